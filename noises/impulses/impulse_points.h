// SPDX-License-Identifier: MIT
//
// Sums of sparse impulses at scattered points, 16 points at a time: a template. The file that
// includes it has before
//
//   impulse_kernel        what the kernel is, a struct
//   impulse_mark          what the kernel makes of an impulse's last two words, a struct
//   impulse_mark impulse_mark_of(const impulse_kernel *, int form, uint32_t third, uint32_t fourth)
//   float impulse_term(const impulse_kernel *, int form, impulse_mark, double x, double y,
//                       double z)
//
// impulse_term is finite everywhere and 0 (of either sign) from the kernel's radius on; `form`
// and the dimensions are constants where impulse_points is called. The differences of places are
// doubles, exactly those of the reference, so that both agree whether an impulse reaches a point
// even where the kernel ends in a step; the kernel itself is a float.
//
// Points that follow each other in one cell, as in a row, share the impulses of the cells around:
// each is placed once, and left out if it reaches none of them. Other points are a cell each. Both
// ways give the same bits: an impulse out of reach adds 0, and a sum of floats that starts with 0
// does not see the sign of a 0 added. The order is that of the cells and of the impulses in them.
#ifndef BL_NOISES_IMPULSES_IMPULSE_POINTS_H
#define BL_NOISES_IMPULSES_IMPULSE_POINTS_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "noises/impulses/impulses.h"

enum { IMPULSE_BLOCK = 512, IMPULSE_SHARED = 4, IMPULSE_OFFSETS = 5 };

typedef struct impulse_block {
    int count;
    uint64_t cell[IMPULSE_AXES][IMPULSE_BLOCK];
    double fraction[IMPULSE_AXES][IMPULSE_BLOCK];
    uint8_t valid[IMPULSE_BLOCK];
} impulse_block;

// Up to 16 points; the last lanes are filled up with copies.
typedef struct impulse_group {
    int count;
    uint64_t cell[IMPULSE_AXES][LANES];
    double fraction[IMPULSE_AXES][LANES];
    double low[IMPULSE_AXES], high[IMPULSE_AXES]; // of the fractions
    float sum[LANES];
} impulse_group;

static inline void impulse_split(impulse_block *block, const unsigned dimensions,
                                 const double *const at[BL_AXES], size_t from) {
    for (int i = 0; i < block->count; i++)
        block->valid[i] = 1;
    for (unsigned a = 0; a < dimensions; a++) {
        const double *x = at[a] + from;
#pragma omp simd
        for (int i = 0; i < block->count; i++) {
            int valid = fabs(x[i]) < 0x1p62; // false for NaN
            double place = valid ? x[i] : 0, lower = floor(place);
            block->cell[a][i] = (uint64_t)(int64_t)lower;
            block->fraction[a][i] = place - lower;
            block->valid[i] = (uint8_t)(block->valid[i] & valid);
        }
    }
}

// How many points from `first` on, up to 16, stand in one cell.
static inline int impulse_run(const impulse_block *block, const unsigned dimensions, int first) {
    int n = 1;
    for (; n < LANES && first + n < block->count; n++)
        for (unsigned a = 0; a < dimensions; a++)
            if (block->cell[a][first + n] != block->cell[a][first])
                return n;
    return n;
}

static inline void impulse_group_load(impulse_group *group, const impulse_block *block,
                                      const unsigned dimensions, int first, int count) {
    group->count = count;
    for (unsigned a = 0; a < dimensions; a++) {
        double low = 1, high = 0;
        for (int l = 0; l < LANES; l++) {
            int i = first + (l < count ? l : count - 1);
            double fraction = block->fraction[a][i];
            group->cell[a][l] = block->cell[a][i];
            group->fraction[a][l] = fraction;
            low = fraction < low ? fraction : low;
            high = fraction > high ? fraction : high;
        }
        group->low[a] = low;
        group->high[a] = high;
    }
    for (int l = 0; l < LANES; l++)
        group->sum[l] = 0;
}

// The squared distance of the group's box from an interval of places along an axis.
static inline double impulse_gap(const impulse_group *group, unsigned axis, double from,
                                 double to) {
    double above = from - group->high[axis], below = group->low[axis] - to;
    double gap = above > below ? above : below;
    return gap > 0 ? gap * gap : 0;
}

