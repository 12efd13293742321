// SPDX-License-Identifier: MIT
#include "noises/tiles/synthesis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/fft.h"
#include "noises/tiles/tile_covariance.h"

const uint32_t bl_synthesis_sizes[BL_TILE_AXES] = {256, 64, 32};

// --- settings -----------------------------------------------------------------------------------

static double band_end(const bl_synthesis *settings) {
    return fmax(settings->from, settings->to);
}

bl_status bl_synthesis_check(const bl_synthesis *settings, bl_message *message) {
    bl_status status = bl_tile_check(&settings->tile, bl_synthesis_sizes, 8, message);
    if (status != BL_OK)
        return status;
    if (settings->tile.samples == 1)
        return bl_report(message, BL_USAGE, "samples=1: expected 0, 2, 4, 8 or 16");
    double nyquist = settings->tile.samples / 2.0;
    if (settings->tile.samples && !*settings->csv && settings->spectrum == BL_SYNTHESIS_BAND &&
        band_end(settings) > nyquist)
        return bl_report(message, BL_USAGE,
                         "samples=%u holds frequencies up to %g; the band from=%g to=%g needs more",
                         settings->tile.samples, nyquist, settings->from, settings->to);
    return BL_OK;
}

// Numbers a unit: as set, or 4 for a power law, or the least power of two that is 4 times the
// highest frequency.
static bl_status find_rate(bl_synthesis *settings, bl_message *message) {
    double highest = 1;
    if (settings->table) {
        size_t last = settings->table->count - 1;
        while (last > 0 && settings->table->density[last] == 0)
            last--;
        // The row after the last that has power: up to there the density falls to 0.
        if (last + 1 < settings->table->count)
            last++;
        highest = settings->table->frequency[last];
    } else if (settings->spectrum == BL_SYNTHESIS_BAND) {
        highest = fmax(1, band_end(settings));
    }
    settings->rate = settings->tile.samples;
    if (settings->tile.samples == 0)
        settings->rate = exp2(ceil(log2(4 * highest)));
    if (highest > settings->rate / 2)
        return bl_report(message, BL_USAGE,
                         "samples=%u holds frequencies up to %g; csv=%s goes up to %g",
                         settings->tile.samples, settings->rate / 2, settings->csv, highest);
    // Outside of this a coordinate times the rate could leave the doubles' range.
    if (!(settings->rate >= 0x1p-60 && settings->rate <= 0x1p60))
        return bl_report(message, BL_USAGE, "csv=%s: frequencies up to %g are out of range",
                         settings->csv, highest);
    return BL_OK;
}

// --- the target ---------------------------------------------------------------------------------

// The density at a radial frequency, without a factor for a band and a power law, whose variance is
// made 1. The ends of a band belong to it; a power law ends at the Nyquist frequency.
static double density(const bl_synthesis *settings, double f) {
    if (settings->table)
        return bl_spectrum_table_density(settings->table, f);
    if (settings->spectrum == BL_SYNTHESIS_BAND)
        return f >= fmin(settings->from, settings->to) && f <= band_end(settings);
    return f <= settings->rate / 2 ? pow(f, -settings->beta) : 0;
}

static double frequency_of(const bl_tile *tile, const int k[3]) {
    double square = 0;
    for (int a = 0; a < BL_TILE_AXES; a++) {
        double f = k[a] * tile->rate / tile->size[a]; // exact
        square += f * f;
    }
    return sqrt(square);
}

// Power of a pair, before it is made 1 in all.
static double raw_power(const bl_synthesis *settings, const bl_tile *tile, const int k[3]) {
    double cell = settings->tile.dimensions == 1 ? 1 : 2; // a line's density is one-sided
    for (uint32_t a = 0; a < tile->dimensions; a++)
        cell *= tile->rate / tile->size[a];
    return density(settings, frequency_of(tile, k)) * cell;
}

// Each pair once, in a fixed order: kx > 0; or kx = 0 and ky > 0; or both 0 and kz > 0. Half the
// size along an axis is its own mirror and is left out.
typedef void pair_function(void *context, const int k[3]);

static void for_each_pair(const bl_tile *tile, pair_function *function, void *context) {
    int half[3];
    for (int a = 0; a < BL_TILE_AXES; a++)
        half[a] = ((int)tile->size[a] - 1) / 2;
    for (int z = -half[2]; z <= half[2]; z++)
        for (int y = -half[1]; y <= half[1]; y++)
            for (int x = 0; x <= half[0]; x++)
                if (x > 0 || y > 0 || (y == 0 && z > 0))
                    function(context, (const int[3]){x, y, z});
}

typedef struct total {
    const bl_synthesis *settings;
    const bl_tile *tile;
    double power;
} total;

static void add_power(void *context, const int k[3]) {
    total *in = context;
    in->power += raw_power(in->settings, in->tile, k);
}

