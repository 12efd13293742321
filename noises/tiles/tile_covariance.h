// SPDX-License-Identifier: MIT
//
// The covariance of a noise that is read from a tile, over places and seeds, exact.
//
// With C(l) = E[c_j c_(j+l)] of the tile's numbers, averaged over the places j in the tile, and rho
// the reading kernel's correlation with itself,
//
//   R(lag) = sum over whole l of  C(l)  rho_x(r lag_x - l_x) rho_y(r lag_y - l_y) rho_z(...)
//
// a finite sum, since rho ends. C comes from the mean power of each harmonic of the numbers, by one
// transform: what makes a tile is linear in its random numbers, or a sum of cosines with random
// phases, so those powers are known exactly. R is as periodic as the tile: it has no end, and its
// transform is a comb of lines and no density. Each line holds what bl_tile_power says.
#ifndef BL_NOISES_TILES_TILE_COVARIANCE_H
#define BL_NOISES_TILES_TILE_COVARIANCE_H

#include "noises/tiles/tile.h"

struct bl_tile_covariance {
    double *number; // C, x runs fastest; a buffer of bl_fft_buffer
    uint32_t size[BL_TILE_AXES];
    unsigned users;
};

// Tiles with more numbers, 2^22, have none: it would take twice the memory of the tile.
int bl_tile_wants_covariance(const bl_tile *tile);

// A buffer for the powers of a tile's harmonics, cleared, as a real transform of the tile stands in
// it (core/fft.h): bl_tile_power_at gives the place of one, -size/2 < k < size/2 or k_x from 0 to
// size/2. The caller frees it. NULL out of memory.
double *bl_tile_powers(const bl_tile *tile);
double *bl_tile_power_at(const bl_tile *tile, double *powers, const int k[BL_TILE_AXES]);

// Gives the tile its covariance from the powers E|c^_k|^2 of all harmonics, whose sum over k and -k
// is E[c^2]; takes the buffer. Errors: BL_DEVICE, which leaves nothing behind.
bl_status bl_tile_set_powers(bl_tile *tile, double *powers, bl_message *message);

// One user less; the last one frees it. NULL is fine. Copies of a block share it: all seeds have
// the same. Thread-safe.
void bl_tile_covariance_keep(bl_tile_covariance *covariance);
void bl_tile_covariance_drop(bl_tile_covariance *covariance);

// R, of a noise whose block begins with its tile, and whether there is one.
double bl_tile_noise_covariance(const void *block, const double lag[BL_AXES]);
int bl_tile_noise_has_covariance(const void *block);

#endif
