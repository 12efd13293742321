// SPDX-License-Identifier: MIT
#include "tests/temporary.h"
#include "tests/test.h"

#include <unistd.h>

#include "reports/plot.h"

static const char data[] =
    "# a comment, with a comma\nx,low,high,\"y, quoted\"\n"
    "0,0,1,0.5\n1,1,2,1.5\n2,,,\n3,1,4,2\n";

static const bl_series series[] = {
    {BL_STROKE_BAND, BL_INK_MEASURED, "data.csv", "x", "low", "high", "95 % band", 0},
    {BL_STROKE_LINE, BL_INK_MEASURED, "data.csv", "x", "y, quoted", NULL, "it's measured", 0},
    {BL_STROKE_DASHED, BL_INK_THEORY, "data.csv", "x", "low", NULL, "closed_form^2", 0},
    {BL_STROKE_POINTS, BL_INK_SECOND, "data.csv", "x", "high", NULL, NULL, 1}};
static const bl_panel panels[] = {
    {"first", series, 4, NULL}, {"second's", series, 2, NULL}, {"third", series, 1, NULL}};
static const bl_limit limits[] = {{1, 1, "Nyquist"}, {0, 0.5, "leak"}};

static bl_plot example(void) {
    return (bl_plot){.title = "What is drawn?",
                     .x = {"frequency, cycles per cell", 0, 3, 1},
                     .y = {"power, dB re variance", -1, 5, 0},
                     .panels = panels,
                     .panel_count = 3,
                     .columns = 2,
                     .limits = limits,
                     .limit_count = 2};
}

static char *draw(const bl_plot *plot, const char *name, int with_pdf) {
    bl_message message = {""};
    const char *folder = bl_temporary_folder();
    char file[64];
    bl_temporary_write(bl_temporary_path("data.csv"), data, sizeof data - 1);
    if (bl_plot_write(plot, folder, name, with_pdf, &message) != BL_OK ||
        bl_plot_run(folder, name, with_pdf, &message) != BL_OK)
        fail_msg("%s", message.text);
    snprintf(file, sizeof file, "%s.svg", name);
    return bl_temporary_read(bl_temporary_path(file), NULL);
}

static void test_a_plot_has_letters_titles_legend_and_limits(void **state) {
    (void)state;
    static const char *const wanted[] = {"What is drawn?", "(a) first",     "(b) second",
                                         "(c) third",      "it's measured", "closed_form^2",
                                         "95 % band",      "Nyquist",       "cycles per cell"};
    bl_plot plot = example();
    char *svg = draw(&plot, "letters", 0);
    assert_non_null(svg);
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++)
        if (!strstr(svg, wanted[i]) && !(i == 4 && strstr(svg, "it&apos;s measured")))
            fail_msg("the plot lacks '%s'", wanted[i]);
    free(svg);
}

static void test_a_plot_needs_no_title_on_itself_its_axes_or_its_panels(void **state) {
    (void)state;
    static const bl_panel bare[] = {{NULL, series, 2, NULL}, {"second", series, 2, NULL}};
    bl_plot plot = example();
    plot.title = plot.x.label = plot.y.label = NULL;
    plot.panels = bare;
    plot.panel_count = 2;
    char *svg = draw(&plot, "bare", 0);
    assert_non_null(svg);
    assert_non_null(strstr(svg, "(a) <"));
    assert_non_null(strstr(svg, "(b) second"));
    assert_null(strstr(svg, "null"));
    free(svg);
}

static void test_the_legend_is_that_of_the_panel_with_the_most_series(void **state) {
    (void)state;
    static const bl_panel poor_first[] = {
        {"first", series, 2, NULL}, {"second", series, 4, NULL}, {"third", series, 3, NULL}};
    bl_plot plot = example();
    plot.panels = poor_first;
    assert_ptr_equal(bl_plot_legend(&plot), &poor_first[1]);
    char *svg = draw(&plot, "legend", 0);
    assert_non_null(svg);
    assert_non_null(strstr(svg, "closed_form^2"));
    free(svg);
}

