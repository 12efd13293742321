// SPDX-License-Identifier: MIT
#ifndef BL_CORE_SINC_H
#define BL_CORE_SINC_H

#include <math.h>

// sin(pi x) / (pi x), and 1 at 0.
static inline double bl_sinc(double x) {
    return x == 0 ? 1 : sin(M_PI * x) / (M_PI * x);
}

#endif
