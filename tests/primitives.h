// SPDX-License-Identifier: MIT
//
// Primitives by their texts, for tests.
#ifndef BL_TESTS_PRIMITIVES_H
#define BL_TESTS_PRIMITIVES_H

#include "core/signal.h"

// Opens a primitive by its text; bl_test_primitive fails the test where it cannot.
bl_status bl_test_open_primitive(const char *text, bl_signal **signal, bl_message *message);
bl_signal *bl_test_primitive(const char *text);

// The value at x averaged over `width`, whatever the width of the signal.
double bl_test_filtered(const bl_signal *signal, double x, double width);

#endif
