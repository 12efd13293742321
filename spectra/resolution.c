// SPDX-License-Identifier: MIT
#include "spectra/resolution.h"

#include <math.h>
#include <string.h>

#include "core/grid.h"
#include "core/random.h"
#include "core/sinc.h"

enum {
    TAPS = 16,   // samples around a place
    LEVELS = 5,  // doublings that are looked at beyond a rate
    MOST = 24,   // doublings after which no rate is looked for
    CHUNK = 64,  // places at a time
    CHUNKS = 64, // of them; more where few of these places see what varies
    MANY = 1024,
    FEW = 16
};
static const double SHORT = 1.0 / 32; // of the distance of samples: the steps of what is finer
static const double BETA = 4;         // of the Kaiser window: 45 dB
static const double RARE = 256;       // kurtosis: 1/256 of the places, or fewer, see what varies

// Sums over places, of a chunk; added in the order of chunks. Powers are those of values less one
// of them, so that they lose nothing.
typedef struct sums {
    double count, power[5], found; // power[k]: of the k-th power
} sums;

typedef struct looking {
    const bl_signal *signal;
    const bl_region *region;
    double step[BL_AXES], weight[TAPS];
    double origin; // of powers
    size_t chunks;
    int threads;
} looking;

// What is found, in squares of values; and the variance and the kurtosis of the values.
typedef struct finding {
    double found, variance, kurtosis;
} finding;

static double bessel(double x) { // I_0; for x <= 4 the term k = 24 is below 1e-30
    double term = 1, sum = 1;
    for (int k = 1; k < 24; k++) {
        term *= 0.25 * x * x / ((double)k * k);
        sum += term;
    }
    return sum;
}

static void set_weights(double weight[TAPS]) {
    double sum = 0;
    for (int k = 0; k < TAPS; k++) {
        double x = k - 0.5 * (TAPS - 1), edge = 2 * x / TAPS;
        weight[k] = bl_sinc(x) * bessel(BETA * sqrt(1 - edge * edge));
        sum += weight[k];
    }
    for (int k = 0; k < TAPS; k++)
        weight[k] /= sum;
}

// The places of a chunk, and a number in [0, 1) for each. They are the same for all steps.
static void place_chunk(const looking *look, size_t chunk, double at[BL_AXES][CHUNK],
                        double along[CHUNK]) {
    bl_random random = bl_random_seed(0x7265736f6c7665, chunk);
    for (size_t i = 0; i < CHUNK; i++) {
        for (int a = 0; a < BL_AXES; a++)
            at[a][i] = look->region->origin[a];
        for (int s = 0; s < BL_AXES; s++) {
            double u = bl_random_unit(&random);
            for (int a = 0; a < BL_AXES; a++)
                at[a][i] += u * look->region->side[s][a];
        }
        along[i] = bl_random_unit(&random);
    }
}

// `around` has `taps` values a place, first those of the first place.
static sums add_up(const float *middle, double origin, const float *around, size_t taps,
                   const double *weight, double gain) {
    sums sum = {0};
    for (size_t i = 0; i < CHUNK; i++) {
        double difference = (double)middle[i], power = 1;
        for (size_t k = 0; k < taps; k++)
            difference -= weight[k] * (double)around[taps * i + k];
        if (!isfinite(difference))
            continue;
        sum.count++;
        for (int k = 1; k <= 4; k++)
            sum.power[k] += power *= (double)middle[i] - origin;
        sum.found += gain * difference * difference;
    }
    return sum;
}

// The samples around the places of a chunk, at a distance of `scale` steps from each other; or two
// of them, a random part of it to both sides.
static sums look_at_chunk(const looking *look, size_t chunk, double scale, int is_short) {
    static const double halves[2] = {0.5, 0.5};
    double place[BL_AXES][CHUNK], along[CHUNK], at[BL_AXES][CHUNK * TAPS];
    float middle[CHUNK], around[CHUNK * TAPS];
    size_t taps = is_short ? 2 : TAPS;
    place_chunk(look, chunk, place, along);
    for (size_t i = 0; i < CHUNK; i++)
        for (size_t k = 0; k < taps; k++) {
            double x =
                is_short ? ((double)k * 2 - 1) * SHORT * along[i] : (double)k - 0.5 * (TAPS - 1);
            for (int a = 0; a < BL_AXES; a++)
                at[a][taps * i + k] = place[a][i] + x * scale * look->step[a];
        }
    bl_signal_points(look->signal, BL_COLUMNS(place), CHUNK, middle);
    bl_signal_points(look->signal, BL_COLUMNS(at), CHUNK * taps, around);
    // The mean of 1 - cos over a turn, squared, is 3/2.
    return is_short ? add_up(middle, look->origin, around, taps, halves, 2.0 / 3)
                    : add_up(middle, look->origin, around, taps, look->weight, 0.25);
}

