// SPDX-License-Identifier: MIT
//
// Tiles as signals: bare samples and images, what stands beyond their edges and between their
// samples, against direct formulas; spectra of wrapped tiles; and every way a raw file can be bad.
#include "tests/temporary.h"
#include "tests/test.h"

#include <sys/stat.h>

#include "core/image.h"
#include "spectra/histogram.h"
#include "spectra/psd.h"
#include "tests/sources.h"

static double at(const bl_signal *signal, double x, double y, double z) {
    const double place[BL_AXES] = {x, y, z, 0};
    return bl_signal_value(signal, place);
}

// A volume of 5 x 4 x 3 whose sample (i, j, k) is a number without a pattern.
enum { WIDTH = 5, HEIGHT = 4, DEPTH = 3 };

static float sample(long i, long j, long k) {
    uint32_t n = (uint32_t)(i + 7 * j + 31 * k);
    n = (n ^ (n >> 3)) * 2654435769u;
    return (float)(n >> 16) / 65536 - 0.5f;
}

static void make_volume(void) {
    float values[DEPTH][HEIGHT][WIDTH];
    for (int k = 0; k < DEPTH; k++)
        for (int j = 0; j < HEIGHT; j++)
            for (int i = 0; i < WIDTH; i++)
                values[k][j][i] = sample(i, j, k);
    bl_temporary_write(bl_temporary_path("vol.raw"), values, sizeof values);
}

static long modulo(long i, long n) {
    return (i % n + n) % n;
}

static long mirrored(long i, long n) {
    long m = modulo(i, 2 * n);
    return m < n ? m : 2 * n - 1 - m;
}

// The sample of a whole place of the endless volume.
static double endless(int mirror, long i, long j, long k) {
    return mirror ? (double)sample(mirrored(i, WIDTH), mirrored(j, HEIGHT), mirrored(k, DEPTH))
                  : (double)sample(modulo(i, WIDTH), modulo(j, HEIGHT), modulo(k, DEPTH));
}

// --- values ---

static void test_a_raw_volume_is_read_as_it_stands(void **state) {
    (void)state;
    make_volume();
    bl_signal *signal = bl_test_open_file("vol.raw", ":size=5x4x3,spacing=1/4");
    assert_int_equal(signal->dimensions, 3);
    assert_string_equal(signal->name, "raw");
    assert_int_equal(signal->extent.size[0], 5);
    assert_int_equal(signal->extent.size[2], 3);
    assert_int_equal(signal->extent.size[3], 0);
    assert_near(signal->extent.spacing[2], 0.25, 0);
    assert_true(isnan(signal->facts.period[0]));
    for (int k = 0; k < DEPTH; k++)
        for (int j = 0; j < HEIGHT; j++) {
            const double start[BL_AXES] = {0, 0.25 * j, 0.25 * k, 9}, step[BL_AXES] = {0.25};
            float row[WIDTH + 1];
            bl_signal_row(signal, start, step, WIDTH + 1, row);
            for (int i = 0; i < WIDTH; i++) {
                assert_near((double)row[i], (double)sample(i, j, k), 0);
                assert_near(at(signal, 0.25 * i + 0.12, 0.25 * j, 0.25 * k - 0.12),
                            (double)sample(i, j, k), 0);
            }
            assert_true(isnan(row[WIDTH]));
            bl_signal_row(signal, start, step, WIDTH, row); // the whole line is copied
            assert_near((double)row[WIDTH - 1], (double)sample(WIDTH - 1, j, k), 0);
        }
    assert_true(isnan(at(signal, -0.2, 0, 0)) && isnan(at(signal, 0, 0, 0.7)));
    assert_true(isnan(at(signal, NAN, 0, 0)) && isnan(at(signal, 0, INFINITY, 0)));
    bl_signal_free(signal);
}

