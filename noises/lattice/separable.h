// SPDX-License-Identifier: MIT
//
// What the fast loops of the separable lattice noises share: blocks of points, and rows along an
// axis.
//
// Points come in blocks that fit the first-level cache. A block is split into cells and fractions,
// and the keys of the 2 to 4 nearest lattice planes are made once for each axis; a corner then
// costs a sum, an exclusive or and a product (noises/lattice/lattice.h).
//
// A row along an axis knows more: the lattice work of the other two axes is the same for all
// samples, and between two lattice planes the noise is a polynomial in the fraction. Its
// coefficients are made for a run of cells side by side, each lattice plane once. Samples then
// evaluate the polynomial of their cell: where many share a cell, run by run; else by index. Both
// do the same operations on the same numbers. A row with more than `widest` cells a sample falls
// back to points; that choice depends on the step alone.
//
// A coordinate is rounded once, to a multiple of 2^-24 (half a unit in the last place of a float
// near 1), ties to even, and splits then exactly into cell and fraction: by itself, and does not
// depend on its neighbours in a block. So neither the length of a row, nor where it was cut, nor
// the points of a batch change a bit of a sample.
#ifndef BL_NOISES_LATTICE_SEPARABLE_H
#define BL_NOISES_LATTICE_SEPARABLE_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "core/signal.h"
#include "noises/lattice/lattice.h"

enum {
    BL_LANES = 16,  // floats in the widest vector; loops run on multiples of it
    BL_BLOCK = 128, // points in a block
    BL_KNOTS = 4,   // the most lattice planes an axis needs for one point
    BL_ROW = 512,   // samples of a row in a block
    BL_CELLS = 1024 // the most cells in a block of a row
};

// --- blocks of points ---------------------------------------------------------------------------

typedef struct bl_axis_block {
    uint32_t add[BL_KNOTS][BL_BLOCK], exclusive[BL_KNOTS][BL_BLOCK];
    uint32_t cell[BL_BLOCK]; // the cell number's low half plus BL_NEAR_BIAS
    float fraction[BL_BLOCK];
    uint32_t plane[BL_KNOTS][BL_BLOCK]; // lattice=perm256: low halves of the planes' numbers
} bl_axis_block;

typedef struct bl_point_block {
    bl_axis_block axis[BL_AXES];
    unsigned dimensions; // the axes that are loaded
    size_t lanes;        // the points, rounded up to a multiple of BL_LANES with copies of the last
    int any_outside;
    unsigned char outside[BL_BLOCK];
    const bl_lattice *lattice;
    int first; // of the planes: 0 for the cell's own two, -1 for the four around it
    int knots;
    uint32_t words256[BL_COMPONENTS][256]; // for lattice=perm256
} bl_point_block;

// In x + 1.5 * 2^28, |x| < 2^27, the last bit is worth 2^-24, the low 24 bits are the fraction and
// the next 28 are the cell plus 2^27; 0x41B above them says that the sum is in [2^28, 2^29).
#define BL_NEAR 0x1p27
#define BL_NEAR_MAGIC 0x1.8p28
#define BL_NEAR_EXPONENT 0x41b00000u
#define BL_NEAR_BIAS 0xb8000000u // what (high << 8 | low >> 24) has above the cell, mod 2^32

// Doubles to be read as 32-bit halves, the low half first (little endian, as all x86-64).
typedef union bl_halves {
    double number[BL_ROW];
    uint32_t half[2 * BL_ROW];
} bl_halves;

// Splits near coordinates; a result other than 0 says that one was not near.
static inline uint32_t bl_split_near(const double *restrict x, size_t lanes,
                                     uint32_t *restrict cell, float *restrict fraction) {
    bl_halves shifted;
    uint32_t strange = 0;
#pragma omp simd
    for (size_t i = 0; i < lanes; i++)
        shifted.number[i] = x[i] + BL_NEAR_MAGIC;
#pragma omp simd reduction(| : strange)
    for (size_t i = 0; i < lanes; i++) {
        uint32_t low = shifted.half[2 * i], high = shifted.half[2 * i + 1];
        strange |= high ^ BL_NEAR_EXPONENT;
        cell[i] = high << 8 | low >> 24;
        fraction[i] = (float)(int32_t)(low & 0xffffffu) * 0x1p-24f;
    }
    return strange >> 20;
}

