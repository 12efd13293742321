// SPDX-License-Identifier: MIT
//
// A folder for the files of one test program, and looks at what stands in it.
#ifndef BL_TESTS_TEMPORARY_H
#define BL_TESTS_TEMPORARY_H

#include <stddef.h>

// The folder: made at the first call, removed with all that is in it when the program ends.
const char *bl_temporary_folder(void);
// The path of a name in it. The text lives until the tenth call from now.
const char *bl_temporary_path(const char *name);
// A whole file as text, which the caller frees; NULL if it cannot be read.
char *bl_temporary_read(const char *path, size_t *size);
// Writes a text to a path.
void bl_temporary_write(const char *path, const void *bytes, size_t size);
// Gives root's powers away until bl_temporary_take_powers, for this whole process; true if it now
// has none. The folder can still be read. Take them back before anything may fail the test.
int bl_temporary_drop_powers(void);
void bl_temporary_take_powers(void);
// Makes every write beyond this many bytes of a file fail with EFBIG, as on a full disk; 0 lifts
// it.
void bl_temporary_limit_files(size_t most_bytes);
// How many files the folder holds, hidden ones too.
size_t bl_temporary_files(void);
// Runs a program with its output thrown away; its exit status, or -1. `folder` may be NULL.
int bl_temporary_run(const char *folder, const char *const arguments[]);
// A setup of tests: where no wisdom is kept, plans are estimated, and nobody's home gets a file.
int bl_temporary_no_wisdom(void **state);

#endif
