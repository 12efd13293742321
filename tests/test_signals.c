// SPDX-License-Identifier: MIT
#include "tests/test_signals.h"

#include <math.h>
#include <string.h>

#include "core/hash.h"
#include "core/random.h"
#include "tests/test.h"

typedef struct block {
    uint64_t seed;
    double mean, amplitude, frequency[3], spacing, depth;
    size_t repeat;
    double (*at)(const struct block *block, const double at[BL_AXES]);
    const bl_signal *inner;
    bl_test_view *view;
} block;

// --- values ---

// Box and Muller: many times faster than by inversion, and as normal.
static double normal_of(uint64_t key) {
    bl_random random = {.key = bl_mix(key), .counter = 0};
    double radius = sqrt(-2 * log(1 - bl_random_unit(&random)));
    return radius * cos(2 * M_PI * bl_random_unit(&random));
}

static double white(const block *b, const double at[BL_AXES]) {
    uint64_t key = bl_mix(b->seed);
    for (int a = 0; a < 3; a++) {
        uint64_t bits;
        double x = at[a] + 0.0; // -0 and 0 are one place
        memcpy(&bits, &x, sizeof bits);
        key = bl_mix(key ^ bits) + BL_GOLDEN;
    }
    return normal_of(key);
}

// Of a cell or a sample; places that no integer has are one.
static uint64_t index_of(double x) {
    return fabs(x) < 0x1p62 ? (uint64_t)llround(x) : 0;
}

static double white_image(const block *b, const double at[BL_AXES]) {
    uint64_t column = index_of(at[0] / b->spacing);
    uint64_t row = index_of(at[1] / b->spacing) / b->repeat;
    return normal_of(bl_stream(bl_stream(b->seed, row), column));
}

static double cosine(const block *b, const double at[BL_AXES]) {
    double phase = (double)(bl_mix(b->seed) >> 11) * 0x1p-53, sum = phase;
    for (int a = 0; a < 3; a++)
        sum += b->frequency[a] * at[a];
    return b->mean + b->amplitude * cos(2 * M_PI * (sum - floor(sum)));
}

static double hat(const block *b, const double at[BL_AXES]) {
    double cell = floor(at[0]), t = at[0] - cell;
    uint64_t index = index_of(cell);
    return (1 - t) * normal_of(bl_stream(b->seed, index)) +
           t * normal_of(bl_stream(b->seed, index + 1));
}

static double flicker(const block *b, const double at[BL_AXES]) {
    bl_random random = bl_random_seed(b->seed, 7);
    double gain = bl_random_unit(&random) < 0.5 ? 1 - b->depth : 1 + b->depth;
    return gain * white(b, at);
}

static double constant(const block *b, const double at[BL_AXES]) {
    (void)at;
    return b->mean;
}

static double broken(const block *b, const double at[BL_AXES]) {
    (void)b;
    return at[0] > 0 ? NAN : 0;
}

static double seen(const block *b, const double at[BL_AXES]) {
    return b->view(b->inner, at);
}

// --- abilities ---

static double value(const void *parameters, const double at[BL_AXES]) {
    const block *b = parameters;
    return b->at(b, at);
}

static void row(const void *parameters, const double start[BL_AXES], const double step[BL_AXES],
                size_t count, float *out) {
    for (size_t i = 0; i < count; i++) {
        double at[BL_AXES];
        for (int a = 0; a < BL_AXES; a++)
            at[a] = start[a] + (double)i * step[a];
        out[i] = (float)value(parameters, at);
    }
}

static void points(const void *parameters, const double *const at[BL_AXES], size_t count,
                   float *out) {
    for (size_t i = 0; i < count; i++) {
        double p[BL_AXES] = {at[0][i], at[1][i], at[2][i], at[3][i]};
        out[i] = (float)value(parameters, p);
    }
}

