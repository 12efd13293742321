// SPDX-License-Identifier: MIT
//
// The plan of a sum of octaves: frequencies, amplitudes, and what of them a sample width keeps.
#include <math.h>

#include "noises/octaves.h"

const char *const bl_octave_clamps[] = {"none", "hard", "fade", NULL};
const char *const bl_octave_basis_examples[] = {"vnoise,basis.interp=linear",
                                                "gnoise,basis.lattice=perm256", "scnoise", NULL};

static void add(bl_octaves_plan *plan, double frequency, double amplitude) {
    plan->frequency[plan->count] = frequency;
    plan->amplitude[plan->count] = amplitude;
    plan->kept[plan->count++] = 1;
    plan->evaluated = plan->count;
}

bl_octaves_plan bl_octaves_plan_between(double least, double most) {
    bl_octaves_plan plan = {.ratio = 2};
    for (double f = least; f < most && plan.count < BL_OCTAVES_MOST; f *= 2)
        add(&plan, f, 1 / f);
    return plan;
}

bl_octaves_plan bl_octaves_plan_count(unsigned count, double ratio, double gain) {
    bl_octaves_plan plan = {.ratio = ratio};
    double frequency = 1, amplitude = 1;
    while (plan.count < count && plan.count < BL_OCTAVES_MOST && amplitude > 0) {
        add(&plan, frequency, amplitude);
        frequency *= ratio;
        amplitude *= gain;
    }
    return plan;
}

double bl_octave_kept(double t, bl_octave_clamp clamp, double width) {
    // Products, not quotients: no width but NaN makes a NaN of them, for t > 0.
    if (clamp == BL_CLAMP_NONE)
        return 1;
    if (clamp == BL_CLAMP_HARD)
        return 2 * t * width < 1;
    double fade = 2 - 4 * t * width;
    return fade >= 1 ? 1 : fade > 0 ? fade : 0;
}

void bl_octaves_plan_clamp(bl_octaves_plan *plan, double top, bl_octave_clamp clamp, double width) {
    plan->evaluated = 0;
    for (unsigned i = 0; i < plan->count; i++) {
        plan->kept[i] = bl_octave_kept(plan->frequency[i] * top, clamp, width);
        if (plan->kept[i] > 0)
            plan->evaluated = i + 1;
    }
}
