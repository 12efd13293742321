// SPDX-License-Identifier: MIT
//
// The same signal with another value of one of its keys, of any kind.
#ifndef BL_CORE_SETTING_H
#define BL_CORE_SETTING_H

#include "core/definition.h"

// The parameter of a key of the signal; NULL for a signal without a definition, or without it.
const bl_parameter *bl_signal_parameter(const bl_signal *signal, const char *key);

// Opens the signal anew with key=value in the place of what its text says of the key; the caller
// frees it. Errors: BL_USAGE for a signal without a definition, an unknown key, and a value that
// the key does not take; BL_DEVICE out of memory. Thread-safe.
bl_status bl_signal_with_setting(const bl_signal *signal, const char *key, const char *value,
                                 bl_signal **changed, bl_message *message);

#endif
