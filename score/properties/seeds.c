// SPDX-License-Identifier: MIT
//
// Seeds: every bit of the seed counts, and signals of neighbouring seeds are unrelated.
//
// From each of many seeds s (the first is the signal's own), the changes are each of its 64 bits
// flipped, s+1 and s+2. A change must alter the value at half of the places or more. And the
// changed signal must be unrelated to the original, at the same places and at places one cell away
// along each axis in both directions (a seed that is added to a cell number shifts the noise).
//
// Unrelated seeds may correlate: they share what the place alone decides, such as a mean that
// depends on the phase in the cell, and over the few entries of a table any two do by chance.
// Therefore each pair is compared with a control, a seed drawn at random. With u the value of s at
// a place (standardised, cut off at 3), v and v' those of the changed one and of the control, the
// mean of u (v - v') over the places is symmetric about 0 if the change is as good as a random
// seed. Student's t over the seeds s tests it, for each change and each way to go, and for all
// changes together; all tests of a signal share alpha. If a relation of half the variance, of all
// changes at the same places, could not be told from chance, four and then sixteen times as many
// seeds are taken; if it still could not, nothing is said. Of signals that are slow to make, only a
// few bits of each seed are tried; their correlation is that of all changes.
#include "score/properties/places.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/grid.h"

enum {
    BITS = 64,
    CHANGES = BITS + 2,
    SHIFTS = 1 + 2 * BL_AXES,
    PLACES = 32,      // of one seed, at most
    LEAST_SEEDS = 16, // for a t
    MORE = 2,         // times four seeds, where those are too few
    AT_ONCE = PLACES * SHIFTS
};

#define MOST_TOLD 0.5

typedef struct survey {
    const bl_signal *signal;
    const bl_score_look *look;
    size_t seeds, places, shifts;
    size_t stride; // seed j has the bits flipped for which bit + j is a multiple of it
} survey;

// Of one seed s.
typedef struct batch {
    double product[CHANGES + 1][SHIFTS]; // mean of u (v - v'); the last: of all changes
    double changed[CHANGES];             // share of places where the value differs
    double uv[CHANGES], uu, vv[CHANGES]; // sums at the same places
    int is_missing;                      // a signal could not be made
} batch;

static uint64_t changed_seed(uint64_t seed, size_t change) {
    return change < BITS ? seed ^ UINT64_C(1) << change : seed + (change - BITS + 1);
}

// The first seed for which a change is tried, and the step to the next one.
static size_t first_of(const survey *s, size_t change) {
    return change < BITS ? (s->stride - change % s->stride) % s->stride : 0;
}

static size_t step_of(const survey *s, size_t change) {
    return change < BITS ? s->stride : 1;
}

static int is_tried(const survey *s, size_t change, size_t j) {
    return j % step_of(s, change) == first_of(s, change);
}

// Random places, and the same ones shifted, shift by shift.
static void choose_places(const survey *s, bl_random *random, double column[BL_AXES][AT_ONCE]) {
    double cell = s->look->cell;
    for (size_t a = 0; a < BL_AXES; a++)
        for (size_t i = 0; i < s->places; i++) {
            double x = cell * 16384 * (bl_random_unit(random) - 0.5);
            for (size_t shift = 0; shift < s->shifts; shift++) {
                int is_along = shift && (shift - 1) / 2 == a;
                column[a][shift * s->places + i] = x + (is_along ? shift % 2 ? cell : -cell : 0);
            }
        }
}

static int sample(const survey *s, uint64_t seed, double column[BL_AXES][AT_ONCE],
                  double out[AT_ONCE]) {
    float value[AT_ONCE];
    size_t count = s->places * s->shifts;
    bl_signal *signal = bl_signal_reseed(s->signal, seed);
    if (!signal)
        return 0;
    bl_signal_points(signal, (const double *const[]){column[0], column[1], column[2], column[3]},
                     count, value);
    bl_signal_free(signal);
    for (size_t i = 0; i < count; i++)
        out[i] = ((double)value[i] - s->look->mean) / s->look->deviation;
    return 1;
}

// NaN stays NaN.
static double cut(double x) {
    return x > 3 ? 3 : x < -3 ? -3 : x;
}

static void add_change(const survey *s, size_t change, const double *original,
                       const double *changed, const double *control, batch *b) {
    for (size_t i = 0; i < s->places; i++) {
        b->changed[change] += (changed[i] != original[i]) / (double)s->places;
        b->uv[change] += original[i] * changed[i];
        b->vv[change] += changed[i] * changed[i];
    }
    for (size_t shift = 0; shift < s->shifts; shift++) {
        double sum = 0;
        for (size_t i = 0; i < s->places; i++) {
            size_t k = shift * s->places + i;
            sum += cut(original[i]) * (cut(changed[k]) - cut(control[k])) / (double)s->places;
        }
        b->product[change][shift] = sum;
        b->product[CHANGES][shift] += sum / (double)(BITS / s->stride + CHANGES - BITS);
    }
}

