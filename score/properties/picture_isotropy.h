// SPDX-License-Identifier: MIT
//
// Isotropy of a picture or a volume of samples, and the direction that it has.
//
// The spectrum is looked at by octaves, from half the sampling rate downwards, in square patches
// that lie side by side, two wavelengths of the octave's lowest frequency wide, each under a window
// that is round (a Hann window of the distance from the middle), so that a spectrum without a
// direction stays without one. Of a patch, the power P over the directions theta of the octave's
// frequencies makes two numbers for each pair of axes,
//
//   a_m = sum w_m P / sum P,   w_m = exp(i m theta) less its straight line over each thin ring,
//
// a stretch for m = 2, and a cross for m = 4. Taking off the ring's own share makes them 0 for
// every spectrum that is a function of the distance alone, whatever the bins are and whatever the
// pixels' two spacings. Over the patches of an isotropic picture each is symmetric about 0 in every
// direction; the mean is told from 0 by the F distribution of 2 and 2 (n - 1) degrees of freedom,
// with the variance and n for neighbours that are alike; or, where the mean is above a half, as if
// they were not, because then all say the same. All tests share alpha. Octaves that hold
// less than a thousandth of the variance, and means below a hundredth, are shown and not judged.
//
// The direction is that along which the picture is stretched, across that of the most power; from
// the first axis towards the second, which runs down a picture. Its interval follows from the same
// variance.
#ifndef BL_SCORE_PROPERTIES_PICTURE_ISOTROPY_H
#define BL_SCORE_PROPERTIES_PICTURE_ISOTROPY_H

#include "score/score.h"

// Errors: BL_DEVICE out of memory.
bl_status bl_score_picture_isotropy(const bl_signal *signal, const bl_score_settings *settings,
                                    bl_score_property *result, bl_message *message);

#endif
