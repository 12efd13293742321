// SPDX-License-Identifier: MIT
//
// The radial Catmull-Rom kernel K(|x|) in three dimensions reduces to the odd kernel g(r) = r k(r).
//
// Transform. For a radial function, K^(f) = (2/f) int_0^2 r k(r) sin(2 pi f r) dr, which is the
// sine transform of g over f; at f = 0 it is 4 pi int_0^2 r^2 k(r) dr.
//
// Correlation. In bipolar coordinates about the two centres, at a distance d,
//     R(d) = (2 pi / d) int_0 r k(r) int_{|r-d|}^{r+d} s k(s) ds dr.
// With G(x) = int_{|x|} s k(s) ds, which is even and has G' = -g, the inner integral is
// G(r-d) - G(r+d); since g is odd the two parts are one integral over all r, C(d) = int g(r)
// G(r-d) dr, whose derivative is int g(r) g(r-d) dr = rho_g(d). C is odd, hence
//     R(d) = (2 pi / d) int_0^d rho_g(t) dt,
// a polynomial over d on [n, n+1], and a polynomial on [0, 1]. R vanishes from 4 on, because the
// integral of rho_g is the square of the integral of g, 0.
//
// Continuity. K is even and smooth in r^2 except for r^3 at the centre, which is C2 in space; it
// and its first derivative meet at r = 1 and r = 2, the second derivatives 4 and 2 do not meet at
// 1. So K is C1.
#include <math.h>

#include "noises/lattice/kernel_tables.h"

double bl_radial_value(double distance) {
    return bl_kernel_value(BL_KERNEL_CATMULL_ROM, distance);
}

// The quotient holds for every f but 0: the sine transform is proportional to f near 0.
double bl_radial_transform(double frequency) {
    double f = fabs(frequency);
    if (f < 1e-150) // the limit, to 1e-299
        f = 1e-150;
    return bl_kernel_transform(BL_KERNEL_RADIAL, f) / f;
}

// radial[0] in powers of d; radial[n] in powers of d - n - 1/2, to be divided by d.
void bl_kernel_find_radial(const bl_correlation *ramp, bl_correlation *radial) {
    *radial = (bl_correlation){.pieces = ramp->pieces};
    double reached = 0; // int_0^n rho_g
    for (int n = 0; n < ramp->pieces; n++) {
        const double *rho = ramp->coefficient[n];
        double *out = radial->coefficient[n];
        for (int p = 0; p + 1 < BL_CORRELATION_ORDERS; p++)
            out[p + 1] = 2 * M_PI * rho[p] / (p + 1);
        out[0] = reached - bl_polynomial(out, BL_CORRELATION_ORDERS, -0.5);
        reached = bl_polynomial(out, BL_CORRELATION_ORDERS, 0.5);
    }
    // Piece 0 about d = 0 instead, divided by d: rho_g = sum c_p (d - 1/2)^p = sum b_q d^q.
    double about_zero[BL_CORRELATION_ORDERS] = {0};
    for (int p = BL_CORRELATION_ORDERS - 1; p >= 0; p--) {
        for (int q = BL_CORRELATION_ORDERS - 1; q > 0; q--)
            about_zero[q] = about_zero[q - 1] - 0.5 * about_zero[q];
        about_zero[0] = ramp->coefficient[0][p] - 0.5 * about_zero[0];
    }
    for (int q = 0; q < BL_CORRELATION_ORDERS; q++)
        radial->coefficient[0][q] = 2 * M_PI * about_zero[q] / (q + 1);
}

double bl_radial_correlation(double distance) {
    const bl_correlation *radial = &bl_kernel_get_tables()->radial;
    double d = fabs(distance);
    if (!(d < radial->pieces))
        return isnan(d) ? d : 0;
    int n = (int)d;
    if (n == 0)
        return bl_polynomial(radial->coefficient[0], BL_CORRELATION_ORDERS, d);
    return bl_polynomial(radial->coefficient[n], BL_CORRELATION_ORDERS, d - n - 0.5) / d;
}
