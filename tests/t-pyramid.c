// SPDX-License-Identifier: MIT
//
// MIP pyramids: the box against means of blocks, other filters against quadrature of their kernels
// over constant pixels, what every level keeps, and lookups between levels.
#include "tests/test.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include "core/random.h"
#include "filters/pyramid.h"

static float *random_image(size_t width, size_t height, uint64_t seed) {
    float *values = malloc(sizeof *values * width * height);
    bl_random random = bl_random_seed(seed, 1);
    for (size_t i = 0; i < width * height; i++)
        values[i] = (float)bl_random_unit(&random);
    return values;
}

static bl_pyramid *make(const float *values, size_t width, size_t height, const char *filter,
                        bl_continuation continuation) {
    bl_pyramid *pyramid = NULL;
    bl_message message;
    assert_int_equal(bl_pyramid_make(values, width, height, bl_filter_find(filter), continuation,
                                     &pyramid, &message),
                     BL_OK);
    return pyramid;
}

static void test_levels_halve_down_to_one_pixel(void **state) {
    (void)state;
    const size_t sizes[][2] = {{1, 1}, {2, 2}, {5, 1}, {1, 9}, {64, 16}, {37, 23}};
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        float *values = random_image(sizes[s][0], sizes[s][1], 1);
        bl_pyramid *pyramid = make(values, sizes[s][0], sizes[s][1], "box", BL_CLAMPED);
        size_t width = sizes[s][0], height = sizes[s][1], n = 0, w, h;
        for (;; n++) {
            bl_pyramid_size(pyramid, n, &w, &h);
            assert_int_equal(w, width);
            assert_int_equal(h, height);
            if (width == 1 && height == 1)
                break;
            width = (width + 1) / 2;
            height = (height + 1) / 2;
        }
        assert_int_equal(bl_pyramid_levels(pyramid), n + 1);
        assert_true(isnan(bl_pyramid_pixel(pyramid, n + 1, 0, 0)));
        assert_true(isnan(bl_pyramid_pixel(pyramid, 0, w + sizes[s][0], 0)));
        bl_pyramid_free(pyramid);
        free(values);
    }
}

// Of sizes that are powers of two a pixel of the box's level n is the mean of 2^n by 2^n.
static void test_the_box_takes_means_of_blocks(void **state) {
    (void)state;
    enum { WIDTH = 32, HEIGHT = 16 };
    float *values = random_image(WIDTH, HEIGHT, 2);
    bl_pyramid *pyramid = make(values, WIDTH, HEIGHT, "box", BL_CLAMPED);
    for (size_t n = 0; n <= 4; n++)
        for (size_t j = 0; j < (size_t)HEIGHT >> n; j++)
            for (size_t i = 0; i < (size_t)WIDTH >> n; i++) {
                size_t side = (size_t)1 << n;
                double sum = 0;
                for (size_t k = 0; k < side * side; k++)
                    sum += (double)values[(j * side + k / side) * WIDTH + i * side + k % side];
                assert_near(bl_pyramid_pixel(pyramid, n, i, j), sum / (double)(side * side), 1e-15);
            }
    bl_pyramid_free(pyramid);
    free(values);
}

// Odd sizes: the pixels of the image are cut where the box ends; the mean of all stays.
static void test_the_box_keeps_the_mean_of_any_size(void **state) {
    (void)state;
    enum { WIDTH = 45, HEIGHT = 27 };
    float *values = random_image(WIDTH, HEIGHT, 3);
    bl_pyramid *pyramid = make(values, WIDTH, HEIGHT, "box", BL_CLAMPED);
    double mean = 0;
    for (size_t n = 0; n < WIDTH * HEIGHT; n++)
        mean += (double)values[n] / (WIDTH * HEIGHT);
    for (size_t n = 0; n < bl_pyramid_levels(pyramid); n++) {
        size_t w, h;
        double sum = 0;
        bl_pyramid_size(pyramid, n, &w, &h);
        for (size_t k = 0; k < w * h; k++)
            sum += bl_pyramid_pixel(pyramid, n, k % w, k / w);
        assert_near(sum / (double)(w * h), mean, 1e-14);
    }
    bl_pyramid_free(pyramid);
    free(values);
}

