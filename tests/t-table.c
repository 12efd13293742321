// SPDX-License-Identifier: MIT
//
// Tables and records: one declaration, told as text, CSV, JSON and HTML. CSV is read back by a
// strict reader below, JSON by jansson.
#include "tests/test.h"

#include "core/plain.h"
#include "core/statistics.h"
#include "core/table.h"
#include "reports/html.h"
#include "reports/table_json.h"

typedef struct way {
    const char *name;
    char letters[16];
    bl_estimate error;
    double real, lower_first[3], list[3];
    size_t count;
    unsigned number;
    int flag;
    bl_verdict verdict;
} way;

static int is_counted(const void *row) {
    return ((const way *)row)->count != 0;
}

static void find_double(const bl_table *table, size_t row, bl_cell *cell) {
    cell->value = 2 * ((const way *)table->rows)[row].real + *(const double *)table->context;
}

static void find_word(const bl_table *table, size_t row, bl_cell *cell) {
    snprintf(cell->text, sizeof cell->text, "way %zu of %zu", row + 1, table->count);
    cell->word = cell->text;
}

#define AT(member) .offset = offsetof(way, member)
static const bl_field fields[] = {
    {"flag", "", BL_CELL_FLAG, AT(flag)},
    {"way", "way", BL_CELL_WORD, AT(name)},
    {"error", "error", BL_CELL_ESTIMATE, AT(error), .digits = 3, .limits = ""},
    {"band", NULL, BL_CELL_ESTIMATE, AT(lower_first), .bare_limits = 1},
    {"real", "real", BL_CELL_REAL, AT(real), .decimals = 2, .unit = "cells"},
    {"twice", NULL, BL_CELL_REAL, .find = find_double},
    {"count", "count", BL_CELL_COUNT, AT(count), .when = is_counted},
    {"rare", NULL, BL_CELL_COUNT, AT(count), .when = is_counted, .absent = 1, .forms = BL_IN_JSON},
    {"number", NULL, BL_CELL_UNSIGNED, AT(number), .forms = BL_IN_CSV},
    {"verdict", "verdict", BL_CELL_VERDICT, AT(verdict)},
    {"list", NULL, BL_CELL_LIST, AT(list), .length = 3},
    {"letters", "letters", BL_CELL_LETTERS, AT(letters)},
    {"which", NULL, BL_CELL_WORD, .find = find_word},
    {0}};
#undef AT

enum { WAYS = 3 };
static const way ways[WAYS] = {{"box",
                                "ab",
                                {0.0962, 0.0961, 0.0963, 0, 0},
                                -0.0,
                                {1, 0.5, 2},
                                {1, 2, 3},
                                7,
                                3,
                                1,
                                BL_VERDICT_PASS},
                               {"a, \"b\"\n<i>&\033[31m\xff",
                                "\u00e9t\u00e9",
                                {1.0 / 3, -INFINITY, NAN, 0, 0},
                                1e300,
                                {0.1, NAN, INFINITY},
                                {NAN, INFINITY, 0.1},
                                0,
                                0,
                                0,
                                BL_VERDICT_FAIL},
                               {NULL,
                                "",
                                {NAN, NAN, NAN, 0, 0},
                                NAN,
                                {NAN, NAN, NAN},
                                {0, 0, 0},
                                SIZE_MAX,
                                4000000000,
                                1,
                                BL_VERDICT_NOT_RUN}};
static const double more = 1;
static const bl_table table = {.fields = fields,
                               .rows = ways,
                               .count = WAYS,
                               .stride = sizeof *ways,
                               .level = 0.95,
                               .context = &more};

// What a writer writes; the caller frees it.
static char *told(void (*write)(const bl_table *table, FILE *out), const bl_table *what) {
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    write(what, out);
    fclose(out);
    return text;
}

static void write_html(const bl_table *what, FILE *out) {
    bl_table_html(what, "ways", out);
}

// --- text ---------------------------------------------------------------------------------------

