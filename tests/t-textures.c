// SPDX-License-Identifier: MIT
//
// Textures: what all of the registry promise, and the filters of some against averages that are
// taken by brute force, by additivity, and in closed form. What the text's own forms get wrong is
// held as a number.
#include "tests/temporary.h"
#include "tests/test.h"

#include "core/random.h"
#include "filters/filter.h"
#include "noises/noise.h"
#include "core/image.h"
#include "sources/source.h"
#include "core/setting.h"
#include "textures/colour_spline.h"
#include "textures/texture.h"
#include "tests/sources.h"

static bl_signal *open_with(const char *name, const char *key, const char *word) {
    char text[160];
    snprintf(text, sizeof text, "%s:%s=%s", name, key, word);
    return bl_test_open_source(text);
}

static double seen(const bl_signal *signal, double s, double t, double width_s, double width_t) {
    return bl_signal_filtered(signal, (const double[BL_AXES]){s, t},
                              (const double[BL_AXES]){width_s, width_t, width_s, width_s});
}

// A place that shows the texture, within two pictures' width of the middle of its own.
static void draw_place(const bl_signal *signal, bl_random *random, double at[BL_AXES]) {
    const bl_picture *picture = &signal->definition->picture;
    for (int a = 0; a < BL_AXES; a++)
        at[a] = picture->at[a] + 4 * picture->scale * (bl_random_unit(random) - 0.5);
}

static void draw_width(const bl_signal *signal, bl_random *random, double width[BL_AXES]) {
    for (int a = 0; a < BL_AXES; a++) {
        double size = exp2(-12 * bl_random_unit(random));
        width[a] = bl_random_unit(random) < 0.1 ? 0 : signal->definition->picture.scale * size;
    }
}

// --- what all of them promise -------------------------------------------------------------------

typedef void check_one(const bl_signal *raw, const bl_signal *filtered, const char *word);

// Every texture, with every word of its key `filter`.
static void walk(check_one *check) {
    for (size_t i = 0; i < bl_texture_count(); i++) {
        const char *name = bl_texture_at(i)->name;
        bl_signal *raw = bl_test_open_source(name);
        const char *const *words = bl_signal_choices(raw, "filter");
        assert_non_null(words);
        assert_string_equal(words[0], "none");
        for (; *words; words++) {
            bl_signal *filtered = open_with(name, "filter", *words);
            check(raw, filtered, *words);
            bl_signal_free(filtered);
        }
        bl_signal_free(raw);
    }
}

// Lookups of pictures are in float, where another level of a pyramid is another sum.
static double rounding_of(const bl_signal *signal) {
    return strcmp(signal->name, "image") == 0 ? 1e-6 : 0;
}

static void check_no_width(const bl_signal *raw, const bl_signal *filtered, const char *word) {
    static const double none[BL_AXES] = {0};
    bl_random random = bl_random_seed(1, 0);
    for (int i = 0; i < 200; i++) {
        double at[BL_AXES], point[3], colour[3];
        draw_place(raw, &random, at);
        bl_signal_colour(raw, at, none, point);
        bl_signal_colour(filtered, at, none, colour);
        for (int c = 0; c < 3; c++)
            if (!(fabs(point[c] - colour[c]) <= rounding_of(raw)))
                fail_msg("%s filter=%s at %g,%g: %.17g, raw %.17g", raw->name, word, at[0], at[1],
                         colour[c], point[c]);
    }
}

static void test_width_0_is_the_raw_form(void **state) {
    (void)state;
    walk(check_no_width);
}

static void check_bounds(const bl_signal *raw, const bl_signal *filtered, const char *word) {
    bl_random random = bl_random_seed(2, 0);
    for (int i = 0; i < 1000; i++) {
        double at[BL_AXES], width[BL_AXES], rgb[3];
        draw_place(raw, &random, at);
        draw_width(raw, &random, width);
        bl_signal_colour(filtered, at, width, rgb);
        for (int c = 0; c < 3; c++)
            if (!(rgb[c] >= -1e-6 && rgb[c] <= 1 + 1e-6))
                fail_msg("%s filter=%s at %g,%g width %g,%g: colour %d is %g", raw->name, word,
                         at[0], at[1], width[0], width[1], c, rgb[c]);
        double value = bl_signal_filtered(filtered, at, width);
        if (!(value >= filtered->facts.lower && value <= filtered->facts.upper))
            fail_msg("%s filter=%s at %g,%g width %g,%g: %.17g beyond [%.17g, %.17g]", raw->name,
                     word, at[0], at[1], width[0], width[1], value, filtered->facts.lower,
                     filtered->facts.upper);
    }
}

static void test_colours_stay_within_their_bounds(void **state) {
    (void)state;
    walk(check_bounds);
}

static void expect_colour(const bl_signal *signal, const double at[BL_AXES],
                          const double width[BL_AXES], int is_number) {
    double rgb[3];
    bl_signal_colour(signal, at, width, rgb);
    for (int c = 0; c < 3; c++)
        if (isfinite(rgb[c]) != is_number || (!is_number && !isnan(rgb[c])))
            fail_msg("%s at %g,%g,%g width %g: %g", signal->text, at[0], at[1], at[2], width[0],
                     rgb[c]);
}

static void check_places(const bl_signal *raw, const bl_signal *filtered, const char *word) {
    static const double wrong[] = {NAN, INFINITY, -INFINITY, 0x1p63, -1e300};
    const double none[BL_AXES] = {0}, some[BL_AXES] = {0.3, 0.2, 0.1, 0.1};
    const double all[BL_AXES] = {INFINITY, INFINITY, INFINITY, INFINITY};
    (void)word;
    for (unsigned a = 0; a < raw->dimensions; a++)
        for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
            double at[BL_AXES] = {0.3, 0.4, 0.5, 0.6};
            at[a] = wrong[i];
            expect_colour(filtered, at, none, 0);
            expect_colour(filtered, at, some, 0);
            expect_colour(filtered, at, all, 0);
        }
    expect_colour(filtered, (const double[BL_AXES]){1e9, -1e9, 1e9}, some, 1);
    expect_colour(filtered, (const double[BL_AXES]){1e9, -1e9, 1e9}, none, 1);
}

