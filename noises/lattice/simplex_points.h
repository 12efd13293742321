// SPDX-License-Identifier: MIT
//
// Simplex noise at scattered points, in float: gradients, and blocks of points.
//
// A block is placed once (noises/lattice/simplex_place.h): near points side by side, far ones,
// which are put in afterwards, one by one. Corner k is one step further along the k axes of the
// least ranks, so that the additive half of its key is that of corner 0 plus k steps, whichever
// these are. Where cells stand for others (a period, lattice=perm256) the words are made point by
// point.
#ifndef BL_NOISES_LATTICE_SIMPLEX_POINTS_H
#define BL_NOISES_LATTICE_SIMPLEX_POINTS_H

#include "noises/lattice/lattice.h"
#include "noises/lattice/separable.h"
#include "noises/lattice/simplex_place.h"
#include "noises/lattice/simplex_words.h"

typedef struct simplex_gradient {
    float x, y, z, w;
} simplex_gradient;

// From the top bits of a word: exact floats, except for the diagonals in 2-D, whose floats are the
// gradient by definition.
BL_INLINE simplex_gradient simplex_gradient_of(unsigned dims, uint32_t word) {
    if (dims == 3) {
        bl_vector g = bl_edge_gradient(word);
        return (simplex_gradient){g.x, g.y, g.z, 0};
    }
    float p = word & 0x20000000u ? -1.0f : 1.0f, q = word & 0x10000000u ? -1.0f : 1.0f,
          r = word & 0x08000000u ? -1.0f : 1.0f;
    uint32_t kind = word >> 30;
    if (dims == 2) {
        // Two kinds of four: the diagonals, and the axes.
        const float diagonal = 0.70710678f;
        int is_diagonal = kind & 1, is_x = kind >> 1;
        return (simplex_gradient){is_diagonal ? diagonal * p
                                  : is_x      ? p
                                              : 0.0f,
                                  is_diagonal ? (is_x ? diagonal : -diagonal)
                                  : is_x      ? 0.0f
                                              : p,
                                  0, 0};
    }
    // The axis `kind` is left out; the three signs go to the others in turn.
    return (simplex_gradient){kind == 0 ? 0.0f : p,
                              kind == 1   ? 0.0f
                              : kind == 0 ? p
                                          : q,
                              kind == 2  ? 0.0f
                              : kind < 2 ? q
                                         : r,
                              kind == 3 ? 0.0f : r};
}

// Gradient times offset. In 3-D without the product with the component that is 0: a sum of two
// components with the signs of bl_edge_gradient.
BL_INLINE float simplex_dot(unsigned dims, uint32_t word, const float d[BL_AXES]) {
    if (dims == 3) {
        uint32_t edge = bl_lattice_edge(word);
        float first = edge < 4 ? d[1] : d[0], second = edge < 8 ? d[2] : d[1];
        return bl_float_of_bits(bl_bits_of_float(first) ^ edge << 31) +
               bl_float_of_bits(bl_bits_of_float(second) ^ (edge >> 1) << 31);
    }
    simplex_gradient g = simplex_gradient_of(dims, word);
    float dot = g.x * d[0] + g.y * d[1];
    if (dims > 2)
        dot += g.z * d[2];
    if (dims > 3)
        dot += g.w * d[3];
    return dot;
}

// Additive halves are those of corner 0, summed over the axes; exclusive halves those of the cell
// and of the next.
typedef struct simplex_block {
    size_t lanes; // the points, rounded up to a multiple of BL_LANES
    double at[BL_AXES][BL_BLOCK];
    uint32_t add[BL_BLOCK], exclusive[BL_AXES][2][BL_BLOCK], rank[BL_AXES][BL_BLOCK];
    uint32_t word[BL_AXES + 1][BL_BLOCK]; // of the corners, for lattices that are not plain
    float offset[BL_AXES][BL_BLOCK];
    uint32_t strange; // whether there are points that are not near
    uint8_t outside[BL_BLOCK];
} simplex_block;

// Copies the points; in the place of the others than near ones stands 0.
BL_INLINE void simplex_copy(simplex_block *block, unsigned dims, const double *const at[BL_AXES],
                            size_t from, size_t count) {
    uint32_t strange = 0;
    block->lanes = (count + BL_LANES - 1) / BL_LANES * BL_LANES;
    for (unsigned a = 0; a < dims; a++) {
        const double *restrict x = at[a] + from;
        double *restrict to = block->at[a];
#pragma omp simd reduction(| : strange)
        for (size_t i = 0; i < count; i++) {
            uint32_t far = !(fabs(x[i]) < BL_NEAR);
            to[i] = far ? 0 : x[i];
            strange |= far;
        }
        for (size_t i = count; i < block->lanes; i++)
            to[i] = 0;
    }
    block->strange = strange;
}

