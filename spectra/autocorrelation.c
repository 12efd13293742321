// SPDX-License-Identifier: MIT
//
// c[m] = 1/(n - m) sum_i (x[i] - mean) (x[i + m] - mean), over all pairs of a line of n samples.
//
// A transform of length 2n of the line followed by n zeros has as its squared magnitude the
// transform of the sum above without wrap-around (Wiener 1930, Khinchin 1934).
#include "core/grid.h"
#include "spectra/autocorrelation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <omp.h>

#include "core/memory.h"
#include "spectra/psd_parts.h"

typedef struct correlation {
    bl_sampler sampler;
    size_t size, averages, count;
    const bl_fft *forward, *back;
    float *samples;      // [averages][size]
    double *products;    // [count][averages]
    double *work;        // [workers][pitch]
    bl_status *statuses; // [averages]
    size_t pitch;
    int workers;
} correlation;

static void close_correlation(correlation *c) {
    free(c->samples);
    free(c->products);
    free(c->work);
    free(c->statuses);
}

static bl_status open_correlation(correlation *c, double reach, bl_message *message) {
    c->size = c->sampler.settings.size;
    c->averages = c->sampler.settings.averages;
    double lags = floor(reach / c->sampler.spacing * (1 + 1e-12)) + 1, most = (double)(c->size / 2);
    c->count = (size_t)(reach == 0 || lags > most + 1 ? most + 1 : lags);
    c->pitch = (2 * (c->size + 1) + 7) / 8 * 8; // doubles: whole cache lines
    int threads = bl_thread_count(c->sampler.settings.threads);
    c->workers = c->averages < (size_t)threads ? (int)c->averages : threads;
    double averages = (double)c->averages, size = (double)c->size;
    bl_status status = bl_memory_check(averages * (4 * size + 8 * (double)c->count + 4) +
                                           40 * size * (double)c->workers,
                                       "this autocorrelation", message);
    if (status != BL_OK)
        return status;
    bl_fft_shape shape = {BL_FFT_REAL, BL_FFT_DOUBLE, 1, {2 * c->size}, 0, 0};
    status = bl_fft_plan(&shape, &c->forward, message);
    shape.kind = BL_FFT_BACK;
    if (status == BL_OK)
        status = bl_fft_plan(&shape, &c->back, message);
    if (status != BL_OK)
        return status;
    c->samples = malloc(c->averages * c->size * sizeof *c->samples);
    c->products = malloc(c->averages * c->count * sizeof *c->products);
    c->work = bl_fft_buffer((size_t)c->workers * c->pitch * sizeof *c->work);
    c->statuses = calloc(c->averages, sizeof *c->statuses);
    if (!c->samples || !c->products || !c->work || !c->statuses)
        return bl_report(message, BL_DEVICE, "out of memory for %zu averages", c->averages);
    return BL_OK;
}

static bl_status sample_lines(correlation *c, double *mean, bl_message *message) {
#pragma omp parallel for schedule(dynamic, 1) num_threads(c->workers) if (c->workers > 1)
    for (size_t k = 0; k < c->averages; k++) {
        float *line = c->samples + k * c->size;
        bl_sampler_fill(&c->sampler, k, line, c->size, 1);
        c->statuses[k] = bl_sampler_check(&c->sampler, k, line, c->size, NULL);
    }
    double shift = (double)c->samples[0], sum = 0;
    for (size_t k = 0; k < c->averages; k++) {
        const float *line = c->samples + k * c->size;
        if (c->statuses[k] != BL_OK)
            return bl_sampler_check(&c->sampler, k, line, c->size, message);
        double line_sum = 0;
        for (size_t i = 0; i < c->size; i++)
            line_sum += (double)line[i] - shift; // so that a constant gives exactly 0
        sum += line_sum / (double)c->size;
    }
    *mean = shift + sum / (double)c->averages;
    return BL_OK;
}

static void correlate_line(const correlation *c, size_t k, double mean, double *work) {
    const float *line = c->samples + k * c->size;
    memset(work, 0, c->pitch * sizeof *work);
    for (size_t i = 0; i < c->size; i++)
        work[i] = (double)line[i] - mean;
    bl_fft_run(c->forward, work);
    for (size_t i = 0; i <= c->size; i++) {
        work[2 * i] = work[2 * i] * work[2 * i] + work[2 * i + 1] * work[2 * i + 1];
        work[2 * i + 1] = 0;
    }
    bl_fft_run(c->back, work);
    for (size_t m = 0; m < c->count; m++)
        c->products[m * c->averages + k] = work[m] / (2 * (double)c->size) / (double)(c->size - m);
}

static bl_status fill_result(const correlation *c, bl_autocorrelation *a, bl_message *message) {
    const bl_signal *signal = c->sampler.signal;
    int closed = bl_signal_has_closed_form(signal) && !c->sampler.on_grid &&
                 c->sampler.settings.place == BL_PLACE_RANDOM;
    a->settings = c->sampler.settings;
    a->count = c->count;
    a->lag = calloc(c->count, sizeof *a->lag);
    a->covariance = calloc(c->count, sizeof *a->covariance);
    a->theory = closed ? calloc(c->count, sizeof *a->theory) : NULL;
    if (!a->lag || !a->covariance || (closed && !a->theory))
        return bl_report(message, BL_DEVICE, "out of memory for %zu lags", c->count);
    double widen = sqrt(c->sampler.overlap);
    for (size_t m = 0; m < c->count; m++) {
        a->lag[m] = (double)m * c->sampler.spacing;
        bl_estimate e =
            bl_mean_estimate(c->products + m * c->averages, c->averages, a->settings.level);
        e.lower = e.value - widen * (e.value - e.lower);
        e.upper = e.value + widen * (e.upper - e.value);
        a->covariance[m] = e;
        if (closed) {
            double lag[BL_AXES];
            for (int axis = 0; axis < BL_AXES; axis++)
                lag[axis] = a->lag[m] * c->sampler.directions[0][axis];
            a->theory[m] = signal->functions->covariance(signal->parameters, lag);
        }
    }
    return BL_OK;
}

bl_status bl_autocorrelation_measure(const bl_signal *signal, const bl_psd_settings *settings,
                                     double reach, bl_autocorrelation *autocorrelation,
                                     bl_message *message) {
    correlation c = {0};
    bl_psd_settings line = *settings;
    line.dims = 1;
    // Overlapped segments weigh all samples alike here.
    line.window = BL_WINDOW_RECTANGLE;
    *autocorrelation = (bl_autocorrelation){0};
    if (!(reach >= 0))
        return bl_report(message, BL_USAGE, "the largest lag is %g units; give 0 or more", reach);
    bl_status status = bl_sampler_open(signal, &line, &c.sampler, message);
    if (status == BL_OK)
        status = open_correlation(&c, reach, message);
    if (status == BL_OK)
        status = sample_lines(&c, &autocorrelation->mean, message);
    if (status == BL_OK) {
#pragma omp parallel for schedule(static) num_threads(c.workers) if (c.workers > 1)
        for (size_t k = 0; k < c.averages; k++)
            correlate_line(&c, k, autocorrelation->mean,
                           c.work + (size_t)omp_get_thread_num() * c.pitch);
        status = fill_result(&c, autocorrelation, message);
    }
    if (status != BL_OK)
        bl_autocorrelation_free(autocorrelation);
    close_correlation(&c);
    return status;
}

void bl_autocorrelation_free(bl_autocorrelation *autocorrelation) {
    free(autocorrelation->lag);
    free(autocorrelation->covariance);
    free(autocorrelation->theory);
    *autocorrelation = (bl_autocorrelation){0};
}
