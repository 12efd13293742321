// SPDX-License-Identifier: MIT
//
// Converged references: against closed forms, their stated error, and the cache.
#include "tests/test.h"

#include "aliasing/patterns.h"
#include "aliasing/reference.h"
#include "aliasing/reference_cache.h"
#include "aliasing/scene.h"
#include "core/hash.h"
#include "tests/ripple.h"
#include "tests/sources.h"
#include "tests/temporary.h"

enum { SIZE = 24 };

typedef struct stage {
    bl_signal *signal;
    bl_view view;
    bl_scene scene;
} stage;

// The scene points into the stage, which therefore stays where it is.
static void open_stage(stage *s, bl_signal *signal, const char *view) {
    bl_message message;
    double seen;
    s->signal = signal;
    assert_int_equal(bl_view_open(view, SIZE, SIZE, &s->view, &message), BL_OK);
    assert_int_equal(bl_scene_make(signal, &s->view, 3, &s->scene, &seen, &message), BL_OK);
}

static void close_stage(stage *s) {
    bl_signal_free(s->signal);
    bl_view_close(&s->view);
}

static bl_reference make(const stage *s, const bl_reference_settings *settings) {
    bl_reference reference;
    bl_message message;
    if (bl_reference_make(&s->scene, settings, &reference, &message) != BL_OK)
        fail_msg("%s", message.text);
    return reference;
}

static double sinc(double f) {
    return f == 0 ? 1 : sin(M_PI * f) / (M_PI * f);
}

// The wave of a pixel, as the closed form has it: damped by the transform of the pixel.
static double wave_at(const stage *s, size_t i, size_t j, double fx, double fy, double damping) {
    bl_sight sight;
    assert_true(bl_view_see(&s->view, (double)i + 0.5, (double)j + 0.5, &sight));
    return 0.5 + 0.4 * damping * cos(2 * M_PI * (fx * sight.at[0] + fy * sight.at[1]));
}

// Turned by 30 degrees, so that there is no exact path; a unit is a pixel.
static void check_against_closed_form(bl_pixel pixel) {
    const double fx = 0.7, fy = 0.3, c = cos(M_PI / 6), d = sin(M_PI / 6);
    const double across = fx * c + fy * d, down = fx * d - fy * c; // cycles per pixel
    double damping = pixel == BL_PIXEL_BOX
                         ? sinc(across) * sinc(down)
                         : exp(-0.5 * M_PI * M_PI * (across * across + down * down));
    stage s;
    open_stage(&s, bl_test_ripple(0.5, 0.4, fx, fy), "flat:scale=24,rotate=30");
    const bl_reference_settings settings = {
        .pixel = pixel, .tolerance = 2e-4, .most_samples = 1 << 14};
    bl_reference reference = make(&s, &settings);
    double squares = 0;
    for (size_t p = 0; p < SIZE * SIZE; p++) {
        double truth = wave_at(&s, p % SIZE, p / SIZE, fx, fy, damping);
        squares += (reference.rgb[3 * p] - truth) * (reference.rgb[3 * p] - truth);
    }
    double rms = sqrt(squares / (SIZE * SIZE));
    assert_false(reference.exact);
    assert_less(reference.rms_error, settings.tolerance);
    // 576 pixels of 3 degrees of freedom each: the ratio of the roots is known to 5 % or so; the
    // errors of a pixel are not normal, so that four times as much is left to it.
    assert_near(rms / reference.rms_error, 1, 0.2);
    bl_reference_free(&reference);
    close_stage(&s);
}

static void test_references_agree_with_closed_forms_within_their_stated_error(void **state) {
    (void)state;
    check_against_closed_form(BL_PIXEL_BOX);
    check_against_closed_form(BL_PIXEL_GAUSSIAN);
}

