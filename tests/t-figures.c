// SPDX-License-Identifier: MIT
//
// Walks the registry of figures: each is run at the quick size, and what it leaves behind is looked
// at as a user would.
#include "tests/temporary.h"
#include "tests/test.h"

#include <jansson.h>
#include <unistd.h>

#include "core/version.h"
#include "reports/figure.h"
#include "reports/reproduce.h"

static bl_reproduction first_run; // of all figures, shared by the tests

static bl_reproduce_settings quick(const char *name) {
    bl_reproduce_settings settings = bl_reproduce_default_settings();
    settings.folder = bl_temporary_path(name);
    settings.size = BL_QUICK;
    return settings;
}

static size_t steps_seen;

static void count_step(void *user, size_t done, size_t total, const char *figure,
                       const char *step) {
    assert_ptr_equal(user, &steps_seen);
    assert_true(done < total);
    assert_non_null(bl_figure_find(figure));
    assert_true(step[0]);
    steps_seen++;
}

static int run_all(void **state) {
    (void)state;
    bl_message message = {""};
    bl_reproduce_settings settings = quick("first");
    settings.progress = count_step;
    settings.user = &steps_seen;
    settings.arguments = "reproduce --quick";
    if (bl_reproduce(NULL, 0, &settings, &first_run, &message) != BL_OK)
        fail_msg("%s", message.text);
    return 0;
}

static int free_all(void **state) {
    (void)state;
    bl_reproduction_free(&first_run);
    return 0;
}

static char *path_in(const bl_figure_result *figure, const char *file) {
    char *path = NULL;
    assert_true(asprintf(&path, "%s/%s", figure->folder, file) > 0);
    return path;
}

static void test_every_figure_of_the_registry_says_what_it_is(void **state) {
    (void)state;
    assert_true(bl_figure_count() >= 3);
    for (size_t i = 0; i < bl_figure_count(); i++) {
        const bl_figure *figure = bl_figure_at(i);
        assert_true(figure->name[0] && figure->title[0] && figure->shows[0] && figure->run);
        assert_int_equal(figure->question[strlen(figure->question) - 1], '?');
        assert_true(strlen(figure->paper) > 5);
        assert_ptr_equal(bl_figure_find(figure->name), figure);
        for (size_t j = 0; j < i; j++)
            assert_string_not_equal(figure->name, bl_figure_at(j)->name);
    }
    assert_null(bl_figure_at(bl_figure_count()));
    assert_null(bl_figure_find("no-such-figure"));
}

static void test_all_files_are_there_and_not_empty(void **state) {
    (void)state;
    assert_int_equal(first_run.count, bl_figure_count());
    assert_true(steps_seen >= first_run.count);
    for (size_t f = 0; f < first_run.count; f++)
        for (size_t i = 0; i < first_run.figures[f].file_count; i++) {
            size_t size = 0;
            char *path = path_in(&first_run.figures[f], first_run.figures[f].files[i]);
            char *text = bl_temporary_read(path, &size);
            if (!text || size == 0)
                fail_msg("%s is missing or empty", path);
            free(text);
            free(path);
        }
    assert_int_equal(access(first_run.page, R_OK), 0);
}

static int ends_with(const char *text, const char *ending) {
    size_t a = strlen(text), b = strlen(ending);
    return a >= b && strcmp(text + a - b, ending) == 0;
}

static void test_data_files_have_comments_one_header_and_even_rows(void **state) {
    (void)state;
    for (size_t f = 0; f < first_run.count; f++)
        for (size_t i = 0; i < first_run.figures[f].file_count; i++) {
            if (!ends_with(first_run.figures[f].files[i], ".csv"))
                continue;
            char *path = path_in(&first_run.figures[f], first_run.figures[f].files[i]);
            char *text = bl_temporary_read(path, NULL);
            size_t columns = 0, rows = 0;
            int in_head = 1;
            for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
                in_head = in_head && line[0] == '#';
                size_t fields = 1;
                int quoted = 0; // RFC 4180: a comma between quotes is part of a field
                for (const char *c = line; *c; c++) {
                    quoted ^= *c == '"';
                    fields += *c == ',' && !quoted;
                }
                if (in_head)
                    continue;
                assert_int_not_equal(line[0], '#');
                columns = columns ? columns : fields;
                assert_int_equal(fields, columns);
                rows++;
            }
            assert_true(columns >= 2 && rows >= 2);
            free(text);
            free(path);
        }
}

// With SCALE below 1 every fourth figure is run again, or its scripts are.
static int takes_figure(size_t index) {
    return bl_test_walk(bl_test_scaled(4, 0) >= 4 || index % 4 == 0);
}

