// SPDX-License-Identifier: MIT
//
// Seeds: every bit of the seed counts, and signals of related seeds are unrelated.
//
// Changes of a seed are each of its 64 bits flipped, 1, 2 and 2^32 added, its double and triple,
// its complement, its negative and its halves exchanged. A change must alter the value at half of
// the places or more. And the changed signal must be unrelated to the original, at the same places,
// at places one and two cells away along each axis, and one cell along several axes at once (a seed
// that is added to a cell number shifts the noise).
//
// Two steps. A look at a few seeds, half of them small ones as people use them, tells which changes
// and shifts may be related: those whose correlation is large. It decides nothing. Then each
// of these, the one that stood out most for every change, is tested with many fresh seeds.
//
// Unrelated seeds may correlate: they share what the place alone decides, such as a mean that
// depends on the phase in the cell, and over the few entries of a table any two do by chance.
// Therefore each pair is compared with a control, a seed drawn at random. With u the value of s at
// a place (standardised, cut off at 3), v and v' those of the changed one and of the control, the
// mean of u (v - v') over the places is symmetric about 0 if the change is as good as a random
// seed. Student's t over the seeds s tests it; half of alpha is shared by all changes and shifts,
// whether they are tested or not, and half is that of the pairs of small seeds (seed_pairs.h).
//
// A relation of 0.2 in one bit stands out in the look as a rule, and is 12 standard errors in the
// test, whose limit is 7. Of a signal that hardly varies less can be told; where the pairs of
// random seeds correlate so much that half of the variance is no sign, nothing is said.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/grid.h"
#include "core/plain.h"
#include "score/properties/seed_pairs.h"

enum { BITS = 64, CHANGES = BITS + 8, SHIFTS = 1 + 4 * BL_AXES + 72, PLACES = 128, MOVED = 24 };
enum { TESTED_SEEDS = 256, TESTED_PLACES = 32 };

// A correlation of the look that is tested: at the same places, and at shifted ones, which are
// fewer, for a noise that is shifted is the same.
static const double TOLD = 0.1, TOLD_MOVED = 0.4, MOST_TOLD = 0.5;

static uint64_t changed_seed(uint64_t seed, size_t change) {
    switch (change < BITS ? 0 : change - BITS + 1) {
    case 0:
        return seed ^ UINT64_C(1) << change;
    case 1:
        return seed + 1;
    case 2:
        return seed + 2;
    case 3:
        return seed + (UINT64_C(1) << 32);
    case 4:
        return 2 * seed;
    case 5:
        return 3 * seed;
    case 6:
        return ~seed;
    case 7:
        return 0 - seed;
    default:
        return seed << 32 | seed >> 32;
    }
}

static void tell_change(size_t change, char *text, size_t size) {
    static const char *const words[CHANGES - BITS] = {
        "differ by 1",           "differ by 2",           "differ by 2^32",
        "are double each other", "are triple each other", "are each other's complement",
        "differ by the sign",    "have exchanged halves"};
    if (change < BITS)
        snprintf(text, size, "differ in bit %zu", change);
    else
        snprintf(text, size, "%s", words[change - BITS]);
}

// Where the noise is looked for: at the same place, one and two cells along each axis, and one cell
// along several axes at once.
typedef struct shifts {
    double by[SHIFTS][BL_AXES]; // cells
    size_t count;
} shifts;

static shifts shifts_of(unsigned dimensions) {
    shifts all = {.count = 1};
    unsigned codes = 1;
    for (unsigned a = 0; a < dimensions; a++) {
        codes *= 3;
        for (int step = -2; step <= 2; step++)
            if (step)
                all.by[all.count++][a] = step;
    }
    for (unsigned code = 0; code < codes; code++) {
        unsigned rest = code, axes = 0;
        double by[BL_AXES] = {0};
        for (unsigned a = 0; a < dimensions; a++, rest /= 3) {
            by[a] = (double)(rest % 3) - 1;
            axes += by[a] != 0;
        }
        if (axes > 1)
            memcpy(all.by[all.count++], by, sizeof by);
    }
    return all;
}

// NaN stays NaN.
static double cut(double x) {
    return x > 3 ? 3 : x < -3 ? -3 : x;
}

