// SPDX-License-Identifier: MIT
//
// Tiles: noises that are made when they are opened, as a periodic grid of numbers, and read back by
// a kernel. What is not hot: settings, making, the reference in double. noises/tiles/tile_points.h
// has the loops in float.
//
//   n(p) = sum over the numbers j of  c_j  k_x(r x - j_x) k_y(r y - j_y) k_z(r z - j_z)
//
// with r numbers a unit, a power of two, so that r x is exact, and a size that is a power of two
// along each axis, after which the numbers repeat. The numbers are floats by definition: the
// reference in double and the float loops start from the same ones.
//
// What reading does to a spectrum. A harmonic exp(2 pi i v j) of the numbers, v cycles a number,
// |v| <= 1/2, becomes the sum over whole m of k^(v + m) exp(2 pi i (v + m) r x): the harmonic
// itself times k^(v), and its images. Over a random place their powers add up, axis by axis, to
// |c|^2 times
//     sum over m of |k^(v + m)|^2  =  sum over whole lags l of rho(l) cos(2 pi v l)
// with rho the kernel's autocorrelation: bl_tile_power. No noise read from a tile is band-limited
// exactly; its leak is that of the images, and is stated.
#ifndef BL_NOISES_TILES_TILE_H
#define BL_NOISES_TILES_TILE_H

#include <stdint.h>

#include "core/grammar.h"
#include "core/random.h"
#include "core/signal.h"

enum { BL_TILE_AXES = 3, BL_TILE_TAPS = 6 };

// The kernels. The first four are the choices of the key `interp`.
typedef enum bl_tile_kernel {
    BL_TILE_BSPLINE3,      // cubic B-spline: C2
    BL_TILE_CATMULL_ROM,   // C1
    BL_TILE_LINEAR,        // C0
    BL_TILE_NEAREST,       // the box, jumps half way between two numbers
    BL_TILE_BSPLINE2,      // quadratic B-spline, C1
    BL_TILE_BSPLINE2_WIDE, // the same, twice as wide: b(x/2)
    BL_TILE_KERNELS
} bl_tile_kernel;

// What a tile is to be; the fields of the shared keys.
typedef struct bl_tile_settings {
    uint64_t seed;
    uint32_t size[BL_LIST_SIZE]; // as read: 0 for the default
    uint32_t dimensions;
    uint32_t samples; // numbers a unit
    uint32_t interp;
} bl_tile_settings;

typedef struct bl_tile_covariance bl_tile_covariance; // noises/tiles/tile_covariance.h

typedef struct bl_tile {
    float *number; // x runs fastest; owned
    uint32_t dimensions;
    uint32_t size[BL_TILE_AXES]; // 1 beyond the dimensions
    uint32_t kernel[BL_TILE_AXES];
    double rate;                    // numbers a unit
    bl_tile_covariance *covariance; // shared with the copies of a block; NULL if it has none
} bl_tile;

extern const char *const bl_tile_interps[]; // "bspline", "catmull-rom", "linear", "nearest"
extern const char *const bl_tile_size_examples[];

// clang-format off
// The keys of a tile, for parameter lists; `usual` are the defaults of the interpolation and of the
// numbers a unit, and the sizes for 0 in words.
#define BL_TILE_DIMENSIONS_PARAMETER(block, field, least, most, usual)                             \
    {"dims", BL_INTEGER, offsetof(block, field), usual, "", .minimum = least, .maximum = most,     \
     .help = "dimensions; coordinates beyond them are ignored"}
#define BL_TILE_SIZE_PARAMETER(block, field, usual)                                                \
    {"size", BL_LIST, offsetof(block, field), "0", "numbers", .minimum = 0, .maximum = 1 << 24,    \
     .examples = bl_tile_size_examples,                                                            \
     .help = "of the tile, a power of two, one or one an axis; 0: " usual}