static void test_text_is_aligned_and_shows_no_control_bytes(void **state) {
    (void)state;
    bl_table small = table;
    small.count = 2;
    char *text = told(bl_table_print, &small);
    assert_string_equal(
        text,
        "   way                          error  95 % interval       real  count  "
        "verdict  letters\n"
        "*  box                         0.0962  0.0961 to 0.0963    0.00      7  "
        "pass     ab\n"
        "   a, \"b\"\\x0a<i>&\\x1b[31m\\xff   0.333  -                 1e+300      -  "
        "fail     \u00e9t\u00e9\n");
    free(text);
}

static void test_a_long_word_widens_its_column_and_the_last_one_wraps(void **state) {
    (void)state;
    static const struct {
        const char *name, *reason;
    } rows[] = {{"x", "short"},
                {"a name of thirty letters or so",
                 "a reason so long that it cannot stand on one line of a hundred letters, so that "
                 "it goes on below where it began, twice if it must, until all of it is told"}};
    static const bl_field named[] = {{"name", "name", BL_CELL_WORD, .offset = 0},
                                     {"reason", "reason", BL_CELL_WORD, .offset = sizeof(char *)},
                                     {0}};
    const bl_table what = {.fields = named, .rows = rows, .count = 2, .stride = sizeof *rows};
    char *text = told(bl_table_print, &what), *rest = NULL;
    size_t lines = 0;
    for (char *line = strtok_r(text, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest)) {
        assert_true(strlen(line) <= 100);
        assert_true(line[strlen(line) - 1] != ' ');
        if (lines > 2)
            assert_int_equal(strspn(line, " "), strlen("a name of thirty letters or so") + 2);
        lines++;
    }
    assert_int_equal(lines, 5);
    free(text);
}

static void test_colours_are_not_counted_as_letters(void **state) {
    (void)state;
    bl_table coloured = table;
    coloured.coloured = 1;
    char *plain = told(bl_table_print, &table), *colours = told(bl_table_print, &coloured), *to;
    assert_non_null(strstr(colours, "\033[31m"));
    to = colours;
    for (const char *from = colours; *from;)
        if (*from == '\033')
            from = strchr(from, 'm') + 1;
        else
            *to++ = *from++;
    *to = '\0';
    assert_string_equal(plain, colours);
    free(plain);
    free(colours);
}

static void test_a_column_that_no_row_has_is_left_out_of_the_text(void **state) {
    (void)state;
    bl_table last = table;
    last.rows = &ways[2];
    last.count = 1;
    char *text = told(bl_table_print, &last);
    assert_null(strstr(text, "error"));
    assert_null(strstr(text, "real"));
    assert_non_null(strstr(text, "count"));
    assert_null(strstr(text, "way"));
    free(text);
}

static void test_a_record_is_told_a_value_a_line(void **state) {
    (void)state;
    bl_table record = table;
    record.count = 1;
    char *text = told(bl_record_print, &record);
    assert_non_null(
        strstr(text, "way      box\nerror    0.0962   95 % interval 0.0961 to 0.0963\n"));
    assert_non_null(strstr(text, "real     0.00 cells\n"));
    free(text);
}

// --- CSV ----------------------------------------------------------------------------------------

enum { FIELDS = 32, FIELD_SIZE = 256 };

// Reads one record, strictly as RFC 4180 has it except for the line feed; NULL at the end.
static const char *read_record(const char *at, char found[FIELDS][FIELD_SIZE], size_t *count) {
    *count = 0;
    if (!*at)
        return NULL;
    for (;;) {
        size_t length = 0;
        assert_true(*count < FIELDS);
        char *field = found[(*count)++];
        if (*at == '"') {
            for (at++; *at != '"' || at[1] == '"'; at++) {
                assert_true(*at && length + 1 < FIELD_SIZE);
                at += *at == '"';
                field[length++] = *at;
            }
            at++;
        } else {
            while (*at != ',' && *at != '\n') {
                assert_true(*at && *at != '"' && *at != '\r' && length + 1 < FIELD_SIZE);
                field[length++] = *at++;
            }
        }
        field[length] = '\0';
        assert_true(*at == ',' || *at == '\n');
        if (*at++ == '\n')
            return at;
    }
}

