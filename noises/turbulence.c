// SPDX-License-Identifier: MIT
//
// turbulence: a sum of the sizes of octaves of a noise, each twice as fine and half as strong.
//
//   n(p) = sum over f = min, 2 min, 4 min, ... < max of  |basis(p f)| / f
//
// Parameters
//   seed, basis, min, max, width, clamp   as in fractalsum, of which see the head
//   lost    what a removed octave leaves (noises/octaves/octaves.h): mean, its mean E|basis| / f,
//           so that the sum keeps its mean at every width; or zero, as in the text, so that it gets
//           darker with distance
//
// Units and domain are those of fractalsum. Bound: between 0 and the sum of 1/f times the bound of
// the basis. Mean: the sum of E|basis|/f, which has no known closed form and so is not stated;
// lost=mean measures E|basis| on opening (noises/octaves/octaves.h). Variance, band: not stated;
// the folds have a spectrum of their own, which falls as f^-4 at a random crossing of 0 and is not
// bounded by the octave's.
// Class C0: the slope jumps wherever an octave crosses 0; that of a basis that is never negative
// (rayshade), whose sizes are its values. Period: as for fractalsum, and a fold may
// only shorten it for a basis whose half period is its negative.
//
// Source: peachey2003, section Spectral Synthesis (at figure 2.38), both versions. Deviations: the
// text removes octaves to zero (lost=zero); that of the clamping in noises/octaves/octaves.h.
#include <math.h>
#include <stddef.h>

#include "noises/noise.h"
#include "noises/octaves/octaves_loops.h"
#include "noises/textbook_loops.h"

typedef struct turbulence_parameters {
    bl_octaves_settings sum;
    double least, most;
    uint32_t lost, seeds;
} turbulence_parameters;

static bl_status build(void *block, bl_opener *open, bl_message *message) {
    turbulence_parameters *p = block;
    bl_octaves_plan plan = bl_octaves_plan_between(p->least, p->most);
    const bl_octaves_rules rules = {
        .fold = BL_FOLD_SIZE, .lost_to_zero = (int)p->lost, .fresh = p->seeds == 0};
    return bl_octaves_build(&p->sum, &plan, &rules, open, message);
}

static const char *const losses[] = {"mean", "zero", NULL};

static const bl_parameter parameters[] = {
    BL_OCTAVES_PARAMETERS(turbulence_parameters, sum),
    BL_OCTAVES_SPAN_PARAMETERS(turbulence_parameters),
    BL_OCTAVES_SEEDS_PARAMETER(turbulence_parameters, "same"),
    {"lost", BL_CHOICE, offsetof(turbulence_parameters, lost), "mean", "", .choices = losses,
     .help = "what a removed octave leaves: its mean, or zero as in the text"},
    {0}};

static float textbook(float x, float y, float z) {
    float sum = 0;
    for (float f = 1; f < 16; f *= 2)
        sum += fabsf(bl_textbook_gradient(x * f, y * f, z * f)) / f;
    return sum;
}

BL_NOISE_DESCRIPTOR(turbulence) = {
    .name = "turbulence",
    .title = "turbulence",
    .summary = "Sizes of octaves of a noise, each twice as fine and half as strong.",
    .formula = "n(p) = sum_{f = min, 2 min, ... < max} |basis(p f)| / f",
    .paper = "peachey2003, figure 2.38",
    .dimensions = 3,
    .dimensions_of = bl_octaves_dimensions,
    .parameters = parameters,
    .parameters_size = sizeof(turbulence_parameters),
    .describe = bl_octaves_describe,
    .textbook = textbook,
    .textbook_settings = BL_TEXTBOOK_OCTAVES,
    .functions = {BL_OCTAVES_FUNCTIONS, .build = build},
};
