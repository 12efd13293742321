// SPDX-License-Identifier: MIT
//
// What a function in a shared object states of itself (include/bandlimit_plugin.h, where it is
// called its claims), asked for, checked and made the facts of the signal.
#ifndef BL_SOURCES_PLUGIN_CLAIMS_H
#define BL_SOURCES_PLUGIN_CLAIMS_H

#include "core/signal.h"
#include "include/bandlimit_plugin.h"

// Lets the plugin write its claims, into a room that is larger than the struct, so that one built
// with a later header is found out and not a danger: false then. Nothing is stated without a
// `claim`. Calls into the plugin.
int bl_plugin_claims_ask(bandlimit_claim *claim, struct bandlimit_claims *claims);

// What is wrong with the claims, in words, or NULL.
const char *bl_plugin_claims_fault(const struct bandlimit_claims *claims);

// Makes facts of claims without a fault.
void bl_plugin_claims_state(const struct bandlimit_claims *claims, bl_facts *facts);

#endif
