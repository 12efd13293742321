// SPDX-License-Identifier: MIT
//
// Functions of shared objects as signals: values equal those of direct calls, claims become facts,
// seeds reach the function, and what is wrong is said.
#include "tests/temporary.h"
#include "tests/test.h"

#include <dlfcn.h>
#include <signal.h>
#include <unistd.h>

#include "core/grid.h"
#include "include/bandlimit_plugin.h"
#include "sources/source.h"
#include "spectra/histogram.h"
#include "spectra/psd.h"
#include "tests/program.h"
#include "tests/sources.h"

static const char *library(void) {
    static char path[512];
    const char *build = getenv("BL_BUILD");
    snprintf(path, sizeof path, "%s/tests/plugins/functions.so", build ? build : "build");
    return path;
}

// LIBRARY:<function>, with settings behind its name
static const char *text_of(const char *function) {
    static char text[1024];
    snprintf(text, sizeof text, "%s:%s", library(), function);
    return text;
}

static bl_signal *open_good(const char *function) {
    return bl_test_open_source(text_of(function));
}

static void refuse(const char *function, bl_status expected, const char *word) {
    bl_test_refuse_source(text_of(function), expected, word);
}

// --- values ---

static void *direct(const char *symbol) {
    void *handle = dlopen(library(), RTLD_NOW);
    void *found = handle ? dlsym(handle, symbol) : NULL;
    if (!found)
        fail_msg("%s", dlerror());
    return found;
}

static void test_values_are_those_of_direct_calls(void **state) {
    (void)state;
    enum { COUNT = 100 };
    void *found = direct("plain");
    bandlimit_function *plain;
    memcpy(&plain, &found, sizeof plain);
    bl_signal *signal = open_good("plain,seed=9,dims=4");
    const double start[BL_AXES] = {-3, 0.25, 1e6, 7}, step[BL_AXES] = {0.1, -0.2, 3, 0};
    double places[BL_AXES][COUNT];
    float row[COUNT], points[COUNT];
    for (int i = 0; i < COUNT; i++)
        for (int a = 0; a < BL_AXES; a++)
            places[a][i] = start[a] + i * step[a];
    const double *const at[BL_AXES] = {places[0], places[1], places[2], places[3]};
    bl_signal_row(signal, start, step, COUNT, row);
    bl_signal_points(signal, at, COUNT, points);
    for (int i = 0; i < COUNT; i++) {
        const double p[BL_AXES] = {places[0][i], places[1][i], places[2][i], places[3][i]};
        double expected = plain(p, 4, 9, NULL);
        assert_near(bl_signal_value(signal, p), expected, 0);
        assert_true(row[i] == (float)expected);
        assert_true(points[i] == (float)expected);
    }
    bl_signal_free(signal);
}

static void test_axes_beyond_dims_are_ignored(void **state) {
    (void)state;
    const double p[BL_AXES] = {1, 2, 3, NAN}, nowhere[BL_AXES] = {1, NAN, 0, 0};
    bl_signal *three = open_good("plain"), *one = open_good("plain,dims=1");
    assert_int_equal(three->dimensions, 3);
    assert_near(bl_signal_value(three, p), 1 + 20 + 300 + 0.003, 1e-12);
    assert_near(bl_signal_value(one, p), 1 + 0.001, 1e-12);
    assert_near(bl_signal_value(one, nowhere), 1 + 0.001, 1e-12);
    assert_true(isnan(bl_signal_value(three, nowhere)));
    bl_signal_free(three);
    bl_signal_free(one);
}

