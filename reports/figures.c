// SPDX-License-Identifier: MIT
//
// The list of all figures.
#include "reports/figure.h"

#define BL_FIGURE(stem) extern const bl_figure bl_figure_##stem;
#include "reports/figures.def"
#undef BL_FIGURE

static const void *const list[] = {
#define BL_FIGURE(stem) &bl_figure_##stem,
#include "reports/figures.def"
#undef BL_FIGURE
};

const bl_registry bl_figures = {"figure", "figures", list, sizeof list / sizeof *list};
