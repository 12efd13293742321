// SPDX-License-Identifier: MIT
//
// The random numbers of the integer lattice: words, values and gradients of a cell and a seed.
//
// lattice=hash. An axis b and a 64-bit cell number c give a key of two 32-bit halves. With
// C = c + 2^31 (mod 2^64), low and high its halves, and o_b, h_b drawn from the seed,
//
//     p = (low + o_b) * M1                          the additive half
//     q = (p ^ p >> 15 ^ mix(high ^ h_b)) * M2      the exclusive half
//
// with bijections at each step: no two cells have one key, so no plane of cells ever repeats. For
// |c| < 2^31, high is 0, and the mix is one number for the whole axis. The keys of the three
// axes meet in one product, the word of the cell:
//
//     word = (p_x + p_y + p_z) * (q_x ^ q_y ^ q_z)      mod 2^32
//
// Only a sum, an exclusive or and one product belong to a corner; everything else is shared by the
// corners with the same coordinate. That is what makes the noises fast, and these are the quality
// requirements that the choice passes (t-lattice): every used bit is balanced and flips with
// probability 1/2 when any bit of cell or seed flips (bits 15 to 12 stay when only bits 28 to 30 of
// a cell number flip, that is between cells 2^28 apart); neighbouring cells and seeds are
// uncorrelated; and so are the products over parallelograms (i,j) (i',j) (i,j') (i',j'), the place
// where keys that are merely added or xored fail: with a linear last step the fourth corner
// follows from the other three. Bits 31 to 12 of a word pass all this in 10^7 words; the bits
// below do not (bit 0 of a product is a product of bits 0), so they are never used bare: a value
// takes bits 31 to 12, and a gradient takes the word's size for its height and the bits 31, 30
// and 22 to 10 of a multiple of it, which fills the plane together with the word, for its
// longitude.
//
// A component index (0 for the noises with one number a cell) adds to the sum and to the exclusive
// or as a fourth axis would: it gives one cell several independent words.
//
// lattice=perm256. The text's own: an 8-bit index, permuted and added axis by axis, so that the
// noise has the period 256 on each axis, and only 256 different words, those of the cells
// (index, 0, 0) of lattice=hash. Its rows are shifts of one another: a known defect of the text.
//
// A value is an odd multiple of 2^-20 in (-1, 1), uniform: mean 0, variance (1 - 2^-40)/3.
//
// A gradient is a float triple by definition; the reference in double takes the same triple.
//   sphere     uniform on the unit sphere: height z = word * 2^-31 as a signed number, radius
//              sqrt(1 - z^2), longitude from 13 bits within a quadrant and two signs. Sine and
//              cosine of pi/4 + a are E -+ O of an even and an odd polynomial, fitted so that
//              E^2 + O^2 is constant to 7e-7: of unit length to 5e-7. The density of the
//              longitude is uniform to 9e-4, with the symmetry of the square, so that the mean is
//              0 (z: -2^-32) and the second moments are I/3.
//   rejection  Perlin's scheme: uniform in the cube, discarded outside of the unit sphere,
//              normalised. 21 bits an axis; at most 64 tries (the chance of more is 2e-18).
//   edges      the 12 midpoints of the edges of the cube [-1,1]^3, of length sqrt 2 (Perlin 2002);
//              second moments 2/3 I.
//   edges16    the same from four bits, the top ones, as Perlin picks them: four of the 12 stand
//              twice; second moments 5/8, 3/4, 5/8.
//
// Every function is pure; all arithmetic on cells, seeds and words is unsigned.
#ifndef BL_NOISES_LATTICE_LATTICE_H
#define BL_NOISES_LATTICE_LATTICE_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "core/hash.h"
#include "core/signal.h"
#include "noises/lattice/permutation.h"

#define BL_INLINE static inline __attribute__((always_inline))

// Odd multipliers: 2^32 times the golden ratio's fraction, and the first one of MurmurHash3's
// finaliser (Appleby 2011), found there by search for avalanche.
#define BL_LATTICE_M1 0x9E3779B1u
#define BL_LATTICE_M2 0x85EBCA6Bu

enum { BL_COMPONENTS = 4 };

typedef enum bl_lattice_kind { BL_LATTICE_HASH, BL_LATTICE_PERM256 } bl_lattice_kind;
typedef enum bl_gradients {
    BL_GRADIENTS_SPHERE,
    BL_GRADIENTS_REJECTION,
    BL_GRADIENTS_EDGES,
    BL_GRADIENTS_EDGES16
} bl_gradients;

