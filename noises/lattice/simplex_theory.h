// SPDX-License-Identifier: MIT
//
// Closed forms of the sum over the points c of the lattice of simplices (A_n*, as the skewed grid
// of simplex noise has it) of g_c . d w(|d|), d = p - c, w(r) = (1/2 - r^2)^4 for r^2 < 1/2, else
// 0, with independent gradients of mean 0 and E[g g^T] = s I.
//
// Over a uniformly random place the sum over the points becomes an integral. The lattice has
// sqrt(n+1) points a unit of volume, the determinant of the skew I + F 1 1^T with 1 + n F =
// sqrt(n+1). With V(d) = d w(|d|) the covariance is
//
//   R(t) = sqrt(n+1) s int V(x) . V(x + t) dx,
//
// a function of |t| alone, 0 from sqrt 2 on. V is the gradient of -(1/2 - r^2)^5 / 10, whose
// transform is a Bessel function (Sonine): with a^2 = 1/2 and z = 2 pi a |f|
//
//   int (a^2 - r^2)^5 e^(-2 pi i f x) dx = pi^(n/2) 5!/Gamma(n/2 + 6) a^(n+10) L(z),
//   L(z) = Gamma(v + 1) (2/z)^v J_v(z),  v = n/2 + 5,
//
// and the density is sqrt(n+1) s (2 pi |f|)^2 times a hundredth of its square. The covariance is by
// Gauss-Legendre quadrature along t and across it: exact except for rounding in 3 dimensions, where
// all is polynomial; in 2 and 4 the slices of the lens end as odd powers of a root, which is taken
// as the variable, and the error is below 1e-13 of the variance (t-simplex).
//
// dims is 2, 3 or 4; all functions are pure and may be called from several threads.
#ifndef BL_NOISES_LATTICE_SIMPLEX_THEORY_H
#define BL_NOISES_LATTICE_SIMPLEX_THEORY_H

// With s = 1.
double bl_simplex_covariance(unsigned dims, double distance);
double bl_simplex_density(unsigned dims, double frequency);

#endif