static void test_nan_infinite_and_huge_places_give_nan(void **state) {
    (void)state;
    walk(check_places);
}

static void test_components_are_those_of_the_colour(void **state) {
    (void)state;
    for (size_t i = 0; i < bl_texture_count(); i++) {
        const char *name = bl_texture_at(i)->name;
        for (uint32_t c = 0; bl_colour_components[c]; c++) {
            bl_random random = bl_random_seed(3, c);
            bl_signal *signal = open_with(name, "width=0.01,component", bl_colour_components[c]);
            for (int k = 0; k < 50; k++) {
                const double width[BL_AXES] = {0.01, 0.01, 0.01, 0.01};
                double at[BL_AXES], rgb[3];
                draw_place(signal, &random, at);
                bl_signal_colour(signal, at, width, rgb);
                double expected =
                    c ? rgb[c - 1] : 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
                assert_near(bl_signal_value(signal, at), expected, 1e-15);
            }
            bl_signal_free(signal);
        }
    }
}

static double difference(const bl_signal *a, const bl_signal *b) {
    bl_random random = bl_random_seed(4, 0);
    double most = 0;
    for (int k = 0; k < 300; k++) {
        double at[BL_AXES];
        draw_place(a, &random, at);
        most = fmax(most, fabs(bl_signal_value(a, at) - bl_signal_value(b, at)));
    }
    return most;
}

static void check_copies(const bl_signal *raw, const bl_signal *filtered, const char *word) {
    (void)word;
    bl_signal *copy = bl_signal_copy(filtered), *chosen = NULL;
    assert_non_null(copy);
    assert_true(difference(copy, filtered) == 0);
    bl_signal_free(copy);
    bl_message message;
    assert_int_equal(bl_signal_with_setting(raw, "filter", word, &chosen, &message), BL_OK);
    assert_true(difference(chosen, filtered) == 0);
    bl_signal_free(chosen);
    if (raw->seed_offset == SIZE_MAX)
        return;
    bl_signal *other = bl_signal_reseed(filtered, 77), *again = bl_signal_reseed(filtered, 0);
    assert_non_null(other);
    assert_true(difference(again, filtered) == 0);
    if (!(difference(other, filtered) > 1e-3) && strcmp(word, "mean") != 0)
        fail_msg("%s: another seed is the same texture", filtered->text);
    bl_signal_free(again);
    bl_signal_free(other);
}

static void test_copies_are_the_same_and_other_seeds_are_not(void **state) {
    (void)state;
    walk(check_copies);
}

static void check_period(const bl_signal *raw, const bl_signal *filtered, const char *word) {
    bl_random random = bl_random_seed(5, 0);
    for (unsigned a = 0; a < raw->dimensions; a++) {
        double period = filtered->facts.period[a];
        for (int k = 0; k < 200 && period > 0; k++) {
            double at[BL_AXES], width[BL_AXES];
            draw_place(raw, &random, at);
            draw_width(raw, &random, width);
            double here = bl_signal_filtered(filtered, at, width);
            at[a] += period;
            // Places of some units round to 1e-15 of them, which a slope of a thousand multiplies;
            // cloudplane's period is no double; an edge may fall between.
            if (k < 3 && fabs(bl_signal_filtered(filtered, at, width) - here) > 1e-5)
                fail_msg("%s filter=%s: %.17g is no period", raw->name, word, period);
        }
    }
}

static void test_periods_are_periods(void **state) {
    (void)state;
    walk(check_period);
}

// --- means --------------------------------------------------------------------------------------

// The mean over places of a lattice with a random shift, `side` x `side` over `span` units, about
// the middle of the texture's picture, and the standard error as if they were independent, which
// for places spread so is an upper bound.
static double sampled_mean(const bl_signal *signal, double span, int side, double *error) {
    bl_random random = bl_random_seed(6, 0);
    double sum = 0, squares = 0, n = (double)side * side;
    for (int j = 0; j < side; j++)
        for (int i = 0; i < side; i++) {
            double at[BL_AXES] = {span * ((i + bl_random_unit(&random)) / side - 0.5),
                                  span * ((j + bl_random_unit(&random)) / side - 0.5),
                                  span * (bl_random_unit(&random) - 0.5)};
            double value = bl_signal_value(signal, at);
            sum += value;
            squares += value * value;
        }
    *error = sqrt(fmax(squares / n - sum / n * (sum / n), 0) / n);
    return sum / n;
}

static void test_infinite_width_is_the_mean(void **state) {
    // Places span many periods or rings; the star's is the plane's, seen from far away. The last
    // number is the error that the heads of the files allow what has no closed form.
    static const struct {
        const char *name;
        double span, allowed;
    } cases[] = {{"brick", 1040, 0},         {"perturbedbrick", 1040, 0},
                 {"bumpbrick", 1040, 2e-4},  {"checkerboard", 64, 0},
                 {"star", 400, 0},           {"wallpaper", 40, 2e-3},
                 {"cloudplane", 1000, 2e-3}, {"marble", 200, 4e-3},
                 {"wood", 200, 1e-3},        {"zoneplate", 4, 2e-2},
                 {"sinesum", 64, 0},         {"image:amount=0", 16, 0}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = bl_test_open_source(cases[i].name);
        double error, mean = sampled_mean(signal, cases[i].span, 400, &error);
        double stated = seen(signal, 0.2, 0.3, INFINITY, INFINITY);
        print_message("  %s: %.6f at infinite width, %.6f +- %.6f sampled\n", cases[i].name, stated,
                      mean, error);
        // 13 tests at five standard errors: one in 10^5 fails by chance.
        assert_near(stated, mean, 5 * error + cases[i].allowed + 1e-12);
        if (isfinite(signal->facts.mean))
            assert_near(signal->facts.mean, stated, 1e-6);
        bl_signal_free(signal);
    }
}

