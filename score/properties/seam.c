// SPDX-License-Identifier: MIT
//
// Seam: whether a picture fits at its edges when it is repeated.
//
// Along each axis, the sample behind the last one is the first. Differences of the first, second
// and third order (jumps, slopes that break, curvatures) that reach across the edge are held
// against the same differences inside: for each order d, the mean square over many lines of the d
// differences that cross the edge, and of every d neighbours inside. Of a picture that fits, and
// whose lines are alike, the edge is a place as any other: its logarithm is one of those inside. It
// is told by Student's t from the mean and the deviation of those, with the degrees of freedom that
// their correlation leaves (Bartlett): places near each other are alike. Logarithms of mean squares
// have short tails above, so that the rate of false alarms is below what is asked; the tests hold
// it. A jump far below those inside is told too: the last samples are the first ones once more.
//
// A picture that is its own mirror image at the edge fits in value and breaks in slope there. It
// does the same in its middle, which is therefore left out of what is inside.
//
// A picture of few places or of sharp edges, whose differences inside are of all sizes, hides more
// at its edge; `told_from_..._db` says from where on a seam shows. White noise fits any way it is
// cut, and a cut along a line of equal neighbours does not show: what does not show is a pass.
//
// The verdict is against the claim where the picture states that it repeats (wrap=periodic), and
// else against the ideal. With wrap=mirror the edge fits by itself.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/grid.h"
#include "score/properties/places.h"

enum { ORDERS = 3, LEAST_SIZE = 12, SMALL_SIZE = 32, LEAST_PLACES = 4 };
#define FLOOR 1e-6    // of the mean square inside: what is below counts as this
#define ROUNDING 1e-6 // of the largest value
#define SUSPICIOUS 1e-3
#define HARDLY 40.0 // dB: from there on hardly any seam would show

static const char *const order_words[ORDERS] = {"jumps", "slopes", "curvatures"};
static const char *const order_names[ORDERS][BL_AXES] = {
    {"jump_x_db", "jump_y_db", "jump_z_db", "jump_w_db"},
    {"slope_x_db", "slope_y_db", "slope_z_db", "slope_w_db"},
    {"curvature_x_db", "curvature_y_db", "curvature_z_db", "curvature_w_db"}};
static const char *const told_names[BL_AXES] = {"told_from_x_db", "told_from_y_db",
                                                "told_from_z_db", "told_from_w_db"};

// Of one axis: the mean squares of differences, of order d at d - 1, that start at each place.
typedef struct edge {
    size_t size, lines;
    double *square[ORDERS]; // [size]
    double largest;         // of the values, in size
    double jump_squares;    // of the first differences at the edge
    int is_mirror;          // 1: f(i) = f(-1 - i), 2: f(i) = f(-i); 0: neither
    int is_repeated;        // the last sample is the first, and no other is its neighbour
    int is_finite;
} edge;

typedef struct finding {
    double db, t, limit, told_db; // told_db: from where on it is told
    int is_told, is_suspicious, is_below;
} finding;

static void edge_free(edge *e) {
    for (int d = 0; d < ORDERS; d++)
        free(e->square[d]);
}

// --- the samples --------------------------------------------------------------------------------

// Adds one line, whose squares all lines share; `mirrors` counts the lines that are mirror images.
static void add_line(edge *e, const float *value, size_t mirrors[2]) {
    size_t n = e->size;
    double near = 0;
    for (size_t i = 0; i < n; i++) {
        double difference[ORDERS + 1];
        for (int k = 0; k <= ORDERS; k++)
            difference[k] = (double)value[(i + (size_t)k) % n];
        e->is_finite &= isfinite(value[i]);
        e->largest = fmax(e->largest, fabs(difference[0]));
        for (int d = 0; d < ORDERS; d++) {
            for (int k = 0; k < ORDERS - d; k++)
                difference[k] = difference[k + 1] - difference[k];
            e->square[d][i] += difference[0] * difference[0];
        }
    }
    near = ROUNDING * e->largest;
    for (int kind = 0; kind < 2; kind++) {
        int is_mirror = 1;
        for (size_t i = (size_t)kind; i < n / 2 && is_mirror; i++)
            is_mirror = fabs((double)value[i] - (double)value[n - 1 - i + (size_t)kind]) <= near;
        mirrors[kind] += (size_t)is_mirror;
    }
}

