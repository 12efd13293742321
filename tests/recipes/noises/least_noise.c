// SPDX-License-Identifier: MIT
//
// least: a random number for each unit square, n(x, y) = h(seed, floor x, floor y) in [0, 1).
// Source: the shortest noise that the tests accept. NaN and coordinates beyond 2^62 give NaN.
#include "noises/common_parameters.h"
#include "noises/lattice/separable.h"
#include "noises/noise.h"

typedef struct least_parameters {
    uint64_t seed;
} least_parameters;

static double value(const void *block, const double at[BL_AXES]) {
    uint64_t bits = ((const least_parameters *)block)->seed;
    for (int a = 0; a < 2; a++) {
        if (!(fabs(at[a]) < 0x1p62))
            return NAN;
        bits = bl_stream(bits, (uint64_t)(int64_t)floor(at[a]));
    }
    return (double)(bits >> 40) * 0x1p-24;
}

static void describe(const void *block, bl_facts *facts) {
    (void)block;
    facts->lower = 0, facts->upper = 1, facts->bound_proof = "24 bits as a fraction";
    facts->continuity = -1, facts->far = 0x1p52, facts->period[0] = facts->period[1] = 0;
}

BL_NOISE_DESCRIPTOR(least_noise) = {
    .name = "least",
    .title = "random squares",
    .summary = "A random number for each unit square.",
    .formula = "n(x, y) = h(seed, floor x, floor y)",
    .paper = "bandlimit",
    .dimensions = 2,
    .parameters = (const bl_parameter[]){BL_SEED_PARAMETER(least_parameters, seed, "them"), {0}},
    .parameters_size = sizeof(least_parameters),
    .describe = describe,
    .functions.value = value};
