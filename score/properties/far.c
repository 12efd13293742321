// SPDX-License-Identifier: MIT
//
// Far out: how good the noise still is at large coordinates.
//
// In one cell at each power of ten from 10^3 to 10^15 (and at 2^31 and 2^53) along each axis, 256
// places are sampled, in three cells some way apart, of which the best counts: one of a sparse
// noise may be empty. Of the coordinates two roundings apart or more (one that is scaled may lose a
// bit), how many give different numbers, where one pair may be equal by symmetry, and how many did
// in the best of the cells near 0? Float points are compared with the reference at the same
// coordinates. And the variance over fresh seeds and places near 10^6 is compared with that near 0.
// NaN and infinite coordinates must give NaN.
//
// Cells that overflow and floats that end break a noise at powers of two: the first coordinate
// where the range breaks, where there is no number and where neighbours jump is told (overflow.h).
// What lies within facts.far fails the claim; where nothing is stated, within 2^32 it fails the
// ideal.
//
// Judged against facts.far, where it is stated: values stay distinct, by nine tenths of what they
// are near 0, in every cell up to a quarter of it. Else against the ideal: by one half up to 10^6.
// A value that is not a number is none of the distinct ones, so the reach ends where they end.
// A function of the registries that neither repeats nor has a seed is judged only against
// facts.far. In both cases the variance near 10^6 must be within 20 % of that near 0; its test,
// Student's t over batches of a fresh seed each, has the whole alpha.
#include "score/properties/places.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/grid.h"
#include "core/statistics.h"
#include "score/properties/overflow.h"
#include "score/properties/sampling.h"

enum {
    PLACES = 256,
    NEAR = 8,
    CELLS = 3,
    MOST_CELLS = 48,
    FIRST = 3,
    LAST = 15,
    SCALES = LAST - FIRST + 1,
    EACH = 64
};
#define FAR_PLACE 1e6

static const char *const share_names[SCALES + 2] = {
    "distinct_at_1e3",  "distinct_at_1e4",  "distinct_at_1e5",  "distinct_at_1e6",
    "distinct_at_1e7",  "distinct_at_1e8",  "distinct_at_1e9",  "distinct_at_1e10",
    "distinct_at_1e11", "distinct_at_1e12", "distinct_at_1e13", "distinct_at_1e14",
    "distinct_at_1e15", "distinct_at_2e31", "distinct_at_2e53"};
static const char *const error_names[SCALES + 2] = {
    "error_at_1e3",  "error_at_1e4",  "error_at_1e5",  "error_at_1e6",  "error_at_1e7",
    "error_at_1e8",  "error_at_1e9",  "error_at_1e10", "error_at_1e11", "error_at_1e12",
    "error_at_1e13", "error_at_1e14", "error_at_1e15", "error_at_2e31", "error_at_2e53"};

// Of one cell: the share of distinct values, of the reference or of points, the smaller one, and
// the largest difference of the two.
typedef struct view {
    double share, error;
    int is_finite;
} view;

static size_t count_distinct(const double *values, size_t count) {
    double sorted[PLACES];
    size_t finite = 0;
    for (size_t i = 0; i < count; i++)
        if (isfinite(values[i]))
            sorted[finite++] = values[i];
    size_t distinct = finite > 0;
    qsort(sorted, finite, sizeof *sorted, bl_ascending);
    for (size_t i = 1; i < finite; i++)
        distinct += sorted[i] != sorted[i - 1];
    return distinct;
}

// The coordinates of a cell at `far` along an axis, two roundings apart or more; the others are
// random.
static size_t choose_places(double far, unsigned axis, double cell, bl_random *random,
                            double column[BL_AXES][PLACES]) {
    double base = cell * floor(far / cell), across[BL_AXES];
    double rounding = 2 * (nextafter(fabs(base), INFINITY) - fabs(base));
    size_t count = 0;
    for (int a = 0; a < BL_AXES; a++)
        across[a] = cell * 16 * (bl_random_unit(random) - 0.5);
    for (int i = 0; i < PLACES; i++) {
        double x = base + cell * ((double)i / PLACES);
        if ((count && x - column[axis][count - 1] < rounding) || x >= base + cell)
            continue;
        for (int a = 0; a < BL_AXES; a++)
            column[a][count] = across[a];
        column[axis][count++] = x;
    }
    return count;
}

