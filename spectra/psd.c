// SPDX-License-Identifier: MIT
//
// The measurement of a power spectral density, from the settings to the filled struct.
//
//   P = (prod dx) |FFT(w (x - mean))|^2 / sum(w^2),  averaged over places (Welch 1967)
//
// Two passes over the samples: the first for the grand mean and the variance, the second for the
// transforms. Averages run side by side, each in one thread with single-threaded plans, and what
// they share is summed in the order of the averages; one slice alone is spread over the threads in
// pieces that do not depend on their number.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <omp.h>

#include "core/grid.h"
#include "core/memory.h"
#include "spectra/psd_parts.h"
#include "spectra/theory.h"

// Samples stay in memory between the passes where they take no more bytes than this.
static const double KEEP_BYTES = 0x1p28;

// Fewer samples than this are done before a second thread wakes up.
static const double LEAST_SHARED = 0x1p14;

typedef struct measurement {
    bl_sampler sampler;
    bl_transform transform;
    bl_bins bins;
    size_t samples, pitch, floats; // of an average: samples, floats between rows, floats in all
    size_t averages, slots;        // slots: averages held in `held`
    int workers, threads_each;     // averages side by side, and threads inside of each
    float *held;                   // [slots][floats]: all averages, or one a worker
    double *lines;                 // [workers][size + 2] for lines, else NULL
    bl_bin_sum *sums;              // [workers][2 * (count + 1)]
    bl_moments *moments;           // [averages] of the samples
    bl_status *statuses;           // [averages]
    double *half;                  // sum of the half spectra, NULL for a line
    double residual;
} measurement;

static void close_measurement(measurement *m) {
    free(m->held);
    free(m->lines);
    free(m->sums);
    free(m->moments);
    free(m->statuses);
    free(m->half);
    bl_transform_close(&m->transform);
    bl_bins_close(&m->bins);
}

// --- memory ---

static double half_cells(const bl_psd_settings *settings) {
    double size = (double)settings->size;
    return (floor(size / 2) + 1) * pow(size, (double)settings->dims - 1);
}

// How many averages run side by side: as many as there are threads, unless they are too few to
// occupy them and a slice can be spread, or do not fit the memory. All in doubles, so that sizes
// that no machine has are refused and not wrapped.
static bl_status plan_memory(measurement *m, bl_message *message) {
    const bl_psd_settings *settings = &m->sampler.settings;
    int threads = bl_thread_count(settings->threads);
    double size = (double)settings->size, averages = (double)settings->averages;
    double rows = pow(size, (double)settings->dims - 1);
    double average = 4 * rows * (settings->dims == 1 ? size : size + 48);
    double each = 24 * size + (settings->dims == 2 ? 128 * size : 16 * size);
    double shared = 8 * (size / 2 + 2) * (averages + 20) + 96 * averages;
    shared += settings->dims == 1 ? 0 : 2 * 8 * half_cells(settings);
    int keep = average * averages <= KEEP_BYTES;
    shared += keep ? average * averages : 0;
    each += keep ? 0 : average;
    bl_status status = bl_memory_check(shared + each, "this spectrum", message);
    if (status != BL_OK)
        return status;
    if (averages * rows * size < LEAST_SHARED)
        threads = 1;
    m->workers = averages < threads ? (int)averages : threads;
    if (settings->dims == 2 && m->workers < threads)
        m->workers = 1;
    double room = 0.8 * (double)bl_memory_available() - shared;
    while (m->workers > 1 && each * m->workers > room)
        m->workers--;
    m->threads_each = m->workers == 1 ? threads : 1;
    m->slots = keep ? settings->averages : (size_t)m->workers;
    return BL_OK;
}

static bl_status open_measurement(measurement *m, bl_message *message) {
    const bl_psd_settings *settings = &m->sampler.settings;
    unsigned dims = settings->dims;
    bl_status status = plan_memory(m, message);
    if (status == BL_OK)
        status = bl_transform_open(dims, settings->size, settings->window, &m->transform, message);
    if (status == BL_OK)
        status = bl_bins_open(dims, settings->size, settings->window, m->workers * m->threads_each,
                              &m->bins, message);
    if (status != BL_OK)
        return status;
    m->averages = settings->averages;
    m->samples = bl_sampler_samples(&m->sampler);
    m->pitch = dims == 1 ? settings->size : m->transform.pitch;
    m->floats = (m->samples / settings->size * m->pitch + 15) / 16 * 16; // whole cache lines
    size_t workers = (size_t)m->workers, sums = 2 * (m->bins.count + 1);
    m->held = bl_fft_buffer(m->slots * m->floats * sizeof(float));
    if (dims == 1)
        m->lines = bl_fft_buffer(workers * m->transform.line_pitch * sizeof(double));
    else
        m->half = calloc(m->samples / settings->size * m->bins.count, sizeof(double));
    m->sums = calloc(workers * sums, sizeof *m->sums);
    m->moments = calloc(m->averages, sizeof *m->moments);
    m->statuses = calloc(m->averages, sizeof *m->statuses);
    if (!m->held || !(dims == 1 ? m->lines : m->half) || !m->sums || !m->moments || !m->statuses)
        return bl_report(message, BL_DEVICE, "out of memory for a spectrum of %zu samples",
                         m->samples);
    return BL_OK;
}

