// SPDX-License-Identifier: MIT
//
// ridged: a multifractal sum of ridges, each octave weighted by the one before, after Musgrave.
//
//   n(p) = sum over i = 0 .. octaves-1 of  s_i / f_i,   f_i = lacunarity^i
//   s_i  = w_i (offset - |basis(p f_i)|)^2
//   w_0  = 1,   w_i = min(1, gain s_{i-1})
//
// Parameters
//   seed, basis, width, clamp   as in fractalsum, of which see the head; one seed for all octaves
//   octaves     1 to 12; default 4
//   lacunarity  1 to 8; default 2
//   gain        0 to 4; default 2: how far an octave below its full height silences the next
//   offset      1/2 to 2; default 1: the height of the ridges, where the basis crosses 0
//
// Clamping. A removed octave has its mean height E (offset - |basis|)^2, measured on opening
// (noises/octaves/octaves.h), instead of its ridges, and still the weight of the octave before.
// That keeps the mean of the first removed octave, if it does not depend on the one before; those
// after it lose the small difference between the mean of a weight and the weight of a mean. With
// the defaults the mean is 1.3685 and, with all octaves removed, 1.3807 (each +- 0.001): 0.9 %
// more.
//
// Units and domain are those of fractalsum. Bound: between 0 and the sum of 1/f_i times the larger
// of offset^2 and (offset - bound of the basis)^2, because the square is convex and weights are 1
// at most. Mean, variance, band: not stated. Class C0: the crest of a ridge, where the basis
// crosses 0, is a kink, and so is the place where a weight reaches 1, also with a basis that is
// never negative (rayshade); that of the basis where its range excludes both. Period: that of the
// basis, as for fbm.
//
// Source: the ridged multifractal of musgrave2003, from its formula as commonly quoted; the book
// was not at hand, and peachey2003 has none. Deviation: the exponent of its amplitudes, f^-H, is
// fixed at H = 1.
#include <math.h>
#include <stddef.h>

#include "noises/noise.h"
#include "noises/octaves/octaves_loops.h"
#include "noises/textbook_loops.h"

typedef struct ridged_parameters {
    bl_octaves_settings sum;
    double lacunarity, gain, offset;
    uint32_t octaves, seeds;
} ridged_parameters;

static bl_status build(void *block, bl_opener *open, bl_message *message) {
    ridged_parameters *p = block;
    bl_octaves_plan plan = bl_octaves_plan_count(p->octaves, p->lacunarity, 1 / p->lacunarity);
    const bl_octaves_rules rules = {.fold = BL_FOLD_RIDGE,
                                    .ridge_offset = p->offset,
                                    .ridge_gain = p->gain,
                                    .fresh = p->seeds == 0};
    return bl_octaves_build(&p->sum, &plan, &rules, open, message);
}

static const char *const lacunarities[] = {"2.17", NULL};

static const bl_parameter parameters[] = {
    BL_OCTAVES_PARAMETERS(ridged_parameters, sum),
    BL_OCTAVES_COUNT_PARAMETERS(ridged_parameters, lacunarities),
    BL_OCTAVES_SEEDS_PARAMETER(ridged_parameters, "same"),
    {"gain", BL_REAL, offsetof(ridged_parameters, gain), "2", "", .minimum = 0, .maximum = 4,
     .help = "of an octave as the weight of the next"},
    {"offset", BL_REAL, offsetof(ridged_parameters, offset), "1", "", .minimum = 0.5, .maximum = 2,
     .help = "the height of a ridge, before it is squared"},
    {0}};

static float textbook(float x, float y, float z) {
    float sum = 0, weight = 1, amplitude = 1;
    for (int i = 0; i < 4; i++) {
        float height = 1 - fabsf(bl_textbook_gradient(x, y, z));
        float ridge = height * height * weight;
        sum += amplitude * ridge;
        weight = ridge * 2 > 1 ? 1 : ridge * 2;
        amplitude *= 0.5f;
        x *= 2;
        y *= 2;
        z *= 2;
    }
    return sum;
}

BL_NOISE_DESCRIPTOR(ridged_sum) = {
    .name = "ridged",
    .title = "ridged multifractal",
    .summary = "Octaves of squared ridges, each weighted by the one before.",
    .formula = "n(p) = sum_i s_i / f_i, s_i = min(1, gain s_{i-1}) (offset - |basis(p f_i)|)^2",
    .paper = "musgrave2003, ridged multifractal",
    .dimensions = 3,
    .dimensions_of = bl_octaves_dimensions,
    .parameters = parameters,
    .parameters_size = sizeof(ridged_parameters),
    .describe = bl_octaves_describe,
    .textbook = textbook,
    .textbook_settings = BL_TEXTBOOK_OCTAVES,
    .functions = {BL_OCTAVES_FUNCTIONS, .build = build},
};
