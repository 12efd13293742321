// SPDX-License-Identifier: MIT
//
// From the samples to moments, range, counts and quantiles (see histogram.c for the intervals).
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "spectra/histogram_parts.h"

static const double probabilities[BL_QUANTILES] = {0.001, 0.01, 0.05, 0.25, 0.5,
                                                   0.75,  0.95, 0.99, 0.999};

// The probability that an interval misses the truth, with all its digits.
static double missed(const bl_sampling *s) {
    return s->settings.missed > 0 ? s->settings.missed : 1 - s->settings.level;
}

// Weighted by their counts, blocks of a grid differ by a sample a side at most.
static void fill_moments(const bl_sampling *s, bl_histogram *h, double *means, double *squares) {
    for (size_t block = 0; block < s->blocks; block++)
        bl_moments_merge(&h->moments, &s->moments[block]);
    for (size_t block = 0; block < s->blocks; block++) {
        const bl_moments *m = &s->moments[block];
        double off = m->mean - h->moments.mean;
        means[block] = m->mean;
        squares[block] = m->m2 / m->n + off * off;
    }
    h->mean = bl_mean_estimate_missing(means, s->blocks, missed(s));
    h->variance = bl_mean_estimate_missing(squares, s->blocks, missed(s));
    // The centres are those of all samples; around them the spread of the blocks.
    double shift = h->moments.mean - h->mean.value;
    h->mean = (bl_estimate){h->moments.mean, h->mean.lower + shift, h->mean.upper + shift,
                            h->mean.level, h->mean.samples};
    h->skewness = bl_moments_skewness(&h->moments);
    h->kurtosis = bl_moments_kurtosis(&h->moments);
    double variance = h->moments.n > 1 ? h->moments.m2 / (h->moments.n - 1) : 0;
    // A variance is positive, and so are its limits on a scale of logarithms.
    double half = h->variance.upper - h->variance.value; // NaN of one block
    double factor = h->variance.value > 0 ? exp(half / h->variance.value) : 1;
    h->variance = (bl_estimate){variance, variance / factor, variance * factor, h->variance.level,
                                h->variance.samples};
}

static void fill_range(const bl_sampling *s, bl_histogram *h) {
    size_t low = 0, high = 0, block = 0;
    for (size_t i = 1; i < s->samples; i++) {
        low = s->values[i] < s->values[low] ? i : low;
        high = s->values[i] > s->values[high] ? i : high;
    }
    h->minimum = (double)s->values[low];
    h->maximum = (double)s->values[high];
    for (; s->first[block + 1] <= low; block++)
        continue;
    bl_sampling_point(s, block, low - s->first[block], h->minimum_at);
    for (block = 0; s->first[block + 1] <= high; block++)
        continue;
    bl_sampling_point(s, block, high - s->first[block], h->maximum_at);
}

static void fill_counts(const bl_sampling *s, bl_histogram *h) {
    double from = s->settings.from, to = s->settings.to;
    if (from == 0 && to == 0) {
        from = h->minimum;
        to = h->maximum;
    }
    if (!(to > from)) { // a constant: one bin's width around it
        double half = fmax(0.5, fabs(from) * 1e-6);
        from -= half;
        to += half;
    }
    size_t bins = s->settings.bins;
    h->settings.from = from;
    h->settings.to = to;
    for (size_t i = 0; i <= bins; i++)
        h->edges[i] = from + (to - from) * ((double)i / (double)bins);
    h->edges[bins] = to;
    for (size_t i = 0; i < s->samples; i++) {
        double value = (double)s->values[i];
        if (value < from || value > to) {
            h->outside++;
            continue;
        }
        size_t bin = (size_t)((value - from) / (to - from) * (double)bins);
        bin = bin < bins ? bin : bins - 1; // the upper end belongs to the last bin
        while (bin > 0 && value < h->edges[bin])
            bin--;
        while (bin + 1 < bins && value >= h->edges[bin + 1])
            bin++;
        h->counts[bin]++;
    }
}

// How many independent samples would spread the share below a value over the blocks as much.
static double independent_samples(const bl_sampling *s, float value, double p) {
    double square = 0, n = (double)s->samples, blocks = (double)s->blocks;
    if (s->blocks < 2)
        return n;
    for (size_t block = 0; block < s->blocks; block++) {
        size_t below = 0, count = s->first[block + 1] - s->first[block];
        for (size_t i = s->first[block]; i < s->first[block + 1]; i++)
            below += s->values[i] <= value;
        double off = (double)below / (double)count - p;
        square += off * off * (double)count / n * blocks;
    }
    double variance = square / (blocks - 1) / blocks; // of the share over all samples
    return variance > 0 ? fmin(n, p * (1 - p) / variance) : n;
}

