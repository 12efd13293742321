// SPDX-License-Identifier: MIT
//
// A program that answers points through a pair of pipes, as a signal:
//
//   cmd:PROGRAM WORDS              cmd,seed=N,dims=N,timeout=SECONDS:PROGRAM WORDS
//
// A question is the count n and the number of dimensions d, two little-endian uint64, then n d
// little-endian doubles, point by point. The answer is n little-endian doubles. n is at most 4096.
// At the end of its input the program ends.
//
// Threads take children from a pool, which grows to the number of processors; each answers one
// question at a time. A point must have the same value no matter which points came before it; then
// nothing depends on the threads. Where {seed} stands in the words, the seed is put, and the signal
// can be reseeded: with children of its own.
//
// The functions of a signal have no place for an error. After the first one every value is NaN, no
// child is asked again, and `complaint` tells what happened; copies share it.
#include <endian.h>
#include <math.h>
#include <pthread.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/grammar.h"
#include "sources/child.h"
#include "sources/command.h"
#include "sources/kind.h"

enum { BATCH = 4096, DEFAULT_DIMS = 3, MOST_CHILDREN = 64 };

// What all signals of one text share.
typedef struct program_source {
    char *text;
    char **words;
    double timeout;
    pthread_mutex_t lock; // of what follows
    bl_status fault;
    bl_message complaint;
    size_t users;
} program_source;

typedef struct child_worker {
    bl_child *child;
    double *places, *values; // of one batch; the head of a question stands before the places
    struct child_worker *next;
} child_worker;

// The children of one seed.
typedef struct child_pool {
    pthread_mutex_t lock;
    pthread_cond_t returned;
    child_worker *idle;
    size_t running, most;
} child_pool;

// The parameter block.
typedef struct program_block {
    uint64_t seed;
    double timeout;
    uint32_t dims;
    program_source *program; // counted
    child_pool *pool;        // owned
} program_block;

static const bl_parameter program_parameters[] = {
    {"seed", BL_SEED, offsetof(program_block, seed), "0", "",
     .help = "put where {seed} stands in the words"},
    {"dims", BL_INTEGER, offsetof(program_block, dims), "3", "", .minimum = 1, .maximum = BL_AXES,
     .help = "dimensions"},
    {"timeout", BL_REAL, offsetof(program_block, timeout), "10", "s", .minimum = 0.001,
     .maximum = 1e6, .help = "in which the program must move a byte"},
    {0}};

// --- complaints ---

static bl_status fault_of(program_source *program, bl_message *message) {
    pthread_mutex_lock(&program->lock);
    bl_status fault = program->fault;
    if (message && fault != BL_OK)
        *message = program->complaint;
    pthread_mutex_unlock(&program->lock);
    return fault;
}

// Keeps the first complaint; a failure goes before a value that is no number.
static void complain(program_source *program, bl_status fault, const bl_message *reason) {
    pthread_mutex_lock(&program->lock);
    if (program->fault == BL_OK || (program->fault != BL_DEVICE && fault == BL_DEVICE)) {
        program->fault = fault;
        bl_report(&program->complaint, fault, "'%.240s' %.760s", program->text, reason->text);
    }
    pthread_mutex_unlock(&program->lock);
}

static bl_status program_complaint(const void *parameters, bl_message *message) {
    return fault_of(((const program_block *)parameters)->program, message);
}

// --- the pool ---

static void end_worker(child_worker *worker, program_source *program, int idle) {
    bl_message message;
    if (worker->child && bl_child_end(worker->child, idle, &message) != BL_OK)
        complain(program, BL_DEVICE, &message);
    free(worker->places);
    free(worker->values);
    free(worker);
}

