// SPDX-License-Identifier: MIT
//
// The keys that all files of samples share. `block` is the struct that the settings are read into,
// which has the fields that a macro names.
#ifndef BL_SOURCES_GRID_PARAMETERS_H
#define BL_SOURCES_GRID_PARAMETERS_H

#include <stddef.h>

#include "core/grammar.h"
#include "sources/sampled_grid.h"

// double spacing; `usual` is the default, as text. What is not above 0 is read too: who opens the
// file has words of his own for it.
#define BL_SPACING_PARAMETER(block, usual, what)                                                   \
    {                                                                                              \
        .key = "spacing", .kind = BL_REAL, .offset = offsetof(block, spacing), .minimum = -1e12,   \
        .maximum = 1e12, .fallback = usual, .unit = "units", .help = what                          \
    }

// double memory.
#define BL_MEMORY_PARAMETER(block, what)                                                           \
    {                                                                                              \
        .key = "memory", .kind = BL_REAL, .offset = offsetof(block, memory), .minimum = 0,         \
        .maximum = 1 << 24, .fallback = "1024", .unit = "MiB", .help = what                        \
    }

// uint32_t wrap, reading: two entries of a list. `samples` are these in the file's words.
#define BL_WRAP_PARAMETERS(block, samples)                                                         \
    {.key = "wrap",                                                                                \
     .kind = BL_CHOICE,                                                                            \
     .offset = offsetof(block, wrap),                                                              \
     .choices = bl_sampled_grid_wrap_words,                                                        \
     .fallback = "none",                                                                           \
     .unit = "",                                                                                   \
     .help = "what stands beyond the edge"},                                                       \
    {                                                                                              \
        .key = "interp", .kind = BL_CHOICE, .offset = offsetof(block, reading),                    \
        .choices = bl_sampled_grid_reading_words, .fallback = "nearest", .unit = "",               \
        .help = "what stands between the " samples                                                 \
    }

#endif
