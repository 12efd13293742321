// SPDX-License-Identifier: MIT
#include "score/properties/scale.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/statistics.h"
#include "score/properties/places.h"
#include "score/properties/sampling.h"

// --- distance -----------------------------------------------------------------------------------

enum { LOWEST = -20, HIGHEST = 20, DISTANCES = HIGHEST - LOWEST + 1 }; // h = 4^k
enum { SEEDS = 8, PAIRS = 32 };

static const double RELATED = 0.5; // r below this

// The signal with fresh seeds, made once: some signals are slow to make.
typedef struct seeds {
    bl_score_fresh fresh[SEEDS];
} seeds;

static seeds seeds_open(const bl_signal *signal, const bl_score_settings *settings) {
    seeds all;
    bl_random random = bl_score_random(settings, "scale", 0);
    for (int s = 0; s < SEEDS; s++)
        all.fresh[s] = bl_score_fresh_open(signal, bl_random_bits(&random));
    return all;
}

static void seeds_close(seeds *all) {
    for (int s = 0; s < SEEDS; s++)
        bl_score_fresh_close(&all->fresh[s]);
}

// r(h) along an axis; NAN where the values do not vary, or half of them are no number.
static double unrelatedness(const seeds *all, const bl_score_settings *settings, unsigned axis,
                            int k) {
    const double h = ldexp(1, 2 * k);
    bl_random random =
        bl_score_random(settings, "scale", 1 + (uint64_t)(k - LOWEST) * BL_AXES + axis);
    bl_moments moments = {.n = 0};
    double squares = 0;
    int pairs = 0;
    for (int s = 0; s < SEEDS; s++) {
        double column[BL_AXES][2 * PAIRS];
        float value[2 * PAIRS];
        for (int i = 0; i < PAIRS; i++) {
            for (int a = 0; a < BL_AXES; a++)
                column[a][2 * i] = column[a][2 * i + 1] = 512 * h * (bl_random_unit(&random) - 0.5);
            column[axis][2 * i + 1] += h * (1 + bl_random_unit(&random));
        }
        bl_signal_points(all->fresh[s].signal, BL_COLUMNS(column), 2 * PAIRS, value);
        for (int i = 0; i < PAIRS; i++) {
            double here = (double)value[2 * i], there = (double)value[2 * i + 1];
            if (!isfinite(here) || !isfinite(there))
                continue;
            pairs++;
            bl_moments_add(&moments, here);
            bl_moments_add(&moments, there);
            squares += (there - here) * (there - here);
        }
    }
    double variance = bl_moments_variance(&moments);
    // Rounding of a constant is no variance.
    return 2 * pairs > SEEDS * PAIRS && variance > 1e-12 * moments.mean * moments.mean
               ? squares / pairs / (2 * variance)
               : NAN;
}

// The correlation length along an axis, by the line through r on both sides of 1/2.
static bl_score_scale scale_along(const seeds *all, const bl_score_settings *settings,
                                  unsigned axis) {
    double r[DISTANCES];
    int first = -1, related = 0, varies = 0;
    for (int i = 0; i < DISTANCES; i++)
        r[i] = unrelatedness(all, settings, axis, LOWEST + i);
    for (int i = 0; i < DISTANCES; i++) {
        varies |= !isnan(r[i]);
        related |= r[i] < RELATED;
        if (first < 0 && r[i] >= RELATED && !(i + 1 < DISTANCES && r[i + 1] < RELATED))
            first = i;
    }
    if (!varies)
        return (bl_score_scale){.variation = BL_VARIES_NOWHERE, .length = NAN};
    if (first < 0)
        return (bl_score_scale){.variation = BL_VARIES_SLOWLY, .length = NAN};
    if (!related)
        return (bl_score_scale){.variation = BL_VARIES_EVERYWHERE, .length = NAN};
    // The mean of h' is 3/2 h. Below the first distance r may be unknown: then half of it.
    double share = first > 0 && r[first - 1] < RELATED
                       ? (RELATED - r[first - 1]) / (r[first] - r[first - 1])
                       : 0.75;
    double length = 1.5 * ldexp(1, 2 * (LOWEST + first - 1)) * pow(4, share);
    return (bl_score_scale){.variation = BL_VARIES, .length = length};
}