// What a block's places pass through on their way.
typedef struct simplex_places {
    double cell[BL_AXES][BL_BLOCK], fraction[BL_AXES][BL_BLOCK];
    double cells[BL_BLOCK], shift[BL_BLOCK], total[BL_BLOCK]; // sums over the axes; the skew
} simplex_places;

// As simplex_place_of, operation by operation.
BL_INLINE void simplex_place_block(const simplex_block *restrict block, const unsigned dims,
                                   simplex_places *restrict places) {
    const size_t lanes = block->lanes;
    double *restrict cells = places->cells, *restrict shift = places->shift,
                     *restrict total = places->total;
    for (unsigned a = 0; a < dims; a++) {
        double *restrict cell = places->cell[a], *restrict fraction = places->fraction[a];
        const double *restrict at = block->at[a];
#pragma omp simd
        for (size_t i = 0; i < lanes; i++) {
            double down = floor(at[i]), rest = at[i] - down;
            cell[i] = down;
            fraction[i] = rest;
            cells[i] = a ? cells[i] + down : down;
            shift[i] = a ? shift[i] + rest : rest;
        }
    }
#pragma omp simd
    for (size_t i = 0; i < lanes; i++) {
        double whole, rest = simplex_skew_near(dims, cells[i], &whole);
        shift[i] = rest + simplex_skews[dims] * shift[i];
        cells[i] = whole;
    }
    for (unsigned a = 0; a < dims; a++) {
        double *restrict cell = places->cell[a], *restrict fraction = places->fraction[a];
#pragma omp simd
        for (size_t i = 0; i < lanes; i++) {
            double u = fraction[i] + shift[i], down = floor(u), rest = u - down;
            cell[i] += cells[i] + down;
            fraction[i] = rest;
            total[i] = a ? total[i] + rest : rest;
        }
    }
}

// Keys: numbers C = cell + 2^31 of near cells, which are below 2^30 in size, have a high half of 0.
BL_INLINE void simplex_load_near(simplex_block *restrict block, const bl_lattice *lattice,
                                 const unsigned dims) {
    simplex_places places;
    const size_t lanes = block->lanes;
    simplex_place_block(block, dims, &places);
    for (unsigned a = 0; a < dims; a++) {
        const uint32_t high = bl_lattice_high(lattice, a, 0);
        const uint32_t bias = lattice->offset[a] + 0x80000000u;
        const double *restrict cell = places.cell[a], *restrict fraction = places.fraction[a],
                               *restrict total = places.total;
        uint32_t *restrict sum = block->add, *restrict first = block->exclusive[a][0],
                           *restrict second = block->exclusive[a][1];
        float *restrict offset = block->offset[a];
#pragma omp simd
        for (size_t i = 0; i < lanes; i++) {
            uint32_t add = ((uint32_t)(int32_t)cell[i] + bias) * BL_LATTICE_M1;
            sum[i] = a ? sum[i] + add : add;
            first[i] = bl_lattice_exclusive(add, high);
            second[i] = bl_lattice_exclusive(add + BL_LATTICE_M1, high);
            offset[i] = (float)simplex_offset(dims, fraction[i], total[i]);
        }
    }
    for (unsigned a = 0; a < dims; a++) {
        const double *restrict own = places.fraction[a];
        uint32_t *restrict rank = block->rank[a];
        for (unsigned b = 0; b < dims; b++) {
            const double *restrict other = places.fraction[b];
            const uint32_t start = a;
            if (b < a)
#pragma omp simd
                for (size_t i = 0; i < lanes; i++)
                    rank[i] = (b ? rank[i] : start) - (own[i] > other[i]);
            else if (b > a)
#pragma omp simd
                for (size_t i = 0; i < lanes; i++)
                    rank[i] = (b > 1 || a ? rank[i] : start) + (other[i] > own[i]);
        }
    }
}

// Puts the points in that are not near.
static void simplex_load_far(simplex_block *block, const bl_lattice *lattice, unsigned dims,
                             const double *const at[BL_AXES], size_t from, size_t count) {
    for (size_t i = 0; i < count; i++) {
        double x[BL_AXES] = {0};
        for (unsigned a = 0; a < dims; a++)
            x[a] = at[a][from + i];
        block->outside[i] = 0;
        if (simplex_is_near(dims, x))
            continue;
        simplex_place place = {0};
        uint32_t rank[BL_AXES];
        block->outside[i] = !simplex_place_of(dims, x, &place);
        simplex_ranks(dims, place.fraction, rank);
        block->add[i] = 0;
        for (unsigned a = 0; a < dims; a++) {
            bl_lattice_key key = bl_lattice_key_of(lattice, a, place.cell[a]);
            block->add[i] += key.add;
            block->exclusive[a][0][i] = key.exclusive;
            block->exclusive[a][1][i] = bl_lattice_key_of(lattice, a, place.cell[a] + 1).exclusive;
            block->rank[a][i] = rank[a];
            block->offset[a][i] = (float)simplex_offset(dims, place.fraction[a], place.total);
        }
    }
}

