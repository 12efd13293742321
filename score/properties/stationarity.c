// SPDX-License-Identifier: MIT
//
// Stationarity: the same mean and the same variance everywhere.
//
// A lattice noise is cyclostationary: over seeds, its variance depends on the place within the
// cell. Each batch draws a fresh seed and fresh cells and takes
//
//   corners  the 2^dims corners of the half cell (vertex, edges, faces, centre): their mean and
//            their variance, each against the average of all corners
//   waves    values and squared deviations at places anywhere, times cos and sin of 2 pi k x_a over
//            the cell, k = 1, 2: what the corners do not see, as a wave that is 0 at all of them
//   regions  (of a signal with a seed) four blocks of 8 cells a side, near 0, near 1000, near -1000
//            and near 10^5, against their average: what happens once, and not in every cell
//   standing the origin, and waves of the variance from cell to cell (standing.h)
//
// and each of these numbers, which is 0 over seeds if the signal is stationary, is tested by
// Student's t over the batches; all tests of a signal share alpha. A function of the registries
// without a seed is not random: over its own cells it may be the same number in every batch.
#include "score/properties/places.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/grid.h"
#include "score/properties/standing.h"

enum {
    CORNERS = 1 << BL_AXES,
    EACH = 48,   // samples at a corner
    WAVES = 256, // samples anywhere
    REGIONS = 4,
    IN_REGION = 32,
    BLOCK = CORNERS * EACH, // the most that is sampled at once
    FREQUENCIES = 2,
    KINDS = CORNERS + 2 * FREQUENCIES * BL_AXES + REGIONS // places or waves that are tested
};
_Static_assert((int)BLOCK >= (int)WAVES && (int)BLOCK >= REGIONS * IN_REGION, "the block is large");

// Of one batch: mean of the values less the pilot's mean, and of their squares; of a wave, of the
// products with it.
typedef struct batch {
    double value[KINDS], square[KINDS];
    double wave_mean[2 * FREQUENCIES * BL_AXES]; // of the wave itself over the places
} batch;

typedef struct survey {
    const bl_signal *signal;
    const bl_score_look *look;
    unsigned corners, waves, regions, first_wave, first_region, kinds;
} survey;

static survey survey_of(const bl_signal *signal, const bl_score_look *look) {
    survey s = {.signal = signal, .look = look};
    s.corners = 1u << look->dimensions;
    s.waves = 2 * FREQUENCIES * look->dimensions;
    s.regions = signal->seed_offset == SIZE_MAX ? 0 : REGIONS;
    s.first_wave = s.corners;
    s.first_region = s.first_wave + s.waves;
    s.kinds = s.first_region + s.regions;
    return s;
}

static void sample(const bl_signal *signal, double column[BL_AXES][BLOCK], size_t count,
                   float *out) {
    bl_signal_points(signal, BL_COLUMNS(column), count, out);
}

static void add(batch *b, unsigned kind, double value, double weight) {
    b->value[kind] += value * weight;
    b->square[kind] += value * value * weight;
}

static void take_corners(const survey *s, const bl_signal *signal, bl_random *random, batch *b) {
    double column[BL_AXES][BLOCK] = {{0}}, cell = s->look->cell;
    float out[BLOCK];
    size_t count = (size_t)s->corners * EACH;
    for (unsigned a = 0; a < s->look->dimensions; a++) {
        double base = bl_score_base(random, cell);
        for (size_t i = 0; i < count; i++)
            column[a][i] = base + cell * (floor(512 * bl_random_unit(random)) +
                                          (double)(i / EACH >> a & 1) / 2);
    }
    sample(signal, column, count, out);
    for (size_t i = 0; i < count; i++)
        add(b, (unsigned)(i / EACH), (double)out[i] - s->look->mean, 1.0 / EACH);
}