// One impulse to all points of the group.
static inline __attribute__((always_inline)) void
impulse_add(const impulse_kernel *kernel, const int form, const unsigned dimensions,
            const double place[IMPULSE_AXES], impulse_mark mark, impulse_group *group) {
    const double *x = group->fraction[0], *y = group->fraction[1], *z = group->fraction[2];
#pragma omp simd
    for (int l = 0; l < LANES; l++)
        group->sum[l] += impulse_term(kernel, form, mark, x[l] - place[0], y[l] - place[1],
                                      dimensions == 3 ? z[l] - place[2] : 0);
}

// The impulses of one cell to a group in one cell. `limit` is the squared radius, and a little.
static inline __attribute__((always_inline)) void
impulse_add_shared(const impulse_source *source, const impulse_kernel *kernel, const int form,
                   const unsigned dimensions, impulse_words words, const int offset[IMPULSE_AXES],
                   double limit, impulse_group *group) {
    int count = impulse_count(source, words.third);
    double place[IMPULSE_AXES][IMPULSE_MOST], gap[IMPULSE_MOST];
    for (int n = 0; n < count; n++) {
        const uint32_t *factor = source->factor[n];
        const uint32_t word[IMPULSE_AXES] = {words.first, words.first, words.second};
        gap[n] = 0;
        for (unsigned a = 0; a < dimensions; a++) {
            place[a][n] = offset[a] + impulse_place(word[a] * factor[a]);
            gap[n] += impulse_gap(group, a, place[a][n], place[a][n]);
        }
    }
    for (int n = 0; n < count; n++) {
        if (gap[n] >= limit)
            continue;
        const double at[IMPULSE_AXES] = {place[0][n], place[1][n],
                                         dimensions == 3 ? place[2][n] : 0};
        impulse_mark mark = impulse_mark_of(kernel, form, words.second * source->factor[n][2],
                                            words.second * source->factor[n][3]);
        impulse_add(kernel, form, dimensions, at, mark, group);
    }
}

// Keys of the cells at the offsets -reach..reach of every lane along every axis.
typedef struct impulse_keys {
    uint32_t add[IMPULSE_AXES][IMPULSE_OFFSETS][LANES];
    uint32_t exclusive[IMPULSE_AXES][IMPULSE_OFFSETS][LANES];
} impulse_keys;

static inline void impulse_keys_load(const impulse_source *source, const impulse_group *group,
                                     const unsigned dimensions, int reach, int lanes,
                                     impulse_keys *keys) {
    for (unsigned a = 0; a < IMPULSE_AXES; a++)
        for (int i = 0; i <= 2 * reach && (a < dimensions || i == 0); i++)
            for (int l = 0; l < lanes; l++) {
                uint64_t cell =
                    a < dimensions ? group->cell[a][l] + (uint64_t)(int64_t)(i - reach) : 0;
                bl_lattice_key key = impulse_key(source, a, cell);
                keys->add[a][i][l] = key.add;
                keys->exclusive[a][i][l] = key.exclusive;
            }
}

// The words of a cell for every lane, and the largest of the counts.
static inline int impulse_lane_words(const impulse_source *source, const impulse_keys *keys,
                                     const int at[IMPULSE_AXES], uint32_t first[LANES],
                                     uint32_t second[LANES], int32_t count[LANES]) {
    uint32_t third[LANES];
    if (source->lattice.kind == BL_LATTICE_PERM256) {
        for (int l = 0; l < LANES; l++) {
            uint32_t index = bl_perm256_index(keys->add[0][at[0]][l], keys->add[1][at[1]][l],
                                              keys->add[2][at[2]][l]);
            first[l] = source->table[0][index];
            second[l] = source->table[1][index];
            third[l] = source->table[2][index];
        }
    } else {
        const uint32_t *x = keys->add[0][at[0]], *y = keys->add[1][at[1]], *z = keys->add[2][at[2]];
        const uint32_t *u = keys->exclusive[0][at[0]], *v = keys->exclusive[1][at[1]],
                       *w = keys->exclusive[2][at[2]];
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            uint32_t add = x[l] + y[l] + z[l], exclusive = u[l] ^ v[l] ^ w[l];
            first[l] = impulse_word(source, add, exclusive, 0);
            second[l] = impulse_word(source, add, exclusive, 1);
            third[l] = impulse_word(source, add, exclusive, 2);
        }
    }
    for (int l = 0; l < LANES; l++)
        count[l] = source->poisson ? 0 : source->most;
    int most = source->poisson ? 0 : source->most;
    for (int n = 0; source->poisson && n < source->most; n++) {
        uint32_t limit = source->limit[n];
        int more = 0;
        for (int l = 0; l < LANES; l++) {
            count[l] += limit <= third[l];
            more |= limit <= third[l];
        }
        if (!more)
            break;
        most = n + 1;
    }
    return most;
}

