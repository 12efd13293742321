// SPDX-License-Identifier: MIT
#include "cli/alias_files.h"

#include <stdio.h>

void bl_alias_warn(bl_call *call, const bl_signal *signal, const bl_view *view,
                   const bl_constancy *same) {
    char share[64] = "all over", elsewhere[160] =
                                     "and no other value was found within 1000 units "
                                     "of 0";
    if (!(same->varies < 0.01))
        return;
    if (same->varies > 0)
        snprintf(share, sizeof share, "in all but %.2g %% of the image", 100 * same->varies);
    if (same->found)
        snprintf(elsewhere, sizeof elsewhere,
                 "it has others near (%.3g, %.3g): try --view flat:scale=%g,x=%.3g,y=%.3g",
                 same->place[0], same->place[1], 2 * same->reach, same->place[0], same->place[1]);
    bl_call_warn(call, "'%s' is %.6g %s where the view '%s' looks: %s can be judged there; %s",
                 signal->text, same->value, share, view->text,
                 same->varies > 0 ? "little" : "no method", elsewhere);
}
