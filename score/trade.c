// SPDX-License-Identifier: MIT
#include "score/trade.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"

// --- the list -----------------------------------------------------------------------------------

bl_alternative *bl_alternatives_add(bl_alternatives *alternatives, const char *name) {
    bl_alternative *list =
        realloc(alternatives->list, (alternatives->count + 1) * sizeof *alternatives->list);
    if (!list)
        return NULL;
    alternatives->list = list;
    bl_alternative *added = &list[alternatives->count];
    *added = (bl_alternative){.name = strdup(name), .largest = NAN};
    if (!added->name)
        return NULL;
    alternatives->count++;
    return added;
}

void bl_alternatives_free(bl_alternatives *alternatives) {
    for (size_t i = 0; i < alternatives->count; i++)
        free(alternatives->list[i].name);
    free(alternatives->list);
    alternatives->list = NULL;
    alternatives->count = 0;
}

// --- times --------------------------------------------------------------------------------------

enum { FIRST_TURNS = 15, MOST_TURNS = 101 };
static const double spread_wanted = 0.1;

static size_t batch_of(const bl_alternative *alternative) {
    return alternative->batch ? alternative->batch : 1;
}

static void run_batch(void *user) {
    const bl_alternative *alternative = user;
    alternative->work(alternative->state, batch_of(alternative));
}

static int is_spread_known(const bl_time *times, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!(times[i].upper - times[i].lower <= spread_wanted * times[i].median))
            return 0;
    return 1;
}

bl_status bl_alternatives_time(bl_alternatives *alternatives, double turn_seconds,
                               bl_message *message) {
    bl_work *works = calloc(alternatives->count + 1, sizeof *works);
    bl_time *times = calloc(alternatives->count + 1, sizeof *times);
    size_t count = 0;
    for (size_t i = 0; works && i < alternatives->count; i++)
        if (alternatives->list[i].work)
            works[count++] = (bl_work){.run = run_batch, .user = &alternatives->list[i]};
    int turns = FIRST_TURNS, known = count == 0;
    while (works && times && !known) {
        bl_time_by_turns(works, count, turns, turn_seconds, times);
        known = turns >= MOST_TURNS || is_spread_known(times, count);
        turns = 2 * turns < MOST_TURNS ? 2 * turns : MOST_TURNS;
    }
    for (size_t i = 0, k = 0; works && times && i < alternatives->count; i++) {
        bl_alternative *a = &alternatives->list[i];
        if (!a->work)
            continue;
        double samples = (double)batch_of(a);
        a->ns = times[k].median / samples;
        a->ns_lowest = times[k].lower / samples;
        a->ns_highest = times[k++].upper / samples;
    }
    bl_status status =
        works && times ? BL_OK : bl_report(message, BL_DEVICE, "out of memory for the clock");
    free(works);
    free(times);
    return status;
}

// --- the front ----------------------------------------------------------------------------------

static int beats(const bl_alternative *b, const bl_alternative *a) {
    return b->ns <= a->ns && b->error.value <= a->error.value &&
           (b->ns_highest < a->ns_lowest || b->error.upper < a->error.lower);
}

void bl_alternatives_mark(bl_alternatives *alternatives) {
    for (size_t i = 0; i < alternatives->count; i++) {
        bl_alternative *a = &alternatives->list[i];
        a->front = isfinite(a->ns) && isfinite(a->error.value);
        for (size_t k = 0; k < alternatives->count; k++)
            if (beats(&alternatives->list[k], a))
                a->front = 0;
    }
}

// --- all of it ----------------------------------------------------------------------------------

bl_status bl_trade_run(const bl_trade *trade, const bl_signal *subject,
                       const bl_trade_settings *settings, bl_alternatives *alternatives,
                       bl_message *message) {
    *alternatives = (bl_alternatives){0};
    bl_status status = trade->open(subject, settings, alternatives, message);
    if (status == BL_OK)
        status = bl_alternatives_time(alternatives, bl_size_pick(settings->size, 2e-4, 2e-3, 1e-2),
                                      message);
    if (status == BL_OK)
        bl_alternatives_mark(alternatives);
    else
        bl_trade_close(trade, alternatives);
    return status;
}

void bl_trade_close(const bl_trade *trade, bl_alternatives *alternatives) {
    trade->close(alternatives);
    bl_alternatives_free(alternatives);
    alternatives->own = NULL;
}
