// SPDX-License-Identifier: MIT
//
// The property `band`: which frequencies the signal has.
//
// Spectra along the x axis, along the diagonal (1, 1, 0) or (1, 1, 1), and radially in slices, each
// averaged over random places and fresh seeds. Of each: the share of the variance above 1 cycle per
// unit and from 0.3 to 0.7, the leak in dB of the variance outside of the band that is judged, and
// the effective edges of the band: the lowest and the highest frequency whose density, smoothed
// over 0.1 cycles per unit, is within 3 dB and within 30 dB of its peak
// (score/properties/band_edges.h).
//
// Judged is the leak along x, outside of the band, by one-sided limits at the property's share of
// alpha, which hold whatever the window smears over the edges. Where they settle nothing a second
// look takes more averages, or longer lines, whose smear is less; each of the two looks has half of
// that share. A leak that is stated fails where the lower limit lies above it. It is a number, not
// a budget: one that is exactly right lies between the limits however many averages there are, so
// it passes where the upper limit is less than 1 dB above it, and is inconclusive else. If a band
// is stated, it is what is judged. Of one without a number the leak has a budget, which pass needs
// the upper limit to keep: -30 dB where none is stated; where it states no leak at all, or less
// than arithmetic can show, -80 dB, the floor: a line at the very edge of the band leaves 10^-9 of
// its power in the side lobes of the window, and float rows round at 10^-11 of the variance or
// less. Without a band the ideal asks for at most -30 dB above 1 cycle per unit, as a budget too.
//
// A density that ends at the edge with a step is smeared over it however long the lines are, so a
// band without a number is judged beyond the edge and twice the smear, on lines sixteen times as
// long; the reason says how far that is from the edge.
#include <math.h>
#include <stdio.h>

#include "score/properties/band_edges.h"
#include "score/properties/places.h"
#include "score/properties/sampling.h"
#include "spectra/psd.h"

static const double CLAIM_MARGIN_DB = 1;
// Of a line, in units. Its smear is then 4.5/128, little for a density that falls steeply at the
// edge; and the lines are short, because all of a line shares its place in the cell, so that only
// fresh lines tell more.
static const double LENGTH = 128;
static const double IDEAL_TO = 1, IDEAL_LEAK_DB = -30, FLOOR_DB = -80;

// A second look for the smear takes lines that are so many times longer.
enum { LONGER = 4 };
// A claim about a sharp edge takes lines that are so many times longer, and as many fewer.
enum { SHARP = 16 };

typedef struct direction {
    const char *above, *middle, *leak;
    const char *edges[4]; // 3 dB from, to; 30 dB from, to
} direction;

static const direction directions[] = {
    {"share_above_1_x",
     "share_0_3_to_0_7_x",
     "leak_x_db",
     {"edge_3db_low_x", "edge_3db_high_x", "edge_30db_low_x", "edge_30db_high_x"}},
    {"share_above_1_diagonal",
     "share_0_3_to_0_7_diagonal",
     "leak_diagonal_db",
     {"edge_3db_low_diagonal", "edge_3db_high_diagonal", "edge_30db_low_diagonal",
      "edge_30db_high_diagonal"}},
    {"share_above_1_radial",
     "share_0_3_to_0_7_radial",
     "leak_radial_db",
     {"edge_3db_low_radial", "edge_3db_high_radial", "edge_30db_low_radial",
      "edge_30db_high_radial"}}};

typedef enum way { ALONG_X, ALONG_DIAGONAL, RADIALLY, WAYS } way;

typedef struct band_claim {
    double from, to, leak_db;
    double margin_db; // above leak_db that still passes
    int is_sharp;     // a band without a number for its leak
    bl_score_against against;
    const char *what; // leak_db is
} band_claim;

// --- how it is measured ---

// Twice the frequencies of the band, if it reaches further than the default rates.
static double rate_for(double usual, double band_to) {
    double rate = usual;
    while (isfinite(band_to) && rate < 4 * band_to && rate < 4096)
        rate *= 2;
    return rate;
}

static bl_psd_settings settings_for(const bl_signal *signal, const bl_score_settings *settings,
                                    way which, const band_claim *claim) {
    bl_psd_settings psd = bl_psd_default_settings(which == RADIALLY ? 2 : 1);
    psd.seed = settings->seed;
    psd.threads = settings->threads;
    psd.level = settings->level;
    if (which == ALONG_DIAGONAL)
        psd.axis[1] = psd.axis[2] = 1;
    if (which == ALONG_DIAGONAL && signal->dimensions < 3)
        psd.axis[2] = 0;
    if (bl_score_on_grid(signal))
        return psd;
    if (which == RADIALLY) {
        psd.rate = rate_for(8, claim->to);
        psd.size = settings->size == BL_QUICK ? 256 : 512;
        psd.averages = (size_t)bl_size_pick(settings->size, 4, 16, 128);
    } else { // LENGTH units long, unless the band is so wide that this takes too many samples
        psd.rate = rate_for(bl_size_pick(settings->size, 8, 16, 16), claim->to);
        psd.size =
            (size_t)fmin(LENGTH * psd.rate, bl_size_pick(settings->size, 4096, 16384, 16384));
        psd.averages = (size_t)bl_size_pick(settings->size, 256, 1024, 8192);
        if (which == ALONG_DIAGONAL) { // which is not judged
            psd.averages /= 4;
        } else if (claim->is_sharp) {
            psd.size *= SHARP;
            psd.averages /= SHARP;
        }
    }
    return psd;
}

