// SPDX-License-Identifier: MIT
//
// Spectral synthesis: a tile that has a given power at each of its harmonics.
//
// The harmonics of a tile of size S_a numbers, r a unit, along each axis are the frequencies
// f_a = r k_a / S_a with whole k_a, |k_a| < S_a/2. A pair k, -k is one cosine. With the target p_k
// of its power, its weight in the tile is  sqrt(2 p_k) g_k cos(2 pi f.x + phase) / k^_x k^_y k^_z,
// g_k = 1 or of mean square 1, where k^ is the reading kernel's transform at k_a / S_a cycles a
// number: so the noise that is read has exactly the power p_k there, and nothing else but images.
#ifndef BL_NOISES_TILES_SYNTHESIS_H
#define BL_NOISES_TILES_SYNTHESIS_H

#include "noises/tiles/spectrum_table.h"
#include "noises/tiles/tile.h"

typedef enum bl_synthesis_spectrum { BL_SYNTHESIS_BAND, BL_SYNTHESIS_POWER } bl_synthesis_spectrum;
typedef enum bl_synthesis_amplitudes {
    BL_SYNTHESIS_FIXED,
    BL_SYNTHESIS_GAUSSIAN
} bl_synthesis_amplitudes;

typedef struct bl_synthesis {
    bl_tile_settings tile;
    uint32_t spectrum;
    uint32_t amplitudes;
    double from, to; // of a band, cycles a unit, in either order
    double beta;     // of a power law
    char csv[BL_TEXT_SIZE];
    bl_spectrum_table *table; // NULL without csv
    double rate;              // numbers a unit
} bl_synthesis;

extern const uint32_t bl_synthesis_sizes[BL_TILE_AXES];

// Errors: BL_USAGE for settings that do not fit together; BL_MISMATCH for a tile too large.
bl_status bl_synthesis_check(const bl_synthesis *settings, bl_message *message);

// Reads the table, or becomes one more user of it, and makes the tile; on failure nothing is left
// to release. Errors: those of bl_spectrum_table_read; BL_USAGE where no harmonic has power or the
// samples are too few; BL_DEVICE.
bl_status bl_synthesis_build(bl_synthesis *settings, bl_tile *tile, bl_message *message);

// The power of the pair k, -k, as the noise is read; unit variance in all, or that of the table.
double bl_synthesis_pair_power(const bl_synthesis *settings, const bl_tile *tile, const int k[3]);

void bl_synthesis_describe(const bl_synthesis *settings, const bl_tile *tile, bl_facts *facts);

#endif
