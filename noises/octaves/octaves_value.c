// SPDX-License-Identifier: MIT
//
// The value of a sum of octaves and its gradient, in double.
#include "noises/octaves/octaves.h"

#include <math.h>
#include <string.h>

double bl_octaves_fold(const bl_octaves_rules *rules, double noise, double *slope) {
    double sign = noise < 0 ? -1 : 1;
    *slope = 1;
    if (rules->fold == BL_FOLD_NONE)
        return noise;
    *slope = sign;
    if (rules->fold == BL_FOLD_SIZE)
        return fabs(noise);
    double height = rules->ridge_offset - fabs(noise);
    *slope = -2 * height * sign;
    return height * height;
}

double bl_octaves_constant(const bl_octaves *octaves, const bl_octaves_plan *plan) {
    double sum = 0, next = 1;
    for (unsigned i = 0; i < plan->count; i++) {
        double lost = (1 - plan->kept[i]) * octaves->lost * next;
        sum += plan->amplitude[i] * lost;
        if (octaves->rules.fold == BL_FOLD_RIDGE)
            next = fmin(1, octaves->rules.ridge_gain * lost);
    }
    if (octaves->rules.fold == BL_FOLD_RIDGE && plan->evaluated > 0)
        return 0;
    return (double)(float)sum;
}

// The noise of an octave at a place of the sum, and its gradient there if asked for.
static double octave_value(const bl_octaves *octaves, const bl_octave *octave,
                           const double at[BL_AXES], double gradient[BL_AXES]) {
    double place[BL_AXES], slope[BL_AXES] = {NAN, NAN, NAN, NAN};
    unsigned dimensions = octaves->dimensions;
    memcpy(place, at, sizeof place);
    bl_octave_place(octave, dimensions, at, place);
    if (gradient && octave->basis->functions->gradient)
        octave->basis->functions->gradient(octave->basis->parameters, place, slope);
    for (unsigned a = 0; gradient && a < dimensions; a++) {
        double sum = slope[a];
        for (unsigned b = 0; octave->rotated && b < dimensions; b++)
            sum = (b ? sum : 0) + octave->rotation[b][a] * slope[b];
        gradient[a] = octave->frequency * sum;
    }
    return bl_signal_value(octave->basis, place);
}

static int is_inside(const bl_octaves *octaves, const double at[BL_AXES]) {
    for (unsigned a = 0; a < octaves->dimensions; a++)
        if (!(fabs(at[a]) < 0x1p62))
            return 0;
    return 1;
}

static double evaluate(const bl_octaves *octaves, const bl_octaves_plan *plan,
                       const double at[BL_AXES], double gradient[BL_AXES]) {
    const bl_octaves_rules *rules = &octaves->rules;
    int inside = is_inside(octaves, at), ridge = rules->fold == BL_FOLD_RIDGE;
    double sum = bl_octaves_constant(octaves, plan), next = 1, next_slope[BL_AXES] = {0};
    for (int a = 0; gradient && a < BL_AXES; a++)
        gradient[a] = inside ? 0 : NAN;
    unsigned last = ridge && plan->evaluated ? plan->count : plan->evaluated;
    for (unsigned i = 0; inside && i < last; i++) {
        double own[BL_AXES] = {0}, slope = 0, part = 0;
        double kept = plan->kept[i], amplitude = plan->amplitude[i];
        if (i < plan->evaluated)
            part = bl_octaves_fold(
                rules, octave_value(octaves, &octaves->octave[i], at, gradient ? own : NULL),
                &slope);
        if (ridge)
            part = (kept * part + (1 - kept) * octaves->lost);
        else
            part *= kept;
        for (unsigned a = 0; gradient && a < octaves->dimensions; a++) {
            own[a] = next * (kept * slope * own[a]) + part * next_slope[a];
            gradient[a] += amplitude * own[a];
            next_slope[a] =
                ridge && rules->ridge_gain * part * next < 1 ? rules->ridge_gain * own[a] : 0;
        }
        sum += amplitude * (part * next);
        if (ridge)
            next = rules->ridge_gain * part * next < 1 ? rules->ridge_gain * part * next : 1;
    }
    return inside ? sum : NAN;
}

double bl_octaves_value(const void *parameters, const double at[BL_AXES]) {
    const bl_octaves *octaves = ((const bl_octaves_settings *)parameters)->octaves;
    return evaluate(octaves, &octaves->plan, at, NULL);
}

void bl_octaves_gradient(const void *parameters, const double at[BL_AXES], double out[BL_AXES]) {
    const bl_octaves *octaves = ((const bl_octaves_settings *)parameters)->octaves;
    evaluate(octaves, &octaves->plan, at, out);
}

static double value_for_width(const bl_octaves_settings *settings, const double at[BL_AXES],
                              double width) {
    const bl_octaves *octaves = settings->octaves;
    bl_octaves_plan plan = octaves->plan;
    bl_octaves_plan_clamp(&plan, octaves->top, (bl_octave_clamp)settings->clamp, width);
    return evaluate(octaves, &plan, at, NULL);
}

double bl_octaves_value_for_width(const bl_signal *sum, const double at[BL_AXES], double width) {
    return bl_octaves_is_sum(sum) && width >= 0 ? value_for_width(sum->parameters, at, width) : NAN;
}

void bl_octaves_filtered(const void *parameters, const bl_samples *samples, double *out) {
    const bl_octaves_settings *settings = parameters;
    for (size_t i = 0; i < samples->count; i++) {
        double at[BL_AXES];
        bl_samples_place(samples, i, at);
        double widest =
            bl_footprint_widest(bl_samples_footprint(samples, i), settings->octaves->dimensions);
        out[i] = isnan(widest) ? NAN : value_for_width(settings, at, fmax(widest, settings->width));
    }
}
