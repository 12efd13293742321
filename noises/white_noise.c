// SPDX-License-Identifier: MIT
//
// white: the hash itself. The value at a point is a number drawn from the exact bits of its
// coordinates, independent of that of any other point.
//
//   n(p) = v(x, y, z, w),  v uniform in (-1, 1)                    cell=0
//   n(p) = v(floor(x/h), floor(y/h), floor(z/h), floor(w/h))       cell=h
//
// Parameters
//   seed       64 bits
//   component  0 to 3: independent noises of one seed
//   dims       1 to 4, default 3: coordinates beyond them are ignored
//   cell       h, in units: 0 (default), or from 2^-40 to 256: the noise is constant in cells of
//   side h
//
// v is an odd multiple of 2^-20, from the top bits of a chain of 64-bit hashes (core/hash.h), one
// link an axis: h' = mix(h ^ bits). For each link both the coordinate and what came before enter by
// a bijection, so points that differ in one coordinate never share their last link; others do with
// the chance 2^-64. -0 is 0. The quotient x/h is rounded once, so that the faces of cells lie
// within half a unit in the last place of their true places.
//
// Bound: |v| < 1 by its definition. Mean 0, variance (1 - 2^-40)/3, at every place: stationary.
//
// Spectrum. cell=0: the covariance is 0 at every lag but 0, where it is the variance. As a function
// of a continuous place this has no density: its integral would have to be the variance while every
// part of it is 0. What is true is a statement on samples: at distinct places, in any pattern, they
// are uncorrelated, and a grid of spacing s in D dimensions has the flat density variance * s^D up
// to its Nyquist frequency, all of it alias. There is no closed form here, no band, and no leak.
// cell=h: with a random place in the cell the covariance is variance * prod max(0, 1 - |lag_a|/h)
// and the density variance * prod h sinc^2(h f_a), sinc(t) = sin(pi t)/(pi t).
// Along an axis the share 1 - 2 Si(2 pi)/pi = 0.0971767 of the variance lies above 1/h: -10.12 dB.
//
// Class -1: it jumps everywhere, or at the faces of the cells. Period: none. NaN, infinity and
// coordinates beyond 2^62 give NaN. Far: doubles from 2^52 on are whole numbers, so that a unit
// has one value; nothing else is lost, a coordinate of any size has its own.
//
// Known defects: as bits decide, places that should be equal and differ by a rounding have
// unrelated values: it suits samples on a grid, not points on a surface seen twice.
// Source: of this project; the yardstick of the measurements, which must find it flat.
#include <stddef.h>

#include "core/hash.h"
#include "noises/closed_forms.h"
#include "noises/common_parameters.h"
#include "noises/noise.h"
#include "noises/lattice/separable.h"

typedef struct white_parameters {
    uint64_t seed;
    uint32_t dimensions, component;
    double cell;
} white_parameters;

// A stream of the seed that nothing else uses.
static uint64_t first_link(const white_parameters *p) {
    return bl_stream(bl_component_seed(p->seed, p->component), 0x776869u);
}

// The number that stands for a coordinate. The sum makes -0 a 0.
BL_INLINE double place(double x, double cell) {
    return (cell > 0 ? floor(x / cell) : x) + 0.0;
}

BL_INLINE uint64_t next_link(uint64_t link, double place) {
    uint64_t bits;
    memcpy(&bits, &place, sizeof bits);
    return bl_mix((link + BL_GOLDEN) ^ bits);
}

// In units of 2^-31.
BL_INLINE float number(uint64_t link) {
    return bl_lattice_value((uint32_t)(link >> 32));
}

static double value(const void *block, const double at[BL_AXES]) {
    const white_parameters *p = block;
    uint64_t link = first_link(p);
    for (uint32_t a = 0; a < p->dimensions; a++) {
        if (!(fabs(at[a]) < 0x1p62))
            return NAN;
        link = next_link(link, place(at[a], p->cell));
    }
    return (double)number(link) * BL_LATTICE_UNIT;
}

// An axis for a block of points; `outside` becomes NaN where the coordinate is out of the domain,
// else it stays.
BL_INLINE void add_axis(const double *restrict x, size_t count, double cell,
                        uint64_t *restrict link, float *restrict outside) {
#pragma omp simd
    for (size_t i = 0; i < count; i++) {
        link[i] = next_link(link[i], place(x[i], cell));
        outside[i] = fabs(x[i]) < 0x1p62 ? outside[i] : NAN;
    }
}

