// SPDX-License-Identifier: MIT
//
// gnoise: gradient noise, first straightforward version.
#include <math.h>
#include <stddef.h>

#include "core/hash.h"
#include "noises/noise.h"

typedef struct gradient_parameters {
    uint64_t seed;
} gradient_parameters;

static const bl_parameter parameters[] = {
    {.key = "seed", .kind = BL_SEED, .offset = offsetof(gradient_parameters, seed), .fallback = "0",
     .unit = "", .help = "chooses the random lattice"},
    {.key = NULL}};

static double value(const void *block, const double at[BL_AXES]) {
    const gradient_parameters *p = block;
    uint64_t cell[3];
    double f[3];
    for (int a = 0; a < 3; a++) {
        if (!(fabs(at[a]) < 0x1p62))
            return NAN;
        double floor_at = floor(at[a]);
        cell[a] = (uint64_t)(int64_t)floor_at;
        f[a] = at[a] - floor_at;
    }
    double sum = 0;
    for (unsigned corner = 0; corner < 8; corner++) {
        uint64_t h = bl_stream(p->seed, 0);
        double weight = 1, d[3];
        for (unsigned a = 0; a < 3; a++) {
            unsigned bit = corner >> a & 1;
            h = bl_mix(h ^ bl_mix(cell[a] + bit + a));
            d[a] = f[a] - bit;
            double t = fabs(d[a]);
            weight *= 1 - t * t * (3 - 2 * t);
        }
        double z = 2 * ((double)(h >> 32) + 0.5) * 0x1p-32 - 1;
        double angle = 2 * M_PI * (double)(h & 0xffffffffu) * 0x1p-32;
        double r = sqrt(1 - z * z);
        sum += weight * (r * cos(angle) * d[0] + r * sin(angle) * d[1] + z * d[2]);
    }
    return sum;
}

static void row(const void *block, const double start[BL_AXES], const double step[BL_AXES],
                size_t count, float *out) {
    for (size_t i = 0; i < count; i++) {
        double at[BL_AXES];
        for (int a = 0; a < BL_AXES; a++)
            at[a] = start[a] + (double)i * step[a];
        out[i] = (float)value(block, at);
    }
}

static void points(const void *block, const double *const at[BL_AXES], size_t count, float *out) {
    for (size_t i = 0; i < count; i++)
        out[i] = (float)value(block, (double[BL_AXES]){at[0][i], at[1][i], at[2][i], 0});
}

static void describe(const void *block, bl_facts *facts) {
    (void)block;
    facts->mean = 0;
    facts->lower = -1;
    facts->upper = 1;
    facts->continuity = 1;
    facts->period = 0;
}

static int has_closed_form(const void *block) {
    (void)block;
    return 0;
}

BL_NOISE_DESCRIPTOR(gradient_noise) = {
    .name = "gnoise",
    .title = "gradient noise",
    .summary = "Random gradients at the lattice points, blended by a smooth fade.",
    .formula = "sum over corners of fade weights times gradient . offset",
    .paper = "peachey2003, pp. 74-77",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(gradient_parameters),
    .seed_offset = offsetof(gradient_parameters, seed),
    .describe = describe,
    .has_closed_form = has_closed_form,
    .functions = {.row = row, .points = points, .value = value},
};
