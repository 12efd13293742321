// SPDX-License-Identifier: MIT
#include "aliasing/view.h"

#include <stdlib.h>
#include <string.h>

#define BL_VIEW(stem) extern const bl_view_kind bl_view_##stem;
#include "aliasing/views.def"
#undef BL_VIEW

static const bl_view_kind *const registry[] = {
#define BL_VIEW(stem) &bl_view_##stem,
#include "aliasing/views.def"
#undef BL_VIEW
};
enum { VIEW_COUNT = sizeof registry / sizeof *registry };

size_t bl_view_count(void) {
    return VIEW_COUNT;
}

const bl_view_kind *bl_view_at(size_t index) {
    return index < VIEW_COUNT ? registry[index] : NULL;
}

const bl_view_kind *bl_view_find(const char *name) {
    for (size_t i = 0; i < VIEW_COUNT; i++)
        if (strcmp(registry[i]->name, name) == 0)
            return registry[i];
    return NULL;
}

static bl_status report_unknown(const char *name, bl_message *message) {
    const char *names[VIEW_COUNT + 1] = {NULL};
    for (size_t i = 0; i < VIEW_COUNT; i++)
        names[i] = registry[i]->name;
    const char *near = bl_nearest(name, names);
    return bl_report(message, BL_USAGE,
                     "unknown view '%s' at column 1%s%s%s `bandlimit list views` shows all", name,
                     near ? "; did you mean '" : "", near ? near : "", near ? "'?" : ";");
}

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
    status =
        kind ? open_kind(kind, &spec, text, view, message) : report_unknown(spec.name, message);
    bl_spec_free(&spec);
    return status;
}

void bl_view_close(bl_view *view) {
    free(view->parameters);
    free(view->text);
    *view = (bl_view){0};
}

int bl_view_see(const bl_view *view, double x, double y, bl_sight *sight) {
    const double size[2] = {(double)view->width, (double)view->height};
    if (view->zoom == 1)
        return view->kind->see(view->parameters, size, x + view->pan[0], y + view->pan[1], sight);
    double factor = 1 / view->zoom, right = x + view->pan[0] - 0.5 * size[0],
           down = y + view->pan[1] - 0.5 * size[1];
    int seen = view->kind->see(view->parameters, size, 0.5 * size[0] + factor * right,
                               0.5 * size[1] + factor * down, sight);
    for (int a = 0; a < BL_AXES && seen; a++) {
        sight->across[a] *= factor;
        sight->down[a] *= factor;
        for (int i = 0; i < 3; i++)
            sight->second[a][i] *= factor * factor;
    }
    return seen;
}
