// SPDX-License-Identifier: MIT
#include "cli/spectral.h"

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

void bl_spectral_warn(bl_call *call, const bl_signal *signal, const bl_psd *psd, double allowed) {
    const bl_resolution found = bl_psd_resolution(signal, &psd->settings, allowed);
    const double most = 1e6; // of --rate
    char remedy[64];
    bl_call_may_warn(call);
    if (!(found.times > 1))
        return;
    if (found.rate <= most)
        snprintf(remedy, sizeof remedy, "--rate %.9g would do", found.rate);
    else
        snprintf(remedy, sizeof remedy, "no --rate up to %g would do", most);
    bl_call_warn(
        call,
        "%.3g samples a unit do not resolve '%s': of its variance %.2g or more lies beyond "
        "%.4g cycles per unit (Nyquist) and folds back; %s (%.2g allowed)",
        psd->settings.rate, signal->text, found.beyond, 0.5 * psd->settings.rate, remedy,
        found.allowed);
}

static const char *place_word(const bl_signal *signal, const bl_psd *psd) {
    return on_grid(signal) ? "grid" : bl_spectral_places[psd->settings.place == BL_PLACE_LATTICE];
}

// --- its values ---------------------------------------------------------------------------------

static const bl_psd *psd_of(const bl_table *table) {
    return table->rows;
}

static void find_place(const bl_table *table, size_t row, bl_cell *cell) {
    (void)row;
    cell->word = place_word(table->context, psd_of(table));
}

static void find_window(const bl_table *table, size_t row, bl_cell *cell) {
    (void)row;
    cell->word = bl_window_name(psd_of(table)->settings.window);
}

static void find_dof(const bl_table *table, size_t row, bl_cell *cell) {
    (void)row;
    cell->value = bl_psd_median_dof(psd_of(table));
}

static void find_peak(const bl_table *table, size_t row, bl_cell *cell) {
    (void)row;
    static const char *const powers[] = {"", "^2", "^3"};
    const bl_psd *psd = psd_of(table);
    size_t peak = bl_psd_peak(psd);
    if (psd->count == 0 || !(psd->psd[peak] > 0))
        return;
    snprintf(cell->text, sizeof cell->text, "%.4g cycles per unit, PSD %.4g per (cycle per unit)%s",
             psd->frequency[peak], psd->psd[peak], powers[psd->settings.dims - 1]);
    cell->word = cell->text;
}

static int has_axis(const void *row) {
    return ((const bl_psd *)row)->settings.dims < 3;
}

// clang-format off
#define AT(member) .offset = offsetof(bl_psd, member)
static const bl_field head_fields[] = {
    {"dims", NULL, BL_CELL_UNSIGNED, AT(settings.dims)},
    {"axis", NULL, BL_CELL_LIST, AT(settings.axis), .length = 3, .when = has_axis, .absent = 1},
    {"place", NULL, BL_CELL_WORD, .find = find_place},
    {"rate", NULL, BL_CELL_REAL, AT(settings.rate)},
    {"size", NULL, BL_CELL_COUNT, AT(settings.size)},
    {"averages", NULL, BL_CELL_COUNT, AT(settings.averages)},
    {"window", NULL, BL_CELL_WORD, .find = find_window},
    {"seed", NULL, BL_CELL_COUNT, AT(settings.seed)},
    {"level", NULL, BL_CELL_REAL, AT(settings.level)},
    {"dof", NULL, BL_CELL_REAL, .find = find_dof},
    {"mean", NULL, BL_CELL_REAL, AT(mean)},
    {"variance", "variance", BL_CELL_ESTIMATE, AT(variance), .digits = 6, .limits = ""},
    {"variance_theory", "theory", BL_CELL_REAL, AT(variance_theory), .digits = 6, .optional = 1},
    {"windowed_variance", "windowed", BL_CELL_REAL, AT(windowed_variance), .digits = 6,
     .unit = "(the sum of the PSD)"},
    {"peak", "peak", BL_CELL_WORD, .find = find_peak, .forms = BL_IN_TEXT, .optional = 1},
    {"parseval_residual", "Parseval", BL_CELL_REAL, AT(parseval_residual), .digits = 2,
     .unit = "residual"},
    {"inflation", NULL, BL_CELL_REAL, AT(inflation)},
    {"correlation", NULL, BL_CELL_REAL, AT(correlation)},
    {"broadening", NULL, BL_CELL_REAL, AT(broadening)},
    {0}};

static const bl_field bin_fields[] = {
    {"frequency", NULL, BL_CELL_REAL, AT(frequency)},
    {"psd", NULL, BL_CELL_REAL, AT(psd)},
    {"lower", NULL, BL_CELL_REAL, AT(lower)},
    {"upper", NULL, BL_CELL_REAL, AT(upper)},
    {"theory", NULL, BL_CELL_REAL, AT(theory)},
    {"dof", NULL, BL_CELL_REAL, AT(dof), .forms = BL_IN_CSV},
    {"dof_per_bin", NULL, BL_CELL_REAL, AT(dof), .forms = BL_IN_JSON},
    {"anisotropy_db", NULL, BL_CELL_REAL, AT(anisotropy_db), .optional = 1},
    {"anisotropy_floor_db", NULL, BL_CELL_REAL, AT(anisotropy_floor_db), .optional = 1,
     .forms = BL_IN_JSON},
    {0}};
#undef AT
// clang-format on

static bl_table head_of(const bl_signal *signal, const bl_psd *psd) {
    bl_table head = BL_RECORD(head_fields, psd);
    head.context = signal;
    head.level = psd->settings.level;
    return head;
}

static bl_table bins_of(const bl_psd *psd) {
    return (bl_table){.fields = bin_fields, .rows = psd, .count = psd->count};
}

static const char *const psd_units[] = {"value^2 per (cycle per unit), one-sided",
                                        "value^2 per (cycle per unit)^2, two-sided",
                                        "value^2 per (cycle per unit)^3, two-sided"};

void bl_spectral_json(json_t *object, const bl_signal *signal, const bl_psd *psd) {
    const bl_table head = head_of(signal, psd), bins = bins_of(psd);
    bl_json_set_text(object, "signal", signal->text);
    bl_record_json(object, &head, 0);
    bl_json_set_text(object, "frequency_unit", "cycles per unit (per cell for a noise)");
    bl_json_set_text(object, "psd_unit", psd_units[psd->settings.dims - 1]);
    bl_table_json_columns(object, &bins);
}

bl_status bl_spectral_csv(bl_call *call, const bl_signal *signal, const bl_psd *psd) {
    const bl_table head = head_of(signal, psd), bins = bins_of(psd);
    return bl_csv_write(call, signal->text, &head, &bins);
}

// --- in words -----------------------------------------------------------------------------------

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
    double dof = bl_psd_median_dof(psd);
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
    const bl_table head = head_of(signal, psd);
    print_settings(out, options, signal, psd);
    fputc('\n', out);
    bl_record_print(&head, out);
}
