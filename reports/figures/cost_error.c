// SPDX-License-Identifier: MIT
//
// cost-against-error: four choices that every renderer makes, each with all its alternatives: the
// table of a radial kernel, the precision of a noise, the kernel of a filtered step, and a power
// against Schlick's form. The measurements are those of the verb `trade`.
#include <math.h>
#include <string.h>

#include "score/trade.h"
#include "filters/primitive.h"
#include "noises/noise.h"
#include "reports/figures/estimates.h"
#include "reports/measure.h"
#include "reports/trade_files.h"

typedef struct choice {
    const char *trade, *subject, *alternative;
    void (*claim)(bl_run *run, const bl_alternatives *alternatives);
} choice;

static const bl_alternative *find(const bl_alternatives *alternatives, const char *name) {
    static const bl_alternative none = {
        .error = {NAN, NAN, NAN, 0.95, 0}, .ns = NAN, .ns_lowest = NAN, .ns_highest = NAN};
    for (size_t i = 0; i < alternatives->count; i++)
        if (strcmp(alternatives->list[i].name, name) == 0)
            return &alternatives->list[i];
    return &none;
}

// The ratio of two times of one run, with the quarters of both; at 92 % or more.
static bl_estimate times_as_long(const bl_alternative *a, const bl_alternative *b) {
    return (bl_estimate){a->ns / b->ns, a->ns_lowest / b->ns_highest, a->ns_highest / b->ns_lowest,
                         0.92, 15};
}

static bl_estimate ratio(const bl_estimate *a, const bl_estimate *b) {
    double value = a->value / b->value;
    double below = hypot((a->value - a->lower) / a->value, (b->upper - b->value) / b->value);
    double above = hypot((a->upper - a->value) / a->value, (b->value - b->lower) / b->value);
    return (bl_estimate){value, value * (1 - below), value * (1 + above), a->level,
                         fmin(a->samples, b->samples)};
}

// --- what is claimed ----------------------------------------------------------------------------

static void claim_tables(bl_run *run, const bl_alternatives *all) {
    const bl_estimate of_64 = ratio(&find(all, "table:64")->error, &find(all, "table:1024")->error);
    bl_make_claim(run, "bandlimit",
                  "A table of 100 entries a unit of squared distance, the text's, is off by less "
                  "than 1/100 of the standard deviation.",
                  "rms error of vcnoise against the exact kernel", "standard deviations", 0, 0.01,
                  find(all, "table:100")->error, "places");
    bl_make_claim(run, "bandlimit",
                  "The error of the nearest entry is proportional to the step of the table: with "
                  "64 entries it is 16 times that with 1024.",
                  "rms errors of vcnoise", "", 14, 18, of_64, "places");
    bl_make_claim(run, "bandlimit",
                  "The exact kernel in float is at least twice as fast as any table found in "
                  "double: the time of a table of 1024 over that of the loops without one.",
                  "vcnoise at scattered points, timed by turns", "", 2, INFINITY,
                  times_as_long(find(all, "table:1024"), find(all, "exact")), "turns");
}

static void claim_precision(bl_run *run, const bl_alternatives *all) {
    const bl_estimate bits = ratio(&find(all, "fixed:8")->error, &find(all, "fixed:16")->error);
    bl_make_claim(
        run, "bandlimit",
        "Each bit of fixed point halves the error: that of 8 bits is 256 times that of 16.",
        "rms errors of gnoise", "", 235, 279, bits, "places");
    bl_make_claim(
        run, "bandlimit",
        "Float is better than 20 bits of fixed point: the error of these over that of float.",
        "rms errors of gnoise", "", 2, INFINITY,
        ratio(&find(all, "fixed:20")->error, &find(all, "float")->error), "places");
}

static void claim_steps(bl_run *run, const bl_alternatives *all) {
    bl_make_claim(
        run, "bandlimit",
        "A box of one sample removes nine tenths of what a step has beyond the Nyquist frequency.",
        "by its response", "of the bare step's", 0, 0.1, find(all, "box")->error, "nodes");
    bl_make_claim(run, "peachey2003, p. 64",
                  "The smooth cubic step is a better filtered step than the linear one of the box: "
                  "the leak of smoothstep over that of the box, both one sample wide.",
                  "by their responses", "", 0, 1,
                  bl_exactly(find(all, "parabola")->error.value / find(all, "box")->error.value, 1),
                  "nodes");
}

