// SPDX-License-Identifier: MIT
#include "noises/tiles/tile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/sinc.h"
#include "noises/lattice/kernel.h"
#include "noises/lattice/lattice.h"
#include "noises/tiles/tile_covariance.h"
#include "noises/tiles/tile_points.h"

const char *const bl_tile_interps[] = {"bspline", "catmull-rom", "linear", "nearest", NULL};
const char *const bl_tile_size_examples[] = {"16", "32,32", NULL};

enum { LARGEST = 1 << 26 }; // numbers in a tile

// --- settings -----------------------------------------------------------------------------------

void bl_tile_sizes(const bl_tile_settings *settings, const uint32_t usual[BL_TILE_AXES],
                   uint32_t size[BL_TILE_AXES]) {
    uint32_t dims = settings->dimensions;
    for (uint32_t a = 0; a < BL_TILE_AXES; a++)
        size[a] = a >= dims ? 1 : settings->size[a] ? settings->size[a] : usual[dims - 1];
}

size_t bl_tile_count(const uint32_t size[BL_TILE_AXES]) {
    return (size_t)size[0] * size[1] * size[2];
}

static int is_power_of_two(uint32_t n) {
    return n && (n & (n - 1)) == 0;
}

bl_status bl_tile_check(const bl_tile_settings *settings, const uint32_t usual[BL_TILE_AXES],
                        uint32_t least, bl_message *message) {
    uint32_t size[BL_TILE_AXES];
    bl_tile_sizes(settings, usual, size);
    double count = 1;
    for (uint32_t a = 0; a < settings->dimensions; a++) {
        if (!is_power_of_two(size[a]) || size[a] < least)
            return bl_report(message, BL_USAGE, "size=%u: expected a power of two from %u on",
                             size[a], least);
        count *= size[a];
    }
    if (count > LARGEST)
        return bl_report(message, BL_MISMATCH,
                         "size: a tile of %.0f numbers is too large; at most 2^26", count);
    if (settings->samples && !is_power_of_two(settings->samples))
        return bl_report(message, BL_USAGE, "samples=%u: expected a power of two",
                         settings->samples);
    return BL_OK;
}

void bl_tile_begin(bl_tile *tile, const bl_tile_settings *settings,
                   const uint32_t usual[BL_TILE_AXES], double rate) {
    bl_tile_covariance_keep(tile->covariance);
    *tile =
        (bl_tile){.dimensions = settings->dimensions, .rate = rate, .covariance = tile->covariance};
    bl_tile_sizes(settings, usual, tile->size);
    for (int a = 0; a < BL_TILE_AXES; a++)
        tile->kernel[a] = settings->interp;
}

void bl_tile_close_rows(double *numbers, size_t rows, size_t width) {
    for (size_t row = 1; row < rows; row++)
        memmove(numbers + row * width, numbers + row * (width + 2), width * sizeof *numbers);
}

bl_status bl_tile_make(bl_tile *tile, const double *numbers, double scale, bl_message *message) {
    size_t count = bl_tile_count(tile->size);
    tile->number = malloc(count * sizeof *tile->number);
    if (!tile->number)
        return bl_report(message, BL_DEVICE, "out of memory for a tile of %zu numbers", count);
    for (size_t i = 0; i < count; i++)
        tile->number[i] = (float)(numbers[i] * scale);
    return BL_OK;
}

void bl_tile_release(bl_tile *tile) {
    free(tile->number);
    tile->number = NULL;
    bl_tile_covariance_drop(tile->covariance);
    tile->covariance = NULL;
}

// --- reading, in double -------------------------------------------------------------------------

// Weights and slopes at the fraction t of the cell; see noises/tiles/tile_points.h for the taps.
static void find_weights(uint32_t kernel, double t, double w[BL_TILE_TAPS],
                         double s[BL_TILE_TAPS]) {
    double r = 1 - t;
    switch (kernel) {
    case BL_TILE_BSPLINE3:
        w[0] = r * r * r / 6, s[0] = -r * r / 2;
        w[1] = 2.0 / 3 - t * t * (1 - t / 2), s[1] = t * (1.5 * t - 2);
        w[2] = 2.0 / 3 - r * r * (1 - r / 2), s[2] = -r * (1.5 * r - 2);
        w[3] = t * t * t / 6, s[3] = t * t / 2;
        break;
    case BL_TILE_CATMULL_ROM:
        w[0] = -t * r * r / 2, s[0] = r * (3 * t - 1) / 2;
        w[1] = 1 + t * t * (1.5 * t - 2.5), s[1] = t * (4.5 * t - 5);
        w[2] = 1 + r * r * (1.5 * r - 2.5), s[2] = -r * (4.5 * r - 5);
        w[3] = -r * t * t / 2, s[3] = -t * (3 * r - 1) / 2;
        break;
    case BL_TILE_LINEAR:
        w[0] = r, s[0] = -1;
        w[1] = t, s[1] = 1;
        break;
    case BL_TILE_NEAREST:
        w[0] = 1, s[0] = 0;
        break;
    case BL_TILE_BSPLINE2:
        w[0] = r * r / 2, s[0] = -r;
        w[1] = 0.5 + t * r, s[1] = 1 - 2 * t;
        w[2] = t * t / 2, s[2] = t;
        break;
    default: // b(d/2) at the distances t+2, t+1, t, t-1, t-2, t-3
        for (int k = 0; k < 6; k++) {
            double d = t + 2 - k, size = fabs(d) / 2, outer = 1.5 - size;
            int middle = k == 2 || k == 3;
            w[k] = middle ? 0.75 - size * size : outer * outer / 2;
            s[k] = middle ? -d / 2 : d > 0 ? -outer / 2 : outer / 2;
        }
    }
}