// Four axes, x fastest; and a row that leaves its line is not a run of samples.
static void test_all_four_axes_have_their_place(void **state) {
    (void)state;
    enum { X = 3, Y = 2, Z = 4, W = 5 };
    float values[X * Y * Z * W];
    for (int n = 0; n < X * Y * Z * W; n++)
        values[n] = (float)n;
    bl_temporary_write(bl_temporary_path("four.raw"), values, sizeof values);
    bl_signal *signal = bl_test_open_file("four.raw", ":size=3x2x4x5");
    assert_int_equal(signal->dimensions, 4);
    for (int w = 0; w < W; w++)
        for (int z = 0; z < Z; z++)
            for (int y = 0; y < Y; y++)
                for (int x = 0; x < X; x++) {
                    const double place[BL_AXES] = {x, y, z, w};
                    assert_near(bl_signal_value(signal, place), x + X * (y + Y * (z + Z * w)), 0);
                }
    for (int axis = 1; axis < BL_AXES; axis++) {
        double step[BL_AXES] = {1};
        float row[2];
        step[axis] = 1;
        const double far = axis == 1 ? X : axis == 2 ? X * Y : X * Y * Z;
        bl_signal_row(signal, (const double[BL_AXES]){0}, step, 2, row);
        assert_near((double)row[1], 1 + far, 0);
    }
    bl_signal_free(signal);
}

static void test_a_wrapped_tile_fills_all_space(void **state) {
    (void)state;
    make_volume();
    bl_signal *tiles[2] = {bl_test_open_file("vol.raw", ":size=5x4x3,wrap=periodic"),
                           bl_test_open_file("vol.raw", ":size=5x4x3,wrap=mirror")};
    for (int mirror = 0; mirror < 2; mirror++) {
        const bl_signal *tile = tiles[mirror];
        assert_near(tile->facts.period[0], 5 * (1 + mirror), 0);
        assert_near(tile->facts.period[2], 3 * (1 + mirror), 0);
        assert_near(tile->facts.period[3], 0, 0); // along which it is constant
        assert_near(tile->facts.cell, 1, 0);
        assert_int_equal(tile->extent.size[0], 5); // measured on its own samples
        for (long i = -13; i < 13; i++)
            for (long j = -9; j < 9; j++)
                for (long k = -7; k < 7; k++)
                    assert_near(at(tile, (double)i + 0.4, (double)j - 0.4, (double)k),
                                endless(mirror, i, j, k), 0);
        const double start[BL_AXES] = {-8, 2, -1}, step[BL_AXES] = {1};
        float row[30];
        bl_signal_row(tile, start, step, 30, row);
        for (int i = 0; i < 30; i++)
            assert_near((double)row[i], endless(mirror, i - 8, 2, -1), 0);
        assert_near(at(tile, 0x1p40 + 3, 0, 0), endless(mirror, (1l << 40) + 3, 0, 0), 0);
        assert_true(isfinite(at(tile, 0x1p62, -0x1p62, 1e15)));
        assert_true(isnan(at(tile, 0x1p63, 0, 0)) && isnan(at(tile, 0, NAN, 0)));
    }
    bl_signal_free(tiles[0]);
    bl_signal_free(tiles[1]);
}

// Against the multilinear formula written out for each of the eight corners.
static void test_linear_reading_is_the_multilinear_formula(void **state) {
    (void)state;
    make_volume();
    for (int mirror = 0; mirror < 2; mirror++) {
        bl_signal *tile =
            bl_test_open_file("vol.raw", mirror ? ":size=5x4x3,wrap=mirror,interp=linear"
                                                : ":size=5x4x3,wrap=periodic,interp=linear");
        assert_int_equal(tile->extent.size[0], 0); // a function like any other
        assert_int_equal(tile->facts.continuity, 0);
        for (int n = 0; n < 300; n++) {
            double p[3] = {-11 + 0.137 * n, 9 - 0.11 * n, -4 + 0.0625 * n}, expected = 0;
            for (int corner = 0; corner < 8; corner++) {
                double weight = 1;
                long index[3];
                for (int a = 0; a < 3; a++) {
                    double t = p[a] - floor(p[a]);
                    int upper = corner >> a & 1;
                    index[a] = (long)floor(p[a]) + upper;
                    weight *= upper ? t : 1 - t;
                }
                expected += weight * endless(mirror, index[0], index[1], index[2]);
            }
            assert_near(at(tile, p[0], p[1], p[2]), expected, 1e-14);
        }
        bl_signal_free(tile);
    }
}