// The settings that all lattice noises share (noises/common_parameters.h has their keys).
typedef struct bl_lattice_settings {
    uint64_t seed;
    uint32_t kind;            // a bl_lattice_kind
    uint32_t component;       // of a vector-valued noise
    uint32_t period[BL_AXES]; // in cells along each axis; 0: none
} bl_lattice_settings;

// What a seed makes of the hash: drawn once for a call, constant from then on.
typedef struct bl_lattice {
    uint32_t offset[BL_AXES], high[BL_AXES];
    uint32_t period[BL_AXES]; // cell numbers are taken modulo it; 0: as they are
    uint32_t add[BL_COMPONENTS], exclusive[BL_COMPONENTS]; // component 0 has zeros
    bl_lattice_kind kind;
} bl_lattice;

// The two halves of the key of a cell along one axis.
typedef struct bl_lattice_key {
    uint32_t add, exclusive;
} bl_lattice_key;

static inline bl_lattice bl_lattice_of(uint64_t seed, bl_lattice_kind kind) {
    bl_lattice lattice = {.kind = kind};
    for (unsigned axis = 0; axis < BL_AXES; axis++) {
        // Streams 3 to 5 are those of the components.
        uint64_t bits = bl_stream(seed, axis < 3 ? axis : 6);
        lattice.offset[axis] = (uint32_t)bits;
        lattice.high[axis] = (uint32_t)(bits >> 32);
    }
    for (unsigned component = 1; component < BL_COMPONENTS; component++) {
        uint64_t bits = bl_stream(seed, 2 + component);
        lattice.add[component] = (uint32_t)bits;
        lattice.exclusive[component] = (uint32_t)(bits >> 32);
    }
    return lattice;
}

static inline bl_lattice bl_lattice_open(const bl_lattice_settings *settings) {
    bl_lattice lattice = bl_lattice_of(bl_component_seed(settings->seed, settings->component),
                                       (bl_lattice_kind)settings->kind);
    memcpy(lattice.period, settings->period, sizeof lattice.period);
    return lattice;
}

// Whether no two cells share a number.
static inline int bl_lattice_is_hash(const bl_lattice_settings *settings) {
    return settings->kind == BL_LATTICE_HASH && settings->period[0] == 0 &&
           settings->period[1] == 0 && settings->period[2] == 0 && settings->period[3] == 0;
}

// Whether all the numbers within any `footprint` cells along each axis differ, and are independent:
// a kernel that is not wider then sees what it would see without periods, at one place.
static inline int bl_lattice_differs_within(const bl_lattice_settings *settings,
                                            unsigned dimensions, double footprint) {
    for (unsigned a = 0; a < dimensions; a++)
        if (settings->period[a] != 0 && settings->period[a] < footprint)
            return 0;
    return settings->kind == BL_LATTICE_HASH;
}

// The cell that stands for `cell` (a signed number in two's complement) in a periodic lattice, from
// 0 to the period - 1.
static inline uint64_t bl_lattice_wrap(const bl_lattice *lattice, unsigned axis, uint64_t cell) {
    uint32_t period = lattice->period[axis];
    if (!period)
        return cell;
    if (cell >> 63) // negative: -1 - ~cell, where ~cell is from 0 to 2^63 - 1
        return period - 1 - ~cell % period;
    return cell % period;
}

