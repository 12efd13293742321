// SPDX-License-Identifier: MIT
#include "aliasing/method.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/setting.h"

// The keys whose words are ways that a signal filters itself: those of textures and primitives, and
// those of sums of octaves.
static const char *const own_keys[] = {"filter", "clamp"};
enum { OWN_KEYS = sizeof own_keys / sizeof *own_keys };

const char *bl_method_own_key(const bl_signal *signal) {
    for (size_t k = 0; k < OWN_KEYS && signal->functions->filtered; k++)
        if (bl_signal_choices(signal, own_keys[k]))
            return own_keys[k];
    return NULL;
}

const char *const *bl_method_own_words(const bl_signal *signal) {
    static const char *const none[] = {NULL};
    const char *key = bl_method_own_key(signal);
    return key ? bl_signal_choices(signal, key) : none;
}

int bl_method_is_own(const bl_signal *signal, const char *word) {
    for (const char *const *own = bl_method_own_words(signal); *own; own++)
        if (strcmp(*own, word) == 0)
            return 1;
    return 0;
}

bl_status bl_method_open_own(const bl_signal *signal, const char *word, const char *width,
                             bl_signal **filtered, bl_message *message) {
    bl_signal *chosen;
    if (!bl_method_is_own(signal, word))
        return bl_report(message, BL_USAGE, "'%s' has no filter '%s'", signal->text, word);
    bl_status status =
        bl_signal_with_setting(signal, bl_method_own_key(signal), word, &chosen, message);
    if (status != BL_OK)
        return status;
    status = bl_signal_with_setting(chosen, "width", width, filtered, message);
    bl_signal_free(chosen);
    return status;
}

void bl_method_close(bl_method *method) {
    free(method->parameters);
    free(method->text);
    if (!method->borrowed)
        bl_signal_free(method->signal);
    *method = (bl_method){0};
}

// The colours at what is seen, or the background: of points where there is no rule.
static void fill_batch(const bl_scene *scene, const bl_width_rule *rule, const double *x,
                       const double *y, size_t count, double *rgb) {
    bl_footprint footprint[BL_BATCH];
    bl_gathered seen = {.count = 0};
    double colour[3 * BL_BATCH];
    for (size_t i = 0; i < count; i++) {
        bl_sight sight;
        memcpy(rgb + 3 * i, scene->background, 3 * sizeof *rgb);
        if (!bl_view_see(scene->view, x[i], y[i], &sight))
            continue;
        if (rule)
            footprint[seen.count] = bl_sight_footprint(&sight, rule);
        bl_gather(&seen, i, sight.at);
    }
    const bl_samples samples =
        bl_gathered_samples(&seen, rule ? footprint : &bl_footprint_point, rule != NULL);
    bl_signal_colours(scene->signal, &samples, colour);
    for (size_t k = 0; k < seen.count; k++)
        memcpy(rgb + 3 * seen.of[k], colour + 3 * k, 3 * sizeof *rgb);
}

void bl_scene_filtered(const bl_scene *scene, const bl_width_rule *rule, const double *x,
                       const double *y, size_t count, double *rgb) {
    for (size_t done = 0; done < count; done += BL_BATCH) {
        size_t here = count - done < BL_BATCH ? count - done : BL_BATCH;
        fill_batch(scene, rule, x + done, y + done, here, rgb + 3 * done);
    }
}

void bl_scene_points(const bl_scene *scene, const double *x, const double *y, size_t count,
                     double *rgb) {
    bl_scene_filtered(scene, NULL, x, y, count, rgb);
}

void bl_scene_point(const bl_scene *scene, double x, double y, double rgb[3]) {
    bl_scene_points(scene, &x, &y, 1, rgb);
}
