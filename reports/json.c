// SPDX-License-Identifier: MIT
//
// The JSON of a figure: "schema": "bandlimit.figure/1". It holds no times and no paths, so that the
// same settings give the same bytes. "No limit" and "not measured" are null.
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/version.h"
#include "reports/record.h"
#include "reports/output.h"
#include "reports/table_json.h"

static json_t *claim_json(const bl_claim *claim) {
    const bl_estimate *m = &claim->measured;
    int known = m->level > 0; // else no interval was estimated
    return json_pack(
        "{s:s, s:s, s:s, s:s, s:[o,o], s:o, s:[o,o], s:o, s:o, s:s, s:s}", "claim", claim->sentence,
        "source", claim->source, "reading", claim->reading, "unit", claim->unit, "expected",
        bl_json_number(claim->expected_lower), bl_json_number(claim->expected_upper), "measured",
        bl_json_number(m->value), "interval", bl_json_number(known ? m->lower : NAN),
        bl_json_number(known ? m->upper : NAN), "level", bl_json_number(known ? m->level : NAN),
        "samples", bl_json_number(m->samples), "samples_of", claim->counted ? claim->counted : "",
        "verdict", bl_outcome_word(bl_claim_outcome(claim)));
}

static json_t *settings_json(const bl_run_record *record) {
    json_t *object = json_object();
    for (size_t i = 0; i < record->setting_count; i++)
        json_object_set_new(object, record->settings[i].name,
                            json_string(record->settings[i].text));
    return object;
}

static json_t *outcomes_json(const bl_figure_result *result) {
    json_t *object = json_object();
    for (int v = 0; v <= BL_NOT_RUN; v++)
        json_object_set_new(object, bl_outcome_word((bl_outcome)v),
                            json_integer((json_int_t)result->outcomes[v]));
    return object;
}

static json_t *figure_json(const bl_run_record *record, const bl_reproduce_settings *settings) {
    const bl_figure_result *result = record->result;
    const bl_figure *figure = result->figure;
    json_t *claims = json_array();
    for (size_t i = 0; i < result->claim_count; i++)
        json_array_append_new(claims, claim_json(&result->claims[i]));
    return json_pack("{s:s, s:s, s:s, s:s, s:s, s:s, s:s, s:s, s:s, s:o, s:o, s:o, s:o, s:o, s:o}",
                     "schema", "bandlimit.figure/1", "version", BL_VERSION, "arguments",
                     settings->arguments ? settings->arguments : "", "figure", figure->name,
                     "title", figure->title, "question", figure->question, "paper", figure->paper,
                     "shows", figure->shows, "size", bl_size_word(settings->size), "seed",
                     bl_json_count(settings->seed), "settings", settings_json(record), "verdicts",
                     outcomes_json(result), "claims", claims, "files",
                     bl_json_texts(result->files, result->file_count), "warnings",
                     bl_json_texts(result->warnings, result->warning_count));
}

bl_status bl_run_write_json(const bl_run_record *record, const bl_reproduce_settings *settings,
                            bl_message *message) {
    json_t *json = figure_json(record, settings);
    char *text = json ? json_dumps(json, JSON_INDENT(2) | JSON_REAL_PRECISION(9)) : NULL;
    json_decref(json);
    bl_file file;
    bl_status status = text ? bl_output_create(record->result->folder, record->result->figure->name,
                                               "json", &file, message)
                            : bl_report(message, BL_DEVICE, "out of memory");
    if (status == BL_OK) {
        fprintf(file.stream, "%s\n", text);
        status = bl_file_commit(&file, message);
    }
    free(text);
    return status;
}