// The impulses of one cell each to a group of points anywhere.
static inline __attribute__((always_inline)) void
impulse_add_own(const impulse_source *source, const impulse_kernel *kernel, const int form,
                const unsigned dimensions, const impulse_keys *keys, const int offset[IMPULSE_AXES],
                int reach, impulse_group *group) {
    uint32_t first[LANES], second[LANES];
    int32_t count[LANES];
    const int at[IMPULSE_AXES] = {offset[0] + reach, offset[1] + reach,
                                  dimensions == 3 ? offset[2] + reach : 0};
    int most = impulse_lane_words(source, keys, at, first, second, count);
    const double *x = group->fraction[0], *y = group->fraction[1], *z = group->fraction[2];
    for (int n = 0; n < most; n++) {
        const uint32_t *factor = source->factor[n];
#pragma omp simd
        for (int l = 0; l < LANES; l++) {
            double dx = x[l] - (offset[0] + impulse_place(first[l] * factor[0]));
            double dy = y[l] - (offset[1] + impulse_place(first[l] * factor[1]));
            double dz =
                dimensions == 3 ? z[l] - (offset[2] + impulse_place(second[l] * factor[2])) : 0;
            impulse_mark mark =
                impulse_mark_of(kernel, form, second[l] * factor[2], second[l] * factor[3]);
            float share = impulse_term(kernel, form, mark, dx, dy, dz);
            group->sum[l] += n < count[l] ? share : 0;
        }
    }
}

// All impulses in reach of a group; `shared`: it stands in one cell.
static inline __attribute__((always_inline)) void
impulse_sum(const impulse_source *source, const impulse_kernel *kernel, const int form,
            const unsigned dimensions, double radius, int shared, impulse_group *group) {
    int reach = radius > 1 ? 2 : 1, across = dimensions == 3 ? reach : 0;
    double limit = radius * radius * (1 + 1e-9) + 1e-9; // more than the rounding of a distance
    impulse_keys keys;
    impulse_keys_load(source, group, dimensions, reach, shared ? 1 : LANES, &keys);
    for (int i = -reach; i <= reach; i++)
        for (int j = -reach; j <= reach; j++)
            for (int k = -across; k <= across; k++) {
                const int offset[IMPULSE_AXES] = {i, j, k};
                double gap = 0;
                for (unsigned a = 0; a < dimensions; a++)
                    gap += impulse_gap(group, a, offset[a], offset[a] + 1);
                if (gap >= limit)
                    continue;
                if (!shared) {
                    impulse_add_own(source, kernel, form, dimensions, &keys, offset, reach, group);
                    continue;
                }
                bl_lattice_key key[IMPULSE_AXES];
                for (unsigned a = 0; a < IMPULSE_AXES; a++) {
                    int n = a < dimensions ? offset[a] + reach : 0;
                    key[a] = (bl_lattice_key){keys.add[a][n][0], keys.exclusive[a][n][0]};
                }
                impulse_add_shared(source, kernel, form, dimensions,
                                   impulse_words_of(source, &key[0], &key[1], &key[2]), offset,
                                   limit, group);
            }
}

// out = scale * sum; the kernel's radius is at most 2 cells.
static inline __attribute__((always_inline)) void
impulse_points(const impulse_source *source, const impulse_kernel *kernel, const int form,
               const unsigned dimensions, double radius, float scale,
               const double *const at[BL_AXES], size_t count, float *out) {
    impulse_block block;
    impulse_group group;
    for (size_t from = 0; from < count; from += IMPULSE_BLOCK) {
        block.count = count - from < IMPULSE_BLOCK ? (int)(count - from) : IMPULSE_BLOCK;
        impulse_split(&block, dimensions, at, from);
        for (int first = 0; first < block.count; first += group.count) {
            int here = impulse_run(&block, dimensions, first);
            int shared = here >= IMPULSE_SHARED;
            if (!shared)
                here = block.count - first < LANES ? block.count - first : LANES;
            impulse_group_load(&group, &block, dimensions, first, here);
            impulse_sum(source, kernel, form, dimensions, radius, shared, &group);
            for (int l = 0; l < here; l++)
                out[from + (size_t)(first + l)] =
                    block.valid[first + l] ? group.sum[l] * scale : NAN;
        }
    }
}

#endif