static void points(const void *block, const double *const at[BL_AXES], size_t count, float *out) {
    const white_parameters *p = block;
    uint64_t link[BL_BLOCK];
    const uint64_t first = first_link(p);
    for (size_t done = 0; done < count; done += BL_BLOCK) {
        size_t here = count - done < BL_BLOCK ? count - done : BL_BLOCK;
        float outside[BL_BLOCK] = {0};
        for (size_t i = 0; i < here; i++)
            link[i] = first;
        for (uint32_t a = 0; a < p->dimensions; a++)
            if (p->cell > 0)
                add_axis(at[a] + done, here, p->cell, link, outside);
            else
                add_axis(at[a] + done, here, 0, link, outside);
        for (size_t i = 0; i < here; i++)
            out[done + i] = number(link[i]) * (float)BL_LATTICE_UNIT + outside[i];
    }
}

BL_ROW_OF_POINTS

static double covariance(const void *block, const double lag[BL_AXES]) {
    const white_parameters *p = block;
    double product = BL_VALUE_VARIANCE(BL_LATTICE_VALUES);
    for (uint32_t a = 0; a < p->dimensions; a++)
        product *= fmax(0, 1 - fabs(lag[a]) / p->cell);
    return product;
}

static double density(const void *block, const double frequency[BL_AXES]) {
    const white_parameters *p = block;
    double product = BL_VALUE_VARIANCE(BL_LATTICE_VALUES);
    for (uint32_t a = 0; a < p->dimensions; a++) {
        double angle = M_PI * frequency[a] * p->cell;
        double sinc = angle != 0 ? sin(angle) / angle : 1;
        product *= p->cell * sinc * sinc;
    }
    return product;
}

static int has_closed_form(const void *block) {
    const white_parameters *p = block;
    return p->cell > 0;
}

static bl_status validate(const void *block, bl_message *message) {
    const white_parameters *p = block;
    if (p->cell > 0 && p->cell < 0x1p-40) // x / cell stays finite, by far
        return bl_report(message, BL_USAGE, "cell=%g: must be 0 or at least 2^-40", p->cell);
    return BL_OK;
}

static void describe(const void *block, bl_facts *facts) {
    const white_parameters *p = block;
    facts->lower = -1;
    facts->upper = 1;
    facts->bound_proof = "each value is an odd multiple of 2^-20 in (-1, 1)";
    facts->mean = 0;
    facts->variance = BL_VALUE_VARIANCE(BL_LATTICE_VALUES);
    facts->continuity = -1;
    for (int a = 0; a < BL_AXES; a++)
        facts->period[a] = 0;
    facts->cell = p->cell;
    facts->far = 0x1p52;
    facts->stationary = 1;
    facts->isotropic = p->cell == 0;
    facts->covariance_reach = p->cell;
    if (!(p->cell > 0))
        return;
    facts->band_from = 0;
    facts->band_to = 1 / p->cell;
    facts->leak_db = -10.12; // 10 log10(0.0971767) = -10.1243, rounded up
}

static const char *const cell_examples[] = {"1", "1/8", NULL};

// A finaliser of 32 bits a coordinate (Appleby 2011), of the bits of the floats.
static float textbook(float x, float y, float z) {
    const float at[3] = {x, y, z};
    uint32_t bits[3], hash = 0;
    memcpy(bits, at, sizeof bits);
    for (int a = 0; a < 3; a++) {
        hash ^= bits[a];
        hash = (hash ^ hash >> 16) * 0x85ebca6bu;
        hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
        hash ^= hash >> 16;
    }
    return (float)(int32_t)hash * 0x1p-31f;
}

static const bl_parameter parameters[] = {
    BL_SEED_PARAMETER(white_parameters, seed, "the numbers"),
    BL_DIMENSIONS_PARAMETER(white_parameters, 1, 4, "3"),
    BL_COMPONENT_PARAMETER(white_parameters, component),
    {"cell", BL_REAL, offsetof(white_parameters, cell), "0", "units", .minimum = 0, .maximum = 256,
     .examples = cell_examples,
     .help = "the side of cells in which the noise is constant; 0: every point has its own"},
    {0}};

BL_NOISE_DESCRIPTOR(white_noise) = {
    .name = "white",
    .title = "white noise",
    .summary = "A random number for every point, from the bits of its coordinates.",
    .formula = "n(p) = v(p), v uniform in (-1,1); with cell=h, n(p) = v(floor(p/h))",
    .paper = "bandlimit",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(white_parameters),
    .validate = validate,
    .describe = describe,
    .has_closed_form = has_closed_form,
    .textbook = textbook,
    .functions = {BL_NOISE_FUNCTIONS, BL_NOISE_CLOSED_FORM},
};
