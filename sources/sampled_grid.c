// SPDX-License-Identifier: MIT
#include "sources/sampled_grid.h"

#include <math.h>

const char *const bl_sampled_grid_wrap_words[] = {"none", "periodic", "mirror", NULL};
const char *const bl_sampled_grid_reading_words[] = {"nearest", "linear", "catmull-rom", NULL};

enum { TAPS = 4 };

static const double FARTHEST = 0x1p62; // of a coordinate that is wrapped

// The sample that a whole number of samples from the first one falls on, or SIZE_MAX. fmod is
// exact, and its result fits a size_t because a size does.
static size_t sample_index(double place, size_t size, uint32_t wrap) {
    double count = (double)size;
    if (wrap == BL_WRAP_NONE)
        return place >= 0 && place < count ? (size_t)place : SIZE_MAX;
    double length = wrap == BL_WRAP_MIRROR ? 2 * count : count;
    double within = fmod(place, length);
    if (within < 0)
        within += length;
    return (size_t)(within < count ? within : length - 1 - within);
}

// The samples around a coordinate and their weights along one axis; those of weight 0 are left out,
// so that the last sample of a grid needs no neighbour. Zero if there is no value.
static unsigned axis_taps(const bl_sampled_grid *grid, unsigned axis, double coordinate,
                          size_t index[TAPS], double weight[TAPS]) {
    double place = coordinate / grid->spacing;
    if (!isfinite(place) || (grid->wrap != BL_WRAP_NONE && fabs(coordinate) > FARTHEST))
        return 0;
    double first, weights[TAPS] = {1};
    unsigned wanted = 1, count = 0;
    if (grid->reading == BL_READ_NEAREST) {
        first = floor(place + 0.5);
    } else {
        first = floor(place);
        double t = place - first, t2 = t * t, t3 = t2 * t;
        if (grid->reading == BL_READ_LINEAR) {
            wanted = 2;
            weights[0] = 1 - t;
            weights[1] = t;
        } else {
            wanted = 4;
            first -= 1;
            weights[0] = -0.5 * t3 + t2 - 0.5 * t;
            weights[1] = 1.5 * t3 - 2.5 * t2 + 1;
            weights[2] = -1.5 * t3 + 2 * t2 + 0.5 * t;
            weights[3] = 0.5 * t3 - 0.5 * t2;
        }
    }
    for (unsigned i = 0; i < wanted; i++) {
        if (weights[i] == 0)
            continue;
        index[count] = sample_index(first + i, grid->size[axis], grid->wrap);
        if (index[count] == SIZE_MAX)
            return 0;
        weight[count++] = weights[i];
    }
    return count;
}

double bl_sampled_grid_value(const bl_sampled_grid *grid, const double at[BL_AXES]) {
    size_t index[BL_AXES][TAPS] = {{0}};
    double weight[BL_AXES][TAPS], sum = 0;
    unsigned taps[BL_AXES] = {1, 1, 1, 1}, total = 1;
    for (unsigned a = 0; a < BL_AXES; a++) {
        weight[a][0] = 1;
        if (a < grid->dims)
            taps[a] = axis_taps(grid, a, at[a], index[a], weight[a]);
        total *= taps[a];
    }
    if (total == 0)
        return NAN;
    for (unsigned tap = 0; tap < total; tap++) {
        size_t place[BL_AXES];
        double product = 1;
        for (unsigned a = 0, rest = tap; a < BL_AXES; rest /= taps[a], a++) {
            place[a] = index[a][rest % taps[a]];
            product *= weight[a][rest % taps[a]];
        }
        float sample = NAN;
        grid->span(grid->source, place, 1, &sample);
        if (total == 1)
            return (double)sample;
        sum += product * (double)sample;
    }
    return sum;
}

// Whether a row walks the samples one by one and stays within the grid; `first` is where it starts.
static int is_span(const bl_sampled_grid *grid, const double start[BL_AXES],
                   const double step[BL_AXES], size_t count, size_t first[BL_AXES]) {
    if (count == 0 || grid->reading != BL_READ_NEAREST || step[0] != grid->spacing)
        return 0;
    for (unsigned a = 0; a < BL_AXES; a++) {
        first[a] = 0;
        if (a >= grid->dims)
            continue;
        if (a > 0 && step[a] != 0)
            return 0;
        first[a] = sample_index(floor(start[a] / grid->spacing + 0.5), grid->size[a], BL_WRAP_NONE);
        if (first[a] == SIZE_MAX)
            return 0;
    }
    double last = start[0] + (double)(count - 1) * step[0];
    size_t end = sample_index(floor(last / grid->spacing + 0.5), grid->size[0], BL_WRAP_NONE);
    return end != SIZE_MAX && end - first[0] == count - 1;
}

void bl_sampled_grid_row(const bl_sampled_grid *grid, const double start[BL_AXES],
                         const double step[BL_AXES], size_t count, float *out) {
    size_t first[BL_AXES];
    if (is_span(grid, start, step, count, first)) {
        grid->span(grid->source, first, count, out);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        double at[BL_AXES];
        for (unsigned a = 0; a < BL_AXES; a++)
            at[a] = start[a] + (double)i * step[a];
        out[i] = (float)bl_sampled_grid_value(grid, at);
    }
}

void bl_sampled_grid_describe(const bl_sampled_grid *grid, bl_signal *signal) {
    signal->dimensions = grid->dims;
    int everywhere = grid->wrap != BL_WRAP_NONE;
    for (unsigned a = 0; a < BL_AXES; a++) {
        int exists = a < grid->dims;
        if (exists) {
            signal->picture.size[a] = grid->size[a];
            signal->picture.spacing[a] = grid->spacing;
        }
        if (exists && !(everywhere && grid->reading != BL_READ_NEAREST)) {
            signal->extent.size[a] = grid->size[a];
            signal->extent.spacing[a] = grid->spacing;
        }
        if (everywhere)
            signal->facts.period[a] = exists ? (double)grid->size[a] * grid->spacing *
                                                   (grid->wrap == BL_WRAP_MIRROR ? 2 : 1)
                                             : 0;
    }
    if (everywhere) {
        signal->facts.cell = grid->spacing;
        signal->facts.continuity = (int)grid->reading - 1; // discontinuous, C0, C1
    }
}
