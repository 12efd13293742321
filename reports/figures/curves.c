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

bl_gallery bl_curves_draw(bl_run *run, const bl_curves *curves) {
    enum { POINTS = BL_CURVES_STEPS + 1 };
    const char *texts[BL_CURVES_MOST];
    bl_line lines[BL_CURVES_MOST];
    double *x = bl_run_memory(run, POINTS, sizeof *x);
    for (size_t n = 0; n < curves->count; n++)
        texts[n] = curves->curves[n].text;
    const bl_gallery gallery = bl_gallery_open(run, texts, curves->count);
    for (size_t i = 0; i < POINTS; i++)
        x[i] = place(curves->x.from, curves->x.to, i);
    for (size_t n = 0; n < curves->count; n++) {
        const bl_curve *curve = &curves->curves[n];
        double *values = bl_run_memory(run, POINTS, sizeof *values);
        for (size_t i = 0; i < POINTS; i++)
            values[i] = bl_curves_at(&gallery, n, x[i]);
        lines[n] = (bl_line){gallery.key[n], values, curve->label, curve->ink, curve->stroke};
    }
    bl_graph_draw(run, &(bl_graph){.name = "curves",
                                   .what = "values along x",
                                   .x_name = "x",
                                   .x = x,
                                   .points = POINTS,
                                   .lines = lines,
                                   .line_count = curves->count,
                                   .plot = {.title = curves->title,
                                            .x = curves->x,
                                            .y = curves->y,
                                            .limits = curves->limits,
                                            .limit_count = curves->limit_count},
                                   .alternative = curves->alternative});
    return gallery;
}
