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
        status = signal->functions->build(signal->parameters, signal->open, message);
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
    copy->open = signal->open;
    if (bl_signal_build(copy, NULL) != BL_OK)
        return NULL;
    copy->definition = signal->definition;
    copy->seed_offset = signal->seed_offset;
    copy->dimensions = signal->dimensions;
    copy->name = signal->name;
    copy->is_serial = signal->is_serial;
    copy->closed_form = signal->closed_form;
    copy->facts = signal->facts;
    copy->extent = signal->extent;
    copy->picture = signal->picture;
    return copy;
}

bl_signal *bl_signal_copy(const bl_signal *signal) {
    return copy_with(signal, NULL);
}

bl_signal *bl_signal_reseed(const bl_signal *signal, uint64_t seed) {
    return signal->seed_offset == SIZE_MAX ? NULL : copy_with(signal, &seed);
}

uint64_t bl_signal_seed(const bl_signal *signal) {
    uint64_t seed = 0;
    if (signal->seed_offset != SIZE_MAX)
        memcpy(&seed, (const char *)signal->parameters + signal->seed_offset, sizeof seed);
    return seed;
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
    double at[BL_AXES][BL_BATCH];
    const double *const columns[BL_AXES] = {at[0], at[1], at[2], at[3]};
    for (size_t done = 0, here; done < count; done += here) {
        here = count - done < BL_BATCH ? count - done : BL_BATCH;
        const double first = (double)done; // exact to 2^53 samples
        const int samples = (int)here;
        for (int a = 0; a < BL_AXES; a++)
            for (int i = 0; i < samples; i++)
                at[a][i] = start[a] + (first + i) * step[a];
        bl_signal_points(signal, columns, here, out + done);
    }
}

void bl_signal_points(const bl_signal *signal, const double *const at[BL_AXES], size_t count,
                      float *out) {
    if (signal->functions->points) {
        signal->functions->points(signal->parameters, at, count, out);
        return;
    }
    double value[BL_BATCH];
    for (size_t done = 0, here; done < count; done += here) {
        here = count - done < BL_BATCH ? count - done : BL_BATCH;
        bl_signal_values(
            signal, (const double *const[]){at[0] + done, at[1] + done, at[2] + done, at[3] + done},
            here, value);
        for (size_t i = 0; i < here; i++)
            out[done + i] = (float)value[i];
    }
}

double bl_signal_value(const bl_signal *signal, const double at[BL_AXES]) {
    if (signal->functions->value)
        return signal->functions->value(signal->parameters, at);
    double value;
    signal->functions->values(signal->parameters,
                              (const double *const[]){&at[0], &at[1], &at[2], &at[3]}, 1, &value);
    return value;
}

void bl_signal_values(const bl_signal *signal, const double *const at[BL_AXES], size_t count,
                      double *out) {
    if (signal->functions->values) {
        signal->functions->values(signal->parameters, at, count, out);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        const double place[BL_AXES] = {at[0][i], at[1][i], at[2][i], at[3][i]};
        out[i] = signal->functions->value(signal->parameters, place);
    }
}

void bl_signal_values_gathered(const bl_signal *signal, const bl_gathered *places, double *out) {
    const double *const at[BL_AXES] = {places->at[0], places->at[1], places->at[2], places->at[3]};
    bl_signal_values(signal, at, places->count, out);
}

void bl_signal_filtered_values(const bl_signal *signal, const bl_samples *samples, double *out) {
    if (signal->functions->filtered)
        signal->functions->filtered(signal->parameters, samples, out);
    else
        bl_signal_values(signal, samples->at, samples->count, out);
}

void bl_signal_colours(const bl_signal *signal, const bl_samples *samples, double *rgb) {
    if (signal->functions->colour) {
        signal->functions->colour(signal->parameters, samples, rgb);
        return;
    }
    double value[BL_BATCH];
    for (size_t done = 0; done < samples->count; done += BL_BATCH) {
        const bl_samples part = bl_samples_part(samples, done, BL_BATCH);
        bl_signal_filtered_values(signal, &part, value);
        for (size_t i = 0; i < part.count; i++)
            for (size_t c = 0; c < 3; c++)
                rgb[3 * (done + i) + c] = value[i];
    }
}

double bl_signal_filtered(const bl_signal *signal, const double at[BL_AXES],
                          const double width[BL_AXES]) {
    const bl_footprint footprint = bl_footprint_of_widths(width);
    double value;
    bl_signal_filtered_values(
        signal, &(const bl_samples){{&at[0], &at[1], &at[2], &at[3]}, &footprint, 0, 1}, &value);
    return value;
}

void bl_signal_colour(const bl_signal *signal, const double at[BL_AXES],
                      const double width[BL_AXES], double rgb[3]) {
    const bl_footprint footprint = bl_footprint_of_widths(width);
    bl_signal_colours(signal,
                      &(const bl_samples){{&at[0], &at[1], &at[2], &at[3]}, &footprint, 0, 1}, rgb);
}

void bl_values_of_width(void (*filtered)(const void *, const bl_samples *, double *),
                        const void *parameters, double width, const double *const at[BL_AXES],
                        size_t count, double *out) {
    const bl_footprint footprint = bl_footprint_of_width(width);
    filtered(parameters, &(const bl_samples){{at[0], at[1], at[2], at[3]}, &footprint, 0, count},
             out);
}

void bl_signal_note(const bl_signal *signal, char *text, size_t size) {
    *text = '\0';
    if (signal->functions->note)
        signal->functions->note(signal->parameters, text, size);
}

bl_status bl_signal_complaint(const bl_signal *signal, bl_message *message) {
    return signal->functions->complaint ? signal->functions->complaint(signal->parameters, message)
                                        : BL_OK;
}

double bl_signal_domain(const bl_signal *signal) {
    // 2^61 of its finest cells rather than 2^62: these are told to a factor of 2 only.
    return signal->facts.far < 0x1p52 ? 0x1p9 * signal->facts.far : 0x1p62;
}
