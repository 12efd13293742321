// SPDX-License-Identifier: MIT
#include "reports/figures/six_spectra.h"

#include <math.h>

const char *const bl_reading_words[BL_READINGS] = {"along a line at a random place",
                                                   "along a lattice edge",
                                                   "in a slice at a random place", "in a volume"};
const char *const bl_reading_names[BL_READINGS] = {"line", "edge", "slice", "volume"};

static bl_psd_settings settings_of(const bl_run *run, bl_reading reading) {
    static const unsigned dims[BL_READINGS] = {1, 1, 2, 3};
    bl_psd_settings s = bl_run_psd_settings(run, dims[reading]);
    s.level = 0.95;
    s.place = reading == BL_READING_EDGE ? BL_PLACE_LATTICE : BL_PLACE_RANDOM;
    for (int a = 0; a < 3; a++)
        s.axis[a] = a == (reading == BL_READING_SLICE ? 2 : 0);
    switch (dims[reading]) {
    case 1:
        s.rate = 16;
        s.size = bl_run_count(run, 512, 2048, 4096);
        s.averages = bl_run_count(run, 192, 2048, 65536);
        break;
    case 2:
        s.rate = 8;
        s.size = bl_run_count(run, 128, 256, 512);
        s.averages = bl_run_count(run, 8, 512, 4096);
        break;
    default:
        s.rate = 4;
        s.size = bl_run_count(run, 32, 64, 128);
        s.averages = bl_run_count(run, 6, 128, 1024);
    }
    return s;
}

static void note_settings(bl_run *run, bl_reading reading, const bl_psd_settings *s) {
    static const char *const shapes[] = {"", "", "^2", "^3"};
    bl_run_setting(
        run, bl_run_text(run, "spectrum %s", bl_reading_words[reading]),
        bl_run_text(
            run,
            "%zu averages of %zu%s samples, %g a cell, %s window; a fresh place and a fresh seed "
            "for each; %g %% bands; a line in the spectrum spreads over +-%.3g cycles per cell",
            s->averages, s->size, shapes[s->dims], s->rate, bl_window_name(s->window),
            100 * s->level, bl_window_half_lobe(s->window) * s->rate / (double)s->size));
}

bl_six_spectra bl_six_spectra_measure(bl_run *run, const bl_gallery *six) {
    bl_six_spectra spectra;
    for (int r = 0; r < BL_READINGS; r++) {
        bl_psd_settings settings = settings_of(run, (bl_reading)r);
        note_settings(run, (bl_reading)r, &settings);
        for (int i = 0; i < BL_SIX; i++) {
            bl_run_step(run, bl_run_text(run, "%s %s", bl_six_names[i], bl_reading_words[r]));
            spectra.psd[r][i] = bl_run_psd(run, six->signal[i], &settings);
        }
    }
    return spectra;
}
