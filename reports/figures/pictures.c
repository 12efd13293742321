// SPDX-License-Identifier: MIT
#include "reports/figures/pictures.h"

#include <math.h>
#include <string.h>

#include "core/grid.h"

// The place of the panel at (x, y), in pictures from its upper left corner; 0 for the background.
static int place_of(const bl_shown *shown, double x, double y, double at[BL_AXES]) {
    memcpy(at, shown->at, sizeof shown->at);
    if (shown->see)
        return shown->see(2 * x - 1, 1 - 2 * y, at);
    at[0] += shown->scale * (x - 0.5);
    at[1] += shown->scale * (y - 0.5);
    return 1;
}

static void draw_pixel(const bl_shown *shown, const bl_signal *signal, unsigned pixels,
                       unsigned samples, size_t i, size_t j, float out[3]) {
    double wide = shown->filtered ? shown->scale / pixels : bl_signal_own_width(signal);
    const double width[BL_AXES] = {wide, wide, wide, wide};
    double sum[3] = {0};
    for (unsigned k = 0; k < samples * samples; k++) {
        double x = ((double)i + (k % samples + 0.5) / samples) / pixels, at[BL_AXES];
        double y = ((double)j + (k / samples + 0.5) / samples) / pixels, rgb[3] = {1, 1, 1};
        if (place_of(shown, x, y, at))
            bl_signal_colour(signal, at, width, rgb);
        for (int c = 0; c < 3; c++)
            sum[c] += rgb[c] / (samples * samples);
    }
    for (int c = 0; c < 3; c++)
        out[c] = (float)sum[c];
}

// All panels of a plot have the same numbers of pixels: coarse ones are drawn as squares.
static const char *draw_one(bl_run *run, const bl_pictures *set, const bl_shown *shown) {
    const bl_signal *raw = shown->signal ? shown->signal : bl_run_signal(run, shown->text);
    const unsigned full = set->pixels, pixels = shown->pixels ? shown->pixels : full;
    const unsigned times = full / pixels;
    // Coarse panels show alias, or what a filter does about it; others are to show neither.
    const bl_signal *signal = shown->filtered || shown->pixels || shown->see
                                  ? raw
                                  : bl_run_filtered(run, raw, shown->scale / pixels);
    const int is_one = shown->filtered || shown->pixels || signal != raw || !set->samples;
    const unsigned samples = is_one ? 1 : set->samples;
    float *values = bl_run_memory(run, (size_t)full * full * 3, sizeof *values);
#pragma omp parallel for num_threads(bl_thread_count(bl_run_settings(run)->threads))               \
    schedule(dynamic, 4)
    for (size_t j = 0; j < full; j++)
        for (size_t i = 0; i < full; i++)
            draw_pixel(shown, signal, pixels, samples, i / times, j / times,
                       values + 3 * (full * j + i));
    const bl_attribute attribute = {"bandlimit:signal", shown->text ? shown->text : signal->text};
    const bl_image image = {.width = full,
                            .height = full,
                            .channels = 3,
                            .values = values,
                            .spacing = shown->scale / full,
                            .white = 1,
                            .srgb = 1,
                            .attributes = &attribute,
                            .attribute_count = 1};
    const char *file = bl_run_image(run, shown->key, &image);
    bl_run_release(run, values);
    return file;
}

void bl_pictures_draw(bl_run *run, const bl_pictures *pictures) {
    bl_panel *panels = bl_run_memory(run, pictures->count, sizeof *panels);
    bl_run_step(run, "pictures");
    for (size_t i = 0; i < pictures->count; i++) {
        bl_shown shown = pictures->shown[i];
        if (!(shown.scale > 0)) {
            memcpy(shown.at, pictures->at, sizeof shown.at);
            shown.scale = pictures->scale;
        }
        bl_run_setting(run, bl_run_text(run, "picture %s", shown.key),
                       shown.text ? shown.text : shown.signal->text);
        panels[i] = (bl_panel){.title = shown.title, .image = draw_one(run, pictures, &shown)};
    }
    const bl_plot plot = {.title = pictures->title,
                          .x = {bl_run_text(run, "s, %s", pictures->unit), 0, 1, 0.25, 0},
                          .y = {bl_run_text(run, "t, %s", pictures->unit), 1, 0, 0.25, 0},
                          .panels = panels,
                          .panel_count = pictures->count,
                          .columns = pictures->columns,
                          .aspect = 1,
                          .coloured = 1,
                          .pixel = 1.0 / pictures->pixels};
    bl_run_plot(run, pictures->name, &plot, pictures->alternative);
}
