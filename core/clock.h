// SPDX-License-Identifier: MIT
//
// A fair clock: two pieces of work timed by turns, each repeated until the clock can be trusted.
#ifndef BL_CORE_CLOCK_H
#define BL_CORE_CLOCK_H

#include <stddef.h>

// A piece of work; `run` does all of it once. With `prepare`, that is called before every run and
// not timed.
typedef struct bl_work {
    void (*run)(void *user);
    void *user;
    void (*prepare)(void *user);
} bl_work;

// Seconds of a clock that only moves forward, from some moment on; and the smallest step that it is
// seen to make, in seconds.
double bl_clock_seconds(void);
double bl_clock_tick(void);

typedef struct bl_time {
    double minimum, median; // nanoseconds a run
    double maximum;         // with the minimum: what was seen
    double lower, upper;    // the quarters: half of all turns lie between
    double worst_block;     // the largest of the minima of 6 blocks of consecutive turns, or of all
                            // turns where there are fewer: how far a minimum can be repeated
} bl_time;

// Times `count` pieces by turns, A B A B ..., `rounds` (at most 101) turns each; a turn repeats its
// piece for at least `turn_seconds` and a thousand ticks of the clock. Each piece runs once before,
// unmeasured. Single-threaded itself. Without memory, all times are NaN.
void bl_time_by_turns(const bl_work *works, size_t count, int rounds, double turn_seconds,
                      bl_time *times);

// What the kernel calls the processor; "unknown" where it does not say.
void bl_processor_name(char *name, size_t size);

#endif
