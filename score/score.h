// SPDX-License-Identifier: MIT
//
// The scorecard of an ideal noise: the contract of a property, the registry of all of them, and the
// measurement of one signal.
//
// A property is one file in score/, which ends with one descriptor, and one line in properties.def.
// It measures a signal, fills numbers with their intervals, and judges them: against what the
// signal states of itself (bl_facts), or, where it states nothing, against the ideal: a repeatable
// function of a known range, limited to a band whose highest frequency is about 1, without periods,
// stationary and isotropic (peachey2003, p. 68). Nothing here prints.
//
// All statistical tests of one table share one error budget, alpha: the probability that a table of
// correct signals shows any failure by chance. bl_score_measure gives each property of each signal
// its equal share; a property divides its share among its own tests.
#ifndef BL_SCORE_SCORE_H
#define BL_SCORE_SCORE_H

#include <stddef.h>
#include <stdint.h>

#include "core/registry.h"
#include "core/signal.h"
#include "core/size.h"
#include "core/statistics.h"
#include "core/verdict.h"
#include "noises/noise.h"

enum {
    BL_SCORE_NUMBERS = 40,    // of a property, at most
    BL_SCORE_PROPERTIES = 16, // of the registry, at most
    BL_SCORE_CLAIMS = 4,      // of a property, at most
    BL_SCORE_VARIANTS = 4     // instruction sets, at most
};

// What a property is judged against: a fact that the signal states, which is then its claim, or the
// ideal.
typedef enum bl_score_against { BL_AGAINST_CLAIM, BL_AGAINST_IDEAL } bl_score_against;

// A number of a property. Its level is 1 if it is exact, 0 if it has no interval.
typedef struct bl_score_number {
    const char *name;     // a constant, in snake case and with the unit: "share_above_1", "leak_db"
    bl_estimate estimate; // value NAN: not measured
} bl_score_number;

// One of several claims that a property judges: the bound, the mean and the variance of the range.
typedef struct bl_score_claim {
    const char *name; // a constant: "variance"
    bl_verdict verdict;
    char reason[200];
} bl_score_claim;

// What a property samples on a grid, and whether that resolves the signal: of several grids, that
// which is furthest from it.
typedef struct bl_score_detail {
    double rate;   // samples per unit; 0: it samples on no grid
    unsigned dims; // of the grid
    double beyond; // Nyquist, of the variance
    double enough; // samples per unit that would do; the rate: it is resolved; INFINITY: none
} bl_score_detail;

typedef struct bl_score_property {
    bl_verdict verdict;
    bl_score_against against;
    char cell[24];    // the entry of the table: "C1", "-31.2 dB"
    char reason[320]; // one sentence: what was found, and against what it was judged
    size_t count;
    bl_score_number numbers[BL_SCORE_NUMBERS];
    bl_score_detail detail;
    size_t claim_count; // 0: the property as a whole is what is claimed, or nothing is
    bl_score_claim claims[BL_SCORE_CLAIMS];
} bl_score_property;

// The scale of a signal, found from its values (score/properties/scale.h).
typedef enum bl_score_variation {
    BL_SCALE_NOT_SOUGHT,  // yet
    BL_VARIES,            // its values are related over a distance
    BL_VARIES_NOWHERE,    // all values are one number
    BL_VARIES_EVERYWHERE, // values are unrelated at any distance
    BL_VARIES_SLOWLY      // values are related at any distance: it has no scale
} bl_score_variation;

typedef struct bl_score_scale {
    bl_score_variation variation;
    double length;   // the shortest correlation length of all axes, units; NAN without
    double lattice;  // the distance of the planes of its lattice, units; 0: none was seen
    double stated;   // the cell that the signal states; NAN: none
    double constant; // the share of places that have the commonest value
} bl_score_scale;

// What is measured: the signal, and the same signal compiled for other instruction sets (none for
// a signal that is not of the registry). All are the caller's.
typedef struct bl_score_subject {
    const bl_signal *signal;
    const bl_signal *variants[BL_SCORE_VARIANTS];
    const char *variant_names[BL_SCORE_VARIANTS];
    size_t variant_count;
    bl_score_scale scale; // sought by bl_score_measure where it was not before
} bl_score_subject;