// Places all points and makes the words of their corners, for any lattice.
static void simplex_load_words(simplex_block *block, const bl_lattice *lattice,
                               const uint32_t words256[256], unsigned dims,
                               const double *const at[BL_AXES], size_t from, size_t count) {
    for (size_t i = 0; i < block->lanes; i++) {
        double x[BL_AXES] = {0};
        for (unsigned a = 0; a < dims && i < count; a++)
            x[a] = at[a][from + i];
        simplex_place place = {0};
        uint32_t rank[BL_AXES];
        block->outside[i] = !simplex_place_of(dims, x, &place);
        simplex_ranks(dims, place.fraction, rank);
        for (unsigned a = 0; a < dims; a++) {
            block->rank[a][i] = rank[a];
            block->offset[a][i] = (float)simplex_offset(dims, place.fraction[a], place.total);
        }
        for (uint32_t k = 0; k <= dims; k++) {
            uint64_t corner[BL_AXES];
            for (unsigned a = 0; a < dims; a++)
                corner[a] = place.cell[a] + (rank[a] < k);
            block->word[k][i] = simplex_word(lattice, dims, corner, words256);
        }
    }
    block->strange = 1; // there may be points outside
}

// The word of corner k of point i on a plain lattice.
BL_INLINE uint32_t simplex_corner_word(const simplex_block *block, unsigned dims, const uint32_t k,
                                       size_t i) {
    uint32_t exclusive = 0;
    for (unsigned a = 0; a < dims; a++)
        exclusive ^= block->rank[a][i] < k ? block->exclusive[a][1][i] : block->exclusive[a][0][i];
    return (block->add[i] + k * BL_LATTICE_M1) * exclusive;
}

// What corner k, of that word, adds to point i.
BL_INLINE float simplex_corner(const simplex_block *block, unsigned dims, const uint32_t k,
                               uint32_t word, float radius2, size_t i) {
    float d[BL_AXES] = {0}, square = 0;
    const float back = (float)(k * simplex_unskews[dims]);
    for (unsigned a = 0; a < dims; a++) {
        d[a] = (block->offset[a][i] + back) - (block->rank[a][i] < k ? 1.0f : 0.0f);
        square += d[a] * d[a];
    }
    float t = radius2 - square;
    t = t > 0 ? t * t : 0;
    return t * t * simplex_dot(dims, word, d);
}

BL_INLINE void simplex_add_corners(const simplex_block *restrict block, const unsigned dims,
                                   const int plain, float radius2, float scale,
                                   float *restrict sum) {
#define SIMPLEX_CORNER(k)                                                                          \
    simplex_corner(block, dims, k,                                                                 \
                   plain ? simplex_corner_word(block, dims, k, i) : block->word[k][i], radius2, i)
#pragma omp simd
    for (size_t i = 0; i < block->lanes; i++) {
        float all = SIMPLEX_CORNER(0);
        all += SIMPLEX_CORNER(1);
        all += SIMPLEX_CORNER(2);
        if (dims > 2)
            all += SIMPLEX_CORNER(3);
        if (dims > 3)
            all += SIMPLEX_CORNER(4);
        sum[i] = all * scale;
    }
#undef SIMPLEX_CORNER
}

BL_INLINE void simplex_points(const bl_lattice *lattice, const unsigned dims, float radius2,
                              float scale, const double *const at[BL_AXES], size_t count,
                              float *out) {
    const int plain = simplex_is_plain(lattice);
    uint32_t words256[256];
    simplex_block block;
    if (lattice->kind == BL_LATTICE_PERM256)
        bl_perm256_words(lattice, 0, words256);
    for (size_t done = 0; done < count; done += BL_BLOCK) {
        size_t here = count - done < BL_BLOCK ? count - done : BL_BLOCK;
        float sum[BL_BLOCK];
        simplex_copy(&block, dims, at, done, here);
        if (count - done >= 2 * BL_BLOCK) // the next block comes while this one is worked on
            for (unsigned a = 0; a < dims; a++)
                for (size_t i = BL_BLOCK; i < 2 * BL_BLOCK; i += 8)
                    __builtin_prefetch(at[a] + done + i);
        if (plain) {
            simplex_load_near(&block, lattice, dims);
            if (block.strange)
                simplex_load_far(&block, lattice, dims, at, done, here);
            simplex_add_corners(&block, dims, 1, radius2, scale, sum);
        } else {
            simplex_load_words(&block, lattice, words256, dims, at, done, here);
            simplex_add_corners(&block, dims, 0, radius2, scale, sum);
        }
        memcpy(out + done, sum, here * sizeof *out);
        for (size_t i = 0; block.strange && i < here; i++)
            out[done + i] = block.outside[i] ? NAN : out[done + i];
    }
}

#endif