static void take_waves(const survey *s, const bl_signal *signal, bl_random *random, batch *b) {
    double column[BL_AXES][BLOCK] = {{0}}, cell = s->look->cell;
    float out[BLOCK];
    for (unsigned a = 0; a < s->look->dimensions; a++) {
        double base = bl_score_base(random, cell);
        for (size_t i = 0; i < WAVES; i++)
            column[a][i] = base + cell * 512 * bl_random_unit(random);
    }
    sample(signal, column, WAVES, out);
    for (unsigned w = 0; w < s->waves; w++) {
        unsigned axis = w / (2 * FREQUENCIES), frequency = 1 + w / 2 % FREQUENCIES;
        for (size_t i = 0; i < WAVES; i++) {
            double x = column[axis][i] / cell;
            double angle = 2 * M_PI * (frequency * (x - floor(x)) - (w % 2) / 4.0);
            double wave = cos(angle) / WAVES;
            add(b, s->first_wave + w, (double)out[i] - s->look->mean, wave);
            b->wave_mean[w] += wave;
        }
    }
}

static void take_regions(const survey *s, const bl_signal *signal, bl_random *random, batch *b) {
    static const double where[REGIONS] = {-4, 1000, -1000, 100000};
    double column[BL_AXES][BLOCK] = {{0}};
    float out[BLOCK];
    size_t count = (size_t)s->regions * IN_REGION;
    for (unsigned a = 0; a < s->look->dimensions; a++)
        for (size_t i = 0; i < count; i++)
            column[a][i] = s->look->cell * (where[i / IN_REGION] + 8 * bl_random_unit(random));
    sample(signal, column, count, out);
    for (size_t i = 0; i < count; i++)
        add(b, s->first_region + (unsigned)(i / IN_REGION), (double)out[i] - s->look->mean,
            1.0 / IN_REGION);
}

static void take(const survey *s, bl_random random, batch *b) {
    bl_score_fresh fresh = bl_score_fresh_open(s->signal, bl_random_bits(&random));
    memset(b, 0, sizeof *b);
    take_corners(s, fresh.signal, &random, b);
    take_waves(s, fresh.signal, &random, b);
    if (s->regions)
        take_regions(s, fresh.signal, &random, b);
    bl_score_fresh_close(&fresh);
}

// Replaces the mean squares by mean squared deviations from the mean of that place over all
// batches; of a wave, the deviations from the mean and from the variance of all corners.
static void centre(const survey *s, batch *b, size_t count) {
    double mean[KINDS] = {0}, overall = 0, variance = 0;
    for (unsigned k = 0; k < s->kinds; k++)
        for (size_t i = 0; i < count; i++)
            mean[k] += b[i].value[k] / (double)count;
    for (unsigned k = 0; k < s->kinds; k++)
        for (size_t i = 0; i < count && (k < s->first_wave || k >= s->first_region); i++)
            b[i].square[k] += mean[k] * (mean[k] - 2 * b[i].value[k]);
    for (unsigned k = 0; k < s->corners; k++) {
        overall += mean[k] / s->corners;
        for (size_t i = 0; i < count; i++)
            variance += b[i].square[k] / s->corners / (double)count;
    }
    for (unsigned w = 0; w < s->waves; w++)
        for (size_t i = 0; i < count; i++) {
            unsigned k = s->first_wave + w;
            double wave = b[i].wave_mean[w], value = b[i].value[k];
            b[i].value[k] -= overall * wave;
            b[i].square[k] += (overall * overall - variance) * wave - 2 * overall * value;
        }
}

// The t of a kind: a corner or a region against the average of its like, a wave against 0.
static double deviate(const survey *s, const batch *b, size_t count, unsigned kind, int square,
                      double *room) {
    unsigned from = kind, to = kind;
    if (kind < s->corners)
        from = 0, to = s->corners;
    else if (kind >= s->first_region)
        from = s->first_region, to = s->kinds;
    for (size_t i = 0; i < count; i++) {
        const double *numbers = square ? b[i].square : b[i].value;
        room[i] = numbers[kind];
        for (unsigned k = from; k < to; k++)
            room[i] -= numbers[k] / (to - from);
    }
    return bl_score_t(room, count, 1);
}

static unsigned halves_of(unsigned corner) {
    return (unsigned)__builtin_popcount(corner);
}

