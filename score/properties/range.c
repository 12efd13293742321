// SPDX-License-Identifier: MIT
//
// The property `range`: where the values lie, how much of the bound they use, their mean and their
// variance.
//
// Samples come in blocks of random places, uniform in +-2^20 on every axis, each block with a fresh
// seed where the signal has one. The extremes are then followed uphill: from the best place of each
// of the best blocks, a coordinate search in double on the reference, whose step is halved where no
// neighbour is better. What it finds is a value that the signal takes, so a bound below it is
// refuted; a bound above it is not proved. A grid gives all its samples and is not climbed.
//
// Special places (special.h) and powers of two far out (overflow.h), up to the stated reach or to
// 2^53, are looked at on purpose, by points and by the reference; they count where they leave the
// range or are no number.
//
// The blocks are independent, and the mean of a block and its mean square about the stated mean are
// sums of many terms, so their averages have Student intervals. A stated mean or variance fails
// where it lies outside of the interval at the property's share of alpha, half of it each. It is
// inconclusive where the interval shown is wider than a quarter of the standard deviation or of the
// variance each way: agreement would say nothing.
//
// Without a stated bound the ideal asks for [-1, 1]. That it has values is what every signal
// claims, so that one that is not finite fails against the claim.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/grid.h"
#include "core/hash.h"
#include "score/properties/overflow.h"
#include "score/properties/places.h"
#include "score/properties/sampling.h"
#include "score/properties/special.h"
#include "score/score.h"
#include "spectra/histogram.h"

enum { CLIMBS = 8, MOST_STEPS = 400 };

static const double REACH = 0x1p20;
static const double LEAST_STEP = 0x1p-13; // of a cell: a smooth peak is met to its square
static const double COARSEST = 0.25;      // of an interval that still says something

// A place where the signal that draws from `seed` was seen to have this value.
typedef struct extreme {
    double value, at[BL_AXES];
    uint64_t seed;
} extreme;

typedef struct block {
    double mean, square; // of the values, and of their distance from the stated mean
    extreme low, high;
    int broken; // a value was not finite, and stands in `low`
} block;

// What is found, whether in blocks or on a grid.
typedef struct findings {
    double samples;
    extreme low, high, sampled_low, sampled_high;
    int has_seed; // the extremes' seeds count
    int broken;
    bl_estimate mean, variance;           // at the level that is shown
    bl_estimate mean_test, variance_test; // at the level of the test
} findings;

// --- blocks ---

// Below 2^53, so that a double of the report holds it.
static uint64_t seed_of_block(const bl_score_settings *settings, size_t index) {
    return bl_stream(settings->seed, 2 * (uint64_t)index + 1) >> 11;
}

static int fill_block(const bl_signal *signal, const bl_score_settings *settings, size_t index,
                      size_t count, block *out) {
    double *room = malloc(count * (BL_AXES * sizeof(double) + sizeof(float)));
    if (!room)
        return 0;
    float *values = (float *)(room + BL_AXES * count);
    const double *at[BL_AXES] = {room, room + count, room + 2 * count, room + 3 * count};
    bl_random random = bl_random_seed(settings->seed, 2 * (uint64_t)index);
    for (size_t i = 0; i < count; i++) {
        double place[BL_AXES];
        bl_score_place(signal, REACH, &random, place);
        for (int a = 0; a < BL_AXES; a++)
            room[(size_t)a * count + i] = place[a];
    }
    uint64_t seed = seed_of_block(settings, index);
    bl_signal *fresh = bl_signal_reseed(signal, seed);
    bl_signal_points(fresh ? fresh : signal, at, count, values);
    bl_signal_free(fresh);
    double pivot = isfinite(signal->facts.mean) ? signal->facts.mean : 0, sum = 0, square = 0;
    size_t low = 0, high = 0;
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(values[i])) {
            out->broken = 1;
            low = high = i;
            break;
        }
        sum += (double)values[i] - pivot;
        square += ((double)values[i] - pivot) * ((double)values[i] - pivot);
        low = values[i] < values[low] ? i : low;
        high = values[i] > values[high] ? i : high;
    }
    out->mean = pivot + sum / (double)count;
    out->square = square / (double)count;
    out->low = (extreme){.value = (double)values[low], .seed = seed};
    out->high = (extreme){.value = (double)values[high], .seed = seed};
    for (int a = 0; a < BL_AXES; a++) {
        out->low.at[a] = at[a][low];
        out->high.at[a] = at[a][high];
    }
    free(room);
    return 1;
}

