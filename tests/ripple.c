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

static double filtered(const void *block, const double at[BL_AXES], const double width[BL_AXES]) {
    const ripple_parameters *p = block;
    double wave = p->amplitude * cos(2 * M_PI * (p->fx * at[0] + p->fy * at[1]));
    if (p->filter > 0)
        wave *= sinc(p->fx * width[0]) * sinc(p->fy * width[1]);
    return p->mean + (p->filter == 2 ? wave * 2 / 3 : wave);
}

static double value(const void *block, const double at[BL_AXES]) {
    static const double none[BL_AXES] = {0};
    return filtered(block, at, none);
}

static void describe(const void *block, bl_facts *facts) {
    (void)block;
    *facts = bl_facts_unknown();
}

static const char *const words[] = {"none", "exact", "wrong", NULL};
#define NUMBER(field)                                                                              \
    {                                                                                              \
        .key = #field, .kind = BL_REAL, .offset = offsetof(ripple_parameters, field),              \
        .minimum = -1e6, .maximum = 1e6, .fallback = "0", .unit = "", .help = ""                   \
    }
static const bl_parameter parameters[] = {NUMBER(mean),
                                          NUMBER(amplitude),
                                          NUMBER(fx),
                                          NUMBER(fy),
                                          {.key = "filter",
                                           .kind = BL_CHOICE,
                                           .offset = offsetof(ripple_parameters, filter),
                                           .choices = words,
                                           .fallback = "none",
                                           .unit = "",
                                           .help = ""},
                                          {.key = NULL}};

static const bl_definition ripple = {.name = "ripple",
                                     .title = "",
                                     .summary = "",
                                     .formula = "",
                                     .paper = "",
                                     .dimensions = 2,
                                     .parameters = parameters,
                                     .parameters_size = sizeof(ripple_parameters),
                                     .seed_offset = SIZE_MAX,
                                     .describe = describe,
                                     .functions = {.value = value, .filtered = filtered}};

bl_signal *bl_test_ripple(double mean, double amplitude, double fx, double fy) {
    char text[160];
    bl_spec spec;
    bl_signal *signal;
    snprintf(text, sizeof text, "ripple:mean=%.17g,amplitude=%.17g,fx=%.17g,fy=%.17g", mean,
             amplitude, fx, fy);
    assert_int_equal(bl_spec_parse(text, &spec, NULL), BL_OK);
    assert_int_equal(bl_definition_open(&ripple, &spec, text, &signal, NULL), BL_OK);
    bl_spec_free(&spec);
    return signal;
}