double bl_tile_value(const bl_tile *tile, const double at[BL_AXES], double gradient[BL_AXES]) {
    double w[BL_TILE_AXES][BL_TILE_TAPS] = {{1}, {1}, {1}}, s[BL_TILE_AXES][BL_TILE_TAPS] = {{0}};
    uint32_t cell[BL_TILE_AXES] = {0};
    int taps[BL_TILE_AXES] = {1, 1, 1}, first[BL_TILE_AXES] = {0}, inside = 1;
    for (uint32_t a = 0; a < tile->dimensions; a++) {
        double t;
        inside &= bl_tile_split(at[a], tile->rate, tile->size[a],
                                bl_tile_is_shifted(tile->kernel[a]), &cell[a], &t);
        taps[a] = bl_tile_tap_count(tile->kernel[a]);
        first[a] = bl_tile_first_tap(tile->kernel[a]);
        find_weights(tile->kernel[a], t, w[a], s[a]);
    }
    double sum = 0, slope[BL_AXES] = {0};
    for (int k = 0; k < taps[2]; k++)
        for (int j = 0; j < taps[1]; j++)
            for (int i = 0; i < taps[0]; i++) {
                const int tap[BL_TILE_AXES] = {i, j, k};
                size_t place = 0;
                for (int a = BL_TILE_AXES - 1; a >= 0; a--)
                    place = place * tile->size[a] +
                            ((cell[a] + (uint32_t)(first[a] + tap[a])) & (tile->size[a] - 1));
                double number = tile->number[place];
                sum += number * w[0][i] * w[1][j] * w[2][k];
                slope[0] += number * s[0][i] * w[1][j] * w[2][k];
                slope[1] += number * w[0][i] * s[1][j] * w[2][k];
                slope[2] += number * w[0][i] * w[1][j] * s[2][k];
            }
    for (int a = 0; gradient && a < BL_AXES; a++)
        gradient[a] = inside ? slope[a] * tile->rate : NAN;
    return inside ? sum : NAN;
}

static int continuity_of(uint32_t kernel) {
    static const int class[BL_TILE_KERNELS] = {2, 1, 0, -1, 1, 1};
    return class[kernel];
}

void bl_tile_describe(const bl_tile *tile, bl_facts *facts) {
    facts->mean = 0;
    if (tile->covariance)
        facts->covariance_reach = INFINITY;
    facts->continuity = 2;
    facts->cell = 1 / tile->rate;
    facts->far = 0x1p52 * facts->cell; // from here on doubles are whole multiples of a cell
    for (uint32_t a = 0; a < BL_AXES; a++)
        facts->period[a] = a < tile->dimensions ? tile->size[a] / tile->rate : 0;
    for (uint32_t a = 0; a < tile->dimensions; a++) {
        int own = continuity_of(tile->kernel[a]);
        facts->continuity = own < facts->continuity ? own : facts->continuity;
    }
}

// --- the kernels' spectra -----------------------------------------------------------------------

double bl_tile_transform(bl_tile_kernel kernel, double v) {
    switch (kernel) {
    case BL_TILE_BSPLINE3:
        return pow(bl_sinc(v), 4);
    case BL_TILE_CATMULL_ROM:
        return bl_kernel_transform(BL_KERNEL_CATMULL_ROM, v);
    case BL_TILE_LINEAR:
        return pow(bl_sinc(v), 2);
    case BL_TILE_NEAREST:
        return bl_sinc(v);
    case BL_TILE_BSPLINE2:
        return pow(bl_sinc(v), 3);
    default:
        return 2 * pow(bl_sinc(2 * v), 3);
    }
}

