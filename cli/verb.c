// SPDX-License-Identifier: MIT
#include "cli/verb.h"

const bl_option bl_no_options[] = {{0}};

#define AT(member) offsetof(bl_common, member)
const bl_option bl_common_options[] = {
    {.name = "json",
     .kind = BL_OPTION_FLAG,
     .offset = AT(json),
     .help = "print one JSON object and nothing else to stdout"},
    {.name = "output",
     .kind = BL_OPTION_WORD,
     .letter = 'o',
     .offset = AT(output),
     .value = "PATH",
     .help = "write to PATH: the report, or what the verb's help says; - is standard output, for "
             "reports and CSV"},
    {.name = "seed",
     .kind = BL_OPTION_WORD,
     .offset = AT(seed_word),
     .value = "N",
     .help = "seed of random places and fresh signals, 0 to 2^64-1 (default: 1); for eval and "
             "render, the seed of the signal (default: what its text says, else 0)"},
    {.name = "threads",
     .kind = BL_OPTION_UNSIGNED,
     .offset = AT(threads),
     .value = "N",
     .minimum = 1,
     .maximum = 1024,
     .help = "threads to use (default: all cores)"},
    {.name = "quick",
     .kind = BL_OPTION_FLAG,
     .offset = AT(quick),
     .help = "smaller settings: seconds"},
    {.name = "full",
     .kind = BL_OPTION_FLAG,
     .offset = AT(full),
     .help = "larger settings: as precise as is sensible"},
    {.name = "isa",
     .kind = BL_OPTION_WORD,
     .offset = AT(isa),
     .value = "SET",
     .help = "instruction set baseline, v3 or v4, for bench also all (default: the best here); the "
             "values are the same bit for bit"},
    {.name = "quiet",
     .kind = BL_OPTION_FLAG,
     .letter = 'q',
     .offset = AT(quiet),
     .help = "no progress and no report on a terminal: errors, files and JSON alone"},
    {.name = "help",
     .kind = BL_OPTION_FLAG,
     .letter = 'h',
     .offset = AT(help),
     .help = "print this help"},
    {.name = "version", .kind = BL_OPTION_FLAG, .offset = AT(version), .help = "print the version"},
    {0}};
#undef AT
