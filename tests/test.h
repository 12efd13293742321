// SPDX-License-Identifier: MIT
//
// What every test program shares: cmocka with its required headers, the filter that
// `make check T=word` sets, and the scale of repetitions that `make check SCALE=10` sets.
#ifndef BL_TESTS_TEST_H
#define BL_TESTS_TEST_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A count of repetitions times SCALE, at least `least`.
static inline size_t bl_test_scaled(size_t count, size_t least) {
    const char *text = getenv("SCALE");
    double scale = text && *text ? atof(text) : 1;
    double scaled = (double)count * scale;
    return scaled > (double)least ? (size_t)scaled : least;
}

// Whether a walk takes this one of all that it could; what it leaves out is said at the end.
static size_t bl_test_taken, bl_test_left_out;

static inline int bl_test_walk(int takes) {
    *(takes ? &bl_test_taken : &bl_test_left_out) += 1;
    return takes;
}

__attribute__((destructor)) static void bl_test_say_walk(void) {
    if (bl_test_left_out)
        printf("# SCALE below 1: %zu of %zu settings are walked\n", bl_test_taken,
               bl_test_taken + bl_test_left_out);
}

// Whether a walk over all settings takes this one: with SCALE below 1 every sixteenth, and the
// defaults of each noise. For tests whose settings do not share random numbers.
static inline int bl_test_takes(size_t index, const char *text) {
    return bl_test_walk(bl_test_scaled(8, 0) >= 8 || index % 16 == 0 || !strchr(text, ':'));
}

// A stream of random numbers for a text: it stays when another noise is registered.
static inline uint64_t bl_test_stream(const char *text) {
    uint64_t stream = 0;
    for (const char *c = text; *c; c++)
        stream = 31 * stream + (unsigned char)*c;
    return stream;
}

// |actual - expected| <= tolerance, with the numbers in the message; NaN fails.
#define assert_near(actual, expected, tolerance)                                                   \
    do {                                                                                           \
        double actual_ = (actual), expected_ = (expected), tolerance_ = (tolerance);               \
        if (!(fabs(actual_ - expected_) <= tolerance_))                                            \
            fail_msg("%s = %.17g, expected %.17g +- %.3g", #actual, actual_, expected_,            \
                     tolerance_);                                                                  \
    } while (0)

#define assert_less(actual, limit)                                                                 \
    do {                                                                                           \
        double actual_ = (actual), limit_ = (limit);                                               \
        if (!(actual_ < limit_))                                                                   \
            fail_msg("%s = %.17g, expected below %.17g", #actual, actual_, limit_);                \
    } while (0)

static inline void bl_set_filter(void) {
    const char *filter = getenv("BL_TEST_FILTER");
    if (filter && *filter)
        cmocka_set_test_filter(filter);
}

// Runs an array of tests; what main returns.
#define bl_run_tests(tests) (bl_set_filter(), cmocka_run_group_tests(tests, NULL, NULL))

#endif
