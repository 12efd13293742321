// SPDX-License-Identifier: MIT
#include "aliasing/usual_methods.h"

#include <string.h>

#include "aliasing/method.h"

size_t bl_usual_methods(const bl_signal *signal, const char **methods) {
    static const char *const usual[] = {"point",           "supersample:n=2", "supersample:n=3",
                                        "supersample:n=4", "supersample:n=8", "mean"};
    const char *const *own = bl_method_own_words(signal);
    size_t count = 0;
    for (size_t i = 0; i < sizeof usual / sizeof *usual; i++)
        if (!bl_method_is_own(signal, usual[i]))
            methods[count++] = usual[i];
    for (; *own && count < BL_METHODS_MOST; own++)
        if (strcmp(*own, "none") != 0) // which is point sampling
            methods[count++] = *own;
    return count;
}
