// SPDX-License-Identifier: MIT
//
// How wide a sample is along an axis of the texture, estimated from the derivatives of its
// coordinates by the pixel.
#ifndef BL_FILTERS_SAMPLE_WIDTH_H
#define BL_FILTERS_SAMPLE_WIDTH_H

typedef enum bl_width_estimator {
    BL_WIDTH_SUM,     // |da/dx| + |da/dy|: never too narrow for a box
    BL_WIDTH_MAXIMUM, // the larger of both
    BL_WIDTH_LENGTH,  // sqrt((da/dx)^2 + (da/dy)^2): right at any rotation for a round filter
    BL_WIDTH_DISTANCE // distance * k: no derivatives at all
} bl_width_estimator;

extern const char *const bl_width_estimator_words[]; // "sum", "maximum", "length", "distance"

// The width along one axis, in its units, of a coordinate with these derivatives (units per pixel).
// `distance` and `k` serve BL_WIDTH_DISTANCE only. NaN gives NaN. Source: peachey2003, p. 61.
double bl_sample_width(bl_width_estimator estimator, double across, double down, double distance,
                       double k);

#endif
