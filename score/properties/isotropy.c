// SPDX-License-Identifier: MIT
//
// Isotropy: a spectrum without a direction.
//
// The verdict comes from the structure function S(u, h) = E[(n(p + h u) - n(p))^2], which is
// 2 (C(0) - C(h u)) and, at short lags, h^2 times the variance of the derivative along u, a second
// moment of the spectrum. Each batch draws a fresh seed and some places, and samples rows from them
// along the axes and the diagonals of faces (and, in space, of the body), at the lags 1/4, 1/2, 1
// and 2 cells. The contrasts
//
//   sum_d (u_a^2 - mean) S_d        a stretch along axis a
//   sum_d (u_a u_b - mean) S_d      a stretch along a diagonal
//   sum_d (sum_a u_a^4 - mean) S_d  axes against diagonals: the cubic lattice
//   S_d - mean                      anything else in direction d
//
// are 0 over seeds and places for an isotropic noise; each is tested by Student's t over the
// batches, and all tests of a signal share alpha. For information: the anisotropy of the rings of
// the power spectrum of a slice (rings.h).
//
// Second moments do not see the tail of the spectrum, where lattice noises have their cross.
// Therefore each batch also takes two slices, and compares their power above 1 cycle a cell near
// the axes with that near the diagonals (sectors.h); the difference is one more test, and the table
// shows the ratio. A tail that holds less than -50 dB of the variance is shown and not judged: it
// is below what the bands of noises are asked for, and mostly the leak of their ends.
#include "score/properties/places.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/grid.h"
#include "score/properties/picture_isotropy.h"
#include "score/properties/rings.h"
#include "score/properties/sectors.h"

#define ROUNDING 1e-10  // of the density of white noise of the same deviation
#define TAIL_LEAST 1e-5 // the share of the variance from which on the tail is judged

enum { DIRECTIONS = 16, LAGS = 4, LENGTH = 64, CONTRASTS = 4 + 6 + 1 + DIRECTIONS };

// Unit vectors: `axes` axes, the diagonals of the faces, and in three dimensions of the body.
typedef struct directions {
    double unit[DIRECTIONS][BL_AXES];
    unsigned count, axes;
} directions;

static void add_direction(directions *d, const double sign[BL_AXES]) {
    double square = 0;
    for (int a = 0; a < BL_AXES; a++)
        square += sign[a] * sign[a];
    for (int a = 0; a < BL_AXES; a++)
        d->unit[d->count][a] = sign[a] / sqrt(square);
    d->count++;
}

static directions directions_of(unsigned dimensions) {
    directions d = {.axes = dimensions};
    for (unsigned a = 0; a < dimensions; a++) {
        double sign[BL_AXES] = {0};
        sign[a] = 1;
        add_direction(&d, sign);
    }
    for (unsigned a = 0; a < dimensions; a++)
        for (unsigned b = 0; b < a; b++)
            for (int minus = 0; minus < 2; minus++) {
                double sign[BL_AXES] = {0};
                sign[a] = 1;
                sign[b] = minus ? -1 : 1;
                add_direction(&d, sign);
            }
    for (unsigned n = 0; n < 4 && dimensions == 3; n++)
        add_direction(&d, (const double[BL_AXES]){1, n & 1 ? -1 : 1, n & 2 ? -1 : 1, 0});
    return d;
}

// Rows of weights over the directions that sum to 0; returns how many.
static unsigned contrasts_of(const directions *d, double weight[CONTRASTS][DIRECTIONS]) {
    unsigned count = 0;
    for (unsigned a = 0; a < d->axes; a++)
        for (unsigned b = 0; b <= a; b++, count++)
            for (unsigned n = 0; n < d->count; n++)
                weight[count][n] = d->unit[n][a] * d->unit[n][b];
    for (unsigned n = 0; n < d->count; n++)
        weight[count][n] = n < d->axes ? 1.0 : 0.0;
    count++;
    for (unsigned one = 0; one < d->count; one++, count++)
        for (unsigned n = 0; n < d->count; n++)
            weight[count][n] = n == one;
    for (unsigned c = 0; c < count; c++) {
        double mean = 0;
        for (unsigned n = 0; n < d->count; n++)
            mean += weight[c][n] / d->count;
        for (unsigned n = 0; n < d->count; n++)
            weight[c][n] -= mean;
    }
    return count;
}

