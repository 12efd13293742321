// SPDX-License-Identifier: MIT
//
// Runs figures and tells what came of them: what the verbs `reproduce` and `compare` share.
#ifndef BL_CLI_FIGURES_H
#define BL_CLI_FIGURES_H

#include "cli/verb.h"
#include "reports/reproduce.h"

// Completes the settings from the options that every verb takes, runs the figures named (count 0:
// all) and reports in text or JSON. Returns the verdict, or an error with its message.
bl_status bl_figures_run(bl_call *call, const char *const *names, size_t count,
                         bl_reproduce_settings *settings);

#endif
