// SPDX-License-Identifier: MIT
//
// Whether samples resolve a signal: against what lines and edges leave beyond Nyquist, against
// closed forms, and as the verbs tell it.
#include "tests/test.h"

#include <jansson.h>
#include <stdlib.h>

#include "noises/noise.h"
#include "spectra/psd.h"
#include "spectra/theory.h"
#include "tests/program.h"
#include "tests/sources.h"
#include "tests/temporary.h"

static const bl_region around = {
    {-512, -512, -512, -512}, {{1024, 0, 0, 0}, {0, 1024, 0, 0}, {0, 0, 1024, 0}, {0, 0, 0, 1024}}};

static bl_resolution measure(const bl_signal *signal, int axis, double rate, double allowed) {
    double step[BL_AXES] = {0};
    step[axis] = 1 / rate;
    const bl_resolution_settings settings = {.allowed = allowed};
    return bl_resolution_measure(signal, &around, step, &settings);
}

static bl_resolution measure_text(const char *text, int axis, double rate, double allowed) {
    bl_signal *signal = bl_test_open_source(text);
    bl_resolution found = measure(signal, axis, rate, allowed);
    bl_signal_free(signal);
    return found;
}

// A line is resolved up to 0.8 of the limit and, above 1.2 of it, not at all: multiples of the rate
// and of its doubles too, where the samples of a rate are all alike.
static void test_a_line_is_on_one_side_of_the_limit(void **state) {
    (void)state;
    static const double times[] = {0.01, 0.3, 0.8, 1.2, 1.9,  2,    2.7,  3,   4,
                                   5,    6,   7.3, 8,   16.1, 32.5, 100., 128, 4096};
    for (size_t i = 0; i < sizeof times / sizeof *times; i++) {
        const double rate = 4;
        char text[64];
        snprintf(text, sizeof text, "sine:frequency=%.17g", 0.5 * rate * times[i]);
        bl_resolution found = measure_text(text, 0, rate, 0.01);
        if (times[i] < 1) {
            if (!(found.beyond < 0.001 && found.rate == rate))
                fail_msg("%s: %g beyond, rate %g", text, found.beyond, found.rate);
        } else if (!(found.beyond > 0.9 && found.rate >= rate * times[i] / 1.3 &&
                     found.rate <= 4 * rate * times[i])) {
            fail_msg("%s: %g beyond, rate %g", text, found.beyond, found.rate);
        }
    }
}

// Squares of side 1: the odd harmonics n/2 of a square wave have 8/(pi n)^2 of its variance. Half
// of what lies beyond is found at least, and no more than that but for the spread of 4096 places.
static void test_edges_leave_what_their_series_says(void **state) {
    (void)state;
    for (double rate = 1.3; rate < 40; rate *= 2.3) {
        double beyond = 1;
        for (int n = 1; 0.5 * n < 0.5 * rate; n += 2)
            beyond -= 8 / pow(M_PI * n, 2);
        bl_resolution found = measure_text("checkerboard", 1, rate, 0.01);
        double spread = 4 * sqrt(beyond / 4096);
        if (!(found.beyond > 0.5 * beyond - spread && found.beyond < beyond + spread))
            fail_msg("%g a unit: %g found, %g there", rate, found.beyond, beyond);
        // The rate that would do leaves what is allowed, give or take the same.
        assert_true(found.rate <= 160 && 4 / (2 * M_PI * M_PI * 0.5 * found.rate) < 0.026);
    }
}

// Between what lies beyond the limit, of which half is seen at least, and what lies beyond 0.8 of
// it. Sampling leaves a few percent of that.
static void test_noises_leave_what_their_closed_form_says(void **state) {
    (void)state;
    static const char *const texts[] = {"gnoise", "vcnoise", "white:cell=0.25"};
    static const double x[3][BL_AXES] = {{1, 0, 0, 0}};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        for (double rate = 1; rate < 8; rate *= 2) {
            bl_signal *signal = bl_test_open_source(texts[i]);
            double most = bl_theory_band(signal, 1, x, 0.4 * rate, INFINITY);
            double least = 0.5 * bl_theory_band(signal, 1, x, 0.6 * rate, INFINITY);
            double found = measure(signal, 0, rate, 0).beyond;
            if (!(found < 1.15 * most + 1e-4 && found > 0.85 * least - 1e-4))
                fail_msg("%s at %g: %g, expected %g to %g", texts[i], rate, found, least, most);
            bl_signal_free(signal);
        }
}

// What is stated of the registry's noises agrees with what is measured.
static void test_registry_noises_are_resolved_at_the_usual_rate(void **state) {
    (void)state;
    for (size_t i = 0; i < bl_noise_count(); i++) {
        bl_signal *signal = bl_test_open_source(bl_noise_at(i, BL_ISA_BEST)->name);
        bl_resolution found = measure(signal, 0, 16, BL_RESOLUTION_SPECTRUM);
        if (found.rate > 16)
            fail_msg("%s: %g beyond", signal->text, found.beyond);
        bl_signal_free(signal);
    }
}

