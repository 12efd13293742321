// SPDX-License-Identifier: MIT
//
// Continuity: jumps of the value and of its first two derivatives, with their places.
//
// Lines of 16 cells, half of them along an axis and half oblique, with their middles within 4 cells
// of the origin or (a quarter) within 16, are scanned by rows with 256 samples a cell. Third
// differences d3 of neighbouring samples are large where something jumps: the value (d3 as large as
// the jump, for every step h), the first derivative (d3 ~ h), the second (d3 ~ h^2); elsewhere d3 ~
// h^3. The largest ones of each line are looked at closely: the reference is sampled in the window
// of four samples, 16 times as densely, the window of the largest d3 is taken again, and so on down
// to h of 10^-11 of a cell. The power of h by which d3 falls in the end tells the order of what is
// there, and d3 its size. Rounding ends the descent; where it ends too early to tell, what rounding
// can hide is either too small to count, or the place is unresolved. The power is taken below an
// eighth of the finest cell: above, the waves of the finest octaves are no jumps.
//
// Lines never meet a value that is another one just on a plane of the lattice or where fractions
// tie. At each special place (special.h) the value is compared with those 2^-8, 2^-12 ... 2^-32 of
// a cell away, both ways along two directions: where the difference no longer shrinks, by more than
// a tenth over two levels, the value jumps there. The last level is that where the values still
// differ, so that a function of floats is judged by what its coordinates resolve. This is done by
// the reference; that rows and points say the same there is the question of another property. Far
// out, jumps across powers of two are looked for (overflow.h).
//
// Judged against the stated class: a jump of a derivative of that order or below fails. A signal
// that states a bound, or a class of 0 or more, states its class; -1 of any other is "not stated",
// and then only a jump of the value fails. Jumps below 2^-16 of the range are not told from
// rounding to floats near the origin; kinks below 10^-3 and bends below 10^-2 of the deviation a
// cell are not counted.
#include "score/properties/places.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/continuity.h"
#include "core/grid.h"
#include "score/properties/overflow.h"
#include "score/properties/special.h"

enum { PER_CELL = 256, LINE = 16 * PER_CELL + 1, CANDIDATES = 3, FINE = 16, LEVELS = 16 };
enum { ORDERS = 3, SMOOTH = ORDERS, UNRESOLVED };

// What was found at a place: order 0 to 2 of the derivative that jumps, or nothing.
typedef struct finding {
    int order;
    double size; // of the jump, in units of the derivative
    double at[BL_AXES];
} finding;

typedef struct line {
    const bl_signal *signal;
    double start[BL_AXES], unit[BL_AXES], h; // sample i is at start + i h unit
} line;

static void place_of(const line *l, double t, double at[BL_AXES]) {
    for (int a = 0; a < BL_AXES; a++)
        at[a] = l->start[a] + t * l->unit[a];
}

static double third_difference(const double v[4]) {
    return fabs((v[3] - v[0]) - 3 * (v[2] - v[1]));
}

static double largest_step(const double v[4]) {
    return fmax(fmax(fabs(v[1] - v[0]), fabs(v[2] - v[1])), fabs(v[3] - v[2]));
}

// --- one place ----------------------------------------------------------------------------------

typedef struct descent {
    double h[LEVELS], third[LEVELS], step[LEVELS]; // of the window of each level
    unsigned levels;
    double t; // its middle in the end
} descent;

static void add_level(descent *d, double h, const double v[4]) {
    d->h[d->levels] = h;
    d->third[d->levels] = third_difference(v);
    d->step[d->levels] = largest_step(v);
    d->levels++;
}

// From the window of four samples of the line that begins at t.
static descent descend(const line *l, double t) {
    descent d = {.levels = 0};
    double v[FINE + 1], at[BL_AXES], width = 3 * l->h;
    for (int i = 0; i < 4; i++) {
        place_of(l, t + i * l->h, at);
        v[i] = bl_signal_value(l->signal, at);
    }
    add_level(&d, l->h, v);
    while (d.levels < LEVELS && width > 0x1p-34 * l->h * PER_CELL) {
        double h = width / FINE;
        int best = 0;
        for (int i = 0; i <= FINE; i++) {
            place_of(l, t + i * h, at);
            v[i] = bl_signal_value(l->signal, at);
        }
        for (int i = 1; i + 3 <= FINE; i++)
            if (third_difference(v + i) > third_difference(v + best))
                best = i;
        add_level(&d, h, v + best);
        t += best * h;
        width = 3 * h;
    }
    d.t = t + width / 2;
    return d;
}

// The power of h by which the third difference falls over the two levels that end at `last`.
static double exponent(const descent *d, unsigned last) {
    return log(d->third[last - 2] / d->third[last]) / log(d->h[last - 2] / d->h[last]);
}

