// SPDX-License-Identifier: MIT
//
// A function in a shared object as a signal: ./lib.so:symbol,seed=N,dims=N.
//
// The object stays loaded until the last signal that refers to it is released. A signal holds what
// the function's own init made for its seed; reseeding makes another. The function never sees a
// coordinate that is not finite or beyond 2^62: those give NaN here.
#include <dlfcn.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/grammar.h"
#include "core/registry.h"
#include "include/bandlimit_plugin.h"
#include "sources/crash.h"
#include "sources/plugin_claims.h"
#include "sources/shared_object.h"
#include "sources/kind.h"

enum { DEFAULT_DIMS = 3 };

// What all signals of one text share.
typedef struct plugin_source {
    void *handle;
    char *path, *symbol;
    char *crash; // what is said if it crashes
    size_t crash_length;
    bandlimit_function *function;
    bandlimit_init *init;
    bandlimit_free *free;
    bandlimit_rows *rows;
    int one_at_a_time;
    atomic_size_t users;
} plugin_source;

// The parameter block.
typedef struct plugin_block {
    uint64_t seed;
    uint32_t dims;
    plugin_source *plugin; // counted
    void *user;            // owned
} plugin_block;

static const bl_parameter plugin_parameters[] = {
    {"seed", BL_SEED, offsetof(plugin_block, seed), "0", "", .help = "given to the function"},
    {"dims", BL_INTEGER, offsetof(plugin_block, dims), "0", "", .minimum = 0, .maximum = BL_AXES,
     .help = "dimensions; 0: what it states, else 3"},
    {0}};

// --- calls into the plugin ---

// Functions that are not thread-safe may share what they write to, within an object and beyond it.
static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;

static void enter(const plugin_source *plugin) {
    if (plugin->one_at_a_time)
        pthread_mutex_lock(&one_at_a_time);
    bl_crash_enter(plugin->crash, plugin->crash_length);
}

static void leave(const plugin_source *plugin) {
    bl_crash_leave();
    if (plugin->one_at_a_time)
        pthread_mutex_unlock(&one_at_a_time);
}

static double call(const plugin_block *block, const double at[BL_AXES]) {
    double place[BL_AXES] = {0};
    if (!bl_source_in_range(at, block->dims))
        return NAN;
    memcpy(place, at, block->dims * sizeof *place);
    return block->plugin->function(place, block->dims, block->seed, block->user);
}

static double plugin_value(const void *parameters, const double at[BL_AXES]) {
    const plugin_block *block = parameters;
    enter(block->plugin);
    double value = call(block, at);
    leave(block->plugin);
    return value;
}

static void plugin_points(const void *parameters, const double *const at[BL_AXES], size_t count,
                          float *out) {
    const plugin_block *block = parameters;
    enter(block->plugin);
    for (size_t i = 0; i < count; i++) {
        const double place[BL_AXES] = {at[0][i], at[1][i], at[2][i], at[3][i]};
        out[i] = (float)call(block, place);
    }
    leave(block->plugin);
}

static void row_by_calls(const plugin_block *block, const double start[BL_AXES],
                         const double step[BL_AXES], size_t count, float *out) {
    for (size_t i = 0; i < count; i++) {
        double place[BL_AXES];
        for (int a = 0; a < BL_AXES; a++)
            place[a] = start[a] + (double)i * step[a];
        out[i] = (float)call(block, place);
    }
}

// Coordinates are monotone along a row, so its ends tell whether all are in range.
static void plugin_row(const void *parameters, const double start[BL_AXES],
                       const double step[BL_AXES], size_t count, float *out) {
    const plugin_block *block = parameters;
    double first[BL_AXES] = {0}, stride[BL_AXES] = {0}, last[BL_AXES] = {0};
    if (count == 0)
        return;
    for (unsigned a = 0; a < block->dims; a++) {
        first[a] = start[a];
        stride[a] = step[a];
        last[a] = start[a] + (double)(count - 1) * step[a];
    }
    int whole = bl_source_in_range(first, block->dims) && bl_source_in_range(last, block->dims) &&
                bl_source_in_range(stride, block->dims);
    enter(block->plugin);
    if (block->plugin->rows && whole)
        block->plugin->rows(first, stride, count, block->dims, block->seed, block->user, out);
    else
        row_by_calls(block, start, step, count, out);
    leave(block->plugin);
}

// --- life ---

static void drop(plugin_source *plugin) {
    if (atomic_fetch_sub(&plugin->users, 1) != 1)
        return;
    if (plugin->handle)
        dlclose(plugin->handle);
    free(plugin->path);
    free(plugin->symbol);
    free(plugin->crash);
    free(plugin);
}