// Keys of the planes of near cells: C = cell + 2^31 has a high half of 0.
static inline void bl_keys_near(const bl_point_block *block, unsigned axis, bl_axis_block *keys) {
    const uint32_t high = bl_lattice_high(block->lattice, axis, 0);
    const uint32_t *restrict cell = keys->cell;
    const uint32_t offset =
        block->lattice->offset[axis] + 0x80000000u - BL_NEAR_BIAS + (uint32_t)block->first;
    const size_t lanes = block->lanes;
    uint32_t *restrict first = keys->add[0], *restrict exclusive = keys->exclusive[0];
#pragma omp simd
    for (size_t i = 0; i < lanes; i++) {
        uint32_t half = (cell[i] + offset) * BL_LATTICE_M1;
        first[i] = half;
        exclusive[i] = bl_lattice_exclusive(half, high);
    }
    for (int knot = 1; knot < block->knots; knot++) {
        uint32_t step = (uint32_t)knot * BL_LATTICE_M1;
        uint32_t *restrict add = keys->add[knot];
        exclusive = keys->exclusive[knot];
#pragma omp simd
        for (size_t i = 0; i < lanes; i++) {
            uint32_t half = first[i] + step;
            add[i] = half;
            exclusive[i] = bl_lattice_exclusive(half, high);
        }
    }
}

// The same for near cells of a periodic lattice, one axis of them. Of whole numbers c and p with
// |c| < 2^28 and p < 2^32 the quotient is 1/p or more below the next whole number, and 2^-53 of it
// is less: the floor of the rounded quotient is that of the quotient, and all below is exact.
static inline void bl_keys_near_periodic(const bl_point_block *block, unsigned axis,
                                         bl_axis_block *keys) {
    const uint32_t period = block->lattice->period[axis], offset = block->lattice->offset[axis];
    const uint32_t low = bl_lattice_high(block->lattice, axis, 0),
                   high = bl_lattice_high(block->lattice, axis, 1);
    const uint32_t bias = BL_NEAR_BIAS - (uint32_t)block->first;
    const double length = period;
    const size_t lanes = block->lanes;
    bl_halves shifted;
    uint32_t wrapped[BL_BLOCK];
#pragma omp simd
    for (size_t i = 0; i < lanes; i++) {
        double cell = (double)(int32_t)(keys->cell[i] - bias);
        // In [0, 2^32): the low half of the sum with 2^52 is the number.
        shifted.number[i] = (cell - floor(cell / length) * length) + 0x1p52;
    }
    for (size_t i = 0; i < lanes; i++)
        wrapped[i] = shifted.half[2 * i];
    for (int knot = 0; knot < block->knots; knot++) {
        uint32_t *restrict add = keys->add[knot], *restrict exclusive = keys->exclusive[knot];
        uint32_t *restrict plane = keys->plane[knot];
#pragma omp simd
        for (size_t i = 0; i < lanes; i++) {
            uint32_t here = wrapped[i], half = (here + 0x80000000u + offset) * BL_LATTICE_M1;
            plane[i] = here;
            add[i] = half;
            exclusive[i] = bl_lattice_exclusive(half, here >> 31 ? high : low);
            wrapped[i] = here + 1 == period ? 0 : here + 1;
        }
    }
}

// The planes of near cells for lattice=perm256, which needs nothing else of a cell.
static inline void bl_planes_near(const bl_point_block *block, bl_axis_block *keys) {
    const uint32_t *restrict cell = keys->cell;
    for (int knot = 0; knot < block->knots; knot++) {
        const uint32_t offset = (uint32_t)(block->first + knot) - BL_NEAR_BIAS;
        uint32_t *restrict plane = keys->plane[knot];
#pragma omp simd
        for (size_t i = 0; i < block->lanes; i++)
            plane[i] = cell[i] + offset;
    }
}

// The same for any coordinate, one by one; points outside of the domain are marked.
static inline void bl_keys_far(bl_point_block *block, unsigned axis, const double *x) {
    bl_axis_block *keys = &block->axis[axis];
    for (size_t i = 0; i < block->lanes; i++) {
        uint64_t cell = 0;
        double fraction = 0;
        // Rounds as bl_split_near does: near numbers at once, because between -1 and 0 the fraction
        // of all their digits would not be exact.
        double near = (x[i] + BL_NEAR_MAGIC) - BL_NEAR_MAGIC;
        if (!bl_lattice_split(fabs(x[i]) < BL_NEAR ? near : x[i], &cell, &fraction))
            block->outside[i] = 1;
        // For the others the fraction, which is exact; 1 belongs to the next cell.
        fraction = (fraction + BL_NEAR_MAGIC) - BL_NEAR_MAGIC;
        cell += fraction >= 1;
        keys->cell[i] = (uint32_t)cell + BL_NEAR_BIAS;
        keys->fraction[i] = fraction >= 1 ? 0 : (float)fraction;
        for (int knot = 0; knot < block->knots; knot++) {
            uint64_t plane = cell + (uint64_t)(int64_t)(block->first + knot);
            bl_lattice_key key = bl_lattice_key_of(block->lattice, axis, plane);
            keys->add[knot][i] = key.add;
            keys->exclusive[knot][i] = key.exclusive;
            keys->plane[knot][i] = (uint32_t)bl_lattice_wrap(block->lattice, axis, plane);
        }
    }
    block->any_outside = 1;
}