static finding find(const looking *look, double scale, int is_short) {
    sums chunk[MANY], all = {0};
#pragma omp parallel for num_threads(bl_thread_count(look->threads)) schedule(dynamic, 1)
    for (size_t c = 0; c < look->chunks; c++)
        chunk[c] = look_at_chunk(look, c, scale, is_short);
    for (size_t c = 0; c < look->chunks; c++) {
        all.count += chunk[c].count;
        for (int k = 1; k <= 4; k++)
            all.power[k] += chunk[c].power[k];
        all.found += chunk[c].found;
    }
    if (!(all.count > 0))
        return (finding){0};
    double m[5];
    for (int k = 1; k <= 4; k++)
        m[k] = all.power[k] / all.count;
    double variance = m[2] - m[1] * m[1];
    double fourth = m[4] - 4 * m[1] * m[3] + 6 * m[1] * m[1] * m[2] - 3 * pow(m[1], 4);
    // Floats round by 2^-24 of their size: a variance below the square of some of that is theirs.
    double rounding = 0x1p-20 * (fabs(look->origin) + fabs(m[1]));
    if (!(variance > rounding * rounding))
        return (finding){.kurtosis = INFINITY};
    return (finding){all.found / all.count, variance, fourth / (variance * variance)};
}

// Whether the signal states that the share beyond the limit is small, in any direction; or that
// samples are independent at any distance, so that there is nothing between them.
static int is_stated(const bl_signal *signal, double rate, double allowed) {
    const bl_facts *facts = &signal->facts;
    int is_inside = sqrt(3) * facts->band_to <= 0.5 * rate;
    return signal->definition && (facts->covariance_reach == 0 ||
                                  (is_inside && pow(10, 0.1 * facts->leak_db) <= allowed));
}

// Whether samples so far apart are those of the signal's own grid, or closer.
static int is_own_grid(const bl_signal *signal, const double step[BL_AXES], double scale) {
    const bl_extent *extent = &signal->extent;
    for (int a = 0; a < BL_AXES; a++)
        if (extent->size[a] && fabs(scale * step[a]) > (1 + 1e-9) * extent->spacing[a])
            return 0;
    return extent->size[0] != 0;
}

// How many chunks cost about as much as the samples that are taken anyway.
static double chunks_afforded(const bl_signal *signal, const bl_resolution_settings *settings) {
    if (signal->definition || settings->samples == 0)
        return MANY;
    return fmax(1, floor(settings->samples / (CHUNK * (LEVELS * (TAPS + 1) + 6.0))));
}

bl_resolution bl_resolution_measure(const bl_signal *signal, const bl_region *region,
                                    const double step[BL_AXES],
                                    const bl_resolution_settings *settings) {
    looking look = {
        .signal = signal, .region = region, .chunks = CHUNKS, .threads = settings->threads};
    double square = 0, found[MOST + LEVELS];
    for (int a = 0; a < BL_AXES; a++)
        square += step[a] * step[a];
    double rate = 1 / sqrt(square);
    bl_resolution resolution = {.times = 1, .rate = rate, .allowed = settings->allowed};
    if (is_stated(signal, rate, settings->allowed) || is_own_grid(signal, step, 1))
        return resolution;
    memcpy(look.step, step, sizeof look.step);
    set_weights(look.weight);
    double origin = bl_signal_value(signal, region->origin);
    look.origin = isfinite(origin) ? origin : 0;
    double afforded = chunks_afforded(signal, settings);
    look.chunks = settings->is_brief ? FEW : CHUNKS;
    if ((double)look.chunks > afforded)
        look.chunks = (size_t)afforded; // at least 1
    if (!settings->is_brief && find(&look, 1, 1).kurtosis > RARE)
        look.chunks = (size_t)fmin(MANY, 4 * afforded);
    for (int level = 0; level < LEVELS - 1; level++)
        found[level] = find(&look, exp2(-level), 0).found;
    for (int base = 0; base < (settings->is_brief ? 1 : MOST); base++) {
        int last = base + LEVELS - 1;
        found[last] = find(&look, exp2(-last), 0).found;
        finding tail = find(&look, exp2(-base), 1);
        double beyond = tail.found;
        for (int level = base; level <= last; level++)
            beyond = fmax(beyond, found[level]);
        if (base == 0) {
            resolution.variance = tail.variance;
            resolution.beyond = tail.variance > 0 ? fmin(beyond / tail.variance, 1) : 0;
        }
        double limit = settings->allowed * fmax(resolution.variance, settings->variance);
        if (beyond <= limit || is_own_grid(signal, step, exp2(-base))) {
            resolution.times = exp2(base);
            resolution.rate = rate * resolution.times;
            return resolution;
        }
    }
    resolution.times = resolution.rate = INFINITY;
    return resolution;
}
