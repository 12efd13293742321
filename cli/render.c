// SPDX-License-Identifier: MIT
//
// The verb `render`: an image of a slice.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/components.h"
#include "cli/json.h"
#include "aliasing/depth.h"
#include "cli/render_warning.h"
#include "core/plain.h"
#include "cli/verb.h"
#include "cli/words.h"
#include "core/grid.h"
#include "core/image.h"
#include "core/memory.h"
#include "spectra/theory.h"

typedef struct render_settings {
    uint64_t width, height, components;
    double scale;
    const char *at, *normal, *range, *bits;
} render_settings;

typedef struct slice_view {
    bl_grid grid; // of the pixels
    double spacing;
    double centre[BL_AXES], normal[3];
    double black, white;
    size_t components;
    int colour; // three components of one signal, linear red, green and blue
} slice_view;

static int is_png(const char *path) {
    return bl_ends_with(path, ".png");
}

// Refuses an ending that no writer knows before anything is computed.
static bl_status check_ending(const char *path, bl_message *message) {
    static const char *const endings[] = {".exr", ".png", ".tif", ".tiff"};
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (bl_ends_with(path, endings[i]))
            return BL_OK;
    return bl_report(message, BL_USAGE,
                     "-o %s: the ending names the format; use .exr, .png, .tif or .tiff", path);
}

// What the definition of the signal says of a picture of it; nothing for files and the user's own.
static bl_picture picture_of(const bl_signal *signal) {
    return signal->definition ? signal->definition->picture : (bl_picture){0};
}

// The defaults of an image are its own pixels; of a noise, 512 x 512 pixels over 16 cells; a
// texture says itself how much of it makes a picture.
static void settle_size(const render_settings *settings, const bl_signal *signal,
                        slice_view *view) {
    const bl_extent *extent = &signal->extent;
    size_t width = settings->width, height = settings->height;
    int sampled = extent->size[0] && extent->size[1];
    view->grid.width = width ? width : height ? height : sampled ? extent->size[0] : 512;
    view->grid.height = height ? height : width ? width : sampled ? extent->size[1] : 512;
    double across = settings->scale > 0            ? settings->scale
                    : sampled                      ? (double)extent->size[0] * extent->spacing[0]
                    : picture_of(signal).scale > 0 ? picture_of(signal).scale
                                                   : 16;
    view->spacing = across / (double)view->grid.width;
    for (int a = 0; a < BL_AXES; a++)
        view->centre[a] = picture_of(signal).at[a];
    if (sampled)
        for (int a = 0; a < 2; a++)
            view->centre[a] = 0.5 * ((double)extent->size[a] - 1) * extent->spacing[a];
}

// Lays the pixels out, row 0 at the top: to the right, down, and the normal are a right-handed
// system, so that the slice is seen along its normal.
static bl_status settle_plane(slice_view *view, bl_message *message) {
    double directions[3][BL_AXES];
    if (!bl_directions(2, view->normal, directions))
        return bl_report(message, BL_USAGE, "--normal: not a direction");
    double left = 0.5 * ((double)view->grid.width - 1), top = 0.5 * ((double)view->grid.height - 1);
    for (int a = 0; a < BL_AXES; a++) {
        view->grid.right[a] = view->spacing * directions[0][a];
        view->grid.down[a] = view->spacing * directions[1][a];
        view->grid.origin[a] =
            view->centre[a] - left * view->grid.right[a] - top * view->grid.down[a];
    }
    return BL_OK;
}