static inline void bl_point_block_begin(bl_point_block *block, const bl_lattice *lattice, int first,
                                        int knots) {
    block->lattice = lattice;
    block->first = first;
    block->knots = knots;
    block->dimensions = 3;
    if (lattice->kind == BL_LATTICE_PERM256)
        for (unsigned component = 0; component < BL_COMPONENTS; component++)
            bl_perm256_words(lattice, component, block->words256[component]);
}

// Loads `count` (1 to BL_BLOCK) points.
static inline void bl_point_block_load(bl_point_block *block, const double *const at[BL_AXES],
                                       size_t from, size_t count) {
    double padded[BL_BLOCK];
    block->lanes = (count + BL_LANES - 1) / BL_LANES * BL_LANES;
    block->any_outside = 0;
    for (unsigned axis = 0; axis < block->dimensions; axis++) {
        const double *x = at[axis] + from;
        if (count < block->lanes) {
            for (size_t i = 0; i < block->lanes; i++)
                padded[i] = x[i < count ? i : count - 1];
            x = padded;
        }
        bl_axis_block *keys = &block->axis[axis];
        if (bl_split_near(x, block->lanes, keys->cell, keys->fraction) == 0) {
            if (block->lattice->period[axis])
                bl_keys_near_periodic(block, axis, keys);
            else if (block->lattice->kind == BL_LATTICE_HASH)
                bl_keys_near(block, axis, keys);
            else
                bl_planes_near(block, keys);
            continue;
        }
        if (!block->any_outside)
            memset(block->outside, 0, sizeof block->outside);
        bl_keys_far(block, axis, x);
    }
}

// The words of one corner of every point, for any lattice.
static inline void bl_point_block_words(const bl_point_block *block, const int knot[3],
                                        unsigned component, uint32_t *restrict words) {
    const bl_axis_block *x = &block->axis[0], *y = &block->axis[1], *z = &block->axis[2];
    if (block->lattice->kind == BL_LATTICE_HASH) {
        const uint32_t add = block->lattice->add[component],
                       exclusive = block->lattice->exclusive[component];
        const uint32_t *restrict ax = x->add[knot[0]], *restrict ay = y->add[knot[1]],
                                 *restrict az = z->add[knot[2]],
                                 *restrict ex = x->exclusive[knot[0]],
                                 *restrict ey = y->exclusive[knot[1]],
                                 *restrict ez = z->exclusive[knot[2]];
#pragma omp simd
        for (size_t i = 0; i < block->lanes; i++)
            words[i] = (ax[i] + ay[i] + az[i] + add) * (ex[i] ^ ey[i] ^ ez[i] ^ exclusive);
        return;
    }
    const uint32_t *restrict px = x->plane[knot[0]], *restrict py = y->plane[knot[1]],
                             *restrict pz = z->plane[knot[2]];
    for (size_t i = 0; i < block->lanes; i++)
        words[i] = block->words256[component][bl_perm256_index(px[i], py[i], pz[i])];
}

// Writes the values of a block times `scale`, and NaN outside of the domain.
static inline void bl_point_block_store(const bl_point_block *block, const float *restrict value,
                                        float scale, size_t count, float *restrict out) {
#pragma omp simd
    for (size_t i = 0; i < count; i++)
        out[i] = value[i] * scale;
    for (size_t i = 0; block->any_outside && i < count; i++)
        out[i] = block->outside[i] ? NAN : out[i];
}

// --- rows ---------------------------------------------------------------------------------------

// The coordinates of `count` (at most BL_BLOCK) samples of a row from sample `first` on.
static inline void bl_row_coordinates(double start, double step, size_t first, size_t count,
                                      double *restrict x) {
    const double number = (double)first; // exact to 2^53 samples
    const int samples = (int)count;
#pragma omp simd
    for (int i = 0; i < samples; i++)
        x[i] = start + (number + i) * step;
}

