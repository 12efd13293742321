// SPDX-License-Identifier: MIT
//
// The list of all properties of the scorecard, and the measuring of them.
#include "score/score.h"

#include <math.h>
#include <string.h>

#include "score/properties/sampling.h"
#include "score/properties/scale.h"

#define BL_PROPERTY(stem) extern const bl_property bl_property_##stem;
#include "score/properties.def"
#undef BL_PROPERTY

static const void *const list[] = {
#define BL_PROPERTY(stem) &bl_property_##stem,
#include "score/properties.def"
#undef BL_PROPERTY
};

const bl_registry bl_properties = {"property", "properties", list, sizeof list / sizeof *list};
_Static_assert(sizeof list / sizeof *list <= (size_t)BL_SCORE_PROPERTIES,
               "a score holds every property");

size_t bl_property_index(const char *name) {
    size_t i = 0;
    while (i < bl_property_count() && strcmp(bl_property_at(i)->name, name) != 0)
        i++;
    return i;
}

void bl_score_subject_scale(bl_score_subject *subject, const bl_score_settings *settings) {
    if (!bl_score_on_grid(subject->signal))
        subject->scale = bl_score_find_scale(subject->signal, settings);
}

bl_status bl_score_measure(const bl_score_subject *subject, const bl_score_settings *settings,
                           uint64_t wanted, bl_score *score, bl_message *message) {
    bl_score_settings share = *settings;
    bl_score_subject own = *subject;
    // The same signal, stating the cell that was found where it states none.
    bl_signal scaled = *subject->signal;
    // Boole's inequality: the parts add up to alpha at most, even if they depend on each other.
    share.alpha /= (double)(settings->table ? settings->table : 1) *
                   (double)(bl_property_count() ? bl_property_count() : 1);
    memset(score, 0, sizeof *score);
    if (own.scale.variation == BL_SCALE_NOT_SOUGHT && wanted)
        bl_score_subject_scale(&own, settings);
    if (isnan(scaled.facts.cell) && own.scale.variation == BL_VARIES)
        scaled.facts.cell = bl_score_cell_of(&own.scale);
    own.signal = &scaled;
    for (size_t i = 0; i < bl_property_count(); i++) {
        bl_score_property *result = &score->properties[i];
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL, BL_SCORE_NOT_ASKED);
        if (!(wanted >> i & 1))
            continue;
        bl_status status = bl_property_at(i)->measure(&own, &share, result, message);
        if (status != BL_OK)
            return status;
    }
    return BL_OK;
}

bl_verdict bl_score_verdict(const bl_score *scores, size_t count, int strict) {
    bl_verdict verdict = BL_VERDICT_PASS;
    for (size_t s = 0; s < count; s++)
        for (size_t i = 0; i < bl_property_count(); i++) {
            const bl_score_property *one = &scores[s].properties[i];
            if (one->against == BL_AGAINST_CLAIM || strict)
                verdict = bl_verdict_worse(verdict, one->verdict);
        }
    return verdict;
}
