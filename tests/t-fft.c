// SPDX-License-Identifier: MIT
//
// Transforms against the sum written out, and the promise of equal bits from run to run.
#include "tests/temporary.h"
#include "tests/test.h"

#include <complex.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/random.h"
#include "core/fft.h"

static double get(bl_fft_precision precision, const void *buffer, size_t i) {
    return precision == BL_FFT_FLOAT ? (double)((const float *)buffer)[i]
                                     : ((const double *)buffer)[i];
}

static void set(bl_fft_precision precision, void *buffer, size_t i, double value) {
    if (precision == BL_FFT_FLOAT)
        ((float *)buffer)[i] = (float)value;
    else
        ((double *)buffer)[i] = value;
}

// The sum, one cell of the spectrum at a time, for any dimensions padded with sizes of 1.
static double complex plain_sum(const double *samples, const size_t size[3], const size_t k[3]) {
    double complex sum = 0;
    for (size_t a = 0; a < size[0]; a++)
        for (size_t b = 0; b < size[1]; b++)
            for (size_t c = 0; c < size[2]; c++) {
                double phase = (double)(a * k[0] % size[0]) / (double)size[0] +
                               (double)(b * k[1] % size[1]) / (double)size[1] +
                               (double)(c * k[2] % size[2]) / (double)size[2];
                sum += samples[(a * size[1] + b) * size[2] + c] * cexp(-2 * M_PI * I * phase);
            }
    return sum;
}

static void check_against_plain_sum(unsigned dims, const size_t size[3],
                                    bl_fft_precision precision) {
    bl_fft_shape shape = {.precision = precision, .dims = dims};
    memcpy(shape.size, size + 3 - dims, dims * sizeof *size);
    size_t rows = size[0] * size[1], n = size[2], pitch = 2 * (n / 2 + 1);
    double *samples = malloc(rows * n * sizeof *samples), largest = 0;
    void *buffer = bl_fft_buffer(bl_fft_bytes(&shape));
    bl_random random = bl_random_seed(1, n);
    for (size_t i = 0; i < rows * n; i++) {
        samples[i] = (double)(float)bl_random_normal(&random);
        set(precision, buffer, i / n * pitch + i % n, samples[i]);
    }
    const bl_fft *plan;
    assert_int_equal(bl_fft_plan(&shape, &plan, NULL), BL_OK);
    bl_fft_run(plan, buffer);
    for (size_t row = 0; row < rows; row++)
        for (size_t c = 0; c <= n / 2; c++) {
            size_t k[3] = {row / size[1], row % size[1], c}, at = row * pitch + 2 * c;
            double complex x = get(precision, buffer, at) + I * get(precision, buffer, at + 1);
            largest = fmax(largest, cabs(x - plain_sum(samples, size, k)));
        }
    double ulp = precision == BL_FFT_FLOAT ? 6e-8 : 1.2e-16, root = sqrt((double)(rows * n));
    assert_less(largest, 64 * ulp * root); // the plain sum errs as well
    // And back again: the count of samples times the original.
    shape.kind = BL_FFT_BACK;
    assert_int_equal(bl_fft_plan(&shape, &plan, NULL), BL_OK);
    bl_fft_run(plan, buffer);
    for (size_t i = 0; i < rows * n; i++)
        assert_near(get(precision, buffer, i / n * pitch + i % n) / (double)(rows * n), samples[i],
                    64 * ulp);
    free(samples);
    free(buffer);
}

static void test_transforms_are_the_sum_written_out(void **state) {
    (void)state;
    const size_t sizes[][3] = {{1, 1, 1},  {1, 1, 2},  {1, 1, 8},   {1, 1, 9},  {1, 1, 97},
                               {1, 1, 60}, {1, 5, 6},  {1, 16, 16}, {1, 13, 7}, {3, 4, 5},
                               {8, 8, 8},  {1, 1, 16}, {2, 3, 2}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        unsigned dims = sizes[i][0] > 1 ? 3 : sizes[i][1] > 1 ? 2 : 1;
        check_against_plain_sum(dims, sizes[i], BL_FFT_FLOAT);
        check_against_plain_sum(dims, sizes[i], BL_FFT_DOUBLE);
    }
}

