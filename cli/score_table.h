// SPDX-License-Identifier: MIT
//
// The scorecard on a terminal.
#ifndef BL_CLI_SCORE_TABLE_H
#define BL_CLI_SCORE_TABLE_H

#include "cli/scorecard.h"

// Prints the table, in blocks of columns that fit 120, then for each signal the reasons of what did
// not pass.
void bl_score_table_print(bl_call *call, const bl_scorecard *cards, size_t count,
                          const bl_score_settings *settings);

#endif
