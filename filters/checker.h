// SPDX-License-Identifier: MIT
//
// The average of a checkerboard of unit squares.
#ifndef BL_FILTERS_CHECKER_H
#define BL_FILTERS_CHECKER_H

#include "filters/filter.h"

// The checkerboard that is 1 where floor(x) + floor(y) is even and 0 elsewhere, averaged by the
// filter along each axis over samples of width[0] by width[1] about (x, y). Width 0 is a point,
// infinity the mean 1/2. Exact for every filter, since the board is a product of two square waves
// (1 + p(x) p(y)) / 2: within 1e-14, in a time that does not grow with the widths. NaN and infinite
// places give NaN. Pure; source: peachey2003, p. 68.
double bl_checker_average(const bl_filter *filter, double x, double y, const double width[2]);

#endif
