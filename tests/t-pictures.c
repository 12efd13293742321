// SPDX-License-Identifier: MIT
//
// What the scorecard says of pictures: whether they fit at their edges, and whether they have a
// direction. The pictures are formulas of the place, so that what is right is known.
//
// Error rates. Verdicts that must not fail are asked for at the default alpha, 1e-6 a table. The
// rates of false alarms are counted at a twentieth, and fail by chance less than once in 10^6
// (binomial, by Hoeffding).
#include "tests/test.h"

#include "tests/scores.h"
#include "tests/pictures.h"
#include "tests/sources.h"
#include "tests/temporary.h"
#include "tests/test_signals.h"

enum { SIDE = 128, MOST = 160 * 160 };
static float values[MOST], other[MOST];

static bl_score_property measure(const bl_signal *signal, const char *name, double alpha) {
    bl_score_settings settings = bl_score_default_settings();
    settings.size = BL_QUICK;
    settings.alpha = alpha;
    return bl_test_score_with(&(bl_score_subject){.signal = signal}, name, &settings);
}

// Of the picture in `from`, wrapped and interpolated.
static bl_score_property ask(const char *name, const float *from, size_t width, size_t height) {
    bl_signal *signal = bl_test_picture(from, width, height, "wrap=periodic,interp=linear");
    bl_score_property result = measure(signal, name, 1e-6);
    bl_signal_free(signal);
    return result;
}

static void expect(const char *what, const bl_score_property *result, bl_verdict verdict,
                   const char *word) {
    if (result->verdict != verdict || !strstr(result->reason, word))
        fail_msg("%s: %s, '%s'; expected %s, '%s'", what, bl_verdict_word(result->verdict),
                 result->reason, bl_verdict_word(verdict), word);
}

static void fill(const bl_test_tile *tile, size_t width, size_t height) {
    bl_test_tile_fill(tile, (const size_t[]){0, 0}, (const size_t[]){width, height}, values);
}

static void expect_seam(const char *what, const float *from, size_t width, size_t height,
                        bl_verdict verdict, const char *word) {
    bl_score_property result = ask("seam", from, width, height);
    expect(what, &result, verdict, word);
    assert_int_equal(result.against, BL_AGAINST_CLAIM);
}

// --- the seam -----------------------------------------------------------------------------------

static void test_a_tile_fits_and_a_cut_one_does_not(void **state) {
    (void)state;
    static const bl_test_tile kinds[] = {{SIDE, SIDE, 2, 1, 0, 1},
                                         {SIDE, SIDE, 1.2, 1, 0, 2},
                                         {SIDE, 96, 2, 1, 0, 3},
                                         {SIDE, SIDE, 1.5, 2, 30, 4}};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        const bl_test_tile *tile = &kinds[k];
        size_t w = tile->width, h = tile->height;
        fill(tile, w, h);
        expect_seam("tile", values, w, h, BL_VERDICT_PASS, "along x, y the edge is as the inside");
        fill(tile, w - 3, h - 3);
        expect_seam("both cut", values, w - 3, h - 3, BL_VERDICT_FAIL, "; along y");
        fill(tile, w, h - 2);
        expect_seam("one cut", values, w, h - 2, BL_VERDICT_FAIL, "along x it fits");
        fill(tile, w - 1, h);
        expect_seam("a column missing", values, w - 1, h, BL_VERDICT_FAIL, "along y it fits");
        fill(tile, w + 1, h);
        expect_seam("a column twice", values, w + 1, h, BL_VERDICT_FAIL, "along y it fits");
    }
}

static void test_a_gradient_and_eight_bits(void **state) {
    (void)state;
    const bl_test_tile tile = {SIDE, SIDE, 2, 1, 0, 5};
    fill(&tile, SIDE, SIDE);
    for (size_t i = 0; i < SIDE * SIDE; i++)
        other[i] = values[i] + 0.01f * (float)(i / SIDE);
    expect_seam("gradient", other, SIDE, SIDE, BL_VERDICT_FAIL, "along x it fits");
    for (size_t i = 0; i < SIDE * SIDE; i++)
        other[i] = roundf(128 + 40 * values[i]);
    expect_seam("codes", other, SIDE, SIDE, BL_VERDICT_PASS, "as the inside");
    fill(&tile, SIDE - 4, SIDE);
    for (size_t i = 0; i < SIDE * SIDE; i++)
        other[i] = roundf(128 + 40 * values[i]);
    expect_seam("codes, cut", other, SIDE - 4, SIDE, BL_VERDICT_FAIL, "along y it fits");
}

