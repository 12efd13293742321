// SPDX-License-Identifier: MIT
//
// mod: the remainder of x after whole periods: a sawtooth.
//
//   mod(x) = x - period floor(x / period), in [0, period); for a negative period in (period, 0],
//   so that mod(-x, -period) = -mod(x, period)
//   filtered: the box has the exact mean of whole teeth and a rest; other filters see
//   filters/average.h
//
// Parameters
//   period                  any finite number but 0
//   width, filter, anchor   how it is averaged (filters/primitive.h). The ideal filter, which has
//                           no end, is refused for widths below period / 8192
//
// Exact at any distance, as C's fmod is, except for one rounding where x and the period differ in
// sign. The text's listing casts x / period to an integer, which overflows beyond 2^31 periods
// (undefined; on usual machines the result is far out of range), and multiplies the rounded
// quotient back, which loses digits before that.
//
// Bound: 0 and period; none for filters with negative lobes. Infinite width: period / 2. NaN and
// infinite x give NaN. Source: peachey2003, p. 31.
#include "filters/average.h"
#include "filters/primitive.h"
#include "filters/sawtooth.h"

#include <math.h>

typedef struct mod_parameters {
    double period;
    bl_averaging averaging;
} mod_parameters;

static double average(const mod_parameters *p, const bl_filter *filter, double x, double width) {
    if (isinf(width) && !isnan(x))
        return 0.5 * p->period;
    if (width == 0 || !isfinite(x))
        return bl_modulo(x, p->period);
    return p->period *
           bl_sawtooth_average(filter, bl_periods(x, p->period), width / fabs(p->period));
}

BL_PRIMITIVE_ABILITIES(mod_parameters)

static bl_status validate(const void *block, bl_message *message) {
    const mod_parameters *p = block;
    if (p->period == 0)
        return bl_report(message, BL_USAGE, "period=0: there is no remainder");
    return bl_check_averaging(bl_filter_at(p->averaging.filter), p->averaging.width,
                              fabs(p->period), message);
}

static void describe(const void *block, bl_facts *facts) {
    const mod_parameters *p = block;
    *facts = bl_facts_unknown();
    if (bl_averaging_keeps_bounds(&p->averaging)) {
        facts->lower = fmin(p->period, 0);
        facts->upper = fmax(p->period, 0);
        facts->bound_proof =
            "a remainder is less than the period, and a nowhere negative kernel "
            "averages it";
    }
    facts->mean = 0.5 * p->period;
    if (p->averaging.width == 0)
        facts->variance = p->period * p->period / 12;
    facts->continuity = bl_averaging_continuity(&p->averaging, -1);
    bl_primitive_period(facts, fabs(p->period));
}

static const bl_parameter parameters[] = {
    BL_PRIMITIVE_REAL(mod_parameters, period, "1", "after which it begins again"),
    BL_AVERAGING_PARAMETERS(mod_parameters),
    {0}};

BL_PRIMITIVE_DESCRIPTOR(mod) = {.name = "mod",
                                .title = "modulo",
                                .summary = "What is left of x after whole periods: a sawtooth.",
                                .formula = "x - period floor(x / period)",
                                .paper = "peachey2003, p. 31",
                                .validate = validate,
                                BL_PRIMITIVE_PARTS(mod_parameters)};
