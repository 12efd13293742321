// SPDX-License-Identifier: MIT
//
// All registries, in the order of `list`: what the program hands to its verbs (call->registries), so
// that whatever is listed is also shown, completed, and known when it is typed as a verb.
#ifndef BL_CLI_REGISTRIES_H
#define BL_CLI_REGISTRIES_H

#include "core/registry.h"

extern const bl_registry *const bl_registries[]; // ended by NULL

#endif
