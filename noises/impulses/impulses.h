// SPDX-License-Identifier: MIT
//
// Sparse impulses: how many a cell has, where they are, how strong, and the walk over all of them
// in reach of a point. spot, gabor and scnoise share it.
//
// A cell has three words, the components 0 to 2 of lattice.h, each folded as in
// convolution_cells.h. The first two are multiplied by odd constants for each impulse, exactly as
// in sparse_impulses.h: x and y from the first word, z and the amplitude from the second. The
// third word alone decides the count.
//
//   fixed    every cell has N impulses. Their places are uniform in the cell, so uniform in space,
//            and amplitudes are independent with mean 0: the covariance is that of a Poisson
//            process of N a cell. It is no Poisson process all the same; the fourth cumulant is
//            smaller by 3 N E[a^2]^2 times the sum over the cells of (int over the cell of K^2)^2
//            and depends on the place in the cell (t-impulses).
//   poisson  the count is Poisson with mean N, by inversion of the 32-bit word: the smallest n with
//            word < 2^32 F(n), F the distribution function, whose products are rounded to whole
//            numbers. F ends where less than 2^-33 is left: at 12 for N = 1, 19 for N = 3, 121 for
//            N = 64; no cell ever has more, which is what bounds the noise. Probabilities are
//            exact to 2^-32, the mean to 1e-8. Counts of cells, places and amplitudes are
//            independent, so that the impulses are a Poisson process.
#ifndef BL_NOISES_IMPULSES_IMPULSES_H
#define BL_NOISES_IMPULSES_IMPULSES_H

#include <math.h>
#include <stdint.h>

#include "core/hash.h"
#include "noises/impulses/convolution_cells.h"

enum { IMPULSE_MOST_MEAN = 64, IMPULSE_MOST = 128, IMPULSE_AXES = 3 };

static const char *const impulse_counts[] = {"poisson", "fixed", NULL};
enum { IMPULSE_COUNT_POISSON, IMPULSE_COUNT_FIXED };

// clang-format off
// uint32_t impulses, the mean; uint32_t count, of impulse_counts.
#define IMPULSE_MEAN_PARAMETER(block, usual)                                                       \
    {"impulses", BL_INTEGER, offsetof(block, impulses), usual, "a cell", .minimum = 1,             \
     .maximum = IMPULSE_MOST_MEAN,                                                                 \
     .help = "impulses in a cell, on average; the sum is divided by the root of it"}
#define IMPULSE_COUNT_PARAMETER(block, usual)                                                      \
    {"count", BL_CHOICE, offsetof(block, count), usual, "", .choices = impulse_counts,             \
     .help = "of impulses in a cell: a true Poisson number, or always the same"}
// clang-format on

// The limits of the counts by the word: count = number of limits <= word. Returns how many there
// are, the largest count; IMPULSE_MOST is enough for a mean of 64.
static inline int impulse_limits(uint32_t mean, uint32_t limits[IMPULSE_MOST]) {
    double probability = 1, below = 0;
    for (uint32_t n = 0; n < mean; n++)
        probability *= 0.36787944117144232160; // 1/e, rounded
    for (int n = 0; n < IMPULSE_MOST; n++) {
        below += probability;
        double limit = floor(below * 0x1p32 + 0.5);
        if (limit >= 0x1p32)
            return n;
        limits[n] = (uint32_t)limit; // below 2^32
        probability *= (double)mean / (n + 1);
    }
    return IMPULSE_MOST;
}

typedef struct impulse_source {
    bl_lattice lattice;
    uint32_t table[3][256]; // lattice=perm256: the folded words of its entries
    uint32_t factor[IMPULSE_MOST][4];
    uint32_t limit[IMPULSE_MOST];
    int most; // impulses of a cell
    int poisson;
} impulse_source;

static inline int impulse_count_most(uint32_t mean, int poisson) {
    uint32_t limits[IMPULSE_MOST];
    return poisson ? impulse_limits(mean, limits) : (int)mean;
}

static inline void impulse_source_open(impulse_source *source, const bl_lattice_settings *settings,
                                       uint32_t mean, int poisson) {
    source->lattice = bl_lattice_open(settings);
    source->poisson = poisson;
    source->most = poisson ? impulse_limits(mean, source->limit) : (int)mean;
    for (uint32_t n = 0; n < (uint32_t)source->most; n++)
        for (uint32_t field = 0; field < 4; field++)
            source->factor[n][field] = (uint32_t)(bl_mix(4 * n + field + 1) >> 32) | 1;
    if (settings->kind == BL_LATTICE_PERM256)
        for (unsigned component = 0; component < 3; component++) {
            bl_perm256_words(&source->lattice, component, source->table[component]);
            for (int i = 0; i < 256; i++)
                source->table[component][i] = folded(source->table[component][i]);
        }
}