// The function would answer 1e9 if it saw such a place.
static void test_places_out_of_range_never_reach_the_function(void **state) {
    (void)state;
    static const double bad[] = {NAN, INFINITY, -INFINITY, 0x1p63, -1e300};
    bl_signal *signal = open_good("full");
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        const double at[BL_AXES] = {0.5, bad[i]}, step[BL_AXES] = {1}, wild[BL_AXES] = {bad[i]};
        const double zero[BL_AXES] = {0}, x[2] = {0.25, bad[i]}, y[2] = {0, 0};
        const double *const points[BL_AXES] = {x, y, y, y};
        float row[3];
        assert_true(isnan(bl_signal_value(signal, at)));
        bl_signal_row(signal, at, step, 3, row);
        assert_true(isnan(row[0]) && isnan(row[1]) && isnan(row[2]));
        bl_signal_row(signal, zero, wild, 3, row);
        assert_true(isnan(row[1]) && isnan(row[2]));
        bl_signal_points(signal, points, 2, row);
        assert_true(fabs((double)row[0]) <= 1 && isnan(row[1]));
    }
    // A row that leaves the range, and one that comes back into it.
    const double zero[BL_AXES] = {0}, away[BL_AXES] = {0x1.8p61}, out[BL_AXES] = {0x1.2p62};
    const double back[BL_AXES] = {-0x1.8p61};
    float row[4];
    bl_signal_row(signal, zero, away, 4, row);
    assert_true(fabs((double)row[0]) <= 1 && fabs((double)row[1]) <= 1);
    assert_true(isnan(row[2]) && isnan(row[3]));
    bl_signal_row(signal, out, back, 2, row);
    assert_true(isnan(row[0]) && fabs((double)row[1]) <= 1);
    const double edge[BL_AXES] = {0x1p62, -0x1p62};
    assert_true(fabs(bl_signal_value(signal, edge)) <= 1);
    bl_signal_free(signal);
}

static void test_a_row_of_the_plugin_equals_its_points(void **state) {
    (void)state;
    enum { COUNT = 257 };
    bl_signal *signal = open_good("full,seed=123");
    const double start[BL_AXES] = {-7.3, 2.1, 5, 6}, step[BL_AXES] = {0.37, 0.11, 1, 1};
    float row[COUNT];
    bl_signal_row(signal, start, step, COUNT, row);
    bl_signal_row(signal, start, step, 0, NULL);
    for (int i = 0; i < COUNT; i++) {
        const double p[BL_AXES] = {start[0] + i * step[0], start[1] + i * step[1]};
        assert_true(row[i] == (float)bl_signal_value(signal, p));
    }
    bl_signal_free(signal);
}

// --- seeds and lives ---

static double alive(const bl_signal *counter) {
    return bl_signal_value(counter, (const double[BL_AXES]){0});
}

static void test_each_seed_has_its_own_state_and_frees_it(void **state) {
    (void)state;
    bl_signal *counter = open_good("full_alive,dims=2"), *signal = open_good("full,seed=250");
    const double at[BL_AXES] = {0, 0};
    assert_near(alive(counter), 1, 0);
    bl_signal *other = bl_signal_reseed(signal, 500), *copy = bl_signal_copy(signal);
    assert_non_null(other);
    assert_near(alive(counter), 3, 0);
    assert_near(bl_signal_value(signal, at), 0.5 * 1 + 0.5, 1e-12); // a phase of 1/4
    assert_near(bl_signal_value(other, at), 0.5, 1e-12);            // and 1/2
    bl_signal_free(signal);
    assert_near(bl_signal_value(copy, at), 1, 1e-12);
    assert_near(bl_signal_value(other, at), 0.5, 1e-12);
    bl_signal_free(copy);
    bl_signal_free(other);
    assert_near(alive(counter), 0, 0);
    bl_signal_free(counter);
}

static void test_the_text_is_canonical_and_takes_a_seed(void **state) {
    (void)state;
    char text[1024], expected[1024];
    bl_message message = {""};
    bl_signal *signal;
    snprintf(text, sizeof text, "%s:plain,seed=0x10,dims=2", library());
    snprintf(expected, sizeof expected, "%s:plain,dims=2,seed=16", library());
    assert_int_equal(bl_source_open(text, BL_ISA_BEST, &signal, &message), BL_OK);
    assert_string_equal(signal->text, expected);
    bl_signal_free(signal);
    assert_int_equal(bl_source_open_seeded(text, 3, BL_ISA_BEST, &signal, &message), BL_USAGE);
    assert_non_null(strstr(message.text, "contradict"));
    snprintf(text, sizeof text, "%s:plain", library());
    snprintf(expected, sizeof expected, "%s:plain,seed=3", library());
    assert_int_equal(bl_source_open_seeded(text, 3, BL_ISA_BEST, &signal, &message), BL_OK);
    assert_string_equal(signal->text, expected);
    bl_signal_free(signal);
}

