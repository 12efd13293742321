// SPDX-License-Identifier: MIT
//
// The definition of a kind of signal: of a noise, a primitive, or a texture. It is a const
// descriptor of one file, and all that the registries, the command line and the tests know of it.
#ifndef BL_CORE_DEFINITION_H
#define BL_CORE_DEFINITION_H

#include "core/grammar.h"
#include "core/registry.h"
#include "core/signal.h"

// A picture that shows a definition well, for those who ask for one without a place of their own.
typedef struct bl_picture {
    double scale;       // units across; 0: nothing in particular
    double at[BL_AXES]; // the place in the middle
    double normal[3];   // of the slice; all 0: z
} bl_picture;

typedef struct bl_definition {
    BL_ENTRY(title, summary);
    const char *formula; // in plain text
    unsigned dimensions; // 1 to 4, with the default settings
    // At most one of the kind BL_SEED, which is the seed of the signal.
    const bl_parameter *parameters;
    size_t parameters_size; // of the flat parameter block
    // Optional: the dimensions with these parameters, and with what functions.build made of them;
    // NULL: what the key `dims` says, and without one always those above.
    unsigned (*dimensions_of)(const void *parameters);
    // Optional: whether the parameters fit together; the message names the keys. Errors: BL_USAGE.
    bl_status (*validate)(const void *parameters, bl_message *message);
    // Fills the facts, which may depend on the parameters (and on what functions.build made).
    void (*describe)(const void *parameters, bl_facts *facts);
    // Optional: whether the closed forms (covariance, density) hold for these parameters; NULL
    // means that they always do. Sets bl_signal.closed_form.
    int (*has_closed_form)(const void *parameters);
    // Optional, of a noise: the text's plain loops in float, a call a point, with default settings
    // and the tables of noises/textbook.h: the benchmark's yardstick; NULL: that is the reference.
    float (*textbook)(float x, float y, float z);
    // Optional: the settings with which the noise is the very field of these loops, up to rounding;
    // NULL: they have the statistics of the noise, and random numbers of their own.
    const char *textbook_settings;
    bl_picture picture; // optional
    bl_signal_functions functions;
} bl_definition;

// Opens a signal of this definition with the settings of the spec; `text` is the text of the whole
// signal, for messages, and `open` (NULL for a signal that is made of no other) becomes
// bl_signal.open. The caller frees the signal with bl_signal_free; on failure it is left alone.
// Errors: BL_USAGE for a key or a value, BL_DEVICE out of memory. Thread-safe.
bl_status bl_definition_open(const bl_definition *definition, const bl_spec *spec, const char *text,
                             bl_opener *open, bl_signal **signal, bl_message *message);

// The key of the kind BL_SEED; NULL for a definition without a seed.
const bl_parameter *bl_definition_seed(const bl_definition *definition);

// The words of a choice among the keys of a signal, ended by NULL; NULL for a signal without a
// definition, or without such a key. The words live as long as the program.
const char *const *bl_signal_choices(const bl_signal *signal, const char *key);

// The width of a sample that the signal's own key `width` sets for its values; 0 without such a
// key.
double bl_signal_own_width(const bl_signal *signal);

#endif