static finding look_closely(const line *l, double t, const bl_score_look *look) {
    static const double least[ORDERS] = {0x1p-16, 1e-3, 1e-2};
    descent d = descend(l, t);
    finding f = {.order = UNRESOLVED};
    unsigned last = d.levels - 1;
    place_of(l, d.t, f.at);
    if (exponent(&d, last) < 0.5 && d.step[last] > least[0] * look->range) {
        f.order = 0;
        f.size = d.step[last];
        return f;
    }
    // Rounding: 2^-46 of the values, sums of some hundred terms, and that of the coordinates times
    // the slope. Values rounded to floats, or taken at rounded places, end in steps that no longer
    // shrink.
    double far = 0, slope = look->range / look->cell;
    for (int a = 0; a < BL_AXES; a++)
        far = fmax(far, fabs(f.at[a]));
    for (unsigned k = 0; k < d.levels; k++)
        slope = fmax(slope, d.step[k] / d.h[k]);
    double noise =
        0x1p-46 * (fabs(look->mean) + look->range) + 0x1p-46 * (far + look->cell) * slope;
    noise = fmax(noise, 8 * d.third[last]);
    while (last > 0 && !(d.third[last] > noise))
        last--;
    if (last < 2 || d.h[last - 2] > look->finest / 8) {
        // The next level has nothing but noise, which hides no more than this.
        unsigned next = d.third[0] > noise ? last + 1 : 0;
        f.order = SMOOTH;
        for (int order = 1; order < ORDERS; order++)
            if (noise / pow(d.h[next], order) >
                least[order] * look->deviation / pow(look->cell, order))
                f.order = UNRESOLVED;
        return f;
    }
    double power = exponent(&d, last);
    f.order = SMOOTH;
    for (int order = 1; order < ORDERS; order++)
        if (power < order + 0.5) {
            // At most 2 of a kink h, and 1 of a bend h^2, is what the third difference shows.
            f.size = d.third[last] / pow(d.h[last], order);
            double unit = look->deviation / pow(look->cell, order);
            f.order = f.size > least[order] * unit ? order : SMOOTH;
            break;
        }
    return f;
}

// --- lines --------------------------------------------------------------------------------------

static line line_of(const bl_signal *signal, const bl_score_look *look, size_t index,
                    bl_random *random) {
    line l = {.signal = signal, .h = look->cell / PER_CELL};
    double square = 0;
    for (unsigned a = 0; a < look->dimensions; a++) {
        double along = 2 * bl_random_unit(random) - 1;
        l.unit[a] = index % 2 ? along : a == index / 2 % look->dimensions;
        square += l.unit[a] * l.unit[a];
    }
    for (unsigned a = 0; a < look->dimensions; a++) {
        double middle = (index % 4 == 3 ? 32 : 8) * (bl_random_unit(random) - 0.5);
        l.unit[a] /= sqrt(square);
        l.start[a] = look->cell * (middle - LINE / 2 / (double)PER_CELL * l.unit[a]);
    }
    return l;
}

// The windows of the largest third differences on a line, apart from each other; -1: none.
static void choose(const float *value, int chosen[CANDIDATES]) {
    for (int c = 0; c < CANDIDATES; c++) {
        double largest = -1;
        chosen[c] = -1;
        for (int i = 0; i + 3 < LINE; i++) {
            const double v[4] = {(double)value[i], (double)value[i + 1], (double)value[i + 2],
                                 (double)value[i + 3]};
            int is_near = 0;
            for (int k = 0; k < c; k++)
                is_near |= abs(i - chosen[k]) < 8;
            if (!is_near && third_difference(v) > largest) {
                largest = third_difference(v);
                chosen[c] = i;
            }
        }
    }
}

static void scan(const bl_signal *signal, const bl_score_look *look, size_t index, bl_random random,
                 finding found[CANDIDATES]) {
    float value[LINE];
    double step[BL_AXES];
    int chosen[CANDIDATES];
    line l = line_of(signal, look, index, &random);
    for (int a = 0; a < BL_AXES; a++)
        step[a] = l.h * l.unit[a];
    bl_signal_row(signal, l.start, step, LINE, value);
    choose(value, chosen);
    for (int c = 0; c < CANDIDATES; c++) {
        found[c] = (finding){.order = UNRESOLVED};
        if (chosen[c] >= 0)
            found[c] = look_closely(&l, chosen[c] * l.h, look);
    }
}

// --- special places -----------------------------------------------------------------------------

enum { RAYS = 4, RAY_LEVELS = 7 };

