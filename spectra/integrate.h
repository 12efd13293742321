// SPDX-License-Identifier: MIT
//
// Integrals of piecewise smooth functions: Gauss-Legendre between the breaks, halved until two
// halves agree with their whole.
#ifndef BL_SPECTRA_INTEGRATE_H
#define BL_SPECTRA_INTEGRATE_H

#include <stddef.h>

typedef double bl_integrand(const void *context, double x);

// A list of places where a function or a derivative jumps. A full list drops further breaks: the
// halving finds them.
enum { BL_BREAKS_MOST = 256 };
typedef struct bl_breaks {
    size_t count;
    double at[BL_BREAKS_MOST];
} bl_breaks;

void bl_breaks_add(bl_breaks *breaks, double x);
void bl_breaks_sort(bl_breaks *breaks);

// int f over [from, to], with panels no longer than `longest` and an absolute tolerance per panel.
// `breaks` must be sorted; those outside are passed over.
double bl_integrate(bl_integrand *f, const void *context, double from, double to,
                    const bl_breaks *breaks, double longest, double tolerance);

#endif
