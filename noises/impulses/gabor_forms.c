// SPDX-License-Identifier: MIT
#include "noises/impulses/gabor_forms.h"

#include <math.h>

#include "core/quadrature.h"

enum { NODES = BL_QUADRATURE_NODES };

// Node i of equal panels on [0, length], and its weight.
static double node(double length, int panels, int i, double *weight) {
    double half = length / (2 * panels);
    *weight = half * bl_quadrature_weight[i % NODES];
    return half * (2 * (i / NODES) + 1 + bl_quadrature_node[i % NODES]);
}

// Beyond this frequency G, then below 1e-8, counts as 0.
#define HIGHEST 1e4

double bl_gabor_envelope(double bandwidth, double frequency) {
    double f = fabs(frequency), sum = 0;
    if (!(f < HIGHEST))
        return isnan(f) ? f : 0;
    int panels = (int)ceil(f) + (int)ceil(bandwidth);
    for (int i = 0; i < panels * NODES; i++) {
        double weight, r = node(1, panels, i, &weight);
        sum += weight * 2 * M_PI * r * exp(-M_PI * bandwidth * bandwidth * r * r) *
               j0(2 * M_PI * f * r);
    }
    return sum;
}

static double density_of(const bl_gabor *kernel, double fx, double fy, double ux, double uy) {
    double gx = kernel->frequency * ux, gy = kernel->frequency * uy;
    double minus = bl_gabor_envelope(kernel->bandwidth, hypot(fx - gx, fy - gy));
    double plus = bl_gabor_envelope(kernel->bandwidth, hypot(fx + gx, fy + gy));
    double cross = kernel->zero_phase ? 2 * minus * plus : 0;
    return (minus * minus + plus * plus + cross) / 4;
}

double bl_gabor_density(const bl_gabor *kernel, double fx, double fy) {
    if (!kernel->isotropic)
        return density_of(kernel, fx, fy, kernel->direction[0], kernel->direction[1]);
    // The integrand is periodic and even in u: equal steps over half a turn converge as soon as
    // they resolve its harmonics, of which there are some 4 pi f F (twice the argument of J0 at the
    // rim of the correlation of g).
    double f = hypot(fx, fy), sum = 0;
    int steps = 32 + (int)fmin(ceil(16 * f * kernel->frequency), 4096);
    if (isnan(f))
        return f;
    for (int i = 0; i < steps; i++) {
        double angle = M_PI * (i + 0.5) / steps;
        sum += density_of(kernel, f, 0, cos(angle), sin(angle));
    }
    return sum / steps;
}

// s + d/2 = cos(angle), the height of the lens sin(angle).
static double gaussian_correlation(double a, double d) {
    double sum = 0, length = acos(d / 2);
    int panels = 1 + (int)ceil(a);
    for (int i = 0; i < panels * NODES; i++) {
        double weight, angle = node(length, panels, i, &weight);
        double s = cos(angle) - d / 2, height = sin(angle);
        sum += weight * height * exp(-2 * M_PI * a * a * s * s) * erf(sqrt(2 * M_PI) * a * height);
    }
    // 4 quarters; int_0^h e^(-2 pi a^2 t^2) dt = erf(sqrt(2 pi) a h) / (2 sqrt 2 a).
    return exp(-M_PI * a * a * d * d / 2) * 4 * sum / (2 * M_SQRT2 * a);
}

// The lens integral with the wave of twice the frequency; `along` and `across` are the components
// of u. Even in both s and t.
static double wave_correlation(const bl_gabor *kernel, double d, double along, double across) {
    double a = kernel->bandwidth, k = 4 * M_PI * kernel->frequency, sum = 0, length = acos(d / 2);
    int panels = 1 + (int)ceil(a / 2 + kernel->frequency);
    for (int i = 0; i < panels * NODES; i++) {
        double weight, angle = node(length, panels, i, &weight), inner = 0;
        double s = cos(angle) - d / 2, height = sin(angle);
        for (int j = 0; j < panels * NODES; j++) {
            double own, t = node(height, panels, j, &own);
            double wave = kernel->isotropic ? j0(k * sqrt(s * s + t * t))
                                            : cos(k * along * s) * cos(k * across * t);
            inner += own * wave * exp(-2 * M_PI * a * a * t * t);
        }
        sum += weight * height * inner * exp(-2 * M_PI * a * a * s * s);
    }
    return exp(-M_PI * a * a * d * d / 2) * 4 * sum;
}

double bl_gabor_covariance(const bl_gabor *kernel, double x, double y) {
    double d = hypot(x, y), f = kernel->frequency;
    if (!(d < 2))
        return isnan(d) ? d : 0;
    double along = kernel->direction[0], across = kernel->direction[1], turn = 0;
    if (d > 0) {
        turn = along * x + across * y;
        across = (across * x - along * y) / d;
        along = turn / d;
    }
    double wave = kernel->isotropic ? j0(2 * M_PI * f * d) : cos(2 * M_PI * f * turn);
    double sum = gaussian_correlation(kernel->bandwidth, d) * wave;
    if (kernel->zero_phase)
        sum += wave_correlation(kernel, d, along, across);
    return sum / 2;
}
