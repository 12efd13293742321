// SPDX-License-Identifier: MIT
#include "tests/temporary.h"
#include "tests/test.h"

#include <sys/stat.h>
#include <unistd.h>

#include "reports/page.h"
#include "reports/reproduce.h"

static const bl_figure figure = {.name = "example-1",
                                 .title = "An <example>",
                                 .question = "Is 1 < 2 & \"so on\"?",
                                 .paper = "nobody2000, fig. 1",
                                 .shows = "What <b>is</b> drawn."};
static const bl_run_note settings_notes[] = {{"signal", "gnoise:seed=7<script>"}};
static const bl_run_picture plots[] = {
    {.name = "drawing",
     .text = "A line that rises, \"quoted\".",
     .title = "Does it <rise>?",
     .keys = {{"closed & open", BL_STROKE_DASHED, BL_INK_THEORY}},
     .key_count = 1}};
static const char *files[] = {"drawing.svg", "data.csv"};
static const char svg[] = "<svg xmlns=\"http://www.w3.org/2000/svg\"/>";

static bl_claim claim_of(const char *sentence, const char *source, double value) {
    bl_claim claim = {.sentence = sentence,
                      .source = source,
                      .reading = "along a line",
                      .unit = "dB",
                      .expected_lower = 0,
                      .expected_upper = INFINITY,
                      .measured = {value, value - 0.5, value + 0.5, 0.95, 100},
                      .counted = "averages"};
    bl_claim_judge(&claim);
    return claim;
}

static char *write_example(const char *name) {
    mkdir(bl_temporary_path("example-1"), 0777);
    bl_temporary_write(bl_temporary_path("example-1/drawing.svg"), svg, sizeof svg - 1);
    bl_claim claims[] = {
        claim_of("It rises.", "nobody2000, p. 1", 1), claim_of("It rises.", "nobody2000, p. 1", -2),
        claim_of("It is <ours>.", "bandlimit", 3), claim_of("It is computed.", "bandlimit", 4),
        claim_of("It is an extreme.", "bandlimit", 5)};
    claims[3].measured = (bl_estimate){4, 4, 4, 1, 10};
    claims[4].measured = (bl_estimate){5, 5, 5, 0, 10};
    bl_figure_result result = {.figure = &figure,
                               .folder = bl_temporary_path("example-1"),
                               .files = files,
                               .file_count = 2,
                               .claims = claims,
                               .claim_count = 5};
    for (int i = 0; i < 5; i++)
        result.outcomes[bl_claim_outcome(&claims[i])]++;
    const bl_run_record view = {.result = &result,
                                .settings = settings_notes,
                                .setting_count = 1,
                                .plots = plots,
                                .plot_count = 1};
    bl_reproduce_settings settings = bl_reproduce_default_settings();
    bl_message message = {""};
    const char *path = bl_temporary_path(name);
    if (bl_page_write(path, &view, 1, &settings, &message) != BL_OK)
        fail_msg("%s", message.text);
    return bl_temporary_read(path, NULL);
}

static size_t count(const char *text, const char *word) {
    size_t found = 0;
    for (const char *at = text; (at = strstr(at, word)); at++)
        found++;
    return found;
}

static void test_the_page_stands_alone_and_has_no_script(void **state) {
    (void)state;
    char *page = write_example("alone.html");
    static const char *const absent[] = {"<script", "http://", "https://",
                                         "<link",   "@import", "url("};
    for (size_t i = 0; i < sizeof absent / sizeof *absent; i++)
        if (strstr(page, absent[i]))
            fail_msg("the page holds %s", absent[i]);
    // base64 of the SVG above, by coreutils: printf '<svg ...' | base64
    assert_non_null(strstr(page,
                           "data:image/svg+xml;base64,PHN2ZyB4bWxucz0iaHR0cDovL3d3dy53My5vcm"
                           "cvMjAwMC9zdmciLz4="));
    free(page);
}

static void test_texts_are_escaped(void **state) {
    (void)state;
    char *page = write_example("escaped.html");
    assert_non_null(strstr(page, "Is 1 &lt; 2 &amp; &quot;so on&quot;?"));
    assert_non_null(strstr(page, "gnoise:seed=7&lt;script&gt;"));
    assert_non_null(strstr(page, "It is &lt;ours&gt;."));
    assert_null(strstr(page, "<b>is</b>"));
    free(page);
}

