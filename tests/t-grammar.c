// SPDX-License-Identifier: MIT
#include "tests/test.h"

#include "core/grammar.h"
#include "core/registry.h"

typedef struct block {
    uint64_t seed;
    double spacing;
    uint32_t impulses, kernel, entries;
} block;

static const char *const kernels[] = {"exact", "table:N", NULL};

static const bl_parameter parameters[] = {
    {"seed", BL_SEED, offsetof(block, seed), "0", .unit = ""},
    {"spacing", BL_REAL, offsetof(block, spacing), "1", "", .minimum = 1e-9, .maximum = 1e9},
    {"impulses", BL_INTEGER, offsetof(block, impulses), "3", "", .minimum = 1, .maximum = 64},
    {"kernel", BL_CHOICE, offsetof(block, kernel), "exact", "", .minimum = 1, .maximum = 1000,
     .choices = kernels, .number_offset = offsetof(block, entries)},
    {0}};

static bl_status read_block(const bl_parameter *list, const char *text, void *out, size_t bytes,
                            bl_message *message) {
    bl_spec spec;
    memset(out, 0, bytes);
    bl_status status = bl_spec_parse(text, &spec, message);
    if (status != BL_OK)
        return status;
    status = bl_parameters_read(list, &spec, text, out, message);
    bl_spec_free(&spec);
    return status;
}

static bl_status read_text(const char *text, block *out, bl_message *message) {
    return read_block(parameters, text, out, sizeof *out, message);
}

static void test_a_text_fills_the_block_and_defaults_the_rest(void **state) {
    (void)state;
    block b;
    bl_message message;
    assert_int_equal(read_text("n:seed=0xff,kernel=table:100,spacing=1/16", &b, &message), BL_OK);
    assert_true(b.seed == 255 && b.kernel == 1 && b.entries == 100);
    assert_true(b.spacing == 0.0625 && b.impulses == 3);
    assert_int_equal(read_text("n", &b, &message), BL_OK);
    assert_true(b.seed == 0 && b.kernel == 0 && b.spacing == 1);
    assert_int_equal(read_text("n:seed=18446744073709551615", &b, &message), BL_OK);
    assert_true(b.seed == UINT64_MAX);
}

static void test_the_canonical_text_reads_back_as_the_same_block(void **state) {
    (void)state;
    const char *texts[] = {"n", "n:seed=7", "n:spacing=0.1,impulses=5", "n:kernel=table:33",
                           "n:seed=18446744073709551615,kernel=exact"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        block first, second;
        bl_message message;
        assert_int_equal(read_text(texts[i], &first, &message), BL_OK);
        char *text = bl_parameters_text("n", parameters, &first);
        assert_int_equal(read_text(text, &second, &message), BL_OK);
        assert_memory_equal(&first, &second, sizeof first);
        free(text);
    }
}

static void test_a_default_written_otherwise_is_left_out_of_the_canonical_text(void **state) {
    (void)state;
    static const bl_parameter half[] = {
        {"spacing", BL_REAL, offsetof(block, spacing), "1/2", "", .minimum = 0, .maximum = 1}, {0}};
    const double values[] = {0.5, 0.25};
    const char *texts[] = {"n", "n:spacing=0.25"};
    for (int i = 0; i < 2; i++) {
        block b = {.spacing = values[i]};
        char *text = bl_parameters_text("n", half, &b);
        assert_string_equal(text, texts[i]);
        free(text);
    }
}

