// SPDX-License-Identifier: MIT
#include "filters/response.h"

#include <math.h>

#include "core/quadrature.h"

enum { LAST = 8, PER_CYCLE = 256 };
static const double ended = 1e-9; // a response or a kernel that is no longer there

// --- powers -------------------------------------------------------------------------------------

static double kernel_squared(const bl_filter *filter, double t) {
    return filter->kernel(t) * filter->kernel(t);
}

static double response_squared(const bl_filter *filter, double f) {
    return filter->response(f) * filter->response(f);
}

static double change_squared(const bl_filter *filter, double f) {
    return (1 - filter->response(f)) * (1 - filter->response(f));
}

// Over [-to, to] of an even function whose corners stand at multiples of 1/2.
static double both_sides(const bl_filter *filter, double (*f)(const bl_filter *, double),
                         double to) {
    double sum = 0;
    for (double left = 0; left < to; left += 0.25)
        for (int n = 0; n < BL_QUADRATURE_NODES; n++)
            sum += 0.25 * bl_quadrature_weight[n] *
                   f(filter, left + 0.125 * (1 + bl_quadrature_node[n]));
    return sum;
}

// What is above the Nyquist frequency is what the kernel has and the frequencies below it have not;
// a kernel without an end has a response with one.
static double alias_of_white(const bl_filter *filter) {
    const double reach = isfinite(filter->support) ? filter->support : 5;
    double below = both_sides(filter, response_squared, 0.5);
    if (fabs(filter->step(-reach)) > ended)
        return both_sides(filter, response_squared, LAST) - below;
    return both_sides(filter, kernel_squared, reach) - below;
}

// --- frequencies --------------------------------------------------------------------------------

static double power_above_half(const bl_filter *filter, double f) {
    return response_squared(filter, f) - 0.5;
}

static double response_at(const bl_filter *filter, double f) {
    return filter->response(f);
}

// Where f changes its sign in [left, right], by halving.
static double crossing(const bl_filter *filter, double (*f)(const bl_filter *, double), double left,
                       double right) {
    int sign = f(filter, left) > 0;
    for (int i = 0; i < 50; i++) {
        double middle = 0.5 * (left + right);
        if ((f(filter, middle) > 0) == sign)
            left = middle;
        else
            right = middle;
    }
    return 0.5 * (left + right);
}

// The place of the one maximum of `sign` times f in [left, right], by cutting off thirds.
static double peak(double (*f)(double), double sign, double left, double right) {
    for (int i = 0; i < 80; i++) {
        double one = left + (right - left) / 3, other = right - (right - left) / 3;
        if (sign * f(one) < sign * f(other))
            left = one;
        else
            right = other;
    }
    return 0.5 * (left + right);
}

static double half_power_of(const bl_filter *filter) {
    for (int i = 0; i < LAST * PER_CYCLE; i++)
        if (power_above_half(filter, (double)(i + 1) / PER_CYCLE) <= 0)
            return crossing(filter, power_above_half, (double)i / PER_CYCLE,
                            (double)(i + 1) / PER_CYCLE);
    return NAN;
}

// A zero of higher order is flat, and rounding hides where it is; those stand at the whole numbers.
static double settle_zero(const bl_filter *filter, double near) {
    double whole = nearbyint(near);
    return fabs(near - whole) < 1e-4 && fabs(filter->response(whole)) < 1e-13 ? whole : near;
}

// A zero is a change of sign, or a touch: a lowest value that is none. A response that is 0 from
// somewhere on has its first zero there.
static double first_zero_of(const bl_filter *filter) {
    for (int i = 1; i < LAST * PER_CYCLE; i++) {
        double left = (double)(i - 1) / PER_CYCLE, right = (double)(i + 1) / PER_CYCLE;
        double before = filter->response(left), after = filter->response(right);
        double here = filter->response((double)i / PER_CYCLE);
        if ((before > 0) != (after > 0))
            return settle_zero(filter, crossing(filter, response_at, left, right));
        if (here < before && here <= after) {
            double lowest = peak(filter->response, -1, left, right);
            if (filter->response(lowest) < ended)
                return settle_zero(filter, lowest);
        }
    }
    return NAN;
}

static void find_lobe(const bl_filter *filter, bl_filter_numbers *numbers) {
    double most = ended, at = NAN;
    if (isnan(numbers->first_zero))
        return;
    for (int i = (int)(numbers->first_zero * PER_CYCLE) + 1; i < LAST * PER_CYCLE; i++) {
        double size = fabs(filter->response((double)i / PER_CYCLE));
        if (size > most) {
            most = size;
            at = (double)i / PER_CYCLE;
        }
    }
    if (isnan(at))
        return;
    numbers->lobe_frequency = peak(filter->response, copysign(1, filter->response(at)),
                                   at - 1.0 / PER_CYCLE, at + 1.0 / PER_CYCLE);
    numbers->lobe = filter->response(numbers->lobe_frequency);
}

static void find_overshoot(const bl_filter *filter, bl_filter_numbers *numbers) {
    double most = 1 + ended, at = NAN;
    for (int i = 0; i < LAST * PER_CYCLE; i++)
        if (filter->step((double)i / PER_CYCLE) > most) {
            most = filter->step((double)i / PER_CYCLE);
            at = (double)i / PER_CYCLE;
        }
    if (isnan(at))
        return;
    numbers->overshoot_at = peak(filter->step, 1, at - 1.0 / PER_CYCLE, at + 1.0 / PER_CYCLE);
    numbers->overshoot = filter->step(numbers->overshoot_at) - 1;
}

bl_filter_numbers bl_filter_measure(const bl_filter *filter) {
    bl_filter_numbers numbers = {.lobe_frequency = NAN, .lobe = NAN, .overshoot_at = NAN};
    numbers.half_power = half_power_of(filter);
    numbers.nyquist = filter->response(0.5);
    numbers.first_zero = first_zero_of(filter);
    find_lobe(filter, &numbers);
    find_overshoot(filter, &numbers);
    numbers.alias = alias_of_white(filter);
    numbers.blur = both_sides(filter, change_squared, 0.5);
    return numbers;
}
