// SPDX-License-Identifier: MIT
//
// The spectra of the six noises in four readings: what figure 2.37 measures, and its claims judge.
#ifndef BL_REPORTS_FIGURES_SIX_SPECTRA_H
#define BL_REPORTS_FIGURES_SIX_SPECTRA_H

#include "reports/figures/six_noises.h"

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
    const bl_psd *psd[BL_READINGS][BL_SIX];
} bl_six_spectra;

// Measures all and notes the settings.
bl_six_spectra bl_six_spectra_measure(bl_run *run, const bl_gallery *six);

// The claims of the figure.
void bl_six_spectra_claim(bl_run *run, const bl_six_spectra *spectra);

#endif
