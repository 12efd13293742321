// SPDX-License-Identifier: MIT
#include "cli/alias_files.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>

#include "cli/csv.h"
#include "core/colourspace.h"
#include "core/image.h"
#include "reports/output.h"
#include "textures/texture.h"

typedef struct picture_files {
    bl_call *call;
    const bl_signal *signal;
    const bl_view *view;
    float *values; // room for the pixels of one image
} picture_files;

static bl_status write_image(const picture_files *files, const char *name, const char *what,
                             const char *ending, size_t channels, double black, double white) {
    const bl_attribute attributes[] = {{"bandlimit:version", BL_VERSION},
                                       {"bandlimit:signal", files->signal->text},
                                       {"bandlimit:view", files->view->text},
                                       {"bandlimit:filter", what}};
    const bl_image image = {.width = files->view->width,
                            .height = files->view->height,
                            .channels = channels,
                            .values = files->values,
                            .black = black,
                            .white = white,
                            .attributes = attributes,
                            .attribute_count = sizeof attributes / sizeof *attributes};
    char *path = bl_output_path(files->call->path, name, ending);
    bl_status status = path ? bl_image_write(path, &image, &files->call->message)
                            : bl_report(&files->call->message, BL_DEVICE, "out of memory");
    free(path);
    return status;
}

static bl_status write_colours(const picture_files *files, const char *name, const char *what,
                               const double *rgb) {
    const size_t count = 3 * files->view->width * files->view->height;
    for (size_t i = 0; i < count; i++)
        files->values[i] = (float)rgb[i];
    bl_status status = write_image(files, name, what, "exr", 3, 0, 0);
    for (size_t i = 0; i < count; i++)
        files->values[i] = (float)bl_srgb_encode(fmin(fmax(rgb[i], 0), 1)); // for the eye
    return status == BL_OK ? write_image(files, name, what, "png", 3, 0, 1) : status;
}

// The signed error of the luminance; grey is none, black and white the largest.
static bl_status write_error(const picture_files *files, const char *name, const bl_alias_row *row,
                             const bl_reference *reference) {
    const size_t count = files->view->width * files->view->height;
    for (size_t p = 0; p < count; p++)
        files->values[p] = (float)(bl_colour_component(&row->image[3 * p], 0) -
                                   bl_colour_component(&reference->rgb[3 * p], 0));
    bl_status status = write_image(files, name, row->method, "exr", 1, 0, 0);
    double scale = row->max_error > 0 ? row->max_error : 1;
    return status == BL_OK ? write_image(files, name, row->method, "png", 1, -scale, scale)
                           : status;
}

// The text of a method as the name of a file.
static void file_name(const char *method, const char *more, char *name, size_t size) {
    snprintf(name, size, "%.100s%s", method, more);
    for (; *name; name++)
        if (!isalnum((unsigned char)*name) && *name != '.')
            *name = '-';
}

// clang-format off
#define AT(member) .offset = offsetof(bl_alias_row, member)
static const bl_field fields[] = {
    {"filter", "method", BL_CELL_WORD, AT(method)},
    {"alias", "alias", BL_CELL_ESTIMATE, AT(alias), .digits = 3, .is_power = 1},
    {"blur", "blur", BL_CELL_ESTIMATE, AT(blur), .digits = 3, .is_power = 1},
    {"mse", "mse", BL_CELL_ESTIMATE, AT(mse), .digits = 3},
    {"psnr_db", "psnr db", BL_CELL_REAL, AT(psnr_db)},
    {"ssim", "ssim", BL_CELL_ESTIMATE, AT(ssim), .decimals = 4},
    {"max_error", "largest", BL_CELL_REAL, AT(max_error), .digits = 3},
    {"flicker", "flicker", BL_CELL_ESTIMATE, AT(flicker), .digits = 3, .is_power = 1},
    {"pops", NULL, BL_CELL_REAL, AT(pops)},
    {"ns_per_sample", "ns", BL_CELL_ESTIMATE, AT(ns_per_sample)},
    {"samples_per_pixel", NULL, BL_CELL_REAL, AT(samples)},
    {"first_alias_cycles_per_pixel", NULL, BL_CELL_REAL, AT(first_alias), .forms = BL_IN_JSON},
    {"predicted_alias", NULL, BL_CELL_REAL, AT(predicted_alias)},
    {"predicted_blur", NULL, BL_CELL_REAL, AT(predicted_blur)},
    {"error_spectrum", NULL, BL_CELL_LIST, AT(rings), .length = BL_ALIAS_RINGS},
    {0}};
#undef AT
// clang-format on

bl_table bl_alias_table(const bl_alias_result *result) {
    return BL_TABLE(fields, result->rows, result->count);
}

static bl_status write_table(const picture_files *files, const bl_alias_result *result) {
    bl_file file;
    const bl_table table = bl_alias_table(result);
    bl_status status =
        bl_output_create(files->call->path, "alias", "csv", &file, &files->call->message);
    if (status != BL_OK)
        return status;
    bl_csv_comment(file.stream, "version", BL_VERSION);
    bl_csv_comment(file.stream, "signal", files->signal->text);
    bl_csv_comment(file.stream, "view", files->view->text);
    fprintf(file.stream, "# size: %zux%zu\n", files->view->width, files->view->height);
    fprintf(file.stream, "# reference rms error: %.3g\n", result->reference_error);
    bl_table_csv(&table, file.stream);
    return bl_file_commit(&file, &files->call->message);
}

bl_status bl_alias_files_write(bl_call *call, const bl_signal *signal, const bl_view *view,
                               const bl_alias_result *result) {
    picture_files files = {call, signal, view, NULL};
    char name[160];
    bl_status status = bl_make_folder(call->path, &call->message);
    if (status != BL_OK)
        return status;
    files.values = malloc(3 * view->width * view->height * sizeof *files.values);
    status = files.values ? write_table(&files, result)
                          : bl_report(&call->message, BL_DEVICE, "out of memory");
    if (status == BL_OK)
        status = write_colours(&files, "reference", "converged", result->reference.rgb);
    for (size_t i = 0; i < result->count && status == BL_OK; i++) {
        file_name(result->rows[i].method, "", name, sizeof name);
        status = write_colours(&files, name, result->rows[i].method, result->rows[i].image);
        file_name(result->rows[i].method, "-error", name, sizeof name);
        if (status == BL_OK)
            status = write_error(&files, name, &result->rows[i], &result->reference);
    }
    free(files.values);
    return status;
}
