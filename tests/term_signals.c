// SPDX-License-Identifier: MIT
#include "tests/term_signals.h"

#include "tests/test.h"

static double covariance(const void *terms, const double lag[BL_AXES]) {
    return bl_terms_covariance(terms, lag);
}

static double density(const void *terms, const double frequency[BL_AXES]) {
    return bl_terms_density(terms, frequency);
}

static const bl_signal_functions functions = {.covariance = covariance, .density = density};

bl_signal *make_signal(int which) {
    bl_terms terms = {0};
    switch (which) {
    case CATMULL_ROM:
        bl_terms_add_value(&terms, 1.0 / 3, BL_KERNEL_CATMULL_ROM);
        break;
    case GRADIENT:
        bl_terms_add_gradient(&terms, 1.0 / 3, BL_KERNEL_RAMP_SMOOTH, BL_KERNEL_SMOOTH);
        break;
    case GRADIENT_QUINTIC:
        bl_terms_add_gradient(&terms, 1.0 / 3, BL_KERNEL_RAMP_QUINTIC, BL_KERNEL_QUINTIC);
        break;
    case LINEAR:
        bl_terms_add_value(&terms, 1.0 / 3, BL_KERNEL_LINEAR);
        break;
    case HERMITE:
        bl_terms_add_value(&terms, 1.0 / 3, BL_KERNEL_SMOOTH);
        bl_terms_add_gradient(&terms, 1.0 / 3, BL_KERNEL_TANGENT, BL_KERNEL_SMOOTH);
        break;
    default:
        bl_terms_add_radial(&terms, 1.0 / 3);
    }
    bl_signal *signal = bl_signal_new(&functions, &terms, sizeof terms, "terms");
    assert_non_null(signal);
    signal->closed_form = 1;
    signal->dimensions = 3;
    bl_terms_describe(&terms, 1, &(bl_lattice_settings){0}, &signal->facts);
    return signal;
}

double variance_of(const bl_signal *signal) {
    return bl_terms_variance(signal->parameters);
}
