// SPDX-License-Identifier: MIT
//
// peachey-2.37: the power spectra of six noises, along a line with the closed form behind the
// measurement, and in four readings side by side. Its measurements stand in six_spectra.c, its
// claims in six_claims.c.
#include <math.h>

#include "reports/figures/six_spectra.h"

static const double lowest_db = -200; // an empty bin, far below what is drawn

static double db_of(double density, double reference) {
    return density > 0 ? fmax(10 * log10(density / reference), lowest_db) : lowest_db;
}

// The columns of one noise.
enum { MEASURED, LOWER, UPPER, THEORY, ERROR, ERROR_LOWER, ERROR_UPPER, KINDS };
static const char *const kind_names[KINDS] = {"",       "_lower",       "_upper",      "_theory",
                                              "_error", "_error_lower", "_error_upper"};

// Fills the columns of one spectrum: power by frequency, in dB of the total variance per cycle per
// cell. For rings and shells the density times measure / width is the power by radius. The error is
// measured minus closed form in dB; its band is where 95 % of the bins lie if the closed form is
// true: the interval of the measured density about itself, turned round.
static void fill_columns(const bl_psd *psd, double *columns, size_t count) {
    double variance = psd->variance.value;
    for (size_t b = 0; b < count; b++) {
        double by_radius = psd->measure[b] / psd->width[b];
        columns[MEASURED * count + b] = db_of(psd->psd[b] * by_radius, variance);
        columns[LOWER * count + b] = db_of(psd->lower[b] * by_radius, variance);
        columns[UPPER * count + b] = db_of(psd->upper[b] * by_radius, variance);
        columns[THEORY * count + b] =
            psd->theory ? db_of(psd->theory[b] * by_radius, variance) : NAN;
        if (!psd->theory)
            continue;
        columns[ERROR * count + b] = db_of(psd->psd[b], psd->theory[b]);
        columns[ERROR_LOWER * count + b] = db_of(psd->psd[b], psd->upper[b]);
        columns[ERROR_UPPER * count + b] = db_of(psd->psd[b], psd->lower[b]);
    }
}

static void write_reading(bl_run *run, const bl_six_spectra *spectra, int reading) {
    const bl_psd *const *psd = spectra->psd[reading];
    size_t count = psd[0]->count;
    double *values = bl_run_memory(run, BL_SIX * KINDS * count, sizeof *values);
    bl_column columns[1 + BL_SIX * KINDS];
    size_t used = 0;
    columns[used++] = (bl_column){"frequency_cycles_per_cell", psd[0]->frequency, NULL};
    for (size_t i = 0; i < BL_SIX; i++) {
        double *own = values + i * KINDS * count;
        fill_columns(psd[i], own, count);
        for (size_t k = 0; k < KINDS; k++)
            if (k < THEORY || psd[i]->theory)
                columns[used++] =
                    (bl_column){bl_run_text(run, "%s%s_db", bl_six_names[i], kind_names[k]),
                                own + k * count, NULL};
    }
    bl_run_csv(run, bl_run_text(run, "spectra-%s", bl_reading_names[reading]),
               bl_run_text(run, "power spectra %s, dB of the total variance per cycle per cell",
                           bl_reading_words[reading]),
               columns, used, count);
}

static bl_plot plot_of(const char *title, const bl_panel *panels, const bl_limit *limit) {
    return (bl_plot){.title = title,
                     .x = {"frequency, cycles per lattice cell", 0, 3, 0.5},
                     .y = {"power density, dB re (variance / (cycle per cell))", -80, 10, 20},
                     .panels = panels,
                     .panel_count = BL_SIX,
                     .columns = 3,
                     .aspect = 0.8,
                     .limits = limit,
                     .limit_count = 1};
}

enum { DC = 1 }; // the bins not drawn: its density is not doubled, and the mean is removed

static const bl_limit band_end = {1, 1, "band limit 1"};

