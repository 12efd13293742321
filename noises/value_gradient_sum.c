// SPDX-License-Identifier: MIT
//
// vgnoise: value-gradient noise as a weighted sum.
//
//   n(p) = value * vnoise(p) + gradient * gnoise(p)
//
// Parameters
//   seed       64 bits; the two parts draw from independent streams of it
//   value      weight of the value noise; default 1/2
//   gradient   weight of the gradient noise; default 1
//   interp, fade, gradients, lattice, component, period   as in vnoise and gnoise, of which see the
//              heads
//
// The text names no weights. With 1/2 and 1 the two parts have about the same size (standard
// deviations 0.212 and 0.182), which takes the zeros of gnoise off the lattice and keeps most of
// its spectrum.
//
// Units: coordinates in cells. Bound: the sum of the bounds of the parts. Class: that of the
// rougher part of those whose weight is not 0; C1 with the default settings. Mean 0, variance
// 0.0782788306 with the default settings; these and the band are exact, because the parts are
// independent (noises/closed_forms.h).
// NaN, infinity and coordinates beyond 2^62 give NaN; the fraction is lost from 2^52 on.
// Source: peachey2003, p. 77. Deviations: the parts share no lattice number, where the text would
// save some work by sharing the index; a shared word would correlate a value with its gradient.
#include <stddef.h>

#include "noises/common_parameters.h"
#include "noises/lattice/gradient_loops.h"
#include "noises/noise.h"
#include "noises/textbook_loops.h"
#include "noises/lattice/value_loops.h"

typedef struct sum_parameters {
    bl_lattice_settings lattice;
    double value, gradient;
    uint32_t interp, fade, gradients;
} sum_parameters;

// The tables of noises/textbook.h are drawn from the same streams.
enum { VALUE_STREAM = 16, GRADIENT_STREAM = 17, CHUNK = 2048 };

static bl_lattice_settings lattice_of(const sum_parameters *p, uint64_t stream) {
    bl_lattice_settings lattice = p->lattice;
    lattice.seed = bl_stream(lattice.seed, stream);
    return lattice;
}

static bl_value_noise value_part(const sum_parameters *p) {
    bl_lattice_settings lattice = lattice_of(p, VALUE_STREAM);
    return bl_value_noise_of(&lattice, p->interp);
}

static bl_gradient_noise gradient_part(const sum_parameters *p) {
    bl_lattice_settings lattice = lattice_of(p, GRADIENT_STREAM);
    return bl_gradient_noise_of(&lattice, p->fade, p->gradients);
}

static void add_parts(const sum_parameters *p, size_t count, const float *restrict gradient,
                      float *restrict out) {
    const float value_weight = (float)p->value, gradient_weight = (float)p->gradient;
#pragma omp simd
    for (size_t i = 0; i < count; i++)
        out[i] = value_weight * out[i] + gradient_weight * gradient[i];
}

static void row(const void *block, const double start[BL_AXES], const double step[BL_AXES],
                size_t count, float *out) {
    const sum_parameters *p = block;
    bl_value_noise values = value_part(p);
    bl_gradient_noise gradients = gradient_part(p);
    float part[CHUNK];
    for (size_t done = 0; done < count; done += CHUNK) {
        size_t here = count - done < CHUNK ? count - done : CHUNK;
        bl_value_row(&values, start, step, done, here, out + done);
        bl_gradient_row(&gradients, start, step, done, here, part);
        add_parts(p, here, part, out + done);
    }
}

static void points(const void *block, const double *const at[BL_AXES], size_t count, float *out) {
    const sum_parameters *p = block;
    bl_value_noise values = value_part(p);
    bl_gradient_noise gradients = gradient_part(p);
    float part[CHUNK];
    for (size_t done = 0; done < count; done += CHUNK) {
        size_t here = count - done < CHUNK ? count - done : CHUNK;
        const double *const rest[BL_AXES] = {at[0] + done, at[1] + done, at[2] + done,
                                             at[3] + done};
        bl_value_points(&values, rest, here, out + done);
        bl_gradient_points(&gradients, rest, here, part);
        add_parts(p, here, part, out + done);
    }
}

typedef struct both_parts {
    bl_value_noise values;
    bl_gradient_noise gradients;
} both_parts;

static both_parts open_parts(const void *block) {
    return (both_parts){value_part(block), gradient_part(block)};
}

