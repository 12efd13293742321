// SPDX-License-Identifier: MIT
#include "reports/figures/gallery.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "sources/source.h"

enum { LONGEST_LABEL = 44, LONGEST_KEY = 40 };

// The text without its seed, short enough for the head of a panel.
static const char *label_of(bl_run *run, const bl_signal *signal) {
    const char *text = bl_run_keep(run, bl_source_text_unseeded(signal), free);
    return bl_run_text(run, strlen(text) > LONGEST_LABEL ? "%.*s..." : "%.*s", LONGEST_LABEL, text);
}

// Letters and digits of the label; what repeats an earlier key gets its number.
static const char *key_of(bl_run *run, const bl_gallery *gallery, size_t index, const char *label) {
    char key[LONGEST_KEY + 1];
    size_t used = 0;
    for (; *label && used < LONGEST_KEY; label++) {
        int plain = isalnum((unsigned char)*label);
        if (plain || (used && key[used - 1] != '-'))
            key[used++] = plain ? *label : '-';
    }
    while (used && key[used - 1] == '-')
        used--;
    key[used] = '\0';
    int taken = used == 0;
    for (size_t i = 0; i < index; i++)
        taken |= strcmp(gallery->key[i], key) == 0;
    return taken ? bl_run_text(run, "%s%s%zu", key, used ? "-" : "", index + 1)
                 : bl_run_text(run, "%s", key);
}

bl_gallery bl_gallery_open(bl_run *run, const char *const *texts, size_t count) {
    const char **labels = bl_run_memory(run, count, sizeof *labels);
    const char **keys = bl_run_memory(run, count, sizeof *keys);
    bl_signal **signals = bl_run_memory(run, count, sizeof *signals);
    bl_gallery gallery = {.signal = signals, .label = labels, .key = keys};
    for (size_t i = 0; i < count; i++) {
        signals[i] = bl_run_seeded_signal(run, texts[i]);
        labels[i] = label_of(run, signals[i]);
        keys[i] = key_of(run, &gallery, i, labels[i]);
        gallery.count++;
        bl_run_setting(run, bl_run_text(run, "signal (%c%.0zu)", (int)('a' + i % 26), i / 26),
                       signals[i]->text);
    }
    return gallery;
}

size_t bl_gallery_columns(size_t count) {
    return count < 3 ? (count ? count : 1) : count == 4 ? 2 : count > 9 ? 4 : 3;
}
