// SPDX-License-Identifier: MIT
//
// Footprints and batches: the widths of an upright footprint; points, whole footprints and widths
// that are not known; and for every texture, primitive and noise of the registry, that a sample
// has the same bits alone and in any batch, whatever the others of it are.
#include "tests/test.h"

#include "core/footprint.h"
#include "core/random.h"
#include "filters/primitive.h"
#include "sources/source.h"
#include "tests/texts.h"
#include "tests/sources.h"
#include "textures/texture.h"

enum { COUNT = 3 * BL_BATCH + 7 };

// --- footprints ---------------------------------------------------------------------------------

static void test_an_upright_footprint_has_its_widths(void **state) {
    (void)state;
    const double width[BL_AXES] = {3, 0.5, 7, INFINITY};
    const bl_footprint footprint = bl_footprint_of_widths(width);
    assert_memory_equal(footprint.width, width, sizeof width);
    for (int a = 0; a < BL_AXES; a++) {
        assert_near(footprint.across[a], a == 0 ? 3 : 0, 0);
        assert_near(footprint.down[a], a == 1 ? 0.5 : 0, 0);
    }
    // In one or two axes the sides say all: any estimate of the widths gives them back.
    for (int a = 0; a < 2; a++) {
        assert_near(fabs(footprint.across[a]) + fabs(footprint.down[a]), width[a], 0);
        assert_near(hypot(footprint.across[a], footprint.down[a]), width[a], 0);
    }
}

static void test_one_width_is_that_along_every_axis(void **state) {
    (void)state;
    const bl_footprint footprint = bl_footprint_of_width(0.3);
    for (int a = 0; a < BL_AXES; a++)
        assert_near(footprint.width[a], 0.3, 0);
    assert_near(footprint.across[0], 0.3, 0);
    assert_near(footprint.down[1], 0.3, 0);
    assert_near(footprint.across[2] + footprint.down[2], 0, 0);
}

static void test_a_point_is_0_and_a_whole_footprint_infinite(void **state) {
    (void)state;
    const bl_footprint whole = bl_footprint_of_width(INFINITY), point = bl_footprint_of_width(0);
    const bl_footprint strip = bl_footprint_of_widths((const double[BL_AXES]){INFINITY, 1});
    assert_memory_equal(&point, &bl_footprint_point, sizeof point);
    for (unsigned dimensions = 1; dimensions <= BL_AXES; dimensions++) {
        assert_true(bl_footprint_is_whole(&whole, dimensions));
        assert_false(bl_footprint_is_whole(&point, dimensions));
        assert_true(isinf(bl_footprint_widest(&whole, dimensions)));
        assert_near(bl_footprint_widest(&point, dimensions), 0, 0);
        assert_int_equal(bl_footprint_is_whole(&strip, dimensions), dimensions == 1);
    }
}

static void test_the_widest_axis_is_not_known_where_one_is_not(void **state) {
    (void)state;
    for (unsigned axis = 0; axis < 3; axis++) {
        double width[BL_AXES] = {1, 2, 3, 4};
        width[axis] = NAN;
        const bl_footprint footprint = bl_footprint_of_widths(width);
        for (unsigned dimensions = 1; dimensions <= 3; dimensions++)
            assert_int_equal(isnan(bl_footprint_widest(&footprint, dimensions)), dimensions > axis);
        assert_false(bl_footprint_is_whole(&footprint, 3));
    }
    const bl_footprint footprint = bl_footprint_of_widths((const double[BL_AXES]){1, 3, 2, 4});
    assert_near(bl_footprint_widest(&footprint, 1), 1, 0);
    assert_near(bl_footprint_widest(&footprint, 3), 3, 0);
}

static void test_parts_of_a_batch_are_its_samples(void **state) {
    (void)state;
    double at[BL_AXES][10];
    bl_footprint footprint[10];
    for (int i = 0; i < 10; i++) {
        for (int a = 0; a < BL_AXES; a++)
            at[a][i] = 10 * i + a;
        footprint[i] = bl_footprint_of_width(i);
    }
    for (size_t step = 0; step < 2; step++) {
        const bl_samples samples = {{at[0], at[1], at[2], at[3]}, footprint, step, 10};
        const bl_samples part = bl_samples_part(&samples, 7, 2),
                         rest = bl_samples_part(&samples, 7, 9);
        assert_int_equal(part.count, 2);
        assert_int_equal(rest.count, 3);
        double place[BL_AXES];
        bl_samples_place(&part, 1, place);
        for (int a = 0; a < BL_AXES; a++)
            assert_near(place[a], 80 + a, 0);
        assert_near(bl_samples_footprint(&part, 1)->width[0], step ? 8 : 0, 0);
    }
}

// --- batches ------------------------------------------------------------------------------------

typedef struct batch {
    double at[BL_AXES][COUNT];
    bl_footprint footprint[COUNT];
} batch;

