// SPDX-License-Identifier: MIT
//
// peachey-2.41: a picture, and the same looked up at perturbed coordinates.
#include <math.h>
#include <string.h>

#include "core/definition.h"
#include "reports/figures/estimates.h"
#include "reports/figures/pictures.h"
#include "textures/texture.h"

static void release_signal(void *signal) {
    bl_signal_free(signal);
}

// The texture `image` of the picture that stands in the folder of the figure. The path may hold
// what the grammar would split, so the setting is handed over as it is.
static const bl_signal *open_picture(bl_run *run, const char *amount) {
    const char *path =
        bl_run_text(run, "%s/peachey-2.41/original.exr", bl_run_settings(run)->folder);
    char path_key[] = "path", amount_key[] = "amount",
         name[] = "image"; // of a spec that owns nothing
    bl_setting settings[] = {{.key = path_key, .value = (char *)path},
                             {.key = amount_key, .value = (char *)amount}};
    const bl_spec spec = {.name = name, .settings = settings, .count = 2};
    bl_signal *signal = NULL;
    bl_run_must(run, bl_definition_open(bl_texture_find("image"), &spec, "image", NULL, &signal,
                                        bl_run_message(run)));
    return bl_run_keep(run, signal, release_signal);
}

// The root mean square of the shift along s, in units.
static bl_estimate shift_of(bl_run *run, const bl_signal *noise) {
    enum { BATCHES = 16 };
    bl_random random = bl_run_random(run, 241);
    size_t places = bl_run_count(run, 1000, 10000, 100000);
    double values[BATCHES];
    for (int b = 0; b < BATCHES; b++) {
        double sum = 0;
        for (size_t i = 0; i < places; i++) {
            double at[BL_AXES] = {0};
            for (int a = 0; a < 3; a++)
                at[a] = 1e4 * bl_random_unit(&random);
            double shift = 0.2 * bl_signal_value(noise, at);
            sum += shift * shift;
        }
        values[b] = sqrt(sum / (double)places);
    }
    return bl_mean_estimate(values, BATCHES, 0.95);
}

// The largest difference of an unperturbed lookup from the signal that the picture was drawn of, at
// the middles of texels, where nothing is interpolated.
static double lookup_error(const bl_signal *picture, const bl_signal *source, unsigned pixels) {
    double most = 0, got[3], expected[3];
    const double point[BL_AXES] = {0};
    for (unsigned j = 0; j < pixels; j += 5)
        for (unsigned i = 0; i < pixels; i += 3) {
            double x = (i + 0.5) / pixels, y = (j + 0.5) / pixels;
            bl_signal_colour(picture, (const double[BL_AXES]){x, y}, point, got);
            bl_signal_colour(source, (const double[BL_AXES]){x, y}, point, expected);
            for (int c = 0; c < 3; c++)
                most = fmax(most, fabs(got[c] - expected[c]));
        }
    return most;
}

static void run_figure(bl_run *run) {
    unsigned pixels = (unsigned)bl_run_pick(run, 128, 256, 1024);
    bl_signal *source = bl_run_signal(run, "checkerboard:size=1/8");
    const bl_shown first = {.key = "original", .title = "original", .signal = source};
    bl_pictures pictures = {.name = "original-alone",
                            .title = "The picture",
                            .alternative = "A checkerboard of 8 by 8 squares.",
                            .shown = &first,
                            .count = 1,
                            .columns = 2,
                            .at = {0.5, 0.5},
                            .scale = 1,
                            .pixels = pixels,
                            .unit = "units"};
    bl_pictures_draw(run, &pictures);
    const bl_signal *plain = open_picture(run, "0"), *moved = open_picture(run, "0.2");
    const bl_signal *noise = bl_run_signal(run, "gnoise");
    const bl_shown both[] = {
        {"lookup", "original, looked up", plain, .text = "image:path=original.exr,amount=0"},
        {"perturbed", "perturbed", moved, .text = "image:path=original.exr"}};
    pictures.name = "perturbed-pictures";
    pictures.title = NULL; // the question
    pictures.alternative = "A checkerboard, and the same with its lines bent into soft waves.";
    pictures.shown = both;
    pictures.count = 2;
    pictures.at[2] = 0.4;
    pictures.samples = 3;
    bl_pictures_draw(run, &pictures);
    double deviation = 0.2 * sqrt(noise->facts.variance);
    bl_make_claim(run, "peachey2003, Perturbed Image Textures",
                  "0.2 times a noise modifies the coordinates slightly: the root mean square of "
                  "the shift is what the noise's stated variance makes of it.",
                  "gnoise", "units", 0.98 * deviation, 1.02 * deviation, shift_of(run, noise),
                  "batches of places");
    bl_make_claim(run, "bandlimit",
                  "A lookup without perturbation gives back the picture: the largest difference at "
                  "the middles of texels.",
                  "linear colour", "", 0, 2e-5,
                  bl_observed(lookup_error(plain, source, pixels), pixels * pixels / 15.0),
                  "texels");
}

BL_FIGURE_DESCRIPTOR(peachey_2_41) = {
    .name = "peachey-2.41",
    .title = "A perturbed picture",
    .question = "What does a noise do to the coordinates of a picture?",
    .paper = "peachey2003, fig. 2.41",
    .shows =
        "A picture that is drawn into a file and read back by filtered lookups, and the same at "
        "coordinates that a gradient noise of 4 cells a unit moves by 0.2 times its value.",
    .run = run_figure};
