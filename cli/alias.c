// SPDX-License-Identifier: MIT
//
// The verb `alias`: what each method of sampling makes of a signal under a view.
#include "aliasing/alias.h"

#include <math.h>
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

#define AT(type, member) .offset = offsetof(type, member)
static const bl_field view_fields[] = {{"view", NULL, BL_CELL_WORD, AT(bl_view, text)},
                                       {"width_pixels", NULL, BL_CELL_COUNT, AT(bl_view, width)},
                                       {"height_pixels", NULL, BL_CELL_COUNT, AT(bl_view, height)},
                                       {0}};

static const bl_field setting_fields[] = {
    {"seed", NULL, BL_CELL_COUNT, AT(bl_alias_settings, seed)},
    {"level", NULL, BL_CELL_REAL, AT(bl_alias_settings, level)},
    {"replicates", NULL, BL_CELL_UNSIGNED, AT(bl_alias_settings, replicates)},
    {0}};

static const bl_field result_fields[] = {
    {"depth_z_units", NULL, BL_CELL_REAL, AT(bl_alias_result, depth[2])},
    {"depth_w_units", NULL, BL_CELL_REAL, AT(bl_alias_result, depth[3])},
    {"depth_is_random", NULL, BL_CELL_FLAG, AT(bl_alias_result, random_depth)},
    {"constant", NULL, BL_CELL_FLAG, AT(bl_alias_result, constancy.constant)},
    {"varying_share", NULL, BL_CELL_REAL, AT(bl_alias_result, constancy.varies)},
    {"seen", NULL, BL_CELL_REAL, AT(bl_alias_result, seen)},
    {"reference_rms_error", NULL, BL_CELL_REAL, AT(bl_alias_result, reference_error)},
    {"reference_samples_per_pixel", NULL, BL_CELL_REAL, AT(bl_alias_result, reference.samples)},
    {"reference_exact", NULL, BL_CELL_FLAG, AT(bl_alias_result, reference.exact)},
    {"reference_from_cache", NULL, BL_CELL_FLAG, AT(bl_alias_result, reference.from_cache)},
    {"error_spectrum_ring_cycles_per_pixel", NULL, BL_CELL_REAL, AT(bl_alias_result, ring_width)},
    {0}};
#undef AT

static void fill_json(json_t *object, const bl_signal *signal, const bl_view *view,
                      const bl_alias_settings *settings, const bl_alias_result *result) {
    const bl_table rows = bl_alias_table(result);
    bl_json_set_text(object, "signal", signal->text);
    bl_record_json(object, &BL_RECORD(view_fields, view), 0);
    bl_json_set_text(object, "pixel", bl_pixel_words[settings->pixel]);
    bl_record_json(object, &BL_RECORD(setting_fields, settings), 0);
    bl_record_json(object, &BL_RECORD(result_fields, result), 0);
    json_object_set_new(object, "rows", bl_table_json(&rows));
}

static void print_reference(FILE *out, const bl_alias_result *result) {
    if (result->reference.exact) {
        fputs("reference of mse to largest: the exact integral over each pixel", out);
    } else {
        fprintf(out,
                "reference of mse to largest: the mean of %.4g samples a pixel, rms error below "
                "%.2g",
                result->reference.samples, result->reference_error);
        if (!bl_alias_is_converged(result))
            fputs(
                "\n(more than a tenth of the smallest error below: see the interval of mse, or "
                "take --full)",
                out);
    }
    fputs(
        "\nreference of alias and blur: the image below half a cycle per pixel, ideally "
        "filtered\n\n",
        out);
}

static void print_depth(FILE *out, const bl_alias_result *result) {
    static const char axes[] = "xyzw";
    for (int a = 2; a < BL_AXES; a++)
        if (isfinite(result->depth[a]))
            fprintf(out, "the slice at %c = %.10g\n", axes[a], result->depth[a]);
    if (result->random_depth)
        fputs(
            "(a random depth of the seed, unless z or w is given to flat or plane; alias and blur "
            "are averages over depths)\n",
            out);
}

static void print_table(FILE *out, const bl_signal *signal, const bl_view *view,
                        const bl_alias_settings *settings, const bl_alias_result *result) {
    const bl_table rows = bl_alias_table(result);
    bl_plain_text(out, signal->text);
    fputs(" under ", out);
    bl_plain_text(out, view->text);
    fprintf(out, ", %zu x %zu pixels, %s pixel\n", view->width, view->height,
            bl_pixel_words[settings->pixel]);
    print_depth(out, result);
    print_reference(out, result);
    bl_table_print(&rows, out);
    fputs(
        "\nalias, blur, mse and flicker are squares of the luminance; ns is ns_per_sample, of a "
        "pixel;\nwhat stands after < is an upper limit; --json has the intervals\n",
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
    bl_alias_warn(call, signal, view, &result.constancy);
    if (call->path)
        status = bl_alias_files_write(call, signal, view, &result);
    json_t *object = status == BL_OK ? bl_json_start(call) : NULL;
    if (object)
        fill_json(object, signal, view, &settings, &result);
    else if (status == BL_OK && !call->common.quiet)
        print_table(call->out, signal, view, &settings, &result);
    bl_alias_free(&result);
    return status;
}

static bl_status run_alias(bl_call *call) {
    bl_call_may_warn(call);
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
    {"view", BL_OPTION_WORD, AT(view), "VIEW", .fallback = "flat",
     .help = "what the pixels see, as plane:height=1,fov=60; `bandlimit list views` shows all"},
    {"method", BL_OPTION_WORDS, AT(methods), "METHOD", .also = "filter",
     .help =
         "how to sample: by a word of the signal's own key filter (of a sum of octaves: clamp), "
         "as integral:width=length; or point, supersample:n=4,pattern=jitter, mean; may be "
         "repeated. all: the signal's own filters and the usual methods (default: all)"},
    {"size", BL_OPTION_WORD, AT(size), "WxH",
     .help = "pixels of the image (default: 128x128; --quick 64x64)"},
    {"pixel", BL_OPTION_CHOICE, AT(pixel), "KERNEL", .fallback = "box", .choices = bl_pixel_words,
     .help = "the pixel of the converged reference: a box as wide as a pixel, or a gaussian with a "
             "standard deviation of half a pixel"},
    {"cache", BL_OPTION_WORD, AT(cache), "DIR",
     .help = "keep converged references in DIR, and take them from there; without it none is kept"},
    {0}};

const bl_verb bl_verb_alias = {
    .name = "alias",
    .operands = "SIGNAL",
    .summary = "alias and blur of each method of sampling under a view",
    .text =
        "Samples a texture, a primitive or a noise under a view with each of the methods asked "
        "for, and compares the images with a converged reference: the energy that folds into the "
        "image (alias), the energy that is missing within (blur), squared and largest error, "
        "structural similarity, what flickers when the picture moves, and the time of a pixel. "
        "Alias and blur are averages over random shifts of the pixels, and over fresh seeds of a "
        "signal that has one; their intervals are from the spread.",
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
