// SPDX-License-Identifier: MIT
#include "noises/tiles/wavelet_tile.h"

#include <math.h>
#include <stdlib.h>

#include "noises/tiles/tile_covariance.h"

const uint32_t bl_wavelet_sizes[BL_TILE_AXES] = {0, 64, 32};

// --- filters ------------------------------------------------------------------------------------

void bl_wavelet_down(const double *fine, size_t outer, size_t n, size_t inner, double *coarse) {
    // U'G/2 and the 120 of G.
    static const double weight[4] = {303.0 * 120 / 960, 147.0 * 120 / 960, 29.0 * 120 / 960,
                                     1.0 * 120 / 960};
    for (size_t o = 0; o < outer; o++)
        for (size_t m = 0; m < n / 2; m++) {
            double *restrict out = coarse + (o * (n / 2) + m) * inner;
            for (size_t i = 0; i < inner; i++)
                out[i] = 0;
            for (size_t k = 0; k < 4; k++) {
                const double *left = fine + (o * n + (2 * m + n - k % n) % n) * inner;
                const double *right = fine + (o * n + (2 * m + 1 + k) % n) * inner;
#pragma omp simd
                for (size_t i = 0; i < inner; i++)
                    out[i] += weight[k] * (left[i] + right[i]);
            }
        }
    for (int sign = -1; sign <= 1; sign += 2) {
        double y = -13 + sign * sqrt(105); // z + 1/z, below -2
        double pole = (y + sqrt(y * y - 4)) / 2;
        bl_tile_solve(coarse, outer, n / 2, inner, pole);
    }
}

void bl_wavelet_up(const double *coarse, size_t outer, size_t n, size_t inner, double *fine) {
    size_t half = n / 2;
    for (size_t o = 0; o < outer; o++)
        for (size_t m = 0; m < half; m++) {
            // 2m is 3/4 of its own coarse spline and 1/4 of the one before; 2m+1 mirrors it.
            const double *here = coarse + (o * half + m) * inner;
            const double *before = coarse + (o * half + (m + half - 1) % half) * inner;
            const double *after = coarse + (o * half + (m + 1) % half) * inner;
            double *restrict even = fine + (o * n + 2 * m) * inner, *restrict odd = even + inner;
#pragma omp simd
            for (size_t i = 0; i < inner; i++) {
                even[i] = 0.75 * here[i] + 0.25 * before[i];
                odd[i] = 0.75 * here[i] + 0.25 * after[i];
            }
        }
}

bl_status bl_wavelet_remove_coarse(double *numbers, const uint32_t size[BL_TILE_AXES],
                                   bl_message *message) {
    size_t count = bl_tile_count(size);
    // Each step halves or doubles one axis between two buffers.
    double *a = malloc(count * sizeof *a), *b = malloc(count * sizeof *b);
    if (!a || !b) {
        free(a);
        free(b);
        return bl_report(message, BL_DEVICE, "out of memory for a tile of %zu numbers", count);
    }
    size_t now[BL_TILE_AXES] = {size[0], size[1], size[2]};
    const double *from = numbers;
    double *to = a;
    for (int axis = BL_TILE_AXES - 1; axis >= 0; axis--) {
        if (size[axis] == 1)
            continue;
        size_t inner = axis > 0 ? now[0] * (axis > 1 ? now[1] : 1) : 1;
        size_t outer = (axis < 2 ? now[2] : 1) * (axis < 1 ? now[1] : 1);
        bl_wavelet_down(from, outer, now[axis], inner, to);
        now[axis] /= 2;
        from = to;
        to = to == a ? b : a;
    }
    for (int axis = 0; axis < BL_TILE_AXES; axis++) {
        if (size[axis] == 1)
            continue;
        now[axis] *= 2;
        size_t inner = axis > 0 ? now[0] * (axis > 1 ? now[1] : 1) : 1;
        size_t outer = (axis < 2 ? now[2] : 1) * (axis < 1 ? now[1] : 1);
        bl_wavelet_up(from, outer, now[axis], inner, to);
        from = to;
        to = to == a ? b : a;
    }
    for (size_t i = 0; i < count; i++)
        numbers[i] -= from[i];
    free(a);
    free(b);
    return BL_OK;
}

