// SPDX-License-Identifier: MIT
//
// The keys that several noises share, for the parameter lists of their files. `block` is the file's
// parameter struct, which has the fields that a macro names.
#ifndef BL_NOISES_COMMON_PARAMETERS_H
#define BL_NOISES_COMMON_PARAMETERS_H

#include <stddef.h>

#include "core/grammar.h"

static const char *const bl_lattice_choices[] = {"hash", "perm256", NULL};

// uint64_t seed; `what` it chooses, in words.
#define BL_SEED_PARAMETER(block, what)                                                             \
    {                                                                                              \
        .key = "seed", .kind = BL_SEED, .offset = offsetof(block, seed), .fallback = "0",          \
        .unit = "", .help = "chooses " what                                                        \
    }

// uint32_t lattice, a bl_lattice_kind.
#define BL_LATTICE_PARAMETER(block)                                                                \
    {                                                                                              \
        .key = "lattice", .kind = BL_CHOICE, .offset = offsetof(block, lattice),                   \
        .choices = bl_lattice_choices, .fallback = "hash", .unit = "",                             \
        .help = "hash of the 64-bit cell, or the text's permutation of 256"                        \
    }

// uint32_t kernel, table_rate: of a radial convolution. `choices` are exact and table:N.
#define BL_KERNEL_PARAMETER(block, words)                                                          \
    {                                                                                              \
        .key = "kernel", .kind = BL_CHOICE, .offset = offsetof(block, kernel), .choices = words,   \
        .number_offset = offsetof(block, table_rate), .minimum = 1, .maximum = 1000000,            \
        .fallback = "exact", .unit = "entries a unit",                                             \
        .help = "exact, or the text's table in squared distance"                                   \
    }

#endif
