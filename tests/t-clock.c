// SPDX-License-Identifier: MIT
//
// The clock: any number of works, and the order of what it says of their times. No absolute time is
// asserted.
#include "tests/test.h"

#include "core/clock.h"

enum { WORKS = 9, ROUNDS = 7 };

typedef struct counter {
    size_t runs, prepared;
} counter;

static size_t last; // the work that ran last
static size_t turns;

static void run(void *user) {
    counter *c = user;
    c->runs++;
}

static void prepare(void *user) {
    counter *c = user;
    c->prepared++;
}

static counter counters[WORKS];

// Counts how often the turn passes from one work to another.
static void run_and_note(void *user) {
    size_t index = (size_t)((counter *)user - counters);
    turns += index != last;
    last = index;
    run(user);
}

static void test_times_of_many_works_are_taken_by_turns(void **state) {
    (void)state;
    bl_work works[WORKS];
    bl_time times[WORKS];
    for (size_t w = 0; w < WORKS; w++) {
        counters[w] = (counter){0, 0};
        works[w] = (bl_work){run_and_note, &counters[w], w % 2 ? prepare : NULL};
    }
    last = WORKS;
    bl_time_by_turns(works, WORKS, ROUNDS, 1e-5, times);
    assert_int_equal(turns, WORKS * (1 + ROUNDS)); // the first round finds how many runs fill one
    for (size_t w = 0; w < WORKS; w++) {
        const bl_time *t = &times[w];
        assert_true(t->minimum > 0);
        assert_true(t->minimum <= t->lower && t->lower <= t->median);
        assert_true(t->median <= t->upper && t->upper <= t->maximum);
        assert_int_equal(counters[w].prepared, w % 2 ? counters[w].runs : 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_times_of_many_works_are_taken_by_turns),
    };
    return bl_run_tests(tests);
}