// --- the spectrum -------------------------------------------------------------------------------

static double gram(double v) {
    return (66 + 52 * cos(2 * M_PI * v) + 2 * cos(4 * M_PI * v)) / 120;
}

static double upsampling(double v) {
    double c = cos(M_PI * v);
    return 2 * c * c * c;
}

// What P leaves at v, and the square of that plus what it brings from v + 1/2.
static void projection(double v, double *kept, double *power) {
    double u = upsampling(v), mirror = upsampling(v + 0.5), whole = 4 * gram(2 * v);
    double brought = u * mirror * gram(v + 0.5) / whole;
    *kept = u * u * gram(v) / whole;
    *power = *kept * *kept + brought * brought;
}

double bl_wavelet_power(unsigned dimensions, const double v[BL_TILE_AXES]) {
    double all_kept = 1, all_power = 1;
    for (unsigned a = 0; a < dimensions; a++) {
        double kept, power;
        projection(v[a], &kept, &power);
        all_kept *= kept;
        all_power *= power;
    }
    return 1 - 2 * all_kept + all_power;
}

// The means over an axis's harmonics of 1, p0 and p0^2 + p1 times the power of the kernel: with all
// images, or of the harmonics themselves, |v| <= 1/2, alone.
static void axis_means(const bl_tile *tile, uint32_t axis, int images, double mean[3]) {
    bl_tile_kernel kernel = (bl_tile_kernel)tile->kernel[axis];
    double n = tile->size[axis];
    mean[0] = mean[1] = mean[2] = 0;
    for (uint32_t k = 0; k < tile->size[axis]; k++) {
        double v = (k <= tile->size[axis] / 2 ? k : k - n) / n, kept, power;
        double transform = bl_tile_transform(kernel, v);
        // The harmonic 1/2 is its own first image: both ends of the band.
        double own = transform * transform * (2 * k == tile->size[axis] ? 2 : 1);
        double weight = (images ? bl_tile_power(kernel, v) : own) / n;
        projection(v, &kept, &power);
        mean[0] += weight;
        mean[1] += weight * kept;
        mean[2] += weight * power;
    }
}

// The variance; along `inside` without the images, -1 for none.
static double variance_of(const bl_tile *tile, int inside) {
    double product[3] = {1, 1, 1};
    for (uint32_t a = 0; a < tile->dimensions; a++) {
        double mean[3];
        axis_means(tile, a, (int)a != inside, mean);
        for (int i = 0; i < 3; i++)
            product[i] *= mean[i];
    }
    return product[0] - 2 * product[1] + product[2];
}

double bl_wavelet_variance(const bl_tile *tile) {
    return variance_of(tile, -1);
}

// --- the tile -----------------------------------------------------------------------------------

// The factors of S at the harmonics of an axis, k = 0 to size - 1.
static double *projections(const bl_tile *tile, int axis) {
    uint32_t size = tile->size[axis];
    double *at = malloc(2 * size * sizeof *at);
    for (uint32_t k = 0; at && k < size; k++)
        projection((double)k / size, &at[2 * k], &at[2 * k + 1]);
    return at;
}

