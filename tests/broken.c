// SPDX-License-Identifier: MIT
//
// A wrapper has a noise of the registry inside, opened from its text with the seed of its own
// block, and works on coordinates, values and gradients around it. It takes over all facts, but for
// the period that it hides.
#include "tests/broken.h"

#include "tests/test.h"

#include "core/hash.h"
#include "noises/noise.h"
#include "noises/lattice/separable.h"

typedef struct block {
    uint64_t seed;
    bl_broken which;
    bl_signal *inner; // made by build
} block;

typedef struct entry {
    const char *name, *property, *text, *also;
} entry;

static const entry entries[BL_BROKEN_COUNT] = {
    [BL_BROKEN_NOTHING] = {"nothing", NULL, "gnoise"},
    [BL_BROKEN_RANGE] = {"range", "range", "gnoise"},
    [BL_BROKEN_PERIOD_SHORT] = {"period-short", "period", "scnoise:period=256,0,0"},
    [BL_BROKEN_PERIOD_LONG] = {"period-long", "period", "scnoise:period=524288,0,0"},
    [BL_BROKEN_JUMP] = {"jump", "continuity", "gnoise"},
    [BL_BROKEN_JUMP_ONCE] = {"jump-once", "continuity", "gnoise"},
    [BL_BROKEN_KINK] = {"kink", "continuity", "gnoise"},
    [BL_BROKEN_SEED_BIT] = {"seed-bit", "seeds", "gnoise"},
    [BL_BROKEN_SEED_SHIFT] = {"seed-shift", "seeds", "gnoise"},
    [BL_BROKEN_STRETCH] = {"stretch", "isotropy", "scnoise"},
    [BL_BROKEN_FLOAT] = {"float", "far", "gnoise"},
    [BL_BROKEN_AMPLITUDE] = {"amplitude", "stationarity", "scnoise", "isotropy"},
    [BL_BROKEN_MEAN] = {"mean", "stationarity", "scnoise", "isotropy"},
    [BL_BROKEN_GRADIENT] = {"gradient", "gradient", "gnoise"},
    [BL_BROKEN_GRADIENT_SOME] = {"gradient-some", "gradient", "gnoise"},
    [BL_BROKEN_PERIOD_MISSING] = {"period-missing", "period", "gnoise"},
    [BL_BROKEN_PERIOD_POINTS] = {"period-points", "period", "gnoise:period=16,0,0"},
    [BL_BROKEN_PERIOD_BEHIND] = {"period-behind", "period", "gnoise:period=16,0,0", "continuity"},
    [BL_BROKEN_PERIOD_HALF] = {"period-half", "period", "gnoise:period=12,0,0"},
    [BL_BROKEN_FAR_GAIN] = {"far-gain", "far", "gnoise"},
    [BL_BROKEN_FAR_NAN] = {"far-nan", "far", "gnoise"},
    [BL_BROKEN_NO_NAN] = {"no-nan", "far", "gnoise"},
    [BL_BROKEN_REGION] = {"region", "stationarity", "scnoise", "far"},
};

// --- what is broken -----------------------------------------------------------------------------

static double wrap(double x, double period) {
    return x - period * floor(x / period);
}

static void bend_coordinates(const block *b, double at[BL_AXES]) {
    // 2^22 at most: the fraction stays.
    if (b->which == BL_BROKEN_SEED_SHIFT)
        at[0] += (double)(b->seed & 0xff) + 1024 * (double)(bl_stream(b->seed >> 8, 0) >> 52);
    if (b->which == BL_BROKEN_STRETCH)
        at[0] *= 1.02;
    for (int a = 0; a < BL_AXES && b->which == BL_BROKEN_FLOAT; a++)
        at[a] = (double)(float)at[a];
}

static double farthest(const double at[BL_AXES]) {
    return fmax(fabs(at[0]), fmax(fabs(at[1]), fabs(at[2])));
}

// The value of the inner noise becomes gain * value + offset; both at the original coordinates.
static void bend_value(const block *b, const double at[BL_AXES], double *gain, double *offset) {
    double range = b->inner->facts.upper - b->inner->facts.lower;
    *gain = 1;
    *offset = 0;
    if (b->which == BL_BROKEN_RANGE)
        *gain = 1.5;
    if (b->which == BL_BROKEN_JUMP) // up at k + 0.3, and down at every other
        *offset = wrap(floor(at[0] - 0.3), 2) * 0.001 * range;
    if (b->which == BL_BROKEN_JUMP_ONCE)
        *offset = (at[0] >= 3) * 0.001 * range;
    if (b->which == BL_BROKEN_KINK) {
        double x = wrap(at[1] - 0.6, 2);
        *offset = 0.01 * (x < 1 ? x : 2 - x);
    }
    if (b->which == BL_BROKEN_AMPLITUDE)
        *gain = 1 + 0.05 * sin(2 * M_PI * wrap(at[1], 1));
    if (b->which == BL_BROKEN_MEAN)
        *offset = 0.05 * sqrt(b->inner->facts.variance) * cos(2 * M_PI * wrap(at[2], 1));
    if (b->which == BL_BROKEN_PERIOD_BEHIND)
        *offset = (at[0] < -20) * 0.01 * range;
    if ((b->which == BL_BROKEN_FAR_GAIN && farthest(at) > 5e5) ||
        (b->which == BL_BROKEN_REGION && at[0] > 5e4))
        *gain = 2;
    if (b->which == BL_BROKEN_FAR_NAN && farthest(at) > 1e9)
        *offset = NAN;
}

// --- abilities ----------------------------------------------------------------------------------

