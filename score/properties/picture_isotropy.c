// SPDX-License-Identifier: MIT
#include "score/properties/picture_isotropy.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/fft.h"
#include "core/grid.h"
#include "score/properties/places.h"

enum { OCTAVES = 8, WIDTH = 2, PADDED = 4, HARMONICS = 2, SLICES = 16, LEAST_PATCHES = 4 };
enum { SECTORS = 16, PAIRS = 6 };
#define LEAST_SHARE 1e-3 // of the variance, that an octave must hold to be judged
#define LEAST_MEAN 1e-2  // of a_m
#define SUSPICIOUS 1e-3

// One octave in the plane of two axes: how patches are taken, and the weights of their bins.
typedef struct octave {
    const bl_signal *signal;
    unsigned axis[2];
    double low; // cycles a unit; up to twice it
    size_t samples[2], patches[2], slices, count;
    bl_fft_shape shape;
    const bl_fft *plan;
    size_t pitch, bins;
    double *window;                    // [samples[1]][samples[0]]
    double window_square;              // its sum of squares
    size_t *bin;                       // [bins], where it stands in the transform
    unsigned char *sector;             // [bins]
    double complex *weight[HARMONICS]; // [bins]
} octave;

// What patches give.
typedef struct patch {
    double complex a[HARMONICS];
    double sector[SECTORS]; // shares of its power
    double power;           // mean square of a bin
} patch;

typedef struct finding {
    double complex mean[HARMONICS];
    double t[HARMONICS], limit[HARMONICS]; // sizes over standard errors
    double spread[HARMONICS];              // standard error of the mean
    double share, db;                      // of the variance; along against across
    bl_estimate ratio;
    double worth; // patches
    int is_judged, is_told[HARMONICS], is_suspicious[HARMONICS];
} finding;

// --- weights ------------------------------------------------------------------------------------

static void octave_free(octave *o) {
    free(o->window);
    free(o->bin);
    free(o->sector);
    for (int m = 0; m < HARMONICS; m++)
        free(o->weight[m]);
}

static double window_at(double distance) {
    return distance < 1 ? 0.5 + 0.5 * cos(M_PI * distance) : 0;
}

static int make_window(octave *o, const double spacing[2]) {
    double radius =
        fmin((double)o->samples[0] * spacing[0], (double)o->samples[1] * spacing[1]) / 2;
    o->window = malloc(o->samples[0] * o->samples[1] * sizeof *o->window);
    for (size_t j = 0; j < o->samples[1] && o->window; j++)
        for (size_t i = 0; i < o->samples[0]; i++) {
            double x = ((double)i - 0.5 * (double)(o->samples[0] - 1)) * spacing[0];
            double y = ((double)j - 0.5 * (double)(o->samples[1] - 1)) * spacing[1];
            double w = o->window[j * o->samples[0] + i] = window_at(hypot(x, y) / radius);
            o->window_square += w * w;
        }
    return o->window != NULL;
}

// Takes off the straight line over the bins of each ring, which `ring` numbers.
static void centre_rings(double complex *weight, const int *ring, const double *distance,
                         size_t bins, int rings) {
    for (int r = 0; r < rings; r++) {
        double n = 0, x = 0, xx = 0;
        double complex y = 0, xy = 0;
        for (size_t b = 0; b < bins; b++)
            if (ring[b] == r)
                n++, x += distance[b], y += weight[b];
        if (n == 0)
            continue;
        x /= n, y /= n;
        for (size_t b = 0; b < bins; b++)
            if (ring[b] == r) {
                xx += (distance[b] - x) * (distance[b] - x);
                xy += (distance[b] - x) * (weight[b] - y);
            }
        for (size_t b = 0; b < bins; b++)
            if (ring[b] == r)
                weight[b] -= y + (xx > 0 ? xy / xx * (distance[b] - x) : 0);
    }
}

