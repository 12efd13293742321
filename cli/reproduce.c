// SPDX-License-Identifier: MIT
//
// The verb `reproduce`: regenerates figures and says which claims held.
#include "cli/figures.h"

typedef struct reproduce_options {
    const char *format;
} reproduce_options;

static bl_status run_reproduce(bl_call *call) {
    const reproduce_options *options = call->settings;
    bl_reproduce_settings settings = bl_reproduce_default_settings();
    settings.format = options->format;
    return bl_figures_run(call, call->operands.words, call->operands.count, &settings);
}

static const char *const formats[] = {"svg", "pdf", NULL};

static const bl_option options[] = {
    {"format", BL_OPTION_CHOICE, offsetof(reproduce_options, format), "FORMAT", .fallback = "svg",
     .choices = formats, .help = "the plots as SVG alone, or with a PDF beside each"},
    {0}};

const bl_verb bl_verb_reproduce = {
    .name = "reproduce",
    .operands = "[FIGURE...]",
    .summary = "regenerate figures: data, plot, image, claims, HTML",
    .text =
        "Without words, all figures. Each gets a folder of its own, and index.html shows them all. "
        "A claim of a paper that turns out false is a finding and does not fail the run; a claim "
        "of our own that fails does (exit status 2). --quick takes seconds, --full a night.",
    .most = 4096,
    .output = BL_OUTPUT_FOLDER,
    .output_help = "the folder to write into (default: out)",
    .options = options,
    .settings_size = sizeof(reproduce_options),
    .run = run_reproduce,
};