static bl_status plugin_build(void *parameters, bl_opener *open, bl_message *message) {
    (void)open;
    plugin_block *block = parameters;
    plugin_source *plugin = block->plugin;
    int failed = 0;
    block->user = NULL;
    enter(plugin);
    if (plugin->init)
        failed = plugin->init(block->seed, &block->user);
    leave(plugin);
    if (failed)
        return bl_report(message, BL_DEVICE, "'%s': %s_init returned %d for seed %llu, not 0",
                         plugin->path, plugin->symbol, failed, (unsigned long long)block->seed);
    atomic_fetch_add(&plugin->users, 1);
    return BL_OK;
}

static void plugin_release(void *parameters) {
    plugin_block *block = parameters;
    enter(block->plugin);
    if (block->plugin->free)
        block->plugin->free(block->user);
    leave(block->plugin);
    drop(block->plugin);
}

static const bl_signal_functions plugin_functions = {.row = plugin_row,
                                                     .points = plugin_points,
                                                     .value = plugin_value,
                                                     .build = plugin_build,
                                                     .release = plugin_release};

// --- opening ---

static bl_status report_missing(const plugin_source *plugin, bl_message *message) {
    const char **functions = bl_shared_object_functions(plugin->handle);
    bl_message unknown = {""};
    char *where = NULL;
    if (functions && asprintf(&where, " of '%s'", plugin->path) >= 0)
        bl_report_unknown(&(bl_unknown){.what = "function",
                                        .word = plugin->symbol,
                                        .where = where,
                                        .words = functions,
                                        .all = *functions ? "`nm -D` shows all" : NULL},
                          &unknown);
    free(where);
    free(functions);
    return bl_report(message, BL_USAGE,
                     "%.700s; declare it with BANDLIMIT_EXPORT of bandlimit_plugin.h",
                     unknown.text);
}

static bl_status find_companion(const plugin_source *plugin, const char *suffix,
                                bl_any_function **found, bl_message *message) {
    char *name = NULL;
    if (asprintf(&name, "%s%s", plugin->symbol, suffix) < 0)
        return bl_report(message, BL_DEVICE, "out of memory");
    bl_status status = bl_shared_object_find(plugin->handle, plugin->path, name, found, message);
    free(name);
    return status;
}

enum { FUNCTIONS = 5 };
static const char *const suffixes[FUNCTIONS] = {"", "_init", "_free", "_rows", "_claims"};

// A companion has another type than a function of values: calling it as one would crash.
static bl_status check_no_companion(const plugin_source *plugin, bl_message *message) {
    const char *symbol = plugin->symbol;
    size_t length = strlen(symbol);
    bl_status status = BL_OK;
    for (int i = 1; i < FUNCTIONS && status == BL_OK; i++) {
        size_t tail = strlen(suffixes[i]);
        if (length <= tail || strcmp(symbol + length - tail, suffixes[i]) != 0)
            continue;
        char *owner = strndup(symbol, length - tail);
        bl_any_function *found = NULL;
        if (!owner)
            return bl_report(message, BL_DEVICE, "out of memory");
        if (bl_shared_object_find(plugin->handle, plugin->path, owner, &found, NULL) == BL_OK &&
            found)
            status = bl_report(message, BL_USAGE,
                               "'%s' in '%s' is a companion of '%s' and no function of values; "
                               "name %s:%s",
                               symbol, plugin->path, owner, plugin->path, owner);
        free(owner);
    }
    return status;
}

static bl_status find_functions(plugin_source *plugin, bandlimit_claim **claim,
                                bl_message *message) {
    bl_any_function *found[FUNCTIONS] = {NULL};
    bl_status status = check_no_companion(plugin, message);
    for (int i = 0; i < FUNCTIONS && status == BL_OK; i++)
        status = find_companion(plugin, suffixes[i], &found[i], message);
    if (status == BL_OK && !found[0])
        status = report_missing(plugin, message);
    plugin->function = (bandlimit_function *)found[0];
    plugin->init = (bandlimit_init *)found[1];
    plugin->free = (bandlimit_free *)found[2];
    plugin->rows = (bandlimit_rows *)found[3];
    *claim = (bandlimit_claim *)found[4];
    return status;
}

static bl_status read_claims(const plugin_source *plugin, bandlimit_claim *claim,
                             struct bandlimit_claims *claims, bl_message *message) {
    enter(plugin);
    int fits = bl_plugin_claims_ask(claim, claims);
    leave(plugin);
    if (!fits)
        return bl_report(message, BL_DEVICE,
                         "'%s': %s_claims wrote a struct of another size than the %zu bytes known "
                         "here; build it with the bandlimit_plugin.h of this version",
                         plugin->path, plugin->symbol, sizeof *claims);
    const char *fault = bl_plugin_claims_fault(claims);
    if (fault)
        return bl_report(message, BL_USAGE, "'%s': %s_claims: %s", plugin->path, plugin->symbol,
                         fault);
    return BL_OK;
}

