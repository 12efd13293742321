// SPDX-License-Identifier: MIT
//
// Lattices of one, two and four dimensions: words and gradients. (Those of three: lattice.h.)
//
// The fourth axis has a key as the others have. In fewer dimensions than three, the axes that are
// left out stand at cell 0, in the hash and in the index of lattice=perm256 alike: a word is then
// as good as one of a row of the lattice in space, and the value noises that interpolate are
// slices of that in space.
//
// Gradients in d dimensions, floats by definition (lattice.h has those of d = 3); all have the mean
// 0 and E[g_a g_b] = 0 for a != b:
//
//   sphere     d = 1: uniform in (-1, 1), as a component of a unit vector in space is
//              (Archimedes); E[g^2] = 1/3. The sphere itself would be the two numbers +-1, and the
//              noise in a cell one of four curves.
//              d = 2: the unit circle, 2^18 directions a quadrant from the bits 31 to 12 of the
//              word by the polynomials of lattice.h; E[g_a^2] = 1/2.
//              d = 4: the unit 3-sphere in Hopf's coordinates, sqrt((1-v)/2) (cos a, sin a) and
//              sqrt((1+v)/2) (cos b, sin b) with v uniform in (-1, 1), which makes it uniform
//              because the surface between two v is proportional to their distance; v and a as
//              height and longitude of lattice.h from one word, b from component 1; E[g_a^2] = 1/4.
//              Of unit length to 1e-6.
//   rejection  uniform in the cube, discarded outside of the unit ball, normalised: E[g_a^2] = 1/d.
//              +-1 for d = 1. 16 bits an axis for d = 4, else 21; at most 64 tries, whose failure
//              has the probability 6e-11 for d = 4.
//   edges      d = 1: +-1; d = 2: the four diagonals (+-1, +-1); d = 4: the 32 midpoints of the
//              edges of the cube, of which one component is 0. E[g_a^2] = 1, 1, 3/4.
#ifndef BL_NOISES_LATTICE_LATTICE_DIMENSIONS_H
#define BL_NOISES_LATTICE_LATTICE_DIMENSIONS_H

#include "noises/lattice/lattice.h"

// --- words --------------------------------------------------------------------------------------

// Of wrapped cells; those of axes that the noise lacks are 0.
static inline uint32_t bl_perm256_index_in(unsigned dimensions, const uint64_t cell[BL_AXES]) {
    uint64_t last = dimensions == 4 ? bl_permutation[cell[3] & 255] : 0;
    return bl_perm256_index(cell[0], cell[1], cell[2] + last);
}

// The word of a cell, straightforwardly; cells beyond the dimensions are not read.
static inline uint32_t bl_lattice_word_in(const bl_lattice *lattice, unsigned dimensions,
                                          const uint64_t cell[BL_AXES], unsigned component) {
    uint64_t there[BL_AXES] = {0};
    for (unsigned axis = 0; axis < dimensions; axis++)
        there[axis] = bl_lattice_wrap(lattice, axis, cell[axis]);
    if (lattice->kind == BL_LATTICE_PERM256)
        return bl_perm256_word(lattice, bl_perm256_index_in(dimensions, there), component);
    uint32_t add = lattice->add[component], exclusive = lattice->exclusive[component];
    for (unsigned axis = 0; axis < (dimensions == 4 ? 4 : 3); axis++) {
        bl_lattice_key key = bl_lattice_wrapped_key(lattice, axis, there[axis]);
        add += key.add;
        exclusive ^= key.exclusive;
    }
    return add * exclusive;
}

// The key of a component and of the axes that a noise of fewer than three dimensions lacks.
static inline bl_lattice_key bl_lattice_rest(const bl_lattice *lattice, unsigned dimensions,
                                             unsigned component) {
    bl_lattice_key rest = {lattice->add[component], lattice->exclusive[component]};
    for (unsigned axis = dimensions; axis < 3; axis++) {
        bl_lattice_key key = bl_lattice_wrapped_key(lattice, axis, 0);
        rest.add += key.add;
        rest.exclusive ^= key.exclusive;
    }
    return rest;
}

// --- gradients ----------------------------------------------------------------------------------

typedef struct bl_direction {
    float x, y, z, w;
} bl_direction;

