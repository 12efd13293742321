// SPDX-License-Identifier: MIT
//
// A run ends at its first failure: nothing is written or claimed after it, its message is the one
// that is reported, and all that the figure opened is released, as it is when all goes well.
#include "tests/temporary.h"
#include "tests/test.h"

#include <unistd.h>

#include "reports/figures/gallery.h"
#include "reports/measure.h"
#include "reports/reproduce.h"

static int released[8], release_count; // the things that were, in their order
static int things[8] = {0, 1, 2, 3, 4, 5, 6, 7};

static void note_release(void *thing) {
    released[release_count++] = *(int *)thing;
}

// Runs a figure of its own alone, in a folder of its name.
static bl_status run_alone(const char *name, void (*run)(bl_run *run), bl_reproduction *result,
                           bl_message *message) {
    const bl_figure figure = {.name = name,
                              .title = "a test",
                              .question = "Does it hold?",
                              .paper = "bandlimit",
                              .shows = "nothing",
                              .run = run},
                    *const figures[] = {&figure};
    bl_reproduce_settings settings = bl_reproduce_default_settings();
    settings.folder = bl_temporary_path("runs");
    settings.size = BL_QUICK;
    settings.figures = figures;
    settings.figure_count = 1;
    release_count = 0;
    *message = (bl_message){""};
    return bl_reproduce(NULL, 0, &settings, result, message);
}

static int exists(const char *file) {
    char path[512];
    snprintf(path, sizeof path, "%s/%s", bl_temporary_path("runs"), file);
    return access(path, F_OK) == 0;
}

static void write_rows(bl_run *run, const char *name) {
    static const double values[] = {1, 2};
    const bl_column column = {"number", values, NULL};
    bl_run_csv(run, name, "two rows", &column, 1, 2);
}

static void claim(bl_run *run) {
    bl_run_claim(run, &(bl_claim){.sentence = "It holds.",
                                  .source = "bandlimit",
                                  .reading = "",
                                  .unit = "",
                                  .measured = {.level = 1, .samples = 1}});
}

// --- all goes well ------------------------------------------------------------------------------

static void run_well(bl_run *run) {
    for (int i = 0; i < 3; i++)
        assert_ptr_equal(bl_run_keep(run, &things[i], note_release), &things[i]);
    bl_run_release(run, &things[1]);
    assert_int_equal(release_count, 1);
    const double *numbers = bl_run_memory(run, 100, sizeof *numbers);
    for (int i = 0; i < 100; i++)
        assert_true(numbers[i] == 0);
    assert_non_null(bl_run_memory(run, 0, 8));
    write_rows(run, "rows");
    claim(run);
}

static void test_what_a_figure_took_is_released_when_it_has_ended(void **state) {
    (void)state;
    bl_message message;
    bl_reproduction result;
    if (run_alone("well", run_well, &result, &message) != BL_OK)
        fail_msg("%s", message.text);
    assert_int_equal(release_count, 3); // each of them once, the last first
    assert_int_equal(released[0], 1);
    assert_int_equal(released[1], 2);
    assert_int_equal(released[2], 0);
    assert_int_equal(result.figures[0].claim_count, 1);
    assert_int_equal(result.figures[0].file_count, 2);
    assert_string_equal(result.figures[0].files[0], "rows.csv");
    assert_string_equal(result.figures[0].files[1], "well.json");
    assert_true(exists("well/rows.csv"));
    bl_reproduction_free(&result);
}

// --- the first failure --------------------------------------------------------------------------

static int went_on;

static void run_badly(bl_run *run) {
    bl_run_keep(run, &things[3], note_release);
    const bl_signal *signal = bl_run_signal(run, "gnoise");
    bl_run_keep(run, &things[4], note_release);
    write_rows(run, "before");
    bl_run_setting(run, "signal", signal->text);
    bl_run_signal(run, "gnoize");
    went_on = 1;
    write_rows(run, "after");
    claim(run);
    bl_run_signal(run, "vnoize");
}

static void test_nothing_is_done_after_the_first_failure(void **state) {
    (void)state;
    bl_message message;
    bl_reproduction result;
    went_on = 0;
    assert_int_equal(run_alone("badly", run_badly, &result, &message), BL_USAGE);
    assert_non_null(strstr(message.text, "gnoize"));
    assert_non_null(strstr(message.text, "gnoise")); // the nearest
    assert_null(strstr(message.text, "vnoize"));
    assert_false(went_on);
    assert_true(exists("badly/before.csv"));
    assert_false(exists("badly/after.csv"));
    assert_false(exists("badly/badly.json"));
    assert_int_equal(release_count, 2);
    assert_int_equal(released[0], 4);
    assert_int_equal(released[1], 3);
}

// Everything that can fail, with something open that must be released.

static void fail_at_a_gallery(bl_run *run) {
    static const char *const texts[] = {"gnoise", "vnoise", "no noise"};
    bl_gallery_open(run, texts, 3);
}

