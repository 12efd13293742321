// SPDX-License-Identifier: MIT
//
// Samples on a grid of up to four axes, read as a signal. What stands beyond the edge is
// nothing (NaN), the grid again, or its mirror image; between the samples stands the nearest one, a
// multilinear interpolation, or the cubic convolution of Keys 1981 (a = -1/2, C1, exact at the
// samples and for quadratics).
//
// A grid is measured on its own samples (extent is set), each once: that is its spectrum without a
// resampling. Only a grid that fills all space and is interpolated is a function like any other and
// has no extent: measured at random places its spectrum shows the kernel of the interpolation and
// the images of the spectrum that it leaves around multiples of 1/spacing.
#ifndef BL_SOURCES_SAMPLED_GRID_H
#define BL_SOURCES_SAMPLED_GRID_H

#include "core/signal.h"

typedef enum bl_sampled_grid_wrap {
    BL_WRAP_NONE,
    BL_WRAP_PERIODIC,
    BL_WRAP_MIRROR
} bl_sampled_grid_wrap;
typedef enum bl_sampled_grid_reading {
    BL_READ_NEAREST,
    BL_READ_LINEAR,
    BL_READ_CATMULL_ROM
} bl_sampled_grid_reading;

extern const char *const bl_sampled_grid_wrap_words[]; // "none", "periodic", "mirror", NULL
extern const char
    *const bl_sampled_grid_reading_words[]; // "nearest", "linear", "catmull-rom", NULL

typedef struct bl_sampled_grid {
    unsigned dims;
    size_t size[BL_AXES]; // 1 along axes it does not have
    double spacing;       // units between samples
    uint32_t wrap, reading;
    // Samples index[0] .. index[0] + count - 1 of a line along x, all within the grid.
    void (*span)(const void *source, const size_t index[BL_AXES], size_t count, float *out);
    const void *source;
} bl_sampled_grid;

// The abilities of a signal, with the grid in the place of the parameters. Coordinates that are not
// finite give NaN, and those beyond 2^62 of a wrapped grid.
void bl_sampled_grid_row(const bl_sampled_grid *grid, const double start[BL_AXES],
                         const double step[BL_AXES], size_t count, float *out);
double bl_sampled_grid_value(const bl_sampled_grid *grid, const double at[BL_AXES]);

// Fills dimensions, extent, picture and facts (period, continuity, cell) of the signal.
void bl_sampled_grid_describe(const bl_sampled_grid *grid, bl_signal *signal);

#endif
