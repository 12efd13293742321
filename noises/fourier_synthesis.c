// SPDX-License-Identifier: MIT
//
// fourier: spectral synthesis, a tile of cosines of random phase with a chosen power spectrum, by
// an inverse transform.
//
//   n(p) = sum over pairs k of  sqrt(2 p_k) g_k cos(2 pi f_k . p + phase_k)  + images,
//   f_k = (k_x / L_x, k_y / L_y, k_z / L_z), L the sides of the tile, k whole and not 0
//
// Phases are uniform and independent. The cosines are divided by the transform of the kernel that
// reads the tile, so that the noise that is read has exactly the powers p_k of the target; the
// images that any kernel leaves around multiples of `samples` cycles a unit come on top of it and
// are what the stated variance and leak count besides (noises/tiles/tile.h,
// noises/tiles/synthesis.h).
//
// Parameters
//   seed        64 bits, chooses phases and amplitudes
//   dims        1 to 3
//   spectrum    band: the same power in all harmonics with |f| between `from` and `to`, both
//               included: the ideal band-limited noise; power: density proportional to |f|^-beta,
//               from 1/L up to |f| = samples/2
//   from, to    cycles a unit, 0 to 4, in either order; 1/2 and 1, an octave
//   beta        0 to 8; the density per (cycle a unit)^dims
//   csv         a table of frequencies and densities that replaces the spectrum
//               (noises/tiles/spectrum_table.h): one-sided in one dimension, two-sided in more
//   amplitudes  fixed: g_k = 1; gaussian: g_k of mean square 1, Rayleigh, so that the noise is a
//               Gaussian process
//   size        numbers in the tile, a power of two from 8 on, one or one an axis; 0: 256, 64 or 32
//               along each axis in one, two or three dimensions
//   samples     numbers a unit, 2 to 16, a power of two; 0: 4, or four times the highest frequency
//   interp      how the tile is read: bspline, catmull-rom, linear, nearest
//
// Variance: 1, or that of the table, plus the images: with amplitudes=fixed this is the mean square
// over one tile, for every seed; with amplitudes=gaussian its expectation. Mean 0 over every tile.
// Bound: the sum of the amplitudes times the largest sum of the kernel's weights. Period: the tile.
// Band: 0 to the highest harmonic, along an axis; the leak is the exact share of the images, -51 dB
// with the default settings, -79 dB with samples=8. Class: C2, C1, C0 or discontinuous, that of the
// kernel. In two and three dimensions the spectrum is isotropic except for the square grid of its
// harmonics and the images, which are not. The covariance over places and seeds is exact
// (noises/tiles/tile_covariance.h); it repeats with the tile, so that the spectrum is one of lines.
// Known defects: it repeats, and all of it must be made before one value is known.
// NaN, infinity, and coordinates beyond 2^62 give NaN; 2^52 is where doubles lose the fraction.
//
// The bits are the same for every instruction set this program is compiled for and any threads. The
// transform is the library's (core/fft.h), with an estimated plan: on another kind of processor its
// last bits may differ, in double, which can turn the last bit of a number of the tile.
//
// Source: Saupe in peitgen1988, chapter 2 (spectral synthesis); peachey2003, p. 48, names it.
// Deviations: any spectrum; no sample at half the sampling frequency; the kernel is compensated.
#include <stddef.h>

#include "noises/common_parameters.h"
#include "noises/noise.h"
#include "noises/textbook_loops.h"
#include "noises/tiles/synthesis.h"
#include "noises/tiles/tile_covariance.h"
#include "noises/tiles/tile_points.h"

typedef struct fourier_parameters {
    bl_tile tile;
    bl_synthesis of;
} fourier_parameters;

static bl_status validate(const void *block, bl_message *message) {
    return bl_synthesis_check(&((const fourier_parameters *)block)->of, message);
}

static bl_status build(void *block, bl_opener *open, bl_message *message) {
    (void)open;
    fourier_parameters *p = block;
    return bl_synthesis_build(&p->of, &p->tile, message);
}

