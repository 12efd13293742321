// SPDX-License-Identifier: MIT
#include "score/properties/sameness.h"
#include "core/statistics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DIFFERENT = 6, MOST_PLACES = 4096 };
enum { CONSTANT_PLACES = 512 }; // a signal that has not differed by then is nearly constant

const bl_score_map bl_score_identity = {.axis = {0, 1, 2, 3}, .sign = {1, 1, 1, 1}};

void bl_score_image(const bl_score_map *map, const double at[BL_AXES], double image[BL_AXES]) {
    for (int a = 0; a < BL_AXES; a++)
        image[a] = map->sign[a] * at[map->axis[a]] + map->shift[a];
}

void bl_score_exact_place(const bl_score_look *look, bl_random *random, double at[BL_AXES]) {
    // Near 0, or anywhere in some thousand cells: what is found for a cell may be a small part of a
    // pattern, which looks the same all over the near places.
    const uint64_t range = bl_random_bits(random) & 1 ? 16 : 2048;
    for (int a = 0; a < BL_AXES; a++)
        at[a] =
            look->cell * ((double)(bl_random_bits(random) % (512 * range)) / 256 - (double)range);
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
        for (int times = -2; times <= 2 && rounding < 0x1p-8 * look->cell; times++) {
            memcpy(other, at, sizeof other);
            other[axis] += times * rounding; // at a peak twice as far is four times as much
            most = fmax(most, fabs(bl_signal_value(signal, other) - here));
        }
        change += most;
    }
    return fmin(change, BL_SILENT * look->range);
}

// Places of so many parts of a cell, along the axes that the map moves.
static bl_score_likeness compare_at(const bl_signal *signal, const bl_score_look *look,
                                    const bl_score_map *map, int parts, int places,
                                    bl_random random) {
    double first = 0, sum = 0, near = BL_SAME * look->range;
    int different = 0, like = 1, opposite = 1, silent = 0;
    for (int i = 0; i < MOST_PLACES && (like || opposite); i++) {
        double at[BL_AXES], image[BL_AXES];
        bl_score_exact_place(look, &random, at);
        for (int a = 0; a < BL_AXES; a++)
            if (map->shift[a] != 0)
                at[a] = look->cell * floor(at[a] / look->cell * parts) / parts;
        bl_score_image(map, at, image);
        double here = bl_signal_value(signal, at), there = bl_signal_value(signal, image);
        first = i ? first : here;
        sum = i ? sum : here + there;
        double off = fabs(there - here), off_sum = fabs(here + there - sum), slack = near;
        if (!(off <= near) || !(off_sum <= near))
            slack += 2 * bl_score_change_by_rounding(signal, look, image);
        if (slack > BL_SILENT * look->range) { // a slope so steep that the rounding decides
            if (2 * ++silent > places)
                return BL_UNLIKE;
            continue;
        }
        like &= off <= slack; // NaN is like nothing
        opposite &= off_sum <= slack;
        different += fabs(here - first) > near;
        if (i + 1 >= places && different >= DIFFERENT)
            return like ? BL_LIKE : opposite ? BL_OPPOSITE : BL_UNLIKE;
    }
    return BL_UNLIKE;
}

// Whether what holds at multiples of 2^-8 cells holds between them too: a chirp repeats on any such
// grid. Not asked of a function whose coordinates are too coarse for other places, as floats are.
static int holds_between(const bl_signal *signal, const bl_score_look *look,
                         const bl_score_map *map, bl_score_likeness likeness, bl_random random) {
    enum { BETWEEN = 64 };
    int resolved = 0, wrong = 0; // and silent where the rounding decides
    double sum = NAN;
    for (int i = 0; i < BETWEEN; i++) {
        double at[BL_AXES], image[BL_AXES], beside[BL_AXES];
        bl_score_exact_place(look, &random, at);
        for (int a = 0; a < BL_AXES; a++)
            at[a] += look->cell * (double)(bl_random_bits(&random) >> 40) * 0x1p-32;
        bl_score_image(map, at, image);
        for (int a = 0; a < BL_AXES; a++)
            beside[a] = image[a] * (1 + 0x1p-30);
        double here = bl_signal_value(signal, at), there = bl_signal_value(signal, image);
        double slack = BL_SAME * look->range + 2 * bl_score_change_by_rounding(signal, look, image);
        sum = isnan(sum) ? here + there : sum;
        resolved += bl_signal_value(signal, beside) != there;
        if (slack > BL_SILENT * look->range)
            continue;
        wrong += likeness == BL_LIKE ? !(fabs(there - here) <= slack)
                                     : !(fabs(here + there - sum) <= slack);
    }
    return 2 * resolved < BETWEEN || wrong == 0;
}