// --- first pass ---

static float *slot_of(const measurement *m, size_t average) {
    size_t slot = m->slots == m->averages ? average : (size_t)omp_get_thread_num();
    return m->held + slot * m->floats;
}

// Mean and second moment around `shift`, a value near the mean, so that a constant gives exactly 0.
static bl_moments average_moments(const measurement *m, const float *samples, double shift) {
    size_t size = m->sampler.settings.size;
    double sum = 0, square = 0, n = (double)m->samples;
    for (size_t row = 0; row < m->samples / size; row++) {
        double row_sum = 0, row_square = 0;
        for (size_t i = 0; i < size; i++) {
            double x = (double)samples[row * m->pitch + i] - shift;
            row_sum += x;
            row_square += x * x;
        }
        sum += row_sum;
        square += row_square;
    }
    double m2 = square - sum * sum / n;
    return (bl_moments){.n = n, .mean = shift + sum / n, .m2 = m2 > 0 ? m2 : 0};
}

static bl_status first_pass(measurement *m, bl_message *message) {
    const bl_sampler *sampler = &m->sampler;
#pragma omp parallel for schedule(dynamic, 1) num_threads(m->workers) if (m->workers > 1)
    for (size_t k = 0; k < m->averages; k++) {
        float *samples = slot_of(m, k);
        bl_sampler_fill(sampler, k, samples, m->pitch, m->threads_each);
        m->statuses[k] = bl_sampler_check(sampler, k, samples, m->pitch, NULL);
        m->moments[k] = average_moments(m, samples, (double)samples[0]);
    }
    for (size_t k = 0; k < m->averages; k++)
        if (m->statuses[k] != BL_OK) {
            bl_sampler_fill(sampler, k, m->held, m->pitch, 1); // again, for the message
            return bl_sampler_check(sampler, k, m->held, m->pitch, message);
        }
    return BL_OK;
}

// --- second pass ---

// One average: its powers go to its profile, its half spectrum stays in the samples.
static bl_status transform_average(measurement *m, size_t k, float *samples, bl_psd *psd,
                                   double *windowed, double *residual, bl_message *message) {
    size_t worker = m->workers > 1 ? (size_t)omp_get_thread_num() : 0, bins = m->bins.count + 1;
    bl_transformed result = {.sums = m->sums + worker * 2 * bins};
    void *buffer = samples;
    if (m->lines) {
        double *line = m->lines + worker * m->transform.line_pitch;
        for (size_t i = 0; i < m->samples; i++)
            line[i] = (double)samples[i];
        buffer = line;
    }
    bl_status status = bl_transform_run(&m->transform, buffer, psd->mean, m->threads_each,
                                        m->half != NULL, &result, message);
    double total = 0, *profile = psd->profiles + k * bins;
    for (size_t bin = 0; status == BL_OK && bin < bins; bin++)
        total += profile[bin] = result.sums[bin].sum;
    *windowed = result.windowed;
    // A signal without variance keeps Parseval's equation as 0 = 0.
    *residual = total == result.windowed ? 0 : fabs(total / result.windowed - 1);
    return status;
}

static bl_status second_pass(measurement *m, bl_psd *psd, bl_message *message) {
    double worst = 0, windowed_sum = 0;
    int again = m->slots != m->averages;
#pragma omp parallel for ordered schedule(static, 1) num_threads(m->workers) if (m->workers > 1)
    for (size_t k = 0; k < m->averages; k++) {
        float *samples = slot_of(m, k);
        double residual, windowed;
        if (again)
            bl_sampler_fill(&m->sampler, k, samples, m->pitch, m->threads_each);
        m->statuses[k] = transform_average(m, k, samples, psd, &windowed, &residual, NULL);
#pragma omp ordered
        {
            if (m->half)
                bl_transform_add(&m->transform, samples, m->half);
            windowed_sum += windowed;
            if (!(residual <= worst)) // NaN stays
                worst = residual;
        }
    }
    for (size_t k = 0; k < m->averages; k++)
        if (m->statuses[k] != BL_OK)
            return bl_report(message, m->statuses[k],
                             "out of memory transforming an average of "
                             "%zu samples",
                             m->samples);
    psd->windowed_variance = windowed_sum / (double)m->averages;
    psd->parseval_residual = worst;
    return bl_psd_check_parseval(psd, message);
}

// --- results ---

// Around the grand mean.
static double average_variance(const bl_moments *moments, double mean) {
    double off = moments->mean - mean;
    return moments->m2 / moments->n + off * off;
}

