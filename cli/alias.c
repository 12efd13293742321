// SPDX-License-Identifier: MIT
//
// The verb `alias`: what each way of sampling leaves of a signal under a view.
#include "aliasing/alias.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/alias_files.h"
#include "cli/json.h"
#include "core/plain.h"
#include "cli/verb.h"

typedef struct alias_options {
    const char *view, *size, *pixel, *cache;
    bl_words methods;
} alias_options;

// Beside the signal's own words.
static const char *const usual[] = {"point",
                                    "supersample:n=2",
                                    "supersample:n=4",
                                    "supersample:n=4,pattern=jitter",
                                    "supersample:n=4,pattern=sobol",
                                    "mean"};
enum { USUAL = sizeof usual / sizeof *usual };

static bl_status read_size(const char *text, size_t size[2], bl_message *message) {
    char word[64];
    unsigned long long width, height;
    snprintf(word, sizeof word, "%s", text);
    char *cross = strchr(word, 'x');
    if (cross)
        *cross = '\0';
    if (!bl_read_unsigned(word, &width) || !bl_read_unsigned(cross ? cross + 1 : word, &height) ||
        width < 2 || height < 2 || width > 4096 || height > 4096)
        return bl_report(message, BL_USAGE,
                         "--size %s: not a size; use WIDTHxHEIGHT or one number, 2 to 4096 pixels",
                         text);
    size[0] = width;
    size[1] = height;
    return BL_OK;
}

static int add_all(const bl_signal *signal, bl_words *methods) {
    int whole = 1;
    for (const char *const *own = bl_method_own_words(signal); *own; own++)
        if (strcmp(*own, "none") != 0) // which is point sampling
            whole = whole && bl_words_add(methods, *own);
    for (size_t i = 0; i < USUAL; i++)
        if (!bl_method_is_own(signal, usual[i]))
            whole = whole && bl_words_add(methods, usual[i]);
    return whole;
}

static bl_status choose_methods(bl_call *call, const bl_signal *signal, bl_words *methods) {
    const alias_options *options = call->settings;
    int whole = 1;
    if (options->methods.count == 0)
        whole = add_all(signal, methods);
    for (size_t i = 0; i < options->methods.count; i++)
        whole = whole && (strcmp(options->methods.words[i], "all") == 0
                              ? add_all(signal, methods)
                              : bl_words_add(methods, options->methods.words[i]));
    return whole ? BL_OK : bl_report(&call->message, BL_DEVICE, "out of memory");
}

static bl_alias_settings settings_of(const bl_call *call) {
    const alias_options *options = call->settings;
    bl_alias_settings settings = bl_alias_settings_of_size(call->size);
    settings.pixel = strcmp(options->pixel, "gaussian") == 0 ? BL_PIXEL_GAUSSIAN : BL_PIXEL_BOX;
    settings.seed = call->common.seed;
    settings.threads = bl_call_threads(call);
    settings.cache = options->cache;
    return settings;
}

// --- reports ------------------------------------------------------------------------------------

static json_t *row_json(const bl_alias_row *row) {
    json_t *object = json_object();
    bl_json_set_text(object, "filter", row->method);
    bl_json_set_estimate(object, "alias", &row->alias);
    bl_json_set_estimate(object, "blur", &row->blur);
    bl_json_set_estimate(object, "mse", &row->mse);
    bl_json_set_number(object, "psnr_db", row->psnr_db);
    bl_json_set_estimate(object, "ssim", &row->ssim);
    bl_json_set_number(object, "max_error", row->max_error);
    bl_json_set_estimate(object, "flicker", &row->flicker);
    bl_json_set_number(object, "pops", row->pops);
    bl_json_set_number(object, "ns_per_sample", row->ns_per_sample);
    bl_json_set_number(object, "ns_per_sample_lower", row->ns_lowest);
    bl_json_set_number(object, "ns_per_sample_upper", row->ns_highest);
    bl_json_set_number(object, "samples_per_pixel", row->samples);
    bl_json_set_number(object, "first_alias_cycles_per_pixel", row->first_alias);
    bl_json_set_number(object, "predicted_alias", row->predicted_alias);
    bl_json_set_number(object, "predicted_blur", row->predicted_blur);
    bl_json_set_numbers(object, "error_spectrum", row->rings, BL_ALIAS_RINGS);
    return object;
}

