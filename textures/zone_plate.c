// SPDX-License-Identifier: MIT
//
// zoneplate: rings that get finer outwards, so that every frequency and direction is somewhere.
//
//   grey = (1 + cos(pi k r^2)) / 2,  r^2 = s^2 + t^2; the frequency at (s, t) is k (s, t)
//
// Parameters
//   chirp    k, cycles per unit, per unit; default 100, that of hart1999
//   filter   none
//            fade      the contrast goes to 0 between half the Nyquist limit of the width and the
//                      limit, by the frequency k r of the place
//            gaussian  exact average under the filter `gaussian` (filters/gaussian.c), of standard
//                      deviation sigma = width/2 along each axis: cos is the real part of e(s)
//                      e(t), and each e becomes
//                          exp(i pi k s^2 / d) / sqrt(d),  d = 1 - 2 pi i k sigma^2
//            exact     the box average: each e becomes a difference of Fresnel integrals over the
//                      width
//   width, component   see textures/texture.h
//
// Bound: 0 and 1. Mean over the plane: 1/2. Period: none. All derivatives. Rings lose their
// phase where k r^2 reaches 2^52. NaN and infinite places give NaN.
//
// Accuracy of exact: each Fresnel integral is good to 1e-15, so the average to 1e-15 / (width
// sqrt(2 k)) at worst; below a width of 1e-7 / sqrt(2 k) the point's value is given, which is off
// by (k s width)^2 pi^2/6 at most.
//
// Source: hart1999, section 3.4 (as a test of filters); abramowitz1964, 7.3 and 7.1.14.
#include "textures/texture.h"

#include <complex.h>
#include <math.h>

#include "filters/octave_fade.h"
#include "textures/sampling.h"

typedef struct zone_plate_parameters {
    double chirp;
    bl_seeing seeing;
} zone_plate_parameters;

enum { NONE, FADE, GAUSSIAN, EXACT };
static const char *const filter_words[] = {"none", "fade", "gaussian", "exact", NULL};

// exp(i pi t), of a phase that is reduced before it is rounded.
static double complex turn(double t) {
    double reduced = remainder(t, 2);
    return cos(M_PI * reduced) + I * sin(M_PI * reduced);
}

// The integral of exp(i pi u^2 / 2) from 0 to z, |z| <= 2, by its power series: the terms fall from
// (2 pi)^n / n! on, so 60 are more than enough, and the largest, 85, costs two digits.
static double complex fresnel_series(double z) {
    double complex term = z, sum = 0, factor = 0.5 * I * M_PI * z * z;
    for (int n = 0; n < 60; n++) {
        sum += term / (2 * n + 1);
        term *= factor / (n + 1);
    }
    return sum;
}

// The integral of the same from z to infinity, z > 2: (1 + i)/2 erfc(w), w = sqrt(pi)/2 (1 - i) z,
// by the continued fraction of erfc in w^2, which 64 steps make good to rounding here.
static double complex fresnel_tail(double z) {
    double complex w = 0.5 * sqrt(M_PI) * (1 - I) * z, fraction = 2 * w * w + 1 + 4 * 64;
    for (int n = 64; n > 0; n--)
        fraction = 2 * w * w + 1 + 4 * (n - 1) - (2.0 * n - 1) * (2.0 * n) / fraction;
    return 0.5 * (1 + I) * turn(0.5 * z * z) * 2 * w / (sqrt(M_PI) * fraction);
}

static double complex fresnel(double z) {
    double size = fabs(z);
    double complex integral = size <= 2 ? fresnel_series(size) : 0.5 * (1 + I) - fresnel_tail(size);
    return z < 0 ? -integral : integral;
}

// The integral from a to b; of two ends on one side, far out, the difference of two small tails.
static double complex fresnel_between(double a, double b) {
    if (a > 2 && b > 2)
        return fresnel_tail(a) - fresnel_tail(b);
    if (a < -2 && b < -2)
        return fresnel_tail(-b) - fresnel_tail(-a);
    return fresnel(b) - fresnel(a);
}

// The average of exp(i pi k x^2) for a sample of this width.
static double complex wave(const zone_plate_parameters *p, double x, double width) {
    double scale = sqrt(2 * p->chirp), sigma = 0.5 * width; // as filters/gaussian.c has it
    if (isinf(width))
        return 0;
    if (p->seeing.filter == GAUSSIAN && width > 0) {
        double complex d = 1 - 2 * M_PI * I * p->chirp * sigma * sigma;
        // exp(i pi k x^2 / d), whose phase is reduced like that of the raw form.
        double bend = 2 * M_PI * p->chirp * sigma * sigma, share = 1 / (1 + bend * bend);
        return exp(-M_PI * p->chirp * x * x * bend * share) * turn(p->chirp * x * x * share) /
               csqrt(d);
    }
    if (p->seeing.filter == EXACT && width * scale > 1e-7)
        return fresnel_between(scale * (x - 0.5 * width), scale * (x + 0.5 * width)) /
               (scale * width);
    return turn(p->chirp * x * x);
}

static bl_colour see(const zone_plate_parameters *p, const double at[BL_AXES],
                     const bl_footprint *footprint) {
    double grey = 0.5, widest = bl_footprint_widest(footprint, 2);
    if (!bl_footprint_is_whole(footprint, 2)) {
        int averaged = p->seeing.filter != NONE && p->seeing.filter != FADE;
        double cosine = creal(wave(p, at[0], averaged ? footprint->width[0] : 0) *
                              wave(p, at[1], averaged ? footprint->width[1] : 0));
        if (p->seeing.filter == FADE && widest > 0)
            cosine *= bl_octave_kept(p->chirp * hypot(at[0], at[1]), BL_CLAMP_FADE, widest);
        grey = 0.5 + 0.5 * fmin(fmax(cosine, -1), 1);
    }
    return (bl_colour){{grey, grey, grey}};
}

BL_TEXTURE_ABILITIES(zone_plate_parameters, 2)

static void describe(const void *block, bl_facts *facts) {
    const zone_plate_parameters *p = block;
    const bl_colour ends[] = {{{0, 0, 0}}, {{1, 1, 1}}};
    *facts = bl_facts_unknown();
    bl_texture_bound(facts, p->seeing.component, ends, 2, "half of 1 plus a cosine");
    facts->mean = 0.5;
    facts->continuity = p->seeing.filter == FADE && p->seeing.width > 0 ? 0 : 99;
    facts->period[0] = facts->period[1] = 0;
}

static const bl_parameter parameters[] = {{"chirp", BL_REAL, offsetof(zone_plate_parameters, chirp),
                                           "100", "cycles per unit, per unit", .minimum = 1e-6,
                                           .maximum = 1e6, .help = "how fast the rings get finer"},
                                          BL_SEEING_PARAMETERS(zone_plate_parameters, filter_words),
                                          {0}};

BL_TEXTURE_DESCRIPTOR(zone_plate) = {
    .name = "zoneplate",
    .title = "zone plate",
    .summary = "Rings that get finer outwards: every frequency in every direction.",
    .formula = "(1 + cos(pi chirp (s^2 + t^2))) / 2",
    .paper = "hart1999, section 3.4",
    .dimensions = 2,
    .parameters = parameters,
    .parameters_size = sizeof(zone_plate_parameters),
    .describe = describe,
    .picture = {.scale = 2},
    .functions = {BL_TEXTURE_FUNCTIONS}};
