// SPDX-License-Identifier: MIT
#include "aliasing/alias.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "aliasing/depth.h"
#include "aliasing/energy.h"
#include "aliasing/flicker.h"
#include "aliasing/metrics.h"
#include "aliasing/patterns.h"
#include "aliasing/predict.h"
#include "aliasing/scene.h"
#include "core/clock.h"
#include "core/hash.h"
#include "core/random.h"
#include "textures/texture.h"

enum { GRIDS = 2, REPLICATES_MOST = 64, TIMED = 256, PILOT_SAMPLES = 32 };

// Everything that is measured together.
typedef struct measurement {
    const bl_signal *signal;
    const bl_view *view;
    const bl_alias_settings *settings;
    size_t count;
    bl_method *methods; // opened
    bl_scene scene;     // of the raw signal
    bl_scene *scenes;   // of each method's own
    bl_scene_method *images;
    double (*alias)[REPLICATES_MOST], (*blur)[REPLICATES_MOST];
    double (*first)[REPLICATES_MOST];
    bl_alias_row *rows; // of the result
} measurement;

bl_alias_settings bl_alias_default_settings(void) {
    return (bl_alias_settings){.pixel = BL_PIXEL_BOX,
                               .oversample = 4,
                               .replicates = 8,
                               .frames = 8,
                               .rounds = 31,
                               .turn_seconds = 3e-4,
                               .most_samples = 512,
                               .level = 0.95,
                               .seed = 1};
}

bl_alias_settings bl_alias_settings_of_size(bl_size size) {
    bl_alias_settings settings = bl_alias_default_settings();
    if (size == BL_QUICK) {
        settings.replicates = 4;
        settings.frames = 4;
        settings.rounds = 15;
        settings.turn_seconds = 2e-4;
        settings.most_samples = 64;
    } else if (size == BL_FULL) {
        settings.replicates = 16;
        settings.frames = 16;
        settings.rounds = 101;
        settings.turn_seconds = 1e-3;
        settings.most_samples = 1 << 14;
    }
    return settings;
}

static bl_status out_of_memory(bl_message *message) {
    return bl_report(message, BL_DEVICE, "out of memory for the measurement of aliasing");
}

// --- alias and blur -----------------------------------------------------------------------------

// The scene of a replicate: with a signal of another seed, where there is one, and at another
// depth. What is made is to be freed; the scene looks through `view`.
static bl_scene reseeded(const bl_scene *scene, uint64_t replicate, bl_view *view,
                         bl_signal **made) {
    bl_scene fresh = *scene;
    uint64_t seed = bl_stream(scene->seed, replicate);
    *made = replicate ? bl_signal_reseed(scene->signal, seed) : NULL;
    *view = *scene->view;
    if (replicate)
        bl_depth_draw(scene->signal, seed, view);
    fresh.seed = seed;
    fresh.view = view;
    if (*made)
        fresh.signal = *made;
    return fresh;
}

// The grids of a replicate: where its pixels are, and how far each grid is moved.
typedef struct grids {
    double shift[2], jitter[GRIDS][2], level;
} grids;

static grids draw_grids(const measurement *m, size_t replicate) {
    bl_random random = bl_random_seed(m->settings->seed, replicate);
    grids at = {.shift = {bl_random_unit(&random), bl_random_unit(&random)},
                .level = bl_colour_component(m->scene.mean, 0)};
    for (int g = 0; g < GRIDS; g++)
        for (int axis = 0; axis < 2; axis++)
            at.jitter[g][axis] = bl_random_unit(&random);
    return at;
}

static void free_spectra(bl_image_spectrum spectra[GRIDS]) {
    for (int g = 0; g < GRIDS; g++)
        bl_image_spectrum_free(&spectra[g]);
}

// On success the caller frees the spectra.
static bl_status take_spectra(const measurement *m, const grids *at, bl_image_values values,
                              const void *user, bl_image_spectrum spectra[GRIDS],
                              bl_message *message) {
    bl_status status = BL_OK;
    for (int g = 0; g < GRIDS; g++)
        spectra[g] = (bl_image_spectrum){0};
    for (int g = 0; g < GRIDS && status == BL_OK; g++)
        status = bl_image_spectrum_take(values, user, m->view->width, m->view->height,
                                        m->settings->oversample, at->shift, at->jitter[g],
                                        at->level, m->settings->threads, &spectra[g], message);
    if (status != BL_OK)
        free_spectra(spectra);
    return status;
}