// --- uphill ---

// Follows the reference up (sign 1) or down (-1).
static void climb(const bl_signal *signal, double sign, extreme *best) {
    bl_signal *fresh = bl_signal_reseed(signal, best->seed);
    const bl_signal *here = fresh ? fresh : signal;
    double cell = bl_score_cell(signal), step = 0.25 * cell;
    double value = bl_signal_value(here, best->at);
    int steps = 0;
    if (isfinite(value))
        best->value = value;
    while (step >= LEAST_STEP * cell && steps < MOST_STEPS) {
        int better = 0;
        for (unsigned a = 0; a < signal->dimensions && a < BL_AXES; a++)
            for (int way = -1; way <= 1; way += 2) {
                double before = best->at[a];
                best->at[a] = before + way * step;
                value = bl_signal_value(here, best->at);
                steps++;
                if (sign * value > sign * best->value && isfinite(value)) {
                    best->value = value;
                    better = 1;
                } else {
                    best->at[a] = before;
                }
            }
        step *= better ? 1 : 0.5;
    }
    bl_signal_free(fresh);
}

// Blocks of equal extremes stand in the order of their seeds, so that there is one order only.
static int order(double x, double y, const block *a, const block *b) {
    return x != y ? (x > y) - (x < y) : (a->low.seed > b->low.seed) - (a->low.seed < b->low.seed);
}

static int by_low(const void *a, const void *b) {
    const block *x = a, *y = b;
    return order(x->low.value, y->low.value, x, y);
}

static int by_high(const void *a, const void *b) {
    const block *x = a, *y = b;
    return order(-x->high.value, -y->high.value, x, y);
}

static void find_extremes(const bl_signal *signal, int threads, block *blocks, size_t count,
                          findings *found) {
    extreme starts[2 * CLIMBS];
    size_t climbs = count < CLIMBS ? count : CLIMBS;
    qsort(blocks, count, sizeof *blocks, by_low);
    for (size_t i = 0; i < climbs; i++)
        starts[i] = blocks[i].low;
    qsort(blocks, count, sizeof *blocks, by_high);
    for (size_t i = 0; i < climbs; i++)
        starts[climbs + i] = blocks[i].high;
    found->sampled_low = found->low = starts[0];
    found->sampled_high = found->high = starts[climbs];
#pragma omp parallel for num_threads(bl_thread_count(threads)) schedule(dynamic, 1)
    for (size_t i = 0; i < 2 * climbs; i++)
        climb(signal, i < climbs ? -1 : 1, &starts[i]);
    for (size_t i = 0; i < climbs; i++) {
        if (starts[i].value < found->low.value)
            found->low = starts[i];
        if (starts[climbs + i].value > found->high.value)
            found->high = starts[climbs + i];
    }
}

static void estimate_moments(const bl_signal *signal, const bl_score_settings *settings,
                             const block *blocks, double *values, size_t count, findings *found) {
    double missed = 0.5 * settings->alpha;
    for (size_t i = 0; i < count; i++)
        values[i] = blocks[i].mean;
    found->mean = bl_mean_estimate(values, count, settings->level);
    found->mean_test = bl_mean_estimate_missing(values, count, missed);
    // The mean square stands about the stated mean, or about 0.
    double shift = isfinite(signal->facts.mean) ? 0 : found->mean.value;
    for (size_t i = 0; i < count; i++)
        values[i] = blocks[i].square - shift * (2 * blocks[i].mean - shift);
    found->variance = bl_mean_estimate(values, count, settings->level);
    found->variance_test = bl_mean_estimate_missing(values, count, missed);
}

