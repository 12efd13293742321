// SPDX-License-Identifier: MIT
//
// The period: exact repeats, and hidden lines of the lattice in the spectrum.
//
// Repeats. From one place, a row of steps of one cell along an axis tells every repeat within some
// ten thousand cells; farther out the shifts 2^k, 3 2^k and 10^k cells are tried up to 2^40, and
// what the signal states, also backwards and divided by small primes. When a shift is a repeat,
// says sameness.h; a signal that hardly ever differs is not judged. Repeats by vectors across the
// axes are sought too (vectors.h). Farther out than a function has distinct values there are no
// repeats to find, and the reason says how far that is. There is no chance in it.
//
// Lines. A mean that depends on the phase in the cell, or a long period, is a line in the spectrum:
// all its power in one bin of a periodogram, however long. One long row along each axis, at 8
// samples a cell under a Blackman-Harris window, is transformed; each bin is compared with the mean
// of 128 bins around it, 6 to 69 bins away on both sides. Bins of a smooth spectrum are exponential
// and neighbours under the window correlated, so the 128 are worth at least m = 48 independent
// ones: P(bin > u mean) = (1 + u/m)^-m, an F distribution with 2 and 2m degrees. At multiples of
// half a cycle a cell a cyclostationary noise has bins up to chi-square with one degree of freedom,
// whose tail is the root of that: there u is doubled. All bins share alpha. Lines more than 80 dB
// below the variance are rounding and not counted, and an axis with a stated period has its own
// lines. A line does not refute a stated period of 0; it is judged against the ideal alone.
#include "score/properties/sameness.h"
#include "score/properties/vectors.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/fft.h"
#include "core/grid.h"
#include "spectra/window.h"

enum { POWER_MOST = 40 };

// --- repeats ------------------------------------------------------------------------------------

typedef struct walk {
    const bl_signal *signal;
    const bl_score_look *look;
    const bl_score_settings *settings;
    unsigned axis;
} walk;

static bl_score_map shift_of(const walk *w, double shift) {
    bl_score_map map = bl_score_identity;
    map.shift[w->axis] = shift * w->look->cell;
    return map;
}

// Whether the signal is the same after `shift` cells.
static int repeats(const walk *w, double shift) {
    bl_score_map map = shift_of(w, shift);
    return bl_score_compare(w->signal, w->look, &map, BL_SAME_PLACES,
                            bl_score_random(w->settings, "period", 1 + w->axis)) == BL_LIKE;
}

// Whether the float points repeat too.
static int points_repeat(const walk *w, double shift) {
    bl_random random = bl_score_random(w->settings, "period", 10 + w->axis);
    double column[BL_AXES][2 * BL_SAME_PLACES];
    float value[2 * BL_SAME_PLACES];
    int equal = 1;
    for (int i = 0; i < BL_SAME_PLACES; i++) {
        double at[BL_AXES];
        bl_score_exact_place(w->look, &random, at);
        for (unsigned a = 0; a < BL_AXES; a++) {
            column[a][i] = at[a];
            column[a][BL_SAME_PLACES + i] = at[a] + (a == w->axis ? shift * w->look->cell : 0);
        }
    }
    bl_signal_points(w->signal, BL_COLUMNS(column), 2 * BL_SAME_PLACES, value);
    for (int i = 0; i < BL_SAME_PLACES; i++) {
        const double at[BL_AXES] = {column[0][BL_SAME_PLACES + i], column[1][BL_SAME_PLACES + i],
                                    column[2][BL_SAME_PLACES + i], column[3][BL_SAME_PLACES + i]};
        double change = bl_score_change_by_rounding(w->signal, w->look, at);
        equal &= change >= BL_SILENT * w->look->range ||
                 fabs((double)value[i] - (double)value[BL_SAME_PLACES + i]) <=
                     10 * BL_SAME * w->look->range + 2 * change;
    }
    return equal;
}

// The smallest repeat in a row of cells; 0: none; -1: out of memory.
static double walk_cells(const walk *w, size_t cells) {
    bl_random random = bl_score_random(w->settings, "period", 20);
    double start[BL_AXES], step[BL_AXES] = {0}, found = 0;
    float *value = malloc((cells + 1) * sizeof *value);
    if (!value)
        return -1;
    bl_score_exact_place(w->look, &random, start);
    // Half a cell: floats keep it far out, and noises of a lattice are not 0 there.
    start[w->axis] = w->look->cell * (floor(start[w->axis] / w->look->cell) + 0.5);
    step[w->axis] = w->look->cell;
    bl_signal_row(w->signal, start, step, cells + 1, value);
    for (size_t i = 1; i <= cells && found == 0; i++)
        if (fabs((double)value[i] - (double)value[0]) <= 2 * BL_SAME * w->look->range &&
            repeats(w, (double)i))
            found = (double)i;
    free(value);
    return found;
}

