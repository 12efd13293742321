// SPDX-License-Identifier: MIT
//
// The registry: one descriptor of each noise for each instruction set, picked once at opening.
#include "noises/noise.h"

#include <string.h>

#define BL_NOISE(stem)                                                                             \
    extern const bl_noise bl_noise_##stem##_baseline, bl_noise_##stem##_v3, bl_noise_##stem##_v4;
#include "noises/noises.def"
#undef BL_NOISE

static const bl_noise *const registry[][BL_ISA_COUNT] = {
#define BL_NOISE(stem) {&bl_noise_##stem##_baseline, &bl_noise_##stem##_v3, &bl_noise_##stem##_v4},
#include "noises/noises.def"
#undef BL_NOISE
};

enum { NOISE_COUNT = sizeof registry / sizeof *registry };

static const char *const isa_names[] = {"baseline", "v3", "v4", NULL};

const char *bl_isa_name(bl_isa isa) {
    return isa_names[isa == BL_ISA_BEST ? bl_isa_best() : isa];
}

int bl_isa_runs_here(bl_isa isa) {
    switch (isa) {
    case BL_ISA_V4:
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
               __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl") && bl_isa_runs_here(BL_ISA_V3);
    case BL_ISA_V3:
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
               __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma");
    default:
        return 1;
    }
}

bl_isa bl_isa_best(void) {
    return bl_isa_runs_here(BL_ISA_V4)   ? BL_ISA_V4
           : bl_isa_runs_here(BL_ISA_V3) ? BL_ISA_V3
                                         : BL_ISA_BASELINE;
}

bl_status bl_isa_read(const char *word, bl_isa *isa, bl_message *message) {
    for (int i = 0; i < BL_ISA_COUNT; i++) {
        if (strcmp(word, isa_names[i]) != 0)
            continue;
        if (!bl_isa_runs_here((bl_isa)i))
            return bl_report(message, BL_MISMATCH,
                             "--isa %s: this processor lacks it; the best here is %s", word,
                             bl_isa_name(BL_ISA_BEST));
        *isa = (bl_isa)i;
        return BL_OK;
    }
    return bl_report(message, BL_USAGE, "--isa %s: not an instruction set; use baseline, v3 or v4",
                     word);
}

size_t bl_noise_count(void) {
    return NOISE_COUNT;
}

const bl_noise *bl_noise_at(size_t index, bl_isa isa) {
    if (index >= NOISE_COUNT)
        return NULL;
    return registry[index][isa == BL_ISA_BEST ? bl_isa_best() : isa];
}

const bl_noise *bl_noise_find(const char *name, bl_isa isa) {
    for (size_t i = 0; i < NOISE_COUNT; i++)
        if (strcmp(registry[i][0]->name, name) == 0)
            return bl_noise_at(i, isa);
    return NULL;
}

static bl_status report_unknown(const char *name, bl_message *message) {
    const char *names[NOISE_COUNT + 1] = {NULL};
    for (size_t i = 0; i < NOISE_COUNT; i++)
        names[i] = registry[i][0]->name;
    const char *near = bl_nearest(name, names);
    return bl_report(message, BL_USAGE,
                     "unknown signal '%s' at column 1%s%s%s `bandlimit list noises` shows all",
                     name, near ? "; did you mean '" : "", near ? near : "", near ? "'?" : ";");
}

bl_status bl_noise_open(const char *text, bl_isa isa, bl_signal **signal, bl_message *message) {
    bl_spec spec;
    bl_status status = bl_spec_parse(text, &spec, message);
    if (status != BL_OK)
        return status;
    const bl_noise *noise = bl_noise_find(spec.name, isa);
    status = noise ? bl_definition_open(noise, &spec, text, signal, message)
                   : report_unknown(spec.name, message);
    bl_spec_free(&spec);
    return status;
}
