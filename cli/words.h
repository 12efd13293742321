// SPDX-License-Identifier: MIT
//
// Values of the command line that are more than one number: points, axes, ranges.
#ifndef BL_CLI_WORDS_H
#define BL_CLI_WORDS_H

#include "core/signal.h"
#include "core/status.h"

// Reads a coordinate: a finite number whose fraction within a cell is not lost, that is not beyond
// `far` (NAN: no limit). `where` says where it stands, for the message.
bl_status bl_read_coordinate(const char *word, double far, const char *where, double *out,
                             bl_message *message);

// Reads "A,B,..." into out[0..least-1 .. most-1]; the ones left out stay as they are.
bl_status bl_read_list(const char *option, const char *text, size_t least, size_t most, double far,
                       double *out, bl_message *message);

// Reads an axis: x, y, z, or a vector "DX,DY,DZ" that is not zero.
bl_status bl_read_axis(const char *option, const char *text, double out[3], bl_message *message);

// Reads "FROM:TO" with FROM < TO; TO may be inf where `open` is set.
bl_status bl_read_range(const char *option, const char *text, int open, double *from, double *to,
                        bl_message *message);

// Whether a path has this ending, in upper or lower case, and more before it.
int bl_ends_with(const char *path, const char *ending);

// The coordinate beyond which a signal has lost the fraction: what it states, at most 2^52.
double bl_signal_far(const bl_signal *signal);

#endif
