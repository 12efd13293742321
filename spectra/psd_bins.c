// SPDX-License-Identifier: MIT
//
// Bins of a spectrum: the cells of the transform gathered by the nearest integer of |k|.
//
// All counts are over the full spectrum, where a cell and its conjugate are two that hold the same
// number. The mean over a bin of n cells through a window has the variance
//
//   2 P^2 / n^2 * sum over pairs (i, j) of its cells of rho(i - j)  =  2 P^2 broadening / n,
//
// rho the correlation of the powers of cells at that distance (bl_window_correlation), for a real
// Gaussian signal: each pair occurs once as itself and once as a conjugate. So the degrees of
// freedom of one average are n / broadening: 2 for a bin of a line, 1 at DC and Nyquist. A wide
// region has broadening = size sum w^4 / (sum w^2)^2 for each dimension; a ring one cell wide has
// less, because its cells have neighbours only along it.
#include <math.h>
#include <stdlib.h>

#include <omp.h>

#include "spectra/psd_parts.h"

enum { REACH = 6, TABLE = 2 * REACH + 1 }; // w^2 of a 4-term window has harmonics up to 6

typedef struct neighbours {
    double rho[TABLE]; // by distance + REACH along one axis
    int reach;         // beyond it rho is below 1e-7
} neighbours;

static neighbours find_neighbours(bl_window window, size_t size) {
    neighbours near = {.reach = 0};
    for (int d = -REACH; d <= REACH; d++) {
        size_t offset = (size_t)abs(d);
        near.rho[d + REACH] = offset < size ? bl_window_correlation(window, size, offset) : 0;
        if (near.rho[d + REACH] > 1e-7 && abs(d) > near.reach)
            near.reach = abs(d);
    }
    return near;
}

// --- counting cells ---

// How many cells have the magnitude k on an axis.
static double multiplicity(size_t k, size_t size) {
    return k == 0 || 2 * k == size ? 1 : 2;
}

// How many images a cell x >= y >= z of the octant has.
static double images_of(unsigned dims, size_t x, size_t y, size_t z, size_t size) {
    double cells = multiplicity(x, size);
    if (dims == 2)
        cells *= multiplicity(y, size) * (x == y ? 1 : 2);
    if (dims == 3)
        cells *= multiplicity(y, size) * multiplicity(z, size) *
                 (x == y && y == z   ? 1
                  : x == y || y == z ? 3
                                     : 6);
    return cells;
}

// Whole numbers, so that their sums do not depend on any order.
typedef struct bin_count {
    uint64_t cells, squares; // squares: the sum of |k|^2
} bin_count;

// Along a row of the octant |k| grows by at most 1 a cell, so the bin by 0 or 1: |k| rounds to r
// while |k|^2 <= r^2 + r. No branch depends on it, because none could be foreseen.
static void count_row(const bl_bins *bins, size_t y, size_t z, bin_count *counts) {
    size_t half = bins->size / 2, rest = y * y + z * z, x = bins->dims > 1 ? y : 0;
    size_t bin = bl_bin_of((double)(x * x + rest), INFINITY);
    // Inside of the octant every cell has the same number of images.
    uint64_t inside = (uint64_t)images_of(bins->dims, half - 1, y, z, bins->size);
    for (size_t first = x; x <= half; x++) {
        size_t square = x * x + rest;
        bin += square > bin * bin + bin;
        uint64_t images = inside;
        if (x == first || x + 1 >= half)
            images = (uint64_t)images_of(bins->dims, x, y, z, bins->size);
        bin_count *count = &counts[bin < bins->count ? bin : bins->count];
        count->cells += images;
        count->squares += images * square;
    }
}

// The mean radius of small bins by their cells; beyond, the root of the mean square stands for it,
// which differs by less than 1/(24 r).
static void fill_radius(bl_bins *bins, const bin_count *counts) {
    enum { EXACT = 32 };
    size_t half = bins->size / 2, end = half < EXACT + 1 ? half : EXACT + 1;
    size_t y_end = bins->dims > 1 ? end : 0, z_end = bins->dims > 2 ? end : 0;
    for (size_t z = 0; z <= z_end; z++)
        for (size_t y = bins->dims > 2 ? z : 0; y <= y_end; y++)
            for (size_t x = bins->dims > 1 ? y : 0; x <= end; x++) {
                double square = (double)(x * x + y * y + z * z);
                size_t bin = bl_bin_of(square, (double)bins->count);
                if (bin <= EXACT)
                    bins->radius[bin] += images_of(bins->dims, x, y, z, bins->size) * sqrt(square);
            }
    for (size_t bin = 0; bin <= bins->count; bin++) {
        double cells = (double)counts[bin].cells, squares = (double)counts[bin].squares;
        bins->cells[bin] = cells;
        if (cells > 0)
            bins->radius[bin] = bin <= EXACT && bin < bins->count ? bins->radius[bin] / cells
                                                                  : sqrt(squares / cells);
    }
}

// Rows in any order by any thread: the sums are whole numbers.
static bl_status count_cells(bl_bins *bins, int threads, bl_message *message) {
    size_t half = bins->size / 2, stride = bins->count + 1;
    size_t y_end = bins->dims > 1 ? half : 0, z_end = bins->dims > 2 ? half : 0;
    threads = half < 512 ? 1 : threads;
    bin_count *counts = calloc((size_t)threads * stride, sizeof *counts);
    if (!counts)
        return bl_report(message, BL_DEVICE, "out of memory for %zu bins", bins->count);
#pragma omp parallel for schedule(dynamic, 32) num_threads(threads) if (threads > 1)
    for (size_t y = 0; y <= y_end; y++)
        for (size_t z = 0; z <= z_end && z <= y; z++)
            count_row(bins, y, z, counts + (size_t)omp_get_thread_num() * stride);
    for (size_t i = stride; i < (size_t)threads * stride; i++) {
        counts[i % stride].cells += counts[i].cells;
        counts[i % stride].squares += counts[i].squares;
    }
    fill_radius(bins, counts);
    free(counts);
    return BL_OK;
}

