// SPDX-License-Identifier: MIT
#include "core/statistics.h"

#include <float.h>
#include <math.h>

double bl_normal_cdf(double x) {
    return 0.5 * erfc(-x * M_SQRT1_2);
}

// The rational starts of Acklam would give nine digits; a bracketed Newton iteration on erfc needs
// no constants and gives all of them.
double bl_normal_quantile(double p) {
    if (!(p >= 0 && p <= 1))
        return NAN;
    if (p == 0 || p == 1)
        return p == 0 ? -INFINITY : INFINITY;
    if (p > 0.5)
        return -bl_normal_quantile(1 - p); // 1 - p is exact for p in [0.5, 1]
    // Below the median log(cdf) is concave and increasing, so Newton on it converges from the
    // left without leaving the bracket; the tail bound cdf(x) <= exp(-x^2/2)/2 starts it there.
    double x = -sqrt(-2 * log(2 * p)), target = log(p);
    for (int i = 0; i < 60; i++) {
        double cdf = bl_normal_cdf(x);
        double slope = exp(-0.5 * x * x) / sqrt(2 * M_PI) / cdf;
        double move = (log(cdf) - target) / slope;
        x -= move;
        if (fabs(move) <= 4 * DBL_EPSILON * (1 + fabs(x)))
            break;
    }
    return x;
}

// Regularised lower incomplete gamma function: the power series left of the mean, the continued
// fraction (modified Lentz) of the complement right of it.
static double gamma_series(double a, double x) {
    double term = 1 / a, sum = term;
    for (int i = 1; i < 100000 && fabs(term) > DBL_EPSILON * fabs(sum); i++) {
        term *= x / (a + i);
        sum += term;
    }
    return sum * exp(a * log(x) - x - lgamma(a));
}

static double gamma_complement_fraction(double a, double x) {
    const double tiny = DBL_MIN / DBL_EPSILON;
    double b = x + 1 - a, c = 1 / tiny, d = 1 / b, h = d;
    for (int i = 1; i < 100000; i++) {
        double an = -i * (i - a);
        b += 2;
        d = an * d + b;
        c = b + an / c;
        d = 1 / (fabs(d) < tiny ? tiny : d);
        c = fabs(c) < tiny ? tiny : c;
        h *= d * c;
        if (fabs(d * c - 1) <= DBL_EPSILON)
            break;
    }
    return h * exp(a * log(x) - x - lgamma(a));
}

double bl_chi_square_cdf(double x, double nu) {
    if (isnan(x) || !(nu > 0))
        return NAN;
    if (x <= 0)
        return 0;
    if (isinf(x))
        return 1;
    double a = 0.5 * nu;
    x *= 0.5;
    return x < a + 1 ? gamma_series(a, x) : 1 - gamma_complement_fraction(a, x);
}

// Quantiles by bisection of a cdf on a bracket: slow and sure. 200 halvings exhaust a double.
typedef double (*cdf_function)(double x, double nu);

static double bisect_quantile(cdf_function cdf, double p, double nu, double low, double high) {
    for (int i = 0; i < 200 && high - low > DBL_EPSILON * fabs(high); i++) {
        double middle = low + 0.5 * (high - low);
        if (cdf(middle, nu) < p)
            low = middle;
        else
            high = middle;
    }
    return low + 0.5 * (high - low);
}

double bl_chi_square_quantile(double p, double nu) {
    if (!(p >= 0 && p <= 1) || !(nu > 0))
        return NAN;
    if (p == 0 || p == 1)
        return p == 0 ? 0 : INFINITY;
    double high = nu + 1;
    while (bl_chi_square_cdf(high, nu) < p)
        high *= 2;
    return bisect_quantile(bl_chi_square_cdf, p, nu, 0, high);
}

// Regularised incomplete beta function by its continued fraction (modified Lentz).
static double beta_fraction(double a, double b, double x) {
    const double tiny = DBL_MIN / DBL_EPSILON;
    double c = 1, d = 1 - (a + b) * x / (a + 1);
    d = 1 / (fabs(d) < tiny ? tiny : d);
    double h = d;
    for (int m = 1; m < 100000; m++) {
        double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        double change = 1;
        for (int half = 0; half < 2; half++) {
            double an = half ? odd : even;
            d = 1 + an * d;
            c = 1 + an / c;
            d = 1 / (fabs(d) < tiny ? tiny : d);
            c = fabs(c) < tiny ? tiny : c;
            change = c * d;
            h *= change;
        }
        if (fabs(change - 1) <= DBL_EPSILON)
            break;
    }
    return h;
}

