// SPDX-License-Identifier: MIT
//
// alias-blur: what methods of sampling leave of the alias and what they cost in blur, on three
// textures.
#include <math.h>
#include <string.h>

#include "aliasing/energy.h"
#include "reports/figures/estimates.h"
#include "reports/measure.h"
#include "textures/texture.h"

enum { OWN, POINT, REGULAR, RANDOM, KINDS };
enum { METHODS_MOST = 12, DRAWN = 3, SINE = 3, SUBJECTS = 4, SHOWN = 4 };
static const char *const kind_names[] = {"own_db", "point_db", "regular_db", "random_db"};
static const char *const kind_labels[] = {"the texture's own filters", "point sampling",
                                          "regular supersamples", "random supersamples"};
static const bl_ink kind_inks[] = {BL_INK_MEASURED, BL_INK_THEORY, BL_INK_SECOND, BL_INK_THIRD};

typedef struct way {
    const char *method, *word; // as it is opened, and as it is drawn
    int kind;
} way;

// What all textures are sampled by; the filters of their own stand before these.
#define COMMON                                                                                     \
    {"point", "point", POINT}, {"supersample:n=4", "4 x 4", REGULAR}, {                            \
        "supersample:n=4,pattern=jitter", "jittered", RANDOM                                       \
    }
#define MORE                                                                                       \
    {"supersample:n=2", "2 x 2", REGULAR}, {"supersample:n=4,pattern=sobol", "Sobol", RANDOM},     \
        {"supersample:n=2,pixel=tent", "tent", REGULAR}, {                                         \
        "supersample:n=2,pixel=mitchell", "Mitchell", REGULAR                                      \
    }

typedef struct subject {
    const char *key, *title;
    const char *text; // NULL: depends on the size of the image
    way ways[METHODS_MOST];
    const char *shown[SHOWN]; // of the pictures; NULL: none
} subject;

static const subject subjects[SUBJECTS] = {
    {"brick",
     "brick, turned by 20 degrees, mortar a third of a pixel thick",
     "brick",
     {{"boxstep", "boxstep", OWN},
      {"smoothstep", "smoothstep", OWN},
      {"integral", "integral", OWN},
      {"exact", "exact box", OWN},
      COMMON,
      MORE},
     {"point", "supersample:n=4", "supersample:n=4,pattern=jitter", "exact"}},
    {"zone-plate",
     "zone plate, up to 2 cycles per pixel",
     NULL,
     {{"fade", "fade", OWN}, {"gaussian", "Gaussian", OWN}, {"exact", "exact box", OWN}, COMMON},
     {"point", "supersample:n=4", "supersample:n=4,pattern=jitter", "exact"}},
    {"turbulence",
     "turbulence, octaves of 1/6 to 4/3 cycles per pixel",
     "turbulence:min=1,max=16",
     {{"hard", "clamped", OWN},
      {"fade", "faded", OWN},
      {"point", "point", POINT},
      {"supersample:n=2", "2 x 2", REGULAR},
      {"supersample:n=4", "4 x 4", REGULAR}},
     {NULL}},
    // Just above 4 cycles per pixel, where 4 x 4 samples see next to nothing move.
    {"sine",
     "sine of 4.1 cycles per pixel",
     "sinesum:min=4.1,max=5",
     {{"exact", "exact box", OWN}, COMMON},
     {"point", "supersample:n=4", "supersample:n=4,pattern=jitter", "exact"}}};

// The least that is drawn, in dB of the alias of point samples; what has less stands there.
enum { LEAST_BLUR = -30, LEAST_ALIAS = -34 };

static size_t way_count(const subject *s) {
    size_t count = 0;
    while (count < METHODS_MOST && s->ways[count].method)
        count++;
    return count;
}

static const bl_alias_row *row_of(const subject *s, const bl_alias_result *m, const char *method) {
    for (size_t i = 0; i < way_count(s); i++)
        if (s->ways[i].method == method || !strcmp(s->ways[i].method, method))
            return &m->rows[i];
    return NULL;
}

// A chirp that takes an image of any size to 2 cycles per pixel at the middle of an edge.
static const char *text_of(bl_run *run, int n, size_t pixels) {
    return n == 1 ? bl_run_text(run, "zoneplate:chirp=%zu", pixels) : subjects[n].text;
}