// --- broadening ---

// The sum of rho from one cell to all cells of the ring `r`.
static double sum_from_cell(const neighbours *near, unsigned dims, long x, long y, long z, long r) {
    int flat = dims == 2 ? 0 : near->reach;
    double sum = 0, low = (double)r * (double)r - (double)r, high = low + 2 * (double)r;
    for (int dz = -flat; dz <= flat; dz++)
        for (int dy = -near->reach; dy <= near->reach; dy++)
            for (int dx = -near->reach; dx <= near->reach; dx++) {
                double a = (double)(x + dx), b = (double)(y + dy), c = (double)(z + dz);
                double square = a * a + b * b + c * c;
                // |k| rounds to r: r^2 - r < |k|^2 <= r^2 + r for integers
                if ((square > low || r == 0) && square <= high)
                    sum += near->rho[dx + REACH] * near->rho[dy + REACH] *
                           (dims == 2 ? 1 : near->rho[dz + REACH]);
            }
    return sum;
}

// The mean of that sum over the ring's octant, without the edge of the spectrum.
static double ring_broadening(const neighbours *near, unsigned dims, long r) {
    double sum = 0, cells = 0;
    long z_end = dims == 3 ? r : 0;
    for (long z = 0; z <= z_end; z++)
        for (long y = z; y <= r; y++) {
            double rest = (double)(y * y + z * z);
            double low = (double)(r * (r - 1)) - rest, high = (double)(r * (r + 1)) - rest;
            if (high < 0)
                break;
            long x = low > 0 ? (long)sqrt(low) : 0;
            for (x = x < y ? y : x; (double)x * (double)x <= high; x++) {
                if ((double)x * (double)x <= low && r > 0)
                    continue;
                // no axis is so short that these cells stand at its edge
                double images = images_of(dims, (size_t)x, (size_t)y, (size_t)z, SIZE_MAX);
                sum += images * sum_from_cell(near, dims, x, y, z, r);
                cells += images;
            }
        }
    return cells > 0 ? sum / cells : 1;
}

// Exact for small rings; towards large ones it settles, and is interpolated between a few.
static void fill_ring_broadening(bl_bins *bins, const neighbours *near) {
    size_t exact = bins->dims == 2 ? 24 : 8, last = bins->dims == 2 ? 1024 : 32;
    for (size_t r = 0; r < bins->count && r <= exact; r++)
        bins->broadening[r] = ring_broadening(near, bins->dims, (long)r);
    for (size_t from = exact; from + 1 < bins->count; from *= 2) {
        double a = bins->broadening[from], b = a;
        if (2 * from <= last)
            b = ring_broadening(near, bins->dims, 2 * (long)from);
        for (size_t r = from + 1; r <= 2 * from && r < bins->count; r++)
            bins->broadening[r] = a + (b - a) * ((double)r / (double)from - 1);
    }
}

static void fill_broadening(bl_bins *bins, bl_window window) {
    neighbours near = find_neighbours(window, bins->size);
    double along = 0;
    for (int d = -near.reach; d <= near.reach; d++)
        along += near.rho[d + REACH];
    bins->broad = pow(along, bins->dims);
    bins->broadening[bins->count] = bins->broad;
    if (bins->dims > 1)
        fill_ring_broadening(bins, &near);
    for (size_t k = 0; bins->dims == 1 && k < bins->count; k++) {
        size_t apart = bl_folded(2 * k, bins->size);
        int pair = bins->cells[k] > 1;
        bins->broadening[k] = 1 + (pair && apart <= REACH ? near.rho[apart + REACH] : 0);
    }
}

bl_status bl_bins_open(unsigned dims, size_t size, bl_window window, int threads, bl_bins *bins,
                       bl_message *message) {
    *bins = (bl_bins){.dims = dims, .size = size, .count = size / 2 + 1};
    bins->cells = calloc(bins->count + 1, sizeof(double));
    bins->radius = calloc(bins->count + 1, sizeof(double));
    bins->broadening = calloc(bins->count + 1, sizeof(double));
    if (!bins->cells || !bins->radius || !bins->broadening) {
        bl_bins_close(bins);
        return bl_report(message, BL_DEVICE, "out of memory for %zu bins", size / 2 + 1);
    }
    bl_status status = count_cells(bins, threads, message);
    if (status == BL_OK)
        fill_broadening(bins, window);
    else
        bl_bins_close(bins);
    return status;
}

void bl_bins_close(bl_bins *bins) {
    free(bins->cells);
    free(bins->radius);
    free(bins->broadening);
    *bins = (bl_bins){0};
}

void bl_bins_reduce(const bl_bins *bins, const double *half, bl_bin_sum *sums) {
    size_t size = bins->size, columns = bins->count, rows = 1;
    for (unsigned d = 1; d < bins->dims; d++)
        rows *= size;
    for (size_t bin = 0; bin <= bins->count; bin++)
        sums[bin] = (bl_bin_sum){0, 0};
    for (size_t row = 0; row < rows; row++) {
        double y = (double)bl_folded(row % size, size), z = (double)bl_folded(row / size, size);
        for (size_t x = 0; x < columns; x++) {
            double square = (double)x * (double)x + y * y + z * z;
            double value = half[row * columns + x], weight = multiplicity(x, size);
            bl_bin_sum *sum = &sums[bl_bin_of(square, (double)bins->count)];
            sum->sum += weight * value;
            sum->square += weight * value * value;
        }
    }
}