// The standardised values of a signal at places that are shifted by some cells.
static void sample_at(const bl_signal *signal, const bl_score_look *look, const double by[BL_AXES],
                      size_t places, double place[BL_AXES][PLACES], double *out) {
    double column[BL_AXES][PLACES];
    float value[PLACES];
    for (size_t a = 0; a < BL_AXES; a++)
        for (size_t i = 0; i < places; i++)
            column[a][i] = place[a][i] + look->cell * by[a];
    bl_signal_points(signal, BL_COLUMNS(column), places, value);
    for (size_t i = 0; i < places; i++)
        out[i] = cut(((double)value[i] - look->mean) / look->deviation);
}

// The same of a seed, at one shift. Returns 0 where the signal could not be made.
static int sample(const bl_signal *signal, const bl_score_look *look, uint64_t seed,
                  const double by[BL_AXES], size_t places, double place[BL_AXES][PLACES],
                  double *out) {
    bl_signal *fresh = bl_signal_reseed(signal, seed);
    if (fresh)
        sample_at(fresh, look, by, places, place, out);
    bl_signal_free(fresh);
    return fresh != NULL;
}

static void choose_places(const bl_score_look *look, bl_random *random, size_t places,
                          double place[BL_AXES][PLACES]) {
    for (size_t a = 0; a < BL_AXES; a++)
        for (size_t i = 0; i < places; i++)
            place[a][i] = look->cell * 16384 * (bl_random_unit(random) - 0.5);
}

// --- the look -----------------------------------------------------------------------------------

// Sums over the seeds of the look.
typedef struct looks {
    double product[CHANGES][SHIFTS], square[CHANGES][SHIFTS], own[SHIFTS];
    double changed[CHANGES]; // share of the places whose value differs
    shifts shifts;
    size_t seeds;
    int is_missing; // a signal could not be made
} looks;

static size_t places_at(size_t shift) {
    return shift ? MOVED : PLACES;
}

// The seeds of the look: the signal's own, small ones and large ones. 0 has no double, no bits to
// exchange and no sign.
static uint64_t seed_of_look(const bl_signal *signal, size_t index, bl_random *random) {
    uint64_t seed = bl_random_bits(random);
    if (index == 0)
        seed = bl_signal_seed(signal);
    else if (index % 2)
        seed = 1 + seed % 255;
    return seed ? seed : 1;
}

static void add_change(const bl_signal *signal, const bl_score_look *look, size_t change,
                       double place[BL_AXES][PLACES], const double *original, looks *all) {
    double changed[PLACES];
    for (size_t shift = 0; shift < all->shifts.count; shift++) {
        sample_at(signal, look, all->shifts.by[shift], places_at(shift), place, changed);
        for (size_t i = 0; i < places_at(shift); i++) {
            all->product[change][shift] += original[i] * changed[i];
            all->square[change][shift] += changed[i] * changed[i];
            all->changed[change] += shift == 0 && changed[i] != original[i];
        }
    }
}

static void take_look(const bl_signal *signal, const bl_score_look *look, size_t index,
                      bl_random random, looks *all) {
    double place[BL_AXES][PLACES], original[PLACES];
    uint64_t seed = seed_of_look(signal, index, &random);
    choose_places(look, &random, PLACES, place);
    all->is_missing |= !sample(signal, look, seed, all->shifts.by[0], PLACES, place, original);
    for (size_t shift = 0; shift < all->shifts.count && !all->is_missing; shift++)
        for (size_t i = 0; i < places_at(shift); i++)
            all->own[shift] += original[i] * original[i];
    for (size_t c = 0; c < CHANGES && !all->is_missing; c++) {
        bl_signal *fresh = bl_signal_reseed(signal, changed_seed(seed, c));
        all->is_missing = !fresh;
        if (fresh)
            add_change(fresh, look, c, place, original, all);
        bl_signal_free(fresh);
    }
}

// The correlation of a change at a shift.
static double correlation(const looks *all, size_t change, size_t shift) {
    return all->product[change][shift] / sqrt(all->own[shift] * all->square[change][shift]);
}

// --- the test -----------------------------------------------------------------------------------

typedef struct test {
    size_t change, shift;
    double t;
    bl_estimate correlation; // at the level that is shown
    int is_missing;
} test;

