// SPDX-License-Identifier: MIT
//
// Threads that wait quietly. Between two loops libgomp's threads spin, which on a machine that does
// something else triples the time of the processors and makes nothing faster; with
// OMP_WAIT_POLICY=passive they sleep. The program asks for that itself, unless the user has set how
// threads wait.
//
// libgomp has no call for it and reads the environment in its constructor, before main. Earlier
// still run the functions of an executable's .preinit_array; there setenv is of no use, as libc
// takes its environment from the stack only after them. They get that very array, though, which has
// no room for one entry more: so one that no library asks for while it is loaded lends its place,
// and gets it back in the constructor of the executable, which runs after those of all libraries.
// The verbs, and the programs that they start, see the environment as the user has it. Without such
// an entry (env -i), and with another libc or OpenMP, threads wait as they did.
#include <stddef.h>
#include <string.h>

static char **lent; // in the environment
static char *lent_entry;

static int begins_with(const char *entry, const char *name) {
    return strncmp(entry, name, strlen(name)) == 0;
}

static void lend_an_entry(int count, char **words, char **environment) {
    static char passive[] = "OMP_WAIT_POLICY=passive";
    static const char *const idle[] = {"_=",    "PWD=",     "OLDPWD=", "SHLVL=", "HOME=",
                                       "USER=", "LOGNAME=", "SHELL=",  "TERM=",  "PATH="};
    char **place = NULL;
    (void)count;
    (void)words;
    for (char **entry = environment; *entry; entry++) {
        if (begins_with(*entry, "OMP_WAIT_POLICY=") || begins_with(*entry, "GOMP_SPINCOUNT="))
            return;
        for (size_t i = 0; i < sizeof idle / sizeof *idle; i++)
            if (begins_with(*entry, idle[i]))
                place = entry;
    }
    if (place) {
        lent = place;
        lent_entry = *place;
        *place = passive;
    }
}

__attribute__((section(".preinit_array"),
               used)) static void (*const early)(int, char **, char **) = lend_an_entry;

__attribute__((constructor)) static void give_the_entry_back(void) {
    if (lent)
        *lent = lent_entry;
}
