// SPDX-License-Identifier: MIT
//
// The share of the variance in a band, exact: the integral of the density over a ball of radius b,
// carried over to the covariance by Parseval's theorem,
//
//   F(b) = int R(d) B(b, |d|) dd,   the transform of the ball in 1, 2, 3 dimensions being
//   B1 = sin(q)/(pi r),  B2 = b J1(q)/r,  B3 = (sin q - q cos q)/(2 pi^2 r^3),   q = 2 pi b r.
//
// Along a line the integral is direct. In a slice or a volume only the mean M(r) of R over circles
// or spheres enters:
//
//   F(b) = 2 pi b int M(r) J1(q) dr        F(b) = (2/pi) int M(r) (sin q - q cos q)/r dr.
//
// M does not depend on b. It is taken at 16 Gauss-Legendre nodes on panels of half a unit, shorter
// towards 0 for signals with finer parts, and interpolated between the nodes by the polynomial
// through them, which is the one the quadrature itself assumes. A circle is broken where a
// component of the lag is a whole number. The share is good to 1e-8 for the lattice noises
// (t-theory compares it with sums over the density).
#include "spectra/theory.h"

#include <math.h>

#include "core/quadrature.h"
#include "spectra/integrate.h"

enum { PANELS_MOST = 96, NODES = BL_QUADRATURE_NODES };

// Gauss-Legendre with 8 nodes for the angles: made like core/quadrature.c.
enum { ANGLES = 8 };
static const double angle_node[ANGLES] = {-0.9602898564975362316836, -0.7966664774136267395916,
                                          -0.5255324099163289858177, -0.1834346424956498049395,
                                          0.1834346424956498049395,  0.5255324099163289858177,
                                          0.7966664774136267395916,  0.9602898564975362316836};
static const double angle_weight[ANGLES] = {0.1012285362903762591525, 0.2223810344533744705444,
                                            0.3137066458778872873380, 0.3626837833783619829652,
                                            0.3626837833783619829652, 0.3137066458778872873380,
                                            0.2223810344533744705444, 0.1012285362903762591525};

typedef struct ball {
    const bl_signal *signal;
    const double (*directions)[BL_AXES];
    unsigned dims;
    double b;
} ball;

// The part of int R over a circle arc: centre + radius (cos a u + sin a v), a in [from, to],
// divided by 2 pi.
static double arc(const ball *in, const double centre[BL_AXES], double radius, double from,
                  double to) {
    const double *u = in->directions[0], *v = in->directions[1];
    bl_breaks breaks = {0};
    for (int a = 0; a < BL_AXES; a++) {
        double size = radius * hypot(u[a], v[a]), phase = atan2(v[a], u[a]);
        for (double n = ceil(centre[a] - size); n <= centre[a] + size; n++) {
            // centre + size cos(angle - phase) = n; twice a turn, so that one lies in [from, to].
            double turn = size > 0 ? acos(fmax(-1, fmin(1, (n - centre[a]) / size))) : NAN;
            for (int side = -1; side <= 1; side += 2) {
                double angle = remainder(phase + side * turn, 2 * M_PI);
                bl_breaks_add(&breaks, angle < 0 ? angle + 2 * M_PI : angle);
            }
        }
    }
    bl_breaks_add(&breaks, to);
    bl_breaks_sort(&breaks);
    double sum = 0, left = from;
    for (size_t i = 0; i < breaks.count; i++) {
        double right = fmin(breaks.at[i], to), half = (right - left) / 2;
        for (int n = 0; n < ANGLES && half > 0; n++) {
            double angle = left + half * (1 + angle_node[n]), lag[BL_AXES];
            for (int a = 0; a < BL_AXES; a++)
                lag[a] = centre[a] + radius * (cos(angle) * u[a] + sin(angle) * v[a]);
            sum += half * angle_weight[n] *
                   in->signal->functions->covariance(in->signal->parameters, lag);
        }
        left = fmax(left, right);
    }
    return sum / (2 * M_PI);
}

// The mean of R over the sphere, from its upper half: circles at the angle t from the third
// direction, at height r cos t and of radius r sin t, with the weight sin t.
static double sphere_mean(const ball *in, double r) {
    const double *u = in->directions[0], *v = in->directions[1], *w = in->directions[2];
    bl_breaks breaks = {0};
    for (int a = 0; a < BL_AXES; a++)
        for (double n = 1; n < r; n++) { // a centre crosses a plane; a circle touches one
            bl_breaks_add(&breaks, acos(n / (r * fabs(w[a]))));
            bl_breaks_add(&breaks, asin(n / (r * hypot(u[a], v[a]))));
        }
    bl_breaks_add(&breaks, M_PI / 2);
    bl_breaks_sort(&breaks);
    double sum = 0, left = 0;
    for (size_t i = 0; i < breaks.count; i++) {
        double right = fmin(breaks.at[i], M_PI / 2), half = (right - left) / 2;
        for (int n = 0; n < ANGLES && half > 0; n++) {
            double t = left + half * (1 + angle_node[n]), centre[BL_AXES];
            for (int a = 0; a < BL_AXES; a++)
                centre[a] = r * cos(t) * w[a];
            sum += half * angle_weight[n] * sin(t) * arc(in, centre, r * sin(t), 0, 2 * M_PI);
        }
        left = fmax(left, right);
    }
    return sum;
}