// Catmull-Rom is exact for quadratics, and goes through the samples with slopes of central
// differences, on both sides.
static void test_cubic_reading_is_exact_for_quadratics_and_smooth(void **state) {
    (void)state;
    float parabola[12];
    for (int i = 0; i < 12; i++)
        parabola[i] = (float)(0.25 * i * i - i + 2);
    bl_temporary_write(bl_temporary_path("line.raw"), parabola, sizeof parabola);
    bl_signal *line = bl_test_open_file("line.raw", ":size=12,interp=catmull-rom");
    assert_int_equal(line->dimensions, 1);
    for (double x = 1; x <= 10; x += 0.0625)
        assert_near(at(line, x, 0, 0), 0.25 * x * x - x + 2, 1e-13);
    assert_near(at(line, 0, 0, 0), 2, 0);    // a sample needs no neighbours
    assert_true(isnan(at(line, 0.5, 0, 0))); // a place between two needs four
    bl_signal_free(line);
    make_volume();
    bl_signal *tile = bl_test_open_file("vol.raw", ":size=5x4x3,wrap=periodic,interp=catmull-rom");
    const double h = 0x1p-20;
    assert_int_equal(tile->facts.continuity, 1);
    for (long i = -6; i < 6; i++) {
        double x = (double)i, slope = 0.5 * (endless(0, i + 1, 1, 2) - endless(0, i - 1, 1, 2));
        assert_near(at(tile, x, 1, 2), endless(0, i, 1, 2), 1e-15);
        // The rest is h/2 times the second derivative, which is at most 5 + 4 + 1 samples of 1/2.
        assert_near((at(tile, x + h, 1, 2) - at(tile, x, 1, 2)) / h, slope, 5 * h + 1e-9);
        assert_near((at(tile, x, 1, 2) - at(tile, x - h, 1, 2)) / h, slope, 5 * h + 1e-9);
    }
    bl_signal_free(tile);
}

static void test_linear_reading_without_wrap_ends_at_the_last_sample(void **state) {
    (void)state;
    make_volume();
    bl_signal *tile = bl_test_open_file("vol.raw", ":size=5x4x3,interp=linear");
    assert_int_equal(tile->extent.size[0], 5);
    assert_near(at(tile, 4, 3, 2), (double)sample(4, 3, 2), 0);
    assert_true(isnan(at(tile, 4.01, 3, 2)) && isnan(at(tile, -0.01, 0, 0)));
    bl_signal_free(tile);
}

static void test_integers_and_headers_are_understood(void **state) {
    (void)state;
    static const unsigned char bytes[] = {'h', 'e', 'a', 0, 51, 255, 0, 0x80, 0xFF, 0xFF};
    bl_temporary_write(bl_temporary_path("a.raw"), bytes, sizeof bytes);
    bl_signal *eight = bl_test_open_file("a.raw", ":size=7,dtype=uint8,offset=3");
    bl_signal *sixteen = bl_test_open_file("a.raw", ":size=2x1,dtype=uint16,offset=6");
    assert_near(at(eight, 0, 0, 0), 0, 0);
    assert_near(at(eight, 1, 0, 0), 0.2, 1e-7);
    assert_near(at(eight, 2, 0, 0), 1, 0);
    assert_int_equal(sixteen->dimensions, 2);
    assert_near(at(sixteen, 0, 0, 0), 32768.0 / 65535, 1e-7);
    assert_near(at(sixteen, 1, 0, 0), 1, 0);
    bl_signal_free(eight);
    bl_signal_free(sixteen);
}

// --- images ---

static void make_image(int width, int height) {
    float *values = malloc(sizeof *values * (size_t)(width * height));
    for (int j = 0; j < height; j++)
        for (int i = 0; i < width; i++)
            values[j * width + i] = sample(i, j, 0);
    bl_message message = {""};
    const bl_image image = {.width = (size_t)width, .height = (size_t)height, .values = values};
    assert_int_equal(bl_image_write(bl_temporary_path("tile.exr"), &image, &message), BL_OK);
    free(values);
}

