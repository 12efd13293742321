// SPDX-License-Identifier: MIT
//
// Walks the registry of noises: a sample is a function of its own coordinate, bit for bit. Where a
// row was cut, how long it is, and which points stand beside a point in a batch change nothing, at
// the places where rounding is hardest: ties of the fraction's last place, 0, and the borders where
// a fast path ends.
#include "tests/test.h"

#include "core/random.h"
#include "tests/texts.h"

enum { LONGEST = 1100 };

static size_t below(bl_random *random, size_t count) {
    return (size_t)(bl_random_unit(random) * (double)count);
}

static double one_of(bl_random *random, const double *numbers, size_t count) {
    double number = numbers[below(random, count)];
    return bl_random_unit(random) < 0.5 ? number : -number;
}

#define ONE_OF(random, numbers) one_of(random, numbers, sizeof(numbers) / sizeof *(numbers))

// A whole number from which a hard coordinate hangs: 0 half of the time, so that (-1, 1) is.
static double choose_cell(bl_random *random) {
    static const double cells[] = {1,      2,          300,    511,    512,         1e6,    0x1p26,
                                   0x1p27, 0x1p27 - 1, 0x1p28, 1e9,    0x1p31,      0x1p32, 0x1p40,
                                   0x1p52, 0x1p53,     1e17,   0x1p62, 0x1p62 - 512};
    return bl_random_unit(random) < 0.5 ? 0 : ONE_OF(random, cells);
}

// A coordinate on, just below or just above a tie between two multiples of 2^-24; or any.
static double choose_start(bl_random *random) {
    static const double beside[] = {0, 0x1p-53, 0x1p-54, 0x1p-60, 0x1p-77, 0x1p-200, 5e-324};
    static const double edges[] = {0, 5e-324, 1e-300, 0x1p-54, 0x1p-25, 0x1p-24, 0.5, 1};
    double cell = choose_cell(random);
    double kind = bl_random_unit(random);
    if (kind < 0.25)
        return cell + (2 * bl_random_unit(random) - 1);
    if (kind < 0.35)
        return (cell + ONE_OF(random, edges)) + ONE_OF(random, beside);
    double tie = (floor(bl_random_unit(random) * 0x1p24) + 0.5) * 0x1p-24;
    if (bl_random_unit(random) < 0.3)
        tie = (floor(bl_random_unit(random) * 8) + 0.5) * 0x1p-24;
    // With a cell, next to the tie is where doubles are next to it.
    double start = cell + (bl_random_unit(random) < 0.5 ? tie : -tie);
    if (bl_random_unit(random) < 0.5)
        return start + ONE_OF(random, beside);
    return nextafter(start, bl_random_unit(random) < 0.5 ? INFINITY : -INFINITY);
}

static double choose_step(bl_random *random) {
    static const double steps[] = {0,       5e-324, 1e-300, 1e-9,  0x1p-60, 0x1p-26, 0x1p-25,
                                   0x3p-25, 0.001,  0.05,   0.125, 0.25,    0.25,    0.25,
                                   0.3,     0.5,    1,      1.25,  1.5,     1.75,    2,
                                   2.5,     7.3,    1e6,    1e9,   1e17,    0x1p58};
    return ONE_OF(random, steps);
}

// A line along an axis, or an oblique one.
static void choose_line(bl_random *random, double start[BL_AXES], double step[BL_AXES]) {
    size_t axis = below(random, 4);
    for (size_t a = 0; a < BL_AXES; a++) {
        start[a] = choose_start(random);
        step[a] = axis == 3 || axis == a ? choose_step(random) : 0;
        // The places across are seldom hard: outside of the domain nothing is left to compare.
        if (axis != a && bl_random_unit(random) < 0.8)
            start[a] = 20 * bl_random_unit(random) - 10;
    }
}

