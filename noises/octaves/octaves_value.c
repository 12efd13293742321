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

static int is_inside(const bl_octaves *octaves, const double at[BL_AXES]) {
    for (unsigned a = 0; a < octaves->dimensions; a++)
        if (!(fabs(at[a]) < 0x1p62))
            return 0;
    return 1;
}

// How many octaves take part: the removed ones of a ridge have their mean height, but still the
// weight of the one before.
static unsigned last_of(const bl_octaves *octaves, const bl_octaves_plan *plan) {
    int goes_on = octaves->rules.fold == BL_FOLD_RIDGE && plan->evaluated > 0;
    return goes_on ? plan->count : plan->evaluated;
}

// What an octave adds, but for its amplitude and the weight of a ridge: of F, what is kept.
static double part_of(const bl_octaves *octaves, double kept, double folded) {
    return octaves->rules.fold == BL_FOLD_RIDGE ? kept * folded + (1 - kept) * octaves->lost
                                                : kept * folded;
}

// The weight of the octave after one of this part and weight.
static double next_weight(const bl_octaves *octaves, double part, double weight) {
    double gain = octaves->rules.ridge_gain;
    if (octaves->rules.fold != BL_FOLD_RIDGE)
        return 1;
    return gain * part * weight < 1 ? gain * part * weight : 1;
}

// --- values, many at once -----------------------------------------------------------------------

// The sums of up to BL_BATCH places: octave by octave, so that the basis is asked once a batch.
typedef struct octaves_batch {
    double at[BL_AXES][BL_BATCH];
    double kept[BL_OCTAVES_MOST][BL_BATCH];
    unsigned evaluated[BL_BATCH], last[BL_BATCH]; // 0 where there is no value
    double weight[BL_BATCH];
} octaves_batch;

static void put_plan(const bl_octaves *octaves, const bl_octaves_plan *plan, size_t i,
                     octaves_batch *batch) {
    for (unsigned o = 0; o < plan->count; o++)
        batch->kept[o][i] = plan->kept[o];
    batch->evaluated[i] = plan->evaluated;
    batch->last[i] = last_of(octaves, plan);
}

// Adds an octave: its noise where it is evaluated, its mean where only its weight goes on.
static void add_octave(const bl_octaves *octaves, unsigned o, size_t count, octaves_batch *batch,
                       double *out) {
    bl_gathered gathered = {.count = 0};
    double noise[BL_BATCH], folded[BL_BATCH] = {0}, slope;
    for (size_t i = 0; i < count; i++) {
        double at[BL_AXES], place[BL_AXES];
        if (o >= batch->evaluated[i])
            continue;
        for (int a = 0; a < BL_AXES; a++)
            at[a] = place[a] = batch->at[a][i];
        bl_octave_place(&octaves->octave[o], octaves->dimensions, at, place);
        bl_gather(&gathered, i, place);
    }
    const bl_samples samples = bl_gathered_samples(&gathered, &bl_footprint_point, 0);
    bl_signal_values(octaves->octave[o].basis, samples.at, samples.count, noise);
    for (size_t k = 0; k < gathered.count; k++)
        folded[gathered.of[k]] = bl_octaves_fold(&octaves->rules, noise[k], &slope);
    for (size_t i = 0; i < count; i++) {
        if (o >= batch->last[i])
            continue;
        double part = part_of(octaves, batch->kept[o][i], folded[i]);
        out[i] += octaves->plan.amplitude[o] * (part * batch->weight[i]);
        batch->weight[i] = next_weight(octaves, part, batch->weight[i]);
    }
}

// Up to BL_BATCH places, of the sum as it is or, if `width` is not NULL, for these widths.
static void fill_batch(const bl_octaves_settings *settings, const double *const at[BL_AXES],
                       const double *width, size_t count, double *out) {
    const bl_octaves *octaves = settings->octaves;
    octaves_batch batch;
    bl_octaves_plan plan = octaves->plan;
    double constant = bl_octaves_constant(octaves, &plan);
    unsigned last = 0;
    for (size_t i = 0; i < count; i++) {
        const double place[BL_AXES] = {at[0][i], at[1][i], at[2][i], at[3][i]};
        for (int a = 0; a < BL_AXES; a++)
            batch.at[a][i] = place[a];
        batch.weight[i] = 1;
        if (width && (i == 0 || width[i] != width[i - 1])) { // made once for equal widths
            bl_octaves_plan_clamp(&plan, octaves->top, (bl_octave_clamp)settings->clamp, width[i]);
            constant = bl_octaves_constant(octaves, &plan);
        }
        put_plan(octaves, &plan, i, &batch);
        out[i] = constant;
        if (!is_inside(octaves, place) || (width && !(width[i] >= 0))) {
            batch.evaluated[i] = batch.last[i] = 0;
            out[i] = NAN;
        }
        last = batch.last[i] > last ? batch.last[i] : last;
    }
    for (unsigned o = 0; o < last; o++)
        add_octave(octaves, o, count, &batch, out);
}