static double raw_total(const bl_synthesis *settings, const bl_tile *tile) {
    total all = {settings, tile, 0};
    for_each_pair(tile, add_power, &all);
    return all.power;
}

static double unit_factor(const bl_synthesis *settings, const bl_tile *tile) {
    return settings->table ? 1 : 1 / raw_total(settings, tile);
}

double bl_synthesis_pair_power(const bl_synthesis *settings, const bl_tile *tile, const int k[3]) {
    return raw_power(settings, tile, k) * unit_factor(settings, tile);
}

// --- making -------------------------------------------------------------------------------------

typedef struct synthesis {
    const bl_synthesis *settings;
    const bl_tile *tile;
    double factor;
    const double *transform[BL_TILE_AXES]; // k^ at |k| = 0 ... size/2
    double *buffer;                        // rows of complex numbers, for a transform back
    bl_random random;
} synthesis;

// The power of a pair in the numbers: more than it has as it is read.
static double power_in_tile(const synthesis *in, const int k[3]) {
    double power = in->factor * raw_power(in->settings, in->tile, k);
    for (int a = 0; a < BL_TILE_AXES && power > 0; a++)
        power /= in->transform[a][abs(k[a])] * in->transform[a][abs(k[a])];
    return power;
}

static void draw_pair(void *context, const int k[3]) {
    synthesis *in = context;
    double power = power_in_tile(in, k);
    if (power <= 0)
        return;
    double angle = 2 * M_PI * bl_random_unit(&in->random), size = sqrt(power / 2);
    if (in->settings->amplitudes == BL_SYNTHESIS_GAUSSIAN)
        // The size of a complex normal number of mean square 1; u >= 2^-54.
        size *= sqrt(-log(((double)(bl_random_bits(&in->random) >> 11) + 0.5) * 0x1p-53));
    double *here = bl_tile_power_at(in->tile, in->buffer, k);
    here[0] = size * cos(angle);
    here[1] = size * sin(angle);
    if (k[0] == 0) { // the mirror stands in the same plane
        double *there = bl_tile_power_at(in->tile, in->buffer, (const int[3]){0, -k[1], -k[2]});
        there[0] = here[0];
        there[1] = -here[1];
    }
}

// k^ at the harmonics of the axes, one array after the other.
static double *make_transforms(const bl_tile *tile, const double *transform[BL_TILE_AXES]) {
    size_t count = 0;
    for (int a = 0; a < BL_TILE_AXES; a++)
        count += tile->size[a] / 2 + 1;
    double *all = malloc(count * sizeof *all), *next = all;
    for (int a = 0; all && a < BL_TILE_AXES; a++) {
        transform[a] = next;
        for (uint32_t k = 0; k <= tile->size[a] / 2; k++)
            *next++ =
                k ? bl_tile_transform((bl_tile_kernel)tile->kernel[a], (double)k / tile->size[a])
                  : 1;
    }
    return all;
}

static bl_status synthesise(const bl_synthesis *settings, bl_tile *tile, bl_message *message) {
    // Always as a volume, whose plan is estimated: a plan that was measured could differ from one
    // process to the next where its wisdom cannot be kept.
    bl_fft_shape shape = {.kind = BL_FFT_BACK,
                          .precision = BL_FFT_DOUBLE,
                          .dims = 3,
                          .size = {tile->size[2], tile->size[1], tile->size[0]}};
    const bl_fft *plan;
    bl_status status = bl_fft_plan(&shape, &plan, message);
    if (status != BL_OK)
        return status;
    synthesis in = {.settings = settings,
                    .tile = tile,
                    .factor = unit_factor(settings, tile),
                    .random = bl_random_seed(settings->tile.seed, 22)};
    double *transforms = make_transforms(tile, in.transform);
    in.buffer = bl_fft_buffer(bl_fft_bytes(&shape));
    if (in.buffer && transforms) {
        memset(in.buffer, 0, bl_fft_bytes(&shape));
        for_each_pair(tile, draw_pair, &in);
        bl_fft_run(plan, in.buffer);
        bl_tile_close_rows(in.buffer, (size_t)tile->size[1] * tile->size[2], tile->size[0]);
        status = bl_tile_make(tile, in.buffer, 1, message);
    } else {
        status = bl_report(message, BL_DEVICE, "out of memory for a tile of %zu numbers",
                           bl_tile_count(tile->size));
    }
    free(in.buffer);
    free(transforms);
    return status;
}

// Half of the power of a pair belongs to each of k and -k.
static void add_share(void *context, const int k[3]) {
    synthesis *in = context;
    double share = power_in_tile(in, k) / 2;
    *bl_tile_power_at(in->tile, in->buffer, k) = share;
    if (k[0] == 0)
        *bl_tile_power_at(in->tile, in->buffer, (const int[3]){0, -k[1], -k[2]}) = share;
}

