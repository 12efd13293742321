// SPDX-License-Identifier: MIT
//
// Advice: the cheapest way to sample a signal whose image under a view stays within a tolerance,
// and what the scene does not need.
//
// A method is within the tolerance if the upper limit of its error is, and beyond it if the lower
// limit is; between, the reference is not converged enough to tell. The error is the root mean
// square of the luminance over the image, against the converged reference of a pixel, or the
// largest over its pixels, whose limits are twice the standard error of the reference there.
#ifndef BL_SCORE_ADVISE_H
#define BL_SCORE_ADVISE_H

#include "aliasing/alias.h"
#include "core/verdict.h"

typedef struct bl_advise_settings {
    double tolerance; // of the luminance, above 0
    int largest;      // 1: of every pixel; 0: of the root mean square
    bl_alias_settings alias;
} bl_advise_settings;

// 1/255 of the root mean square, and what is measured of aliasing for that: no moving pictures.
bl_advise_settings bl_advise_settings_of_size(bl_size size);

// What of the signal a view shows.
typedef struct bl_scene_needs {
    double least_width, most_width; // of a sample along any axis that varies; NAN: none varies
    double highest_frequency;       // that any pixel shows: half a cycle in the least width
    double least[BL_AXES], most[BL_AXES]; // coordinates seen
    int varies[BL_AXES];                  // whether a coordinate does
    unsigned octaves, octaves_seen;       // of a sum of octaves: those with a frequency below the
                                          // highest; 0 of any other signal
} bl_scene_needs;

// Where a method is furthest off.
typedef struct bl_worst_pixel {
    size_t x, y;
    double error; // signed, of the luminance
    double width; // of the sample there, units; NAN where nothing is seen
} bl_worst_pixel;

typedef struct bl_advice {
    bl_alias_result alias; // all that was measured; rows as the methods were given
    bl_estimate *error;    // of each row, by the measure asked for; owned
    bl_worst_pixel *worst; // of each row; owned
    // Pass: `chosen` is within the tolerance. Inconclusive: none surely is, but one may be. Fail:
    // all are beyond.
    bl_verdict verdict;
    size_t chosen;  // the cheapest that is within; else that of the least error
    size_t cheaper; // the dearest of the cheaper ones; SIZE_MAX: there is none
    bl_scene_needs needs;
} bl_advice;

// Measures the methods (texts as in bl_method_open) and chooses. On success the caller ends with
// bl_advice_free. Errors: those of bl_alias_measure; BL_USAGE for a tolerance that is not above 0.
bl_status bl_advise(const bl_signal *signal, const bl_view *view, const char *const *methods,
                    size_t count, const bl_advise_settings *settings, bl_advice *advice,
                    bl_message *message);
void bl_advice_free(bl_advice *advice);

// What the pixels of the view see of the signal, by their centres.
bl_scene_needs bl_scene_needs_find(const bl_signal *signal, const bl_view *view);

// The choice alone, of rows whose errors and times are known; fills verdict, chosen and cheaper.
void bl_advice_choose(bl_advice *advice, double tolerance);

#endif
