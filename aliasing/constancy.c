// SPDX-License-Identifier: MIT
#include "aliasing/constancy.h"

#include <math.h>
#include <stdlib.h>

#include "aliasing/scene.h"
#include "core/footprint.h"
#include "core/grid.h"
#include "core/random.h"
#include "core/statistics.h"
#include "textures/texture.h"

enum { SIDE = 128, PLACES = SIDE * SIDE, REACHES = 12, TRIES = 512 };
_Static_assert((int)SIDE <= (int)BL_BATCH, "a row is one batch");

// Values are floats: their rounding is no detail.
static int differs(double value, double from) {
    return !(fabs(value - from) <= 0x1p-21 * fmax(fabs(value), fabs(from)));
}

// One random place in each cell of a grid over the image.
static void look(const bl_scene *scene, double *value) {
    bl_random random = bl_random_seed(scene->seed, 0);
    const double width = (double)scene->view->width / SIDE;
    const double height = (double)scene->view->height / SIDE;
    for (int j = 0; j < SIDE; j++) {
        double x[SIDE], y[SIDE];
        for (int i = 0; i < SIDE; i++) {
            x[i] = width * (i + bl_random_unit(&random));
            y[i] = height * (j + bl_random_unit(&random));
        }
        bl_scene_raw_luminances(scene, x, y, SIDE, value + j * SIDE);
    }
}

// Looks at random places about 0, within ever wider boxes.
static void search(const bl_signal *signal, bl_constancy *same) {
    bl_random random = bl_random_seed(0, 0);
    for (int i = 0; i < REACHES * TRIES && !same->found; i++) {
        double at[BL_AXES] = {0}, rgb[3];
        same->reach = ldexp(1, i / TRIES - 1);
        for (unsigned a = 0; a < signal->dimensions; a++)
            at[a] = same->reach * (2 * bl_random_unit(&random) - 1);
        bl_gathered one = {.count = 0};
        bl_gather(&one, 0, at);
        const bl_samples samples = bl_gathered_samples(&one, &bl_footprint_point, 0);
        bl_signal_colours(signal, &samples, rgb);
        double value = bl_colour_component(rgb, 0);
        same->found = isfinite(value) && differs(value, same->value);
        for (int a = 0; a < BL_AXES; a++)
            same->place[a] = at[a];
    }
}

bl_constancy bl_constancy_find(const bl_scene *scene) {
    bl_constancy same = {.value = NAN, .varies = NAN};
    double *value = malloc(2 * PLACES * sizeof *value), *sorted = value + PLACES;
    if (!value)
        return same; // no memory for 256 KiB: what comes next says so
    look(scene, value);
    for (int i = 0; i < PLACES; i++)
        sorted[i] = value[i];
    qsort(sorted, PLACES, sizeof *sorted, bl_ascending);
    same.value = sorted[PLACES / 2];
    int others = 0;
    for (int i = 0; i < PLACES; i++)
        others += differs(value[i], same.value);
    same.varies = (double)others / PLACES;
    same.constant = others == 0;
    free(value);
    if (same.varies < 0.01)
        search(scene->signal, &same);
    return same;
}