// Its own mirror image at the edge: values fit, slopes do not; the same crease in the middle is no
// excuse.
static void test_a_mirrored_tile_is_named(void **state) {
    (void)state;
    const bl_test_tile tile = {4096, SIDE, 2, 1, 0, 6};
    fill(&tile, SIDE / 2, SIDE);
    for (size_t twice = 0; twice < 2; twice++) { // with the last column twice, or once
        size_t width = SIDE - 2 * twice;
        for (size_t j = 0; j < SIDE; j++)
            for (size_t i = 0; i < width; i++)
                other[j * width + i] =
                    values[j * (SIDE / 2) + (i < SIDE / 2 ? i : SIDE - 1 - twice - i)];
        expect_seam("mirrored", other, width, SIDE, BL_VERDICT_FAIL,
                    "along x the edge is a mirror: values fit");
    }
}

static void test_patterns_and_white_noise_fit(void **state) {
    (void)state;
    for (size_t side = 1; side <= SIDE / 2; side *= 4) {
        for (size_t j = 0; j < SIDE; j++)
            for (size_t i = 0; i < SIDE; i++) {
                values[j * SIDE + i] = (float)((i / side + j / side) % 2);
                other[j * SIDE + i] = (float)(i / side % 2);
            }
        expect_seam("checkerboard", values, SIDE, SIDE, BL_VERDICT_PASS, "as the inside");
        expect_seam("stripes", other, SIDE, SIDE, BL_VERDICT_PASS, "as the inside");
    }
    const bl_test_tile white = {4096, 4096, 0, 1, 0, 7};
    fill(&white, 100, 90);
    expect_seam("white", values, 100, 90, BL_VERDICT_PASS, "as the inside");
    for (size_t i = 0; i < SIDE * SIDE; i++)
        values[i] = (float)(i % SIDE);
    expect_seam("ramp", values, SIDE, SIDE, BL_VERDICT_FAIL, "along y it fits");
}

static void test_a_small_picture_is_not_judged_rashly(void **state) {
    (void)state;
    for (uint64_t seed = 0; seed < 20; seed++) {
        const bl_test_tile tile = {16, 16, 1, 1, 0, seed};
        fill(&tile, 16, 16);
        bl_score_property result = ask("seam", values, 16, 16);
        assert_int_not_equal(result.verdict, BL_VERDICT_FAIL);
    }
    bl_score_property result = ask("seam", values, 8, 32);
    expect("8 wide", &result, BL_VERDICT_NOT_RUN, "8 samples along x are too few");
}

static void test_the_seam_is_judged_against_what_is_stated(void **state) {
    (void)state;
    const bl_test_tile tile = {SIDE, SIDE, 2, 1, 0, 8};
    fill(&tile, SIDE - 3, SIDE);
    bl_signal *plain = bl_test_picture(values, SIDE - 3, SIDE, "");
    bl_score_property result = measure(plain, "seam", 1e-6);
    expect("plain", &result, BL_VERDICT_FAIL, "along x");
    assert_int_equal(result.against, BL_AGAINST_IDEAL);
    bl_signal *mirror = bl_test_picture(values, SIDE - 3, SIDE, "wrap=mirror,interp=linear");
    result = measure(mirror, "seam", 1e-6);
    expect("mirror", &result, BL_VERDICT_NOT_RUN, "the mirror image");
    bl_signal *noise = bl_test_open_source("gnoise");
    result = measure(noise, "seam", 1e-6);
    expect("a function", &result, BL_VERDICT_NOT_RUN, BL_SCORE_NO_PICTURE);
    bl_signal_free(noise);
    bl_signal_free(mirror);
    bl_signal_free(plain);
}

// How often a picture that is right fails at a level of a twentieth.
static void check_rate(const char *name, const bl_test_tile *kind) {
    size_t count = bl_test_scaled(200, 20), fails = 0;
    for (size_t i = 0; i < count; i++) {
        bl_test_tile tile = *kind;
        tile.seed = 1000 + i;
        fill(&tile, tile.width, tile.height);
        bl_signal *signal = bl_test_picture(values, tile.width, tile.height, "wrap=periodic");
        bl_score_property result = measure(signal, name, 0.05 * (double)bl_property_count());
        fails += result.verdict == BL_VERDICT_FAIL;
        bl_signal_free(signal);
    }
    // Hoeffding: P(share - 0.05 > h) < exp(-2 n h^2).
    assert_less((double)fails / (double)count, 0.05 + sqrt(log(1e6) / 2 / (double)count));
}

static void test_false_alarms_are_rarer_than_stated(void **state) {
    (void)state;
    static const bl_test_tile kinds[] = {{48, 40, 1.5, 1, 0, 0}, {64, 64, 0, 1, 0, 0}};
    for (size_t k = 0; k < 2; k++) {
        check_rate("seam", &kinds[k]);
        check_rate("isotropy", &kinds[k]);
    }
}