// --- numbers ---

static bl_status add_edges(bl_score_property *result, const direction *names, const bl_psd *psd,
                           double level, bl_message *message) {
    static const double below_db[] = {3, 30};
    bl_band_edges edges[2];
    bl_status status = bl_find_band_edges(psd, below_db, 2, level, edges, message);
    for (int d = 0; status == BL_OK && d < 2; d++) {
        bl_score_add(result, names->edges[2 * d], edges[d].low);
        bl_score_add(result, names->edges[2 * d + 1], edges[d].high);
    }
    return status;
}

static bl_status add_numbers(bl_score_property *result, const direction *names, bl_psd *psd,
                             bl_band_limit limit, double level, bl_message *message) {
    bl_band above = {.from = 1, .to = INFINITY}, middle = {.from = 0.3, .to = 0.7};
    psd->settings.level = level;
    if (above.from < 0.5 * psd->settings.rate) {
        bl_psd_band(psd, &above);
        bl_score_add(result, names->above, above.fraction);
    }
    if (middle.to <= 0.5 * psd->settings.rate) {
        bl_psd_band(psd, &middle);
        bl_score_add(result, names->middle, middle.fraction);
    }
    psd->settings.level = 0.5 + 0.5 * level; // two one-sided limits of this level
    if (bl_psd_has_outside(psd, &limit)) {
        bl_psd_band_limit(psd, &limit);
        bl_score_add(result, names->leak,
                     (bl_estimate){limit.leak_db, limit.lower_db, limit.upper_db, level,
                                   (double)psd->settings.averages});
    }
    return add_edges(result, names, psd, level, message);
}

// --- the verdict ---

static band_claim claim_of(const bl_signal *signal) {
    const bl_facts *facts = &signal->facts;
    if (!bl_score_states_band(signal))
        return (band_claim){0, IDEAL_TO, IDEAL_LEAK_DB, 0, 0, BL_AGAINST_IDEAL, "the ideal is"};
    band_claim claim = {isfinite(facts->band_from) ? facts->band_from : 0,
                        isnan(facts->band_to) ? INFINITY : facts->band_to,
                        facts->leak_db,
                        CLAIM_MARGIN_DB,
                        isnan(facts->leak_db) || facts->leak_db < FLOOR_DB,
                        BL_AGAINST_CLAIM,
                        "the claim is"};
    if (isnan(facts->leak_db)) {
        claim.leak_db = IDEAL_LEAK_DB;
        claim.margin_db = 0;
        claim.what = "the claim is this band without a leak, judged by the ideal leak of";
    } else if (facts->leak_db < FLOOR_DB) {
        claim.leak_db = FLOOR_DB;
        claim.margin_db = 0;
        claim.what = isinf(facts->leak_db)
                         ? "the claim is no leak at all, and the floor of window and arithmetic is"
                         : "the claim is less than the floor of window and arithmetic, which is";
    }
    return claim;
}

static bl_band_limit limit_of(const band_claim *claim, const bl_psd *psd) {
    return (bl_band_limit){.from = claim->from,
                           .to = claim->to,
                           .limit_db = claim->leak_db,
                           .guard = claim->is_sharp ? 2 * bl_psd_smear(psd) : 0};
}

// Prepares a second look, with more averages or longer lines; returns 0 where the first one settles
// the verdict. Each look has half of alpha, so that both together fail a correct signal no more
// often than alpha says.
static int prepare_second_look(const bl_psd *psd, const band_claim *claim,
                               const bl_score_settings *settings, bl_psd_settings *wanted) {
    double passes = claim->leak_db + claim->margin_db;
    bl_band_limit limit = limit_of(claim, psd);
    limit.limit_db = passes;
    limit.missed = 0.5 * settings->alpha;
    if (!(psd->variance.value > 0) || !bl_psd_has_outside(psd, &limit))
        return 0;
    bl_psd_band_limit(psd, &limit);
    if (limit.upper_db <= passes || limit.lower_db > claim->leak_db)
        return 0;
    size_t averages = psd->settings.averages;
    size_t most = averages * (size_t)bl_size_pick(settings->size, 16, 4, 4);
    size_t needed = limit.needed_averages < most ? 2 * limit.needed_averages : most;
    needed = needed > 4 * averages ? needed : 4 * averages;
    wanted->averages = needed < most ? needed : most;
    if (limit.needed_size) {
        wanted->averages = averages * (size_t)bl_size_pick(settings->size, 4, 1, 1);
        wanted->size *= LONGER;
    }
    return 1;
}