// Pixels of one size, whatever their number.
static const char *view_of(bl_run *run, int n, size_t pixels) {
    static const double pixels_a_unit[SUBJECTS] = {32, 0, 6, 1};
    return n == 1 ? "flat:scale=2"
                  : bl_run_text(run, n == 0 ? "flat:scale=%g,rotate=20" : "flat:scale=%g",
                                (double)pixels / pixels_a_unit[n]);
}

static const bl_alias_result *measure(bl_run *run, int n) {
    const subject *s = &subjects[n];
    const size_t pixels = bl_run_count(run, 32, 64, 128);
    const char *methods[METHODS_MOST];
    const bl_alias_settings settings =
        bl_run_alias_settings(run, bl_run_pick(run, 2, 3, 16), bl_run_pick(run, 32, 128, 1024));
    const bl_signal *signal = bl_run_signal(run, text_of(run, n, pixels));
    const bl_view *view = bl_run_view(run, view_of(run, n, pixels), pixels, pixels);
    for (size_t i = 0; i < way_count(s); i++)
        methods[i] = s->ways[i].method;
    bl_run_setting(run, s->key, signal->text);
    bl_run_setting(run, bl_run_text(run, "view of %s", s->key), view->text);
    bl_run_step(run, s->key);
    return bl_run_alias(run, signal, view, methods, way_count(s), &settings);
}

// --- the plot of alias against blur --------------------------------------------------------------

typedef struct entry {
    const char *method, *word;
    bl_estimate alias;
    double blur, mse, samples, of_kind[KINDS], alias_db, blur_db;
} entry;

#define AT(kind, member) NULL, BL_CELL_##kind, .offset = offsetof(entry, member)
static const bl_field fields[] = {{"filter", AT(WORD, method)},
                                  {"word", AT(WORD, word)},
                                  {"blur", AT(REAL, blur)},
                                  {"alias", AT(ESTIMATE, alias)},
                                  {"mse", AT(REAL, mse)},
                                  {"samples_a_pixel", AT(REAL, samples)},
                                  {"own_db", AT(REAL, of_kind[OWN])},
                                  {"point_db", AT(REAL, of_kind[POINT])},
                                  {"regular_db", AT(REAL, of_kind[REGULAR])},
                                  {"random_db", AT(REAL, of_kind[RANDOM])},
                                  {"alias_db", AT(REAL, alias_db)},
                                  {"blur_db", AT(REAL, blur_db)},
                                  {0}};
#undef AT

static void write_rows(bl_run *run, const subject *s, const bl_alias_result *m) {
    entry rows[METHODS_MOST];
    const double unit = row_of(s, m, "point")->alias.value;
    for (size_t i = 0; i < way_count(s); i++) {
        const bl_alias_row *r = &m->rows[i];
        rows[i] = (entry){r->method,
                          s->ways[i].word,
                          r->alias,
                          r->blur.value,
                          r->mse.value,
                          r->samples,
                          {NAN, NAN, NAN, NAN},
                          fmax(10 * log10(r->alias.value / unit), LEAST_ALIAS),
                          fmax(10 * log10(r->blur.value / unit), LEAST_BLUR)};
        rows[i].of_kind[s->ways[i].kind] = rows[i].alias_db;
    }
    const bl_table table = {fields, rows, way_count(s), sizeof *rows, .level = 0.95};
    bl_run_table(run, s->key,
                 "alias and blur of each method, squares of the value, and dB of the alias of "
                 "point samples",
                 &table);
}

static void draw_rows(bl_run *run) {
    bl_series series[DRAWN][KINDS + 1];
    bl_panel panels[DRAWN];
    for (int n = 0; n < DRAWN; n++) {
        const char *file = bl_run_text(run, "%s.csv", subjects[n].key);
        for (int k = 0; k < KINDS; k++)
            series[n][k] = (bl_series){BL_STROKE_POINTS, kind_inks[k], file,           "blur_db",
                                       kind_names[k],    NULL,         kind_labels[k], 0};
        series[n][KINDS] = (bl_series){BL_STROKE_WORDS, BL_INK_PLAIN, file, "blur_db",
                                       "alias_db",      "word",       NULL, 0};
        panels[n] =
            (bl_panel){.title = subjects[n].title, .series = series[n], .series_count = KINDS + 1};
    }
    const bl_plot plot = {.x = {"blur, dB of the alias of point samples", LEAST_BLUR, 5, 5, 0},
                          .y = {"alias, dB of that of point samples", -35, 5, 5, 0},
                          .panels = panels,
                          .panel_count = DRAWN,
                          .aspect = 0.5};
    bl_run_plot(run, "alias-blur", &plot,
                "Three panels of named dots, alias upwards and blur to the right: point sampling "
                "stands on top, the textures' own filters below.");
}

