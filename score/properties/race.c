// SPDX-License-Identifier: MIT
#include "score/properties/race.h"

#include <math.h>
#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "core/clock.h"
#include "core/random.h"

enum { PIECES = 8, PIECE = 12, PLACES = PIECES * PIECE, LEAST_THREADS = 4, MOST_THREADS = 32 };
enum { POINTS, ROW, VALUES, KINDS };
static const char *const kinds[KINDS] = {"points", "a row", "a value"};

// Pieces of a row and scattered pieces: piece p is asked for as its kind, p modulo KINDS.
typedef struct asker {
    struct race *race;
    const bl_signal *signal;
    double at[BL_AXES][PLACES], step[PIECES][BL_AXES];
    double first[PLACES], alone[PLACES], got[PLACES];
    bl_race found;
} asker;

typedef struct race {
    size_t count;
    asker *askers;
    atomic_size_t arrived; // at the gate; the last one opens it
    atomic_int is_closed, is_over;
} race;

static double seconds_of_processors(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

// Multiples of 2^-10, so that places in a row are exact.
static double coordinate(bl_random *random, double reach) {
    return floor(reach * 0x1p10 * (2 * bl_random_unit(random) - 1)) * 0x1p-10;
}

static void choose_places(asker *a, bl_random *random) {
    for (int p = 0; p < PIECES; p++) {
        double start[BL_AXES];
        for (int axis = 0; axis < BL_AXES; axis++) {
            start[axis] = coordinate(random, 512);
            a->step[p][axis] = coordinate(random, 2);
        }
        for (int i = 0; i < PIECE; i++)
            for (int axis = 0; axis < BL_AXES; axis++)
                a->at[axis][p * PIECE + i] =
                    p % KINDS == ROW ? start[axis] + i * a->step[p][axis] : coordinate(random, 512);
    }
}

static void ask_piece(const asker *a, int p, double *out) {
    const double *const at[BL_AXES] = {a->at[0] + p * PIECE, a->at[1] + p * PIECE,
                                       a->at[2] + p * PIECE, a->at[3] + p * PIECE};
    float value[PIECE];
    if (p % KINDS == POINTS) {
        bl_signal_points(a->signal, at, PIECE, value);
    } else if (p % KINDS == ROW) {
        const double start[BL_AXES] = {at[0][0], at[1][0], at[2][0], at[3][0]};
        bl_signal_row(a->signal, start, a->step[p], PIECE, value);
    }
    for (int i = 0; i < PIECE; i++)
        out[p * PIECE + i] = p % KINDS == VALUES
                                 ? bl_signal_value(a->signal, (const double[]){at[0][i], at[1][i],
                                                                               at[2][i], at[3][i]})
                                 : (double)value[i];
}

static void ask_all(const asker *a, double *out) {
    for (int p = 0; p < PIECES; p++)
        ask_piece(a, p, out);
}

// Keeps the first difference; false if there is one.
static int hold(asker *a, const double *got) {
    for (int i = 0; i < PLACES; i++) {
        if (memcmp(&a->alone[i], &got[i], sizeof *got) == 0 ||
            (isnan(a->alone[i]) && isnan(got[i])))
            continue;
        a->found = (bl_race){.is_found = 1,
                             .what = kinds[i / PIECE % KINDS],
                             .at = {a->at[0][i], a->at[1][i], a->at[2][i], a->at[3][i]},
                             .alone = a->alone[i],
                             .together = got[i]};
        return 0;
    }
    return 1;
}

// Threads start together, so they keep their processors while they wait, for most of the time;
// false: there are too few of them, and nothing is asked.
static int wait_for_all(race *r) {
    atomic_fetch_add(&r->arrived, 1);
    for (int turn = 1; atomic_load(&r->arrived) < r->count && !atomic_load(&r->is_closed); turn++)
        if (turn % 65536 == 0)
            sched_yield();
    return !atomic_load(&r->is_closed);
}

static void *ask_first(void *user) {
    asker *a = user;
    if (wait_for_all(a->race))
        ask_all(a, a->first);
    return NULL;
}

static void *ask_again(void *user) {
    asker *a = user;
    if (!wait_for_all(a->race))
        return NULL;
    do {
        ask_all(a, a->got);
        if (!hold(a, a->got))
            atomic_store(&a->race->is_over, 1);
    } while (!atomic_load(&a->race->is_over));
    return NULL;
}

// Runs `ask` in all threads, and tells them to end when the time is spent.
static int run_threads(race *r, void *(*ask)(void *), double seconds) {
    pthread_t threads[MOST_THREADS];
    size_t started = 0;
    double wall = bl_clock_seconds(), spent = seconds_of_processors();
    atomic_store(&r->arrived, 0);
    while (started < r->count &&
           pthread_create(&threads[started], NULL, ask, &r->askers[started]) == 0)
        started++;
    atomic_store(&r->is_closed, started < r->count);
    while (started == r->count && seconds > 0 && !atomic_load(&r->is_over)) {
        nanosleep(&(struct timespec){.tv_nsec = 20000}, NULL);
        if (seconds_of_processors() - spent > seconds || bl_clock_seconds() - wall > 4 * seconds)
            atomic_store(&r->is_over, 1);
    }
    for (size_t i = 0; i < started; i++)
        pthread_join(threads[i], NULL);
    return started == r->count;
}

// Whether the answers are the same when they are asked for alone once more.
static int is_one_answer(asker *a) {
    ask_all(a, a->got);
    return memcmp(a->alone, a->got, sizeof a->alone) == 0;
}

static int run_race(race *r, double seconds, bl_race *found) {
    if (!run_threads(r, ask_first, 0))
        return 0;
    for (size_t i = 0; i < r->count; i++) {
        asker *a = &r->askers[i];
        ask_all(a, a->alone);
        if (!hold(a, a->first))
            atomic_store(&r->is_over, 1);
    }
    if (!atomic_load(&r->is_over) && !run_threads(r, ask_again, seconds))
        return 0;
    for (size_t i = 0; i < r->count && !found->is_found; i++)
        if (r->askers[i].found.is_found && is_one_answer(&r->askers[i]))
            *found = r->askers[i].found;
    return 1;
}

// Twice as many as there are processors, so that they are set aside at any place.
static size_t count_threads(void) {
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    size_t count = processors > 0 ? 2 * (size_t)processors : LEAST_THREADS;
    return count < LEAST_THREADS ? LEAST_THREADS : count > MOST_THREADS ? MOST_THREADS : count;
}

int bl_race_find(const bl_signal *signal, uint64_t seed, double seconds, bl_race *found) {
    race r = {.count = count_threads()};
    bl_random random = bl_random_seed(seed, 1);
    // Of 16 bits: one that is added to a coordinate leaves digits to it.
    bl_signal *other = bl_signal_reseed(signal, bl_random_bits(&random) & 0xffff);
    *found = (bl_race){.is_found = 0};
    r.askers = calloc(r.count, sizeof *r.askers);
    for (size_t i = 0; r.askers && i < r.count; i++) {
        r.askers[i].race = &r;
        r.askers[i].signal = i % 2 && other ? other : signal;
        choose_places(&r.askers[i], &random);
    }
    int good = r.askers && run_race(&r, seconds, found);
    free(r.askers);
    bl_signal_free(other);
    return good;
}
