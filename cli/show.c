// SPDX-License-Identifier: MIT
//
// The verb `show`: what a noise, a filter, a figure or a file is, with its parameters and what it
// claims.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "aliasing/view.h"
#include "cli/json.h"
#include "core/plain.h"
#include "cli/show_filter.h"
#include "cli/verb.h"
#include "cli/words.h"
#include "core/continuity.h"
#include "core/grammar.h"
#include "filters/primitive.h"
#include "reports/figure.h"
#include "sources/source.h"
#include "textures/texture.h"

static const char *const kinds[] = {"seed", "integer", "real", "choice", "list", "text", "signal"};

static json_t *parameters_json(const bl_parameter *parameter) {
    json_t *list = json_array();
    for (; parameter->key; parameter++) {
        json_t *object = json_object();
        bl_json_set_text(object, "key", parameter->key);
        bl_json_set_text(object, "kind", kinds[parameter->kind]);
        bl_json_set_text(object, "default", parameter->fallback);
        bl_json_set_text(object, "unit", parameter->unit ? parameter->unit : "");
        if (parameter->kind == BL_INTEGER || parameter->kind == BL_REAL ||
            parameter->kind == BL_LIST) {
            bl_json_set_number(object, "minimum", parameter->minimum);
            bl_json_set_number(object, "maximum", parameter->maximum);
        }
        if (parameter->kind == BL_CHOICE) {
            json_t *choices = json_array();
            for (size_t i = 0; parameter->choices[i]; i++)
                json_array_append_new(choices, bl_json_text(parameter->choices[i]));
            json_object_set_new(object, "choices", choices);
        }
        bl_json_set_text(object, "help", parameter->help);
        json_array_append_new(list, object);
    }
    return list;
}

static void range_text(const bl_parameter *parameter, char *text, size_t size) {
    size_t used = 0;
    *text = '\0';
    if (parameter->kind == BL_SEED)
        snprintf(text, size, "0 to 2^64-1");
    else if (parameter->kind == BL_TEXT)
        snprintf(text, size, *parameter->unit ? "a list of" : "a path");
    else if (parameter->kind == BL_NESTED)
        snprintf(text, size, "any of `bandlimit list noises`, its keys as %s.KEY", parameter->key);
    else if (parameter->kind != BL_CHOICE) // no maximum is "inf"
        snprintf(text, size, "%.10g to %.10g", parameter->minimum, parameter->maximum);
    else
        for (size_t i = 0; parameter->choices[i] && used < size; i++)
            used += (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : "",
                                     parameter->choices[i]);
}

static void print_parameters(FILE *out, const bl_parameter *parameter) {
    fputs("\nparameters\n", out);
    for (; parameter->key; parameter++) {
        char range[256];
        range_text(parameter, range, sizeof range);
        fprintf(out, "  %-12s %s\n  %-12s %s%s%s; default %s\n", parameter->key, parameter->help,
                "", range, parameter->unit && *parameter->unit ? " " : "",
                parameter->unit ? parameter->unit : "", parameter->fallback);
    }
}

static void facts_json(json_t *object, const bl_signal *signal) {
    const bl_facts *facts = &signal->facts;
    double bound[2] = {facts->lower, facts->upper}, band[2] = {facts->band_from, facts->band_to};
    char class[16];
    json_t *list = json_object();
    bl_json_set_numbers(list, "bound", isfinite(bound[0]) && isfinite(bound[1]) ? bound : NULL, 2);
    bl_json_set_text(list, "bound_proof", facts->bound_proof);
    bl_json_set_number(list, "mean", facts->mean);
    bl_json_set_number(list, "variance", facts->variance);
    bl_json_set_numbers(list, "band_cycles_per_unit", isfinite(band[0]) ? band : NULL, 2);
    bl_json_set_number(list, "leak_db", facts->leak_db);
    bl_json_set_text(
        list, "continuity",
        facts->continuity < -1 ? NULL : bl_continuity_text(facts->continuity, class, sizeof class));
    bl_json_set_numbers(list, "period", isnan(facts->period[0]) ? NULL : facts->period,
                        signal->dimensions);
    bl_json_set_number(list, "cell", facts->cell);
    bl_json_set_number(list, "far", facts->far);
    json_object_set_new(list, "closed_form", json_boolean(bl_signal_has_closed_form(signal)));
    json_object_set_new(object, "facts", list);
}