// "inf" where the maximum is infinite, and nowhere else.
static void test_infinity_is_a_number_where_no_maximum_forbids_it(void **state) {
    (void)state;
    static const bl_parameter open_ended[] = {
        {"spacing", BL_REAL, offsetof(block, spacing), "0", "", .minimum = 0, .maximum = INFINITY},
        {0}};
    static const char *const right[] = {"n:spacing=inf", "n:spacing=infinity"};
    static const char *const wrong[] = {"n:spacing=-inf", "n:spacing=nan",   "n:spacing=1e999",
                                        "n:spacing=info", "n:spacing=inf/2", "n:spacing=-1"};
    bl_message message;
    bl_spec spec;
    block b;
    for (int i = 0; i < 2; i++) {
        assert_int_equal(bl_spec_parse(right[i], &spec, &message), BL_OK);
        assert_int_equal(bl_parameters_read(open_ended, &spec, right[i], &b, &message), BL_OK);
        assert_true(isinf(b.spacing) && b.spacing > 0);
        char *text = bl_parameters_text("n", open_ended, &b);
        assert_string_equal(text, "n:spacing=inf");
        free(text);
        assert_int_equal(bl_parameters_read(parameters, &spec, right[i], &b, &message), BL_USAGE);
        bl_spec_free(&spec);
    }
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(bl_spec_parse(wrong[i], &spec, &message), BL_OK);
        if (bl_parameters_read(open_ended, &spec, wrong[i], &b, &message) != BL_USAGE ||
            !strstr(message.text, "from 0 to inf"))
            fail_msg("%s: '%s'", wrong[i], message.text);
        bl_spec_free(&spec);
    }
}

