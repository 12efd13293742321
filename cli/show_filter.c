// SPDX-License-Identifier: MIT
#include "cli/show_filter.h"

#include <math.h>

#include "cli/json.h"
#include "core/continuity.h"
#include "filters/response.h"
#include "reports/filter_plot.h"

enum { ROWS_PER_UNIT = 4, SAMPLES_PER_UNIT = 32, REACH = 3 };

static double decibels(double amplitude) {
    return 20 * log10(fabs(amplitude));
}

// --- JSON ---------------------------------------------------------------------------------------

static void numbers_json(json_t *object, const bl_filter_numbers *n) {
    json_t *list = json_object();
    bl_json_set_number(list, "half_power_cycles_per_width", n->half_power);
    bl_json_set_number(list, "nyquist_db", decibels(n->nyquist));
    bl_json_set_number(list, "first_zero_cycles_per_width", n->first_zero);
    bl_json_set_number(list, "side_lobe_cycles_per_width", n->lobe_frequency);
    bl_json_set_number(list, "side_lobe_db", decibels(n->lobe));
    bl_json_set_number(list, "overshoot", n->overshoot);
    bl_json_set_number(list, "overshoot_widths", n->overshoot_at);
    bl_json_set_number(list, "white_alias", n->alias);
    bl_json_set_number(list, "white_blur", n->blur);
    json_object_set_new(object, "numbers", list);
}

static void samples_json(json_t *object, const bl_filter *filter) {
    static const char *const names[] = {"place", "kernel", "step", "ramp", "response"};
    json_t *lists[5], *samples = json_object();
    for (int k = 0; k < 5; k++)
        lists[k] = json_array();
    for (int i = -REACH * SAMPLES_PER_UNIT; i <= REACH * SAMPLES_PER_UNIT; i++) {
        double x = (double)i / SAMPLES_PER_UNIT;
        const double values[] = {x, filter->kernel(x), filter->step(x), filter->ramp(x),
                                 filter->response(x)};
        for (int k = 0; k < 5; k++)
            json_array_append_new(lists[k], bl_json_number(values[k]));
    }
    for (int k = 0; k < 5; k++)
        json_object_set_new(samples, names[k], lists[k]);
    bl_json_set_text(samples, "unit_of_place",
                     "widths of kernel, step and ramp; cycles per width of the response");
    json_object_set_new(object, "samples", samples);
}

static void filter_json(json_t *object, const bl_filter *filter, const bl_filter_numbers *n) {
    char class[16];
    bl_json_set_text(object, "kind", "filter");
    bl_json_set_text(object, "name", filter->name);
    bl_json_set_text(object, "title", filter->title);
    bl_json_set_text(object, "summary", filter->summary);
    bl_json_set_text(object, "formula", filter->formula);
    char example[96];
    snprintf(example, sizeof example, "bandlimit show %s --plot filter.svg", filter->name);
    bl_json_set_text(object, "paper", filter->paper);
    bl_json_set_text(object, "example", example);
    bl_json_set_number(object, "support_widths", filter->support);
    bl_json_set_text(object, "continuity",
                     bl_continuity_text(filter->continuity, class, sizeof class));
    numbers_json(object, n);
    samples_json(object, filter);
}

// --- text ---------------------------------------------------------------------------------------

static void print_head(FILE *out, const bl_filter *filter) {
    char class[16];
    fprintf(out, "%s: %s\n\n%s\n\nkernel       %s\n", filter->name, filter->title, filter->summary,
            filter->formula);
    fprintf(out, "source       %s\nexample      bandlimit show %s --plot filter.svg\n",
            filter->paper, filter->name);
    if (isfinite(filter->support))
        fprintf(out, "support      %g widths to both sides\n", filter->support);
    else
        fputs("support      without an end\n", out);
    fprintf(out, "continuity   %s\n", bl_continuity_text(filter->continuity, class, sizeof class));
}

static void print_numbers(FILE *out, const bl_filter_numbers *n) {
    fputs("\nresponse, in cycles per width (samples stand a width apart: Nyquist frequency 1/2)\n",
          out);
    fprintf(out, "  %-16s %.6g\n", "-3 dB at", n->half_power);
    fprintf(out, "  %-16s %.3g dB\n", "at 1/2", decibels(n->nyquist));
    if (isnan(n->first_zero))
        fprintf(out, "  %-16s none\n", "first zero");
    else
        fprintf(out, "  %-16s %.6g\n", "first zero", n->first_zero);
    if (isnan(n->lobe))
        fprintf(out, "  %-16s none\n", "largest lobe");
    else
        fprintf(out, "  %-16s %.3g dB at %.4g\n", "largest lobe", decibels(n->lobe),
                n->lobe_frequency);
    fprintf(out, "  %-16s alias %.3g, blur %.3g of the power below 1/2\n", "of white noise",
            n->alias, n->blur);
    if (isnan(n->overshoot_at))
        fputs("\nstep\n  overshoot        none\n", out);
    else
        fprintf(out, "\nstep\n  overshoot        %.3g at %.4g widths\n", n->overshoot,
                n->overshoot_at);
}

static void print_table(FILE *out, const bl_filter *filter) {
    fputs("\n      t     kernel      step   |     f    response        dB\n", out);
    for (int i = 0; i <= REACH * ROWS_PER_UNIT; i++) {
        double x = (double)i / ROWS_PER_UNIT, kernel = filter->kernel(x);
        double passed = filter->response(x);
        fprintf(out, "  %5.2f  %9.6f  %9.6f   |  %5.2f  %9.6f", x, fabs(kernel) < 5e-7 ? 0 : kernel,
                filter->step(x), x, fabs(passed) < 5e-7 ? 0 : passed);
        if (fabs(passed) < 1e-12)
            fputs("       zero\n", out);
        else
            fprintf(out, "  %9.2f\n", decibels(passed) + 0.0);
    }
}

bl_status bl_show_filter(bl_call *call, const bl_filter *filter, const char *plot) {
    bl_filter_numbers numbers = bl_filter_measure(filter);
    bl_status status = plot ? bl_filter_plot(filter, plot, &call->message) : BL_OK;
    if (status != BL_OK)
        return status;
    json_t *object = bl_json_start(call);
    if (object) {
        filter_json(object, filter, &numbers);
        return BL_OK;
    }
    print_head(call->out, filter);
    print_numbers(call->out, &numbers);
    print_table(call->out, filter);
    return BL_OK;
}