static size_t choose_count(bl_random *random) {
    static const size_t counts[] = {1, 2, 15, 16, 17, 128, 129, 511, 512, 513, 1024};
    if (bl_random_unit(random) < 0.5)
        return counts[below(random, sizeof counts / sizeof *counts)];
    return 1 + below(random, bl_random_unit(random) < 0.5 ? 40 : LONGEST - 1);
}

// Fails unless a sample of a row has the bits it has alone.
static void check_sample(const char *text, const bl_signal *signal, const double start[],
                         const double step[], size_t count, size_t i, float sample) {
    double at[BL_AXES];
    float alone;
    for (int a = 0; a < BL_AXES; a++)
        at[a] = start[a] + (double)i * step[a];
    bl_signal_row(signal, at, step, 1, &alone);
    if (memcmp(&sample, &alone, sizeof alone) != 0)
        fail_msg("%s: sample %zu of a row of %zu is %a, alone %a; start %a %a %a, step %a %a %a",
                 text, i, count, (double)sample, (double)alone, start[0], start[1], start[2],
                 step[0], step[1], step[2]);
}

static void test_a_sample_of_a_row_is_as_alone(void **state) {
    (void)state;
    const bl_texts *list = bl_test_texts();
    const size_t lines = bl_test_scaled(600, 100);
    for (size_t n = 0; n < list->count; n++) {
        bl_random random = bl_random_seed(1, 0);
        bl_signal *signal = bl_test_open(list->text[n], BL_ISA_BEST);
        for (size_t line = 0; line < lines; line++) {
            static float row[LONGEST];
            double start[BL_AXES], step[BL_AXES];
            choose_line(&random, start, step);
            size_t count = choose_count(&random);
            bl_signal_row(signal, start, step, count, row);
            check_sample(list->text[n], signal, start, step, count, 0, row[0]);
            for (int k = 0; k < 6; k++) {
                size_t i = below(&random, count);
                check_sample(list->text[n], signal, start, step, count, i, row[i]);
            }
        }
        bl_signal_free(signal);
    }
}

// A line whose coordinates are all exact, so that it may be cut anywhere: start and step are
// multiples of 2^-30 below 2^17, far out of 2^-10 below 2^41, which with LONGEST < 2^11 steps of at
// most 8, or 2^20, leaves less than 53 bits.
static void choose_exact_line(bl_random *random, double start[BL_AXES], double step[BL_AXES]) {
    static const double steps[] = {0,    0x1p-30, 0x1p-25, 0x5p-24, 0.046875, 0x3333p-18, 0.0625,
                                   0.25, 0.5,     1,       1.5,     1.75,     2,          7.25};
    static const double far_steps[] = {0, 0x1p-10, 0.0625, 0.25, 0.75, 1.5, 1.75, 2, 7.25, 1e6};
    static const double cells[] = {0, 1, 256, 1e5};
    static const double far_cells[] = {1e6, 0x1p27, 1e9, 0x1p40};
    size_t axis = below(random, 4);
    int far = bl_random_unit(random) < 0.4;
    double unit = far ? 0x1p-10 : 0x1p-30;
    for (size_t a = 0; a < BL_AXES; a++) {
        double cell = far ? ONE_OF(random, far_cells) : ONE_OF(random, cells);
        double chosen = far ? ONE_OF(random, far_steps) : ONE_OF(random, steps);
        start[a] = cell + round((8 * bl_random_unit(random) - 4) / unit) * unit;
        step[a] = axis == 3 || axis == a ? chosen : 0;
    }
}

