// SPDX-License-Identifier: MIT
//
// The kernels of the lattice noises as piecewise polynomials: values, transforms, correlations.
//
// A kernel k is even or odd and has compact support. Its transform and its continuity follow from
// its jumps J(x, m) (core/piecewise.h), and so does its correlation:
//
//   correlation  rho(t) = int k(x) k(x+t) dx has the transform |k^|^2, a product of two such sums:
//                it is again a piecewise polynomial, with the jump (-1)^(m+1) J(x, m) J(y, n) of
//                order m+n+1 at the knot y-x
//
// All functions are pure and may be called from several threads.
#ifndef BL_NOISES_LATTICE_KERNEL_H
#define BL_NOISES_LATTICE_KERNEL_H

typedef enum bl_kernel {
    BL_KERNEL_CATMULL_ROM,  // interpolation by the Catmull-Rom spline: C1, support 2
    BL_KERNEL_LINEAR,       // 1 - |x|: C0, support 1; the value weight of every linear blend
    BL_KERNEL_SMOOTH,       // 1 - (3x^2 - 2|x|^3): C1, support 1
    BL_KERNEL_QUINTIC,      // 1 - (6|x|^5 - 15x^4 + 10|x|^3): C2, support 1
    BL_KERNEL_BSPLINE2,     // quadratic B-spline, knots at the half integers: C1, support 1.5
    BL_KERNEL_BSPLINE3,     // cubic B-spline: C2, support 2
    BL_KERNEL_RAMP_LINEAR,  // x (1 - |x|): odd, C0; the gradient weights of the three fades
    BL_KERNEL_RAMP_SMOOTH,  // x times BL_KERNEL_SMOOTH: odd, C1
    BL_KERNEL_RAMP_QUINTIC, // x times BL_KERNEL_QUINTIC: odd, C2
    BL_KERNEL_TANGENT,      // x (1 - |x|)^2, the tangent weight of Hermite interpolation: odd, C1
    BL_KERNEL_RADIAL,       // x times BL_KERNEL_CATMULL_ROM: odd; serves the radial kernel below
    BL_KERNEL_COUNT
} bl_kernel;

int bl_kernel_is_odd(bl_kernel kernel);
double bl_kernel_support(bl_kernel kernel);
int bl_kernel_continuity(bl_kernel kernel);

double bl_kernel_value(bl_kernel kernel, double x);
// int k cos(2 pi f x) dx of an even kernel, int k sin(2 pi f x) dx of an odd one; |k^| is its size.
double bl_kernel_transform(bl_kernel kernel, double f);
// rho(lag) = int k(x) k(x + lag) dx; 0 from twice the support on.
double bl_kernel_correlation(bl_kernel kernel, double lag);

// The Catmull-Rom kernel as a function of the distance in three dimensions, radius 2.
enum { BL_RADIAL_REACH = 4 }; // of its correlation
double bl_radial_value(double distance);
double bl_radial_transform(double frequency);  // its 3-D transform at |f|
double bl_radial_correlation(double distance); // int K(|x|) K(|x + d|) dx over space

#endif