static void test_each_axis_is_judged_alone(void **state) {
    (void)state;
    const char *text = "brick:brick_width=4,brick_height=0.05,mortar=0.02";
    assert_true(measure_text(text, 0, 64, 0.02).rate == 64);
    assert_true(measure_text(text, 1, 64, 0.02).rate > 128);
}

static void test_threads_change_nothing(void **state) {
    (void)state;
    bl_signal *signal = bl_test_open_source("wood");
    bl_resolution found[2];
    for (int i = 0; i < 2; i++) {
        const bl_resolution_settings settings = {.allowed = 0.01, .threads = 1 + 2 * i};
        found[i] =
            bl_resolution_measure(signal, &around, (const double[BL_AXES]){1.0 / 16}, &settings);
    }
    assert_memory_equal(&found[0], &found[1], sizeof *found);
    bl_signal_free(signal);
}

// A signal that is rarely other than its usual value: a thousandth of the places see it.
static void test_rare_detail_is_seen(void **state) {
    (void)state;
    bl_resolution found = measure_text("pulse:low=0,high=0.001", 0, 16, 0.01);
    // The transform of a pulse of width w: the share beyond N is 1 - 2 N w for N w well below 1.
    assert_true(found.beyond > 0.5 && found.rate > 4096 && found.rate < 1e6);
    assert_true(measure_text("pulse:low=0,high=0.001", 0, found.rate, 0.01).times == 1);
}

// --- as the verbs tell it -----------------------------------------------------------------------

static const char *warned(const bl_ran *ran) {
    return strstr(ran->err, ": warning: ");
}

// Runs with the words and one option more; fails unless it warns as is said.
static bl_ran expect_warning(const char *const *words, const char *option, const char *value,
                             int is_warned) {
    const char *all[16];
    size_t count = 0;
    for (; words[count]; count++)
        all[count] = words[count];
    all[count++] = option;
    all[count++] = value;
    all[count] = NULL;
    bl_ran ran = bl_run_words(NULL, all);
    if ((warned(&ran) != NULL) != is_warned || ran.status > 2)
        fail_msg("%s %s %s: status %d: %s", words[0], words[1], value ? value : "", ran.status,
                 ran.err);
    return ran;
}

// What stands behind some words, up to one of the characters.
static char *word_after(const char *text, const char *before, const char *ends, char *word,
                        size_t size) {
    const char *found = strstr(text, before);
    if (!found)
        fail_msg("no '%s' in: %s", before, text);
    found += strlen(before);
    size_t length = strcspn(found, ends);
    snprintf(word, size, "%.*s", (int)length, found);
    return word;
}

static const char *plugin(const char *name) {
    static char text[400];
    const char *build = getenv("BL_BUILD");
    snprintf(text, sizeof text, "%s/tests/plugins/functions.so:%s", build ? build : "build", name);
    return text;
}

static void test_spectra_warn_with_the_rate_that_does(void **state) {
    (void)state;
    char rate[64];
    const char *const texts[] = {
        "brick",          "checkerboard:size=1/64", "pulse:low=0,high=0.01",
        "fbm:octaves=12", "wood:rings=90",          plugin("fine")};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        const char *const words[] = {i % 2 ? "check" : "spectrum", texts[i], "--quick", NULL};
        bl_ran first = expect_warning(words, NULL, NULL, 1);
        word_after(first.err, "--rate ", " ", rate, sizeof rate);
        bl_ran second = expect_warning(words, "--rate", rate, 0);
        bl_ran_free(&first);
        bl_ran_free(&second);
    }
}

