// SPDX-License-Identifier: MIT
//
// A command line as words, split as a shell does but without one: blanks part words, '...' and
// "..." hold blanks, a backslash makes the next letter plain (within "..." only \" and \\), and
// nothing else is special. Who wants a shell writes sh -c '...'.
#ifndef BL_SOURCES_COMMAND_H
#define BL_SOURCES_COMMAND_H

#include <stdint.h>

#include "core/status.h"

// Splits `command`, a part of `text` for messages, into words that end with NULL; the caller frees
// them. Errors: BL_USAGE for no word and for a quote without its end.
bl_status bl_command_read(const char *text, const char *command, char ***words,
                          bl_message *message);
void bl_command_free(char **words);

// Whether {seed} stands in the words, and a copy of them with a seed in its place (NULL if out of
// memory).
int bl_command_has_seed(char *const *words);
char **bl_command_with_seed(char *const *words, uint64_t seed);

#endif