// The bins of the octave in the half plane of the transform; each stands for its conjugate too.
static int make_weights(octave *o, const double spacing[2]) {
    size_t wide = o->shape.size[1], high = o->shape.size[0], most = (wide / 2 + 1) * high;
    double thin = o->low / (WIDTH * PADDED); // a ring is about one bin wide
    int *ring = malloc(most * sizeof *ring), good;
    double *distance = malloc(most * sizeof *distance);
    o->bin = malloc(most * sizeof *o->bin);
    o->sector = malloc(most);
    good = ring && distance && o->bin && o->sector;
    for (int m = 0; m < HARMONICS; m++)
        good &= (o->weight[m] = malloc(most * sizeof *o->weight[m])) != NULL;
    o->pitch = 2 * (wide / 2 + 1);
    for (size_t j = 0; j < high && good; j++)
        for (size_t i = 0; i <= wide / 2; i++) {
            double down = (double)j - (j > high / 2 ? (double)high : 0);
            double x = (double)i / ((double)wide * spacing[0]);
            double y = down / ((double)high * spacing[1]), f = hypot(x, y);
            if (f < o->low || f >= 2 * o->low || (i == 0 && down < 0))
                continue;
            double theta = atan2(y, x), turn = theta < 0 ? theta + M_PI : theta;
            o->bin[o->bins] = j * o->pitch + 2 * i;
            o->sector[o->bins] = (unsigned char)((int)(turn / M_PI * SECTORS) % SECTORS);
            distance[o->bins] = f;
            ring[o->bins] = (int)((f - o->low) / thin);
            for (int m = 0; m < HARMONICS; m++)
                o->weight[m][o->bins] = cexp(I * 2 * (m + 1) * theta);
            o->bins++;
        }
    for (int m = 0; m < HARMONICS && good; m++)
        centre_rings(o->weight[m], ring, distance, o->bins, WIDTH * PADDED + 1);
    free(ring);
    free(distance);
    return good;
}

// --- patches ------------------------------------------------------------------------------------

// Where patch p starts: side by side along both axes, in slices across the others.
static void place_patch(const octave *o, size_t p, double start[BL_AXES]) {
    const bl_extent *picture = &o->signal->picture;
    size_t column = p % o->patches[0], row = p / o->patches[0] % o->patches[1];
    size_t slice = p / o->patches[0] / o->patches[1];
    for (unsigned a = 0; a < BL_AXES; a++)
        start[a] = a < o->signal->dimensions
                       ? picture->spacing[a] * floor((double)picture->size[a] *
                                                     ((double)slice + 0.5) / (double)o->slices)
                       : 0;
    start[o->axis[0]] = picture->spacing[o->axis[0]] * (double)(column * o->samples[0]);
    start[o->axis[1]] = picture->spacing[o->axis[1]] * (double)(row * o->samples[1]);
}

// Reads a patch under the window, without its own mean and slopes, into the zeros of the buffer:
// what is coarser than the patch would leak into the octave, with the direction that it has here.
static void read_patch(const octave *o, size_t p, float *value, double *buffer) {
    const bl_extent *picture = &o->signal->picture;
    size_t wide = o->samples[0], high = o->samples[1];
    double start[BL_AXES], step[BL_AXES] = {0}, sum[3] = {0}, weight[3] = {0};
    double middle[2] = {0.5 * (double)(wide - 1), 0.5 * (double)(high - 1)};
    place_patch(o, p, start);
    step[o->axis[0]] = picture->spacing[o->axis[0]];
    for (size_t j = 0; j < high; j++) {
        double at[BL_AXES];
        memcpy(at, start, sizeof at);
        at[o->axis[1]] += (double)j * picture->spacing[o->axis[1]];
        bl_signal_row(o->signal, at, step, wide, value + j * wide);
    }
    for (size_t j = 0; j < high; j++)
        for (size_t i = 0; i < wide; i++) {
            double w = o->window[j * wide + i];
            const double basis[3] = {1, (double)i - middle[0], (double)j - middle[1]};
            for (int k = 0; k < 3; k++) { // which are orthogonal under the window
                sum[k] += w * basis[k] * (double)value[j * wide + i];
                weight[k] += w * basis[k] * basis[k];
            }
        }
    memset(buffer, 0, o->pitch * o->shape.size[0] * sizeof *buffer);
    for (size_t j = 0; j < high; j++)
        for (size_t i = 0; i < wide; i++)
            buffer[j * o->pitch + i] =
                o->window[j * wide + i] * ((double)value[j * wide + i] - sum[0] / weight[0] -
                                           ((double)i - middle[0]) * sum[1] / weight[1] -
                                           ((double)j - middle[1]) * sum[2] / weight[2]);
}

