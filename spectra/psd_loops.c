// SPDX-License-Identifier: MIT
//
// The loops over every sample and every cell of a slice or volume, for the baseline and for AVX2.
//
// Both are compiled from one source, in which every sum names its order (sixteen partial sums), and
// without fused operations: the bits are the same.
#include <math.h>

#include "spectra/psd_parts.h"

enum { PARTS = 16, CELLS = BL_CELLS_AT_ONCE };

#define BL_INLINE static inline __attribute__((always_inline))

BL_INLINE double sum_parts(const double parts[PARTS]) {
    double sum = 0;
    for (size_t j = 0; j < PARTS; j++)
        sum += parts[j];
    return sum;
}

BL_INLINE void sum_row(const float *row, size_t size, double *sum, double *square) {
    double parts[PARTS] = {0}, squares[PARTS] = {0};
    size_t whole = size / PARTS * PARTS;
    for (size_t i = 0; i < whole; i += PARTS)
        for (size_t j = 0; j < PARTS; j++) {
            double x = (double)row[i + j];
            parts[j] += x;
            squares[j] += x * x;
        }
    for (size_t i = whole; i < size; i++) {
        parts[0] += (double)row[i];
        squares[0] += (double)row[i] * (double)row[i];
    }
    *sum = sum_parts(parts);
    *square = sum_parts(squares);
}

BL_INLINE double weight_row(const float *row, const float *window, size_t size, float mean,
                            float factor, float *out) {
    double parts[PARTS] = {0};
    size_t whole = size / PARTS * PARTS;
    for (size_t i = 0; i < whole; i += PARTS)
        for (size_t j = 0; j < PARTS; j++) {
            float value = (row[i + j] - mean) * (window[i + j] * factor);
            out[i + j] = value;
            parts[j] += (double)value * (double)value;
        }
    for (size_t i = whole; i < size; i++) {
        out[i] = (row[i] - mean) * (window[i] * factor);
        parts[0] += (double)out[i] * (double)out[i];
    }
    return sum_parts(parts);
}

// |X|^2 stays in float where it stands, for whoever wants the plane; scaled only in double, because
// weak cells of a large slice would be denormal numbers in float.
BL_INLINE void square_cells(float *cells, size_t count, float power[CELLS]) {
    for (size_t i = 0; i < count; i++)
        power[i] = cells[2 * i] * cells[2 * i] + cells[2 * i + 1] * cells[2 * i + 1];
    for (size_t i = 0; i < count; i++)
        cells[2 * i] = power[i];
}

BL_INLINE void bin_some_cells(float *cells, float *mirror, size_t from, size_t count, double rest,
                              const double *weight, size_t bin_count, bl_bin_sum *sums) {
    float power[CELLS], other[CELLS] = {0};
    double sum[CELLS], square[CELLS];
    int bins[CELLS];
    square_cells(cells, count, power);
    if (mirror)
        square_cells(mirror, count, other);
    for (size_t i = 0; i < count; i++) {
        double a = (double)power[i], b = (double)other[i], x = (double)(int)(from + i);
        double nearest = sqrt(x * x + rest) + 0.5; // as bl_bin_of
        bins[i] = (int)(nearest < (double)bin_count ? nearest : (double)bin_count);
        sum[i] = weight[i] * (a + b);
        square[i] = weight[i] * (a * a + b * b);
    }
    for (size_t i = 0; i < count; i++) {
        sums[bins[i]].sum += sum[i];
        sums[bins[i]].square += square[i];
    }
}

// A whole block has a constant count, which the compiler turns into whole vectors.
BL_INLINE void bin_cells(float *cells, float *mirror, size_t from, size_t count, double rest,
                         const double *weight, size_t bin_count, bl_bin_sum *sums) {
    if (count == CELLS && mirror)
        bin_some_cells(cells, mirror, from, CELLS, rest, weight, bin_count, sums);
    else
        bin_some_cells(cells, mirror, from, count, rest, weight, bin_count, sums);
}

#define BL_LOOPS(name, attribute)                                                                  \
    attribute static void sum_row_##name(const float *row, size_t size, double *sum,               \
                                         double *square) {                                         \
        sum_row(row, size, sum, square);                                                           \
    }                                                                                              \
    attribute static double weight_row_##name(const float *row, const float *window, size_t size,  \
                                              float mean, float factor, float *out) {              \
        return weight_row(row, window, size, mean, factor, out);                                   \
    }                                                                                              \
    attribute static void bin_cells_##name(float *cells, float *mirror, size_t from, size_t count, \
                                           double rest, const double *weight, size_t bin_count,    \
                                           bl_bin_sum *sums) {                                     \
        bin_cells(cells, mirror, from, count, rest, weight, bin_count, sums);                      \
    }                                                                                              \
    static const bl_loops loops_##name = {sum_row_##name, weight_row_##name, bin_cells_##name};

#define BL_NO_ATTRIBUTE
BL_LOOPS(baseline, BL_NO_ATTRIBUTE)

#ifdef __x86_64__
BL_LOOPS(avx2, __attribute__((target("avx2"))))
#endif

const bl_loops *bl_psd_loops(void) {
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx2"))
        return &loops_avx2;
#endif
    return &loops_baseline;
}
