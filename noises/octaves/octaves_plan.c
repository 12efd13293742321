// SPDX-License-Identifier: MIT
//
// The plan of a sum of octaves: frequencies, amplitudes, and what of them a sample width keeps.
#include <math.h>

#include "noises/octaves/octaves.h"

const char *const bl_octave_seedings[] = {"fresh", "same", NULL};

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

void bl_octaves_plan_clamp(bl_octaves_plan *plan, double top, bl_octave_clamp clamp, double width) {
    plan->evaluated = 0;
    for (unsigned i = 0; i < plan->count; i++) {
        plan->kept[i] = bl_octave_kept(plan->frequency[i] * top, clamp, width);
        if (plan->kept[i] > 0)
            plan->evaluated = i + 1;
    }
}
