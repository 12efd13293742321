// SPDX-License-Identifier: MIT
//
// Closed-form spectra along lines and in slices, by the slice theorem: the spectrum of a signal
// restricted to a line or a plane is the transform of its covariance restricted to the same line or
// plane (the integral of the volume density over the frequencies left out).
//
//   line   P1(f) = int R(t d) cos(2 pi f t) dt
//   slice  P2(fu, fv) = int int R(s u + t v) cos(2 pi (fu s + fv t)) ds dt
//
// R has compact support. Its pieces meet where a component of the lag is a whole number (products
// of lattice kernels) or where its length is (radial kernels); we break the integrals there, and
// where the signal's pieces are shorter the panels are halved until they agree. The absolute error
// of a line is below 1e-13 of the variance, of a slice below 1e-9.
#include "spectra/theory.h"

#include <math.h>
#include <string.h>

#include "spectra/integrate.h"

static int reaches(const bl_signal *signal, const double direction[BL_AXES]) {
    for (unsigned a = signal->dimensions; a > 0 && a < BL_AXES; a++) // 0: dimensions not known
        if (direction[a] != 0)
            return 0;
    return 1;
}

int bl_theory_reaches(const bl_signal *signal, unsigned dims, const double directions[3][BL_AXES]) {
    int all = 1;
    for (unsigned d = 0; d < dims; d++)
        all &= reaches(signal, directions[d]);
    return all;
}

static double covariance(const bl_signal *signal, const double lag[BL_AXES]) {
    return signal->functions->covariance(signal->parameters, lag);
}

static double variance_of(const bl_signal *signal) {
    return covariance(signal, (const double[BL_AXES]){0});
}

typedef struct plane_integral {
    const bl_signal *signal;
    const double *u, *v; // a line has no v
    double fu, fv, s;
} plane_integral;

// Where base + t direction crosses a whole component or a whole length, for t in [from, to].
static void add_crossings(bl_breaks *breaks, const double base[BL_AXES],
                          const double direction[BL_AXES], double reach) {
    double along = 0, square = 0; // base . direction, |base|^2
    for (int a = 0; a < BL_AXES; a++) {
        along += base[a] * direction[a];
        square += base[a] * base[a];
        if (direction[a] == 0)
            continue;
        for (double n = -floor(reach); n <= reach; n++)
            bl_breaks_add(breaks, (n - base[a]) / direction[a]);
    }
    for (double n = 1; n <= reach; n++) {
        double inside = along * along - square + n * n; // |base + t direction| = n
        if (inside <= 0)
            continue;
        bl_breaks_add(breaks, -along - sqrt(inside));
        bl_breaks_add(breaks, -along + sqrt(inside));
    }
    bl_breaks_sort(breaks);
}

// The part of the line base + t direction on which every component is within the reach.
static void clip(const double base[BL_AXES], const double direction[BL_AXES], double reach,
                 double *from, double *to) {
    *from = -INFINITY;
    *to = INFINITY;
    for (int a = 0; a < BL_AXES; a++) {
        if (direction[a] == 0) {
            if (fabs(base[a]) >= reach)
                *from = *to = 0;
            continue;
        }
        double one = (-reach - base[a]) / direction[a], other = (reach - base[a]) / direction[a];
        *from = fmax(*from, fmin(one, other));
        *to = fmin(*to, fmax(one, other));
    }
}

// Panels of a cycle at most, and of a cell.
static double longest_panel(double f) {
    return fmin(1, 1 / fabs(f));
}

static double line_integrand(const void *context, double t) {
    const plane_integral *line = context;
    double lag[BL_AXES];
    for (int a = 0; a < BL_AXES; a++)
        lag[a] = t * line->u[a];
    return covariance(line->signal, lag) * cos(2 * M_PI * line->fu * t);
}

double bl_theory_line(const bl_signal *signal, const double direction[BL_AXES], double f) {
    if (!bl_signal_has_density(signal) || !isfinite(f) || !reaches(signal, direction))
        return NAN;
    plane_integral line = {.signal = signal, .u = direction, .fu = f};
    bl_breaks breaks = {0};
    const double origin[BL_AXES] = {0};
    double from, to, reach = signal->facts.covariance_reach;
    clip(origin, direction, reach, &from, &to);
    add_crossings(&breaks, origin, direction, reach);
    // Even in t. Never negative except for rounding.
    double half = bl_integrate(line_integrand, &line, 0, to, &breaks, longest_panel(f),
                               1e-15 * variance_of(signal));
    return fmax(0, 2 * half);
}