static void test_an_integral_is_used_where_it_holds(void **state) {
    (void)state;
    static const struct {
        const char *view;
        bl_pixel pixel;
        int exact;
    } cases[] = {{"flat:scale=24,x=0.3", BL_PIXEL_BOX, 1},
                 {"flat:scale=24,rotate=30", BL_PIXEL_BOX, 0},
                 {"flat:scale=24", BL_PIXEL_GAUSSIAN, 0},
                 {"plane:pitch=90", BL_PIXEL_BOX, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        stage s;
        open_stage(&s, bl_test_ripple(0.5, 0.4, 0.7, 0.2), cases[i].view);
        const bl_reference_settings settings = {
            .pixel = cases[i].pixel, .tolerance = 0.01, .most_samples = 64};
        bl_reference reference = make(&s, &settings);
        assert_int_equal(reference.exact, cases[i].exact);
        if (reference.exact) {
            assert_near(reference.rms_error, 0, 0);
            assert_near(reference.rgb[0], wave_at(&s, 0, 0, 0.7, 0.2, sinc(0.7) * sinc(0.2)),
                        1e-14);
        }
        bl_reference_free(&reference);
        close_stage(&s);
    }
}

// Of one sequence, its samples taken one by one: runs of 128, whatever a batch is, and the background
// after each run.
static double sum_of_sequence(const bl_scene *scene, double x, double y, uint32_t samples,
                              uint64_t key, uint32_t *unseen) {
    enum { RUN = 128 };
    double sum = 0;
    for (uint32_t first = 0; first < samples; first += RUN) {
        uint32_t missed = 0;
        for (uint32_t i = first; i < first + RUN; i++) {
            double place[2];
            float value;
            bl_sight sight;
            bl_sobol_place(i, key, place);
            if (!bl_view_see(scene->view, x + place[0] - 0.5, y + place[1] - 0.5, &sight)) {
                missed++;
                continue;
            }
            const double *const at[BL_AXES] = {&sight.at[0], &sight.at[1], &sight.at[2],
                                               &sight.at[3]};
            bl_signal_points(scene->signal, at, 1, &value);
            sum += (double)value;
        }
        sum += missed * scene->background[0];
        *unseen += missed;
    }
    return sum;
}

static void test_a_reference_does_not_depend_on_the_batch(void **state) {
    (void)state;
    enum { SAMPLES = 1024, SEQUENCES = 4, KEY = 5 };
    stage s;
    open_stage(&s, bl_test_open_source("gnoise"), "sphere");
    for (int c = 0; c < 3; c++)
        s.scene.background[c] = 0.1; // not exact, so that the order of the sum shows
    int partly = 0;
    for (size_t i = 0; i < SIZE; i++) { // some pixels of the middle row see the rim
        double rgb[3], variance, sum = 0, x = (double)i + 0.5, y = 0.5 * SIZE + 0.5;
        uint32_t unseen = 0;
        for (uint64_t q = 0; q < SEQUENCES; q++)
            sum += sum_of_sequence(&s.scene, x, y, SAMPLES, bl_stream(KEY, q), &unseen) / SAMPLES /
                   SEQUENCES;
        bl_reference_pixel(&s.scene, BL_PIXEL_BOX, x, y, SAMPLES, KEY, rgb, &variance);
        assert_near(rgb[0], sum, 0);
        partly += unseen > 0 && unseen < SEQUENCES * SAMPLES;
    }
    assert_true(partly > 0);
    close_stage(&s);
}

static void test_threads_do_not_change_a_reference(void **state) {
    (void)state;
    stage s;
    open_stage(&s, bl_test_ripple(0.5, 0.4, 3, 2), "plane");
    bl_reference_settings settings = {.tolerance = 1e-3, .most_samples = 128, .threads = 1};
    bl_reference one = make(&s, &settings);
    settings.threads = 3;
    bl_reference three = make(&s, &settings);
    assert_memory_equal(one.rgb, three.rgb, 3 * SIZE * SIZE * sizeof(double));
    assert_memory_equal(one.error, three.error, SIZE * SIZE * sizeof(double));
    bl_reference_free(&one);
    bl_reference_free(&three);
    close_stage(&s);
}

static void expect_made_anew(const stage *s, const bl_reference_settings *settings,
                             const bl_reference *first) {
    bl_reference again = make(s, settings);
    assert_false(again.from_cache);
    assert_memory_equal(again.rgb, first->rgb, 3 * SIZE * SIZE * sizeof(double));
    bl_reference_free(&again);
    again = make(s, settings);
    assert_true(again.from_cache); // and mended
    bl_reference_free(&again);
}

static void test_a_cached_reference_is_verified(void **state) {
    (void)state;
    stage s;
    open_stage(&s, bl_test_ripple(0.5, 0.4, 0.7, 0.2), "flat:rotate=10");
    const bl_reference_settings settings = {
        .tolerance = 0.01, .most_samples = 64, .cache = bl_temporary_path("references")};
    bl_reference first = make(&s, &settings), second = make(&s, &settings);
    assert_false(first.from_cache);
    assert_true(second.from_cache);
    assert_memory_equal(first.rgb, second.rgb, 3 * SIZE * SIZE * sizeof(double));
    assert_memory_equal(first.error, second.error, SIZE * SIZE * sizeof(double));
    assert_near(first.rms_error, second.rms_error, 0);
    bl_reference_free(&second);

    size_t size;
    char *path = bl_reference_cache_path(&s.scene, &settings);
    char *bytes = bl_temporary_read(path, &size);
    assert_non_null(bytes);
    for (size_t at = 0; at < size; at += size / 7) { // a flipped bit anywhere
        bytes[at] = (char)(bytes[at] ^ 4);
        bl_temporary_write(path, bytes, size);
        expect_made_anew(&s, &settings, &first);
        bytes[at] = (char)(bytes[at] ^ 4);
    }
    bl_temporary_write(path, bytes, size / 2);
    expect_made_anew(&s, &settings, &first);
    bl_temporary_write(path, "", 0);
    expect_made_anew(&s, &settings, &first);
    free(bytes);
    free(path);
    bl_reference_free(&first);
    close_stage(&s);
}

// Two signals of one text, as an image that was written again.
static void test_a_cached_reference_is_of_the_same_values(void **state) {
    (void)state;
    stage a, b;
    open_stage(&a, bl_test_ripple(0.5, 0.4, 0.7, 0.2), "flat:rotate=10");
    open_stage(&b, bl_test_ripple(0.5, 0.3, 0.7, 0.2), "flat:rotate=10");
    free(b.signal->text);
    b.signal->text = strdup(a.signal->text);
    memcpy(b.scene.background, a.scene.background, sizeof b.scene.background);
    const bl_reference_settings settings = {
        .tolerance = 0.01, .most_samples = 64, .cache = bl_temporary_path("same")};
    bl_reference first = make(&a, &settings), second = make(&b, &settings);
    assert_false(second.from_cache);
    bl_reference_free(&first);
    bl_reference_free(&second);
    close_stage(&a);
    close_stage(&b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_references_agree_with_closed_forms_within_their_stated_error),
        cmocka_unit_test(test_an_integral_is_used_where_it_holds),
        cmocka_unit_test(test_a_reference_does_not_depend_on_the_batch),
        cmocka_unit_test(test_threads_do_not_change_a_reference),
        cmocka_unit_test(test_a_cached_reference_is_verified),
        cmocka_unit_test(test_a_cached_reference_is_of_the_same_values),
    };
    return bl_run_tests(tests);
}
