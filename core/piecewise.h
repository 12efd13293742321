// SPDX-License-Identifier: MIT
//
// Even and odd functions that are polynomials between knots: kernels of noises and of filters, and
// what follows from where they jump.
//
// A piecewise polynomial k is given for x >= 0 and is 0 from its last knot on. J(x, m) is the step
// of its m-th derivative at the knot x. With w = 2 pi f,
//
//   transform    k^(f) = int k(x) e^(-i w x) dx = sum over knots x and orders m of
//                J(x, m) e^(-i w x) / (i w)^(m+1)                  (the derivative of order m+1 of
//                each piece is a sum of impulses; divide by (i w)^(m+1))
//   continuity   k is C^c when the lowest order that jumps is c+1; |k^| then falls as f^-(c+2)
//
// All functions are pure and may be called from several threads.
#ifndef BL_CORE_PIECEWISE_H
#define BL_CORE_PIECEWISE_H

enum {
    BL_PIECEWISE_ORDERS = 7, // derivatives 0 to 6: x times a quintic
    BL_PIECEWISE_PIECES = 2  // at x >= 0
};

typedef struct bl_piecewise {
    int odd;
    double divisor;                   // of the coefficients, which are whole numbers
    double knot[BL_PIECEWISE_PIECES]; // the right end of each piece; 0 after the last
    double coefficient[BL_PIECEWISE_PIECES][BL_PIECEWISE_ORDERS]; // of x^0, x^1, ...
} bl_piecewise;

// The kernels that noises and filters share; t-kernel holds them to their formulas.
#define BL_PIECEWISE_TENT                                                                          \
    {                                                                                              \
        0, 1, {1}, {                                                                               \
            { 1, -1 }                                                                              \
        }                                                                                          \
    } // 1 - |x|
#define BL_PIECEWISE_CATMULL_ROM                                                                   \
    {                                                                                              \
        0, 2, {1, 2}, {                                                                            \
            {2, 0, -5, 3}, {                                                                       \
                4, -8, 5, -1                                                                       \
            }                                                                                      \
        }                                                                                          \
    } // of the spline through its knots

// The jumps at the knots x >= 0, times the divisor; whole numbers over powers of two, so exact.
// At -x the jump is -(-1)^m J(x, m) for an even function, (-1)^m J(x, m) for an odd one.
typedef struct bl_piecewise_jumps {
    int count;
    double knot[BL_PIECEWISE_PIECES + 1];
    double jump[BL_PIECEWISE_PIECES + 1][BL_PIECEWISE_ORDERS];
} bl_piecewise_jumps;

bl_piecewise_jumps bl_piecewise_find_jumps(const bl_piecewise *function);
int bl_piecewise_continuity(const bl_piecewise *function);
double bl_piecewise_support(const bl_piecewise *function); // the last knot

// 0 from the last knot on; NaN gives NaN.
double bl_piecewise_value(const bl_piecewise *function, double x);

// int k cos(2 pi f x) dx of an even function, int k sin(2 pi f x) dx of an odd one; |k^| is its
// size. `jumps` are those of the function.
double bl_piecewise_transform(const bl_piecewise *function, const bl_piecewise_jumps *jumps,
                              double f);

// sum of coefficient[i] x^i, i < orders.
double bl_polynomial(const double *coefficient, int orders, double x);

#endif