static void release(void *block) {
    fourier_parameters *p = block;
    bl_tile_release(&p->tile);
    bl_spectrum_table_drop(p->of.table);
}

static void describe(const void *block, bl_facts *facts) {
    const fourier_parameters *p = block;
    bl_synthesis_describe(&p->of, &p->tile, facts);
}

static const char *const spectra[] = {"band", "power", NULL};
static const char *const amplitudes[] = {"fixed", "gaussian", NULL};

#define AT(field) offsetof(fourier_parameters, of.field)
static const bl_parameter parameters[] = {
    BL_SEED_PARAMETER(fourier_parameters, of.tile.seed, "phases and amplitudes"),
    BL_TILE_DIMENSIONS_PARAMETER(fourier_parameters, of.tile.dimensions, 1, 3, "2"),
    {"spectrum", BL_CHOICE, AT(spectrum), "band", "", .choices = spectra,
     .help = "level from `from` to `to`, or a power law |f|^-beta"},
    {"from", BL_REAL, AT(from), "1/2", "cycles a unit", .maximum = 4,
     .help = "one end of the band"},
    {"to", BL_REAL, AT(to), "1", "cycles a unit", .maximum = 4,
     .help = "the other end of the band"},
    {"beta", BL_REAL, AT(beta), "2", "", .maximum = 8, .help = "the exponent of the power law"},
    {"csv", BL_TEXT, AT(csv), "", "",
     .help = "a file of frequencies and densities, which replaces the spectrum"},
    {"amplitudes", BL_CHOICE, AT(amplitudes), "fixed", "", .choices = amplitudes,
     .help = "of the cosines: those of the spectrum, or random about them"},
    BL_TILE_SIZE_PARAMETER(fourier_parameters, of.tile.size, "256, 64, 32 in 1, 2, 3 dimensions"),
    {"samples", BL_INTEGER, AT(tile.samples), "0", "a unit", .maximum = 16,
     .help = "numbers of the tile, a power of two; 0: by the spectrum"},
    BL_TILE_INTERP_PARAMETER(fourier_parameters, of.tile.interp, "bspline"),
    {0}};
#undef AT

// The tile, read by the four weights of the cubic B-spline along each axis.
static void textbook_weights(float t, float w[4]) {
    float rest = 1 - t;
    w[0] = rest * rest * rest / 6;
    w[1] = (4 - 6 * t * t + 3 * t * t * t) / 6;
    w[2] = (4 - 6 * rest * rest + 3 * rest * rest * rest) / 6;
    w[3] = t * t * t / 6;
}

static float textbook(float x, float y, float z) {
    (void)z;
    float u = 4 * x, v = 4 * y, wx[4], wy[4];
    int ix = bl_textbook_floor(u), iy = bl_textbook_floor(v);
    textbook_weights(u - (float)ix, wx);
    textbook_weights(v - (float)iy, wy);
    return bl_textbook_read(bl_textbook_data.fourier, ix, iy, wx, wy);
}

BL_NOISE_DESCRIPTOR(fourier_synthesis) = {
    .name = "fourier",
    .title = "spectral synthesis",
    .summary =
        "A tile of cosines of random phase, with a band, a power law, or a table as its "
        "spectrum.",
    .formula = "n(p) = sum_k sqrt(2 p_k) g_k cos(2 pi f_k . p + phase_k)",
    .paper = "peitgen1988, chapter 2",
    .dimensions = 2,
    .parameters = parameters,
    .parameters_size = sizeof(fourier_parameters),
    .validate = validate,
    .describe = describe,
    .textbook = textbook,
    .textbook_settings = BL_TEXTBOOK_TILE_SETTINGS,
    .has_closed_form = bl_tile_noise_has_covariance,
    .functions = {.row = bl_tile_noise_row,
                  .points = bl_tile_noise_points,
                  .value = bl_tile_noise_value,
                  .gradient = bl_tile_noise_gradient,
                  .covariance = bl_tile_noise_covariance,
                  .build = build,
                  .release = release},
};
