// SPDX-License-Identifier: MIT
//
// Opens what `bl_source_open` opens (noises, images, raw files, functions, programs), or expects it
// to be refused. All fail the running test if it goes another way.
#ifndef BL_TESTS_SOURCES_H
#define BL_TESTS_SOURCES_H

#include "aliasing/view.h"
#include "core/signal.h"

// The caller frees it.
bl_signal *bl_test_open_source(const char *text);

// Expects this status, a message with this word in it, and no signal.
void bl_test_refuse_source(const char *text, bl_status expected, const char *word);

// The text of a file of the temporary folder with the settings behind its name (":spacing=2"). It
// lives until the next call.
const char *bl_test_file_text(const char *name, const char *settings);

// The same two for such a file.
bl_signal *bl_test_open_file(const char *name, const char *settings);
void bl_test_refuse_file(const char *name, const char *settings, bl_status expected,
                         const char *word);

// A square view of so many pixels a side, for the caller to close.
bl_view bl_test_open_view(const char *text, size_t size);

#endif
