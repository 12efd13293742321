// SPDX-License-Identifier: MIT
#include "noises/lattice/lattice_repeats.h"

#include <pthread.h>
#include <stdint.h>

#include "noises/lattice/permutation.h"

enum { SPAN = 2 * BL_REPEATS_REACH + 1 };

// Counts by l_z, l_y, l_x, out of 2^16; of a plane z = 0 by l_y, l_x, out of 2^8.
static uint32_t volume[SPAN][SPAN][SPAN], plane[SPAN][SPAN];

static unsigned shift_of(int y, int z) {
    return bl_permutation[(unsigned)(y + (int)bl_permutation[z & 255]) & 255];
}

// l_x from -reach to reach as an index, or SPAN.
static unsigned step_of(unsigned from, unsigned to) {
    unsigned step = (from - to + BL_REPEATS_REACH) & 255;
    return step < SPAN ? step : SPAN;
}

static void count_repeats(void) {
    for (int k = 0; k < SPAN; k++)
        for (int j = 0; j < SPAN; j++) {
            int ly = j - BL_REPEATS_REACH, lz = k - BL_REPEATS_REACH;
            for (int z = 0; z < 256; z++)
                for (int y = 0; y < 256; y++) {
                    unsigned step = step_of(shift_of(y, z), shift_of(y + ly, z + lz));
                    if (step == SPAN)
                        continue;
                    volume[k][j][step]++;
                    plane[j][step] += z == 0 && lz == 0;
                }
        }
}

double bl_perm256_repeats(unsigned dimensions, const int lag[3]) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, count_repeats);
    int x = lag[0] + BL_REPEATS_REACH, y = lag[1] + BL_REPEATS_REACH, z = lag[2] + BL_REPEATS_REACH;
    if (dimensions == 1) // one row
        return lag[0] == 0;
    return dimensions == 2 ? plane[y][x] / 256.0 : volume[z][y][x] / 65536.0;
}
