// SPDX-License-Identifier: MIT
//
// wavelet: wavelet noise, a tile of random numbers without the part that a spline of half the
// resolution can represent, read back by quadratic B-splines.
//
//   n(p) = sum_j c_j b(2x - j_x) b(2y - j_y) b(2z - j_z),    c = s (r - P r)
//
// b is the quadratic B-spline, r random of variance 1, nearly normal (bl_tile_numbers in
// noises/tiles/tile.h), P the projection on the coarser splines, derived in
// noises/tiles/wavelet_tile.h: the least squares over space, exact on the periodic tile.
//
// Units: two numbers a unit, so that the highest frequency of the numbers is 1 cycle a unit, and
// the noise is one octave, about 1/2 to 1.
//
// Parameters
//   seed    64 bits, chooses the random numbers
//   dims    2 or 3
//   size    numbers in the tile, a power of two from 8 on, one or one an axis; 0: 64 along each
//           axis in two dimensions, 32 in three. In units, the period is half of it
//   slice   none: the noise itself. A plane cut out of three-dimensional noise is not band-pass:
//           the integral over f_z fills it, and 22 % of its variance is below |f| = 1/2.
//           projected (dims=3): along `normal` the kernel is b((2z - j)/2), the coarse spline,
//           twice as wide: the noise is convolved along the normal, so that slices at every z have
//           4.5 % there
//   normal  x, y or z
//
// Variance 1, mean 0 over places and seeds: exact, from the spectrum of the projection. Bound: |r|
// is below 3.4642, |r - P r| at most (1 + gain of P) of it, the gain the largest sum of sizes in a
// row of P, and the kernel's weights sum to 1 an axis (2 if wide). Period: the tile. Class: C1,
// with knots a quarter of a unit from the multiples of 1/2.
// Band: the coarse splines take all power at 0 and half of it at 1/2; the kernel, sinc^3, leaves
// images beyond 1. Along an axis, 0 to 1 with the stated leak, exact, -16.5 dB by default. In
// frequency space the noise fills a cube without its inner cube, not a shell. Known defects: not
// isotropic; cyclostationary, with the coarse lattice, one unit, as its cell. The covariance over
// places and seeds is exact and repeats with the tile (noises/tiles/tile_covariance.h): the
// spectrum is one of lines. Tests hold the power of
// each harmonic to the formula of noises/tiles/wavelet_tile.h.
// NaN, infinity, and coordinates beyond 2^62 give NaN; 2^52 is where doubles lose the fraction.
//
// Source: cook2005. Deviations: the downsampling filter is derived here and exact, where the paper
// prints a table; random numbers are nearly normal; the paper's addition of a copy shifted by an
// odd number, which evens out the variance of even and odd places, is left out, since the copy is
// not free of the coarse part; the variance is 1; `projected` takes normals along an axis only.
#include <stddef.h>

#include "noises/common_parameters.h"
#include "noises/noise.h"
#include "noises/textbook.h"
#include "noises/tiles/tile_covariance.h"
#include "noises/tiles/tile_points.h"
#include "noises/tiles/wavelet_tile.h"

typedef struct wavelet_parameters {
    bl_tile tile;
    bl_wavelet of;
} wavelet_parameters;

static bl_status validate(const void *block, bl_message *message) {
    const wavelet_parameters *p = block;
    if (p->of.projected && p->of.tile.dimensions != 3)
        return bl_report(message, BL_USAGE,
                         "slice=projected needs dims=3: it projects a volume on its planes");
    return bl_tile_check(&p->of.tile, bl_wavelet_sizes, 8, message);
}

static bl_status build(void *block, bl_opener *open, bl_message *message) {
    (void)open;
    wavelet_parameters *p = block;
    return bl_wavelet_build(&p->of, &p->tile, message);
}

static void describe(const void *block, bl_facts *facts) {
    const wavelet_parameters *p = block;
    bl_wavelet_describe(&p->of, &p->tile, facts);
}

static const char *const slices[] = {"none", "projected", NULL};
static const char *const normals[] = {"x", "y", "z", NULL};

static const bl_parameter parameters[] = {
    BL_SEED_PARAMETER(wavelet_parameters, of.tile.seed, "the random numbers"),
    BL_TILE_DIMENSIONS_PARAMETER(wavelet_parameters, of.tile.dimensions, 2, 3, "3"),
    BL_TILE_SIZE_PARAMETER(wavelet_parameters, of.tile.size, "64, 32 in 2, 3 dimensions"),
    {"slice", BL_CHOICE, offsetof(wavelet_parameters, of.projected), "none", "", .choices = slices,
     .help = "the noise, or its projection, whose slices across the normal are band-pass"},
    {"normal", BL_CHOICE, offsetof(wavelet_parameters, of.normal), "z", "", .choices = normals,
     .help = "of slice=projected"},
    {0}};

// The 27 numbers around the point, each times the weights of three quadratic B-splines.
static float textbook(float x, float y, float z) {
    const float at[3] = {2 * x, 2 * y, 2 * z};
    int middle[3];
    float w[3][3], sum = 0;
    for (int a = 0; a < 3; a++) {
        middle[a] = bl_textbook_floor(at[a] + 0.5f);
        float t = (float)middle[a] - (at[a] - 0.5f); // in [0, 1]
        w[a][0] = t * t / 2;
        w[a][2] = (1 - t) * (1 - t) / 2;
        w[a][1] = 1 - w[a][0] - w[a][2];
    }
    for (int k = -1; k <= 1; k++)
        for (int j = -1; j <= 1; j++)
            for (int i = -1; i <= 1; i++) {
                int cx = (middle[0] + i) & (BL_TEXTBOOK_CUBE - 1);
                int cy = (middle[1] + j) & (BL_TEXTBOOK_CUBE - 1);
                int cz = (middle[2] + k) & (BL_TEXTBOOK_CUBE - 1);
                int entry = (cz * BL_TEXTBOOK_CUBE + cy) * BL_TEXTBOOK_CUBE + cx;
                sum += w[0][i + 1] * w[1][j + 1] * w[2][k + 1] * bl_textbook_data.wavelet[entry];
            }
    return sum;
}

BL_NOISE_DESCRIPTOR(wavelet_noise) = {
    .name = "wavelet",
    .title = "wavelet noise",
    .summary = "A tile of random numbers without their coarse part, read by quadratic B-splines.",
    .formula = "n(p) = sum_j c_j b(2x-j_x) b(2y-j_y) b(2z-j_z), c = r - upsampled(downsampled(r))",
    .paper = "cook2005",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(wavelet_parameters),
    .validate = validate,
    .describe = describe,
    .textbook = textbook,
    .textbook_settings = BL_TEXTBOOK_TILE_SETTINGS,
    .has_closed_form = bl_tile_noise_has_covariance,
    .functions = {BL_TILE_FUNCTIONS, .build = build},
};
