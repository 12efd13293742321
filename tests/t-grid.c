// SPDX-License-Identifier: MIT
//
// A grid holds what its points have one by one, for any number of threads.
#include "tests/test.h"

#include "core/grid.h"
#include "noises/noise.h"

enum { WIDTH = 61, HEIGHT = 37 };

static const bl_grid slanted = {.origin = {-3.25, 7.5, 0.125, 0},
                                .right = {0.125, 0.0625, 0, 0},
                                .down = {-0.03125, 0.25, 0.5, 0},
                                .width = WIDTH,
                                .height = HEIGHT};

static bl_signal *open_noise(void) {
    bl_signal *noise = NULL;
    assert_int_equal(bl_noise_open("gnoise:seed=3", BL_ISA_BEST, &noise, NULL), BL_OK);
    return noise;
}

static void test_each_sample_is_the_value_at_its_point(void **state) {
    (void)state;
    static float values[WIDTH * HEIGHT];
    bl_signal *noise = open_noise();
    bl_grid_fill(noise, &slanted, 2, values);
    for (int j = 0; j < HEIGHT; j++)
        for (int i = 0; i < WIDTH; i++) {
            double at[BL_AXES];
            for (int a = 0; a < BL_AXES; a++)
                at[a] = slanted.origin[a] + i * slanted.right[a] + j * slanted.down[a];
            assert_near((double)values[j * WIDTH + i], bl_signal_value(noise, at), 1e-6);
        }
    bl_signal_free(noise);
}

static void test_the_number_of_threads_changes_no_bit(void **state) {
    (void)state;
    static float one[WIDTH * HEIGHT], many[WIDTH * HEIGHT];
    bl_signal *noise = open_noise();
    bl_grid_fill(noise, &slanted, 1, one);
    for (int threads = 0; threads <= 4; threads++) {
        memset(many, 0, sizeof many);
        bl_grid_fill(noise, &slanted, threads, many);
        assert_memory_equal(one, many, sizeof one);
    }
    bl_signal_free(noise);
}

static void test_an_empty_grid_writes_nothing(void **state) {
    (void)state;
    float value = 7;
    bl_signal *noise = open_noise();
    bl_grid empty = slanted;
    empty.height = 0;
    bl_grid_fill(noise, &empty, 1, &value);
    empty = slanted;
    empty.width = 0;
    bl_grid_fill(noise, &empty, 1, &value);
    assert_true(value == 7);
    bl_signal_free(noise);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_sample_is_the_value_at_its_point),
        cmocka_unit_test(test_the_number_of_threads_changes_no_bit),
        cmocka_unit_test(test_an_empty_grid_writes_nothing),
    };
    return bl_run_tests(tests);
}
