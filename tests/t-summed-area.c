// SPDX-License-Identifier: MIT
//
// Summed-area tables against sums over pixels, in all four precisions; boxes with real edges, wider
// than the image, outside of it and without end; the law of the error of float tables.
#include "tests/test.h"

#include "core/random.h"
#include "filters/summed_area.h"

enum { WIDTH = 13, HEIGHT = 7 };

static const bl_sums all_sums[] = {BL_SUMS_FLOAT, BL_SUMS_ROUNDED, BL_SUMS_DOUBLE,
                                   BL_SUMS_COMPENSATED};
static const double epsilon[] = {0x1p-24, 0x1p-24, 0x1p-53, 0x1p-100};

static bl_summed_area *make(const float *values, size_t width, size_t height, bl_sums sums,
                            bl_continuation continuation) {
    bl_summed_area *table = NULL;
    bl_message message;
    assert_int_equal(
        bl_summed_area_make(values, width, height, sums, continuation, &table, &message), BL_OK);
    return table;
}

static float *random_image(size_t width, size_t height, uint64_t seed) {
    float *values = malloc(sizeof *values * width * height);
    bl_random random = bl_random_seed(seed, 1);
    for (size_t i = 0; i < width * height; i++)
        values[i] = (float)bl_random_unit(&random);
    return values;
}

static size_t continued(long index, size_t length, bl_continuation continuation) {
    long last = (long)length - 1;
    if (continuation == BL_WRAPPED)
        return (size_t)((index % (long)length + (long)length) % (long)length);
    return (size_t)(index < 0 ? 0 : index > last ? last : index);
}

// The mean over a box, pixel by pixel, each with the share of it that the box covers.
static double counted(const float *values, size_t width, size_t height,
                      bl_continuation continuation, double x, double y, const double size[2]) {
    double left = x - 0.5 * size[0], top = y - 0.5 * size[1];
    double right = x + 0.5 * size[0], bottom = y + 0.5 * size[1];
    long double sum = 0;
    for (long j = (long)floor(top); (double)j < bottom; j++)
        for (long i = (long)floor(left); (double)i < right; i++) {
            double across = fmin((double)i + 1, right) - fmax((double)i, left);
            double down = fmin((double)j + 1, bottom) - fmax((double)j, top);
            size_t n =
                continued(j, height, continuation) * width + continued(i, width, continuation);
            sum += (long double)across * down * values[n];
        }
    return (double)(sum / ((long double)size[0] * size[1]));
}

static void test_tables_are_sums_over_pixels(void **state) {
    (void)state;
    bl_random random = bl_random_seed(1, 2);
    for (int one = 0; one < 2; one++)
        for (int c = 0; c < 2; c++)
            for (int k = 0; k < 4; k++) {
                size_t height = one ? 1 : HEIGHT;
                bl_continuation continuation = c ? BL_WRAPPED : BL_CLAMPED;
                float *values = random_image(WIDTH, height, 3);
                bl_summed_area *table = make(values, WIDTH, height, all_sums[k], continuation);
                size_t count = bl_test_scaled(800, 100);
                for (size_t n = 0; n < count; n++) {
                    double x = 60 * (bl_random_unit(&random) - 0.4);
                    double y = 40 * (bl_random_unit(&random) - 0.4);
                    double size[2] = {exp2(8 * bl_random_unit(&random) - 3),
                                      exp2(8 * bl_random_unit(&random) - 3)};
                    double expected = counted(values, WIDTH, height, continuation, x, y, size);
                    double area = fmin(1, size[0]) * fmin(1, size[1]);
                    // The table's entries, and the edges of the box, which are rounded.
                    double tolerance = (4 * epsilon[k] * WIDTH * (double)height + 1e-13) / area;
                    assert_near(bl_summed_area_mean(table, x, y, size), expected, tolerance);
                }
                bl_summed_area_free(table);
                free(values);
            }
}

