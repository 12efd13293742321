// SPDX-License-Identifier: MIT
//
// filtered-steps: what each filter of the registry makes of a step, and what it passes of each
// frequency.
#include <math.h>

#include "core/quadrature.h"
#include "filters/response.h"
#include "reports/figures/estimates.h"
#include "reports/figures/graph.h"

static const char section[] = "peachey2003, Better Filters";

enum { FILTERS_MOST = 16, PLACES = 641, FREQUENCIES = 801 };
static const double reach = 4, highest = 4, floor_db = -80;

static size_t count_of(void) {
    size_t count = bl_filter_count();
    return count < FILTERS_MOST ? count : FILTERS_MOST;
}

// --- plots --------------------------------------------------------------------------------------

// A panel for each filter, whose titles are put here.
static void draw(bl_run *run, bl_graph *graph) {
    const char *names[FILTERS_MOST];
    for (size_t f = 0; f < count_of(); f++)
        names[f] = bl_filter_at(f)->name;
    graph->panels = names;
    graph->panel_count = count_of();
    graph->plot.columns = 4;
    graph->plot.aspect = 0.8;
    bl_graph_draw(run, graph);
}

static void draw_steps(bl_run *run) {
    static double x[PLACES], step[FILTERS_MOST][PLACES], kernel[FILTERS_MOST][PLACES];
    bl_line lines[FILTERS_MOST][2];
    for (int i = 0; i < PLACES; i++)
        x[i] = reach * (2.0 * i / (PLACES - 1) - 1);
    for (size_t f = 0; f < count_of(); f++) {
        const bl_filter *filter = bl_filter_at(f);
        for (int i = 0; i < PLACES; i++) {
            step[f][i] = filter->step(x[i]);
            kernel[f][i] = filter->kernel(x[i]);
        }
        lines[f][0] = (bl_line){bl_run_text(run, "%s_step", filter->name), step[f], "step",
                                BL_INK_MEASURED, BL_STROKE_LINE};
        lines[f][1] = (bl_line){bl_run_text(run, "%s_kernel", filter->name), kernel[f], "kernel",
                                BL_INK_FOURTH, BL_STROKE_THIN};
    }
    draw(run,
         &(bl_graph){
             .name = "steps",
             .what = "filtered steps and their kernels",
             .x_name = "distance_widths",
             .x = x,
             .points = PLACES,
             .lines = lines[0],
             .line_count = 2 * count_of(),
             .plot = {.title = "What does each filter make of a step?",
                      .x = {"distance from the edge, widths", -reach, reach, 2, 0},
                      .y = {"value", -0.3, 1.6, 0.5, 0}},
             .alternative =
                 "A panel for each filter: its kernel and the step that it makes. Those of box, "
                 "tent, parabola and Gaussian rise all the way; Catmull-Rom, Mitchell, Lanczos and "
                 "sinc dip below 0 and rise above 1, sinc again and again."});
}

static void draw_responses(bl_run *run) {
    static double frequency[FREQUENCIES], response[FILTERS_MOST][FREQUENCIES];
    static const bl_limit nyquist = {1, 0.5, "Nyquist"};
    bl_line lines[FILTERS_MOST];
    for (size_t f = 0; f < count_of(); f++) {
        const bl_filter *filter = bl_filter_at(f);
        for (int i = 0; i < FREQUENCIES; i++) {
            frequency[i] = highest * i / (FREQUENCIES - 1);
            response[f][i] = fmax(20 * log10(fabs(filter->response(frequency[i]))), floor_db - 20);
        }
        lines[f] = (bl_line){bl_run_text(run, "%s_db", filter->name), response[f], "response",
                             BL_INK_MEASURED, BL_STROKE_LINE};
    }
    draw(run, &(bl_graph){.name = "responses",
                          .what = "responses in dB of that at 0, cut off below -100 dB",
                          .x_name = "frequency_cycles_per_width",
                          .x = frequency,
                          .points = FREQUENCIES,
                          .lines = lines,
                          .line_count = count_of(),
                          .plot = {.title = "What does each filter pass of each frequency?",
                                   .x = {"frequency, cycles per width", 0, highest, 1, 0},
                                   .y = {"response, dB of that at 0", floor_db, 10, 20, 0},
                                   .limits = &nyquist,
                                   .limit_count = 1},
                          .alternative = "A panel for each filter: the response in decibels over "
                                         "the frequency. The side lobes of "
                                         "the box fall slowest; the Gaussian has none; sinc ends "
                                         "at the Nyquist frequency."});
}

