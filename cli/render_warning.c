// SPDX-License-Identifier: MIT
#include "cli/render_warning.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "aliasing/method.h"
#include "core/setting.h"
#include "spectra/resolution.h"

// The area of the pixels, not their middles alone.
static bl_region region_of(const bl_grid *grid) {
    bl_region region = {{0}, {{0}}};
    for (int a = 0; a < BL_AXES; a++) {
        region.origin[a] = grid->origin[a] - 0.5 * (grid->right[a] + grid->down[a]);
        region.side[0][a] = (double)grid->width * grid->right[a];
        region.side[1][a] = (double)grid->height * grid->down[a];
    }
    return region;
}

// Of both directions that which needs the smaller pixels.
static bl_resolution measure(const bl_call *call, const bl_signal *signal, const bl_grid *grid,
                             double variance, int is_brief) {
    const bl_region region = region_of(grid);
    const bl_resolution_settings settings = {.allowed = BL_RESOLUTION_PICTURE,
                                             .variance = variance,
                                             .samples = 0.5 * (double)(grid->width * grid->height),
                                             .is_brief = is_brief,
                                             .threads = bl_call_threads(call)};
    bl_resolution across = bl_resolution_measure(signal, &region, grid->right, &settings);
    bl_resolution down = bl_resolution_measure(signal, &region, grid->down, &settings);
    return down.times > across.times ? down : across;
}

// The variance of the texture before it filters itself; 0 of one that does not.
static double raw_variance(const bl_call *call, const bl_signal *signal, const bl_grid *grid) {
    bl_signal *raw;
    if (!(bl_signal_own_width(signal) > 0) ||
        bl_signal_with_setting(signal, "width", "0", &raw, NULL) != BL_OK)
        return 0;
    double variance = measure(call, raw, grid, 0, 1).variance;
    bl_signal_free(raw);
    return variance;
}

// Adds the best of the signal's own filters, if it does; exact averages before approximations.
static void add_filter(const bl_call *call, const bl_signal *signal, const bl_grid *grid,
                       double spacing, double variance, char *text, size_t size) {
    static const char *const words[] = {"exact", "integral", "sat", "slope", "fade", "clamp"};
    char width[32];
    snprintf(width, sizeof width, "%.9g", spacing);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        bl_signal *filtered;
        if (bl_method_open_own(signal, words[i], width, &filtered, NULL) != BL_OK)
            continue;
        int does = measure(call, filtered, grid, variance, 1).times == 1;
        if (does)
            snprintf(text, size, ", and so would '%s'", filtered->text);
        bl_signal_free(filtered);
        if (does)
            return;
    }
}

void bl_render_warn(bl_call *call, const bl_signal *signal, const bl_grid *grid, double spacing) {
    bl_call_may_warn(call);
    double variance = raw_variance(call, signal, grid);
    // What filters itself is slow, and is resolved if it filters for the pixel.
    if (variance > 0 && measure(call, signal, grid, variance, 1).times == 1)
        return;
    const bl_resolution found = measure(call, signal, grid, variance, 0);
    const double factor = found.times, most = 1 << 14; // pixels of a picture for the eye
    const double width = (double)grid->width * factor, height = (double)grid->height * factor;
    char remedy[128] = "no size up to 16384 pixels would do", filter[600] = "";
    if (!(factor > 1))
        return;
    if (width <= most && height <= most)
        snprintf(remedy, sizeof remedy, "--width %.0f --height %.0f would do", width, height);
    else if (isfinite(factor)) // and once more by 2, as other places are seen then
        snprintf(remedy, sizeof remedy, "--scale %.3g would do",
                 0.5 * spacing * (double)grid->width / factor);
    add_filter(call, signal, grid, spacing, fmax(variance, found.variance), filter, sizeof filter);
    bl_call_warn(call,
                 "pixels of %.4g units are coarser than '%s': of its variance %.2g or more is "
                 "beyond what they resolve and shows as alias; %s%s (%.2g allowed)",
                 spacing, signal->text, found.beyond, remedy, filter, BL_RESOLUTION_PICTURE);
}
