// SPDX-License-Identifier: MIT
//
// Opens any signal by its text: a noise, primitive or texture of the registries, a file of samples,
// or the user's own noise as a function or as a program.
//
//   gnoise:seed=7                                a noise, a primitive, a texture
//   grain.exr:spacing=0.0625,channel=R           an image file
//   vol.raw:size=128x128x128,wrap=periodic       bare samples
//   ./mine.so:noise,seed=3                       a function in a shared object
//   cmd:./mine.py --octaves 3                    a program
//
// What ends in .so (or .so.1) before the first colon is a shared object, what begins with `cmd:` or
// `cmd,` a program, what ends in .raw bare samples. Else the word before the first colon is an
// image if it holds a '.' or a '/', or if a file of that name exists; the whole text is one if a
// file of exactly that name exists. Keys of an image:
//
//   channel=NAME|INDEX  which channel (default: the first; an index counts from 0)
//   spacing=REAL        units between pixels (default: the file's attribute "bandlimit:spacing",
//                       else 1, so that frequencies are in cycles per pixel)
//   part=INDEX          which part of a multi-part file, which is refused without it
//   memory=MIB          how much of the image is held in memory (default 1024); a larger image is
//                       read in blocks through a cache of that size
//   wrap=none|periodic|mirror       beyond the edge: NaN, the samples again, or their mirror image
//   interp=nearest|linear|catmull-rom  between the pixels: the nearest, linear, Catmull-Rom (C1)
//
// Values are those of the file: floats and halves as they are, integers divided by their full
// scale; no colour curve and no alpha is applied. Pixel (i, j), counted from the upper left corner
// of the data window, stands at (i, j) * spacing; a coordinate takes the nearest pixel, and NaN
// outside of the image, unless wrap and interp say otherwise. The whole image is read once while
// opening, so a truncated or corrupt file is refused there and not in the middle of a measurement.
//
// A grid is measured on its own samples, each once, whether it is wrapped or not: random places at
// another rate would alias. Only one that is wrapped and interpolated is a function like any other,
// measured at random places; its spectrum shows the interpolation too (sources/sampled_grid.h).
//
// Bare samples (.raw) stand x fastest, little-endian; size= and offset= must account for every byte
// of the file. Keys: size=WxHxD (one to four axes), dtype=float32|uint8|uint16, offset=BYTES, and
// spacing, wrap, interp, memory as above.
//
// A function follows include/bandlimit_plugin.h. Keys: seed=N (default 0) and dims=N (default: what
// the plugin states, else 3). What it states becomes the facts of the signal.
//
// A program follows sources/program.c: it is asked through its standard input and answers on its
// standard output, in little-endian doubles. Its words are split as by a shell (sources/command.h).
// Keys stand before the colon, as in `cmd,dims=2,seed=3,timeout=60:./mine {seed}`: dims (default
// 3), timeout (seconds without a byte, default 10) and seed, which stands where the words have
// {seed}; without it the signal has no seed. When the program fails, values are NaN and
// bl_signal_complaint tells why.
#ifndef BL_SOURCES_SOURCE_H
#define BL_SOURCES_SOURCE_H

#include "core/signal.h"
#include "noises/noise.h"
#include "sources/kind.h"

// Opens a signal; the caller frees it with bl_signal_free. Errors, each with a message:
// BL_USAGE for an unknown name, key, channel or function, a value out of range, and claims that
// cannot be; BL_DEVICE for a file that is missing, unreadable, a folder, empty, truncated or not
// what it should be, a program that does not answer, and without memory; BL_MISMATCH for an image
// that is not one plane of pixels, and for a raw file of another size. Safe from several threads,
// and so is reading the signal.
bl_status bl_source_open(const char *text, bl_isa isa, bl_signal **signal, bl_message *message);

// The same with a seed, as a part of the signal's text: the value of its key of the kind seed. Errors
// besides: BL_MISMATCH for a signal without a seed, BL_USAGE if the text names another.
bl_status bl_source_open_seeded(const char *text, uint64_t seed, bl_isa isa, bl_signal **signal,
                                bl_message *message);

// The text of a signal without its seed, which the caller frees; NULL if out of memory.
char *bl_source_text_unseeded(const bl_signal *signal);

// The source that a text names, by the rule above; NULL for a definition.
const bl_source *bl_source_of(const char *text);

// The definition of a noise, primitive or texture by name; NULL for an unknown one.
const bl_definition *bl_source_definition(const char *name, bl_isa isa);

#endif
