// SPDX-License-Identifier: MIT
#include "cli/spectral.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/csv.h"
#include "cli/json.h"
#include "core/plain.h"
#include "cli/words.h"

const char *const bl_spectral_places[] = {"random", "lattice", NULL};

static int on_grid(const bl_signal *signal) {
    return signal->extent.size[0] != 0;
}

bl_status bl_spectral_settings(bl_call *call, const bl_spectral *options, const bl_signal *signal,
                               bl_psd_settings *settings) {
    unsigned dims = (unsigned)options->dims;
    bl_status status = BL_OK;
    *settings = bl_psd_default_settings(dims);
    settings->rate = options->rate;
    settings->size = options->size;
    settings->averages =
        options->averages ? options->averages : bl_psd_usual_averages(signal, dims, call->size);
    settings->level = options->level;
    settings->threads = bl_call_threads(call);
    if (call->common.seed_word)
        settings->seed = call->common.seed;
    if (options->place && on_grid(signal))
        return bl_report(&call->message, BL_MISMATCH,
                         "--place %s: '%s' is measured on its own samples; leave --place out",
                         options->place, signal->text);
    if (options->place && strcmp(options->place, "lattice") == 0)
        settings->place = BL_PLACE_LATTICE;
    if (options->window)
        status = bl_window_read(options->window, &settings->window, &call->message);
    if (status == BL_OK && options->axis)
        status = bl_read_axis("axis", options->axis, settings->axis, &call->message);
    return status;
}

