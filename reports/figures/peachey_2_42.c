// SPDX-License-Identifier: MIT
//
// peachey-2.42: wallpaper of stars, by both listings, printed and corrected.
#include <math.h>

#include "reports/figures/estimates.h"
#include "reports/figures/pictures.h"

// The share of the area of whole stars that a form gets wrong, over `cells` x `cells` cells; *where
// is a place that it gets wrong, of the most crowded one in its neighbourhood.
static double wrong_share(const bl_signal *form, const bl_signal *right, int cells, double where[2],
                          double *looked) {
    enum { PER_CELL = 25 };
    int side = cells * PER_CELL;
    double wrong = 0, all = 0;
    const double point[BL_AXES] = {0};
    for (int j = 0; j < side; j++)
        for (int i = 0; i < side; i++) {
            const double at[BL_AXES] = {0.1 * (i + 0.5) / PER_CELL, 0.1 * (j + 0.5) / PER_CELL};
            double a[3], b[3];
            bl_signal_colour(form, at, point, a);
            bl_signal_colour(right, at, point, b);
            all += b[0] > 0.5;
            if ((a[0] > 0.5) != (b[0] > 0.5)) {
                if (wrong == 0) {
                    where[0] = at[0];
                    where[1] = at[1];
                }
                wrong++;
            }
        }
    *looked = (double)side * side;
    return wrong / all;
}

static void run_figure(bl_run *run) {
    static const char *const texts[] = {"wallpaper", "wallpaper:form=printed",
                                        "wallpaper:cells=one"};
    static const char *const titles[] = {"corrected", "as printed", "one cell"};
    static const char *const keys[] = {"corrected", "printed", "one-cell"};
    bl_signal *paper[3];
    bl_shown shown[6];
    double where[2] = {0.5, 0.5}, looked = 0, wrong = 0;
    bl_run_signals(run, texts, 3, paper);
    wrong = wrong_share(paper[1], paper[0], (int)bl_run_pick(run, 12, 48, 256), where, &looked);
    for (int i = 0; i < 6; i++)
        shown[i] =
            (bl_shown){.key = bl_run_text(run, "%s%s", keys[i % 3], i < 3 ? "" : "-near"),
                       .title = bl_run_text(run, "%s%s", titles[i % 3], i < 3 ? "" : ", near by"),
                       .signal = paper[i % 3],
                       .at = {where[0], where[1]},
                       .scale = i < 3 ? 0 : 0.12};
    const bl_pictures pictures = {
        .name = "wallpapers",
        .alternative =
            "Orange stars strewn over blue paper. Seen close, a star of the printed form ends at a "
            "straight line, and one of the single-cell form is cut in half.",
        .shown = shown,
        .count = 6,
        .columns = 3,
        .at = {0.5, 0.5},
        .scale = 1,
        .samples = 2,
        .pixels = (unsigned)bl_run_pick(run, 128, 320, 1024),
        .unit = "pictures of 1 and 0.12 units"};
    bl_pictures_draw(run, &pictures);
    bl_make_claim(run, "peachey2003, Random Placement Patterns",
                  "With the tests of the eight cells around, stars that cross an edge are rendered "
                  "correctly: the share of the stars' area that the printed listing gets wrong.",
                  "against the listing with the presence of the visited cell", "of the area", 0,
                  1e-9, bl_exactly(wrong, looked), "points");
}

BL_FIGURE_DESCRIPTOR(peachey_2_42) = {
    .name = "peachey-2.42",
    .title = "Random placement wallpaper",
    .question = "Which listing cuts its stars?",
    .paper = "peachey2003, fig. 2.42",
    .shows =
        "Stars at random places: with the presence of each visited cell; as printed, where the "
        "column of the centre cell decides; and by the first listing, where each cell has its star "
        "and sees no other. Below, a place where the printed listing is wrong.",
    .run = run_figure};
