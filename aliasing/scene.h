// SPDX-License-Identifier: MIT
//
// Scenes: a signal under a view, with what methods must know of both.
#ifndef BL_ALIASING_SCENE_H
#define BL_ALIASING_SCENE_H

#include "aliasing/method.h"

// A scene of the signal and the view, which must outlive it. Its mean colour is what the signal
// states, or that of the signal at 2^14 places within 64 units of what the view sees (an image: at
// what is seen); it is the background too. `seen` is the share of the view that sees the signal.
// Errors: BL_MISMATCH if the view sees nothing, or no value that is finite.
bl_status bl_scene_make(const bl_signal *signal, const bl_view *view, uint64_t seed,
                        bl_scene *scene, double *seen, bl_message *message);

// The luminances of pixels as a method gives them, for what samples images (aliasing/energy.h):
// `user` is a bl_scene_method.
typedef struct bl_scene_method {
    const bl_scene *scene;
    const bl_method_kind *kind;
    const void *parameters;
} bl_scene_method;
void bl_scene_luminances(const void *user, const double *x, const double *y, size_t count,
                         double *out);
// The same of the unfiltered signal: `user` is a bl_scene.
void bl_scene_raw_luminances(const void *user, const double *x, const double *y, size_t count,
                             double *out);

// The image of a method, 3 values a pixel, row by row, in `threads` threads (0: all).
void bl_scene_image(const bl_scene_method *method, int threads, double *rgb);

#endif