// Black and white, unless they are given. Textures are 0 to 1. A bound about 1 is shown as -1:1, so
// that pictures of most noises compare. A bound is what cannot be exceeded, which for sums of many
// terms lies far from what is: those are shown to four deviations from the mean.
static void settle_range(const bl_signal *signal, slice_view *view) {
    const bl_facts *facts = &signal->facts;
    double lower = facts->lower, upper = facts->upper, size = fmax(fabs(lower), fabs(upper));
    view->black = signal->functions->colour ? 0 : -1; // a colour lies in 0 to 1
    view->white = 1;
    if (signal->functions->colour || !isfinite(lower) || !isfinite(upper) || !(lower < upper))
        return;
    if (lower < 0 && size >= 0.5 && size <= 2)
        return;
    view->black = lower;
    view->white = upper;
    double reach = 4 * sqrt(facts->variance);
    if (size > 2 && reach > 0 && isfinite(facts->mean)) {
        view->black = fmax(lower, facts->mean - reach);
        view->white = fmin(upper, facts->mean + reach);
    }
}

// The axes that --at does not name: a solid noise is seen at a random depth, since its lattice
// planes are unlike all else; what a picture shows is not moved.
static void settle_depth(const bl_call *call, const bl_signal *signal, const bl_picture *picture,
                         slice_view *view) {
    const render_settings *settings = call->settings;
    const int stays = picture->normal[0] != 0 || picture->normal[1] != 0 || picture->normal[2] != 0;
    unsigned asked = settings->at ? 1 : 0;
    for (const char *c = settings->at; c && *c; c++)
        asked += *c == ',';
    for (unsigned a = asked; a < signal->dimensions && signal->dimensions > 2 && !stays; a++)
        if (a == 3 || view->normal[a] != 0)
            view->centre[a] = bl_depth_place(signal, a, call->common.seed);
}

static bl_status settle_view(bl_call *call, const bl_signal *signal, slice_view *view) {
    const render_settings *settings = call->settings;
    bl_status status = BL_OK;
    const bl_picture picture = picture_of(signal);
    // A component that is named is a grey value as any other; noise.component= is none of these.
    const char *text = call->operands.words[0];
    int colour =
        signal->functions->colour && !strstr(text, ":component=") && !strstr(text, ",component=");
    *view = (slice_view){
        .normal = {0, 0, 1}, .components = colour ? 3 : settings->components, .colour = colour};
    if (colour && settings->components > 1)
        return bl_report(
            &call->message, BL_MISMATCH,
            "--components %d: '%s' has a colour of its own; name one of its components "
            "with component= to draw others of its kind",
            (int)settings->components, signal->text);
    if (picture.normal[0] != 0 || picture.normal[1] != 0 || picture.normal[2] != 0)
        memcpy(view->normal, picture.normal, sizeof view->normal);
    settle_size(settings, signal, view);
    settle_range(signal, view);
    if (settings->at)
        status = bl_read_list("at", settings->at, 1, BL_AXES, bl_signal_far(signal), view->centre,
                              &call->message);
    if (status == BL_OK && settings->normal)
        status = bl_read_axis("normal", settings->normal, view->normal, &call->message);
    if (status == BL_OK && settings->range)
        status =
            bl_read_range("range", settings->range, 0, &view->black, &view->white, &call->message);
    if (status == BL_OK)
        settle_depth(call, signal, &picture, view);
    return status == BL_OK ? settle_plane(view, &call->message) : status;
}

typedef struct image_outcome {
    double minimum, maximum;
    size_t finite;  // values
    size_t clipped; // outside of the range
} image_outcome;

static image_outcome look(const float *values, size_t count, const slice_view *view) {
    image_outcome outcome = {.minimum = INFINITY, .maximum = -INFINITY};
    for (size_t i = 0; i < count; i++) {
        double value = (double)values[i];
        if (!isfinite(value))
            continue;
        outcome.finite++;
        outcome.minimum = fmin(outcome.minimum, value);
        outcome.maximum = fmax(outcome.maximum, value);
        outcome.clipped += value < view->black || value > view->white;
    }
    return outcome;
}

