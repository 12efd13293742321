// SPDX-License-Identifier: MIT
//
// A list of things of any kind that are released together.
#ifndef BL_REPORTS_OWNED_H
#define BL_REPORTS_OWNED_H

#include <stddef.h>

typedef struct bl_owned {
    struct bl_owned_thing *things;
    size_t count;
} bl_owned;

// Adds a thing, which release(thing) releases; 0 if out of memory: then it is released already.
int bl_owned_add(bl_owned *owned, void *thing, void (*release)(void *thing));

// Releases the thing at once, by all that was added for it.
void bl_owned_release(bl_owned *owned, const void *thing);

// Releases all, the last one first, and empties the list.
void bl_owned_release_all(bl_owned *owned);

// Makes room for one more element of an array that is grown by it alone: `array` points to the
// pointer to `count` elements of `size` bytes. 0 if out of memory: then the array is untouched.
int bl_grow(void *array, size_t count, size_t size);

#endif
