// SPDX-License-Identifier: MIT
#include "score/properties/vectors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "score/properties/sameness.h"

enum { NEAR = 256, STEP = 16, POWER_MOST = 40, MOST_COMPARED = 4096 };
enum { FAR_NEAR = 64, FAR_STEP = 8 }; // of four axes, which have too many places
#define FLOATS 1e-5                   // of the range

// A place of the block, or of the multiples, with the values at two offsets in its cell.
typedef struct entry {
    float value[2];
    int cell[BL_AXES];
} entry;

typedef struct entries {
    entry *list;
    size_t count;
} entries;

static int by_value(const void *a, const void *b) {
    const entry *x = a, *y = b;
    return (x->value[0] > y->value[0]) - (x->value[0] < y->value[0]);
}

// All cells `step` apart from `first` to `last` along every axis. An empty list: out of memory.
static entries make_cells(unsigned dimensions, int first, int last, int step) {
    size_t side = (size_t)((last - first) / step) + 1, count = 1;
    for (unsigned a = 0; a < dimensions; a++)
        count *= side;
    entries made = {calloc(count, sizeof *made.list), count};
    for (size_t i = 0; made.list && i < count; i++) {
        size_t rest = i;
        for (unsigned a = 0; a < dimensions; a++, rest /= side)
            made.list[i].cell[a] = first + step * (int)(rest % side);
    }
    return made;
}

static void fill_values(const bl_signal *signal, const bl_score_look *look,
                        double offset[2][BL_AXES], entries *all) {
    enum { EACH = 1024 };
    for (size_t from = 0, now; from < all->count; from += now) {
        double column[BL_AXES][EACH];
        float value[EACH];
        now = all->count - from < EACH ? all->count - from : EACH;
        for (int which = 0; which < 2; which++) {
            for (size_t i = 0; i < now; i++)
                for (int a = 0; a < BL_AXES; a++)
                    column[a][i] =
                        look->cell * ((double)all->list[from + i].cell[a] + offset[which][a]);
            bl_signal_points(signal, BL_COLUMNS(column), now, value);
            for (size_t i = 0; i < now; i++)
                all->list[from + i].value[which] = value[i];
        }
    }
}

// Whether the vector is made of whole repeats along the axes.
static int is_known(const double vector[BL_AXES], const double along[BL_AXES]) {
    for (int a = 0; a < BL_AXES; a++)
        if (vector[a] != 0 && !(along[a] > 0 && fmod(vector[a], along[a]) == 0))
            return 0;
    return 1;
}

static double length_of(const double vector[BL_AXES]) {
    double sum = 0;
    for (int a = 0; a < BL_AXES; a++)
        sum += vector[a] * vector[a];
    return sqrt(sum);
}

typedef struct search {
    const bl_signal *signal;
    const bl_score_look *look;
    const bl_score_settings *settings;
    const double *along;
    double *best;
    size_t compared;
} search;

// Takes the vector if it is one, shorter than the best, and of which the last part that is not 0 is
// positive: v and -v are one repeat.
static void consider(search *s, const double vector[BL_AXES]) {
    bl_score_map map = bl_score_identity;
    double length = length_of(vector), last = 0;
    int parts = 0; // a vector along one axis is found by the walk along it
    for (int a = 0; a < BL_AXES; a++) {
        last = vector[a] != 0 ? vector[a] : last;
        parts += vector[a] != 0;
        map.shift[a] = vector[a] * s->look->cell;
    }
    if (parts < 2 || !(last > 0) || is_known(vector, s->along) || s->compared >= MOST_COMPARED ||
        (length_of(s->best) > 0 && length >= length_of(s->best)))
        return;
    s->compared++;
    if (bl_score_compare(s->signal, s->look, &map, BL_SAME_PLACES,
                         bl_score_random(s->settings, "vectors", 1)) == BL_LIKE)
        memcpy(s->best, vector, BL_AXES * sizeof *vector);
}

