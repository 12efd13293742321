// SPDX-License-Identifier: MIT
//
// The pulse is its mean d and a periodic rest, f = d + g. Four routes to the average of g, each
// where it is exact and short:
//
//   steps      each pulse in reach is the difference of two steps of the filter: narrow widths
//   jumps      with g_1, g_2, ... the periodic integrals of g of mean 0, integration by parts of a
//              kernel that jumps by J(t, m) in its m-th derivative at the knot t gives
//                int k(t) g(x - w t) dt = sum over t, m of J(t, m) g_(m+1)(x - w t) / w^(m+1),
//              finite and exact for a piecewise polynomial: any wide width
//   harmonics  g = sum over n of (sin 2 pi n (x - low) - sin 2 pi n (x - high)) / (pi n), each
//              times the response at n w
//   far_images the sum of so many harmonics that they are like an integral: narrow sinc
//
// g_m is a difference of Bernoulli polynomials of the fractions of x - high and x - low.
#include "filters/pulse_train.h"

#include <math.h>

#include "filters/sine_integral.h"

typedef struct pulse {
    double low, high;
} pulse;

// --- steps --------------------------------------------------------------------------------------

// `reach`: the distance, in widths, beyond which the step is 0 or 1.
static double by_steps(const bl_filter *filter, double reach, pulse p, double x, double width) {
    double periods = ceil(reach * width) + 1, sum = 0;
    for (double k = -periods; k <= periods; k++)
        sum += filter->step((x - p.low - k) / width) - filter->step((x - p.high - k) / width);
    return sum;
}

// --- jumps --------------------------------------------------------------------------------------

// B_n(y) / n!, the coefficients of y^0, y^1, ... times the divisor, for n = 2 to 8.
enum { BERNOULLI_FIRST = 2, BERNOULLI_COUNT = BL_PIECEWISE_ORDERS, BERNOULLI_TERMS = 9 };
static const struct {
    double divisor, coefficient[BERNOULLI_TERMS];
} bernoulli[BERNOULLI_COUNT] = {
    {12, {1, -6, 6}},
    {12, {0, 1, -3, 2}},
    {720, {-1, 0, 30, -60, 30}},
    {720, {0, -1, 0, 10, -15, 6}},
    {30240, {1, 0, -21, 0, 105, -126, 42}},
    {30240, {0, 1, 0, -7, 0, 21, -21, 6}},
    {1209600, {-1, 0, 20, 0, -70, 0, 140, -120, 30}},
};

// The n-th periodic integral of g at a phase. Phases are below 3 in size, so that floor is exact
// and the fraction is off by 2^-53 at most.
static double periodic_integral(int n, pulse p, double phase) {
    double after_high = phase - p.high - floor(phase - p.high);
    double after_low = phase - p.low - floor(phase - p.low);
    const double *coefficient = bernoulli[n + 1 - BERNOULLI_FIRST].coefficient;
    return (bl_polynomial(coefficient, BERNOULLI_TERMS, after_high) -
            bl_polynomial(coefficient, BERNOULLI_TERMS, after_low)) /
           bernoulli[n + 1 - BERNOULLI_FIRST].divisor;
}

static double by_jumps(const bl_piecewise *kernel, pulse p, double x, double width) {
    bl_piecewise_jumps jumps = bl_piecewise_find_jumps(kernel);
    double sum = 0, scale = 1 / (width * kernel->divisor);
    for (int m = 0; m < BL_PIECEWISE_ORDERS; m++, scale /= width) {
        double at_order = 0;
        for (int i = 0; i < jumps.count; i++) {
            double jump = jumps.jump[i][m], turned = remainder(width * jumps.knot[i], 1);
            if (jump == 0)
                continue;
            at_order += jump * periodic_integral(m + 1, p, x - turned);
            if (i > 0)
                at_order += (m & 1 ? jump : -jump) * periodic_integral(m + 1, p, x + turned);
        }
        sum += at_order * scale;
    }
    return p.high - p.low + sum;
}

// --- harmonics ----------------------------------------------------------------------------------

// sin(2 pi n phase), reduced before it is scaled.
static double wave(double n, double phase) {
    return sin(2 * M_PI * remainder(n * phase, 1));
}

static double by_harmonics(const bl_filter *filter, double harmonics, pulse p, double x,
                           double width) {
    double sum = 0;
    for (double n = harmonics; n >= 1; n--)
        sum +=
            filter->response(n * width) / (M_PI * n) * (wave(n, x - p.low) - wave(n, x - p.high));
    return p.high - p.low + sum;
}

// --- the ideal filter, narrow -------------------------------------------------------------------

// sum_{n=1}^N sin(2 pi n y) / (pi n) for N >= 64 and |y| <= 1/2. With M = N + 1/2 and t = 2 pi y,
//
//   sum sin(n t) / n = Si(M t) - t/2 + int_0^t sin(M s) h(s) ds,  h(s) = 1/(2 sin(s/2)) - 1/s,
//
// and by parts the last is a sum of h^(m)(t) M^-(m+1) times cos or sin of M t. h is odd, and
// h(2 pi u) = (1/pi) sum_j eta(2j) u^(2j-1), whose terms fall by 4 for |u| <= 1/2; its m-th
// derivative is below m!/pi^(m+1), so that nine terms leave less than 9!/(64 pi)^10 = 4e-18.
// eta(2j) = 1 - 2^-2j + 3^-2j - ... for j = 1 to 28, to 18 digits; the term after the last is 2^-57
// at most.
enum { ETA_COUNT = 28, PARTS = 9 };
static const double eta[ETA_COUNT] = {
    0.822467033424113218, 0.947032829497245918, 0.985551091297435104, 0.996233001852647899,
    0.999039507598271566, 0.999757685143858191, 0.999939170345979718, 0.999984764214906106,
    0.999996187869610113, 0.999999046611581522, 0.999999761613230823, 0.999999940398892395,
    0.999999985099231997, 0.999999996274753400, 0.999999999068682281, 0.999999999767169896,
    0.999999999941792399, 0.999999999985448091, 0.999999999996362022, 0.999999999999090505,
    0.999999999999772626, 0.999999999999943157, 0.999999999999985789, 0.999999999999996447,
    0.999999999999999112, 0.999999999999999778, 0.999999999999999944, 0.999999999999999986};

