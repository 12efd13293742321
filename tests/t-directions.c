// SPDX-License-Identifier: MIT
//
// One direction of t: row 0 of every picture, the upper one, has the least t, whatever drew it.
#include "tests/test.h"

#include <stdlib.h>

#include "aliasing/view.h"
#include "core/image.h"
#include "core/random.h"
#include "tests/program.h"
#include "tests/sources.h"
#include "tests/temporary.h"

typedef struct picture {
    size_t width, height;
    float *values; // of the first channel
} picture;

static picture read_picture(const char *path) {
    const bl_pixels_choice choice = {
        .path = path, .channel_index = 0, .part = -1, .memory_bytes = 1 << 26};
    bl_pixels *pixels;
    bl_pixels_facts facts;
    bl_message message = {""};
    if (bl_pixels_open(&choice, &pixels, &facts, &message) != BL_OK)
        fail_msg("%s", message.text);
    picture read = {facts.width, facts.height,
                    malloc(facts.width * facts.height * sizeof *read.values)};
    for (size_t j = 0; j < read.height; j++)
        bl_pixels_span(pixels, 0, j, read.width, read.values + j * read.width);
    bl_pixels_close(pixels);
    return read;
}

static double mean_of_rows(const picture *p, size_t from, size_t to) {
    double sum = 0;
    for (size_t i = from * p->width; i < to * p->width; i++)
        sum += (double)p->values[i];
    return sum / (double)((to - from) * p->width);
}

static void run(const char *const *words) {
    bl_ran ran = bl_run_words(NULL, words);
    if (ran.status != 0 && ran.status != 1)
        fail_msg("%s: status %d: %s", words[0], ran.status, ran.err);
    bl_ran_free(&ran);
}
#define RUN(...) run((const char *const[]){__VA_ARGS__, "-q", NULL})

// The function `plain` of the tests' plugin rises by 10 a unit of t and by 1 a unit of s.
static const char *rising(void) {
    static char text[400];
    const char *build = getenv("BL_BUILD");
    snprintf(text, sizeof text, "%s/tests/plugins/functions.so:plain", build ? build : "build");
    return text;
}

static void expect_rising(const char *path) {
    picture p = read_picture(path);
    double upper = mean_of_rows(&p, 0, p.height / 2),
           lower = mean_of_rows(&p, p.height / 2, p.height);
    if (!(upper < lower))
        fail_msg("%s: the upper half is %g, the lower %g", path, upper, lower);
    free(p.values);
}

static void test_every_verb_draws_the_least_t_at_the_top(void **state) {
    (void)state;
    static const char *const endings[] = {"rise.exr", "rise.png", "rise.tif"};
    for (int i = 0; i < 3; i++) {
        const char *path = bl_temporary_path(endings[i]);
        RUN("render", rising(), "--width", "16", "--at", "0,0,0", "--range=-100:100", "-o", path);
        expect_rising(path);
    }
    char path[400];
    const char *folder = bl_temporary_path("alias");
    RUN("alias", rising(), "--view", "flat:z=0", "--method", "point", "--size", "16", "--quick",
        "-o", folder);
    static const char *const files[] = {"reference.exr", "reference.png", "point.exr"};
    for (int i = 0; i < 3; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, files[i]);
        expect_rising(path);
    }
}

// A figure draws a star as `render` does: the one pixel for pixel, the other flipped is another.
static void test_figures_and_render_draw_the_same_picture(void **state) {
    (void)state;
    char path[400];
    const char *folder = bl_temporary_path("figures");
    RUN("reproduce", "peachey-2.27", "peachey-2.41", "--quick", "-o", folder);
    snprintf(path, sizeof path, "%s/peachey-2.27/corrected.exr", folder);
    picture figure = read_picture(path);
    char size[32];
    snprintf(size, sizeof size, "%zu", figure.width);
    const char *drawn = bl_temporary_path("star.exr");
    RUN("render", "star", "--width", size, "--scale", "0.5", "-o", drawn);
    picture star = read_picture(drawn);
    size_t same = 0, flipped = 0, count = star.width * star.height;
    for (size_t i = 0; i < count; i++) {
        size_t other = (star.height - 1 - i / star.width) * star.width + i % star.width;
        same += fabsf(star.values[i] - figure.values[i]) > 0.4f;
        flipped += fabsf(star.values[other] - figure.values[i]) > 0.4f;
    }
    assert_less((double)same, 0.005 * (double)count); // edges
    assert_less(0.02 * (double)count, (double)flipped);
    free(figure.values);
    free(star.values);
    // A picture that was written and looked up is the picture; a checkerboard on its head is not.
    snprintf(path, sizeof path, "%s/peachey-2.41/original.exr", folder);
    picture original = read_picture(path);
    snprintf(path, sizeof path, "%s/peachey-2.41/lookup.exr", folder);
    picture lookup = read_picture(path);
    double difference = 0;
    count = original.width * original.height;
    for (size_t i = 0; i < count; i++)
        difference += fabs((double)original.values[i] - (double)lookup.values[i]);
    assert_less(difference, 0.1 * (double)count);
    free(original.values);
    free(lookup.values);
}