static void take(const survey *s, size_t j, uint64_t seed, bl_random random, batch *b) {
    double column[BL_AXES][AT_ONCE], original[AT_ONCE], changed[AT_ONCE], control[AT_ONCE];
    memset(b, 0, sizeof *b);
    choose_places(s, &random, column);
    b->is_missing =
        !sample(s, seed, column, original) || !sample(s, bl_random_bits(&random), column, control);
    for (size_t i = 0; i < s->places && !b->is_missing; i++)
        b->uu += original[i] * original[i];
    for (size_t change = 0; change < CHANGES && !b->is_missing; change++) {
        if (!is_tried(s, change, j))
            continue;
        b->is_missing = !sample(s, changed_seed(seed, change), column, changed);
        add_change(s, change, original, changed, control, b);
    }
}

// --- the verdict --------------------------------------------------------------------------------

typedef struct totals {
    double largest_t, limit; // the t that is largest against its limit
    bl_estimate correlation; // the largest
    double told;             // what the test of all changes at the same places can tell
    double least_changed;
    size_t worst_change, worst_shift, dead_bits, first_dead;
} totals;

// Of the mean over seeds of the product of all changes at the same places.
static double standard_error(const survey *s, const batch *b) {
    bl_moments moments = {.n = 0};
    for (size_t j = 0; j < s->seeds; j++)
        bl_moments_add(&moments, b[j].product[CHANGES][0]);
    return sqrt(bl_moments_variance(&moments) / moments.n);
}

// The correlation of one change, or of all, at the same places. Its limits are those of the mean of
// the products over seeds, divided by the variance.
static bl_estimate correlation_of(const survey *s, const batch *b, size_t change, double level,
                                  double *room) {
    double power = 0;
    size_t n = 0;
    for (size_t j = first_of(s, change); j < s->seeds; j += step_of(s, change)) {
        double uu = 0, uv = 0, vv = 0;
        for (size_t c = 0; c < CHANGES; c++)
            if (is_tried(s, c, j) && (c == change || change == CHANGES)) {
                uu += b[j].uu;
                uv += b[j].uv[c];
                vv += b[j].vv[c];
            }
        power += (uu + vv) / 2;
        room[n++] = uv;
    }
    bl_estimate e = bl_mean_estimate(room, n, level);
    double scale = (double)n / power;
    e.value *= scale, e.lower *= scale, e.upper *= scale;
    return e;
}

// The largest of all changes of which there are enough, at a level for all of them at once.
static bl_estimate largest_correlation(const survey *s, const batch *b, double level,
                                       double *room) {
    bl_estimate largest = {.value = 0};
    for (size_t change = 0; change <= CHANGES; change++) {
        if (s->seeds / step_of(s, change) < LEAST_SEEDS)
            continue;
        bl_estimate e = correlation_of(s, b, change, 1 - (1 - level) / (CHANGES + 1), room);
        if (!(fabs(e.value) <= fabs(largest.value)))
            largest = e;
    }
    largest.level = level;
    return largest;
}

static totals totals_of(const survey *s, const batch *b, double alpha) {
    totals sum = {.least_changed = 1, .limit = INFINITY};
    for (size_t change = 0; change <= CHANGES; change++) {
        size_t step = step_of(s, change), n = s->seeds / step;
        if (n < LEAST_SEEDS)
            continue;
        double limit = bl_score_t_limit(alpha, (double)((CHANGES + 1) * s->shifts), n);
        for (size_t shift = 0; shift < s->shifts; shift++) {
            double t = bl_score_t(&b[first_of(s, change)].product[change][shift], n,
                                  step * sizeof *b / sizeof(double));
            if (fabs(t) / limit >= fabs(sum.largest_t) / sum.limit || isnan(t)) {
                sum.largest_t = t;
                sum.limit = limit;
                sum.worst_change = change;
                sum.worst_shift = shift;
            }
            if (change == CHANGES && shift == 0)
                sum.told = limit * standard_error(s, b);
        }
    }
    for (size_t change = 0; change < CHANGES; change++) {
        double changed = 0;
        for (size_t j = 0; j < s->seeds; j++)
            if (is_tried(s, change, j))
                changed += b[j].changed[change] * (double)step_of(s, change) / (double)s->seeds;
        sum.least_changed = fmin(sum.least_changed, changed);
        if (changed < 0.5 && change < BITS && sum.dead_bits++ == 0)
            sum.first_dead = change;
    }
    return sum;
}

static void describe(const totals *sum, char *text, size_t size) {
    char shift[32] = "at the same places";
    if (sum->worst_shift)
        snprintf(shift, sizeof shift, "a cell apart along %c", "xyzw"[(sum->worst_shift - 1) / 2]);
    if (sum->worst_change < BITS)
        snprintf(text, size, "seeds that differ in bit %zu, %s,", sum->worst_change, shift);
    else if (sum->worst_change < CHANGES)
        snprintf(text, size, "seeds that differ by %zu, %s,", sum->worst_change - BITS + 1, shift);
    else
        snprintf(text, size, "neighbouring seeds, %s,", shift);
}

