// SPDX-License-Identifier: MIT
#include "core/signal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bl_facts bl_facts_unknown(void) {
    return (bl_facts){.lower = NAN,
                      .upper = NAN,
                      .mean = NAN,
                      .variance = NAN,
                      .band_from = NAN,
                      .band_to = NAN,
                      .leak_db = NAN,
                      .continuity = -2,
                      .period = {NAN, NAN, NAN, NAN},
                      .cell = NAN,
                      .far = NAN,
                      .covariance_reach = NAN};
}

bl_signal *bl_signal_new(const bl_signal_functions *functions, const void *parameters,
                         size_t parameters_size, const char *text) {
    bl_signal *signal = calloc(1, sizeof *signal);
    if (!signal)
        return NULL;
    signal->functions = functions;
    signal->parameters = malloc(parameters_size);
    signal->parameters_size = parameters_size;
    signal->seed_offset = SIZE_MAX;
    signal->text = strdup(text);
    signal->name = "";
    signal->facts = bl_facts_unknown();
    if (!signal->parameters || !signal->text) {
        free(signal->parameters);
        free(signal->text);
        free(signal);
        return NULL;
    }
    memcpy(signal->parameters, parameters, parameters_size);
    return signal;
}

// Frees the signal, but nothing that its block refers to.
static void discard(bl_signal *signal) {
    if (!signal)
        return;
    free(signal->parameters);
    free(signal->text);
    free(signal);
}

bl_status bl_signal_build(bl_signal *signal, bl_message *message) {
    bl_status status = BL_OK;
    if (signal->functions->build)
        status = signal->functions->build(signal->parameters, message);
    if (status != BL_OK)
        discard(signal);
    return status;
}

// A copy whose block has the given seed, or the signal's own if `seed` is NULL.
static bl_signal *copy_with(const bl_signal *signal, const uint64_t *seed) {
    const bl_signal_functions *functions = signal->functions;
    if (functions->release && !functions->build)
        return NULL;
    bl_signal *copy =
        bl_signal_new(signal->functions, signal->parameters, signal->parameters_size, signal->text);
    if (!copy)
        return NULL;
    if (seed)
        memcpy((char *)copy->parameters + signal->seed_offset, seed, sizeof *seed);
    if (bl_signal_build(copy, NULL) != BL_OK)
        return NULL;
    copy->definition = signal->definition;
    copy->seed_offset = signal->seed_offset;
    copy->dimensions = signal->dimensions;
    copy->name = signal->name;
    copy->closed_form = signal->closed_form;
    copy->facts = signal->facts;
    copy->extent = signal->extent;
    return copy;
}

bl_signal *bl_signal_copy(const bl_signal *signal) {
    return copy_with(signal, NULL);
}

bl_signal *bl_signal_reseed(const bl_signal *signal, uint64_t seed) {
    return signal->seed_offset == SIZE_MAX ? NULL : copy_with(signal, &seed);
}

void bl_signal_free(bl_signal *signal) {
    if (signal && signal->functions->release)
        signal->functions->release(signal->parameters);
    discard(signal);
}

bl_status bl_signal_check_statistics(const bl_signal *signal, bl_message *message) {
    int repeats = 0;
    for (unsigned a = 0; a < BL_AXES; a++)
        repeats |= signal->facts.period[a] != 0; // NaN: not stated
    if (!signal->definition || signal->seed_offset != SIZE_MAX || repeats)
        return BL_OK;
    return bl_report(message, BL_MISMATCH,
                     "'%s' neither repeats nor is random, so that it has no statistics over all "
                     "places; use eval or render, or a periodic signal",
                     signal->text);
}

int bl_signal_has_closed_form(const bl_signal *signal) {
    return signal->closed_form && signal->functions->covariance;
}

int bl_signal_has_density(const bl_signal *signal) {
    return bl_signal_has_closed_form(signal) && isfinite(signal->facts.covariance_reach);
}

void bl_signal_row(const bl_signal *signal, const double start[BL_AXES], const double step[BL_AXES],
                   size_t count, float *out) {
    if (signal->functions->row) {
        signal->functions->row(signal->parameters, start, step, count, out);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        double at[BL_AXES];
        for (int a = 0; a < BL_AXES; a++)
            at[a] = start[a] + (double)i * step[a];
        out[i] = (float)bl_signal_value(signal, at);
    }
}

void bl_signal_points(const bl_signal *signal, const double *const at[BL_AXES], size_t count,
                      float *out) {
    if (signal->functions->points) {
        signal->functions->points(signal->parameters, at, count, out);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        const double place[BL_AXES] = {at[0][i], at[1][i], at[2][i], at[3][i]};
        out[i] = (float)bl_signal_value(signal, place);
    }
}

double bl_signal_value(const bl_signal *signal, const double at[BL_AXES]) {
    return signal->functions->value(signal->parameters, at);
}

double bl_signal_filtered(const bl_signal *signal, const double at[BL_AXES],
                          const double width[BL_AXES]) {
    return signal->functions->filtered ? signal->functions->filtered(signal->parameters, at, width)
                                       : bl_signal_value(signal, at);
}

void bl_signal_colour(const bl_signal *signal, const double at[BL_AXES],
                      const double width[BL_AXES], double rgb[3]) {
    if (signal->functions->colour)
        signal->functions->colour(signal->parameters, at, width, rgb);
    else
        rgb[0] = rgb[1] = rgb[2] = bl_signal_filtered(signal, at, width);
}

bl_status bl_signal_complaint(const bl_signal *signal, bl_message *message) {
    return signal->functions->complaint ? signal->functions->complaint(signal->parameters, message)
                                        : BL_OK;
}

double bl_signal_domain(const bl_signal *signal) {
    // 2^61 of its finest cells rather than 2^62: these are told to a factor of 2 only.
    return signal->facts.far < 0x1p52 ? 0x1p9 * signal->facts.far : 0x1p62;
}
