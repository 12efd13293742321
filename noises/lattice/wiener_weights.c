// SPDX-License-Identifier: MIT
#include "noises/lattice/wiener_weights.h"

#include <math.h>
#include <string.h>

#include "core/quadrature.h"
#include "core/sinc.h"

enum { NODES = BL_WIENER_DEGREE + 1 };

// The covariance at a distance, and its derivative; at 0 that from the right.
static double covariance_at(const bl_wiener_kernel *kernel, double d, double *slope) {
    double x = d / kernel->width, rho;
    switch (kernel->covariance) {
    case BL_WIENER_EXPONENTIAL:
        rho = exp(-fabs(x));
        *slope = (d < 0 ? rho : -rho) / kernel->width;
        return rho;
    case BL_WIENER_SINC:
        if (fabs(x) < 1e-4) { // the next terms are below 1e-16
            *slope = -M_PI * M_PI / 3 * x / kernel->width;
            return 1 - M_PI * M_PI / 6 * x * x;
        }
        rho = bl_sinc(x);
        *slope = (cos(M_PI * x) - rho) / d;
        return rho;
    default:
        rho = exp(-x * x / 2);
        *slope = -x / kernel->width * rho;
        return rho;
    }
}

// The inverse of the covariances of four points by elimination, which needs no pivots: the matrix
// is positive definite.
static void invert(bl_wiener_kernel *kernel) {
    double row[4][8] = {{0}}, slope;
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++)
            row[i][j] = covariance_at(kernel, i - j, &slope);
        row[i][4 + i] = 1;
    }
    for (int pivot = 0; pivot < 4; pivot++)
        for (int i = 0; i < 4; i++) {
            double factor = row[i][pivot] / row[pivot][pivot];
            for (int j = 0; i != pivot && j < 8; j++)
                row[i][j] -= factor * row[pivot][j];
        }
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            kernel->inverse[i][j] = row[i][4 + j] / row[i][i];
}

void bl_wiener_weights(const bl_wiener_kernel *kernel, double t, double weight[4],
                       double slope[4]) {
    double near[4], change[4];
    for (int i = 0; i < 4; i++)
        near[i] = covariance_at(kernel, t - (i - 1), &change[i]);
    for (int i = 0; i < 4; i++) {
        weight[i] = slope[i] = 0;
        for (int j = 0; j < 4; j++) {
            weight[i] += kernel->inverse[i][j] * near[j];
            slope[i] += kernel->inverse[i][j] * change[j];
        }
    }
}

// Turns values at the Chebyshev nodes of [-1/2, 1/2] into the coefficients of the powers: first of
// the Chebyshev polynomials T_n(2 s), by their orthogonality over the nodes, then, by the
// recurrence T_n = 2 y T_{n-1} - T_{n-2}, of the powers of y = 2 s. The coefficients fall fast with
// n, so that the powers, as large as 2^(n-1), lose nothing.
static void fit(const double value[NODES], double coefficient[NODES]) {
    double before[NODES] = {0}, here[NODES] = {1}; // T_{n-1} and T_n; T_{-1} = T_1
    before[1] = 1;
    memset(coefficient, 0, NODES * sizeof *coefficient);
    for (int n = 0; n < NODES; n++) {
        double c = 0, next[NODES] = {0};
        for (int i = 0; i < NODES; i++)
            c += value[i] * cos(M_PI * n * (i + 0.5) / NODES) * (n ? 2.0 : 1.0) / NODES;
        for (int k = 0; k < NODES; k++) {
            coefficient[k] += c * here[k] * ldexp(1, k);
            next[k] = 2 * (k ? here[k - 1] : 0) - before[k];
        }
        memcpy(before, here, sizeof before);
        memcpy(here, next, sizeof here);
    }
}

bl_wiener_kernel bl_wiener_kernel_of(bl_wiener_covariance covariance, double width) {
    bl_wiener_kernel kernel = {.covariance = covariance, .width = width};
    double value[2][NODES];
    invert(&kernel);
    for (int i = 0; i < NODES; i++) {
        double weight[4], slope[4];
        bl_wiener_weights(&kernel, 0.5 + 0.5 * cos(M_PI * (i + 0.5) / NODES), weight, slope);
        value[0][i] = weight[1];
        value[1][i] = weight[0];
    }
    fit(value[0], kernel.piece[0]);
    fit(value[1], kernel.piece[1]);
    return kernel;
}

static double polynomial(const double coefficient[NODES], double s) {
    double sum = coefficient[NODES - 1];
    for (int k = NODES - 2; k >= 0; k--)
        sum = coefficient[k] + s * sum;
    return sum;
}

double bl_wiener_value(const bl_wiener_kernel *kernel, double x) {
    double d = fabs(x);
    return d < 1   ? polynomial(kernel->piece[0], d - 0.5)
           : d < 2 ? polynomial(kernel->piece[1], d - 1.5)
                   : 0;
}

// k(x) k(x + lag) between two breaks: a polynomial of degree 26, for which 16 nodes are exact.
static double panel(const bl_wiener_kernel *kernel, double lag, double from, double to) {
    double sum = 0, half = (to - from) / 2;
    for (int i = 0; i < BL_QUADRATURE_NODES; i++) {
        double x = from + half * (1 + bl_quadrature_node[i]);
        sum +=
            bl_quadrature_weight[i] * bl_wiener_value(kernel, x) * bl_wiener_value(kernel, x + lag);
    }
    return half * sum;
}

// The breaks are the whole numbers and the whole numbers minus the lag.
double bl_wiener_correlation(const bl_wiener_kernel *kernel, double lag) {
    double d = fabs(lag), part = ceil(d) - d, sum = 0;
    for (double x = -2; x + d < 2; x++) {
        sum += panel(kernel, d, x, x + part);
        if (x + part + d < 2)
            sum += panel(kernel, d, x + part, x + 1);
    }
    return sum;
}

// Panels of half a cycle at most.
double bl_wiener_transform(const bl_wiener_kernel *kernel, double f) {
    double sum = 0, parts = ceil(fmax(1, 2 * fabs(f))), half = 0.5 / parts;
    for (double n = 0; n < 2 * parts; n++)
        for (int i = 0; i < BL_QUADRATURE_NODES; i++) {
            double x = half * (2 * n + 1 + bl_quadrature_node[i]);
            sum +=
                half * bl_quadrature_weight[i] * bl_wiener_value(kernel, x) * cos(2 * M_PI * f * x);
        }
    return 2 * sum;
}

double bl_wiener_largest_sum(const bl_wiener_kernel *kernel) {
    enum { STEPS = 4096 };
    double most = 0, steepest = 0;
    for (int n = 0; n <= STEPS; n++) {
        double s = 0.5 * n / STEPS, sum = 0;
        for (int piece = 0; piece < 2; piece++)
            sum += fabs(polynomial(kernel->piece[piece], s)) +
                   fabs(polynomial(kernel->piece[piece], -s));
        most = fmax(most, sum);
    }
    for (int piece = 0; piece < 2; piece++)
        for (int k = 1; k < NODES; k++)
            steepest += 2 * k * fabs(kernel->piece[piece][k]) * ldexp(2, -k);
    return most + steepest * 0.25 / STEPS + 4 * 3e-9;
}