static void test_an_image_wraps_as_bare_samples_do(void **state) {
    (void)state;
    static const char *const settings[] = {",wrap=periodic", ",wrap=mirror,interp=linear",
                                           ",wrap=periodic,interp=catmull-rom", ",interp=linear"};
    char text[128];
    float values[HEIGHT * WIDTH];
    make_image(WIDTH, HEIGHT);
    for (int n = 0; n < HEIGHT * WIDTH; n++)
        values[n] = sample(n % WIDTH, n / WIDTH, 0);
    bl_temporary_write(bl_temporary_path("tile.raw"), values, sizeof values);
    for (size_t s = 0; s < sizeof settings / sizeof *settings; s++) {
        snprintf(text, sizeof text, ":spacing=0.5%s", settings[s]);
        bl_signal *image = bl_test_open_file("tile.exr", text);
        strcat(text, ",memory=0");
        bl_signal *blocks = bl_test_open_file("tile.exr", text);
        snprintf(text, sizeof text, ":size=5x4,spacing=0.5%s", settings[s]);
        bl_signal *raw = bl_test_open_file("tile.raw", text);
        assert_memory_equal(&image->extent, &raw->extent, sizeof raw->extent);
        assert_int_equal(image->facts.continuity, raw->facts.continuity);
        for (int n = 0; n < 500; n++) {
            double x = -6 + 0.0373 * n, y = 4 - 0.021 * n, expected = at(raw, x, y, 0);
            if (isnan(expected)) {
                assert_true(isnan(at(image, x, y, 0)) && isnan(at(blocks, x, y, 0)));
                continue;
            }
            assert_near(at(image, x, y, 0), expected, 0);
            assert_near(at(blocks, x, y, 0), expected, 0);
        }
        bl_signal_free(image);
        bl_signal_free(blocks);
        bl_signal_free(raw);
    }
    bl_test_refuse_file("tile.exr", ":wrap=around", BL_USAGE, "none, periodic, mirror");
    bl_test_refuse_file("tile.exr", ":interp=quintic", BL_USAGE, "nearest, linear, catmull-rom");
}

// --- measurements ---

static bl_psd measure(const bl_signal *signal, unsigned dims, double rate) {
    bl_psd_settings settings = bl_psd_default_settings(dims);
    bl_message message = {""};
    bl_psd psd;
    settings.rate = rate;
    if (bl_psd_measure(signal, &settings, &psd, &message) != BL_OK)
        fail_msg("%s", message.text);
    return psd;
}

// A tile is measured on its own samples whatever stands beyond its edge, so wrapping changes
// nothing: the same bits.
static void test_wrapping_does_not_change_the_spectrum_of_the_samples(void **state) {
    (void)state;
    make_image(96, 80);
    for (unsigned dims = 1; dims <= 2; dims++) {
        bl_signal *bare = bl_test_open_file("tile.exr", ""),
                  *wrapped = bl_test_open_file("tile.exr", ":wrap=mirror");
        bl_psd one = measure(bare, dims, 0), two = measure(wrapped, dims, 0);
        assert_int_equal(one.count, two.count);
        assert_memory_equal(one.psd, two.psd, one.count * sizeof *one.psd);
        bl_psd_free(&one);
        bl_psd_free(&two);
        bl_signal_free(bare);
        bl_signal_free(wrapped);
    }
}

