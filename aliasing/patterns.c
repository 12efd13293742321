// SPDX-License-Identifier: MIT
#include "aliasing/patterns.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "core/hash.h"

const char *const bl_pattern_words[] = {"regular", "jitter", "stratified", "halton", "sobol", NULL};

static double unit(uint64_t bits) {
    return (double)(bits >> 11) * 0x1p-53;
}

// A place in a random permutation of 0 .. n-1: a bijection of the next power of two, walked until
// it falls below n, which it does after two steps on average and at the latest where it started.
static uint32_t permuted(uint32_t index, uint32_t n, uint64_t key) {
    uint32_t mask = 1;
    while (mask < n - 1)
        mask = 2 * mask + 1;
    do {
        for (int round = 0; round < 3; round++) {
            uint64_t bits = bl_stream(key, (uint64_t)round);
            index = (index ^ (uint32_t)bits) & mask;
            index = (index * ((uint32_t)(bits >> 32) | 1)) & mask;
            index ^= index >> 1;
        }
    } while (index >= n);
    return index;
}

static double radical_inverse(uint32_t index, uint32_t base) {
    double sum = 0, digit = 1.0 / base;
    for (; index; index /= base, digit /= base)
        sum += digit * (index % base);
    return sum;
}

static double wrapped(double x) {
    return x >= 1 ? x - 1 : x;
}

// The binary digits of the index, mirrored at the point; and in the second dimension the sum modulo
// 2 of direction numbers, of which each is the one before plus itself a digit further: those of the
// polynomial x + 1.
void bl_sobol_place(uint32_t index, uint64_t key, double out[2]) {
    uint32_t x = (uint32_t)(bl_stream(key, 0) >> 32), y = (uint32_t)(bl_stream(key, 1) >> 32);
    uint32_t first = UINT32_C(1) << 31, second = first;
    for (; index; index >>= 1, first >>= 1, second ^= second >> 1)
        if (index & 1) {
            x ^= first;
            y ^= second;
        }
    out[0] = x * 0x1p-32;
    out[1] = y * 0x1p-32;
}

static void stratified_place(uint32_t n, uint32_t index, uint64_t key, double out[2]) {
    uint32_t i = index % n, j = index / n;
    uint64_t jitter = bl_stream(key, index);
    double fine_x = permuted(j, n, bl_stream(key, (UINT64_C(1) << 40) + i));
    double fine_y = permuted(i, n, bl_stream(key, (UINT64_C(2) << 40) + j));
    out[0] = (i + (fine_x + unit(jitter)) / n) / n;
    out[1] = (j + (fine_y + unit(bl_mix(jitter))) / n) / n;
}

void bl_pattern_place(bl_pattern pattern, uint32_t n, uint32_t index, uint64_t key, double out[2]) {
    uint64_t random = bl_stream(key, index);
    switch (pattern) {
    case BL_PATTERN_JITTER:
        out[0] = (index % n + unit(random)) / n;
        out[1] = (index / n + unit(bl_mix(random))) / n;
        break;
    case BL_PATTERN_STRATIFIED:
        stratified_place(n, index, key, out);
        break;
    case BL_PATTERN_HALTON:
        out[0] = wrapped(radical_inverse(index, 2) + unit(bl_stream(key, 0)));
        out[1] = wrapped(radical_inverse(index, 3) + unit(bl_stream(key, 1)));
        break;
    case BL_PATTERN_SOBOL:
        bl_sobol_place(index, key, out);
        break;
    default:
        out[0] = (index % n + 0.5) / n;
        out[1] = (index / n + 0.5) / n;
    }
    for (int a = 0; a < 2; a++) // rounding may reach the end
        out[a] = out[a] < 1 ? out[a] : 1 - 0x1p-53;
}

uint64_t bl_pattern_key(uint64_t seed, double x, double y) {
    uint64_t a, b;
    memcpy(&a, &x, sizeof a);
    memcpy(&b, &y, sizeof b);
    return bl_stream(bl_stream(seed, a), b);
}
