// SPDX-License-Identifier: MIT
#include "tests/circles.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/test.h"

void bl_unit_of(const char *file, char unit[BL_UNIT_NAME]) {
    const char *name = strrchr(file, '/') ? strrchr(file, '/') + 1 : file;
    size_t folder = (size_t)(name - file), stem = strcspn(name, ".");
    char header[BL_UNIT_NAME + 2];
    assert_true(folder + stem < BL_UNIT_NAME);
    for (size_t end = strcspn(name, "_."); end < stem; end += 1 + strcspn(name + end + 1, "_.")) {
        snprintf(header, sizeof header, "%.*s.h", (int)(folder + end), file);
        if (access(header, R_OK) == 0) {
            stem = end;
            break;
        }
    }
    snprintf(unit, BL_UNIT_NAME, "%.*s", (int)(folder + stem), file);
}

bl_needs *bl_needs_new(void) {
    bl_needs *needs = calloc(1, sizeof *needs);
    assert_non_null(needs);
    return needs;
}

void bl_needs_free(bl_needs *needs) {
    for (size_t i = 0; i < needs->count; i++)
        for (size_t j = 0; j < needs->count; j++)
            free(needs->why[i][j]);
    free(needs);
}

static size_t index_of(bl_needs *needs, const char *file) {
    char unit[BL_UNIT_NAME];
    size_t i = 0;
    bl_unit_of(file, unit);
    while (i < needs->count && strcmp(needs->unit[i], unit) != 0)
        i++;
    if (i == needs->count) {
        assert_true(needs->count < BL_UNITS_MOST);
        strcpy(needs->unit[needs->count++], unit);
    }
    return i;
}

void bl_needs_add(bl_needs *needs, const char *file, const char *needed, const char *symbol) {
    size_t from = index_of(needs, file), to = index_of(needs, needed);
    if (from != to && !needs->why[from][to] &&
        asprintf(&needs->why[from][to], "%s %s%s%s %s", file, symbol ? "uses " : "includes",
                 symbol ? symbol : "", symbol ? " of" : "", needed) < 0)
        fail_msg("out of memory");
}

// Warshall's closure: which unit is reached from which.
static void join(bl_needs *needs) {
    size_t count = needs->count;
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < count; j++)
            needs->joined[i][j] = needs->why[i][j] != NULL;
    for (size_t k = 0; k < count; k++)
        for (size_t i = 0; i < count; i++)
            for (size_t j = 0; needs->joined[i][k] && j < count; j++)
                needs->joined[i][j] |= needs->joined[k][j];
}

static int in_circle(const bl_needs *needs, size_t a, size_t b) {
    return needs->joined[a][b] && needs->joined[b][a];
}

static void tell(const bl_needs *needs, size_t first, FILE *out) {
    fputs("a circle of", out);
    for (size_t i = first; i < needs->count; i++)
        if (in_circle(needs, first, i))
            fprintf(out, " %s", needs->unit[i]);
    fputc('\n', out);
    for (size_t i = first; i < needs->count; i++)
        for (size_t j = first; j < needs->count; j++)
            if (in_circle(needs, first, i) && in_circle(needs, first, j) && needs->why[i][j])
                fprintf(out, "  %s\n", needs->why[i][j]);
}

size_t bl_circles(bl_needs *needs, char *text, size_t size) {
    FILE *out = fmemopen(text, size, "w");
    size_t circles = 0;
    assert_non_null(out);
    join(needs);
    for (size_t i = 0; i < needs->count; i++) {
        size_t first = 0; // the first of the circle tells it
        while (first < i && !in_circle(needs, first, i))
            first++;
        if (first == i && in_circle(needs, i, i)) {
            tell(needs, i, out);
            circles++;
        }
    }
    fclose(out);
    text[size - 1] = '\0'; // where it does not fit
    return circles;
}