// Reads lines along the axis, spread over all there are. Returns 0 out of memory.
static int read_lines(const bl_signal *signal, unsigned axis, size_t most, edge *e) {
    const bl_extent *picture = &signal->picture;
    size_t all = 1, mirrors[2] = {0};
    double step[BL_AXES] = {0};
    *e = (edge){.size = picture->size[axis], .is_finite = 1};
    for (unsigned a = 0; a < signal->dimensions; a++)
        all *= a == axis ? 1 : picture->size[a];
    e->lines = all < most / e->size ? all : most / e->size ? most / e->size : 1;
    float *value = malloc(e->size * sizeof *value);
    int good = value != NULL;
    for (int d = 0; d < ORDERS; d++)
        good &= (e->square[d] = calloc(e->size, sizeof *e->square[d])) != NULL;
    step[axis] = picture->spacing[axis];
    for (size_t line = 0; line < e->lines && good; line++) {
        double start[BL_AXES] = {0};
        size_t rest = (size_t)((double)line * (double)all / (double)e->lines);
        for (unsigned a = 0; a < signal->dimensions; a++) {
            if (a == axis)
                continue;
            start[a] = (double)(rest % picture->size[a]) * picture->spacing[a];
            rest /= picture->size[a];
        }
        bl_signal_row(signal, start, step, e->size, value);
        add_line(e, value, mirrors);
    }
    e->is_mirror = mirrors[0] == e->lines ? 1 : mirrors[1] == e->lines ? 2 : 0;
    for (int d = 0; d < ORDERS && good; d++)
        for (size_t i = 0; i < e->size; i++)
            e->square[d][i] /= (double)e->lines;
    free(value);
    return good;
}

// --- the edge against the inside ----------------------------------------------------------------

// The mean of `order` neighbours from place i on, across the edge where it ends there.
static double mean_from(const edge *e, int order, size_t i) {
    double sum = 0;
    for (int k = 0; k < order; k++)
        sum += e->square[order - 1][(i + (size_t)k) % e->size];
    return sum / order;
}

// Whether the differences of `order` neighbours from place i on reach over the middle of a picture
// that is its own mirror image.
static int is_in_the_middle(const edge *e, int order, size_t i) {
    size_t middle = e->size / 2, end = i + 2 * (size_t)order - 1; // the last sample
    return e->is_mirror && i <= middle && end + 1 >= middle;
}

// How many independent numbers a series is worth for its mean, and how many degrees of freedom it
// leaves to its variance: n over the sums of its correlations, and of their squares.
static void count_independent(const double *x, size_t n, double mean, double variance,
                              double *for_mean, double *freedom) {
    double sum = 1, squares = 1;
    for (size_t lag = 1; lag <= n / 4 && variance > 0; lag++) {
        double product = 0;
        for (size_t i = 0; i + lag < n; i++)
            product += (x[i] - mean) * (x[i + lag] - mean);
        double correlation = product / (double)(n - lag) / variance;
        if (correlation * correlation * (double)(n - lag) < 2) // its own error, and beyond
            break;
        sum += 2 * fmax(0, correlation);
        squares += 2 * correlation * correlation;
    }
    *for_mean = (double)n / sum;
    *freedom = (double)n / squares - 1;
}

