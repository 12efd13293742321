// SPDX-License-Identifier: MIT
#include "textures/texture.h"

#include <math.h>
#include <string.h>

const char *const bl_colour_components[] = {"luminance", "red", "green", "blue", NULL};

// The weights of ITU-R BT.709, whose primaries sRGB has; they sum to 1.
double bl_colour_component(const double rgb[3], uint32_t component) {
    return component == 0 ? 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
                          : rgb[component - 1];
}

bl_colour bl_colour_mix(bl_colour a, bl_colour b, double x) {
    bl_colour mixed;
    for (int i = 0; i < 3; i++)
        mixed.rgb[i] = (1 - x) * a.rgb[i] + x * b.rgb[i];
    return mixed;
}

const bl_colour bl_colour_missing = {{NAN, NAN, NAN}};

void bl_colour_put(bl_colour colour, double rgb[3]) {
    memcpy(rgb, colour.rgb, sizeof colour.rgb);
}

int bl_texture_is_seen(const double at[BL_AXES], const bl_footprint *footprint,
                       unsigned dimensions) {
    for (unsigned a = 0; a < dimensions; a++)
        if (!(fabs(at[a]) <= 0x1p62) || isnan(footprint->width[a]))
            return 0;
    return 1;
}

void bl_texture_filtered(void (*colour)(const void *, const bl_samples *, double *),
                         const void *parameters, uint32_t component, const bl_samples *samples,
                         double *out) {
    double rgb[3 * BL_BATCH];
    for (size_t done = 0; done < samples->count; done += BL_BATCH) {
        const bl_samples part = bl_samples_part(samples, done, BL_BATCH);
        colour(parameters, &part, rgb);
        for (size_t i = 0; i < part.count; i++)
            out[done + i] = bl_colour_component(rgb + 3 * i, component);
    }
}

void bl_texture_bound(bl_facts *facts, uint32_t component, const bl_colour *colours, size_t count,
                      const char *proof) {
    facts->lower = INFINITY;
    facts->upper = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        double value = bl_colour_component(colours[i].rgb, component);
        facts->lower = fmin(facts->lower, value);
        facts->upper = fmax(facts->upper, value);
    }
    // Mixtures and luminances are sums of products of what is not negative, which round: some ulps
    // beyond the ends, and none below 0.
    facts->lower -= 0x1p-50 * fabs(facts->lower);
    facts->upper += 0x1p-50 * fabs(facts->upper);
    facts->bound_proof = proof;
}

void bl_texture_mean(bl_facts *facts, uint32_t component, bl_colour mean) {
    facts->mean = bl_colour_component(mean.rgb, component);
}