#define BL_TILE_INTERP_PARAMETER(block, field, usual)                                              \
    {"interp", BL_CHOICE, offsetof(block, field), usual, "", .choices = bl_tile_interps,           \
     .help = "the kernel that reads the tile"}
#define BL_TILE_SAMPLES_PARAMETER(block, field)                                                    \
    {"samples", BL_INTEGER, offsetof(block, field), "4", "a unit", .minimum = 2, .maximum = 16,    \
     .help = "numbers of the tile, a power of two"}
// clang-format on

// The size along each axis with these settings: `usual[d-1]` where none is set, 1 beyond the
// dimensions.
void bl_tile_sizes(const bl_tile_settings *settings, const uint32_t usual[BL_TILE_AXES],
                   uint32_t size[BL_TILE_AXES]);

// Whether each size is a power of two from `least` on, their product at most 2^26, and the samples
// a power of two. Errors: BL_USAGE, naming the key; BL_MISMATCH for a tile too large.
bl_status bl_tile_check(const bl_tile_settings *settings, const uint32_t usual[BL_TILE_AXES],
                        uint32_t least, bl_message *message);

// Makes a tile of these numbers, each times `scale`; release frees it. Errors: BL_DEVICE.
bl_status bl_tile_make(bl_tile *tile, const double *numbers, double scale, bl_message *message);
void bl_tile_release(bl_tile *tile);
size_t bl_tile_count(const uint32_t size[BL_TILE_AXES]);

// Begins a tile of these settings, to be made: what a copy of a block brings along stays.
void bl_tile_begin(bl_tile *tile, const bl_tile_settings *settings,
                   const uint32_t usual[BL_TILE_AXES], double rate);

// Rows of width + 2 numbers, as a transform back leaves them, become rows of width.
void bl_tile_close_rows(double *numbers, size_t rows, size_t width);

// The reference, and its gradient where that is not NULL: NaN for NaN, infinity, and beyond 2^62 in
// one of the tile's axes.
double bl_tile_value(const bl_tile *tile, const double at[BL_AXES], double gradient[BL_AXES]);

// The facts of reading: class, periods, cell, far, mean 0.
void bl_tile_describe(const bl_tile *tile, bl_facts *facts);

// The kernel: its transform at v cycles a number; its correlation with itself, int k(x) k(x + lag)
// dx; the power of a harmonic and all its images (see above); the largest sum of the sizes of its
// weights.
double bl_tile_transform(bl_tile_kernel kernel, double v);
double bl_tile_correlation(bl_tile_kernel kernel, double lag);
double bl_tile_power(bl_tile_kernel kernel, double v);
double bl_tile_gain(bl_tile_kernel kernel);

// Solves a periodic system along the middle index of numbers[outer][n][inner], in place: the
// numbers are divided by the filter x + 1/x - (z + 1/z), x the shift by one, for a pole 0 < |z| <
// 1, by a recursion each way (unser1993), exact except for rounding: periodic sums start them.
void bl_tile_solve(double *numbers, size_t outer, size_t n, size_t inner, double pole);

// Turns values into the weights of the kernel that pass through them: for the cubic B-spline (1, 4,
// 1)/6 is inverted along each axis; for the others nothing changes. The largest sum of sizes of the
// inverse is 3 an axis: 1 / ((4 - 2)/6).
void bl_tile_prefilter(double *numbers, const uint32_t size[BL_TILE_AXES], bl_tile_kernel kernel);
double bl_tile_prefilter_gain(bl_tile_kernel kernel);

// Independent random numbers, nearly normal: sums of four uniform ones, which one random word
// holds, scaled to mean 0 and variance 1, exactly. Their fourth moment is 2.7 (normal: 3), and none
// is beyond BL_TILE_NUMBER: 4 sqrt(3/4) = 3.4642. No library function rounds here, so the numbers
// are the same everywhere.
#define BL_TILE_NUMBER 3.4642
void bl_tile_numbers(bl_random *random, double *numbers, size_t count);

#endif