static bl_samples samples_of(const batch *b) {
    return (bl_samples){{b->at[0], b->at[1], b->at[2], b->at[3]}, b->footprint, 1, COUNT};
}

static bl_footprint draw_footprint(bl_random *random) {
    bl_footprint footprint = {{0}, {0}, {0}};
    double width[BL_AXES], kind = bl_random_unit(random);
    for (int a = 0; a < BL_AXES; a++)
        width[a] = kind < 0.1 ? INFINITY : kind < 0.2 ? 0 : exp2(2 - 10 * bl_random_unit(random));
    if (kind < 0.25)
        width[(int)(60 * kind) % 3] = NAN;
    if (kind < 0.6)
        return bl_footprint_of_widths(width);
    for (int a = 0; a < BL_AXES; a++) { // turned
        footprint.across[a] = width[a] * (bl_random_unit(random) - 0.5);
        footprint.down[a] = width[a] * (bl_random_unit(random) - 0.5);
        footprint.width[a] = fabs(footprint.across[a]) + fabs(footprint.down[a]);
    }
    return footprint;
}

// Runs of equal footprints, some places that have no value, and footprints of every kind.
static void draw_batch(bl_random *random, batch *b) {
    static const double wrong[] = {NAN, INFINITY, 0x1p63};
    for (size_t i = 0; i < COUNT; i++) {
        for (int a = 0; a < BL_AXES; a++)
            b->at[a][i] = 8 * (bl_random_unit(random) - 0.5);
        if (i % 17 == 5)
            b->at[i / 17 % 3][i] = wrong[i / 17 % 3];
        b->footprint[i] = i % 8 > 3 ? b->footprint[i - 1] : draw_footprint(random);
    }
}

static void put_sample(const batch *from, size_t i, batch *to, size_t j) {
    for (int a = 0; a < BL_AXES; a++)
        to->at[a][j] = from->at[a][i];
    to->footprint[j] = from->footprint[i];
}

// NaN is NaN, whatever its bits.
static int is_same(double a, double b) {
    return isnan(a) ? isnan(b) : memcmp(&a, &b, sizeof a) == 0;
}

static void expect_same(const bl_signal *signal, const char *what, const double *alone,
                        const double *together, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!is_same(alone[i], together[i]))
            fail_msg("%s: %s %zu is %.17g alone, %.17g in a batch", signal->text, what, i, alone[i],
                     together[i]);
}

static void check_batch(const bl_signal *signal) {
    static batch b, turned;
    static double one[COUNT], rgb_one[3 * COUNT], value_one[COUNT], out[COUNT], rgb[3 * COUNT];
    bl_random random = bl_random_seed(bl_test_stream(signal->text), 0);
    draw_batch(&random, &b);
    const bl_samples all = samples_of(&b), reversed = samples_of(&turned);
    for (size_t i = 0; i < COUNT; i++) {
        const bl_samples alone = bl_samples_part(&all, i, 1);
        bl_signal_filtered_values(signal, &alone, &one[i]);
        bl_signal_colours(signal, &alone, &rgb_one[3 * i]);
        double at[BL_AXES];
        bl_samples_place(&all, i, at);
        value_one[i] = bl_signal_value(signal, at);
        put_sample(&b, i, &turned, COUNT - 1 - i);
    }
    // Cut anywhere, in order.
    for (size_t done = 0, size = 1; done < COUNT; done += size, size = 1 + (5 * size + 3) % 101) {
        const bl_samples part = bl_samples_part(&all, done, size);
        bl_signal_filtered_values(signal, &part, out + done);
        bl_signal_colours(signal, &part, rgb + 3 * done);
    }
    expect_same(signal, "sample", one, out, COUNT);
    expect_same(signal, "colour", rgb_one, rgb, 3 * COUNT);
    bl_signal_values(signal, all.at, COUNT, out);
    expect_same(signal, "value", value_one, out, COUNT);
    // All at once, the other way round.
    bl_signal_filtered_values(signal, &reversed, out);
    bl_signal_colours(signal, &reversed, rgb);
    for (size_t i = 0; i < COUNT; i++) {
        expect_same(signal, "reversed sample", &one[COUNT - 1 - i], &out[i], 1);
        expect_same(signal, "reversed colour", &rgb_one[3 * (COUNT - 1 - i)], &rgb[3 * i], 3);
    }
}

// One footprint for all is the same as each its own.
static void check_one_for_all(const bl_signal *signal) {
    static batch b;
    static double shared[COUNT], own[COUNT];
    bl_random random = bl_random_seed(bl_test_stream(signal->text), 1);
    draw_batch(&random, &b);
    bl_samples samples = samples_of(&b);
    samples.step = 0;
    for (int k = 0; k < 4; k++) {
        b.footprint[0] = k ? draw_footprint(&random) : bl_footprint_point;
        for (size_t i = 1; i < COUNT; i++)
            b.footprint[i] = b.footprint[0];
        const bl_samples each = samples_of(&b);
        bl_signal_filtered_values(signal, &samples, shared);
        bl_signal_filtered_values(signal, &each, own);
        expect_same(signal, "sample of a shared footprint", own, shared, COUNT);
    }
}

