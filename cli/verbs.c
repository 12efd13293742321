// SPDX-License-Identifier: MIT
//
// The list of all verbs.
#include "cli/verb.h"

#define BL_VERB(stem) extern const bl_verb bl_verb_##stem;
#include "cli/verbs.def"
#undef BL_VERB

static const void *const list[] = {
#define BL_VERB(stem) &bl_verb_##stem,
#include "cli/verbs.def"
#undef BL_VERB
};

const bl_registry bl_verbs = {"verb", "verbs", list, sizeof list / sizeof *list};
