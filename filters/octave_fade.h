// SPDX-License-Identifier: MIT
//
// What is kept of an octave, or of any wave, for samples that stand `width` units apart (Norton,
// Rockwood and Skolmoski 1982). Such samples can show frequencies below the Nyquist limit
// 1/(2 width). What has its energy up to the frequency t is kept with the weight
//
//   none   1
//   hard   1 if t < 1/(2 width), else 0
//   fade   2 - 4 t width, clamped to [0, 1]: 1 below half the Nyquist limit, 0 from the limit on
//
// The fade is that of peachey2003, section Clamping, except for one thing: the text's cutoff is the
// smaller of the Nyquist limit and MAXFREQ, which may fade the last octave at any width.
#ifndef BL_FILTERS_OCTAVE_FADE_H
#define BL_FILTERS_OCTAVE_FADE_H

typedef enum bl_octave_clamp { BL_CLAMP_NONE, BL_CLAMP_HARD, BL_CLAMP_FADE } bl_octave_clamp;

extern const char *const bl_octave_clamps[]; // "none", "hard", "fade", ended by NULL

// The weight of one octave whose energy ends at frequency t. A width that is NaN gives 0. Pure.
double bl_octave_kept(double t, bl_octave_clamp clamp, double width);

#endif