static void test_rows_and_columns_are_the_sum_written_out(void **state) {
    (void)state;
    enum { N = 24, COLUMNS = 5 };
    bl_fft_shape shape = {.kind = BL_FFT_COLUMNS, .dims = 1, .size = {N}, .columns = COLUMNS};
    const bl_fft *plan;
    assert_int_equal(bl_fft_plan(&shape, &plan, NULL), BL_OK);
    float *buffer = bl_fft_buffer(bl_fft_bytes(&shape)), *row = bl_fft_buffer(4 * (N + 2));
    float original[2 * N * COLUMNS];
    bl_random random = bl_random_seed(2, 0);
    for (size_t i = 0; i < 2 * N * COLUMNS; i++)
        original[i] = buffer[i] = (float)bl_random_normal(&random);
    bl_fft_run(plan, buffer);
    for (size_t c = 0; c < COLUMNS; c++)
        for (size_t k = 0; k < N; k++) {
            double complex sum = 0;
            for (size_t n = 0; n < N; n++)
                sum += ((double)original[2 * (n * COLUMNS + c)] +
                        I * (double)original[2 * (n * COLUMNS + c) + 1]) *
                       cexp(-2 * M_PI * I * (double)(n * k) / N);
            assert_near((double)buffer[2 * (k * COLUMNS + c)], creal(sum), 1e-5);
            assert_near((double)buffer[2 * (k * COLUMNS + c) + 1], cimag(sum), 1e-5);
        }
    double samples[N];
    for (size_t n = 0; n < N; n++) {
        buffer[n] = (float)n * (float)n;
        samples[n] = (double)(n * n);
    }
    shape.kind = BL_FFT_ROW;
    assert_int_equal(bl_fft_plan(&shape, &plan, NULL), BL_OK);
    bl_fft_run_row(plan, buffer, row);
    for (size_t k = 0; k <= N / 2; k++) {
        double complex sum = plain_sum(samples, (size_t[3]){1, 1, N}, (size_t[3]){0, 0, k});
        assert_near((double)row[2 * k], creal(sum), 1e-3);
        assert_near((double)row[2 * k + 1], cimag(sum), 1e-3);
    }
    free(buffer);
    free(row);
}

