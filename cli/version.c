// SPDX-License-Identifier: MIT
//
// The verb `version`.
#include "cli/json.h"
#include "cli/verb.h"

static bl_status run_version(bl_call *call) {
    json_t *object = bl_json_start(call);
    const char *best = bl_isa_name(bl_isa_best());
    if (object) {
        bl_json_set_text(object, "compiler", __VERSION__);
        bl_json_set_text(object, "isa_best", best);
        bl_json_set_text(object, "licence", "GPL-3.0-or-later as linked; own sources MIT");
        return BL_OK;
    }
    fprintf(call->out,
            "bandlimit %s\ncompiler %s; best instruction set here %s\n"
            "As linked (FFTW, OpenImageIO): GNU General Public License, version 3 or later.\n"
            "Our own sources: MIT.\n",
            BL_VERSION, __VERSION__, best);
    return BL_OK;
}

const bl_verb bl_verb_version = {
    .name = "version",
    .operands = "",
    .summary = "the version, the compiler and the licence",
    .options = bl_no_options,
    .run = run_version,
};