static view view_of(const bl_signal *signal, double far, unsigned axis, double cell,
                    bl_random random) {
    double column[BL_AXES][PLACES], reference[PLACES], widened[PLACES];
    float points[PLACES];
    view v = {.is_finite = 1};
    size_t count = choose_places(far, axis, cell, &random, column);
    bl_signal_points(signal, BL_COLUMNS(column), count, points);
    for (size_t i = 0; i < count; i++) {
        const double at[BL_AXES] = {column[0][i], column[1][i], column[2][i], column[3][i]};
        reference[i] = bl_signal_value(signal, at);
        widened[i] = (double)points[i];
        v.error = fmax(v.error, fabs(widened[i] - reference[i]));
        v.is_finite = v.is_finite && isfinite(reference[i]) && isfinite(widened[i]);
    }
    size_t by_value = count_distinct(reference, count), by_points = count_distinct(widened, count);
    size_t distinct = by_value < by_points ? by_value : by_points;
    // Two places of a symmetric cell; where the values are all equal, nothing is symmetric.
    distinct += distinct > 1 && distinct < count;
    v.share = count ? (double)distinct / (double)count : 0;
    return v;
}

// Of several cells from `far` on: the best share, and the largest error. A sparse noise has cells
// with next to nothing in them, so more are tried while none has the share that is wanted.
static view best_view(const bl_signal *signal, double far, unsigned axis, double cell,
                      bl_random random, double wanted) {
    view best = {.is_finite = 1};
    for (int k = 0; k < (best.share < wanted ? MOST_CELLS : CELLS); k++) {
        bl_random own = bl_random_seed(bl_random_bits(&random), (uint64_t)k);
        view v = view_of(signal, far + 7 * k * cell, axis, cell, own);
        best.share = fmax(best.share, v.share);
        best.error = fmax(best.error, v.error);
        best.is_finite = best.is_finite && v.is_finite;
    }
    return best;
}

static double scale_of(int index) {
    return index < SCALES ? pow(10, FIRST + index) : index == SCALES ? 0x1p31 : 0x1p53;
}

// --- the variance far out -----------------------------------------------------------------------

// The mean of squared deviations at random places near 0, and near the far place on all axes.
static void take(const bl_signal *signal, const bl_score_look *look, bl_random random, double *near,
                 double *far) {
    double column[BL_AXES][2 * EACH];
    float value[2 * EACH];
    bl_score_fresh fresh = bl_score_fresh_open(signal, bl_random_bits(&random));
    for (size_t i = 0; i < 2 * EACH; i++)
        for (int a = 0; a < BL_AXES; a++)
            column[a][i] = look->cell * (2048 * (bl_random_unit(&random) - 0.5)) +
                           (i < EACH ? 0 : look->cell * FAR_PLACE);
    bl_signal_points(fresh.signal, BL_COLUMNS(column), 2 * EACH, value);
    bl_score_fresh_close(&fresh);
    *near = *far = 0;
    for (size_t i = 0; i < 2 * EACH; i++) {
        double deviation = (double)value[i] - look->mean;
        *(i < EACH ? near : far) += deviation * deviation / EACH;
    }
}

// The ratio of the two, at the level that is shown and at the one that is judged.
static bl_status variance_ratio(const bl_signal *signal, const bl_score_settings *settings,
                                const bl_score_look *look, bl_estimate *shown, bl_estimate *judged,
                                bl_message *message, bl_score_property *result) {
    size_t count = (size_t)bl_size_pick(settings->size, 256, 1024, 8192);
    double *room = malloc(2 * count * sizeof *room);
    if (!room)
        return bl_score_no_memory(result, message);
#pragma omp parallel for num_threads(bl_thread_count(settings->threads)) schedule(dynamic, 8)
    for (size_t i = 0; i < count; i++)
        take(signal, look, bl_score_random(settings, "far", 1000 + i), &room[i], &room[count + i]);
    *shown = bl_ratio_estimate(room + count, room, count, settings->level);
    *judged = bl_ratio_estimate_missing(room + count, room, count, settings->alpha);
    free(room);
    return BL_OK;
}

// --- the verdict --------------------------------------------------------------------------------