static void expect_number(const char *text, double number) {
    char *end;
    if (!isfinite(number)) {
        assert_string_equal(text, "");
        return;
    }
    assert_true(*text);
    assert_near(strtod(text, &end), number, 5e-9 * fabs(number));
    assert_int_equal(*end, '\0');
}

static void test_csv_is_read_back_by_a_strict_reader(void **state) {
    (void)state;
    static char header[FIELDS][FIELD_SIZE], row[FIELDS][FIELD_SIZE];
    static const char *const names[] = {"flag",  "way",    "error",   "error_lower", "error_upper",
                                        "band",  "lower",  "upper",   "real",        "twice",
                                        "count", "number", "verdict", "letters",     "which"};
    char *text = told(bl_table_csv, &table);
    size_t columns, count;
    const char *at = read_record(text, header, &columns);
    assert_int_equal(columns, sizeof names / sizeof *names);
    for (size_t i = 0; i < columns; i++)
        assert_string_equal(header[i], names[i]);
    for (size_t i = 0; i < WAYS; i++) {
        const way *w = &ways[i];
        at = read_record(at, row, &count);
        assert_non_null(at);
        assert_int_equal(count, columns);
        assert_string_equal(row[0], w->flag ? "1" : "0");
        assert_string_equal(row[1], w->name ? w->name : "");
        expect_number(row[2], w->error.value);
        expect_number(row[3], w->error.lower);
        expect_number(row[4], w->error.upper);
        expect_number(row[6], w->lower_first[1]);
        expect_number(row[8], w->real);
        expect_number(row[9], 2 * w->real + 1);
        assert_string_equal(row[13], w->letters);
    }
    assert_string_equal(row[10], "18446744073709551615");
    assert_string_equal(row[11], "4000000000");
    assert_string_equal(row[12], bl_verdict_word(BL_VERDICT_NOT_RUN));
    assert_string_equal(row[14], "way 3 of 3");
    assert_null(read_record(at, row, &count));
    free(text);
}

static void test_a_record_in_csv_is_comments_of_one_line_each(void **state) {
    (void)state;
    const bl_table record = BL_RECORD(fields, &ways[1]);
    bl_table with = record;
    with.context = &more;
    char *text = told(bl_record_csv, &with), *rest = NULL;
    assert_non_null(strstr(text, "# error: 0.333333333\n"));
    assert_null(strstr(text, "error_lower"));
    assert_null(strstr(text, "# count"));
    for (char *line = strtok_r(text, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest)) {
        assert_memory_equal(line, "# ", 2);
        assert_null(strchr(line, '\033'));
    }
    free(text);
}

// --- JSON ---------------------------------------------------------------------------------------

static void expect_json_number(const json_t *object, const char *key, double number) {
    const json_t *value = json_object_get(object, key);
    if (!value)
        fail_msg("no key %s", key);
    if (isfinite(number))
        assert_true(json_real_value(value) == number);
    else
        assert_true(json_is_null(value));
}

static void test_json_is_read_back_with_every_bit(void **state) {
    (void)state;
    json_t *made = bl_table_json(&table);
    char *text = json_dumps(made, JSON_REAL_PRECISION(17));
    json_t *rows = json_loads(text, 0, NULL);
    assert_int_equal(json_array_size(rows), WAYS);
    for (size_t i = 0; i < WAYS; i++) {
        const json_t *row = json_array_get(rows, i);
        expect_json_number(row, "error", ways[i].error.value);
        expect_json_number(row, "error_lower", ways[i].error.lower);
        expect_json_number(row, "error_upper", ways[i].error.upper);
        expect_json_number(row, "lower", ways[i].lower_first[1]);
        expect_json_number(row, "upper", ways[i].lower_first[2]);
        expect_json_number(row, "real", ways[i].real);
        assert_true(json_is_boolean(json_object_get(row, "flag")));
        assert_int_equal(json_array_size(json_object_get(row, "list")), 3);
        assert_null(json_object_get(row, "number"));
        assert_int_equal(json_object_get(row, "rare") != NULL, ways[i].count != 0);
        assert_int_equal(json_is_null(json_object_get(row, "count")), ways[i].count == 0);
    }
    assert_true(json_is_null(json_object_get(json_array_get(rows, 2), "way")));
    assert_string_equal(json_string_value(json_object_get(json_array_get(rows, 2), "count")),
                        "18446744073709551615"); // beyond the integers of JSON here
    json_decref(rows);
    json_decref(made);
    free(text);
}

