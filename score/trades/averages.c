// SPDX-License-Identifier: MIT
//
// averages: how many lines a power spectrum is averaged over; the subject is the word `spectrum`.
//
// What is measured is gradient noise along lines of 256 samples, 8 a cell. Error: half the width of
// the confidence interval of a bin at 95 %, in parts of the estimate, the mean over the bins of the
// band from 0.25 to 1 cycles a cell. With K averages it is about 1.96 / sqrt(K), and more for few,
// where the interval is lopsided. The cost is that of the whole estimate: below some hundred
// averages most of it are the quantiles of the intervals, which are paid once.
//
// Source: welch1967.
#include "score/trade.h"
#include "noises/noise.h"
#include "spectra/psd.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BINS_MOST = 512 };

typedef struct spectrum_work {
    const bl_signal *signal;
    bl_psd_settings settings;
    int failed;
} spectrum_work;

static int applies(const bl_signal *subject, const char *word) {
    return !subject && word && strcmp(word, "spectrum") == 0;
}

static void work(void *state, size_t count) {
    spectrum_work *work = state;
    for (size_t i = 0; i < count; i++) {
        bl_psd psd;
        if (bl_psd_measure(work->signal, &work->settings, &psd, NULL) == BL_OK)
            bl_psd_free(&psd);
        else
            work->failed = 1;
    }
}

// Neighbouring bins are correlated through the window: those `broadening` apart count as
// independent, which only widens the interval.
static bl_estimate width_of_interval(const bl_psd *psd) {
    double width[BINS_MOST];
    size_t count = 0, stride = (size_t)fmax(1, ceil(psd->broadening));
    for (size_t i = 0; i < psd->count && count < BINS_MOST; i += stride)
        if (psd->frequency[i] >= 0.25 && psd->frequency[i] <= 1 && psd->dof[i] > 0)
            width[count++] = 0.5 * (psd->upper[i] - psd->lower[i]) / psd->psd[i];
    bl_estimate mean = bl_mean_estimate(width, count, 0.95);
    mean.lower = fmax(0, mean.lower);
    return mean;
}

static bl_status add(const bl_signal *signal, size_t averages, const bl_trade_settings *settings,
                     bl_alternatives *alternatives, bl_message *message) {
    char name[32];
    snprintf(name, sizeof name, "%zu", averages);
    spectrum_work *state = calloc(1, sizeof *state);
    bl_alternative *added = state ? bl_alternatives_add(alternatives, name) : NULL;
    if (!added) {
        free(state);
        return bl_report(message, BL_DEVICE, "out of memory for a trade");
    }
    bl_psd psd;
    state->signal = signal;
    state->settings = bl_psd_default_settings(1);
    state->settings.rate = 8;
    state->settings.size = 256;
    state->settings.averages = averages;
    state->settings.seed = settings->seed;
    state->settings.threads = 1; // so that the time is that of the work
    added->state = state;
    added->work = work;
    bl_status status = bl_psd_measure(signal, &state->settings, &psd, message);
    if (status != BL_OK)
        return status;
    added->error = width_of_interval(&psd);
    bl_psd_free(&psd);
    return BL_OK;
}

static bl_status open(const bl_signal *subject, const bl_trade_settings *settings,
                      bl_alternatives *alternatives, bl_message *message) {
    static const size_t averages[] = {16, 64, 256, 1024, 4096, 16384, 65536};
    static const size_t counts[] = {5, 6, 7};
    bl_signal *signal;
    (void)subject;
    bl_status status = bl_noise_open("gnoise", BL_ISA_BEST, &signal, message);
    if (status != BL_OK)
        return status;
    signal->closed_form = 0; // the time is that of measuring, not of the theory beside it
    alternatives->own = signal;
    for (size_t i = 0; i < counts[settings->size] && status == BL_OK; i++)
        status = add(signal, averages[i], settings, alternatives, message);
    return status;
}

static void close_spectra(bl_alternatives *alternatives) {
    for (size_t i = 0; i < alternatives->count; i++)
        free(alternatives->list[i].state);
    bl_signal_free(alternatives->own);
}

BL_TRADE_DESCRIPTOR(averages) = {
    .name = "averages",
    .title = "averages of a spectrum",
    .question = "How many averages until a spectrum is known, and how long do they take?",
    .paper = "welch1967",
    .error_name = "half the 95 % interval of a bin",
    .error_unit = "of the estimate",
    .sample = "a whole estimate",
    .subject = "spectrum",
    .applies = applies,
    .open = open,
    .close = close_spectra};