static void report(bl_call *call, const bl_signal *signal, const slice_view *view,
                   const image_outcome *outcome) {
    size_t count = view->grid.width * view->grid.height * view->components;
    json_t *object = bl_json_start(call);
    if (object) {
        bl_json_set_text(object, "signal", signal->text);
        bl_json_set_text(object, "path", call->path);
        bl_json_set_count(object, "width_pixels", view->grid.width);
        bl_json_set_count(object, "height_pixels", view->grid.height);
        bl_json_set_number(object, "spacing_units", view->spacing);
        bl_json_set_count(object, "components", view->components);
        bl_json_set_numbers(object, "centre", view->centre, signal->dimensions == 4 ? 4 : 3);
        bl_json_set_numbers(object, "normal", view->normal, 3);
        bl_json_set_number(object, "min", outcome->minimum);
        bl_json_set_number(object, "max", outcome->maximum);
        bl_json_set_count(object, "not_finite", count - outcome->finite);
        if (is_png(call->path)) {
            double range[2] = {view->black, view->white};
            bl_json_set_numbers(object, "range", range, 2);
            bl_json_set_count(object, "clipped", outcome->clipped);
        }
        if (signal->functions->colour)
            bl_json_set_text(object, "colour", view->colour ? "linear sRGB" : "none");
        return;
    }
    if (call->common.quiet)
        return;
    bl_plain_text(call->out, call->path);
    fprintf(call->out, ": %zu x %zu pixels, %g unit%s between them, values ", view->grid.width,
            view->grid.height, view->spacing, view->spacing == 1 ? "" : "s");
    bl_plain_number(call->out, outcome->minimum, 6);
    fputs(" to ", call->out);
    bl_plain_number(call->out, outcome->maximum, 6);
    fputc('\n', call->out);
    if (signal->dimensions > 2) {
        static const char axes[] = "xyzw";
        fputs("the middle is at ", call->out);
        for (unsigned k = 0; k < signal->dimensions; k++)
            fprintf(call->out, "%s%c = %.10g", k ? ", " : "", axes[k], view->centre[k] + 0.0);
        fputc('\n', call->out);
    }
    if (is_png(call->path))
        fprintf(call->out, "black is %g, white is %g%s; %zu value%s clipped\n", view->black + 0.0,
                view->white + 0.0, view->colour ? ", on the curve of sRGB" : "", outcome->clipped,
                outcome->clipped == 1 ? " was" : "s were");
    size_t missing = count - outcome->finite;
    if (missing && view->components > 1)
        fprintf(call->out, "%zu of %zu values %s missing\n", missing, count,
                missing == 1 ? "is" : "are");
    else if (missing)
        fprintf(call->out, "%zu pixel%s no value\n", missing, missing == 1 ? " has" : "s have");
}

static bl_status write_image(bl_call *call, const bl_signal *signal, const slice_view *view,
                             const float *values) {
    char centre[128], normal[128], components[32];
    int length = snprintf(centre, sizeof centre, "%.17g %.17g %.17g", view->centre[0],
                          view->centre[1], view->centre[2]);
    if (signal->dimensions == 4)
        snprintf(centre + length, sizeof centre - (size_t)length, " %.17g", view->centre[3]);
    snprintf(components, sizeof components, "%zu", view->components);
    snprintf(normal, sizeof normal, "%.17g %.17g %.17g", view->normal[0], view->normal[1],
             view->normal[2]);
    const bl_attribute attributes[] = {{"bandlimit:version", BL_VERSION},
                                       {"bandlimit:signal", signal->text},
                                       {"bandlimit:centre", centre},
                                       {"bandlimit:normal", normal},
                                       {"bandlimit:components", components}};
    const render_settings *settings = call->settings;
    const bl_image image = {.width = view->grid.width,
                            .height = view->grid.height,
                            .channels = view->components,
                            .values = values,
                            .spacing = view->spacing,
                            .black = view->black,
                            .white = view->white,
                            .bits = strcmp(settings->bits, "16") == 0 ? 16 : 8,
                            .srgb = view->colour,
                            .attributes = attributes,
                            .attribute_count = sizeof attributes / sizeof *attributes};
    return bl_image_write(call->path, &image, &call->message);
}

