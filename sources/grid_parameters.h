// SPDX-License-Identifier: MIT
//
// The keys that all files of samples share. `block` is the struct that the settings are read into,
// which has the fields that a macro names.
#ifndef BL_SOURCES_GRID_PARAMETERS_H
#define BL_SOURCES_GRID_PARAMETERS_H

#include <stddef.h>

#include "core/grammar.h"
#include "sources/sampled_grid.h"

// clang-format off
// double spacing; `usual` is the default, as text. What is not above 0 is read too: who opens the
// file has words of his own for it.
#define BL_SPACING_PARAMETER(block, usual, what)                                                   \
    {"spacing", BL_REAL, offsetof(block, spacing), usual, "units", .minimum = -1e12,               \
     .maximum = 1e12, .help = what}

// double memory.
#define BL_MEMORY_PARAMETER(block, what)                                                           \
    {"memory", BL_REAL, offsetof(block, memory), "1024", "MiB", .minimum = 0,                      \
     .maximum = 1 << 24, .help = what}

// uint32_t wrap, reading: two entries of a list. `samples` are these in the file's words.
#define BL_WRAP_PARAMETERS(block, samples)                                                         \
    {"wrap", BL_CHOICE, offsetof(block, wrap), "none", "",                                         \
     .choices = bl_sampled_grid_wrap_words, .help = "what stands beyond the edge"},                \
    {"interp", BL_CHOICE, offsetof(block, reading), "nearest", "",                                 \
     .choices = bl_sampled_grid_reading_words, .help = "what stands between the " samples}
// clang-format on

#endif
