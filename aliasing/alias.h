// SPDX-License-Identifier: MIT
//
// What a sampling method leaves of a signal under a view: alias, blur, error, flicker and cost.
//
// Let F be the image that the view shows, as a function of a continuous place (x, y), and G what
// the method gives for a pixel centred at (x, y). The pixels of an image are samples of G at the
// centres. Both are computed on two grids of `oversample` samples a pixel along each axis, from
// which aliasing/energy.h takes without bias
//
//   alias = the energy of G beyond half a cycle per pixel along either axis, which folds into the
//           image: sum over k != 0 of int |G(f + k)|^2
//   blur  = the energy of F - G within: int |F - G|^2, which for a linear filter H is
//           int |1 - H|^2 |F|^2
//
// so that alias + blur is the squared error against the ideal band-limited image, a pixel. For a
// stationary signal seen flat both are predicted from its density, and compared. The errors (mse,
// psnr, ssim, largest) are those of the image itself against the converged reference, and flicker
// is what remains of their movement: the variance over time of the error of a pixel, while the
// view pans by sub-pixel steps and zooms, averaged over pixels. All are of the luminance, in units
// of the signal.
#ifndef BL_ALIASING_ALIAS_H
#define BL_ALIASING_ALIAS_H

#include "aliasing/method.h"
#include "aliasing/reference.h"
#include "aliasing/constancy.h"
#include "core/size.h"
#include "core/statistics.h"

typedef struct bl_alias_settings {
    bl_pixel pixel;        // of the reference
    unsigned oversample;   // samples of F and G a pixel along each axis, on each of two grids
    unsigned replicates;   // of alias and blur, at random shifts of the grid, 2 to 64; the
                           // intervals come of their spread
    unsigned frames;       // of a pan and of a zoom; 0: no flicker
    unsigned rounds;       // of timing; 0: times are not taken
    double turn_seconds;   // of timing, a turn (core/clock.h)
    uint32_t most_samples; // of each of the four sequences of the reference, a pixel
    double level;          // of the intervals
    uint64_t seed;
    int threads;
    const char *cache; // folder of converged references; NULL: none is kept
} bl_alias_settings;

bl_alias_settings bl_alias_default_settings(void); // of normal size
bl_alias_settings bl_alias_settings_of_size(bl_size size);

enum { BL_ALIAS_RINGS = 32 };

typedef struct bl_alias_row {
    char *method; // the text of the method; owned by the result
    bl_estimate alias, blur, mse, ssim, flicker;
    double psnr_db; // of a full scale of 1
    double max_error;
    double predicted_alias, predicted_blur; // of a stationary signal seen flat; NAN: none
    double first_alias;                     // cycles per pixel of the strongest alias; NAN
    double pops;                            // sudden changes in a slow zoom (aliasing/flicker.h)
    double rings[BL_ALIAS_RINGS]; // the energy of the error by frequency (aliasing/energy.h), of
                                  // the first replicate
    double samples;               // of the signal, a pixel
    double ns_per_sample, ns_lowest, ns_highest; // of a pixel: median, least and most
    double *image; // linear red, green and blue of each pixel; owned by the result
} bl_alias_row;

typedef struct bl_alias_result {
    size_t count;
    bl_alias_row *rows;
    bl_reference reference; // the converged image
    double reference_error; // its rms error: twice the standard error
    double ring_width;      // of the spectrum of the error, cycles per pixel
    double depth[BL_AXES];  // of a solid signal, where the image is flat; NAN along other axes
    int random_depth;       // no view asked for it; every further replicate has its own
    bl_constancy constancy; // is there anything to judge? Of the image at its own depth
    double seen;            // share of the pixels that see the signal
    double mean[3];         // colour of the signal, which stands where the view sees nothing
} bl_alias_result;

// Measures the methods side by side; each pixel's time is taken interleaved with the others'.
// `text` of a method as in bl_method_open. On success the caller frees the result. Errors: those of
// bl_method_open; BL_MISMATCH if the view sees nothing; BL_DEVICE for memory and the cache.
bl_status bl_alias_measure(const bl_signal *signal, const bl_view *view, const char *const *methods,
                           size_t count, const bl_alias_settings *settings, bl_alias_result *result,
                           bl_message *message);
void bl_alias_free(bl_alias_result *result);

// Whether the signal has one value all over the image, so that no method is judged there.
int bl_alias_is_constant(const bl_alias_result *result);

// Whether the reference is good to a tenth of the smallest error that was measured with it.
int bl_alias_is_converged(const bl_alias_result *result);

#endif