static bl_status look_in_blocks(const bl_signal *signal, const bl_score_settings *settings,
                                findings *found, bl_message *message) {
    // Quick has as many seeds as normal: those of a sum of few waves differ most by their variance.
    size_t count = (size_t)bl_size_pick(settings->size, 256, 256, 1024);
    size_t each = (size_t)bl_size_pick(settings->size, 256, 4096, 16384);
    block *blocks = calloc(count, sizeof *blocks);
    double *values = calloc(count, sizeof *values);
    int failed = !blocks || !values;
#pragma omp parallel for num_threads(bl_thread_count(settings->threads)) schedule(dynamic, 1)      \
    reduction(|                                                                                    \
              : failed)
    for (size_t i = 0; i < count; i++)
        if (blocks && values && !fill_block(signal, settings, i, each, &blocks[i]))
            failed = 1;
    for (size_t i = 0; !failed && i < count && !found->broken; i++) {
        found->broken = blocks[i].broken;
        found->low = blocks[i].low;
    }
    if (!failed && !found->broken) {
        found->samples = (double)count * (double)each;
        bl_signal *fresh = bl_signal_reseed(signal, seed_of_block(settings, 0));
        found->has_seed = fresh != NULL;
        bl_signal_free(fresh);
        estimate_moments(signal, settings, blocks, values, count, found);
        find_extremes(signal, settings->threads, blocks, count, found);
    }
    free(blocks);
    free(values);
    return failed ? bl_report(message, BL_DEVICE, "out of memory") : BL_OK;
}

// --- grids ---

static bl_status look_on_grid(const bl_signal *signal, const bl_score_settings *settings,
                              findings *found, bl_message *message) {
    bl_histogram_settings wanted = bl_histogram_default_settings();
    bl_histogram histogram;
    wanted.threads = settings->threads;
    wanted.seed = settings->seed;
    for (int test = 0; test < 2; test++) { // the limits at the level shown, and at the test's
        wanted.level = settings->level;
        wanted.missed = test ? 0.5 * settings->alpha : 0;
        bl_status status = bl_histogram_measure(signal, &wanted, &histogram, message);
        if (status != BL_OK)
            return status;
        *(test ? &found->mean_test : &found->mean) = histogram.mean;
        *(test ? &found->variance_test : &found->variance) = histogram.variance;
        found->samples = (double)histogram.count;
        found->low.value = histogram.minimum;
        found->high.value = histogram.maximum;
        for (int a = 0; a < BL_AXES; a++) {
            found->low.at[a] = histogram.minimum_at[a];
            found->high.at[a] = histogram.maximum_at[a];
        }
        bl_histogram_free(&histogram);
    }
    found->sampled_low = found->low;
    found->sampled_high = found->high;
    return BL_OK;
}

// --- special places ---

static int exceeds(const findings *found, double lower, double upper) {
    double rounding = 32 * 0x1p-24 * fmax(1, fmax(fabs(lower), fabs(upper)));
    return found->low.value < lower - rounding || found->high.value > upper + rounding;
}

// A value on purpose: it counts where it is no number, or breaks a range that held so far.
static void meet(findings *found, const bl_signal *signal, double value, const double at[BL_AXES],
                 uint64_t seed) {
    int is_stated = isfinite(bl_score_bound(signal));
    double lower = is_stated ? signal->facts.lower : -1,
           upper = is_stated ? signal->facts.upper : 1;
    extreme here = {.value = value, .seed = seed};
    findings with = *found;
    memcpy(here.at, at, sizeof here.at);
    with.low = value < found->low.value ? here : found->low;
    with.high = value > found->high.value ? here : found->high;
    if (found->broken)
        return;
    if (!isfinite(value)) {
        found->broken = 1;
        found->low = here;
    } else if (exceeds(&with, lower, upper)) {
        *found = with;
    }
}

static void meet_special(findings *found, const bl_signal *signal, double cell, uint64_t seed,
                         bl_random random) {
    enum { CHUNK = BL_SPECIAL_MOST };
    bl_special special;
    float points[CHUNK];
    double values[CHUNK];
    bl_score_fresh fresh = bl_score_fresh_open(signal, seed);
    bl_special_fill(&special, signal->dimensions, cell, &random);
    bl_signal_points(fresh.signal, BL_COLUMNS(special.at), special.count, points);
    bl_signal_values(fresh.signal, BL_COLUMNS(special.at), special.count, values);
    bl_score_fresh_close(&fresh);
    for (size_t i = 0; i < special.count; i++) {
        const double at[BL_AXES] = {special.at[0][i], special.at[1][i], special.at[2][i],
                                    special.at[3][i]};
        meet(found, signal, (double)points[i], at, seed);
        meet(found, signal, values[i], at, seed);
    }
}

