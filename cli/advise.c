// SPDX-License-Identifier: MIT
//
// The verb `advise`: the cheapest way to sample a texture under a view within a tolerance.
#include "score/advise.h"

#include <math.h>
#include <stdint.h>

#include "aliasing/usual_methods.h"
#include "cli/alias_files.h"
#include "cli/json.h"
#include "core/plain.h"
#include "cli/verb.h"

typedef struct advise_options {
    const char *view, *tolerance;
    int largest;
    uint64_t size;
    bl_words methods;
} advise_options;

static const char axes[] = "xyzw";

// --- settings -----------------------------------------------------------------------------------

static bl_advise_settings settings_of(const bl_call *call, double tolerance) {
    const advise_options *options = call->settings;
    bl_advise_settings settings = bl_advise_settings_of_size(call->size);
    settings.tolerance = tolerance;
    settings.largest = options->largest;
    settings.alias.seed = call->common.seed;
    settings.alias.threads = bl_call_threads(call);
    return settings;
}

static bl_status read_tolerance(bl_call *call, double *tolerance) {
    const advise_options *options = call->settings;
    if (bl_read_real(options->tolerance, tolerance) && *tolerance > 0)
        return BL_OK;
    return bl_report(&call->message, BL_USAGE,
                     "--tolerance %s: not a number above 0; write it as 1/255 or 0.004",
                     options->tolerance);
}

static size_t choose_methods(const bl_call *call, const bl_signal *signal, const char **methods) {
    const advise_options *options = call->settings;
    size_t count = 0;
    if (options->methods.count == 0)
        return bl_usual_methods(signal, methods);
    for (; count < options->methods.count && count < BL_METHODS_MOST; count++)
        methods[count] = options->methods.words[count];
    return count;
}

// --- JSON ---------------------------------------------------------------------------------------

// What stands beside the rows of the measurement.
static void find_error(const bl_table *table, size_t row, bl_cell *cell) {
    const bl_estimate *error = &((const bl_advice *)table->context)->error[row];
    cell->value = error->value;
    cell->lower = error->lower;
    cell->upper = error->upper;
}

// clang-format off
#define AT(member) .offset = offsetof(bl_alias_row, member)
static const bl_field row_fields[] = {
    {"filter", NULL, BL_CELL_WORD, AT(method)},
    {"error", NULL, BL_CELL_ESTIMATE, .find = find_error},
    {"max_error", NULL, BL_CELL_REAL, AT(max_error)},
    {"alias", NULL, BL_CELL_ESTIMATE, AT(alias)},
    {"blur", NULL, BL_CELL_ESTIMATE, AT(blur)},
    {"ns_per_sample", NULL, BL_CELL_ESTIMATE, AT(ns_per_sample)},
    {"samples_per_pixel", NULL, BL_CELL_REAL, AT(samples)},
    {0}};
#undef AT

#define AT(member) .offset = offsetof(bl_worst_pixel, member)
static const bl_field worst_fields[] = {
    {"worst_x_pixel", NULL, BL_CELL_COUNT, AT(x)},
    {"worst_y_pixel", NULL, BL_CELL_COUNT, AT(y)},
    {"worst_error", NULL, BL_CELL_REAL, AT(error)},
    {"worst_width", NULL, BL_CELL_REAL, AT(width)},
    {0}};
#undef AT

static int has_octaves(const void *row) {
    return ((const bl_scene_needs *)row)->octaves > 0;
}

#define AT(member) .offset = offsetof(bl_scene_needs, member)
static const bl_field needs_fields[] = {
    {"least_width", NULL, BL_CELL_REAL, AT(least_width)},
    {"most_width", NULL, BL_CELL_REAL, AT(most_width)},
    {"highest_frequency", NULL, BL_CELL_REAL, AT(highest_frequency)},
    {"octaves", NULL, BL_CELL_UNSIGNED, AT(octaves), .when = has_octaves, .absent = 1},
    {"octaves_seen", NULL, BL_CELL_UNSIGNED, AT(octaves_seen), .when = has_octaves, .absent = 1},
    {0}};
#undef AT
// clang-format on

static json_t *rows_json(const bl_advice *advice) {
    const bl_alias_result *alias = &advice->alias;
    const bl_table worst = BL_TABLE(worst_fields, advice->worst, alias->count);
    bl_table rows = BL_TABLE(row_fields, alias->rows, alias->count);
    rows.context = advice;
    json_t *list = bl_table_json(&rows);
    for (size_t i = 0; i < alias->count; i++)
        bl_record_json(json_array_get(list, i), &worst, i);
    return list;
}

