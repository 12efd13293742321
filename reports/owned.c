// SPDX-License-Identifier: MIT
#include "reports/owned.h"

#include <stdlib.h>

typedef struct bl_owned_thing {
    void *thing;
    void (*release)(void *thing); // NULL: it has been
} bl_owned_thing;

int bl_grow(void *array, size_t count, size_t size) {
    void **where = array;
    if (count & (count - 1)) // room is made at 0 and at the powers of two
        return 1;
    void *larger = realloc(*where, (count ? 2 * count : 1) * size);
    if (larger)
        *where = larger;
    return larger != NULL;
}

int bl_owned_add(bl_owned *owned, void *thing, void (*release)(void *thing)) {
    if (!bl_grow(&owned->things, owned->count, sizeof *owned->things)) {
        release(thing);
        return 0;
    }
    owned->things[owned->count++] = (bl_owned_thing){thing, release};
    return 1;
}

static void release_one(bl_owned_thing *one) {
    if (one->release)
        one->release(one->thing);
    one->release = NULL;
}

void bl_owned_release(bl_owned *owned, const void *thing) {
    for (size_t i = owned->count; i-- > 0;)
        if (owned->things[i].thing == thing)
            release_one(&owned->things[i]);
    while (owned->count && !owned->things[owned->count - 1].release)
        owned->count--;
}

void bl_owned_release_all(bl_owned *owned) {
    while (owned->count)
        release_one(&owned->things[--owned->count]);
    free(owned->things);
    *owned = (bl_owned){0};
}