static void fill_json(json_t *object, const bl_call *call, const bl_signal *signal,
                      const bl_view *view, const bl_alias_settings *settings,
                      const bl_alias_result *result) {
    json_t *rows = json_array();
    bl_json_set_text(object, "signal", signal->text);
    bl_json_set_text(object, "view", view->text);
    bl_json_set_count(object, "width_pixels", view->width);
    bl_json_set_count(object, "height_pixels", view->height);
    bl_json_set_text(object, "pixel", bl_pixel_words[settings->pixel]);
    bl_json_set_count(object, "seed", call->common.seed);
    bl_json_set_number(object, "level", settings->level);
    bl_json_set_count(object, "replicates", settings->replicates);
    bl_json_set_number(object, "seen", result->seen);
    bl_json_set_number(object, "reference_rms_error", result->reference_error);
    bl_json_set_number(object, "reference_samples_per_pixel", result->reference.samples);
    json_object_set_new(object, "reference_exact", json_boolean(result->reference.exact));
    json_object_set_new(object, "reference_from_cache", json_boolean(result->reference.from_cache));
    bl_json_set_number(object, "error_spectrum_ring_cycles_per_pixel", result->ring_width);
    for (size_t i = 0; i < result->count; i++)
        json_array_append_new(rows, row_json(&result->rows[i]));
    json_object_set_new(object, "rows", rows);
}

// Whether the reference is good to a tenth of the smallest error that was measured with it.
static int is_converged(const bl_alias_result *result) {
    double least = INFINITY;
    for (size_t i = 0; i < result->count; i++)
        least = fmin(least, result->rows[i].mse.value);
    return result->reference_error <= 0.1 * sqrt(least) + 0x1p-16;
}

static void print_table(FILE *out, const bl_signal *signal, const bl_view *view,
                        const bl_alias_settings *settings, const bl_alias_result *result) {
    int width = 6;
    for (size_t i = 0; i < result->count; i++) {
        int letters = (int)strlen(result->rows[i].method);
        width = letters > width ? letters : width;
    }
    bl_plain_text(out, signal->text);
    fputs(" under ", out);
    bl_plain_text(out, view->text);
    fprintf(out, ", %zu x %zu pixels, %s pixel\n", view->width, view->height,
            bl_pixel_words[settings->pixel]);
    fprintf(out, "reference: %s%.4g samples a pixel, rms error below %.2g%s\n\n",
            result->reference.exact ? "exact, " : "", result->reference.samples,
            result->reference_error,
            is_converged(result) ? ""
                                 : "\n(more than a tenth of the smallest error below: see "
                                   "the interval of mse, or take --full)");
    fprintf(out,
            "%-*s  alias      blur       mse        psnr_db  ssim    max_error  flicker    "
            "ns_per_sample\n",
            width, "method");
    for (size_t i = 0; i < result->count; i++) {
        const bl_alias_row *row = &result->rows[i];
        fprintf(out, "%-*s  %-9.3g  %-9.3g  %-9.3g  %-7.4g  %-6.4f  %-9.3g  %-9.3g  %.4g\n", width,
                row->method, row->alias.value, row->blur.value, row->mse.value, row->psnr_db,
                row->ssim.value, row->max_error, row->flicker.value, row->ns_per_sample);
    }
    fputs("\nalias, blur, mse and flicker are squares of the luminance; --json has the intervals\n",
          out);
}