// --- numbers ------------------------------------------------------------------------------------

typedef struct entry {
    const char *filter;
    bl_filter_numbers n;
    double nyquist_db, lobe_db;
} entry;

#define AT(member) NULL, BL_CELL_REAL, .offset = offsetof(entry, member)
static const bl_field fields[] = {{"filter", NULL, BL_CELL_WORD, .offset = offsetof(entry, filter)},
                                  {"half_power_cycles_per_width", AT(n.half_power)},
                                  {"nyquist_db", AT(nyquist_db)},
                                  {"first_zero_cycles_per_width", AT(n.first_zero)},
                                  {"lobe_cycles_per_width", AT(n.lobe_frequency)},
                                  {"lobe_db", AT(lobe_db)},
                                  {"overshoot", AT(n.overshoot)},
                                  {"overshoot_widths", AT(n.overshoot_at)},
                                  {"white_alias", AT(n.alias)},
                                  {"white_blur", AT(n.blur)},
                                  {0}};
#undef AT

static void write_numbers(bl_run *run, const bl_filter_numbers *numbers) {
    entry rows[FILTERS_MOST];
    for (size_t f = 0; f < count_of(); f++)
        rows[f] = (entry){bl_filter_at(f)->name, numbers[f], 20 * log10(numbers[f].nyquist),
                          20 * log10(fabs(numbers[f].lobe))};
    const bl_table table = {fields, rows, count_of(), sizeof *rows, .level = 0.95};
    bl_run_table(run, "numbers", "responses and steps in numbers", &table);
}

// How far a filter is from the ideal one on the spectrum 1/f^2 of a step, in widths: int over all f
// of |H - H_ideal|^2 / (2 pi f)^2, which is the integral over x of the squared difference of the
// two filtered steps. Beyond 64 what is left is below 2 (0.0052/64)^2.
static double distance_of_steps(const bl_filter *filter, double widening) {
    double sum = 0;
    const double part = 1.0 / 16;
    for (double left = 0; left < 64; left += part)
        for (int n = 0; n < BL_QUADRATURE_NODES; n++) {
            double f = left + 0.5 * part * (1 + bl_quadrature_node[n]);
            double missing = (f < 0.5) - filter->response(f * widening);
            sum += part * bl_quadrature_weight[n] * missing * missing / (4 * M_PI * M_PI * f * f);
        }
    return sum;
}

static void claim_ideal(bl_run *run, const bl_filter_numbers *box,
                        const bl_filter_numbers *parabola) {
    const bl_filter *flat = bl_filter_find("box"), *curved = bl_filter_find("parabola");
    static const char sentence[] =
        "Smoothstep in place of the step is like a quadratic filter, which is a better "
        "approximation to the ideal filter than the box: the squared difference to the ideal "
        "response with the box, minus that with smoothstep.";
    double white = box->alias + box->blur - parabola->alias - parabola->blur;
    bl_make_claim(run, section, sentence, "white noise, both one width wide",
                  "of the power below the Nyquist frequency", 0, INFINITY, bl_exactly(white, 1),
                  "pair");
    bl_make_claim(run, section, sentence, "a step, both one width wide", "widths", 0, INFINITY,
                  bl_exactly(distance_of_steps(flat, 1) - distance_of_steps(curved, 1), 1), "pair");
    bl_make_claim(run, section, sentence, "a step, smoothstep over 1.5 widths and the box over one",
                  "widths", 0, INFINITY,
                  bl_exactly(distance_of_steps(flat, 1) - distance_of_steps(curved, 1.5), 1),
                  "pair");
}

static double lowest_of(const bl_filter *filter) {
    double lowest = 0;
    for (double t = 0; t < 5; t += 1.0 / 256)
        lowest = fmin(lowest, filter->kernel(t));
    return lowest;
}

