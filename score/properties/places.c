// SPDX-License-Identifier: MIT
#include "score/properties/places.h"

#include <math.h>
#include <string.h>

#include "score/properties/sampling.h"

enum { LOOKS = 1024, FRESH = 9, FRESH_LOOKS = 32 };

// The blocks of 2^24 streams that were given out first, by number; every other name has the block
// of its hash (FNV-1a), which is none of these.
static uint64_t block_of(const char *property) {
    static const char *const first[] = {"look",  "period", "stationarity", "isotropy", "continuity",
                                        "seeds", "far",    "gradient",     "fresh"};
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < sizeof first / sizeof *first; i++)
        if (strcmp(first[i], property) == 0)
            return (i + 1) << 24;
    for (const char *c = property; *c; c++)
        hash = (hash ^ (unsigned char)*c) * UINT64_C(0x100000001b3);
    return hash << 24;
}

bl_random bl_score_random(const bl_score_settings *settings, const char *property,
                          uint64_t stream) {
    return bl_random_seed(settings->seed, block_of(property) + stream);
}

void bl_score_spread(bl_random *random, double cell, size_t count, double *const at[BL_AXES]) {
    for (size_t i = 0; i < count; i++)
        for (int a = 0; a < BL_AXES; a++)
            at[a][i] = cell * (i % 2 ? 32 : 2000) * (bl_random_unit(random) - 0.5);
}

int bl_score_look_at(const bl_score_subject *subject, const bl_score_settings *settings,
                     bl_score_property *result, bl_score_look *look) {
    const bl_signal *signal = subject->signal;
    double cell = bl_score_cell(signal), column[BL_AXES][LOOKS];
    float value[LOOKS];
    bl_moments moments = {.n = 0};
    bl_random random = bl_score_random(settings, "look", 0);
    *look = (bl_score_look){.dimensions = signal->dimensions, .cell = cell, .finest = cell};
    // The fraction within the finest cell is what is lost at facts.far, which is 2^52 such cells.
    if (signal->facts.cell > 0 && signal->facts.far > 0)
        look->finest = fmin(cell, signal->facts.far * 0x1p-52);
    if (signal->extent.size[0]) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL,
                       "the signal is a grid of samples, which has no values between them");
        return 0;
    }
    bl_score_spread(&random, cell, LOOKS,
                    (double *const[]){column[0], column[1], column[2], column[3]});
    bl_signal_points(signal, BL_COLUMNS(column), LOOKS, value);
    double lower = INFINITY, upper = -INFINITY;
    for (int i = 0; i < LOOKS; i++) {
        if (!isfinite(value[i])) {
            bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL,
                           "the value at (%.9g, %.9g, %.9g, %.9g) is not finite", column[0][i],
                           column[1][i], column[2][i], column[3][i]);
            return 0;
        }
        bl_moments_add(&moments, (double)value[i]);
        lower = fmin(lower, (double)value[i]);
        upper = fmax(upper, (double)value[i]);
    }
    look->mean = moments.mean;
    look->range = upper - lower;
    look->deviation = sqrt(bl_moments_variance(&moments));
    // Floats of a constant that is computed, such as an interpolation between equal values.
    double size = fmax(fmax(fabs(lower), fabs(upper)), fabs(signal->facts.upper)); // fmax drops NaN
    if (look->range <= 32 * 0x1p-24 * (isfinite(size) ? size : 0)) {
        if (bl_score_varies(signal, settings, result))
            bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL,
                           "all values at %d places are %g", (int)LOOKS, lower);
        return 0;
    }
    return 1;
}

// Whether the values near 0 are all the same number, which is left in *value.
static int is_constant(const bl_signal *signal, double cell, bl_random *random, double *value) {
    double column[BL_AXES][FRESH_LOOKS];
    float values[FRESH_LOOKS];
    for (int i = 0; i < FRESH_LOOKS; i++)
        for (int a = 0; a < BL_AXES; a++)
            column[a][i] = cell * 16 * (bl_random_unit(random) - 0.5);
    bl_signal_points(signal, BL_COLUMNS(column), FRESH_LOOKS, values);
    *value = (double)values[0];
    for (int i = 1; i < FRESH_LOOKS; i++)
        if (!(values[i] == values[0])) // NaN is no constant
            return 0;
    return 1;
}

int bl_score_varies(const bl_signal *signal, const bl_score_settings *settings,
                    bl_score_property *result) {
    double cell = bl_score_cell(signal), first = NAN;
    int constant = 0, differs = 0;
    if (signal->seed_offset == SIZE_MAX || signal->extent.size[0])
        return 1;
    for (int i = 0; i < FRESH; i++) {
        bl_random random = bl_score_random(settings, "fresh", (uint64_t)i);
        bl_signal *fresh = bl_signal_reseed(signal, bl_random_bits(&random));
        double value;
        if (!fresh)
            return 1;
        if (is_constant(fresh, cell, &random, &value)) {
            constant++;
            differs |= value != first && !isnan(first);
            first = value;
        }
        bl_signal_free(fresh);
        if (i == 2 && !constant) // the usual case, at the cost of three looks
            return 1;
    }
    if (2 * constant < FRESH || !differs)
        return 1;
    bl_score_judge(result, BL_VERDICT_NOT_RUN, result->against,
                   "constant for each seed: of %d seeds of 64 bits, %d have one value within "
                   "eight cells of the origin",
                   FRESH, constant);
    return 0;
}

int bl_score_has_statistics(const bl_signal *signal, bl_score_property *result) {
    bl_message message = {""};
    if (bl_signal_check_statistics(signal, &message) == BL_OK)
        return 1;
    bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL, "%s", message.text);
    return 0;
}

void bl_score_not_finite(bl_score_property *result) {
    bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL,
                   "the signal has values that are not finite");
}

bl_status bl_score_no_memory(bl_score_property *result, bl_message *message) {
    bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL, "out of memory");
    return bl_report(message, BL_DEVICE, "out of memory for the scorecard");
}

bl_score_fresh bl_score_fresh_open(const bl_signal *signal, uint64_t seed) {
    bl_signal *own = bl_signal_reseed(signal, seed);
    return (bl_score_fresh){own ? own : signal, own};
}

void bl_score_fresh_close(bl_score_fresh *fresh) {
    bl_signal_free(fresh->own);
    fresh->own = NULL;
}

double bl_score_base(bl_random *random, double cell) {
    return cell * (floor(0x1p16 * bl_random_unit(random)) - 0x1p15);
}

double bl_score_t(const double *values, size_t n, size_t stride) {
    bl_moments moments = {.n = 0};
    for (size_t i = 0; i < n; i++)
        bl_moments_add(&moments, values[i * stride]);
    double error = sqrt(bl_moments_variance(&moments) / moments.n);
    return moments.mean == 0 ? 0 : moments.mean / error;
}

double bl_score_t_limit(double alpha, double tests, size_t n) {
    return -bl_student_quantile(alpha / tests / 2, (double)n - 1);
}

bl_estimate bl_score_db(bl_estimate ratio) {
    ratio.value = 10 * log10(ratio.value);
    ratio.lower = 10 * log10(fmax(0, ratio.lower));
    ratio.upper = 10 * log10(ratio.upper);
    return ratio;
}
