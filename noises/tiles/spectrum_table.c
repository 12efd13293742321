// SPDX-License-Identifier: MIT
#include "noises/tiles/spectrum_table.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct reader {
    const char *path;
    size_t line, room;
    int seen_header;
    bl_spectrum_table *table;
    bl_message *message;
} reader;

// The number at the start of a field, and where the field ends; NULL if there is none.
static const char *read_field(const char *text, double *number) {
    char *end;
    *number = strtod(text, &end);
    if (end == text)
        return NULL;
    end += strspn(end, " \t\r\n");
    return *end == ',' || *end == '\0' ? end : NULL;
}

static bl_status complain(const reader *in, const char *what) {
    if (in->line == 0)
        return bl_report(in->message, BL_USAGE, "csv=%s: the file is empty", in->path);
    return bl_report(in->message, BL_USAGE, "csv=%s, line %zu: %s", in->path, in->line, what);
}

static bl_status make_room(reader *in) {
    bl_spectrum_table *table = in->table;
    if (table->count < in->room)
        return BL_OK;
    in->room = in->room ? 2 * in->room : 64;
    double *frequency = realloc(table->frequency, in->room * sizeof *frequency);
    if (frequency)
        table->frequency = frequency;
    double *density = realloc(table->density, in->room * sizeof *density);
    if (density)
        table->density = density;
    return frequency && density
               ? BL_OK
               : bl_report(in->message, BL_DEVICE, "out of memory reading %s", in->path);
}

static bl_status read_line(reader *in, const char *text) {
    double frequency, density;
    text += strspn(text, " \t\r\n");
    if (*text == '\0' || *text == '#')
        return BL_OK;
    const char *end = read_field(text, &frequency);
    if (!end && !in->seen_header && in->table->count == 0) {
        in->seen_header = 1;
        return BL_OK;
    }
    if (!end)
        return complain(in, "expected a frequency, a number");
    if (*end != ',' || !read_field(end + 1, &density))
        return complain(in, "expected a density, a number, after a comma");
    if (!(frequency >= 0 && isfinite(frequency)))
        return complain(in, "expected a frequency from 0 on");
    if (!(density >= 0 && isfinite(density)))
        return complain(in, "expected a density from 0 on");
    if (in->table->count && frequency <= in->table->frequency[in->table->count - 1])
        return complain(in, "frequencies must rise from line to line");
    bl_status status = make_room(in);
    if (status == BL_OK) {
        in->table->frequency[in->table->count] = frequency;
        in->table->density[in->table->count++] = density;
    }
    return status;
}

bl_status bl_spectrum_table_read(const char *path, bl_spectrum_table **table, bl_message *message) {
    FILE *file = fopen(path, "r");
    if (!file)
        return bl_report(message, BL_DEVICE, "csv=%s: %s", path, strerror(errno));
    reader in = {.path = path, .message = message, .table = calloc(1, sizeof *in.table)};
    char *text = NULL;
    size_t size = 0;
    bl_status status =
        in.table ? BL_OK : bl_report(message, BL_DEVICE, "out of memory reading %s", path);
    while (status == BL_OK && (errno = 0, getline(&text, &size, file)) >= 0) {
        in.line++;
        status = read_line(&in, text);
    }
    if (status == BL_OK && !feof(file))
        status = bl_report(message, BL_DEVICE, "csv=%s: %s", path, strerror(errno));
    if (status == BL_OK && in.table->count < 2)
        status = complain(&in, "the table ends; expected two rows or more");
    free(text);
    fclose(file);
    if (in.table)
        in.table->users = 1;
    if (status == BL_OK)
        *table = in.table;
    else
        bl_spectrum_table_drop(in.table);
    return status;
}

void bl_spectrum_table_keep(bl_spectrum_table *table) {
    __atomic_add_fetch(&table->users, 1, __ATOMIC_RELAXED);
}

void bl_spectrum_table_drop(bl_spectrum_table *table) {
    if (!table || __atomic_sub_fetch(&table->users, 1, __ATOMIC_ACQ_REL) > 0)
        return;
    free(table->frequency);
    free(table->density);
    free(table);
}

double bl_spectrum_table_density(const bl_spectrum_table *table, double frequency) {
    const double *f = table->frequency;
    size_t low = 0, high = table->count - 1;
    if (!(frequency >= f[0] && frequency <= f[high]))
        return 0;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (frequency < f[middle])
            high = middle;
        else
            low = middle;
    }
    double t = (frequency - f[low]) / (f[high] - f[low]); // the frequencies rise: not 0
    return (1 - t) * table->density[low] + t * table->density[high];
}
