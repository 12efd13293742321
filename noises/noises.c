// SPDX-License-Identifier: MIT
//
// The list of all noises: one descriptor of each for each instruction set, picked once at opening.
#include "noises/noise.h"

#include <string.h>

#define BL_NOISE(stem)                                                                             \
    extern const bl_noise bl_noise_##stem##_baseline, bl_noise_##stem##_v3, bl_noise_##stem##_v4;
#include "noises/noises.def"
#undef BL_NOISE

static const bl_noise *const variants[][BL_ISA_COUNT] = {
#define BL_NOISE(stem) {&bl_noise_##stem##_baseline, &bl_noise_##stem##_v3, &bl_noise_##stem##_v4},
#include "noises/noises.def"
#undef BL_NOISE
};

static const void *const list[] = {
#define BL_NOISE(stem) &bl_noise_##stem##_baseline,
#include "noises/noises.def"
#undef BL_NOISE
};

const bl_registry bl_noises = {"noise", "noises", list, sizeof list / sizeof *list};

const bl_noise *bl_noise_at(size_t index, bl_isa isa) {
    if (index >= bl_noises.count)
        return NULL;
    return variants[index][isa == BL_ISA_BEST ? bl_isa_best() : isa];
}

const bl_noise *bl_noise_find(const char *name, bl_isa isa) {
    for (size_t i = 0; i < bl_noises.count; i++)
        if (strcmp(bl_registry_entry(&bl_noises, i)->name, name) == 0)
            return bl_noise_at(i, isa);
    return NULL;
}

// What a noise that is made of another opens that with: of the instruction set that it is of.
static bl_status open_baseline(const char *text, bl_signal **signal, bl_message *message) {
    return bl_noise_open(text, BL_ISA_BASELINE, signal, message);
}

static bl_status open_v3(const char *text, bl_signal **signal, bl_message *message) {
    return bl_noise_open(text, BL_ISA_V3, signal, message);
}

static bl_status open_v4(const char *text, bl_signal **signal, bl_message *message) {
    return bl_noise_open(text, BL_ISA_V4, signal, message);
}

bl_opener *bl_noise_opener(bl_isa isa) {
    static bl_opener *const openers[] = {open_baseline, open_v3, open_v4};
    return openers[isa == BL_ISA_BEST ? bl_isa_best() : isa];
}

bl_status bl_noise_open(const char *text, bl_isa isa, bl_signal **signal, bl_message *message) {
    bl_spec spec;
    bl_status status = bl_spec_parse(text, &spec, message);
    if (status != BL_OK)
        return status;
    const bl_noise *noise = bl_noise_find(spec.name, isa);
    status = noise ? bl_definition_open(noise, &spec, text, bl_noise_opener(isa), signal, message)
                   : bl_registry_report(&bl_noises, spec.name, " at column 1", message);
    bl_spec_free(&spec);
    return status;
}
