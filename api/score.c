// SPDX-License-Identifier: MIT
//
// Chapter 5: the scorecard; chapter 7: cost against error.
#include "api/api.h"

#include <stdlib.h>

#include "score/score.h"
#include "score/trade.h"

// --- the scorecard ---

// Which properties are asked for, as bits.
static bl_status read_names(const char *const *only, uint64_t *wanted, bandlimit_message *message) {
    *wanted = only ? 0 : (UINT64_C(1) << bl_property_count()) - 1;
    for (; only && *only; only++) {
        size_t i = bl_property_index(*only);
        if (i == bl_property_count())
            return bl_registry_report(&bl_properties, *only, NULL, bl_api_message(message));
        *wanted |= UINT64_C(1) << i;
    }
    return BL_OK;
}

static bl_status measure_score(const bl_signal *signal, const bandlimit_score_settings *own,
                               uint64_t wanted, bl_score *score, bl_message *message) {
    bl_score_subject subject;
    bl_score_settings settings = bl_score_default_settings();
    if (own->alpha != 0)
        settings.alpha = own->alpha;
    settings.size = bl_api_size(own->effort);
    settings.seed = BL_API_SEED(*own);
    settings.level = BL_API_LEVEL(*own);
    settings.threads = own->threads;
    bl_status status = bl_score_subject_open(signal, signal->text, BL_ISA_BEST, &subject, message);
    if (status != BL_OK)
        return status;
    status = bl_score_measure(&subject, &settings, wanted, score, message);
    bl_score_subject_close(&subject);
    // The values of a source that has failed are no numbers, and no property is to judge them.
    if (status == BL_OK && bl_signal_complaint(signal, NULL) == BL_DEVICE)
        status = bl_signal_complaint(signal, message);
    return status;
}

bandlimit_status bandlimit_score_measure(const bandlimit_signal *signal,
                                         const bandlimit_score_settings *settings,
                                         bandlimit_score *score, bandlimit_message *message) {
    bandlimit_score_settings own;
    uint64_t wanted;
    bl_status status = BL_API_CHECK(score, bandlimit_score, message);
    if (status == BL_OK)
        status = BL_API_TAKE(settings, &own, bandlimit_score_settings, message);
    if (status == BL_OK)
        status = read_names(own.only, &wanted, message);
    if (status != BL_OK)
        return (bandlimit_status)status;
    bl_score *room = bl_api_room(sizeof *room, message);
    status = room
                 ? measure_score(bl_api_signal(signal), &own, wanted, room, bl_api_message(message))
                 : BL_DEVICE;
    if (status == BL_OK) {
        score->count = bl_property_count();
        score->verdict = (bandlimit_verdict)bl_score_verdict(room, 1, own.strict);
        score->owned = room;
    }
    return bl_api_end(status, signal, room, message);
}

bandlimit_status bandlimit_property_at(const bandlimit_score *score, size_t index,
                                       bandlimit_property *property, bandlimit_message *message) {
    const bl_score *room = score->owned;
    bl_status status = BL_API_CHECK(property, bandlimit_property, message);
    if (status == BL_OK)
        status = bl_api_index(index, score->count, "property", message);
    if (status != BL_OK)
        return (bandlimit_status)status;
    const bl_score_property *own = &room->properties[index];
    *property = (bandlimit_property){.bytes = sizeof *property,
                                     .name = bl_property_at(index)->name,
                                     .verdict = (bandlimit_verdict)own->verdict,
                                     .against_claim = own->against == BL_AGAINST_CLAIM,
                                     .cell = own->cell,
                                     .reason = own->reason,
                                     .numbers = own->count};
    return BANDLIMIT_OK;
}

const char *bandlimit_property_number(const bandlimit_score *score, size_t index, size_t number,
                                      bandlimit_estimate *estimate) {
    const bl_score *room = score->owned;
    if (index >= score->count || number >= room->properties[index].count)
        return NULL;
    const bl_score_number *own = &room->properties[index].numbers[number];
    *estimate = bl_api_estimate(&own->estimate);
    return own->name;
}

void bandlimit_score_free(bandlimit_score *score) {
    free(score->owned);
    BANDLIMIT_INIT(score);
}

// --- trades ---

typedef struct trade_room {
    const bl_trade *trade;
    bl_alternatives alternatives;
} trade_room;

static bl_status find_trade(const bl_signal *signal, const char *name, const bl_trade **trade,
                            bl_message *message) {
    *trade = bl_trade_find(name);
    if (!*trade)
        return bl_registry_report(&bl_trades, name, NULL, message);
    if ((*trade)->applies(signal, signal ? NULL : "spectrum"))
        return BL_OK;
    return bl_report(message, BL_MISMATCH, "'%s' has no choice that '%s' trades",
                     signal ? signal->text : "no signal", name);
}

bandlimit_status bandlimit_trade_measure(const bandlimit_signal *signal, const char *name,
                                         const bandlimit_trade_settings *settings,
                                         bandlimit_trade *trade, bandlimit_message *message) {
    bandlimit_trade_settings own;
    const bl_trade *found;
    bl_status status = BL_API_CHECK(trade, bandlimit_trade, message);
    if (status == BL_OK)
        status = BL_API_TAKE(settings, &own, bandlimit_trade_settings, message);
    if (status == BL_OK)
        status = find_trade(bl_api_signal(signal), name, &found, bl_api_message(message));
    if (status != BL_OK)
        return (bandlimit_status)status;
    const bl_trade_settings used = {.seed = BL_API_SEED(own),
                                    .threads = own.threads,
                                    .size = bl_api_size(own.effort),
                                    .view = own.view};
    trade_room *room = bl_api_room(sizeof *room, message);
    status = room ? bl_trade_run(found, bl_api_signal(signal), &used, &room->alternatives,
                                 bl_api_message(message))
                  : BL_DEVICE;
    if (status == BL_OK) {
        room->trade = found;
        *trade = (bandlimit_trade){.bytes = sizeof *trade,
                                   .count = room->alternatives.count,
                                   .error_name = found->error_name,
                                   .error_unit = found->error_unit,
                                   .sample = found->sample,
                                   .owned = room};
    }
    return bl_api_end(status, signal, room, message);
}

bandlimit_status bandlimit_alternative_at(const bandlimit_trade *trade, size_t index,
                                          bandlimit_alternative *alternative,
                                          bandlimit_message *message) {
    const trade_room *room = trade->owned;
    bl_status status = BL_API_CHECK(alternative, bandlimit_alternative, message);
    if (status == BL_OK)
        status = bl_api_index(index, trade->count, "alternative", message);
    if (status != BL_OK)
        return (bandlimit_status)status;
    const bl_alternative *own = &room->alternatives.list[index];
    *alternative = (bandlimit_alternative){.bytes = sizeof *alternative,
                                           .name = own->name,
                                           .error = bl_api_estimate(&own->error),
                                           .largest = own->largest,
                                           .ns = own->ns,
                                           .ns_lowest = own->ns_lowest,
                                           .ns_highest = own->ns_highest,
                                           .is_on_front = own->front};
    return BANDLIMIT_OK;
}

static void close_trade(trade_room *room) {
    bl_trade_close(room->trade, &room->alternatives);
}

void bandlimit_trade_free(bandlimit_trade *trade) {
    BL_API_RELEASE(trade, close_trade);
}