static void plot_lines(bl_run *run, const bl_six_spectra *spectra) {
    static const char file[] = "spectra-line.csv", x[] = "frequency_cycles_per_cell";
    bl_series series[BL_SIX][3];
    bl_panel panels[BL_SIX];
    for (int i = 0; i < BL_SIX; i++) {
        const char *name = bl_six_names[i];
        int theory = spectra->psd[BL_READING_LINE][i]->theory != NULL;
        series[i][0] = (bl_series){BL_STROKE_BAND,
                                   BL_INK_MEASURED,
                                   file,
                                   x,
                                   bl_run_text(run, "%s_lower_db", name),
                                   bl_run_text(run, "%s_upper_db", name),
                                   "95 % band",
                                   DC};
        series[i][1] =
            (bl_series){BL_STROKE_THIN, BL_INK_MEASURED, file, x, bl_run_text(run, "%s_db", name),
                        NULL,           "measured",      DC};
        series[i][2] = (bl_series){BL_STROKE_DASHED,
                                   BL_INK_THEORY,
                                   file,
                                   x,
                                   bl_run_text(run, "%s_theory_db", name),
                                   NULL,
                                   "closed form",
                                   DC};
        panels[i] = (bl_panel){name, series[i], theory ? 3 : 2, NULL};
    }
    const bl_plot plot =
        plot_of("Where in frequency does the power of the six noises lie?", panels, &band_end);
    bl_run_plot(
        run, "spectra-line", &plot,
        "Six power spectra along a line at a random place, each with its 95 % band and the closed "
        "form, dashed, as the window sees it. All fall steeply towards frequency 1 and go on in "
        "side lobes beyond. On this scale the three lie upon each other; the next plot takes the "
        "closed form away. Lines begin at the first frequency above 0.");
}

// A round number above the reach of nearly all points: four standard errors of the widest band.
static double error_reach(const bl_six_spectra *spectra, double highest) {
    static const double round_db[] = {0.1, 0.2, 0.4, 0.8, 1.6, 3.2, 6.4};
    double widest = 0;
    for (int i = 0; i < BL_SIX; i++) {
        const bl_psd *psd = spectra->psd[BL_READING_LINE][i];
        for (size_t b = DC; b < psd->count && psd->frequency[b] <= highest; b++)
            widest = fmax(widest, -db_of(psd->lower[b], psd->psd[b]));
    }
    size_t k = 0;
    while (k + 1 < sizeof round_db / sizeof *round_db && round_db[k] < 2 * widest)
        k++;
    return round_db[k];
}

static void plot_errors(bl_run *run, const bl_six_spectra *spectra) {
    static const char file[] = "spectra-line.csv", x[] = "frequency_cycles_per_cell";
    bl_series series[BL_SIX][2];
    bl_panel panels[BL_SIX];
    size_t panel_count = 0;
    for (int i = 0; i < BL_SIX; i++) {
        const char *name = bl_six_names[i];
        if (!spectra->psd[BL_READING_LINE][i]->theory)
            continue;
        series[i][0] = (bl_series){.stroke = BL_STROKE_BAND,
                                   .ink = BL_INK_THEORY,
                                   .file = file,
                                   .x = x,
                                   .y = bl_run_text(run, "%s_error_lower_db", name),
                                   .upper = bl_run_text(run, "%s_error_upper_db", name),
                                   .label = "where 95 % of the bins belong",
                                   .skip = DC};
        series[i][1] = (bl_series){.stroke = BL_STROKE_POINTS,
                                   .ink = BL_INK_MEASURED,
                                   .file = file,
                                   .x = x,
                                   .y = bl_run_text(run, "%s_error_db", name),
                                   .label = "measured minus closed form",
                                   .skip = DC};
        panels[panel_count++] = (bl_panel){name, series[i], 2, NULL};
    }
    if (panel_count == 0)
        return;
    const bl_limit zero = {0, 0, NULL};
    bl_plot plot = plot_of("Do the measured spectra agree with their closed forms?", panels, &zero);
    double reach = error_reach(spectra, plot.x.to);
    plot.panel_count = panel_count;
    plot.y = (bl_axis){
        .label = "measured minus closed form, dB", .from = -reach, .to = reach, .tick = reach / 2};
    bl_run_plot(run, "errors-line", &plot,
                "Measured minus closed form of the spectra along a line at a random place, a point "
                "for each frequency, over the band in which 95 % of the points belong if the "
                "closed form is true: one point in twenty lies outside of it by chance. Neighbours "
                "are alike because of the window; and bins a whole cycle apart hold the same "
                "lattice numbers, so that the points of a value noise repeat with the period 1.");
}

