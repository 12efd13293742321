// SPDX-License-Identifier: MIT
//
// Below 4 the power series: the largest term is below 4 (that of x^3 at 4 is 3.6), so that rounding
// stays below 1e-15. From 4 on the continued fraction of e^z E1(z) at z = i x, whose value is
// g - i f:
//   e^z E1(z) = 1/(z + 1 - 1^2/(z + 3 - 2^2/(z + 5 - ...))).
// It converges the sooner the larger x is: 48 steps at 4 and 19 at 40 leave nothing above the
// rounding (t-filters holds f and g to their integrals).
#include "filters/sine_integral.h"

#include <math.h>

static const double euler_gamma = 0.57721566490153286061; // Euler's constant, to 20 digits
static const double series_end = 4;

// sum_{k>=1} (-1)^(k+1) x^n / (n n!) over n = 2k (even) or n = 2k - 1 (odd).
static double series(double x, int first) {
    double square = x * x, power = first == 1 ? x : 0.5 * square, sum = 0; // x^n / n!, signed
    for (int n = first; n < 40; n += 2) { // 4^40 / (40 40!) is 4e-26
        sum += power / n;
        power *= -square / ((n + 1) * (n + 2));
    }
    return sum;
}

// From the innermost fraction outwards: tail = i x + 2n - 1 - n^2 / tail.
static bl_sine_auxiliary by_fraction(double x) {
    if (x > 1e8) // f x = 1 - 2/x^2 + ..., g x^2 = 1 - 6/x^2 + ...
        return (bl_sine_auxiliary){1 / x, 1 / x / x};
    int steps = 16 + (int)(x < 40 ? 128 / x : 0);
    double real = 2 * steps + 1, imaginary = x;
    for (int n = steps; n > 0; n--) {
        double quotient = (double)n * n / (real * real + imaginary * imaginary);
        real = 2 * n - 1 - quotient * real;
        imaginary = x + quotient * imaginary;
    }
    double square = real * real + imaginary * imaginary;
    return (bl_sine_auxiliary){imaginary / square, real / square};
}

bl_sine_auxiliary bl_sine_integral_auxiliary(double x) {
    if (!(x <= series_end))
        return isinf(x) ? (bl_sine_auxiliary){0, 0} : by_fraction(x);
    double rest = M_PI_2 - series(x, 1), ci = euler_gamma + log(x) - series(x, 2);
    double sine = sin(x), cosine = cos(x);
    return (bl_sine_auxiliary){ci * sine + rest * cosine, rest * sine - ci * cosine};
}

double bl_sine_integral(double x) {
    double size = fabs(x);
    if (!(size > series_end))
        return series(x, 1);
    if (isinf(x))
        return copysign(M_PI_2, x);
    bl_sine_auxiliary rest = by_fraction(size);
    return copysign(M_PI_2 - rest.f * cos(size) - rest.g * sin(size), x);
}

double bl_entire_cosine_integral(double x) {
    double size = fabs(x);
    if (!(size > series_end))
        return series(size, 2);
    if (isinf(x))
        return size;
    bl_sine_auxiliary rest = by_fraction(size);
    return euler_gamma + log(size) - (rest.f * sin(size) - rest.g * cos(size));
}