static void measure_patch(const octave *o, const double *spectrum, patch *out) {
    double total = 0;
    *out = (patch){.power = 0};
    for (size_t b = 0; b < o->bins; b++) {
        const double *bin = spectrum + o->bin[b];
        double power = bin[0] * bin[0] + bin[1] * bin[1];
        total += power;
        out->sector[o->sector[b]] += power;
        for (int m = 0; m < HARMONICS; m++)
            out->a[m] += power * o->weight[m][b];
    }
    out->power = total / (double)o->bins / o->window_square;
}

// Returns 0 out of memory.
static int take_patches(const octave *o, int threads, patch *out) {
    int missing = 0;
#pragma omp parallel for num_threads(bl_thread_count(threads)) schedule(dynamic, 8)                \
    reduction(|                                                                                    \
              : missing)
    for (size_t p = 0; p < o->count; p++) {
        float *value = malloc(o->samples[0] * o->samples[1] * sizeof *value);
        double *buffer = bl_fft_buffer(bl_fft_bytes(&o->shape));
        if (value && buffer) {
            read_patch(o, p, value, buffer);
            bl_fft_run(o->plan, buffer);
            measure_patch(o, buffer, &out[p]);
        }
        missing |= !value || !buffer;
        free(value);
        free(buffer);
    }
    return !missing;
}

// --- the tests ----------------------------------------------------------------------------------

// The mean product of a number of each patch and of those beside it and across, without the mean;
// `alone` gets that of each with itself.
static double of_neighbours(const octave *o, const patch *p, int m, double complex mean,
                            double *alone) {
    double sum = 0, pairs = 0;
    *alone = 0;
    for (size_t i = 0; i < o->count; i++) {
        size_t column = i % o->patches[0], row = i / o->patches[0] % o->patches[1];
        double complex own = p[i].a[m] - mean;
        *alone += creal(own * conj(own)) / ((double)o->count - 1);
        for (int k = 0; k < 4; k++) { // right, below, below right, below left
            static const int right[] = {1, 0, 1, -1}, below[] = {0, 1, 1, 1};
            size_t at = column + (size_t)right[k], under = row + (size_t)below[k];
            if (at >= o->patches[0] || under >= o->patches[1])
                continue;
            size_t other = i + (size_t)below[k] * o->patches[0] + (size_t)right[k];
            sum += creal(own * conj(p[other].a[m] - mean));
            pairs++;
        }
    }
    return pairs > 0 ? sum / pairs : 0;
}

// |z| that a mean of patches of an isotropic picture passes with this probability, over its
// standard error: of F(2, 2 (n - 1)), whose tail is (1 + F / (n - 1))^-(n - 1).
static double limit_of(double probability, double worth) {
    double n = worth - 1;
    return n >= 1 ? sqrt(n * (pow(probability, -1 / n) - 1)) : INFINITY;
}

// Half of the power and more has one direction, in all patches alike: then these are neighbours of
// one kind, and not one patch that was counted often.
static int is_gross(const finding *f, int m, double alpha, size_t count, double inflation) {
    return cabs(f->mean[m]) > 0.5 && f->t[m] * sqrt(inflation) > limit_of(alpha, (double)count);
}