// The mean and the variance of all samples.
static void fill_variance(const measurement *m, bl_psd *psd) {
    double shift = m->moments[0].mean, sum = 0;
    for (size_t k = 0; k < m->averages; k++)
        sum += m->moments[k].mean - shift;
    psd->mean = shift + sum / (double)m->averages;
    sum = 0;
    for (size_t k = 0; k < m->averages; k++)
        sum += average_variance(&m->moments[k], psd->mean);
    psd->variance.value = sum / (double)m->averages;
    int known = m->sampler.settings.place == BL_PLACE_RANDOM && !m->sampler.on_grid;
    psd->variance_theory = known ? m->sampler.signal->facts.variance : NAN;
}

static bl_status fill_limits(const measurement *m, bl_psd *psd, bl_message *message) {
    bl_status status =
        bl_psd_fill_limits(psd, &m->bins, m->sampler.overlap, m->sampler.on_grid, message);
    if (status != BL_OK)
        return status;
    double *values = malloc(m->averages * sizeof *values);
    if (!values)
        return bl_report(message, BL_DEVICE, "out of memory for %zu averages", m->averages);
    for (size_t k = 0; k < m->averages; k++)
        values[k] = average_variance(&m->moments[k], psd->mean);
    bl_psd_fill_variance_limits(psd, &m->bins, values);
    free(values);
    return BL_OK;
}

static bl_status fill_theory(const measurement *m, bl_psd *psd, bl_message *message) {
    const bl_sampler *sampler = &m->sampler;
    const bl_psd_settings *settings = &sampler->settings;
    if (settings->place != BL_PLACE_RANDOM || sampler->on_grid ||
        !bl_signal_has_closed_form(sampler->signal))
        return BL_OK;
    size_t cells = m->samples / settings->size * m->bins.count;
    double *half = malloc(cells * sizeof *half);
    bl_bin_sum *sums = calloc(m->bins.count + 1, sizeof *sums);
    psd->theory = malloc(m->bins.count * sizeof *psd->theory);
    psd->theory_corners = malloc(sizeof *psd->theory_corners);
    bl_status status = BL_OK;
    if (!half || !sums || !psd->theory || !psd->theory_corners)
        status = bl_report(message, BL_DEVICE, "out of memory for the closed form");
    if (status == BL_OK)
        status =
            bl_theory_periodogram(sampler->signal, settings->dims, sampler->directions,
                                  settings->rate, settings->size, settings->window, half, message);
    if (status == BL_OK) {
        double cell = pow(psd->width[0], (double)settings->dims); // df^dims
        bl_bins_reduce(&m->bins, half, sums);
        for (size_t bin = 0; bin < m->bins.count; bin++)
            psd->theory[bin] = sums[bin].sum * cell / psd->measure[bin];
        *psd->theory_corners = sums[m->bins.count].sum * cell;
    }
    free(half);
    free(sums);
    return status;
}

// The plane, and the anisotropy of the rings of the averaged half spectrum.
static bl_status fill_half(measurement *m, bl_psd *psd, bl_message *message) {
    if (!m->half)
        return BL_OK;
    bl_bin_sum *sums = calloc(m->bins.count + 1, sizeof *sums);
    if (!sums)
        return bl_report(message, BL_DEVICE, "out of memory for %zu rings", m->bins.count);
    size_t cells = m->samples / psd->settings.size * m->bins.count;
    double factor = 1 / ((double)m->averages * pow(psd->width[0], (double)psd->settings.dims));
    for (size_t i = 0; i < cells; i++)
        m->half[i] *= factor;
    bl_bins_reduce(&m->bins, m->half, sums);
    bl_psd_fill_anisotropy(psd, &m->bins, sums);
    free(sums);
    if (psd->settings.dims == 2) {
        psd->plane = m->half;
        m->half = NULL;
    }
    return BL_OK;
}

bl_status bl_psd_measure(const bl_signal *signal, const bl_psd_settings *settings, bl_psd *psd,
                         bl_message *message) {
    measurement m = {0};
    *psd = (bl_psd){0};
    bl_status status = bl_sampler_open(signal, settings, &m.sampler, message);
    if (status == BL_OK)
        status = open_measurement(&m, message);
    psd->settings = m.sampler.settings;
    if (status == BL_OK)
        status = bl_psd_allocate(psd, &m.bins, message);
    if (status == BL_OK)
        status = first_pass(&m, message);
    if (status == BL_OK) {
        fill_variance(&m, psd);
        status = second_pass(&m, psd, message);
    }
    if (status == BL_OK)
        status = fill_limits(&m, psd, message);
    if (status == BL_OK)
        status = fill_half(&m, psd, message);
    if (status == BL_OK)
        status = fill_theory(&m, psd, message);
    if (status != BL_OK)
        bl_psd_free(psd);
    close_measurement(&m);
    return status;
}
