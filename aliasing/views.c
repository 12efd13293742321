// SPDX-License-Identifier: MIT
//
// The list of all views, and the opening of one by its text.
#include "aliasing/view.h"

#include <stdlib.h>

#define BL_VIEW(stem) extern const bl_view_kind bl_view_##stem;
#include "aliasing/views.def"
#undef BL_VIEW

static const void *const list[] = {
#define BL_VIEW(stem) &bl_view_##stem,
#include "aliasing/views.def"
#undef BL_VIEW
};

const bl_registry bl_views = {"view", "views", list, sizeof list / sizeof *list};

static bl_status open_kind(const bl_view_kind *kind, const bl_spec *spec, const char *text,
                           bl_view *view, bl_message *message) {
    void *block = calloc(1, kind->parameters_size);
    if (!block)
        return bl_report(message, BL_DEVICE, "out of memory opening '%s'", text);
    bl_status status = bl_parameters_read(kind->parameters, spec, text, block, message);
    if (status == BL_OK && kind->validate)
        status = kind->validate(block, message);
    char *canonical =
        status == BL_OK ? bl_parameters_text(kind->name, kind->parameters, block) : NULL;
    if (status == BL_OK && !canonical)
        status = bl_report(message, BL_DEVICE, "out of memory opening '%s'", text);
    if (status != BL_OK) {
        free(block);
        return status;
    }
    view->kind = kind;
    view->parameters = block;
    view->text = canonical;
    return BL_OK;
}

bl_status bl_view_open(const char *text, size_t width, size_t height, bl_view *view,
                       bl_message *message) {
    bl_spec spec;
    *view = (bl_view){.width = width, .height = height, .zoom = 1};
    bl_status status = bl_spec_parse(text, &spec, message);
    if (status != BL_OK)
        return status;
    const bl_view_kind *kind = bl_view_find(spec.name);
    status = kind ? open_kind(kind, &spec, text, view, message)
                  : bl_registry_report(&bl_views, spec.name, " at column 1", message);
    view->asked[2] = bl_spec_get(&spec, "z") != NULL;
    view->asked[3] = bl_spec_get(&spec, "w") != NULL;
    bl_spec_free(&spec);
    return status;
}
