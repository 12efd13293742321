// SPDX-License-Identifier: MIT
#include "score/properties/overflow.h"

#include <math.h>

#include "core/grid.h"
#include "score/properties/places.h"
#include "score/properties/sampling.h"
#include "score/properties/special.h"

enum { FIRST = 10, LAST = 63, POWERS = LAST - FIRST + 1, CLOSE = 16 };
enum { OFFSETS = 10, PAIRS = 6, ELSEWHERE = 4, REPEATS = 2 };
enum { LINES = 2 * REPEATS * (BL_AXES + 1), PLACES = LINES * OFFSETS };

// Pairs of offsets that are neighbours; those from ELSEWHERE on cross no plane.
static const int pairs[PAIRS][2] = {{0, 1}, {1, 2}, {4, 5}, {5, 6}, {7, 8}, {8, 9}};

// What is seen at one power. A line is a set of axes with a sign; its places stand in a row.
typedef struct view {
    double base, at[BL_AXES][PLACES], reference[PLACES], widened[PLACES];
    size_t lines;
    int is_resolved; // neighbours are places of their own
} view;

static void choose(view *v, unsigned dimensions, double cell, bl_random *random) {
    double rounding = nextafter(v->base, INFINITY) - v->base;
    double near = fmax(0x1p-12 * cell, 2 * rounding);
    v->is_resolved = near <= cell / 8;
    v->lines = 0;
    for (unsigned axis = 0; axis <= (dimensions > 1 ? dimensions : 0); axis++)
        for (int way = 0; way < 2 * REPEATS; way++, v->lines++) {
            double f = cell * (0.25 + 0.5 * bl_random_unit(random)), across[BL_AXES];
            const double offsets[OFFSETS] = {-cell - near, -cell,    near - cell, -f,      -near, 0,
                                             near,         f - near, f,           f + near};
            for (int a = 0; a < BL_AXES; a++)
                across[a] = cell * 16 * (bl_random_unit(random) - 0.5);
            for (int i = 0; i < OFFSETS; i++)
                for (unsigned a = 0; a < BL_AXES; a++) {
                    int is_far = a < dimensions && (a == axis || axis == dimensions);
                    double far = v->base + offsets[i];
                    v->at[a][v->lines * OFFSETS + (size_t)i] =
                        is_far ? (way % 2 ? -far : far) : across[a];
                }
        }
}

static void look(const bl_signal *signal, double cell, bl_random random, view *v) {
    float points[PLACES];
    unsigned dimensions = signal->dimensions < BL_AXES ? signal->dimensions : BL_AXES;
    choose(v, dimensions, cell, &random);
    size_t count = v->lines * OFFSETS;
    bl_signal_points(signal, BL_COLUMNS(v->at), count, points);
    bl_signal_values(signal, BL_COLUMNS(v->at), count, v->reference);
    for (size_t i = 0; i < count; i++)
        v->widened[i] = (double)points[i];
}

static double step_of(const view *v, size_t line, int pair) {
    const double *value = v->reference + line * OFFSETS;
    return fabs(value[pairs[pair][1]] - value[pairs[pair][0]]);
}

// What is usual near 0, and then on the way out.
typedef struct usual {
    double lower, upper; // of what is in range
    double range, step;  // of the values, and of neighbours
} usual;

static usual usual_of(const bl_signal *signal, const bl_score_settings *settings, double cell) {
    usual u = {.lower = INFINITY, .upper = -INFINITY};
    for (int k = 0; k < CLOSE; k++) {
        view v = {.base = cell * k};
        look(signal, cell, bl_score_random(settings, "overflow", (uint64_t)k), &v);
        for (size_t i = 0; i < v.lines * OFFSETS; i++) {
            if (!isfinite(v.reference[i]))
                continue;
            u.lower = fmin(u.lower, v.reference[i]);
            u.upper = fmax(u.upper, v.reference[i]);
        }
        for (size_t line = 0; line < v.lines; line++)
            for (int p = 0; p < PAIRS; p++)
                u.step = fmax(u.step, step_of(&v, line, p)); // fmax drops NaN
    }
    u.range = u.upper - u.lower;
    const bl_facts *facts = &signal->facts;
    int is_stated = isfinite(facts->lower) && isfinite(facts->upper);
    double size = fmax(1, fmax(fabs(facts->lower), fabs(facts->upper)));
    double slack = is_stated ? 32 * 0x1p-24 * size : 4 * u.range;
    u.lower = (is_stated ? facts->lower : u.lower) - slack;
    u.upper = (is_stated ? facts->upper : u.upper) + slack;
    return u;
}

