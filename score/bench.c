// SPDX-License-Identifier: MIT
#include "score/bench.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *signal, *path;
    double ratio;
} floors[] = {
#define BL_FLOOR(signal, path, ratio) {signal, path, ratio},
#include "score/bench_floors.def"
#undef BL_FLOOR
};

static double floor_of(const bl_bench_row *row) {
    for (size_t i = 0; i < sizeof floors / sizeof *floors; i++)
        if (strcmp(floors[i].signal, row->signal) == 0 && strcmp(floors[i].path, row->path) == 0)
            return floors[i].ratio;
    return NAN;
}

static bl_time per_sample(bl_time time, double samples) {
    return (bl_time){.minimum = time.minimum / samples,
                     .median = time.median / samples,
                     .worst_block = time.worst_block / samples};
}

int bl_bench_add(bl_bench *bench, const bl_bench_row *row) {
    bl_bench_row *rows = realloc(bench->rows, (bench->count + 1) * sizeof *rows);
    if (!rows)
        return 0;
    bench->rows = rows;
    bl_bench_row *added = &rows[bench->count++];
    *added = *row;
    added->candidate = per_sample(row->candidate, row->samples);
    added->yardstick = per_sample(row->yardstick, row->samples);
    added->ratio = row->yardstick.minimum / row->candidate.minimum;
    added->floor = floor_of(row);
    added->transforms = 1 / added->ratio;
    added->ceiling = 1 / added->floor;
    added->met = added->ratio >= added->floor;
    added->verdict = isnan(added->floor) ? BL_VERDICT_NOT_RUN
                     : added->met        ? BL_VERDICT_PASS
                                         : BL_VERDICT_FAIL;
    return 1;
}

int bl_bench_is_transform(const bl_bench_row *row) {
    return strcmp(row->path, "psd-4096") == 0;
}

size_t bl_bench_missed(const bl_bench *bench) {
    size_t missed = 0;
    for (size_t i = 0; i < bench->count; i++)
        missed += bench->rows[i].verdict == BL_VERDICT_FAIL;
    return missed;
}

void bl_bench_step(const bl_bench *bench, const char *format, ...) {
    char what[256];
    va_list arguments;
    if (!bench->progress)
        return;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    bench->progress(bench->user, what);
}