// Of one batch: the structure function in each direction at each lag.
typedef struct batch {
    double structure[LAGS][DIRECTIONS];
    double near_axes, near_diagonals; // the power of the slices
    int is_missing;                   // out of memory
} batch;

static void take_row(const bl_signal *signal, const double start[BL_AXES], const double *unit,
                     double cell, double structure[LAGS], double weight) {
    float value[LENGTH];
    double step[BL_AXES];
    for (int a = 0; a < BL_AXES; a++)
        step[a] = unit[a] * cell / 4;
    bl_signal_row(signal, start, step, LENGTH, value);
    for (unsigned lag = 0; lag < LAGS; lag++) {
        size_t apart = (size_t)1 << lag, pairs = LENGTH - apart;
        double sum = 0;
        for (size_t i = 0; i < pairs; i++) {
            double difference = (double)value[i + apart] - (double)value[i];
            sum += difference * difference;
        }
        structure[lag] += sum / (double)pairs * weight;
    }
}

static void take(const bl_signal *signal, const directions *d, const bl_score_look *look,
                 size_t rows, const bl_fft *plan, size_t index, bl_random random, batch *b) {
    bl_score_fresh fresh = bl_score_fresh_open(signal, bl_random_bits(&random));
    memset(b, 0, sizeof *b);
    for (unsigned n = 0; n < d->count; n++) {
        double structure[LAGS] = {0};
        for (size_t row = 0; row < rows; row++) {
            double start[BL_AXES] = {0};
            for (unsigned a = 0; a < look->dimensions; a++)
                start[a] =
                    bl_score_base(&random, look->cell) + look->cell * 16 * bl_random_unit(&random);
            take_row(fresh.signal, start, d->unit[n], look->cell, structure, 1.0 / (double)rows);
        }
        for (unsigned lag = 0; lag < LAGS; lag++)
            b->structure[lag][n] = structure[lag];
    }
    unsigned first = (unsigned)(index % d->axes), second = (first + 1) % d->axes;
    b->is_missing = !bl_score_sectors(fresh.signal, look, plan, (unsigned[]){first, second},
                                      &random, &b->near_axes, &b->near_diagonals);
    bl_score_fresh_close(&fresh);
}

// The mean structure function of the directions from `from` up to `to`, over that of the others
// from `against` on, in dB.
static bl_estimate ratio_db(const batch *b, size_t count, unsigned lag, const unsigned range[4],
                            double level, double *room) {
    memset(room, 0, 2 * count * sizeof *room);
    for (size_t i = 0; i < count; i++) {
        for (unsigned n = range[0]; n < range[1]; n++)
            room[i] += b[i].structure[lag][n] / (range[1] - range[0]);
        for (unsigned n = range[2]; n < range[3]; n++)
            room[count + i] += b[i].structure[lag][n] / (range[3] - range[2]);
    }
    return bl_score_db(bl_ratio_estimate(room, room + count, count, level));
}

