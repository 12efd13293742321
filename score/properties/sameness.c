// SPDX-License-Identifier: MIT
#include "score/properties/sameness.h"

#include <math.h>
#include <string.h>

enum { DIFFERENT = 6, MOST_PLACES = 4096 };
enum { CONSTANT_PLACES = 512 }; // a signal that has not differed by then is nearly constant
#define SLOPE 1e-3              // of the range

const bl_score_map bl_score_identity = {.axis = {0, 1, 2, 3}, .sign = {1, 1, 1, 1}};

void bl_score_image(const bl_score_map *map, const double at[BL_AXES], double image[BL_AXES]) {
    for (int a = 0; a < BL_AXES; a++)
        image[a] = map->sign[a] * at[map->axis[a]] + map->shift[a];
}

void bl_score_exact_place(const bl_score_look *look, bl_random *random, double at[BL_AXES]) {
    for (int a = 0; a < BL_AXES; a++)
        at[a] = look->cell * ((double)(bl_random_bits(random) % 8192) / 256 - 16);
}

int bl_score_is_nearly_constant(const bl_signal *signal, const bl_score_look *look,
                                bl_random random) {
    double first = 0;
    int different = 0;
    for (int i = 0; i < CONSTANT_PLACES && different < DIFFERENT; i++) {
        double at[BL_AXES];
        bl_score_exact_place(look, &random, at);
        double here = bl_signal_value(signal, at);
        first = i ? first : here;
        different += !(fabs(here - first) <= BL_SAME * look->range);
    }
    return different < DIFFERENT;
}

double bl_score_change_by_rounding(const bl_signal *signal, const bl_score_look *look,
                                   const double at[BL_AXES]) {
    double here = bl_signal_value(signal, at), change = 0;
    for (unsigned axis = 0; axis < look->dimensions; axis++) {
        double other[BL_AXES], rounding = 0x1p-52 * fabs(at[axis]), most = 0;
        for (int sign = -1; sign <= 1 && rounding < 0x1p-8 * look->cell; sign += 2) {
            memcpy(other, at, sizeof other);
            other[axis] += sign * rounding;
            most = fmax(most, fabs(bl_signal_value(signal, other) - here));
        }
        change += most;
    }
    return fmin(change, SLOPE * look->range);
}

bl_score_likeness bl_score_compare(const bl_signal *signal, const bl_score_look *look,
                                   const bl_score_map *map, int places, bl_random random) {
    double first = 0, sum = 0, near = BL_SAME * look->range;
    int different = 0, like = 1, opposite = 1;
    for (int i = 0; i < MOST_PLACES && (like || opposite); i++) {
        double at[BL_AXES], image[BL_AXES];
        bl_score_exact_place(look, &random, at);
        bl_score_image(map, at, image);
        double here = bl_signal_value(signal, at), there = bl_signal_value(signal, image);
        first = i ? first : here;
        sum = i ? sum : here + there;
        double off = fabs(there - here), off_sum = fabs(here + there - sum), slack = near;
        if (!(off <= near) || !(off_sum <= near))
            slack += 2 * bl_score_change_by_rounding(signal, look, image);
        like &= off <= slack; // NaN is like nothing
        opposite &= off_sum <= slack;
        different += fabs(here - first) > near;
        if (i + 1 >= places && different >= DIFFERENT)
            return like ? BL_LIKE : opposite ? BL_OPPOSITE : BL_UNLIKE;
    }
    return BL_UNLIKE;
}