static void test_each_picture_has_an_alternative_text_and_a_caption(void **state) {
    (void)state;
    char *page = write_example("alternative.html");
    assert_int_equal(count(page, "<img "), count(page, "alt=\"A line that rises"));
    assert_int_equal(count(page, "<figcaption>"), 1);
    free(page);
}

static void test_claims_are_tallied_grouped_and_judged(void **state) {
    (void)state;
    char *page = write_example("claims.html");
    assert_int_equal(count(page, "<tr class=\"claim\">"), 4); // two readings of one sentence
    assert_int_equal(count(page, "<tr><td"), 5);
    assert_non_null(strstr(page, "<b>4</b><span class=\"holds\">"));
    assert_non_null(strstr(page, "<b>1</b><span class=\"refuted\">"));
    assert_non_null(strstr(page, "What does not hold"));
    assert_non_null(strstr(page, "at least 0 dB"));
    assert_non_null(strstr(page, "-2.5 to -1.5 dB (95&nbsp;%)"));
    assert_non_null(strstr(page, "interval -2.5 to -1.5 dB")); // in the list of what does not hold
    assert_non_null(strstr(page, "100 averages"));
    free(page);
}

static void test_only_a_computed_number_is_called_exact(void **state) {
    (void)state;
    char *page = write_example("exact.html");
    assert_int_equal(count(page, "<span>exact</span>"), 1);
    assert_int_equal(count(page, "<span>not estimated</span>"), 1);
    free(page);
}

static void test_the_legend_of_a_plot_stands_in_text_too(void **state) {
    (void)state;
    char *page = write_example("legend.html");
    assert_non_null(strstr(page, "<b>Does it &lt;rise&gt;?</b>"));
    assert_non_null(strstr(page, "color:#D55E00\"></i>closed &amp; open</span>"));
    free(page);
}

static void test_links_lead_to_what_is_there(void **state) {
    (void)state;
    char *page = write_example("links.html");
    assert_int_equal(count(page, "id=\"example-1\""), 1);
    assert_non_null(strstr(page, "href=\"#example-1\""));
    assert_non_null(strstr(page, "href=\"example-1/data.csv\""));
    free(page);
}

static void test_the_elements_close(void **state) {
    (void)state;
    static const char *const names[] = {"section", "table", "tr", "td",
                                        "figure",  "ul",    "dl", "main"};
    char *page = write_example("closed.html");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char open[16], open_with[16], close[16];
        snprintf(open, sizeof open, "<%s>", names[i]);
        snprintf(open_with, sizeof open_with, "<%s ", names[i]);
        snprintf(close, sizeof close, "</%s>", names[i]);
        assert_int_equal(count(page, open) + count(page, open_with), count(page, close));
    }
    free(page);
}

static void test_a_missing_picture_or_folder_is_reported_and_leaves_no_page(void **state) {
    (void)state;
    free(write_example("before.html"));
    bl_figure_result result = {.figure = &figure, .folder = (char *)bl_temporary_path("nowhere")};
    const bl_run_record view = {.result = &result, .plots = plots, .plot_count = 1};
    bl_reproduce_settings settings = bl_reproduce_default_settings();
    bl_message message = {""};
    assert_int_equal(bl_page_write(bl_temporary_path("none.html"), &view, 1, &settings, &message),
                     BL_DEVICE);
    assert_non_null(strstr(message.text, "drawing.svg"));
    assert_int_not_equal(access(bl_temporary_path("none.html"), F_OK), 0);
    assert_int_equal(bl_page_write(bl_temporary_path("no/x.html"), NULL, 0, &settings, &message),
                     BL_DEVICE);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_page_stands_alone_and_has_no_script),
        cmocka_unit_test(test_texts_are_escaped),
        cmocka_unit_test(test_each_picture_has_an_alternative_text_and_a_caption),
        cmocka_unit_test(test_claims_are_tallied_grouped_and_judged),
        cmocka_unit_test(test_only_a_computed_number_is_called_exact),
        cmocka_unit_test(test_the_legend_of_a_plot_stands_in_text_too),
        cmocka_unit_test(test_links_lead_to_what_is_there),
        cmocka_unit_test(test_the_elements_close),
        cmocka_unit_test(test_a_missing_picture_or_folder_is_reported_and_leaves_no_page),
    };
    return bl_run_tests(tests);
}