static child_worker *start_worker(const program_block *block, bl_message *message) {
    child_worker *made = calloc(1, sizeof *made);
    char **words = bl_command_with_seed(block->program->words, block->seed);
    bl_status status = BL_OK;
    if (made) {
        made->places = malloc((2 + (size_t)BATCH * BL_AXES) * sizeof *made->places);
        made->values = malloc(BATCH * sizeof *made->values + BL_CHILD_SLACK);
    }
    if (!made || !words || !made->places || !made->values)
        status = bl_report(message, BL_DEVICE, "could not be started: out of memory");
    if (status == BL_OK)
        status = bl_child_start(words, &made->child, message);
    bl_command_free(words);
    if (status != BL_OK && made)
        end_worker(made, block->program, 0);
    return status == BL_OK ? made : NULL;
}

// A worker that is free, or a new one, or the next that comes back. NULL after a failure.
static child_worker *take_worker(const program_block *block) {
    child_pool *pool = block->pool;
    child_worker *taken = NULL;
    int starts = 0;
    pthread_mutex_lock(&pool->lock);
    while (!pool->idle && pool->running == pool->most)
        pthread_cond_wait(&pool->returned, &pool->lock);
    if (fault_of(block->program, NULL) == BL_DEVICE) { // while waiting
        pthread_cond_signal(&pool->returned);
        pthread_mutex_unlock(&pool->lock);
        return NULL;
    }
    if (pool->idle) {
        taken = pool->idle;
        pool->idle = taken->next;
    } else {
        pool->running++;
        starts = 1;
    }
    pthread_mutex_unlock(&pool->lock);
    if (!starts)
        return taken;
    bl_message message;
    taken = start_worker(block, &message);
    if (!taken) {
        complain(block->program, BL_DEVICE, &message);
        pthread_mutex_lock(&pool->lock);
        pool->running--;
        pthread_cond_signal(&pool->returned);
        pthread_mutex_unlock(&pool->lock);
    }
    return taken;
}

static void give_back(const program_block *block, child_worker *worker, int usable) {
    child_pool *pool = block->pool;
    if (!usable)
        end_worker(worker, block->program, 0);
    pthread_mutex_lock(&pool->lock);
    if (usable) {
        worker->next = pool->idle;
        pool->idle = worker;
    } else {
        pool->running--;
    }
    pthread_cond_signal(&pool->returned);
    pthread_mutex_unlock(&pool->lock);
}

// --- values ---

static double swapped(double value) { // between the machine's order of bytes and little-endian
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    bits = htole64(bits);
    memcpy(&value, &bits, sizeof bits);
    return value;
}

// The place is known to the worker alone: it is told with what the child said.
static void complain_of_value(const program_block *block, child_worker *worker, size_t index) {
    bl_message message;
    char place[160] = "", errors[480];
    size_t used = 0;
    for (unsigned a = 0; a < block->dims; a++)
        used += (size_t)snprintf(place + used, sizeof place - used, "%s%.9g", a ? ", " : "",
                                 swapped(worker->places[2 + index * block->dims + a]));
    bl_child_errors(worker->child, errors, sizeof errors);
    bl_report(&message, BL_MISMATCH, "answered %g at (%s)%s%s", worker->values[index], place,
              errors[0] ? "; its standard error ends with: " : "", errors);
    complain(block->program, BL_MISMATCH, &message);
}

// Asks for the places that the worker holds and leaves the values there.
static int ask(const program_block *block, child_worker *worker, size_t count) {
    const uint64_t head[2] = {htole64((uint64_t)count), htole64((uint64_t)block->dims)};
    const size_t each = sizeof *worker->places;
    bl_message message;
    memcpy(worker->places, head, sizeof head);
    bl_status status =
        bl_child_ask(worker->child, worker->places, sizeof head + count * block->dims * each,
                     worker->values, count * each, block->program->timeout, &message);
    if (status != BL_OK) {
        complain(block->program, BL_DEVICE, &message);
        return 0;
    }
    int told = 0;
    for (size_t i = 0; i < count; i++) {
        worker->values[i] = swapped(worker->values[i]);
        if (!isfinite(worker->values[i]) && !told) {
            complain_of_value(block, worker, i);
            told = 1;
        }
    }
    return 1;
}

