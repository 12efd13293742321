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
