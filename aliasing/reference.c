// SPDX-License-Identifier: MIT
#include "aliasing/reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "aliasing/patterns.h"
#include "aliasing/reference_cache.h"
#include "core/setting.h"
#include "core/grid.h"
#include "core/hash.h"
#include "core/statistics.h"
#include "textures/texture.h"

// A sequence is summed in runs of RUN samples, since the rounding of a sum depends on its order:
// RUN is part of what a reference is, and no matter of how many samples fit a batch.
enum { SEQUENCES = 4, PILOT = 32, ROUNDS = 4, RUN = 128 };
_Static_assert((int)RUN <= (int)BL_BATCH, "a run is one batch");

const char *const bl_pixel_words[] = {"box", "gaussian", NULL};

static double pixel_offset(bl_pixel pixel, double place) {
    return pixel == BL_PIXEL_BOX ? place - 0.5 : 0.5 * bl_normal_quantile(place + 0x1p-33);
}

// Adds the colours at the places of a run: in rows of floats, and the background after them, where
// the signal has rows and no colour; their rounding (2^-24 of a value) is far below what is
// converged to.
static void add_colours(const bl_scene *scene, const double *x, const double *y, size_t count,
                        double sum[3]) {
    if (scene->signal->functions->colour || !scene->signal->functions->points) {
        double rgb[3 * RUN];
        bl_scene_points(scene, x, y, count, rgb);
        for (size_t i = 0; i < count; i++)
            for (size_t c = 0; c < 3; c++)
                sum[c] += rgb[3 * i + c];
        return;
    }
    bl_gathered seen = {.count = 0};
    float out[RUN];
    for (size_t i = 0; i < count; i++) {
        bl_sight sight;
        if (bl_view_see(scene->view, x[i], y[i], &sight))
            bl_gather(&seen, i, sight.at);
    }
    const bl_samples samples = bl_gathered_samples(&seen, &bl_footprint_point, 0);
    bl_signal_points(scene->signal, samples.at, seen.count, out);
    for (int c = 0; c < 3; c++) {
        for (size_t i = 0; i < seen.count; i++)
            sum[c] += (double)out[i];
        sum[c] += (double)(count - seen.count) * scene->background[c];
    }
}

void bl_reference_pixel(const bl_scene *scene, bl_pixel pixel, double x, double y, uint32_t samples,
                        uint64_t key, double rgb[3], double *variance) {
    bl_moments moments = {0};
    double sum[3] = {0, 0, 0}, at_x[RUN], at_y[RUN];
    for (uint64_t s = 0; s < SEQUENCES; s++) {
        double part[3] = {0, 0, 0};
        uint64_t own = bl_stream(key, s);
        for (uint32_t done = 0, count; done < samples; done += count) {
            count = samples - done < RUN ? samples - done : RUN;
            for (uint32_t i = 0; i < count; i++) {
                double place[2];
                bl_sobol_place(done + i, own, place);
                at_x[i] = x + pixel_offset(pixel, place[0]);
                at_y[i] = y + pixel_offset(pixel, place[1]);
            }
            add_colours(scene, at_x, at_y, count, part);
        }
        for (int c = 0; c < 3; c++) {
            part[c] /= samples;
            sum[c] += part[c] / SEQUENCES;
        }
        bl_moments_add(&moments, bl_colour_component(part, 0));
    }
    memcpy(rgb, sum, sizeof sum);
    *variance = bl_moments_variance(&moments) / SEQUENCES;
}

// --- convergence --------------------------------------------------------------------------------

// One round: every pixel anew with its own number of samples.
static void run_round(const bl_scene *scene, const bl_reference_settings *settings,
                      const uint32_t *samples, uint64_t round, bl_reference *reference) {
    const size_t width = reference->width;
    double squares = 0, total = 0;
#pragma omp parallel for schedule(dynamic, 2) num_threads(bl_thread_count(settings->threads))
    for (size_t j = 0; j < reference->height; j++)
        for (size_t i = 0; i < width; i++) {
            size_t p = j * width + i;
            double x = (double)i + 0.5, y = (double)j + 0.5, variance;
            uint64_t key = bl_stream(bl_pattern_key(scene->seed, x, y), round);
            bl_reference_pixel(scene, settings->pixel, x, y, samples[p], key,
                               &reference->rgb[3 * p], &variance);
            reference->error[p] = sqrt(variance);
        }
    for (size_t p = 0; p < width * reference->height; p++) { // in order, for the same bits
        squares += reference->error[p] * reference->error[p];
        total += SEQUENCES * (double)samples[p];
    }
    reference->rms_error = sqrt(squares / (double)(width * reference->height));
    reference->samples += total / (double)(width * reference->height);
}

// The largest error at a pixel and its neighbours: four values may agree by chance.
static double error_about(const bl_reference *reference, size_t i, size_t j) {
    double most = 0;
    for (size_t v = j ? j - 1 : 0; v < j + 2 && v < reference->height; v++)
        for (size_t u = i ? i - 1 : 0; u < i + 2 && u < reference->width; u++)
            most = fmax(most, reference->error[v * reference->width + u]);
    return most;
}