bl_score_likeness bl_score_compare(const bl_signal *signal, const bl_score_look *look,
                                   const bl_score_map *map, int places, bl_random random) {
    static const int parts[] = {256, 8, 4, 2, 1};
    enum { PARTS = sizeof parts / sizeof *parts };
    double farthest = 0;
    for (int a = 0; a < BL_AXES; a++)
        farthest = fmax(farthest, fabs(map->shift[a]));
    bl_score_likeness found = BL_UNLIKE;
    for (int p = 0; p < (farthest >= 4096 * look->cell ? PARTS : 1) && found == BL_UNLIKE; p++)
        found = compare_at(signal, look, map, parts[p], places, random);
    return found == BL_UNLIKE || holds_between(signal, look, map, found, random) ? found
                                                                                 : BL_UNLIKE;
}

// --- the look at many maps ----------------------------------------------------------------------

enum { TRIED = 256, PROBES = 2 };
#define FLOATS 1e-4 // of the range: floats of correct rows and points differ by less

// Two places, among many, whose values are far from the middle one and from each other. They are
// odd eighths of a cell, which floats keep far out, and where noises of a lattice are not 0.
static void choose_probes(const bl_signal *signal, const bl_score_look *look, bl_random *random,
                          double probes[PROBES][BL_AXES]) {
    double at[TRIED][BL_AXES], value[TRIED], sorted[TRIED];
    size_t best[PROBES] = {0};
    for (size_t i = 0; i < TRIED; i++) {
        bl_score_exact_place(look, random, at[i]);
        for (int a = 0; a < BL_AXES; a++)
            at[i][a] = look->cell * (floor(at[i][a] / look->cell * 4) / 4 + 0.125);
        sorted[i] = value[i] = bl_signal_value(signal, at[i]);
    }
    qsort(sorted, TRIED, sizeof *sorted, bl_ascending);
    double middle = sorted[TRIED / 2];
    for (size_t i = 1; i < TRIED; i++)
        if (fabs(value[i] - middle) > fabs(value[best[0]] - middle))
            best[0] = i;
    for (size_t i = 1; i < TRIED; i++)
        if (fabs(value[i] - value[best[0]]) * fabs(value[i] - middle) >
            fabs(value[best[1]] - value[best[0]]) * fabs(value[best[1]] - middle))
            best[1] = i;
    for (size_t p = 0; p < PROBES; p++)
        memcpy(probes[p], at[best[p]], sizeof at[0]);
}

void bl_score_likely(const bl_signal *signal, const bl_score_look *look, const bl_score_map *maps,
                     size_t count, bl_random *random, unsigned char *is_likely) {
    enum { EACH = 512 };
    double near = FLOATS * look->range, here[PROBES], probes[PROBES][BL_AXES];
    choose_probes(signal, look, random, probes);
    for (int p = 0; p < PROBES; p++)
        here[p] = bl_signal_value(signal, probes[p]);
    for (size_t from = 0, now; from < count; from += now) {
        double column[BL_AXES][PROBES * EACH];
        float value[PROBES * EACH];
        now = count - from < EACH ? count - from : EACH;
        for (size_t i = 0; i < PROBES * now; i++) {
            double image[BL_AXES];
            bl_score_image(&maps[from + i / PROBES], probes[i % PROBES], image);
            for (int a = 0; a < BL_AXES; a++)
                column[a][i] = image[a];
        }
        bl_signal_points(signal, BL_COLUMNS(column), PROBES * now, value);
        for (size_t i = 0; i < now; i++) {
            double first = (double)value[PROBES * i], second = (double)value[PROBES * i + 1];
            is_likely[from + i] =
                (fabs(first - here[0]) <= near && fabs(second - here[1]) <= near) ||
                fabs(first + here[0] - second - here[1]) <= near;
        }
    }
}