// Any row through the points of a noise.
typedef void bl_points_function(const void *parameters, const double *const at[BL_AXES],
                                size_t count, float *out);

static inline void bl_row_by_points(bl_points_function *points, const void *parameters,
                                    const double start[BL_AXES], const double step[BL_AXES],
                                    size_t first, size_t count, float *out) {
    double at[BL_AXES][BL_BLOCK];
    const double *const columns[BL_AXES] = {at[0], at[1], at[2], at[3]};
    for (size_t done = 0; done < count; done += BL_BLOCK) {
        size_t here = count - done < BL_BLOCK ? count - done : BL_BLOCK;
        for (int axis = 0; axis < BL_AXES; axis++)
            bl_row_coordinates(start[axis], step[axis], first + done, here, at[axis]);
        points(parameters, columns, here, out + done);
    }
}

// In a noise file, after its `points`: a row for a noise that has none faster. Compiled with the
// noise, for each instruction set: where points are cheap, a third of the time are coordinates.
#define BL_ROW_OF_POINTS                                                                           \
    static void row(const void *block, const double start[BL_AXES], const double step[BL_AXES],    \
                    size_t count, float *out) {                                                    \
        bl_row_by_points(points, block, start, step, 0, count, out);                               \
    }

// The axis a row runs along (x for a row that stands still), or -1 if it is oblique, or takes more
// than `widest` cells a sample.
static inline int bl_row_axis(const double step[BL_AXES], double widest) {
    int axis = 0, moving = 0;
    for (int a = 0; a < 3; a++)
        if (step[a] != 0) {
            axis = a;
            moving++;
        }
    return moving <= 1 && fabs(step[axis]) <= widest ? axis : -1;
}

// A block of a row: the samples' cells, counted from `cell`, and fractions.
typedef struct bl_row_block {
    uint32_t index[BL_ROW + BL_LANES];
    float fraction[BL_ROW + BL_LANES];
    size_t count;
    uint64_t cell;
    size_t cells;
    size_t lanes;   // cells plus the planes beyond, rounded up to a multiple of BL_LANES
    float per_cell; // about the samples in a cell
    int rising, dense;
} bl_row_block;

// Splits up to BL_ROW samples, fewer if they span too many cells (far out, where neighbouring
// doubles are many cells apart) or if the domain ends among them. The cell planes lie at whole
// numbers minus `shift`, which is 0 or 1/2. Returns 0 if the samples are outside of the domain.
static inline int bl_row_block_load(bl_row_block *block, double start, double step, size_t first,
                                    size_t count, double shift) {
    count = count < BL_ROW ? count : BL_ROW;
    double from = start + (double)first * step, to;
    int inside;
    for (;; count = (count + 1) / 2) {
        to = start + (double)(first + count - 1) * step;
        inside = fabs(from) < 0x1p62;
        // Both ends are inside, or both are outside, on one side because they are not far apart;
        // coordinates are monotone along a row, so all between are as the ends. It stops after one
        // sample if that one does not advance (or is infinite or NaN: no number is the distance).
        if (inside == (fabs(to) < 0x1p62) && !(fabs(to - from) >= BL_CELLS - 4))
            break;
    }
    block->count = count;
    if (!inside)
        return 0;
    double base = floor(fmin(from, to));
    bl_halves shifted;
    // Near numbers are rounded by the sum with `magic` alone; the 1 is room for the shift. The
    // others are above 2^27 - 2^11 > 2^26 in size, so that x and base are multiples of 2^-26, and
    // 0 <= x - base < 2^10: exact. Its sum with `magic` rounds as that of x would, ties too: base
    // is a multiple of 2 * 2^-24.
    const int near = fmax(fabs(from), fabs(to)) < BL_NEAR - 1;
    const double number = (double)first, magic = shift + BL_NEAR_MAGIC, origin = near ? 0 : base;
    const uint32_t bias = BL_NEAR_BIAS + (near ? (uint32_t)(int64_t)base : 0);
    const int samples = (int)count;
#pragma omp simd
    for (int i = 0; i < samples; i++)
        shifted.number[i] = ((start + (number + i) * step) - origin) + magic;
#pragma omp simd
    for (size_t i = 0; i < count; i++) {
        uint32_t low = shifted.half[2 * i], high = shifted.half[2 * i + 1];
        block->index[i] = (high << 8 | low >> 24) - bias;
        block->fraction[i] = (float)(int32_t)(low & 0xffffffu) * 0x1p-24f;
    }
    for (size_t i = count; i < count + BL_LANES; i++) {
        block->index[i] = 0;
        block->fraction[i] = 0;
    }
    block->cell = (uint64_t)(int64_t)base;
    // As the coordinates, the cells are monotone.
    uint32_t last = block->index[from < to ? count - 1 : 0];
    block->cells = last + 1;
    block->lanes = (block->cells + BL_KNOTS + BL_LANES - 1) / BL_LANES * BL_LANES;
    block->per_cell = fabs(step) > 0x1p-60 ? (float)(1 / fabs(step)) : 0x1p60f;
    block->rising = step > 0;
    block->dense = block->per_cell >= 6;
    return 1;
}

