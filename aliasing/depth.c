// SPDX-License-Identifier: MIT
#include "aliasing/depth.h"

#include <math.h>

#include "core/hash.h"
#include "core/random.h"

enum { LOOKS = 8 }; // along each axis of the image

double bl_depth_place(const bl_signal *signal, unsigned axis, uint64_t seed) {
    const double cell =
        signal->facts.cell > 0 && isfinite(signal->facts.cell) ? signal->facts.cell : 1;
    bl_random random = bl_random_seed(bl_stream(seed, axis), 0);
    return signal->extent.size[axis] ? 0 : cell * (floor(640000 * bl_random_unit(&random)) / 10000);
}

int bl_depth_is_flat(const bl_signal *signal, const bl_view *view, unsigned axis) {
    if (axis < 2 || axis >= signal->dimensions)
        return 0;
    for (int i = 0; i < LOOKS * LOOKS; i++) {
        bl_sight sight;
        double x = (i % LOOKS + 0.5) / LOOKS * (double)view->width;
        double y = (i / LOOKS + 0.5) / LOOKS * (double)view->height;
        if (bl_view_see(view, x, y, &sight) && (sight.across[axis] != 0 || sight.down[axis] != 0))
            return 0;
    }
    return 1;
}

void bl_depth_draw(const bl_signal *signal, uint64_t seed, bl_view *view) {
    for (unsigned a = 2; a < BL_AXES; a++)
        if (!view->asked[a] && bl_depth_is_flat(signal, view, a))
            view->depth[a] = bl_depth_place(signal, a, seed);
}