static double beta_regularised(double a, double b, double x) {
    if (x <= 0 || x >= 1)
        return x <= 0 ? 0 : 1;
    double front = exp(lgamma(a + b) - lgamma(a) - lgamma(b) + a * log(x) + b * log1p(-x));
    if (x < (a + 1) / (a + b + 2))
        return front * beta_fraction(a, b, x) / a;
    return 1 - front * beta_fraction(b, a, 1 - x) / b;
}

static double student_cdf(double t, double nu) {
    double tail = 0.5 * beta_regularised(0.5 * nu, 0.5, nu / (nu + t * t));
    return t > 0 ? 1 - tail : tail;
}

double bl_student_quantile(double p, double nu) {
    if (!(p >= 0 && p <= 1) || !(nu > 0))
        return NAN;
    if (p == 0 || p == 1)
        return p == 0 ? -INFINITY : INFINITY;
    if (p > 0.5)
        return -bl_student_quantile(1 - p, nu);
    if (p == 0.5)
        return 0;
    double low = -1;
    while (student_cdf(low, nu) > p && low > -1e300)
        low *= 2;
    return bisect_quantile(student_cdf, p, nu, low, 0);
}

bl_estimate bl_mean_estimate_missing(const double *values, size_t n, double missed) {
    bl_moments moments = {0};
    for (size_t i = 0; i < n; i++)
        bl_moments_add(&moments, values[i]);
    double half = NAN;
    if (n >= 2)
        half = -bl_student_quantile(0.5 * missed, (double)n - 1) *
               sqrt(bl_moments_variance(&moments) / (double)n);
    return (bl_estimate){moments.mean, moments.mean - half, moments.mean + half, 1 - missed,
                         (double)n};
}

bl_estimate bl_mean_estimate(const double *values, size_t n, double level) {
    bl_estimate estimate = bl_mean_estimate_missing(values, n, 1 - level);
    estimate.level = level; // to the last bit
    return estimate;
}

bl_estimate bl_ratio_estimate_missing(const double *a, const double *b, size_t n, double missed) {
    double sum_a = 0, sum_b = 0, sum_residual = 0;
    for (size_t i = 0; i < n; i++) {
        sum_a += a[i];
        sum_b += b[i];
    }
    double ratio = sum_a / sum_b, half = NAN;
    // The residuals a - ratio*b sum to zero, so their mean square is their variance.
    for (size_t i = 0; i < n; i++)
        sum_residual += (a[i] - ratio * b[i]) * (a[i] - ratio * b[i]);
    if (n >= 2) {
        double count = (double)n;
        half = -bl_student_quantile(0.5 * missed, count - 1) *
               sqrt(sum_residual * count / (count - 1)) / fabs(sum_b);
    }
    return (bl_estimate){ratio, ratio - half, ratio + half, 1 - missed, (double)n};
}

bl_estimate bl_ratio_estimate(const double *a, const double *b, size_t n, double level) {
    bl_estimate estimate = bl_ratio_estimate_missing(a, b, n, 1 - level);
    estimate.level = level; // to the last bit
    return estimate;
}

void bl_moments_add(bl_moments *moments, double x) {
    bl_moments one = {1, x, 0, 0, 0};
    bl_moments_merge(moments, &one);
}

void bl_moments_merge(bl_moments *into, const bl_moments *from) {
    double na = into->n, nb = from->n, n = na + nb;
    if (nb == 0)
        return;
    if (na == 0) {
        *into = *from;
        return;
    }
    double d = from->mean - into->mean, d2 = d * d;
    double m2 = into->m2 + from->m2 + d2 * na * nb / n;
    double m3 = into->m3 + from->m3 + d * d2 * na * nb * (na - nb) / (n * n) +
                3 * d * (na * from->m2 - nb * into->m2) / n;
    double m4 = into->m4 + from->m4 +
                d2 * d2 * na * nb * (na * na - na * nb + nb * nb) / (n * n * n) +
                6 * d2 * (na * na * from->m2 + nb * nb * into->m2) / (n * n) +
                4 * d * (na * from->m3 - nb * into->m3) / n;
    *into = (bl_moments){n, into->mean + d * nb / n, m2, m3, m4};
}

double bl_moments_variance(const bl_moments *moments) {
    return moments->n < 2 ? NAN : moments->m2 / (moments->n - 1);
}

double bl_moments_skewness(const bl_moments *moments) {
    return sqrt(moments->n) * moments->m3 / pow(moments->m2, 1.5);
}

double bl_moments_kurtosis(const bl_moments *moments) {
    return moments->n * moments->m4 / (moments->m2 * moments->m2);
}

int bl_ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}
