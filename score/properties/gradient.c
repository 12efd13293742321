// SPDX-License-Identifier: MIT
//
// The gradient: the analytic one against central differences of the reference.
//
// With D(h) = (n(x+h) - n(x-h)) / 2h, Richardson's (4 D(h/2) - D(h)) / 3 has an error of order h^4
// where the noise is smooth, and |D(h) - D(h/2)| bounds it from above by far. Where a second
// derivative jumps within the stencil both are of the same order, so that the place excuses itself;
// where the first derivative jumps very near the place, both D may agree and be wrong, which
// happens at less than one place in a thousand for a step of 2^-12 of the finest cell. A place is
// wrong where the analytic gradient is off by more than 8 times that bound and a part of 10^-4 of
// the root-mean-square gradient; a signal is wrong if more than one place in fifty is. There is no
// chance in it: no limit depends on alpha.
//
// A signal that does not state a continuous derivative has more of such places, and its value may
// jump. There the two one-sided differences disagree: places where they do, by a twentieth of
// themselves and a thousandth of the root-mean-square gradient, are left out of everything. If most
// places are, nothing is judged.
#include "score/properties/places.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/grid.h"
#include "core/statistics.h"

#define STEP 0x1p-12 // of the finest cell
#define TOLERANCE 1e-4
#define DISAGREE 0.05 // of one-sided differences, of the larger one
#define UNLIKE 1e-3   // the same, of the root-mean-square gradient
#define SHARE_WRONG 0.02

typedef struct place {
    double at[BL_AXES], analytic[BL_AXES], numeric[BL_AXES], bound[BL_AXES];
    double disagreement[BL_AXES]; // of the one-sided differences; 0 where they agree
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

// The difference of the one-sided differences, where it is beyond DISAGREE.
static double disagreement_of(const bl_signal *signal, const double at[BL_AXES], unsigned axis,
                              double h) {
    double above[BL_AXES], below[BL_AXES], here = bl_signal_value(signal, at);
    for (int a = 0; a < BL_AXES; a++)
        above[a] = below[a] = at[a];
    above[axis] += h;
    below[axis] -= h;
    double forward = (bl_signal_value(signal, above) - here) / (above[axis] - at[axis]);
    double backward = (here - bl_signal_value(signal, below)) / (at[axis] - below[axis]);
    double apart = fabs(forward - backward);
    return apart <= DISAGREE * fmax(fabs(forward), fabs(backward)) ? 0 : apart;
}

static void take(const bl_signal *signal, const bl_score_look *look, bl_random random, place *p) {
    *p = (place){.at = {0}};
    for (unsigned a = 0; a < look->dimensions; a++)
        p->at[a] = look->cell * 64 * (bl_random_unit(&random) - 0.5);
    signal->functions->gradient(signal->parameters, p->at, p->analytic);
    for (unsigned a = 0; a < look->dimensions; a++) {
        double step = STEP * look->finest, wide = central(signal, p->at, a, step);
        double narrow = central(signal, p->at, a, step / 2);
        p->numeric[a] = (4 * narrow - wide) / 3;
        // Rounding: two values of some 1e-15 of the deviation, over the step.
        p->bound[a] = fabs(wide - narrow) + 1e-14 * look->deviation / step;
        if (signal->facts.continuity < 1)
            p->disagreement[a] = disagreement_of(signal, p->at, a, step / 2);
    }
}

static int is_rough(const place *p, double least) {
    double largest = 0;
    for (int a = 0; a < BL_AXES; a++)
        largest = fmax(largest, p->disagreement[a]);
    return largest > least;
}

// The sum of squares of the numeric gradients of the places that are left in, over their number.
// `least` is the disagreement beyond which a place is left out.
static double mean_square(const place *places, size_t count, unsigned dimensions, double least) {
    double square = 0;
    size_t left = 0;
    for (size_t i = 0; i < count; i++) {
        if (is_rough(&places[i], least))
            continue;
        left++;
        for (unsigned a = 0; a < dimensions; a++)
            square += places[i].numeric[a] * places[i].numeric[a];
    }
    return left ? square / (double)left : 0;
}

// Whether the analytic gradient is wrong there, and how far off it is.
static int is_wrong(const place *p, unsigned dimensions, double size, double *error) {
    int wrong = 0;
    *error = 0;
    for (unsigned a = 0; a < dimensions; a++) {
        double off = fabs(p->analytic[a] - p->numeric[a]);
        *error = fmax(*error, off / size);
        wrong |= !(off <= 8 * p->bound[a] + TOLERANCE * size);
    }
    return wrong;
}

static void judge(const place *places, size_t all, unsigned dimensions, double *error,
                  bl_score_property *result) {
    size_t wrong = 0, first = 0, count = 0;
    // The first root leaves out all that disagree, some of which the threshold lets in again.
    double least = UNLIKE * sqrt(mean_square(places, all, dimensions, 0));
    double size = sqrt(mean_square(places, all, dimensions, least));
    for (size_t i = 0; i < all; i++) {
        if (is_rough(&places[i], least))
            continue;
        if (is_wrong(&places[i], dimensions, size, &error[count++]) && wrong++ == 0)
            first = i;
    }
    bl_score_add_exact(result, "places", (double)count);
    bl_score_add_exact(result, "places_left_out", (double)(all - count));
    if (2 * count < all) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_CLAIM,
                       "most places are too near a jump of the value or of a derivative");
        return;
    }
    qsort(error, count, sizeof *error, bl_ascending);
    double share = (double)wrong / (double)count, median = error[count / 2];
    bl_score_add_seen(result, "median_error", median);
    bl_score_add_seen(result, "error_of_95_percent", error[count * 95 / 100]);
    bl_score_add_seen(result, "share_wrong", share);
    snprintf(result->cell, sizeof result->cell, "%.1e", median);
    if (!isfinite(size)) {
        bl_score_not_finite(result);
    } else if (share > SHARE_WRONG) {
        const double *at = places[first].at;
        bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_CLAIM,
                       "the gradient is not the derivative at %.3g %% of the places, such as "
                       "(%.6g, %.6g, %.6g, %.6g); median error %.2g",
                       100 * share, at[0], at[1], at[2], at[3], median);
    } else {
        bl_score_judge(result, BL_VERDICT_PASS, BL_AGAINST_CLAIM,
                       "the gradient is the derivative: median error %.2g of its size", median);
    }
}

static bl_status measure(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message) {
    const bl_signal *signal = subject->signal;
    bl_score_look look;
    if (!signal->functions->gradient) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL, "the signal has no gradient");
        return BL_OK;
    }
    if (!bl_score_look_at(subject, settings, result, &look))
        return BL_OK;
    size_t count = (size_t)bl_size_pick(settings->size, 250, 2000, 20000);
    place *places = malloc(count * sizeof *places);
    double *error = malloc(count * sizeof *error);
    if (places && error) {
#pragma omp parallel for num_threads(bl_thread_count(settings->threads)) schedule(dynamic, 8)
        for (size_t i = 0; i < count; i++)
            take(signal, &look, bl_score_random(settings, "gradient", i), &places[i]);
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