// The smallest repeat among all that are tried; 0: none; -1: out of memory.
static double smallest_repeat(const walk *w, double stated) {
    static const double primes[] = {2, 3, 5, 7};
    size_t cells = (size_t)bl_size_pick(w->settings->size, 8192, 131072, 1048576);
    double found = walk_cells(w, cells), tried[3 * POWER_MOST + 8];
    int count = 0;
    if (found != 0)
        return found;
    for (int k = 0; k <= POWER_MOST; k++) {
        tried[count++] = ldexp(1, k);
        tried[count++] = k < POWER_MOST ? ldexp(3, k) : ldexp(1, 32) - 1;
        if (k <= 12)
            tried[count++] = pow(10, k);
    }
    for (int k = 0; k < 4 && stated > 0; k++)
        if (fmod(stated, primes[k]) == 0)
            tried[count++] = stated / primes[k];
    if (stated > 0)
        tried[count++] = stated;
    for (int i = 0; i < count; i++)
        if (tried[i] > (double)cells && (found == 0 || tried[i] < found) && repeats(w, tried[i]))
            found = tried[i];
    return found;
}

// The farthest power of two of cells where half of the eighths of a cell have values of their own.
static double distinct_up_to(const walk *w) {
    enum { EIGHTHS = 32 };
    int power = 0;
    for (int k = 1; k <= POWER_MOST; k++) {
        bl_random random = bl_score_random(w->settings, "period", 40 + w->axis);
        double at[BL_AXES], last = NAN;
        int distinct = 0;
        bl_score_exact_place(w->look, &random, at);
        for (int i = 0; i < EIGHTHS; i++) {
            at[w->axis] = w->look->cell * (ldexp(1, k) + 0.125 * i);
            double value = bl_signal_value(w->signal, at);
            distinct += isfinite(value) && value != last;
            last = value;
        }
        if (2 * distinct < EIGHTHS)
            break;
        power = k;
    }
    return ldexp(1, power);
}

// --- lines --------------------------------------------------------------------------------------

enum { RATE = 8, INNER = 6, OUTER = 69, WORTH = 48 };

typedef struct strongest {
    double excess;    // over the limit: u / limit
    double ratio;     // u
    double frequency; // cycles a cell
} strongest;

static double limit_of(double p) {
    return WORTH * (pow(p, -1.0 / WORTH) - 1);
}

static strongest find_line(const double *power, size_t bins, size_t cells, double total, double p) {
    strongest best = {0, 0, 0};
    double limit = limit_of(p / (double)bins);
    for (size_t k = OUTER + 1; k + OUTER + 1 < bins; k++) {
        double around = 0;
        for (size_t j = INNER; j <= OUTER; j++)
            around += (power[k - j] + power[k + j]) / (2 * (OUTER - INNER + 1));
        size_t from_half = (2 * k + cells / 2) % cells; // of half a cycle, in half bins
        int is_half = from_half + 12 >= cells / 2 && from_half <= cells / 2 + 12;
        double ratio = power[k] / around, excess = ratio / (is_half ? 2 * limit : limit);
        if (power[k] > 1e-8 * total && excess > best.excess)
            best = (strongest){excess, ratio, (double)k / (double)cells};
    }
    return best;
}

