// SPDX-License-Identifier: MIT
//
// The keys that several noises share, for the parameter lists of their files. `block` is the file's
// parameter struct, which has the fields that a macro names.
#ifndef BL_NOISES_COMMON_PARAMETERS_H
#define BL_NOISES_COMMON_PARAMETERS_H

#include <stddef.h>

#include "core/grammar.h"

static const char *const bl_lattice_choices[] = {"hash", "perm256", NULL};
// Not 1 or 2, where symmetry makes some kernels smoother than their class (t-period has these).
static const char *const bl_period_examples[] = {"4,8,16", "3", "5,0,300,7", NULL};

// clang-format off
// uint64_t `field`; `what` it chooses, in words.
#define BL_SEED_PARAMETER(block, field, what)                                                      \
    {"seed", BL_SEED, offsetof(block, field), "0", "", .help = "chooses " what}

// uint32_t dimensions, `least` to `most`; `usual` is the default, as text.
#define BL_DIMENSIONS_PARAMETER(block, least, most, usual)                                         \
    {"dims", BL_INTEGER, offsetof(block, dimensions), usual, "", .minimum = least,                 \
     .maximum = most, .help = "dimensions; coordinates beyond them are ignored"}

// uint32_t `field`.
#define BL_COMPONENT_PARAMETER(block, field)                                                       \
    {"component", BL_INTEGER, offsetof(block, field), "0", "", .maximum = 3,                       \
     .help = "of a vector-valued noise: independent noises of one seed"}
// clang-format on

// bl_lattice_settings lattice: seed, lattice, component and period, four entries of a list.
#define BL_LATTICE_PARAMETERS(block, what) BL_LATTICE_PARAMETERS_WITH(block, what, "hash")

// The same with another default lattice.
#define BL_LATTICE_PARAMETERS_WITH(block, what, usual)                                             \
    BL_LATTICE_PARAMETERS_OF(block, what, usual, bl_period_examples)

// clang-format off
// The same with periods of its own for the tests.
#define BL_LATTICE_PARAMETERS_OF(block, what, usual, periods)                                      \
    BL_SEED_PARAMETER(block, lattice.seed, what),                                                  \
    {"lattice", BL_CHOICE, offsetof(block, lattice.kind), usual, "",                               \
     .choices = bl_lattice_choices,                                                                \
     .help = "hash of the 64-bit cell, or the text's permutation of 256"},                         \
    BL_COMPONENT_PARAMETER(block, lattice.component),                                              \
    {"period", BL_LIST, offsetof(block, lattice.period), "0", "cells", .maximum = 4294967295.0,    \
     .examples = periods,                                                                          \
     .help = "after which the noise repeats, one number or one an axis; 0: never"}
// clang-format on

#endif
