// SPDX-License-Identifier: MIT
#include "noises/textbook.h"

#include <math.h>
#include <pthread.h>

#include "core/random.h"
#include "noises/lattice/lattice.h"
#include "noises/noise.h"
#include "noises/tiles/tile.h"
#include "noises/lattice/wiener_weights.h"

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
