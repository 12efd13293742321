// SPDX-License-Identifier: MIT
#include "aliasing/usual_methods.h"

#include <string.h>

#include "aliasing/method.h"

static int has_word(const char *const *words, const char *word) {
    for (; words && *words; words++)
        if (strcmp(*words, word) == 0)
            return 1;
    return 0;
}

size_t bl_usual_methods(const bl_signal *signal, const char **methods) {
    static const char *const usual[] = {"point",           "supersample:n=2", "supersample:n=3",
                                        "supersample:n=4", "supersample:n=8", "mean"};
    const char *key = bl_method_own_key(signal);
    const char *const *own = key ? bl_signal_choices(signal, key) : NULL;
    size_t count = 0;
    for (size_t i = 0; i < sizeof usual / sizeof *usual; i++)
        if (!has_word(own, usual[i]))
            methods[count++] = usual[i];
    for (; own && *own && count < BL_METHODS_MOST; own++)
        if (strcmp(*own, "none") != 0) // which is point sampling
            methods[count++] = *own;
    return count;
}