static void check_all(const bl_signal *raw, const bl_signal *filtered, const char *word) {
    double expected = seen(raw, 0.2, 0.3, INFINITY, INFINITY);
    (void)word;
    assert_near(seen(filtered, 0.2, 0.3, INFINITY, INFINITY), expected, 1e-12);
    assert_near(seen(filtered, -7.7, 31.1, INFINITY, INFINITY), expected, 1e-12);
}

static void test_all_filters_have_one_mean(void **state) {
    (void)state;
    walk(check_all);
}

// On a sphere, heights are uniformly distributed: points of a spiral are as well.
static void test_the_mean_of_the_sky_is_that_of_a_sphere(void **state) {
    (void)state;
    bl_signal *signal = bl_test_open_source("metallic");
    enum { PLACES = 20000 };
    double sum = 0;
    for (int i = 0; i < PLACES; i++) {
        double z = 2 * (i + 0.5) / PLACES - 1, angle = 2.39996 * i, r = sqrt(1 - z * z);
        sum += bl_signal_value(signal, (const double[BL_AXES]){r * cos(angle), r * sin(angle), z});
    }
    // The mean at infinite width is taken before the cut at 0, which blue needs below the horizon.
    assert_near(seen(signal, 1, 0, INFINITY, INFINITY), sum / PLACES, 5e-4);
    bl_signal_free(signal);
}

// --- averages over a box ------------------------------------------------------------------------

// The midpoint rule, n x n places of the raw form.
static double brute_force(const bl_signal *raw, const double at[BL_AXES],
                          const double width[BL_AXES], int n) {
    double sum = 0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const double place[BL_AXES] = {at[0] + width[0] * ((i + 0.5) / n - 0.5),
                                           at[1] + width[1] * ((j + 0.5) / n - 0.5), at[2]};
            sum += bl_signal_value(raw, place);
        }
    return sum / n / n;
}

static const struct exact_case {
    const char *name, *word;
    double widest; // of the boxes tried
    double edges;  // straight edges that a box of that width meets at most, along both axes
} exact_cases[] = {
    {"brick", "exact", 0.4, 4 * 2 + 6 * 2}, {"perturbedbrick", "exact", 0.4, 6 * 4 * 2 + 6 * 2},
    {"checkerboard", "exact", 3, 8},        {"star", "exact", 0.6, 20},
    {"sinesum", "exact", 0.8, 0},           {"zoneplate", "exact", 0.2, 0}};

// A midpoint rule of n places along an axis puts an edge at most half a place wrong; one that is
// not along the axes passes through 2 n of the n^2 cells at most, each off by half. A smooth
// wave of the phase pi k r^2 with up to 20 turns a box is good to (pi f w / n)^2 / 6 at f w = 40.
static void test_exact_filters_are_averages_over_the_box(void **state) {
    enum { PLACES = 500, BOXES = 12 };
    (void)state;
    for (size_t c = 0; c < sizeof exact_cases / sizeof *exact_cases; c++) {
        const struct exact_case *it = &exact_cases[c];
        bl_random random = bl_random_seed(7, c);
        bl_signal *raw = bl_test_open_source(it->name),
                  *filtered = open_with(it->name, "filter", it->word);
        double contrast = raw->facts.upper - raw->facts.lower;
        double tolerance = contrast * (it->edges / PLACES + 0.5 * pow(M_PI * 40 / PLACES, 2) / 6);
        for (int b = 0; b < BOXES; b++) {
            double at[BL_AXES], width[BL_AXES] = {0};
            draw_place(raw, &random, at);
            if (strcmp(it->name, "star") == 0)
                for (int a = 0; a < 2; a++)
                    at[a] = 0.3 + 0.4 * bl_random_unit(&random);
            for (int a = 0; a < 2; a++)
                width[a] = it->widest * bl_random_unit(&random);
            assert_near(bl_signal_filtered(filtered, at, width),
                        brute_force(raw, at, width, PLACES), tolerance);
        }
        bl_signal_free(raw);
        bl_signal_free(filtered);
    }
}

// The average over a box is the mean of those over its four quarters, to rounding. With the limit
// at width 0 that leaves nothing but the integral.
static void test_exact_filters_add_up(void **state) {
    (void)state;
    for (size_t c = 0; c < sizeof exact_cases / sizeof *exact_cases; c++) {
        const struct exact_case *it = &exact_cases[c];
        bl_random random = bl_random_seed(8, c);
        bl_signal *filtered = open_with(it->name, "filter", it->word);
        for (int b = 0; b < 300; b++) {
            double at[BL_AXES], width[BL_AXES], half[BL_AXES], sum = 0;
            draw_place(filtered, &random, at);
            draw_width(filtered, &random, width);
            for (int a = 0; a < BL_AXES; a++) {
                width[a] = fmax(width[a], 1e-3);
                half[a] = 0.5 * width[a];
            }
            for (int q = 0; q < 4; q++) {
                double quarter[BL_AXES] = {at[0] + (q % 2 - 0.5) * half[0],
                                           at[1] + (q / 2 - 0.5) * half[1], at[2]};
                sum += 0.25 * bl_signal_filtered(filtered, quarter, half);
            }
            // Quotients by a width of 1e-3 and areas by 1e-6 lose as many digits of 1e-16.
            assert_near(bl_signal_filtered(filtered, at, width), sum, 2e-10);
        }
        bl_signal_free(filtered);
    }
}

typedef struct plate {
    double centre, width;
    int sine;
} plate;