// The variance at the corners with a number of halves, by batch.
static void class_variance(const survey *s, const batch *b, size_t count, unsigned halves,
                           double *out) {
    unsigned members = 0;
    memset(out, 0, count * sizeof *out);
    for (unsigned k = 0; k < s->corners; k++) {
        members += halves_of(k) == halves;
        for (size_t i = 0; i < count && halves_of(k) == halves; i++)
            out[i] += b[i].square[k];
    }
    for (size_t i = 0; i < count; i++)
        out[i] /= members;
}

// Adds the variance of each class of corners, and the largest ratio of two of them; which it
// returns, in dB.
static double add_variances(const survey *s, const batch *b, size_t count, double level,
                            double *room, bl_score_property *result) {
    static const char *const names[BL_AXES + 1][BL_AXES + 1] = {
        {0},
        {"variance_vertex", "variance_centre"},
        {"variance_vertex", "variance_edge", "variance_centre"},
        {"variance_vertex", "variance_edge", "variance_face", "variance_centre"},
        {"variance_vertex", "variance_edge", "variance_face", "variance_volume",
         "variance_centre"}};
    unsigned dimensions = s->look->dimensions, least = 0, most = 0;
    bl_estimate variance[BL_AXES + 1];
    for (unsigned halves = 0; halves <= dimensions; halves++) {
        class_variance(s, b, count, halves, room);
        variance[halves] = bl_mean_estimate(room, count, level);
        // Where the noise is 0, rounding leaves either sign.
        variance[halves].value = fmax(0, variance[halves].value);
        variance[halves].lower = fmax(0, variance[halves].lower);
        variance[halves].upper = fmax(0, variance[halves].upper);
        bl_score_add(result, names[dimensions][halves], variance[halves]);
        if (variance[halves].value < variance[least].value)
            least = halves;
        if (variance[halves].value > variance[most].value)
            most = halves;
    }
    bl_estimate ratio = {INFINITY, INFINITY, INFINITY, level, (double)count};
    class_variance(s, b, count, most, room);
    class_variance(s, b, count, least, room + count);
    // A vertex where the noise is 0 has a variance of rounding errors at most.
    if (variance[least].value > 1e-12 * variance[most].value)
        ratio = bl_score_db(bl_ratio_estimate(room, room + count, count, level));
    bl_score_add(result, "largest_ratio_db", ratio);
    return ratio.value;
}

static void describe(const survey *s, unsigned kind, int square, char *text, size_t size) {
    static const char *const corners[] = {"a vertex", "an edge", "a face", "a volume"};
    const char *moment = square ? "variance" : "mean";
    unsigned halves = halves_of(kind), wave = kind - s->first_wave;
    if (kind < s->first_wave)
        snprintf(text, size, "the %s at %s of the cell", moment,
                 halves == s->look->dimensions ? "the centre" : corners[halves]);
    else if (kind < s->first_region)
        snprintf(text, size, "the %s along %c of the cell, a wave of frequency %u", moment,
                 "xyzw"[wave / (2 * FREQUENCIES)], 1 + wave / 2 % FREQUENCIES);
    else
        snprintf(text, size, "the %s in region %u", moment, kind - s->first_region);
}