enum { BL_PLANES = BL_CELLS + BL_KNOTS + BL_LANES };

// The number of a plane of a periodic lattice after a given one.
static inline uint64_t bl_lattice_next(uint32_t period, uint64_t wrapped) {
    return wrapped + 1 == period ? 0 : wrapped + 1;
}

// The keys of the lattice planes of a row's block in a periodic lattice.
static inline void bl_row_keys_periodic(const bl_row_block *block, const bl_lattice *lattice,
                                        unsigned axis, int first, uint32_t *restrict add,
                                        uint32_t *restrict exclusive) {
    const uint32_t period = lattice->period[axis];
    uint64_t plane = bl_lattice_wrap(lattice, axis, block->cell + (uint64_t)(int64_t)first);
    const uint32_t low = bl_lattice_high(lattice, axis, 0),
                   high = bl_lattice_high(lattice, axis, 1);
    for (size_t m = 0; m < block->lanes; m++, plane = bl_lattice_next(period, plane)) {
        add[m] = ((uint32_t)plane + 0x80000000u + lattice->offset[axis]) * BL_LATTICE_M1;
        exclusive[m] = bl_lattice_exclusive(add[m], plane >> 31 ? high : low);
    }
}

// The keys of the lattice planes of a row's block, from plane `first` of its first cell on.
static inline void bl_row_keys(const bl_row_block *block, const bl_lattice *lattice, unsigned axis,
                               int first, uint32_t *restrict add, uint32_t *restrict exclusive) {
    if (lattice->period[axis]) {
        bl_row_keys_periodic(block, lattice, axis, first, add, exclusive);
        return;
    }
    const uint64_t biased = block->cell + (uint64_t)(int64_t)first + UINT64_C(0x80000000);
    const uint32_t low = (uint32_t)biased, high = (uint32_t)(biased >> 32);
    const uint32_t offset = lattice->offset[axis], lanes = (uint32_t)block->lanes;
    // A block has fewer than 2^32 planes: it sees at most two high halves.
    const uint32_t before = bl_lattice_high(lattice, axis, high);
    const uint32_t after = bl_lattice_high(lattice, axis, high + 1);
#pragma omp simd
    for (uint32_t m = 0; m < lanes; m++) {
        uint32_t here = low + m;
        uint32_t half = (here + offset) * BL_LATTICE_M1;
        add[m] = half;
        exclusive[m] = bl_lattice_exclusive(half, here < low ? after : before);
    }
}

// What a block outside of the domain has.
static inline void bl_row_nan(const bl_row_block *block, float *out) {
    for (size_t i = 0; i < block->count; i++)
        out[i] = NAN;
}

// What the two other axes of a row say: their cells, fractions and keys.
typedef struct bl_row_cross {
    const bl_lattice *lattice;
    unsigned axis, across[2]; // the row's axis and the two others
    uint64_t cell[2];
    double fraction[2];
    bl_lattice_key key[2][BL_KNOTS];
} bl_row_cross;

// The planes across lie at whole numbers minus `shift`, from plane `first` of the cell on. Returns
// 0 outside of the domain.
static inline int bl_row_cross_load(bl_row_cross *cross, const bl_lattice *lattice, unsigned axis,
                                    const double start[BL_AXES], int first, int knots,
                                    double shift) {
    cross->lattice = lattice;
    cross->axis = axis;
    for (unsigned b = 0; b < 2; b++) {
        unsigned other = (axis + 1 + b) % 3;
        cross->across[b] = other;
        if (!bl_lattice_split(start[other], &cross->cell[b], &cross->fraction[b]))
            return 0;
        cross->fraction[b] += shift;
        if (cross->fraction[b] >= 1) {
            cross->fraction[b] -= 1;
            cross->cell[b]++;
        }
        for (int knot = 0; knot < knots; knot++)
            cross->key[b][knot] = bl_lattice_key_of(
                lattice, other, cross->cell[b] + (uint64_t)(int64_t)(first + knot));
    }
    return 1;
}