// Whether it gives 0 for a place that is none.
static int hides(const block *b, const double at[BL_AXES]) {
    return b->which == BL_BROKEN_NO_NAN && !isfinite(at[0] + at[1] + at[2]);
}

static double value(const void *parameters, const double at[BL_AXES]) {
    const block *b = parameters;
    double bent[BL_AXES], gain, offset;
    memcpy(bent, at, sizeof bent);
    bend_coordinates(b, bent);
    bend_value(b, at, &gain, &offset);
    return hides(b, at) ? 0 : gain * bl_signal_value(b->inner, bent) + offset;
}

static void points(const void *parameters, const double *const at[BL_AXES], size_t count,
                   float *out) {
    enum { CHUNK = 256 };
    const block *b = parameters;
    for (size_t from = 0; from < count; from += CHUNK) {
        size_t n = count - from < CHUNK ? count - from : CHUNK;
        double column[BL_AXES][CHUNK];
        for (size_t i = 0; i < n; i++) {
            double bent[BL_AXES] = {at[0][from + i], at[1][from + i], at[2][from + i],
                                    at[3][from + i]};
            bend_coordinates(b, bent);
            for (int a = 0; a < BL_AXES; a++)
                column[a][i] = bent[a];
        }
        bl_signal_points(b->inner, BL_COLUMNS(column), n, out + from);
        for (size_t i = 0; i < n; i++) {
            const double here[BL_AXES] = {at[0][from + i], at[1][from + i], at[2][from + i],
                                          at[3][from + i]};
            double gain, offset;
            bend_value(b, here, &gain, &offset);
            if (b->which == BL_BROKEN_PERIOD_POINTS && here[0] >= 20)
                offset = 0.01 * b->inner->facts.upper;
            out[from + i] = hides(b, here) ? 0 : (float)(gain * (double)out[from + i] + offset);
        }
    }
}

static void row(const void *parameters, const double start[BL_AXES], const double step[BL_AXES],
                size_t count, float *out) {
    bl_row_by_points(points, parameters, start, step, 0, count, out);
}

// Of those whose value is not bent by the place, times the derivative of the coordinate.
static void gradient(const void *parameters, const double at[BL_AXES], double out[BL_AXES]) {
    const block *b = parameters;
    double bent[BL_AXES], gain, offset;
    memcpy(bent, at, sizeof bent);
    bend_coordinates(b, bent);
    bend_value(b, at, &gain, &offset);
    b->inner->functions->gradient(b->inner->parameters, bent, out);
    if (b->which == BL_BROKEN_GRADIENT)
        gain = 1.001;
    if (b->which == BL_BROKEN_GRADIENT_SOME && wrap(floor(at[0]), 4) + wrap(floor(at[1]), 4) == 0)
        gain = 2;
    for (int a = 0; a < BL_AXES; a++)
        out[a] *= gain;
    if (b->which == BL_BROKEN_STRETCH)
        out[0] *= 1.02;
}

static bl_status build(void *parameters, bl_opener *open, bl_message *message) {
    (void)open;
    block *b = parameters;
    char text[64];
    uint64_t seed = b->seed;
    if (b->which == BL_BROKEN_SEED_BIT)
        seed &= ~(UINT64_C(1) << 37);
    if (b->which == BL_BROKEN_SEED_SHIFT)
        seed = 0;
    const char *inner = entries[b->which].text;
    snprintf(text, sizeof text, "%s%cseed=%llu", inner, strchr(inner, ':') ? ',' : ':',
             (unsigned long long)seed);
    return bl_noise_open(text, BL_ISA_BEST, &b->inner, message);
}

static void release(void *parameters) {
    block *b = parameters;
    bl_signal_free(b->inner);
}

static const bl_signal_functions functions = {.row = row,
                                              .points = points,
                                              .value = value,
                                              .gradient = gradient,
                                              .build = build,
                                              .release = release};
static const bl_signal_functions without_gradient = {
    .row = row, .points = points, .value = value, .build = build, .release = release};

static int has_gradient(bl_broken which) {
    return which != BL_BROKEN_JUMP && which != BL_BROKEN_JUMP_ONCE && which != BL_BROKEN_KINK &&
           which != BL_BROKEN_FLOAT && which != BL_BROKEN_AMPLITUDE && which != BL_BROKEN_MEAN &&
           which != BL_BROKEN_PERIOD_BEHIND;
}

bl_signal *bl_broken_signal(bl_broken which) {
    block b = {.which = which};
    bl_message message = {""};
    bl_signal *signal = bl_signal_new(has_gradient(which) ? &functions : &without_gradient, &b,
                                      sizeof b, bl_broken_name(which));
    assert_non_null(signal);
    if (bl_signal_build(signal, &message) != BL_OK)
        fail_msg("%s: %s", bl_broken_name(which), message.text);
    const block *made = signal->parameters;
    signal->seed_offset = offsetof(block, seed);
    signal->dimensions = made->inner->dimensions;
    signal->name = "broken";
    signal->facts = made->inner->facts;
    if (which == BL_BROKEN_PERIOD_SHORT || which == BL_BROKEN_PERIOD_LONG)
        signal->facts.period[0] = 0;
    if (which == BL_BROKEN_PERIOD_MISSING)
        signal->facts.period[1] = 7;
    if (which == BL_BROKEN_PERIOD_HALF)
        signal->facts.period[0] = 24;
    return signal;
}

const char *bl_broken_name(bl_broken which) {
    return entries[which].name;
}

const char *bl_broken_property(bl_broken which) {
    return entries[which].property;
}

const char *bl_broken_inner(bl_broken which) {
    return entries[which].text;
}

const char *bl_broken_also(bl_broken which) {
    return entries[which].also;
}
