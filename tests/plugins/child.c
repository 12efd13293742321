// SPDX-License-Identifier: MIT
//
// A program that answers points, well or badly: child MODE [SEED]. The value at (x, y, ...) is
// x + 10 y + 100 z + 1000 w + 0.25 seed. A mode may begin with the block in which it starts (the
// first is 0, which is the question that opening asks). The mode `saw` gives the fraction alone.
#include <math.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static double values[1 << 16], places[1 << 18];

static double value_at(const double *p, uint64_t dims, double seed) {
    static const double factor[] = {1, 10, 100, 1000};
    double sum = 0.25 * seed;
    for (uint64_t a = 0; a < dims; a++)
        sum += factor[a] * p[a];
    return sum;
}

static void put(size_t count) {
    fwrite(values, sizeof *values, count, stdout);
    fflush(stdout);
}

// What a mode does instead of an answer.
static void misbehave(const char *mode, size_t count) {
    if (strcmp(mode, "die") == 0)
        exit(7);
    if (strcmp(mode, "crash") == 0)
        raise(SIGKILL);
    if (strcmp(mode, "half") == 0) {
        put(count / 2);
        exit(0);
    }
    if (strcmp(mode, "little") == 0) {
        put(count - 1);
        return;
    }
    if (strcmp(mode, "stall") == 0)
        sleep(600);
    if (strcmp(mode, "close") == 0) {
        fclose(stdout);
        close(1);
        sleep(600);
    }
    if (strcmp(mode, "much") == 0) {
        values[count] = 1;
        put(count + 1);
        return;
    }
    if (strcmp(mode, "text") == 0) {
        printf("%g\n", values[0]);
        fflush(stdout);
        return;
    }
    if (strcmp(mode, "nan") == 0) {
        fprintf(stderr, "log of -1\n");
        values[count - 1] = NAN;
    }
    if (strcmp(mode, "worse") == 0) { // first no number, then the end
        static int before;
        if (before++)
            exit(7);
        values[count - 1] = NAN;
    }
    if (strcmp(mode, "slow") == 0) { // but it moves
        for (size_t i = 0; i < count; i++) {
            fwrite(values + i, sizeof *values, 1, stdout);
            fflush(stdout);
            usleep(60000);
        }
        return;
    }
    if (strcmp(mode, "again") == 0) { // the answer once more, a moment later
        usleep(200000);
        put(count);
        usleep(20000);
    }
    if (strcmp(mode, "talk") == 0) {
        for (int i = 0; i < 20000; i++)
            fprintf(stderr, "line %d\033[31m\n", i);
        fprintf(stderr, "the \"last\" words\a\n");
        exit(3);
    }
    if (strcmp(mode, "saw") == 0)
        for (size_t i = 0; i < count; i++) // below 2^63: places are within a few million
            values[i] -= (double)(long long)values[i];
    if (strcmp(mode, "chatter") == 0) // harmless: more than a pipe holds
        for (int i = 0; i < 20000; i++)
            fprintf(stderr, "a note\n");
    put(count);
}

int main(int argument_count, char **arguments) {
    const char *mode = argument_count > 1 ? arguments[1] : "good";
    double seed = argument_count > 2 ? atof(arguments[2]) : 0;
    long first = strtol(mode, (char **)&mode, 10);
    uint64_t head[2];
    for (long block = 0; fread(head, sizeof *head, 2, stdin) == 2; block++) {
        if (strcmp(mode, "stream") == 0) { // answers before it has read all
            for (uint64_t i = 0; i < head[0]; i++) {
                if (fread(places, sizeof *places, head[1], stdin) != head[1])
                    return 9;
                values[0] = value_at(places, head[1], seed);
                put(1);
            }
            continue;
        }
        if (fread(places, sizeof *places, head[0] * head[1], stdin) != head[0] * head[1])
            return 9;
        for (uint64_t i = 0; i < head[0]; i++)
            values[i] = value_at(places + i * head[1], head[1], seed);
        if (block >= first && strcmp(mode, "good") != 0 && strcmp(mode, "late") != 0) {
            misbehave(mode, head[0]);
        } else {
            put(head[0]);
        }
    }
    if (strcmp(mode, "late") == 0) // a word of farewell that nobody asked for
        puts("done");
    return 0;
}