// The cubic B-spline, times one for lags across x: the hat repeats along y and z.
static double hat_covariance(const void *parameters, const double lag[BL_AXES]) {
    (void)parameters;
    double t = fabs(lag[0]);
    if (t >= 2)
        return 0;
    return t < 1 ? 2.0 / 3 - t * t * (1 - 0.5 * t) : (2 - t) * (2 - t) * (2 - t) / 6;
}

static const bl_signal_functions functions = {.row = row, .points = points, .value = value};
static const bl_signal_functions hat_functions = {
    .row = row, .points = points, .value = value, .covariance = hat_covariance};

static bl_signal *make(block b, const bl_signal_functions *with, const char *text) {
    bl_signal *signal = bl_signal_new(with, &b, sizeof b, text);
    signal->dimensions = 3;
    signal->seed_offset = offsetof(block, seed);
    return signal;
}

bl_signal *bl_test_white(uint64_t seed) {
    bl_signal *signal = make((block){.seed = seed, .at = white}, &functions, "white");
    signal->facts.variance = 1;
    return signal;
}

static bl_signal *make_image(block b, size_t width, size_t height, const char *text) {
    bl_signal *signal = make(b, &functions, text);
    signal->seed_offset = SIZE_MAX;
    signal->dimensions = height ? 2 : 1;
    signal->extent = (bl_extent){{width, height}, {b.spacing, height ? b.spacing : 0}};
    return signal;
}

bl_signal *bl_test_white_image(uint64_t seed, size_t width, size_t height, double spacing) {
    block b = {.seed = seed, .spacing = spacing, .repeat = 1, .at = white_image};
    return make_image(b, width, height, "white.exr");
}

bl_signal *bl_test_streaky_image(uint64_t seed, size_t width, size_t height, size_t repeat) {
    block b = {.seed = seed, .spacing = 1, .repeat = repeat, .at = white_image};
    return make_image(b, width, height, "streaky.exr");
}

bl_signal *bl_test_cosine(double mean, double amplitude, const double frequency[3]) {
    block b = {.mean = mean, .amplitude = amplitude, .at = cosine};
    memcpy(b.frequency, frequency, sizeof b.frequency);
    bl_signal *signal = make(b, &functions, "cosine");
    signal->facts.variance = 0.5 * amplitude * amplitude;
    return signal;
}

bl_signal *bl_test_hat(uint64_t seed) {
    bl_signal *signal = make((block){.seed = seed, .at = hat}, &hat_functions, "hat");
    signal->closed_form = 1;
    signal->dimensions = 1;
    signal->facts.variance = 2.0 / 3;
    signal->facts.covariance_reach = 2;
    return signal;
}

bl_signal *bl_test_flicker(double depth) {
    return make((block){.depth = depth, .at = flicker}, &functions, "flicker");
}

bl_signal *bl_test_constant(double level) {
    return make((block){.mean = level, .at = constant}, &functions, "constant");
}

bl_signal *bl_test_broken(void) {
    return make((block){.at = broken}, &functions, "broken");
}

bl_signal *bl_test_seen_through(const bl_signal *inner, bl_test_view *view) {
    block b = {.at = seen, .inner = inner, .view = view};
    bl_signal *signal = make(b, &functions, "seen-through");
    signal->dimensions = inner->dimensions;
    signal->seed_offset = SIZE_MAX;
    return signal;
}

bl_signal *bl_test_built(const bl_signal_functions *with, const void *parameters, size_t size,
                         size_t seed_offset, const char *text) {
    bl_message message = {""};
    bl_signal *signal = bl_signal_new(with, parameters, size, text);
    if (!signal || bl_signal_build(signal, &message) != BL_OK)
        fail_msg("%s: %s", text, signal ? message.text : "out of memory");
    signal->seed_offset = seed_offset;
    signal->dimensions = 3;
    signal->facts = bl_facts_unknown();
    signal->facts.cell = 1;
    return signal;
}