// --- lattice ------------------------------------------------------------------------------------

enum { ROW = 512, ROWS = 96, PER_LENGTH = 4 };
// A bin over the mean of NEAR bins on each side, which are independent enough to be worth NEAR:
// beyond LINE with the probability (1 + LINE/NEAR)^-NEAR = 2e-9 a bin.
enum { APART = 3, NEAR = 20 };
static const double LINE = 35;

// The mean of squares about the mean along rows that begin at `start` along the axis.
static int mean_squares(const seeds *all, const bl_score_settings *settings, unsigned axis,
                        double length, double start, double *square) {
    static const double across = 1000; // correlation lengths
    double along[BL_AXES] = {0}, at[BL_AXES], *mean = calloc(ROW, sizeof *mean);
    bl_random random = bl_score_random(settings, "lattice", axis);
    if (!mean)
        return 0;
    along[axis] = length / PER_LENGTH;
    memset(square, 0, ROW * sizeof *square);
    for (int i = 0; i < ROWS; i++) {
        float row[ROW];
        for (int a = 0; a < BL_AXES; a++)
            at[a] = across * length * (bl_random_unit(&random) - 0.5);
        at[axis] = start;
        bl_signal_row(all->fresh[i % SEEDS].signal, at, along, ROW, row);
        for (int j = 0; j < ROW; j++) {
            mean[j] += (double)row[j] / ROWS;
            square[j] += (double)row[j] * (double)row[j] / ROWS;
        }
    }
    double level = 0;
    for (int j = 0; j < ROW; j++) {
        square[j] -= mean[j] * mean[j];
        level += square[j] / ROW;
    }
    for (int j = 0; j < ROW; j++)
        square[j] -= level;
    free(mean);
    return isfinite(level);
}

// The wave of `frequency` cycles a sample in the row, under Hann's window.
static void wave_of(const double *square, double frequency, double wave[2]) {
    wave[0] = wave[1] = 0;
    for (int j = 0; j < ROW; j++) {
        double window = 0.5 - 0.5 * cos(2 * M_PI * (j + 0.5) / ROW);
        double angle = 2 * M_PI * frequency * j;
        wave[0] += window * square[j] * cos(angle);
        wave[1] -= window * square[j] * sin(angle);
    }
}

static double power_of(const double *square, double frequency) {
    double wave[2];
    wave_of(square, frequency, wave);
    return wave[0] * wave[0] + wave[1] * wave[1];
}

// The lowest line of the row's spectrum, cycles a sample; 0: none. A wave that is sampled finely
// enough has a fundamental, and it is the lowest line.
static double find_line(const double *square) {
    enum { BINS = ROW / 2 };
    double power[BINS], most = 0;
    for (int k = 0; k < BINS; k++)
        power[k] = power_of(square, (double)k / ROW);
    for (int k = NEAR; k < BINS; k++)
        most = fmax(most, power[k]);
    for (int k = NEAR; k + NEAR < BINS; k++) {
        double around = 0;
        for (int j = APART; j < NEAR; j++)
            around += (power[k - j] + power[k + j]) / (2 * (NEAR - APART));
        if (power[k] < power[k - 1] || power[k] < power[k + 1] || power[k] < 0.01 * most ||
            power[k] < LINE * around)
            continue;
        double step = 0.25 / ROW, frequency = (double)k / ROW;
        for (int n = 0; n < 40; n++) {
            double here = power_of(square, frequency), above = power_of(square, frequency + step),
                   below = power_of(square, frequency - step);
            if (above > here || below > here)
                frequency += above > below ? step : -step;
            else
                step /= 2;
        }
        return frequency;
    }
    return 0;
}