// Where the i-th of a run of points stands.
typedef void place_of(const void *run, size_t index, double at[BL_AXES]);

// At most BATCH points: those in range are asked for, the others are NaN. False after a failure.
static int answer_batch(const program_block *block, child_worker *worker, place_of *place,
                        const void *run, size_t first, size_t count, double *out) {
    unsigned char asked[BATCH];
    size_t wanted = 0;
    for (size_t i = 0; i < count; i++) {
        double at[BL_AXES];
        place(run, first + i, at);
        asked[i] = (unsigned char)bl_source_in_range(at, block->dims);
        for (unsigned a = 0; a < block->dims && asked[i]; a++)
            worker->places[2 + wanted * block->dims + a] = swapped(at[a]);
        wanted += asked[i];
    }
    int good = wanted == 0 || ask(block, worker, wanted);
    for (size_t i = 0, next = 0; i < count; i++)
        out[i] = good && asked[i] ? worker->values[next++] : NAN;
    return good;
}

static void answer(const program_block *block, place_of *place, const void *run, size_t count,
                   float *out) {
    for (size_t first = 0; first < count; first += BATCH) {
        double values[BATCH];
        size_t batch = count - first < BATCH ? count - first : BATCH;
        child_worker *worker = take_worker(block);
        for (size_t i = 0; !worker && i < batch; i++)
            values[i] = NAN;
        if (worker)
            give_back(block, worker, answer_batch(block, worker, place, run, first, batch, values));
        for (size_t i = 0; i < batch; i++)
            out[first + i] = (float)values[i];
    }
}

typedef struct row_run {
    const double *start, *step;
} row_run;

static void place_in_row(const void *run, size_t index, double at[BL_AXES]) {
    const row_run *row = run;
    for (int a = 0; a < BL_AXES; a++)
        at[a] = row->start[a] + (double)index * row->step[a];
}

static void program_row(const void *parameters, const double start[BL_AXES],
                        const double step[BL_AXES], size_t count, float *out) {
    const row_run row = {start, step};
    answer(parameters, place_in_row, &row, count, out);
}

static void place_of_point(const void *run, size_t index, double at[BL_AXES]) {
    const double *const *places = run;
    for (int a = 0; a < BL_AXES; a++)
        at[a] = places[a][index];
}

static void program_points(const void *parameters, const double *const at[BL_AXES], size_t count,
                           float *out) {
    answer(parameters, place_of_point, at, count, out);
}

static double program_value(const void *parameters, const double at[BL_AXES]) {
    static const double step[BL_AXES] = {0};
    const program_block *block = parameters;
    const row_run row = {at, step};
    double value = NAN;
    child_worker *worker = take_worker(block);
    if (worker)
        give_back(block, worker, answer_batch(block, worker, place_in_row, &row, 0, 1, &value));
    return value;
}

// --- life ---

static void drop(program_source *program) {
    pthread_mutex_lock(&program->lock);
    size_t left = --program->users;
    pthread_mutex_unlock(&program->lock);
    if (left > 0)
        return;
    pthread_mutex_destroy(&program->lock);
    bl_command_free(program->words);
    free(program->text);
    free(program);
}

static bl_status program_build(void *parameters, bl_opener *open, bl_message *message) {
    (void)open;
    program_block *block = parameters;
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    block->pool = calloc(1, sizeof *block->pool);
    if (!block->pool)
        return bl_report(message, BL_DEVICE, "out of memory");
    pthread_mutex_init(&block->pool->lock, NULL);
    pthread_cond_init(&block->pool->returned, NULL);
    block->pool->most = processors < 1               ? 1
                        : processors > MOST_CHILDREN ? MOST_CHILDREN
                                                     : (size_t)processors;
    pthread_mutex_lock(&block->program->lock);
    block->program->users++;
    pthread_mutex_unlock(&block->program->lock);
    return BL_OK;
}