static double mean_over(const ball *in, double r) {
    const double origin[BL_AXES] = {0};
    return in->dims == 2 ? 2 * arc(in, origin, r, 0, M_PI) : sphere_mean(in, r);
}

// r^(dims-1) B(b, r) times the measure of the unit circle or sphere.
static double ball_transform(unsigned dims, double b, double r) {
    double q = 2 * M_PI * b * r;
    if (dims == 2)
        return 2 * M_PI * b * j1(q);
    // sin q - q cos q = q^3/3 - ...: below 0.01 the first two terms are exact to 1e-12 of q^3.
    double part = q < 0.01 ? q * q * q * (1 - q * q / 10) / 3 : sin(q) - q * cos(q);
    return 2 / M_PI * part / r;
}

// The value at x of the polynomial through the values at the quadrature nodes. Barycentric
// weights of Gauss-Legendre nodes: (-1)^i sqrt((1 - x_i^2) w_i) (Wang and Xiang 2012).
static double interpolate(const double values[NODES], double x) {
    double above = 0, below = 0;
    for (int i = 0; i < NODES; i++) {
        double node = bl_quadrature_node[i], distance = x - node;
        if (distance == 0)
            return values[i];
        double weight = sqrt((1 - node * node) * bl_quadrature_weight[i]) / distance;
        above += (i & 1 ? -weight : weight) * values[i];
        below += i & 1 ? -weight : weight;
    }
    return above / below;
}

// Edges of the panels: 2^-8, 2^-7, ... 1/2, 1, 3/2, ...
static int panel_edges(double far, double edges[PANELS_MOST + 1]) {
    int count = 1;
    edges[0] = 0;
    for (double r = 0x1p-8; r < far && count < PANELS_MOST; r = r < 0.5 ? 2 * r : r + 0.5)
        edges[count++] = r;
    edges[count] = far;
    return count;
}

// One panel's part of F for each of two radii.
static void add_panel(const ball *in, double left, double right, const double b[2],
                      double share[2]) {
    double values[NODES], half = (right - left) / 2;
    for (int n = 0; n < NODES; n++)
        values[n] = mean_over(in, left + half * (1 + bl_quadrature_node[n]));
    for (int k = 0; k < 2; k++) {
        double parts = ceil((right - left) * b[k] + 1); // less than a cycle each
        for (double part = 0; part < parts; part++)
            for (int n = 0; n < NODES; n++) {
                double x = (2 * part + 1 + bl_quadrature_node[n]) / parts - 1;
                share[k] += half / parts * bl_quadrature_weight[n] * interpolate(values, x) *
                            ball_transform(in->dims, b[k], left + half * (1 + x));
            }
    }
}

static double line_integrand(const void *context, double t) {
    const ball *in = context;
    double lag[BL_AXES];
    for (int a = 0; a < BL_AXES; a++)
        lag[a] = t * in->directions[0][a];
    return in->signal->functions->covariance(in->signal->parameters, lag) *
           sin(2 * M_PI * in->b * t) / (M_PI * t);
}

static double line_share(const ball *in, double variance) {
    double reach = in->signal->facts.covariance_reach, far = INFINITY;
    bl_breaks breaks = {0};
    for (int a = 0; a < BL_AXES; a++)
        far = fmin(far, reach / fabs(in->directions[0][a]));
    for (double n = 1; n <= reach; n++) {
        bl_breaks_add(&breaks, n);
        for (int a = 0; a < BL_AXES; a++)
            bl_breaks_add(&breaks, n / fabs(in->directions[0][a]));
    }
    bl_breaks_sort(&breaks);
    return 2 *
           bl_integrate(line_integrand, in, 0, far, &breaks, fmin(1, 1 / in->b), 1e-15 * variance);
}

// Above b = 4096 all of a continuous noise counts as below b: its density falls at least as f^-4
// along a line, so that less than 1e-10 of it is left.
enum { HIGHEST = 4096 };

double bl_theory_band(const bl_signal *signal, unsigned dims, const double directions[3][BL_AXES],
                      double from, double to) {
    if (!bl_signal_has_density(signal) || isnan(from) || isnan(to) ||
        !bl_theory_reaches(signal, dims, directions))
        return NAN;
    double variance = signal->functions->covariance(signal->parameters, (const double[BL_AXES]){0});
    const double b[2] = {fmax(from, 0), fmax(to, 0)};
    double share[2] = {0, 0};
    int wanted[2];
    for (int k = 0; k < 2; k++) {
        wanted[k] = b[k] > 0 && b[k] <= HIGHEST;
        share[k] = b[k] > HIGHEST ? variance : 0;
    }
    ball in = {.signal = signal, .directions = directions, .dims = dims};
    if (dims == 1) {
        for (int k = 0; k < 2; k++) {
            in.b = b[k];
            share[k] = wanted[k] ? line_share(&in, variance) : share[k];
        }
    } else if (wanted[0] || wanted[1]) {
        double edges[PANELS_MOST + 1], parts[2] = {0, 0};
        const double radii[2] = {wanted[0] ? b[0] : 0, wanted[1] ? b[1] : 0};
        int panels = panel_edges(sqrt(dims) * signal->facts.covariance_reach, edges);
        for (int i = 0; i < panels; i++)
            add_panel(&in, edges[i], edges[i + 1], radii, parts);
        for (int k = 0; k < 2; k++)
            share[k] = wanted[k] ? parts[k] : share[k];
    }
    return (share[1] - share[0]) / variance;
}
