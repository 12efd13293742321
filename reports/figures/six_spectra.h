// SPDX-License-Identifier: MIT
//
// The spectra of the six noises in four readings: what figure 2.37 measures, and its claims judge.
#ifndef BL_REPORTS_FIGURES_SIX_SPECTRA_H
#define BL_REPORTS_FIGURES_SIX_SPECTRA_H

#include "reports/figures/six_noises.h"
#include "spectra/psd.h"

typedef enum bl_reading {
    BL_READING_LINE,   // along a line at a random place
    BL_READING_EDGE,   // along an edge of the lattice
    BL_READING_SLICE,  // in a slice at a random place, by radial frequency
    BL_READING_VOLUME, // in a volume, by radial frequency
    BL_READINGS
} bl_reading;

extern const char *const bl_reading_words[BL_READINGS]; // "along a line at a random place"
extern const char *const bl_reading_names[BL_READINGS]; // of files: "line"

typedef struct bl_six_spectra {
    bl_psd psd[BL_READINGS][BL_SIX];
    int measured[BL_READINGS][BL_SIX];
} bl_six_spectra;

// Measures all and notes the settings. On success and on failure end with bl_six_spectra_free.
bl_status bl_six_spectra_measure(bl_run *run, const bl_six *six, bl_six_spectra *spectra,
                                 bl_message *message);
void bl_six_spectra_free(bl_six_spectra *spectra);

// The share of the variance between two frequencies, and what the closed form says.
bl_estimate bl_six_share(const bl_psd *psd, double from, double to);
bl_band bl_six_band(const bl_psd *psd, double from, double to);

// The claims of the figure.
void bl_six_spectra_claim(bl_run *run, const bl_six_spectra *spectra);

#endif
