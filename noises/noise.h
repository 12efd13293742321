// SPDX-License-Identifier: MIT
//
// The contract of a noise, and the registry of all noises.
//
// A noise is one file, which ends with one definition (core/definition.h), and one line in
// noises.def. The file is
// compiled once for each instruction set; BL_NOISE_DESCRIPTOR gives the descriptor its suffixed
// name, and everything else in the file is static. No analysis knows a noise by name: what it may
// know stands in the descriptor.
#ifndef BL_NOISES_NOISE_H
#define BL_NOISES_NOISE_H

#include "core/definition.h"

typedef bl_definition bl_noise;

// The instruction sets every noise is compiled for; all give the same bits.
typedef enum bl_isa { BL_ISA_BASELINE, BL_ISA_V3, BL_ISA_V4, BL_ISA_COUNT, BL_ISA_BEST } bl_isa;

const char *bl_isa_name(bl_isa isa); // "baseline", "v3", "v4"
int bl_isa_runs_here(bl_isa isa);    // by the processor's own word
bl_isa bl_isa_best(void);            // the highest that runs here
// Reads "baseline", "v3" or "v4". Errors: BL_USAGE for another word, BL_MISMATCH for a set that
// this processor lacks.
bl_status bl_isa_read(const char *word, bl_isa *isa, bl_message *message);

extern const bl_registry bl_noises; // compiled for the baseline
static inline size_t bl_noise_count(void) {
    return bl_noises.count;
}
// The descriptor of a noise by index or by name, compiled for `isa` (BL_ISA_BEST: the best here);
// NULL past the end and for an unknown name.
const bl_noise *bl_noise_at(size_t index, bl_isa isa);
const bl_noise *bl_noise_find(const char *name, bl_isa isa);

// Opens a noise by its text. The caller frees the signal with bl_signal_free; on failure it is left
// alone. Errors: BL_USAGE for an unknown name, key or value, BL_DEVICE out of memory. Thread-safe.
bl_status bl_noise_open(const char *text, bl_isa isa, bl_signal **signal, bl_message *message);

// The opener of noises for noises that are made of others (bl_signal.open).
bl_opener *bl_noise_opener(bl_isa isa);

// In a noise file: the functions that nearly every noise has, under their own names.
#define BL_NOISE_FUNCTIONS .row = row, .points = points, .value = value
#define BL_NOISE_CLOSED_FORM .covariance = covariance, .density = density

// In a noise file: the instruction set it is being compiled for, as a bl_isa.
#define BL_ISA_INDEX_baseline BL_ISA_BASELINE
#define BL_ISA_INDEX_v3 BL_ISA_V3
#define BL_ISA_INDEX_v4 BL_ISA_V4
#define BL_ISA_INDEX_(set) BL_ISA_INDEX_##set
#define BL_ISA_INDEX(set) BL_ISA_INDEX_(set)
#define BL_THIS_ISA BL_ISA_INDEX(BL_ISA)

// Names the descriptor of a noise file: BL_NOISE_DESCRIPTOR(gradient_noise) = {...};
#define BL_PASTE_(a, b, c) a##b##_##c
#define BL_PASTE(a, b, c) BL_PASTE_(a, b, c)
#define BL_NOISE_DESCRIPTOR(stem)                                                                  \
    extern const bl_noise BL_PASTE(bl_noise_, stem, BL_ISA);                                       \
    const bl_noise BL_PASTE(bl_noise_, stem, BL_ISA)

#endif
