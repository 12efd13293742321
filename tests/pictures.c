// SPDX-License-Identifier: MIT
#include "tests/pictures.h"

#include "tests/test.h"

#include "core/hash.h"
#include "core/statistics.h"
#include "sources/source.h"
#include "tests/temporary.h"

bl_signal *bl_test_picture(const float *values, size_t width, size_t height, const char *settings) {
    char text[4096];
    bl_signal *signal;
    bl_message message = {""};
    const char *path = bl_temporary_path("picture.raw");
    bl_temporary_write(path, values, width * height * sizeof *values);
    snprintf(text, sizeof text, "%s:size=%zux%zu%s%s", path, width, height, *settings ? "," : "",
             settings);
    if (bl_source_open(text, BL_ISA_BEST, &signal, &message) != BL_OK)
        fail_msg("%s", message.text);
    return signal;
}

// A normal number of a sample of the tile.
static double white(const bl_test_tile *t, long x, long y) {
    long w = (long)t->width, h = (long)t->height;
    uint64_t i = (uint64_t)(((x % w) + w) % w), j = (uint64_t)(((y % h) + h) % h);
    uint64_t bits = bl_mix(t->seed * 1000003 + j * t->width + i);
    return bl_normal_quantile(((double)(bits >> 12) + 0.5) * 0x1p-52);
}

// The weights of the kernel, whose squares sum to 1, and how far it reaches.
static long make_kernel(const bl_test_tile *t, double *kernel, long most) {
    double c = cos(t->degrees * M_PI / 180), s = sin(t->degrees * M_PI / 180), squares = 0;
    double along = t->sigma * (t->stretch > 0 ? t->stretch : 1);
    long reach = (long)ceil(3.5 * fmax(along, t->sigma)), side = 2 * reach + 1;
    assert_true(side * side <= most);
    for (long j = -reach; j <= reach; j++)
        for (long i = -reach; i <= reach; i++) {
            double u = ((double)i * c + (double)j * s) / (along > 0 ? along : 1);
            double v = ((double)j * c - (double)i * s) / (t->sigma > 0 ? t->sigma : 1);
            double weight = kernel[(j + reach) * side + i + reach] = exp(-0.5 * (u * u + v * v));
            squares += weight * weight;
        }
    for (long k = 0; k < side * side; k++)
        kernel[k] /= sqrt(squares);
    return reach;
}

void bl_test_tile_fill(const bl_test_tile *tile, const size_t first[2], const size_t count[2],
                       float *values) {
    static double kernel[301 * 301];
    long reach = make_kernel(tile, kernel, 301 * 301), side = 2 * reach + 1;
    size_t wide = count[0] + 2 * (size_t)reach, high = count[1] + 2 * (size_t)reach;
    double *noise = malloc(wide * high * sizeof *noise);
    assert_non_null(noise);
    for (size_t j = 0; j < high; j++)
        for (size_t i = 0; i < wide; i++)
            noise[j * wide + i] =
                white(tile, (long)(first[0] + i) - reach, (long)(first[1] + j) - reach);
    for (size_t j = 0; j < count[1]; j++)
        for (size_t i = 0; i < count[0]; i++) {
            double sum = 0;
            for (long b = 0; b < side; b++)
                for (long a = 0; a < side; a++)
                    sum += kernel[b * side + a] * noise[(j + (size_t)b) * wide + i + (size_t)a];
            values[j * count[0] + i] = (float)sum;
        }
    free(noise);
}