// --- claims ---

static void test_claims_become_facts(void **state) {
    (void)state;
    bl_signal *full = open_good("full"), *plain = open_good("plain");
    const bl_facts *facts = &full->facts;
    assert_int_equal(full->dimensions, 2);
    assert_string_equal(full->name, "plugin");
    assert_near(facts->lower, -1, 0);
    assert_near(facts->upper, 1, 0);
    assert_non_null(facts->bound_proof);
    assert_near(facts->mean, 0, 0);
    assert_near(facts->variance, 0.25, 0);
    assert_near(facts->band_to, 1, 0);
    assert_near(facts->leak_db, -60, 0);
    assert_int_equal(facts->continuity, 2);
    assert_near(facts->period[0], 1, 0);
    assert_near(facts->period[1], 2, 0);
    assert_true(isnan(facts->period[2]));
    assert_near(facts->cell, 0, 0);
    assert_true(facts->stationary && !facts->isotropic);
    assert_true(isnan(plain->facts.lower) && isnan(plain->facts.variance));
    assert_true(isnan(plain->facts.band_from) && isnan(plain->facts.period[0]));
    assert_int_equal(plain->facts.continuity, -2);
    assert_null(plain->facts.bound_proof);
    bl_signal_free(full);
    bl_signal_free(plain);
}

static void test_claims_that_cannot_be_are_refused(void **state) {
    (void)state;
    refuse("bad_bound", BL_USAGE, "lower is above upper");
    refuse("bad_mean", BL_USAGE, "mean");
    refuse("bad_variance", BL_USAGE, "variance");
    refuse("bad_sign", BL_USAGE, "negative");
    refuse("bad_band", BL_USAGE, "band");
    refuse("half_band", BL_USAGE, "both ends");
    refuse("bad_leak", BL_USAGE, "leak_db");
    refuse("bad_dims", BL_USAGE, "above 4");
    refuse("bad_period", BL_USAGE, "period");
    refuse("bad_cell", BL_USAGE, "cell");
    refuse("endless_cell", BL_USAGE, "cell");
    refuse("bad_class", BL_USAGE, "continuity");
    refuse("bad_flags", BL_USAGE, "flags");
    refuse("bad_size", BL_DEVICE, "another size");
    refuse("long_claims", BL_DEVICE, "another size");
    refuse("full,dims=3", BL_USAGE, "states 2 dimensions");
}

// --- measurements ---

static void test_measurements_do_not_depend_on_the_threads(void **state) {
    (void)state;
    bl_signal *signal = open_good("full");
    bl_psd_settings settings = bl_psd_default_settings(1);
    bl_message message = {""};
    bl_psd one, many;
    settings.averages = 16;
    settings.threads = 1;
    assert_int_equal(bl_psd_measure(signal, &settings, &one, &message), BL_OK);
    settings.threads = 5;
    assert_int_equal(bl_psd_measure(signal, &settings, &many, &message), BL_OK);
    assert_memory_equal(one.psd, many.psd, one.count * sizeof *one.psd);
    bl_psd_free(&one);
    bl_psd_free(&many);
    bl_signal_free(signal);
}

static void test_calls_of_a_function_that_is_not_thread_safe_come_one_by_one(void **state) {
    (void)state;
    enum { SIZE = 96 };
    static float values[SIZE * SIZE];
    bl_signal *signal = open_good("unsafe");
    const bl_grid grid = {.right = {1}, .down = {0, 1}, .width = SIZE, .height = SIZE};
    bl_grid_fill(signal, &grid, 8, values);
    for (int i = 0; i < SIZE * SIZE; i++)
        assert_near((double)values[i], i % SIZE, 0);
    static double places[SIZE * SIZE];
    int wrong = 0;
    for (int i = 0; i < SIZE * SIZE; i++)
        places[i] = i;
        // Points and single values, for long enough that threads meet.
#pragma omp parallel for num_threads(4) schedule(static, 1) reduction(+ : wrong)
    for (int i = 0; i < 200 * SIZE; i++) {
        float row[SIZE];
        const double *const x = places + (size_t)(i % SIZE) * SIZE;
        bl_signal_points(signal, (const double *const[]){x, x, x, x}, SIZE, row);
        for (int k = 0; k < SIZE; k++)
            wrong += row[k] != (float)x[k];
        wrong += bl_signal_value(signal, (const double[BL_AXES]){x[1]}) != x[1];
    }
    assert_int_equal(wrong, 0);
    bl_signal_free(signal);
}

