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
    x += view->pan[0];
    y += view->pan[1];
    if (view->zoom != 1) {
        x = 0.5 * size[0] + 1 / view->zoom * (x - 0.5 * size[0]);
        y = 0.5 * size[1] + 1 / view->zoom * (y - 0.5 * size[1]);
    }
    if (!view->kind->see(view->parameters, size, x, y, sight))
        return 0;
    for (int a = 0; a < BL_AXES; a++) {
        sight->at[a] += view->depth[a];
        if (view->zoom == 1)
            continue;
        double factor = 1 / view->zoom;
        sight->across[a] *= factor;
        sight->down[a] *= factor;
        for (int i = 0; i < 3; i++)
            sight->second[a][i] *= factor * factor;
    }
    return 1;
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