static void run_test(const bl_signal *signal, const bl_score_look *look,
                     const bl_score_settings *settings, const double by[BL_AXES], test *tried) {
    double contrast[TESTED_SEEDS], product[TESTED_SEEDS], power[TESTED_SEEDS];
    int is_missing = 0;
#pragma omp parallel for num_threads(bl_thread_count(settings->threads)) schedule(dynamic)         \
    reduction(|                                                                                    \
              : is_missing)
    for (size_t j = 0; j < TESTED_SEEDS; j++) {
        double place[BL_AXES][PLACES], u[PLACES], v[PLACES], control[PLACES];
        const size_t places = TESTED_PLACES;
        bl_random random = bl_score_random(
            settings, "seeds", 1024 + (tried->change * SHIFTS + tried->shift) * TESTED_SEEDS + j);
        uint64_t seed = bl_random_bits(&random), other = bl_random_bits(&random);
        choose_places(look, &random, places, place);
        contrast[j] = product[j] = power[j] = 0;
        const double here[BL_AXES] = {0};
        if (!sample(signal, look, seed, here, places, place, u) ||
            !sample(signal, look, changed_seed(seed, tried->change), by, places, place, v) ||
            !sample(signal, look, other, by, places, place, control)) {
            is_missing = 1;
            continue;
        }
        for (size_t i = 0; i < places; i++) {
            contrast[j] += u[i] * (v[i] - control[i]) / (double)places;
            product[j] += u[i] * v[i];
            power[j] += 0.5 * (u[i] * u[i] + v[i] * v[i]);
        }
    }
    tried->is_missing = is_missing;
    tried->t = bl_score_t(contrast, TESTED_SEEDS, 1);
    tried->correlation = bl_ratio_estimate(product, power, TESTED_SEEDS, settings->level);
}

// The shift at which each change stands out most, tested where that is more than chance does.
static bl_status test_changes(const bl_signal *signal, const bl_score_look *look,
                              const bl_score_settings *settings, const looks *all, test *worst,
                              size_t *tested) {
    *worst = (test){0};
    *tested = 0;
    for (size_t c = 0; c < CHANGES; c++) {
        size_t most = 0; // the shift at which it is farthest beyond its limit
        double excess = fabs(correlation(all, c, 0)) / TOLD;
        for (size_t shift = 1; shift < all->shifts.count; shift++)
            if (fabs(correlation(all, c, shift)) / TOLD_MOVED > excess) {
                excess = fabs(correlation(all, c, shift)) / TOLD_MOVED;
                most = shift;
            }
        if (!(excess > 1))
            continue;
        test tried = {.change = c, .shift = most};
        run_test(signal, look, settings, all->shifts.by[most], &tried);
        if (tried.is_missing)
            return BL_DEVICE;
        if (!(fabs(tried.t) <= fabs(worst->t)))
            *worst = tried;
        ++*tested;
    }
    return BL_OK;
}

// --- the verdict --------------------------------------------------------------------------------

static void judge_dead(const looks *all, bl_score_property *result) {
    size_t dead = 0, first = 0;
    double least = 1;
    for (size_t c = 0; c < CHANGES; c++) {
        double share = all->changed[c] / (double)(all->seeds * PLACES);
        least = fmin(least, share);
        if (c < BITS && share < 0.5 && dead++ == 0)
            first = c;
    }
    bl_score_add_seen(result, "dead_bits", (double)dead);
    bl_score_add_seen(result, "least_share_changed", least);
    if (!dead)
        return;
    snprintf(result->cell, sizeof result->cell, "%u dead", (unsigned)dead);
    bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_IDEAL,
                   "%zu bit%s of the seed do%s nothing at most places, the first is bit %zu", dead,
                   bl_plural(dead), dead == 1 ? "es" : "", first);
}

// "(1, -1, 0) cells away", or at the same places.
static void tell_shift(const looks *all, size_t index, unsigned dimensions, char *text,
                       size_t size) {
    size_t used = (size_t)snprintf(text, size, "at the same places");
    for (unsigned a = 0; a < dimensions && index && used < size; a++) {
        used = a ? used : 0;
        used +=
            (size_t)snprintf(text + used, size - used, "%s%+g%s", a ? ", " : "(",
                             all->shifts.by[index][a], a + 1 < dimensions ? "" : ") cells away");
    }
}

