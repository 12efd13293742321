// SPDX-License-Identifier: MIT
#include "score/advise.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "score/trade_signals.h"
#include "noises/octaves/octaves.h"
#include "textures/texture.h"

// --- what the scene needs -----------------------------------------------------------------------

static double width_along(const bl_sight *sight, int axis) {
    return bl_sample_width(BL_WIDTH_MAXIMUM, sight->across[axis], sight->down[axis], 0, 0);
}

static void widen(bl_scene_needs *needs, const bl_sight *sight, unsigned dimensions) {
    for (unsigned a = 0; a < dimensions; a++) {
        double width = width_along(sight, (int)a);
        needs->least[a] = fmin(needs->least[a], sight->at[a]);
        needs->most[a] = fmax(needs->most[a], sight->at[a]);
        if (!(width > 0))
            continue;
        needs->least_width = fmin(needs->least_width, width); // of NAN and a number, the number
        needs->most_width = fmax(needs->most_width, width);
    }
}

// Coordinates are sums of products in double: what is constant varies by their rounding at most.
static int varies(double least, double most) {
    return most - least > 1e-9 * fmax(fabs(least), fabs(most));
}

bl_scene_needs bl_scene_needs_find(const bl_signal *signal, const bl_view *view) {
    bl_scene_needs needs = {.least_width = NAN, .most_width = NAN};
    for (int a = 0; a < BL_AXES; a++)
        needs.least[a] = INFINITY, needs.most[a] = -INFINITY;
    for (size_t p = 0; p < view->width * view->height; p++) {
        bl_sight sight;
        if (bl_view_see(view, (double)(p % view->width) + 0.5, (double)(p / view->width) + 0.5,
                        &sight))
            widen(&needs, &sight, signal->dimensions);
    }
    for (unsigned a = 0; a < signal->dimensions; a++)
        needs.varies[a] = varies(needs.least[a], needs.most[a]);
    needs.highest_frequency = 0.5 / needs.least_width;
    if (bl_octaves_is_sum(signal)) {
        const bl_octaves_plan *plan =
            &((const bl_octaves_settings *)signal->parameters)->octaves->plan;
        needs.octaves = plan->count;
        for (unsigned i = 0; i < plan->count; i++)
            needs.octaves_seen += plan->frequency[i] < needs.highest_frequency;
    }
    return needs;
}

// --- errors -------------------------------------------------------------------------------------

static double error_at(const bl_alias_result *alias, size_t row, size_t pixel) {
    return bl_colour_component(&alias->rows[row].image[3 * pixel], 0) -
           bl_colour_component(&alias->reference.rgb[3 * pixel], 0);
}

static bl_worst_pixel worst_of(const bl_alias_result *alias, size_t row, const bl_view *view,
                               unsigned dimensions) {
    bl_worst_pixel worst = {.width = NAN};
    bl_sight sight;
    for (size_t p = 0; p < view->width * view->height; p++) {
        double error = error_at(alias, row, p);
        if (fabs(error) > fabs(worst.error))
            worst = (bl_worst_pixel){p % view->width, p / view->width, error, NAN};
    }
    if (bl_view_see(view, (double)worst.x + 0.5, (double)worst.y + 0.5, &sight))
        for (unsigned a = 0; a < dimensions; a++)
            worst.width = fmax(worst.width, width_along(&sight, (int)a));
    return worst;
}

static bl_estimate largest_of(const bl_alias_result *alias, const bl_worst_pixel *worst) {
    size_t pixel = worst->y * alias->reference.width + worst->x;
    double size = fabs(worst->error), bound = 2 * alias->reference.error[pixel];
    return (bl_estimate){size, fmax(0, size - bound), size + bound, 0.95, 1};
}

// --- the choice ---------------------------------------------------------------------------------

static int is_better(const bl_advice *advice, size_t row, size_t than) {
    return than == SIZE_MAX || advice->error[row].value < advice->error[than].value;
}

static int is_cheaper(const bl_advice *advice, size_t row, size_t than) {
    return than == SIZE_MAX ||
           advice->alias.rows[row].ns_per_sample < advice->alias.rows[than].ns_per_sample;
}

void bl_advice_choose(bl_advice *advice, double tolerance) {
    size_t within = SIZE_MAX, best = SIZE_MAX;
    int maybe = 0;
    for (size_t i = 0; i < advice->alias.count; i++) {
        if (advice->error[i].upper <= tolerance && is_cheaper(advice, i, within))
            within = i;
        if (is_better(advice, i, best))
            best = i;
        maybe |= advice->error[i].lower <= tolerance;
    }
    advice->verdict = within != SIZE_MAX ? BL_VERDICT_PASS
                      : maybe            ? BL_VERDICT_INCONCLUSIVE
                                         : BL_VERDICT_FAIL;
    if (bl_alias_is_constant(
            &advice->alias)) // all are right, for what they do elsewhere is not seen
        advice->verdict = BL_VERDICT_INCONCLUSIVE;
    advice->chosen = within != SIZE_MAX ? within : best;
    advice->cheaper = SIZE_MAX;
    for (size_t i = 0; i < advice->alias.count; i++)
        if (i != advice->chosen && is_cheaper(advice, i, advice->chosen) &&
            (advice->cheaper == SIZE_MAX || is_cheaper(advice, advice->cheaper, i)))
            advice->cheaper = i;
}

bl_advise_settings bl_advise_settings_of_size(bl_size size) {
    bl_advise_settings settings = {.tolerance = 1.0 / 255, .alias = bl_alias_default_settings()};
    bl_alias_settings *alias = &settings.alias;
    alias->frames = 0;
    alias->rounds = (unsigned)bl_size_pick(size, 9, 25, 101);
    alias->turn_seconds = bl_size_pick(size, 5e-4, 2e-3, 2e-3);
    alias->replicates = size == BL_FULL ? 8 : 2;
    alias->most_samples = (uint32_t)bl_size_pick(size, 256, 1024, 1 << 14);
    return settings;
}

bl_status bl_advise(const bl_signal *signal, const bl_view *view, const char *const *methods,
                    size_t count, const bl_advise_settings *settings, bl_advice *advice,
                    bl_message *message) {
    *advice = (bl_advice){0};
    if (!(settings->tolerance > 0))
        return bl_report(message, BL_USAGE, "a tolerance is a number above 0, as 1/255, not %g",
                         settings->tolerance);
    bl_status status =
        bl_alias_measure(signal, view, methods, count, &settings->alias, &advice->alias, message);
    if (status != BL_OK)
        return status;
    advice->error = calloc(count, sizeof *advice->error);
    advice->worst = calloc(count, sizeof *advice->worst);
    if (!advice->error || !advice->worst) {
        bl_advice_free(advice);
        return bl_report(message, BL_DEVICE, "out of memory for the advice");
    }
    for (size_t i = 0; i < count; i++) {
        advice->worst[i] = worst_of(&advice->alias, i, view, signal->dimensions);
        advice->error[i] = settings->largest ? largest_of(&advice->alias, &advice->worst[i])
                                             : bl_root_estimate(advice->alias.rows[i].mse);
    }
    advice->needs = bl_scene_needs_find(signal, view);
    bl_advice_choose(advice, settings->tolerance);
    return BL_OK;
}

void bl_advice_free(bl_advice *advice) {
    bl_alias_free(&advice->alias);
    free(advice->error);
    free(advice->worst);
    advice->error = NULL;
    advice->worst = NULL;
}