// Fills pixels of as many values as there are components; `plane` holds one of them.
static void fill(bl_call *call, const bl_vector_signal *vector, const bl_grid *grid, float *plane,
                 float *values) {
    const size_t pixels = grid->width * grid->height;
    for (size_t k = 0; k < vector->count; k++) {
        bl_grid_fill(vector->of[k], grid, bl_call_threads(call), plane);
        for (size_t i = 0; i < pixels && plane != values; i++)
            values[vector->count * i + k] = plane[i];
    }
}

static bl_status check_memory(const bl_grid *grid, double bytes, bl_message *message) {
    double available = (double)bl_memory_available();
    if (bytes <= available)
        return BL_OK;
    return bl_report(message, BL_MISMATCH,
                     "an image of %zu x %zu pixels takes %s of memory (%.0f bytes), and %s are "
                     "available; use a smaller --width or --height",
                     grid->width, grid->height, bl_plain_bytes(bytes).text, bytes,
                     bl_plain_bytes(available).text);
}

// An image of nothing is a mistake in the place that was asked for.
static bl_status report_nothing(const bl_signal *signal, bl_message *message) {
    const bl_extent *extent = &signal->extent;
    if (!extent->size[0] || !extent->size[1])
        return bl_report(message, BL_MISMATCH,
                         "'%s' has no value anywhere in this slice; see --at and --scale",
                         signal->text);
    return bl_report(message, BL_MISMATCH,
                     "this slice lies wholly outside of '%s', which spans 0 to %g and 0 to %g "
                     "units; see --at and --scale",
                     signal->text, (double)(extent->size[0] - 1) * extent->spacing[0],
                     (double)(extent->size[1] - 1) * extent->spacing[1]);
}

static bl_status fill_and_write(bl_call *call, const bl_signal *signal, slice_view *view,
                                const bl_vector_signal *vector, float *plane, float *values) {
    bl_progress(call, "rendering %s ...", signal->text);
    if (view->colour) {
        const double own = bl_signal_own_width(signal), width[BL_AXES] = {own, own, own, own};
        bl_grid_fill_colour(signal, &view->grid, width, bl_call_threads(call), values);
    } else {
        fill(call, vector, &view->grid, plane, values);
    }
    const render_settings *settings = call->settings;
    size_t count = view->components * view->grid.width * view->grid.height;
    image_outcome outcome = look(values, count, view);
    // An image states no bound; pictures have 0 to 1, and only rendered noise has negative values.
    if (!settings->range && signal->extent.size[0] && outcome.minimum >= 0) {
        view->black = 0;
        outcome = look(values, count, view);
    }
    bl_status status = bl_call_complaints(call, BL_OK); // before an image of a dead program
    if (status == BL_OK && outcome.finite == 0)
        status = report_nothing(signal, &call->message);
    else if (status == BL_OK)
        status = write_image(call, signal, view, values);
    if (status == BL_OK)
        bl_render_warn(call, signal, &view->grid, view->spacing);
    if (status == BL_OK)
        report(call, signal, view, &outcome);
    return status;
}

static bl_status render(bl_call *call, const bl_signal *signal) {
    slice_view view;
    bl_status status = settle_view(call, signal, &view);
    if (status != BL_OK)
        return status;
    // The writer holds a second copy at most; 2^30 * 2^30 * 36 fits in a double and not in memory.
    const size_t count = view.components;
    double bytes = (8.0 * (double)count + (count > 1 ? 4 : 0)) * (double)view.grid.width *
                   (double)view.grid.height;
    status = check_memory(&view.grid, bytes, &call->message);
    if (status != BL_OK)
        return status;
    size_t pixels = view.grid.width * view.grid.height;
    float *values = malloc(count * pixels * sizeof *values);
    float *plane = count > 1 ? malloc(pixels * sizeof *plane) : values;
    bl_vector_signal vector = {.count = 1};
    if (!values || !plane)
        status = bl_report(&call->message, BL_DEVICE, "out of memory: the image takes %s",
                           bl_plain_bytes(bytes).text);
    else
        status = bl_vector_signal_open(signal, view.colour ? 1 : count, &vector, &call->message);
    if (status == BL_OK)
        status = fill_and_write(call, signal, &view, &vector, plane, values);
    bl_vector_signal_free(&vector);
    if (plane != values)
        free(plane);
    free(values);
    return status;
}