static double inner_integrand(const void *context, double t) {
    const plane_integral *plane = context;
    double lag[BL_AXES];
    for (int a = 0; a < BL_AXES; a++)
        lag[a] = plane->s * plane->u[a] + t * plane->v[a];
    return covariance(plane->signal, lag) * cos(2 * M_PI * (plane->fu * plane->s + plane->fv * t));
}

static double outer_integrand(const void *context, double s) {
    plane_integral plane = *(const plane_integral *)context;
    plane.s = s;
    double base[BL_AXES], from, to, reach = plane.signal->facts.covariance_reach;
    for (int a = 0; a < BL_AXES; a++)
        base[a] = s * plane.u[a];
    clip(base, plane.v, reach, &from, &to);
    bl_breaks breaks = {0};
    add_crossings(&breaks, base, plane.v, reach);
    return bl_integrate(inner_integrand, &plane, from, to, &breaks, longest_panel(plane.fv),
                        1e-11 * variance_of(plane.signal));
}

double bl_theory_slice(const bl_signal *signal, const double u[BL_AXES], const double v[BL_AXES],
                       double fu, double fv) {
    if (!bl_signal_has_density(signal) || !isfinite(fu) || !isfinite(fv) || !reaches(signal, u) ||
        !reaches(signal, v))
        return NAN;
    plane_integral plane = {.signal = signal, .u = u, .v = v, .fu = fu, .fv = fv};
    double reach = signal->facts.covariance_reach, far = 0;
    for (int a = 0; a < BL_AXES; a++)
        far += reach * fabs(u[a]); // |s| = |lag . u| <= sum of reach |u_a|
    bl_breaks breaks = {0};
    for (double n = 1; n < far; n++)
        bl_breaks_add(&breaks, n);
    // R(-lag) = R(lag): the half plane s > 0, twice.
    double half = bl_integrate(outer_integrand, &plane, 0, far, &breaks, longest_panel(fu),
                               1e-10 * variance_of(signal));
    return fmax(0, 2 * half);
}

// The integral over the fourth frequency. With steps of 1/reach the sum over the multiples is the
// integral, because it is that of the covariance at w = 0 and at the multiples of the reach
// (Poisson summation), where there is none. The density falls at least as f^-4 along an axis: what
// lies beyond the last step is below 1e-9 of the variance.
static double volume_of_four(const bl_signal *signal, const double f[BL_AXES]) {
    enum { STEPS = 2048 };
    double step = 1 / signal->facts.covariance_reach, sum = 0;
    for (int n = STEPS; n >= 0; n--) {
        const double at[BL_AXES] = {f[0], f[1], f[2], n * step};
        sum += (n ? 2 : 1) * step * signal->functions->density(signal->parameters, at);
    }
    return sum;
}

double bl_theory_volume(const bl_signal *signal, const double f[BL_AXES]) {
    if (!bl_signal_has_density(signal) || !signal->functions->density)
        return NAN;
    if (signal->dimensions == 4)
        return volume_of_four(signal, f);
    if (signal->dimensions == 1 || signal->dimensions == 2)
        return NAN;
    return signal->functions->density(signal->parameters, f);
}

// The first axis after the one nearest to n, made normal to n, and the one that completes them:
// x, y for z; y, z for x; z, x for y.
int bl_directions(unsigned dims, const double axis[3], double directions[3][BL_AXES]) {
    memset(directions, 0, 3 * sizeof *directions);
    if (dims == 3) {
        for (int a = 0; a < 3; a++)
            directions[a][a] = 1;
        return 1;
    }
    double largest = fmax(fabs(axis[0]), fmax(fabs(axis[1]), fabs(axis[2])));
    if (!(isfinite(axis[0]) && isfinite(axis[1]) && isfinite(axis[2]) && largest > 0))
        return 0;
    double n[3], length = 0;
    for (int a = 0; a < 3; a++) {
        n[a] = axis[a] / largest; // no component overflows when squared
        length += n[a] * n[a];
    }
    int nearest = 0;
    for (int a = 0; a < 3; a++) {
        if (fabs(n[a]) > fabs(n[nearest]))
            nearest = a;
        n[a] /= sqrt(length);
    }
    if (dims == 1) {
        memcpy(directions[0], n, sizeof n);
        return 1;
    }
    int next = (nearest + 1) % 3;
    double *u = directions[0], *v = directions[1];
    double rest = sqrt(1 - n[next] * n[next]); // at least 1/sqrt 2: another component is larger
    for (int a = 0; a < 3; a++)
        u[a] = ((a == next) - n[next] * n[a]) / rest;
    for (int a = 0; a < 3; a++)
        v[a] = n[(a + 1) % 3] * u[(a + 2) % 3] - n[(a + 2) % 3] * u[(a + 1) % 3];
    return 1;
}
