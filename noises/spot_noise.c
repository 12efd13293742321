// SPDX-License-Identifier: MIT
//
// spot: spot noise, copies of one spot of random weight dropped at random places.
//
//   n(p) = 1/sqrt N  sum over cells c, impulses k of  a_ck h(p - c - x_ck)
//
// x_ck uniform in the cell, a_ck uniform in (-1, 1), N impulses a cell on average. The division by
// sqrt N keeps the contrast when N changes; as N grows the noise becomes Gaussian.
//
// Parameters
//   seed, lattice, component, period   of the impulses, as for every lattice noise
//   dims      2 or 3
//   impulses  N, 1 to 64 a cell
//   count     poisson: the number in a cell is Poisson (impulses.h); fixed: always N
//   shape     disc, gaussian, cosine, ring: functions of the distance (impulse_profiles.h);
//             square: 1 in the square (cube) inscribed in the circle (ball)
//   radius    1/8 to 1 cell: the spot is 0 outside of this circle, so that the cells around that
//             of the point are enough
//   stretch   1 to 8: the spot is narrower by this factor across `angle`; its length stays
//   angle     -360 to 360 degrees, of the long axis from x towards y; turns the square
//
// Bound: each of the 3^dims cells in reach has at most M impulses (N, or the largest Poisson count
// that occurs), of size below max |h|: 3^dims M max |h| / sqrt N.
// Spectrum: N impulses a cell of the variance E[a^2]/N, so E[a^2] |h^(f)|^2 exactly, for both kinds
// of count. Covariance E[a^2] (h * h)(lag). E[a^2] = (1 - 2^-40)/3. The amplitude of the disc falls
// as f^-3/2 (ball f^-2), of the square as sinc, of the others as that of a C1 radial kernel. Not
// band limited; stated is the exact leak beyond 1/radius (times the stretch).
// Stationary exactly to second order; with count=poisson, in every respect (but for the 2^-32 of
// impulses.h). Isotropic except for the square and for stretch > 1.
// Class: C1; disc and square are discontinuous.
// Period: that of the lattice. NaN, infinity and coordinates beyond 2^62 give NaN; from 2^52 on
// the fraction is lost.
// Known defects: slow for many impulses.
//
// Source: vanwijk1991. Deviations: the spots stand in cells, by a hash, so that any point can be
// computed alone; the Gaussian and its difference end without a step at the radius. The paper's
// other ways to vary spots (position, data dependent transforms) are stretch and angle here.
//
// Float results are within 1e-6 of the largest |h| per impulse in reach.
#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "noises/closed_forms.h"
#include "noises/common_parameters.h"
#include "noises/impulses/impulse_profiles.h"
#include "noises/impulses/impulses.h"
#include "noises/lattice/reference.h"
#include "noises/noise.h"
#include "noises/impulses/profile_float.h"
#include "noises/lattice/separable.h"
#include "noises/textbook_loops.h"

typedef struct spot_parameters {
    bl_lattice_settings lattice;
    uint32_t dimensions, impulses, count, shape;
    double radius, stretch, angle;
} spot_parameters;

enum { SHAPE_DISC, SHAPE_GAUSSIAN, SHAPE_COSINE, SHAPE_RING, SHAPE_SQUARE };

static const char *const shapes[] = {"disc", "gaussian", "cosine", "ring", "square", NULL};

#define AT(field) offsetof(spot_parameters, field)
static const bl_parameter parameters[] = {
    BL_LATTICE_PARAMETERS(spot_parameters, "the spots"),
    BL_DIMENSIONS_PARAMETER(spot_parameters, 2, 3, "2"),
    IMPULSE_MEAN_PARAMETER(spot_parameters, "4"),
    IMPULSE_COUNT_PARAMETER(spot_parameters, "poisson"),
    {"shape", BL_CHOICE, AT(shape), "gaussian", "", .choices = shapes,
     .help = "of the spot; ring: a difference of Gaussians"},
    {"radius", BL_REAL, AT(radius), "1", "cells", .minimum = 0.125, .maximum = 1,
     .help = "of the circle beyond which the spot is 0"},
    {"stretch", BL_REAL, AT(stretch), "1", "", .minimum = 1, .maximum = 8,
     .help = "length over width of the spot"},
    {"angle", BL_REAL, AT(angle), "0", "degrees", .minimum = -360, .maximum = 360,
     .help = "of the long axis, or of a side of the square, from x towards y"},
    {0}};
