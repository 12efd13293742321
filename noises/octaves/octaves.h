// SPDX-License-Identifier: MIT
//
// Sums of octaves: one basis noise at rising frequencies and falling amplitudes. What fractalsum,
// turbulence, fbm and ridged share; the loops over samples are in noises/octaves/octaves_loops.h.
//
//   out(p) = sum over octaves i of  a_i F(n_i(R_i p f_i + o_i))
//
// with F the identity, the size |n|, or the ridge (offset - |n|)^2 weighted by the octave before.
//
// Clamping (filters/octave_fade.h). An octave's energy ends about at t = f_i * band_to, the
// frequency of the octave times the band that its basis states (1 where it states none). An octave
// of weight 0 is not evaluated. What an octave loses goes to its mean: F becomes k F + (1 - k)
// E[F]. Width 0 keeps all octaves, and so does any width so small that all of them lie below half
// the limit; a huge or infinite width keeps none and leaves the constant mean.
//
// E[F] is the basis's stated mean where F is the identity and the mean is stated; else it is
// measured when the sum is opened, from 32 fresh seeds, 4096 random places each, the same for every
// seed of the sum; its standard error is about 0.3 % of the standard deviation of F, and more
// where the seeds of a basis differ. clamp=none measures nothing.
//
// A nested text must not set the seed of the basis, which is the sum's. A basis may itself be a
// sum, down to a key basis.basis.basis.basis.
//
// Statistics. With seeds=fresh octaves are independent. With one seed for all of them, two octaves
// draw different lattice numbers wherever the cells of p f_i and p f_j differ, which they do but
// for a few cells around the origin: at a random place octaves are uncorrelated, and the
// variances, the covariances and the densities of octaves add up. This needs frequencies that
// are well apart (a ratio of 3/2 at least), a basis that does not repeat, and one that is not
// itself a sum, whose octaves could meet those of this one.
#ifndef BL_NOISES_OCTAVES_OCTAVES_H
#define BL_NOISES_OCTAVES_OCTAVES_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "core/signal.h"
#include "filters/octave_fade.h"
#include "noises/noise.h"

enum { BL_OCTAVES_MOST = 32 };

typedef enum bl_octave_fold { BL_FOLD_NONE, BL_FOLD_SIZE, BL_FOLD_RIDGE } bl_octave_fold;

// --- the plan -----------------------------------------------------------------------------------

// Which octaves there are, and what of them is kept. Frequencies never fall, so the octaves that
// are evaluated are the first ones.
typedef struct bl_octaves_plan {
    unsigned count, evaluated;
    double ratio; // of neighbouring frequencies
    double frequency[BL_OCTAVES_MOST], amplitude[BL_OCTAVES_MOST], kept[BL_OCTAVES_MOST];
} bl_octaves_plan;

// Frequencies least, 2 least, 4 least, ... below most, of amplitude 1/f; none if least >= most.
bl_octaves_plan bl_octaves_plan_between(double least, double most);
// `count` frequencies ratio^i of amplitude gain^i; those of amplitude 0 are left out.
bl_octaves_plan bl_octaves_plan_count(unsigned count, double ratio, double gain);
// Fills `kept` and `evaluated`; `top` is the highest frequency of the basis.
void bl_octaves_plan_clamp(bl_octaves_plan *plan, double top, bl_octave_clamp clamp, double width);

// --- the sum ------------------------------------------------------------------------------------

// What a noise file says of its sum beside the plan.
typedef struct bl_octaves_rules {
    bl_octave_fold fold;
    double ridge_offset, ridge_gain;
    int fresh;        // a seed of its own for each octave
    int shift;        // a random offset for each octave but the first
    int rotate;       // a random rotation for each octave but the first
    int lost_to_zero; // removed octaves leave nothing, as in the text
} bl_octaves_rules;

typedef struct bl_octave {
    const bl_signal *basis;
    double frequency;
    double offset[BL_AXES], rotation[BL_AXES][BL_AXES];
    int shifted, rotated;
    int exact; // the frequency is a power of two: scaling rounds nothing
} bl_octave;

typedef struct bl_octaves {
    bl_octaves_plan plan;
    bl_octaves_rules rules;
    double top;      // the highest frequency of the basis
    double lost;     // E[F], a float
    double constant; // what the removed parts add up to, a float; of a ridge only if all are
    unsigned dimensions;
    unsigned seeds; // how many signals are owned
    bl_signal *seeded[BL_OCTAVES_MOST];
    bl_octave octave[BL_OCTAVES_MOST];
} bl_octaves;

// The first member of the parameter block of every sum.
typedef struct bl_octaves_settings {
    uint64_t seed;
    char basis[BL_TEXT_SIZE];
    double width;
    uint32_t clamp; // a bl_octave_clamp
    int lost_known; // a copy of the block need not measure again
    double lost;
    bl_octaves *octaves; // made by build
} bl_octaves_settings;

// Opens the basis and makes the sum. Errors: BL_USAGE for a bad basis (the message names it),
// BL_DEVICE out of memory.
bl_status bl_octaves_build(bl_octaves_settings *settings, const bl_octaves_plan *plan,
                           const bl_octaves_rules *rules, bl_opener *open, bl_message *message);

// F of a value of the basis, without the weight of a ridge; its slope in *slope.
double bl_octaves_fold(const bl_octaves_rules *rules, double noise, double *slope);
// What removed parts add to each value, a float. A ridge's parts depend on the octave before,
// unless all are removed.
double bl_octaves_constant(const bl_octaves *octaves, const bl_octaves_plan *plan);