static void test_shapes_that_are_none_are_refused(void **state) {
    (void)state;
    bl_message message;
    const bl_fft *plan;
    const bl_fft_shape wrong[] = {
        {.dims = 0, .size = {8}},
        {.dims = 4, .size = {8}},
        {.dims = 2, .size = {8, 0}},
        {.dims = 1, .size = {8}, .threads = -1},
        {.kind = BL_FFT_COLUMNS, .dims = 1, .size = {8}},
        {.kind = BL_FFT_ROW, .precision = BL_FFT_DOUBLE, .dims = 1, .size = {8}}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_int_equal(bl_fft_plan(&wrong[i], &plan, &message), BL_USAGE);
    bl_fft_shape huge = {.dims = 1, .size = {SIZE_MAX - 1}};
    assert_int_equal(bl_fft_plan(&huge, &plan, &message), BL_MISMATCH);
    huge = (bl_fft_shape){.dims = 3, .size = {(size_t)1 << 31, (size_t)1 << 31, (size_t)1 << 31}};
    assert_true(bl_fft_bytes(&huge) == SIZE_MAX);
    assert_null(bl_fft_buffer(SIZE_MAX));
}

static void test_plans_are_made_once_by_any_thread(void **state) {
    (void)state;
    const bl_fft *plans[8];
    bl_fft_shape shape = {.precision = BL_FFT_DOUBLE, .dims = 1, .size = {77}};
#pragma omp parallel for num_threads(8)
    for (int i = 0; i < 8; i++)
        if (bl_fft_plan(&shape, &plans[i], NULL) != BL_OK)
            plans[i] = NULL;
    for (int i = 0; i < 8; i++)
        assert_true(plans[i] && plans[i] == plans[0]);
}

static void transform_bits(size_t n, float *out) {
    bl_fft_shape shape = {.dims = 1, .size = {n}};
    const bl_fft *plan;
    assert_int_equal(bl_fft_plan(&shape, &plan, NULL), BL_OK);
    float *buffer = bl_fft_buffer(bl_fft_bytes(&shape));
    bl_random random = bl_random_seed(3, 0);
    for (size_t i = 0; i < n; i++)
        buffer[i] = (float)bl_random_normal(&random);
    bl_fft_run(plan, buffer);
    memcpy(out, buffer, n * sizeof *out);
    free(buffer);
}

// A process that forgot everything is as good as a new one: the bits must come from the disk.
static void test_wisdom_on_disk_gives_the_same_bits_again(void **state) {
    (void)state;
    enum { N = 3600 };
    static float first[N], again[N];
    char cache[] = "/tmp/bandlimit-test-XXXXXX", path[128], *folder;
    assert_non_null(mkdtemp(cache));
    setenv("XDG_CACHE_HOME", cache, 1);
    bl_fft_forget();
    assert_true(bl_fft_keeps_wisdom(&folder));
    free(folder);
    transform_bits(N, first);
    snprintf(path, sizeof path, "%s/bandlimit/fftw-float.wisdom", cache);
    struct stat before, after;
    assert_int_equal(stat(path, &before), 0);
    for (int i = 0; i < 3; i++) {
        bl_fft_forget();
        transform_bits(N, again);
        assert_memory_equal(first, again, sizeof first);
    }
    assert_int_equal(stat(path, &after), 0);
    assert_true(after.st_ino == before.st_ino); // it was read, not measured and written anew
    FILE *damaged = fopen(path, "w");
    fputs("(fftw-3.3.10 fftwf_wisdom #x0 nonsense", damaged);
    fclose(damaged);
    bl_fft_forget();
    transform_bits(N, again); // a damaged file is replaced
    for (int i = 0; i < N; i++)
        assert_near((double)again[i], (double)first[i], 1e-3);
    bl_fft_forget();
    unlink(path);
    snprintf(path, sizeof path, "%s/bandlimit/lock", cache);
    unlink(path);
    snprintf(path, sizeof path, "%s/bandlimit", cache);
    rmdir(path);
    rmdir(cache);
    bl_temporary_no_wisdom(NULL);
}

static void test_estimated_plans_give_the_same_bits_again(void **state) {
    (void)state;
    enum { N = 1024 };
    static float first[N], again[N];
    char *folder;
    assert_false(bl_fft_keeps_wisdom(&folder));
    free(folder);
    setenv("XDG_CACHE_HOME", "relative/path", 1); // which the standard says to ignore
    assert_false(bl_fft_keeps_wisdom(&folder));
    free(folder);
    bl_fft_forget();
    transform_bits(N, first);
    bl_fft_forget();
    transform_bits(N, again);
    assert_memory_equal(first, again, sizeof first);
    bl_temporary_no_wisdom(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_transforms_are_the_sum_written_out),
        cmocka_unit_test(test_rows_and_columns_are_the_sum_written_out),
        cmocka_unit_test(test_shapes_that_are_none_are_refused),
        cmocka_unit_test(test_plans_are_made_once_by_any_thread),
        cmocka_unit_test(test_wisdom_on_disk_gives_the_same_bits_again),
        cmocka_unit_test(test_estimated_plans_give_the_same_bits_again),
    };
    bl_set_filter();
    return cmocka_run_group_tests(tests, bl_temporary_no_wisdom, NULL);
}
