// SPDX-License-Identifier: MIT
#include "textures/colour_spline.h"

#include <math.h>

#include "filters/spline.h"
#include "textures/sampling.h"

// One component of the colours.
static bl_spline part(const bl_colour_spline *spline, int component, const double *place) {
    return (bl_spline){.knot = &spline->knots[0].rgb[component],
                       .count = spline->count,
                       .stride = sizeof(bl_colour) / sizeof(double),
                       .place = place};
}

bl_colour bl_colour_spline_at(const bl_colour_spline *spline, double x) {
    bl_colour colour;
    for (int i = 0; i < 3; i++) {
        bl_spline own = part(spline, i, NULL);
        colour.rgb[i] = bl_spline_at(&own, x);
    }
    return colour;
}

bl_colour bl_colour_spline_mean(const bl_colour_spline *spline, double x, double width) {
    double place[BL_SPLINE_MOST];
    bl_colour mean;
    bl_spline_places(spline->count, place);
    for (int i = 0; i < 3; i++) {
        bl_spline own = part(spline, i, place);
        mean.rgb[i] = bl_spline_average(&own, &bl_filter_box, x, width);
    }
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