// Returns the ratio of axes to diagonals at the lag where they differ most.
static double add_ratios(const batch *b, size_t count, const directions *d, double level,
                         double *room, bl_score_property *result) {
    static const char *const lags[LAGS] = {"axes_to_diagonals_db_quarter",
                                           "axes_to_diagonals_db_half", "axes_to_diagonals_db_one",
                                           "axes_to_diagonals_db_two"};
    static const char *const axes[] = {"x_to_other_axes_db", "y_to_other_axes_db",
                                       "z_to_other_axes_db", "w_to_other_axes_db"};
    double largest = 0;
    for (unsigned lag = 0; lag < LAGS; lag++) {
        const unsigned range[] = {0, d->axes, d->axes, d->count};
        bl_estimate ratio = ratio_db(b, count, lag, range, level, room);
        bl_score_add(result, lags[lag], ratio);
        largest = fabs(ratio.value) > fabs(largest) ? ratio.value : largest;
    }
    for (unsigned a = 0; a < d->axes; a++) {
        // The axis over the mean of all axes, which is m/dims of it: solved for the other axes.
        bl_estimate all = ratio_db(b, count, 0, (unsigned[]){a, a + 1, 0, d->axes}, level, room);
        double *limit[] = {&all.value, &all.lower, &all.upper};
        for (int k = 0; k < 3; k++) {
            double share = pow(10, *limit[k] / 10) / d->axes;
            *limit[k] = 10 * log10(share / fmax(0, 1 - share) * (d->axes - 1));
        }
        bl_score_add(result, axes[a], all);
    }
    return largest;
}

// The t of the slices' power near the axes less that near the diagonals; 0 where there is none but
// rounding errors, or too little to judge. Adds their ratio.
static double tail_deviate(const batch *b, size_t count, double level, double *room,
                           bl_score_property *result) {
    double power = 0;
    for (size_t i = 0; i < count; i++) {
        room[i] = b[i].near_axes;
        room[count + i] = b[i].near_diagonals;
        power += (b[i].near_axes + b[i].near_diagonals) / (double)count;
    }
    if (!(power > ROUNDING))
        return 0;
    bl_score_add(result, "tail_axes_to_diagonals_db",
                 bl_score_db(bl_ratio_estimate(room, room + count, count, level)));
    // White noise would have 1 in each sector of both slices, 4 in all, over the square of Nyquist,
    // 16 times a square of one cycle; the ring from 1 to 2 is 3 pi of them.
    double share = power / 4 * (3 * M_PI / 16);
    bl_score_add_seen(result, "tail_share_db", 10 * log10(share));
    for (size_t i = 0; i < count; i++)
        room[i] -= room[count + i];
    return share < TAIL_LEAST ? 0 : bl_score_t(room, count, 1);
}