static void meet_far(findings *found, const bl_signal *signal, const bl_score_settings *settings) {
    bl_overflow_place broken[BL_OVERFLOW_KINDS];
    bl_overflow_find(signal, settings, broken);
    for (int kind = BL_OVERFLOW_RANGE; kind <= BL_OVERFLOW_NAN; kind++)
        if (broken[kind].from <= bl_overflow_domain(signal, BL_OVERFLOW_LAST))
            meet(found, signal, broken[kind].value, broken[kind].at, bl_signal_seed(signal));
}

static void look_on_purpose(const bl_signal *signal, const bl_score_settings *settings,
                            findings *found) {
    enum { SEEDS = 3 };
    double cell = bl_score_cell(signal);
    for (uint64_t s = 0; s < SEEDS; s++) {
        uint64_t seed = s ? seed_of_block(settings, (size_t)s) : bl_signal_seed(signal);
        meet_special(found, signal, cell, seed, bl_score_random(settings, "range", s));
        if (cell != 1)
            meet_special(found, signal, 1, seed, bl_score_random(settings, "range", SEEDS + s));
    }
    meet_far(found, signal, settings);
}

// --- numbers ---

static void add_place(bl_score_property *result, const bl_signal *signal, const findings *found,
                      int high) {
    static const char *const names[2][BL_AXES] = {
        {"minimum_x", "minimum_y", "minimum_z", "minimum_w"},
        {"maximum_x", "maximum_y", "maximum_z", "maximum_w"}};
    static const char *const phases[2][BL_AXES] = {
        {"minimum_phase_x", "minimum_phase_y", "minimum_phase_z", "minimum_phase_w"},
        {"maximum_phase_x", "maximum_phase_y", "maximum_phase_z", "maximum_phase_w"}};
    const extreme *e = high ? &found->high : &found->low;
    double cell = signal->facts.cell;
    for (unsigned a = 0; a < signal->dimensions && a < BL_AXES; a++) {
        bl_score_add_exact(result, names[high][a], e->at[a]);
        if (cell > 0)
            bl_score_add_exact(result, phases[high][a], e->at[a] / cell - floor(e->at[a] / cell));
    }
    if (found->has_seed)
        bl_score_add_exact(result, high ? "maximum_seed" : "minimum_seed", (double)e->seed);
}

static void add_numbers(bl_score_property *result, const bl_signal *signal, const findings *found) {
    const bl_facts *facts = &signal->facts;
    bl_score_add_seen(result, "minimum", found->low.value);
    bl_score_add_seen(result, "maximum", found->high.value);
    bl_score_add_seen(result, "minimum_of_samples", found->sampled_low.value);
    bl_score_add_seen(result, "maximum_of_samples", found->sampled_high.value);
    bl_score_add_exact(result, "samples", found->samples);
    if (isfinite(bl_score_bound(signal))) {
        bl_score_add_exact(result, "bound_lower", facts->lower);
        bl_score_add_exact(result, "bound_upper", facts->upper);
        bl_score_add_seen(result, "used_of_bound",
                          (found->high.value - found->low.value) / (facts->upper - facts->lower));
    }
    bl_score_add(result, "mean", found->mean);
    bl_score_add(result, "variance", found->variance);
    if (isfinite(facts->mean))
        bl_score_add_exact(result, "mean_stated", facts->mean);
    if (isfinite(facts->variance))
        bl_score_add_exact(result, "variance_stated", facts->variance);
    add_place(result, signal, found, 0);
    add_place(result, signal, found, 1);
}

// --- verdicts ---

static void judge_bound(bl_score_property *result, const bl_signal *signal, const findings *found) {
    double lower = signal->facts.lower, upper = signal->facts.upper;
    int low = found->low.value - lower < upper - found->high.value; // the side that is worse
    const extreme *worst = low ? &found->low : &found->high;
    if (exceeds(found, lower, upper)) {
        char seed[40] = "";
        if (found->has_seed)
            snprintf(seed, sizeof seed, " with seed %llu", (unsigned long long)worst->seed);
        bl_score_add_claim(result, "range", BL_VERDICT_FAIL,
                           "%.9g at %s%s lies outside of the stated range [%.9g, %.9g]",
                           worst->value, bl_score_place_text(signal, worst->at).text, seed, lower,
                           upper);
    } else {
        bl_score_add_claim(result, "range", BL_VERDICT_PASS,
                           "found %.6g to %.6g, which is %.0f %% of the stated range [%.6g, %.6g]",
                           found->low.value, found->high.value,
                           100 * (found->high.value - found->low.value) / (upper - lower), lower,
                           upper);
    }
}