static finding find(const octave *o, patch *p, double variance, double alpha, double *room,
                    double level) {
    finding f = {.worth = (double)o->count};
    double power = 0, area = 3 * M_PI * o->low * o->low;
    for (size_t i = 0; i < o->count; i++)
        power += p[i].power / (double)o->count;
    if (!(power > 0))
        return f;
    f.share = power / variance * area * o->signal->picture.spacing[o->axis[0]] *
              o->signal->picture.spacing[o->axis[1]];
    f.is_judged = f.share >= LEAST_SHARE;
    for (int m = 0; m < HARMONICS; m++) {
        double alone, beside, inflation;
        for (size_t i = 0; i < o->count; i++) {
            p[i].a[m] /= power * o->window_square * (double)o->bins;
            f.mean[m] += p[i].a[m] / (double)o->count;
        }
        beside = of_neighbours(o, p, m, f.mean[m], &alone);
        inflation = 1 + 8 * fmax(0, alone > 0 ? beside / alone : 0);
        f.spread[m] = sqrt(alone * inflation / (double)o->count);
        f.worth = fmin(f.worth, (double)o->count / inflation);
        f.t[m] = cabs(f.mean[m]) / fmax(f.spread[m], 1e-300);
        f.limit[m] = limit_of(alpha, (double)o->count / inflation);
        int counts = f.is_judged && cabs(f.mean[m]) >= LEAST_MEAN;
        f.is_told[m] =
            counts && (f.t[m] > f.limit[m] || is_gross(&f, m, alpha, o->count, inflation));
        f.is_suspicious[m] =
            counts && f.t[m] > limit_of(SUSPICIOUS, fmax(2, (double)o->count / inflation));
    }
    // Power within 22.5 degrees of the strongest direction over that across.
    double across = carg(f.mean[0]) / 2;
    memset(room, 0, 2 * o->count * sizeof *room);
    for (size_t i = 0; i < o->count; i++)
        for (int s = 0; s < SECTORS; s++) {
            double angle = ((double)s + 0.5) * M_PI / SECTORS, off = cos(2 * (angle - across));
            if (fabs(off) > M_SQRT1_2)
                room[off > 0 ? i : o->count + i] += p[i].sector[s];
        }
    f.ratio = bl_score_db(bl_ratio_estimate(room, room + o->count, o->count, level));
    return f;
}

// Returns 0 where the picture has too few patches of this octave; *status tells of memory.
static int measure_octave(octave *o, const bl_score_settings *settings, double variance,
                          double alpha, finding *f, bl_status *status, bl_message *message) {
    const bl_extent *picture = &o->signal->picture;
    size_t most = (size_t)bl_size_pick(settings->size, 1024, 4096, 16384), others = 1;
    double spacing[2];
    for (int k = 0; k < 2; k++) {
        spacing[k] = picture->spacing[o->axis[k]];
        o->samples[k] = (size_t)(WIDTH / o->low / spacing[k] + 0.5);
        o->patches[k] = picture->size[o->axis[k]] / o->samples[k];
        o->shape.size[1 - k] = PADDED * o->samples[k];
    }
    for (unsigned a = 0; a < o->signal->dimensions; a++)
        others *= a == o->axis[0] || a == o->axis[1] ? 1 : picture->size[a];
    o->slices = others > SLICES ? SLICES : others;
    while (o->patches[0] * o->patches[1] * o->slices > most && o->slices > 1)
        o->slices--;
    while (o->patches[0] * o->patches[1] > most)
        o->patches[o->patches[1] > o->patches[0]]--;
    o->count = o->patches[0] * o->patches[1] * o->slices;
    if (o->count < LEAST_PATCHES)
        return 0;
    o->shape.kind = BL_FFT_REAL;
    o->shape.precision = BL_FFT_DOUBLE;
    o->shape.dims = 2;
    *status = bl_fft_plan(&o->shape, &o->plan, message);
    patch *p = malloc(o->count * sizeof *p);
    double *room = malloc(2 * o->count * sizeof *room);
    int good = *status == BL_OK && p && room && make_window(o, spacing) &&
               make_weights(o, spacing) && take_patches(o, settings->threads, p);
    if (good)
        *f = find(o, p, variance, alpha, room, settings->level);
    else if (*status == BL_OK)
        *status = bl_report(message, BL_DEVICE, "out of memory for the patches of a picture");
    free(p);
    free(room);
    return good;
}