static void program_release(void *parameters) {
    program_block *block = parameters;
    for (child_worker *one = block->pool->idle, *next; one; one = next) {
        next = one->next;
        end_worker(one, block->program, 1);
    }
    pthread_mutex_destroy(&block->pool->lock);
    pthread_cond_destroy(&block->pool->returned);
    free(block->pool);
    drop(block->program);
}

static const bl_signal_functions program_functions = {.row = program_row,
                                                      .points = program_points,
                                                      .value = program_value,
                                                      .build = program_build,
                                                      .release = program_release,
                                                      .complaint = program_complaint};

// --- opening ---

static bl_status make_signal(const char *text, const program_block *block, bl_signal **signal,
                             bl_message *message) {
    bl_signal *made = bl_signal_new(&program_functions, block, sizeof *block, text);
    if (!made)
        return bl_report(message, BL_DEVICE, "out of memory opening '%s'", text);
    made->name = "program";
    made->dimensions = block->dims;
    made->is_serial = 1; // each child answers one question at a time
    if (bl_command_has_seed(block->program->words))
        made->seed_offset = offsetof(program_block, seed);
    bl_status status = bl_signal_build(made, message);
    if (status != BL_OK)
        return status;
    // A first question finds a program that is missing or ends at once.
    (void)bl_signal_value(made, (const double[BL_AXES]){0});
    status = fault_of(block->program, message);
    if (status == BL_DEVICE) {
        bl_signal_free(made);
        return status;
    }
    block->program->fault = BL_OK; // nobody has asked for the value there
    *signal = made;
    return BL_OK;
}

static bl_status read_command(const char *text, const char *command, const program_block *block,
                              int seed_is_named, program_source *program, bl_message *message) {
    program->text = strdup(text);
    program->timeout = block->timeout;
    if (!program->text)
        return bl_report(message, BL_DEVICE, "out of memory opening '%s'", text);
    bl_status status = bl_command_read(text, command, &program->words, message);
    if (status == BL_OK && seed_is_named && !bl_command_has_seed(program->words))
        status = bl_report(message, BL_USAGE,
                           "'%s': seed= goes nowhere; let {seed} stand where the program takes it",
                           text);
    return status;
}

static bl_status open_text(const char *text, bl_signal **signal, bl_message *message) {
    size_t head = strcspn(text, ":"); // cmd, or cmd,key=value
    const char *settings = text[3] == ',' ? text + 4 : NULL;
    program_block block = {0};
    bl_status status =
        bl_source_settings(program_parameters, text, settings,
                           settings ? head - (size_t)(settings - text) : 0, &block, message);
    if (status != BL_OK)
        return status;
    program_source *opened = calloc(1, sizeof *opened);
    if (!opened)
        return bl_report(message, BL_DEVICE, "out of memory opening '%s'", text);
    pthread_mutex_init(&opened->lock, NULL);
    opened->users = 1;
    block.program = opened;
    const char *named = settings ? strstr(settings, "seed=") : NULL;
    status =
        read_command(text, text + head + 1, &block, named && named < text + head, opened, message);
    if (status == BL_OK)
        status = make_signal(text, &block, signal, message);
    drop(opened); // the signal has its own share
    return status;
}

static int takes(const char *text) {
    return strncmp(text, "cmd:", 4) == 0 || (strncmp(text, "cmd,", 4) == 0 && strchr(text, ':'));
}

static size_t seed_place(const char *text) {
    size_t head = strcspn(text, ":");
    return strstr(text + head, "{seed}") ? head : 0;
}

BL_SOURCE_DESCRIPTOR(program) = {
    .name = "program",
    .title = "a program",
    .summary = "A program that reads points and answers with values, in doubles on its pipes.",
    .paper = "bandlimit",
    .kind = "program",
    .form = "cmd,KEY=VALUE:PROGRAM WORDS",
    .example = "cmd:./mine.py --seed {seed}",
    .parameters = program_parameters,
    .takes = takes,
    .open = open_text,
    .seed_place = seed_place,
    .seed_hint = ", or let {seed} stand where the program takes it"};
