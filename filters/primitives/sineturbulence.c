// SPDX-License-Identifier: MIT
//
// sineturbulence: the turbulence of the text with a sine in the place of the noise.
//
//   sineturbulence(x) = sum over f = min, 2 min, 4 min, ... < max of |sin(2 pi f x)| / f
//   filtered: each |sin| has the exact mean of whole half waves and a rest under the box; other
//   filters see filters/average.h, with the series of |sin|
//
// Parameters
//   min, max                cycles per unit, 0 < min; the least frequency, and where the sum ends.
//                           max <= min leaves an empty sum, 0
//   width, filter, anchor   how it is averaged (filters/primitive.h). The ideal filter, which has
//                           no end, is refused for widths below 1/8192 of a half wave
//
// f x is exact as long as f is a power of two; the reduction by half waves is exact always.
// Bound: 0 and the sum of all 1/f; none for filters with negative lobes. The kinks make it C0, and
// its spectrum has no end: |sin| has all even harmonics. Infinite width: 2/pi times the sum of 1/f.
// NaN and infinite x give NaN. Source: peachey2003, p. 87.
#include "filters/average.h"
#include "filters/primitive.h"

#include <math.h>

typedef struct sineturbulence_parameters {
    double min, max;
    bl_averaging averaging;
} sineturbulence_parameters;

static double half_wave(double u) {
    return sin(M_PI * u);
}

// The integral of sin(pi u) over [m - h/2, m + h/2] is (2 / pi) sin(pi m) sin(pi h / 2).
static double half_wave_mean(double from, double length) {
    double middle = sin(M_PI * (from + 0.5 * length)), angle = 0.5 * M_PI * length;
    return angle < 1e-9 ? middle : middle * (sin(angle) / angle);
}

// |sin(pi u)| = 2/pi - (4/pi) sum of cos(2 pi n u) / (4 n^2 - 1)
static void series(double n, double *c, double *s) {
    *c = -4 / (M_PI * (4 * n * n - 1));
    *s = 0;
}

static double average(const sineturbulence_parameters *p, const bl_filter *filter, double x,
                      double width) {
    static const bl_wave wave = {
        .value = half_wave, .mean = half_wave_mean, .average = 2 / M_PI, .series = series};
    double sum = 0;
    if (isnan(width) || isnan(x) || (isinf(x) && !isinf(width)))
        return NAN;
    for (double f = p->min; f < p->max; f *= 2) {
        double half = 0.5 / f; // of a wave, in units
        double u = isinf(width) ? 0 : bl_periods(x, half);
        sum +=
            (width == 0 ? half_wave(fabs(u)) : bl_average_wave(filter, &wave, u, width / half)) / f;
    }
    return sum;
}

BL_PRIMITIVE_ABILITIES(sineturbulence_parameters)

static double sum_of_sizes(const sineturbulence_parameters *p) {
    double sum = 0;
    for (double f = p->min; f < p->max; f *= 2)
        sum += 1 / f;
    return sum;
}

static bl_status validate(const void *block, bl_message *message) {
    const sineturbulence_parameters *p = block;
    return bl_check_averaging(bl_filter_at(p->averaging.filter), p->averaging.width, 0.5 / p->min,
                              message);
}

static void describe(const void *block, bl_facts *facts) {
    const sineturbulence_parameters *p = block;
    *facts = bl_facts_unknown();
    if (bl_averaging_keeps_bounds(&p->averaging)) {
        facts->lower = 0;
        facts->upper = sum_of_sizes(p) * (1 + 1e-15);
        facts->bound_proof = "every term is at most 1/f, and a nowhere negative kernel averages it";
    }
    facts->mean = 2 / M_PI * sum_of_sizes(p);
    facts->continuity = bl_averaging_continuity(&p->averaging, 0);
    bl_primitive_period(facts, p->min < p->max ? 0.5 / p->min : 0);
}

static const bl_parameter parameters[] = {
    {"min", BL_REAL, offsetof(sineturbulence_parameters, min), "1", "cycles per unit",
     .minimum = 1e-9, .maximum = 1e9, .help = "the least frequency"},
    {"max", BL_REAL, offsetof(sineturbulence_parameters, max), "16", "cycles per unit",
     .minimum = 0, .maximum = 1e9, .help = "where the sum ends, not included"},
    BL_AVERAGING_PARAMETERS(sineturbulence_parameters),
    {0}};

BL_PRIMITIVE_DESCRIPTOR(sineturbulence) = {
    .name = "sineturbulence",
    .title = "turbulence of sines",
    .summary = "Sizes of sines of doubling frequencies, over the frequency.",
    .formula = "sum of |sin(2 pi f x)| / f, f = min, 2 min, ... < max",
    .paper = "peachey2003, p. 87",
    .validate = validate,
    BL_PRIMITIVE_PARTS(sineturbulence_parameters)};
