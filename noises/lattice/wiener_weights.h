// SPDX-License-Identifier: MIT
//
// Weights of Wiener interpolation on a line: the linear estimate, of least mean square error, of a
// stationary field of mean 0 and covariance rho at t in [0, 1) from its values at the points -1, 0,
// 1 and 2.
//
// E[(f(t) - sum_i w_i f(i))^2] is least where its derivatives by the w_i are 0:
//
//   sum_j rho(i - j) w_j = rho(t - i)   for each i,   w = C^-1 c(t)
//
// By the reflection t -> 1 - t, w_i(t) = w_{1-i}(1 - t): the weights are the samples k(t - i) of an
// even kernel with two pieces, k(x) = w_0(x) on [0, 1] and k(x) = w_{-1}(x - 1) on [1, 2]. Since
// c(0) and c(1) are columns of C, k(0) = 1 and k(1) = k(2) = 0: it interpolates and is continuous.
//
// With width w, the covariances are
//   gaussian     exp(-(d/w)^2 / 2)
//   exponential  exp(-|d|/w); only the two nearest points count (it is a Markov process), with the
//                weights sinh((1-t)/w)/sinh(1/w) and sinh(t/w)/sinh(1/w)
//   sinc         sin(pi d/w)/(pi d/w), of a field that is flat up to the frequency 1/(2w); with w =
//   1
//                C = I, and the weights are the samples of a sinc cut at |x| = 2
// For 1/2 <= w <= 2 the matrix C is at worst conditioned to 1e5, and the weights are good to 1e-10.
//
// All functions are pure and may be called from several threads.
#ifndef BL_NOISES_LATTICE_WIENER_WEIGHTS_H
#define BL_NOISES_LATTICE_WIENER_WEIGHTS_H

typedef enum bl_wiener_covariance {
    BL_WIENER_GAUSSIAN,
    BL_WIENER_EXPONENTIAL,
    BL_WIENER_SINC
} bl_wiener_covariance;

enum { BL_WIENER_DEGREE = 13 };

typedef struct bl_wiener_kernel {
    bl_wiener_covariance covariance;
    double width;
    double inverse[4][4]; // C^-1, for the exact weights
    // The two pieces of k as polynomials in x - 1/2 and x - 3/2, by interpolation at 14 Chebyshev
    // nodes; the error is below 3e-9 for 1/2 <= w <= 2 (largest for the sinc of width 1/2).
    double piece[2][BL_WIENER_DEGREE + 1];
} bl_wiener_kernel;

bl_wiener_kernel bl_wiener_kernel_of(bl_wiener_covariance covariance, double width);

// The exact weights of the points -1 to 2 and their derivatives.
void bl_wiener_weights(const bl_wiener_kernel *kernel, double t, double weight[4], double slope[4]);

// From here on k is that of the pieces. k(x); int k(x) k(x + lag) dx, by a quadrature that is exact
// except for rounding; int k(x) cos(2 pi f x) dx, to 1e-14.
double bl_wiener_value(const bl_wiener_kernel *kernel, double x);
double bl_wiener_correlation(const bl_wiener_kernel *kernel, double lag);
double bl_wiener_transform(const bl_wiener_kernel *kernel, double f);

// A bound of sum_i |w_i(t)| over all t: the largest of 4097 places on half of the cell, plus half a
// step times a bound of the slope, plus the error of the pieces.
double bl_wiener_largest_sum(const bl_wiener_kernel *kernel);

#endif
