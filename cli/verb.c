// SPDX-License-Identifier: MIT
#include "cli/verb.h"

const bl_option bl_no_options[] = {{0}};

#define AT(member) offsetof(bl_common, member)
const bl_option bl_common_options[] = {
    {"json", BL_OPTION_FLAG, AT(json), .help = "print one JSON object and nothing else to stdout"},
    {"output", BL_OPTION_WORD, AT(output), "PATH", .letter = 'o',
     .help = "write to PATH: the report, or what the verb's help says; - is standard output, for "
             "reports and CSV"},
    {"seed", BL_OPTION_WORD, AT(seed_word), "N",
     .help = "seed of random places and fresh signals, 0 to 2^64-1 (default: 1); for eval and "
             "render, the seed of the signal (default: what its text says, else 0)"},
    {"threads", BL_OPTION_UNSIGNED, AT(threads), "N", .minimum = 1, .maximum = 1024,
     .help = "threads to use (default: all cores)"},
    {"quick", BL_OPTION_FLAG, AT(quick), .help = "smaller settings: seconds"},
    {"full", BL_OPTION_FLAG, AT(full), .help = "larger settings: as precise as is sensible"},
    {"isa", BL_OPTION_WORD, AT(isa), "SET",
     .help = "instruction set baseline, v3 or v4, for bench also all (default: the best here); the "
             "values are the same bit for bit"},
    {"quiet", BL_OPTION_FLAG, AT(quiet), .letter = 'q',
     .help = "no progress and no report on a terminal: errors, files and JSON alone"},
    {"help", BL_OPTION_FLAG, AT(help), .letter = 'h', .help = "print this help"},
    {"version", BL_OPTION_FLAG, AT(version), .help = "print the version"},
    {0}};
#undef AT