static void print_fact(FILE *out, const char *name, double number, const char *unit) {
    if (isnan(number))
        fprintf(out, "  %-12s not stated\n", name);
    else
        fprintf(out, "  %-12s %.9g%s\n", name, number + 0.0, unit); // -0 is 0
}

static void print_period(FILE *out, const double *period, unsigned dimensions) {
    int any = 0, known = 1;
    for (unsigned a = 0; a < dimensions; a++) {
        any |= period[a] > 0;
        known &= !isnan(period[a]);
    }
    fprintf(out, "  %-12s ", "period");
    if (!known || !any) {
        fputs(known ? "none\n" : "not stated\n", out);
        return;
    }
    for (unsigned a = 0; a < dimensions; a++)
        fprintf(out, "%s%.9g", a ? ", " : "", period[a]);
    fputs(" units\n", out);
}

static void print_facts(FILE *out, const bl_signal *signal) {
    const bl_facts *facts = &signal->facts;
    fputs("\nfacts, for ", out);
    bl_plain_text(out, signal->text);
    fputc('\n', out);
    if (isfinite(facts->lower) && isfinite(facts->upper))
        fprintf(out, "  %-12s %.9g to %.9g%s%s\n", "bound", facts->lower + 0.0, facts->upper + 0.0,
                facts->bound_proof ? "; " : "", facts->bound_proof ? facts->bound_proof : "");
    else
        fprintf(out, "  %-12s not stated\n", "bound");
    print_fact(out, "mean", facts->mean, "");
    print_fact(out, "variance", facts->variance, "");
    if (isfinite(facts->band_from) && isfinite(facts->leak_db))
        fprintf(out,
                "  %-12s %g : %g cycles per unit; leak %g dB of the variance, along a line, no "
                "guard\n",
                "band", facts->band_from, facts->band_to, facts->leak_db);
    else if (isfinite(facts->band_from) && facts->variance > 0)
        fprintf(out, "  %-12s %g : %g cycles per unit; leak %s\n", "band", facts->band_from,
                facts->band_to, facts->leak_db < 0 ? "none at all" : "not known");
    else if (isfinite(facts->band_from))
        fprintf(out, "  %-12s not stated: there is no variance\n", "band");
    else
        fprintf(out, "  %-12s not stated\n", "band");
    char class[16];
    fprintf(out, "  %-12s %s\n", "continuity",
            bl_continuity_text(facts->continuity, class, sizeof class));
    print_period(out, facts->period, signal->dimensions);
    if (facts->cell > 0)
        print_fact(out, "cell", facts->cell, " units between the planes of its lattice");
    print_fact(out, "far", facts->far, " units: beyond it the fraction within a cell is lost");
    fprintf(out, "  %-12s %s\n", "spectrum",
            bl_signal_has_density(signal)       ? "closed form"
            : bl_signal_has_closed_form(signal) ? "closed form, of lines"
                                                : "no closed form");
}

// The registry that a definition stands in.
static const char *kind_of(const bl_definition *definition) {
    return bl_texture_find(definition->name)     ? "texture"
           : bl_primitive_find(definition->name) ? "primitive"
                                                 : "noise";
}

static bl_status show_definition(bl_call *call, const bl_definition *definition, const char *text) {
    bl_signal *signal;
    bl_status status = bl_source_open(text, call->isa, &signal, &call->message);
    if (status != BL_OK)
        return status;
    json_t *object = bl_json_start(call);
    if (object) {
        bl_json_set_text(object, "kind", kind_of(definition));
        bl_json_set_text(object, "name", definition->name);
        bl_json_set_text(object, "signal", signal->text);
        bl_json_set_text(object, "title", definition->title);
        bl_json_set_text(object, "summary", definition->summary);
        bl_json_set_text(object, "formula", definition->formula);
        bl_json_set_text(object, "paper", definition->paper);
        bl_json_set_count(object, "dimensions", signal->dimensions);
        json_object_set_new(object, "parameters", parameters_json(definition->parameters));
        facts_json(object, signal);
    } else {
        fprintf(call->out, "%s: %s\n\n%s\n\nformula\n  %s\n", definition->name, definition->title,
                definition->summary, definition->formula);
        fprintf(call->out, "\nsource       %s\ndimensions   %u\n", definition->paper,
                signal->dimensions);
        print_parameters(call->out, definition->parameters);
        print_facts(call->out, signal);
    }
    bl_signal_free(signal);
    return BL_OK;
}

