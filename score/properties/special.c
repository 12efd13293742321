// SPDX-License-Identifier: MIT
#include "score/properties/special.h"

#include <assert.h>
#include <math.h>
#include <string.h>

enum { REPEATS = 4 };

// A fraction that is neither 0 nor 1/2.
static double fraction(bl_random *random) {
    double f = floor(511 * bl_random_unit(random)) + 1; // 1 to 511
    return (f + (bl_random_unit(random) < 0.5 ? 0 : 512)) * 0x1p-10;
}

// Negative cells as often as others.
static double whole(bl_random *random) {
    return floor(16 * bl_random_unit(random)) - 8;
}

static void draw(bl_random *random, double at[BL_AXES]) {
    for (int a = 0; a < BL_AXES; a++)
        at[a] = whole(random) + fraction(random);
}

static void add(bl_special *special, unsigned dimensions, double cell, const double at[BL_AXES]) {
    assert(special->count < BL_SPECIAL_MOST);
    for (unsigned a = 0; a < BL_AXES; a++)
        special->at[a][special->count] = a < dimensions ? cell * at[a] : 0;
    special->count++;
}

static unsigned bits(unsigned set) {
    return (unsigned)__builtin_popcount(set);
}

// Whole, half, zero and negative zero on a set of axes.
static void add_planes(bl_special *special, unsigned dimensions, double cell, unsigned set,
                       bl_random *random) {
    for (int kind = 0; kind < 4; kind++) {
        double at[BL_AXES];
        if (kind == 3 && set + 1 < 1u << dimensions) // -0.0 on all axes alone
            continue;
        draw(random, at);
        for (unsigned a = 0; a < dimensions; a++)
            if (set >> a & 1)
                at[a] = kind == 0   ? whole(random)
                        : kind == 1 ? whole(random) + 0.5
                        : kind == 2 ? 0.0
                                    : -0.0;
        add(special, dimensions, cell, at);
    }
}

// Equal fractions, and equal coordinates.
static void add_ties(bl_special *special, unsigned dimensions, double cell, unsigned set,
                     bl_random *random) {
    for (int equal = 0; equal < 2; equal++) {
        double at[BL_AXES], tie = fraction(random), same = whole(random);
        draw(random, at);
        for (unsigned a = 0; a < dimensions; a++)
            if (set >> a & 1)
                at[a] = (equal ? same : whole(random)) + tie;
        add(special, dimensions, cell, at);
    }
}

// The last axis of the set is solved for: the sum, with its signs, is whole or zero.
static void add_sums(bl_special *special, unsigned dimensions, double cell, unsigned set,
                     bl_random *random) {
    const unsigned count = bits(set);
    for (unsigned signs = 0; signs < 1u << (count - 1); signs++)
        for (int zero = 0; zero < 2; zero++) {
            double at[BL_AXES], sum = zero ? 0 : whole(random);
            unsigned last = 0, seen = 0;
            draw(random, at);
            for (unsigned a = 0; a < dimensions; a++) {
                if (!(set >> a & 1))
                    continue;
                last = a;
                if (++seen < count)
                    sum -= signs >> (seen - 1) & 1 ? -at[a] : at[a];
            }
            at[last] = sum;
            add(special, dimensions, cell, at);
        }
}

// A plane of the skewed lattice across one axis, which is solved for. F is irrational but for three
// axes, so that of the doubles around the plane one is taken whose own sum is whole, if there is.
static void add_skewed(bl_special *special, unsigned dimensions, double cell, unsigned axis,
                       bl_random *random) {
    const double skew = (sqrt(dimensions + 1.0) - 1) / dimensions;
    double at[BL_AXES], others = 0, plane = whole(random);
    draw(random, at);
    for (unsigned a = 0; a < dimensions; a++)
        others += a == axis ? 0 : at[a];
    double best = (plane - skew * others) / (1 + skew), near = best;
    for (int k = 0; k < 8; k++)
        near = nextafter(near, -INFINITY);
    for (int k = 0; k <= 16; k++, near = nextafter(near, INFINITY)) {
        double sum = 0;
        at[axis] = near;
        for (unsigned a = 0; a < dimensions; a++)
            sum += at[a];
        if (near + sum * skew == plane) {
            best = near;
            break;
        }
    }
    at[axis] = best;
    add(special, dimensions, cell, at);
}

void bl_special_fill(bl_special *special, unsigned dimensions, double cell, bl_random *random) {
    dimensions = dimensions < BL_AXES ? dimensions : BL_AXES;
    memset(special, 0, sizeof *special);
    add(special, dimensions, cell, (const double[BL_AXES]){0});
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        for (unsigned set = 1; set < 1u << dimensions; set++) {
            add_planes(special, dimensions, cell, set, random);
            if (bits(set) < 2)
                continue;
            add_ties(special, dimensions, cell, set, random);
            add_sums(special, dimensions, cell, set, random);
        }
        for (unsigned a = 0; a < dimensions && dimensions > 1; a++)
            add_skewed(special, dimensions, cell, a, random);
    }
}