static bl_status measure_line(const walk *w, double p, strongest *best, bl_message *message) {
    size_t size = (size_t)bl_size_pick(w->settings->size, 1 << 14, 1 << 17, 1 << 20),
           bins = size / 2;
    bl_fft_shape shape = {
        .kind = BL_FFT_REAL, .precision = BL_FFT_DOUBLE, .dims = 1, .size = {size}};
    const bl_fft *plan;
    bl_status status = bl_fft_plan(&shape, &plan, message);
    if (status != BL_OK)
        return status;
    double *buffer = bl_fft_buffer(bl_fft_bytes(&shape)), *window = malloc(size * sizeof *window);
    float *row = malloc(size * sizeof *row);
    if (buffer && window && row) {
        double start[BL_AXES] = {0}, step[BL_AXES] = {0}, mean = 0, total = 0;
        bl_random random = bl_score_random(w->settings, "period", 30 + w->axis);
        bl_window_fill(BL_WINDOW_BLACKMAN_HARRIS, size, window);
        for (unsigned a = 0; a < w->look->dimensions; a++)
            start[a] =
                bl_score_base(&random, w->look->cell) + w->look->cell * bl_random_unit(&random);
        step[w->axis] = w->look->cell / RATE;
        bl_signal_row(w->signal, start, step, size, row);
        for (size_t i = 0; i < size; i++)
            mean += (double)row[i] / (double)size;
        for (size_t i = 0; i < size; i++)
            buffer[i] = ((double)row[i] - mean) * window[i];
        bl_fft_run(plan, buffer);
        for (size_t k = 0; k < bins; k++) {
            buffer[k] = buffer[2 * k] * buffer[2 * k] + buffer[2 * k + 1] * buffer[2 * k + 1];
            total += buffer[k];
        }
        *best = find_line(buffer, bins, size / RATE, total, p);
    } else {
        status = bl_report(message, BL_DEVICE, "out of memory for a row of %zu samples", size);
    }
    free(buffer);
    free(window);
    free(row);
    return status;
}

// --- the verdict --------------------------------------------------------------------------------

typedef struct axis_result {
    double stated, repeat; // stated: NAN if it is not
    int is_true;           // the stated period holds, in both directions
    double reach;          // cells up to which values are distinct
    strongest line;
} axis_result;

static bl_status measure_axis(const walk *w, axis_result *r, bl_message *message) {
    double cell = w->look->cell;
    r->stated = w->signal->facts.period[w->axis] / cell;
    r->repeat = smallest_repeat(w, r->stated);
    r->is_true = 1;
    for (int sign = -1; sign <= 1 && r->stated > 0; sign += 2)
        r->is_true &= repeats(w, sign * r->stated) && points_repeat(w, sign * r->stated);
    if (r->repeat < 0)
        return bl_report(message, BL_DEVICE, "out of memory for a row");
    r->reach = distinct_up_to(w);
    if (r->stated > 0 || r->repeat > 0)
        return BL_OK;
    return measure_line(w, w->settings->alpha / w->look->dimensions, &r->line, message);
}

// The verdict on the repeats: against the claim if any axis has one. A tile of a file states how
// large it is, and not that it is the smallest.
static void judge_repeats(const axis_result *r, unsigned axes, double cell, int is_tile,
                          int *is_stated, bl_score_property *result) {
    *is_stated = 1;
    for (unsigned a = 0; a < axes; a++)
        *is_stated = *is_stated && !isnan(r[a].stated);
    for (unsigned a = 0; a < axes; a++) {
        bl_score_against against = isnan(r[a].stated) ? BL_AGAINST_IDEAL : BL_AGAINST_CLAIM;
        if (!r[a].is_true)
            bl_score_judge(result, BL_VERDICT_FAIL, against,
                           "states a period of %.10g along %c: no", r[a].stated * cell, "xyzw"[a]);
        else if (r[a].repeat > 0 && !(r[a].repeat >= r[a].stated && r[a].stated > 0))
            bl_score_judge(result, BL_VERDICT_FAIL, is_tile ? BL_AGAINST_IDEAL : against,
                           "repeats after %.10g along %c; %s", r[a].repeat * cell, "xyzw"[a],
                           isnan(r[a].stated) ? "nothing is stated"
                           : r[a].stated > 0  ? "more is stated"
                                              : "no period is stated");
        else
            continue;
        return;
    }
}

// "57, -1, 0": in units.
static void judge_vector(const double vector[BL_AXES], unsigned axes, double cell,
                         bl_score_property *result) {
    static const char *const names[] = {"vector_x", "vector_y", "vector_z", "vector_w"};
    char text[96] = "";
    size_t used = 0;
    int is_one = 0;
    for (unsigned a = 0; a < axes; a++) {
        is_one |= vector[a] != 0;
        bl_score_add_seen(result, names[a], vector[a] * cell);
        if (used < sizeof text)
            used += (size_t)snprintf(text + used, sizeof text - used, "%s%.10g", a ? ", " : "",
                                     vector[a] * cell);
    }
    if (!is_one || result->verdict == BL_VERDICT_FAIL)
        return;
    snprintf(result->cell, sizeof result->cell, "%.23s", text);
    bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_IDEAL, "repeats after the vector (%s)",
                   text);
}

