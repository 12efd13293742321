// SPDX-License-Identifier: MIT
//
// Whether the samples of a measured spectrum resolve the signal, along each of its directions.
#include <math.h>

#include "spectra/psd.h"
#include "spectra/theory.h"

static const double REACH = 1024;     // of the places: near enough for functions of floats
static const double OF_A_BAND = 1e-4; // allowed where the band that is stated reaches beyond

static bl_region region_of(const bl_psd_settings *settings, const double directions[3][BL_AXES]) {
    bl_region region = {{0}, {{0}}};
    if (settings->place == BL_PLACE_LATTICE) { // from a lattice point, along the line or the slice
        for (unsigned d = 0; d < settings->dims; d++)
            for (int a = 0; a < BL_AXES; a++)
                region.side[d][a] = REACH * directions[d][a];
        return region;
    }
    for (int a = 0; a < BL_AXES; a++) {
        region.origin[a] = -REACH;
        region.side[a][a] = 2 * REACH;
    }
    return region;
}

// Of the directions that which needs the most samples.
bl_resolution bl_psd_resolution(const bl_signal *signal, const bl_psd_settings *settings,
                                double allowed) {
    double directions[3][BL_AXES], step[BL_AXES];
    bl_resolution worst = {.allowed = allowed, .times = 1, .rate = settings->rate};
    if (!bl_directions(settings->dims, settings->axis, directions))
        return worst;
    const bl_region region = region_of(settings, directions);
    if (signal->definition && signal->facts.band_to > 0.5 * settings->rate)
        allowed = fmin(allowed, OF_A_BAND); // its octaves are detail that counts, if little power
    const double samples = (double)settings->averages * pow((double)settings->size, settings->dims);
    const bl_resolution_settings wanted = {
        .allowed = allowed, .samples = samples / settings->dims, .threads = settings->threads};
    for (unsigned d = 0; d < settings->dims; d++) {
        for (int a = 0; a < BL_AXES; a++)
            step[a] = directions[d][a] / settings->rate;
        bl_resolution found = bl_resolution_measure(signal, &region, step, &wanted);
        if (d == 0 || found.times > worst.times)
            worst = found;
    }
    worst.rate = settings->rate * worst.times; // without the rounding of a direction
    return worst;
}
