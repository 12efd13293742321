// SPDX-License-Identifier: MIT
//
// Converged images: what a perfect sampler gives for a pixel.
//
// The colour of a pixel is the mean of the signal over a box of one pixel, or under a Gaussian with
// a standard deviation of half a pixel. It is estimated by four independent randomised Sobol
// sequences a pixel, whose spread is the error. A pilot of 32 places each tells where more are
// needed; from then on every round draws anew, so that an estimate does not choose its own end, and
// the error that is stated is that of the values that are kept.
//
// It is exact instead where the signal has the word `exact` among its filters, the view is straight
// and its pixels' edges lie along the axes of the signal, and the pixel is a box.
#ifndef BL_ALIASING_REFERENCE_H
#define BL_ALIASING_REFERENCE_H

#include "aliasing/method.h"

typedef enum bl_pixel { BL_PIXEL_BOX, BL_PIXEL_GAUSSIAN } bl_pixel;
extern const char *const bl_pixel_words[]; // "box", "gaussian", ended by NULL

typedef struct bl_reference {
    size_t width, height;
    double *rgb;   // height rows of width pixels of 3 values; owned
    double *error; // standard error of the luminance of each pixel; owned
    double rms_error;
    double samples; // of the signal, a pixel
    int exact;
    int from_cache;
} bl_reference;

typedef struct bl_reference_settings {
    bl_pixel pixel;
    double tolerance;      // wanted of the rms error
    uint32_t most_samples; // a pixel, of each of the four sequences
    int threads;
    const char *cache; // folder; NULL: nothing is kept
} bl_reference_settings;

// Makes the image of the scene, whose seed the sequences take. The tolerance is not met where it
// would take more than `most_samples`: rms_error tells. In the folder of the cache an image stands
// under the hash of all that made it; what is read back is checked against that text, the values of
// the signal at many places, and a checksum, and made anew where it does not agree. On success the
// caller ends with bl_reference_free. Errors: BL_MISMATCH if the signal is not finite there;
// BL_DEVICE out of memory, and for a folder that cannot be written.
bl_status bl_reference_make(const bl_scene *scene, const bl_reference_settings *settings,
                            bl_reference *reference, bl_message *message);
void bl_reference_free(bl_reference *reference);

// One pixel centred at (x, y) with this many samples of each of the four sequences, of the key: its
// mean colour, and the variance of the luminance of that mean. Thread-safe.
void bl_reference_pixel(const bl_scene *scene, bl_pixel pixel, double x, double y, uint32_t samples,
                        uint64_t key, double rgb[3], double *variance);

#endif
