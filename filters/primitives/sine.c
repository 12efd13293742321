// SPDX-License-Identifier: MIT
//
// sine: one frequency.
//
//   sine(x) = sin(2 pi (frequency x + phase)); a cosine has the phase 1/4
//   filtered: times the response of the filter at frequency * width, exactly
//
// Parameters
//   frequency               cycles per unit, any finite number; 0 is a constant
//   phase                   cycles
//   width, filter, anchor   how it is averaged (filters/primitive.h)
//
// The phase is reduced before it is rounded: with the error of the product frequency * x, which a
// fused multiplication gives, it is good at any distance. Bound: -1 and 1; filtered, the size of
// the response. Infinite width: 0, the mean. NaN and infinite x give NaN,
// and so does a product beyond the range of double.
// Source: peachey2003, p. 30.
#include "filters/primitive.h"

#include <math.h>

typedef struct sine_parameters {
    double frequency, phase;
    bl_averaging averaging;
} sine_parameters;

// How much is left of the wave.
static double share(const sine_parameters *p, const bl_filter *filter, double width) {
    return width == 0 || p->frequency == 0 ? 1
           : isinf(width)                  ? 0
                                           : filter->response(fabs(p->frequency) * width);
}

static double average(const sine_parameters *p, const bl_filter *filter, double x, double width) {
    if (isinf(width) && p->frequency != 0 && !isnan(x))
        return 0;
    double cycles = p->frequency * x, error = fma(p->frequency, x, -cycles);
    if (isnan(width) || !isfinite(x) || !isfinite(cycles))
        return p->frequency == 0 && isinf(x) && !isnan(width)
                   ? sin(2 * M_PI * remainder(p->phase, 1))
                   : NAN;
    double phase = remainder(cycles, 1) + remainder(error, 1) + remainder(p->phase, 1);
    return share(p, filter, width) * sin(2 * M_PI * remainder(phase, 1));
}

BL_PRIMITIVE_ABILITIES(sine_parameters)

static void describe(const void *block, bl_facts *facts) {
    const sine_parameters *p = block;
    double left = share(p, bl_filter_at(p->averaging.filter), p->averaging.width);
    *facts = bl_facts_unknown();
    double constant = sin(2 * M_PI * remainder(p->phase, 1));
    facts->lower = p->frequency != 0 ? -fabs(left) : constant;
    facts->upper = p->frequency != 0 ? fabs(left) : constant;
    facts->bound_proof = "it is a sine, times the response of the filter";
    facts->mean = p->frequency != 0 ? 0 : constant;
    facts->variance = p->frequency != 0 ? 0.5 * left * left : 0;
    facts->continuity = 99;
    bl_primitive_period(facts, p->frequency != 0 ? 1 / fabs(p->frequency) : 0);
}

static const bl_parameter parameters[] = {
    {"frequency", BL_REAL, offsetof(sine_parameters, frequency), "1", "cycles per unit",
     .minimum = -1e300, .maximum = 1e300, .help = "of the wave"},
    {"phase", BL_REAL, offsetof(sine_parameters, phase), "0", "cycles", .minimum = -1e300,
     .maximum = 1e300, .help = "at 0; 1/4 makes a cosine"},
    BL_AVERAGING_PARAMETERS(sine_parameters),
    {0}};

BL_PRIMITIVE_DESCRIPTOR(sine) = {.name = "sine",
                                 .title = "sine",
                                 .summary = "One frequency.",
                                 .formula = "sin(2 pi (frequency x + phase))",
                                 .paper = "peachey2003, p. 30",
                                 BL_PRIMITIVE_PARTS(sine_parameters)};
