// SPDX-License-Identifier: MIT
#include "reports/figures/six_noises.h"

#include <stdarg.h>

#include "noises/noise.h"

const char *const bl_six_names[BL_SIX] = {"vnoise",  "gnoise",  "vgnoise",
                                          "hermite", "vcnoise", "scnoise"};

bl_status bl_six_open_one(bl_run *run, bl_signal **signal, bl_message *message, const char *format,
                          ...) {
    va_list arguments;
    va_start(arguments, format);
    const char *text = bl_run_vtext(run, format, arguments);
    va_end(arguments);
    if (!*text)
        return bl_report(message, BL_DEVICE, "out of memory");
    return bl_noise_open(text, bl_run_settings(run)->isa, signal, message);
}

bl_status bl_six_open(bl_run *run, bl_six *six, bl_message *message) {
    static const char *const notes[BL_SIX] = {"signal (a)", "signal (b)", "signal (c)",
                                              "signal (d)", "signal (e)", "signal (f)"};
    *six = (bl_six){0};
    for (int i = 0; i < BL_SIX; i++) {
        bl_status status =
            bl_six_open_one(run, &six->signal[i], message, "%s:seed=%llu", bl_six_names[i],
                            (unsigned long long)bl_run_settings(run)->seed);
        if (status != BL_OK) {
            bl_six_close(six);
            return status;
        }
        bl_run_setting(run, notes[i], six->signal[i]->text);
    }
    return BL_OK;
}

void bl_six_close(bl_six *six) {
    for (int i = 0; i < BL_SIX; i++)
        bl_signal_free(six->signal[i]);
    *six = (bl_six){0};
}

bl_gallery bl_six_gallery(bl_six *six) {
    return (bl_gallery){BL_SIX, six->signal, bl_six_names, bl_six_names};
}