// The error of the means over boxes of `side` by `side` pixels at the far corner of a large table.
// The edges of the boxes are exact, so that only the table's entries are rounded.
enum { LARGE = 256 };
static double error_of(const float *values, bl_sums sums, int side) {
    bl_summed_area *table = make(values, LARGE, LARGE, sums, BL_CLAMPED);
    double sum = 0, size[2] = {side, side};
    for (int n = 0; n < 400; n++) {
        double x = LARGE - 40 + 0.5 * side + n % 20, y = LARGE - 40 + 0.5 * side + n / 20;
        double error = bl_summed_area_mean(table, x, y, size) -
                       counted(values, LARGE, LARGE, BL_CLAMPED, x, y, size);
        sum += error * error / 400;
    }
    bl_summed_area_free(table);
    return sqrt(sum);
}

// A row is added to the sums above it with one rounding. Of a box of h rows 2 h of them do not
// cancel, those of its two columns; in a table that is rounded once, four do not.
static void test_what_each_precision_loses(void **state) {
    (void)state;
    float *values = random_image(LARGE, LARGE, 5);
    double rounded = error_of(values, BL_SUMS_ROUNDED, 1);
    // Entries of about 2^15 have an ulp of 2^-9 or 2^-8, and errors uniform within half of it.
    assert_true(rounded > 0.5 * 0x1p-9 * sqrt(4.0 / 12) && rounded < 0x1p-8 * sqrt(4.0 / 12));
    assert_near(error_of(values, BL_SUMS_FLOAT, 1) / rounded, sqrt(0.5), 0.1);
    double ratio = error_of(values, BL_SUMS_FLOAT, 16) / error_of(values, BL_SUMS_ROUNDED, 16);
    assert_near(ratio, sqrt(32.0 / 4), 0.6);
    // Floats have 24 bits, and the sum of 2^16 of them not many more: double holds nearly all.
    assert_true(error_of(values, BL_SUMS_DOUBLE, 1) < rounded * 0x1p-28);
    assert_less(error_of(values, BL_SUMS_COMPENSATED, 1), 1e-20);
    free(values);
}

// The law of the header: four times the area, four times the error.
static void test_the_error_of_float_tables_grows_with_the_area(void **state) {
    (void)state;
    double rms[3];
    for (int s = 0; s < 3; s++) {
        size_t side = (size_t)64 << s;
        float *values = random_image(side, side, 7);
        bl_summed_area *table = make(values, side, side, BL_SUMS_ROUNDED, BL_CLAMPED);
        double sum = 0;
        for (size_t j = 0; j < side; j++)
            for (size_t i = 0; i < side; i++) {
                double error = bl_summed_area_mean(table, (double)i + 0.5, (double)j + 0.5,
                                                   (const double[2]){1, 1}) -
                               (double)values[j * side + i];
                sum += error * error;
            }
        rms[s] = sqrt(sum / (double)(side * side));
        bl_summed_area_free(table);
        free(values);
    }
    assert_near(rms[1] / rms[0], 4, 0.5);
    assert_near(rms[2] / rms[1], 4, 0.5);
}

// Numbers that cancel within the image: the pairs keep what doubles lose.
static void test_pairs_survive_cancellation(void **state) {
    (void)state;
    const float values[4] = {1e8F, 1e-12F, -1e8F, 1e-12F};
    const double size[2] = {1, 1};
    bl_summed_area *table = make(values, 4, 1, BL_SUMS_COMPENSATED, BL_CLAMPED);
    assert_near(bl_summed_area_mean(table, 1.5, 0.5, size), (double)1e-12F, 1e-20);
    assert_near(bl_summed_area_mean(table, 3.5, 0.5, size), (double)1e-12F, 1e-20);
    bl_summed_area_free(table);
    table = make(values, 4, 1, BL_SUMS_DOUBLE, BL_CLAMPED);
    assert_true(fabs(bl_summed_area_mean(table, 1.5, 0.5, size) - (double)1e-12F) > 1e-13);
    bl_summed_area_free(table);
}

