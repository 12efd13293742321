// SPDX-License-Identifier: MIT
//
// The property `repeatable`: equal questions get equal answers.
//
// An exact test. The same places are asked for again, backwards, in pieces of several sizes, from
// several threads at once, of a second signal of the same seed, and of the loops for every other
// instruction set; every bit must agree. This is done with scattered points and with rows along
// every axis and across them, near the origin and far away. The starts and steps of rows are
// multiples of 2^-10, so that start + i*step is exact and a piece of a row has the places of the
// whole. Special places (special.h) are asked for as points, and rows along the axes and the
// diagonals of the lattice pass through them. A function of the user's own is also asked by more
// threads than there are processors, for a while, so that a race is found (race.h); our own are
// held to be free of them by the tests. One that says that it is not thread-safe, or that answers
// from processes of its own, is called by one thread at a time, and its races are not looked for.
//
// Rows, points and the double reference are three routes to one function: they must agree to
// 32 * 2^-24 * max(1, bound) where the signal states its bound, which is the rounding that float
// loops are allowed; where it states none, to 10^-5 of the range of its values and four roundings
// of the largest one; and the largest difference is reported.
//
// That it is a function of the place is what every signal states (core/signal.h), so the verdict is
// against the claim; and a signal that has no numbers near the origin is none, and fails.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/hash.h"
#include "score/properties/race.h"
#include "score/properties/places.h"
#include "score/properties/sampling.h"
#include "score/properties/special.h"
#include "score/score.h"

enum { MOST = 4096, THREADS = 4, BATCHES = 4, REFERENCES = 128 };
static const size_t batches[BATCHES] = {1, 3, 7, 64};

// What is asked: a row, or a list of points. `at` holds the places of both.
typedef struct question {
    int is_row;
    double start[BL_AXES], step[BL_AXES];
    double (*at)[MOST]; // [BL_AXES]
    size_t count;
} question;

typedef struct trial {
    const bl_score_subject *subject;
    const bl_score_settings *settings;
    bl_signal *twin; // of the same seed; NULL if there is none
    double at[BL_AXES][MOST], backwards[BL_AXES][MOST];
    float answer[MOST], again[MOST], by_thread[THREADS][MOST];
    double row_error, point_error, route_error; // of all questions
    double largest, lower, upper;               // of the values, in size and in sign
    double row_error_at[BL_AXES];
    size_t compared;
    int is_raced;         // races were looked for, or found
    int is_near;          // the questions are near the origin
    char difference[300]; // "" while there is none
    char hole[160];       // the first place near the origin whose value is not finite
} trial;

static void ask(const bl_signal *signal, const question *q, size_t from, size_t count, float *out) {
    double start[BL_AXES];
    const double *at[BL_AXES];
    for (int a = 0; a < BL_AXES; a++) {
        start[a] = q->start[a] + (double)from * q->step[a];
        at[a] = q->at[a] + from;
    }
    if (q->is_row)
        bl_signal_row(signal, start, q->step, count, out);
    else
        bl_signal_points(signal, at, count, out);
}