// Doubles what is wanted: the error of a randomised sequence falls at least as the root of its
// length; at edges as its 3/4 power. False if all is spent.
static int plan_round(const bl_reference *reference, double target, uint32_t most,
                      uint32_t *samples) {
    int grown = 0;
    for (size_t j = 0; j < reference->height; j++)
        for (size_t i = 0; i < reference->width; i++) {
            uint32_t *n = &samples[j * reference->width + i], before = *n;
            double ratio = target > 0 ? error_about(reference, i, j) / target : INFINITY;
            double wanted = *n * pow(fmin(fmax(ratio, 1), 1e9), 4.0 / 3);
            while (*n < most && *n < wanted)
                *n *= 2; // whole powers of two keep the strata whole
            grown = grown || *n > before;
        }
    return grown;
}

static void converge(const bl_scene *scene, const bl_reference_settings *settings,
                     uint32_t *samples, bl_reference *reference) {
    double target = settings->tolerance;
    for (size_t p = 0; p < reference->width * reference->height; p++)
        samples[p] = PILOT;
    run_round(scene, settings, samples, 0, reference);
    for (uint64_t round = 1; round <= ROUNDS && reference->rms_error > settings->tolerance &&
                             plan_round(reference, target, settings->most_samples, samples);
         round++) {
        run_round(scene, settings, samples, round, reference);
        target *= fmin(1, 0.9 * settings->tolerance / reference->rms_error);
    }
}

// --- exact --------------------------------------------------------------------------------------

// Whether each axis of the image runs along one axis of the signal, so that a pixel is a box there.
static int is_along_axes(const bl_view *view) {
    bl_sight sight;
    if (!view->kind->affine || !bl_view_see(view, 0.5, 0.5, &sight))
        return 0;
    int across = 0, down = 0, both = 0;
    for (int a = 0; a < BL_AXES; a++) {
        across += sight.across[a] != 0;
        down += sight.down[a] != 0;
        both += sight.across[a] != 0 && sight.down[a] != 0;
    }
    return across <= 1 && down <= 1 && !both;
}

static void fill_exact(const bl_scene *scene, const bl_signal *exact, bl_reference *reference) {
    const size_t pixels = reference->width * reference->height;
    const bl_width_rule rule = {.estimator = BL_WIDTH_SUM, .scale = 1};
    bl_scene filtered = *scene;
    filtered.signal = exact;
    for (size_t first = 0; first < pixels; first += BL_BATCH) {
        double x[BL_BATCH], y[BL_BATCH];
        size_t count = bl_view_pixels(scene->view, first, x, y);
        bl_scene_filtered(&filtered, &rule, x, y, count, reference->rgb + 3 * first);
    }
    reference->exact = 1;
    reference->samples = 1;
}

// Sets `reference->exact` where there is an integral.
static bl_status try_exact(const bl_scene *scene, bl_pixel pixel, bl_reference *reference,
                           bl_message *message) {
    if (pixel != BL_PIXEL_BOX || !bl_method_is_own(scene->signal, "exact") ||
        !is_along_axes(scene->view))
        return BL_OK;
    bl_signal *exact;
    bl_status status = bl_signal_with_setting(scene->signal, bl_method_own_key(scene->signal),
                                              "exact", &exact, message);
    if (status != BL_OK)
        return status;
    fill_exact(scene, exact, reference);
    bl_signal_free(exact);
    return BL_OK;
}

// --- all of it ----------------------------------------------------------------------------------

static bl_status make(const bl_scene *scene, const bl_reference_settings *settings,
                      bl_reference *reference, bl_message *message) {
    const size_t pixels = reference->width * reference->height;
    bl_status status = try_exact(scene, settings->pixel, reference, message);
    if (status != BL_OK)
        return status;
    uint32_t *samples = malloc(pixels * sizeof *samples);
    if (!samples)
        return bl_report(message, BL_DEVICE, "out of memory for a converged image");
    if (!reference->exact)
        converge(scene, settings, samples, reference);
    free(samples);
    for (size_t i = 0; i < 3 * pixels; i++)
        if (!isfinite(reference->rgb[i]))
            return bl_report(message, BL_MISMATCH,
                             "'%s' is not finite at pixel %zu, %zu of the view '%s'",
                             scene->signal->text, i / 3 % reference->width,
                             i / 3 / reference->width, scene->view->text);
    return BL_OK;
}

bl_status bl_reference_make(const bl_scene *scene, const bl_reference_settings *settings,
                            bl_reference *reference, bl_message *message) {
    const size_t pixels = scene->view->width * scene->view->height;
    *reference = (bl_reference){.width = scene->view->width, .height = scene->view->height};
    reference->rgb = calloc(3 * pixels, sizeof *reference->rgb);
    reference->error = calloc(pixels, sizeof *reference->error);
    bl_status status = BL_OK;
    if (!reference->rgb || !reference->error)
        status = bl_report(message, BL_DEVICE, "out of memory for a converged image");
    else if (!settings->cache || !bl_reference_cache_read(scene, settings, reference)) {
        status = make(scene, settings, reference, message);
        if (status == BL_OK && settings->cache)
            status = bl_reference_cache_write(scene, settings, reference, message);
    }
    if (status != BL_OK)
        bl_reference_free(reference);
    return status;
}

void bl_reference_free(bl_reference *reference) {
    free(reference->rgb);
    free(reference->error);
    *reference = (bl_reference){0};
}
