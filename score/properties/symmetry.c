// SPDX-License-Identifier: MIT
//
// Symmetry: whether the field is its own mirror image, which is seen at once where the mirror is in
// view, and whether an axis does nothing.
//
// Asked are, in this order: every axis, moved alone; the mirror of one axis at every half cell
// within some cells of 0; the exchange of two axes, x = k + y and x = k - y for whole numbers k of
// cells; and all other ways to exchange and mirror axes about 0 and about the centre of the first
// cell. The values may come back as they were or turned over, so that their sum is one number
// everywhere. What is found first is named; it is the simplest.
//
// What passes a look at all maps is compared in double, at 2048 places (sameness.h). There is no
// chance in it, and nothing that a signal could state: the verdict is against the ideal.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "score/properties/sameness.h"

enum { VERIFIED = 2048 }; // places: a function that varies in a hundredth of the range is seen to

// A list of maps that grows; `failed` where memory ends.
typedef struct maps {
    bl_score_map *list;
    size_t count, room;
    int failed;
} maps;

static void add(maps *all, bl_score_map map) {
    if (all->count == all->room) {
        size_t room = all->room ? 2 * all->room : 4096;
        bl_score_map *list = realloc(all->list, room * sizeof *list);
        if (!list) {
            all->failed = 1;
            return;
        }
        all->list = list;
        all->room = room;
    }
    all->list[all->count++] = map;
}

static void add_mirror(maps *all, unsigned axis, double twice_centre) {
    bl_score_map map = bl_score_identity;
    map.sign[axis] = -1;
    map.shift[axis] = twice_centre;
    add(all, map);
}

// x = k + y and y = x - k, or x = k - y and y = k - x.
static void add_exchange(maps *all, unsigned a, unsigned b, int sign, double k) {
    bl_score_map map = bl_score_identity;
    map.axis[a] = b;
    map.axis[b] = a;
    map.sign[a] = map.sign[b] = sign;
    map.shift[a] = k;
    map.shift[b] = sign > 0 ? -k : k;
    add(all, map);
}

static int is_exchange(const unsigned axis[BL_AXES], unsigned dimensions) {
    unsigned seen = 0;
    for (unsigned a = 0; a < dimensions; a++)
        seen |= 1u << axis[a];
    return seen == (1u << dimensions) - 1;
}

// All exchanges of axes with all signs, about the place whose coordinates are all `centre`.
static void add_signed_exchanges(maps *all, unsigned dimensions, double centre) {
    for (unsigned code = 0; code < 1u << 2 * dimensions; code++) {
        bl_score_map map = bl_score_identity;
        for (unsigned a = 0; a < dimensions; a++)
            map.axis[a] = code >> 2 * a & 3;
        if (!is_exchange(map.axis, dimensions))
            continue;
        for (unsigned signs = 0; signs < 1u << dimensions; signs++) {
            for (unsigned a = 0; a < dimensions; a++) {
                map.sign[a] = signs >> a & 1 ? -1 : 1;
                map.shift[a] = centre - map.sign[a] * centre;
            }
            if (signs || code != 0xe4u % (1u << 2 * dimensions)) // not the identity
                add(all, map);
        }
    }
}

static void add_all(maps *all, const bl_score_look *look, int reach) {
    const unsigned dimensions = look->dimensions;
    for (int k = 0; k <= 2 * reach; k++)
        for (int sign = 1; sign >= -1 && (k || sign > 0); sign -= 2)
            for (unsigned a = 0; a < dimensions; a++)
                add_mirror(all, a, sign * k * look->cell); // about half of it
    for (int k = 0; k <= reach; k++)
        for (int sign = 1; sign >= -1 && (k || sign > 0); sign -= 2)
            for (unsigned a = 0; a < dimensions; a++)
                for (unsigned b = a + 1; b < dimensions; b++)
                    for (int way = 1; way >= -1; way -= 2)
                        add_exchange(all, a, b, way, sign * k * look->cell);
    add_signed_exchanges(all, dimensions, 0);
    add_signed_exchanges(all, dimensions, 0.5 * look->cell);
}

// --- the verdict --------------------------------------------------------------------------------

// "3 - x, y, z": the arguments of the image.
static void tell_image(const bl_score_map *map, unsigned dimensions, char *text, size_t size) {
    size_t used = 0;
    for (unsigned a = 0; a < dimensions && used < size; a++) {
        char name = "xyzw"[map->axis[a]];
        const char *comma = a ? ", " : "";
        double shift = map->shift[a];
        if (shift == 0)
            used += (size_t)snprintf(text + used, size - used, "%s%s%c", comma,
                                     map->sign[a] < 0 ? "-" : "", name);
        else
            used += (size_t)snprintf(text + used, size - used, "%s%g %c %c", comma, shift,
                                     map->sign[a] < 0 ? '-' : '+', name);
    }
}

