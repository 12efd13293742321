// SPDX-License-Identifier: MIT
#include "aliasing/flicker.h"

#include <math.h>
#include <stdlib.h>

#include "aliasing/patterns.h"
#include "core/grid.h"
#include "core/statistics.h"
#include "textures/texture.h"

enum { POP_FRAMES = 8 }; // times the frames of flicker

// The errors of one frame: errors[m * pixels + p], and the variance of the reference at each pixel.
typedef struct moving_picture {
    const bl_scene *scene;
    const bl_scene_method *methods;
    size_t count, pixels; // pixels: all of them
    const bl_flicker_settings *settings;
    double *error, *before, *noise;
    double spread;       // share of the image that the pixels are taken from, about its middle
    bl_moments *moments; // of each method's pixel
} moving_picture;

static void show_pixel(const moving_picture *picture, const bl_view *view, size_t p) {
    size_t side = picture->settings->pixels;
    // The middles of equal parts of the image, on centres of pixels.
    double u = 0.5 + picture->spread * (((double)(p % side) + 0.5) / (double)side - 0.5);
    double v = 0.5 + picture->spread * (((double)(p / side) + 0.5) / (double)side - 0.5);
    double x = floor(u * (double)view->width) + 0.5, y = floor(v * (double)view->height) + 0.5;
    double rgb[3];
    bl_scene scene = *picture->scene;
    scene.view = view;
    bl_reference_pixel(&scene, picture->settings->pixel, x, y, picture->settings->samples,
                       bl_pattern_key(scene.seed, x + view->pan[0], y + view->zoom), rgb,
                       &picture->noise[p]);
    double truth = bl_colour_component(rgb, 0);
    for (size_t m = 0; m < picture->count; m++) {
        bl_scene moved = *picture->methods[m].scene;
        moved.view = view;
        bl_scene_method method = picture->methods[m];
        method.scene = &moved;
        bl_scene_luminances(&method, &x, &y, 1, &picture->error[m * picture->pixels + p]);
        picture->error[m * picture->pixels + p] -= truth;
    }
}

static void show_frame(const moving_picture *picture, double right, double down, double zoom) {
    bl_view view = *picture->scene->view;
    view.pan[0] += right;
    view.pan[1] += down;
    view.zoom *= zoom;
#pragma omp parallel for schedule(dynamic, 4)                                                      \
    num_threads(bl_thread_count(picture->settings->threads))
    for (size_t p = 0; p < picture->pixels; p++)
        show_pixel(picture, &view, p);
}

// Adds the variance over one movement to each column's mean; what the reference itself varies is
// taken off.
static void add_variance(moving_picture *picture, int zooms, double *columns) {
    const unsigned frames = picture->settings->frames;
    const size_t side = picture->settings->pixels;
    const double share = 1.0 / (2.0 * (double)side);
    // The corner of the image moves by a pixel in all.
    double reach =
        2 / hypot((double)picture->scene->view->width, (double)picture->scene->view->height);
    for (size_t i = 0; i < picture->count * picture->pixels; i++)
        picture->moments[i] = (bl_moments){0};
    for (unsigned t = 0; t < frames; t++) {
        double time = (double)t / frames;
        show_frame(picture, zooms ? 0 : time, zooms ? 0 : 0.5 * time, zooms ? 1 + reach * time : 1);
        for (size_t i = 0; i < picture->count * picture->pixels; i++) {
            bl_moments_add(&picture->moments[i], picture->error[i]);
            columns[i / picture->pixels * side + i % side] -=
                share * picture->noise[i % picture->pixels] / frames;
        }
    }
    for (size_t i = 0; i < picture->count * picture->pixels; i++)
        columns[i / picture->pixels * side + i % side] +=
            share * bl_moments_variance(&picture->moments[i]);
}

// Fills the rms change of each method's error between the frames t - 1 and t of the zoom.
static void change_frame(moving_picture *picture, unsigned t, unsigned frames, double *changes) {
    double *swap = picture->before;
    picture->before = picture->error;
    picture->error = swap;
    show_frame(picture, 0, 0, exp2((double)t / frames));
    for (size_t m = 0; m < picture->count && t > 0; m++) {
        double sum = 0;
        for (size_t p = 0; p < picture->pixels; p++) {
            size_t i = m * picture->pixels + p;
            double change = picture->error[i] - picture->before[i];
            sum += change * change / (double)picture->pixels;
        }
        changes[m * frames + t - 1] = sqrt(sum);
    }
}

static bl_status find_pops(moving_picture *picture, bl_flicker *results, bl_message *message) {
    const unsigned frames = POP_FRAMES * picture->settings->frames;
    double *changes = malloc(picture->count * frames * sizeof *changes);
    if (!changes)
        return bl_report(message, BL_DEVICE, "out of memory for moving pictures");
    picture->spread = 0.5;
    for (unsigned t = 0; t <= frames; t++)
        change_frame(picture, t, frames, changes);
    for (size_t m = 0; m < picture->count; m++) {
        double *own = changes + m * frames;
        qsort(own, frames, sizeof *own, bl_ascending);
        double largest = own[frames - 1], median = own[frames / 2];
        results[m].pops = sqrt(largest * largest - median * median);
    }
    free(changes);
    return BL_OK;
}

bl_status bl_flicker_measure(const bl_scene *scene, const bl_scene_method *methods, size_t count,
                             const bl_flicker_settings *settings, bl_flicker *results,
                             bl_message *message) {
    const size_t side = settings->pixels, pixels = side * side;
    double *room = calloc(2 * count * pixels + pixels + count * side, sizeof *room);
    moving_picture picture = {scene, methods, count, pixels, settings, .error = room, .spread = 1};
    picture.moments = malloc(count * pixels * sizeof *picture.moments);
    if (!room || !picture.moments) {
        free(room);
        free(picture.moments);
        return bl_report(message, BL_DEVICE, "out of memory for moving pictures");
    }
    picture.before = room + count * pixels;
    picture.noise = picture.before + count * pixels;
    double *columns = picture.noise + pixels;
    add_variance(&picture, 0, columns);
    add_variance(&picture, 1, columns);
    for (size_t m = 0; m < count; m++)
        results[m] = (bl_flicker){bl_mean_estimate(columns + m * side, side, settings->level), 0};
    bl_status status = find_pops(&picture, results, message);
    free(room);
    free(picture.moments);
    return status;
}