// Whether NaN and infinity on any axis give NaN, in all three ways to evaluate.
static int gives_nan(const bl_signal *signal, const bl_score_look *look) {
    static const double bad[] = {NAN, INFINITY, -INFINITY};
    for (unsigned a = 0; a < look->dimensions; a++)
        for (int k = 0; k < 3; k++) {
            double at[BL_AXES] = {0.3, 0.4, 0.6, 0.7}, step[BL_AXES] = {0};
            float row, points;
            at[a] = bad[k];
            bl_signal_row(signal, at, step, 1, &row);
            bl_signal_points(signal, (const double *const[]){&at[0], &at[1], &at[2], &at[3]}, 1,
                             &points);
            if (!isnan(bl_signal_value(signal, at)) || !isnan(row) || !isnan(points))
                return 0;
        }
    return 1;
}

typedef struct summary {
    double share[SCALES + 2], error[SCALES + 2]; // share: over that near 0
    double lost;                                 // the first power of ten with too few, or 0
    double reach;                                // the last of those with half, from 10^2 on
    int is_finite;
} summary;

static summary summarise(const bl_signal *signal, const bl_score_settings *settings,
                         const bl_score_look *look, double least, double limit) {
    summary s = {.is_finite = 1, .reach = 100};
    view close[NEAR][BL_AXES], views[SCALES + 2][BL_AXES];
    const unsigned axes = look->dimensions;
    const int threads = bl_thread_count(settings->threads);
#pragma omp parallel for num_threads(threads) schedule(dynamic)
    for (unsigned n = 0; n < NEAR * axes; n++)
        close[n / axes][n % axes] = view_of(signal, 7.0 * (n / axes) - 7, n % axes, look->cell,
                                            bl_score_random(settings, "far", n % axes));
    double near = 1;
    for (unsigned axis = 0; axis < axes; axis++) {
        double best = 0;
        for (unsigned n = 0; n < NEAR; n++)
            best = fmax(best, close[n][axis].share);
        near = fmin(near, best);
    }
    // A staircase has more steps in one cell than in the next.
    least = near < 0.9 ? fmin(least, 0.5) : least;
#pragma omp parallel for num_threads(threads) schedule(dynamic)
    for (unsigned n = 0; n < (SCALES + 2) * axes; n++)
        views[n / axes][n % axes] =
            best_view(signal, scale_of((int)(n / axes)), n % axes, look->cell,
                      bl_score_random(settings, "far", n % axes), least * near);
    for (unsigned i = 0; i < SCALES + 2; i++) {
        s.share[i] = 1;
        for (unsigned axis = 0; axis < axes; axis++) {
            s.share[i] = fmin(s.share[i], fmin(1, views[i][axis].share / near));
            s.error[i] = fmax(s.error[i], views[i][axis].error);
            s.is_finite = s.is_finite && (scale_of((int)i) > limit || views[i][axis].is_finite);
        }
        if (i < SCALES && scale_of((int)i) <= limit && s.share[i] < least && s.lost == 0)
            s.lost = scale_of((int)i);
        if (i < SCALES && s.share[i] >= 0.5 && s.reach * 10 >= scale_of((int)i) * (1 - 1e-9))
            s.reach = scale_of((int)i);
    }
    return s;
}

static void add_numbers(const summary *s, bl_score_property *result) {
    for (int i = 0; i < SCALES + 2; i++) {
        bl_score_add_seen(result, share_names[i], s->share[i]);
        bl_score_add_seen(result, error_names[i], s->error[i]);
    }
    bl_score_add_seen(result, "half_distinct_up_to", s->reach);
    snprintf(result->cell, sizeof result->cell, "%.0e", s->reach);
}

// The coordinates; NaN: nowhere.
static void add_broken(const bl_overflow_place *broken, bl_score_property *result) {
    static const char *const names[BL_OVERFLOW_KINDS] = {"range_breaks_at", "no_number_at",
                                                         "neighbours_jump_at"};
    for (int kind = 0; kind < BL_OVERFLOW_KINDS; kind++)
        bl_score_add_seen(result, names[kind],
                          isfinite(broken[kind].from) ? broken[kind].from : NAN);
}

// "2^31", or the number.
static bl_score_text power_text(double x) {
    bl_score_text out;
    int exponent;
    if (frexp(x, &exponent) == 0.5)
        snprintf(out.text, sizeof out.text, "2^%d", exponent - 1);
    else
        snprintf(out.text, sizeof out.text, "%.9g", x);
    return out;
}

// Of what breaks within `limit` the nearest; NULL: nothing.
static const bl_overflow_place *nearest(const bl_overflow_place *broken, double limit) {
    const bl_overflow_place *first = NULL;
    for (int kind = 0; kind < BL_OVERFLOW_KINDS; kind++)
        if (broken[kind].from <= limit && (!first || broken[kind].from < first->from))
            first = &broken[kind];
    return first;
}

