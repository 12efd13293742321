// SPDX-License-Identifier: MIT
//
// fractalsum: a sum of octaves of a noise, each twice as fine and half as strong.
//
//   n(p) = sum over f = min, 2 min, 4 min, ... < max of  basis(p f) / f
//
// Parameters
//   seed    64 bits, the seed of the basis
//   basis   any noise, with its settings as basis.KEY (but for seed); default gnoise
//   min     frequency of the first octave, cells of the basis a unit, 1/256 to 4096; default 1
//   max     octaves end below it, 1/256 to 4096; default 16; the sum is 0 if max <= min
//   seeds   fresh: each octave has its own numbers; same: all have those of the seed, as in the
//           text, and meet at the origin, where the sum is the basis times the sum of the 1/f,
//           1.875, and its variance 2.65 times that elsewhere; default same
//   width   units between samples, 0 to inf; default 0, which keeps all octaves
//   clamp   fade, hard or none: how octaves beyond 1/(2 width) go (noises/octaves/octaves.h); what
//           goes leaves the mean of the basis, which is 0 for most
//
// Units: those in which min = 1 is one cell of the basis. Frequencies are powers of two times min,
// so for min a power of two p f is exact.
// Bound: the sum of 1/f times the bound of the basis, because |sum| <= sum of sizes.
// Mean: the sum of 1/f times the mean of the basis. Variance, covariance, density: the sum over
// octaves, which are uncorrelated (noises/octaves/octaves.h), of those of basis(p f)/f: v/f^2,
// R(lag f)/f^2 and P(u/f)/f^(2 + dims). They hold at a random place; around the origin octaves
// meet, unless seeds=fresh: p = 0 is a lattice point of all of them.
// Band: up to the highest octave's frequency times the band of the basis; the exact share above.
// Class of continuity, direction and stationarity are those of the basis. Period: that of the basis
// in the first octave, 1/min of its own. Far: where the highest octave loses its fraction.
// A NaN, an infinity, a coordinate beyond 2^62, or one that times the highest frequency is, gives
// NaN, as does any coordinate at which the basis is NaN.
//
// Known defects: lattice points of octaves coincide, and a zero of gnoise at all integers is one of
// the sum; fbm has offsets, rotations and other ratios of frequency.
// Source: peachey2003, sections Spectral Synthesis (at figure 2.38) and Clamping. Deviations: those
// of the clamping, in noises/octaves/octaves.h.
#include <stddef.h>

#include "noises/noise.h"
#include "noises/octaves/octaves_loops.h"
#include "noises/textbook_loops.h"

typedef struct fractal_parameters {
    bl_octaves_settings sum;
    double least, most;
    uint32_t seeds;
} fractal_parameters;

static bl_status build(void *block, bl_opener *open, bl_message *message) {
    fractal_parameters *p = block;
    bl_octaves_plan plan = bl_octaves_plan_between(p->least, p->most);
    const bl_octaves_rules rules = {.fold = BL_FOLD_NONE, .fresh = p->seeds == 0};
    return bl_octaves_build(&p->sum, &plan, &rules, open, message);
}

static const bl_parameter parameters[] = {BL_OCTAVES_PARAMETERS(fractal_parameters, sum),
                                          BL_OCTAVES_SPAN_PARAMETERS(fractal_parameters),
                                          BL_OCTAVES_SEEDS_PARAMETER(fractal_parameters, "same"),
                                          {0}};

static float textbook(float x, float y, float z) {
    float sum = 0;
    for (float f = 1; f < 16; f *= 2)
        sum += bl_textbook_gradient(x * f, y * f, z * f) / f;
    return sum;
}

BL_NOISE_DESCRIPTOR(fractal_sum) = {
    .name = "fractalsum",
    .title = "fractal sum",
    .summary = "Octaves of a noise, each twice as fine and half as strong.",
    .formula = "n(p) = sum_{f = min, 2 min, ... < max} basis(p f) / f",
    .paper = "peachey2003, figure 2.38",
    .dimensions = 3,
    .dimensions_of = bl_octaves_dimensions,
    .parameters = parameters,
    .parameters_size = sizeof(fractal_parameters),
    .describe = bl_octaves_describe,
    .has_closed_form = bl_octaves_has_closed_form,
    .textbook = textbook,
    .textbook_settings = BL_TEXTBOOK_OCTAVES,
    .functions = {BL_OCTAVES_FUNCTIONS, .covariance = bl_octaves_covariance,
                  .density = bl_octaves_density, .build = build},
};
