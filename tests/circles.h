// SPDX-License-Identifier: MIT
//
// Circles of files: units that need each other, so that none of them can be read, or lifted out,
// without the others.
//
// A unit is a header x.h with x.c and every file of the same folder that is called x_*; where
// several headers claim a file, the shortest name has it. A file without such a header is a unit of
// its own. Within a unit files may need each other as they like.
#ifndef BL_TESTS_CIRCLES_H
#define BL_TESTS_CIRCLES_H

#include <stddef.h>

enum { BL_UNITS_MOST = 1024, BL_UNIT_NAME = 96 };

typedef struct bl_needs {
    size_t count;
    char unit[BL_UNITS_MOST][BL_UNIT_NAME];  // "noises/tiles/tile"
    char *why[BL_UNITS_MOST][BL_UNITS_MOST]; // the first arrow from one to the other, or NULL
    unsigned char joined[BL_UNITS_MOST][BL_UNITS_MOST]; // whether arrows lead there; by bl_circles
} bl_needs;

// The unit of a source, a header or an object; the headers are looked for from the top of the tree.
void bl_unit_of(const char *file, char unit[BL_UNIT_NAME]);

// Adds that a file needs another: it uses a symbol of it, or (NULL) includes it. The caller frees all
// with bl_needs_free.
bl_needs *bl_needs_new(void);
void bl_needs_add(bl_needs *needs, const char *file, const char *needed, const char *symbol);
void bl_needs_free(bl_needs *needs);

// How many circles there are. Their units, and the arrows that tie them, are written to `text`, one
// a line, as far as they fit.
size_t bl_circles(bl_needs *needs, char *text, size_t size);

#endif