static void fill(const bl_octaves_settings *settings, const double *const at[BL_AXES],
                 const double *width, size_t count, double *out) {
    for (size_t done = 0; done < count; done += BL_BATCH) {
        size_t here = count - done < BL_BATCH ? count - done : BL_BATCH;
        const double *const rest[BL_AXES] = {at[0] + done, at[1] + done, at[2] + done,
                                             at[3] + done};
        fill_batch(settings, rest, width ? width + done : NULL, here, out + done);
    }
}

void bl_octaves_values(const void *parameters, const double *const at[BL_AXES], size_t count,
                       double *out) {
    fill(parameters, at, NULL, count, out);
}

double bl_octaves_value(const void *parameters, const double at[BL_AXES]) {
    double value;
    fill(parameters, (const double *const[]){&at[0], &at[1], &at[2], &at[3]}, NULL, 1, &value);
    return value;
}

void bl_octaves_values_for_widths(const bl_signal *sum, const double *const at[BL_AXES],
                                  const double *width, size_t count, double *out) {
    if (bl_octaves_is_sum(sum))
        fill(sum->parameters, at, width, count, out);
    for (size_t i = 0; i < count && !bl_octaves_is_sum(sum); i++)
        out[i] = NAN;
}

double bl_octaves_value_for_width(const bl_signal *sum, const double at[BL_AXES], double width) {
    double value;
    bl_octaves_values_for_widths(sum, (const double *const[]){&at[0], &at[1], &at[2], &at[3]},
                                 &width, 1, &value);
    return value;
}

void bl_octaves_filtered(const void *parameters, const bl_samples *samples, double *out) {
    const bl_octaves_settings *settings = parameters;
    double width[BL_BATCH];
    for (size_t done = 0; done < samples->count; done += BL_BATCH) {
        const bl_samples part = bl_samples_part(samples, done, BL_BATCH);
        for (size_t i = 0; i < part.count; i++) {
            width[i] =
                bl_footprint_widest(bl_samples_footprint(&part, i), settings->octaves->dimensions);
            if (settings->width > width[i]) // never of NaN
                width[i] = settings->width;
        }
        fill_batch(settings, part.at, width, part.count, out + done);
    }
}

// --- the gradient -------------------------------------------------------------------------------

// The noise of an octave at a place of the sum, and its gradient there.
static double octave_gradient(const bl_octaves *octaves, const bl_octave *octave,
                              const double at[BL_AXES], double gradient[BL_AXES]) {
    double place[BL_AXES], slope[BL_AXES] = {NAN, NAN, NAN, NAN};
    unsigned dimensions = octaves->dimensions;
    memcpy(place, at, sizeof place);
    bl_octave_place(octave, dimensions, at, place);
    if (octave->basis->functions->gradient)
        octave->basis->functions->gradient(octave->basis->parameters, place, slope);
    for (unsigned a = 0; a < dimensions; a++) {
        double sum = slope[a];
        for (unsigned b = 0; octave->rotated && b < dimensions; b++)
            sum = (b ? sum : 0) + octave->rotation[b][a] * slope[b];
        gradient[a] = octave->frequency * sum;
    }
    return bl_signal_value(octave->basis, place);
}

void bl_octaves_gradient(const void *parameters, const double at[BL_AXES], double out[BL_AXES]) {
    const bl_octaves *octaves = ((const bl_octaves_settings *)parameters)->octaves;
    const bl_octaves_plan *plan = &octaves->plan;
    int inside = is_inside(octaves, at);
    double weight = 1, weight_slope[BL_AXES] = {0};
    for (int a = 0; a < BL_AXES; a++)
        out[a] = inside ? 0 : NAN;
    unsigned last = inside ? last_of(octaves, plan) : 0;
    for (unsigned i = 0; i < last; i++) {
        double own[BL_AXES] = {0}, slope = 0, folded = 0, kept = plan->kept[i];
        if (i < plan->evaluated)
            folded = bl_octaves_fold(
                &octaves->rules, octave_gradient(octaves, &octaves->octave[i], at, own), &slope);
        double part = part_of(octaves, kept, folded), next = next_weight(octaves, part, weight);
        int grows = octaves->rules.fold == BL_FOLD_RIDGE && next < 1;
        for (unsigned a = 0; a < octaves->dimensions; a++) {
            own[a] = weight * (kept * slope * own[a]) + part * weight_slope[a];
            out[a] += plan->amplitude[i] * own[a];
            weight_slope[a] = grows ? octaves->rules.ridge_gain * own[a] : 0;
        }
        weight = next;
    }
}
