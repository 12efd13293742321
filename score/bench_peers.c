// SPDX-License-Identifier: MIT
//
// Other libraries in the same run. libnoise is C++; its functions take plain numbers, so the
// running program looks them up under their mangled names, and the build needs nothing of them.
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "score/bench.h"
#include "noises/textbook.h"

enum { STANDARD_QUALITY = 1 };

typedef double (*libnoise_function)(double x, double y, double z, int seed, int quality);

static libnoise_function gradient_function, value_function;

static double gradient_value(double x, double y, double z) {
    return gradient_function(x, y, z, 0, STANDARD_QUALITY);
}

static double value_value(double x, double y, double z) {
    return value_function(x, y, z, 0, STANDARD_QUALITY);
}

// The library stays loaded until the program ends.
static libnoise_function find_libnoise(const char *symbol) {
    static const char *const names[] = {"libnoise.so.0", "libnoise.so.2", "libnoise.so"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        void *library = dlopen(names[i], RTLD_NOW | RTLD_LOCAL);
        void *found = library ? dlsym(library, symbol) : NULL;
        libnoise_function function;
        memcpy(&function, &found, sizeof function); // POSIX lets a function stand in a void *
        if (found)
            return function;
    }
    return NULL;
}

static bl_peer_function libnoise_gradient(void) {
    gradient_function = find_libnoise("_ZN5noise23GradientCoherentNoise3DEdddiNS_12NoiseQualityE");
    return gradient_function ? gradient_value : NULL;
}

static bl_peer_function libnoise_value(void) {
    value_function = find_libnoise("_ZN5noise20ValueCoherentNoise3DEdddiNS_12NoiseQualityE");
    return value_function ? value_value : NULL;
}

static const struct {
    const char *name;
    bl_peer_function (*find)(void);
    const char *counterpart;
} peers[] = {
#define BL_PEER(name, find, counterpart) {name, find, counterpart},
#include "score/bench_peers.def"
#undef BL_PEER
};

typedef struct peer_work {
    bl_peer_function function;
    double at[3][BL_SCATTERED];
    float at_float[3][BL_SCATTERED];
    float out[BL_SCATTERED], textbook_out[BL_SCATTERED];
} peer_work;

static void run_peer(void *user) {
    peer_work *work = user;
    for (size_t i = 0; i < BL_SCATTERED; i++)
        work->out[i] = (float)work->function(work->at[0][i], work->at[1][i], work->at[2][i]);
}

static void scatter(peer_work *work) {
    bl_bench_scatter(3, work->at);
    for (int a = 0; a < 3; a++)
        for (size_t i = 0; i < BL_SCATTERED; i++)
            work->at_float[a][i] = (float)work->at[a][i];
}

bl_status bl_bench_peers(bl_bench *bench, bl_message *message) {
    static peer_work work;
    scatter(&work);
    bl_textbook_tables(bl_noise_opener(BL_ISA_BASELINE));
    for (size_t p = 0; p < sizeof peers / sizeof *peers; p++) {
        if (!(work.function = peers[p].find()))
            continue;
        const bl_noise *noise = bl_noise_find(peers[p].counterpart, bench->isa);
        bl_textbook_work plain = {.textbook = noise ? noise->textbook : NULL,
                                  .at = {work.at_float[0], work.at_float[1], work.at_float[2]},
                                  .count = BL_SCATTERED,
                                  .out = work.textbook_out};
        const bl_work works[] = {{run_peer, &work, NULL}, {bl_textbook_run, &plain, NULL}};
        bl_time times[2] = {{.minimum = 0}, {.minimum = NAN, .median = NAN, .worst_block = NAN}};
        bl_bench_step(bench, "%s", peers[p].name);
        bl_time_by_turns(works, plain.textbook ? 2 : 1, bench->rounds, bench->turn_seconds, times);
        bl_bench_row row = {.path = "points",
                            .isa = "as built",
                            .samples_per_cell = BL_SCATTERED / pow(BL_SCATTER_CUBE, 3),
                            .samples = BL_SCATTERED,
                            .against = plain.textbook ? "textbook" : NULL,
                            .candidate = times[0],
                            .yardstick = times[1],
                            .max_error = NAN,
                            .floor = NAN,
                            .peer = 1};
        snprintf(row.signal, sizeof row.signal, "%s", peers[p].name);
        if (!bl_bench_add(bench, &row))
            return bl_report(message, BL_DEVICE, "out of memory");
    }
    return BL_OK;
}
