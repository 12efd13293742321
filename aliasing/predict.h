// SPDX-License-Identifier: MIT
//
// The alias and the blur of a linear method on a stationary signal that is seen straight ahead,
// from closed forms alone.
#ifndef BL_ALIASING_PREDICT_H
#define BL_ALIASING_PREDICT_H

#include "aliasing/method.h"

typedef struct bl_prediction {
    double alias, blur;
} bl_prediction;

// What bl_image_energies is expected to find, over seeds, places and depths, through its own
// window, as far as `oversample` samples a pixel show it: the closed-form spectrum of the samples,
// weighted with the method's response. The power beyond half the rate of the samples is taken with
// the response of the frequency that it folds to. `known` is 0, and the numbers NaN, without a
// closed form, a response, a straight view whose axes stand upright on each other and are equally
// long, and a square image. Errors: BL_DEVICE out of memory.
bl_status bl_predict_energies(const bl_signal *signal, const bl_view *view, const bl_method *method,
                              size_t oversample, bl_prediction *prediction, int *known,
                              bl_message *message);

#endif
