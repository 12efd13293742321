// SPDX-License-Identifier: MIT
#include "textures/colour_spline.h"

#include <math.h>

// The cubic of span i in u in [0, 1], as coefficients of 1, u, u^2, u^3, of one component.
static void cubic(const bl_colour_spline *spline, size_t span, int component, double c[4]) {
    double k[4];
    for (size_t j = 0; j < 4; j++)
        k[j] = spline->knots[span + j].rgb[component];
    c[0] = k[1];
    c[1] = 0.5 * (k[2] - k[0]);
    c[2] = k[0] - 2.5 * k[1] + 2 * k[2] - 0.5 * k[3];
    c[3] = 0.5 * (k[3] - k[0]) + 1.5 * (k[1] - k[2]);
}

bl_colour bl_colour_spline_at(const bl_colour_spline *spline, double x) {
    bl_colour colour = bl_colour_missing;
    if (isnan(x))
        return colour;
    size_t spans = spline->count - 3;
    double place = fmin(fmax(x, 0), 1) * (double)spans; // within [0, spans], so the cast is safe
    size_t span = (size_t)place < spans ? (size_t)place : spans - 1;
    double u = place - (double)span, c[4];
    for (int i = 0; i < 3; i++) {
        cubic(spline, span, i, c);
        colour.rgb[i] = c[0] + u * (c[1] + u * (c[2] + u * c[3]));
    }
    return colour;
}

// Adds the integral over the part of a span that lies within [from, to], in spans.
static void add_span(const bl_colour_spline *spline, size_t span, double from, double to,
                     double sum[3]) {
    double a = fmax(from - (double)span, 0), b = fmin(to - (double)span, 1), c[4];
    for (int i = 0; i < 3 && b > a; i++) {
        cubic(spline, span, i, c);
        double at_b = b * (c[0] + b * (c[1] / 2 + b * (c[2] / 3 + b * c[3] / 4)));
        double at_a = a * (c[0] + a * (c[1] / 2 + a * (c[2] / 3 + a * c[3] / 4)));
        sum[i] += at_b - at_a;
    }
}

bl_colour bl_colour_spline_mean(const bl_colour_spline *spline, double x, double width) {
    double spans = (double)(spline->count - 3), sum[3] = {0};
    double from = (x - 0.5 * width) * spans, to = (x + 0.5 * width) * spans;
    if (isnan(from) || isnan(to))
        return bl_colour_missing;
    // Below this the difference of two quartics has fewer digits than the middle of the width.
    if (to - from < 1e-5)
        return bl_colour_spline_at(spline, x);
    if (isinf(to - from)) // half of the line is below, half above
        return bl_colour_mix(bl_colour_spline_at(spline, 0), bl_colour_spline_at(spline, 1), 0.5);
    for (size_t span = 0; span < spline->count - 3; span++)
        add_span(spline, span, from, to, sum);
    double below = fmax(fmin(to, 0) - from, 0), above = fmax(to - fmax(from, spans), 0);
    bl_colour first = bl_colour_spline_at(spline, 0), last = bl_colour_spline_at(spline, 1), mean;
    for (int i = 0; i < 3; i++)
        mean.rgb[i] = (sum[i] + below * first.rgb[i] + above * last.rgb[i]) / (to - from);
    return mean;
}

bl_colour bl_colour_spline_normal(const bl_colour_spline *spline, double x, double deviation) {
    enum { PIECES = 32 };
    if (!(deviation > 0))
        return isnan(deviation) ? bl_colour_missing : bl_colour_spline_at(spline, x);
    bl_colour mean = {{0, 0, 0}};
    double total = 0;
    for (int i = 0; i < PIECES; i++) {
        double from = -4 + 8.0 * i / PIECES, to = -4 + 8.0 * (i + 1) / PIECES;
        double mass = erf(to * M_SQRT1_2) - erf(from * M_SQRT1_2);
        bl_colour piece = bl_colour_spline_mean(spline, x + 0.5 * (from + to) * deviation,
                                                (to - from) * deviation);
        total += mass;
        for (int c = 0; c < 3; c++)
            mean.rgb[c] += mass * piece.rgb[c];
    }
    for (int c = 0; c < 3; c++)
        mean.rgb[c] /= total;
    return mean;
}

bl_colour bl_colour_clamp(bl_colour colour) {
    for (int i = 0; i < 3; i++)
        if (!isnan(colour.rgb[i]))
            colour.rgb[i] = fmin(fmax(colour.rgb[i], 0), 1);
    return colour;
}
