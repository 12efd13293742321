// SPDX-License-Identifier: MIT
//
// The contract of a primitive, and the registry of all primitives.
//
// A primitive is a function of one coordinate that textures are made of, and a signal: one file in
// filters/primitives/, which ends with one definition (core/definition.h), and one line in
// primitives.def. All have the keys width, filter and anchor: the value is averaged by a filter
// (filters/filter.h) over samples of this width, around x or from x on.
//
// Width 0 is the function itself; an infinite width is its mean. All functions are defined for
// every double; the head of each file says how.
#ifndef BL_FILTERS_PRIMITIVE_H
#define BL_FILTERS_PRIMITIVE_H

#include <math.h>
#include <stddef.h>

#include "core/registry.h"
#include "core/definition.h"
#include "filters/filter.h"

typedef bl_definition bl_primitive;

BL_REGISTRY(bl_primitive, bl_primitive, bl_primitives)

// How a primitive is averaged: a field of its parameter block.
typedef struct bl_averaging {
    double width;
    uint32_t filter; // index in the registry of filters
    uint32_t anchor; // 0 centre, 1 start: over [x, x + width] for the box
} bl_averaging;

// The keys of bl_averaging, for the parameter list of a file whose block has it as `averaging`.
extern const char *const bl_anchor_words[];
// clang-format off
#define BL_AVERAGING_PARAMETERS(block)                                                             \
    {"width", BL_REAL, offsetof(block, averaging.width), "0", "units", .maximum = INFINITY,        \
     .help = "of a sample, over which the value is averaged; 0: not at all"},                      \
    {"filter", BL_CHOICE, offsetof(block, averaging.filter), "box", "",                            \
     .choices = bl_filter_words, .help = "that averages"},                                         \
    {"anchor", BL_CHOICE, offsetof(block, averaging.anchor), "centre", "",                         \
     .choices = bl_anchor_words, .help = "where x stands in the width"}

// A key of a primitive that takes any finite number.
#define BL_PRIMITIVE_REAL(block, name, usual, what)                                                \
    {#name, BL_REAL, offsetof(block, name), usual, "units", .minimum = -1e300, .maximum = 1e300,   \
     .help = what}
// clang-format on

// Where the middle of the width lies, for a sample at x.
static inline double bl_averaging_centre(const bl_averaging *averaging, double x, double width) {
    return averaging->anchor ? x + 0.5 * width : x;
}

// Whether the average stays within the bounds of the function, and its continuity class, for a
// function of class `continuity` (bl_filter_keeps_bounds, bl_filter_continuity).
int bl_averaging_keeps_bounds(const bl_averaging *averaging);
int bl_averaging_continuity(const bl_averaging *averaging, int continuity);

// States the period along the one axis of a primitive; 0: none.
void bl_primitive_period(bl_facts *facts, double period);

// States the facts of a continuous monotone curve that is 0 up to 0 and 1 from 1 on.
void bl_primitive_unit_facts(const bl_averaging *averaging, bl_facts *facts);

// x modulo a period other than 0, exact except for one rounding: in [0, period), or in (period, 0]
// for a negative one, so that modulo(-x, -period) is -modulo(x, period). NaN for infinite x.
double bl_modulo(double x, double period);

// x in periods, less all whole ones: exact except for one rounding, in (-1, 1), with the sign of x
// / period, so that places just below 0 keep their digits. NaN for infinite x.
double bl_periods(double x, double period);

// In a primitive's file, after `static double average(const block *, const bl_filter *filter,
// double x, double width)`, which knows no anchor: the abilities of the signal, for its definition
// as .functions = {BL_PRIMITIVE_FUNCTIONS}.
#define BL_PRIMITIVE_ABILITIES(block)                                                              \
    static void filtered(const void *parameters, const bl_samples *samples, double *out) {         \
        const block *p = parameters;                                                               \
        const bl_filter *filter = bl_filter_at(p->averaging.filter);                               \
        for (size_t i = 0; i < samples->count; i++) {                                              \
            double width = bl_samples_footprint(samples, i)->width[0];                             \
            out[i] = average(p, filter,                                                            \
                             bl_averaging_centre(&p->averaging, samples->at[0][i], width), width); \
        }                                                                                          \
    }                                                                                              \
    static void values(const void *parameters, const double *const at[BL_AXES], size_t count,      \
                       double *out) {                                                              \
        bl_values_of_width(filtered, parameters, ((const block *)parameters)->averaging.width, at, \
                           count, out);                                                            \
    }
#define BL_PRIMITIVE_FUNCTIONS .values = values, .filtered = filtered

// Its `validate`, where all there is to check is that averages are known on a span of the function
// (bl_check_averaging), an expression in which p is the block.
#define BL_PRIMITIVE_VALIDATE(block, span)                                                         \
    static bl_status validate(const void *parameters, bl_message *message) {                       \
        const block *p = parameters;                                                               \
        return bl_check_averaging(bl_filter_at(p->averaging.filter), p->averaging.width, span,     \
                                  message);                                                        \
    }

// What most definitions have alike: one coordinate, and the file's own `parameters` and `describe`.
#define BL_PRIMITIVE_PARTS(block)                                                                  \
    .dimensions = 1, .parameters = parameters, .parameters_size = sizeof(block),                   \
    .describe = describe, .functions = {BL_PRIMITIVE_FUNCTIONS}

// Names the definition of a primitive's file: BL_PRIMITIVE_DESCRIPTOR(step) = {...};
#define BL_PRIMITIVE_DESCRIPTOR(stem)                                                              \
    extern const bl_primitive bl_primitive_##stem;                                                 \
    const bl_primitive bl_primitive_##stem

#endif
