// SPDX-License-Identifier: MIT
//
// The property `least-property`: the value at a random place lies among a thousand others.
#include <math.h>

#include "score/properties/places.h"

static bl_status measure(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message) {
    bl_score_look look;
    double at[BL_AXES];
    (void)message;
    if (!bl_score_look_at(subject, settings, result, &look))
        return BL_OK; // judged already
    bl_random random = bl_score_random(settings, "least-property", 0);
    for (int a = 0; a < BL_AXES; a++)
        at[a] = look.cell * bl_random_unit(&random);
    double off = fabs(bl_signal_value(subject->signal, at) - look.mean);
    bl_score_add_exact(result, "off_mean", off);
    bl_score_judge(result, off <= look.range ? BL_VERDICT_PASS : BL_VERDICT_INCONCLUSIVE,
                   BL_AGAINST_IDEAL, "a value is %g off the mean", off);
    return BL_OK;
}

BL_PROPERTY_DESCRIPTOR(least_property) = {.name = "least-property",
                                          .title = "least-property",
                                          .entry = "how far one value is off the mean",
                                          .question = "Is a value near the mean?",
                                          .measure = measure};