// --- the verdict --------------------------------------------------------------------------------

typedef struct plane {
    unsigned axis[2];
    finding octave[OCTAVES];
    int found[OCTAVES], count;
} plane;

static double degrees_of(double complex mean, int m) {
    double direction = carg(mean) / (2 * (m + 1)) * 180 / M_PI + (m == 0 ? 90 : 0);
    double turn = m == 0 ? 180 : 90;
    direction -= turn * floor(direction / turn);
    return direction > turn - 0.5 ? direction - turn : direction; // -0.4 rather than 179.6
}

// The direction with its interval, of normal deviates.
static bl_estimate direction_of(const finding *f, double level) {
    double value = degrees_of(f->mean[0], 0);
    double error = f->spread[0] / M_SQRT2 / cabs(f->mean[0]) / 2 * 180 / M_PI;
    double reach = fmin(90, -bl_normal_quantile((1 - level) / 2) * error);
    return (bl_estimate){value, value - reach, value + reach, level, f->worth};
}

static void tell(const plane *p, const finding *f, int m, double low, char *text, size_t size) {
    if (m == 0)
        snprintf(text, size,
                 "stretched along %.0f degrees (from %c towards %c) at %.3g to %.3g cycles a unit: "
                 "%.1f dB more power across than along",
                 degrees_of(f->mean[0], 0), "xyzw"[p->axis[0]], "xyzw"[p->axis[1]], low, 2 * low,
                 f -> ratio.value);
    else
        snprintf(text, size,
                 "a cross at %.0f and %.0f degrees (from %c towards %c) in the power at %.3g to "
                 "%.3g cycles a unit",
                 degrees_of(f->mean[1], 1), degrees_of(f->mean[1], 1) + 90, "xyzw"[p->axis[0]],
                 "xyzw"[p->axis[1]], low, 2 * low);
}

// What shows most, weighed by how much of the variance has it.
static double weight_of(const finding *f, int m) {
    return cabs(f->mean[m]) * sqrt(f->share);
}

static void judge(const plane *planes, unsigned count, double top,
                  const bl_score_settings *settings, bl_score_property *result) {
    const finding *worst = NULL;
    const plane *where = NULL;
    int harmonic = 0, lowest = 0, fails = 0, patches = 0;
    double seen = 0;
    for (int strict = 1; strict >= 0 && !worst; strict--)
        for (unsigned k = 0; k < count; k++)
            for (int o = 0; o < OCTAVES; o++)
                for (int m = 0; m < HARMONICS; m++) {
                    const finding *f = &planes[k].octave[o];
                    if (!planes[k].found[o] || !(strict ? f->is_told[m] : f->is_suspicious[m]))
                        continue;
                    if (!worst || weight_of(f, m) > weight_of(worst, harmonic))
                        worst = f, where = &planes[k], harmonic = m, lowest = o;
                    fails |= strict;
                }
    for (unsigned k = 0; k < count; k++) {
        double sum = 0;
        for (int o = 0; o < OCTAVES; o++) {
            sum += planes[k].found[o] ? planes[k].octave[o].share : 0;
            patches += planes[k].found[o] ? 1 : 0;
        }
        seen = k ? fmin(seen, sum) : sum;
    }
    const finding *shown = worst;
    for (int o = 0; o < OCTAVES && !shown; o++)
        if (planes[0].found[o])
            for (int b = o; b < OCTAVES; b++)
                if (planes[0].found[b] && (!shown || planes[0].octave[b].share > shown->share))
                    shown = &planes[0].octave[b];
    if (!shown) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL,
                       "the picture has too few samples for a spectrum with directions");
        return;
    }
    char text[240] = "";
    if (worst)
        tell(where, worst, harmonic, ldexp(top, -1 - lowest), text, sizeof text);
    bl_score_add(result, "along_to_across_db", shown->ratio);
    if (cabs(shown->mean[0]) > 0)
        bl_score_add(result, "direction_degrees", direction_of(shown, settings->level));
    bl_score_add_seen(result, "stretch", cabs(shown->mean[0]));
    bl_score_add_seen(result, "cross", cabs(shown->mean[1]));
    bl_score_add_seen(result, "cross_degrees", degrees_of(shown->mean[1], 1));
    bl_score_add_seen(result, "largest_deviate", shown->t[harmonic]);
    bl_score_add_seen(result, "limit_deviate", shown->limit[harmonic]);
    bl_score_add_seen(result, "share_looked_at", fmin(1, seen));
    if (worst && harmonic == 0)
        snprintf(result->cell, sizeof result->cell, "%.0f deg", degrees_of(worst->mean[0], 0));
    else
        snprintf(result->cell, sizeof result->cell, worst ? "cross" : "none");
    if (fails)
        bl_score_judge(result, BL_VERDICT_FAIL, BL_AGAINST_IDEAL, "%s", text);
    else if (worst)
        bl_score_judge(result, BL_VERDICT_INCONCLUSIVE, BL_AGAINST_IDEAL,
                       "%s, which a picture without a direction shows once in %.0f", text,
                       1 / SUSPICIOUS);
    else if (seen < 0.5)
        bl_score_judge(
            result, BL_VERDICT_INCONCLUSIVE, BL_AGAINST_IDEAL,
            "no direction in %d octaves, but these hold %.0f %% of the variance: the rest "
            "is coarser than the picture can tell",
            patches, 100 * seen);
    else
        bl_score_judge(result, BL_VERDICT_PASS, BL_AGAINST_IDEAL,
                       "no direction in %d octaves below %.3g cycles a unit, which hold %.0f %% of "
                       "the variance",
                       patches, top, 100 * fmin(1, seen));
}