static void test_a_value_that_is_no_number_stops_a_measurement(void **state) {
    (void)state;
    bl_signal *signal = open_good("nowhere");
    bl_histogram_settings settings = bl_histogram_default_settings();
    bl_histogram histogram;
    bl_message message = {""};
    settings.samples = 4096;
    assert_true(isnan(bl_signal_value(signal, (const double[BL_AXES]){1})));
    assert_int_equal(bl_histogram_measure(signal, &settings, &histogram, &message), BL_MISMATCH);
    assert_non_null(strstr(message.text, "nan"));
    assert_int_equal(bl_signal_complaint(signal, &message), BL_OK);
    bl_signal_free(signal);
}

// --- the examples ---

// Their Makefile builds the function in a copy of the folder; its claims hold, and its spectrum
// ends at 1 cycle per unit.
static void test_the_example_keeps_what_it_claims(void **state) {
    (void)state;
    char command[1024], text[512];
    const char *folder = bl_temporary_folder();
    snprintf(command, sizeof command,
             "mkdir %s/examples %s/include && cp -r examples/plugin %s/examples && "
             "cp include/bandlimit_plugin.h %s/include && rm -f %s/examples/plugin/*.so",
             folder, folder, folder, folder, folder);
    assert_int_equal(bl_temporary_run(NULL, (const char *const[]){"sh", "-c", command, NULL}), 0);
    snprintf(command, sizeof command, "%s/examples/plugin", folder);
    const char *const make[] = {"make", "-C", command, "mynoise.so", NULL};
    assert_int_equal(bl_temporary_run(NULL, make), 0);
    snprintf(text, sizeof text, "%s/examples/plugin/mynoise.so:waves", folder);
    bl_message message = {""};
    bl_signal *signal = bl_test_open_source(text);
    bl_psd_settings settings = bl_psd_default_settings(1);
    bl_psd psd;
    settings.averages = 64;
    assert_int_equal(bl_psd_measure(signal, &settings, &psd, &message), BL_OK);
    // The density ends at 1 with a step, which the window smears.
    bl_band_limit limit = {.from = 0, .to = 1, .limit_db = -90, .guard = 2 * bl_psd_smear(&psd)};
    bl_psd_band_limit(&psd, &limit);
    assert_int_equal(limit.verdict, BL_VERDICT_PASS);
    for (int i = 0; i < 1000; i++) {
        const double at[BL_AXES] = {0.37 * i, -0.11 * i, 0.05 * i};
        assert_true(fabs(bl_signal_value(signal, at)) <= signal->facts.upper);
    }
    bl_psd_free(&psd);
    bl_signal_free(signal);
}

// The header stands alone, in C and in C++.
static void test_the_header_needs_nothing_else(void **state) {
    (void)state;
    static const char use[] =
        "#include \"bandlimit_plugin.h\"\n"
        "BANDLIMIT_EXPORT double f(const double p[4], unsigned d, uint64_t s,"
        " void *u) { (void)d, (void)s, (void)u; return p[0]; }\n";
    char command[1024];
    bl_temporary_write(bl_temporary_path("use.c"), use, sizeof use - 1);
    snprintf(command, sizeof command,
             "f=%s && for way in 'cc -std=c99' 'c++ -x c++ -std=c++11'; do "
             "$way -Wall -Wextra -pedantic -Werror -fPIC -shared -Iinclude $f -o $f.so && "
             "nm -D $f.so | grep -q ' T f$' || exit 1; done",
             bl_temporary_path("use.c"));
    assert_int_equal(bl_temporary_run(NULL, (const char *const[]){"sh", "-c", command, NULL}), 0);
}

