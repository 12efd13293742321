// SPDX-License-Identifier: MIT
//
// The transform of a kernel, by two routes that t-kernel compares where they meet.
//
// From |f| = 2 on, the sum over the jumps (noises/kernel.h). The knots x and -x give conjugate
// terms for an even kernel and opposite ones for an odd kernel, so with w = 2 pi f
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

#include "core/quadrature.h"
#include "noises/kernel_tables.h"

static double by_jumps(const bl_kernel_jumps *jumps, int odd, double f) {
    double w = 2 * M_PI * f, sum = 0;
    for (int i = 0; i < jumps->count; i++) {
        // f x in cycles, reduced before it is scaled: exact remainders for any f.
        double angle = 2 * M_PI * remainder(f * jumps->knot[i], 1);
        double cosine = cos(angle), sine = sin(angle), at_knot = 0, power = 1 / w;
        for (int m = 0; m < BL_KERNEL_ORDERS; m++, power /= w) {
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

static double by_quadrature(bl_kernel kernel, double f) {
    const bl_kernel_shape *shape = &bl_kernel_shapes[kernel];
    double left = 0, sum = 0;
    for (int i = 0; i < BL_KERNEL_PIECES && shape->knot[i] > 0; i++) {
        double half = (shape->knot[i] - left) / 4; // half of the width of half a piece
        for (int part = 1; part <= 3; part += 2)
            for (int n = 0; n < BL_QUADRATURE_NODES; n++) {
                double x = left + half * (part + bl_quadrature_node[n]);
                double value = bl_polynomial(shape->coefficient[i], BL_KERNEL_ORDERS, x);
                double angle = 2 * M_PI * f * x;
                sum +=
                    half * bl_quadrature_weight[n] * value * (shape->odd ? sin(angle) : cos(angle));
            }
        left = shape->knot[i];
    }
    return 2 * sum;
}

double bl_kernel_transform(bl_kernel kernel, double f) {
    const bl_kernel_shape *shape = &bl_kernel_shapes[kernel];
    if (!(fabs(f) >= 2))
        return by_quadrature(kernel, f) / shape->divisor;
    if (isinf(f))
        return 0;
    const bl_kernel_tables *tables = bl_kernel_get_tables();
    double size = by_jumps(&tables->jumps[kernel], shape->odd, fabs(f)) / shape->divisor;
    return shape->odd && f < 0 ? -size : size;
}
