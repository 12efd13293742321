// SPDX-License-Identifier: MIT
//
// peachey-2.27: the star, corrected and as printed.
#include <math.h>

#include "reports/figures/estimates.h"
#include "reports/figures/pictures.h"

// The area of the star: the box averages of a lattice of cells, which leave nothing out, or points
// where there is no average; with a bound of its error from the cells that an edge may cross.
static bl_estimate area_of(const bl_signal *signal, int exact, int side) {
    double sum = 0, rgb[3], wide = exact ? 1.0 / side : 0;
    const double width[BL_AXES] = {wide, wide};
    for (int j = 0; j < side; j++)
        for (int i = 0; i < side; i++) {
            const double at[BL_AXES] = {(i + 0.5) / side, (j + 0.5) / side};
            bl_signal_colour(signal, at, width, rgb);
            sum += (rgb[0] - 0.05) / 0.95; // red of the field and of the star
        }
    double area = sum / side / side;
    // Ten edges of at most 0.15 units, each through 2 * 0.15 side cells at most, half a cell wrong.
    double error = exact ? 1e-12 : 10 * 0.15 / side;
    return (bl_estimate){area, area - error, area + error, 1, (double)side * side};
}

static void run_figure(bl_run *run) {
    const bl_signal *corrected = bl_run_signal(run, "star");
    const bl_signal *printed = bl_run_signal(run, "star:form=printed");
    const bl_signal *exact = bl_run_signal(run, "star:filter=exact");
    const bl_shown shown[] = {
        {.key = "corrected", .title = "corrected", .signal = corrected},
        {.key = "printed", .title = "as printed", .signal = printed},
        {"exact", "corrected, few pixels", .signal = exact, .pixels = 32, .filtered = 1}};
    const bl_pictures pictures = {
        .name = "stars",
        .alternative =
            "A five-pointed star with straight edges; the same with fatter points and shallow "
            "notches, as printed; and the star at 32 by 32 pixels.",
        .shown = shown,
        .count = 3,
        .columns = 3,
        .at = {0.5, 0.5},
        .scale = 0.5,
        .samples = 4,
        .pixels = 32 * (unsigned)bl_run_pick(run, 6, 12, 32),
        .unit = "pictures of half a unit"};
    bl_pictures_draw(run, &pictures);
    static const char source[] = "peachey2003, Example: Procedural Star Texture";
    static const char sentence[] =
        "Edges run straight from tips at 0.2 to notches at 0.07: the area is 5 * 0.2 * 0.07 sin 36 "
        "degrees = 0.041145.";
    int side = (int)bl_run_pick(run, 1000, 3000, 10000);
    double area = 5 * 0.2 * 0.07 * sin(M_PI / 5), allowed = 2e-3;
    bl_make_claim(run, source, sentence, "corrected, areas of 100 x 100 cells", "square units",
                  area - 1e-9, area + 1e-9, area_of(exact, 1, 100), "cells");
    bl_make_claim(run, source, sentence, "as printed, points", "square units", area - allowed,
                  area + allowed, area_of(printed, 0, side), "points");
}

BL_FIGURE_DESCRIPTOR(peachey_2_27) = {
    .name = "peachey-2.27",
    .title = "The star texture",
    .question = "Does the listing draw a star?",
    .paper = "peachey2003, fig. 2.27",
    .shows =
        "The star of the text with the right angle; as printed, where the fraction of a point is "
        "taken for an angle in radians; and the exact area of the star in each of few pixels.",
    .run = run_figure};
