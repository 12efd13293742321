// SPDX-License-Identifier: MIT
#include "reports/reproduce.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/file.h"
#include "reports/record.h"
#include "reports/page.h"

bl_reproduce_settings bl_reproduce_default_settings(void) {
    return (bl_reproduce_settings){
        .folder = "out", .format = "svg", .size = BL_NORMAL, .seed = 1, .isa = BL_ISA_BEST};
}

// The runs of a reproduction, in the order of its figures.
typedef struct runs {
    size_t count;
    bl_run *run[];
} runs;

// The figures that a run may choose from.
static bl_registry registry_of(const bl_reproduce_settings *settings) {
    bl_registry registry = bl_figures;
    if (settings->figures) {
        registry.list = (const void *const *)settings->figures;
        registry.count = settings->figure_count;
    }
    return registry;
}

// Every name is looked up before the first figure runs: a typing error must not cost a minute.
static bl_status check(const bl_registry *figures, const char *const *names, size_t count,
                       const bl_reproduce_settings *settings, bl_message *message) {
    if (strcmp(settings->format, "svg") != 0 && strcmp(settings->format, "pdf") != 0)
        return bl_report(message, BL_USAGE, "unknown format '%s'; use svg or pdf",
                         settings->format);
    for (size_t i = 0; i < count; i++) {
        if (!bl_registry_find(figures, names[i]))
            return bl_registry_report(figures, names[i], NULL, message);
        for (size_t j = 0; j < i; j++)
            if (strcmp(names[i], names[j]) == 0)
                return bl_report(message, BL_USAGE, "figure '%s' is named twice", names[i]);
    }
    return bl_make_folder(settings->folder, message);
}

static bl_status run_all(const bl_registry *figures, const char *const *names, size_t count,
                         const bl_reproduce_settings *settings, runs *all, bl_message *message) {
    size_t total = count ? count : figures->count;
    for (size_t i = 0; i < total; i++) {
        const bl_figure *figure =
            count ? bl_registry_find(figures, names[i]) : bl_registry_at(figures, i);
        bl_status status = bl_run_figure(figure, settings, i, total, &all->run[i], message);
        if (status != BL_OK)
            return status;
        all->count = i + 1;
    }
    return BL_OK;
}

static void free_runs(runs *all) {
    for (size_t i = 0; all && i < all->count; i++)
        bl_run_free(all->run[i]);
    free(all);
}

static void sum_up(const runs *all, bl_reproduction *result) {
    for (size_t i = 0; i < all->count; i++) {
        const bl_figure_result *figure = bl_run_look(all->run[i]).result;
        result->figures[i] = *figure;
        result->seconds += figure->seconds;
        for (int v = 0; v <= BL_NOT_RUN; v++)
            result->outcomes[v] += figure->outcomes[v];
        for (size_t c = 0; c < figure->claim_count; c++)
            if (bl_claim_is_ours(&figure->claims[c]))
                result->verdict = bl_verdict_worse(result->verdict, figure->claims[c].verdict);
    }
    result->count = all->count;
}

static bl_status write_page(const runs *all, const bl_reproduce_settings *settings,
                            bl_reproduction *result, bl_message *message) {
    bl_run_record *records = calloc(all->count + 1, sizeof *records);
    if (!records || asprintf(&result->page, "%s/index.html", settings->folder) < 0) {
        free(records);
        result->page = NULL;
        return bl_report(message, BL_DEVICE, "out of memory");
    }
    for (size_t i = 0; i < all->count; i++)
        records[i] = bl_run_look(all->run[i]);
    bl_status status = bl_page_write(result->page, records, all->count, settings, message);
    free(records);
    return status;
}

bl_status bl_reproduce(const char *const *names, size_t count,
                       const bl_reproduce_settings *settings, bl_reproduction *result,
                       bl_message *message) {
    *result = (bl_reproduction){.verdict = BL_VERDICT_PASS};
    const bl_registry figures = registry_of(settings);
    bl_status status = check(&figures, names, count, settings, message);
    if (status != BL_OK)
        return status;
    size_t total = count ? count : figures.count;
    runs *all = calloc(1, sizeof *all + total * sizeof *all->run);
    result->figures = calloc(total, sizeof *result->figures);
    if (!all || !result->figures)
        status = bl_report(message, BL_DEVICE, "out of memory");
    result->owned = all;
    if (status == BL_OK)
        status = run_all(&figures, names, count, settings, all, message);
    if (status == BL_OK) {
        sum_up(all, result);
        status = write_page(all, settings, result, message);
    }
    if (status != BL_OK)
        bl_reproduction_free(result);
    return status;
}

void bl_reproduction_free(bl_reproduction *result) {
    free_runs(result->owned);
    free(result->figures);
    free(result->page);
    *result = (bl_reproduction){0};
}
