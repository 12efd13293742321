// SPDX-License-Identifier: MIT
//
// Chapter 4: what there is, out of all registries.
#include "api/api.h"

#include "aliasing/method.h"
#include "filters/filter.h"
#include "filters/primitive.h"
#include "noises/noise.h"
#include "reports/figure.h"
#include "score/score.h"
#include "score/trade.h"
#include "textures/texture.h"

static const bl_registry *const registries[] = {
    [BANDLIMIT_NOISES] = &bl_noises,     [BANDLIMIT_PRIMITIVES] = &bl_primitives,
    [BANDLIMIT_TEXTURES] = &bl_textures, [BANDLIMIT_FILTERS] = &bl_filters,
    [BANDLIMIT_VIEWS] = &bl_views,       [BANDLIMIT_METHODS] = &bl_methods,
    [BANDLIMIT_TRADES] = &bl_trades,     [BANDLIMIT_PROPERTIES] = &bl_properties,
    [BANDLIMIT_FIGURES] = &bl_figures};

// What an entry has beside its head, by its kind; the keys of its text are returned.
static const bl_parameter *fill_rest(bandlimit_kind kind, const void *thing,
                                     bandlimit_entry *entry) {
    const bl_parameter *parameters = NULL;
    if (kind <= BANDLIMIT_TEXTURES) {
        const bl_definition *definition = thing;
        entry->formula = definition->formula;
        entry->dimensions = definition->dimensions;
        parameters = definition->parameters;
    } else if (kind == BANDLIMIT_FILTERS) {
        entry->formula = ((const bl_filter *)thing)->formula;
    } else if (kind == BANDLIMIT_VIEWS) {
        entry->formula = ((const bl_view_kind *)thing)->formula;
        parameters = ((const bl_view_kind *)thing)->parameters;
    } else if (kind == BANDLIMIT_METHODS) {
        parameters = ((const bl_method_kind *)thing)->parameters;
    }
    for (const bl_parameter *p = parameters; p && p->key; p++)
        entry->parameters++;
    return parameters;
}

static int is_kind(bandlimit_kind kind) {
    return (size_t)kind < sizeof registries / sizeof *registries;
}

size_t bandlimit_count(bandlimit_kind kind) {
    return is_kind(kind) ? registries[kind]->count : 0;
}

static bl_status find(bandlimit_kind kind, size_t index, bandlimit_entry *entry,
                      const bl_parameter **parameters, bandlimit_message *message) {
    bl_status status =
        bl_api_index(index, bandlimit_count(kind),
                     is_kind(kind) ? registries[kind]->kind : "thing of this kind", message);
    if (status != BL_OK)
        return status;
    const bl_entry *head = bl_registry_entry(registries[kind], index);
    *entry = (bandlimit_entry){.bytes = sizeof *entry,
                               .name = head->name,
                               .title = head->title,
                               .summary = head->summary,
                               .paper = bl_entry_paper(head)};
    *parameters = fill_rest(kind, head, entry);
    return BL_OK;
}

bandlimit_status bandlimit_entry_at(bandlimit_kind kind, size_t index, bandlimit_entry *entry,
                                    bandlimit_message *message) {
    const bl_parameter *parameters;
    bl_status status = BL_API_CHECK(entry, bandlimit_entry, message);
    if (status == BL_OK)
        status = find(kind, index, entry, &parameters, message);
    return (bandlimit_status)status;
}

bandlimit_status bandlimit_parameter_at(bandlimit_kind kind, size_t index, size_t number,
                                        bandlimit_parameter *parameter,
                                        bandlimit_message *message) {
    static const char *const words[] = {
        [BL_SEED] = "seed", [BL_INTEGER] = "integer", [BL_REAL] = "real",    [BL_CHOICE] = "choice",
        [BL_LIST] = "list", [BL_TEXT] = "text",       [BL_NESTED] = "signal"};
    bandlimit_entry entry;
    const bl_parameter *parameters;
    bl_status status = BL_API_CHECK(parameter, bandlimit_parameter, message);
    if (status == BL_OK)
        status = find(kind, index, &entry, &parameters, message);
    if (status == BL_OK)
        status = bl_api_index(number, entry.parameters, "parameter", message);
    if (status != BL_OK)
        return (bandlimit_status)status;
    const bl_parameter *own = &parameters[number];
    *parameter = (bandlimit_parameter){.bytes = sizeof *parameter,
                                       .key = own->key,
                                       .kind = words[own->kind],
                                       .minimum = own->minimum,
                                       .maximum = own->maximum,
                                       .fallback = own->fallback,
                                       .unit = own->unit,
                                       .help = own->help,
                                       .choices = own->kind == BL_CHOICE ? own->choices : NULL};
    return BANDLIMIT_OK;
}