#undef AT

// --- the spot -----------------------------------------------------------------------------------

static inline bl_profile profile_of(const uint32_t shape) {
    static const bl_profile profiles[] = {BL_PROFILE_DISC, BL_PROFILE_GAUSSIAN, BL_PROFILE_COSINE,
                                          BL_PROFILE_RING, BL_PROFILE_DISC};
    return profiles[shape];
}

// The spot in its own axes, of radius 1: along = xx dx + xy dy, across = yx dx + yy dy, up = zz dz.
typedef struct impulse_kernel {
    double xx, xy, yx, yy, zz, half; // half the side of the square
} impulse_kernel;

static impulse_kernel kernel_of(const spot_parameters *p) {
    double c = cos(p->angle * (M_PI / 180)), s = sin(p->angle * (M_PI / 180));
    double along = 1 / p->radius, across = p->stretch / p->radius;
    return (impulse_kernel){c * along,  s * along, -s * across,
                            c * across, across,    sqrt(1.0 / p->dimensions)};
}

typedef struct impulse_mark {
    float amplitude; // in BL_LATTICE_UNIT
} impulse_mark;

static inline __attribute__((always_inline)) impulse_mark
impulse_mark_of(const impulse_kernel *kernel, const int form, uint32_t third, uint32_t fourth) {
    (void)kernel, (void)form, (void)third;
    return (impulse_mark){bl_lattice_value(fourth)};
}

// Whether, and where, in double: the reference decides alike.
static inline double spot_square(const impulse_kernel *k, double x, double y, double z) {
    double along = k->xx * x + k->xy * y, across = k->yx * x + k->yy * y, up = k->zz * z;
    return along * along + across * across + up * up;
}

static inline int spot_inside(const impulse_kernel *k, double x, double y, double z) {
    double along = fabs(k->xx * x + k->xy * y), across = fabs(k->yx * x + k->yy * y);
    return along < k->half && across < k->half && fabs(k->zz * z) < k->half;
}

static inline __attribute__((always_inline)) float impulse_term(const impulse_kernel *kernel,
                                                                const int form, impulse_mark mark,
                                                                double x, double y, double z) {
    if (form == SHAPE_SQUARE)
        return spot_inside(kernel, x, y, z) ? mark.amplitude : 0;
    double q = spot_square(kernel, x, y, z);
    if (form == SHAPE_DISC)
        return q < 1 ? mark.amplitude : 0;
    const bl_profile profile = form == SHAPE_GAUSSIAN ? BL_PROFILE_GAUSSIAN
                               : form == SHAPE_COSINE ? BL_PROFILE_COSINE
                                                      : BL_PROFILE_RING;
    return mark.amplitude * profile_float(profile, (float)q);
}

#include "noises/impulses/impulse_points.h"

// --- the reference ------------------------------------------------------------------------------

typedef struct spot_sum {
    impulse_kernel kernel;
    uint32_t shape;
    double value, gradient[3];
} spot_sum;

static void add_spot(void *context, const double d[IMPULSE_AXES], uint32_t third, uint32_t fourth) {
    (void)third;
    spot_sum *sum = context;
    const impulse_kernel *k = &sum->kernel;
    double amplitude = (double)bl_lattice_value(fourth) * BL_LATTICE_UNIT;
    if (sum->shape == SHAPE_SQUARE) {
        sum->value += spot_inside(k, d[0], d[1], d[2]) ? amplitude : 0;
        return;
    }
    double q = spot_square(k, d[0], d[1], d[2]);
    bl_profile profile = profile_of(sum->shape);
    sum->value += amplitude * bl_profile_value(profile, q);
    double slope = 2 * amplitude * bl_profile_slope(profile, q);
    double along = k->xx * d[0] + k->xy * d[1], across = k->yx * d[0] + k->yy * d[1];
    sum->gradient[0] += slope * (along * k->xx + across * k->yx);
    sum->gradient[1] += slope * (along * k->xy + across * k->yy);
    sum->gradient[2] += slope * (k->zz * k->zz * d[2]);
}