// Five waves in a tile of 64 samples of 1/8 units: 5/8 cycles per unit. Read linearly at random
// places it is that wave times sinc^2(5/64) and images at k 8 +- 5/8 with amplitudes in proportion
// to 1/(64 k +- 5)^2, of which those below Nyquist (16) are seen. All are lines of known power.
static void test_linear_reading_shows_the_images_of_the_spectrum(void **state) {
    (void)state;
    const double pi = acos(-1);
    float wave[64];
    for (int i = 0; i < 64; i++)
        wave[i] = (float)cos(2 * pi * 5 * i / 64);
    bl_temporary_write(bl_temporary_path("wave.raw"), wave, sizeof wave);
    bl_signal *signal =
        bl_test_open_file("wave.raw", ":size=64,spacing=1/8,wrap=periodic,interp=linear");
    bl_psd psd = measure(signal, 1, 32);
    double first = 0, total = 0;
    for (int k = -200; k <= 200; k++) {
        double u = pi * (5 + 64 * k) / 64, power = 0.5 * pow(sin(u) / u, 4);
        total += power;
        if (k == 0)
            first = power;
    }
    bl_band line = {.from = 5.0 / 8 - 0.2, .to = 5.0 / 8 + 0.2};
    bl_band image = {.from = 8 - 5.0 / 8 - 0.2, .to = 8 - 5.0 / 8 + 0.2};
    bl_psd_band(&psd, &line);
    bl_psd_band(&psd, &image);
    double u = pi * (5 - 64) / 64, second = 0.5 * pow(sin(u) / u, 4);
    assert_near(line.fraction.value, first / total, 1e-5);
    assert_near(image.fraction.value, second / total, 1e-2 * second / total);
    assert_near(psd.windowed_variance, total, 2e-3 * total);
    bl_psd_free(&psd);
    bl_signal_free(signal);
}

static void test_a_volume_is_measured_in_three_dimensions(void **state) {
    (void)state;
    enum { SIDE = 24 };
    static float values[SIDE * SIDE * SIDE];
    bl_message message = {""};
    double mean = 0;
    for (int n = 0; n < SIDE * SIDE * SIDE; n++) {
        values[n] = sample(n * 13 + n / 7, n / 3, n);
        mean += (double)values[n] / (SIDE * SIDE * SIDE);
    }
    bl_temporary_write(bl_temporary_path("cube.raw"), values, sizeof values);
    bl_signal *signal = bl_test_open_file("cube.raw", ":size=24x24x24,wrap=periodic");
    bl_psd psd = measure(signal, 3, 0);
    assert_near(psd.settings.rate, 1, 0);
    bl_histogram_settings settings = bl_histogram_default_settings();
    bl_histogram histogram;
    assert_int_equal(bl_histogram_measure(signal, &settings, &histogram, &message), BL_OK);
    assert_int_equal(histogram.count, SIDE * SIDE * SIDE);
    assert_near(histogram.mean.value, mean, 1e-9);
    bl_histogram_free(&histogram);
    bl_psd_free(&psd);
    bl_signal_free(signal);
}

// --- refusals ---

static void test_every_bad_raw_file_is_refused_with_its_reason(void **state) {
    (void)state;
    make_volume();
    bl_test_refuse_file("vol.raw", "", BL_USAGE, "give size=");
    bl_test_refuse_file("vol.raw", ":spacing=2", BL_USAGE, "give size=");
    bl_test_refuse_file("vol.raw", ":size=5x4x4", BL_MISMATCH, "240 bytes");
    bl_test_refuse_file("vol.raw", ":size=5x4x4", BL_MISMATCH, "takes 320");
    bl_test_refuse_file("vol.raw", ":size=5x4x3,offset=4", BL_MISMATCH, "takes 244");
    bl_test_refuse_file("vol.raw", ":size=5x4x3,dtype=uint8", BL_MISMATCH, "takes 60");
    bl_test_refuse_file("vol.raw", ":size=5x4x3,offset=1/2", BL_USAGE, "whole number");
    static const char *const sizes[] = {"0x4", "5x",        "x5",          "5xx4",
                                        "5,4", "1x2x3x4x5", "99999999999", "-3x4"};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        char settings[64];
        snprintf(settings, sizeof settings, ":size=%s", sizes[i]);
        bl_test_refuse_file("vol.raw", settings, BL_USAGE, "as 128x128x128");
    }
    bl_test_refuse_file("vol.raw", ":size=2147483648x2147483648x2147483648", BL_MISMATCH,
                        "240 bytes");
    bl_test_refuse_file("vol.raw", ":size=5x4x3,memory=0", BL_MISMATCH, "give memory=1");
    bl_test_refuse_file("vol.raw", ":size=5x4x3,spacing=0", BL_USAGE, "spacing=0");
    bl_temporary_write(bl_temporary_path("noise.py"), "print()\n", 8);
    bl_test_refuse_file("noise.py", "", BL_USAGE, "cmd:python3 ");
    bl_temporary_write(bl_temporary_path("mine.c"), "int x;\n", 7);
    bl_test_refuse_file("mine.c", ":mine", BL_USAGE, "-fPIC -shared");
    bl_test_refuse_file("vol.raw", ":size=5x4x3,spacing=-1", BL_USAGE, "above 0");
    bl_test_refuse_file("vol.raw", ":size=5x4x3,warp=mirror", BL_USAGE, "did you mean 'wrap'");
    bl_test_refuse_file("vol.raw", ":size=5x4x3,dtype=float16", BL_USAGE, "float32, uint8, uint16");
    bl_test_refuse_file("missing.raw", ":size=3", BL_DEVICE, "No such file");
    mkdir(bl_temporary_path("folder.raw"), 0777);
    mkfifo(bl_temporary_path("pipe.raw"), 0777);
    bl_test_refuse_file("folder.raw", ":size=3", BL_DEVICE, "folder");
    bl_test_refuse_file("pipe.raw", ":size=3", BL_DEVICE, "pipe");
    bl_temporary_write(bl_temporary_path("empty.raw"), "", 0);
    bl_test_refuse_file("empty.raw", ":size=1", BL_MISMATCH, "0 bytes");
}