// --- HTML ---------------------------------------------------------------------------------------

static void test_html_lets_no_mark_of_the_users_through(void **state) {
    (void)state;
    char *text = told(write_html, &table);
    assert_non_null(strstr(text, "<table class=\"ways\">"));
    assert_non_null(strstr(text, "<th>real, cells</th>"));
    assert_non_null(strstr(text, "<td data-label=\"95 % interval\">0.0961 to 0.0963</td>"));
    assert_non_null(strstr(text, "&lt;i&gt;&amp;"));
    assert_null(strstr(text, "<i>"));
    free(text);
}

// --- columns that are arrays --------------------------------------------------------------------

static void test_a_struct_of_arrays_is_a_table_of_their_columns(void **state) {
    (void)state;
    static const double x[] = {0, 0.5, 1};
    static const bl_estimate y[] = {{1, 0, 2, 0, 0}, {2, 1, 3, 0, 0}, {3, 2, 4, 0, 0}};
    static const struct {
        const double *x;
        const bl_estimate *y;
        const double *theory, *never;
    } arrays = {x, y, NULL, NULL};
    const bl_field columns[] = {
        {"x", "x", BL_CELL_REAL, .offset = 0},
        {"y", "y", BL_CELL_ESTIMATE, .offset = sizeof x[0], .bare_limits = 1},
        {"theory", "theory", BL_CELL_REAL, .offset = 2 * sizeof x[0]},
        {"never", "never", BL_CELL_REAL, .offset = 3 * sizeof x[0], .optional = 1},
        {0}};
    const bl_table what = {.fields = columns, .rows = &arrays, .count = 3};
    char *text = told(bl_table_csv, &what);
    assert_string_equal(text, "x,y,lower,upper,theory\n0,1,0,2,\n0.5,2,1,3,\n1,3,2,4,\n");
    free(text);
    json_t *object = json_object();
    bl_table_json_columns(object, &what);
    assert_int_equal(json_array_size(json_object_get(object, "x")), 3);
    assert_true(json_real_value(json_array_get(json_object_get(object, "upper"), 2)) == 4);
    assert_true(json_is_null(json_object_get(object, "theory")));
    assert_null(json_object_get(object, "never"));
    json_decref(object);
}

static void test_an_empty_table_is_its_headings(void **state) {
    (void)state;
    bl_table empty = table;
    empty.count = 0;
    char *csv = told(bl_table_csv, &empty), *text = told(bl_table_print, &empty);
    assert_ptr_equal(strchr(csv, '\n'), csv + strlen(csv) - 1);
    assert_ptr_equal(strchr(text, '\n'), text + strlen(text) - 1);
    json_t *rows = bl_table_json(&empty);
    assert_int_equal(json_array_size(rows), 0);
    json_decref(rows);
    free(csv);
    free(text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_text_is_aligned_and_shows_no_control_bytes),
        cmocka_unit_test(test_a_long_word_widens_its_column_and_the_last_one_wraps),
        cmocka_unit_test(test_colours_are_not_counted_as_letters),
        cmocka_unit_test(test_a_column_that_no_row_has_is_left_out_of_the_text),
        cmocka_unit_test(test_a_record_is_told_a_value_a_line),
        cmocka_unit_test(test_csv_is_read_back_by_a_strict_reader),
        cmocka_unit_test(test_a_record_in_csv_is_comments_of_one_line_each),
        cmocka_unit_test(test_json_is_read_back_with_every_bit),
        cmocka_unit_test(test_html_lets_no_mark_of_the_users_through),
        cmocka_unit_test(test_a_struct_of_arrays_is_a_table_of_their_columns),
        cmocka_unit_test(test_an_empty_table_is_its_headings),
    };
    return bl_run_tests(tests);
}