typedef struct spot_opened {
    impulse_source source;
    impulse_kernel kernel;
} spot_opened;

static spot_opened open_spot(const void *block) {
    const spot_parameters *p = block;
    spot_opened opened = {.kernel = kernel_of(p)};
    impulse_source_open(&opened.source, &p->lattice, p->impulses,
                        p->count == IMPULSE_COUNT_POISSON);
    return opened;
}

static spot_sum evaluate(const spot_parameters *p, const spot_opened *opened,
                         const double at[BL_AXES]) {
    spot_sum sum = {.kernel = opened->kernel, .shape = p->shape};
    if (!impulse_visit(&opened->source, p->dimensions, 1, at, add_spot, &sum))
        sum.value = sum.gradient[0] = sum.gradient[1] = sum.gradient[2] = NAN;
    double scale = 1 / sqrt(p->impulses);
    sum.value *= scale;
    for (unsigned a = 0; a < 3; a++)
        sum.gradient[a] *= scale;
    return sum;
}

static double value_at(const void *block, const spot_opened *opened, const double at[BL_AXES]) {
    return evaluate(block, opened, at).value;
}

BL_VALUES_OF_OPENED(spot_opened, open_spot)

// Of disc and square 0, as it is almost everywhere.
static void gradient(const void *block, const double at[BL_AXES], double out[BL_AXES]) {
    const spot_opened opened = open_spot(block);
    const spot_sum sum = evaluate(block, &opened, at);
    for (unsigned a = 0; a < 3; a++)
        out[a] = sum.gradient[a];
    out[3] = 0;
}

// --- points and rows ----------------------------------------------------------------------------

static inline __attribute__((always_inline)) void spot_points(const spot_parameters *p,
                                                              const int form,
                                                              const double *const at[BL_AXES],
                                                              size_t count, float *out) {
    impulse_source source;
    impulse_kernel kernel = kernel_of(p);
    float scale = (float)(BL_LATTICE_UNIT / sqrt(p->impulses));
    impulse_source_open(&source, &p->lattice, p->impulses, p->count == IMPULSE_COUNT_POISSON);
    if (p->dimensions == 2)
        impulse_points(&source, &kernel, form, 2, p->radius, scale, at, count, out);
    else
        impulse_points(&source, &kernel, form, 3, p->radius, scale, at, count, out);
}

static void points(const void *block, const double *const at[BL_AXES], size_t count, float *out) {
    const spot_parameters *p = block;
    switch (p->shape) {
    case SHAPE_DISC:
        spot_points(p, SHAPE_DISC, at, count, out);
        return;
    case SHAPE_GAUSSIAN:
        spot_points(p, SHAPE_GAUSSIAN, at, count, out);
        return;
    case SHAPE_COSINE:
        spot_points(p, SHAPE_COSINE, at, count, out);
        return;
    case SHAPE_RING:
        spot_points(p, SHAPE_RING, at, count, out);
        return;
    default:
        spot_points(p, SHAPE_SQUARE, at, count, out);
    }
}

BL_ROW_OF_POINTS

// --- closed forms -------------------------------------------------------------------------------

// The size of the spot's volume beside that of radius 1.
static double volume(const spot_parameters *p) {
    double across = p->radius / p->stretch;
    return p->radius * across * (p->dimensions == 3 ? across : 1);
}

static double covariance(const void *block, const double lag[BL_AXES]) {
    const spot_parameters *p = block;
    impulse_kernel k = kernel_of(p);
    double up = p->dimensions == 3 ? lag[2] : 0, product = BL_VALUE_VARIANCE(1 << 20) * volume(p);
    if (p->shape != SHAPE_SQUARE)
        return product * bl_profile_correlation(profile_of(p->shape), p->dimensions,
                                                sqrt(spot_square(&k, lag[0], lag[1], up)));
    const double own[3] = {k.xx * lag[0] + k.xy * lag[1], k.yx * lag[0] + k.yy * lag[1], k.zz * up};
    for (unsigned a = 0; a < p->dimensions; a++)
        product *= fmax(0, 2 * k.half - fabs(own[a]));
    return product;
}

