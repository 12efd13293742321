// SPDX-License-Identifier: MIT
//
// texture-filter: the methods of sampling a texture, or anything else that filters itself, under a
// view (aliasing/alias.h): its own filters, one point, more points, and the mean.
//
// Error: the root mean square of the luminance against the converged image of a box pixel. The
// interval is that of the reference's own error. A sample is a pixel.
//
// Source: peachey2003, pp. 57-66.
#include "aliasing/alias.h"
#include "score/trade.h"
#include "score/trade_signals.h"
#include "aliasing/usual_methods.h"

static int applies(const bl_signal *subject, const char *word) {
    (void)word;
    return subject && subject->dimensions > 1 && bl_method_own_key(subject);
}

static bl_alias_settings settings_of(const bl_trade_settings *settings) {
    static const unsigned samples[] = {128, 512, 4096}, rounds[] = {15, 31, 101};
    bl_alias_settings alias = bl_alias_default_settings();
    alias.oversample = 1; // alias and blur apart are not asked for
    alias.replicates = 2;
    alias.frames = 0;
    alias.rounds = rounds[settings->size];
    alias.turn_seconds = settings->size == BL_QUICK ? 2e-4 : 2e-3;
    alias.most_samples = samples[settings->size];
    alias.seed = settings->seed;
    alias.threads = settings->threads;
    return alias;
}

static bl_status take(const bl_alias_result *result, const char *const *methods,
                      bl_alternatives *alternatives, bl_message *message) {
    for (size_t i = 0; i < result->count; i++) {
        const bl_alias_row *row = &result->rows[i];
        bl_alternative *added = bl_alternatives_add(alternatives, methods[i]);
        if (!added)
            return bl_report(message, BL_DEVICE, "out of memory for a trade");
        added->error = bl_root_estimate(row->mse);
        added->largest = row->max_error;
        added->ns = row->ns_per_sample;
        added->ns_lowest = row->ns_lowest;
        added->ns_highest = row->ns_highest;
    }
    return BL_OK;
}

static bl_status open(const bl_signal *subject, const bl_trade_settings *settings,
                      bl_alternatives *alternatives, bl_message *message) {
    static const size_t sizes[] = {48, 128, 256};
    const char *methods[BL_METHODS_MOST];
    const bl_alias_settings alias = settings_of(settings);
    size_t size = sizes[settings->size], count = bl_usual_methods(subject, methods);
    bl_view view;
    bl_alias_result result;
    bl_status status =
        bl_view_open(settings->view ? settings->view : "plane", size, size, &view, message);
    if (status != BL_OK)
        return status;
    status = bl_alias_measure(subject, &view, methods, count, &alias, &result, message);
    bl_view_close(&view);
    if (status != BL_OK)
        return status;
    status = take(&result, methods, alternatives, message);
    bl_alias_free(&result);
    return status;
}

static void close_nothing(bl_alternatives *alternatives) {
    (void)alternatives;
}

BL_TRADE_DESCRIPTOR(texture_filter) = {
    .name = "texture-filter",
    .title = "method of sampling",
    .question = "What does each method of sampling cost, and how far off is its image?",
    .paper = "peachey2003, pp. 57-66",
    .error_name = "rms error of the image",
    .error_unit = "of full luminance",
    .sample = "a pixel",
    .subject = "brick",
    .applies = applies,
    .open = open,
    .close = close_nothing};
