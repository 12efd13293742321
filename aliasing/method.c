// SPDX-License-Identifier: MIT
#include "aliasing/method.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

void bl_method_close(bl_method *method) {
    free(method->parameters);
    free(method->text);
    if (!method->borrowed)
        bl_signal_free(method->signal);
    *method = (bl_method){0};
}

// The raw colour at what is seen, or the background.
void bl_scene_point(const bl_scene *scene, double x, double y, double rgb[3]) {
    static const double none[BL_AXES] = {0};
    bl_sight sight;
    if (bl_view_see(scene->view, x, y, &sight))
        bl_signal_colour(scene->signal, sight.at, none, rgb);
    else
        memcpy(rgb, scene->background, 3 * sizeof *rgb);
}
