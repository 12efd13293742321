// SPDX-License-Identifier: MIT
#include "score/properties/standing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/grid.h"

enum {
    NEAR = 4, // places at and near the origin
    ROW = 256,
    WAVES = ROW / 2 - 1, // waves in a row, of half cells: below one a cell
    AT_ORIGIN = 2 * NEAR,
    TESTS = AT_ORIGIN + 2 * WAVES * BL_AXES,
    CHUNK = 64 // batches at a time, whose numbers are added in their order
};

static const double near_origin[NEAR] = {0, 1.0 / 64, 1.0 / 16, 0.25}; // cells

// cos and sin of whole numbers of waves in a row.
typedef struct table {
    float wave[2 * WAVES][ROW];
} table;

static void fill_table(table *t) {
    for (int w = 0; w < 2 * WAVES; w++)
        for (int j = 0; j < ROW; j++) {
            int turn = (1 + w / 2) * j % ROW;
            t->wave[w][j] = (float)cos(2 * M_PI * ((double)turn / ROW - (w % 2) / 4.0));
        }
}

static void take_origin(const bl_signal *signal, const bl_score_look *look, bl_random *random,
                        double *number, double squares[2][NEAR]) {
    double column[BL_AXES][2 * NEAR] = {{0}};
    float value[2 * NEAR];
    for (unsigned a = 0; a < look->dimensions; a++) {
        double base = bl_score_base(random, look->cell);
        for (int i = 0; i < NEAR; i++) {
            column[a][i] = look->cell * near_origin[i];
            column[a][NEAR + i] = base + column[a][i];
        }
    }
    bl_signal_points(signal, BL_COLUMNS(column), 2 * NEAR, value);
    for (int i = 0; i < NEAR; i++) {
        double here = (double)value[i] - look->mean, there = (double)value[NEAR + i] - look->mean;
        number[2 * i] = here - there;
        number[2 * i + 1] = here * here - there * there;
        squares[0][i] = here * here;
        squares[1][i] = there * there;
    }
}

// A row along each axis, through a place off the lattice.
static void take_rows(const bl_signal *signal, const bl_score_look *look, const table *t,
                      double *number) {
    static const double start[BL_AXES] = {1000.3, -700.7, 300.2, 2000.6};
    for (unsigned axis = 0; axis < look->dimensions; axis++) {
        double at[BL_AXES] = {0}, step[BL_AXES] = {0};
        float value[ROW], square[ROW];
        for (unsigned a = 0; a < look->dimensions; a++)
            at[a] = look->cell * start[a];
        step[axis] = look->cell / 2;
        bl_signal_row(signal, at, step, ROW, value);
        for (int j = 0; j < ROW; j++) {
            float off = (float)(((double)value[j] - look->mean) / look->deviation);
            square[j] = off * off;
        }
        for (int w = 0; w < 2 * WAVES; w++) {
            double sum = 0;
            for (int j = 0; j < ROW; j++)
                sum += (double)(square[j] * t->wave[w][j]);
            number[axis * 2 * WAVES + (unsigned)w] = sum;
        }
    }
}

static void describe(unsigned test, double cell, bl_standing *found) {
    if (test < AT_ORIGIN && near_origin[test / 2] == 0) {
        snprintf(found->what, sizeof found->what, "the %s at the origin",
                 test % 2 ? "variance" : "mean");
    } else if (test < AT_ORIGIN) {
        snprintf(found->what, sizeof found->what,
                 "the %s near the origin, %g units along each axis,",
                 test % 2 ? "variance" : "mean", cell * near_origin[test / 2]);
    } else {
        unsigned wave = test - AT_ORIGIN, axis = wave / (2 * WAVES);
        double length = cell * ROW / 2 / (1 + wave % (2 * WAVES) / 2);
        snprintf(found->what, sizeof found->what,
                 "the variance along %c, a wave of %.4g units from cell to cell,", "xyzw"[axis],
                 length);
    }
}

bl_status bl_standing_measure(const bl_signal *signal, const bl_score_look *look,
                              const bl_score_settings *settings, size_t count, double alpha,
                              bl_standing *found, bl_message *message) {
    const unsigned tests = AT_ORIGIN + 2 * WAVES * look->dimensions;
    table *t = malloc(sizeof *t);
    double(*number)[TESTS] = calloc(CHUNK, sizeof *number);
    double squares[CHUNK][2][NEAR], sum[2][NEAR] = {{0}};
    bl_moments *moments = calloc(TESTS, sizeof *moments);
    bl_status status = t && number && moments
                           ? BL_OK
                           : bl_report(message, BL_DEVICE, "out of memory for %u waves", tests);
    *found = (bl_standing){.tests = tests, .ratio = NAN};
    if (status == BL_OK)
        fill_table(t);
    for (size_t from = 0; status == BL_OK && from < count; from += CHUNK) {
        const size_t now = count - from < CHUNK ? count - from : CHUNK;
#pragma omp parallel for num_threads(bl_thread_count(settings->threads)) schedule(dynamic)
        for (size_t i = 0; i < now; i++) {
            bl_random random = bl_score_random(settings, "standing", from + i);
            bl_score_fresh fresh = bl_score_fresh_open(signal, bl_random_bits(&random));
            take_origin(fresh.signal, look, &random, number[i], squares[i]);
            take_rows(fresh.signal, look, t, number[i] + AT_ORIGIN);
            bl_score_fresh_close(&fresh);
        }
        for (size_t i = 0; i < now; i++)
            for (unsigned k = 0; k < tests; k++)
                bl_moments_add(&moments[k], number[i][k]);
        for (size_t i = 0; i < now; i++)
            for (int n = 0; n < NEAR; n++) {
                sum[0][n] += squares[i][0][n];
                sum[1][n] += squares[i][1][n];
            }
    }
    const double limit = bl_score_t_limit(alpha, tests, count);
    for (unsigned k = 0; status == BL_OK && k < tests; k++) {
        if (k == AT_ORIGIN && fabs(found->t) > limit)
            break;
        double error = sqrt(bl_moments_variance(&moments[k]) / moments[k].n);
        // A row of whole repeats has no odd waves but those of rounding, which are no chance.
        double least = k < AT_ORIGIN ? 0 : 1e-6 * ROW;
        double deviate = fabs(moments[k].mean) <= least ? 0 : moments[k].mean / error;
        if (fabs(deviate) > fabs(found->t) || isnan(deviate)) {
            found->t = deviate;
            found->ratio =
                k < AT_ORIGIN && k % 2 ? sum[0][k / 2] / sum[1][k / 2] : NAN; // of variances
            describe(k, look->cell, found);
        }
        if (isnan(deviate))
            break;
    }
    free(t);
    free(number);
    free(moments);
    return status;
}
