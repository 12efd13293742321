// SPDX-License-Identifier: MIT
//
// Closed forms of Gabor noise: the autocorrelation and the energy spectrum of one kernel
//
//   K(x) = g(|x|) cos(2 pi (F u.x + phi)),   g(r) = e^(-pi a^2 r^2) for r < 1, 0 beyond
//
// averaged over the phase (if random, phi uniform; else 0) and the direction (if isotropic, u
// uniform on the circle). With G the transform of the truncated Gaussian g, and f-, f+ = |f -+ F
// u|:
//
//   random phase   |K^|^2 = (G(f-)^2 + G(f+)^2)/4        K*K = A(d) cos(2 pi F u.lag)/2
//   zero phase     |K^|^2 = (G(f-) + G(f+))^2/4          K*K = the same + B(lag)/2
//
// A(d) is the autocorrelation of g: with x from the middle of the lens of the two discs,
// e^(-pi a^2 d^2/2) int e^(-2 pi a^2 |x|^2) dx; B has the factor cos(4 pi F u.x) in the integral.
// The mean over directions makes J0(2 pi F d) and J0(4 pi F |x|) of the cosines.
//
// Without the truncation G(f) = e^(-pi f^2/a^2)/a^2, so that the spectrum for random phase is two
// Gaussians at +-F u, their mean over the circle a ring,
// e^(-2 pi (f^2+F^2)/a^2) I0(4 pi f F/a^2)/(2 a^4) with the modified Bessel function I0, and
// A(d) = e^(-pi a^2 d^2/2)/(2 a^2). The truncation takes the share e^(-2 pi a^2) of the energy of g
// (0.19 % for a = 1) and gives G a tail of sidelobes that falls as f^-3/2, of size e^(-pi a^2)/f
// J1(2 pi f): all that is in the integrals here. They are taken by Gauss-Legendre panels: G to
// 1e-13, A to 1e-12, B to 1e-9, the mean over directions by equal steps to 1e-12 (t-impulses).
//
// Pure functions; any thread may call them.
#ifndef BL_NOISES_IMPULSES_GABOR_FORMS_H
#define BL_NOISES_IMPULSES_GABOR_FORMS_H

typedef struct bl_gabor {
    double frequency;    // F, cycles a cell
    double bandwidth;    // a, cycles a cell
    double direction[2]; // u
    int isotropic, zero_phase;
} bl_gabor;

double bl_gabor_envelope(double bandwidth, double frequency); // G
double bl_gabor_density(const bl_gabor *kernel, double fx, double fy);
double bl_gabor_covariance(const bl_gabor *kernel, double x, double y); // 0 from distance 2 on

#endif
