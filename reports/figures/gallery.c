// SPDX-License-Identifier: MIT
#include "reports/figures/gallery.h"

#include <ctype.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "sources/source.h"

enum { LONGEST_LABEL = 44, LONGEST_KEY = 40 };

// The text without its seed, short enough for the head of a panel.
static const char *label_of(bl_run *run, const char *text) {
    const char *seed = strstr(text, "seed=");
    if (!seed || seed == text || (seed[-1] != ':' && seed[-1] != ','))
        return bl_run_text(run, strlen(text) > LONGEST_LABEL ? "%.*s..." : "%.*s", LONGEST_LABEL,
                           text);
    const char *rest = seed + strcspn(seed, ",:"); // of a program, ":" and its words
    int before = (int)(seed - text) - 1;           // without the colon or the comma
    const char *joint = *rest != ',' ? "" : seed[-1] == ':' ? ":" : ",";
    const char *whole =
        bl_run_text(run, "%.*s%s%s", before, text, joint, *rest == ',' ? rest + 1 : rest);
    return strlen(whole) > LONGEST_LABEL ? bl_run_text(run, "%.*s...", LONGEST_LABEL, whole)
                                         : whole;
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

static bl_status open_one(bl_run *run, const char *text, bl_signal **signal, bl_message *message) {
    const bl_reproduce_settings *settings = bl_run_settings(run);
    bl_status status = bl_source_open(text, settings->isa, signal, message);
    if (status != BL_OK || (*signal)->seed_offset == SIZE_MAX || strstr(text, "seed="))
        return status;
    bl_signal *seeded = NULL;
    if (bl_source_is_file(text)) { // a program has its seed elsewhere
        status = bl_source_open_seeded(text, settings->seed, settings->isa, &seeded, message);
    } else {
        const char *with_seed =
            bl_run_text(run, "%s%cseed=%llu", text, strchr(text, ':') ? ',' : ':',
                        (unsigned long long)settings->seed);
        status = bl_source_open(with_seed, settings->isa, &seeded, message);
    }
    bl_signal_free(*signal);
    *signal = seeded; // NULL if that failed
    return status;
}

bl_status bl_gallery_open(bl_run *run, const char *const *texts, size_t count, bl_gallery *gallery,
                          bl_message *message) {
    const char **labels = calloc(count, sizeof *labels), **keys = calloc(count, sizeof *keys);
    *gallery = (bl_gallery){
        .signal = calloc(count, sizeof *gallery->signal), .label = labels, .key = keys};
    bl_status status =
        gallery->signal && labels && keys ? BL_OK : bl_report(message, BL_DEVICE, "out of memory");
    for (size_t i = 0; i < count && status == BL_OK; i++) {
        status = open_one(run, texts[i], &gallery->signal[i], message);
        if (status != BL_OK)
            break;
        const char *text = gallery->signal[i]->text;
        labels[i] = label_of(run, text);
        keys[i] = key_of(run, gallery, i, labels[i]);
        gallery->count++;
        bl_run_setting(run, bl_run_text(run, "signal (%c%.0zu)", (int)('a' + i % 26), i / 26),
                       text);
    }
    if (status != BL_OK)
        bl_gallery_close(gallery);
    return status;
}

void bl_gallery_close(bl_gallery *gallery) {
    for (size_t i = 0; i < gallery->count; i++)
        bl_signal_free(gallery->signal[i]);
    free(gallery->signal);
    free((void *)gallery->label);
    free((void *)gallery->key);
    *gallery = (bl_gallery){0};
}

size_t bl_gallery_columns(size_t count) {
    return count < 3 ? (count ? count : 1) : count == 4 ? 2 : count > 9 ? 4 : 3;
}