static bl_status add_energies(measurement *m, size_t method, size_t replicate, const grids *at,
                              const bl_image_spectrum truth[GRIDS], bl_message *message) {
    bl_signal *made;
    bl_view view;
    bl_image_spectrum sampled[GRIDS];
    bl_scene scene = reseeded(&m->scenes[method], replicate, &view, &made);
    bl_scene_method image = m->images[method];
    image.scene = &scene;
    bl_status status = take_spectra(m, at, bl_scene_luminances, &image, sampled, message);
    if (status == BL_OK) {
        bl_energies energies = bl_image_energies(
            sampled, truth, GRIDS, replicate == 0 ? BL_ALIAS_RINGS : 0, m->rows[method].rings);
        m->alias[method][replicate] = energies.alias;
        m->blur[method][replicate] = energies.blur;
        m->first[method][replicate] = energies.first_alias;
        free_spectra(sampled);
    }
    bl_signal_free(made);
    return status;
}

static bl_status run_replicate(measurement *m, size_t replicate, bl_message *message) {
    const grids at = draw_grids(m, replicate);
    bl_signal *made;
    bl_view view;
    bl_image_spectrum truth[GRIDS];
    bl_scene scene = reseeded(&m->scene, replicate, &view, &made);
    bl_status status = take_spectra(m, &at, bl_scene_raw_luminances, &scene, truth, message);
    if (status == BL_OK) {
        for (size_t i = 0; i < m->count && status == BL_OK; i++)
            status = add_energies(m, i, replicate, &at, truth, message);
        free_spectra(truth);
    }
    bl_signal_free(made);
    return status;
}

// Energies are not negative, though the estimate of a small one may be.
static bl_estimate energy_estimate(const double *values, size_t count, double level) {
    bl_estimate estimate = bl_mean_estimate(values, count, level);
    estimate.value = fmax(0, estimate.value);
    estimate.lower = fmax(0, estimate.lower);
    estimate.upper = fmax(0, estimate.upper);
    return estimate;
}

// A prediction is of all depths; one that was asked for is another thing.
static int is_asked(const measurement *m) {
    for (unsigned a = 2; a < m->signal->dimensions; a++)
        if (m->view->asked[a] && bl_depth_is_flat(m->signal, m->view, a))
            return 1;
    return 0;
}

static bl_status measure_energies(measurement *m, bl_alias_row *rows, bl_message *message) {
    const size_t replicates = m->settings->replicates;
    bl_status status = BL_OK;
    for (size_t r = 0; r < replicates && status == BL_OK; r++)
        status = run_replicate(m, r, message);
    for (size_t i = 0; i < m->count && status == BL_OK; i++) {
        int known;
        bl_prediction prediction;
        rows[i].alias = energy_estimate(m->alias[i], replicates, m->settings->level);
        rows[i].blur = energy_estimate(m->blur[i], replicates, m->settings->level);
        rows[i].first_alias = m->first[i][0];
        status = bl_predict_energies(m->signal, m->view, &m->methods[i],
                                     2 * m->settings->oversample, &prediction, &known, message);
        rows[i].predicted_alias = is_asked(m) ? NAN : prediction.alias;
        rows[i].predicted_blur = is_asked(m) ? NAN : prediction.blur;
    }
    return status;
}

// --- the image ----------------------------------------------------------------------------------

static void take_luminance(const double *rgb, size_t pixels, double *out) {
    for (size_t p = 0; p < pixels; p++)
        out[p] = bl_colour_component(&rgb[3 * p], 0);
}

// The squared errors of the images against a reference whose own error is known.
static void compare(const measurement *m, const bl_reference *reference, bl_alias_row *rows,
                    double *room) {
    const size_t pixels = reference->width * reference->height;
    const double noise = reference->rms_error, bound = 2 * noise;
    double *truth = room, *image = room + pixels;
    take_luminance(reference->rgb, pixels, truth);
    for (size_t i = 0; i < m->count; i++) {
        take_luminance(rows[i].image, pixels, image);
        bl_image_error error = bl_image_compare(image, truth, pixels);
        double rms = sqrt(fmax(0, error.mse - noise * noise));
        double least = fmax(0, sqrt(error.mse) - bound);
        rows[i].mse = (bl_estimate){rms * rms, least * least,
                                    (sqrt(error.mse) + bound) * (sqrt(error.mse) + bound),
                                    m->settings->level, (double)pixels};
        rows[i].psnr_db = bl_psnr_db(rms * rms);
        rows[i].max_error = error.largest;
        rows[i].ssim =
            bl_ssim(image, truth, reference->width, reference->height, m->settings->level);
    }
}

// A tenth of the smallest error that is measured, but nothing finer than a PNG of 16 bits shows.
static double tolerance_of(const measurement *m, const bl_alias_row *rows) {
    double least = INFINITY;
    for (size_t i = 0; i < m->count; i++)
        least = fmin(least, sqrt(rows[i].mse.value));
    return fmax(0.5 * 0.1 * least, 0x1p-17);
}