// S at all harmonics, of numbers that make the variance 1: mean squares that add up over them.
static bl_status find_covariance(bl_tile *tile, bl_message *message) {
    const uint32_t *size = tile->size;
    double *powers = bl_tile_powers(tile), *axis[BL_TILE_AXES] = {NULL};
    double scale = 1 / (bl_wavelet_variance(tile) * (double)bl_tile_count(size));
    int known = powers != NULL;
    for (uint32_t a = 0; a < tile->dimensions; a++)
        known &= (axis[a] = projections(tile, (int)a)) != NULL;
    for (uint32_t z = 0; known && z < size[2]; z++)
        for (uint32_t y = 0; y < size[1]; y++)
            for (uint32_t x = 0; x <= size[0] / 2; x++) {
                const uint32_t k[BL_TILE_AXES] = {x, y, z};
                double kept = 1, power = 1;
                for (uint32_t a = 0; a < tile->dimensions; a++) {
                    kept *= axis[a][2 * k[a]];
                    power *= axis[a][2 * k[a] + 1];
                }
                *bl_tile_power_at(tile, powers, (const int[]){(int)x, (int)y, (int)z}) =
                    scale * (1 - 2 * kept + power);
            }
    for (int a = 0; a < BL_TILE_AXES; a++)
        free(axis[a]);
    if (known)
        return bl_tile_set_powers(tile, powers, message);
    free(powers);
    return bl_report(message, BL_DEVICE, "out of memory for a tile of %zu numbers",
                     bl_tile_count(size));
}

bl_status bl_wavelet_build(const bl_wavelet *settings, bl_tile *tile, bl_message *message) {
    bl_tile_begin(tile, &settings->tile, bl_wavelet_sizes, 2);
    for (uint32_t a = 0; a < BL_TILE_AXES; a++)
        tile->kernel[a] =
            settings->projected && a == settings->normal ? BL_TILE_BSPLINE2_WIDE : BL_TILE_BSPLINE2;
    size_t count = bl_tile_count(tile->size);
    double *numbers = malloc(count * sizeof *numbers);
    if (!numbers) {
        bl_tile_release(tile);
        return bl_report(message, BL_DEVICE, "out of memory for a tile of %zu numbers", count);
    }
    bl_random random = bl_random_seed(settings->tile.seed, 23);
    bl_tile_numbers(&random, numbers, count);
    bl_status status = bl_wavelet_remove_coarse(numbers, tile->size, message);
    if (status == BL_OK && bl_tile_wants_covariance(tile))
        status = find_covariance(tile, message);
    if (status == BL_OK)
        status = bl_tile_make(tile, numbers, 1 / sqrt(bl_wavelet_variance(tile)), message);
    free(numbers);
    if (status != BL_OK)
        bl_tile_release(tile);
    return status;
}

// The largest sum of sizes in a row of P along one axis. The rows are shifts by two of rows 0 and
// 1, which are gathered from what P does to each single number.
static double projection_gain(size_t n) {
    double *one = calloc(n, sizeof *one), *half = malloc(n / 2 * sizeof *half),
           *out = malloc(n * sizeof *out), even = 0, odd = 0;
    for (size_t j = 0; one && half && out && j < n; j++) {
        one[j] = 1;
        bl_wavelet_down(one, 1, n, 1, half);
        bl_wavelet_up(half, 1, n, 1, out);
        even += fabs(out[0]);
        odd += fabs(out[1]);
        one[j] = 0;
    }
    double gain = one && half && out ? fmax(even, odd) : INFINITY;
    free(one);
    free(half);
    free(out);
    return gain;
}

void bl_wavelet_describe(const bl_wavelet *settings, const bl_tile *tile, bl_facts *facts) {
    double gain = 1, weights = 1, inside = INFINITY, all = bl_wavelet_variance(tile);
    for (uint32_t a = 0; a < tile->dimensions; a++) {
        gain *= projection_gain(tile->size[a]);
        weights *= bl_tile_gain((bl_tile_kernel)tile->kernel[a]);
        if (!settings->projected || a != settings->normal)
            inside = fmin(inside, variance_of(tile, (int)a));
    }
    bl_tile_describe(tile, facts);
    facts->upper = BL_TILE_NUMBER * (1 + gain) * weights / sqrt(all) * (1 + 0x1p-20);
    facts->lower = -facts->upper;
    facts->bound_proof =
        "random numbers below 3.4642; the coarse part adds at most the largest sum "
        "of sizes in a row of the projection; weights sum to 1, or 2 if wide";
    facts->variance = 1;
    facts->band_from = 0;
    facts->band_to = 1;
    facts->leak_db = ceil(1000 * log10(1 - inside / all)) / 100;
}