// Two words for the cell: "x = 3.5" for a mirror, "x and y" for an exchange, "about 0" for others.
static void fill_cell(const bl_score_map *map, unsigned dimensions, bl_score_property *result) {
    unsigned mirrors = 0, exchanged = 0, last = 0, moved[BL_AXES];
    for (unsigned a = 0; a < dimensions; a++) {
        if (map->axis[a] != a)
            moved[exchanged++] = a;
        else if (map->sign[a] < 0)
            mirrors++, last = a;
    }
    if (!exchanged && mirrors == 1)
        snprintf(result->cell, sizeof result->cell, "mirror %c=%.4g", "xyzw"[last],
                 map -> shift[last] / 2);
    else if (exchanged == 2 && !mirrors)
        snprintf(result->cell, sizeof result->cell, "%c like %c", "xyzw"[moved[0]],
                 "xyzw"[moved[1]]);
    else
        snprintf(result->cell, sizeof result->cell, "mirrored");
}

static void judge_map(const bl_score_map *map, bl_score_likeness likeness, double sum,
                      unsigned dimensions, bl_score_property *result) {
    char image[96] = "", place[16] = "", turned[40] = "";
    tell_image(&bl_score_identity, dimensions, place, sizeof place);
    tell_image(map, dimensions, image, sizeof image);
    fill_cell(map, dimensions, result);
    if (likeness == BL_OPPOSITE && sum != 0)
        snprintf(turned, sizeof turned, "%.6g - ", sum);
    else if (likeness == BL_OPPOSITE)
        snprintf(turned, sizeof turned, "-");
    bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_IDEAL,
                   "it is its own image everywhere: n(%s) = %sn(%s)", image, turned, place);
}

// The axis that does nothing, or `dimensions` for none.
static unsigned find_idle_axis(const bl_signal *signal, const bl_score_look *look,
                               bl_random random) {
    for (unsigned a = 0; a < look->dimensions; a++) {
        bl_score_map map = bl_score_identity;
        map.shift[a] = 0.37 * look->cell;
        if (bl_score_compare(signal, look, &map, BL_SAME_PLACES, random) != BL_LIKE)
            continue;
        map.shift[a] = 1234.56 * look->cell;
        if (bl_score_compare(signal, look, &map, VERIFIED, random) == BL_LIKE)
            return a;
    }
    return look->dimensions;
}

static void find_map(const bl_signal *signal, const bl_score_look *look, const maps *all,
                     const unsigned char *is_likely, bl_random random, bl_score_property *result) {
    for (size_t i = 0; i < all->count; i++) {
        const bl_score_map *map = &all->list[i];
        if (!is_likely[i])
            continue;
        bl_score_likeness likeness = bl_score_compare(signal, look, map, VERIFIED, random);
        if (likeness == BL_UNLIKE)
            continue;
        double at[BL_AXES], image[BL_AXES];
        bl_score_exact_place(look, &random, at);
        bl_score_image(map, at, image);
        double sum = bl_signal_value(signal, at) + bl_signal_value(signal, image);
        judge_map(map, likeness, fabs(sum) <= BL_SAME * look->range ? 0 : sum, look->dimensions,
                  result);
        return;
    }
    snprintf(result->cell, sizeof result->cell, "none");
    bl_score_judge(result, BL_VERDICT_PASS, BL_AGAINST_IDEAL,
                   "none of %zu ways to mirror and exchange axes leaves it as it is", all->count);
}

static bl_status measure(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message) {
    const bl_signal *signal = subject->signal;
    bl_score_look look;
    maps all = {NULL, 0, 0, 0};
    if (!bl_score_look_at(subject, settings, result, &look))
        return BL_OK;
    bl_random random = bl_score_random(settings, "symmetry", 0);
    if (bl_score_is_nearly_constant(signal, &look, random)) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL,
                       "the signal is too nearly constant to tell a mirror image");
        return BL_OK;
    }
    unsigned idle = find_idle_axis(signal, &look, random);
    if (idle < look.dimensions) {
        snprintf(result->cell, sizeof result->cell, "no %c", "xyzw"[idle]);
        bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_IDEAL, "it does not change along %c",
                       "xyzw"[idle]);
        return BL_OK;
    }
    add_all(&all, &look, (int)bl_size_pick(settings->size, 32, 256, 1024));
    unsigned char *is_likely = all.failed ? NULL : calloc(all.count, sizeof *is_likely);
    bl_status status = BL_OK;
    if (is_likely) {
        bl_score_likely(signal, &look, all.list, all.count, &random, is_likely);
        bl_score_add_exact(result, "maps", (double)all.count);
        find_map(signal, &look, &all, is_likely, bl_score_random(settings, "symmetry", 1), result);
    } else {
        status = bl_score_no_memory(result, message);
    }
    free(is_likely);
    free(all.list);
    return status;
}

BL_PROPERTY_DESCRIPTOR(symmetry) = {
    .name = "symmetry",
    .title = "symmetry",
    .paper = "peachey2003, p. 68",
    .entry = "the mirror, or the axes that can be exchanged",
    .question = "Is the noise its own mirror image anywhere?",
    .measure = measure,
};
