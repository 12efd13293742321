// SPDX-License-Identifier: MIT
//
// The option --components: the independent components of a vector-valued noise.
#ifndef BL_CLI_COMPONENTS_H
#define BL_CLI_COMPONENTS_H

#include "cli/verb.h"

enum { BL_COMPONENTS_MOST = 4 };

// uint64_t `member` of the block of settings.
// clang-format off
#define BL_COMPONENTS_OPTION(block, member)                                                        \
    {"components", BL_OPTION_UNSIGNED, offsetof(block, member), "N", .fallback = "1",              \
     .minimum = 1, .maximum = BL_COMPONENTS_MOST,                                                  \
     .help = "components of a vector: the signal and others of its kind and of seeds that "        \
             "follow from its own, as component=1 to 3 of a lattice noise"}
// clang-format on

typedef struct bl_vector_signal {
    size_t count;
    const bl_signal *of[BL_COMPONENTS_MOST]; // of[0] is the signal itself, not owned
} bl_vector_signal;

// Makes the components of a signal: component k draws from bl_component_seed(seed, k). Errors:
// BL_MISMATCH for more than one component of a signal without a seed, BL_DEVICE out of memory. On
// success the caller calls bl_vector_signal_free.
bl_status bl_vector_signal_open(const bl_signal *signal, size_t count, bl_vector_signal *vector,
                                bl_message *message);
void bl_vector_signal_free(bl_vector_signal *vector);

#endif