static void judge(const survey *s, const batch *b, totals sum, const bl_score_settings *settings,
                  bl_score_property *result) {
    char what[128];
    double *room = malloc(s->seeds * sizeof *room);
    if (!room) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL, "out of memory");
        return;
    }
    sum.correlation = largest_correlation(s, b, settings->level, room);
    free(room);
    describe(&sum, what, sizeof what);
    bl_score_add(result, "largest_correlation", sum.correlation);
    bl_score_add_seen(result, "least_relation_told", sum.told);
    bl_score_add_seen(result, "largest_deviate", sum.largest_t);
    bl_score_add_seen(result, "limit_deviate", sum.limit);
    bl_score_add_seen(result, "dead_bits", (double)sum.dead_bits);
    bl_score_add_seen(result, "least_share_changed", sum.least_changed);
    bl_score_add_exact(result, "seeds", (double)s->seeds);
    snprintf(result->cell, sizeof result->cell, "|r| %.2g", fabs(sum.correlation.value));
    if (sum.dead_bits) {
        snprintf(result->cell, sizeof result->cell, "%u dead", (unsigned)sum.dead_bits);
        bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_IDEAL,
                       "%zu bits of the seed do nothing at most places, the first is bit %zu",
                       sum.dead_bits, sum.first_dead);
    } else if (isnan(sum.largest_t)) {
        bl_score_not_finite(result);
    } else if (fabs(sum.largest_t) > sum.limit) {
        bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_IDEAL,
                       "%s are related: %.1f standard errors", what, sum.largest_t);
    } else if (!(sum.told <= MOST_TOLD)) {
        bl_score_judge(result, BL_VERDICT_INCONCLUSIVE, BL_AGAINST_IDEAL,
                       "all 64 bits count; a relation of neighbouring seeds below %.2g of the "
                       "variance cannot be told from chance over %zu seeds",
                       sum.told, s->seeds);
    } else {
        bl_score_judge(result, BL_VERDICT_PASS, BL_AGAINST_IDEAL,
                       "all 64 bits count, and neighbouring seeds are unrelated: |r| up to %.3f "
                       "over %zu places",
                       fabs(sum.correlation.value), s->seeds * s->places);
    }
}

// Measures and judges; returns 0 out of memory. With `has_more` seeds to come, a test that tells
// too little judges nothing, and *is_coarse is set.
static int run(const survey *s, const bl_score_settings *settings, int has_more, int *is_coarse,
               bl_score_property *result) {
    batch *batches = malloc(s->seeds * sizeof *batches);
    int is_missing = !batches;
    *is_coarse = 0;
    if (batches) {
#pragma omp parallel for num_threads(bl_thread_count(settings->threads)) schedule(dynamic)
        for (size_t j = 0; j < s->seeds; j++) {
            const bl_signal *signal = s->signal;
            bl_random random = bl_score_random(settings, "seeds", j);
            uint64_t seed = bl_random_bits(&random);
            if (j == 0)
                memcpy(&seed, (const char *)signal->parameters + signal->seed_offset, sizeof seed);
            take(s, j, seed, random, &batches[j]);
        }
        for (size_t j = 0; j < s->seeds; j++)
            is_missing |= batches[j].is_missing;
        totals sum = {0};
        if (!is_missing)
            sum = totals_of(s, batches, settings->alpha);
        // Judged by the spread alone, not by the mean: the choice does not favour a verdict.
        *is_coarse = has_more && sum.told > MOST_TOLD;
        if (!is_missing && !*is_coarse)
            judge(s, batches, sum, settings, result);
    }
    free(batches);
    return !is_missing;
}

static bl_status measure(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message) {
    const bl_signal *signal = subject->signal;
    bl_score_look look;
    if (signal->seed_offset == SIZE_MAX ||
        (signal->functions->release && !signal->functions->build)) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL, "the signal has no seed");
        return BL_OK;
    }
    if (!bl_score_look_at(subject, settings, result, &look))
        return BL_OK;
    survey s = {.signal = signal, .look = &look, .shifts = 1 + 2 * look.dimensions};
    s.seeds = (size_t)bl_size_pick(settings->size, 32, 128, 1024);
    s.stride = 1;
    if (signal->functions->build) {
        s.stride = 16;
    }
    s.places = (size_t)bl_size_pick(settings->size, 16, 24, PLACES);
    int is_coarse = 1, is_done = 1;
    for (int more = 0; more <= MORE && is_done && is_coarse; more++, s.seeds *= 4)
        is_done = run(&s, settings, more < MORE, &is_coarse, result);
    return is_done ? BL_OK : bl_score_no_memory(result, message);
}

BL_PROPERTY_DESCRIPTOR(seeds) = {
    .name = "seeds",
    .title = "seeds",
    .entry =
        "|r|, the largest correlation of seeds that differ by a bit or by 1 or 2; dead: bits of "
        "the seed that do nothing",
    .question = "Does every bit of the seed count, and are neighbouring seeds unrelated?",
    .measure = measure,
};
