// SPDX-License-Identifier: MIT
//
// midpoint: fractional Brownian motion, roughly, by random midpoint displacement, as a tile.
//
//   a line    level by level: the point half way between two neighbours s apart gets their mean
//             plus s^H z; then s is halved
//   a plane   diamonds and squares: the middle of each square of side s gets the mean of its four
//             corners plus s^H z, then the middle of each side the mean of its four neighbours,
//             corners and middles, plus (s/sqrt 2)^H z; then s is halved
//
// z random of mean 0 and variance 1, nearly normal (bl_tile_numbers in noises/tiles/tile.h); begun
// from one point, 0, on a periodic grid, and times the factor that makes the variance 1.
//
// Parameters
//   seed     64 bits, chooses the random numbers
//   dims     1 or 2
//   hurst    H, 0 (rough) to 1 (smooth)
//   size     numbers in the tile, a power of two from 8 on, the same along both axes; 0: 256 in one
//            dimension, 64 in two
//   samples  numbers a unit, 2 to 16, a power of two
//   interp   how the tile is read: bspline, catmull-rom, linear, nearest; all pass through the
//            numbers (noises/tiles/tile.h)
//
// Bound: a random number is below 3.4642 in size and means add nothing, so the sum
// of the deviations of the levels times 3.4642, times the gain of the reading kernel. Mean 0 and
// variance 1, over places and seeds: exact, from the squares of what each single number does
// (noises/tiles/displacement.c). Period: the tile. Class: C2, C1, C0 or discontinuous, that of the
// kernel. Band: none. The spectrum falls about as f^-(2H+1) in one dimension and f^-(2H+2) in two,
// from 1/tile on, and images of it stand beyond samples/2 cycles a unit. The covariance,
// over places and seeds, is exact and repeats with the tile (noises/tiles/tile_covariance.h).
//
// Known defects, those of the method: it is not stationary. The variance depends on the place in
// the tile, 0 at the first point, and points of coarse levels are never touched again, so creases
// along their lines stay visible; the increments of fractional Brownian motion have, and these have
// not, one variance. It is not isotropic.
// NaN, infinity, and coordinates beyond 2^62 give NaN; 2^52 is where doubles lose the fraction.
//
// Source: fournier1982; diamonds and squares as in peitgen1988, chapter 2. Deviations: periodic;
// the first level is that of one point; the displacements are s^H, without the factor
// sqrt(1 - 2^(2H-2)) of the exact variance of a midpoint, which the unit variance swallows.
#include <stddef.h>

#include "noises/common_parameters.h"
#include "noises/tiles/displacement.h"
#include "noises/noise.h"
#include "noises/textbook_loops.h"
#include "noises/tiles/tile_covariance.h"
#include "noises/tiles/tile_points.h"

typedef struct midpoint_parameters {
    bl_tile tile;
    bl_displacement of;
    double scale; // that makes the variance 1; a reseeded block brings it along
} midpoint_parameters;

static bl_status validate(const void *block, bl_message *message) {
    const midpoint_parameters *p = block;
    uint32_t size[BL_TILE_AXES];
    bl_status status = bl_tile_check(&p->of.tile, bl_displacement_sizes, 8, message);
    bl_tile_sizes(&p->of.tile, bl_displacement_sizes, size);
    if (status == BL_OK && p->of.tile.dimensions == 2 && size[0] != size[1])
        return bl_report(message, BL_USAGE,
                         "size=%u,%u: midpoint displacement needs a square tile; `additions` does "
                         "not",
                         size[0], size[1]);
    return status;
}

static bl_status build(void *block, bl_opener *open, bl_message *message) {
    (void)open;
    midpoint_parameters *p = block;
    return bl_displacement_build(&p->of, &p->scale, &p->tile, message);
}

static void describe(const void *block, bl_facts *facts) {
    const midpoint_parameters *p = block;
    bl_displacement_describe(&p->of, p->scale, &p->tile, facts);
}

static float textbook(float x, float y, float z) {
    (void)z;
    return bl_textbook_catmull_rom_tile(bl_textbook_data.midpoint, x, y);
}

static const bl_parameter parameters[] = {
    BL_SEED_PARAMETER(midpoint_parameters, of.tile.seed, "the displacements"),
    BL_TILE_DIMENSIONS_PARAMETER(midpoint_parameters, of.tile.dimensions, 1, 2, "2"),
    {"hurst", BL_REAL, offsetof(midpoint_parameters, of.hurst), "0.5", "", .minimum = 0,
     .maximum = 1, .help = "H: a displacement over s has the standard deviation s^H"},
    BL_TILE_SIZE_PARAMETER(midpoint_parameters, of.tile.size, "256, 64 in 1, 2 dimensions"),
    BL_TILE_SAMPLES_PARAMETER(midpoint_parameters, of.tile.samples),
    BL_TILE_INTERP_PARAMETER(midpoint_parameters, of.tile.interp, "catmull-rom"),
    {0}};

BL_NOISE_DESCRIPTOR(midpoint_displacement) = {
    .name = "midpoint",
    .title = "midpoint displacement",
    .summary = "A tile refined level by level: midpoints are means plus a random displacement.",
    .formula = "midpoint = mean of the neighbours s apart + s^H z, z random; then s/2",
    .paper = "fournier1982",
    .dimensions = 2,
    .parameters = parameters,
    .parameters_size = sizeof(midpoint_parameters),
    .validate = validate,
    .describe = describe,
    .textbook = textbook,
    .textbook_settings = BL_TEXTBOOK_TILE_SETTINGS,
    .has_closed_form = bl_tile_noise_has_covariance,
    .functions = {BL_TILE_FUNCTIONS, .build = build},
};
