// SPDX-License-Identifier: MIT
//
// Radial kernels of sparse impulses on the unit disc or ball, K(q) with q = r^2, and what follows
// from them: transforms, correlations, spectra of sums of impulses.
//
//   catmull-rom  the radial Catmull-Rom kernel of radius 2 (radial_kernel.h), at 2 r; C1
//   cosine       (1 + cos(pi r))/2, the raised cosine (Lewis 1989); C1
//   gaussian     (e^(-G q) - E - G E (1-q)) / (1 - E (1+G)), G = 6, E = e^-G = 0.0024788: a
//                Gaussian of standard deviation 1/sqrt(2G) = 0.28868, less the tangent in q at the
//                rim, so that it ends without a step (0.0025 if merely cut off) and without a bend.
//                It differs from the Gaussian by at most E (1+G)/(1 - E (1+G)) = 0.0177, and its
//                spectrum falls as that of a C1 kernel instead of that of a step; C1
//   ring         2 (e^(-G q) - e^(-4 G q) - A - B (1-q)), A = E - E^4, B = G (E - 4 E^4): the
//                difference of two Gaussians, less the tangent at the rim; C1. Its crest of 0.9126
//                is at r = 0.28; -0.0347 in the middle.
//   disc         1; discontinuous
// All are 0 for q >= 1.
//
// Transform, radial too:  2-D  2 pi int r K J0(2 pi f r) dr,  3-D  4 pi int r^2 K sinc(2 f r) dr;
// of the disc J1(2 pi f)/f, of the ball (sin u - u cos u)/(2 pi^2 f^3), u = 2 pi f. The integrals
// are taken by Gauss-Legendre panels shorter than a period of the wave; error below 1e-13.
//
// Correlation at the distance d: the integral of K(|u - d/2|) K(|u + d/2|) over the lens |s| + d/2
// = cos t, height sin t, in which both factors are smooth functions of the squared distances, so
// that Gauss-Legendre panels in t and in the distance from the axis converge geometrically; error
// below 1e-10. t-impulses holds both against other quadratures.
//
// Pure functions; any thread may call them.
#ifndef BL_NOISES_IMPULSES_IMPULSE_PROFILES_H
#define BL_NOISES_IMPULSES_IMPULSE_PROFILES_H

#include "core/signal.h"

typedef enum bl_profile {
    BL_PROFILE_CATMULL_ROM,
    BL_PROFILE_COSINE,
    BL_PROFILE_GAUSSIAN,
    BL_PROFILE_RING,
    BL_PROFILE_DISC
} bl_profile;

#define BL_GAUSSIAN_RATE 6.0                         // G
#define BL_GAUSSIAN_EDGE 0.0024787521766663584230    // E = e^-G
#define BL_GAUSSIAN_EDGE_4 3.7751345442790977516e-11 // E^4

double bl_profile_value(bl_profile profile, double q);
double bl_profile_slope(bl_profile profile, double q); // dK/dq
double bl_profile_most(bl_profile profile);            // of |K|, rounded up

// Both for 2 or 3 dimensions; not for catmull-rom, whose forms are in kernel.h.
double bl_profile_transform(bl_profile profile, unsigned dimensions, double frequency);
double bl_profile_correlation(bl_profile profile, unsigned dimensions, double distance);

// The share of the variance above a frequency of the spectrum along an axis, by quadrature of a
// covariance that reaches over lags below `reach`: good to 1e-6 where the covariance is smooth.
typedef double bl_covariance_function(const void *parameters, const double lag[BL_AXES]);
double bl_share_above(bl_covariance_function *covariance, const void *parameters, unsigned axis,
                      double reach, double frequency);

// Fills what follows from a covariance: mean 0, variance, reach, and the band from 0 to `band` with
// its exact leak along the worst of the axes, rounded up to the next hundredth of a dB.
void bl_impulses_describe(bl_covariance_function *covariance, const void *parameters,
                          unsigned dimensions, double reach, double band, bl_facts *facts);

// The bound of sparse convolution in space with a kernel of radius 2 whose counts are fixed: the
// sum over the cells of the largest K in each, rounded up. For cosine and gaussian.
double bl_profile_sparse_bound(bl_profile profile);

#endif
