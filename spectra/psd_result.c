// SPDX-License-Identifier: MIT
//
// The result of a measurement: its arrays, what follows from the bins alone, the anisotropy, and
// the check by Parseval's equation. Also the measurement of one slice that the caller has sampled.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/grid.h"
#include "core/statistics.h"
#include "spectra/psd_parts.h"

bl_status bl_psd_allocate(bl_psd *psd, const bl_bins *bins, bl_message *message) {
    size_t count = bins->count;
    psd->count = count;
    double **arrays[] = {&psd->frequency, &psd->width, &psd->measure, &psd->psd,
                         &psd->lower,     &psd->upper, &psd->dof};
    int good = 1;
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
        *arrays[i] = calloc(count, sizeof(double));
        good = good && *arrays[i];
    }
    psd->profiles = calloc(psd->settings.averages * (count + 1), sizeof(double));
    good = good && psd->profiles;
    if (good && bins->dims > 1) {
        psd->anisotropy_db = calloc(count, sizeof(double));
        psd->anisotropy_floor_db = calloc(count, sizeof(double));
        good = psd->anisotropy_db && psd->anisotropy_floor_db;
    }
    if (!good)
        return bl_report(message, BL_DEVICE, "out of memory for %zu bins of %zu averages", count,
                         psd->settings.averages);
    double step = psd->settings.rate / (double)psd->settings.size;
    for (size_t bin = 0; bin < count; bin++) {
        psd->frequency[bin] = step * bins->radius[bin];
        psd->width[bin] = step;
        // The bin of a line is one-sided: a pair of cells stands for one step of frequency.
        psd->measure[bin] = bins->dims == 1 ? step : bins->cells[bin] * pow(step, bins->dims);
    }
    return BL_OK;
}

void bl_psd_free(bl_psd *psd) {
    double *arrays[] = {psd->frequency,     psd->width, psd->measure, psd->psd,
                        psd->lower,         psd->upper, psd->dof,     psd->profiles,
                        psd->anisotropy_db, psd->plane, psd->theory,  psd->anisotropy_floor_db,
                        psd->theory_corners};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        free(arrays[i]);
    *psd = (bl_psd){0};
}

// Rounding of the transform is near 1e-16 (1e-7) times log2 of the samples; of the sums, less.
bl_status bl_psd_check_parseval(const bl_psd *psd, bl_message *message) {
    double limit = psd->settings.dims == 1 ? 1e-12 : 1e-5;
    if (psd->parseval_residual <= limit)
        return BL_OK;
    return bl_report(message, BL_FAIL,
                     "the powers of the bins miss the variance by %.3g of it (Parseval), above "
                     "%.0e: values beyond the range of the arithmetic; scale the signal towards 1",
                     psd->parseval_residual, limit);
}

// Ulichney 1987: the variance of the ring's cells, pairs once, over the square of their mean.
void bl_psd_fill_anisotropy(bl_psd *psd, const bl_bins *bins, const bl_bin_sum *sums) {
    for (size_t bin = 0; bin < bins->count; bin++) {
        // A ring of n cells has n/2 independent ones, except for the few that are their own pairs.
        double cells = bins->cells[bin], independent = ceil(cells / 2);
        double mean = sums[bin].sum / cells, square = sums[bin].square / cells;
        double spread = (square - mean * mean) * independent / (independent - 1);
        psd->anisotropy_floor_db[bin] = -10 * log10((double)psd->settings.averages);
        psd->anisotropy_db[bin] = NAN;
        if (independent > 1 && mean > 0)
            psd->anisotropy_db[bin] = 10 * log10((spread > 0 ? spread : 0) / (mean * mean));
    }
}

// --- a slice that the caller has sampled ---

static double buffer_mean(const float *samples, size_t size, size_t pitch, double *rows,
                          int threads, double *square) {
    const bl_loops *loops = bl_psd_loops();
    double *row_squares = rows + size, sum = 0;
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
    for (size_t y = 0; y < size; y++)
        loops->sum_row(samples + y * pitch, size, &rows[y], &row_squares[y]);
    *square = 0;
    for (size_t y = 0; y < size; y++) {
        sum += rows[y];
        *square += row_squares[y];
    }
    double samples_in_all = (double)size * (double)size;
    *square /= samples_in_all;
    return sum / samples_in_all;
}