static void plot_readings(bl_run *run) {
    static const bl_ink inks[BL_READINGS] = {BL_INK_MEASURED, BL_INK_FOURTH, BL_INK_SECOND,
                                             BL_INK_THIRD};
    static const char *const labels[BL_READINGS] = {"line, random place", "line, lattice edge",
                                                    "slice, by radius", "volume, by radius"};
    bl_series series[BL_SIX][BL_READINGS];
    bl_panel panels[BL_SIX];
    for (int i = 0; i < BL_SIX; i++) {
        for (int r = 0; r < BL_READINGS; r++)
            series[i][r] = (bl_series){BL_STROKE_THIN,
                                       inks[r],
                                       bl_run_text(run, "spectra-%s.csv", bl_reading_names[r]),
                                       "frequency_cycles_per_cell",
                                       bl_run_text(run, "%s_db", bl_six_names[i]),
                                       NULL,
                                       labels[r],
                                       DC};
        panels[i] = (bl_panel){bl_six_names[i], series[i], BL_READINGS, NULL};
    }
    const bl_plot plot = plot_of("How much do the spectra depend on where and how they are read?",
                                 panels, &band_end);
    bl_run_plot(
        run, "readings", &plot,
        "The same six noises read in four ways: along a line at a random place, along a lattice "
        "edge, and by radial frequency in a slice and in a volume. The more dimensions, the higher "
        "the frequencies that carry the power. Where one of the two lines is not seen, it lies "
        "under the other. The curves of the volume end at frequency 2, the highest that its 4 "
        "samples a cell hold. In a slice and in a volume the curve falls towards frequency 0 for a "
        "reason of geometry: it is the power on the whole ring or shell, whose length grows with "
        "the radius and whose area with its square.");
}

static void run_figure(bl_run *run) {
    const bl_gallery six = bl_six_open(run);
    const bl_six_spectra spectra = bl_six_spectra_measure(run, &six);
    for (int r = 0; r < BL_READINGS; r++)
        write_reading(run, &spectra, r);
    plot_lines(run, &spectra);
    plot_errors(run, &spectra);
    plot_readings(run);
    bl_six_spectra_claim(run, &spectra);
}

static const bl_term terms[] = {
    {"power density",
     "power by frequency, in dB of the variance of the noise spread over one cycle per cell: a "
     "spectrum that is flat from 0 to 1 reads 0 dB there"},
    {"share of the variance",
     "the power between two frequencies over that of the whole spectrum, from 0 to 1; the spectrum "
     "sums to the variance of the samples under the window"},
    {"octave", "a doubling of frequency: 0.5 to 1, 0.25 to 0.5, 0.125 to 0.25, and what is below"},
    {0}};

BL_FIGURE_DESCRIPTOR(peachey_2_37) = {
    .name = "peachey-2.37",
    .title = "Power spectra of six noises",
    .question = "Where in frequency does the power of the six noises lie?",
    .paper = "peachey2003, fig. 2.37",
    .terms = terms,
    .shows =
        "Each panel is the power spectrum of one noise. First along a line at a random place: the "
        "measurement with its 95 % band, and the closed form as this window sees it; then how far "
        "the two lie apart. Last, the same noises read in four ways, each as power by frequency "
        "that sums to the variance; a line, a slice and a volume of one noise have different "
        "spectra, and a sentence that is true of one may be false of another.",
    .run = run_figure};