// The number with the fewest digits within `error` of x, relatively.
static double shortest_near(double x, double error) {
    for (int digits = 0; digits < 15; digits++) {
        char text[40];
        snprintf(text, sizeof text, "%.*e", digits, x);
        double rounded = strtod(text, NULL);
        if (fabs(rounded - x) <= error * x)
            return rounded;
    }
    return x;
}

// Follows the phase of the line over distances that grow as the error shrinks.
static double find_lattice(const seeds *all, const bl_score_settings *settings, unsigned axis,
                           double length) {
    double near[ROW], far[ROW], first[2], there[2], sample = length / PER_LENGTH;
    if (!mean_squares(all, settings, axis, length, 0, near))
        return 0;
    double frequency = find_line(near), error = 0.1 / ROW; // cycles a sample
    if (frequency == 0)
        return 0;
    for (double cells = 64; cells <= 64 * 64; cells *= 8) {
        double samples = round(cells / frequency);
        if (samples * error > 0.4 ||
            !mean_squares(all, settings, axis, length, samples * sample, far))
            break;
        wave_of(near, frequency, first);
        wave_of(far, frequency, there);
        double turn = atan2(there[1], there[0]) - atan2(first[1], first[0]);
        turn = turn / (2 * M_PI) - samples * frequency;
        frequency += (turn - round(turn)) / samples;
        error = 0.02 / samples;
    }
    return shortest_near(sample / frequency, 2 * error / frequency);
}

// --- both ---------------------------------------------------------------------------------------

// The share of the commonest value at places near 0 and far, over the seeds; NAN where one is none.
static double constant_share(const seeds *all, const bl_score_settings *settings, double cell) {
    enum { EACH = 256, PLACES = SEEDS * EACH };
    double value[PLACES];
    size_t most = 0;
    bl_random random = bl_score_random(settings, "constant", 0);
    for (int s = 0; s < SEEDS; s++) {
        double column[BL_AXES][EACH];
        float seen[EACH];
        bl_score_spread(&random, cell, EACH,
                        (double *const[]){column[0], column[1], column[2], column[3]});
        bl_signal_points(all->fresh[s].signal, BL_COLUMNS(column), EACH, seen);
        for (int i = 0; i < EACH; i++)
            value[s * EACH + i] = (double)seen[i];
    }
    for (int i = 0; i < PLACES; i++)
        if (!isfinite(value[i]))
            return NAN;
    qsort(value, PLACES, sizeof *value, bl_ascending);
    for (size_t from = 0, to; from < PLACES; from = to) {
        for (to = from; to < PLACES && value[to] == value[from]; to++) {
        }
        most = to - from > most ? to - from : most;
    }
    return (double)most / PLACES;
}

double bl_score_cell_of(const bl_score_scale *scale) {
    if (scale->lattice > 0)
        return scale->lattice;
    // A power of two: whole units, where a function may well repeat, are whole cells of it.
    return scale->length > 0 ? exp2(floor(log2(2 * scale->length))) : 1;
}

bl_score_scale bl_score_find_scale(const bl_signal *signal, const bl_score_settings *settings) {
    bl_score_scale all = {.variation = BL_VARIES_NOWHERE, .length = NAN};
    unsigned shortest = 0;
    seeds fresh = seeds_open(signal, settings);
    for (unsigned a = 0; a < signal->dimensions && a < BL_AXES; a++) {
        bl_score_scale one = scale_along(&fresh, settings, a);
        if (one.variation == BL_VARIES && (isnan(all.length) || one.length < all.length)) {
            all = one;
            shortest = a;
        } else if (isnan(all.length) && one.variation != BL_VARIES_NOWHERE) {
            all.variation = one.variation;
        }
    }
    const double cell = signal->facts.cell;
    all.stated = cell;
    if (all.variation == BL_VARIES && isnan(cell))
        all.lattice = find_lattice(&fresh, settings, shortest, all.length);
    all.constant = constant_share(&fresh, settings, cell > 0 ? cell : bl_score_cell_of(&all));
    seeds_close(&fresh);
    return all;
}