static json_t *needs_json(const bl_scene_needs *needs, unsigned dimensions) {
    json_t *object = json_object(), *unused = json_array();
    bl_record_json(object, &BL_RECORD(needs_fields, needs), 0);
    for (unsigned a = 0; a < dimensions; a++)
        if (!needs->varies[a])
            json_array_append_new(unused, json_stringn(&axes[a], 1));
    json_object_set_new(object, "dimensions_not_used", unused);
    return object;
}

static void set_row(json_t *object, const char *key, const bl_advice *advice, size_t row) {
    bl_json_set_text(object, key, row == SIZE_MAX ? NULL : advice->alias.rows[row].method);
}

static void fill_json(json_t *object, const bl_signal *signal, const bl_view *view,
                      const bl_advise_settings *settings, const bl_advice *advice) {
    bl_json_set_text(object, "signal", signal->text);
    bl_json_set_text(object, "view", view->text);
    bl_json_set_count(object, "width_pixels", view->width);
    bl_json_set_count(object, "height_pixels", view->height);
    bl_json_set_number(object, "tolerance", settings->tolerance);
    bl_json_set_text(object, "measure", settings->largest ? "largest" : "rms");
    bl_json_set_number(object, "reference_rms_error", advice->alias.reference_error);
    bl_json_set_text(object, "verdict", bl_verdict_word(advice->verdict));
    bl_json_set_count(object, "exit_status", (uint64_t)bl_verdict_status(advice->verdict));
    set_row(object, "advice", advice,
            advice->verdict == BL_VERDICT_PASS ? advice->chosen : SIZE_MAX);
    set_row(object, "best", advice, advice->chosen);
    set_row(object, "next_cheaper", advice, advice->cheaper);
    json_object_set_new(object, "rows", rows_json(advice));
    json_object_set_new(object, "needs", needs_json(&advice->needs, signal->dimensions));
}

// --- the report ---------------------------------------------------------------------------------

static void print_fault(FILE *out, const bl_advice *advice, size_t row, double tolerance,
                        const char *measure) {
    const bl_alias_row *measured = &advice->alias.rows[row];
    const bl_worst_pixel *worst = &advice->worst[row];
    fprintf(out, "  its %s error is %.3g, %.3g times the tolerance, more of it %s\n", measure,
            advice->error[row].value, advice->error[row].value / tolerance,
            measured->alias.value > measured->blur.value ? "alias than blur" : "blur than alias");
    fprintf(out, "  it is furthest off at pixel (%zu, %zu), by %+.3g", worst->x, worst->y,
            worst->error);
    if (isfinite(worst->width))
        fprintf(out, ", where a sample is %.3g units wide", worst->width);
    fputs("\n", out);
}

static void print_choice(FILE *out, const bl_advice *advice, double tolerance,
                         const char *measure) {
    const bl_alias_row *chosen = &advice->alias.rows[advice->chosen];
    if (bl_alias_is_constant(&advice->alias)) {
        fputs("no advice: the image is constant, and does not tell good methods from bad ones\n",
              out);
        return;
    }
    if (advice->verdict == BL_VERDICT_PASS)
        fprintf(out, "use %s: %s error %.3g (%.3g to %.3g), %.4g ns a pixel (%.4g to %.4g)\n",
                chosen->method, measure, advice->error[advice->chosen].value,
                advice->error[advice->chosen].lower, advice->error[advice->chosen].upper,
                chosen->ns_per_sample, chosen->ns_lowest, chosen->ns_highest);
    else {
        fprintf(out, "none is %swithin the tolerance; the nearest is %s, %.4g ns a pixel\n",
                advice->verdict == BL_VERDICT_FAIL ? "" : "surely ", chosen->method,
                chosen->ns_per_sample);
        print_fault(out, advice, advice->chosen, tolerance, measure);
        if (advice->verdict == BL_VERDICT_INCONCLUSIVE)
            fputs("  its interval holds the tolerance: --full converges the reference further\n",
                  out);
    }
    if (advice->cheaper == SIZE_MAX) {
        fputs("nothing that was measured is cheaper\n", out);
        return;
    }
    fprintf(out, "the next cheaper is %s, %.4g ns a pixel\n",
            advice->alias.rows[advice->cheaper].method,
            advice->alias.rows[advice->cheaper].ns_per_sample);
    print_fault(out, advice, advice->cheaper, tolerance, measure);
}

