// SPDX-License-Identifier: MIT
#include "tests/ripple.h"

#include <math.h>

#include "core/definition.h"
#include "tests/test.h"

typedef struct ripple_parameters {
    double mean, amplitude, fx, fy;
    uint32_t filter;
} ripple_parameters;

static double sinc(double f) {
    return f == 0 ? 1 : sin(M_PI * f) / (M_PI * f);
}

static void filtered(const void *block, const bl_samples *samples, double *out) {
    const ripple_parameters *p = block;
    for (size_t i = 0; i < samples->count; i++) {
        const double *width = bl_samples_footprint(samples, i)->width;
        double turns = p->fx * samples->at[0][i] + p->fy * samples->at[1][i];
        double wave = p->amplitude * cos(2 * M_PI * turns);
        if (p->filter > 0)
            wave *= sinc(p->fx * width[0]) * sinc(p->fy * width[1]);
        out[i] = p->mean + (p->filter == 2 ? wave * 2 / 3 : wave);
    }
}

static void values(const void *block, const double *const at[BL_AXES], size_t count, double *out) {
    bl_values_of_width(filtered, block, 0, at, count, out);
}

static void describe(const void *block, bl_facts *facts) {
    (void)block;
    *facts = bl_facts_unknown();
}

static const char *const words[] = {"none", "exact", "wrong", NULL};
// clang-format off
#define NUMBER(field)                                                                              \
    {#field, BL_REAL, offsetof(ripple_parameters, field), "0", "", .minimum = -1e6,                \
     .maximum = 1e6, .help = ""}
// clang-format on
static const bl_parameter parameters[] = {NUMBER(mean),
                                          NUMBER(amplitude),
                                          NUMBER(fx),
                                          NUMBER(fy),
                                          {"filter", BL_CHOICE, offsetof(ripple_parameters, filter),
                                           "none", "", .choices = words, .help = ""},
                                          {0}};

static const bl_definition ripple = {.name = "ripple",
                                     .title = "",
                                     .summary = "",
                                     .formula = "",
                                     .paper = "",
                                     .dimensions = 2,
                                     .parameters = parameters,
                                     .parameters_size = sizeof(ripple_parameters),
                                     .describe = describe,
                                     .functions = {.values = values, .filtered = filtered}};

bl_signal *bl_test_ripple(double mean, double amplitude, double fx, double fy) {
    char text[160];
    bl_spec spec;
    bl_signal *signal;
    snprintf(text, sizeof text, "ripple:mean=%.17g,amplitude=%.17g,fx=%.17g,fy=%.17g", mean,
             amplitude, fx, fy);
    assert_int_equal(bl_spec_parse(text, &spec, NULL), BL_OK);
    assert_int_equal(bl_definition_open(&ripple, &spec, text, NULL, &signal, NULL), BL_OK);
    bl_spec_free(&spec);
    return signal;
}
