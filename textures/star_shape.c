// SPDX-License-Identifier: MIT
#include "textures/star_shape.h"

#include <math.h>

double bl_star_distance(const bl_star *star, double s, double t, double outwards[2]) {
    double sector = 2 * M_PI / star->points, half = 0.5 * sector;
    double phi = atan2(s, t) + M_PI, radius = sqrt(s * s + t * t);
    double k = floor(phi / sector), fraction = phi / sector - k;
    int folded = fraction >= 0.5;
    double a = folded ? 1 - fraction : fraction, angle = star->printed ? a : a * sector;
    // From the tip to the notch, and from the tip to the place.
    double edge[2] = {star->inner * cos(half) - star->outer, star->inner * sin(half)};
    double place[2] = {radius * cos(angle) - star->outer, radius * sin(angle)};
    double length = sqrt(edge[0] * edge[0] + edge[1] * edge[1]);
    double normal = atan2(-edge[0], edge[1]); // of the way out, in the folded sector
    double turned = (folded ? (k + 1) * sector - normal : k * sector + normal) - M_PI;
    outwards[0] = sin(turned);
    outwards[1] = cos(turned);
    return (edge[0] * place[1] - edge[1] * place[0]) / length;
}

double bl_star_step(const bl_star *star, bl_edge edge, double s, double t,
                    const double width[BL_AXES]) {
    double outwards[2], distance = bl_star_distance(star, s, t, outwards);
    double across =
        edge == BL_EDGE_SHARP ? 0 : fabs(outwards[0]) * width[0] + fabs(outwards[1]) * width[1];
    return bl_edge_step(edge, distance, across);
}

double bl_star_area(const bl_star *star) { // of 2 points triangles
    return star->points * star->inner * star->outer * sin(M_PI / star->points);
}

typedef struct polygon {
    // A cut leaves at most 3/2 of the corners: four cuts of 2 points leave 10.2 points.
    double at[11 * BL_STAR_POINTS_MOST][2];
    unsigned count;
} polygon;

// What of the polygon lies where sign * (coordinate - limit) <= 0, after sutherland1974. Of
// a hollow polygon, pieces hang together by bridges along the limit, which have no area.
static void cut(polygon *shape, int axis, double sign, double limit) {
    polygon kept = {.count = 0};
    for (unsigned i = 0; i < shape->count; i++) {
        const double *a = shape->at[i], *b = shape->at[(i + 1) % shape->count];
        double from = sign * (a[axis] - limit), to = sign * (b[axis] - limit);
        if (from <= 0) {
            kept.at[kept.count][0] = a[0];
            kept.at[kept.count++][1] = a[1];
        }
        if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
            double share = from / (from - to);
            kept.at[kept.count][axis] = limit;
            kept.at[kept.count][1 - axis] = a[1 - axis] + share * (b[1 - axis] - a[1 - axis]);
            kept.count++;
        }
    }
    *shape = kept;
}

static double area(const polygon *shape) {
    double twice = 0;
    for (unsigned i = 0; i < shape->count; i++) {
        const double *a = shape->at[i], *b = shape->at[(i + 1) % shape->count];
        twice += a[0] * b[1] - a[1] * b[0];
    }
    return 0.5 * fabs(twice);
}

double bl_star_coverage(const bl_star *star, double s, double t, const double width[BL_AXES]) {
    polygon shape = {.count = 2 * star->points};
    for (unsigned i = 0; i < shape.count; i++) {
        double radius = i % 2 ? star->inner : star->outer;
        double angle = M_PI * i / star->points - M_PI;
        shape.at[i][0] = radius * sin(angle) - s; // the sample stands at the origin
        shape.at[i][1] = radius * cos(angle) - t;
    }
    for (int axis = 0; axis < 2; axis++) {
        cut(&shape, axis, 1, 0.5 * width[axis]);
        cut(&shape, axis, -1, -0.5 * width[axis]);
    }
    return fmin(area(&shape) / (width[0] * width[1]), 1);
}