double bl_tile_correlation(bl_tile_kernel kernel, double lag) {
    static const bl_kernel kernels[BL_TILE_KERNELS] = {BL_KERNEL_BSPLINE3, BL_KERNEL_CATMULL_ROM,
                                                       BL_KERNEL_LINEAR,   BL_KERNEL_LINEAR,
                                                       BL_KERNEL_BSPLINE2, BL_KERNEL_BSPLINE2};
    if (kernel == BL_TILE_NEAREST) // that of the box is the hat
        return fmax(0, 1 - fabs(lag));
    // int b(x/2) b((x+l)/2) dx = 2 rho(l/2).
    double stretch = kernel == BL_TILE_BSPLINE2_WIDE ? 2 : 1;
    return stretch * bl_kernel_correlation(kernels[kernel], lag / stretch);
}

double bl_tile_power(bl_tile_kernel kernel, double v) {
    double sum = bl_tile_correlation(kernel, 0);
    for (int lag = 1; lag < 6; lag++)
        sum += 2 * bl_tile_correlation(kernel, lag) * cos(2 * M_PI * v * lag);
    return sum;
}

double bl_tile_gain(bl_tile_kernel kernel) {
    // Catmull-Rom: noises/lattice/bounds.c. The others are not negative and add up to 1, the wide
    // one, whose even and odd taps each do, to 2.
    return kernel == BL_TILE_CATMULL_ROM ? 1.25 : kernel == BL_TILE_BSPLINE2_WIDE ? 2 : 1;
}

// --- making -------------------------------------------------------------------------------------

// c = 1/(1 - z x) s, then d = -z/(1 - z/x) c: together 1/(x + 1/x - z - 1/z) s.
void bl_tile_solve(double *numbers, size_t outer, size_t n, size_t inner, double pole) {
    double whole = 1 / (1 - pow(pole, (double)n));
    // Terms below e^-40 are below the rounding of the largest.
    double needed = ceil(-40 / log(fabs(pole)));
    size_t terms = needed < (double)(n - 1) ? (size_t)needed : n - 1;
    for (size_t o = 0; o < outer; o++) {
        double *line = numbers + o * n * inner, *last = line + (n - 1) * inner;
        // sum over i of z^i s_(-i), by Horner's rule from the far end: ..., s_(-2), s_(-1), s_0.
        for (size_t i = 0; i < inner; i++) {
            double start = 0;
            for (size_t k = n - terms; k < n; k++)
                start = start * pole + line[k * inner + i];
            line[i] = (start * pole + line[i]) * whole;
        }
        for (size_t k = 1; k < n; k++) {
            double *here = line + k * inner;
#pragma omp simd
            for (size_t i = 0; i < inner; i++)
                here[i] += pole * here[i - inner];
        }
        for (size_t i = 0; i < inner; i++) {
            double start = 0;
            for (size_t k = terms; k-- > 0;)
                start = start * pole + line[k * inner + i];
            last[i] = -pole * (start * pole + last[i]) * whole;
        }
        for (size_t k = n - 1; k-- > 0;) {
            double *here = line + k * inner;
#pragma omp simd
            for (size_t i = 0; i < inner; i++)
                here[i] = pole * (here[i + inner] - here[i]);
        }
    }
}

void bl_tile_prefilter(double *numbers, const uint32_t size[BL_TILE_AXES], bl_tile_kernel kernel) {
    if (kernel != BL_TILE_BSPLINE3)
        return;
    size_t inner = 1, count = bl_tile_count(size);
    double gain = 1;
    for (int a = 0; a < BL_TILE_AXES; a++) {
        if (size[a] > 1) {
            bl_tile_solve(numbers, count / (inner * size[a]), size[a], inner, sqrt(3) - 2);
            gain *= 6;
        }
        inner *= size[a];
    }
    for (size_t i = 0; i < count; i++)
        numbers[i] *= gain;
}

double bl_tile_prefilter_gain(bl_tile_kernel kernel) {
    return kernel == BL_TILE_BSPLINE3 ? 3 : 1;
}

void bl_tile_numbers(bl_random *random, double *numbers, size_t count) {
    // Each uniform number is one of the 2^16 odd multiples of 2^-16 in (-1, 1).
    const double scale = sqrt(0.75 / (1 - 0x1p-32)) * 0x1p-16;
    for (size_t i = 0; i < count; i++) {
        uint64_t bits = bl_random_bits(random);
        int32_t sum = (int32_t)((bits & 0xffff) + (bits >> 16 & 0xffff) + (bits >> 32 & 0xffff) +
                                (bits >> 48));
        numbers[i] = scale * (2 * sum + 4 - 4 * 65536);
    }
}