static void fail_at_a_view(bl_run *run) {
    bl_run_view(run, "flat:scale=2", 8, 8);
    bl_run_view(run, "flat:scale=two", 8, 8);
}

static void fail_at_a_method(bl_run *run) {
    const bl_signal *brick = bl_run_signal(run, "brick");
    bl_run_method(run, "supersample:n=2", brick);
    bl_run_method(run, "supersample:m=2", brick);
}

static void fail_at_a_psd(bl_run *run) {
    bl_psd_settings settings = bl_run_psd_settings(run, 1);
    const bl_signal *signal = bl_run_signal(run, "gnoise");
    settings.averages = 2;
    settings.size = 64;
    assert_true(bl_run_psd(run, signal, &settings)->count > 0);
    settings.size = 4;
    bl_run_psd(run, signal, &settings);
}

static void fail_at_a_misfit(bl_run *run) {
    bl_psd_settings settings = bl_run_psd_settings(run, 3);
    const bl_signal *signal = bl_run_signal(run, "gnoise:dims=2");
    bl_message why = {""};
    assert_null(bl_run_fitting_psd(run, signal, &settings, &why));
    assert_true(why.text[0]);
    bl_run_psd(run, signal, &settings);
}

static void fail_at_a_histogram(bl_run *run) {
    bl_histogram_settings settings = bl_run_histogram_settings(run, 100);
    const bl_signal *signal = bl_run_signal(run, "gnoise");
    assert_int_equal(bl_run_histogram(run, signal, &settings)->count, 100);
    settings.samples = 0;
    bl_run_histogram(run, signal, &settings);
}

static void fail_at_an_alias(bl_run *run) {
    static const char *const methods[] = {"point", "no method"};
    const bl_alias_settings settings = bl_run_alias_settings(run, 2, 4);
    bl_run_alias(run, bl_run_signal(run, "brick"), bl_run_view(run, "flat:scale=2", 8, 8), methods,
                 2, &settings);
}

static void fail_at_a_table(bl_run *run) {
    static const float pixels[] = {0, 1, 2, NAN};
    bl_run_summed_area(run, pixels, 1, BL_SUMS_DOUBLE);
    bl_run_summed_area(run, pixels, 2, BL_SUMS_DOUBLE);
}

static void fail_at_a_file(bl_run *run) {
    write_rows(run, "no-such-folder/rows");
}

static void fail_at_a_plot(bl_run *run) {
    const bl_series series = {.file = "none.csv", .x = "x", .y = "y"};
    const bl_panel panel = {.series = &series, .series_count = 1};
    bl_run_plot(run, "plot", &(bl_plot){.panels = &panel, .panel_count = 1, .columns = 1}, "");
}

static void fail_at_an_image(bl_run *run) {
    static const float value = 1;
    bl_run_image(run, "no-such-folder/image",
                 &(bl_image){.width = 1, .height = 1, .values = &value, .white = 1});
}

static void fail_by_itself(bl_run *run) {
    bl_run_must(run, bl_report(bl_run_message(run), BL_MISMATCH, "it does not fit"));
}

static void test_whatever_fails_is_reported_and_leaves_nothing_open(void **state) {
    (void)state;
    static const struct {
        void (*run)(bl_run *run);
        bl_status status;
        const char *words;
    } failing[] = {{fail_at_a_gallery, BL_USAGE, "no noise"},
                   {fail_at_a_view, BL_USAGE, "two"},
                   {fail_at_a_method, BL_USAGE, "'m'"},
                   {fail_at_a_psd, BL_USAGE, "too few"},
                   {fail_at_a_misfit, BL_MISMATCH, "dimensions"},
                   {fail_at_a_histogram, BL_USAGE, "sample"},
                   {fail_at_an_alias, BL_USAGE, "no method"},
                   {fail_at_a_table, BL_USAGE, "finite"},
                   {fail_at_a_file, BL_DEVICE, "no-such-folder"},
                   {fail_at_a_plot, BL_DEVICE, "gnuplot"},
                   {fail_at_an_image, BL_DEVICE, "no-such-folder"},
                   {fail_by_itself, BL_MISMATCH, "it does not fit"}};
    for (size_t i = 0; i < sizeof failing / sizeof *failing; i++) {
        bl_message message;
        bl_reproduction result;
        bl_status status = run_alone("failing", failing[i].run, &result, &message);
        if (status != failing[i].status || !strstr(message.text, failing[i].words))
            fail_msg("%zu: status %d, %s", i, (int)status, message.text);
        assert_false(exists("failing/failing.json"));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_a_figure_took_is_released_when_it_has_ended),
        cmocka_unit_test(test_nothing_is_done_after_the_first_failure),
        cmocka_unit_test(test_whatever_fails_is_reported_and_leaves_nothing_open),
    };
    return bl_run_tests(tests);
}
