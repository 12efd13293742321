// SPDX-License-Identifier: MIT
#include "noises/textbook.h"

#include <math.h>
#include <pthread.h>

#include "core/random.h"
#include "noises/kernel.h"
#include "noises/tile.h"
#include "noises/wiener_weights.h"

// peachey2003, p. 70: a permutation of 0..255. Data of the text, unchanged.
// clang-format off
const unsigned char bl_permutation[BL_TEXTBOOK_SIZE] = {
    225, 155, 210, 108, 175, 199, 221, 144, 203, 116, 70, 213, 69, 158, 33, 252,
    5, 82, 173, 133, 222, 139, 174, 27, 9, 71, 90, 246, 75, 130, 91, 191,
    169, 138, 2, 151, 194, 235, 81, 7, 25, 113, 228, 159, 205, 253, 134, 142,
    248, 65, 224, 217, 22, 121, 229, 63, 89, 103, 96, 104, 156, 17, 201, 129,
    36, 8, 165, 110, 237, 117, 231, 56, 132, 211, 152, 20, 181, 111, 239, 218,
    170, 163, 51, 172, 157, 47, 80, 212, 176, 250, 87, 49, 99, 242, 136, 189,
    162, 115, 44, 43, 124, 94, 150, 16, 141, 247, 32, 10, 198, 223, 255, 72,
    53, 131, 84, 57, 220, 197, 58, 50, 208, 11, 241, 28, 3, 192, 62, 202,
    18, 215, 153, 24, 76, 41, 15, 179, 39, 46, 55, 6, 128, 167, 23, 188,
    106, 34, 187, 140, 164, 73, 112, 182, 244, 195, 227, 13, 35, 77, 196, 185,
    26, 200, 226, 119, 31, 123, 168, 125, 249, 68, 183, 230, 177, 135, 160, 180,
    12, 1, 243, 148, 102, 166, 38, 238, 251, 37, 240, 126, 64, 74, 161, 40,
    184, 149, 171, 178, 101, 66, 29, 59, 146, 61, 254, 107, 42, 86, 154, 4,
    236, 232, 120, 21, 233, 209, 45, 98, 193, 114, 78, 19, 206, 14, 118, 127,
    48, 79, 147, 85, 30, 207, 219, 54, 88, 234, 190, 122, 95, 67, 143, 109,
    137, 214, 145, 93, 92, 100, 245, 0, 216, 186, 60, 83, 105, 97, 204, 52,
};
// clang-format on

bl_textbook bl_textbook_data;

static double radial_catmull_rom(double r) {
    return r < 1 ? 1 + r * r * (-2.5 + 1.5 * r) : 2 + r * (-4 + r * (2.5 - 0.5 * r));
}

static void fill_tile(bl_random *random, float *tile, size_t count, bl_kernel kernel, int axes) {
    // The variance of reading numbers of variance 1, at a random place.
    double scale = pow(bl_kernel_correlation(kernel, 0), -0.5 * axes);
    for (size_t i = 0; i < count; i += 64) {
        double numbers[64];
        bl_tile_numbers(random, numbers, 64);
        for (size_t j = 0; j < 64; j++)
            tile[i + j] = (float)(scale * numbers[j]);
    }
}

void bl_textbook_refill(uint64_t seed) {
    bl_random random = bl_random_seed(seed, 0);
    bl_textbook *data = &bl_textbook_data;
    for (int i = 0; i < BL_TEXTBOOK_SIZE; i++) {
        data->values[i] = (float)(1 - 2 * bl_random_unit(&random));
        double z = 1 - 2 * bl_random_unit(&random);
        double longitude = 2 * acos(-1) * bl_random_unit(&random);
        data->gradients[3 * i] = (float)(sqrt(1 - z * z) * cos(longitude));
        data->gradients[3 * i + 1] = (float)(sqrt(1 - z * z) * sin(longitude));
        data->gradients[3 * i + 2] = (float)z;
        for (int c = 0; c < 3; c++)
            data->impulses[4 * i + c] = (float)bl_random_unit(&random);
        data->impulses[4 * i + 3] = (float)(1 - 2 * bl_random_unit(&random));
    }
    for (int i = 0; i <= 400; i++)
        data->kernel[i] = (float)radial_catmull_rom(sqrt(i / 100.0));
    for (int i = 0; i < 3 * BL_TEXTBOOK_SIZE; i++)
        data->tangents[i] = (float)(1 - 2 * bl_random_unit(&random));
    bl_wiener_kernel wiener = bl_wiener_kernel_of(BL_WIENER_GAUSSIAN, 1);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            data->inverse[i][j] = (float)wiener.inverse[i][j];
    const size_t square = BL_TEXTBOOK_TILE * BL_TEXTBOOK_TILE;
    const size_t cube = BL_TEXTBOOK_CUBE * BL_TEXTBOOK_CUBE * BL_TEXTBOOK_CUBE;
    fill_tile(&random, data->bspline3, square, BL_KERNEL_BSPLINE3, 2);
    fill_tile(&random, data->catmull_rom, square, BL_KERNEL_CATMULL_ROM, 2);
    fill_tile(&random, data->bspline2, cube, BL_KERNEL_BSPLINE2, 3);
}

static void fill_tables(void) {
    bl_textbook_refill(665); // the seed of the text
}

const bl_textbook *bl_textbook_tables(void) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, fill_tables);
    return &bl_textbook_data;
}