static int same_bits(float a, float b) {
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

// Holds `got` against the first answer; false at a difference, which is put into words.
static int compare(trial *t, const question *q, const float *got, const char *how) {
    for (size_t i = 0; i < q->count; i++) {
        t->compared++;
        if (same_bits(t->answer[i], got[i]))
            continue;
        const double at[BL_AXES] = {q->at[0][i], q->at[1][i], q->at[2][i], q->at[3][i]};
        snprintf(t->difference, sizeof t->difference, "%s %s: %.9g, then %.9g at %s",
                 q->is_row ? "a row" : "points", how, (double)t->answer[i], (double)got[i],
                 bl_score_place_text(t->subject->signal, at).text);
        return 0;
    }
    return 1;
}

static int compare_backwards(trial *t, const question *q) {
    question turned = *q;
    turned.at = t->backwards;
    for (int a = 0; a < BL_AXES; a++) {
        turned.start[a] = q->start[a] + (double)(q->count - 1) * q->step[a];
        turned.step[a] = -q->step[a];
        for (size_t i = 0; i < q->count; i++)
            t->backwards[a][i] = q->at[a][q->count - 1 - i];
    }
    ask(t->subject->signal, &turned, 0, q->count, t->again);
    for (size_t i = 0; i < q->count / 2; i++) {
        float swap = t->again[i];
        t->again[i] = t->again[q->count - 1 - i];
        t->again[q->count - 1 - i] = swap;
    }
    return compare(t, q, t->again, "asked backwards");
}

static int compare_batches(trial *t, const question *q) {
    char how[40];
    for (int b = 0; b < BATCHES; b++) {
        size_t batch = batches[b];
        for (size_t from = 0; from < q->count; from += batch)
            ask(t->subject->signal, q, from, q->count - from < batch ? q->count - from : batch,
                t->again + from);
        snprintf(how, sizeof how, "in pieces of %zu", batch);
        if (!compare(t, q, t->again, how))
            return 0;
    }
    return 1;
}

static int compare_threads(trial *t, const question *q) {
#pragma omp parallel for num_threads(THREADS) schedule(static, 1)
    for (int k = 0; k < THREADS; k++)
        ask(t->subject->signal, q, 0, q->count, t->by_thread[k]);
    for (int k = 0; k < THREADS; k++)
        if (!compare(t, q, t->by_thread[k], "asked from several threads"))
            return 0;
    return 1;
}

static int compare_variants(trial *t, const question *q) {
    char how[64];
    for (size_t v = 0; v < t->subject->variant_count; v++) {
        ask(t->subject->variants[v], q, 0, q->count, t->again);
        snprintf(how, sizeof how, "by instruction set %s", t->subject->variant_names[v]);
        if (!compare(t, q, t->again, how))
            return 0;
    }
    return 1;
}

static double difference_of(double a, double b) {
    return isnan(a) && isnan(b) ? 0 : isnan(a) || isnan(b) ? INFINITY : fabs(a - b);
}

// How far the answers are from the reference, and a row from the same places as points.
static void find_errors(trial *t, const question *q) {
    double *error = q->is_row ? &t->row_error : &t->point_error;
    question points = *q;
    points.is_row = 0;
    ask(t->subject->signal, &points, 0, q->count, t->again);
    for (size_t i = 0; i < q->count; i++) {
        const double at[BL_AXES] = {q->at[0][i], q->at[1][i], q->at[2][i], q->at[3][i]};
        double own = t->answer[i], route = difference_of(own, t->again[i]);
        if (isfinite(own)) {
            t->largest = fmax(t->largest, fabs(own));
            t->lower = fmin(t->lower, own);
            t->upper = fmax(t->upper, own);
        } else if (t->is_near && !t->hole[0]) {
            snprintf(t->hole, sizeof t->hole, "%s",
                     bl_score_place_text(t->subject->signal, at).text);
        }
        if (i < REFERENCES)
            *error = fmax(*error, difference_of(own, bl_signal_value(t->subject->signal, at)));
        if (route > t->route_error)
            memcpy(t->row_error_at, at, sizeof at);
        t->route_error = fmax(t->route_error, route);
    }
}

// All ways to ask one question; false at the first difference.
static int try_question(trial *t, const question *q) {
    ask(t->subject->signal, q, 0, q->count, t->answer);
    ask(t->subject->signal, q, 0, q->count, t->again);
    if (!compare(t, q, t->again, "asked twice") || !compare_backwards(t, q) ||
        !compare_batches(t, q) || !compare_threads(t, q) || !compare_variants(t, q))
        return 0;
    if (t->twin) {
        ask(t->twin, q, 0, q->count, t->again);
        if (!compare(t, q, t->again, "of a second signal of the same seed"))
            return 0;
    }
    find_errors(t, q);
    return 1;
}

// --- the questions ---

// Random places around `base`; the first are lattice points and middles of cells.
static int try_points(trial *t, double base, size_t count, bl_random *random) {
    const bl_signal *signal = t->subject->signal;
    question q = {.at = t->at, .count = count};
    for (size_t i = 0; i < count; i++) {
        double at[BL_AXES];
        bl_score_place(signal, 512, random, at);
        for (int a = 0; a < BL_AXES; a++) {
            if (!bl_score_on_grid(signal) && i < 16)
                at[a] = floor(at[a]) + (i % 2 ? 0.5 : 0);
            t->at[a][i] = base + at[a];
        }
    }
    return try_question(t, &q);
}

static int try_row(trial *t, const double start[BL_AXES], const double step[BL_AXES],
                   size_t count) {
    question q = {.is_row = 1, .at = t->at, .count = count};
    for (int a = 0; a < BL_AXES; a++) {
        q.start[a] = start[a];
        q.step[a] = step[a];
        for (size_t i = 0; i < count; i++)
            t->at[a][i] = start[a] + (double)i * step[a];
    }
    return try_question(t, &q);
}

// Rows along every axis, and two across: one finer and one coarser than a cell.
static int try_rows(trial *t, double base, size_t count, bl_random *random) {
    static const double across[2][BL_AXES] = {{5 * 0x1p-6, -3 * 0x1p-6, 7 * 0x1p-6, 0x1p-6},
                                              {2.125, 1.0625, -3.5, 0.75}};
    const bl_signal *signal = t->subject->signal;
    for (unsigned k = 0; k < signal->dimensions + 2 && k < BL_AXES + 2; k++) {
        double start[BL_AXES], step[BL_AXES] = {0};
        for (int a = 0; a < BL_AXES; a++)
            start[a] = base + floor(0x1p20 * (bl_random_unit(random) - 0.5)) * 0x1p-10;
        if (k < signal->dimensions)
            step[k] = 3 * 0x1p-6;
        else
            memcpy(step, across[k - signal->dimensions], sizeof step);
        if (!try_row(t, start, step, count))
            return 0;
    }
    return 1;
}

// Points where functions break ties.
static int try_special(trial *t, double cell) {
    bl_special special;
    bl_random random = bl_score_random(t->settings, "repeatable", 0);
    bl_special_fill(&special, t->subject->signal->dimensions, cell, &random);
    for (int a = 0; a < BL_AXES; a++)
        memcpy(t->at[a], special.at[a], special.count * sizeof special.at[a][0]);
    return try_question(t, &(question){.at = t->at, .count = special.count});
}

// Rows in each direction of three steps an axis, -1, 0 or 1 of 1/16 cell, from a lattice point, and
// again with random fractions on the axes that stand. They cross the origin or pass near it. The
// cell is rounded to ten digits of base two, so that start + i*step is exact.
static int try_diagonals(trial *t, double cell, bl_random *random) {
    enum { COUNT = 128 };
    const unsigned axes = t->subject->signal->dimensions;
    unsigned directions = 1;
    int exponent;
    double mantissa = frexp(cell, &exponent);
    cell = ldexp(rint(0x1p10 * mantissa), exponent - 10);
    for (unsigned a = 0; a < axes && a < BL_AXES; a++)
        directions *= 3;
    // The other half are the same, turned.
    for (unsigned k = 2 * (directions / 2 + 1); k < 2 * directions; k++) {
        double start[BL_AXES] = {0}, step[BL_AXES] = {0};
        unsigned digits = k / 2;
        for (unsigned a = 0; a < axes && a < BL_AXES; a++, digits /= 3) {
            double whole = floor(8 * bl_random_unit(random)) - 4;
            double fraction = floor(0x1p10 * bl_random_unit(random)) * 0x1p-10;
            step[a] = cell * 0x1p-4 * ((double)(digits % 3) - 1);
            start[a] =
                step[a] != 0 ? -COUNT / 2 * step[a] : cell * (whole + (k % 2 ? fraction : 0));
        }
        if (!try_row(t, start, step, COUNT))
            return 0;
    }
    return 1;
}

// Rows of a grid: whole lines of its samples.
static int try_grid_rows(trial *t, size_t count, bl_random *random) {
    const bl_extent *extent = &t->subject->signal->extent;
    for (int a = 0; a < BL_AXES; a++) {
        double start[BL_AXES], step[BL_AXES] = {0};
        if (extent->size[a] < 2)
            continue;
        bl_score_place(t->subject->signal, 0, random, start);
        start[a] = 0;
        step[a] = extent->spacing[a];
        if (!try_row(t, start, step, extent->size[a] < count ? extent->size[a] : count))
            return 0;
    }
    return 1;
}

// The scales of the coordinates; how many were tried.
static size_t try_scales(trial *t) {
    static const double bases[] = {0, 1000, -1e6, 1e9};
    const bl_signal *signal = t->subject->signal;
    size_t count = (size_t)bl_size_pick(t->settings->size, 512, 1024, MOST), scales = 0;
    // Where a signal does not say how far it reaches, a float of its own reaches that far.
    double far = isfinite(signal->facts.far) ? signal->facts.far / 1024 : 1e6;
    bl_random random = bl_random_seed(t->settings->seed, 0);
    const double cell = bl_score_cell(signal);
    t->is_near = 1;
    if (!bl_score_on_grid(signal) && try_special(t, cell)) {
        bl_random own = bl_score_random(t->settings, "repeatable", 1);
        try_diagonals(t, cell, &own);
    }
    for (size_t s = 0; s < sizeof bases / sizeof *bases && !t->difference[0]; s++) {
        if (s > 0 && (bl_score_on_grid(signal) || fabs(bases[s]) > far))
            continue;
        scales++;
        t->is_near = s == 0;
        if (try_points(t, bases[s], count, &random)) {
            if (bl_score_on_grid(signal))
                try_grid_rows(t, count, &random);
            else
                try_rows(t, bases[s], count / 2, &random);
        }
    }
    return scales;
}

// Before anything else is asked, so that threads meet in what a function makes at its first call.
static void look_for_race(trial *t, bl_race *race) {
    const bl_signal *signal = t->subject->signal;
    double seconds = bl_size_pick(t->settings->size, 2, 4, 10) * 0.1;
    race->is_found = 0;
    t->is_raced = !signal->definition && !signal->is_serial && !bl_score_on_grid(signal) &&
                  bl_race_find(signal, t->settings->seed, seconds, race);
}

static void tell_race(trial *t, const bl_race *race) {
    snprintf(t->difference, sizeof t->difference,
             "%s asked for while other threads ask (a race): %.9g alone, %.9g then at %s",
             race->what, race->alone, race->together,
             bl_score_place_text(t->subject->signal, race->at).text);
}

// What was done with several threads, for the sentence of a signal that passes.
static const char *thread_text(const trial *t) {
    return t->is_raced                     ? ", from more threads than processors"
           : t->subject->signal->is_serial ? ", one call at a time as it asks,"
                                           : ", from several threads";
}

static void judge(trial *t, size_t scales, bl_score_property *result) {
    const bl_score_subject *subject = t->subject;
    double bound = bl_score_bound(subject->signal);
    double allowed = isfinite(bound)
                         ? 32 * 0x1p-24 * fmax(1, bound)
                         : 1e-5 * fmax(0, t->upper - t->lower) + 4 * 0x1p-24 * t->largest;
    double worst = fmax(t->route_error, fmax(t->row_error, t->point_error));
    bl_score_add_exact(result, "comparisons", (double)t->compared);
    bl_score_add_exact(result, "scales", (double)scales);
    bl_score_add_exact(result, "instruction_sets", (double)subject->variant_count + 1);
    if (t->difference[0]) {
        snprintf(result->cell, sizeof result->cell, "differs");
        bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_CLAIM, "%s", t->difference);
        return;
    }
    if (t->hole[0]) {
        snprintf(result->cell, sizeof result->cell, "no number");
        bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_CLAIM,
                       "it is no signal: the value at %s is not finite", t->hole);
        return;
    }
    bl_score_add_seen(result, "error_of_rows", t->row_error);
    bl_score_add_seen(result, "error_of_points", t->point_error);
    bl_score_add_seen(result, "rows_against_points", t->route_error);
    bl_score_add_exact(result, "error_allowed", allowed);
    snprintf(result->cell, sizeof result->cell, worst > 0 ? "%.0e" : "%g", worst);
    if (worst > allowed && t->route_error > allowed)
        bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_CLAIM,
                       "a row and the same places as points differ by %.3g at %s; %.3g is allowed",
                       t->route_error, bl_score_place_text(subject->signal, t->row_error_at).text,
                       allowed);
    else if (worst > allowed)
        bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_CLAIM,
                       "rows differ from the double reference by %.3g, points by %.3g; %.3g is "
                       "allowed",
                       t->row_error, t->point_error, allowed);
    else
        bl_score_judge(result, BL_VERDICT_PASS, BL_AGAINST_CLAIM,
                       "the same bits twice, backwards, in pieces%s and by %zu "
                       "instruction set%s, at %zu scale%s of coordinates; rows and points are "
                       "within %.2g of the double reference",
                       thread_text(t), subject->variant_count + 1,
                       subject->variant_count ? "s" : "", scales, scales == 1 ? "" : "s", worst);
}

static bl_status measure(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message) {
    const bl_signal *signal = subject->signal;
    trial *t = calloc(1, sizeof *t);
    if (!t)
        return bl_report(message, BL_DEVICE, "out of memory");
    t->subject = subject;
    t->settings = settings;
    t->lower = INFINITY;
    t->upper = -INFINITY;
    t->twin = bl_signal_reseed(signal, bl_signal_seed(signal));
    bl_race race;
    look_for_race(t, &race);
    size_t scales = try_scales(t);
    if (race.is_found && !t->difference[0]) // of two faults the one that a single thread shows
        tell_race(t, &race);
    judge(t, scales, result);
    bl_signal_free(t->twin);
    free(t);
    return BL_OK;
}

BL_PROPERTY_DESCRIPTOR(repeatable) = {
    .name = "repeatable",
    .title = "repeatable",
    .paper = "peachey2003, p. 68",
    .entry = "the largest difference of rows and points from the double reference",
    .question = "Does it give the same value for the same place, however it is asked?",
    .measure = measure,
};
