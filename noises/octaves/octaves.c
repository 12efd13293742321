// SPDX-License-Identifier: MIT
//
// Making a sum of octaves: its basis, its octaves and what it loses of them.
#include "noises/octaves/octaves.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/hash.h"
#include "core/random.h"

enum {
    SEED_STREAM = 64,   // and on: the seeds of octaves
    PLACE_STREAM = 128, // and on: offsets and rotations
    DEEPEST = 3,        // dots in a key of the basis's own text
    LOST_SEEDS = 32,
    LOST_PLACES = 4096
};

// --- the basis ----------------------------------------------------------------------------------

static bl_status report_basis(const char *basis, const char *what, bl_status status,
                              bl_message *message) {
    return bl_report(message, status, "in the basis '%s': %s", basis, what);
}

// How many names of nested signals a key begins with.
static int dots(const char *key) {
    int count = 0;
    for (; *key; key++)
        count += *key == '.';
    return count;
}

static bl_status check_basis(const char *basis, bl_message *message) {
    bl_spec spec;
    bl_message inner = {""};
    size_t name = strcspn(basis, ":");
    if (strcspn(basis, "./") < name || strncmp(basis, "cmd:", 4) == 0)
        return bl_report(message, BL_USAGE,
                         "the basis '%s' is no noise of the registry: it must be one of "
                         "`bandlimit list noises`, not a file, a function or a program",
                         basis);
    bl_status status = bl_spec_parse(basis, &spec, &inner);
    if (status != BL_OK)
        return report_basis(basis, inner.text, status, message);
    for (size_t i = 0; i < spec.count && status == BL_OK; i++) {
        const char *key = spec.settings[i].key;
        int depth =
            dots(key) + (strcmp(strrchr(key, '.') ? strrchr(key, '.') + 1 : key, "basis") == 0);
        if (strcmp(key, "seed") == 0)
            status = report_basis(basis,
                                  "the sum's own seed is the seed of its basis; give seed=, not "
                                  "basis.seed=",
                                  BL_USAGE, message);
        else if (depth > DEEPEST)
            status =
                report_basis(basis, "more than four bases within one another", BL_USAGE, message);
    }
    bl_spec_free(&spec);
    return status;
}

static bl_status open_basis(const char *basis, bl_opener *open, bl_signal **signal,
                            bl_message *message) {
    bl_message inner = {""};
    bl_status status = check_basis(basis, message);
    if (status != BL_OK)
        return status;
    status = open(basis, signal, &inner);
    return status == BL_OK ? BL_OK : report_basis(basis, inner.text, status, message);
}

// --- what octaves lose --------------------------------------------------------------------------

// E[F] over fresh seeds and places within 2^20 of the origin; NaN out of memory.
static double measure_lost(const bl_signal *basis, const bl_octaves_rules *rules) {
    static const uint64_t key = 0x6c6f7374; // any number
    enum { BATCH = 256 };
    double total = 0, slope;
    for (uint64_t s = 0; s < LOST_SEEDS; s++) {
        bl_signal *fresh = bl_signal_reseed(basis, bl_stream(key, s));
        bl_random random = bl_random_seed(key, s);
        if (!fresh)
            return NAN;
        for (int done = 0; done < LOST_PLACES; done += BATCH) {
            double at[BL_AXES][BATCH], sum = 0;
            float out[BATCH];
            for (int i = 0; i < BATCH; i++)
                for (int a = 0; a < BL_AXES; a++)
                    at[a][i] = 0x1p21 * bl_random_unit(&random) - 0x1p20;
            bl_signal_points(fresh, BL_COLUMNS(at), BATCH, out);
            for (int i = 0; i < BATCH; i++)
                sum += bl_octaves_fold(rules, (double)out[i], &slope);
            total += sum;
        }
        bl_signal_free(fresh);
    }
    return total / (LOST_SEEDS * LOST_PLACES);
}

static bl_status find_lost(bl_octaves_settings *settings, const bl_signal *basis,
                           const bl_octaves_rules *rules, bl_message *message) {
    if (settings->lost_known || settings->clamp == BL_CLAMP_NONE || rules->lost_to_zero)
        return BL_OK;
    double lost = basis->facts.mean;
    if (rules->fold != BL_FOLD_NONE || !isfinite(lost))
        lost = measure_lost(basis, rules);
    if (isnan(lost))
        return report_basis(settings->basis, "out of memory, or it cannot be reseeded", BL_DEVICE,
                            message);
    settings->lost = (double)(float)lost;
    settings->lost_known = 1;
    return BL_OK;
}

// --- octaves ------------------------------------------------------------------------------------

static double dot(const double *a, const double *b, unsigned dimensions) {
    double sum = 0;
    for (unsigned i = 0; i < dimensions; i++)
        sum += a[i] * b[i];
    return sum;
}