static bl_status check_buffer(float *samples, const bl_psd_settings *settings,
                              bl_message *message) {
    if ((uintptr_t)samples % BL_FFT_ALIGNMENT != 0)
        return bl_report(message, BL_USAGE, "the samples must start at a multiple of %d bytes",
                         BL_FFT_ALIGNMENT);
    if (settings->size < 8 || !(settings->rate > 0) || isinf(settings->rate) ||
        !(settings->level > 0 && settings->level < 1) || settings->threads < 0 ||
        (unsigned)settings->window >= BL_WINDOW_COUNT)
        return bl_report(message, BL_USAGE,
                         "a slice of %zu samples at a rate of %g and a level of %g cannot be "
                         "measured; give 8 or more, a positive rate, and a level as 0.95",
                         settings->size, settings->rate, settings->level);
    return BL_OK;
}

static bl_status measure_buffer(float *samples, const bl_transform *transform, const bl_bins *bins,
                                bl_psd *psd, bl_message *message) {
    size_t size = transform->size, count = bins->count;
    int threads = bl_thread_count(psd->settings.threads);
    double *rows = malloc(2 * size * sizeof *rows), square;
    bl_transformed result = {.sums = calloc(2 * (count + 1), sizeof *result.sums)};
    bl_status status = BL_OK;
    if (!rows || !result.sums)
        status = bl_report(message, BL_DEVICE, "out of memory for %zu rings", count);
    if (status == BL_OK) {
        psd->mean = buffer_mean(samples, size, transform->pitch, rows, threads, &square);
        psd->variance.value = fmax(0, square - psd->mean * psd->mean);
        psd->variance_theory = NAN;
        if (!isfinite(square))
            status = bl_report(message, BL_MISMATCH, "the slice holds values that are not finite");
    }
    if (status == BL_OK)
        status = bl_transform_run(transform, samples, psd->mean, threads, 0, &result, message);
    if (status == BL_OK) {
        double total = 0;
        for (size_t bin = 0; bin <= count; bin++)
            total += psd->profiles[bin] = result.sums[bin].sum;
        psd->windowed_variance = result.windowed;
        psd->parseval_residual = total == result.windowed ? 0 : fabs(total / result.windowed - 1);
        status = bl_psd_check_parseval(psd, message);
        bl_psd_fill_anisotropy(psd, bins, result.sums);
    }
    free(rows);
    free(result.sums);
    return status;
}

bl_status bl_psd_of_buffer(float *samples, const bl_psd_settings *settings, bl_psd *psd,
                           bl_message *message) {
    bl_transform transform = {0};
    bl_bins bins = {0};
    *psd = (bl_psd){.settings = *settings};
    psd->settings.dims = 2;
    psd->settings.averages = 1;
    bl_status status = check_buffer(samples, settings, message);
    if (status == BL_OK)
        status = bl_transform_open(2, settings->size, settings->window, &transform, message);
    if (status == BL_OK)
        status = bl_bins_open(2, settings->size, settings->window,
                              bl_thread_count(settings->threads), &bins, message);
    if (status == BL_OK)
        status = bl_psd_allocate(psd, &bins, message);
    if (status == BL_OK)
        status = measure_buffer(samples, &transform, &bins, psd, message);
    if (status == BL_OK)
        status = bl_psd_fill_limits(psd, &bins, 1, 0, message);
    if (status == BL_OK)
        bl_psd_fill_variance_limits(psd, &bins, NULL);
    else
        bl_psd_free(psd);
    bl_transform_close(&transform);
    bl_bins_close(&bins);
    return status;
}

double bl_psd_median_dof(const bl_psd *psd) {
    double *sorted = malloc((psd->count + 1) * sizeof *sorted), median = NAN;
    if (!sorted)
        return NAN;
    memcpy(sorted, psd->dof, psd->count * sizeof *sorted);
    qsort(sorted, psd->count, sizeof *sorted, bl_ascending);
    median = psd->count ? sorted[psd->count / 2] : NAN;
    free(sorted);
    return median;
}

size_t bl_psd_peak(const bl_psd *psd) {
    size_t peak = 0;
    for (size_t i = 1; i < psd->count; i++)
        if (!(psd->psd[i] <= psd->psd[peak]))
            peak = i;
    return peak;
}
