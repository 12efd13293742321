// SPDX-License-Identifier: MIT
//
// Opens any signal by its text: a noise of the registry, or an image file.
//
//   gnoise:seed=7                                a noise
//   grain.exr:spacing=0.0625,channel=R           an image file
//
// The word before the first colon is a file if it holds a '.' or a '/', or if a file of that name
// exists; the whole text is a file if one of exactly that name exists. Keys of an image:
//
//   channel=NAME|INDEX  which channel (default: the first; an index counts from 0)
//   spacing=REAL        units between pixels (default: the file's attribute "bandlimit:spacing",
//                       else 1, so that frequencies are in cycles per pixel)
//   part=INDEX          which part of a multi-part file, which is refused without it
//   memory=MIB          how much of the image is held in memory (default 1024); a larger image is
//                       read in blocks through a cache of that size
//
// Values are those of the file: floats and halves as they are, integers divided by their full
// scale; no colour curve and no alpha is applied. Pixel (i, j), counted from the upper left corner
// of the data window, stands at (i, j) * spacing; a coordinate takes the nearest pixel, and NaN
// outside of the image. The whole image is read once while opening, so a truncated or corrupt
// file is refused there and not in the middle of a measurement.
#ifndef BL_REPORTS_SOURCE_H
#define BL_REPORTS_SOURCE_H

#include "core/signal.h"
#include "noises/noise.h"

// Opens a signal; the caller frees it with bl_signal_free. Errors, each with a message:
// BL_USAGE for an unknown name, key, channel or a value out of range; BL_DEVICE for a file that is
// missing, unreadable, a folder, empty, truncated or not an image, and without memory;
// BL_MISMATCH for an image that is not one plane of pixels. Safe from several threads, and so is
// reading the signal.
bl_status bl_source_open(const char *text, bl_isa isa, bl_signal **signal, bl_message *message);

// Whether the text names a file and not a noise, by the rule above.
int bl_source_is_file(const char *text);

#endif