static bl_status show_view(bl_call *call, const bl_view_kind *view) {
    json_t *object = bl_json_start(call);
    if (object) {
        bl_json_set_text(object, "kind", "view");
        bl_json_set_text(object, "name", view->name);
        bl_json_set_text(object, "title", view->title);
        bl_json_set_text(object, "summary", view->summary);
        bl_json_set_text(object, "formula", view->formula);
        json_object_set_new(object, "parameters", parameters_json(view->parameters));
        return BL_OK;
    }
    fprintf(call->out, "%s: %s\n\n%s\n\nformula\n  %s\n", view->name, view->title, view->summary,
            view->formula);
    print_parameters(call->out, view->parameters);
    return BL_OK;
}

static bl_status show_figure(bl_call *call, const bl_figure *figure) {
    json_t *object = bl_json_start(call);
    if (object) {
        bl_json_set_text(object, "kind", "figure");
        bl_json_set_text(object, "name", figure->name);
        bl_json_set_text(object, "title", figure->title);
        bl_json_set_text(object, "question", figure->question);
        bl_json_set_text(object, "paper", figure->paper);
        bl_json_set_text(object, "shows", figure->shows);
        return BL_OK;
    }
    fprintf(call->out,
            "%s: %s\n\nquestion  %s\nsource    %s\n\n%s\n\nto make it: bandlimit "
            "reproduce %s\n",
            figure->name, figure->title, figure->question, figure->paper, figure->shows,
            figure->name);
    return BL_OK;
}

// What a source is called; indexed by its kind.
static const char *const source_words[] = {"noise", "file", "file", "function", "program"};
static const char *const source_titles[] = {"a noise", "a file of samples", "a file of samples",
                                            "a function of a shared object", "a program"};

static void print_source(FILE *out, bl_source_kind kind, const bl_signal *signal) {
    int sampled = kind == BL_SOURCE_IMAGE || kind == BL_SOURCE_RAW;
    bl_plain_text(out, signal->text);
    fprintf(out, ": %s\n\ndimensions   %u\n", source_titles[kind], signal->dimensions);
    if (!sampled)
        fprintf(out, "seed         %s\n",
                signal->seed_offset == SIZE_MAX ? "none: {seed} stands nowhere in the words"
                                                : "it can be reseeded");
    for (unsigned a = 0; a < signal->dimensions && signal->extent.size[a]; a++)
        fprintf(out, "axis %c       %zu sample%s, %g unit%s between them\n", "xyzw"[a],
                signal -> extent.size[a], bl_plural(signal->extent.size[a]),
                signal->extent.spacing[a], signal->extent.spacing[a] == 1 ? "" : "s");
    if (!sampled || !isnan(signal->facts.period[0]))
        print_facts(out, signal);
}

static bl_status show_file(bl_call *call, const char *text) {
    bl_source_kind kind = bl_source_kind_of(text);
    bl_signal *signal;
    bl_status status = bl_call_open(call, text, &signal);
    if (status != BL_OK)
        return status;
    json_t *object = bl_json_start(call);
    if (object) {
        json_t *size = json_array();
        for (unsigned a = 0; a < signal->dimensions; a++)
            json_array_append_new(size, json_integer((json_int_t)signal->extent.size[a]));
        bl_json_set_text(object, "kind", source_words[kind]);
        bl_json_set_text(object, "signal", signal->text);
        bl_json_set_count(object, "dimensions", signal->dimensions);
        json_object_set_new(object, "size", size);
        bl_json_set_numbers(object, "spacing_units", signal->extent.spacing, signal->dimensions);
        facts_json(object, signal);
    } else {
        print_source(call->out, kind, signal);
    }
    bl_signal_free(signal);
    return BL_OK;
}