// The m-th derivative of sum_j eta(2j) u^(2j-1).
static double image_derivative(int m, double u) {
    double sum = 0, power = m & 1 ? 1 : u; // u^(2j-1-m), from the lowest j that is left
    for (int j = (m + 2) / 2; j <= ETA_COUNT; j++, power *= u * u) {
        double falling = 1;
        for (int i = 0; i < m; i++)
            falling *= 2 * j - 1 - i;
        sum += eta[j - 1] * falling * power;
    }
    return sum;
}

static double sum_of_waves(double harmonics, double y) {
    double u = remainder(y, 1), size = fabs(u), m = harmonics + 0.5;
    double phase = 2 * M_PI * remainder(m * size, 1), sine = sin(phase), cosine = cos(phase);
    const double turned[4] = {-cosine, sine, cosine, -sine};
    double sum = bl_sine_integral(2 * M_PI * m * size) - M_PI * size, power = M_PI * m;
    for (int part = 0; part < PARTS; part++, power *= 2 * M_PI * m)
        sum += turned[part & 3] * image_derivative(part, size) / power;
    return copysign(sum / M_PI, u);
}

static double by_far_images(const bl_filter *filter, pulse p, double x, double width) {
    double harmonics = floor(0.5 / width);
    double sum = sum_of_waves(harmonics, x - p.low) - sum_of_waves(harmonics, x - p.high);
    // The last one may stand at the edge of the band.
    double missing = (1 - filter->response(harmonics * width)) / (M_PI * harmonics);
    sum -= missing * (wave(harmonics, x - p.low) - wave(harmonics, x - p.high));
    return p.high - p.low + sum;
}

// --- the choice ---------------------------------------------------------------------------------

// x in [-1/2, 1/2] stands at the fraction x or, left of 0, x + 1, which would be rounded.
static double at_point(pulse p, double x) {
    return x < 0 ? x >= p.low - 1 && x < p.high - 1 : x >= p.low && x < p.high;
}

// The Gaussian leaves less than 2^-53 of its step beyond 4.2 widths, and of any wave of more than 3
// cycles per width less than 1e-19; of the kernels without an end only sinc leaves more of a step.
enum { LAST_FREQUENCY = 3, FEW_HARMONICS = 64 };
static const double gaussian_reach = 4.2;

static double endless(const bl_filter *filter, pulse p, double x, double width) {
    if (fabs(filter->step(-gaussian_reach)) < 0x1p-53) {
        if (width < 0.5) // else at most six waves
            return by_steps(filter, gaussian_reach, p, x, width);
        return by_harmonics(filter, ceil(LAST_FREQUENCY / width), p, x, width);
    }
    if (0.5 / width < FEW_HARMONICS)
        return by_harmonics(filter, floor(0.5 / width), p, x, width);
    return by_far_images(filter, p, x, width);
}

// Lanczos: its response is below 0.0036 f^-3, so that the waves left out add up to less than
// 8e-4/(n w)^3 < 2e-15 from n = 8192/w on.
static double ended(const bl_filter *filter, pulse p, double x, double width) {
    if (width < 24)
        return by_steps(filter, filter->support, p, x, width);
    return by_harmonics(filter, ceil(8192 / width), p, x, width);
}

double bl_pulse_train_average(const bl_filter *filter, double low, double high, double x,
                              double width) {
    if (!isfinite(x) || isnan(width) || isnan(low) || isnan(high))
        return NAN;
    pulse p = {low, high};
    x = remainder(x, 1);                  // exact
    width = fmax(fabs(width), 0x1p-1000); // 1/width stays finite; nothing is narrower than that
    if (width == 0x1p-1000)
        return at_point(p, x);
    if (isinf(width))
        return high - low;
    if (!filter->pieces)
        return isfinite(filter->support) ? ended(filter, p, x, width)
                                         : endless(filter, p, x, width);
    if (width < 1)
        return by_steps(filter, filter->support, p, x, width);
    return by_jumps(filter->pieces, p, x, width);
}

// --- the text's way -----------------------------------------------------------------------------

double bl_pulse_train_difference(double low, double high, double x, double width) {
    double begin = floor(x), end = floor(x + width);
    double from = begin * (high - low) + fmin(fmax(0, x - begin - low), high - low);
    double to = end * (high - low) + fmin(fmax(0, x + width - end - low), high - low);
    return (to - from) / width;
}

double bl_pulse_train_printed(double edge, double x, double width) {
    double begin = floor(x), end = floor(x + width);
    double from = begin * (1 - 2 * edge) + fmax(0, x - begin - edge);
    double to = end * (1 - 2 * edge) + fmax(0, x + width - end - edge);
    return (to - from) / width;
}