// The signal, and where it is a noise the same noise, by its text, for the other instruction sets
// that run here. On success the caller ends with bl_score_subject_close, which leaves the signal
// open. Errors: BL_DEVICE out of memory.
bl_status bl_score_subject_open(const bl_signal *signal, const char *text, bl_isa isa,
                                bl_score_subject *subject, bl_message *message);
void bl_score_subject_close(bl_score_subject *subject);

typedef struct bl_score_settings {
    double alpha; // in bl_score_measure: of the whole table; in a property: its own share
    size_t table; // signals in the table, which share alpha
    bl_size size;
    uint64_t seed; // of all random places and fresh seeds
    double level;  // of the confidence intervals that are shown, 0.95
    int threads;   // 0: as many as OpenMP gives
} bl_score_settings;

// Finds the scale once for several measurements.
void bl_score_subject_scale(bl_score_subject *subject, const bl_score_settings *settings);

typedef struct bl_property {
    BL_ENTRY(title, question); // the name is the JSON key, the title the column of the table
    const char *entry;         // what stands in that column: "the shortest repeat, in units"
    // Fills the result, which comes zeroed with verdict BL_VERDICT_NOT_RUN. Errors only where
    // nothing could be measured at all (BL_DEVICE out of memory); a signal that cannot be judged is
    // "not run" with its reason.
    bl_status (*measure)(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message);
} bl_property;

#define BL_PROPERTY_DESCRIPTOR(stem)                                                               \
    extern const bl_property bl_property_##stem;                                                   \
    const bl_property bl_property_##stem

BL_REGISTRY(bl_property, bl_property, bl_properties)
// The index of a name, where a score holds what was found; their count for an unknown one.
size_t bl_property_index(const char *name);

typedef struct bl_score {
    bl_score_property properties[BL_SCORE_PROPERTIES]; // in the order of the registry
} bl_score;

// 1e-6, one signal, normal size, seed 1, level 0.95, all threads.
bl_score_settings bl_score_default_settings(void);

// The reason of a property that was not measured because nobody asked.
#define BL_SCORE_NOT_ASKED "not asked for"
// The reason of one that asks something of pictures, for a function; its column is not shown where
// there are functions alone.
#define BL_SCORE_NO_PICTURE "a function has no edges"

// Measures the properties whose index is set in `wanted` (bit i: property i); the others are "not
// run". Deterministic for given settings whatever the threads, except for the property `cost`.
// Thread-safe, except for `cost`, whose times disturb each other. Errors: those of the properties.
bl_status bl_score_measure(const bl_score_subject *subject, const bl_score_settings *settings,
                           uint64_t wanted, bl_score *score, bl_message *message);

// Adds a number; the name is a constant. Dropped beyond BL_SCORE_NUMBERS (asserts).
void bl_score_add(bl_score_property *result, const char *name, bl_estimate estimate);
// An exact number, or one without an interval.
void bl_score_add_exact(bl_score_property *result, const char *name, double value);
void bl_score_add_seen(bl_score_property *result, const char *name, double value);
// The number of that name, or NULL.
const bl_score_number *bl_score_find(const bl_score_property *result, const char *name);

// Sets verdict, against and the reason by printf.
void bl_score_judge(bl_score_property *result, bl_verdict verdict, bl_score_against against,
                    const char *format, ...) __attribute__((format(printf, 4, 5)));

// Adds one of several claims; the name is a constant. Dropped beyond BL_SCORE_CLAIMS (asserts).
void bl_score_add_claim(bl_score_property *result, const char *name, bl_verdict verdict,
                        const char *format, ...) __attribute__((format(printf, 4, 5)));
const char *bl_score_against_word(bl_score_against against); // "claim", "ideal"
// The verdict of a table: fail if a claim fails (or, if `strict`, the ideal), else inconclusive if
// one is, else pass.
bl_verdict bl_score_verdict(const bl_score *scores, size_t count, int strict);

#endif