static double value_at(const void *block, const both_parts *parts, const double at[BL_AXES]) {
    const sum_parameters *p = block;
    return p->value * bl_value_reference(&parts->values, at, NULL) +
           p->gradient * bl_gradient_reference(&parts->gradients, at, NULL);
}

BL_VALUES_OF_OPENED(both_parts, open_parts)

static void gradient(const void *block, const double at[BL_AXES], double out[BL_AXES]) {
    const sum_parameters *p = block;
    bl_value_noise values = value_part(p);
    bl_gradient_noise gradients = gradient_part(p);
    double part[BL_AXES];
    bl_value_reference(&values, at, out);
    bl_gradient_reference(&gradients, at, part);
    for (int axis = 0; axis < BL_AXES; axis++)
        out[axis] = p->value * out[axis] + p->gradient * part[axis];
}

static double gradient_square(const sum_parameters *p) {
    return p->gradients == BL_GRADIENTS_EDGES ? 2 : 1;
}

static bl_terms terms_of(const void *block) {
    const sum_parameters *p = block;
    bl_terms terms = {0};
    bl_terms_add_value(&terms, p->value * p->value * BL_VALUE_VARIANCE(BL_LATTICE_VALUES),
                       bl_value_kernels[p->interp]);
    bl_terms_add_gradient(&terms, p->gradient * p->gradient * gradient_square(p) / 3,
                          bl_gradient_ramps[p->fade], bl_gradient_weights[p->fade]);
    return terms;
}

BL_CLOSED_FORM_OF_TERMS

static void describe(const void *block, bl_facts *facts) {
    const sum_parameters *p = block;
    bl_terms terms = terms_of(block);
    bl_kernel kernel = bl_value_kernels[p->interp], weight = bl_gradient_weights[p->fade];
    int value_class = bl_kernel_continuity(kernel), gradient_class = bl_kernel_continuity(weight);
    bl_terms_describe(&terms, 1, &p->lattice, facts);
    double bound =
        fabs(p->value) * bl_bound_value(kernel).value +
        fabs(p->gradient) * bl_bound_gradient(weight, p->gradients == BL_GRADIENTS_EDGES).value;
    // The lower class of the two; a part of weight 0 takes nothing away.
    if (p->value == 0)
        value_class = gradient_class;
    else if (p->gradient == 0)
        gradient_class = value_class;
    int continuity = value_class < gradient_class ? value_class : gradient_class;
    bl_lattice_describe((bl_bound){bound, "the weighted sum of the bounds of vnoise and gnoise"},
                        continuity, &p->lattice, facts);
}

static float textbook(float x, float y, float z) {
    return 0.5f * bl_textbook_value(x, y, z) + bl_textbook_gradient(x, y, z);
}

static const bl_parameter parameters[] = {
    BL_LATTICE_PARAMETERS(sum_parameters, "the values and the gradients"),
    {"value", BL_REAL, offsetof(sum_parameters, value), "1/2", "", .minimum = -1000,
     .maximum = 1000, .help = "weight of the value noise"},
    {"gradient", BL_REAL, offsetof(sum_parameters, gradient), "1", "", .minimum = -1000,
     .maximum = 1000, .help = "weight of the gradient noise"},
    {"interp", BL_CHOICE, offsetof(sum_parameters, interp), "catmull-rom", "",
     .choices = bl_value_interps, .help = "the kernel of the value noise"},
    {"fade", BL_CHOICE, offsetof(sum_parameters, fade), "cubic", "", .choices = bl_gradient_fades,
     .help = "the blend of the gradient noise"},
    {"gradients", BL_CHOICE, offsetof(sum_parameters, gradients), "sphere", "",
     .choices = bl_gradient_modes,
     .help = "how gradients are drawn: uniform on the sphere, by rejection, or 12 edges"},
    {0}};

BL_NOISE_DESCRIPTOR(value_gradient_sum) = {
    .name = "vgnoise",
    .title = "value-gradient noise",
    .summary = "A weighted sum of value noise and gradient noise.",
    .formula = "n(p) = value * vnoise(p) + gradient * gnoise(p)",
    .paper = "peachey2003, p. 77",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(sum_parameters),
    .describe = describe,
    .has_closed_form = bl_lattice_has_closed_form,
    .textbook = textbook,
    .textbook_settings = BL_TEXTBOOK_PERM256,
    .functions = {BL_NOISE_FUNCTIONS, .values = values, .gradient = gradient, BL_NOISE_CLOSED_FORM},
};