// The mixed high half of a biased cell number: lowbias32 (Wellons 2018), a bijection.
static inline uint32_t bl_lattice_high(const bl_lattice *lattice, unsigned axis, uint32_t high) {
    uint32_t x = high ^ lattice->high[axis];
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

// The exclusive half, from the additive half and the mixed high half.
static inline uint32_t bl_lattice_exclusive(uint32_t add, uint32_t high) {
    return (add ^ add >> 15 ^ high) * BL_LATTICE_M2;
}

// The key of a cell number that bl_lattice_wrap gave.
static inline bl_lattice_key bl_lattice_wrapped_key(const bl_lattice *lattice, unsigned axis,
                                                    uint64_t wrapped) {
    uint64_t biased = wrapped + UINT64_C(0x80000000);
    uint32_t add = ((uint32_t)biased + lattice->offset[axis]) * BL_LATTICE_M1;
    uint32_t high = bl_lattice_high(lattice, axis, (uint32_t)(biased >> 32));
    return (bl_lattice_key){add, bl_lattice_exclusive(add, high)};
}

static inline bl_lattice_key bl_lattice_key_of(const bl_lattice *lattice, unsigned axis,
                                               uint64_t cell) {
    return bl_lattice_wrapped_key(lattice, axis, bl_lattice_wrap(lattice, axis, cell));
}

static inline uint32_t bl_perm256_index(uint64_t x, uint64_t y, uint64_t z) {
    uint32_t index = bl_permutation[z & 255];
    index = bl_permutation[(y + index) & 255];
    return bl_permutation[(x + index) & 255];
}

static inline uint32_t bl_lattice_hash_word(const bl_lattice *lattice, const uint64_t cell[3],
                                            unsigned component) {
    uint32_t add = lattice->add[component], exclusive = lattice->exclusive[component];
    for (unsigned axis = 0; axis < 3; axis++) {
        bl_lattice_key key = bl_lattice_key_of(lattice, axis, cell[axis]);
        add += key.add;
        exclusive ^= key.exclusive;
    }
    return add * exclusive;
}

// The word of an index of lattice=perm256: that of the cell (index, 0, 0), for every period.
static inline uint32_t bl_perm256_word(const bl_lattice *lattice, uint32_t index,
                                       unsigned component) {
    bl_lattice plain = *lattice;
    memset(plain.period, 0, sizeof plain.period);
    return bl_lattice_hash_word(&plain, (const uint64_t[3]){index, 0, 0}, component);
}

// The word of a cell, straightforwardly: the reference for the loops that share the keys.
static inline uint32_t bl_lattice_word(const bl_lattice *lattice, const uint64_t cell[3],
                                       unsigned component) {
    if (lattice->kind == BL_LATTICE_HASH)
        return bl_lattice_hash_word(lattice, cell, component);
    uint64_t wrapped[3];
    for (unsigned axis = 0; axis < 3; axis++)
        wrapped[axis] = bl_lattice_wrap(lattice, axis, cell[axis]);
    return bl_perm256_word(lattice, bl_perm256_index(wrapped[0], wrapped[1], wrapped[2]),
                           component);
}

// The 256 words that lattice=perm256 draws from.
static inline void bl_perm256_words(const bl_lattice *lattice, unsigned component,
                                    uint32_t words[256]) {
    for (uint32_t index = 0; index < 256; index++)
        words[index] = bl_perm256_word(lattice, index, component);
}

// Numbers are made in units of 2^-31, so that a loop scales once a sample and not once a corner.
#define BL_LATTICE_UNIT 0x1p-31

enum { BL_LATTICE_VALUES = 1 << 20 }; // how many values there are

// The value of a word in units of 2^-31: exact, because its low 11 bits are 0.
static inline float bl_lattice_value(uint32_t word) {
    return (float)(int32_t)((word & 0xfffff000u) | 0x800u);
}

static inline float bl_float_of_bits(uint32_t bits) {
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline uint32_t bl_bits_of_float(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

// x and y are the equator's part, to be multiplied by `radius` and by BL_SPHERE_SCALE; z stands for
// itself. All are in units of 2^-31.
typedef struct bl_sphere {
    float radius, x, y, z;
} bl_sphere;

// cos(pi/4 + a) and sin(pi/4 + a) times sqrt 2 / BL_SPHERE_SCALE are E - O and E + O of
// t = a / 2 pi in (-1/8, 1/8), s = t^2:  E = (s + E1) s + E0,  O = t ((O2 s + O1) s + O0).
// Levenberg-Marquardt fit to unit length (weight 100) and to equal steps of the longitude (weight
// 1) on 60 Chebyshev nodes; residuals: length 3.3e-7, longitude 2.6e-5.
#define BL_SPHERE_SCALE (63.254425948940046 * 0.70710678118654752)
#define BL_SPHERE_E1 -0.31195181565357155f
#define BL_SPHERE_E0 0.015809165205292755f
#define BL_SPHERE_O2 1.074496912532877f
#define BL_SPHERE_O1 -0.6496546932968489f
#define BL_SPHERE_O0 0.09931634408635416f

// A second number that fills the plane with the first: the pairs (word, mixed) are the lattice of a
// linear congruential generator, here the multiplier with the best spectral test for 2^32
// (L'Ecuyer 1999, table 4).
static inline uint32_t bl_lattice_mixed(uint32_t word) {
    return word * 0xac564b05u;
}

static inline bl_sphere bl_sphere_gradient(uint32_t word) {
    uint32_t mixed = bl_lattice_mixed(word);
    float z = (float)(int32_t)word;
    // |z| <= 2^31, so the root is of no negative number. Bit 31 turns by half a circle.
    float radius = sqrtf(0x1p62f - z * z);
    radius = bl_float_of_bits(bl_bits_of_float(radius) ^ (mixed & 0x80000000u));
    // Bits 22 to 10 become the mantissa of a number in [1/4, 1/2), at the middles of 2^13 steps.
    float t = bl_float_of_bits((mixed & 0x007ffc00u) | 0x3e800200u) - 0.375f;
    float s = t * t;
    float even = (s + BL_SPHERE_E1) * s + BL_SPHERE_E0;
    float odd = t * ((s * BL_SPHERE_O2 + BL_SPHERE_O1) * s + BL_SPHERE_O0);
    float x = bl_float_of_bits(bl_bits_of_float(even - odd) ^ (mixed << 1 & 0x80000000u));
    return (bl_sphere){radius, x, even + odd, z};
}

typedef struct bl_vector {
    float x, y, z;
} bl_vector;

static inline bl_vector bl_rejection_gradient(uint32_t word) {
    for (uint64_t attempt = 0; attempt < 64; attempt++) {
        uint64_t bits = bl_mix(word + (attempt << 32));
        float c[3], square = 0;
        for (int axis = 0; axis < 3; axis++) {
            // Odd multiples of 2^-21 in (-1, 1).
            int32_t odd = (int32_t)(bits >> 21 * axis & 0x1fffff) * 2 + 1 - 0x200000;
            c[axis] = (float)odd * 0x1p-21f;
            square += c[axis] * c[axis];
        }
        // Above 0: no component is 0.
        if (square > 1)
            continue;
        float length = sqrtf(square);
        return (bl_vector){c[0] / length, c[1] / length, c[2] / length};
    }
    return (bl_vector){1, 0, 0};
}

// The edge of a word: floor(12 m / 2^32) of the mixed word m, from 0 to 11. With m = 2^30 t + f it
// is 3 t + floor(3 f / 2^30), and 3 f fits in 32 bits.
static inline uint32_t bl_lattice_edge(uint32_t word) {
    uint32_t mixed = bl_lattice_mixed(word);
    return 3 * (mixed >> 30) + (3 * (mixed & 0x3fffffffu) >> 30);
}

// Bit 0 of the edge is the sign of its first component that is not 0, bit 1 that of the second.
static inline bl_vector bl_edge_gradient(uint32_t word) {
    uint32_t edge = bl_lattice_edge(word);
    float first = edge & 1 ? -1.0f : 1.0f, second = edge & 2 ? -1.0f : 1.0f;
    return (bl_vector){edge < 4 ? 0.0f : first,
                       edge < 4   ? first
                       : edge < 8 ? 0.0f
                                  : second,
                       edge < 8 ? second : 0.0f};
}

// Bits 31 to 28: the first eight are the edges of u = x and v = y or z, the next four those of u =
// y and v = z; of the last four, two are edges of x and y and two of y and z again. The lowest bit
// is the sign of u, the next that of v.
static inline bl_vector bl_edge16_gradient(uint32_t word) {
    uint32_t entry = word >> 28;
    float u = bl_float_of_bits(0x3f800000u | entry << 31);
    float v = bl_float_of_bits(0x3f800000u | (entry >> 1) << 31);
    int u_is_x = entry < 8, v_is_y = entry < 4, v_is_x = (entry & 13) == 12;
    float x = u_is_x ? u : 0, y = u_is_x ? 0 : u, z = v_is_y ? 0 : v;
    return (bl_vector){v_is_x ? v : x, v_is_y ? v : y, v_is_x ? 0 : z};
}

// The gradient of a word in double: the same numbers as the loops in float, whatever the mode.
static inline void bl_lattice_gradient(bl_gradients gradients, uint32_t word, double out[3]) {
    if (gradients == BL_GRADIENTS_SPHERE) {
        bl_sphere g = bl_sphere_gradient(word);
        out[0] = (double)g.radius * g.x * (BL_SPHERE_SCALE * BL_LATTICE_UNIT);
        out[1] = (double)g.radius * g.y * (BL_SPHERE_SCALE * BL_LATTICE_UNIT);
        out[2] = g.z * BL_LATTICE_UNIT;
        return;
    }
    bl_vector g = gradients == BL_GRADIENTS_EDGES     ? bl_edge_gradient(word)
                  : gradients == BL_GRADIENTS_EDGES16 ? bl_edge16_gradient(word)
                                                      : bl_rejection_gradient(word);
    out[0] = g.x;
    out[1] = g.y;
    out[2] = g.z;
}

// Splits a coordinate into its cell and the fraction within it, in [0, 1). Returns 0 outside of
// |x| < 2^62 and for NaN: there the cell would not be an integer of 64 bits.
static inline int bl_lattice_split(double x, uint64_t *cell, double *fraction) {
    if (!(fabs(x) < 0x1p62))
        return 0;
    double down = floor(x);
    *cell = (uint64_t)(int64_t)down;
    *fraction = x - down;
    return 1;
}

#endif
