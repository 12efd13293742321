// SPDX-License-Identifier: MIT
//
// What moves in the error of a method when the picture moves.
//
// Flicker is the variance over time of the error of a pixel, averaged over pixels: while the view
// pans by a pixel in sub-pixel steps, and while it zooms until its corners have moved by about one.
// What should stay constant is the error, 0. An error that stays where it is does not flicker; what
// a blur lacks does as far as it moves through the pixel, and alias does most.
//
// Pops are sudden changes while the view zooms by a factor of 2 in eight times as many steps, in
// the middle half of the image, where little moves: of the rms change of the error from one frame
// to the next, the largest beyond the median, sqrt(largest^2 - median^2). An octave that is cut off
// at once shows there with its whole standard deviation.
#ifndef BL_ALIASING_FLICKER_H
#define BL_ALIASING_FLICKER_H

#include "aliasing/reference.h"
#include "aliasing/scene.h"
#include "core/statistics.h"

typedef struct bl_flicker_settings {
    bl_pixel pixel;
    unsigned frames;  // of the pan and of the zoom, 2 or more
    size_t pixels;    // looked at along each axis
    uint32_t samples; // of each of the four sequences of the reference
    double level;
    int threads;
} bl_flicker_settings;

typedef struct bl_flicker {
    bl_estimate variance; // over the columns of pixels
    double pops;
} bl_flicker;

// Measures `count` methods side by side against the raw signal of `scene`; the methods' own scenes
// are of the same view. Errors: BL_DEVICE out of memory.
bl_status bl_flicker_measure(const bl_scene *scene, const bl_scene_method *methods, size_t count,
                             const bl_flicker_settings *settings, bl_flicker *results,
                             bl_message *message);

#endif
