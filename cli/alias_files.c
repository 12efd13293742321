// SPDX-License-Identifier: MIT
#include "cli/alias_files.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/csv.h"
#include "core/image.h"
#include "reports/output.h"
#include "textures/texture.h"

typedef struct picture_files {
    bl_call *call;
    const bl_signal *signal;
    const bl_view *view;
    float *values; // room for the pixels of one image
} picture_files;

// The curve of IEC 61966-2-1, for the eye: a PNG is shown as it is.
static double srgb(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

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
        files->values[i] = (float)srgb(fmin(fmax(rgb[i], 0), 1));
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

static void write_estimate(FILE *out, const bl_estimate *estimate) {
    bl_csv_number(out, estimate->value), fputc(',', out);
    bl_csv_number(out, estimate->lower), fputc(',', out);
    bl_csv_number(out, estimate->upper), fputc(',', out);
}

static void write_row(FILE *out, const bl_alias_row *row) {
    bl_csv_word(out, row->method), fputc(',', out);
    write_estimate(out, &row->alias);
    write_estimate(out, &row->blur);
    write_estimate(out, &row->mse);
    bl_csv_number(out, row->psnr_db), fputc(',', out);
    write_estimate(out, &row->ssim);
    bl_csv_number(out, row->max_error), fputc(',', out);
    write_estimate(out, &row->flicker);
    bl_csv_number(out, row->pops), fputc(',', out);
    bl_csv_number(out, row->ns_per_sample), fputc(',', out);
    bl_csv_number(out, row->ns_lowest), fputc(',', out);
    bl_csv_number(out, row->ns_highest), fputc(',', out);
    bl_csv_number(out, row->samples), fputc(',', out);
    bl_csv_number(out, row->predicted_alias), fputc(',', out);
    bl_csv_number(out, row->predicted_blur), fputc('\n', out);
}

static bl_status write_table(const picture_files *files, const bl_alias_result *result) {
    bl_file file;
    bl_status status =
        bl_output_create(files->call->path, "alias", "csv", &file, &files->call->message);
    if (status != BL_OK)
        return status;
    bl_csv_comment(file.stream, "version", BL_VERSION);
    bl_csv_comment(file.stream, "signal", files->signal->text);
    bl_csv_comment(file.stream, "view", files->view->text);
    fprintf(file.stream, "# size: %zux%zu\n", files->view->width, files->view->height);
    fprintf(file.stream, "# reference rms error: %.3g\n", result->reference_error);
    fputs(
        "filter,alias,alias_lower,alias_upper,blur,blur_lower,blur_upper,mse,mse_lower,mse_upper,"
        "psnr_db,ssim,ssim_lower,ssim_upper,max_error,flicker,flicker_lower,flicker_upper,pops,"
        "ns_per_sample,ns_per_sample_lower,ns_per_sample_upper,samples_per_pixel,"
        "predicted_alias,predicted_blur\n",
        file.stream);
    for (size_t i = 0; i < result->count; i++)
        write_row(file.stream, &result->rows[i]);
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