static void check_nan(const bl_signal *signal) {
    static const double none[BL_AXES] = {0};
    const double here[BL_AXES] = {0.3, 0.4, 0.45, 0.2};
    for (unsigned a = 0; a < signal->dimensions; a++) {
        double at[BL_AXES], width[BL_AXES] = {0.1, 0.2, 0.3, 0.4}, rgb[3];
        memcpy(at, here, sizeof at);
        at[a] = NAN;
        width[a] = NAN;
        if (!isnan(bl_signal_filtered(signal, at, none)))
            fail_msg("%s: no place along axis %u, and a value", signal->text, a);
        if (!signal->functions->filtered)
            continue;
        bl_signal_colour(signal, here, width, rgb);
        if (!isnan(bl_signal_filtered(signal, here, width)) || !isnan(rgb[0]))
            fail_msg("%s: a width that is not known along axis %u, and a value", signal->text, a);
    }
}

// The value of a text with a width is that filtered for the upright footprint of this width.
static void check_width(const bl_signal *signal, double width) {
    const bl_footprint footprint = bl_footprint_of_width(width);
    const double *w = footprint.width;
    for (int i = 0; i < 20 && signal->functions->filtered; i++) {
        const double at[BL_AXES] = {0.13 * i - 1.01, 0.07 * i, 0.3 - 0.11 * i, 0.05 * i};
        expect_same(signal, "place", (const double[]){bl_signal_value(signal, at)},
                    (const double[]){bl_signal_filtered(signal, at, w)}, 1);
    }
}

// --- the registries -----------------------------------------------------------------------------

static void check_text(const char *text, double width) {
    bl_signal *signal = bl_test_open_source(text);
    check_batch(signal);
    check_one_for_all(signal);
    check_nan(signal);
    check_width(signal, width);
    bl_signal_free(signal);
}

// With every word of the key, at points and at a width.
static void check_words(const char *name, const char *key) {
    bl_signal *plain = bl_test_open_source(name);
    const char *const *words = bl_signal_choices(plain, key);
    assert_non_null(words);
    for (; *words; words++)
        for (int wide = 0; wide < 2; wide++) {
            char text[160];
            snprintf(text, sizeof text, "%s%c%s=%s,width=%s", name, strchr(name, ':') ? ',' : ':',
                     key, *words, wide ? "0.25" : "0");
            check_text(text, wide ? 0.25 : 0);
        }
    bl_signal_free(plain);
}

static void test_textures_alone_and_in_batches(void **state) {
    (void)state;
    for (size_t i = 0; i < bl_texture_count(); i++)
        check_words(bl_texture_at(i)->name, "filter");
    check_text("marble:basis=vnoise,filter=map", 0);
    check_text("wallpaper:cells=one,filter=boxstep,noise=wavelet", 0);
}

static void test_primitives_alone_and_in_batches(void **state) {
    (void)state;
    for (size_t i = 0; i < bl_primitive_count(); i++) {
        check_text(bl_primitive_at(i)->name, 0);
        char text[160];
        snprintf(text, sizeof text, "%s:width=0.25,anchor=start", bl_primitive_at(i)->name);
        check_text(text, 0.25);
    }
    check_text("spline:knots=0/0/0;1/0.5/0;1/1/1;1/1/1,width=0.1", 0.1);
}

static void test_noises_and_sums_of_octaves_alone_and_in_batches(void **state) {
    (void)state;
    const bl_texts *list = bl_test_texts();
    for (size_t i = 0; i < list->count; i++) {
        if (!bl_test_takes(i, list->text[i]))
            continue;
        bl_signal *signal = bl_test_open(list->text[i], BL_ISA_BEST);
        check_batch(signal);
        check_one_for_all(signal);
        check_nan(signal);
        bl_signal_free(signal);
    }
    static const char *const sums[] = {"fbm", "fractalsum", "turbulence", "ridged"};
    for (size_t i = 0; i < sizeof sums / sizeof *sums; i++)
        check_words(sums[i], "clamp");
    check_words("fbm:rotate=random,shift=random,basis=fbm,basis.basis=vnoise,octaves=3", "clamp");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_an_upright_footprint_has_its_widths),
        cmocka_unit_test(test_one_width_is_that_along_every_axis),
        cmocka_unit_test(test_a_point_is_0_and_a_whole_footprint_infinite),
        cmocka_unit_test(test_the_widest_axis_is_not_known_where_one_is_not),
        cmocka_unit_test(test_parts_of_a_batch_are_its_samples),
        cmocka_unit_test(test_textures_alone_and_in_batches),
        cmocka_unit_test(test_primitives_alone_and_in_batches),
        cmocka_unit_test(test_noises_and_sums_of_octaves_alone_and_in_batches),
    };
    return bl_run_tests(tests);
}
