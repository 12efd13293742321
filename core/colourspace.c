// SPDX-License-Identifier: MIT
#include "core/colourspace.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

const char *const bl_colourspace_words[] = {"file", "linear", "srgb", "gamma2.2", NULL};

static const double LEAST_POWER = 0.1, LARGEST_POWER = 10;

// A power in units of `unit`, behind which stands `end`; nothing else where that is "".
static int read_power(const char *word, double unit, const char *end, double *power) {
    char *rest;
    if (!((*word >= '0' && *word <= '9') || *word == '.'))
        return 0;
    *power = unit * strtod(word, &rest);
    return strncasecmp(rest, end, strlen(end)) == 0 && (*end || !*rest) && *power >= LEAST_POWER &&
           *power <= LARGEST_POWER;
}

static bl_colourspace of_power(double power) {
    return power == 1 ? (bl_colourspace){BL_COLOURS_LINEAR, 0}
                      : (bl_colourspace){BL_COLOURS_POWER, power};
}

bl_status bl_colourspace_read(const char *word, bl_colourspace *space, bl_message *message) {
    double power;
    *space = (bl_colourspace){BL_COLOURS_LINEAR, 0};
    if (strcmp(word, "file") == 0)
        space->curve = BL_COLOURS_OF_FILE;
    else if (strcmp(word, "srgb") == 0)
        space->curve = BL_COLOURS_SRGB;
    else if (read_power(strncmp(word, "gamma", 5) == 0 ? word + 5 : word, 1, "", &power))
        *space = of_power(power);
    else if (strcmp(word, "linear") != 0)
        return bl_report(message, BL_USAGE,
                         "colourspace=%.80s: there are file, linear, srgb and gamma2.2, or any "
                         "power from %g to %g",
                         word, LEAST_POWER, LARGEST_POWER);
    return BL_OK;
}

static int begins(const char *word, const char *with) {
    return strncasecmp(word, with, strlen(with)) == 0;
}

int bl_colourspace_of_file(const char *word, double power, bl_colourspace *space) {
    *space = (bl_colourspace){BL_COLOURS_LINEAR, 0};
    if (begins(word, "srgb"))
        space->curve = BL_COLOURS_SRGB;
    else if (begins(word, "gamma") && read_power(word + 5, 1, "", &power))
        *space = of_power(power);
    else if (strcasecmp(word, "GammaCorrected") == 0 && power >= LEAST_POWER &&
             power <= LARGEST_POWER)
        *space = of_power(power);
    else if (begins(word, "g") && read_power(word + 1, 0.1, "_rec709", &power))
        *space = of_power(power);
    else
        return begins(word, "lin") || strcasecmp(word, "scene_linear") == 0;
    return 1;
}

void bl_colourspace_text(const bl_colourspace *space, char *text, size_t size) {
    if (space->curve == BL_COLOURS_POWER)
        snprintf(text, size, "the power %g", space->power);
    else
        snprintf(text, size, "%s",
                 space->curve == BL_COLOURS_SRGB ? "the curve of sRGB" : "linear");
}