static void claim_lobes(bl_run *run, const bl_filter_numbers *numbers) {
    double blur[2] = {0, 0}, least_overshoot = INFINITY, deepest = -INFINITY;
    int count[2] = {0, 0};
    for (size_t f = 0; f < count_of(); f++) {
        const bl_filter *filter = bl_filter_at(f);
        double lowest = lowest_of(filter);
        int negative = lowest < 0;
        blur[negative] += numbers[f].blur;
        count[negative]++;
        if (negative)
            least_overshoot = fmin(least_overshoot, numbers[f].overshoot);
        if (filter == bl_filter_find("sinc") || filter == bl_filter_find("catmull-rom"))
            deepest = fmax(deepest, lowest);
    }
    bl_make_claim(run, section,
                  "Filters such as sinc and Catmull-Rom have negative lobes: the higher of their "
                  "lowest values.",
                  "kernels over 5 widths", "", -1, -1e-3, bl_exactly(deepest, 2), "filters");
    bl_make_claim(run, section,
                  "Filters with negative lobes generally produce sharper patterns: the mean blur "
                  "of white noise of those without, minus that of those with.",
                  bl_run_text(run, "%d filters without, %d with", count[0], count[1]),
                  "of the power below the Nyquist frequency", 0, 1,
                  bl_exactly(blur[0] / count[0] - blur[1] / count[1], count[0] + count[1]),
                  "filters");
    bl_make_claim(
        run, section,
        "Filters with negative lobes ring: the least overshoot of a step under one of them.",
        "all filters with negative lobes", "of the step", 1e-3, 1,
        bl_exactly(least_overshoot, count[1]), "filters");
}

// The step against sums of the kernel at the middles of 2^14 intervals a width.
static void claim_integrals(bl_run *run) {
    const double h = 0x1p-14;
    const bl_filter *filter = bl_filter_find("catmull-rom");
    double sum = 0, off = 0;
    for (double t = -2; t < 2; t += h) {
        sum += h * filter->kernel(t + 0.5 * h);
        off = fmax(off, fabs(sum - filter->step(t + h)));
    }
    bl_make_claim(run, section,
                  "The convolution of the Catmull-Rom filter with a step is the integral of the "
                  "filter: the largest difference between catstep and a sum over the kernel.",
                  "2^14 values of the kernel a width", "", 0, 1e-8, bl_exactly(off, 65536),
                  "places");
}

static void run_figure(bl_run *run) {
    bl_filter_numbers numbers[FILTERS_MOST], *box = NULL, *parabola = NULL;
    for (size_t f = 0; f < count_of(); f++) {
        numbers[f] = bl_filter_measure(bl_filter_at(f));
        if (bl_filter_at(f) == bl_filter_find("box"))
            box = &numbers[f];
        if (bl_filter_at(f) == bl_filter_find("parabola"))
            parabola = &numbers[f];
    }
    bl_run_setting(run, "filters", bl_run_text(run, "all %zu of the registry", count_of()));
    draw_steps(run);
    draw_responses(run);
    write_numbers(run, numbers);
    if (box && parabola)
        claim_ideal(run, box, parabola);
    claim_lobes(run, numbers);
    claim_integrals(run);
}

static const bl_term terms[] = {
    {"width", "of a filter: the distance of the samples that it serves"},
    {"alias of white noise", "the power above the Nyquist frequency that the filter leaves"},
    {"blur of white noise", "the power of what it changes below the Nyquist frequency"},
    {0}};

BL_FIGURE_DESCRIPTOR(filtered_steps) = {
    .name = "filtered-steps",
    .title = "All filtered steps and their responses",
    .question = "What does each filter make of a step, and what does it pass?",
    .paper = "peachey2003, Better Filters",
    .terms = terms,
    .shows =
        "The step that each filter makes, with its kernel, and the response in decibels, all for "
        "samples a width apart. numbers.csv has the -3 dB point, the first zero, the largest side "
        "lobe, the overshoot, and alias and blur of white noise.",
    .run = run_figure};