static void judge(const axis_result *r, unsigned axes, double cell, const double vector[BL_AXES],
                  int is_tile, bl_score_property *result) {
    double reach = INFINITY;
    static const char *const repeat_names[] = {"repeat_x", "repeat_y", "repeat_z", "repeat_w"};
    double smallest = INFINITY;
    int is_stated, line_axis = -1;
    strongest line = {0, 0, 0};
    for (unsigned a = 0; a < axes; a++) {
        bl_score_add_seen(result, repeat_names[a], r[a].repeat * cell);
        if (r[a].repeat > 0)
            smallest = fmin(smallest, r[a].repeat * cell);
        reach = fmin(reach, r[a].reach);
        if (r[a].line.excess > line.excess)
            line = r[a].line, line_axis = (int)a;
    }
    bl_score_add_seen(result, "strongest_line_db", line_axis < 0 ? NAN : 10 * log10(line.ratio));
    bl_score_add_seen(result, "strongest_line_frequency",
                      line_axis < 0 ? NAN : line.frequency / cell);
    bl_score_add_seen(result, "line_to_limit_db", line_axis < 0 ? NAN : 10 * log10(line.excess));
    if (isinf(smallest) && line.excess > 1)
        snprintf(result->cell, sizeof result->cell, "line %.3g", line.frequency / cell);
    else if (isinf(smallest))
        snprintf(result->cell, sizeof result->cell, "none");
    else
        snprintf(result->cell, sizeof result->cell, "%.10g", smallest);
    judge_repeats(r, axes, cell, is_tile, &is_stated, result);
    judge_vector(vector, axes, cell, result);
    if (result->verdict == BL_VERDICT_FAIL)
        return;
    if (line.excess > 1)
        bl_score_judge(result, is_stated ? BL_VERDICT_PASS : BL_VERDICT_FAIL,
                       is_stated ? BL_AGAINST_CLAIM : BL_AGAINST_IDEAL,
                       "%sa spectral line of %.3g cycles a unit along %c, %.1f dB above its "
                       "surroundings",
                       is_stated ? "the stated periods hold; but " : "", line.frequency / cell,
                       "xyzw"[line_axis], 10 * log10(line.ratio));
    else
        bl_score_judge(result, BL_VERDICT_PASS, is_stated ? BL_AGAINST_CLAIM : BL_AGAINST_IDEAL,
                       "%s, no other repeat up to %.3g units%s, and no spectral line",
                       isinf(smallest) ? "no period" : "the stated period holds", reach * cell,
                       reach < ldexp(1, POWER_MOST) ? ", where its values cease to be distinct"
                                                    : "");
}

static bl_status measure(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message) {
    bl_score_look look;
    bl_status statuses[BL_AXES] = {BL_OK};
    bl_message messages[BL_AXES];
    axis_result axes[BL_AXES] = {{0}};
    if (!bl_score_look_at(subject, settings, result, &look))
        return BL_OK;
    if (bl_score_is_nearly_constant(subject->signal, &look,
                                    bl_score_random(settings, "period", 1))) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL,
                       "the signal is too nearly constant to tell a repeat");
        return BL_OK;
    }
#pragma omp parallel for num_threads(bl_thread_count(settings->threads)) schedule(dynamic)
    for (unsigned a = 0; a < look.dimensions; a++) {
        walk w = {subject->signal, &look, settings, a};
        statuses[a] = measure_axis(&w, &axes[a], &messages[a]);
    }
    for (unsigned a = 0; a < look.dimensions; a++)
        if (statuses[a] != BL_OK) {
            bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL, "out of memory");
            return bl_report(message, statuses[a], "%s", messages[a].text);
        }
    double along[BL_AXES] = {0}, vector[BL_AXES];
    for (unsigned a = 0; a < look.dimensions; a++)
        along[a] = axes[a].repeat > 0 ? axes[a].repeat : fmax(0, axes[a].stated); // NaN: 0
    bl_status status =
        bl_score_find_vector(subject->signal, &look, settings, along, vector, message);
    if (status != BL_OK)
        return bl_score_no_memory(result, message);
    const bl_signal *signal = subject->signal;
    int is_tile = !signal->definition && signal->seed_offset == SIZE_MAX;
    judge(axes, look.dimensions, look.cell, vector, is_tile, result);
    return BL_OK;
}

BL_PROPERTY_DESCRIPTOR(period) = {
    .name = "period",
    .title = "period",
    .paper = "peachey2003, p. 68",
    .entry = "the shortest repeat, in units; or a spectral line, in cycles a unit",
    .question = "Does the noise repeat, or hide lines of its lattice in the spectrum?",
    .measure = measure,
};