// The abilities that all sums share, for their descriptors; `parameters` is the block.
void bl_octaves_release(void *parameters);
double bl_octaves_value(const void *parameters, const double at[BL_AXES]);
void bl_octaves_values(const void *parameters, const double *const at[BL_AXES], size_t count,
                       double *out);
// The value for samples as far apart as the largest width of its axes says, or as the key width, if
// that is larger.
void bl_octaves_filtered(const void *parameters, const bl_samples *samples, double *out);
// NaN where the basis has no gradient.
void bl_octaves_gradient(const void *parameters, const double at[BL_AXES], double out[BL_AXES]);
double bl_octaves_covariance(const void *parameters, const double lag[BL_AXES]);
double bl_octaves_density(const void *parameters, const double frequency[BL_AXES]);
int bl_octaves_has_closed_form(const void *parameters);
unsigned bl_octaves_dimensions(const void *parameters);
void bl_octaves_describe(const void *parameters, bl_facts *facts);

// Whether a signal is one of these sums.
int bl_octaves_is_sum(const bl_signal *signal);

// The value of a sum for a sample width of its own, in units, clamped as the sum says: an
// approximation of the mean over a box of that width, not that mean. NaN for a width that is
// negative or NaN, and for a signal that is not a sum of octaves. Thread-safe.
double bl_octaves_value_for_width(const bl_signal *sum, const double at[BL_AXES], double width);
// The same at many places, each for its own width: fills out[i].
void bl_octaves_values_for_widths(const bl_signal *sum, const double *const at[BL_AXES],
                                  const double *width, size_t count, double *out);

// The place of octave's basis for a place of the sum; only the first `dimensions` are filled.
static inline void bl_octave_place(const bl_octave *octave, unsigned dimensions,
                                   const double at[BL_AXES], double out[BL_AXES]) {
    for (unsigned a = 0; a < dimensions; a++) {
        double x = at[a];
        if (octave->rotated) {
            x = octave->rotation[a][0] * at[0];
            for (unsigned b = 1; b < dimensions; b++)
                x += octave->rotation[a][b] * at[b];
        }
        x *= octave->frequency;
        out[a] = octave->shifted ? x + octave->offset[a] : x;
    }
}

// --- parameters ---------------------------------------------------------------------------------

extern const char *const bl_octave_basis_examples[];
extern const char *const bl_octave_seedings[]; // "fresh", "same", ended by NULL

// clang-format off
// bl_octaves_settings `field`, the first member of the block: seed, basis, width and clamp.
#define BL_OCTAVES_PARAMETERS(block, field)                                                        \
    {"seed", BL_SEED, offsetof(block, field.seed), "0", "", .help = "the seed of the basis"},      \
    {"basis", BL_NESTED, offsetof(block, field.basis), "gnoise", "",                               \
     .examples = bl_octave_basis_examples,                                                         \
     .help = "the noise of each octave, of the registry; its settings are basis.KEY=VALUE"},       \
    {"width", BL_REAL, offsetof(block, field.width), "0", "units", .maximum = INFINITY,            \
     .help = "between samples: octaves beyond 1/(2 width) are removed; 0 keeps all"},              \
    {"clamp", BL_CHOICE, offsetof(block, field.clamp), "fade", "", .choices = bl_octave_clamps,    \
     .help = "how octaves beyond the Nyquist limit of the width are removed"}

// uint32_t seeds, 0 for fresh: `default` is one of the words of bl_octave_seedings.
#define BL_OCTAVES_SEEDS_PARAMETER(block, default)                                                 \
    {"seeds", BL_CHOICE, offsetof(block, seeds), default, "", .choices = bl_octave_seedings,       \
     .help = "a seed of its own for each octave, or the same for all, whose octaves meet at the "  \
             "origin: the sum there is the basis times the sum of the amplitudes"}

// double least, most: the octaves f = min, 2 min, ... below max; two entries of a list.
#define BL_OCTAVES_SPAN_PARAMETERS(block)                                                          \
    {"min", BL_REAL, offsetof(block, least), "1", "cells a unit", .minimum = 1.0 / 256,            \
     .maximum = 4096, .help = "the frequency of the first octave"},                                \
    {"max", BL_REAL, offsetof(block, most), "16", "cells a unit", .minimum = 1.0 / 256,            \
     .maximum = 4096, .help = "octaves have frequencies below it"}

// uint32_t octaves, double lacunarity; `more` are further values of it to try.
#define BL_OCTAVES_COUNT_PARAMETERS(block, more)                                                   \
    {"octaves", BL_INTEGER, offsetof(block, octaves), "4", "", .minimum = 1, .maximum = 12,        \
     .help = "how many"},                                                                          \
    {"lacunarity", BL_REAL, offsetof(block, lacunarity), "2", "", .minimum = 1, .maximum = 8,      \
     .examples = more, .help = "the ratio of the frequencies of neighbouring octaves"}
// clang-format on

// The functions of a sum that adds its octaves up unchanged, except those that it has itself.
#define BL_OCTAVES_FUNCTIONS                                                                       \
    .row = bl_octaves_row, .points = bl_octaves_points, .value = bl_octaves_value,                 \
    .values = bl_octaves_values, .gradient = bl_octaves_gradient, .filtered = bl_octaves_filtered, \
    .release = bl_octaves_release

#endif