// The words of lattice=perm256 along a row, at the given plane numbers across.
static inline void bl_row_words256(const bl_row_block *block, const bl_row_cross *cross,
                                   const uint32_t words256[256], int first, int j, int k,
                                   uint32_t *restrict words) {
    const bl_lattice *lattice = cross->lattice;
    const int knot[2] = {j, k};
    uint64_t cell[3];
    for (int b = 0; b < 2; b++)
        cell[cross->across[b]] = bl_lattice_wrap(
            lattice, cross->across[b], cross->cell[b] + (uint64_t)(int64_t)(first + knot[b]));
    uint64_t plane = bl_lattice_wrap(lattice, cross->axis, block->cell + (uint64_t)(int64_t)first);
    // Without a period no plane is followed by plane 0, but -1, which has it anyway.
    const uint32_t period = lattice->period[cross->axis];
    for (size_t m = 0; m < block->lanes; m++, plane = bl_lattice_next(period, plane)) {
        cell[cross->axis] = plane;
        words[m] = words256[bl_perm256_index(cell[0], cell[1], cell[2])];
    }
}

// About how many samples of the first run of a block share its cell.
static inline size_t bl_row_first_run(const bl_row_block *block) {
    float left = block->rising ? 1 - block->fraction[0] : block->fraction[0];
    float guess = left * block->per_cell;
    return guess < BL_ROW ? (size_t)guess + 1 : BL_ROW;
}

// Where the run of samples ends that share the cell of sample `from`. The guess, at least 1, makes
// the end predictable, so that the processor need not wait for one run to begin the next.
static inline size_t bl_row_run_end(const bl_row_block *block, size_t from, size_t guess) {
    const uint32_t *index = block->index;
    size_t end = from + guess < block->count ? from + guess : block->count;
    while (index[end - 1] != index[from])
        end--;
    while (end < block->count && index[end] == index[from])
        end++;
    return end;
}

// A sample's value from the four numbers of its cell; `fade` is a further number of the sample.
BL_INLINE float bl_row_cubic(float t, float fade, float c0, float c1, float c2, float c3) {
    (void)fade;
    return c0 + t * (c1 + t * (c2 + t * c3));
}

// Two lines a + b t and (a + c) + (b + d) t, blended by the fade.
BL_INLINE float bl_row_blend(float t, float fade, float a, float b, float c, float d) {
    return (a + b * t) + fade * (c + d * t);
}

typedef float bl_row_formula(float t, float fade, float c0, float c1, float c2, float c3);

// Evaluates the formula at every sample of a block.
BL_INLINE void bl_row_evaluate(const bl_row_block *block, bl_row_formula *formula,
                               float (*restrict c)[BL_PLANES], const float *restrict fade,
                               float *restrict out) {
    const float *restrict fraction = block->fraction;
    const uint32_t *restrict index = block->index;
    const float *restrict c0 = c[0], *restrict c1 = c[1], *restrict c2 = c[2], *restrict c3 = c[3];
    const size_t count = block->count;
    if (!block->dense) {
#pragma omp simd
        for (size_t i = 0; i < count; i++) {
            uint32_t m = index[i];
            out[i] = formula(fraction[i], fade[i], c0[m], c1[m], c2[m], c3[m]);
        }
        return;
    }
    // Whole vectors; what they write past the end of a run, the next run overwrites.
    float tail[BL_LANES];
    size_t guess = bl_row_first_run(block);
    const size_t usual = block->per_cell < BL_ROW ? (size_t)(block->per_cell + 0.5f) : BL_ROW;
    for (size_t from = 0, end; from < count; from = end, guess = usual) {
        uint32_t m = index[from];
        float d0 = c0[m], d1 = c1[m], d2 = c2[m], d3 = c3[m];
        end = bl_row_run_end(block, from, guess);
        for (size_t i = from; i < end; i += BL_LANES) {
            float *restrict to = i + BL_LANES <= count ? out + i : tail;
#pragma omp simd
            for (size_t l = 0; l < BL_LANES; l++)
                to[l] = formula(fraction[i + l], fade[i + l], d0, d1, d2, d3);
            if (to == tail)
                memcpy(out + i, tail, (count - i) * sizeof *out);
        }
    }
}

#endif
