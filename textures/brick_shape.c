// SPDX-License-Identifier: MIT
#include "textures/brick_shape.h"

#include <math.h>

#include "filters/pulse_train.h"
#include "textures/sampling.h"

const bl_colour bl_brick_colour = {{0.5, 0.15, 0.14}}, bl_mortar_colour = {{0.5, 0.5, 0.5}};

bl_brick bl_brick_of(const bl_brick_sizes *sizes) {
    bl_brick brick = {
        .size = {sizes->brick_width + sizes->mortar, sizes->brick_height + sizes->mortar}};
    for (int a = 0; a < 2; a++)
        brick.edge[a] = 0.5 * sizes->mortar / brick.size[a];
    return brick;
}

double bl_brick_share(const bl_brick *brick) {
    return (1 - 2 * brick->edge[0]) * (1 - 2 * brick->edge[1]);
}

bl_colour bl_brick_mean(const bl_brick *brick) {
    return bl_colour_mix(bl_mortar_colour, bl_brick_colour, bl_brick_share(brick));
}

double bl_brick_shift(double row) {
    return 0.5 * row - floor(0.5 * row); // 0 or 1/2, exact
}

// The rows of one parity are a pulse of period two rows. Each has its own average along s, so that
// the average of the product is a sum of two products of averages.
double bl_brick_average(const bl_brick *brick, const double at[BL_AXES],
                        const double width[BL_AXES]) {
    double s = at[0] / brick->size[0], t = at[1] / brick->size[1], sum = 0;
    double width_s = width[0] / brick->size[0], width_t = width[1] / brick->size[1];
    for (int parity = 0; parity < 2; parity++) {
        double low = 0.5 * (parity + brick->edge[1]), high = 0.5 * (parity + 1 - brick->edge[1]);
        sum += bl_pulse_train_average(&bl_filter_box, low, high, 0.5 * t, 0.5 * width_t) *
               bl_pulse_train_average(&bl_filter_box, brick->edge[0], 1 - brick->edge[0],
                                      s + 0.5 * parity, width_s);
    }
    return sum;
}
