// SPDX-License-Identifier: MIT
//
// The contract of a noise, and the registry of all noises.
//
// A noise is one file, which ends with one descriptor, and one line in noises.def. The file is
// compiled once for each instruction set; BL_NOISE_DESCRIPTOR gives the descriptor its suffixed
// name, and everything else in the file is static. No analysis knows a noise by name: what it may
// know stands in the descriptor.
#ifndef BL_NOISES_NOISE_H
#define BL_NOISES_NOISE_H

#include "core/grammar.h"
#include "core/signal.h"

typedef struct bl_noise {
    const char *name;    // in the registry and the grammar: "gnoise"
    const char *title;   // "gradient noise"
    const char *summary; // one sentence
    const char *formula; // in plain text
    const char *paper;   // key and page or section: "peachey2003, p. 75"
    unsigned dimensions; // 1 to 4, with the default settings
    const bl_parameter *parameters;
    size_t parameters_size; // of the flat parameter block
    size_t seed_offset;
    // Optional: the dimensions with these parameters, and with what functions.build made of them;
    // NULL: always those above.
    unsigned (*dimensions_of)(const void *parameters);
    // Optional: whether the parameters fit together; the message names the keys. Errors: BL_USAGE.
    bl_status (*validate)(const void *parameters, bl_message *message);
    // Fills the facts, which may depend on the parameters (and on what functions.build made).
    void (*describe)(const void *parameters, bl_facts *facts);
    // Optional: whether the closed forms (covariance, density) hold for these parameters; NULL
    // means that they always do. Sets bl_signal.closed_form.
    int (*has_closed_form)(const void *parameters);
    // The plain loops of the text in float, a call a point, with the default settings and the
    // tables of noises/textbook.h: the yardstick of the benchmark, never used otherwise.
    float (*textbook)(float x, float y, float z);
    // Optional: the settings with which the noise is the very field of these loops, up to rounding;
    // NULL: they have the statistics of the noise, and random numbers of their own.
    const char *textbook_settings;
    bl_signal_functions functions;
} bl_noise;

// The instruction sets every noise is compiled for; all give the same bits.
typedef enum bl_isa { BL_ISA_BASELINE, BL_ISA_V3, BL_ISA_V4, BL_ISA_COUNT, BL_ISA_BEST } bl_isa;

const char *bl_isa_name(bl_isa isa); // "baseline", "v3", "v4"
int bl_isa_runs_here(bl_isa isa);    // by the processor's own word
bl_isa bl_isa_best(void);            // the highest that runs here
// Reads "baseline", "v3" or "v4". Errors: BL_USAGE for another word, BL_MISMATCH for a set that
// this processor lacks.
bl_status bl_isa_read(const char *word, bl_isa *isa, bl_message *message);

size_t bl_noise_count(void);
// The descriptor of a noise by index or by name, compiled for `isa` (BL_ISA_BEST: the best here);
// NULL past the end and for an unknown name.
const bl_noise *bl_noise_at(size_t index, bl_isa isa);
const bl_noise *bl_noise_find(const char *name, bl_isa isa);

// Opens a noise by its text. The caller frees the signal with bl_signal_free; on failure it is left
// alone. Errors: BL_USAGE for an unknown name, key or value, BL_DEVICE out of memory. Thread-safe.
bl_status bl_noise_open(const char *text, bl_isa isa, bl_signal **signal, bl_message *message);

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