static double plate_part(double u, void *context) {
    const plate *p = context;
    double phase = M_PI * 100 * u * u, t = (u - p->centre) / p->width;
    return (p->sine ? sin(phase) : cos(phase)) * bl_filter_find("gaussian")->kernel(t) / p->width;
}

static double plate_integral(plate p) {
    enum { STEPS = 4000 };
    double sum = 0, step = 8 * p.width / STEPS; // of a smooth function that vanishes at the ends
    for (int i = 0; i <= STEPS; i++)
        sum += step * plate_part(p.centre - 4 * p.width + i * step, &p);
    return sum;
}

static void test_the_plate_under_a_gaussian(void **state) {
    (void)state;
    bl_signal *signal = bl_test_open_source("zoneplate:filter=gaussian");
    for (int i = 0; i < 20; i++) {
        double s = 0.07 * i, t = 0.3 - 0.02 * i, width = 0.004 * (i + 1);
        plate x = {s, width, 0}, y = {t, width, 0}, x1 = x, y1 = y;
        x1.sine = y1.sine = 1;
        double expected =
            plate_integral(x) * plate_integral(y) - plate_integral(x1) * plate_integral(y1);
        assert_near(seen(signal, s, t, width, width), 0.5 + 0.5 * expected, 1e-12);
    }
    bl_signal_free(signal);
}

// The same over a box, by the midpoint rule, whose error is below (pi f w / n)^2 / 6 for the
// fastest wave in the box, f w <= 70 * 0.2.
static void test_the_plate_over_a_box(void **state) {
    (void)state;
    enum { STEPS = 20000 };
    bl_signal *signal = bl_test_open_source("zoneplate:filter=exact");
    for (int i = 0; i < 24; i++) {
        double place[2] = {0.04 * i - 0.3, 0.25 - 0.02 * i}, width = 0.004 + 0.0015 * i * i / 4;
        double cosine[2] = {0}, sine[2] = {0};
        for (int a = 0; a < 2; a++)
            for (int k = 0; k < STEPS; k++) {
                double x = place[a] + width * ((k + 0.5) / STEPS - 0.5);
                cosine[a] += cos(M_PI * 100 * x * x) / STEPS;
                sine[a] += sin(M_PI * 100 * x * x) / STEPS;
            }
        double expected = cosine[0] * cosine[1] - sine[0] * sine[1];
        assert_near(seen(signal, place[0], place[1], width, width), 0.5 + 0.5 * expected, 2e-6);
    }
    bl_signal_free(signal);
}

static void test_the_mean_of_a_spline_is_its_integral(void **state) {
    static const bl_colour knots[] = {{{0.3, 0, 1}}, {{0.1, 0.9, 0}}, {{0.8, 0.2, 0.5}},
                                      {{0, 0.4, 1}}, {{1, 1, 0}},     {{0.2, 0.6, 0.3}}};
    const bl_colour_spline spline = {knots, 6};
    (void)state;
    for (int i = 0; i < 40; i++) {
        double x = -0.4 + 0.045 * i, width = 0.02 * (i % 7 + 1), sum[3] = {0};
        bl_colour mean = bl_colour_spline_mean(&spline, x, width);
        enum { STEPS = 20000 };
        for (int k = 0; k < STEPS; k++) {
            bl_colour at = bl_colour_spline_at(&spline, x + width * ((k + 0.5) / STEPS - 0.5));
            for (int c = 0; c < 3; c++)
                sum[c] += at.rgb[c] / STEPS;
        }
        for (int c = 0; c < 3; c++)
            assert_near(mean.rgb[c], sum[c], 1e-8);
    }
    for (int k = 1; k < 5; k++) // through its knots
        for (int c = 0; c < 3; c++)
            assert_near(bl_colour_spline_at(&spline, (k - 1) / 3.0).rgb[c], knots[k].rgb[c], 1e-14);
}

// --- what the text's forms get wrong ------------------------------------------------------------

// Over even numbers of whole rows, and a point in s: half of the rows have mortar there, the other
// half bricks. The text takes the row of the middle for all of them.
static void test_the_integral_across_rows_is_off_by_half_a_wall(void **state) {
    (void)state;
    bl_signal *text = bl_test_open_source("brick:filter=integral"),
              *exact = bl_test_open_source("brick:filter=exact");
    bl_signal *raw = bl_test_open_source("brick");
    const double at[BL_AXES] = {0, 0.045}, width[BL_AXES] = {0.004, 4 * 0.09};
    double mortar = 0.5, brick = bl_colour_component((const double[]){0.5, 0.15, 0.14}, 0);
    double height = 0.08 / 0.09;
    double share = (mortar - bl_signal_filtered(exact, at, width)) / (mortar - brick);
    assert_near(share, 0.5 * height, 1e-12);
    double error = bl_signal_filtered(text, at, width) - bl_signal_filtered(exact, at, width);
    print_message("  integral across four rows: %.4f too light, %.3f of the contrast\n", error,
                  error / (mortar - brick));
    assert_near(error, 0.5 * height * (mortar - brick), 1e-12);
    assert_near(brute_force(raw, at, width, 900), bl_signal_filtered(exact, at, width), 2e-3);
    bl_signal_free(raw);
    bl_signal_free(text);
    bl_signal_free(exact);
}

// Half a brick aside and within one row, the text's forms are right, and wrong beyond.
static void test_boxstep_misses_the_brick_next_door(void **state) {
    (void)state;
    bl_signal *text = bl_test_open_source("brick:filter=boxstep"),
              *exact = bl_test_open_source("brick:filter=exact");
    double within = 0, beyond = 0;
    for (int i = 0; i < 1000; i++) {
        double s = 0.26 * i / 1000, t = 0.045;
        within = fmax(within, fabs(seen(text, s, t, 0.009, 0.01) - seen(exact, s, t, 0.009, 0.01)));
        beyond = fmax(beyond, fabs(seen(text, s, t, 0.1, 0.01) - seen(exact, s, t, 0.1, 0.01)));
    }
    print_message("  boxstep at 0.9 and at 10 widths of mortar: off by %.2g and %.3f\n", within,
                  beyond);
    assert_less(within, 1e-12);
    assert_true(beyond > 0.05);
    bl_signal_free(text);
    bl_signal_free(exact);
}