// Drawn, read and drawn again, by both ways that a file is read: nothing moves.
static void test_an_image_that_is_read_and_drawn_again_is_the_same(void **state) {
    (void)state;
    char path[300], text[400];
    snprintf(path, sizeof path, "%s", bl_temporary_path("first.exr"));
    RUN("render", "star", "--width", "32", "-o", path);
    picture first = read_picture(path);
    const char *again = bl_temporary_path("again.exr");
    RUN("render", path, "-o", again);
    picture second = read_picture(again);
    assert_int_equal(second.width, 32);
    assert_memory_equal(first.values, second.values, 32 * 32 * sizeof(float));
    snprintf(text, sizeof text, "image:path=%s,amount=0", path);
    again = bl_temporary_path("looked-up.exr");
    RUN("render", text, "--width", "32", "-o", again);
    picture third = read_picture(again);
    for (size_t i = 0; i < 32 * 32; i++) // at the middles of texels, in float
        assert_near((double)first.values[i], (double)third.values[i], 1e-5);
    // Its places are columns and rows.
    bl_signal *signal = bl_test_open_source(path);
    bl_random random = bl_random_seed(3, 1);
    for (int n = 0; n < 100; n++) {
        size_t i = (size_t)(32 * bl_random_unit(&random)),
               j = (size_t)(32 * bl_random_unit(&random));
        const double spacing = signal->extent.spacing[0];
        const double at[BL_AXES] = {spacing * (double)i, spacing * (double)j};
        assert_near(bl_signal_value(signal, at), (double)first.values[32 * j + i], 0);
    }
    bl_signal_free(signal);
    free(first.values);
    free(second.values);
    free(third.values);
}

// The texture of a surface is not mirrored, and its t runs downwards where the view is upright.
static void test_no_view_mirrors_or_turns_the_texture(void **state) {
    (void)state;
    static const char *const upright[] = {"flat", "plane", "sphere", "torus"};
    for (size_t v = 0; v < bl_view_count(); v++) {
        const bl_view_kind *kind = bl_view_at(v);
        for (int example = -1; example < 0 || (kind->examples && kind->examples[example]);
             example++) {
            char text[256];
            snprintf(text, sizeof text, "%s%s%s", kind->name, example < 0 ? "" : ":",
                     example < 0 ? "" : kind->examples[example]);
            if (strstr(text, "solid"))
                continue;
            bl_view view = bl_test_open_view(text, 16);
            size_t seen = 0;
            for (int i = 0; i < 256; i++) {
                bl_sight sight;
                if (!bl_view_see(&view, i % 16 + 0.5, i / 16 + 0.5, &sight))
                    continue;
                seen++;
                if (!(sight.across[0] * sight.down[1] - sight.across[1] * sight.down[0] > 0))
                    fail_msg("%s is mirrored at %d, %d", text, i % 16, i / 16);
            }
            assert_true(seen > 0);
            bl_view_close(&view);
        }
    }
    for (size_t i = 0; i < 4; i++) {
        bl_view view = bl_test_open_view(upright[i], 16);
        bl_sight sight;
        assert_true(bl_view_see(&view, 8.1, i == 3 ? 11 : 8.1, &sight)); // the torus has a hole
        assert_true(sight.down[1] > 0 && sight.across[0] > 0);
        bl_view_close(&view);
    }
}

// A tilt brings the upper end towards the eye: from there one sees north, in the middle.
static void test_a_tilted_sphere_shows_its_upper_end(void **state) {
    (void)state;
    bl_view view = bl_test_open_view("sphere:tilt=30,coordinates=solid,scale=1", 16);
    bl_sight sight;
    assert_true(bl_view_see(&view, 8, 8, &sight));
    assert_near(sight.at[2], 0.5, 1e-12); // sin 30
    assert_near(sight.at[1], -sqrt(0.75), 1e-12);
    bl_view_close(&view);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_verb_draws_the_least_t_at_the_top),
        cmocka_unit_test(test_figures_and_render_draw_the_same_picture),
        cmocka_unit_test(test_an_image_that_is_read_and_drawn_again_is_the_same),
        cmocka_unit_test(test_no_view_mirrors_or_turns_the_texture),
        cmocka_unit_test(test_a_tilted_sphere_shows_its_upper_end),
    };
    return bl_run_tests(tests);
}