// A stated number against the interval at the test's level; `scale` says what is precise enough.
// It misses a correct number with the probability `missed`.
static void judge_number(bl_score_property *result, const char *name, double stated,
                         const bl_estimate *shown, const bl_estimate *test, double missed,
                         double scale) {
    double half = 0.5 * (shown->upper - shown->lower);
    // Samples are floats, each off by 2^-24 of its size; those of a pulse are all as far from the
    // mean, so that the interval is a point.
    double rounding = 0x1p-23 * fmax(fabs(stated), scale);
    if (!(stated >= test->lower - rounding && stated <= test->upper + rounding))
        bl_score_add_claim(result, name, BL_VERDICT_FAIL,
                           "%s %.6g is not the stated %.6g (%.6g to %.6g at the level 1 - %.2g)",
                           name, shown->value, stated, test->lower, test->upper, missed);
    else if (!(half <= COARSEST * scale))
        bl_score_add_claim(result, name, BL_VERDICT_INCONCLUSIVE,
                           "%s %.6g +- %.2g is too coarse to judge the stated %.6g by", name,
                           shown->value, half, stated);
    else
        bl_score_add_claim(result, name, BL_VERDICT_PASS,
                           "%s %.6g +- %.2g agrees with the stated %.6g", name, shown->value, half,
                           stated);
}

// All claims, or the ideal where nothing is stated.
static void judge(bl_score_property *result, const bl_signal *signal, const findings *found,
                  double missed) {
    const bl_facts *facts = &signal->facts;
    double size = fmax(fabs(found->low.value), fabs(found->high.value));
    int bounded = isfinite(bl_score_bound(signal));
    double used = (found->high.value - found->low.value) / (facts->upper - facts->lower);
    snprintf(result->cell, sizeof result->cell, "%.2f", bounded ? used : size);
    if (bounded)
        judge_bound(result, signal, found);
    if (isfinite(facts->mean))
        judge_number(result, "mean", facts->mean, &found->mean, &found->mean_test, missed,
                     sqrt(found->variance.value));
    if (isfinite(facts->variance))
        judge_number(result, "variance", facts->variance, &found->variance, &found->variance_test,
                     missed, found->variance.value);
    const bl_score_claim *worst = NULL;
    for (size_t i = 0; i < result->claim_count; i++)
        if (!worst || bl_verdict_worse(result->claims[i].verdict, worst->verdict) != worst->verdict)
            worst = &result->claims[i];
    if (worst)
        bl_score_judge(result, worst->verdict, BL_AGAINST_CLAIM, "%s", worst->reason);
    else
        bl_score_judge(result, exceeds(found, -1, 1) ? BL_VERDICT_FAIL : BL_VERDICT_PASS,
                       BL_AGAINST_IDEAL,
                       "no range is stated; values from %.6g to %.6g against the ideal [-1, 1]",
                       found->low.value, found->high.value);
}

static bl_status measure(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message) {
    const bl_signal *signal = subject->signal;
    findings found = {0};
    bl_message own = {""};
    bl_status status = bl_score_on_grid(signal) ? look_on_grid(signal, settings, &found, &own)
                                                : look_in_blocks(signal, settings, &found, &own);
    if (status == BL_DEVICE)
        return bl_report(message, status, "%s", own.text);
    if (status == BL_OK && !found.broken && !bl_score_on_grid(signal))
        look_on_purpose(signal, settings, &found);
    if (status != BL_OK) // of a grid: what is not finite, with its place
        bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_CLAIM, "%s", own.text);
    else if (found.broken)
        bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_CLAIM, "the value at %s is not finite",
                       bl_score_place_text(signal, found.low.at).text);
    if (status != BL_OK || found.broken)
        return BL_OK;
    add_numbers(result, signal, &found);
    judge(result, signal, &found, 0.5 * settings->alpha);
    return BL_OK;
}

BL_PROPERTY_DESCRIPTOR(range) = {
    .name = "range",
    .title = "range",
    .paper = "peachey2003, p. 68",
    .entry = "the share of the stated range that was found; without one the largest size",
    .question = "Is the range known, and do values, mean and variance keep to what is stated?",
    .measure = measure,
};