static void print_needs(FILE *out, const bl_scene_needs *needs, unsigned dimensions) {
    fputs("what the scene does not need\n", out);
    fprintf(out, "  widths below %.3g and above %.3g units: no sample has them\n",
            needs->least_width, needs->most_width);
    if (needs->octaves_seen < needs->octaves)
        fprintf(out, "  octaves: %u of %u have a frequency of %.3g or more, which no pixel shows\n",
                needs->octaves - needs->octaves_seen, needs->octaves, needs->highest_frequency);
    else if (needs->octaves)
        fprintf(out, "  octaves: all %u are seen\n", needs->octaves);
    for (unsigned a = 0; a < dimensions; a++)
        if (!needs->varies[a])
            fprintf(out, "  the dimension %c: it is %.6g all over\n", axes[a], needs->least[a]);
}

static void print_advice(FILE *out, const bl_signal *signal, const bl_view *view,
                         const bl_advise_settings *settings, const bl_advice *advice) {
    const char *measure = settings->largest ? "largest" : "rms";
    bl_plain_text(out, signal->text);
    fputs(" under ", out);
    bl_plain_text(out, view->text);
    fprintf(out, ", %zu x %zu pixels, %s error at most %.4g\n\n", view->width, view->height,
            measure, settings->tolerance);
    print_choice(out, advice, settings->tolerance, measure);
    fputs("\n", out);
    print_needs(out, &advice->needs, signal->dimensions);
    fprintf(out, "\nreference: rms error below %.2g; %zu methods were measured\n",
            advice->alias.reference_error, advice->alias.count);
}

// --- the verb -----------------------------------------------------------------------------------

static bl_status advise(bl_call *call, const bl_signal *signal, const bl_view *view,
                        double tolerance) {
    const bl_advise_settings settings = settings_of(call, tolerance);
    const char *methods[BL_METHODS_MOST];
    size_t count = choose_methods(call, signal, methods);
    bl_advice advice;
    bl_progress(call, "measuring %zu methods on %s ...", count, signal->text);
    bl_status status = bl_advise(signal, view, methods, count, &settings, &advice, &call->message);
    bl_progress(call, NULL);
    if (status != BL_OK)
        return status;
    bl_alias_warn(call, signal, view, &advice.alias.constancy);
    if (bl_json_start(call))
        fill_json(call->json, signal, view, &settings, &advice);
    else if (!call->common.quiet)
        print_advice(call->out, signal, view, &settings, &advice);
    status = bl_verdict_status(advice.verdict);
    bl_advice_free(&advice);
    call->message.text[0] = '\0';
    return status;
}

static bl_status run_advise(bl_call *call) {
    bl_call_may_warn(call);
    const advise_options *options = call->settings;
    size_t size = options->size ? options->size : call->size == BL_QUICK ? 48 : 128;
    double tolerance;
    bl_view view;
    bl_signal *signal;
    bl_status status = read_tolerance(call, &tolerance);
    if (status == BL_OK)
        status = bl_view_open(options->view, size, size, &view, &call->message);
    if (status != BL_OK)
        return status;
    status = bl_call_open(call, call->operands.words[0], &signal);
    if (status == BL_OK) {
        status = advise(call, signal, &view, tolerance);
        bl_signal_free(signal);
    }
    bl_view_close(&view);
    return status;
}

#define AT(member) offsetof(advise_options, member)
static const bl_option options[] = {
    {"view", BL_OPTION_WORD, AT(view), "VIEW", .fallback = "plane",
     .help = "what the pixels see, as plane:height=1,fov=60"},
    {"tolerance", BL_OPTION_WORD, AT(tolerance), "E", .fallback = "1/255",
     .help = "the error allowed, of the linear luminance"},
    {"largest", BL_OPTION_FLAG, AT(largest),
     .help = "every pixel must be within the tolerance, not only the root mean square"},
    {"method", BL_OPTION_WORDS, AT(methods), "METHOD", .also = "filter",
     .help = "how to sample, as `alias` takes it; may be repeated (default: the usual methods)"},
    {"size", BL_OPTION_UNSIGNED, AT(size), "N", .minimum = 2, .maximum = 2048,
     .help = "pixels of each side of the image (default: 128; --quick 48)"},
    {0}};

const bl_verb bl_verb_advise = {
    .name = "advise",
    .operands = "SIGNAL",
    .summary = "the cheapest way to sample within a tolerance",
    .text =
        "Measures every usual method of sampling a texture, a primitive or a noise under a view, "
        "and tells the cheapest one whose error stays within the tolerance, what it costs, what "
        "the next cheaper one gets wrong and where, and what the scene does not need: widths that "
        "no sample has, octaves that no pixel shows, dimensions that do not vary. The exit status "
        "is 0 if a method is within the tolerance, 1 if the reference is not exact enough to tell, "
        "2 if none is.",
    .least = 1,
    .most = 1,
    .output_help = "write the report to PATH instead of stdout",
    .options = options,
    .settings_size = sizeof(advise_options),
    .run = run_advise,
};
