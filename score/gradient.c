// SPDX-License-Identifier: MIT
//
// The gradient: the analytic one against central differences of the reference.
//
// With D(h) = (n(x+h) - n(x-h)) / 2h, Richardson's (4 D(h/2) - D(h)) / 3 has an error of order h^4
// where the noise is smooth, and |D(h) - D(h/2)| bounds it from above by far. Where a second
// derivative jumps within the stencil both are of the same order, so that the place excuses itself;
// where the first derivative jumps very near the place, both D may agree and be wrong, which
// happens at less than one place in a thousand for a step of 2^-12 of a cell. A place is wrong
// where the analytic gradient is off by more than 8 times that bound and a part of 10^-4 of the
// root-mean-square gradient; a signal is wrong if more than one place in fifty is. There is no
// chance in it: no limit depends on alpha.
#include "score/places.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/grid.h"

#define STEP 0x1p-12 // of a cell
#define TOLERANCE 1e-4
#define SHARE_WRONG 0.02

typedef struct place {
    double at[BL_AXES], analytic[BL_AXES], numeric[BL_AXES], bound[BL_AXES];
} place;

static double central(const bl_signal *signal, const double at[BL_AXES], unsigned axis, double h) {
    double above[BL_AXES], below[BL_AXES];
    for (int a = 0; a < BL_AXES; a++)
        above[a] = below[a] = at[a];
    above[axis] += h;
    below[axis] -= h;
    // The step that the coordinates took, which is exact.
    return (bl_signal_value(signal, above) - bl_signal_value(signal, below)) /
           (above[axis] - below[axis]);
}

static void take(const bl_signal *signal, const bl_score_look *look, bl_random random, place *p) {
    *p = (place){.at = {0}};
    for (unsigned a = 0; a < look->dimensions; a++)
        p->at[a] = look->cell * 64 * (bl_random_unit(&random) - 0.5);
    signal->functions->gradient(signal->parameters, p->at, p->analytic);
    for (unsigned a = 0; a < look->dimensions; a++) {
        double wide = central(signal, p->at, a, STEP * look->cell);
        double narrow = central(signal, p->at, a, STEP / 2 * look->cell);
        p->numeric[a] = (4 * narrow - wide) / 3;
        // Rounding: two values of some 1e-15 of the deviation, over the step.
        p->bound[a] = fabs(wide - narrow) + 1e-14 * look->deviation / (STEP * look->cell);
    }
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void judge(const place *places, size_t count, unsigned dimensions, double *error,
                  bl_score_property *result) {
    double square = 0;
    size_t wrong = 0, first = 0;
    for (size_t i = 0; i < count; i++)
        for (unsigned a = 0; a < dimensions; a++)
            square += places[i].numeric[a] * places[i].numeric[a] / (double)count;
    double size = sqrt(square);
    for (size_t i = 0; i < count; i++) {
        int is_wrong = 0;
        error[i] = 0;
        for (unsigned a = 0; a < dimensions; a++) {
            double off = fabs(places[i].analytic[a] - places[i].numeric[a]);
            error[i] = fmax(error[i], off / size);
            is_wrong |= !(off <= 8 * places[i].bound[a] + TOLERANCE * size);
        }
        if (is_wrong && wrong++ == 0)
            first = i;
    }
    qsort(error, count, sizeof *error, ascending);
    double share = (double)wrong / (double)count, median = error[count / 2];
    bl_score_add_seen(result, "median_error", median);
    bl_score_add_seen(result, "error_of_95_percent", error[count * 95 / 100]);
    bl_score_add_seen(result, "share_wrong", share);
    bl_score_add_exact(result, "places", (double)count);
    snprintf(result->cell, sizeof result->cell, "%.1e", median);
    if (!isfinite(size)) {
        bl_score_not_finite(result);
    } else if (share > SHARE_WRONG) {
        const double *at = places[first].at;
        bl_score_judge(result, BL_SCORE_FAIL, BL_AGAINST_CLAIM,
                       "the gradient is not the derivative at %.3g %% of the places, such as "
                       "(%.6g, %.6g, %.6g, %.6g); median error %.2g",
                       100 * share, at[0], at[1], at[2], at[3], median);
    } else {
        bl_score_judge(result, BL_SCORE_PASS, BL_AGAINST_CLAIM,
                       "the gradient is the derivative: median error %.2g of its size", median);
    }
}

static bl_status measure(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message) {
    const bl_signal *signal = subject->signal;
    bl_score_look look;
    if (!signal->functions->gradient) {
        bl_score_judge(result, BL_SCORE_NOT_RUN, BL_AGAINST_IDEAL, "the signal has no gradient");
        return BL_OK;
    }
    if (signal->facts.continuity == -1) {
        bl_score_judge(result, BL_SCORE_NOT_RUN, BL_AGAINST_IDEAL,
                       "the signal states that it is discontinuous");
        return BL_OK;
    }
    if (!bl_score_look_at(subject, settings, result, &look))
        return BL_OK;
    size_t count = (size_t)bl_score_pick(settings, 250, 2000, 20000);
    place *places = malloc(count * sizeof *places);
    double *error = malloc(count * sizeof *error);
    if (places && error) {
#pragma omp parallel for num_threads(bl_thread_count(settings->threads)) schedule(dynamic, 8)
        for (size_t i = 0; i < count; i++)
            take(signal, &look, bl_score_random(settings, BL_SCORE_STREAM_GRADIENT, i), &places[i]);
        judge(places, count, look.dimensions, error, result);
    }
    bl_status status = places && error ? BL_OK : bl_score_no_memory(result, message);
    free(places);
    free(error);
    return status;
}

BL_PROPERTY_DESCRIPTOR(gradient) = {
    .name = "gradient",
    .title = "gradient",
    .entry = "the median error, of the size of the gradient",
    .question = "Is the analytic gradient the derivative?",
    .measure = measure,
};