static void test_where_a_row_is_cut_changes_nothing(void **state) {
    (void)state;
    const bl_texts *list = bl_test_texts();
    const size_t lines = bl_test_scaled(60, 20);
    for (size_t n = 0; n < list->count; n++) {
        bl_random random = bl_random_seed(2, 0);
        bl_signal *signal = bl_test_open(list->text[n], BL_ISA_BEST);
        for (size_t line = 0; line < lines; line++) {
            static float whole[LONGEST], parts[LONGEST];
            double start[BL_AXES], step[BL_AXES], at[BL_AXES];
            choose_exact_line(&random, start, step);
            bl_signal_row(signal, start, step, LONGEST, whole);
            for (size_t from = 0, here; from < LONGEST; from += here) {
                here = choose_count(&random);
                here = here < LONGEST - from ? here : LONGEST - from;
                for (int a = 0; a < BL_AXES; a++)
                    at[a] = start[a] + (double)from * step[a];
                bl_signal_row(signal, at, step, here, parts + from);
            }
            for (size_t i = 0; i < LONGEST; i++)
                if (memcmp(&whole[i], &parts[i], sizeof *whole) != 0)
                    fail_msg(
                        "%s: sample %zu is %a in the whole row, %a in its part; start %a %a "
                        "%a, step %a %a %a",
                        list->text[n], i, (double)whole[i], (double)parts[i], start[0], start[1],
                        start[2], step[0], step[1], step[2]);
        }
        bl_signal_free(signal);
    }
}

// Far points, and points outside of the domain, take other ways; their neighbours must not.
static void test_a_point_beside_any_other_is_as_alone(void **state) {
    (void)state;
    enum { MANY = 150 };
    const bl_texts *list = bl_test_texts();
    const size_t batches = bl_test_scaled(40, 10);
    for (size_t n = 0; n < list->count; n++) {
        bl_random random = bl_random_seed(3, 0);
        bl_signal *signal = bl_test_open(list->text[n], BL_ISA_BEST);
        for (size_t batch = 0; batch < batches; batch++) {
            static double at[BL_AXES][MANY];
            float all[MANY], alone;
            for (size_t k = 0; k < MANY; k++)
                for (int a = 0; a < BL_AXES; a++)
                    at[a][k] = choose_start(&random);
            bl_signal_points(signal, BL_COLUMNS(at), MANY, all);
            for (size_t k = 0; k < MANY; k += 1 + below(&random, 5)) {
                bl_signal_points(
                    signal, (const double *const[]){at[0] + k, at[1] + k, at[2] + k, at[3] + k}, 1,
                    &alone);
                if (memcmp(&all[k], &alone, sizeof alone) != 0)
                    fail_msg("%s at (%a, %a, %a): %a in a batch, %a alone", list->text[n], at[0][k],
                             at[1][k], at[2][k], (double)all[k], (double)alone);
            }
        }
        bl_signal_free(signal);
    }
}

static void test_no_more_is_written_than_asked_for(void **state) {
    (void)state;
    static const size_t counts[] = {0, 1, 17, 512, 513};
    static const double steps[] = {0, 0.05, -0.5, 1.75, 9};
    const bl_texts *list = bl_test_texts();
    for (size_t n = 0; n < list->count; n++) {
        bl_signal *signal = bl_test_open(list->text[n], BL_ISA_BEST);
        for (size_t k = 0; k < 25; k++)
            for (size_t axis = 0; axis < 4; axis++) {
                static float out[LONGEST];
                size_t count = counts[k / 5];
                const double start[BL_AXES] = {0.25, -0.125, 7.5, 0.5};
                double step[BL_AXES] = {0};
                for (size_t a = 0; a < 3; a++)
                    step[a] = axis == 3 || axis == a ? steps[k % 5] : 0;
                for (size_t i = 0; i < LONGEST; i++)
                    out[i] = 1e30f;
                bl_signal_row(signal, start, step, count, out);
                for (size_t i = 0; i < LONGEST; i++)
                    if ((out[i] == 1e30f) != (i >= count))
                        fail_msg("%s: place %zu after a row of %zu", list->text[n], i, count);
            }
        bl_signal_free(signal);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_sample_of_a_row_is_as_alone),
        cmocka_unit_test(test_where_a_row_is_cut_changes_nothing),
        cmocka_unit_test(test_a_point_beside_any_other_is_as_alone),
        cmocka_unit_test(test_no_more_is_written_than_asked_for),
    };
    return bl_run_tests(tests);
}
