// SPDX-License-Identifier: MIT
#include "noises/lattice/simplex_theory.h"

#include <math.h>

#include "core/quadrature.h"

// The half of the lens beyond its middle, at a height z above it: the integral across, s from 0 to
// where the farther ball ends. `across` is the measure of the sphere of directions across.
static double lens_slice(unsigned dims, double z, double t) {
    static const double across[] = {0, 0, 2, 2 * M_PI, 4 * M_PI};
    double near = (z - t / 2) * (z - t / 2), far = (z + t / 2) * (z + t / 2), sum = 0;
    double half = sqrt(fmax(0, 0.5 - far)) / 2;
    for (int i = 0; i < BL_QUADRATURE_NODES; i++) {
        double s = half * (1 + bl_quadrature_node[i]), square = s * s;
        double both = (0.5 - square - near) * (0.5 - square - far);
        double dot = square + z * z - t * t / 4;
        sum += bl_quadrature_weight[i] * pow(s, dims - 2) * dot * both * both * both * both;
    }
    return across[dims] * half * sum;
}

double bl_simplex_covariance(unsigned dims, double distance) {
    double top = M_SQRT1_2 - distance / 2, sum = 0;
    if (!(top > 0))
        return 0;
    for (int i = 0; i < 2 * BL_QUADRATURE_NODES; i++) {
        // In even dimensions a slice ends as an odd power of the root of top - z: of q.
        double q = (1 + bl_quadrature_node[i / 2] + 2 * (i % 2)) / 4;
        double z = dims == 3 ? top * q : top * (1 - q * q);
        double slice = lens_slice(dims, z, distance);
        sum += bl_quadrature_weight[i / 2] * (dims == 3 ? 1 : 2 * q) * slice;
    }
    return 2 * sqrt(dims + 1) * top / 4 * sum;
}

// Gamma(v+1) (2/z)^v J_v(z) by its series: at z < 8 no term is above 2.4, and the 30th is below
// 1e-20.
static double bessel_series(double v, double z) {
    double term = 1, sum = 1;
    for (int k = 1; k <= 30; k++) {
        term *= -z * z / 4 / (k * (v + k));
        sum += term;
    }
    return sum;
}

// j_6 by the recurrence upwards, stable for z > 6.
static double spherical_bessel_6(double z) {
    double before = sin(z) / z, here = (before - cos(z)) / z;
    for (int l = 1; l < 6; l++) {
        double next = (2 * l + 1) / z * here - before;
        before = here;
        here = next;
    }
    return here;
}

static double bessel(unsigned dims, double z) {
    double v = dims / 2.0 + 5;
    if (z < 8)
        return bessel_series(v, z);
    double j = dims == 3 ? sqrt(2 * z / M_PI) * spherical_bessel_6(z) : jn((int)v, z);
    return tgamma(v + 1) * pow(2 / z, v) * j;
}

double bl_simplex_density(unsigned dims, double frequency) {
    double half = dims / 2.0, f = fabs(frequency);
    double transform = pow(M_PI, half) * 120 / tgamma(half + 6) * pow(0.5, half + 5) *
                       bessel(dims, 2 * M_PI * M_SQRT1_2 * f);
    double field = 2 * M_PI * f * transform / 10;
    return sqrt(dims + 1) * field * field;
}
