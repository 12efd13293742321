// SPDX-License-Identifier: MIT
//
// What the verbs that measure a spectrum share: their options, the measurement, and its forms as
// JSON and as a data file.
#ifndef BL_CLI_SPECTRAL_H
#define BL_CLI_SPECTRAL_H

#include "cli/verb.h"
#include "spectra/psd.h"

typedef struct bl_spectral {
    uint64_t dims, size, averages; // 0: as the library chooses
    double rate, level;
    const char *axis, *window, *place;
} bl_spectral;

#define BL_SPECTRAL_AT(type, member) (offsetof(type, spectral) + offsetof(bl_spectral, member))

// clang-format off
// The options, for a settings struct `type` with a member `spectral`.
#define BL_SPECTRAL_OPTIONS(type)                                                                  \
    {"dims", BL_OPTION_UNSIGNED, BL_SPECTRAL_AT(type, dims), "N", .fallback = "1",                 \
     .minimum = 1, .maximum = 3,                                                                   \
     .help = "1 along a line, 2 in a slice (rings), 3 in a volume (shells)"},                      \
    {"axis", BL_OPTION_WORD, BL_SPECTRAL_AT(type, axis), "AXIS",                                   \
     .help = "direction of the line or normal of the slice: x, y, z or DX,DY,DZ (default: x for "  \
             "a line, z for a slice)"},                                                            \
    {"rate", BL_OPTION_REAL, BL_SPECTRAL_AT(type, rate), "R", .minimum = 1e-6, .maximum = 1e6,     \
     .help = "samples per unit (default: that of an image; else 16, 8, 4 by dims)"},               \
    {"size", BL_OPTION_UNSIGNED, BL_SPECTRAL_AT(type, size), "N", .minimum = 8, .maximum = 1e12,   \
     .help = "samples along each axis (default: 2048, 512, 64 by dims, or what an image has)"},    \
    {"average", BL_OPTION_UNSIGNED, BL_SPECTRAL_AT(type, averages), "K", .minimum = 2,             \
     .maximum = 1e7,                                                                               \
     .help = "independent places to average over (default: 256, 16, 8 by dims; a quarter with "    \
             "--quick, sixteen times with --full; of an image at most what it has)"},              \
    {"window", BL_OPTION_WORD, BL_SPECTRAL_AT(type, window), "NAME",                               \
     .help = "taper: blackman-harris, hann or rectangle (default: blackman-harris)"},              \
    {"place", BL_OPTION_CHOICE, BL_SPECTRAL_AT(type, place), "PLACE",                              \
     .choices = bl_spectral_places,                                                                \
     .help = "where lines and slices lie: anywhere (the default), or on lattice edges and planes"},\
    BL_LEVEL_OPTION(BL_SPECTRAL_AT(type, level))
// clang-format on

extern const char *const bl_spectral_places[];

// Turns the options into settings of the library. Errors: BL_USAGE for a value that cannot be read,
// BL_MISMATCH for a place where the signal has its own.
bl_status bl_spectral_settings(bl_call *call, const bl_spectral *options, const bl_signal *signal,
                               bl_psd_settings *settings);

// Turns the options into settings and measures.
bl_status bl_spectral_measure(bl_call *call, const bl_spectral *options, const bl_signal *signal,
                              bl_psd *psd);

// Warns where more than the share `allowed` of the variance lies beyond Nyquist, with the rate that
// would do.
void bl_spectral_warn(bl_call *call, const bl_signal *signal, const bl_psd *psd, double allowed);

// Adds how the spectrum was taken, the variance, and the arrays over frequency.
void bl_spectral_json(json_t *object, const bl_signal *signal, const bl_psd *psd);

// Writes the data file: comments, one header line, one row a frequency.
bl_status bl_spectral_csv(bl_call *call, const bl_signal *signal, const bl_psd *psd);

// Prints what was measured and how: the first lines of a report.
void bl_spectral_print(FILE *out, const bl_spectral *options, const bl_signal *signal,
                       const bl_psd *psd);

#endif
