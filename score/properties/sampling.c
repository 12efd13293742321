// SPDX-License-Identifier: MIT
#include "score/properties/sampling.h"

#include <math.h>
#include <stdio.h>

int bl_score_on_grid(const bl_signal *signal) {
    return signal->extent.size[0] != 0;
}

double bl_score_cell(const bl_signal *signal) {
    return signal->facts.cell > 0 ? signal->facts.cell : 1;
}

void bl_score_place(const bl_signal *signal, double reach, bl_random *random, double at[BL_AXES]) {
    for (int a = 0; a < BL_AXES; a++) {
        double unit = bl_random_unit(random); // below 1, so the index is below the size
        size_t size = signal->extent.size[a];
        if (bl_score_on_grid(signal))
            at[a] = size ? signal->extent.spacing[a] * floor(unit * (double)size) : 0;
        else
            at[a] = (2 * unit - 1) * reach;
    }
}

bl_score_text bl_score_place_text(const bl_signal *signal, const double at[BL_AXES]) {
    bl_score_text place = {""};
    size_t used = 0, size = sizeof place.text;
    for (unsigned a = 0; a < signal->dimensions && a < BL_AXES && used < size; a++)
        used += (size_t)snprintf(place.text + used, size - used, "%s%.17g", a ? ", " : "(", at[a]);
    if (used < size)
        snprintf(place.text + used, size - used, ")");
    return place;
}

double bl_score_bound(const bl_signal *signal) {
    double lower = fabs(signal->facts.lower), upper = fabs(signal->facts.upper);
    return isfinite(lower) && isfinite(upper) ? fmax(lower, upper) : NAN;
}

int bl_score_states_band(const bl_signal *signal) {
    const bl_facts *facts = &signal->facts;
    return isfinite(facts->band_to) || facts->band_from > 0;
}

int bl_score_states_something(const bl_signal *signal) {
    const bl_facts *facts = &signal->facts;
    if (isfinite(bl_score_bound(signal)) || isfinite(facts->mean) || isfinite(facts->variance) ||
        bl_score_states_band(signal))
        return 1;
    if (bl_score_on_grid(signal))
        return 0;
    for (unsigned a = 0; a < signal->dimensions; a++)
        if (!isnan(facts->period[a]))
            return 1;
    return facts->continuity >= -1 || facts->far > 0 || facts->stationary == 1 ||
           facts->isotropic == 1 || signal->functions->gradient;
}

void bl_score_note_detail(bl_score_property *result, const bl_signal *signal,
                          const bl_psd_settings *settings) {
    const bl_resolution found = bl_psd_resolution(signal, settings, BL_RESOLUTION_SPECTRUM);
    bl_score_detail *kept = &result->detail;
    if (kept->rate == 0 || found.times > kept->enough / kept->rate)
        *kept = (bl_score_detail){settings->rate, settings->dims, found.beyond, found.rate};
}
