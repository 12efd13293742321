// SPDX-License-Identifier: MIT
//
// Runs the built program, whose path is in BL_PROGRAM, and keeps what it says.
#ifndef BL_TESTS_PROGRAM_H
#define BL_TESTS_PROGRAM_H

#include <stddef.h>

typedef struct bl_ran {
    int status;      // exit status; 128 + number if a signal ended it
    char *out, *err; // all of it, ended by a zero byte
    size_t out_size;
} bl_ran;

typedef struct bl_streams {
    const char *input;  // text for stdin; NULL: /dev/null
    const char *output; // a path that stdout is opened at; NULL: kept in bl_ran.out
    int close_output;   // stdout is closed
    size_t most_bytes;  // no file can be longer: writing more fails half way, as on a full disk
    int as_nobody;      // without root's powers, if the test has them (see bl_can_be_nobody)
} bl_streams;

enum { BL_NOBODY = 65534 }; // the user and group without rights

// Whether a child may become nobody, or need not: a container can forbid it.
int bl_can_be_nobody(void);

// Runs with these words, ended by NULL; fails the test if the program cannot be started.
bl_ran bl_run_words(const bl_streams *streams, const char *const *words);
void bl_ran_free(bl_ran *ran);

#define bl_run_program(...) bl_run_words(NULL, (const char *const[]){__VA_ARGS__, NULL})

#endif