bl_status bl_spectral_measure(bl_call *call, const bl_spectral *options, const bl_signal *signal,
                              bl_psd *psd) {
    bl_psd_settings settings;
    bl_status status = bl_spectral_settings(call, options, signal, &settings);
    if (status != BL_OK)
        return status;
    bl_progress(call, "measuring %s ...", signal->text);
    return bl_psd_measure(signal, &settings, psd, &call->message);
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double bl_spectral_dof(const bl_psd *psd) {
    double *sorted = malloc((psd->count + 1) * sizeof *sorted), median = NAN;
    if (!sorted)
        return NAN;
    memcpy(sorted, psd->dof, psd->count * sizeof *sorted);
    qsort(sorted, psd->count, sizeof *sorted, ascending);
    median = psd->count ? sorted[psd->count / 2] : NAN;
    free(sorted);
    return median;
}

static const char *place_word(const bl_signal *signal, const bl_psd *psd) {
    return on_grid(signal) ? "grid" : bl_spectral_places[psd->settings.place == BL_PLACE_LATTICE];
}

void bl_spectral_json(json_t *object, const bl_signal *signal, const bl_psd *psd) {
    const bl_psd_settings *used = &psd->settings;
    bl_json_set_text(object, "signal", signal->text);
    bl_json_set_count(object, "dims", used->dims);
    if (used->dims < 3)
        bl_json_set_numbers(object, "axis", used->axis, 3);
    bl_json_set_text(object, "place", place_word(signal, psd));
    bl_json_set_number(object, "rate", used->rate);
    bl_json_set_count(object, "size", used->size);
    bl_json_set_count(object, "averages", used->averages);
    bl_json_set_text(object, "window", bl_window_name(used->window));
    bl_json_set_count(object, "seed", used->seed);
    bl_json_set_number(object, "level", used->level);
    bl_json_set_number(object, "dof", bl_spectral_dof(psd));
    bl_json_set_number(object, "mean", psd->mean);
    bl_json_set_estimate(object, "variance", &psd->variance);
    bl_json_set_number(object, "windowed_variance", psd->windowed_variance);
    bl_json_set_number(object, "variance_theory", psd->variance_theory);
    bl_json_set_number(object, "parseval_residual", psd->parseval_residual);
    bl_json_set_number(object, "inflation", psd->inflation);
    bl_json_set_number(object, "correlation", psd->correlation);
    bl_json_set_number(object, "broadening", psd->broadening);
    bl_json_set_text(object, "frequency_unit", "cycles per unit (per cell for a noise)");
    bl_json_set_text(object, "psd_unit",
                     used->dims == 1   ? "value^2 per (cycle per unit), one-sided"
                     : used->dims == 2 ? "value^2 per (cycle per unit)^2, two-sided"
                                       : "value^2 per (cycle per unit)^3, two-sided");
    bl_json_set_numbers(object, "frequency", psd->frequency, psd->count);
    bl_json_set_numbers(object, "psd", psd->psd, psd->count);
    bl_json_set_numbers(object, "lower", psd->lower, psd->count);
    bl_json_set_numbers(object, "upper", psd->upper, psd->count);
    bl_json_set_numbers(object, "theory", psd->theory, psd->count);
    bl_json_set_numbers(object, "dof_per_bin", psd->dof, psd->count);
    if (psd->anisotropy_db) {
        bl_json_set_numbers(object, "anisotropy_db", psd->anisotropy_db, psd->count);
        bl_json_set_numbers(object, "anisotropy_floor_db", psd->anisotropy_floor_db, psd->count);
    }
}

static void write_head(FILE *out, const bl_signal *signal, const bl_psd *psd) {
    const bl_psd_settings *used = &psd->settings;
    char text[256];
    bl_csv_comment(out, "bandlimit spectrum", BL_VERSION);
    bl_csv_comment(out, "signal", signal->text);
    snprintf(
        text, sizeof text,
        "dims %u, axis %.9g %.9g %.9g, rate %.9g, size %zu, averages %zu, window %s, place %s, "
        "seed %llu, level %g",
        used->dims, used->axis[0], used->axis[1], used->axis[2], used->rate, used->size,
        used->averages, bl_window_name(used->window), place_word(signal, psd),
        (unsigned long long)used->seed, used->level);
    bl_csv_comment(out, "settings", text);
    snprintf(text, sizeof text, "%.9g, from %.9g to %.9g; parseval residual %.3g",
             psd->variance.value, psd->variance.lower, psd->variance.upper, psd->parseval_residual);
    bl_csv_comment(out, "variance", text);
    bl_csv_comment(out, "units",
                   "frequency in cycles per unit, psd in value^2 per (cycle per "
                   "unit)^dims, one-sided for dims 1");
}

bl_status bl_spectral_csv(bl_call *call, const bl_signal *signal, const bl_psd *psd) {
    bl_file file;
    bl_status status = bl_csv_open(call, &file);
    if (status != BL_OK)
        return status;
    write_head(file.stream, signal, psd);
    fprintf(file.stream, "frequency,psd,lower,upper,theory,dof%s\n",
            psd->anisotropy_db ? ",anisotropy_db" : "");
    for (size_t i = 0; i < psd->count; i++) {
        bl_csv_number(file.stream, psd->frequency[i]), fputc(',', file.stream);
        bl_csv_number(file.stream, psd->psd[i]), fputc(',', file.stream);
        bl_csv_number(file.stream, psd->lower[i]), fputc(',', file.stream);
        bl_csv_number(file.stream, psd->upper[i]), fputc(',', file.stream);
        bl_csv_number(file.stream, psd->theory ? psd->theory[i] : NAN), fputc(',', file.stream);
        bl_csv_number(file.stream, psd->dof[i]),
            fputc(psd->anisotropy_db ? ',' : '\n', file.stream);
        if (psd->anisotropy_db)
            bl_csv_number(file.stream, psd->anisotropy_db[i]), fputc('\n', file.stream);
    }
    return bl_csv_close(call, &file);
}

// What of an image or a volume was measured: ", all 32 rows of the image", ", 3 patches ...".
static void print_pieces(FILE *out, const bl_signal *signal, const bl_psd_settings *used) {
    const size_t *size = signal->extent.size;
    unsigned along = used->axis[0] != 0 ? 0 : used->axis[1] != 0 ? 1 : 2;
    size_t lines = 1;
    for (unsigned a = 0; a < BL_AXES; a++)
        lines *= a != along && size[a] ? size[a] : 1;
    const char *word = along == 0 ? "row" : along == 1 ? "column" : "z line";
    const char *thing = size[2] ? "volume" : "image";
    const char *plural = bl_plural(used->averages);
    if (used->dims == 1 && used->size == size[along] && used->averages == lines)
        fprintf(out, ", all %zu %s%s of the %s\n", lines, word, bl_plural(lines), thing);
    else if (used->dims == 1 && used->size == size[along])
        fprintf(out, ", %zu of the %zu %s%s of the %s\n", used->averages, lines, word,
                bl_plural(lines), thing);
    else if (used->dims == 1)
        fprintf(out, ", %zu segment%s of the %ss of the %s\n", used->averages, plural, word, thing);
    else
        fprintf(out, ", %zu patch%s the %s\n", used->averages,
                used->averages == 1 ? " that spans" : "es that span", thing);
}

static size_t find_peak(const bl_psd *psd) {
    size_t peak = 0;
    for (size_t i = 1; i < psd->count; i++)
        if (!(psd->psd[i] <= psd->psd[peak]))
            peak = i;
    return peak;
}

// How it was sampled, in the first two lines, and a third if fewer averages exist than are wanted.
static void print_settings(FILE *out, const bl_spectral *options, const bl_signal *signal,
                           const bl_psd *psd) {
    static const char *const shapes[] = {"along a line in direction", "in slices with normal",
                                         "in volumes"};
    const bl_psd_settings *used = &psd->settings;
    bl_plain_text(out, signal->text);
    fprintf(out, " %s", shapes[used->dims - 1]);
    if (used->dims < 3)
        fprintf(out, " (%g, %g, %g)", used->axis[0], used->axis[1], used->axis[2]);
    if (on_grid(signal))
        print_pieces(out, signal, used);
    else
        fprintf(out, ", %s places\n", place_word(signal, psd));
    double dof = bl_spectral_dof(psd);
    fprintf(out,
            "%zu samples an axis, %g per unit: up to %g cycles per unit (Nyquist)\n"
            "%zu average%s; %s window; %.*f degrees of freedom a bin\n",
            used->size, used->rate, 0.5 * used->rate, used->averages, bl_plural(used->averages),
            bl_window_name(used->window), dof < 100, dof);
    if (options->averages > used->averages)
        fprintf(out, "--average %llu is more than there is: the image has %zu\n",
                (unsigned long long)options->averages, used->averages);
}

void bl_spectral_print(FILE *out, const bl_spectral *options, const bl_signal *signal,
                       const bl_psd *psd) {
    static const char *const units[] = {"", "^2", "^3"};
    print_settings(out, options, signal, psd);
    fputs("\nvariance       ", out);
    bl_plain_estimate(out, &psd->variance, psd->settings.level, 6);
    if (isfinite(psd->variance_theory))
        fprintf(out, "   theory %.6g", psd->variance_theory);
    fputs("\nwindowed       ", out);
    bl_plain_number(out, psd->windowed_variance, 6);
    fputs(" (the sum of the PSD)", out);
    size_t peak = find_peak(psd);
    if (psd->count && psd->psd[peak] > 0)
        fprintf(out, "\npeak           %.4g cycles per unit, PSD %.4g per (cycle per unit)%s",
                psd->frequency[peak], psd->psd[peak], units[psd->settings.dims - 1]);
    fputs("\nParseval       residual ", out);
    bl_plain_number(out, psd->parseval_residual, 2);
    fputc('\n', out);
}