// --- quantiles ---

// Negative floats order backwards by their bits; turned over, all finite floats order as integers.
static uint32_t key_of(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

static float value_of(uint32_t key) {
    uint32_t bits = key & 0x80000000u ? key & 0x7fffffffu : ~key;
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

// Sorts keys by three passes of eleven bits; `room` is as long. The result is in room.
static void sort_keys(uint32_t *keys, uint32_t *room, size_t count, size_t *starts) {
    enum { BITS = 11, BUCKETS = 1 << BITS };
    for (int pass = 0; pass < 3; pass++) {
        uint32_t *from = pass % 2 ? room : keys, *to = pass % 2 ? keys : room;
        memset(starts, 0, BUCKETS * sizeof *starts);
        for (size_t i = 0; i < count; i++)
            starts[from[i] >> (BITS * pass) & (BUCKETS - 1)]++;
        for (size_t bucket = 0, sum = 0; bucket < BUCKETS; bucket++) {
            size_t here = starts[bucket];
            starts[bucket] = sum;
            sum += here;
        }
        for (size_t i = 0; i < count; i++)
            to[starts[from[i] >> (BITS * pass) & (BUCKETS - 1)]++] = from[i];
    }
}

// The value at a rank from 0, clamped to the ends.
static double at_rank(const uint32_t *sorted, size_t count, double rank) {
    double last = (double)(count - 1), clamped = rank < 0 ? 0 : rank > last ? last : rank;
    return (double)value_of(sorted[(size_t)clamped]);
}

static void fill_quantile(const bl_sampling *s, const uint32_t *sorted, double p,
                          bl_estimate *quantile) {
    double n = (double)s->samples;
    double value = at_rank(sorted, s->samples, ceil(n * p) - 1);
    double independent = independent_samples(s, (float)value, p);
    double reach = -bl_normal_quantile(0.5 * missed(s)) * sqrt(p * (1 - p) / independent) * n;
    quantile->value = value;
    quantile->lower = at_rank(sorted, s->samples, floor(n * p - reach) - 1);
    quantile->upper = at_rank(sorted, s->samples, ceil(n * p + reach));
    quantile->level = 1 - missed(s);
    quantile->samples = independent;
}

static bl_status fill_quantiles(const bl_sampling *s, bl_histogram *h, bl_message *message) {
    uint32_t *keys = malloc(s->samples * sizeof *keys), *room = malloc(s->samples * sizeof *room);
    size_t *starts = malloc(2048 * sizeof *starts);
    bl_status status = BL_OK;
    if (keys && room && starts) {
        for (size_t i = 0; i < s->samples; i++)
            keys[i] = key_of(s->values[i]);
        sort_keys(keys, room, s->samples, starts);
        for (int q = 0; q < BL_QUANTILES; q++) {
            h->quantile_p[q] = probabilities[q];
            fill_quantile(s, room, probabilities[q], &h->quantile[q]);
        }
    } else {
        status = bl_report(message, BL_DEVICE, "out of memory sorting %zu samples", s->samples);
    }
    free(keys);
    free(room);
    free(starts);
    return status;
}

bl_status bl_histogram_fill(const bl_sampling *s, bl_histogram *histogram, bl_message *message) {
    histogram->settings = s->settings;
    histogram->settings.samples = s->samples;
    histogram->count = s->samples;
    histogram->edges = calloc(s->settings.bins + 1, sizeof *histogram->edges);
    histogram->counts = calloc(s->settings.bins, sizeof *histogram->counts);
    double *replicates = malloc(2 * s->blocks * sizeof *replicates);
    bl_status status = BL_OK;
    if (histogram->edges && histogram->counts && replicates) {
        fill_moments(s, histogram, replicates, replicates + s->blocks);
        fill_range(s, histogram);
        fill_counts(s, histogram);
        status = fill_quantiles(s, histogram, message);
    } else {
        status = bl_report(message, BL_DEVICE, "out of memory for %zu bins", s->settings.bins);
    }
    free(replicates);
    return status;
}

double bl_histogram_share(const bl_histogram *histogram, size_t first, size_t end) {
    size_t sum = 0;
    for (size_t i = first; i < end; i++)
        sum += histogram->counts[i];
    return (double)sum / (double)histogram->count;
}

double bl_histogram_density(const bl_histogram *histogram, size_t bin) {
    double width = histogram->edges[bin + 1] - histogram->edges[bin];
    return (double)histogram->counts[bin] / (double)histogram->count / width;
}