// Memory counts floats, whatever the file has.
static void test_the_memory_is_that_of_floats(void **state) {
    (void)state;
    static const unsigned char bytes[300000];
    bl_temporary_write(bl_temporary_path("large.raw"), bytes, sizeof bytes);
    bl_test_refuse_file("large.raw", ":size=300x1000,dtype=uint8,memory=1", BL_MISMATCH,
                        "give memory=2");
    bl_signal_free(bl_test_open_file("large.raw", ":size=300x1000,dtype=uint8,memory=2"));
}

// Bytes that are no sensible floats are values all the same, and stop a measurement.
static void test_values_that_are_no_numbers_are_found(void **state) {
    (void)state;
    unsigned char bytes[16 * 16 * 4];
    bl_message message = {""};
    bl_psd_settings settings = bl_psd_default_settings(2);
    bl_psd psd;
    memset(bytes, 0xFF, sizeof bytes);
    bl_temporary_write(bl_temporary_path("ones.raw"), bytes, sizeof bytes);
    bl_signal *signal = bl_test_open_file("ones.raw", ":size=16x16");
    assert_true(isnan(at(signal, 3, 3, 0)));
    assert_int_equal(bl_psd_measure(signal, &settings, &psd, &message), BL_MISMATCH);
    assert_non_null(strstr(message.text, "nan"));
    bl_signal_free(signal);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_raw_volume_is_read_as_it_stands),
        cmocka_unit_test(test_all_four_axes_have_their_place),
        cmocka_unit_test(test_a_wrapped_tile_fills_all_space),
        cmocka_unit_test(test_linear_reading_is_the_multilinear_formula),
        cmocka_unit_test(test_cubic_reading_is_exact_for_quadratics_and_smooth),
        cmocka_unit_test(test_linear_reading_without_wrap_ends_at_the_last_sample),
        cmocka_unit_test(test_integers_and_headers_are_understood),
        cmocka_unit_test(test_an_image_wraps_as_bare_samples_do),
        cmocka_unit_test(test_wrapping_does_not_change_the_spectrum_of_the_samples),
        cmocka_unit_test(test_linear_reading_shows_the_images_of_the_spectrum),
        cmocka_unit_test(test_a_volume_is_measured_in_three_dimensions),
        cmocka_unit_test(test_every_bad_raw_file_is_refused_with_its_reason),
        cmocka_unit_test(test_the_memory_is_that_of_floats),
        cmocka_unit_test(test_values_that_are_no_numbers_are_found),
    };
    return bl_run_tests(tests);
}