// What breaks there, and where; "" for nothing.
static void tell_broken(const bl_signal *signal, const bl_overflow_place *broken,
                        const bl_overflow_place *first, char text[300]) {
    static const char *const what[BL_OVERFLOW_KINDS] = {"the range breaks", "there is no number",
                                                        "neighbours jump"};
    text[0] = '\0';
    if (first)
        snprintf(text, 300, "%s at %s: %.3g at %s", what[first - broken],
                 power_text(first->from).text, first->value,
                 bl_score_place_text(signal, first->at).text);
}

static void judge(const bl_signal *signal, const summary *s, double limit, int is_nan,
                  const bl_estimate *ratio, const bl_overflow_place *broken,
                  bl_score_property *result) {
    char told[300], beyond[304] = "";
    const bl_overflow_place *within = nearest(broken, bl_overflow_domain(signal, 0x1p32));
    bl_score_against against = signal->facts.far > 0 ? BL_AGAINST_CLAIM : BL_AGAINST_IDEAL;
    const char *wish = against == BL_AGAINST_CLAIM ? "stated" : "wanted";
    tell_broken(signal, broken, within ? within : nearest(broken, BL_OVERFLOW_LAST / 2), told);
    if (told[0])
        snprintf(beyond, sizeof beyond, "; %s", told);
    if (s->lost > 0)
        bl_score_judge(result, BL_VERDICT_FAIL, against,
                       "half of the values in a cell are distinct numbers up to %.0e; at %.0e too "
                       "few are, and %s is %.3g%s",
                       s->reach, s->lost, wish, limit, beyond);
    else if (!s->is_finite)
        bl_score_judge(result, BL_VERDICT_FAIL, against,
                       "half of the values in a cell are distinct numbers up to %.0e, but some "
                       "below %.3g are not finite, and %s is %.3g%s",
                       s->reach, limit, wish, limit, beyond);
    else if (!is_nan)
        bl_score_judge(result, BL_VERDICT_FAIL, against,
                       "a coordinate that is NaN or infinite does not give NaN%s", beyond);
    else if (ratio->lower > 1.2 || ratio->upper < 0.8)
        bl_score_judge(result, BL_VERDICT_FAIL, against,
                       "the variance near 1e6 is %.3g times that near 0%s", ratio->value, beyond);
    else if (within)
        bl_score_judge(result, BL_VERDICT_FAIL, against,
                       "values are distinct numbers up to %.0e, but %s", s->reach, told);
    else
        bl_score_judge(result, BL_VERDICT_PASS, against,
                       "values stay distinct numbers up to %.0e (%s: %.3g), and the variance near "
                       "1e6 is %.3g times that near 0%s",
                       s->reach, wish, limit, ratio->value, beyond);
}

static bl_status measure(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message) {
    const bl_signal *signal = subject->signal;
    bl_score_look look;
    bl_estimate shown = {.value = NAN}, judged = shown;
    if (!bl_score_look_at(subject, settings, result, &look) ||
        !bl_score_varies(signal, settings, result))
        return BL_OK;
    // A step is level far out and has limits: no digits are lost there, and nothing is like near 0.
    if (!(signal->facts.far > 0) && !bl_score_has_statistics(signal, result))
        return BL_OK;
    int is_stated = signal->facts.far > 0;
    double limit = is_stated ? signal->facts.far / 4 : FAR_PLACE;
    // A cell that was found is that of the finest detail, beside which there may be flat ones.
    if (isnan(subject->scale.stated))
        look.cell = fmax(look.cell, 1);
    bl_overflow_place broken[BL_OVERFLOW_KINDS];
    bl_overflow_find(signal, settings, broken);
    if (variance_ratio(signal, settings, &look, &shown, &judged, message, result) != BL_OK)
        return BL_DEVICE;
    summary s = summarise(signal, settings, &look, is_stated ? 0.9 : 0.5, limit);
    add_numbers(&s, result);
    bl_score_add(result, "variance_ratio_at_1e6", shown);
    add_broken(broken, result);
    judge(signal, &s, limit, gives_nan(signal, &look), &judged, broken, result);
    return BL_OK;
}

BL_PROPERTY_DESCRIPTOR(far) = {
    .name = "far",
    .title = "far",
    .entry = "the coordinate up to which half of the values in a cell are distinct numbers",
    .question = "Is the noise as good at large coordinates as near 0?",
    .measure = measure,
};