static void claim_forms(bl_run *run, const bl_alternatives *all) {
    bl_make_claim(run, "peachey2003, p. 39",
                  "Schlick's forms can be evaluated more quickly than the powers: the time of the "
                  "power over that of Schlick's bias.",
                  "bias:b=0.7, timed by turns", "", 1, INFINITY,
                  times_as_long(find(all, "power"), find(all, "schlick")), "turns");
    bl_make_claim(run, "bandlimit",
                  "Schlick's bias of 0.7 differs from the power by 1/10 of the range or a little "
                  "more, at worst.",
                  "largest difference at random places in [0, 1]", "of the range", 0.095, 0.115,
                  bl_observed(find(all, "schlick")->largest, find(all, "schlick")->error.samples),
                  "places");
}

static const choice choices[] = {
    {"kernel-table", "vcnoise",
     "Error against time. Larger tables take the same time and have smaller errors; the exact "
     "kernel in float is both faster and better than all of them.",
     claim_tables},
    {"precision", "gnoise",
     "Error against time. Fixed point of 8 to 24 bits takes the same time, with ever smaller "
     "errors; float is faster and better.",
     claim_precision},
    {"step-filter", "step",
     "Leak against time: from the bare step down over the box and the tent to the Gaussian; the "
     "Lanczos kernel costs far more.",
     claim_steps},
    {"curve-form", "bias",
     "Error against time: two points, the power exact and slow, Schlick's form fast and off.",
     claim_forms}};

// --- the figure ---------------------------------------------------------------------------------

static void draw(bl_run *run, const choice *made, const bl_trade *trade,
                 const bl_alternatives *all) {
    static const char what[] = "cost against error of the alternatives";
    bl_alternative *rows = bl_run_memory(run, all->count, sizeof *rows);
    const bl_table table = bl_trade_table(all), front = bl_trade_front(all, rows);
    bl_trade_plot plot;
    bl_run_table(run, trade->name, what, &table);
    bl_run_table(run, bl_run_text(run, "%s-front", trade->name), what, &front);
    bl_trade_plot_describe(trade, all, trade->name, &plot);
    bl_run_plot(run, trade->name, &plot.plot, made->alternative);
}

typedef struct opened {
    const bl_trade *trade;
    bl_alternatives all;
} opened;

static void release(void *thing) {
    opened *o = thing;
    bl_trade_close(o->trade, &o->all);
}

static void run_choice(bl_run *run, const choice *made) {
    const bl_trade_settings settings = {.seed = bl_run_settings(run)->seed,
                                        .threads = bl_run_settings(run)->threads,
                                        .size = bl_run_settings(run)->size};
    const bl_signal *subject = bl_run_signal(run, made->subject);
    opened *o = bl_run_memory(run, 1, sizeof *o);
    o->trade = bl_trade_find(made->trade);
    bl_run_setting(run, made->trade, subject->text);
    bl_run_must(run, bl_trade_run(o->trade, subject, &settings, &o->all, bl_run_message(run)));
    bl_run_keep(run, o, release);
    draw(run, made, o->trade, &o->all);
    made->claim(run, &o->all);
}

static void run_figure(bl_run *run) {
    for (size_t i = 0; i < sizeof choices / sizeof *choices; i++) {
        bl_run_step(run, choices[i].trade);
        run_choice(run, &choices[i]);
    }
}

BL_FIGURE_DESCRIPTOR(cost_error) = {
    .name = "cost-against-error",
    .title = "Cost against error of four choices",
    .question = "What does each alternative cost, and what does it get wrong?",
    .paper = "bandlimit, after peachey2003, pp. 38-39, 64-66 and 78-80",
    .shows =
        "Every alternative of a choice as a point: the time of a sample, measured by turns with "
        "the others, against its error; both axes are logarithmic, and what has no error is not "
        "drawn. The dashed line joins those that nothing beats in both cost and error, as far as "
        "the intervals tell.",
    .run = run_figure,
    .timed = 1};
