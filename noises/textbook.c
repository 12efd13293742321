// SPDX-License-Identifier: MIT
#include "noises/textbook.h"

#include <math.h>
#include <pthread.h>

#include "core/random.h"
#include "noises/lattice/lattice.h"
#include "noises/noise.h"
#include "noises/tiles/tile.h"
#include "noises/lattice/wiener_weights.h"

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

// The words of all entries of lattice=perm256.
typedef uint32_t entry_words[BL_TEXTBOOK_SIZE];

static void draw_words(uint64_t seed, entry_words words[BL_COMPONENTS]) {
    bl_lattice lattice = bl_lattice_of(seed, BL_LATTICE_PERM256);
    for (unsigned component = 0; component < BL_COMPONENTS; component++)
        bl_perm256_words(&lattice, component, words[component]);
}

void bl_textbook_draw(bl_textbook *tables, uint64_t seed) {
    entry_words of_value[BL_COMPONENTS], of_gradient[BL_COMPONENTS];
    draw_words(bl_stream(seed, 16), of_value);
    draw_words(bl_stream(seed, 17), of_gradient);
    bl_random random = bl_random_seed(seed, 0);
    for (int i = 0; i < BL_TEXTBOOK_SIZE; i++) {
        double gradient[3];
        float number[BL_COMPONENTS];
        bl_lattice_gradient(BL_GRADIENTS_SPHERE, of_gradient[0][i], gradient);
        for (unsigned component = 0; component < BL_COMPONENTS; component++)
            number[component] = bl_lattice_value(of_value[component][i]) * (float)BL_LATTICE_UNIT;
        tables->values[i] = number[0];
        tables->edges[i] = (unsigned char)(of_gradient[0][i] >> 28);
        for (int c = 0; c < 3; c++) {
            tables->tangents[3 * i + c] = number[1 + c];
            tables->gradients[3 * i + c] = (float)gradient[c];
            tables->places[3 * i + c] = 0.5f + 0.5f * number[c];
            tables->impulses[4 * i + c] = (float)bl_random_unit(&random);
        }
        tables->impulses[4 * i + 3] = (float)(1 - 2 * bl_random_unit(&random));
    }
}

// The numbers of a noise whose parameter block begins with its tile.
static void copy_tile(bl_opener *open, const char *text, float *numbers, size_t count) {
    bl_signal *signal;
    bl_message message;
    const bl_tile *tile = NULL;
    for (size_t i = 0; i < count; i++)
        numbers[i] = NAN;
    if (open(text, &signal, &message) != BL_OK)
        return;
    tile = signal->parameters;
    if (bl_tile_count(tile->size) == count)
        memcpy(numbers, tile->number, count * sizeof *numbers);
    bl_signal_free(signal);
}

static void fill_tables(bl_opener *open) {
    const size_t square = BL_TEXTBOOK_TILE * BL_TEXTBOOK_TILE;
    bl_textbook *data = &bl_textbook_data;
    bl_textbook_draw(data, BL_TEXTBOOK_SEED);
    for (int i = 0; i <= 400; i++)
        data->kernel[i] = (float)radial_catmull_rom(sqrt(i / 100.0));
    bl_wiener_kernel wiener = bl_wiener_kernel_of(BL_WIENER_GAUSSIAN, 1);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            data->inverse[i][j] = (float)wiener.inverse[i][j];
    copy_tile(open, "fourier:" BL_TEXTBOOK_TILE_SETTINGS, data->fourier, square);
    copy_tile(open, "midpoint:" BL_TEXTBOOK_TILE_SETTINGS, data->midpoint, square);
    copy_tile(open, "additions:" BL_TEXTBOOK_TILE_SETTINGS, data->additions, square);
    copy_tile(open, "wavelet:" BL_TEXTBOOK_TILE_SETTINGS, data->wavelet,
              BL_TEXTBOOK_CUBE * BL_TEXTBOOK_CUBE * BL_TEXTBOOK_CUBE);
}

const bl_textbook *bl_textbook_tables(bl_opener *open) {
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    static int filled;
    pthread_mutex_lock(&lock);
    if (!filled)
        fill_tables(open);
    filled = 1;
    pthread_mutex_unlock(&lock);
    return &bl_textbook_data;
}
