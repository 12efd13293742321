// SPDX-License-Identifier: MIT
#include "cli/words.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/grammar.h"

int bl_ends_with(const char *path, const char *ending) {
    size_t length = strlen(path), tail = strlen(ending);
    return length > tail && strcasecmp(path + length - tail, ending) == 0;
}

double bl_signal_far(const bl_signal *signal) {
    // From 2^52 on a double has no fraction, whatever the signal does with it.
    return signal->facts.far > 0 ? fmin(signal->facts.far, 0x1p52) : 0x1p52;
}

bl_status bl_read_coordinate(const char *word, double far, const char *where, double *out,
                             bl_message *message) {
    double number;
    if (!bl_read_real(word, &number)) {
        char *end;
        double loose = strtod(word, &end);
        if (end != word && *end == '\0' && !isfinite(loose))
            return bl_report(message, BL_USAGE, "%s: '%s' is not finite; a coordinate is a number",
                             where, word);
        return bl_report(message, BL_USAGE, "%s: '%s' is not a number; write it as 0.25 or 1/4",
                         where, word);
    }
    if (fabs(number) > far)
        return bl_report(message, BL_USAGE,
                         "%s: '%s' is too large; beyond +-%.6g nothing is left of the fraction "
                         "within a cell",
                         where, word, far);
    *out = number;
    return BL_OK;
}

bl_status bl_read_list(const char *option, const char *text, size_t least, size_t most, double far,
                       double *out, bl_message *message) {
    char word[64];
    size_t count = 0;
    for (const char *at = text;; at++) {
        size_t length = strcspn(at, ",");
        if (count == most)
            return bl_report(message, BL_USAGE, "--%s %s: more than %zu numbers", option, text,
                             most);
        if (length >= sizeof word)
            return bl_report(message, BL_USAGE, "--%s %s: a number of more than 63 letters", option,
                             text);
        memcpy(word, at, length);
        word[length] = '\0';
        char where[128];
        snprintf(where, sizeof where, "--%s %.80s", option, text);
        bl_status status = bl_read_coordinate(word, far, where, &out[count++], message);
        if (status != BL_OK)
            return status;
        at += length;
        if (*at == '\0')
            break;
    }
    if (count < least)
        return bl_report(message, BL_USAGE, "--%s %s: needs %zu numbers with commas between them",
                         option, text, least);
    return BL_OK;
}

bl_status bl_read_axis(const char *option, const char *text, double out[3], bl_message *message) {
    out[0] = out[1] = out[2] = 0;
    if (strlen(text) == 1 && *text >= 'x' && *text <= 'z') {
        out[*text - 'x'] = 1;
        return BL_OK;
    }
    if (!strchr(text, ','))
        return bl_report(message, BL_USAGE,
                         "--%s %s: not an axis; use x, y, z or a direction as 1,1,0", option, text);
    bl_status status = bl_read_list(option, text, 2, 3, NAN, out, message);
    if (status != BL_OK)
        return status;
    double length = hypot(hypot(out[0], out[1]), out[2]);
    if (!(length > 0) || !isfinite(length))
        return bl_report(message, BL_USAGE,
                         "--%s %s: a direction must have a length that is finite and not zero",
                         option, text);
    return BL_OK;
}

bl_status bl_read_range(const char *option, const char *text, int open, double *from, double *to,
                        bl_message *message) {
    const char *colon = strchr(text, ':');
    char low[64];
    size_t length = colon ? (size_t)(colon - text) : 0;
    if (colon && length < sizeof low) {
        memcpy(low, text, length);
        low[length] = '\0';
        int endless = open && strcmp(colon + 1, "inf") == 0;
        if (endless)
            *to = INFINITY;
        if (bl_read_real(low, from) && (endless || bl_read_real(colon + 1, to))) {
            if (*from < *to)
                return BL_OK;
            return bl_report(message, BL_USAGE, "--%s %s: the first number must be the smaller",
                             option, text);
        }
    }
    return bl_report(message, BL_USAGE, "--%s %s: not a range; write FROM:TO as 0.5:1%s", option,
                     text, open ? " or 1:inf" : "");
}