static void test_beyond_the_image(void **state) {
    (void)state;
    float *values = random_image(WIDTH, HEIGHT, 9);
    bl_summed_area *clamped = make(values, WIDTH, HEIGHT, BL_SUMS_DOUBLE, BL_CLAMPED);
    bl_summed_area *wrapped = make(values, WIDTH, HEIGHT, BL_SUMS_DOUBLE, BL_WRAPPED);
    const double small[2] = {0.5, 0.5}, endless[2] = {INFINITY, INFINITY}, large[2] = {1e9, 1e9};
    // Far to the lower right of a clamped image stands its last pixel.
    assert_near(bl_summed_area_mean(clamped, 1e15, 1e15, small), (double)values[WIDTH * HEIGHT - 1],
                1e-13);
    assert_near(bl_summed_area_mean(clamped, -1e300, -1e300, small), (double)values[0], 1e-13);
    double mean = 0, corners = 0;
    for (int n = 0; n < WIDTH * HEIGHT; n++)
        mean += (double)values[n] / (WIDTH * HEIGHT);
    corners = ((double)values[0] + (double)values[WIDTH - 1] +
               (double)values[WIDTH * (HEIGHT - 1)] + (double)values[WIDTH * HEIGHT - 1]) /
              4;
    assert_near(bl_summed_area_mean(wrapped, 3.3, 4.4, endless), mean, 1e-14);
    assert_near(bl_summed_area_mean(wrapped, 3.3, 4.4, large), mean, 1e-7);
    assert_near(bl_summed_area_mean(clamped, 3.3, 4.4, endless), corners, 1e-14);
    assert_near(bl_summed_area_mean(clamped, 3.3, 4.4, large), corners, 1e-7);
    // Periods away the same.
    for (double x = -3; x < 3; x += 0.25) {
        double here = bl_summed_area_mean(wrapped, x, 2 * x, small);
        assert_near(bl_summed_area_mean(wrapped, x + 1024 * WIDTH, 2 * x - 512 * HEIGHT, small),
                    here, 1e-13);
    }
    bl_summed_area_free(clamped);
    bl_summed_area_free(wrapped);
    free(values);
}

static void test_points_are_pixels(void **state) {
    (void)state;
    float *values = random_image(WIDTH, HEIGHT, 11);
    bl_summed_area *table = make(values, WIDTH, HEIGHT, BL_SUMS_COMPENSATED, BL_WRAPPED);
    const double point[2] = {0, 0};
    for (int j = -HEIGHT; j < 2 * HEIGHT; j++)
        for (int i = -WIDTH; i < 2 * WIDTH; i++) {
            double pixel = (double)
                values[continued(j, HEIGHT, BL_WRAPPED) * WIDTH + continued(i, WIDTH, BL_WRAPPED)];
            assert_near(bl_summed_area_mean(table, i, j, point), pixel, 1e-16);
            assert_near(bl_summed_area_mean(table, i + 0.999, j + 0.5, point), pixel, 1e-16);
        }
    assert_true(isnan(bl_summed_area_mean(table, NAN, 0, point)));
    assert_true(isnan(bl_summed_area_mean(table, 0, INFINITY, point)));
    assert_true(isnan(bl_summed_area_mean(table, 0, 0, (const double[2]){1, NAN})));
    bl_summed_area_free(table);
    free(values);
}

static void test_bad_images_are_refused(void **state) {
    (void)state;
    float values[6] = {0, 1, 2, 3, 4, 5};
    bl_summed_area *table = NULL;
    bl_message message;
    assert_int_equal(
        bl_summed_area_make(values, 0, 3, BL_SUMS_DOUBLE, BL_CLAMPED, &table, &message), BL_USAGE);
    values[4] = NAN;
    assert_int_equal(
        bl_summed_area_make(values, 3, 2, BL_SUMS_DOUBLE, BL_CLAMPED, &table, &message), BL_USAGE);
    assert_non_null(strstr(message.text, "(1, 1)"));
    assert_null(table);
    bl_summed_area_free(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tables_are_sums_over_pixels),
        cmocka_unit_test(test_what_each_precision_loses),
        cmocka_unit_test(test_the_error_of_float_tables_grows_with_the_area),
        cmocka_unit_test(test_pairs_survive_cancellation),
        cmocka_unit_test(test_beyond_the_image),
        cmocka_unit_test(test_points_are_pixels),
        cmocka_unit_test(test_bad_images_are_refused),
    };
    return bl_run_tests(tests);
}
