// SPDX-License-Identifier: MIT
//
// pulse: 1 from `low` up to `high`, else 0, once in each period.
//
//   pulse(x) = step(x - low) - step(x - high) for period=inf, the pulse of the text, and
//              the sum of pulse(x - k period) over all whole k else: the pattern of bricks, stripes
//   filtered: filters/pulse_train.h; of a single pulse the integral of the kernel over it
//
// Parameters
//   low, high               the edges, any finite numbers. Reversed they make pulses of -1 from
//                           high up to low, as the difference says; equal edges make 0
//   period                  after which it repeats, inf for a single pulse. A pulse as long as the
//                           period is the constant 1. A negative one mirrors the train
//   width, filter, anchor   how it is averaged (filters/primitive.h)
//
// x modulo the period is exact at any distance (C's fmod is). Bound: 0 and 1 (or -1 and 0); none
// for filters with negative lobes. Infinite width: the mean, (high - low) / period, 0 of a single
// pulse. NaN gives NaN; infinite x gives NaN, of a single pulse 0.
// Source: peachey2003, p. 27, 32 and 68. Deviation: the text divides by the period first, so that
// its edges are parts of it; here they are in the units of x.
#include "filters/average.h"
#include "filters/primitive.h"
#include "filters/pulse_train.h"

#include <math.h>

typedef struct pulse_parameters {
    double low, high, period;
    bl_averaging averaging;
} pulse_parameters;

static double one(const void *block, size_t span, double x) {
    (void)block, (void)span, (void)x;
    return 1;
}

static double one_mean(const void *block, size_t span, double from, double length) {
    (void)block, (void)span, (void)from, (void)length;
    return 1;
}

// Much wider than the pulse, the difference of two steps keeps few digits of what is left: there it
// is the integral of the kernel over the pulse.
static double single(const double knot[2], const bl_filter *filter, double x, double width) {
    if (isinf(x) || isinf(width))
        return 0;
    if (width == 0)
        return x >= knot[0] && x < knot[1];
    if (knot[1] - knot[0] >= width)
        return filter->step((x - knot[0]) / width) - filter->step((x - knot[1]) / width);
    const bl_spans spans = {.knot = knot, .count = 2, .value = one, .mean = one_mean};
    return bl_average_spans(filter, &spans, x, width);
}

// The share of the period that is not 0.
static double duty(const pulse_parameters *p) {
    return fmin(1, fabs(p->high - p->low) / fabs(p->period));
}

static double average(const pulse_parameters *p, const bl_filter *filter, double x, double width) {
    if (isnan(x) || isnan(width))
        return NAN;
    double sign = p->low <= p->high ? 1 : -1, period = fabs(p->period);
    const double knot[2] = {fmin(p->low, p->high), fmax(p->low, p->high)};
    if (isinf(period))
        return sign * single(knot, filter, p->period < 0 ? -x : x, width);
    double share = duty(p);
    if (isinf(width))
        return sign * share;
    double u = bl_periods(p->period < 0 ? -x : x, period) - bl_periods(knot[0], period);
    return sign * bl_pulse_train_average(filter, 0, share, u, width / period);
}

BL_PRIMITIVE_ABILITIES(pulse_parameters)

static bl_status validate(const void *block, bl_message *message) {
    const pulse_parameters *p = block;
    if (p->period == 0)
        return bl_report(message, BL_USAGE,
                         "period=0: there is nothing that could repeat; inf is a single pulse");
    return isinf(p->period) ? BL_OK
                            : bl_check_averaging(bl_filter_at(p->averaging.filter),
                                                 p->averaging.width, fabs(p->period), message);
}

static void describe(const void *block, bl_facts *facts) {
    const pulse_parameters *p = block;
    double share = duty(p), sign = p->low <= p->high ? 1 : -1;
    *facts = bl_facts_unknown();
    if (bl_averaging_keeps_bounds(&p->averaging)) {
        facts->lower = p->low > p->high ? -1 : 0;
        facts->upper = p->low < p->high ? 1 : 0;
        facts->bound_proof = "it has two values, and a nowhere negative kernel averages them";
    }
    facts->mean = sign * share;
    if (p->averaging.width == 0)
        facts->variance = share * (1 - share);
    facts->continuity = bl_averaging_continuity(&p->averaging, -1);
    bl_primitive_period(facts, isinf(p->period) ? 0 : fabs(p->period));
}

static const bl_parameter parameters[] = {
    BL_PRIMITIVE_REAL(pulse_parameters, low, "0.4", "where each pulse begins"),
    BL_PRIMITIVE_REAL(pulse_parameters, high, "0.6", "where each pulse ends"),
    {"period", BL_REAL, offsetof(pulse_parameters, period), "1", "units", .minimum = -1e300,
     .maximum = INFINITY, .help = "after which it repeats; inf: never"},
    BL_AVERAGING_PARAMETERS(pulse_parameters),
    {0}};

BL_PRIMITIVE_DESCRIPTOR(pulse) = {.name = "pulse",
                                  .title = "periodic pulse",
                                  .summary = "1 between two edges, else 0, once in each period.",
                                  .formula = "low <= x - k period < high for a whole k",
                                  .paper = "peachey2003, p. 27 and 32",
                                  .validate = validate,
                                  BL_PRIMITIVE_PARTS(pulse_parameters)};