static bl_status report_unknown(bl_call *call, const char *name) {
    size_t definitions = 0, count = 0;
    while (bl_source_definition_at(definitions))
        definitions++;
    const char **names = calloc(
        definitions + bl_filter_count() + bl_view_count() + bl_figure_count() + 1, sizeof *names);
    if (!names)
        return bl_report(&call->message, BL_DEVICE, "out of memory");
    for (size_t i = 0; i < definitions; i++)
        names[count++] = bl_source_definition_at(i)->name;
    for (size_t i = 0; i < bl_filter_count(); i++)
        names[count++] = bl_filter_at(i)->name;
    for (size_t i = 0; i < bl_view_count(); i++)
        names[count++] = bl_view_at(i)->name;
    for (size_t i = 0; i < bl_figure_count(); i++)
        names[count++] = bl_figure_at(i)->name;
    const char *near = bl_suggest(name, names);
    free(names);
    return bl_report(&call->message, BL_USAGE,
                     "no noise, primitive, filter, texture, view, figure or file is called "
                     "'%s'%s%s%s`bandlimit list` shows all",
                     name, near ? "; did you mean '" : "", near ? near : "", near ? "'? " : "; ");
}

typedef struct show_settings {
    const char *plot;
} show_settings;

// A name may be that of a primitive and of a filter, as smoothstep; `filter:smoothstep` is the
// filter, and so is what is to be plotted.
static const bl_filter *filter_meant(const char *text, const char *plot) {
    static const char prefix[] = "filter:";
    if (strncmp(text, prefix, sizeof prefix - 1) == 0)
        return bl_filter_find(text + sizeof prefix - 1);
    return plot ? bl_filter_find(text) : NULL;
}

static bl_status run_show(bl_call *call) {
    const show_settings *settings = call->settings;
    const char *text = call->operands.words[0];
    const bl_filter *filter = filter_meant(text, settings->plot);
    if (filter)
        return bl_show_filter(call, filter, settings->plot);
    if (settings->plot)
        return bl_report(&call->message, BL_USAGE,
                         "--plot draws filters, and '%s' is none; `bandlimit list filters` shows "
                         "them, `render` and `spectrum` draw signals",
                         text);
    const bl_figure *figure = bl_figure_find(text);
    if (figure)
        return show_figure(call, figure);
    bl_spec spec;
    if (bl_source_is_file(text))
        return show_file(call, text);
    bl_status status = bl_spec_parse(text, &spec, &call->message);
    if (status != BL_OK)
        return status;
    const bl_definition *definition = bl_source_definition(spec.name, call->isa);
    const bl_view_kind *view = bl_view_find(spec.name);
    filter = bl_filter_find(spec.name);
    if (definition)
        status = show_definition(call, definition, text);
    else if (filter && !spec.count)
        status = bl_show_filter(call, filter, NULL);
    else if (view && !spec.count)
        status = show_view(call, view);
    else
        status = report_unknown(call, spec.name);
    bl_spec_free(&spec);
    return status;
}

static const bl_option options[] = {
    {.name = "plot",
     .kind = BL_OPTION_WORD,
     .offset = offsetof(show_settings, plot),
     .value = "PATH",
     .help = "of a filter: draw kernel, step and response to PATH, which ends in .svg or .png"},
    {0}};

const bl_verb bl_verb_show = {
    .name = "show",
    .operands = "NAME",
    .summary = "definition, parameters, facts, source",
    .text =
        "NAME is a noise, primitive or texture, with or without settings (the facts are those for "
        "the settings), a filter (filter:NAME where a primitive has that name too), a view, a "
        "figure, a file, a function ./lib.so:NAME, or a program "
        "cmd:PROGRAM.",
    .least = 1,
    .most = 1,
    .output_help = "write the text to PATH instead of stdout",
    .options = options,
    .settings_size = sizeof(show_settings),
    .run = run_show,
};