// A place on the circle, divided by BL_SPHERE_SCALE, from the bits 31 to 12 of a word: two signs
// and the middle of one of 2^18 steps.
BL_INLINE bl_direction bl_circle(uint32_t word) {
    float t = bl_float_of_bits((word >> 7 & 0x007fffe0u) | 0x3e800010u) - 0.375f;
    float s = t * t;
    float even = (s + BL_SPHERE_E1) * s + BL_SPHERE_E0;
    float odd = t * ((s * BL_SPHERE_O2 + BL_SPHERE_O1) * s + BL_SPHERE_O0);
    float x = bl_float_of_bits(bl_bits_of_float(even - odd) ^ (word & 0x80000000u));
    float y = bl_float_of_bits(bl_bits_of_float(even + odd) ^ (word << 1 & 0x80000000u));
    return (bl_direction){x, y, 0, 0};
}

BL_INLINE bl_direction bl_sphere_in(unsigned dimensions, uint32_t word, uint32_t second) {
    const float scale = (float)BL_SPHERE_SCALE;
    float height = bl_lattice_value(word) * (float)BL_LATTICE_UNIT;
    if (dimensions == 1)
        return (bl_direction){height, 0, 0, 0};
    if (dimensions == 2) {
        bl_direction g = bl_circle(word);
        return (bl_direction){g.x * scale, g.y * scale, 0, 0};
    }
    float inner = sqrtf(0.5f - 0.5f * height) * scale, outer = sqrtf(0.5f + 0.5f * height) * scale;
    // The signs and the 13 bits of the mixed word that lattice.h takes, as bits 31, 30 and 29 to 17
    // of a word; bit 16 is the middle of a step.
    uint32_t mixed = bl_lattice_mixed(word);
    bl_direction a = bl_circle((mixed & 0xc0000000u) | (mixed & 0x007ffc00u) << 7 | 0x00010000u);
    bl_direction b = bl_circle(second);
    return (bl_direction){inner * a.x, inner * a.y, outer * b.x, outer * b.y};
}

static inline bl_direction bl_rejection_in(unsigned dimensions, uint32_t word) {
    const int bits_an_axis = dimensions == 4 ? 16 : 21;
    const uint64_t mask = (UINT64_C(1) << bits_an_axis) - 1;
    const float unit = 2 / (float)(1 << bits_an_axis);
    for (uint64_t attempt = 0; attempt < 64; attempt++) {
        uint64_t bits = bl_mix(word + (attempt << 32));
        float c[BL_AXES] = {0}, square = 0;
        for (unsigned axis = 0; axis < dimensions; axis++) {
            // Odd multiples of unit / 2 in (-1, 1).
            float middle = (float)(int32_t)(bits & mask) + 0.5f;
            c[axis] = middle * unit - 1;
            square += c[axis] * c[axis];
            bits >>= bits_an_axis;
        }
        if (square > 1) // above 0: no component is
            continue;
        float length = sqrtf(square);
        return (bl_direction){c[0] / length, c[1] / length, c[2] / length, c[3] / length};
    }
    return (bl_direction){1, 0, 0, 0};
}

static inline bl_direction bl_edge_in(unsigned dimensions, uint32_t word) {
    uint32_t mixed = bl_lattice_mixed(word);
    float c[BL_AXES] = {0};
    // The signs from the bits 31, 30, 29, and in four dimensions the axis without one from 28, 27.
    const unsigned none = dimensions == 4 ? mixed >> 27 & 3 : BL_AXES;
    unsigned bit = 31;
    for (unsigned axis = 0; axis < dimensions; axis++)
        if (axis != none)
            c[axis] = mixed >> bit-- & 1 ? -1.0f : 1.0f;
    return (bl_direction){c[0], c[1], c[2], c[3]};
}

// The gradient of a cell whose words of components 0 and 1 these are.
BL_INLINE bl_direction bl_direction_of(bl_gradients gradients, unsigned dimensions, uint32_t word,
                                       uint32_t second) {
    if (gradients == BL_GRADIENTS_SPHERE)
        return bl_sphere_in(dimensions, word, second);
    if (gradients == BL_GRADIENTS_EDGES)
        return bl_edge_in(dimensions, word);
    return bl_rejection_in(dimensions, word);
}

// Whether the gradients need component 1.
static inline int bl_directions_need_two(bl_gradients gradients, unsigned dimensions) {
    return gradients == BL_GRADIENTS_SPHERE && dimensions == 4;
}

#endif