typedef struct star_edge {
    double inner, outer, half, angle_of;
} star_edge;

// Half the square of the radius at which the edge is met at the angle phi of the sector.
static double sector(double phi, const star_edge *e) {
    double angle = phi * e->angle_of, x = e->inner * cos(e->half) - e->outer;
    double y = e->inner * sin(e->half);
    double radius = e->outer * y / (y * cos(angle) - x * sin(angle));
    return 0.5 * radius * radius;
}

static double star_area(double angle_of) {
    enum { STEPS = 10000 };
    const star_edge e = {0.07, 0.2, M_PI / 5, angle_of};
    double sum = 0;
    for (int i = 0; i < STEPS; i++)
        sum += 10 * e.half / STEPS * sector(e.half * (i + 0.5) / STEPS, &e);
    return sum;
}

// The share of the unit square that is star.
static double sampled_area(const char *text, int n) {
    bl_signal *signal = bl_test_open_source(text);
    const double middle[BL_AXES] = {0.5, 0.5}, unit[BL_AXES] = {1, 1};
    double field = seen(signal, 10, 10, 0, 0), star = seen(signal, 0.5, 0.5, 0, 0);
    double mean = brute_force(signal, middle, unit, n);
    bl_signal_free(signal);
    return (mean - field) / (star - field);
}

static void test_the_printed_star_is_too_fat(void **state) {
    (void)state;
    enum { N = 1000 };
    double right = star_area(1), printed = star_area(5 / (2 * M_PI));
    print_message("  area of the star %.6f, as printed %.6f: %.1f %% more\n", right, printed,
                  100 * (printed / right - 1));
    assert_near(right, 5 * 0.07 * 0.2 * sin(M_PI / 5), 1e-9);
    // Ten edges of 0.15 units at most pass through 2 * 150 cells each of 1e-6, each off by half.
    assert_near(sampled_area("star", N), right, 10 * 300 * 0.5e-6);
    assert_near(sampled_area("star:form=printed", N), printed, 10 * 300 * 0.5e-6);
    assert_true(printed > 1.1 * right);
}

static void test_the_boxes_of_a_star_add_up_to_its_area(void **state) {
    (void)state;
    bl_signal *signal = bl_test_open_source("star:filter=exact,component=red");
    double sum = 0, field = seen(signal, 9, 9, 0.01, 0.01);
    for (int j = 0; j < 37; j++)
        for (int i = 0; i < 41; i++)
            sum += (seen(signal, (i + 0.5) / 41, (j + 0.5) / 37, 1.0 / 41, 1.0 / 37) - field) /
                   (1 - field) / 41 / 37;
    assert_near(sum, 5 * 0.07 * 0.2 * sin(M_PI / 5), 1e-13);
    bl_signal_free(signal);
}

// Whether (x, y) lies in a five-pointed star with a tip at -y, by crossings of a ray.
static int in_star(double x, double y) {
    int crossings = 0;
    double at[10][2];
    for (int k = 0; k < 10; k++) {
        double radius = k % 2 ? 0.1 : 0.3, angle = M_PI * k / 5;
        at[k][0] = -radius * sin(angle);
        at[k][1] = -radius * cos(angle);
    }
    for (int k = 0; k < 10; k++) {
        const double *a = at[k], *b = at[(k + 1) % 10];
        if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1]))
            crossings++;
    }
    return crossings % 2;
}

static double noise_at(const bl_signal *noise, double x, double y) {
    return bl_signal_value(noise, (const double[BL_AXES]){x, y});
}

// Every star of 7 x 7 cells, each whole.
static int in_wallpaper(const bl_signal *noise, double s, double t) {
    for (double row = floor(t) - 3; row <= floor(t) + 3; row++)
        for (double column = floor(s) - 3; column <= floor(s) + 3; column++) {
            double x = column + 0.5 + 0.6 * noise_at(noise, column + 0.5, row + 0.5);
            double y = row + 0.5 + 0.6 * noise_at(noise, column + 3.5, row + 8.5);
            if (0.5 + 0.5 * noise_at(noise, 3 * column - 9.5, 7 * row + 7.5) < 0.55 &&
                in_star(s - x, t - y))
                return 1;
        }
    return 0;
}

static void test_the_printed_wallpaper_cuts_stars(void **state) {
    (void)state;
    bl_signal *right = bl_test_open_source("wallpaper:component=red");
    bl_signal *printed = bl_test_open_source("wallpaper:component=red,form=printed");
    bl_signal *one = bl_test_open_source("wallpaper:component=red,cells=one");
    bl_signal *noise = bl_test_open_source("gnoise:dims=2");
    enum { N = 400 };
    int wrong = 0, cut = 0, stars = 0, alone = 0;
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++) {
            double s = 4 * (i + 0.5) / N, t = 4 * (j + 0.5) / N;
            int expected = in_wallpaper(noise, 10 * s, 10 * t);
            wrong += (seen(right, s, t, 0, 0) > 0.5) != expected;
            cut += (seen(printed, s, t, 0, 0) > 0.5) != expected;
            alone += seen(one, s, t, 0, 0) > 0.5;
            stars += expected;
        }
    print_message("  of the stars' area, the printed test gets %.2f %% wrong\n",
                  100.0 * cut / stars);
    assert_int_equal(wrong, 0);
    assert_true(cut > 0);
    assert_true(alone > stars); // no presence test: more stars
    bl_signal_free(right);
    bl_signal_free(printed);
    bl_signal_free(one);
    bl_signal_free(noise);
}