typedef struct line {
    const float *values;
    size_t length;
    const bl_filter *filter;
    double middle, width;
} line;

static double weighted(double x, void *context) {
    const line *l = context;
    long index = (long)floor(x) % (long)l->length;
    index += index < 0 ? (long)l->length : 0;
    return l->filter->kernel((x - l->middle) / l->width) / l->width * (double)l->values[index];
}

static void test_every_filter_integrates_constant_pixels(void **state) {
    (void)state;
    gsl_set_error_handler_off();
    gsl_integration_workspace *workspace = gsl_integration_workspace_alloc(1000);
    for (size_t f = 0; f < bl_filter_count(); f++) {
        const bl_filter *filter = bl_filter_at(f);
        if (strcmp(filter->name, "sinc") == 0)
            continue;
        for (size_t length = 11; length <= 16; length += 5) {
            float *values = random_image(length, 1, 4);
            bl_pyramid *pyramid = make(values, length, 1, filter->name, BL_WRAPPED);
            size_t coarse = (length + 1) / 2;
            for (size_t i = 0; i < coarse; i++) {
                double width = (double)length / (double)coarse, sum = 0;
                line in = {values, length, filter, ((double)i + 0.5) * width, width};
                gsl_function function = {weighted, &in};
                double reach = (isfinite(filter->support) ? filter->support : 5) * width;
                // Corners: pixels, and knots of the kernel at multiples of half a width.
                for (double left = in.middle - reach; left < in.middle + reach - 1e-12;) {
                    double knot =
                        in.middle + (floor(2 * (left - in.middle) / width + 1e-9) + 1) * width / 2;
                    double right = fmin(floor(left + 1e-12) + 1, knot), part, error;
                    gsl_integration_qag(&function, left, right, 1e-14, 1e-12, 1000,
                                        GSL_INTEG_GAUSS31, workspace, &part, &error);
                    sum += part;
                    left = right;
                }
                assert_near(bl_pyramid_pixel(pyramid, 1, i, 0), sum, 1e-11);
            }
            bl_pyramid_free(pyramid);
            free(values);
        }
    }
    gsl_integration_workspace_free(workspace);
}

static void test_constants_stay(void **state) {
    (void)state;
    enum { SIDE = 27 };
    float constant[SIDE * SIDE];
    for (size_t n = 0; n < SIDE * SIDE; n++)
        constant[n] = 0.75F;
    for (size_t f = 0; f < bl_filter_count(); f++) {
        if (strcmp(bl_filter_at(f)->name, "sinc") == 0)
            continue;
        bl_pyramid *pyramid = make(constant, SIDE, SIDE, bl_filter_at(f)->name, BL_CLAMPED);
        for (size_t n = 0; n < bl_pyramid_levels(pyramid); n++)
            assert_near(bl_pyramid_pixel(pyramid, n, 0, 0), 0.75, 1e-13);
        bl_pyramid_free(pyramid);
    }
}

// The mean of a line that wraps, at level 1 minus that at level 0.
static double change_of_mean(const float *values, size_t length, const char *filter) {
    bl_pyramid *pyramid = make(values, length, 1, filter, BL_WRAPPED);
    double change = 0;
    size_t half = (length + 1) / 2;
    for (size_t i = 0; i < half; i++)
        change += bl_pyramid_pixel(pyramid, 1, i, 0) / (double)half;
    for (size_t i = 0; i < length; i++)
        change -= (double)values[i] / (double)length;
    bl_pyramid_free(pyramid);
    return change;
}

// Of an even number of pixels each counts as much as any other, by symmetry. Of an odd one only
// where the weights of samples a width apart add to 1 everywhere, which is where the response is 0
// at all whole frequencies.
static void test_means_stay_where_the_weights_add_to_one(void **state) {
    (void)state;
    float *values = random_image(45, 1, 5);
    for (size_t f = 0; f < bl_filter_count(); f++) {
        const bl_filter *filter = bl_filter_at(f);
        if (strcmp(filter->name, "sinc") == 0)
            continue;
        int keeps = fabs(filter->response(1)) < 1e-12 && fabs(filter->response(2)) < 1e-12;
        assert_near(change_of_mean(values, 44, filter->name), 0, 1e-14);
        assert_int_equal(fabs(change_of_mean(values, 45, filter->name)) < 1e-14, keeps);
    }
    free(values);
}