// --- the verdict --------------------------------------------------------------------------------

// Of places with one value, a signal that varies has fewer; of cells in a correlation length, and
// of correlation lengths in a cell.
static const double MOST_CONSTANT = 0.95, MOST_APART = 32;

// That a user's function with a seed varies is what it states by having one; of the registry's some
// are patterns on a constant ground.
static void judge_constant(bl_score_property *result, const bl_signal *signal, double share) {
    snprintf(result->cell, sizeof result->cell, "constant");
    bl_score_judge(
        result, BL_VERDICT_FAIL,
        signal->definition || signal->seed_offset == SIZE_MAX ? BL_AGAINST_IDEAL : BL_AGAINST_CLAIM,
        "it is constant almost everywhere: %.4g %% of the places have one value", 100 * share);
}

static void judge_length(bl_score_property *result, const bl_score_scale *scale) {
    double cell = scale->stated;
    snprintf(result->cell, sizeof result->cell, "%.3g", scale->length);
    if (cell > 0 && (scale->length > MOST_APART * cell || cell > MOST_APART * scale->length))
        bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_CLAIM,
                       "it states a cell of %.6g units, and its values are related over %.3g", cell,
                       scale->length);
    else if (!isnan(cell))
        bl_score_judge(result, BL_VERDICT_PASS, BL_AGAINST_CLAIM,
                       "its values are related over %.3g units", scale->length);
    else if (scale->lattice > 0)
        bl_score_judge(result, BL_VERDICT_PASS, BL_AGAINST_IDEAL,
                       "no cell is stated: planes of a lattice were found %.10g units apart, and "
                       "stand for it",
                       scale->lattice);
    else
        bl_score_judge(result, BL_VERDICT_PASS, BL_AGAINST_IDEAL,
                       "no cell is stated, and no lattice was found: values are related over %.3g "
                       "units, and %.6g stand for the cell",
                       scale->length, bl_score_cell_of(scale));
}

static bl_status measure(const bl_score_subject *subject, const bl_score_settings *settings,
                         bl_score_property *result, bl_message *message) {
    const bl_score_scale *scale = &subject->scale;
    const bl_signal *signal = subject->signal;
    (void)settings;
    (void)message;
    if (bl_score_on_grid(signal)) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL,
                       "the signal is a grid of samples, whose spacing is its scale");
        return BL_OK;
    }
    bl_score_add_seen(result, "correlation_length", scale->length);
    bl_score_add_seen(result, "lattice", scale->lattice > 0 ? scale->lattice : NAN);
    bl_score_add_seen(result, "constant_share", scale->constant);
    if (scale->constant >= MOST_CONSTANT) {
        judge_constant(result, signal, scale->constant);
    } else if (scale->variation == BL_VARIES) {
        judge_length(result, scale);
    } else if (scale->variation == BL_VARIES_EVERYWHERE) {
        snprintf(result->cell, sizeof result->cell, "white");
        bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_IDEAL,
                       "values are unrelated at any distance, so that it has no scale");
    } else if (scale->variation == BL_VARIES_SLOWLY) {
        snprintf(result->cell, sizeof result->cell, "none");
        bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_IDEAL,
                       "values are related at any distance, so that it has no scale");
    } else {
        bl_score_not_finite(result);
    }
    return BL_OK;
}

BL_PROPERTY_DESCRIPTOR(scale) = {
    .name = "scale",
    .title = "scale",
    .paper = "peachey2003, p. 68",
    .entry = "the distance over which values are related, in units",
    .question = "Over what distance do its values vary, and do they vary at all?",
    .measure = measure,
};
