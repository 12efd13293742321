// SPDX-License-Identifier: MIT
//
// The sources of signals that are no noises of the registry; bl_source_open tells them apart. The
// texts are those of sources/source.h, and so are the errors.
#ifndef BL_SOURCES_SOURCE_KINDS_H
#define BL_SOURCES_SOURCE_KINDS_H

#include "core/grammar.h"
#include "core/signal.h"

bl_status bl_image_text_open(const char *text, bl_signal **signal, bl_message *message);
bl_status bl_plugin_open(const char *text, bl_signal **signal, bl_message *message);
bl_status bl_program_open(const char *text, bl_signal **signal, bl_message *message);
bl_status bl_raw_open(const char *text, bl_signal **signal, bl_message *message);

// Reads settings that begin at text + start, after the character at `start - 1`, into a block; the
// columns of messages are those of the whole text. `settings` may be NULL: none are given.
bl_status bl_source_settings(const bl_parameter *parameters, const char *text, const char *settings,
                             size_t length, void *block, bl_message *message);

// Whether the first `length` letters of a text end with `ending`, and are not that alone.
int bl_source_ends_with(const char *text, size_t length, const char *ending);

// Whether every coordinate that a signal of `dims` dimensions uses is finite and at most 2^62 in
// size.
int bl_source_in_range(const double *at, unsigned dims);

#endif