// --- pictures ------------------------------------------------------------------------------------

static const char *draw_picture(bl_run *run, const char *key, const bl_alias_row *row,
                                size_t pixels) {
    float *values = bl_run_memory(run, 3 * pixels * pixels, sizeof *values);
    for (size_t i = 0; i < 3 * pixels * pixels; i++)
        values[i] = (float)row->image[i];
    return bl_run_image(run, key,
                        &(bl_image){.width = pixels,
                                    .height = pixels,
                                    .channels = 3,
                                    .values = values,
                                    .spacing = 1,
                                    .white = 1,
                                    .srgb = 1});
}

static void draw_pictures(bl_run *run, const bl_alias_result *const *all) {
    bl_panel panels[SUBJECTS * SHOWN];
    size_t count = 0, pixels = all[0]->reference.width;
    for (int n = 0; n < SUBJECTS; n++)
        for (int k = 0; k < SHOWN && subjects[n].shown[k]; k++) {
            const bl_alias_row *row = row_of(&subjects[n], all[n], subjects[n].shown[k]);
            const char *key = bl_run_text(run, "%s-%d", subjects[n].key, k + 1);
            panels[count++] = (bl_panel){.title = subjects[n].ways[row - all[n]->rows].word,
                                         .image = draw_picture(run, key, row, pixels)};
        }
    const bl_plot plot = {.title = "What is left to see?",
                          .x = {"pixels", 0, (double)pixels, (double)pixels / 2},
                          .y = {"pixels", (double)pixels, 0, (double)pixels / 2},
                          .panels = panels,
                          .panel_count = count,
                          .columns = SHOWN,
                          .aspect = 1,
                          .coloured = 1,
                          .pixel = 1};
    bl_run_plot(run, "pictures", &plot,
                "A brick wall, a zone plate and a sine. Point samples show false patterns, "
                "supersamples fainter ones, jittered samples noise, and filtered ones none.");
}

// --- the largest single frequency of the error ---------------------------------------------------

typedef struct error_image {
    const bl_alias_row *row;
    const bl_reference *reference;
} error_image;

static void fill_errors(const void *user, const double *x, const double *y, size_t count,
                        double *out) {
    const error_image *e = user;
    for (size_t i = 0; i < count; i++) { // places are centres of pixels
        size_t p = 3 * ((size_t)y[i] * e->reference->width + (size_t)x[i]);
        out[i] = bl_colour_component(e->row->image + p, 0) -
                 bl_colour_component(e->reference->rgb + p, 0);
    }
}

typedef struct error_lines {
    double energy, largest; // mean square of the error, and the part of one frequency in it
} error_lines;

static error_lines measure_lines(bl_run *run, const bl_alias_result *m, const bl_alias_row *row) {
    const bl_reference *reference = &m->reference;
    const error_image image = {row, reference};
    error_lines lines = {0, 0};
    bl_image_spectrum spectrum;
    bl_run_must(run,
                bl_image_spectrum_take(fill_errors, &image, reference->width, reference->height, 1,
                                       (const double[2]){0.5, 0.5}, (const double[2]){0, 0}, 0, 1,
                                       &spectrum, bl_run_message(run)));
    size_t half = reference->width / 2 + 1;
    for (size_t k = 0; k < half * reference->height; k++) {
        const double *c = spectrum.coefficient + 2 * k;
        int twice = k % half && k % half != half - 1;
        double energy = (1 + twice) * (c[0] * c[0] + c[1] * c[1]);
        lines.energy += energy;
        lines.largest = fmax(lines.largest, energy);
    }
    bl_image_spectrum_free(&spectrum);
    return lines;
}