// A run of equal values in the sorted block for each multiple.
static void match(search *s, const entries *block, const entries *multiples) {
    const float near = (float)(FLOATS * s->look->range);
    for (size_t m = 0; m < multiples->count; m++) {
        const entry *here = &multiples->list[m];
        size_t low = 0, high = block->count;
        while (low < high) {
            size_t middle = low + (high - low) / 2;
            if (block->list[middle].value[0] < here->value[0] - near)
                low = middle + 1;
            else
                high = middle;
        }
        for (size_t i = low; i < block->count && block->list[i].value[0] <= here->value[0] + near;
             i++) {
            double vector[BL_AXES];
            if (!(fabsf(block->list[i].value[1] - here->value[1]) <= near))
                continue;
            for (int a = 0; a < BL_AXES; a++)
                vector[a] = here->cell[a] - block->list[i].cell[a];
            consider(s, vector);
        }
    }
}

// A vector with a negative last part is found by its opposite, so both signs of all are there.
static bl_status find_near(search *s, bl_message *message) {
    const unsigned dimensions = s->look->dimensions;
    const int step = dimensions > 3 ? FAR_STEP : STEP, most = dimensions > 3 ? FAR_NEAR : NEAR;
    entries block = make_cells(dimensions, 0, step - 1, 1);
    entries multiples = make_cells(dimensions, -most, most + step, step);
    bl_status status = BL_OK;
    if (block.list && multiples.list) {
        double offset[2][BL_AXES];
        bl_random random = bl_score_random(s->settings, "vectors", 0);
        for (int which = 0; which < 2; which++)
            for (int a = 0; a < BL_AXES; a++) // eighths, which floats keep
                offset[which][a] = 0.125 * (double)(1 + bl_random_bits(&random) % 7);
        fill_values(s->signal, s->look, offset, &block);
        fill_values(s->signal, s->look, offset, &multiples);
        qsort(block.list, block.count, sizeof *block.list, by_value);
        match(s, &block, &multiples);
    } else {
        status = bl_report(message, BL_DEVICE, "out of memory for %zu places", multiples.count);
    }
    free(block.list);
    free(multiples.list);
    return status;
}

// All directions of 1, 0 and -1 with more than one axis, and all lengths.
static void find_far(search *s) {
    enum { DIRECTIONS = 81, LENGTHS = 2 * POWER_MOST };
    static const double sign[] = {0, 1, -1};
    bl_score_map maps[LENGTHS];
    unsigned char is_likely[LENGTHS];
    unsigned codes = 1;
    for (unsigned a = 0; a < s->look->dimensions; a++)
        codes *= 3;
    for (unsigned code = 1; code < codes; code++) {
        double direction[BL_AXES] = {0};
        unsigned rest = code, axes = 0;
        for (unsigned a = 0; a < s->look->dimensions; a++, rest /= 3) {
            direction[a] = sign[rest % 3];
            axes += direction[a] != 0;
        }
        if (axes < 2)
            continue;
        for (int k = 0; k < LENGTHS; k++) {
            maps[k] = bl_score_identity;
            for (int a = 0; a < BL_AXES; a++)
                maps[k].shift[a] = direction[a] * ldexp(k % 2 ? 3 : 1, k / 2) * s->look->cell;
        }
        bl_random random = bl_score_random(s->settings, "vectors", 2);
        bl_score_likely(s->signal, s->look, maps, LENGTHS, &random, is_likely);
        for (int k = 0; k < LENGTHS; k++) {
            double vector[BL_AXES];
            for (int a = 0; a < BL_AXES; a++)
                vector[a] = direction[a] * ldexp(k % 2 ? 3 : 1, k / 2);
            if (is_likely[k])
                consider(s, vector);
        }
    }
}

bl_status bl_score_find_vector(const bl_signal *signal, const bl_score_look *look,
                               const bl_score_settings *settings, const double along[BL_AXES],
                               double vector[BL_AXES], bl_message *message) {
    search s = {signal, look, settings, along, vector, 0};
    memset(vector, 0, BL_AXES * sizeof *vector);
    if (look->dimensions < 2)
        return BL_OK;
    bl_status status = find_near(&s, message);
    if (status == BL_OK && length_of(vector) == 0)
        find_far(&s);
    return status;
}