static finding compare(const edge *e, int order, double alpha, double *room) {
    size_t count = 0;
    double inside = 0, mean = 0, variance = 0, lower = INFINITY, upper = 0, independent, freedom;
    for (size_t i = 0; i + 2 * (size_t)order <= e->size; i++)
        if (!is_in_the_middle(e, order, i)) {
            inside += room[count] = mean_from(e, order, i);
            lower = fmin(lower, room[count]);
            upper = fmax(upper, room[count++]);
        }
    double rounding = ROUNDING * e->largest, seam = mean_from(e, order, e->size - (size_t)order);
    double least = fmax(FLOOR * inside / (double)count, rounding * rounding);
    for (size_t i = 0; i < count; i++)
        mean += (room[i] = log(room[i] + least)) / (double)count;
    for (size_t i = 0; i < count; i++)
        variance += (room[i] - mean) * (room[i] - mean) / (double)(count - 1);
    if (variance < 1e-16) // rounding errors of equal numbers
        variance = 0;
    count_independent(room, count, mean, variance, &independent, &freedom);
    // The variance about a mean that few numbers make is too small by that.
    double spread =
        sqrt(variance * independent / fmax(0.5, independent - 1) * (1 + 1 / independent));
    double off = log(seam + least) - mean, decibels = 10 / M_LN10;
    finding f = {.db = decibels * off, .is_below = off < 0};
    if (fabs(off) < 1e-9)
        return f;
    f.t = off / fmax(spread, 1e-9);
    f.limit = freedom >= LEAST_PLACES ? -bl_student_quantile(alpha, freedom) : INFINITY;
    f.told_db = decibels * spread * f.limit;
    // The edge is as the inside where the inside has as much somewhere, or as little. What lies
    // below says something only of jumps: equal samples.
    int is_equal = seam <= rounding * rounding && lower > rounding * rounding;
    int counts = f.is_below ? order == 1 && is_equal : seam > upper * (1 + 1e-6);
    f.is_told = counts && fabs(f.t) > f.limit;
    f.is_suspicious =
        counts &&
        fabs(f.t) > (freedom >= LEAST_PLACES ? -bl_student_quantile(SUSPICIOUS / 2, freedom) : 10);
    return f;
}

// --- the verdict --------------------------------------------------------------------------------

typedef struct axis_result {
    finding order[ORDERS];
    const finding *worst;
    int is_told, is_suspicious, is_mirror;
} axis_result;

static axis_result judge_axis(const edge *e, double alpha, double *room) {
    axis_result r = {.is_mirror = e->is_mirror};
    for (int d = 0; d < ORDERS; d++) {
        r.order[d] = compare(e, d + 1, alpha, room);
        r.is_told |= r.order[d].is_told;
        r.is_suspicious |= r.order[d].is_suspicious;
    }
    return r;
}

// The order that shows most.
static int worst_of(const axis_result *r) {
    int worst = 0;
    for (int d = 1; d < ORDERS; d++)
        if (r->order[d].t > r->order[worst].t || (r->order[worst].is_below && r->is_told))
            worst = d;
    return worst;
}

// "along x slopes are 12.3 dB above those inside".
static void tell_axis(const axis_result *r, unsigned axis, char *text, size_t size) {
    int worst = worst_of(r);
    const finding *f = &r->order[worst];
    if (r->is_mirror)
        snprintf(text, size,
                 "along %c the edge is a mirror: values fit, and %s are %.1f dB above those inside",
                 "xyzw"[axis], order_words[worst], f -> db);
    else if (f->is_below)
        snprintf(text, size, "along %c the last samples are the first ones once more",
                 "xyzw"[axis]);
    else
        snprintf(text, size, "along %c %s are %.1f dB above those inside", "xyzw"[axis],
                 order_words[worst], f -> db);
}