// Replaces the spectrum of a first look by that of a second one where the first settles nothing. A
// grid has no more to show.
static bl_status look_again(const bl_signal *signal, const band_claim *claim,
                            const bl_score_settings *settings, bl_psd *psd, bl_message *message) {
    bl_psd_settings wanted = psd->settings;
    if (bl_score_on_grid(signal) || !prepare_second_look(psd, claim, settings, &wanted))
        return BL_OK;
    bl_psd_free(psd);
    return bl_psd_measure(signal, &wanted, psd, message);
}

static void judge_leak(bl_score_property *result, const bl_psd *psd, const band_claim *claim,
                       bl_band_limit *limit) {
    double passes = claim->leak_db + claim->margin_db;
    bl_verdict verdict = limit->lower_db > claim->leak_db ? BL_VERDICT_FAIL
                         : limit->upper_db <= passes      ? BL_VERDICT_PASS
                                                          : BL_VERDICT_INCONCLUSIVE;
    char settle[80] = "", edge[40] = "";
    if (limit->guard > 0)
        snprintf(edge, sizeof edge, ", %.2g beyond its edges,", limit->guard);
    if (verdict == BL_VERDICT_INCONCLUSIVE && limit->needed_size)
        snprintf(settle, sizeof settle, "; %.4g dB lie within the smear of the edges",
                 limit->edge_db);
    else if (verdict == BL_VERDICT_INCONCLUSIVE && claim->margin_db > 0)
        snprintf(settle, sizeof settle, "; it passes below %.4g dB: take more averages", passes);
    else if (verdict == BL_VERDICT_INCONCLUSIVE && limit->needed_averages)
        snprintf(settle, sizeof settle, "; about %zu averages would settle it",
                 limit->needed_averages);
    snprintf(result->cell, sizeof result->cell, isfinite(limit->leak_db) ? "%.1f dB" : "none",
             limit->leak_db);
    bl_score_judge(result, verdict, claim->against,
                   "%.4g dB of the variance outside of %.4g to %.4g cycles per unit%s along x "
                   "(%.4g to %.4g from %zu averages), %s %.4g dB%s",
                   limit->leak_db, limit->from, limit->to, edge, limit->lower_db, limit->upper_db,
                   psd->settings.averages, claim->what, claim->leak_db, settle);
}

static void judge(bl_score_property *result, bl_psd *psd, const band_claim *claim, double alpha) {
    bl_band_limit limit = limit_of(claim, psd);
    if (!(psd->variance.value > 0)) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, claim->against,
                       "it is constant: there is no variance to judge");
        return;
    }
    if (!bl_psd_has_outside(psd, &limit) || limit.from >= 0.5 * psd->settings.rate) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, claim->against,
                       "its samples hold frequencies up to %g cycles per unit, so nothing is left "
                       "to judge outside of %g to %g; of an image spacing= tells its scale",
                       0.5 * psd->settings.rate, limit.from, limit.to);
        return;
    }
    limit.missed = alpha;
    bl_psd_band_limit(psd, &limit);
    judge_leak(result, psd, claim, &limit);
}

static int has_way(const bl_signal *signal, way which) {
    if (which == ALONG_X)
        return 1;
    return signal->dimensions > 1 && !(which == ALONG_DIAGONAL && bl_score_on_grid(signal));
}

static bl_status measure(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message) {
    // What is judged is the measurement alone: the closed form of long lines would take longer.
    bl_signal plain = *subject->signal;
    plain.closed_form = 0;
    const bl_signal *signal = &plain;
    band_claim claim = claim_of(signal);
    bl_score_judge(result, BL_VERDICT_NOT_RUN, claim.against, "nothing was measured");
    if (!bl_score_varies(signal, settings, result))
        return BL_OK;
    for (way which = ALONG_X; which < WAYS; which++) {
        bl_message own = {""};
        bl_psd psd;
        if (!has_way(signal, which))
            continue;
        bl_psd_settings wanted = settings_for(signal, settings, which, &claim);
        bl_status status = bl_psd_measure(signal, &wanted, &psd, &own);
        if (status == BL_OK && which == ALONG_X)
            status = look_again(signal, &claim, settings, &psd, &own);
        if (status == BL_DEVICE)
            return bl_report(message, status, "%s", own.text);
        if (status != BL_OK && which == ALONG_X) {
            bl_score_judge(result, BL_VERDICT_NOT_RUN, claim.against, "%s", own.text);
            return BL_OK;
        }
        if (status != BL_OK) // a grid without squares, say; the line has been judged
            continue;
        bl_score_note_detail(result, signal, &psd.settings);
        bl_band_limit limit = limit_of(&claim, &psd);
        if (psd.variance.value > 0)
            status = add_numbers(result, &directions[which], &psd, limit, settings->level, message);
        if (which == ALONG_X)
            judge(result, &psd, &claim, 0.5 * settings->alpha);
        bl_psd_free(&psd);
        if (status == BL_DEVICE)
            return status;
    }
    return BL_OK;
}

BL_PROPERTY_DESCRIPTOR(band) = {
    .name = "band",
    .title = "band",
    .paper = "peachey2003, p. 68",
    .entry = "the leak outside of the band along x, dB of the variance",
    .question = "Is it limited to a band, and how much of its variance lies outside?",
    .measure = measure,
};