static void judge(const bl_signal *signal, const batch *b, size_t count, const directions *d,
                  const bl_score_settings *settings, double *room, bl_score_property *result) {
    static const double lag_length[LAGS] = {0.25, 0.5, 1, 2};
    bl_score_against against = signal->facts.isotropic == 1 ? BL_AGAINST_CLAIM : BL_AGAINST_IDEAL;
    double weight[CONTRASTS][DIRECTIONS], largest = 0, worst_lag = 0;
    unsigned contrasts = contrasts_of(d, weight), worst = 0;
    double limit = bl_score_t_limit(settings->alpha, (double)contrasts * LAGS + 1, count);
    for (unsigned c = 0; c < contrasts; c++)
        for (unsigned lag = 0; lag < LAGS; lag++) {
            for (size_t i = 0; i < count; i++) {
                room[i] = 0;
                for (unsigned n = 0; n < d->count; n++)
                    room[i] += weight[c][n] * b[i].structure[lag][n];
            }
            double t = bl_score_t(room, count, 1);
            if (isnan(t)) {
                bl_score_not_finite(result);
                return;
            }
            if (fabs(t) > fabs(largest))
                largest = t, worst = c, worst_lag = lag_length[lag];
        }
    double tail = tail_deviate(b, count, settings->level, room, result);
    int is_tail = fabs(tail) > fabs(largest);
    largest = is_tail ? tail : largest;
    double ratio = add_ratios(b, count, d, settings->level, room, result);
    unsigned quadratic = d->axes * (d->axes + 1) / 2;
    bl_score_add_seen(result, "largest_deviate", largest);
    bl_score_add_seen(result, "limit_deviate", limit);
    const bl_score_number *cross = bl_score_find(result, "tail_axes_to_diagonals_db");
    const bl_score_number *share = bl_score_find(result, "tail_share_db");
    double cross_db = cross ? cross->estimate.value : 0;
    int is_tail_judged = share && share->estimate.value >= 10 * log10(TAIL_LEAST);
    snprintf(result->cell, sizeof result->cell, is_tail_judged ? "%+.2f dB" : "lags %+.2f dB",
             is_tail_judged ? cross_db : ratio);
    char tail_text[80] = "";
    if (is_tail_judged)
        snprintf(tail_text, sizeof tail_text, "; power near them, above 1 cycle a cell: %+.2f dB",
                 cross_db);
    if (fabs(largest) > limit && is_tail)
        bl_score_judge(result, BL_VERDICT_FAIL, against,
                       "above 1 cycle a cell, the power near the axes is %+.2f dB of that near the "
                       "diagonals (%.1f standard errors)",
                       cross_db, largest);
    else if (fabs(largest) > limit)
        bl_score_judge(result, BL_VERDICT_FAIL, against,
                       "at the lag of %g cells, differences %s deviate by %.1f standard errors; "
                       "differences along axes over those along diagonals: %+.2f dB%s",
                       worst_lag,
                       worst < quadratic    ? "along an axis or a diagonal (a stretch)"
                       : worst == quadratic ? "along the axes against the diagonals"
                                            : "in one direction",
                       largest, ratio, tail_text);
    else
        bl_score_judge(
            result, BL_VERDICT_PASS, against,
            "differences are of one size in %u directions at four lags, as far as %zu "
            "batches can tell; differences along axes over those along diagonals: %+.2f dB%s",
            d->count, count, ratio, tail_text);
}

static bl_status measure(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message) {
    const bl_signal *signal = subject->signal;
    bl_score_look look;
    if (signal->picture.size[0])
        return bl_score_picture_isotropy(signal, settings, result, message);
    if (!bl_score_look_at(subject, settings, result, &look) ||
        !bl_score_varies(signal, settings, result))
        return BL_OK;
    if (look.dimensions < 2) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL,
                       "a signal of one dimension has no directions");
        return BL_OK;
    }
    directions d = directions_of(look.dimensions);
    const bl_fft *plan;
    bl_status status = bl_score_sectors_plan(&plan, message);
    if (status != BL_OK)
        return status;
    size_t count = (size_t)bl_size_pick(settings->size, 128, 512, 4096);
    size_t rows = (size_t)bl_size_pick(settings->size, 6, 20, 64);
    batch *batches = malloc(count * sizeof *batches);
    double *room = malloc(2 * count * sizeof *room);
    if (batches && room) {
#pragma omp parallel for num_threads(bl_thread_count(settings->threads)) schedule(dynamic, 4)
        for (size_t i = 0; i < count; i++)
            take(signal, &d, &look, rows, plan, i, bl_score_random(settings, "isotropy", i),
                 &batches[i]);
        judge(signal, batches, count, &d, settings, room, result);
        if (result->verdict != BL_VERDICT_NOT_RUN)
            bl_score_add_rings(signal, settings, &look, result);
    }
    int is_missing = !batches || !room;
    for (size_t i = 0; i < count && !is_missing; i++)
        is_missing = batches[i].is_missing;
    if (is_missing)
        status = bl_score_no_memory(result, message);
    free(batches);
    free(room);
    return status;
}

BL_PROPERTY_DESCRIPTOR(isotropy) = {
    .name = "isotropy",
    .title = "isotropy",
    .paper = "peachey2003, p. 68",
    .entry =
        "power near axes over that near diagonals, above 1 cycle a cell; of a picture, its "
        "direction",
    .question = "Does the spectrum have no direction?",
    .measure = measure,
};