static void test_gnuplot_scripts_run_again_by_hand(void **state) {
    (void)state;
    for (size_t f = 0; f < first_run.count; f++) {
        const size_t files = takes_figure(f) ? first_run.figures[f].file_count : 0;
        for (size_t i = 0; i < files; i++) {
            const char *file = first_run.figures[f].files[i];
            if (!ends_with(file, ".gp"))
                continue;
            char picture[128];
            snprintf(picture, sizeof picture, "%.*s.svg", (int)strlen(file) - 3, file);
            char *path = path_in(&first_run.figures[f], picture);
            char *before = bl_temporary_read(path, NULL);
            unlink(path);
            const char *const arguments[] = {"gnuplot", file, NULL};
            if (bl_temporary_run(first_run.figures[f].folder, arguments) != 0)
                fail_msg("gnuplot %s fails", file);
            char *after = bl_temporary_read(path, NULL);
            assert_non_null(after);
            assert_string_equal(before, after);
            free(before);
            free(after);
            free(path);
        }
    }
}

static void test_no_claim_of_our_own_is_broken(void **state) {
    (void)state;
    for (size_t f = 0; f < first_run.count; f++) {
        const bl_figure_result *figure = &first_run.figures[f];
        size_t total = 0;
        assert_true(figure->claim_count > 0);
        for (size_t i = 0; i < figure->claim_count; i++) {
            const bl_claim *claim = &figure->claims[i];
            const bl_estimate *m = &claim->measured;
            assert_true(claim->sentence[0] && claim->source[0] && claim->reading[0]);
            if (bl_claim_outcome(claim) == BL_BROKEN || claim->verdict == BL_VERDICT_NOT_RUN)
                fail_msg("%s: %s (%s): %s, measured %g in [%g, %g], expected %g to %g",
                         figure->figure->name, claim->sentence, claim->reading,
                         bl_outcome_word(bl_claim_outcome(claim)), m->value, m->lower, m->upper,
                         claim->expected_lower, claim->expected_upper);
            assert_true(m->lower <= m->value && m->value <= m->upper);
            assert_true(m->samples >= 1);
        }
        for (int v = 0; v <= BL_NOT_RUN; v++)
            total += figure->outcomes[v];
        assert_int_equal(total, figure->claim_count);
    }
    assert_int_not_equal(first_run.verdict, BL_VERDICT_FAIL);
}

static void test_json_agrees_with_the_result(void **state) {
    (void)state;
    for (size_t f = 0; f < first_run.count; f++) {
        const bl_figure_result *figure = &first_run.figures[f];
        char name[128];
        snprintf(name, sizeof name, "%s.json", figure->figure->name);
        char *path = path_in(figure, name);
        json_error_t error;
        json_t *json = json_load_file(path, 0, &error);
        if (!json)
            fail_msg("%s: %s", path, error.text);
        assert_string_equal(json_string_value(json_object_get(json, "schema")),
                            "bandlimit.figure/1");
        assert_string_equal(json_string_value(json_object_get(json, "version")), BL_VERSION);
        assert_string_equal(json_string_value(json_object_get(json, "arguments")),
                            "reproduce --quick");
        json_t *claims = json_object_get(json, "claims"),
               *settings = json_object_get(json, "settings");
        assert_int_equal(json_array_size(claims), figure->claim_count);
        assert_true(json_object_size(settings) > 0);
        assert_int_equal(json_array_size(json_object_get(json, "files")), figure->file_count);
        for (size_t i = 0; i < figure->claim_count; i++) {
            json_t *claim = json_array_get(claims, i);
            assert_string_equal(json_string_value(json_object_get(claim, "verdict")),
                                bl_outcome_word(bl_claim_outcome(&figure->claims[i])));
            assert_int_equal(json_array_size(json_object_get(claim, "interval")), 2);
            int estimated = figure->claims[i].measured.level > 0; // else there is no interval
            assert_int_equal(json_is_null(json_object_get(claim, "level")), !estimated);
            assert_true(json_string_length(json_object_get(claim, "samples_of")) > 0);
        }
        json_decref(json);
        free(path);
    }
}

// docs/findings.md is made from these very claims.
static void test_the_findings_are_what_was_measured(void **state) {
    (void)state;
    char *command, *made = strdup(bl_temporary_path("findings.md"));
    assert_true(asprintf(&command, "sh docs/findings.sh '%s' > '%s'", bl_temporary_path("first"),
                         made) > 0);
    assert_int_equal(system(command), 0);
    char *expected = bl_temporary_read(made, NULL),
         *found = bl_temporary_read("docs/findings.md", NULL);
    if (strcmp(expected, found) != 0)
        fail_msg("docs/findings.md is not what the figures found; run make docs:\n%s", expected);
    free(command);
    free(made);
    free(expected);
    free(found);
}

