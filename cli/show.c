// SPDX-License-Identifier: MIT
//
// The verb `show`: what a noise, a filter, a figure or a file is, with its parameters and what it
// claims.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "aliasing/method.h"
#include "aliasing/view.h"
#include "cli/json.h"
#include "core/plain.h"
#include "cli/show_filter.h"
#include "cli/verb.h"
#include "core/continuity.h"
#include "core/grammar.h"
#include "filters/primitive.h"
#include "reports/figure.h"
#include "score/score.h"
#include "score/trade.h"
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
        if (parameter->choices)
            json_object_set_new(object, "choices", bl_json_texts(parameter->choices, SIZE_MAX));
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
    else if (parameter->kind == BL_TEXT && !parameter->choices)
        snprintf(text, size, *parameter->unit ? "a list of" : "a path");
    else if (parameter->kind == BL_NESTED)
        snprintf(text, size, "any of `bandlimit list noises`, its keys as %s.KEY", parameter->key);
    else if (parameter->kind != BL_CHOICE && parameter->kind != BL_TEXT) // no maximum is "inf"
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
    char note[256];
    bl_signal_note(signal, note, sizeof note);
    if (*note)
        bl_json_set_text(object, "values", note);
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

static void print_note(FILE *out, const bl_signal *signal) {
    char note[256];
    bl_signal_note(signal, note, sizeof note);
    if (*note)
        fprintf(out, "values       %s\n", note);
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

// --- what each kind has besides its head --------------------------------------------------------

enum { LINES_MOST = 2 };

typedef struct details {
    const char *summary_key; // in JSON
    struct {
        const char *key, *text;
    } lines[LINES_MOST];
    const bl_parameter *parameters;
    char example[256]; // a command
} details;

static void tell_example(details *d, const char *format, const char *name) {
    snprintf(d->example, sizeof d->example, format, name);
}

// A subject that has the choice.
static void tell_trade(details *d, const bl_call *call, const bl_trade *trade) {
    static const char *const subjects[] = {"spectrum",   "gnoise", "vnoise", "vcnoise", "scnoise",
                                           "fractalsum", "bias",   "step",   "brick",   NULL};
    for (const char *const *subject = subjects; *subject && !*d->example; subject++) {
        bl_signal *signal = NULL;
        if (subject != subjects && bl_source_open(*subject, call->isa, &signal, NULL) != BL_OK)
            continue;
        if (trade->applies(signal, signal ? NULL : *subject))
            snprintf(d->example, sizeof d->example, "bandlimit trade %s --trade %s", *subject,
                     trade->name);
        bl_signal_free(signal);
    }
    d->lines[0].key = "error";
    d->lines[0].text = trade->error_name;
    d->lines[1].key = "sample";
    d->lines[1].text = trade->sample;
}

static details details_of(const bl_call *call, const bl_registry *registry, const void *thing) {
    const char *name = ((const bl_entry *)thing)->name;
    details d = {.summary_key = "summary"};
    if (registry == &bl_noises) {
        tell_example(&d, "bandlimit spectrum %s", name);
    } else if (registry == &bl_primitives) {
        tell_example(&d, "bandlimit eval %s 0.5", name);
    } else if (registry == &bl_textures) {
        tell_example(&d, "bandlimit alias %s -o out", name);
    } else if (registry == &bl_filters) {
        tell_example(&d, "bandlimit show %s --plot filter.svg", name);
    } else if (registry == &bl_views) {
        const bl_view_kind *view = thing;
        d.lines[0].key = "formula";
        d.lines[0].text = view->formula;
        d.parameters = view->parameters;
        tell_example(&d, "bandlimit alias brick --view %s", name);
    } else if (registry == &bl_methods) {
        d.parameters = ((const bl_method_kind *)thing)->parameters;
        tell_example(&d, "bandlimit alias brick --method %s", name);
    } else if (registry == &bl_sources) {
        const bl_source *source = thing;
        d.lines[0].key = "form";
        d.lines[0].text = source->form;
        d.parameters = source->parameters;
        tell_example(&d, "bandlimit spectrum '%s'", source->example);
    } else if (registry == &bl_trades) {
        d.summary_key = "question";
        tell_trade(&d, call, thing);
    } else if (registry == &bl_properties) {
        d.summary_key = "question";
        d.lines[0].key = "entry";
        d.lines[0].text = ((const bl_property *)thing)->entry;
        tell_example(&d, "bandlimit score gnoise --only %s", name);
    } else if (registry == &bl_figures) {
        d.summary_key = "question";
        d.lines[0].key = "shows";
        d.lines[0].text = ((const bl_figure *)thing)->shows;
        tell_example(&d, "bandlimit reproduce %s", name);
    } else {
        tell_example(&d, "bandlimit help %s", name);
    }
    return d;
}

// --- showing ------------------------------------------------------------------------------------

static void print_example(FILE *out, const details *d) {
    fprintf(out, "example      %s\n", d->example);
}

// What stands in a registry and is no signal.
static bl_status show_entry(bl_call *call, const bl_registry *registry, const void *thing) {
    const bl_entry *entry = thing;
    details d = details_of(call, registry, thing);
    json_t *object = bl_json_start(call);
    if (object) {
        bl_json_set_text(object, "kind", registry->kind);
        bl_json_set_text(object, "name", entry->name);
        bl_json_set_text(object, "title", entry->title);
        bl_json_set_text(object, d.summary_key, entry->summary);
        for (int i = 0; i < LINES_MOST && d.lines[i].key; i++)
            bl_json_set_text(object, d.lines[i].key, d.lines[i].text);
        bl_json_set_text(object, "paper", bl_entry_paper(entry));
        bl_json_set_text(object, "example", d.example);
        if (d.parameters)
            json_object_set_new(object, "parameters", parameters_json(d.parameters));
        return BL_OK;
    }
    fprintf(call->out, "%s: %s\n", entry->name, entry->title);
    if (entry->summary)
        fprintf(call->out, "\n%s\n", entry->summary);
    for (int i = 0; i < LINES_MOST && d.lines[i].key; i++)
        fprintf(call->out, "\n%s\n  %s\n", d.lines[i].key, d.lines[i].text);
    fprintf(call->out, "\nsource       %s\n", bl_entry_paper(entry));
    print_example(call->out, &d);
    if (d.parameters && d.parameters->key)
        print_parameters(call->out, d.parameters);
    return BL_OK;
}

static bl_status show_definition(bl_call *call, const bl_registry *registry, const char *text) {
    bl_signal *signal;
    bl_status status = bl_source_open(text, call->isa, &signal, &call->message);
    if (status != BL_OK)
        return status;
    const bl_definition *definition = signal->definition;
    details d = details_of(call, registry, definition);
    json_t *object = bl_json_start(call);
    if (object) {
        bl_json_set_text(object, "kind", registry->kind);
        bl_json_set_text(object, "name", definition->name);
        bl_json_set_text(object, "signal", signal->text);
        bl_json_set_text(object, "title", definition->title);
        bl_json_set_text(object, "summary", definition->summary);
        bl_json_set_text(object, "formula", definition->formula);
        bl_json_set_text(object, "paper", definition->paper);
        bl_json_set_count(object, "dimensions", signal->dimensions);
        bl_json_set_text(object, "example", d.example);
        json_object_set_new(object, "parameters", parameters_json(definition->parameters));
        facts_json(object, signal);
    } else {
        fprintf(call->out, "%s: %s\n\n%s\n\nformula\n  %s\n", definition->name, definition->title,
                definition->summary, definition->formula);
        fprintf(call->out, "\nsource       %s\ndimensions   %u\n", definition->paper,
                signal->dimensions);
        print_note(call->out, signal);
        print_example(call->out, &d);
        print_parameters(call->out, definition->parameters);
        print_facts(call->out, signal);
    }
    bl_signal_free(signal);
    return BL_OK;
}

static void print_source(FILE *out, const bl_source *source, const bl_signal *signal) {
    bl_plain_text(out, signal->text);
    fprintf(out, ": %s\n\ndimensions   %u\n", source->title, signal->dimensions);
    if (!source->sampled)
        fprintf(out, "seed         %s\n",
                signal->seed_offset == SIZE_MAX ? "none: {seed} stands nowhere in the words"
                                                : "it can be reseeded");
    for (unsigned a = 0; a < signal->dimensions && signal->extent.size[a]; a++)
        fprintf(out, "axis %c       %zu sample%s, %g unit%s between them\n", "xyzw"[a],
                signal -> extent.size[a], bl_plural(signal->extent.size[a]),
                signal->extent.spacing[a], signal->extent.spacing[a] == 1 ? "" : "s");
    print_note(out, signal);
    if (!source->sampled || !isnan(signal->facts.period[0]))
        print_facts(out, signal);
}

static bl_status show_source(bl_call *call, const bl_source *source, const char *text) {
    bl_signal *signal;
    bl_status status = bl_call_open(call, text, &signal);
    if (status != BL_OK)
        return status;
    json_t *object = bl_json_start(call);
    if (object) {
        json_t *size = json_array();
        for (unsigned a = 0; a < signal->dimensions; a++)
            json_array_append_new(size, json_integer((json_int_t)signal->extent.size[a]));
        bl_json_set_text(object, "kind", source->kind);
        bl_json_set_text(object, "signal", signal->text);
        bl_json_set_count(object, "dimensions", signal->dimensions);
        json_object_set_new(object, "size", size);
        bl_json_set_numbers(object, "spacing_units", signal->extent.spacing, signal->dimensions);
        facts_json(object, signal);
    } else {
        print_source(call->out, source, signal);
    }
    bl_signal_free(signal);
    return BL_OK;
}

static bl_status report_unknown(bl_call *call, const char *name) {
    const bl_unknown unknown = {.what = "name",
                                .word = name,
                                .registries = call->registries,
                                .all = "`bandlimit list` shows all"};
    return bl_report_unknown(&unknown, &call->message);
}

typedef struct show_settings {
    const char *plot;
} show_settings;

static int takes_settings(const bl_registry *registry) {
    return registry == &bl_noises || registry == &bl_primitives || registry == &bl_textures;
}

static bl_status show_thing(bl_call *call, const bl_registry *registry, const void *thing) {
    return registry == &bl_filters ? bl_show_filter(call, thing, NULL)
                                   : show_entry(call, registry, thing);
}

static bl_status show_named(bl_call *call, const bl_spec *spec, const char *text) {
    for (const bl_registry *const *registry = call->registries; *registry; registry++) {
        if (!bl_registry_find(*registry, spec->name))
            continue;
        return takes_settings(*registry)
                   ? show_definition(call, *registry, text)
                   : bl_report(&call->message, BL_USAGE,
                               "'%s': a %s is shown without settings, as `bandlimit show %s`", text,
                               (*registry)->kind, spec->name);
    }
    return report_unknown(call, spec->name);
}

static bl_status run_show(bl_call *call) {
    const show_settings *settings = call->settings;
    const char *text = call->operands.words[0];
    const bl_source *source = bl_source_of(text);
    const bl_filter *filter = settings->plot ? bl_filter_find(text) : NULL;
    bl_spec spec;
    if (filter)
        return bl_show_filter(call, filter, settings->plot);
    if (settings->plot)
        return bl_report(&call->message, BL_USAGE,
                         "--plot draws filters, and '%s' is none; `bandlimit list filters` shows "
                         "them, `render` and `spectrum` draw signals",
                         text);
    // A figure's name may hold a dot, as that of a file does, and a folder may be called as a verb.
    for (const bl_registry *const *registry = call->registries; *registry; registry++)
        if (!takes_settings(*registry) && bl_registry_find(*registry, text))
            return show_thing(call, *registry, bl_registry_find(*registry, text));
    if (source)
        return show_source(call, source, text);
    bl_status status = bl_spec_parse(text, &spec, &call->message);
    if (status != BL_OK)
        return status;
    status = show_named(call, &spec, text);
    bl_spec_free(&spec);
    return status;
}

static const bl_option options[] = {
    {"plot", BL_OPTION_WORD, offsetof(show_settings, plot), "PATH",
     .help = "of a filter: draw kernel, step and response to PATH, which ends in .svg or .png"},
    {0}};

const bl_verb bl_verb_show = {
    .name = "show",
    .operands = "NAME",
    .summary = "definition, parameters, facts, source",
    .text =
        "NAME is anything that `bandlimit list` shows. A noise, primitive or texture may have "
        "settings (the facts are those for the settings). It may also be a file, a function "
        "./lib.so:NAME, or a program cmd:PROGRAM.",
    .least = 1,
    .most = 1,
    .output_help = "write the text to PATH instead of stdout",
    .options = options,
    .settings_size = sizeof(show_settings),
    .run = run_show,
};