// Of all samples, or of a part spread over them.
static double variance_of(const bl_signal *signal, const bl_score_settings *settings) {
    const bl_extent *picture = &signal->picture;
    bl_random random = bl_score_random(settings, "picture", 0);
    bl_moments moments = {.n = 0};
    for (int i = 0; i < 65536; i++) {
        double at[BL_AXES] = {0};
        for (unsigned a = 0; a < signal->dimensions; a++)
            at[a] = picture->spacing[a] * floor(bl_random_unit(&random) * (double)picture->size[a]);
        bl_moments_add(&moments, bl_signal_value(signal, at));
    }
    return bl_moments_variance(&moments);
}

bl_status bl_score_picture_isotropy(const bl_signal *signal, const bl_score_settings *settings,
                                    bl_score_property *result, bl_message *message) {
    const bl_extent *picture = &signal->picture;
    unsigned axes = signal->dimensions, count = 0;
    double variance = variance_of(signal, settings), top = INFINITY;
    plane planes[PAIRS];
    memset(planes, 0, sizeof planes);
    bl_status status = BL_OK;
    if (axes < 2) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL,
                       "samples along one axis have no directions");
        return BL_OK;
    }
    if (!(variance > 0)) {
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL,
                       isnan(variance) ? "the picture has values that are not finite"
                                       : "the picture is constant");
        return BL_OK;
    }
    for (unsigned a = 0; a < axes; a++)
        top = fmin(top, 0.5 / picture->spacing[a]);
    double tests = (double)(axes * (axes - 1) / 2) * OCTAVES * HARMONICS;
    for (unsigned b = 1; b < axes; b++)
        for (unsigned a = 0; a < b; a++, count++) {
            planes[count].axis[0] = a;
            planes[count].axis[1] = b;
            for (int k = 0; k < OCTAVES && status == BL_OK; k++) {
                octave o = {.signal = signal, .axis = {a, b}, .low = ldexp(top, -1 - k)};
                planes[count].found[k] =
                    measure_octave(&o, settings, variance, settings->alpha / tests,
                                   &planes[count].octave[k], &status, message);
                octave_free(&o);
            }
        }
    if (status == BL_OK)
        judge(planes, count, top, settings, result);
    else
        bl_score_judge(result, BL_VERDICT_NOT_RUN, BL_AGAINST_IDEAL, "out of memory");
    return status;
}
