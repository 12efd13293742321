// SPDX-License-Identifier: MIT
//
// Distributions and intervals. All functions are pure. Probabilities outside (0, 1) give the end
// of the distribution's support or NaN; degrees of freedom need not be whole.
#ifndef BL_CORE_STATISTICS_H
#define BL_CORE_STATISTICS_H

#include <stddef.h>

// A measured number: value, two-sided interval at `level`, and how many independent samples.
typedef struct bl_estimate {
    double value, lower, upper;
    double level;
    double samples;
} bl_estimate;

// The standard normal distribution: the probability below x, and the x with the probability p below
// it (-INFINITY and INFINITY at 0 and 1). Good to 1e-13 relative in the tails.
double bl_normal_cdf(double x);
double bl_normal_quantile(double p);
// Chi-square with nu > 0 degrees of freedom; NaN for nu <= 0. The quantile halves its bracket until
// it cannot: microseconds, good to a few units in the last place of the distribution function.
double bl_chi_square_cdf(double x, double nu);
double bl_chi_square_quantile(double p, double nu);
// Student's t with nu > 0 degrees of freedom, in the same way.
double bl_student_quantile(double p, double nu);

// Mean and its Student interval from n independent values.
bl_estimate bl_mean_estimate(const double *values, size_t n, double level);

// Ratio of sums, sum(a)/sum(b), over n independent pairs: interval by the linearised variance of
// the ratio (Student, n-1 degrees of freedom).
bl_estimate bl_ratio_estimate(const double *a, const double *b, size_t n, double level);

// The same from the probability `missed` that the interval misses the truth, on both sides
// together: 1e-17 is a probability, and 1 - 1e-17 is 1.
bl_estimate bl_mean_estimate_missing(const double *values, size_t n, double missed);
bl_estimate bl_ratio_estimate_missing(const double *a, const double *b, size_t n, double missed);

// Running moments to the fourth order, mergeable in a fixed order (Pebay 2008).
typedef struct bl_moments {
    double n, mean, m2, m3, m4;
} bl_moments;

void bl_moments_add(bl_moments *moments, double x);
void bl_moments_merge(bl_moments *into, const bl_moments *from);
double bl_moments_variance(const bl_moments *moments); // unbiased; NaN below two values
double bl_moments_skewness(const bl_moments *moments);
double bl_moments_kurtosis(const bl_moments *moments); // of a normal: 3

// For qsort: doubles, the least first; none of them NaN.
int bl_ascending(const void *a, const void *b);

#endif
