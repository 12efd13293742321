// SPDX-License-Identifier: MIT
//
// Registries: all there is of one kind, and what is said of a word that names none of it.
//
// A kind of thing (a filter, a view, a figure) has three parts. Its contract is a header that every
// thing of the kind includes (filters/filter.h). Each thing is one file, which ends with one const
// descriptor. The list is a visible file with one line a thing (filters/filters.def); one source
// alone reads it (filters/filters.c) and makes the bl_registry. That source knows all things of the
// kind, and no thing uses it.
#ifndef BL_CORE_REGISTRY_H
#define BL_CORE_REGISTRY_H

#include <stddef.h>

#include "core/status.h"

// What every thing says of itself.
typedef struct bl_entry {
    const char *name;    // one word, in the registry and in texts: "catmull-rom"
    const char *title;   // "Catmull-Rom kernel"
    const char *summary; // one sentence; may be NULL
    const char
        *paper; // its source: key and page or section, or "bandlimit" for one of ours (NULL too)
} bl_entry;

// The head of every descriptor: a bl_entry, whose title and summary may have another name there.
#define BL_ENTRY(title, summary)                                                                   \
    union {                                                                                        \
        bl_entry head;                                                                             \
        struct {                                                                                   \
            const char *name, *title, *summary, *paper;                                            \
        };                                                                                         \
    }

typedef struct bl_registry {
    const char *kind, *kinds; // what one is called, and several: "filter", "filters"
    const void *const *list;  // the descriptors, each of which begins with its bl_entry
    size_t count;
} bl_registry;

// The descriptor at an index, NULL past the end; that of a name, NULL for an unknown one.
const void *bl_registry_at(const bl_registry *registry, size_t index);
const void *bl_registry_find(const bl_registry *registry, const char *name);
// What the descriptor at an index below the count says of itself.
const bl_entry *bl_registry_entry(const bl_registry *registry, size_t index);

// The source of an entry: "bandlimit" where it names none, since then it is one of ours.
const char *bl_entry_paper(const bl_entry *entry);

// Declares a registry and the same functions with the type of its descriptors: bl_filter_count,
// bl_filter_at, bl_filter_find.
#define BL_REGISTRY(type, stem, registry)                                                          \
    extern const bl_registry registry;                                                             \
    static inline size_t stem##_count(void) {                                                      \
        return registry.count;                                                                     \
    }                                                                                              \
    static inline const type *stem##_at(size_t index) {                                            \
        return bl_registry_at(&registry, index);                                                   \
    }                                                                                              \
    static inline const type *stem##_find(const char *name) {                                      \
        return bl_registry_find(&registry, name);                                                  \
    }

// The candidate nearest to a word by edit distance, ignoring case; NULL if none is near, which is
// when more than half of the word's letters would have to change. `candidates` ends with NULL.
const char *bl_nearest(const char *word, const char *const *candidates);

// A word that is not known.
typedef struct bl_unknown {
    const char *what;  // that it should name: "filter", "key", "value"
    const char *word;  // as it was written
    const char *key;   // optional: what it is the value of, "fade" or "--window"
    const char *where; // optional: " at column 8 of 'gnoise:sed=3'"
    // What is known, both optional and ended by NULL: words, and the names in registries.
    const char *const *words;
    const bl_registry *const *registries;
    const char *all; // optional: where all of it stands, if it is too long to be told
} bl_unknown;

// "unknown filter 'bix' at column 3 of '...'; did you mean 'box'? There are box, tent, ..."; a long
// list is not told, but where it stands. Returns BL_USAGE.
bl_status bl_report_unknown(const bl_unknown *unknown, bl_message *message);
// The same of one registry, for a word that stands `where` (NULL: nowhere in particular).
bl_status bl_registry_report(const bl_registry *registry, const char *word, const char *where,
                             bl_message *message);

#endif
