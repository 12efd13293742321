// SPDX-License-Identifier: MIT
//
// What `show` says of a filter: its numbers, a table and a plot of kernel, step and response.
#ifndef BL_CLI_SHOW_FILTER_H
#define BL_CLI_SHOW_FILTER_H

#include "cli/verb.h"
#include "filters/filter.h"

// Prints the filter to call->out or fills call->json; with `plot`, a path that ends in .svg or
// .png, its picture is written there. Errors: BL_USAGE for another ending, BL_DEVICE.
bl_status bl_show_filter(bl_call *call, const bl_filter *filter, const char *plot);

#endif
