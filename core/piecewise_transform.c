// SPDX-License-Identifier: MIT
//
// The transform of a piecewise polynomial, by two routes that t-kernel compares where they meet.
//
// From |f| = 2 on, the sum over the jumps (core/piecewise.h). The knots x and -x give
// conjugate terms for an even function and opposite ones for an odd one, so with w = 2 pi f
//     even:  k^ = sum_m w^-(m+1) [J(0,m) c_m(0) + 2 sum_{x>0} J(x,m) c_m(w x)]
//            with c_m(a) = Re(e^(-ia) i^-(m+1)) = cos(a + (m+1) pi/2)
//     odd:   the same with s_m(a) = sin(a + (m+1) pi/2): -Im of the same number.
// The largest term is below 4320/w^7 < 1e-4 there (the sixth derivative of the quintic ramp), so
// the sum is good to 1e-20 and loses nothing to cancellation.
//
// Below, where powers of 1/w cancel, Gauss-Legendre on each piece: a polynomial of degree at most
// 6 times a cosine of at most 2 cycles, 16 nodes on each half of the piece; the error is below the
// rounding, 1e-16.
#include <math.h>

#include "core/piecewise.h"
#include "core/quadrature.h"

static double by_jumps(const bl_piecewise_jumps *jumps, int odd, double f) {
    double w = 2 * M_PI * f, sum = 0;
    for (int i = 0; i < jumps->count; i++) {
        // f x in cycles, reduced before it is scaled: exact remainders for any f.
        double angle = 2 * M_PI * remainder(f * jumps->knot[i], 1);
        double cosine = cos(angle), sine = sin(angle), at_knot = 0, power = 1 / w;
        for (int m = 0; m < BL_PIECEWISE_ORDERS; m++, power /= w) {
            double turned = sine; // cos or sin of (angle + (m+1) pi/2), turned below
            switch ((m + 1 - odd) & 3) {
            case 0:
                turned = cosine;
                break;
            case 1:
                turned = -sine;
                break;
            case 2:
                turned = -cosine;
                break;
            default:
                break;
            }
            at_knot += jumps->jump[i][m] * power * turned;
        }
        sum += i == 0 ? at_knot : 2 * at_knot;
    }
    return sum;
}

static double by_quadrature(const bl_piecewise *shape, double f) {
    double left = 0, sum = 0;
    for (int i = 0; i < BL_PIECEWISE_PIECES && shape->knot[i] > 0; i++) {
        double half = (shape->knot[i] - left) / 4; // half of the width of half a piece
        for (int part = 1; part <= 3; part += 2)
            for (int n = 0; n < BL_QUADRATURE_NODES; n++) {
                double x = left + half * (part + bl_quadrature_node[n]);
                double value = bl_polynomial(shape->coefficient[i], BL_PIECEWISE_ORDERS, x);
                double angle = 2 * M_PI * f * x;
                sum +=
                    half * bl_quadrature_weight[n] * value * (shape->odd ? sin(angle) : cos(angle));
            }
        left = shape->knot[i];
    }
    return 2 * sum;
}

double bl_piecewise_transform(const bl_piecewise *function, const bl_piecewise_jumps *jumps,
                              double f) {
    if (!(fabs(f) >= 2))
        return by_quadrature(function, f) / function->divisor;
    if (isinf(f))
        return 0;
    double size = by_jumps(jumps, function->odd, fabs(f)) / function->divisor;
    return function->odd && f < 0 ? -size : size;
}
