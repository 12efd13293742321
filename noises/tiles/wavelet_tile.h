// SPDX-License-Identifier: MIT
//
// The tile of wavelet noise: random numbers minus their best approximation by coarser splines.
//
// Numbers c_j, j whole, stand for the spline sum of c_j b(x - j), b the quadratic B-spline with
// knots at the half integers. Coarse splines are b((x - 1/2)/2 - m): their knots are among the fine
// ones, and by the two-scale relation of the B-spline
//
//   b((x - 1/2)/2 - m) = 1/4 b(x - 2m + 1) + 3/4 b(x - 2m) + 3/4 b(x - 2m - 1) + 1/4 b(x - 2m - 2)
//
// which is upsampling, U. Downsampling, D, is the best approximation in the sense of least squares
// over x (not over the numbers): a = D c minimises the integral of the square of the spline of
// c - U a, so (U'GU) a = U'G c, where G is the matrix of the integrals of b(x - i) b(x - j): the
// quintic B-spline at whole numbers, (1, 26, 66, 26, 1)/120. U'GU is that of the coarse splines,
// 2 G on the coarse lattice. So
//
//   D = 1/2 G^-1 U'G,    U'G = (1, 29, 147, 303, 303, 147, 29, 1)/480 around 2m + 1/2
//
// and G^-1 is two recursions, with the poles z + 1/z = -13 +- sqrt 105, both ways, periodic and
// exact (bl_tile_solve): the filter is not cut off, so there is no truncation error.
//
// D U = 1, P = U D is a projection, and the spline of c - P c is orthogonal to every coarse one. In
// several dimensions P is the product of those of the axes.
//
// Spectrum. On a lattice of n numbers, v = k/n, with u(v) = 2 cos^3(pi v) for U and
// G(v) = (66 + 52 cos 2 pi v + 2 cos 4 pi v)/120, a harmonic v of c passes P to v itself times
//   p0(v) = u(v)^2 G(v) / (4 G(2v))            and to its mirror image v + 1/2, of the same power
//   as p1(v) = u(v)^2 u(v+1/2)^2 G(v+1/2)^2 / (4 G(2v))^2,     the power that v receives from v +
//   1/2.
// For white numbers of variance 1 the power of c - P c at (v_x, v_y, v_z), over places, is
//   S = 1 - 2 prod p0(v_a) + prod (p0(v_a)^2 + p1(v_a)).
#ifndef BL_NOISES_TILES_WAVELET_TILE_H
#define BL_NOISES_TILES_WAVELET_TILE_H

#include "noises/tiles/tile.h"

typedef struct bl_wavelet {
    bl_tile_settings tile;
    uint32_t projected; // along the normal: the wide kernel
    uint32_t normal;    // an axis
} bl_wavelet;

extern const uint32_t bl_wavelet_sizes[BL_TILE_AXES];

// Along the middle index of numbers[outer][n][inner], n even: to [outer][n/2][inner], and back.
void bl_wavelet_down(const double *fine, size_t outer, size_t n, size_t inner, double *coarse);
void bl_wavelet_up(const double *coarse, size_t outer, size_t n, size_t inner, double *fine);

// Takes away the coarse part of a tile's numbers, in place. Errors: BL_DEVICE.
bl_status bl_wavelet_remove_coarse(double *numbers, const uint32_t size[BL_TILE_AXES],
                                   bl_message *message);

// S above, of numbers of variance 1; for frequencies in cycles a number.
double bl_wavelet_power(unsigned dimensions, const double v[BL_TILE_AXES]);

// Makes the tile, of unit variance over places and seeds. Errors: BL_DEVICE.
bl_status bl_wavelet_build(const bl_wavelet *settings, bl_tile *tile, bl_message *message);
void bl_wavelet_describe(const bl_wavelet *settings, const bl_tile *tile, bl_facts *facts);

// The variance before it is made 1.
double bl_wavelet_variance(const bl_tile *tile);

#endif