static void judge(const looks *all, const test *worst, double limit, const bl_seed_pairs *pairs,
                  unsigned dimensions, bl_score_property *result) {
    char change[48], shift[64];
    double largest =
        fmax(fabs(pairs->correlation), worst->t != 0 ? fabs(worst->correlation.value) : 0);
    tell_change(worst->change, change, sizeof change);
    tell_shift(all, worst->shift, dimensions, shift, sizeof shift);
    snprintf(result->cell, sizeof result->cell, "|r| %.2g", largest);
    if (isnan(worst->t) || isnan(pairs->correlation))
        bl_score_not_finite(result);
    else if (fabs(worst->t) > limit)
        bl_score_judge(
            result, BL_VERDICT_FAIL, BL_AGAINST_IDEAL,
            "seeds that %s are related: r = %.3f (%.3f to %.3f) %s, %.1f standard errors", change,
            worst->correlation.value, worst->correlation.lower, worst->correlation.upper, shift,
            worst->t);
    else if (fabs(pairs->correlation) > pairs->limit)
        bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_IDEAL,
                       "the seeds %llu and %llu are related: r = %.3f at %zu places, where random "
                       "seeds have a deviation of %.3f",
                       (unsigned long long)pairs->seeds[0], (unsigned long long)pairs->seeds[1],
                       pairs->correlation, pairs->places, pairs->deviation);
    else if (pairs->limit > MOST_TOLD)
        bl_score_judge(result, BL_VERDICT_INCONCLUSIVE, BL_AGAINST_IDEAL,
                       "all 64 bits count; a relation of two seeds below %.2g of the variance "
                       "cannot be told from chance at %zu places",
                       pairs->limit, pairs->places);
    else
        bl_score_judge(result, BL_VERDICT_PASS, BL_AGAINST_IDEAL,
                       "all 64 bits count, and related seeds give unrelated signals: |r| up to "
                       "%.3f among the seeds 0 to 31, at %zu places",
                       fabs(pairs->correlation), pairs->places);
}

static bl_status measure_changes(const bl_signal *signal, const bl_score_look *look,
                                 const bl_score_settings *settings, looks *all,
                                 bl_score_property *result, bl_message *message) {
    const double half = 0.5 * settings->alpha;
    size_t tested;
    test worst;
    bl_seed_pairs pairs;
    double limit = bl_score_t_limit(half, (double)(CHANGES * all->shifts.count), TESTED_SEEDS);
    for (size_t j = 0; j < all->seeds; j++)
        take_look(signal, look, j, bl_score_random(settings, "seeds", j), all);
    if (all->is_missing || test_changes(signal, look, settings, all, &worst, &tested) != BL_OK)
        return bl_score_no_memory(result, message);
    if (bl_seed_pairs_measure(signal, look, settings, half, &pairs, message) != BL_OK)
        return bl_score_no_memory(result, message);
    bl_estimate r = {pairs.correlation, pairs.correlation - 2 * pairs.deviation,
                     pairs.correlation + 2 * pairs.deviation, settings->level,
                     (double)pairs.places};
    bl_score_add(result, "largest_correlation", worst.t != 0 ? worst.correlation : r);
    bl_score_add_seen(result, "largest_deviate", worst.t);
    bl_score_add_seen(result, "limit_deviate", limit);
    bl_score_add_exact(result, "changes_tested", (double)tested);
    bl_score_add_seen(result, "pair_correlation", pairs.correlation);
    bl_score_add_seen(result, "pair_limit", pairs.limit);
    bl_score_add_exact(result, "seeds", (double)(all->seeds + tested * TESTED_SEEDS));
    judge_dead(all, result);
    if (result->verdict != BL_VERDICT_FAIL)
        judge(all, &worst, limit, &pairs, look->dimensions, result);
    return BL_OK;
}

static bl_status measure(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message) {
    const bl_signal *signal = subject->signal;
    bl_score_look look;
    if (signal->seed_offset == SIZE_MAX ||
        (signal->functions->release && !signal->functions->build)) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL, "the signal has no seed");
        return BL_OK;
    }
    if (!bl_score_look_at(subject, settings, result, &look))
        return BL_OK;
    looks *all = calloc(1, sizeof *all);
    if (!all)
        return bl_score_no_memory(result, message);
    all->shifts = shifts_of(look.dimensions);
    all->seeds = (size_t)bl_size_pick(settings->size, 6, 8, 32);
    bl_status status = measure_changes(signal, &look, settings, all, result, message);
    free(all);
    return status;
}

BL_PROPERTY_DESCRIPTOR(seeds) = {
    .name = "seeds",
    .title = "seeds",
    .entry =
        "|r|, the largest correlation of related seeds, or of the seeds 0 to 31; dead: bits of the "
        "seed that do nothing",
    .question = "Does every bit of the seed count, and are related seeds unrelated signals?",
    .measure = measure,
};
