// SPDX-License-Identifier: MIT
//
// The picture of a filter: kernel and step over the distance, the response over the frequency.
#ifndef BL_REPORTS_FILTER_PLOT_H
#define BL_REPORTS_FILTER_PLOT_H

#include "core/status.h"
#include "filters/filter.h"

// Draws it to `path`, which ends in .svg or .png, by gnuplot in a temporary folder. Errors:
// BL_USAGE for another ending, BL_DEVICE.
bl_status bl_filter_plot(const bl_filter *filter, const char *path, bl_message *message);

#endif