// --- the direction ------------------------------------------------------------------------------

static void test_an_isotropic_picture_passes(void **state) {
    (void)state;
    static const bl_test_tile kinds[] = {
        {SIDE, SIDE, 1.5, 1, 0, 1}, {4096, 4096, 0, 1, 0, 2}, {4096, 4096, 1, 1, 0, 3}};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        fill(&kinds[k], SIDE, SIDE - 16 * k);
        bl_score_property result = ask("isotropy", values, SIDE, SIDE - 16 * k);
        expect("isotropic", &result, BL_VERDICT_PASS, "no direction in");
        assert_int_equal(result.against, BL_AGAINST_IDEAL);
    }
}

static void test_the_direction_of_a_stretch_is_found(void **state) {
    (void)state;
    static const bl_test_tile kinds[] = {{4096, 4096, 1.5, 3, 30, 1},
                                         {4096, 4096, 1.5, 3, 75, 2},
                                         {SIDE, SIDE, 1.5, 2, 120, 3},
                                         {4096, 4096, 1, 10, 90, 4},
                                         {4096, 4096, 1.2, 4, 0, 5}};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        fill(&kinds[k], SIDE, SIDE - 8 * k);
        bl_score_property result = ask("isotropy", values, SIDE, SIDE - 8 * k);
        expect("stretched", &result, BL_VERDICT_FAIL, "stretched along");
        bl_estimate found = bl_score_find(&result, "direction_degrees")->estimate;
        double off = remainder(found.value - kinds[k].degrees, 180);
        assert_near(off, 0, fmax(5, 2 * (found.upper - found.value)));
        assert_less(found.upper - found.lower, 25);
        assert_non_null(strstr(result.cell, " deg"));
    }
}

static void test_a_cross_is_told_from_a_stretch(void **state) {
    (void)state;
    for (size_t j = 0; j < SIDE; j++)
        for (size_t i = 0; i < SIDE; i++) {
            values[j * SIDE + i] = (float)((i / 8 + j / 8) % 2);
            other[j * SIDE + i] = (float)((i / 4 % 2) + (j / 4 % 2)); // along both axes
        }
    bl_score_property result = ask("isotropy", values, SIDE, SIDE);
    expect("checkerboard", &result, BL_VERDICT_FAIL, "a cross at 45 and 135 degrees");
    assert_string_equal(result.cell, "cross");
    result = ask("isotropy", other, SIDE, SIDE);
    expect("grid", &result, BL_VERDICT_FAIL, "a cross at 0 and 90 degrees");
}

// Blocks of a volume that last for several samples along one axis.
static void test_the_direction_of_a_volume_is_found(void **state) {
    (void)state;
    enum { EDGE = 40 };
    const bl_test_tile tile = {4096, 4096, 0, 1, 0, 9};
    float *volume = malloc(sizeof *volume * EDGE * EDGE * EDGE);
    assert_non_null(volume);
    for (size_t z = 0; z < EDGE; z++) {
        bl_test_tile_fill(&tile, (const size_t[]){0, 64 * (z / 6)}, (const size_t[]){EDGE, EDGE},
                          volume + z * EDGE * EDGE);
    }
    const char *path = bl_temporary_path("volume.raw");
    bl_temporary_write(path, volume, sizeof *volume * EDGE * EDGE * EDGE);
    free(volume);
    bl_signal *signal = bl_test_open_file("volume.raw", ":size=40x40x40");
    bl_score_property result = measure(signal, "isotropy", 1e-6);
    expect("volume", &result, BL_VERDICT_FAIL, "stretched along 90 degrees");
    assert_non_null(strstr(result.reason, "towards z)"));
    result = measure(signal, "seam", 1e-6);
    expect("volume", &result, BL_VERDICT_PASS, "along x, y, z");
    bl_signal_free(signal);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_tile_fits_and_a_cut_one_does_not),
        cmocka_unit_test(test_a_gradient_and_eight_bits),
        cmocka_unit_test(test_a_mirrored_tile_is_named),
        cmocka_unit_test(test_patterns_and_white_noise_fit),
        cmocka_unit_test(test_a_small_picture_is_not_judged_rashly),
        cmocka_unit_test(test_the_seam_is_judged_against_what_is_stated),
        cmocka_unit_test(test_false_alarms_are_rarer_than_stated),
        cmocka_unit_test(test_an_isotropic_picture_passes),
        cmocka_unit_test(test_the_direction_of_a_stretch_is_found),
        cmocka_unit_test(test_a_cross_is_told_from_a_stretch),
        cmocka_unit_test(test_the_direction_of_a_volume_is_found),
    };
    return bl_run_tests(tests);
}