static void judge(const axis_result *r, unsigned axes, int is_small, bl_score_against against,
                  double alpha, bl_score_property *result) {
    char told[BL_AXES * 100] = "", whole[16] = "";
    int fails = 0, suspicious = 0, said = 0, fit = 0;
    double from = -INFINITY;
    for (unsigned a = 0; a < axes; a++) {
        fails |= r[a].is_told;
        suspicious |= r[a].is_suspicious;
    }
    for (unsigned a = 0; a < axes; a++) {
        size_t used = strlen(told);
        int shows = fails ? r[a].is_told : r[a].is_suspicious;
        from = fmax(from, r[a].order[0].told_db);
        if (shows) {
            snprintf(told + used, sizeof told - used, "%s", said++ ? "; " : "");
            used = strlen(told);
            tell_axis(&r[a], a, told + used, sizeof told - used);
        } else {
            snprintf(whole + strlen(whole), sizeof whole - strlen(whole), "%s%c", fit++ ? ", " : "",
                     "xyzw"[a]);
        }
    }
    size_t used = strlen(told);
    if (fit && fails)
        snprintf(told + used, sizeof told - used, "; along %s it fits", whole);
    snprintf(result->cell, sizeof result->cell, "fits");
    if (fails || suspicious) {
        size_t cell = (size_t)snprintf(result->cell, sizeof result->cell, "along");
        for (unsigned a = 0; a < axes; a++)
            if (fails ? r[a].is_told : r[a].is_suspicious)
                cell += (size_t)snprintf(result->cell + cell, sizeof result->cell - cell, " %c",
                                         "xyzw"[a]);
    }
    if (fails)
        bl_score_judge(result, BL_VERDICT_FAIL, against, "%s", told);
    else if (suspicious)
        bl_score_judge(result, BL_VERDICT_INCONCLUSIVE, against,
                       "%s, which a picture that fits shows once in %.0f; a larger picture tells",
                       told, 1 / SUSPICIOUS);
    else if (from > HARDLY && is_small)
        bl_score_judge(result, BL_VERDICT_INCONCLUSIVE, against,
                       "no seam shows along %s, but so few samples would hardly show one", whole);
    else if (from > HARDLY)
        bl_score_judge(result, BL_VERDICT_PASS, against,
                       "along %s the edge is as the inside, which has jumps of all sizes: a seam "
                       "would hardly show",
                       whole);
    else
        bl_score_judge(result, BL_VERDICT_PASS, against,
                       "along %s the edge is as the inside; a jump of %.1f dB above those inside "
                       "would show, with an error of %.1g",
                       whole, from, alpha);
}

static bl_status measure(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message) {
    const bl_signal *signal = subject->signal;
    const bl_extent *picture = &signal->picture;
    unsigned axes = signal->dimensions;
    size_t most = (size_t)bl_size_pick(settings->size, 1 << 20, 1 << 22, 1 << 24);
    axis_result r[BL_AXES];
    int is_small = 0;
    bl_score_against against = BL_AGAINST_IDEAL;
    if (!picture->size[0]) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL, BL_SCORE_NO_PICTURE);
        return BL_OK;
    }
    for (unsigned a = 0; a < axes; a++) {
        double length = (double)picture->size[a] * picture->spacing[a];
        if (signal->facts.period[a] > 1.5 * length) {
            bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL,
                           "beyond the edge stands the mirror image, which fits by itself; "
                           "wrap=periodic asks whether the picture does");
            return BL_OK;
        }
        if (signal->facts.period[a] > 0)
            against = BL_AGAINST_CLAIM;
        is_small |= picture->size[a] < SMALL_SIZE;
        if (picture->size[a] < LEAST_SIZE) {
            bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL,
                           "%zu samples along %c are too few to tell an edge from the inside",
                           picture->size[a], "xyzw"[a]);
            return BL_OK;
        }
    }
    double alpha = settings->alpha / (axes * (ORDERS + 1.0));
    for (unsigned a = 0; a < axes; a++) {
        edge e;
        double *room = malloc(picture->size[a] * sizeof *room);
        int good = read_lines(signal, a, most, &e) && room;
        if (good && e.is_finite)
            r[a] = judge_axis(&e, alpha, room);
        edge_free(&e);
        free(room);
        if (!good)
            return bl_score_no_memory(result, message);
        if (!e.is_finite) {
            bl_score_not_finite(result);
            return BL_OK;
        }
        for (int d = 0; d < ORDERS; d++)
            bl_score_add_seen(result, order_names[d][a], r[a].order[d].db);
        bl_score_add_seen(result, told_names[a], r[a].order[0].told_db);
    }
    judge(r, axes, is_small, against, settings->alpha, result);
    return BL_OK;
}

BL_PROPERTY_DESCRIPTOR(seam) = {
    .name = "seam",
    .title = "seam",
    .paper = "bandlimit",
    .entry = "of a picture: along which axes its edges show when it is repeated",
    .question = "Does a picture fit at its edges when it is repeated?",
    .measure = measure,
};