static bl_status measure_images(measurement *m, bl_alias_result *result, bl_message *message) {
    const size_t pixels = m->view->width * m->view->height;
    bl_reference_settings settings = {.pixel = m->settings->pixel,
                                      .most_samples = PILOT_SAMPLES,
                                      .threads = m->settings->threads,
                                      .cache = m->settings->cache};
    double *room = malloc(2 * pixels * sizeof *room);
    bl_status status = room ? BL_OK : out_of_memory(message);
    for (size_t i = 0; i < m->count && status == BL_OK; i++) {
        result->rows[i].image = malloc(3 * pixels * sizeof(double));
        if (result->rows[i].image)
            bl_scene_image(&m->images[i], m->settings->threads, result->rows[i].image);
        else
            status = out_of_memory(message);
    }
    if (status == BL_OK)
        status = bl_reference_make(&m->scene, &settings, &result->reference, message);
    if (status == BL_OK) {
        compare(m, &result->reference, result->rows, room);
        settings.tolerance = tolerance_of(m, result->rows);
        settings.most_samples = m->settings->most_samples;
    }
    if (status == BL_OK && !result->reference.exact &&
        result->reference.rms_error > settings.tolerance) {
        bl_reference_free(&result->reference);
        status = bl_reference_make(&m->scene, &settings, &result->reference, message);
        if (status == BL_OK)
            compare(m, &result->reference, result->rows, room);
    }
    if (status == BL_OK)
        result->reference_error = 2 * result->reference.rms_error;
    free(room);
    return status;
}

static bl_status measure_flicker(measurement *m, bl_alias_row *rows, bl_message *message) {
    const bl_flicker_settings settings = {.pixel = m->settings->pixel,
                                          .frames = m->settings->frames,
                                          .pixels = 16,
                                          .samples = 32,
                                          .level = m->settings->level,
                                          .threads = m->settings->threads};
    for (size_t i = 0; i < m->count; i++) {
        rows[i].flicker = (bl_estimate){NAN, NAN, NAN, m->settings->level, 0};
        rows[i].pops = NAN;
    }
    if (settings.frames < 2)
        return BL_OK;
    bl_flicker *results = calloc(m->count, sizeof *results);
    if (!results)
        return out_of_memory(message);
    bl_status status =
        bl_flicker_measure(&m->scene, m->images, m->count, &settings, results, message);
    for (size_t i = 0; i < m->count && status == BL_OK; i++) {
        rows[i].flicker = results[i].variance;
        rows[i].pops = results[i].pops;
    }
    free(results);
    return status;
}

// --- time ---------------------------------------------------------------------------------------

// Pixels all over the image, in an order that jumps: no cache helps that a renderer would not have.
static void run_pixels(void *user) {
    const bl_scene_method *image = user;
    const bl_view *view = image->scene->view;
    const size_t pixels = view->width * view->height;
    double x[TIMED], y[TIMED], out[TIMED];
    for (size_t i = 0; i < TIMED; i++) {
        size_t p = (i * UINT64_C(2654435761)) % pixels;
        x[i] = (double)(p % view->width) + 0.5;
        y[i] = (double)(p / view->width) + 0.5;
    }
    bl_scene_luminances(image, x, y, TIMED, out);
    __asm__ volatile("" : : "r"(out) : "memory"); // so that it is computed
}

static bl_status measure_times(const measurement *m, bl_alias_row *rows, bl_message *message) {
    bl_work *works = calloc(m->count, sizeof *works);
    bl_time *times = calloc(m->count, sizeof *times);
    bl_status status = works && times ? BL_OK : out_of_memory(message);
    for (size_t i = 0; i < m->count && status == BL_OK; i++) {
        works[i] = (bl_work){.run = run_pixels, .user = &m->images[i]};
        times[i] = (bl_time){.minimum = NAN, .median = NAN, .maximum = NAN};
    }
    if (status == BL_OK && m->settings->rounds)
        bl_time_by_turns(works, m->count, (int)m->settings->rounds, m->settings->turn_seconds,
                         times);
    for (size_t i = 0; i < m->count && status == BL_OK; i++) {
        rows[i].ns_per_sample = times[i].median / TIMED;
        rows[i].ns_lowest = times[i].minimum / TIMED;
        rows[i].ns_highest = times[i].maximum / TIMED;
    }
    free(times);
    free(works);
    return status;
}

// --- all of it ----------------------------------------------------------------------------------

