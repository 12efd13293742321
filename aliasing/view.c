// SPDX-License-Identifier: MIT
#include "aliasing/view.h"

#include <stdlib.h>
#include <string.h>

void bl_view_close(bl_view *view) {
    free(view->parameters);
    free(view->text);
    *view = (bl_view){0};
}

int bl_view_see(const bl_view *view, double x, double y, bl_sight *sight) {
    const double size[2] = {(double)view->width, (double)view->height};
    if (view->zoom == 1)
        return view->kind->see(view->parameters, size, x + view->pan[0], y + view->pan[1], sight);
    double factor = 1 / view->zoom, right = x + view->pan[0] - 0.5 * size[0],
           down = y + view->pan[1] - 0.5 * size[1];
    int seen = view->kind->see(view->parameters, size, 0.5 * size[0] + factor * right,
                               0.5 * size[1] + factor * down, sight);
    for (int a = 0; a < BL_AXES && seen; a++) {
        sight->across[a] *= factor;
        sight->down[a] *= factor;
        for (int i = 0; i < 3; i++)
            sight->second[a][i] *= factor * factor;
    }
    return seen;
}

bl_footprint bl_sight_footprint(const bl_sight *sight, const bl_width_rule *rule) {
    bl_footprint footprint;
    for (int a = 0; a < BL_AXES; a++) {
        footprint.across[a] = rule->scale * sight->across[a];
        footprint.down[a] = rule->scale * sight->down[a];
        footprint.width[a] =
            rule->scale * bl_sample_width(rule->estimator, sight->across[a], sight->down[a],
                                          sight->distance, rule->k);
    }
    return rule->estimator == BL_WIDTH_DISTANCE ? bl_footprint_of_widths(footprint.width)
                                                : footprint;
}

size_t bl_view_pixels(const bl_view *view, size_t first, double x[BL_BATCH], double y[BL_BATCH]) {
    size_t rest = view->width * view->height - first, count = rest < BL_BATCH ? rest : BL_BATCH;
    for (size_t i = 0; i < count; i++) {
        x[i] = (double)((first + i) % view->width) + 0.5;
        y[i] = (double)((first + i) / view->width) + 0.5;
    }
    return count;
}