static bl_status settle_dims(const plugin_source *plugin, uint32_t stated, uint32_t *dims,
                             bl_message *message) {
    if (*dims && stated && *dims != stated)
        return bl_report(message, BL_USAGE,
                         "'%s': %s states %u dimension%s, and dims=%u; leave "
                         "dims out",
                         plugin->path, plugin->symbol, stated, stated == 1 ? "" : "s", *dims);
    if (!*dims)
        *dims = stated ? stated : DEFAULT_DIMS;
    return BL_OK;
}

// The text with the settings that are not the default.
static char *canonical_text(const plugin_source *plugin, uint32_t named_dims, uint64_t seed) {
    char dims_text[24] = "", seed_text[40] = "", *text = NULL;
    if (named_dims)
        snprintf(dims_text, sizeof dims_text, ",dims=%u", named_dims);
    if (seed)
        snprintf(seed_text, sizeof seed_text, ",seed=%llu", (unsigned long long)seed);
    if (asprintf(&text, "%s:%s%s%s", plugin->path, plugin->symbol, dims_text, seed_text) < 0)
        return NULL;
    return text;
}

static bl_status make_signal(plugin_source *plugin, plugin_block *block, bl_signal **signal,
                             bl_message *message) {
    struct bandlimit_claims claims;
    bandlimit_claim *claim = NULL;
    uint32_t named_dims = block->dims;
    bl_status status = find_functions(plugin, &claim, message);
    if (status == BL_OK)
        status = read_claims(plugin, claim, &claims, message);
    if (status == BL_OK)
        status = settle_dims(plugin, claims.dims, &block->dims, message);
    if (status != BL_OK)
        return status;
    plugin->one_at_a_time = (claims.flags & BANDLIMIT_NOT_THREAD_SAFE) != 0;
    char *text = canonical_text(plugin, named_dims, block->seed);
    bl_signal *made = text ? bl_signal_new(&plugin_functions, block, sizeof *block, text) : NULL;
    free(text);
    if (!made)
        return bl_report(message, BL_DEVICE, "out of memory opening '%s'", plugin->path);
    made->name = "plugin";
    made->seed_offset = offsetof(plugin_block, seed);
    made->dimensions = block->dims;
    made->is_serial = plugin->one_at_a_time;
    bl_plugin_claims_state(&claims, &made->facts);
    status = bl_signal_build(made, message);
    if (status == BL_OK)
        *signal = made;
    return status;
}

static bl_status open_text(const char *text, bl_signal **signal, bl_message *message) {
    const char *colon = strchr(text, ':');
    size_t length = colon ? strcspn(colon + 1, ",") : 0;
    if (length == 0)
        return bl_report(message, BL_USAGE,
                         "'%s' names no function; a plugin reads ./lib.so:function,key=value",
                         text);
    const char *settings = colon[1 + length] ? colon + length + 2 : NULL;
    plugin_block block = {0};
    bl_status status = bl_source_settings(plugin_parameters, text, settings,
                                          settings ? strlen(settings) : 0, &block, message);
    if (status != BL_OK)
        return status;
    plugin_source *opened = calloc(1, sizeof *opened);
    if (!opened)
        return bl_report(message, BL_DEVICE, "out of memory opening '%s'", text);
    atomic_init(&opened->users, 1);
    opened->path = strndup(text, (size_t)(colon - text));
    opened->symbol = strndup(colon + 1, length);
    block.plugin = opened;
    int said = asprintf(&opened->crash, "bandlimit: crashed inside %.*s\n",
                        (int)(colon - text) + 1 + (int)length, text);
    opened->crash_length = said < 0 ? 0 : (size_t)said;
    if (said < 0)
        opened->crash = NULL;
    if (!opened->path || !opened->symbol || !opened->crash)
        status = bl_report(message, BL_DEVICE, "out of memory opening '%s'", text);
    bl_crash_watch();
    if (status == BL_OK) {
        enter(opened); // constructors run
        status = bl_shared_object_open(opened->path, &opened->handle, message);
        leave(opened);
    }
    if (status == BL_OK)
        status = make_signal(opened, &block, signal, message);
    drop(opened); // the signal has its own share
    return status;
}

static int takes(const char *text) {
    return !bl_source_is_whole_file(text) && bl_source_is_shared_object(text, strcspn(text, ":"));
}

BL_SOURCE_DESCRIPTOR(plugin) = {
    .name = "function",
    .title = "a function of a shared object",
    .summary = "A noise of the user's own, as bandlimit_plugin.h declares it, with its claims.",
    .paper = "bandlimit",
    .kind = "function",
    .form = "./FILE.so:FUNCTION,KEY=VALUE",
    .example = "./mine.so:noise,seed=3",
    .parameters = plugin_parameters,
    .takes = takes,
    .open = open_text,
    .seed_place = strlen};