static void test_lookups(void **state) {
    (void)state;
    enum { SIDE = 16 };
    float values[SIDE * SIDE];
    for (size_t n = 0; n < SIDE * SIDE; n++) // a plane: linear between pixels is exact
        values[n] = (float)(n % SIDE) + 2 * (float)(n / SIDE);
    bl_pyramid *pyramid = make(values, SIDE, SIDE, "box", BL_CLAMPED);
    for (double x = 4; x <= 12; x += 0.37)
        for (double y = 4; y <= 12; y += 0.41)
            for (double width = 0; width <= 4; width += 0.4) // the edges are not reached
                assert_near(bl_pyramid_value(pyramid, x, y, width), x - 0.5 + 2 * (y - 0.5), 1e-13);
    bl_pyramid_free(pyramid);
    float *noise = random_image(SIDE, SIDE, 6);
    pyramid = make(noise, SIDE, SIDE, "mitchell", BL_WRAPPED);
    size_t last = bl_pyramid_levels(pyramid) - 1;
    for (size_t n = 0; n <= last; n++) { // at the middle of a pixel, at its level
        double side = exp2((double)n);
        assert_near(bl_pyramid_value(pyramid, 0.5 * side, 0.5 * side, side),
                    bl_pyramid_pixel(pyramid, n, 0, 0), 1e-15);
        // Half way between two levels, and an image further.
        if (n < last) {
            double middle = 0.5 * (bl_pyramid_value(pyramid, 3.3, 4.4, side) +
                                   bl_pyramid_value(pyramid, 3.3, 4.4, 2 * side));
            assert_near(bl_pyramid_value(pyramid, 3.3, 4.4, side * M_SQRT2), middle, 1e-13);
        }
        assert_near(bl_pyramid_value(pyramid, 3.25 + SIDE, 4.5 - SIDE, side),
                    bl_pyramid_value(pyramid, 3.25, 4.5, side), 1e-14);
    }
    double top = bl_pyramid_pixel(pyramid, last, 0, 0);
    assert_near(bl_pyramid_value(pyramid, 1e300, -1e300, 1e9), top, 1e-15);
    assert_near(bl_pyramid_value(pyramid, 7, 9, INFINITY), top, 1e-15);
    assert_true(isnan(bl_pyramid_value(pyramid, NAN, 0, 1)));
    assert_true(isnan(bl_pyramid_value(pyramid, 0, INFINITY, 1)));
    assert_true(isnan(bl_pyramid_value(pyramid, 0, 0, NAN)));
    bl_pyramid_free(pyramid);
    free(noise);
}

static void test_what_cannot_be_made_is_refused(void **state) {
    (void)state;
    const float value = 1;
    bl_pyramid *pyramid = NULL;
    bl_message message;
    assert_int_equal(
        bl_pyramid_make(&value, 0, 1, bl_filter_find("box"), BL_CLAMPED, &pyramid, &message),
        BL_USAGE);
    assert_int_equal(
        bl_pyramid_make(&value, 1, 1, bl_filter_find("sinc"), BL_CLAMPED, &pyramid, &message),
        BL_USAGE);
    assert_non_null(strstr(message.text, "sinc"));
    assert_null(pyramid);
    bl_pyramid_free(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_levels_halve_down_to_one_pixel),
        cmocka_unit_test(test_the_box_takes_means_of_blocks),
        cmocka_unit_test(test_the_box_keeps_the_mean_of_any_size),
        cmocka_unit_test(test_every_filter_integrates_constant_pixels),
        cmocka_unit_test(test_constants_stay),
        cmocka_unit_test(test_means_stay_where_the_weights_add_to_one),
        cmocka_unit_test(test_lookups),
        cmocka_unit_test(test_what_cannot_be_made_is_refused),
    };
    return bl_run_tests(tests);
}
