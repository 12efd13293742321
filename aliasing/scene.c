// SPDX-License-Identifier: MIT
#include "aliasing/scene.h"

#include <math.h>
#include <string.h>

#include "core/grid.h"
#include "core/random.h"
#include "textures/texture.h"

enum { PLACES = 1 << 14, REACH = 64 };

// Adds the colour at a random place near one that is seen; 0 if nothing is seen there.
static int add_place(const bl_scene *scene, bl_random *random, double sum[3], double *count) {
    static const double none[BL_AXES] = {0};
    double x = bl_random_unit(random) * (double)scene->view->width;
    double y = bl_random_unit(random) * (double)scene->view->height, rgb[3];
    bl_sight sight;
    if (!bl_view_see(scene->view, x, y, &sight))
        return 0;
    for (int a = 0; a < BL_AXES; a++) {
        double offset = REACH * (2 * bl_random_unit(random) - 1);
        if (scene->signal->extent.size[0] == 0)
            sight.at[a] += offset;
    }
    bl_signal_colour(scene->signal, sight.at, none, rgb);
    if (!isfinite(rgb[0] + rgb[1] + rgb[2]))
        return 1;
    for (int c = 0; c < 3; c++)
        sum[c] += rgb[c];
    *count += 1;
    return 1;
}

bl_status bl_scene_make(const bl_signal *signal, const bl_view *view, uint64_t seed,
                        bl_scene *scene, double *seen, bl_message *message) {
    bl_random random = bl_random_seed(0, 0); // the scene looks the same for every seed
    double sum[3] = {0, 0, 0}, count = 0, sights = 0;
    *scene = (bl_scene){.signal = signal, .view = view, .seed = seed};
    for (int i = 0; i < PLACES; i++)
        sights += add_place(scene, &random, sum, &count);
    *seen = sights / PLACES;
    if (sights == 0)
        return bl_report(message, BL_MISMATCH, "the view '%s' sees nothing of '%s'; turn it",
                         view->text, signal->text);
    if (count == 0)
        return bl_report(message, BL_MISMATCH, "'%s' has no value where the view '%s' looks",
                         signal->text, view->text);
    int stated = isfinite(signal->facts.mean) && !signal->functions->colour;
    for (int c = 0; c < 3; c++)
        scene->mean[c] = scene->background[c] = stated ? signal->facts.mean : sum[c] / count;
    return BL_OK;
}

double bl_scene_luminance(const void *user, double x, double y) {
    const bl_scene_method *method = user;
    double rgb[3];
    method->kind->sample(method->parameters, method->scene, x, y, rgb);
    return bl_colour_component(rgb, 0);
}

double bl_scene_raw_luminance(const void *user, double x, double y) {
    double rgb[3];
    bl_scene_point(user, x, y, rgb);
    return bl_colour_component(rgb, 0);
}

void bl_scene_image(const bl_scene_method *method, int threads, double *rgb) {
    const bl_view *view = method->scene->view;
#pragma omp parallel for schedule(dynamic, 4) num_threads(bl_thread_count(threads))
    for (size_t j = 0; j < view->height; j++)
        for (size_t i = 0; i < view->width; i++)
            method->kind->sample(method->parameters, method->scene, (double)i + 0.5,
                                 (double)j + 0.5, &rgb[3 * (j * view->width + i)]);
}
