// SPDX-License-Identifier: MIT
//
// The contract of a source: what opens signals that are of no registry.
//
// A source is one file, which ends with one descriptor, and one line in sources.def; the first
// in its order that takes a text opens it. The texts are those of sources/source.h, and so are the
// errors.
#ifndef BL_SOURCES_KIND_H
#define BL_SOURCES_KIND_H

#include "core/grammar.h"
#include "core/registry.h"
#include "core/signal.h"

typedef struct bl_source {
    BL_ENTRY(title, summary);
    const char *kind;    // of its signals, in reports: "file", "function", "program"
    const char *form;    // how a text is written: "FILE.raw:size=WxHxD,KEY=VALUE"
    const char *example; // such a text
    const bl_parameter *parameters;
    int sampled; // its signals are samples on a grid
    int (*takes)(const char *text);
    bl_status (*open)(const char *text, bl_signal **signal, bl_message *message);
    // Optional: where a further setting goes in a text, or 0 if its signal has no seed; and what to
    // do about that.
    size_t (*seed_place)(const char *text);
    const char *seed_hint;
} bl_source;

BL_REGISTRY(bl_source, bl_source, bl_sources)

// Names the descriptor of a source's file: BL_SOURCE_DESCRIPTOR(raw) = {...};
#define BL_SOURCE_DESCRIPTOR(stem)                                                                 \
    extern const bl_source bl_source_##stem;                                                       \
    const bl_source bl_source_##stem

// Reads settings that begin at text + start, after the character at `start - 1`, into a block; the
// columns of messages are those of the whole text. `settings` may be NULL: none are given.
bl_status bl_source_settings(const bl_parameter *parameters, const char *text, const char *settings,
                             size_t length, void *block, bl_message *message);

// Whether the first `length` letters of a text end with `ending`, and are not that alone.
int bl_source_ends_with(const char *text, size_t length, const char *ending);

// Whether these letters name a shared object: lib.so, and lib.so.1.2.
int bl_source_is_shared_object(const char *text, size_t length);
// Whether the whole text is the name of a file, which may hold a colon, and of neither a shared
// object nor bare samples.
int bl_source_is_whole_file(const char *text);

// Whether every coordinate that a signal of `dims` dimensions uses is finite and at most 2^62 in
// size.
int bl_source_in_range(const double *at, unsigned dims);

#endif
