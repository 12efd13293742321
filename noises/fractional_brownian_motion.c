// SPDX-License-Identifier: MIT
//
// fbm: a sum of octaves with any ratio of frequency and of amplitude, each with numbers of its own.
//
//   n(p) = sum over i = 0 .. octaves-1 of  gain^i basis_i(R_i p f_i + o_i),   f_i = lacunarity^i
//
// Parameters
//   seed        64 bits
//   basis       any noise, with its settings as basis.KEY (but for seed); default gnoise
//   octaves     1 to 12; default 4
//   lacunarity  1 to 8; default 2. With 2, 4 and 8 lattice planes of octaves coincide; 2.17 is the
//               text's; other numbers than powers of two cost rows their speed
//   gain        0 to 1; default 1/2. With lacunarity^-H octaves add up to a spectrum of slope
//               -(2 H + 1) along a line, about that of fractional Brownian motion of exponent H
//   seeds       fresh: each octave has its own numbers, drawn from the seed; same: all have those
//               of the basis with this seed, as in fractalsum
//   shift       random: each octave but the first is moved by o_i, uniform within 2^10 cells along
//               each axis, drawn from the seed; none
//   rotate      random: each octave but the first is turned by R_i, a uniformly random rotation of
//               all the dimensions of the basis, drawn from the seed, orthonormal to rounding; none
//   width, clamp   as in fractalsum, of which see the head
//
// Bound: the sum of gain^i times the bound of the basis. Mean: the sum of gain^i times its mean.
// Variance: the sum of gain^2i times its variance. With seeds=fresh this is exact everywhere, since
// octaves are independent; with seeds=same at a random place, if lacunarity >= 3/2
// (noises/octaves/octaves.h); else it is not stated. Covariance and density add up in the same way;
// with rotate=random the mean over seeds is one over all directions, and they are stated for an
// isotropic basis alone, which it does not change.
// Band: up to the highest octave's frequency times the band of the basis; the exact share above.
// Class of continuity, stationarity: those of the basis. Period: the basis's, if all octaves repeat
// with some power of two times it; none with rotate=random. Far: where the highest octave loses its
// fraction. Domain as for fractalsum.
//
// Known defects: with seeds=same and shift=none octaves meet at the origin; a lacunarity of 1 only
// adds up noises of one frequency.
// Source: peachey2003, section Spectral Synthesis (at figure 2.40: lacunarity, amplitudes, Worley).
// Deviations: fresh seeds, which the text does not have, are the default; shift and rotate are
// written from the idea.
#include <stddef.h>

#include "noises/noise.h"
#include "noises/octaves/octaves_loops.h"
#include "noises/textbook_loops.h"

typedef struct fbm_parameters {
    bl_octaves_settings sum;
    double lacunarity, gain;
    uint32_t octaves, seeds, shift, rotate;
} fbm_parameters;

static bl_status build(void *block, bl_opener *open, bl_message *message) {
    fbm_parameters *p = block;
    bl_octaves_plan plan = bl_octaves_plan_count(p->octaves, p->lacunarity, p->gain);
    const bl_octaves_rules rules = {.fold = BL_FOLD_NONE,
                                    .fresh = p->seeds == 0,
                                    .shift = (int)p->shift,
                                    .rotate = (int)p->rotate};
    return bl_octaves_build(&p->sum, &plan, &rules, open, message);
}

static const char *const draws[] = {"none", "random", NULL};
static const char *const lacunarities[] = {"2.17", "1.5", NULL};

static const bl_parameter parameters[] = {
    BL_OCTAVES_PARAMETERS(fbm_parameters, sum),
    BL_OCTAVES_COUNT_PARAMETERS(fbm_parameters, lacunarities),
    {"gain", BL_REAL, offsetof(fbm_parameters, gain), "1/2", "", .minimum = 0, .maximum = 1,
     .help = "the ratio of the amplitudes of neighbouring octaves"},
    BL_OCTAVES_SEEDS_PARAMETER(fbm_parameters, "fresh"),
    {"shift", BL_CHOICE, offsetof(fbm_parameters, shift), "none", "", .choices = draws,
     .help = "whether octaves are moved to random places"},
    {"rotate", BL_CHOICE, offsetof(fbm_parameters, rotate), "none", "", .choices = draws,
     .help = "whether octaves are turned at random"},
    {0}};

static float textbook(float x, float y, float z) {
    float sum = 0, amplitude = 1;
    for (int i = 0; i < 4; i++) {
        sum += amplitude * bl_textbook_gradient(x, y, z);
        amplitude *= 0.5f;
        x *= 2;
        y *= 2;
        z *= 2;
    }
    return sum;
}

BL_NOISE_DESCRIPTOR(fractional_brownian_motion) = {
    .name = "fbm",
    .title = "fractional Brownian motion",
    .summary = "Octaves of a noise with any lacunarity and gain, each with its own numbers.",
    .formula = "n(p) = sum_i gain^i basis_i(R_i p f_i + o_i), f_i = lacunarity^i",
    .paper = "peachey2003, figure 2.40",
    .dimensions = 3,
    .dimensions_of = bl_octaves_dimensions,
    .parameters = parameters,
    .parameters_size = sizeof(fbm_parameters),
    .describe = bl_octaves_describe,
    .has_closed_form = bl_octaves_has_closed_form,
    .textbook = textbook,
    .textbook_settings = BL_TEXTBOOK_OCTAVES ",seeds=same",
    .functions = {BL_OCTAVES_FUNCTIONS, .covariance = bl_octaves_covariance,
                  .density = bl_octaves_density, .build = build},
};