// Clamping octaves before a map of colours loses what the map makes of them; averaging the map
// keeps the mean. Compared over a box of many cells.
static void test_marble_keeps_its_mean_by_its_map(void **state) {
    (void)state;
    bl_signal *raw = bl_test_open_source("marble:component=blue");
    bl_signal *map = bl_test_open_source("marble:component=blue,filter=map");
    bl_signal *fade = bl_test_open_source("marble:component=blue,filter=fade");
    double error, mean = sampled_mean(raw, 200, 300, &error);
    double by_map = seen(map, 0.3, 0.4, 50, 50), by_fade = seen(fade, 0.3, 0.4, 50, 50);
    print_message("  blue of marble: mean %.5f +- %.5f, far away by map %.5f, by fade %.5f\n", mean,
                  error, by_map, by_fade);
    // The sum of octaves is not quite normal; the map's slope times that is some thousandths.
    assert_near(by_map, mean, 5 * error + 4e-3);
    assert_true(fabs(by_fade - mean) > 3 * fabs(by_map - mean));
    // And on the way there, where the first octave is half gone: what is lost is averaged over, so
    // that the distribution of all of it stays.
    bl_signal *half = bl_test_open_source("marble:component=blue,filter=map,width=0.15");
    double half_error, half_mean = sampled_mean(half, 200, 200, &half_error);
    print_message("  half way %.5f +- %.5f\n", half_mean, half_error);
    assert_near(half_mean, mean, 5 * (error + half_error) + 2e-3);
    bl_signal_free(half);
    bl_signal_free(raw);
    bl_signal_free(map);
    bl_signal_free(fade);
}

// Near the middle of an edge, and with a sample that meets no other, the ramp is as wide as the box
// is across the edge: it is 0 or 1 where the box lies on one side, and nowhere else.
static void test_the_ramp_of_a_star_is_as_wide_as_the_sample(void **state) {
    (void)state;
    bl_signal *ramp = bl_test_open_source("star:filter=boxstep,component=red");
    bl_signal *exact = bl_test_open_source("star:filter=exact,component=red");
    bl_random random = bl_random_seed(9, 0);
    double field = seen(exact, 9, 9, 0.01, 0.01);
    int between = 0, outside = 0;
    for (int i = 0; i < 2000; i++) {
        int k = (int)(10 * bl_random_unit(&random));
        double tip = M_PI * (k / 2 * 2 + (k % 2 ? 0 : 2)) / 5, notch = M_PI * (k / 2 * 2 + 1) / 5;
        double s = -0.5 * (0.2 * sin(tip) + 0.07 * sin(notch));
        double t = -0.5 * (0.2 * cos(tip) + 0.07 * cos(notch));
        double width_s = 0.001 + 0.02 * bl_random_unit(&random);
        double width_t = 0.001 + 0.02 * bl_random_unit(&random);
        s += 0.5 + 0.03 * (bl_random_unit(&random) - 0.5);
        t += 0.5 + 0.03 * (bl_random_unit(&random) - 0.5);
        double a = (seen(ramp, s, t, width_s, width_t) - field) / (1 - field);
        double b = (seen(exact, s, t, width_s, width_t) - field) / (1 - field);
        between += b > 1e-9 && b < 1 - 1e-9;
        outside += b <= 1e-9;
        // The area over a corner of the box is up to 1/8 from the ramp, for a square and its
        // diagonal.
        assert_near(a, b, 0.125 + 1e-9);
        if (b < 1e-12 || b > 1 - 1e-12)
            assert_near(a, b, 1e-9);
    }
    assert_true(between > 300 && outside > 300);
    bl_signal_free(ramp);
    bl_signal_free(exact);
}

// --- filters of octaves, slopes and rings -------------------------------------------------------

// The noise has a width of its own, and the loop over terms that the texture does without.
static void test_clouds_fade_as_their_noise_does(void **state) {
    static const char *const clamps[][2] = {{"clamp", "hard"}, {"fade", "fade"}};
    (void)state;
    for (int c = 0; c < 2; c++)
        for (int i = 0; i < 12; i++) {
            char text[128];
            double width = 0.5 * pow(1.5, i);
            snprintf(text, sizeof text, "gardner:width=%.17g,clamp=%s", width, clamps[c][1]);
            bl_signal *noise = bl_test_open_source(text);
            bl_signal *sky = open_with("cloudplane", "component=red,filter", clamps[c][0]);
            for (int k = 0; k < 20; k++) {
                double x = 7.3 * k, y = 90 - 11.7 * k, value = noise_at(noise, x, y);
                // A sum that has lost all its terms is rounded to float.
                assert_near(seen(sky, x, y, width, width), 0.16 + 0.84 * fmax(value, 0), 5e-9);
            }
            bl_signal_free(noise);
            bl_signal_free(sky);
        }
}

// With slopes of 0.003 at most, light is linear in them except for the square of that; brick and
// mortar have the same red.
static void test_averaged_slopes_are_the_average_of_faint_bumps(void **state) {
    (void)state;
    bl_signal *raw = bl_test_open_source("bumpbrick:depth=1e-5,component=red");
    bl_signal *slope = bl_test_open_source("bumpbrick:depth=1e-5,component=red,filter=slope");
    bl_random random = bl_random_seed(10, 0);
    double most = 0;
    for (int i = 0; i < 30; i++) {
        const double at[BL_AXES] = {0.26 * bl_random_unit(&random), 0.006};
        const double width[BL_AXES] = {0.02 * bl_random_unit(&random), 0.011 - 0.002 * (i % 5)};
        double flat = bl_signal_value(raw, (const double[BL_AXES]){0.13, 0.045});
        double average = brute_force(raw, at, width, 200);
        assert_near(bl_signal_filtered(slope, at, width), average, 0.003 * 0.003);
        most = fmax(most, fabs(average - flat));
    }
    assert_true(most > 1e-4); // the bumps are seen
    bl_signal_free(raw);
    bl_signal_free(slope);
}