static double density(const void *block, const double frequency[BL_AXES]) {
    const spot_parameters *p = block;
    double c = cos(p->angle * (M_PI / 180)), s = sin(p->angle * (M_PI / 180));
    double across = p->radius / p->stretch, half = sqrt(1.0 / p->dimensions), product = volume(p);
    const double own[3] = {p->radius * (c * frequency[0] + s * frequency[1]),
                           across * (c * frequency[1] - s * frequency[0]), across * frequency[2]};
    double square = 0;
    for (unsigned a = 0; a < p->dimensions; a++)
        square += own[a] * own[a];
    if (p->shape != SHAPE_SQUARE)
        product *= bl_profile_transform(profile_of(p->shape), p->dimensions, sqrt(square));
    for (unsigned a = 0; p->shape == SHAPE_SQUARE && a < p->dimensions; a++) {
        double u = 2 * M_PI * half * own[a];
        product *= 2 * half * (fabs(u) < 1e-4 ? 1 - u * u / 6 : sin(u) / u);
    }
    return BL_VALUE_VARIANCE(1 << 20) * product * product;
}

static void describe(const void *block, bl_facts *facts) {
    const spot_parameters *p = block;
    facts->mean = 0;
    if (bl_lattice_has_closed_form(block))
        bl_impulses_describe(covariance, p, p->dimensions, 2 * p->radius, p->stretch / p->radius,
                             facts);
    else if (bl_lattice_differs_within(&p->lattice, p->dimensions, 2 * p->radius))
        facts->variance = covariance(p, (const double[BL_AXES]){0});
    facts->stationary = bl_lattice_has_closed_form(block);
    facts->isotropic = facts->stationary && p->shape != SHAPE_SQUARE && p->stretch == 1;
    double cells = p->dimensions == 3 ? 27 : 9;
    int most = impulse_count_most(p->impulses, p->count == IMPULSE_COUNT_POISSON);
    bl_bound bound = {cells * most * bl_profile_most(profile_of(p->shape)) / sqrt(p->impulses),
                      "amplitudes below 1; the cells in reach times the most impulses of a cell "
                      "times the largest size of the spot, over the root of their mean number"};
    int steps = p->shape == SHAPE_DISC || p->shape == SHAPE_SQUARE;
    bl_lattice_describe(bound, steps ? -1 : 1, &p->lattice, facts);
}

// A generator a cell, as in the loop of gabor: four spots a cell on average.
static float textbook(float x, float y, float z) {
    (void)z;
    const float rate = (float)BL_GAUSSIAN_RATE, edge = (float)BL_GAUSSIAN_EDGE;
    int cell_x = bl_textbook_floor(x), cell_y = bl_textbook_floor(y);
    float fx = x - (float)cell_x, fy = y - (float)cell_y, sum = 0;
    for (int i = -1; i <= 1; i++)
        for (int j = -1; j <= 1; j++) {
            uint32_t state = bl_textbook_cell(cell_x + i, cell_y + j);
            int count = bl_textbook_poisson(&state, 0.018315639f); // e^-4
            for (int n = 0; n < count; n++) {
                float dx = fx - ((float)i + bl_textbook_uniform(&state));
                float dy = fy - ((float)j + bl_textbook_uniform(&state));
                float amplitude = 2 * bl_textbook_uniform(&state) - 1, q = dx * dx + dy * dy;
                if (q < 1)
                    sum += amplitude * (expf(-rate * q) - edge - rate * edge * (1 - q));
            }
        }
    return sum / (2 * (1 - edge * (1 + rate)));
}

BL_NOISE_DESCRIPTOR(spot_noise) = {
    .name = "spot",
    .title = "spot noise",
    .summary = "Spots of random weight at Poisson places: a texture with the spectrum of its spot.",
    .formula = "1/sqrt N sum over cells c and impulses k of a_ck h(p - c - x_ck)",
    .paper = "vanwijk1991",
    .dimensions = 2,
    .parameters = parameters,
    .parameters_size = sizeof(spot_parameters),
    .describe = describe,
    .has_closed_form = bl_lattice_has_closed_form,
    .textbook = textbook,
    .functions = {BL_NOISE_FUNCTIONS, .values = values, .gradient = gradient, BL_NOISE_CLOSED_FORM},
};
