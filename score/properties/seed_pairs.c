// SPDX-License-Identifier: MIT
#include "score/properties/seed_pairs.h"

#include <math.h>
#include <stdlib.h>

#include "core/grid.h"

enum { SEEDS = 32, PAIRS = SEEDS * (SEEDS - 1) / 2 };

// Of 2 SEEDS signals, the small seeds and then the random ones, the standardised values at the same
// places, cut off at 3 deviations: one far value decides nothing.
typedef struct sample {
    uint64_t seed[2 * SEEDS];
    size_t places;
    float *value; // [2 * SEEDS][places]
} sample;

static int fill(const bl_signal *signal, const bl_score_look *look,
                const bl_score_settings *settings, sample *s) {
    const size_t count = s->places;
    int failed = 0;
    double *column = malloc(BL_AXES * count * sizeof *column);
    s->value = malloc(2 * SEEDS * count * sizeof *s->value);
    bl_random random = bl_score_random(settings, "seed pairs", 0);
    for (size_t i = 0; column && i < BL_AXES * count; i++)
        column[i] = look->cell * 16384 * (bl_random_unit(&random) - 0.5);
    for (int k = 0; k < 2 * SEEDS; k++)
        s->seed[k] = k < SEEDS ? (uint64_t)k : bl_random_bits(&random);
    failed = !column || !s->value;
#pragma omp parallel for num_threads(bl_thread_count(settings->threads)) schedule(dynamic)
    for (int k = 0; k < 2 * SEEDS; k++) {
        bl_signal *fresh = failed ? NULL : bl_signal_reseed(signal, s->seed[k]);
        float *value = fresh ? s->value + (size_t)k * count : NULL;
        if (!fresh) {
#pragma omp atomic write
            failed = 1;
            continue;
        }
        bl_signal_points(
            fresh,
            (const double *const[]){column, column + count, column + 2 * count, column + 3 * count},
            count, value);
        bl_signal_free(fresh);
        for (size_t i = 0; i < count; i++) {
            float u = (float)(((double)value[i] - look->mean) / look->deviation);
            value[i] = u > 3 ? 3 : u < -3 ? -3 : u; // NaN stays NaN
        }
    }
    free(column);
    return !failed;
}

static double correlation(const sample *s, size_t i, size_t j) {
    const float *a = s->value + i * s->places, *b = s->value + j * s->places;
    double n = (double)s->places, a1 = 0, b1 = 0, ab = 0, aa = 0, bb = 0;
    for (size_t k = 0; k < s->places; k++) {
        a1 += (double)a[k];
        b1 += (double)b[k];
        ab += (double)a[k] * (double)b[k];
        aa += (double)a[k] * (double)a[k];
        bb += (double)b[k] * (double)b[k];
    }
    return (ab - a1 * b1 / n) / sqrt((aa - a1 * a1 / n) * (bb - b1 * b1 / n));
}

bl_status bl_seed_pairs_measure(const bl_signal *signal, const bl_score_look *look,
                                const bl_score_settings *settings, double alpha,
                                bl_seed_pairs *pairs, bl_message *message) {
    sample s = {.places = (size_t)bl_size_pick(settings->size, 2048, 4096, 16384)};
    double squares = 0;
    *pairs = (bl_seed_pairs){.places = s.places};
    if (!fill(signal, look, settings, &s)) {
        free(s.value);
        return bl_report(message, BL_DEVICE, "out of memory for signals of %d seeds", 2 * SEEDS);
    }
    for (size_t i = 0; i < SEEDS; i++)
        for (size_t j = 0; j < i; j++) {
            double r = correlation(&s, i, j), control = correlation(&s, SEEDS + i, SEEDS + j);
            squares += control * control;
            if (!(fabs(r) <= fabs(pairs->correlation))) { // NaN too
                pairs->correlation = r;
                pairs->seeds[0] = s.seed[j];
                pairs->seeds[1] = s.seed[i];
            }
        }
    free(s.value);
    pairs->deviation = sqrt(squares / PAIRS);
    // Correlations of independent signals are uncorrelated, but not independent where two share a
    // signal of few large values: they count as a quarter of their number.
    pairs->limit = pairs->deviation * -bl_student_quantile(alpha / PAIRS / 2, PAIRS / 4.0);
    return BL_OK;
}