static void test_a_plot_is_the_same_bytes_every_time(void **state) {
    (void)state;
    bl_plot plot = example();
    char *first = draw(&plot, "same", 0), *second = draw(&plot, "same", 0);
    assert_string_equal(first, second);
    free(first);
    free(second);
}

static void test_the_script_runs_by_hand_in_its_folder(void **state) {
    (void)state;
    bl_plot plot = example();
    char *made = draw(&plot, "hand", 1);
    unlink(bl_temporary_path("hand.svg"));
    unlink(bl_temporary_path("hand.png"));
    unlink(bl_temporary_path("hand.pdf"));
    const char *const arguments[] = {"gnuplot", "hand.gp", NULL};
    assert_int_equal(bl_temporary_run(bl_temporary_folder(), arguments), 0);
    char *again = bl_temporary_read(bl_temporary_path("hand.svg"), NULL);
    assert_non_null(again);
    assert_string_equal(made, again);
    assert_int_equal(access(bl_temporary_path("hand.png"), R_OK), 0);
    assert_int_equal(access(bl_temporary_path("hand.pdf"), R_OK), 0);
    free(made);
    free(again);
}

static void test_a_failing_gnuplot_reports_what_it_said_and_leaves_no_picture(void **state) {
    (void)state;
    bl_message message = {""};
    static const char script[] =
        "set terminal svg\nset output prefix.'bad.svg'\nplot 'missing.csv'\n";
    bl_temporary_write(bl_temporary_path("bad.gp"), script, sizeof script - 1);
    assert_int_equal(bl_plot_run(bl_temporary_folder(), "bad", 0, &message), BL_DEVICE);
    assert_non_null(strstr(message.text, "missing.csv"));
    assert_int_not_equal(access(bl_temporary_path("bad.svg"), F_OK), 0);
    const char *const arguments[] = {"sh", "-c", "! ls -A | grep -- -bad", NULL};
    assert_int_equal(bl_temporary_run(bl_temporary_folder(), arguments), 0);
}

static void test_a_missing_gnuplot_says_what_to_install(void **state) {
    (void)state;
    bl_message message = {""};
    bl_plot plot = example();
    char *path = strdup(getenv("PATH"));
    assert_int_equal(bl_plot_write(&plot, bl_temporary_folder(), "none", 0, &message), BL_OK);
    setenv("PATH", bl_temporary_folder(), 1);
    bl_status status = bl_plot_run(bl_temporary_folder(), "none", 0, &message);
    setenv("PATH", path, 1);
    free(path);
    assert_int_equal(status, BL_DEVICE);
    assert_non_null(strstr(message.text, "install"));
}

static void test_a_missing_folder_is_reported(void **state) {
    (void)state;
    bl_message message = {""};
    bl_plot plot = example();
    assert_int_equal(bl_plot_write(&plot, bl_temporary_path("nowhere"), "x", 0, &message),
                     BL_DEVICE);
    assert_non_null(strstr(message.text, "nowhere"));
}

static void test_the_colours_of_the_palette_differ(void **state) {
    (void)state;
    for (int a = 0; a < BL_INK_COUNT; a++)
        for (int b = 0; b < a; b++)
            assert_string_not_equal(bl_ink_colour((bl_ink)a), bl_ink_colour((bl_ink)b));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_plot_has_letters_titles_legend_and_limits),
        cmocka_unit_test(test_a_plot_needs_no_title_on_itself_its_axes_or_its_panels),
        cmocka_unit_test(test_the_legend_is_that_of_the_panel_with_the_most_series),
        cmocka_unit_test(test_a_plot_is_the_same_bytes_every_time),
        cmocka_unit_test(test_the_script_runs_by_hand_in_its_folder),
        cmocka_unit_test(test_a_failing_gnuplot_reports_what_it_said_and_leaves_no_picture),
        cmocka_unit_test(test_a_missing_gnuplot_says_what_to_install),
        cmocka_unit_test(test_a_missing_folder_is_reported),
        cmocka_unit_test(test_the_colours_of_the_palette_differ),
    };
    return bl_run_tests(tests);
}
