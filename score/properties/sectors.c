// SPDX-License-Identifier: MIT
#include "score/properties/sectors.h"

#include <math.h>
#include <stdlib.h>

#include "core/grid.h"
#include "spectra/window.h"

enum { SIZE = 64, RATE = 4, WIDTH = SIZE / 2 + 1, PITCH = 2 * WIDTH };

static const bl_fft_shape shape = {
    .kind = BL_FFT_REAL, .precision = BL_FFT_FLOAT, .dims = 2, .size = {SIZE, SIZE}};

bl_status bl_score_sectors_plan(const bl_fft **plan, bl_message *message) {
    return bl_fft_plan(&shape, plan, message);
}

// Samples a slice under the window.
static void sample(const bl_signal *signal, const bl_score_look *look, const double start[BL_AXES],
                   const double right[BL_AXES], const double down[BL_AXES], float *buffer) {
    double window[SIZE];
    bl_window_fill(BL_WINDOW_BLACKMAN_HARRIS, SIZE, window);
    for (int j = 0; j < SIZE; j++) {
        double at[BL_AXES];
        float *row = buffer + (size_t)j * PITCH;
        for (int a = 0; a < BL_AXES; a++)
            at[a] = start[a] + j * down[a];
        bl_signal_row(signal, at, right, SIZE, row);
        for (int i = 0; i < SIZE; i++)
            row[i] = (float)(((double)row[i] - look->mean) * window[i] * window[j]);
    }
}

// What white noise of deviation 1 has in a bin.
static double power_of_window(void) {
    double window[SIZE], sum = 0;
    bl_window_fill(BL_WINDOW_BLACKMAN_HARRIS, SIZE, window);
    for (int i = 0; i < SIZE; i++)
        sum += window[i] * window[i];
    return sum * sum;
}

// The mean powers near the axes of the grid, [0], and near its diagonals, [1].
static void sum_sectors(const float *spectrum, double mean[2]) {
    double count[2] = {0}, sum[2] = {0};
    for (int j = 0; j < SIZE; j++)
        for (int i = 0; i < WIDTH; i++) {
            int y = j <= SIZE / 2 ? j : SIZE - j;
            double longer = fmax(i, y), shorter = fmin(i, y), square = i * i + y * y;
            int is_axis = shorter < tan(M_PI / 12) * longer;
            int is_diagonal = shorter > tan(M_PI / 6) * longer;
            const float *bin = spectrum + (size_t)j * PITCH + 2 * i;
            if (square < SIZE / RATE * (SIZE / RATE) || square > SIZE / 2 * (SIZE / 2) ||
                !(is_axis || is_diagonal))
                continue;
            sum[is_diagonal] += (double)bin[0] * (double)bin[0] + (double)bin[1] * (double)bin[1];
            count[is_diagonal]++;
        }
    mean[0] = sum[0] / count[0];
    mean[1] = sum[1] / count[1];
}

int bl_score_sectors(const bl_signal *signal, const bl_score_look *look, const bl_fft *plan,
                     const unsigned pair[2], bl_random *random, double *near_axes,
                     double *near_diagonals) {
    float *buffer = bl_fft_buffer(bl_fft_bytes(&shape));
    double unit = look->deviation * look->deviation * power_of_window();
    *near_axes = *near_diagonals = 0;
    if (!buffer)
        return 0;
    for (int turned = 0; turned < 2; turned++) {
        double start[BL_AXES] = {0}, right[BL_AXES] = {0}, down[BL_AXES] = {0}, mean[2];
        double step = look->cell / RATE, oblique = step * sqrt(0.5);
        for (unsigned a = 0; a < look->dimensions; a++)
            start[a] = bl_score_base(random, look->cell) + look->cell * 16 * bl_random_unit(random);
        right[pair[0]] = down[pair[1]] = turned ? oblique : step;
        right[pair[1]] = turned ? oblique : 0;
        down[pair[0]] = turned ? -oblique : 0;
        sample(signal, look, start, right, down, buffer);
        bl_fft_run(plan, buffer);
        sum_sectors(buffer, mean);
        *near_axes += mean[turned] / unit;
        *near_diagonals += mean[!turned] / unit;
    }
    free(buffer);
    return 1;
}