// --- refusals ---

static void test_every_bad_text_is_refused_with_its_reason(void **state) {
    (void)state;
    refuse("plane", BL_USAGE, "did you mean 'plain'?");
    refuse("malloc", BL_USAGE, "unknown function 'malloc'"); // of another library
    refuse("data", BL_USAGE, "is data");
    refuse("full_init", BL_USAGE, "a companion of 'full'");
    refuse("full_free", BL_USAGE, "a companion of 'full'");
    refuse("full_rows,dims=2", BL_USAGE, "a companion of 'full'");
    refuse("full_claims", BL_USAGE, "a companion of 'full'");
    refuse("", BL_USAGE, "names no function");
    refuse(",seed=3", BL_USAGE, "names no function");
    refuse("plain,", BL_USAGE, "expected key=value");
    refuse("plain,sed=3", BL_USAGE, "did you mean 'seed'");
    refuse("plain,seed=x", BL_USAGE, "seed=x");
    refuse("plain,seed=1,seed=2", BL_USAGE, "twice");
    refuse("plain,dims=5", BL_USAGE, "dims=5");
    refuse("no_init", BL_DEVICE, "no_init_init returned 42");
    bl_signal_free(open_good("no_init,seed=7"));
    char text[1024];
    snprintf(text, sizeof text, "%s", library());
    bl_test_refuse_source(text, BL_USAGE, "names no function");
}

static void test_a_failing_init_leaves_a_reseeded_signal_out(void **state) {
    (void)state;
    bl_signal *signal = open_good("no_init,seed=7");
    assert_null(bl_signal_reseed(signal, 8));
    bl_signal_free(signal);
}

static void test_every_bad_file_is_refused_with_its_reason(void **state) {
    (void)state;
    char text[512];
    size_t size;
    char *bytes = bl_temporary_read(library(), &size);
    assert_non_null(bytes);
    bl_temporary_write(bl_temporary_path("empty.so"), "", 0);
    bl_temporary_write(bl_temporary_path("text.so"), "no library at all", 17);
    const char *const paths[] = {"missing.so", "empty.so", "text.so"};
    const char *const words[] = {"No such file", "cannot load", "cannot load"};
    for (int i = 0; i < 3; i++) {
        snprintf(text, sizeof text, "%s:f", bl_temporary_path(paths[i]));
        bl_test_refuse_source(text, BL_DEVICE, words[i]);
    }
    for (size_t part = 1; part < 16; part++) { // cut short, it must not end us with SIGBUS
        snprintf(text, sizeof text, "%s:plain", bl_temporary_path("cut.so"));
        bl_temporary_write(bl_temporary_path("cut.so"), bytes, size * part / 32);
        bl_signal *signal = NULL;
        bl_message message = {""};
        bl_status status = bl_source_open(text, BL_ISA_BEST, &signal, &message);
        assert_true(status == BL_OK || (status == BL_DEVICE && message.text[0]));
        bl_signal_free(signal);
    }
    free(bytes);
}

static const char *of_text(const char *text) {
    const bl_source *source = bl_source_of(text);
    return source ? source->name : "";
}

static void test_what_ends_in_so_is_a_function(void **state) {
    (void)state;
    assert_string_equal(of_text("lib.so:f"), "function");
    assert_string_equal(of_text("./lib.so.1.2:f,seed=3"), "function");
    assert_string_equal(of_text("./lib.sow:f"), "image-file");
    assert_string_equal(of_text("cmd:./lib.so"), "program");
    assert_string_equal(of_text("cmd,dims=2:x"), "program");
    assert_string_equal(of_text("a.raw:size=3"), "raw-file");
    assert_string_equal(of_text("gnoise:seed=3"), "");
    assert_string_equal(of_text(""), "");
}