static const bl_figure_result *in_first_run(const bl_figure *figure) {
    for (size_t f = 0; f < first_run.count; f++)
        if (first_run.figures[f].figure == figure)
            return &first_run.figures[f];
    fail_msg("%s did not run", figure->name);
    return NULL;
}

// The same settings give the same bytes, on any number of threads, but of times.
static void test_a_second_run_on_one_thread_leaves_the_same_bytes(void **state) {
    (void)state;
    bl_message message = {""};
    bl_reproduction second;
    bl_reproduce_settings settings = quick("second");
    settings.threads = 1;
    settings.arguments = "reproduce --quick";
    const char *names[256];
    size_t count = 0;
    for (size_t i = 0; i < bl_figure_count() && count < 256; i++)
        if (takes_figure(i) && !bl_figure_at(i)->timed)
            names[count++] = bl_figure_at(i)->name;
    if (bl_reproduce(names, count, &settings, &second, &message) != BL_OK)
        fail_msg("%s", message.text);
    for (size_t f = 0; f < second.count; f++) {
        const bl_figure_result *first_of_it = in_first_run(second.figures[f].figure);
        assert_int_equal(second.figures[f].file_count, first_of_it->file_count);
        for (size_t i = 0; i < second.figures[f].file_count; i++) {
            size_t a = 0, b = 0;
            char *here = path_in(first_of_it, first_of_it->files[i]);
            char *there = path_in(&second.figures[f], second.figures[f].files[i]);
            char *first = bl_temporary_read(here, &a), *again = bl_temporary_read(there, &b);
            if (a != b || memcmp(first, again, a) != 0)
                fail_msg("%s differs from %s", here, there);
            free(first);
            free(again);
            free(here);
            free(there);
        }
    }
    bl_reproduction_free(&second);
}

static void test_bad_requests_are_refused_before_anything_runs(void **state) {
    (void)state;
    bl_message message = {""};
    bl_reproduction result;
    bl_reproduce_settings settings = quick("refused");
    const char *const unknown[] = {"peachey-2.73"}, *const twice[] = {"peachey-2.35",
                                                                      "peachey-2.35"};
    assert_int_equal(bl_reproduce(unknown, 1, &settings, &result, &message), BL_USAGE);
    assert_non_null(strstr(message.text, "did you mean"));
    assert_int_equal(bl_reproduce(twice, 2, &settings, &result, &message), BL_USAGE);
    settings.format = "bmp";
    assert_int_equal(bl_reproduce(twice, 1, &settings, &result, &message), BL_USAGE);
    assert_int_not_equal(access(bl_temporary_path("refused"), F_OK), 0);
    settings = quick("refused");
    settings.folder = "/dev/null/out";
    assert_int_equal(bl_reproduce(twice, 1, &settings, &result, &message), BL_DEVICE);
    assert_non_null(strstr(message.text, "/dev/null"));
}

static void test_one_figure_alone_can_be_had_with_pdf(void **state) {
    (void)state;
    bl_message message = {""};
    bl_reproduction result;
    bl_reproduce_settings settings = quick("alone");
    settings.format = "pdf";
    const char *const names[] = {"peachey-2.35"};
    if (bl_reproduce(names, 1, &settings, &result, &message) != BL_OK)
        fail_msg("%s", message.text);
    assert_int_equal(result.count, 1);
    size_t pdfs = 0;
    for (size_t i = 0; i < result.figures[0].file_count; i++)
        pdfs += (size_t)ends_with(result.figures[0].files[i], ".pdf");
    assert_int_equal(pdfs, 1);
    bl_reproduction_free(&result);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_findings_are_what_was_measured),
        cmocka_unit_test(test_every_figure_of_the_registry_says_what_it_is),
        cmocka_unit_test(test_all_files_are_there_and_not_empty),
        cmocka_unit_test(test_data_files_have_comments_one_header_and_even_rows),
        cmocka_unit_test(test_gnuplot_scripts_run_again_by_hand),
        cmocka_unit_test(test_no_claim_of_our_own_is_broken),
        cmocka_unit_test(test_json_agrees_with_the_result),
        cmocka_unit_test(test_a_second_run_on_one_thread_leaves_the_same_bytes),
        cmocka_unit_test(test_bad_requests_are_refused_before_anything_runs),
        cmocka_unit_test(test_one_figure_alone_can_be_had_with_pdf),
    };
    bl_set_filter();
    return cmocka_run_group_tests(tests, run_all, free_all);
}
