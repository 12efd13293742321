// SPDX-License-Identifier: MIT
//
// Plain loops that several noises take as their yardsticks or as parts of them: the text's value
// and gradient noise (peachey2003, pp. 70-77), one call a point, and the reading of a tile.
#ifndef BL_NOISES_TEXTBOOK_LOOPS_H
#define BL_NOISES_TEXTBOOK_LOOPS_H

#include "noises/textbook.h"

#define BL_PLAIN static inline __attribute__((unused))

BL_PLAIN float bl_textbook_lerp(float t, float a, float b) {
    return a + t * (b - a);
}

BL_PLAIN float bl_textbook_corner(int ix, int iy, int iz, float fx, float fy, float fz) {
    const float *g = &bl_textbook_data.gradients[3 * bl_textbook_index(ix, iy, iz)];
    return g[0] * fx + g[1] * fy + g[2] * fz;
}

BL_PLAIN float bl_textbook_gradient(float x, float y, float z) {
    int ix = bl_textbook_floor(x), iy = bl_textbook_floor(y), iz = bl_textbook_floor(z);
    float x0 = x - (float)ix, x1 = x0 - 1, y0 = y - (float)iy, y1 = y0 - 1;
    float z0 = z - (float)iz, z1 = z0 - 1;
    float wx = x0 * x0 * (3 - 2 * x0), wy = y0 * y0 * (3 - 2 * y0), wz = z0 * z0 * (3 - 2 * z0);
    float near0 = bl_textbook_lerp(wx, bl_textbook_corner(ix, iy, iz, x0, y0, z0),
                                   bl_textbook_corner(ix + 1, iy, iz, x1, y0, z0));
    float near1 = bl_textbook_lerp(wx, bl_textbook_corner(ix, iy + 1, iz, x0, y1, z0),
                                   bl_textbook_corner(ix + 1, iy + 1, iz, x1, y1, z0));
    float far0 = bl_textbook_lerp(wx, bl_textbook_corner(ix, iy, iz + 1, x0, y0, z1),
                                  bl_textbook_corner(ix + 1, iy, iz + 1, x1, y0, z1));
    float far1 = bl_textbook_lerp(wx, bl_textbook_corner(ix, iy + 1, iz + 1, x0, y1, z1),
                                  bl_textbook_corner(ix + 1, iy + 1, iz + 1, x1, y1, z1));
    return bl_textbook_lerp(wz, bl_textbook_lerp(wy, near0, near1),
                            bl_textbook_lerp(wy, far0, far1));
}

// The text's spline through n knots, with all its generality.
BL_PLAIN float bl_textbook_spline(float x, int n, const float *knot) {
    int spans = n - 3;
    if (spans < 1)
        return 0;
    x = (x < 0 ? 0 : x > 1 ? 1 : x) * (float)spans;
    int span = (int)x;
    if (span >= spans)
        span = spans;
    x -= (float)span;
    knot += span;
    float c3 = -0.5f * knot[0] + 1.5f * knot[1] - 1.5f * knot[2] + 0.5f * knot[3];
    float c2 = knot[0] - 2.5f * knot[1] + 2.0f * knot[2] - 0.5f * knot[3];
    float c1 = -0.5f * knot[0] + 0.5f * knot[2];
    return ((c3 * x + c2) * x + c1) * x + knot[1];
}

BL_PLAIN float bl_textbook_value(float x, float y, float z) {
    int ix = bl_textbook_floor(x), iy = bl_textbook_floor(y), iz = bl_textbook_floor(z);
    float fx = x - (float)ix, fy = y - (float)iy, fz = z - (float)iz;
    // One knot more than is used: at x = 1 the text's spline steps to the last span.
    float xknots[5] = {0}, yknots[5] = {0}, zknots[5] = {0};
    for (int k = -1; k <= 2; k++) {
        for (int j = -1; j <= 2; j++) {
            for (int i = -1; i <= 2; i++)
                xknots[i + 1] = bl_textbook_data.values[bl_textbook_index(ix + i, iy + j, iz + k)];
            yknots[j + 1] = bl_textbook_spline(fx, 4, xknots);
        }
        zknots[k + 1] = bl_textbook_spline(fy, 4, yknots);
    }
    return bl_textbook_spline(fz, 4, zknots);
}

// A square tile of 4 numbers a unit, read with the weights of four neighbours along each axis.
BL_PLAIN float bl_textbook_read(const float *tile, int ix, int iy, const float wx[4],
                                const float wy[4]) {
    float sum = 0;
    for (int j = 0; j < 4; j++)
        for (int i = 0; i < 4; i++) {
            int column = (ix + i - 1) & (BL_TEXTBOOK_TILE - 1);
            int row = (iy + j - 1) & (BL_TEXTBOOK_TILE - 1);
            sum += wx[i] * wy[j] * tile[row * BL_TEXTBOOK_TILE + column];
        }
    return sum;
}

BL_PLAIN void bl_textbook_catmull_rom_weights(float t, float w[4]) {
    w[0] = 0.5f * t * (-1 + t * (2 - t));
    w[1] = 1 + 0.5f * t * t * (-5 + 3 * t);
    w[2] = 0.5f * t * (1 + t * (4 - 3 * t));
    w[3] = 0.5f * t * t * (t - 1);
}

BL_PLAIN float bl_textbook_catmull_rom_tile(const float *tile, float x, float y) {
    float u = 4 * x, v = 4 * y, wx[4], wy[4];
    int ix = bl_textbook_floor(u), iy = bl_textbook_floor(v);
    bl_textbook_catmull_rom_weights(u - (float)ix, wx);
    bl_textbook_catmull_rom_weights(v - (float)iy, wy);
    return bl_textbook_read(tile, ix, iy, wx, wy);
}

// The text's table of the radial kernel, by the nearest entry.
BL_PLAIN float bl_textbook_kernel(float squared) {
    if (squared >= 4)
        return 0;
    int entry = bl_textbook_floor(squared * 100 + 0.5f);
    return entry > 400 ? 0 : bl_textbook_data.kernel[entry];
}

// A generator a cell, for the loops of impulses, and Poisson numbers by Knuth's products of uniform
// ones, down to e^-mean.
BL_PLAIN uint32_t bl_textbook_cell(int ix, int iy) {
    return (uint32_t)ix * 0x9E3779B1u ^ (uint32_t)iy * 65537u;
}

BL_PLAIN float bl_textbook_uniform(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) * 0x1p-24f;
}

BL_PLAIN int bl_textbook_poisson(uint32_t *state, float limit) {
    int count = -1;
    for (float product = 1; product > limit; count++)
        product *= bl_textbook_uniform(state);
    return count;
}

#endif
