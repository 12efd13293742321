// SPDX-License-Identifier: MIT
//
// A noise as a program: cmd:./noise {seed}. Value noise with a smooth fade on the integer lattice.
// (Written for little-endian machines: numbers are read and written as they are.)
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

static uint64_t seed;

static double lattice(const double *cell, uint64_t dims, unsigned corner) {
    uint64_t hash = seed;
    for (uint64_t a = 0; a < dims; a++) {
        double whole = fmod(cell[a] + (corner >> a & 1), 0x1p32);
        hash = (hash ^ (uint64_t)(int64_t)whole) * 0x9E3779B97F4A7C15u;
        hash ^= hash >> 32;
    }
    return (double)(hash >> 11) * 0x1p-52 - 1;
}

static double noise(const double *p, uint64_t dims) {
    double cell[4], weight[4], sum = 0;
    for (uint64_t a = 0; a < dims; a++) {
        cell[a] = floor(p[a]);
        double t = p[a] - cell[a];
        weight[a] = t * t * (3 - 2 * t);
    }
    for (unsigned corner = 0; corner < 1u << dims; corner++) {
        double product = lattice(cell, dims, corner);
        for (uint64_t a = 0; a < dims; a++)
            product *= corner >> a & 1 ? weight[a] : 1 - weight[a];
        sum += product;
    }
    return sum;
}

int main(int count, char **words) {
    uint64_t head[2];
    seed = count > 1 ? strtoull(words[1], NULL, 10) : 0;
    while (fread(head, sizeof *head, 2, stdin) == 2) {
        if (head[1] > 4)
            return 1;
        for (uint64_t i = 0; i < head[0]; i++) {
            double p[4] = {0};
            if (fread(p, sizeof *p, head[1], stdin) != head[1])
                return 1;
            const double value = noise(p, head[1]);
            fwrite(&value, sizeof value, 1, stdout);
        }
        fflush(stdout);
    }
    return 0;
}
