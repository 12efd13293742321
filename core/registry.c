// SPDX-License-Identifier: MIT
#include "core/registry.h"

#include <ctype.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

const void *bl_registry_at(const bl_registry *registry, size_t index) {
    return index < registry->count ? registry->list[index] : NULL;
}

const bl_entry *bl_registry_entry(const bl_registry *registry, size_t index) {
    return registry->list[index];
}

const void *bl_registry_find(const bl_registry *registry, const char *name) {
    for (size_t i = 0; i < registry->count; i++)
        if (strcmp(bl_registry_entry(registry, i)->name, name) == 0)
            return registry->list[i];
    return NULL;
}

const char *bl_entry_paper(const bl_entry *entry) {
    return entry->paper ? entry->paper : "bandlimit";
}

// --- the nearest word ---------------------------------------------------------------------------

static size_t smallest(size_t a, size_t b, size_t c) {
    size_t least = a < b ? a : b;
    return least < c ? least : c;
}

enum { LONGEST_WORD = 63 };

// Levenshtein's distance, one row at a time.
static size_t edit_distance(const char *a, const char *b) {
    size_t rows[LONGEST_WORD + 1], length = strlen(b);
    for (size_t j = 0; j <= length; j++)
        rows[j] = j;
    for (size_t i = 1; a[i - 1]; i++) {
        size_t diagonal = rows[0];
        rows[0] = i;
        for (size_t j = 1; j <= length; j++) {
            int differs = tolower((unsigned char)a[i - 1]) != tolower((unsigned char)b[j - 1]);
            size_t change = diagonal + (size_t)differs;
            diagonal = rows[j];
            rows[j] = smallest(rows[j] + 1, rows[j - 1] + 1, change);
        }
    }
    return rows[length];
}

typedef struct search {
    const char *word, *best;
    size_t least;
} search;

// A number is no slip of another one.
static void try_candidate(search *near, const char *candidate) {
    size_t length = strlen(near->word);
    int is_number = near->word[strspn(near->word, "0123456789.+-")] == '\0';
    if (is_number || length > LONGEST_WORD || strlen(candidate) > LONGEST_WORD)
        return;
    size_t distance = edit_distance(near->word, candidate);
    if (distance < near->least && distance <= (length + 1) / 2) {
        near->least = distance;
        near->best = candidate;
    }
}

const char *bl_nearest(const char *word, const char *const *candidates) {
    search near = {word, NULL, SIZE_MAX};
    for (; *candidates; candidates++)
        try_candidate(&near, *candidates);
    return near.best;
}

// --- unknown words ------------------------------------------------------------------------------

// A list of words, told if it is short.
typedef struct telling {
    char text[384];
    size_t used;
    search near;
} telling;

static void tell(telling *told, const char *word) {
    try_candidate(&told->near, word);
    if (told->used < sizeof told->text)
        told->used += (size_t)snprintf(told->text + told->used, sizeof told->text - told->used,
                                       "%s%s", told->used ? ", " : "", word);
}

bl_status bl_report_unknown(const bl_unknown *unknown, bl_message *message) {
    const bl_registry *const *registry = unknown->registries;
    telling told = {.near = {unknown->word, NULL, SIZE_MAX}};
    char all[sizeof told.text + 16], meant[LONGEST_WORD + 24] = ";";
    for (const char *const *word = unknown->words; word && *word; word++)
        tell(&told, *word);
    for (; registry && *registry; registry++)
        for (size_t i = 0; i < (*registry)->count; i++)
            tell(&told, bl_registry_entry(*registry, i)->name);
    if (told.near.best)
        snprintf(meant, sizeof meant, "; did you mean '%s'?", told.near.best);
    if (told.used && (told.used < sizeof told.text || !unknown->all))
        snprintf(all, sizeof all, "%s are %s", told.near.best ? "There" : "there", told.text);
    else
        snprintf(all, sizeof all, "%s", unknown->all ? unknown->all : "there are none");
    const char *key = unknown->key ? unknown->key : "";
    return bl_report(message, BL_USAGE, "unknown %s '%s%s%s'%s%s %s", unknown->what, key,
                     *key == '-' ? " "
                     : *key      ? "="
                                 : "",
                     unknown->word, unknown->where ? unknown->where : "", meant, all);
}

bl_status bl_registry_report(const bl_registry *registry, const char *word, const char *where,
                             bl_message *message) {
    char all[64];
    snprintf(all, sizeof all, "`bandlimit list %s` shows all", registry->kinds);
    const bl_unknown unknown = {.what = registry->kind,
                                .word = word,
                                .where = where,
                                .registries = (const bl_registry *const[]){registry, NULL},
                                .all = all};
    return bl_report_unknown(&unknown, message);
}
