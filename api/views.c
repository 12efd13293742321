// SPDX-License-Identifier: MIT
//
// Chapter 6: sampling under a view.
#include "api/api.h"

#include <stdlib.h>

#include "aliasing/usual_methods.h"
#include "score/advise.h"

// What both measurements need: the view, the methods, and the settings of the caller.
typedef struct view_scene {
    bandlimit_view_settings given;
    bl_view view;
    const char *usual[BL_METHODS_MOST];
    const char *const *methods;
    size_t count;
} view_scene;

static bl_status open_scene(const bl_signal *signal, const bandlimit_view_settings *settings,
                            const char *usual_view, view_scene *scene, bandlimit_message *message) {
    bl_status status = BL_API_TAKE(settings, &scene->given, bandlimit_view_settings, message);
    if (status != BL_OK)
        return status;
    const bandlimit_view_settings *given = &scene->given;
    const size_t side = given->effort == BANDLIMIT_QUICK ? 64 : 128;
    scene->methods = given->method_count ? given->methods : scene->usual;
    scene->count =
        given->method_count ? given->method_count : bl_usual_methods(signal, scene->usual);
    return bl_view_open(given->view ? given->view : usual_view, given->width ? given->width : side,
                        given->height ? given->height : side, &scene->view,
                        bl_api_message(message));
}

static void settle(const bandlimit_view_settings *given, bl_alias_settings *settings) {
    settings->pixel = given->gaussian ? BL_PIXEL_GAUSSIAN : BL_PIXEL_BOX;
    settings->seed = BL_API_SEED(*given);
    settings->threads = given->threads;
    settings->cache = given->cache;
}

bandlimit_status bandlimit_alias_measure(const bandlimit_signal *signal,
                                         const bandlimit_view_settings *settings,
                                         bandlimit_alias *alias, bandlimit_message *message) {
    view_scene scene;
    bl_status status = BL_API_CHECK(alias, bandlimit_alias, message);
    if (status == BL_OK)
        status = open_scene(bl_api_signal(signal), settings, "flat", &scene, message);
    if (status != BL_OK)
        return (bandlimit_status)status;
    bl_alias_settings own = bl_alias_settings_of_size(bl_api_size(scene.given.effort));
    settle(&scene.given, &own);
    bl_alias_result *room = bl_api_room(sizeof *room, message);
    status = room ? bl_alias_measure(bl_api_signal(signal), &scene.view, scene.methods, scene.count,
                                     &own, room, bl_api_message(message))
                  : BL_DEVICE;
    bl_view_close(&scene.view);
    if (status == BL_OK)
        *alias = (bandlimit_alias){.bytes = sizeof *alias,
                                   .count = room->count,
                                   .width = room->reference.width,
                                   .height = room->reference.height,
                                   .seen = room->seen,
                                   .reference = room->reference.rgb,
                                   .reference_error = room->reference_error,
                                   .owned = room};
    return bl_api_end(status, signal, room, message);
}

bandlimit_status bandlimit_alias_row_at(const bandlimit_alias *alias, size_t index,
                                        bandlimit_alias_row *row, bandlimit_message *message) {
    const bl_alias_result *room = alias->owned;
    bl_status status = BL_API_CHECK(row, bandlimit_alias_row, message);
    if (status == BL_OK)
        status = bl_api_index(index, alias->count, "method", message);
    if (status != BL_OK)
        return (bandlimit_status)status;
    const bl_alias_row *own = &room->rows[index];
    *row = (bandlimit_alias_row){.bytes = sizeof *row,
                                 .method = own->method,
                                 .alias = bl_api_estimate(&own->alias),
                                 .blur = bl_api_estimate(&own->blur),
                                 .mse = bl_api_estimate(&own->mse),
                                 .ssim = bl_api_estimate(&own->ssim),
                                 .flicker = bl_api_estimate(&own->flicker),
                                 .psnr_db = own->psnr_db,
                                 .max_error = own->max_error,
                                 .predicted_alias = own->predicted_alias,
                                 .predicted_blur = own->predicted_blur,
                                 .samples = own->samples,
                                 .ns = own->ns_per_sample,
                                 .ns_lowest = own->ns_lowest,
                                 .ns_highest = own->ns_highest,
                                 .image = own->image};
    return BANDLIMIT_OK;
}

void bandlimit_alias_free(bandlimit_alias *alias) {
    BL_API_RELEASE(alias, bl_alias_free);
}

static void show_advice(bl_advice *room, bandlimit_advice *advice) {
    const bl_alias_row *chosen = &room->alias.rows[room->chosen];
    *advice = (bandlimit_advice){.bytes = sizeof *advice,
                                 .verdict = (bandlimit_verdict)room->verdict,
                                 .method = chosen->method,
                                 .error = bl_api_estimate(&room->error[room->chosen]),
                                 .ns = chosen->ns_per_sample,
                                 .least_width = room->needs.least_width,
                                 .most_width = room->needs.most_width,
                                 .octaves = room->needs.octaves,
                                 .octaves_seen = room->needs.octaves_seen,
                                 .owned = room};
    if (room->cheaper == SIZE_MAX)
        return;
    advice->cheaper = room->alias.rows[room->cheaper].method;
    advice->cheaper_error = bl_api_estimate(&room->error[room->cheaper]);
    advice->cheaper_ns = room->alias.rows[room->cheaper].ns_per_sample;
}

bandlimit_status bandlimit_advise(const bandlimit_signal *signal,
                                  const bandlimit_view_settings *settings, bandlimit_advice *advice,
                                  bandlimit_message *message) {
    view_scene scene;
    bl_status status = BL_API_CHECK(advice, bandlimit_advice, message);
    if (status == BL_OK)
        status = open_scene(bl_api_signal(signal), settings, "plane", &scene, message);
    if (status != BL_OK)
        return (bandlimit_status)status;
    bl_advise_settings own = bl_advise_settings_of_size(bl_api_size(scene.given.effort));
    settle(&scene.given, &own.alias);
    own.largest = scene.given.largest;
    if (scene.given.tolerance != 0)
        own.tolerance = scene.given.tolerance;
    bl_advice *room = bl_api_room(sizeof *room, message);
    status = room ? bl_advise(bl_api_signal(signal), &scene.view, scene.methods, scene.count, &own,
                              room, bl_api_message(message))
                  : BL_DEVICE;
    bl_view_close(&scene.view);
    if (status == BL_OK)
        show_advice(room, advice);
    return bl_api_end(status, signal, room, message);
}

void bandlimit_advice_free(bandlimit_advice *advice) {
    BL_API_RELEASE(advice, bl_advice_free);
}