static bl_status find_covariance(const bl_synthesis *settings, bl_tile *tile, bl_message *message) {
    synthesis in = {.settings = settings,
                    .tile = tile,
                    .factor = unit_factor(settings, tile),
                    .buffer = bl_tile_powers(tile)};
    double *transforms = make_transforms(tile, in.transform);
    bl_status status = BL_DEVICE;
    if (in.buffer && transforms) {
        for_each_pair(tile, add_share, &in);
        status = bl_tile_set_powers(tile, in.buffer, message);
    } else {
        bl_report(message, BL_DEVICE, "out of memory for a tile of %zu numbers",
                  bl_tile_count(tile->size));
        free(in.buffer);
    }
    free(transforms);
    return status;
}

bl_status bl_synthesis_build(bl_synthesis *settings, bl_tile *tile, bl_message *message) {
    bl_status status = BL_OK;
    if (settings->table) // a copy of a block that was built
        bl_spectrum_table_keep(settings->table);
    else if (*settings->csv)
        status = bl_spectrum_table_read(settings->csv, &settings->table, message);
    if (status != BL_OK)
        return status;
    bl_tile_begin(tile, &settings->tile, bl_synthesis_sizes, 0);
    status = find_rate(settings, message);
    tile->rate = settings->rate;
    if (status == BL_OK && !(raw_total(settings, tile) > 0))
        status = bl_report(message, BL_USAGE,
                           "no harmonic of the tile, multiples of %g cycles a unit, has power; use "
                           "a larger size",
                           tile->rate / tile->size[0]);
    if (status == BL_OK && bl_tile_wants_covariance(tile))
        status = find_covariance(settings, tile, message);
    if (status == BL_OK)
        status = synthesise(settings, tile, message);
    if (status != BL_OK) {
        bl_tile_release(tile);
        bl_spectrum_table_drop(settings->table);
    }
    return status;
}

// --- facts --------------------------------------------------------------------------------------

typedef struct sums {
    const bl_synthesis *settings;
    const bl_tile *tile;
    double factor, variance, amplitudes, highest;
    double inside[BL_TILE_AXES]; // the variance within the band along each axis
} sums;

// How much a harmonic's power along an axis grows with its images.
static double images(const bl_tile *tile, int axis, int k) {
    if (k == 0 && (uint32_t)axis >= tile->dimensions)
        return 1;
    bl_tile_kernel kernel = (bl_tile_kernel)tile->kernel[axis];
    double v = (double)k / tile->size[axis], transform = bl_tile_transform(kernel, v);
    return bl_tile_power(kernel, v) / (transform * transform);
}

static void add_pair(void *context, const int k[3]) {
    sums *in = context;
    double power = in->factor * raw_power(in->settings, in->tile, k), size = sqrt(2 * power);
    if (power <= 0)
        return;
    double grown[BL_TILE_AXES];
    for (int a = 0; a < BL_TILE_AXES; a++) {
        grown[a] = images(in->tile, a, k[a]);
        if ((uint32_t)a < in->tile->dimensions)
            size /= bl_tile_transform((bl_tile_kernel)in->tile->kernel[a],
                                      (double)k[a] / in->tile->size[a]);
    }
    in->variance += power * grown[0] * grown[1] * grown[2];
    in->amplitudes += size;
    in->highest = fmax(in->highest, frequency_of(in->tile, k));
    // Images along an axis are beyond samples/2 on that axis; along it, those of the others count.
    for (int a = 0; a < BL_TILE_AXES; a++)
        in->inside[a] += power * grown[0] * grown[1] * grown[2] / grown[a];
}

void bl_synthesis_describe(const bl_synthesis *settings, const bl_tile *tile, bl_facts *facts) {
    sums all = {.settings = settings, .tile = tile, .factor = unit_factor(settings, tile)};
    for_each_pair(tile, add_pair, &all);
    double bound = all.amplitudes, least = all.variance;
    if (settings->amplitudes == BL_SYNTHESIS_GAUSSIAN)
        bound *= 6.119; // sqrt(54 ln 2) = 6.1180
    bound *= pow(bl_tile_gain((bl_tile_kernel)tile->kernel[0]), tile->dimensions);
    for (uint32_t a = 0; a < tile->dimensions; a++)
        least = fmin(least, all.inside[a]);
    bl_tile_describe(tile, facts);
    facts->upper = bound * (1 + 0x1p-20); // floats of the tile
    facts->lower = -facts->upper;
    facts->bound_proof = settings->amplitudes == BL_SYNTHESIS_GAUSSIAN
                             ? "the sum of the harmonics' amplitudes, each below 6.119 deviations, "
                               "times the largest sum of the kernel's weights"
                             : "the sum of the harmonics' amplitudes, times the largest sum of the "
                               "kernel's weights";
    facts->variance = all.variance;
    facts->band_from = 0;
    facts->band_to = all.highest;
    facts->leak_db = ceil(1000 * log10(fmax(1 - least / all.variance, 1e-16))) / 100;
}