static void test_errors_name_the_word_the_column_and_the_nearest_word(void **state) {
    (void)state;
    static const struct {
        const char *text, *words[3];
    } cases[] = {
        {"n:sed=7", {"'sed'", "column 3", "'seed'"}},
        {"n:seed=7,kernel=exakt", {"exakt", "column 17", "'exact'"}},
        {"n:impulses=0", {"impulses=0", "column 12", "from 1 to 64"}},
        {"n:impulses=3.5", {"impulses=3.5", "column 12", "whole number"}},
        {"n:seed=18446744073709551616", {"seed=", "column 8", "18446744073709551615"}},
        {"n:seed=-1", {"seed=-1", "column 8", "0 to"}},
        {"n:spacing=nan", {"spacing=nan", "column 11", "a number"}},
        {"n:spacing=1/0", {"spacing=1/0", "column 11", "a number"}},
        {"n:kernel=table:", {"kernel=table:", "column 16", "whole number"}},
        {"n:kernel=table:0", {"kernel=table:0", "column 16", "1 to 1000"}},
        {"n:seed=1,seed=2", {"'seed'", "column 10", "twice"}},
        {"n:seed", {"'seed'", "column 3", "key=value"}},
        {"n:seed=", {"'seed='", "column 3", "key=value"}},
        {"n:", {"column 3", "key=value", "nothing"}},
        {"n:seed=1,", {"column 10", "key=value", "nothing"}},
        {":seed=1", {"no name", "", ""}},
        {"", {"no name", "", ""}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        block b;
        bl_message message = {""};
        assert_int_equal(read_text(cases[i].text, &b, &message), BL_USAGE);
        for (int w = 0; w < 3; w++)
            if (!strstr(message.text, cases[i].words[w]))
                fail_msg("%s: '%s' lacks '%s'", cases[i].text, message.text, cases[i].words[w]);
    }
}

static void test_the_nearest_word_is_near_or_none(void **state) {
    (void)state;
    const char *words[] = {"vnoise", "gnoise", "hermite", NULL};
    assert_string_equal(bl_nearest("gnose", words), "gnoise");
    assert_string_equal(bl_nearest("hermit", words), "hermite");
    assert_string_equal(bl_nearest("GNOISE", words), "gnoise");
    assert_null(bl_nearest("zebra", words));
    assert_null(bl_nearest("", words));
    char long_word[500];
    memset(long_word, 'g', sizeof long_word - 1);
    long_word[sizeof long_word - 1] = '\0';
    assert_null(bl_nearest(long_word, words));
}

static void test_a_word_is_near_up_to_half_of_its_letters(void **state) {
    (void)state;
    const char *words[] = {"gnoise", NULL};
    assert_string_equal(bl_nearest("gnoxxx", words), "gnoise");
    assert_null(bl_nearest("gnxxxx", words));
    assert_null(bl_nearest("xxxxxx", words));
}

static void test_the_ends_of_a_range_belong_to_it(void **state) {
    (void)state;
    block b;
    bl_message message;
    assert_int_equal(read_text("n:impulses=64,spacing=1e9,kernel=table:1000", &b, &message), BL_OK);
    assert_int_equal(read_text("n:impulses=1,spacing=1e-9,kernel=table:1", &b, &message), BL_OK);
    static const char *const beyond[] = {"n:impulses=65", "n:spacing=1000000001", "n:spacing=9e-10",
                                         "n:kernel=table:1001", "n:spacing=-1"};
    for (size_t i = 0; i < sizeof beyond / sizeof *beyond; i++)
        assert_int_equal(read_text(beyond[i], &b, &message), BL_USAGE);
}

// --- lists, texts and nested signals ---

typedef struct wide_block {
    uint32_t list[BL_LIST_SIZE];
    char text[BL_TEXT_SIZE], basis[BL_TEXT_SIZE];
} wide_block;

static const bl_parameter wide_parameters[] = {
    {"list", BL_LIST, offsetof(wide_block, list), "0", "", .maximum = 100},
    {"text", BL_TEXT, offsetof(wide_block, text), "", .unit = ""},
    {"basis", BL_NESTED, offsetof(wide_block, basis), "g", .unit = ""},
    {0}};

static bl_status read_wide(const char *text, wide_block *out, bl_message *message) {
    return read_block(wide_parameters, text, out, sizeof *out, message);
}

static void refuse_wide(const char *text, const char *says) {
    wide_block b;
    bl_message message = {""};
    if (read_wide(text, &b, &message) != BL_USAGE || !strstr(message.text, says))
        fail_msg("%.80s: '%s' lacks '%s'", text, message.text, says);
}

// One number is that of all axes; axes that are left out have 0.
static void test_lists_are_read_and_printed(void **state) {
    (void)state;
    static const struct {
        const char *text, *canonical;
        uint32_t list[BL_LIST_SIZE];
    } cases[] = {{"n", "n", {0, 0, 0, 0}},
                 {"n:list=0,0", "n", {0, 0, 0, 0}},
                 {"n:list=5", "n:list=5", {5, 5, 5, 5}},
                 {"n:list=5,5,5,5", "n:list=5", {5, 5, 5, 5}},
                 {"n:list=5,0", "n:list=5,0", {5, 0, 0, 0}},
                 {"n:list=5,6,0,0", "n:list=5,6", {5, 6, 0, 0}},
                 {"n:list=0,0,7", "n:list=0,0,7", {0, 0, 7, 0}},
                 {"n:list=1,2,3,100", "n:list=1,2,3,100", {1, 2, 3, 100}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wide_block b;
        bl_message message;
        assert_int_equal(read_wide(cases[i].text, &b, &message), BL_OK);
        assert_memory_equal(b.list, cases[i].list, sizeof b.list);
        char *text = bl_parameters_text("n", wide_parameters, &b);
        assert_string_equal(text, cases[i].canonical);
        free(text);
    }
    refuse_wide("n:list=1,2,3,4,5", "4 numbers at most");
    refuse_wide("n:list=1,2,101", "column 12");
    refuse_wide("n:list=1,-2", "column 10");
    refuse_wide("n:5", "expected key=value"); // no list that it could go on with
    refuse_wide("n:text=a,b", "expected key=value");
}

// Settings of the nested signal are dotted, before or after its name; a list is one of them.
static void test_nested_signals_are_read_and_printed(void **state) {
    (void)state;
    static const struct {
        const char *text, *basis, *canonical;
    } cases[] = {
        {"n:basis=g", "g", "n"},
        {"n:basis=v,basis.seed=3", "v:seed=3", "n:basis=v,basis.seed=3"},
        {"n:basis.seed=3,basis=v", "v:seed=3", "n:basis=v,basis.seed=3"},
        {"n:basis.seed=3", "g:seed=3", "n:basis=g,basis.seed=3"},
        {"n:basis=v,basis.list=1,2,basis.k=3", "v:list=1,2,k=3",
         "n:basis=v,basis.list=1,2,basis.k=3"},
        {"n:basis=v,basis.basis=w,basis.basis.list=1,2,3", "v:basis=w,basis.list=1,2,3",
         "n:basis=v,basis.basis=w,basis.basis.list=1,2,3"},
        {"n:basis=v,basis.list=7,8,list=9", "v:list=7,8", "n:list=9,basis=v,basis.list=7,8"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        wide_block b, again;
        bl_message message;
        assert_int_equal(read_wide(cases[i].text, &b, &message), BL_OK);
        assert_string_equal(b.basis, cases[i].basis);
        char *text = bl_parameters_text("n", wide_parameters, &b);
        assert_string_equal(text, cases[i].canonical);
        assert_int_equal(read_wide(text, &again, &message), BL_OK);
        assert_string_equal(again.basis, b.basis);
        free(text);
    }
    refuse_wide("n:basis.=3", "after the dot");
    refuse_wide("n:list.seed=3", "unknown key 'list.seed'");
    refuse_wide("n:basis=g,basis=v", "twice");
}

// 511 letters fit and 512 do not, whether in a word or put together.
static void test_texts_end_at_their_size(void **state) {
    (void)state;
    for (int more = 0; more < 2; more++)
        for (int nested = 0; nested < 2; nested++) {
            char text[2 * BL_TEXT_SIZE] = "n:text=";
            wide_block b;
            bl_message message = {""};
            size_t letters = BL_TEXT_SIZE - 1 + (size_t)more, used;
            if (nested) { // g:k= and the letters
                strcpy(text, "n:basis.k=");
                letters -= 4;
            }
            used = strlen(text);
            memset(text + used, 'a', letters);
            text[used + letters] = '\0';
            assert_int_equal(read_wide(text, &b, &message), more ? BL_USAGE : BL_OK);
            if (!more)
                assert_int_equal(strlen(nested ? b.basis : b.text), BL_TEXT_SIZE - 1);
        }
}

static void test_numbers_are_whole_words(void **state) {
    (void)state;
    unsigned long long u;
    double d;
    assert_true(bl_read_unsigned("0x10", &u) && u == 16);
    assert_false(bl_read_unsigned("", &u) || bl_read_unsigned(" 1", &u) ||
                 bl_read_unsigned("+1", &u) || bl_read_unsigned("1x", &u) ||
                 bl_read_unsigned("99999999999999999999", &u));
    assert_true(bl_read_real("-1e3", &d) && d == -1000);
    assert_true(bl_read_real("3/4", &d) && d == 0.75);
    assert_false(bl_read_real("", &d) || bl_read_real("inf", &d) || bl_read_real("nan", &d) ||
                 bl_read_real("1e999", &d) || bl_read_real("1/", &d) || bl_read_real("/2", &d) ||
                 bl_read_real("1 ", &d) || bl_read_real("1/2/3", &d));
}

static void test_a_whole_number_may_be_written_with_an_exponent(void **state) {
    (void)state;
    block b;
    unsigned long long n;
    bl_message message;
    assert_int_equal(read_text("n:impulses=1e1", &b, &message), BL_OK);
    assert_int_equal(b.impulses, 10);
    assert_true(bl_read_count("1e12", &n) && n == 1000000000000ull);
    assert_false(bl_read_count("1.5", &n) || bl_read_count("1e-1", &n) ||
                 bl_read_count("-1e3", &n) || bl_read_count("1e16", &n) || bl_read_count("e3", &n));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_whole_number_may_be_written_with_an_exponent),
        cmocka_unit_test(test_a_text_fills_the_block_and_defaults_the_rest),
        cmocka_unit_test(test_the_canonical_text_reads_back_as_the_same_block),
        cmocka_unit_test(test_a_default_written_otherwise_is_left_out_of_the_canonical_text),
        cmocka_unit_test(test_infinity_is_a_number_where_no_maximum_forbids_it),
        cmocka_unit_test(test_errors_name_the_word_the_column_and_the_nearest_word),
        cmocka_unit_test(test_the_nearest_word_is_near_or_none),
        cmocka_unit_test(test_a_word_is_near_up_to_half_of_its_letters),
        cmocka_unit_test(test_the_ends_of_a_range_belong_to_it),
        cmocka_unit_test(test_lists_are_read_and_printed),
        cmocka_unit_test(test_nested_signals_are_read_and_printed),
        cmocka_unit_test(test_texts_end_at_their_size),
        cmocka_unit_test(test_numbers_are_whole_words),
    };
    return bl_run_tests(tests);
}