static void claim_lines(bl_run *run, int n, const bl_alias_result *m) {
    const subject *s = &subjects[n];
    const error_lines regular = measure_lines(run, m, row_of(s, m, "supersample:n=4"));
    const error_lines jittered =
        measure_lines(run, m, row_of(s, m, "supersample:n=4,pattern=jitter"));
    double energy = 10 * log10(jittered.energy / regular.energy);
    double share = 10 * log10(jittered.largest / regular.largest) - energy;
    double pixels = (double)(m->reference.width * m->reference.height);
    const char *reading =
        bl_run_text(run, "%s, 4 x 4 samples, jittered over regular", subjects[n].key);
    bl_make_claim(run, "peachey2003, Methods of Antialiasing Procedural Textures",
                  "Irregular samples turn the structured alias into noise: the share of the "
                  "largest single frequency in the error falls.",
                  reading, "dB", -INFINITY, 0, bl_observed(share, pixels), "pixels");
    bl_make_claim(run, "peachey2003, Methods of Antialiasing Procedural Textures",
                  "Irregular samples turn aliases into noise but cannot remove them: the error "
                  "keeps at least a hundredth of its energy.",
                  reading, "dB", -20, INFINITY, bl_observed(energy, pixels), "pixels");
    if (n != SINE)
        return;
    // Regular places see the sine stand still and keep 0.968 of its energy (their response squared
    // at 4.1 cycles per pixel); 16 irregular ones are as many independent values of it, and their
    // mean has 1/16: -11.9 dB. The energy is a sum over some 400 pixels or more, good to 0.3 dB.
    bl_make_claim(run, "bandlimit",
                  "Noise is less than the alias it replaces: n samples a pixel spread it over n "
                  "times the band, and 1/n of its energy is left.",
                  reading, "dB", -13.4, -10.4, bl_observed(energy, pixels), "pixels");
}

// --- claims --------------------------------------------------------------------------------------

static void claim_ratio(bl_run *run, const char *source, const char *sentence, int n,
                        const bl_alias_result *const *all, const char *a, const char *b,
                        double upper) {
    const bl_alias_row *above = row_of(&subjects[n], all[n], a);
    const bl_alias_row *below = row_of(&subjects[n], all[n], b);
    bl_make_claim(run, source, sentence,
                  bl_run_text(run, "%s: alias of %s over that of %s", subjects[n].key, a, b), "dB",
                  -INFINITY, upper, bl_ratio_db(above->alias, below->alias),
                  "random shifts of the pixels");
}

static void claim_all(bl_run *run, const bl_alias_result *const *all) {
    static const char *const section = "peachey2003, Methods of Antialiasing Procedural Textures";
    claim_ratio(run, "peachey2003, Example: Antialiased Brick Texture",
                "The integral takes the alias of a brick wall away: at least nine tenths.", 0, all,
                "integral", "point", -10);
    for (int n = 0; n < DRAWN; n++)
        claim_ratio(
            run, section,
            "Supersamples take away the alias from frequencies below their own Nyquist limit.", n,
            all, "supersample:n=4", "point", 0);
    claim_ratio(run, section,
                "Filtering before sampling is better than random supersamples: less alias.", 0, all,
                "exact", "supersample:n=4,pattern=jitter", 0);
    claim_ratio(run, section,
                "Filtering before sampling is better than random supersamples: less alias.", 1, all,
                "exact", "supersample:n=4,pattern=jitter", 0);
    claim_ratio(run, "peachey2003, Clamping",
                "Clamping takes alias away from a sum of noises, too, if less than from sines.", 2,
                all, "fade", "point", 0);
    claim_ratio(run, "bandlimit",
                "A Gaussian of the same width lets less alias through than a box, whose response "
                "falls slowly.",
                1, all, "gaussian", "exact", 0);
    claim_lines(run, 0, all[0]);
    claim_lines(run, SINE, all[SINE]);
}

static void run_figure(bl_run *run) {
    const bl_alias_result *all[SUBJECTS];
    for (int n = 0; n < SUBJECTS; n++)
        all[n] = measure(run, n);
    for (int n = 0; n < SUBJECTS; n++)
        write_rows(run, &subjects[n], all[n]);
    draw_rows(run);
    draw_pictures(run, all);
    claim_all(run, all);
}

BL_FIGURE_DESCRIPTOR(alias_blur) = {
    .name = "alias-blur",
    .title = "Alias and blur of methods",
    .question = "How much alias and how much blur does each method leave?",
    .paper = "peachey2003, Methods of Antialiasing Procedural Textures",
    .shows =
        "Each method of sampling a brick wall, a zone plate and a turbulence: the energy that "
        "folds into the picture (alias) against the energy that is missing or wrong within it "
        "(blur). The best stands at the lower left. A box that is a pixel wide is no ideal filter: "
        "it blurs, and leaves some alias. Tent and Mitchell weight 2 x 2 samples a pixel; jittered "
        "and Sobol are 4 x 4 irregular ones. The pictures show it, also for a sine that is too "
        "fine for 4 x 4 samples.",
    .run = run_figure};
