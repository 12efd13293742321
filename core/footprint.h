// SPDX-License-Identifier: MIT
//
// Footprints: what one sample sees of a signal, and batches of samples.
//
// A pixel of a view is, to the first order, a parallelogram of the signal: its sides are the
// derivatives of the coordinates, `across` to the next pixel on the right and `down` to the next
// one below. Filters that follow a direction (a box that is turned, an ellipse) take these two.
//
// Filters that look along the axes, or in all directions alike, take `width` instead: how wide the
// sample is along each axis. No one width is right for a parallelogram that is turned against the
// axes, so whoever makes the footprint chooses the estimate (filters/sample_width.h has them) and
// writes it down here, once for all filters.
//
// An upright footprint is one told by its widths alone: across lies along x and down along y. Along
// the other axes a flat sample has no side; its width there is given: a solid texture of width w
// sees (w, 0, 0) and (0, w, 0), and filters with the width w along every axis.
//
// A point is 0 all over. A whole footprint is infinitely wide along every axis of the signal: the
// sample is the mean; one that is infinite along some of them only is an endless strip. NaN says
// that a width is not known: what depends on it is NaN.
#ifndef BL_CORE_FOOTPRINT_H
#define BL_CORE_FOOTPRINT_H

#include <stddef.h>

enum { BL_AXES = 4 }; // x, y, z, w

typedef struct bl_footprint {
    double across[BL_AXES], down[BL_AXES]; // units a sample; either sign
    double width[BL_AXES];                 // units, 0 to INFINITY
} bl_footprint;

extern const bl_footprint bl_footprint_point;

// The upright footprint of these widths; and of one width along every axis.
bl_footprint bl_footprint_of_widths(const double width[BL_AXES]);
bl_footprint bl_footprint_of_width(double width);

// The largest width among the first `dimensions` axes, for what filters alike in all directions;
// NaN if one of them is.
double bl_footprint_widest(const bl_footprint *footprint, unsigned dimensions);

// Whether nothing but the mean is left along the first `dimensions` axes, whatever the filter.
int bl_footprint_is_whole(const bl_footprint *footprint, unsigned dimensions);

// Many samples at once. Sample i lies at (at[0][i], at[1][i], at[2][i], at[3][i]) and sees
// footprint[i * step]: `step` is 1, or 0 where one footprint is that of all samples. All arrays are
// plain doubles without further alignment, borrowed, and apart from those that are written.
typedef struct bl_samples {
    const double *at[BL_AXES]; // all four can be read, `count` numbers each
    const bl_footprint *footprint;
    size_t step, count;
} bl_samples;

static inline const bl_footprint *bl_samples_footprint(const bl_samples *samples, size_t i) {
    return &samples->footprint[i * samples->step];
}

static inline void bl_samples_place(const bl_samples *samples, size_t i, double at[BL_AXES]) {
    for (int a = 0; a < BL_AXES; a++)
        at[a] = samples->at[a][i];
}

// The samples from `first` on, at most `most` of them; first < samples->count.
bl_samples bl_samples_part(const bl_samples *samples, size_t first, size_t most);

// How many samples those who go through many take at a time, with room for them on the stack. No
// result depends on it: where sums are rounded in runs, the run has a length of its own.
enum { BL_BATCH = 128 };

// A batch that is gathered place by place: number k is that of the caller's `of[k]`.
typedef struct bl_gathered {
    double at[BL_AXES][BL_BATCH];
    size_t of[BL_BATCH], count;
} bl_gathered;

// At most BL_BATCH places fit.
static inline void bl_gather(bl_gathered *gathered, size_t of, const double at[BL_AXES]) {
    for (int a = 0; a < BL_AXES; a++)
        gathered->at[a][gathered->count] = at[a];
    gathered->of[gathered->count++] = of;
}

static inline bl_samples bl_gathered_samples(const bl_gathered *gathered,
                                             const bl_footprint *footprint, size_t step) {
    return (bl_samples){{gathered->at[0], gathered->at[1], gathered->at[2], gathered->at[3]},
                        footprint,
                        step,
                        gathered->count};
}

#endif
