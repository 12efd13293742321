// SPDX-License-Identifier: MIT
//
// A gallery: any signals side by side, one panel a signal, in the pictures that the papers compare
// noises with: graphs along a line, slices, spectra along a line and by radius, and histograms.
// Figures 2.35 to 2.37 of peachey2003 show six noises in it, the zoo all of them, and `compare` the
// user's own.
#ifndef BL_REPORTS_FIGURES_GALLERY_H
#define BL_REPORTS_FIGURES_GALLERY_H

#include "reports/figures/graph.h"
#include "reports/measure.h"

typedef struct bl_gallery {
    size_t count;
    bl_signal **signal;
    const char *const *label; // the title of the panel: the text without the seed
    const char *const *key;   // of columns and files: letters, digits and '-', different for each
} bl_gallery;

// Opens the signals (noises, files, programs) with the seed of the run, where a signal has one and
// its text names none, and notes their texts as settings "signal (a)", "signal (b)", ... The run
// owns it all.
bl_gallery bl_gallery_open(bl_run *run, const char *const *texts, size_t count);

// The columns of panels that `count` panels are laid out in.
size_t bl_gallery_columns(size_t count);

// --- graphs along lines -------------------------------------------------------------------------

// One of the lines of a panel. Its coordinates y, z, w; x runs from 0.
typedef struct bl_gallery_line {
    const char *name;  // of its columns: "edge"
    const char *label; // in the legend
    double across[3];  // y, z, w
    bl_ink ink;
    bl_stroke stroke;
} bl_gallery_line;

typedef struct bl_gallery_graphs {
    const char *title, *alternative;
    const bl_gallery_line *lines;
    size_t line_count;
    double length; // along x, units
    size_t steps;  // of the graph, so that steps + 1 samples are drawn
    bl_axis y;     // from and to 0: the range of the values of all panels
    const char *x_label;
    size_t columns; // of panels; 0: bl_gallery_columns
    double aspect;
} bl_gallery_graphs;

// Writes graphs.csv and the plot "graphs". A signal with a grid is drawn over its own first row.
void bl_gallery_draw_graphs(bl_run *run, const bl_gallery *gallery,
                            const bl_gallery_graphs *graphs);

// --- curves -------------------------------------------------------------------------------------

// Draws one curve a signal, of values that the figure measured over the x of the graph, of each
// signal after the other; a panel each. `label` is that of the legend.
void bl_gallery_draw_curves(bl_run *run, const bl_gallery *gallery, const double *values,
                            bl_stroke stroke, const char *label, const bl_graph *graph);

// --- slices -------------------------------------------------------------------------------------

typedef struct bl_gallery_slices {
    const char
        *name; // of the files: "random" makes KEY-random.exr, .png and the plot slices-random
    const char *title, *alternative;
    double origin[BL_AXES]; // of the upper left pixel
    double length;          // of a side, units
    size_t pixels;          // of a side
    double black, white;    // both 0: the range of the values of all panels
    double deviations;      // above 0: instead each panel spans so many standard deviations on
                            // both sides of its own mean
    const char *unit;       // of the axes: "lattice cells"
} bl_gallery_slices;

void bl_gallery_draw_slices(bl_run *run, const bl_gallery *gallery,
                            const bl_gallery_slices *slices);

// --- spectra ------------------------------------------------------------------------------------

// One spectrum a signal; NULL for one that could not be measured: the settings of the run say why.
typedef struct bl_gallery_spectra {
    const bl_psd *const *psd;
    size_t count;
} bl_gallery_spectra;

// Measures all. A signal that does not fit the settings (too few dimensions, a grid too small) is
// left out.
bl_gallery_spectra bl_gallery_measure_spectra(bl_run *run, const bl_gallery *gallery,
                                              const bl_psd_settings *settings, const char *what);

typedef struct bl_gallery_spectrum_plot {
    const char *name; // of the files: "line" makes spectrum-line-KEY.csv and the plot spectra-line
    const char *title, *alternative;
    double lowest, highest; // frequencies drawn
    int logarithmic;        // axis of the frequency
    double lowest_db, highest_db;
    double tick, tick_db;
    double limit; // a frequency to mark; 0: the end of the ideal band, 1
    const char *limit_label;
    const char *x_label;
} bl_gallery_spectrum_plot;

// Power by frequency, in dB of the total variance per cycle per unit, with its band and the closed
// form where there is one. For rings and shells that is the density times measure over width.
void bl_gallery_draw_spectra(bl_run *run, const bl_gallery *gallery,
                             const bl_gallery_spectra *spectra,
                             const bl_gallery_spectrum_plot *plot);

// The anisotropy of the rings of slices over the level that an isotropic signal reads.
void bl_gallery_draw_anisotropy(bl_run *run, const bl_gallery *gallery,
                                const bl_gallery_spectra *spectra,
                                const bl_gallery_spectrum_plot *plot);

// --- histograms ---------------------------------------------------------------------------------

// Measures and draws the distribution of the values over `samples` places, in standard deviations
// from the mean, over the normal density; writes histogram-KEY.csv, histograms.csv (moments and
// range of each) and the plot "histograms".
void bl_gallery_draw_histograms(bl_run *run, const bl_gallery *gallery, size_t samples,
                                const char *title, const char *alternative);

#endif