// Values of the reference at a place, and on rays from it: level k is 2^-(8 + 4k) cells away.
typedef struct rays {
    double here, away[RAYS][RAY_LEVELS];
} rays;

static rays see_rays(const bl_signal *signal, const bl_score_look *look, const double at[BL_AXES],
                     bl_random random) {
    enum { COUNT = RAYS * RAY_LEVELS + 1 };
    double column[BL_AXES][COUNT], value[COUNT], unit[RAYS / 2][BL_AXES];
    rays r;
    for (int k = 0; k < RAYS / 2; k++)
        for (int a = 0; a < BL_AXES; a++)
            unit[k][a] = bl_random_unit(&random) - 0.5;
    for (int i = 0; i < COUNT; i++) {
        int ray = i / RAY_LEVELS;
        double away = ldexp(look->cell, -8 - 4 * (i % RAY_LEVELS));
        for (unsigned a = 0; a < BL_AXES; a++)
            column[a][i] = ray == RAYS || a >= look->dimensions // -0.0 stays
                               ? at[a]
                               : at[a] + (ray % 2 ? away : -away) * unit[ray / 2][a];
    }
    bl_signal_values(signal, BL_COLUMNS(column), COUNT, value);
    memcpy(r.away, value, sizeof r.away);
    r.here = value[COUNT - 1];
    return r;
}

// How far the value at the place is from its limit along a ray; 0: it goes there.
static double jump_along(double here, const double away[RAY_LEVELS], const bl_score_look *look) {
    double apart[RAY_LEVELS], least = 0x1p-12 * look->range;
    int last = RAY_LEVELS - 1;
    for (int k = 0; k < RAY_LEVELS; k++)
        apart[k] = fabs(away[k] - here);
    while (last > 0 && apart[last] == 0)
        last--;
    // Coarser than 2^-16 of the finest cell a wave may look like a jump.
    if (last < 2 || ldexp(look->cell, -8 - 4 * last) > 0x1p-12 * look->finest)
        return 0;
    return apart[last] > least && apart[last] > 0.9 * apart[last - 1] &&
                   apart[last - 1] > 0.9 * apart[last - 2]
               ? apart[last]
               : 0;
}

static finding look_at_special(const bl_signal *signal, const bl_score_look *look,
                               const double at[BL_AXES], bl_random random) {
    rays r = see_rays(signal, look, at, random);
    finding f = {.order = SMOOTH};
    for (int k = 0; k < RAYS; k++)
        f.size = fmax(f.size, jump_along(r.here, r.away[k], look));
    if (f.size > 0)
        f.order = 0;
    memcpy(f.at, at, sizeof f.at);
    return f;
}

// The largest jump of all special places.
static finding look_at_specials(const bl_signal *signal, const bl_score_settings *settings,
                                const bl_score_look *look, finding *found) {
    bl_special special;
    finding worst = {.order = SMOOTH};
    bl_random random = bl_score_random(settings, "special", 0);
    bl_special_fill(&special, look->dimensions, look->cell, &random);
#pragma omp parallel for num_threads(bl_thread_count(settings->threads)) schedule(dynamic, 8)
    for (size_t i = 0; i < special.count; i++) {
        const double at[BL_AXES] = {special.at[0][i], special.at[1][i], special.at[2][i],
                                    special.at[3][i]};
        found[i] = look_at_special(signal, look, at, bl_score_random(settings, "special", 1 + i));
    }
    for (size_t i = 0; i < special.count; i++)
        worst = found[i].size > worst.size ? found[i] : worst;
    return worst;
}

// --- the verdict --------------------------------------------------------------------------------

typedef struct summary {
    finding largest[ORDERS]; // size 0: none
    size_t unresolved, places;
} summary;

static summary summarise(const finding *found, size_t count) {
    summary s = {.places = count};
    for (size_t i = 0; i < count; i++) {
        int order = found[i].order;
        s.unresolved += order == UNRESOLVED;
        if (order < ORDERS && found[i].size > s.largest[order].size)
            s.largest[order] = found[i];
    }
    return s;
}

// Across a power of two far out (overflow.h), as far as the signal is said to be good; if nothing
// is said, where a double still has a fraction of twenty bits.
static void add_far_jump(const bl_signal *signal, const bl_score_settings *settings, summary *s) {
    bl_overflow_place broken[BL_OVERFLOW_KINDS];
    const bl_overflow_place *jump = &broken[BL_OVERFLOW_JUMP];
    bl_overflow_find(signal, settings, broken);
    if (!(jump->from <= bl_overflow_domain(signal, 0x1p32)) || s->largest[0].size > 0)
        return;
    s->largest[0] = (finding){.order = 0, .size = jump->value};
    memcpy(s->largest[0].at, jump->at, sizeof jump->at);
}

