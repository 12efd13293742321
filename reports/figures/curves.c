// SPDX-License-Identifier: MIT
#include "reports/figures/curves.h"

#include <math.h>

#include "reports/figures/estimates.h"

double bl_curves_at(const bl_gallery *gallery, size_t index, double x) {
    return bl_signal_value(gallery->signal[index], (const double[BL_AXES]){x});
}

static double place(double from, double to, size_t i) {
    return from + (to - from) * (double)i / BL_CURVES_STEPS;
}

double bl_curves_largest(double (*a)(const bl_gallery *gallery, double x),
                         const bl_gallery *gallery, double from, double to) {
    double largest = 0;
    for (size_t i = 0; i <= BL_CURVES_STEPS; i++) {
        double size = fabs(a(gallery, place(from, to, i)));
        if (isnan(size))
            return NAN; // fmax would hide it
        largest = fmax(largest, size);
    }
    return largest;
}

void bl_curves_claim(bl_run *run, const char *source, const char *sentence, const char *reading,
                     double limit, double measured) {
    bl_make_claim(run, source, sentence, reading, "", 0, limit,
                  bl_exactly(measured, BL_CURVES_STEPS + 1), "places");
}

static void write_values(bl_run *run, const bl_curves *curves, const bl_gallery *gallery) {
    enum { POINTS = BL_CURVES_STEPS + 1 };
    double *values = bl_run_memory(run, (curves->count + 1) * POINTS, sizeof *values), *x = values;
    bl_column columns[BL_CURVES_MOST + 1];
    columns[0] = (bl_column){"x", x, NULL};
    for (size_t i = 0; i < POINTS; i++)
        x[i] = place(curves->x.from, curves->x.to, i);
    for (size_t n = 0; n < curves->count; n++) {
        double *column = values + (n + 1) * POINTS;
        for (size_t i = 0; i < POINTS; i++)
            column[i] = bl_curves_at(gallery, n, x[i]);
        columns[n + 1] = (bl_column){gallery->key[n], column, NULL};
    }
    bl_run_csv(run, "curves", "values along x", columns, curves->count + 1, POINTS);
}

static void draw(bl_run *run, const bl_curves *curves, const bl_gallery *gallery) {
    bl_series series[BL_CURVES_MOST];
    for (size_t n = 0; n < curves->count; n++)
        series[n] = (bl_series){.stroke = curves->curves[n].stroke,
                                .ink = curves->curves[n].ink,
                                .file = "curves.csv",
                                .x = "x",
                                .y = gallery->key[n],
                                .label = curves->curves[n].label};
    const bl_panel panel = {.title = "", .series = series, .series_count = curves->count};
    const bl_plot plot = {.title = curves->title,
                          .x = curves->x,
                          .y = curves->y,
                          .panels = &panel,
                          .panel_count = 1,
                          .limits = curves->limits,
                          .limit_count = curves->limit_count};
    bl_run_plot(run, "curves", &plot, curves->alternative);
}

bl_gallery bl_curves_draw(bl_run *run, const bl_curves *curves) {
    const char *texts[BL_CURVES_MOST];
    for (size_t n = 0; n < curves->count; n++)
        texts[n] = curves->curves[n].text;
    const bl_gallery gallery = bl_gallery_open(run, texts, curves->count);
    write_values(run, curves, &gallery);
    draw(run, curves, &gallery);
    return gallery;
}
