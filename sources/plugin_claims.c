// SPDX-License-Identifier: MIT
#include "sources/plugin_claims.h"

#include <math.h>
#include <string.h>

enum { CLAIMS_ROOM = 1024 };

int bl_plugin_claims_ask(bandlimit_claim *claim, struct bandlimit_claims *claims) {
    union {
        struct bandlimit_claims claims;
        unsigned char bytes[CLAIMS_ROOM];
    } room;
    memset(room.bytes, 0xA5, sizeof room.bytes);
    room.claims = (struct bandlimit_claims){.size = sizeof room.claims,
                                            .lower = NAN,
                                            .upper = NAN,
                                            .mean = NAN,
                                            .variance = NAN,
                                            .band_from = NAN,
                                            .band_to = NAN,
                                            .leak_db = NAN,
                                            .period = {NAN, NAN, NAN, NAN},
                                            .cell = NAN,
                                            .continuity = -2};
    if (claim)
        claim(&room.claims);
    *claims = room.claims;
    int beyond = 0;
    for (size_t i = sizeof *claims; i < sizeof room.bytes; i++)
        beyond |= room.bytes[i] != 0xA5;
    return claims->size == sizeof *claims && !beyond;
}

// Comparisons with NaN, which is not stated, are false.
const char *bl_plugin_claims_fault(const struct bandlimit_claims *c) {
    double range = c->upper - c->lower;
    if (c->dims > BL_AXES)
        return "dims is above 4";
    if (c->lower > c->upper)
        return "lower is above upper";
    if (c->mean < c->lower || c->mean > c->upper)
        return "the mean lies outside of lower to upper";
    if (c->variance < 0)
        return "the variance is negative";
    if (c->variance > 0.25 * range * range * (1 + 1e-9)) // Popoviciu's inequality
        return "the variance is more than a quarter of (upper - lower)^2, which none can be";
    if (c->band_from < 0 || c->band_from > c->band_to || isnan(c->band_from) != isnan(c->band_to))
        return "the band must rise from 0 or more, with both ends stated";
    if (c->leak_db > 0)
        return "leak_db is above 0 dB of the variance";
    for (int a = 0; a < BL_AXES; a++)
        if (c->period[a] < 0 || isinf(c->period[a]))
            return "a period must be finite and not negative";
    if (c->cell < 0 || isinf(c->cell))
        return "the cell must be finite and not negative";
    if (c->continuity < -2)
        return "continuity is below -1, discontinuous, and -2, not stated";
    if (c->flags & ~(uint32_t)BANDLIMIT_NOT_THREAD_SAFE)
        return "flags has bits that this version does not know";
    return NULL;
}

void bl_plugin_claims_state(const struct bandlimit_claims *claims, bl_facts *facts) {
    facts->lower = claims->lower;
    facts->upper = claims->upper;
    facts->bound_proof = isnan(claims->upper) ? NULL : "stated by the plugin";
    facts->mean = claims->mean;
    facts->variance = claims->variance;
    facts->band_from = claims->band_from;
    facts->band_to = claims->band_to;
    facts->leak_db = claims->leak_db;
    facts->continuity = claims->continuity;
    memcpy(facts->period, claims->period, sizeof facts->period);
    facts->cell = claims->cell;
    facts->stationary = claims->stationary == 1;
    facts->isotropic = claims->isotropic == 1;
}