static void add_numbers(const summary *s, const bl_score_look *look, int found_class,
                        bl_score_property *result) {
    static const char *const sizes[ORDERS] = {"largest_jump", "largest_kink", "largest_bend"};
    static const char *const places[ORDERS][BL_AXES] = {
        {"jump_at_x", "jump_at_y", "jump_at_z", "jump_at_w"},
        {"kink_at_x", "kink_at_y", "kink_at_z", "kink_at_w"},
        {"bend_at_x", "bend_at_y", "bend_at_z", "bend_at_w"}};
    bl_score_add_seen(result, "class", found_class);
    for (int order = 0; order < ORDERS; order++) {
        bl_score_add_seen(result, sizes[order], s->largest[order].size);
        for (unsigned a = 0; a < look->dimensions && s->largest[order].size > 0; a++)
            bl_score_add_seen(result, places[order][a], s->largest[order].at[a]);
    }
    bl_score_add_exact(result, "places", (double)s->places);
    bl_score_add_exact(result, "unresolved_places", (double)s->unresolved);
}

static void judge(const bl_signal *signal, const summary *s, const bl_score_look *look,
                  bl_score_property *result) {
    static const char *const what[ORDERS] = {"the value", "the first derivative",
                                             "the second derivative"};
    const bl_facts *facts = &signal->facts;
    int is_stated = facts->continuity >= -1;
    bl_score_against against = is_stated ? BL_AGAINST_CLAIM : BL_AGAINST_IDEAL;
    int wanted = is_stated ? facts->continuity : 0, found_class = -1;
    while (found_class + 1 < ORDERS && s->largest[found_class + 1].size == 0)
        found_class++;
    const finding *worst = &s->largest[found_class + 1 < ORDERS ? found_class + 1 : 0];
    char class[16];
    int is_blind = 2 * s->unresolved > s->places && found_class >= 0;
    add_numbers(s, look, found_class, result);
    if (found_class < 0)
        snprintf(result->cell, sizeof result->cell, "jumps %.2g", worst->size);
    else if (is_blind)
        snprintf(result->cell, sizeof result->cell, "C0 at least");
    else
        snprintf(result->cell, sizeof result->cell, "C%d%s", found_class,
                 found_class == ORDERS - 1 ? "+" : "");
    if (found_class < wanted && found_class < ORDERS - 1)
        bl_score_judge(result, BL_VERDICT_FAIL, against,
                       "%s jumps by %.3g at (%.12g, %.12g, %.12g, %.12g); %s %s",
                       what[found_class + 1], worst->size, worst->at[0], worst->at[1], worst->at[2],
                       worst->at[3], is_stated ? "stated" : "wanted",
                       bl_continuity_text(wanted, class, sizeof class));
    else if (is_blind && wanted > 0)
        bl_score_judge(result, BL_VERDICT_INCONCLUSIVE, against,
                       "the value does not jump; its derivatives cannot be seen, because the "
                       "values are rounded too coarsely");
    else if (is_stated && wanted < 0)
        bl_score_judge(result, BL_VERDICT_PASS, against, "stated discontinuous; %s",
                       found_class < 0 ? "its value jumps" : "no jump was found");
    else
        bl_score_judge(result, BL_VERDICT_PASS, against,
                       "no jump up to derivative %d at %zu places", is_blind ? 0 : found_class,
                       s->places);
}

static bl_status measure(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message) {
    const bl_signal *signal = subject->signal;
    bl_score_look look;
    if (!bl_score_look_at(subject, settings, result, &look))
        return BL_OK;
    size_t lines = (size_t)bl_size_pick(settings->size, 48, 192, 1536);
    size_t count = lines * CANDIDATES;
    finding *found = malloc((count + BL_SPECIAL_MOST) * sizeof *found);
    if (!found)
        return bl_score_no_memory(result, message);
#pragma omp parallel for num_threads(bl_thread_count(settings->threads)) schedule(dynamic)
    for (size_t i = 0; i < lines; i++)
        scan(signal, &look, i, bl_score_random(settings, "continuity", i), found + i * CANDIDATES);
    summary s = summarise(found, count);
    finding special = look_at_specials(signal, settings, &look, found + count);
    if (special.size > s.largest[0].size)
        s.largest[0] = special;
    add_far_jump(signal, settings, &s);
    judge(signal, &s, &look, result);
    free(found);
    return BL_OK;
}

BL_PROPERTY_DESCRIPTOR(continuity) = {
    .name = "continuity",
    .title = "continuity",
    .entry = "the class, C0 and up (C2+: 2 or more), or the largest jump",
    .question = "Does the value, or a derivative of it, jump?",
    .measure = measure,
};
