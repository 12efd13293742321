// SPDX-License-Identifier: MIT
#include "aliasing/scene.h"

#include <math.h>
#include <string.h>

#include "core/grid.h"
#include "core/random.h"
#include "textures/texture.h"

enum { PLACES = 1 << 14, REACH = 64 };
_Static_assert(PLACES % BL_BATCH == 0, "whole batches of places");

// Adds the finite ones of the colours at BL_BATCH random places near those that are seen; returns
// how many see something.
static double add_places(const bl_scene *scene, bl_random *random, double sum[3], double *count) {
    bl_gathered seen = {.count = 0};
    double rgb[3 * BL_BATCH];
    for (size_t i = 0; i < BL_BATCH; i++) {
        double x = bl_random_unit(random) * (double)scene->view->width;
        double y = bl_random_unit(random) * (double)scene->view->height;
        bl_sight sight;
        if (!bl_view_see(scene->view, x, y, &sight))
            continue;
        for (int a = 0; a < BL_AXES; a++) {
            double offset = REACH * (2 * bl_random_unit(random) - 1);
            if (scene->signal->extent.size[0] == 0)
                sight.at[a] += offset;
        }
        bl_gather(&seen, i, sight.at);
    }
    const bl_samples samples = bl_gathered_samples(&seen, &bl_footprint_point, 0);
    bl_signal_colours(scene->signal, &samples, rgb);
    for (const double *c = rgb; c < rgb + 3 * seen.count; c += 3) {
        if (!isfinite(c[0] + c[1] + c[2]))
            continue;
        for (int k = 0; k < 3; k++)
            sum[k] += c[k];
        *count += 1;
    }
    return (double)seen.count;
}

bl_status bl_scene_make(const bl_signal *signal, const bl_view *view, uint64_t seed,
                        bl_scene *scene, double *seen, bl_message *message) {
    bl_random random = bl_random_seed(0, 0); // the scene looks the same for every seed
    double sum[3] = {0, 0, 0}, count = 0, sights = 0;
    *scene = (bl_scene){.signal = signal, .view = view, .seed = seed};
    for (int i = 0; i < PLACES; i += BL_BATCH)
        sights += add_places(scene, &random, sum, &count);
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

static void take_luminances(const double *rgb, size_t count, double *out) {
    for (size_t i = 0; i < count; i++)
        out[i] = bl_colour_component(rgb + 3 * i, 0);
}

void bl_scene_luminances(const void *user, const double *x, const double *y, size_t count,
                         double *out) {
    const bl_scene_method *method = user;
    double rgb[3 * BL_BATCH];
    for (size_t done = 0, here; done < count; done += here) {
        here = count - done < BL_BATCH ? count - done : BL_BATCH;
        method->kind->sample(method->parameters, method->scene, x + done, y + done, here, rgb);
        take_luminances(rgb, here, out + done);
    }
}

void bl_scene_raw_luminances(const void *user, const double *x, const double *y, size_t count,
                             double *out) {
    double rgb[3 * BL_BATCH];
    for (size_t done = 0, here; done < count; done += here) {
        here = count - done < BL_BATCH ? count - done : BL_BATCH;
        bl_scene_points(user, x + done, y + done, here, rgb);
        take_luminances(rgb, here, out + done);
    }
}

void bl_scene_image(const bl_scene_method *method, int threads, double *rgb) {
    const bl_view *view = method->scene->view;
#pragma omp parallel for schedule(dynamic) num_threads(bl_thread_count(threads))
    for (size_t first = 0; first < view->width * view->height; first += BL_BATCH) {
        double x[BL_BATCH], y[BL_BATCH];
        size_t count = bl_view_pixels(view, first, x, y);
        method->kind->sample(method->parameters, method->scene, x, y, count, rgb + 3 * first);
    }
}