static void take(bl_overflow_place *found, const view *v, size_t i, double value) {
    if (found->from <= v->base)
        return;
    *found = (bl_overflow_place){.from = v->base, .value = value};
    for (int a = 0; a < BL_AXES; a++)
        found->at[a] = v->at[a][i];
}

static void judge_values(const view *v, const usual *u, bl_overflow_place *found) {
    for (size_t i = 0; i < v->lines * OFFSETS; i++)
        for (int route = 0; route < 2; route++) {
            double value = route ? v->reference[i] : v->widened[i];
            if (!isfinite(value))
                take(&found[BL_OVERFLOW_NAN], v, i, value);
            else if (value < u->lower || value > u->upper)
                take(&found[BL_OVERFLOW_RANGE], v, i, value);
        }
}

// What a pair across the power does is held against the usual, to which the other pairs add.
static void judge_steps(const view *v, usual *u, bl_overflow_place *found) {
    if (!v->is_resolved)
        return;
    double elsewhere = 0;
    for (size_t line = 0; line < v->lines; line++)
        for (int p = ELSEWHERE; p < PAIRS; p++)
            elsewhere = fmax(elsewhere, step_of(v, line, p));
    if (elsewhere == 0) // floats have no place between neighbours
        return;
    u->step = fmax(u->step, elsewhere);
    double least = 8 * u->step + 0x1p-8 * u->range;
    for (int p = 0; p < ELSEWHERE; p++) {
        size_t lines = 0, worst = 0;
        for (size_t line = 0; line < v->lines; line++) {
            lines += step_of(v, line, p) > least;
            worst = step_of(v, line, p) > step_of(v, worst, p) ? line : worst;
        }
        if (lines > 1)
            take(&found[BL_OVERFLOW_JUMP], v, worst * OFFSETS + (size_t)pairs[p][1],
                 step_of(v, worst, p));
    }
}

// Powers of `unit`.
static void find_from(const bl_signal *signal, const bl_score_settings *settings, double unit,
                      double cell, usual u, bl_overflow_place *found) {
    static const int together = 6; // views in memory
    view views[6];
    for (int from = 0; from < POWERS; from += together) {
#pragma omp parallel for num_threads(bl_thread_count(settings->threads)) schedule(static, 1)
        for (int k = from; k < from + together; k++) {
            views[k - from].base = ldexp(unit, FIRST + k);
            look(signal, cell, bl_score_random(settings, "overflow", (uint64_t)(CLOSE + k)),
                 &views[k - from]);
        }
        for (int k = from; k < from + together; k++) {
            judge_values(&views[k - from], &u, found);
            judge_steps(&views[k - from], &u, found);
        }
    }
}
_Static_assert(POWERS % 6 == 0, "the powers come in sixes");

void bl_overflow_find(const bl_signal *signal, const bl_score_settings *settings,
                      bl_overflow_place found[BL_OVERFLOW_KINDS]) {
    const double cell = bl_score_cell(signal);
    for (int kind = 0; kind < BL_OVERFLOW_KINDS; kind++)
        found[kind] = (bl_overflow_place){.from = INFINITY};
    usual u = usual_of(signal, settings, cell);
    find_from(signal, settings, 1, cell, u, found);
    if (cell != 1 && cell < 0x1p40)
        find_from(signal, settings, cell, cell, u, found);
}

double bl_overflow_domain(const bl_signal *signal, double unstated) {
    return signal->facts.far > 0 ? signal->facts.far : unstated;
}
