// SPDX-License-Identifier: MIT
//
// Chapters 2 and 3: signals and their values.
#include "api/api.h"

#include "core/footprint.h"
#include "filters/sample_width.h"
#include "sources/source.h"

bandlimit_status bandlimit_open(const char *text, bandlimit_signal **signal,
                                bandlimit_message *message) {
    bl_signal *opened = NULL;
    bl_status status = bl_source_open(text, BL_ISA_BEST, &opened, bl_api_message(message));
    *signal = (bandlimit_signal *)opened;
    return (bandlimit_status)status;
}

bandlimit_status bandlimit_reseed(const bandlimit_signal *signal, uint64_t seed,
                                  bandlimit_signal **copy, bandlimit_message *message) {
    const bl_signal *own = bl_api_signal(signal);
    bl_signal *made = bl_signal_reseed(own, seed);
    *copy = (bandlimit_signal *)made;
    if (made)
        return BANDLIMIT_OK;
    if (own->seed_offset == SIZE_MAX)
        return (bandlimit_status)bl_report(bl_api_message(message), BL_MISMATCH, "'%s' has no seed",
                                           own->text);
    return (bandlimit_status)bl_report(bl_api_message(message), BL_DEVICE,
                                       "'%s' cannot be copied, or memory is out", own->text);
}

void bandlimit_close(bandlimit_signal *signal) {
    bl_signal_free((bl_signal *)signal);
}

bandlimit_status bandlimit_facts_of(const bandlimit_signal *signal, bandlimit_facts *facts,
                                    bandlimit_message *message) {
    const bl_signal *own = bl_api_signal(signal);
    const bl_facts *stated = &own->facts;
    bl_status status = BL_API_CHECK(facts, bandlimit_facts, message);
    if (status != BL_OK)
        return (bandlimit_status)status;
    *facts = (bandlimit_facts){.bytes = sizeof *facts,
                               .text = own->text,
                               .name = own->name,
                               .dimensions = own->dimensions,
                               .has_seed = own->seed_offset != SIZE_MAX,
                               .has_gradient = own->functions->gradient != NULL,
                               .has_filter = own->functions->filtered != NULL,
                               .has_colour = own->functions->colour != NULL,
                               .has_closed_form = bl_signal_has_closed_form(own),
                               .lower = stated->lower,
                               .upper = stated->upper,
                               .bound_proof = stated->bound_proof,
                               .mean = stated->mean,
                               .variance = stated->variance,
                               .band_from = stated->band_from,
                               .band_to = stated->band_to,
                               .leak_db = stated->leak_db,
                               .continuity = stated->continuity,
                               .is_stationary = stated->stationary,
                               .is_isotropic = stated->isotropic,
                               .cell = stated->cell,
                               .far = stated->far};
    memcpy(facts->period, stated->period, sizeof facts->period);
    memcpy(facts->samples, own->extent.size, sizeof facts->samples);
    memcpy(facts->spacing, own->extent.spacing, sizeof facts->spacing);
    return BANDLIMIT_OK;
}

bandlimit_status bandlimit_complaint(const bandlimit_signal *signal, bandlimit_message *message) {
    return (bandlimit_status)bl_signal_complaint(bl_api_signal(signal), bl_api_message(message));
}

// --- values ---

void bandlimit_row(const bandlimit_signal *signal, const double start[4], const double step[4],
                   size_t count, float *out) {
    bl_signal_row(bl_api_signal(signal), start, step, count, out);
}

// Arrays inside can all be read; one that the caller has not is one that the signal ignores.
#define PLACES                                                                                     \
    { x, y ? y : x, z ? z : x, w ? w : x }

void bandlimit_points(const bandlimit_signal *signal, const double *x, const double *y,
                      const double *z, const double *w, size_t count, float *out) {
    const double *const at[BL_AXES] = PLACES;
    bl_signal_points(bl_api_signal(signal), at, count, out);
}

double bandlimit_value(const bandlimit_signal *signal, const double at[4]) {
    return bl_signal_value(bl_api_signal(signal), at);
}

bandlimit_status bandlimit_gradient(const bandlimit_signal *signal, const double at[4],
                                    double gradient[4], bandlimit_message *message) {
    const bl_signal *own = bl_api_signal(signal);
    if (!own->functions->gradient)
        return (bandlimit_status)bl_report(bl_api_message(message), BL_MISMATCH,
                                           "'%s' has no analytic gradient", own->text);
    own->functions->gradient(own->parameters, at, gradient);
    for (unsigned a = own->dimensions; a < BL_AXES; a++)
        gradient[a] = 0;
    return BANDLIMIT_OK;
}

_Static_assert(sizeof(bandlimit_footprint) == sizeof(bl_footprint) &&
                   offsetof(bandlimit_footprint, down) == offsetof(bl_footprint, down) &&
                   offsetof(bandlimit_footprint, width) == offsetof(bl_footprint, width),
               "footprints are cast");

bandlimit_footprint bandlimit_footprint_of(const double across[4], const double down[4]) {
    bandlimit_footprint footprint;
    for (unsigned a = 0; a < BL_AXES; a++) {
        footprint.across[a] = across[a];
        footprint.down[a] = down[a];
        footprint.width[a] = bl_sample_width(BL_WIDTH_SUM, across[a], down[a], 0, 0);
    }
    return footprint;
}

bandlimit_footprint bandlimit_footprint_upright(const double width[4]) {
    const bl_footprint own = bl_footprint_of_widths(width);
    bandlimit_footprint footprint;
    memcpy(&footprint, &own, sizeof footprint);
    return footprint;
}

void bandlimit_filtered(const bandlimit_signal *signal, const double *x, const double *y,
                        const double *z, const double *w, const bandlimit_footprint *footprints,
                        size_t count, double *out) {
    const bl_samples samples = {PLACES, (const bl_footprint *)footprints, 1, count};
    bl_signal_filtered_values(bl_api_signal(signal), &samples, out);
}

void bandlimit_colour(const bandlimit_signal *signal, const double *x, const double *y,
                      const double *z, const double *w, const bandlimit_footprint *footprints,
                      size_t count, double *rgb) {
    const bl_samples samples = {PLACES, (const bl_footprint *)footprints, 1, count};
    bl_signal_colours(bl_api_signal(signal), &samples, rgb);
}