static bl_status open_methods(measurement *m, const char *const *texts, bl_alias_result *result,
                              bl_message *message) {
    bl_status status =
        bl_scene_make(m->signal, m->view, m->settings->seed, &m->scene, &result->seen, message);
    for (size_t i = 0; i < m->count && status == BL_OK; i++) {
        status = bl_method_open(texts[i], m->signal, &m->methods[i], message);
        if (status != BL_OK)
            break;
        m->scenes[i] = m->scene;
        m->scenes[i].signal = m->methods[i].signal;
        m->images[i] =
            (bl_scene_method){&m->scenes[i], m->methods[i].kind, m->methods[i].parameters};
        result->rows[i].method = strdup(m->methods[i].text);
        result->rows[i].samples = m->methods[i].kind->samples(m->methods[i].parameters);
        if (!result->rows[i].method)
            status = out_of_memory(message);
    }
    memcpy(result->mean, m->scene.mean, sizeof result->mean);
    if (status == BL_OK)
        result->constancy = bl_constancy_find(&m->scene);
    return status;
}

static bl_status allocate(measurement *m, bl_alias_result *result, bl_message *message) {
    result->count = m->count;
    result->rows = m->rows = calloc(m->count, sizeof *result->rows);
    result->ring_width = bl_image_highest(m->settings->oversample) / BL_ALIAS_RINGS;
    m->methods = calloc(m->count, sizeof *m->methods);
    m->scenes = calloc(m->count, sizeof *m->scenes);
    m->images = calloc(m->count, sizeof *m->images);
    m->alias = calloc(m->count, sizeof *m->alias);
    m->blur = calloc(m->count, sizeof *m->blur);
    m->first = calloc(m->count, sizeof *m->first);
    return result->rows && m->methods && m->scenes && m->images && m->alias && m->blur && m->first
               ? BL_OK
               : out_of_memory(message);
}

static void release(measurement *m) {
    for (size_t i = 0; m->methods && i < m->count; i++)
        bl_method_close(&m->methods[i]);
    free(m->methods);
    free(m->scenes);
    free(m->images);
    free(m->alias);
    free(m->blur);
    free(m->first);
}

static bl_status check_settings(const bl_alias_settings *settings, size_t count,
                                bl_message *message) {
    if (count < 1 || settings->replicates < 2 || settings->replicates > REPLICATES_MOST ||
        settings->oversample < 1 || settings->most_samples < 1)
        return bl_report(message, BL_USAGE,
                         "aliasing is measured of 1 method or more, with 2 to %d replicates, and "
                         "with 1 sample or more; there are %zu methods, %u replicates",
                         REPLICATES_MOST, count, settings->replicates);
    return BL_OK;
}

static void note_depth(const bl_signal *signal, const bl_view *view, bl_alias_result *result) {
    bl_sight sight = {0};
    double x = 0.5 * (double)view->width, y = 0.5 * (double)view->height;
    int seen = bl_view_see(view, x, y, &sight);
    for (unsigned a = 0; a < BL_AXES; a++) {
        int flat = bl_depth_is_flat(signal, view, a);
        result->depth[a] = !flat ? NAN : seen ? sight.at[a] : view->depth[a];
        result->random_depth |= flat && !view->asked[a];
    }
}

bl_status bl_alias_measure(const bl_signal *signal, const bl_view *view, const char *const *methods,
                           size_t count, const bl_alias_settings *settings, bl_alias_result *result,
                           bl_message *message) {
    bl_view own = *view;
    measurement m = {.signal = signal, .view = &own, .settings = settings, .count = count};
    *result = (bl_alias_result){0};
    bl_depth_draw(signal, settings->seed, &own);
    note_depth(signal, &own, result);
    bl_status status = check_settings(settings, count, message);
    if (status != BL_OK)
        return status;
    status = allocate(&m, result, message);
    if (status == BL_OK)
        status = open_methods(&m, methods, result, message);
    if (status == BL_OK)
        status = measure_images(&m, result, message);
    if (status == BL_OK)
        status = measure_energies(&m, result->rows, message);
    if (status == BL_OK)
        status = measure_flicker(&m, result->rows, message);
    if (status == BL_OK)
        status = measure_times(&m, result->rows, message);
    release(&m);
    if (status != BL_OK)
        bl_alias_free(result);
    return status;
}

void bl_alias_free(bl_alias_result *result) {
    for (size_t i = 0; result->rows && i < result->count; i++) {
        free(result->rows[i].method);
        free(result->rows[i].image);
    }
    free(result->rows);
    bl_reference_free(&result->reference);
    *result = (bl_alias_result){0};
}

int bl_alias_is_constant(const bl_alias_result *result) {
    return result->constancy.constant;
}

int bl_alias_is_converged(const bl_alias_result *result) {
    double least = INFINITY;
    for (size_t i = 0; i < result->count; i++)
        least = fmin(least, result->rows[i].mse.value);
    return result->reference_error <= 0.1 * sqrt(least) + 0x1p-16;
}