static void test_pictures_warn_with_what_does(void **state) {
    (void)state;
    char width[64], text[400];
    const char *path = bl_temporary_path("coarse.png");
    const struct {
        const char *text, *scale;
        int is_filtered;
    } cases[] = {{"checkerboard", "14", 1},
                 {"fbm:octaves=12", "50", 1},
                 {"image:amount=0", "3", 1},
                 {plugin("fine"), "2", 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *words[] = {"render",   cases[i].text, "--scale", cases[i].scale, "-o", path,
                               "--height", "64",          NULL};
        bl_ran first = expect_warning(words, NULL, NULL, 1), second;
        if (cases[i].is_filtered) {
            words[1] = word_after(first.err, "so would '", "'", text, sizeof text);
            second = expect_warning(words, NULL, NULL, 0);
        } else {
            word_after(first.err, "--width ", " ", width, sizeof width);
            second = expect_warning(words, "--width", width, 0);
        }
        bl_ran_free(&first);
        bl_ran_free(&second);
    }
}

// The scorecard has no rate to choose, and names the verb that has.
static void test_scores_warn_of_what_they_do_not_resolve(void **state) {
    (void)state;
    const char *const words[] = {"score",  plugin("fine"),  "gnoise", "--quick",
                                 "--only", "band,isotropy", NULL};
    bl_ran ran = expect_warning(words, NULL, NULL, 1);
    assert_non_null(strstr(ran.err, "warning: band: 8 samples a unit do not resolve"));
    assert_non_null(strstr(ran.err, "--dims 1 --rate 256` would do"));
    assert_null(strstr(ran.err, "gnoise"));
    bl_ran_free(&ran);
}

static void test_what_is_resolved_is_not_warned_of(void **state) {
    (void)state;
    char image[300];
    snprintf(image, sizeof image, "%s", bl_temporary_path("own.exr"));
    const char *const calls[][4] = {{"spectrum", "gnoise"}, {"spectrum", "gnoise", "--dims", "3"},
                                    {"spectrum", "fbm"},    {"spectrum", "white"},
                                    {"check", "simplex"},   {"spectrum", plugin("full")}};
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++) {
        const char *const words[] = {calls[i][0], calls[i][1], "--quick",
                                     calls[i][2], calls[i][3], NULL};
        bl_ran ran = expect_warning(words, NULL, NULL, 0);
        bl_ran_free(&ran);
    }
    static const char *const pictures[] = {"gnoise", "brick"};
    for (size_t i = 0; i < sizeof pictures / sizeof *pictures; i++) {
        const char *const words[] = {"render", pictures[i], "-o", image, NULL};
        bl_ran ran = expect_warning(words, NULL, NULL, 0);
        bl_ran_free(&ran);
    }
    // An image at its own samples is what it is; read at fewer it has lost some.
    const char *const white[] = {"render", "white", "--width", "256", "-o", image, NULL};
    bl_ran drawn = expect_warning(white, NULL, NULL, 0);
    bl_ran_free(&drawn);
    const char *const own[] = {"spectrum", image, NULL};
    drawn = expect_warning(own, NULL, NULL, 0);
    bl_ran_free(&drawn);
    const char *const again[] = {"render", image, "-o", bl_temporary_path("again.png"), NULL};
    drawn = expect_warning(again, NULL, NULL, 0);
    bl_ran_free(&drawn);
    drawn = expect_warning(again, "--width", "32", 1);
    assert_non_null(strstr(drawn.err, "--width 256 --height 256 would do"));
    bl_ran_free(&drawn);
}

// On standard error once, in the object, and not with --quiet; the status stays.
static void test_warnings_are_told_once_and_hushed(void **state) {
    (void)state;
    const char *const words[] = {"spectrum", "brick", "--quick", "--json", NULL};
    bl_ran ran = expect_warning(words, NULL, NULL, 1);
    assert_int_equal(ran.status, 0);
    assert_null(strstr(warned(&ran) + 1, ": warning: "));
    json_t *object = json_loads(ran.out, 0, NULL), *list = json_object_get(object, "warnings");
    assert_int_equal(json_array_size(list), 1);
    assert_non_null(strstr(ran.err, json_string_value(json_array_get(list, 0))));
    json_decref(object);
    bl_ran_free(&ran);
    ran = expect_warning(words, "--quiet", NULL, 0);
    object = json_loads(ran.out, 0, NULL);
    assert_int_equal(json_array_size(json_object_get(object, "warnings")), 1);
    json_decref(object);
    bl_ran_free(&ran);
    const char *const good[] = {"spectrum", "gnoise", "--quick", "--json", NULL};
    ran = expect_warning(good, NULL, NULL, 0);
    object = json_loads(ran.out, 0, NULL);
    assert_true(json_is_array(json_object_get(object, "warnings")));
    json_decref(object);
    bl_ran_free(&ran);
    // Data on standard output leave room for a warning.
    const char *const data[] = {"spectrum", "brick", "--quick", "-o", "-", NULL};
    ran = expect_warning(data, NULL, NULL, 1);
    bl_ran_free(&ran);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_line_is_on_one_side_of_the_limit),
        cmocka_unit_test(test_edges_leave_what_their_series_says),
        cmocka_unit_test(test_noises_leave_what_their_closed_form_says),
        cmocka_unit_test(test_registry_noises_are_resolved_at_the_usual_rate),
        cmocka_unit_test(test_each_axis_is_judged_alone),
        cmocka_unit_test(test_threads_change_nothing),
        cmocka_unit_test(test_rare_detail_is_seen),
        cmocka_unit_test(test_spectra_warn_with_the_rate_that_does),
        cmocka_unit_test(test_pictures_warn_with_what_does),
        cmocka_unit_test(test_scores_warn_of_what_they_do_not_resolve),
        cmocka_unit_test(test_what_is_resolved_is_not_warned_of),
        cmocka_unit_test(test_warnings_are_told_once_and_hushed),
    };
    return bl_run_tests(tests);
}