// The key of a cell along an axis; for perm256 `add` is the cell itself, modulo 2^32.
static inline bl_lattice_key impulse_key(const impulse_source *source, unsigned axis,
                                         uint64_t cell) {
    if (source->lattice.kind == BL_LATTICE_PERM256)
        return (bl_lattice_key){(uint32_t)bl_lattice_wrap(&source->lattice, axis, cell), 0};
    return bl_lattice_key_of(&source->lattice, axis, cell);
}

// The three words from the keys of the axes, summed and exclusive-ored; for perm256 from the cell.
static inline uint32_t impulse_word(const impulse_source *source, uint32_t add, uint32_t exclusive,
                                    unsigned component) {
    return folded((add + source->lattice.add[component]) *
                  (exclusive ^ source->lattice.exclusive[component]));
}

typedef struct impulse_words {
    uint32_t first, second, third;
} impulse_words;

static inline impulse_words impulse_words_of(const impulse_source *source, const bl_lattice_key *x,
                                             const bl_lattice_key *y, const bl_lattice_key *z) {
    if (source->lattice.kind == BL_LATTICE_PERM256) {
        uint32_t index = bl_perm256_index(x->add, y->add, z->add);
        return (impulse_words){source->table[0][index], source->table[1][index],
                               source->table[2][index]};
    }
    uint32_t add = x->add + y->add + z->add;
    uint32_t exclusive = x->exclusive ^ y->exclusive ^ z->exclusive;
    return (impulse_words){impulse_word(source, add, exclusive, 0),
                           impulse_word(source, add, exclusive, 1),
                           impulse_word(source, add, exclusive, 2)};
}

static inline int impulse_count(const impulse_source *source, uint32_t third) {
    int count = source->most;
    if (source->poisson)
        for (count = 0; count < source->most && source->limit[count] <= third; count++)
            ;
    return count;
}

// A coordinate within the cell from its word: in [0, 1], exact in double.
static inline double impulse_place(uint32_t word) {
    return (double)(float)(int32_t)word * 0x1p-32 + 0.5;
}

// --- the reference: all impulses in the cells within `reach` of a point's cell -------------------

// `d` leads from the impulse to the point; `third` and `fourth` are the impulse's last two words.
typedef void impulse_visitor(void *context, const double d[IMPULSE_AXES], uint32_t third,
                             uint32_t fourth);

// Returns 0 for a point outside of the domain. In two dimensions z is ignored, d[2] is 0.
static inline int impulse_visit(const impulse_source *source, unsigned dimensions, int reach,
                                const double at[BL_AXES], impulse_visitor *visitor, void *context) {
    uint64_t cell[IMPULSE_AXES] = {0};
    double fraction[IMPULSE_AXES] = {0};
    for (unsigned a = 0; a < dimensions; a++)
        if (!bl_lattice_split(at[a], &cell[a], &fraction[a]))
            return 0;
    int across = dimensions == 3 ? reach : 0;
    for (int i = -reach; i <= reach; i++)
        for (int j = -reach; j <= reach; j++)
            for (int k = -across; k <= across; k++) {
                const int offset[IMPULSE_AXES] = {i, j, k};
                bl_lattice_key key[IMPULSE_AXES];
                for (unsigned a = 0; a < IMPULSE_AXES; a++)
                    key[a] = impulse_key(source, a, cell[a] + (uint64_t)(int64_t)offset[a]);
                impulse_words words = impulse_words_of(source, &key[0], &key[1], &key[2]);
                int count = impulse_count(source, words.third);
                for (int n = 0; n < count; n++) {
                    const uint32_t *factor = source->factor[n];
                    const uint32_t word[IMPULSE_AXES] = {words.first, words.first, words.second};
                    double d[IMPULSE_AXES] = {0};
                    for (unsigned a = 0; a < dimensions; a++)
                        d[a] = fraction[a] - (offset[a] + impulse_place(word[a] * factor[a]));
                    visitor(context, d, words.second * factor[2], words.second * factor[3]);
                }
            }
    return 1;
}

#endif
