// SPDX-License-Identifier: MIT
//
// One property of the scorecard of one signal, for the tests of properties.
#ifndef BL_TESTS_SCORES_H
#define BL_TESTS_SCORES_H

#include "score/score.h"

// The property of that name. Fails the running test where it cannot be measured.
bl_score_property bl_test_score_with(const bl_score_subject *subject, const char *property,
                                     const bl_score_settings *settings);

// With the default settings but for size and seed.
bl_score_property bl_test_score(const bl_signal *signal, const char *property, bl_size size,
                                uint64_t seed);

#endif