static void judge(const survey *s, const batch *b, size_t count, const bl_standing *standing,
                  const bl_score_settings *settings, double *room, bl_score_property *result) {
    bl_score_against against =
        s->signal->facts.stationary == 1 ? BL_AGAINST_CLAIM : BL_AGAINST_IDEAL;
    // Half of alpha each for what stands still and for what does not: they are many more.
    double limit = bl_score_t_limit(0.5 * settings->alpha, 2.0 * s->kinds, count), largest = 0;
    double standing_limit = bl_score_t_limit(0.5 * settings->alpha, standing->tests, count);
    char also[160] = "";
    int stands;
    unsigned worst = 0;
    char what[96];
    for (unsigned test = 0; test < 2 * s->kinds; test++) {
        double t = deviate(s, b, count, test / 2, test % 2, room);
        if (isnan(t)) {
            bl_score_not_finite(result);
            return;
        }
        if (fabs(t) > fabs(largest))
            largest = t, worst = test;
    }
    if (isnan(standing->t)) {
        bl_score_not_finite(result);
        return;
    }
    stands = standing->tests > 0 && !(fabs(largest) > limit) &&
             fabs(standing->t) / standing_limit > fabs(largest) / limit;
    if (!stands && standing->tests > 0 && fabs(standing->t) > standing_limit)
        snprintf(also, sizeof also, "; and %s by %.1f", standing->what, standing->t);
    double ratio = add_variances(s, b, count, settings->level, room, result);
    bl_score_add_seen(result, "largest_deviate", largest);
    bl_score_add_seen(result, "limit_deviate", limit);
    const char *where = worst / 2 < s->first_wave     ? ""
                        : worst / 2 < s->first_region ? ", wave"
                                                      : ", region";
    if (fabs(largest) > limit && (*where || worst % 2 == 0)) // not what the ratio is of
        snprintf(result->cell, sizeof result->cell, "%s%s", worst % 2 ? "variance" : "mean", where);
    else
        snprintf(result->cell, sizeof result->cell, "%.2g dB", ratio);
    describe(s, worst / 2, worst % 2, what, sizeof what);
    if (stands) {
        largest = standing->t;
        limit = standing_limit;
        snprintf(what, sizeof what, "%s", standing->what);
        if (isfinite(standing->ratio)) {
            bl_score_add_seen(result, "origin_ratio", standing->ratio);
            snprintf(also, sizeof also, ": it is %.2f times that elsewhere", standing->ratio);
        }
    }
    if (isinf(largest)) // a seed that changes nothing, and cells that are all alike
        bl_score_judge(result, BL_VERDICT_FAIL, against,
                       "%s is the same number in every batch, %s that of all places", what,
                       largest > 0 ? "above" : "below");
    else if (fabs(largest) > limit)
        bl_score_judge(result, BL_VERDICT_FAIL, against, "%s deviates by %.1f standard errors%s",
                       what, largest, also);
    else
        bl_score_judge(result, BL_VERDICT_PASS, against,
                       "mean and variance are the same all over the cell, as far as %zu batches "
                       "can tell",
                       count);
}

static bl_status measure(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message) {
    bl_score_look look;
    if (!bl_score_look_at(subject, settings, result, &look) ||
        !bl_score_varies(subject->signal, settings, result))
        return BL_OK;
    if (!bl_score_has_statistics(subject->signal, result))
        return BL_OK;
    if (subject->signal->definition && subject->signal->seed_offset == SIZE_MAX) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL,
                       "the signal has no seed: it is one function, whose value at a place of the "
                       "cell is not random");
        return BL_OK;
    }
    size_t count = (size_t)bl_size_pick(settings->size, 384, 1536, 16384);
    survey s = survey_of(subject->signal, &look);
    bl_standing standing = {0};
    bl_status status = BL_OK;
    if (s.regions)
        status = bl_standing_measure(subject->signal, &look, settings, count, 0.5 * settings->alpha,
                                     &standing, message);
    batch *batches = malloc(count * sizeof *batches);
    double *room = malloc(2 * count * sizeof *room);
    if (batches && room && status == BL_OK) {
#pragma omp parallel for num_threads(bl_thread_count(settings->threads)) schedule(dynamic, 8)
        for (size_t i = 0; i < count; i++)
            take(&s, bl_score_random(settings, "stationarity", i), &batches[i]);
        centre(&s, batches, count);
        judge(&s, batches, count, &standing, settings, room, result);
    }
    if (!batches || !room || status != BL_OK)
        status = bl_score_no_memory(result, message);
    free(batches);
    free(room);
    return status;
}

BL_PROPERTY_DESCRIPTOR(stationarity) = {
    .name = "stationarity",
    .title = "stationarity",
    .paper = "peachey2003, p. 68",
    .entry = "the largest variance at a place of the cell over the smallest; or what else differs",
    .question = "Are mean and variance the same everywhere in the cell?",
    .measure = measure,
};