// The examples that need a library are built where it is, and not counted as passed elsewhere.
static void check_wrapper(const char *header, const char *name, const char *function) {
    char command[600], text[300];
    if (access(header, R_OK) != 0) {
        fprintf(stderr, "skipped: %s is not installed\n", header);
        skip();
    }
    snprintf(command, sizeof command,
             "cp examples/plugin/* %s && make -s -C %s INCLUDE=$PWD/include %s.so",
             bl_temporary_folder(), bl_temporary_folder(), name);
    assert_int_equal(system(command), 0);
    snprintf(text, sizeof text, "%s/%s.so:%s", bl_temporary_folder(), name, function);
    bl_ran ran = bl_run_program("check", text, "--claims", "--quick");
    if (strcmp(name, "libnoise") == 0 && ran.status != 0)
        fail_msg("%s: %s%s", text, ran.out, ran.err);
    assert_true(ran.status == 0 || ran.status == 2); // stb_perlin's coordinates are floats
    bl_ran_free(&ran);
}

static void test_the_wrapper_of_libnoise_keeps_what_it_claims(void **state) {
    (void)state;
    check_wrapper("/usr/include/libnoise/noise.h", "libnoise", "value");
}

static void test_the_wrapper_of_stb_perlin_is_built(void **state) {
    (void)state;
    check_wrapper("/usr/include/stb/stb_perlin.h", "stb_perlin", "noise");
}

// The signal that ends it stays the one of the crash. A sanitizer has a handler of its own.
static void test_a_crash_names_the_function(void **state) {
    (void)state;
    static const struct {
        const char *function;
        int number;
    } cases[] = {{"crash_read", SIGSEGV}, {"crash_abort", SIGABRT}, {"crash_deep", SIGSEGV}};
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    skip();
#endif
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1024], expected[1100];
        snprintf(text, sizeof text, "%s:%s", library(), cases[i].function);
        snprintf(expected, sizeof expected, "bandlimit: crashed inside %s\n", text);
        bl_ran ran = bl_run_program("eval", text, "1");
        if (ran.status != 128 + cases[i].number || strcmp(ran.err, expected) != 0)
            fail_msg("%s: status %d, '%s'", text, ran.status, ran.err);
        bl_ran_free(&ran);
        // In a thread of the library; of two that crash at once either may be first to end it.
        ran = bl_run_program("histogram", text, "--quick", "--threads", "1");
        assert_int_equal(ran.status, 128 + cases[i].number);
        assert_non_null(strstr(ran.err, expected));
        bl_ran_free(&ran);
        ran = bl_run_program("eval", text, "0");
        assert_int_equal(ran.status, 0);
        bl_ran_free(&ran);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values_are_those_of_direct_calls),
        cmocka_unit_test(test_axes_beyond_dims_are_ignored),
        cmocka_unit_test(test_places_out_of_range_never_reach_the_function),
        cmocka_unit_test(test_a_row_of_the_plugin_equals_its_points),
        cmocka_unit_test(test_each_seed_has_its_own_state_and_frees_it),
        cmocka_unit_test(test_the_text_is_canonical_and_takes_a_seed),
        cmocka_unit_test(test_claims_become_facts),
        cmocka_unit_test(test_claims_that_cannot_be_are_refused),
        cmocka_unit_test(test_measurements_do_not_depend_on_the_threads),
        cmocka_unit_test(test_calls_of_a_function_that_is_not_thread_safe_come_one_by_one),
        cmocka_unit_test(test_a_value_that_is_no_number_stops_a_measurement),
        cmocka_unit_test(test_the_example_keeps_what_it_claims),
        cmocka_unit_test(test_the_header_needs_nothing_else),
        cmocka_unit_test(test_every_bad_text_is_refused_with_its_reason),
        cmocka_unit_test(test_a_failing_init_leaves_a_reseeded_signal_out),
        cmocka_unit_test(test_every_bad_file_is_refused_with_its_reason),
        cmocka_unit_test(test_what_ends_in_so_is_a_function),
        cmocka_unit_test(test_a_crash_names_the_function),
        cmocka_unit_test(test_the_wrapper_of_libnoise_keeps_what_it_claims),
        cmocka_unit_test(test_the_wrapper_of_stb_perlin_is_built),
    };
    return bl_run_tests(tests);
}
