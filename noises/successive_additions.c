// SPDX-License-Identifier: MIT
//
// additions: fractional Brownian motion by successive random additions, as a tile.
//
//   all points of a periodic grid s numbers apart get s^H z; the grid is refined linearly (along x,
//   then along y) to one s/lacunarity apart; and so on to s = 1
//
// z random of mean 0 and variance 1, nearly normal (bl_tile_numbers in noises/tiles/tile.h);
// times the factor that makes the variance 1. Since a linear refinement of a linear refinement is
// linear, the noise at its numbers is a sum of value noises with linear interpolation, of spacing
// lacunarity^l and weight lacunarity^(l H), all on one lattice.
//
// Parameters
//   seed        64 bits, chooses the random numbers
//   dims        1 or 2
//   hurst       H, 0 (rough) to 1 (smooth)
//   lacunarity  2, 4 or 8: the ratio of the spacings of two levels
//   size        numbers in the tile, a power of two from 8 on, one or one an axis; 0: 256 in one
//               dimension, 64 in two. The coarsest spacing is the largest power of lacunarity that
//               is below the least size
//   samples     numbers a unit, 2 to 16, a power of two
//   interp      how the tile is read: bspline, catmull-rom, linear, nearest; all pass through the
//               numbers (noises/tiles/tile.h)
//
// Bound: a random number is below 3.4642 in size and a refinement takes means, so
// the sum of the deviations of the levels times 3.4642, times the gain of the reading kernel. Mean
// 0 and variance 1, over places and seeds: exact, from the squares of what each single number does
// (noises/tiles/displacement.c). Period: the tile. Class: C2, C1, C0 or discontinuous, that of the
// kernel. Band: none. The spectrum falls about as f^-(2H+1) in one dimension and f^-(2H+2) in two,
// from 1/tile on, and images of it stand beyond samples/2 cycles a unit. The covariance,
// over places and seeds, is exact and repeats with the tile (noises/tiles/tile_covariance.h).
//
// Known defects: smoother than midpoint displacement, since old points move too, but still
// cyclostationary on each level's lattice (a point that was refined has a smaller variance than its
// neighbours), and the lattices coincide. It is not isotropic. With a large lacunarity the gaps
// between the levels show.
// NaN, infinity, and coordinates beyond 2^62 give NaN; 2^52 is where doubles lose the fraction.
//
// Source: Voss in peitgen1988, chapter 1. Deviations: periodic; refinement in two dimensions is
// bilinear and not by diamonds and squares, so that any lacunarity and any shape of tile will do.
#include <stddef.h>

#include "noises/common_parameters.h"
#include "noises/tiles/displacement.h"
#include "noises/noise.h"
#include "noises/textbook_loops.h"
#include "noises/tiles/tile_covariance.h"
#include "noises/tiles/tile_points.h"

typedef struct additions_parameters {
    bl_tile tile;
    bl_displacement of;
    uint32_t lacunarity; // the choice
    double scale;        // that makes the variance 1; a reseeded block brings it along
} additions_parameters;

static const char *const lacunarities[] = {"2", "4", "8", NULL};

static bl_status validate(const void *block, bl_message *message) {
    const additions_parameters *p = block;
    return bl_tile_check(&p->of.tile, bl_displacement_sizes, 8, message);
}

static bl_status build(void *block, bl_opener *open, bl_message *message) {
    (void)open;
    additions_parameters *p = block;
    p->of.all = 1;
    p->of.lacunarity = 2u << p->lacunarity;
    return bl_displacement_build(&p->of, &p->scale, &p->tile, message);
}

static void describe(const void *block, bl_facts *facts) {
    const additions_parameters *p = block;
    bl_displacement_describe(&p->of, p->scale, &p->tile, facts);
}

static float textbook(float x, float y, float z) {
    (void)z;
    return bl_textbook_catmull_rom_tile(bl_textbook_data.additions, x, y);
}

static const bl_parameter parameters[] = {
    BL_SEED_PARAMETER(additions_parameters, of.tile.seed, "the displacements"),
    BL_TILE_DIMENSIONS_PARAMETER(additions_parameters, of.tile.dimensions, 1, 2, "2"),
    {"hurst", BL_REAL, offsetof(additions_parameters, of.hurst), "0.5", "", .minimum = 0,
     .maximum = 1, .help = "H: an addition at the spacing s has the standard deviation s^H"},
    {"lacunarity", BL_CHOICE, offsetof(additions_parameters, lacunarity), "2", "",
     .choices = lacunarities, .help = "the ratio of the spacings of two levels"},
    BL_TILE_SIZE_PARAMETER(additions_parameters, of.tile.size, "256, 64 in 1, 2 dimensions"),
    BL_TILE_SAMPLES_PARAMETER(additions_parameters, of.tile.samples),
    BL_TILE_INTERP_PARAMETER(additions_parameters, of.tile.interp, "catmull-rom"),
    {0}};

BL_NOISE_DESCRIPTOR(successive_additions) = {
    .name = "additions",
    .title = "successive random additions",
    .summary = "A tile refined level by level: all points get a random addition at each level.",
    .formula = "n_s = linear refinement of n_(s lacunarity) + s^H z, z random; down to s = 1",
    .paper = "peitgen1988, chapter 1",
    .dimensions = 2,
    .parameters = parameters,
    .parameters_size = sizeof(additions_parameters),
    .validate = validate,
    .describe = describe,
    .textbook = textbook,
    .textbook_settings = BL_TEXTBOOK_TILE_SETTINGS,
    .has_closed_form = bl_tile_noise_has_covariance,
    .functions = {BL_TILE_FUNCTIONS, .build = build},
};