// The light comes from the upper left: of the slopes up to a brick, the left and the upper one are
// lighter than the flat wall, or lose less, than those that face away.
static void test_grooves_are_lit_from_the_upper_left(void **state) {
    (void)state;
    bl_signal *bump = bl_test_open_source("bumpbrick:component=red");
    double left = seen(bump, 0.0025, 0.045, 0, 0), right = seen(bump, 0.2575, 0.045, 0, 0);
    double upper = seen(bump, 0.13, 0.0025, 0, 0), lower = seen(bump, 0.13, 0.0875, 0, 0);
    assert_true(left > right + 0.05 && upper > lower + 0.05);
    bl_signal_free(bump);
}

static void test_rings_are_averaged_along_the_radius(void **state) {
    (void)state;
    bl_signal *raw = bl_test_open_source("wood:wobble=0,fibre=0");
    bl_signal *integral = bl_test_open_source("wood:wobble=0,fibre=0,filter=integral");
    for (int i = 0; i < 40; i++) {
        const double at[BL_AXES] = {3 + 0.031 * i}, width[BL_AXES] = {0.008 * (i % 9 + 1)};
        // A midpoint rule of a C1 function: its second derivative is below 1e4, the error below
        // 1e4 width^2 / 24 n^2.
        assert_near(bl_signal_filtered(integral, at, width), brute_force(raw, at, width, 400),
                    2e-5);
    }
    bl_signal_free(raw);
    bl_signal_free(integral);
}

static void test_the_sky_is_averaged_over_altitudes(void **state) {
    (void)state;
    bl_signal *raw = bl_test_open_source("metallic"),
              *integral = bl_test_open_source("metallic:filter=integral");
    for (int i = 0; i < 20; i++) {
        enum { STEPS = 2000 };
        double z = 0.25 + 0.02 * i, width = 0.02 * (i + 1), sum = 0;
        for (int k = 0; k < STEPS; k++) {
            double height = z + width * ((k + 0.5) / STEPS - 0.5);
            sum +=
                bl_signal_value(raw, (const double[BL_AXES]){sqrt(1 - height * height), 0, height});
        }
        assert_near(bl_signal_filtered(integral, (const double[BL_AXES]){0, sqrt(1 - z * z), z},
                                       (const double[BL_AXES]){0, 0, width}),
                    sum / STEPS, 1e-5);
    }
    bl_signal_free(raw);
    bl_signal_free(integral);
}

// --- pictures of files --------------------------------------------------------------------------

static const char *write_ramp(const char *name, int srgb) {
    enum { SIDE = 64 };
    static float values[3 * SIDE * SIDE];
    for (int j = 0; j < SIDE; j++)
        for (int i = 0; i < SIDE; i++) {
            float *pixel = &values[3 * (SIDE * j + i)];
            pixel[0] = ((float)i + 0.5f) / SIDE;
            pixel[1] = ((float)j + 0.5f) / SIDE; // downwards
            pixel[2] = 0.25f;
        }
    const bl_image image = {.width = SIDE,
                            .height = SIDE,
                            .channels = 3,
                            .values = values,
                            .white = 1,
                            .bits = 16,
                            .srgb = srgb};
    bl_message message;
    const char *path = bl_temporary_path(name);
    if (bl_image_write(path, &image, &message) != BL_OK)
        fail_msg("%s", message.text);
    return path;
}

static void check_ramp(const char *path, double tolerance) {
    char text[1200];
    static const char *const words[] = {"none", "mip", "anisotropic"};
    for (int w = 0; w < 3; w++) {
        snprintf(text, sizeof text, "image:path=%s,amount=0,filter=%s", path, words[w]);
        bl_signal *signal = bl_test_open_source(text);
        for (int i = 0; i < 20; i++) {
            double s = 0.3 + 0.02 * i, t = 0.25 + 0.017 * i, width = w ? 0.02 * (i % 3) : 0, rgb[3];
            bl_signal_colour(signal, (const double[BL_AXES]){s + 3, t - 2},
                             (const double[BL_AXES]){width, width}, rgb);
            assert_near(rgb[0], s, tolerance);
            assert_near(rgb[1], t, tolerance);
            assert_near(rgb[2], 0.25, tolerance);
        }
        assert_near(seen(signal, 0, 0, INFINITY, INFINITY),
                    0.2126 * 0.5 + 0.7152 * 0.5 + 0.0722 * 0.25, 1e-4);
        bl_signal_free(signal);
    }
}

// A ramp is its own average, and linear between its texels: every lookup gives the coordinates.
static void test_a_picture_shows_its_ramp(void **state) {
    (void)state;
    check_ramp(write_ramp("ramp.exr", 0), 1e-4); // floats, and coordinates in float
    check_ramp(write_ramp("ramp.png", 1), 2e-4); // 16 bits of sRGB, decoded
}

// Against the sum over all texels, each with the part of the box that it holds. The picture
// repeats.
static double box_sum(const float *plane, const size_t size[2], const double at[2],
                      const double width[2]) {
    double weight[2][64] = {{0}}, sum = 0;
    for (int a = 0; a < 2; a++) {
        double texels = (double)size[a], middle = at[a] * texels;
        double from = middle - 0.5 * width[a] * texels, to = middle + 0.5 * width[a] * texels;
        for (double i = floor(from); i < to; i++) {
            double column = i - texels * floor(i / texels);
            weight[a][(int)column] += (fmin(to, i + 1) - fmax(from, i)) / (to - from);
        }
    }
    for (size_t j = 0; j < size[1]; j++)
        for (size_t i = 0; i < size[0]; i++)
            sum += weight[0][i] * weight[1][j] * (double)plane[size[0] * j + i];
    return sum;
}