static bl_status measure(bl_call *call, const bl_signal *signal, const bl_view *view) {
    const bl_alias_settings settings = settings_of(call);
    bl_words methods = {0};
    bl_alias_result result;
    bl_status status = choose_methods(call, signal, &methods);
    if (status == BL_OK) {
        bl_progress(call, "measuring %zu methods on %s ...", methods.count, signal->text);
        status = bl_alias_measure(signal, view, methods.words, methods.count, &settings, &result,
                                  &call->message);
        bl_progress(call, NULL);
    }
    bl_words_free(&methods);
    if (status != BL_OK)
        return status;
    if (call->path)
        status = bl_alias_files_write(call, signal, view, &result);
    json_t *object = status == BL_OK ? bl_json_start(call) : NULL;
    if (object)
        fill_json(object, call, signal, view, &settings, &result);
    else if (status == BL_OK && !call->common.quiet)
        print_table(call->out, signal, view, &settings, &result);
    bl_alias_free(&result);
    return status;
}

static bl_status run_alias(bl_call *call) {
    const alias_options *options = call->settings;
    size_t size[2] = {0, 0};
    bl_view view;
    bl_signal *signal;
    const char *usual_size = call->size == BL_QUICK ? "64x64" : "128x128";
    bl_status status = read_size(options->size ? options->size : usual_size, size, &call->message);
    if (status == BL_OK)
        status = bl_view_open(options->view, size[0], size[1], &view, &call->message);
    if (status != BL_OK)
        return status;
    status = bl_call_open(call, call->operands.words[0], &signal);
    if (status == BL_OK) {
        status = measure(call, signal, &view);
        bl_signal_free(signal);
    }
    bl_view_close(&view);
    return status;
}

#define AT(member) offsetof(alias_options, member)
static const bl_option options[] = {
    {.name = "view",
     .kind = BL_OPTION_WORD,
     .offset = AT(view),
     .value = "VIEW",
     .fallback = "flat",
     .help = "what the pixels see, as plane:height=1,fov=60; `bandlimit list views` shows all"},
    {.name = "method",
     .also = "filter",
     .kind = BL_OPTION_WORDS,
     .offset = AT(methods),
     .value = "METHOD",
     .help =
         "how to sample: by a word of the signal's own key filter (of a sum of octaves: clamp), "
         "as integral:width=length; or point, supersample:n=4,pattern=jitter, mean; may be "
         "repeated. all: the signal's own filters and the usual methods (default: all)"},
    {.name = "size",
     .kind = BL_OPTION_WORD,
     .offset = AT(size),
     .value = "WxH",
     .help = "pixels of the image (default: 128x128; --quick 64x64)"},
    {.name = "pixel",
     .kind = BL_OPTION_CHOICE,
     .offset = AT(pixel),
     .value = "KERNEL",
     .fallback = "box",
     .choices = bl_pixel_words,
     .help = "of the converged reference: box, a pixel wide, or gaussian, of a standard deviation "
             "of half a pixel"},
    {.name = "cache",
     .kind = BL_OPTION_WORD,
     .offset = AT(cache),
     .value = "DIR",
     .help = "keep converged references in DIR, and take them from there; without it none is kept"},
    {0}};

const bl_verb bl_verb_alias = {
    .name = "alias",
    .operands = "SIGNAL",
    .summary = "alias and blur of each method of sampling under a view",
    .text =
        "Samples a texture, a primitive or a noise under a view with each of the methods asked "
        "for, and "
        "compares the images with a converged reference: the energy that folds into the image "
        "(alias), the energy that is missing within (blur), squared and largest error, structural "
        "similarity, what flickers when the picture moves, and the time of a pixel. Alias and blur "
        "are averages over random shifts of the pixels, and over fresh seeds where the signal has "
        "one; their intervals come of the spread.",
    .least = 1,
    .most = 1,
    .output = BL_OUTPUT_FOLDER,
    .output_help =
        "the folder to write into: the reference, the image of each method and its "
        "signed error, as EXR (linear) and PNG (sRGB), and alias.csv",
    .options = options,
    .settings_size = sizeof(alias_options),
    .run = run_alias,
};