// A uniformly random rotation: normal vectors, made orthonormal (Gram and Schmidt, twice, which
// leaves only rounding), and the last one turned so that the determinant is 1.
static void draw_rotation(bl_random *random, unsigned n, double matrix[BL_AXES][BL_AXES]) {
    double determinant = 1, work[BL_AXES][BL_AXES];
    for (unsigned i = 0; i < n; i++) {
        for (unsigned k = 0; k < n; k++)
            matrix[i][k] = bl_random_normal(random);
        for (int pass = 0; pass < 2; pass++) {
            for (unsigned j = 0; j < i; j++) {
                double along = dot(matrix[i], matrix[j], n);
                for (unsigned k = 0; k < n; k++)
                    matrix[i][k] -= along * matrix[j][k];
            }
            double length = sqrt(dot(matrix[i], matrix[i], n));
            for (unsigned k = 0; k < n; k++)
                matrix[i][k] /= length;
        }
    }
    // The determinant of an orthonormal matrix is 1 or -1: elimination finds its sign.
    memcpy(work, matrix, sizeof work);
    for (unsigned c = 0; c < n; c++) {
        unsigned pivot = c;
        for (unsigned r = c; r < n; r++)
            if (fabs(work[r][c]) > fabs(work[pivot][c]))
                pivot = r;
        for (unsigned k = 0; k < n && pivot != c; k++) {
            double swap = work[c][k];
            work[c][k] = work[pivot][k];
            work[pivot][k] = swap;
        }
        determinant *= (pivot != c ? -1 : 1) * work[c][c];
        for (unsigned r = c + 1; r < n; r++)
            for (unsigned k = n; k-- > c;)
                work[r][k] -= work[r][c] / work[c][c] * work[c][k];
    }
    for (unsigned k = 0; k < n && determinant < 0; k++)
        matrix[n - 1][k] = -matrix[n - 1][k];
}

// The first octave stays where it is, so that a sum of one octave is its basis.
static void place_octave(bl_octaves *octaves, unsigned index, uint64_t seed) {
    bl_octave *octave = &octaves->octave[index];
    int exponent;
    octave->basis = octaves->seeded[octaves->rules.fresh ? index : 0];
    octave->frequency = octaves->plan.frequency[index];
    octave->exact = frexp(octave->frequency, &exponent) == 0.5;
    bl_random random = bl_random_seed(bl_stream(seed, PLACE_STREAM + index), 0);
    if (octaves->rules.shift && index > 0) {
        octave->shifted = 1; // by multiples of 2^-32 within 2^10 cells
        for (unsigned a = 0; a < octaves->dimensions; a++)
            octave->offset[a] = (double)(bl_random_bits(&random) >> 21) * 0x1p-32 - 0x1p10;
    }
    random = bl_random_seed(bl_stream(seed, PLACE_STREAM + index), 1);
    if (octaves->rules.rotate && index > 0) {
        octave->rotated = 1;
        draw_rotation(&random, octaves->dimensions, octave->rotation);
    }
}

static void free_octaves(bl_octaves *octaves) {
    for (unsigned i = 0; octaves && i < octaves->seeds; i++)
        bl_signal_free(octaves->seeded[i]);
    free(octaves);
}

static bl_status seed_octaves(bl_octaves *octaves, const bl_octaves_settings *settings,
                              const bl_signal *basis, bl_message *message) {
    // One at least: an empty sum still states the facts of its basis.
    unsigned count = octaves->rules.fresh && octaves->plan.count ? octaves->plan.count : 1;
    while (octaves->seeds < count) {
        uint64_t seed = octaves->rules.fresh
                            ? bl_stream(settings->seed, SEED_STREAM + octaves->seeds)
                            : settings->seed;
        octaves->seeded[octaves->seeds] = bl_signal_reseed(basis, seed);
        if (!octaves->seeded[octaves->seeds])
            return report_basis(settings->basis, "out of memory, or it cannot be reseeded",
                                BL_DEVICE, message);
        octaves->seeds++;
    }
    return BL_OK;
}

bl_status bl_octaves_build(bl_octaves_settings *settings, const bl_octaves_plan *plan,
                           const bl_octaves_rules *rules, bl_opener *open, bl_message *message) {
    bl_signal *basis = NULL;
    bl_octaves *octaves = calloc(1, sizeof *octaves);
    if (!octaves)
        return bl_report(message, BL_DEVICE, "out of memory for a sum of octaves");
    octaves->plan = *plan;
    octaves->rules = *rules;
    bl_status status = open_basis(settings->basis, open, &basis, message);
    if (status == BL_OK)
        status = seed_octaves(octaves, settings, basis, message);
    if (status == BL_OK)
        status = find_lost(settings, basis, rules, message);
    if (status == BL_OK) {
        octaves->dimensions = basis->dimensions;
        octaves->top = basis->facts.band_to > 0 ? basis->facts.band_to : 1;
        octaves->lost = settings->lost;
        bl_octaves_plan_clamp(&octaves->plan, octaves->top, (bl_octave_clamp)settings->clamp,
                              settings->width);
        octaves->constant = bl_octaves_constant(octaves, &octaves->plan);
        for (unsigned i = 0; i < octaves->plan.count; i++)
            place_octave(octaves, i, settings->seed);
        settings->octaves = octaves;
    } else
        free_octaves(octaves);
    bl_signal_free(basis);
    return status;
}

void bl_octaves_release(void *parameters) {
    bl_octaves_settings *settings = parameters;
    free_octaves(settings->octaves);
    settings->octaves = NULL;
}

int bl_octaves_is_sum(const bl_signal *signal) {
    return signal->functions->release == bl_octaves_release;
}

unsigned bl_octaves_dimensions(const void *parameters) {
    return ((const bl_octaves_settings *)parameters)->octaves->dimensions;
}