static void test_the_tables_of_a_picture_give_the_mean_of_any_box(void **state) {
    (void)state;
    enum { WIDTH = 37, HEIGHT = 23 };
    static float values[3 * WIDTH * HEIGHT], plane[3][WIDTH * HEIGHT];
    const size_t size[2] = {WIDTH, HEIGHT};
    bl_random random = bl_random_seed(31, 0);
    for (size_t i = 0; i < 3 * WIDTH * HEIGHT; i++)
        plane[i % 3][i / 3] = values[i] = (float)bl_random_unit(&random);
    const bl_image image = {
        .width = WIDTH, .height = HEIGHT, .channels = 3, .values = values, .white = 1, .bits = 16};
    bl_message message = {""};
    char text[1200];
    const char *path = bl_temporary_path("texels.exr");
    if (bl_image_write(path, &image, &message) != BL_OK)
        fail_msg("%s", message.text);
    snprintf(text, sizeof text, "image:path=%s,amount=0,filter=sat", path);
    bl_signal *signal = bl_test_open_source(text);
    for (int b = 0; b < 400; b++) {
        double at[BL_AXES] = {0}, width[BL_AXES] = {0}, rgb[3];
        for (int a = 0; a < 2; a++) {
            at[a] = 6 * bl_random_unit(&random) - 3;
            width[a] = 2.5 * exp2(-9 * bl_random_unit(&random));
        }
        bl_signal_colour(signal, at, width, rgb);
        for (int c = 0; c < 3; c++)
            assert_near(rgb[c], box_sum(plane[c], size, at, width), 1e-11);
    }
    // Endless along s: the mean of a row of texels.
    double row = 0, rgb[3];
    for (size_t i = 0; i < WIDTH; i++)
        row += (double)plane[1][4 * WIDTH + i] / WIDTH;
    bl_signal_colour(signal, (const double[BL_AXES]){0.3, 4.5 / HEIGHT},
                     (const double[BL_AXES]){INFINITY, 1.0 / HEIGHT}, rgb);
    assert_near(rgb[1], row, 1e-12);
    bl_signal_free(signal);
}

static void test_a_picture_that_is_not_there(void **state) {
    (void)state;
    bl_signal *signal = NULL;
    bl_message message;
    assert_int_equal(bl_source_open("image:path=/nowhere/x.png", BL_ISA_BEST, &signal, &message),
                     BL_DEVICE);
    assert_non_null(strstr(message.text, "/nowhere/x.png"));
    assert_null(signal);
}

// A perturbation that is 0 at the lattice moves nothing there.
static void test_the_perturbation_is_that_of_the_noise(void **state) {
    (void)state;
    bl_signal *plain = bl_test_open_source("image:amount=0"),
              *noise = bl_test_open_source("gnoise");
    bl_signal *moved = bl_test_open_source("image:amount=0.1,frequency=1");
    for (int i = 0; i < 50; i++) {
        double p[BL_AXES] = {0.137 * i, 0.291 * i, 0.05 * i};
        double q[BL_AXES] = {p[0] + 1.5, p[1] + 6.7, p[2] + 3.4};
        const double there[BL_AXES] = {p[0] + 0.1 * bl_signal_value(noise, p),
                                       p[1] + 0.1 * bl_signal_value(noise, q), p[2]};
        assert_near(bl_signal_value(moved, p), bl_signal_value(plain, there), 1e-6);
    }
    bl_signal_free(plain);
    bl_signal_free(noise);
    bl_signal_free(moved);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_width_0_is_the_raw_form),
        cmocka_unit_test(test_colours_stay_within_their_bounds),
        cmocka_unit_test(test_nan_infinite_and_huge_places_give_nan),
        cmocka_unit_test(test_components_are_those_of_the_colour),
        cmocka_unit_test(test_copies_are_the_same_and_other_seeds_are_not),
        cmocka_unit_test(test_periods_are_periods),
        cmocka_unit_test(test_infinite_width_is_the_mean),
        cmocka_unit_test(test_all_filters_have_one_mean),
        cmocka_unit_test(test_the_mean_of_the_sky_is_that_of_a_sphere),
        cmocka_unit_test(test_exact_filters_are_averages_over_the_box),
        cmocka_unit_test(test_exact_filters_add_up),
        cmocka_unit_test(test_the_plate_under_a_gaussian),
        cmocka_unit_test(test_the_plate_over_a_box),
        cmocka_unit_test(test_the_mean_of_a_spline_is_its_integral),
        cmocka_unit_test(test_the_integral_across_rows_is_off_by_half_a_wall),
        cmocka_unit_test(test_boxstep_misses_the_brick_next_door),
        cmocka_unit_test(test_the_printed_star_is_too_fat),
        cmocka_unit_test(test_the_boxes_of_a_star_add_up_to_its_area),
        cmocka_unit_test(test_the_printed_wallpaper_cuts_stars),
        cmocka_unit_test(test_the_ramp_of_a_star_is_as_wide_as_the_sample),
        cmocka_unit_test(test_clouds_fade_as_their_noise_does),
        cmocka_unit_test(test_averaged_slopes_are_the_average_of_faint_bumps),
        cmocka_unit_test(test_grooves_are_lit_from_the_upper_left),
        cmocka_unit_test(test_rings_are_averaged_along_the_radius),
        cmocka_unit_test(test_the_sky_is_averaged_over_altitudes),
        cmocka_unit_test(test_marble_keeps_its_mean_by_its_map),
        cmocka_unit_test(test_a_picture_shows_its_ramp),
        cmocka_unit_test(test_the_tables_of_a_picture_give_the_mean_of_any_box),
        cmocka_unit_test(test_a_picture_that_is_not_there),
        cmocka_unit_test(test_the_perturbation_is_that_of_the_noise),
    };
    return bl_run_tests(tests);
}