static bl_status run_render(bl_call *call) {
    if (!call->path)
        return bl_report(&call->message, BL_USAGE, "render needs -o FILE (.exr, .png or .tif)");
    bl_signal *signal;
    const render_settings *settings = call->settings;
    if (is_png(call->path) && (settings->components == 2 || settings->components == 4))
        return bl_report(&call->message, BL_USAGE,
                         "--components %d: a PNG would take the last one for opacity; use 1 or 3, "
                         "or write .exr or .tif",
                         (int)settings->components);
    bl_status status = check_ending(call->path, &call->message);
    if (status == BL_OK)
        status = bl_output_check(call->path, &call->message);
    if (status == BL_OK)
        status = bl_call_open_seeded(call, &signal);
    if (status != BL_OK)
        return status;
    status = render(call, signal);
    bl_signal_free(signal);
    return status;
}

static const char *const bits[] = {"8", "16", NULL};

#define AT(member) offsetof(render_settings, member)
static const bl_option options[] = {
    {"width", BL_OPTION_UNSIGNED, AT(width), "N", .minimum = 1, .maximum = 1 << 30,
     .help = "pixels across (default: the height, the image's own, or 512)"},
    {"height", BL_OPTION_UNSIGNED, AT(height), "N", .minimum = 1, .maximum = 1 << 30,
     .help = "pixels down (default: the width, the image's own, or 512)"},
    {"scale", BL_OPTION_REAL, AT(scale), "CELLS", .minimum = 1e-12, .maximum = 1e12,
     .help =
         "units across the width (default: 16, the whole of an image, or what shows a texture)"},
    {"at", BL_OPTION_WORD, AT(at), "X,Y,Z,W",
     .help = "the point at the centre; of a noise in four dimensions W, its time, too (default: "
             "0,0 and of a solid noise a random depth of the seed, the middle of an image, or as "
             "suits a texture)"},
    {"normal", BL_OPTION_WORD, AT(normal), "AXIS",
     .help = "normal of the slice, along which it is seen: x, y, z or DX,DY,DZ (default: z, or as "
             "suits a texture)"},
    {"range", BL_OPTION_WORD, AT(range), "LO:HI",
     .help = "PNG: the values of black and white (default: 0:1 for a texture, and for an image "
             "without negative values; -1:1 where no bounds are stated, or bounds from 0.5 to 2 "
             "either way; else the stated bounds, but at most 4 deviations from the mean)"},
    {"bits", BL_OPTION_CHOICE, AT(bits), "N", .fallback = "8", .choices = bits,
     .help = "PNG: bits a pixel"},
    BL_COMPONENTS_OPTION(render_settings, components),
    {0}};
#undef AT

const bl_verb bl_verb_render = {
    .name = "render",
    .operands = "SIGNAL -o FILE",
    .summary = "an image of a slice (EXR, PNG, TIFF by the name)",
    .text =
        "Of a slice with the normal z, x runs to the right and y downwards, from row 0 at the top; "
        "so do s and t of a texture, and the columns and rows of an image. A pixel is the value at "
        "its middle; a warning tells where that is too coarse, and what would do. EXR and TIFF "
        "hold the values as floats; PNG holds codes proportional to the value within the range. "
        "Textures are drawn in colour, linear in EXR and TIFF, by the curve of sRGB in "
        "PNG, unless component= names one of its components. --components says how many values a "
        "pixel has: three are red, green and blue. The file keeps the settings as attributes.",
    .least = 1,
    .most = 1,
    .output = BL_OUTPUT_FOLDER,
    .output_help = "the image; its ending names the format: .exr, .png, .tif or .tiff",
    .options = options,
    .settings_size = sizeof(render_settings),
    .run = run_render,
};
