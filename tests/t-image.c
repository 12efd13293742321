// SPDX-License-Identifier: MIT
//
// Images as signals: pictures made by oiiotool, with known answers; our own writer read back; and
// every way in which a file can be bad.
#include "tests/temporary.h"
#include "tests/test.h"

#include <sys/stat.h>
#include <unistd.h>

#include "core/image.h"
#include "sources/source.h"
#include "spectra/psd.h"
#include "tests/sources.h"

// On a damaged PNG, libpng leaves OpenImageIO's PngReadCallback by longjmp over a string: 31 bytes
// are lost each time, and not by us. Only stacks with that frame are forgiven; the fast unwinder
// would stop before it, inside of the C++ library.
const char *__asan_default_options(void);
const char *__asan_default_options(void) {
    return "fast_unwind_on_malloc=0";
}

const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) {
    return "leak:PNGInput::PngReadCallback\n";
}

enum { ARGUMENTS = 24 };

// Runs oiiotool in the temporary folder on words separated by blanks.
static void oiiotool(const char *words) {
    char copy[512];
    const char *arguments[ARGUMENTS] = {"oiiotool"};
    int count = 1;
    snprintf(copy, sizeof copy, "%s", words);
    for (char *word = strtok(copy, " "); word && count < ARGUMENTS - 1; word = strtok(NULL, " "))
        arguments[count++] = word;
    if (bl_temporary_run(bl_temporary_folder(), arguments) != 0)
        fail_msg("oiiotool %s failed", words);
}

static double at(const bl_signal *signal, double x, double y) {
    const double place[BL_AXES] = {x, y, 0, 0};
    return bl_signal_value(signal, place);
}

// --- reading ------------------------------------------------------------------------------------

static bl_psd measure_plane(const bl_signal *signal) {
    bl_psd_settings settings = bl_psd_default_settings(2);
    settings.averages = 1;
    settings.axis[2] = 1;
    bl_message message = {""};
    bl_psd psd;
    if (bl_psd_measure(signal, &settings, &psd, &message) != BL_OK)
        fail_msg("%s", message.text);
    return psd;
}

// Gaussian noise of another program's making, all 256^2 = n pixels of it: the sample variance has
// the standard deviation s^2 sqrt(2/n); the share F of a ring that holds a part p of the cells,
// sqrt(2 b p (1-p) / n), as 2/dof = 2b/(n p) is the relative variance of its power (b: the window's
// broadening). Each tolerance is 3.9 standard deviations, an error rate of 1e-4; five are asked.
static void test_white_noise_has_its_variance_and_a_flat_spectrum(void **state) {
    (void)state;
    const double n = 256 * 256, pi = acos(-1);
    oiiotool(
        "--create 256x256 1 --noise:type=gaussian:mean=0.5:stddev=0.25:mono=1 -d float -o "
        "white.exr");
    bl_signal *signal = bl_test_open_file("white.exr", ":spacing=0.25");
    bl_psd psd = measure_plane(signal);
    assert_near(psd.settings.rate, 4, 0);
    assert_true(psd.settings.size == 256);
    assert_near(psd.variance.value, 0.0625, 3.9 * 0.0625 * sqrt(2 / n));
    for (int ring = 0; ring < 4; ring++) {
        bl_band band = {.from = 0.5 * ring, .to = 0.5 * ring + 0.5};
        bl_psd_band(&psd, &band);
        double p = pi * (2 * ring + 1) / 64; // of the square of side 4
        assert_near(band.fraction.value, p, 3.9 * sqrt(2 * psd.broadening * p * (1 - p) / n));
    }
    bl_psd_free(&psd);
    bl_signal_free(signal);
}

// Two bright pixels, transformed back by another program: cos(2 pi (12 i + 9 j) / 128), so 15 waves
// in 128 pixels of 0.5 units, a frequency of 15/64 cycles per unit. The window's main lobe reaches
// four cells of 1/64 to each side, and no side lobe is above -92 dB: what is outside is below 1e-6.
static void test_a_sine_shows_as_one_line(void **state) {
    (void)state;
    oiiotool(
        "--create 128x128 2 --point:color=64,0 12,9 --point:color=64,0 116,119 --ifft -d float "
        "-o sine.exr");
    bl_signal *signal = bl_test_open_file("sine.exr", ":spacing=0.5");
    for (int j = 0; j < 128; j += 31)
        for (int i = 0; i < 128; i++)
            assert_near(at(signal, 0.5 * i, 0.5 * j), cos(2 * acos(-1) * (12 * i + 9 * j) / 128),
                        1e-5);
    bl_psd psd = measure_plane(signal);
    bl_band line = {.from = 15.0 / 64 - 4.5 / 64, .to = 15.0 / 64 + 4.5 / 64};
    bl_psd_band(&psd, &line);
    assert_near(psd.variance.value, 0.5, 1e-4); // 1/16384 more, if divided by n - 1
    assert_true(line.fraction.value > 0.999);
    size_t highest = 0;
    for (size_t bin = 1; bin < psd.count; bin++)
        if (psd.psd[bin] * psd.measure[bin] > psd.psd[highest] * psd.measure[highest])
            highest = bin;
    assert_near(psd.frequency[highest], 15.0 / 64, 0.5 / 64);
    bl_psd_free(&psd);
    bl_signal_free(signal);
}

static void test_integers_are_divided_by_their_full_scale(void **state) {
    (void)state;
    oiiotool("--pattern constant:color=0.2,0.4,0.6 8x4 3 -d uint8 -o eight.png");
    oiiotool("--pattern constant:color=0.2,0.4,0.6 8x4 3 -d uint16 -o sixteen.png");
    oiiotool("--pattern constant:color=0.2,-0.4,6 8x4 3 -d half -o half.exr");
    bl_signal *eight = bl_test_open_file("eight.png", ":channel=G");
    bl_signal *sixteen = bl_test_open_file("sixteen.png", ":channel=2");
    bl_signal *half = bl_test_open_file("half.exr", ":channel=B");
    assert_near(at(eight, 0, 0), 102.0 / 255, 1e-7); // no colour curve
    assert_near(at(sixteen, 7, 3), 39321.0 / 65535, 1e-7);
    assert_near(at(half, 0, 0), 6, 0);
    assert_int_equal(eight->dimensions, 2);
    assert_int_equal(eight->extent.size[0], 8);
    assert_int_equal(eight->extent.size[1], 4);
    assert_string_equal(eight->name, "image");
    bl_signal_free(eight);
    bl_signal_free(sixteen);
    bl_signal_free(half);
}

static void test_alpha_does_not_change_the_values(void **state) {
    (void)state;
    oiiotool(
        "--pattern constant:color=0.8,0.8,0.8,0.5 8x8 4 --iscolorspace linear --unpremult "
        "-d uint8 -o alpha.png");
    bl_signal *colour = bl_test_open_file("alpha.png", ":channel=R");
    bl_signal *blocks = bl_test_open_file("alpha.png", ":channel=R,memory=0");
    assert_near(at(colour, 3, 3), at(blocks, 3, 3), 0);
    assert_true(at(colour, 3, 3) > 0.79); // not 0.8 times alpha, nor that again
    bl_signal_free(colour);
    bl_signal_free(blocks);
}

// An image whose pixel (i, j) is i + 1000 j, as scanlines and as tiles.
static void make_ramp(int width, int height) {
    float *values = malloc(sizeof(float) * (size_t)(width * height));
    for (int j = 0; j < height; j++)
        for (int i = 0; i < width; i++)
            values[j * width + i] = (float)(i + 1000 * j);
    bl_message message = {""};
    const bl_image image = {.width = (size_t)width, .height = (size_t)height, .values = values};
    assert_int_equal(bl_image_write(bl_temporary_path("ramp.tif"), &image, &message), BL_OK);
    free(values);
    oiiotool("ramp.tif --tile 32 32 -o tiled.exr");
}

static void check_ramp(const bl_signal *signal, int width, int height) {
    float row[700], across[700];
    double x[700], y[700];
    const double zeros[700] = {0};
    for (int j = 0; j < height; j += 37) {
        const double start[BL_AXES] = {5 * 0.5, j * 0.5, 0, 0}, step[BL_AXES] = {0.5, 0, 0, 0};
        bl_signal_row(signal, start, step, (size_t)width - 5, row);
        for (int i = 0; i < width - 5; i++)
            assert_near((double)row[i], i + 5 + 1000 * j, 0);
    }
    const double start[BL_AXES] = {3 * 0.5, 0, 0, 0}, step[BL_AXES] = {0, 0.5, 0, 0};
    bl_signal_row(signal, start, step, (size_t)height, row);
    for (int j = 0; j < height; j++) {
        x[j] = 3 * 0.5;
        y[j] = j * 0.5;
        assert_near((double)row[j], 3 + 1000 * j, 0);
    }
    const double *const points[BL_AXES] = {x, y, zeros, zeros};
    bl_signal_points(signal, points, (size_t)height, across);
    assert_memory_equal(row, across, sizeof *row * (size_t)height);
}

static void test_rows_columns_and_points_agree_in_memory_and_in_blocks(void **state) {
    (void)state;
    make_ramp(300, 200);
    static const char *const files[] = {"ramp.tif", "tiled.exr"};
    for (int f = 0; f < 2; f++) {
        bl_signal *held = bl_test_open_file(files[f], ":spacing=1/2");
        bl_signal *blocks = bl_test_open_file(files[f], ":spacing=1/2,memory=0");
        check_ramp(held, 300, 200);
        check_ramp(blocks, 300, 200);
        bl_signal_free(held);
        bl_signal_free(blocks);
    }
}

static void test_a_place_takes_the_nearest_pixel_and_nan_outside(void **state) {
    (void)state;
    make_ramp(300, 200);
    bl_signal *signal = bl_test_open_file("ramp.tif", ":spacing=2");
    assert_near(at(signal, 2.9, 0), 1, 0);
    assert_near(at(signal, 3.1, 2.2), 1002, 0);
    assert_near(at(signal, 598.9, 398.9), 299 + 199000, 0);
    assert_true(isnan(at(signal, -1.1, 0)));
    assert_true(isnan(at(signal, 600, 0)));
    assert_true(isnan(at(signal, 0, 400)));
    assert_true(isnan(at(signal, NAN, 0)));
    assert_true(isnan(at(signal, INFINITY, 1e300)));
    float row[4];
    const double start[BL_AXES] = {596, 0, 0, 0}, step[BL_AXES] = {2, 0, 0, 0};
    bl_signal_row(signal, start, step, 4, row);
    assert_near((double)row[1], 299, 0);
    assert_true(isnan(row[2]));
    bl_signal_free(signal);
}

static void test_a_noise_is_not_taken_for_a_file(void **state) {
    (void)state;
    bl_signal *signal = NULL;
    bl_message message = {""};
    assert_int_equal(bl_source_open("gnoise:seed=7", BL_ISA_BEST, &signal, &message), BL_OK);
    assert_string_equal(signal->name, "gnoise");
    bl_signal_free(signal);
    signal = NULL;
    assert_int_equal(bl_source_open("gnoize", BL_ISA_BEST, &signal, &message), BL_USAGE);
    assert_non_null(strstr(message.text, "did you mean 'gnoise'"));
    assert_null(signal);
    assert_non_null(bl_source_of("grain.exr:spacing=1"));
    assert_non_null(bl_source_of("./grain"));
    assert_null(bl_source_of("gnoise:seed=7"));
    assert_null(bl_source_of(""));
}

// --- refusals -----------------------------------------------------------------------------------

static void test_every_bad_file_is_refused_with_its_reason(void **state) {
    (void)state;
    static const char noise[] = "this is not an image at all, whatever its name may say";
    oiiotool("--create 64x64 3 --noise -d half -o whole.exr");
    oiiotool("--create 64x64 3 --noise -d uint8 -o whole.png");
    oiiotool("--create 64x64 3 --noise -d float -o whole.tif");
    oiiotool("whole.exr --dup --siappend -o parts.exr");
    bl_temporary_write(bl_temporary_path("empty.exr"), "", 0);
    bl_temporary_write(bl_temporary_path("text.exr"), noise, sizeof noise);
    bl_temporary_write(bl_temporary_path("text.txt"), noise, sizeof noise);
    mkdir(bl_temporary_path("folder.exr"), 0777);
    mkfifo(bl_temporary_path("pipe.exr"), 0777);
    static const char *const names[] = {"exr", "png", "tif"};
    for (int i = 0; i < 3; i++) {
        char from[32], to[32];
        size_t size;
        snprintf(from, sizeof from, "whole.%s", names[i]);
        snprintf(to, sizeof to, "cut.%s", names[i]);
        char *bytes = bl_temporary_read(bl_temporary_path(from), &size);
        bl_temporary_write(bl_temporary_path(to), bytes, size / 2);
        free(bytes);
        bl_test_refuse_file(to, "", BL_DEVICE, "cannot read");
    }
    bl_test_refuse_file("missing.exr", "", BL_DEVICE, "No such file");
    bl_test_refuse_file("folder.exr", "", BL_DEVICE, "folder");
    bl_test_refuse_file("pipe.exr", "", BL_DEVICE, "pipe");
    bl_test_refuse_file("empty.exr", "", BL_DEVICE, "empty");
    bl_test_refuse_file("text.exr", "", BL_DEVICE, "cannot read");
    bl_test_refuse_file("text.txt", "", BL_DEVICE, "cannot read");
    bl_test_refuse_file("parts.exr", "", BL_MISMATCH, "2 parts");
    bl_test_refuse_file("parts.exr", ":part=2", BL_USAGE, "2 parts");
    bl_signal_free(bl_test_open_file("parts.exr", ":part=1"));
}

static void test_a_closed_file_is_refused(void **state) {
    (void)state;
    bl_signal *opened = NULL, *refused = NULL;
    bl_message message = {""}, reason = {""};
    oiiotool("--create 64x64 3 --noise -d float -o open.tif");
    oiiotool("--create 64x64 3 --noise -d float -o closed.tif");
    chmod(bl_temporary_path("open.tif"), 0644);
    chmod(bl_temporary_path("closed.tif"), 0);
    if (!bl_temporary_drop_powers())
        skip(); // nothing is closed to root, who may not be another here
    bl_status good =
        bl_source_open(bl_test_file_text("open.tif", ""), BL_ISA_BEST, &opened, &message);
    bl_status bad =
        bl_source_open(bl_test_file_text("closed.tif", ""), BL_ISA_BEST, &refused, &reason);
    bl_temporary_take_powers();
    bl_signal_free(opened);
    assert_int_equal(good, BL_OK);
    assert_int_equal(bad, BL_DEVICE);
    assert_non_null(strstr(reason.text, "denied"));
    assert_null(refused);
}

static void test_damaged_bytes_never_crash(void **state) {
    (void)state;
    static const char *const names[] = {"whole.exr", "whole.png", "whole.tif"};
    oiiotool("--create 32x32 1 --noise -d half -o whole.exr");
    oiiotool("--create 32x32 1 --noise -d uint8 -o whole.png");
    oiiotool("--create 32x32 1 --noise -d float -o whole.tif");
    uint64_t random = 1;
    for (size_t trial = 0; trial < bl_test_scaled(90, 9); trial++) {
        size_t size;
        char bad[32];
        char *bytes = bl_temporary_read(bl_temporary_path(names[trial % 3]), &size);
        for (int k = 0; k < 4; k++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            bytes[(random >> 33) % (k < 2 ? 200 : size)] ^= (char)(1 << (random >> 61));
        }
        snprintf(bad, sizeof bad, "bad%s", names[trial % 3] + 5);
        bl_temporary_write(bl_temporary_path(bad), bytes, size);
        free(bytes);
        bl_signal *signal = NULL;
        bl_message message = {""};
        bl_status status =
            bl_source_open(bl_test_file_text(bad, ""), BL_ISA_BEST, &signal, &message);
        assert_true(status == BL_OK || message.text[0]);
        if (status == BL_OK)
            (void)at(signal, 1, 1);
        bl_signal_free(signal);
    }
}

static void test_every_bad_setting_is_refused_with_its_reason(void **state) {
    (void)state;
    oiiotool("--create 64x64 3 --noise -d half -o good.exr");
    bl_test_refuse_file("good.exr", ":channel=Q", BL_USAGE, "R, G, B");
    bl_test_refuse_file("good.exr", ":channel=3", BL_USAGE, "0 to 2");
    bl_test_refuse_file("good.exr", ":channel=R,channel=G", BL_USAGE, "twice");
    bl_test_refuse_file("good.exr", ":spacing=0", BL_USAGE, "above 0");
    bl_test_refuse_file("good.exr", ":spacing=-1", BL_USAGE, "above 0");
    bl_test_refuse_file("good.exr", ":spacing=abc", BL_USAGE, "spacing");
    bl_test_refuse_file("good.exr", ":spacing=nan", BL_USAGE, "spacing");
    bl_test_refuse_file("good.exr", ":part=1.5", BL_USAGE, "part");
    bl_test_refuse_file("good.exr", ":part=-1", BL_USAGE, "part");
    bl_test_refuse_file("good.exr", ":chanel=R", BL_USAGE, "did you mean 'channel'");
    bl_test_refuse_file("good.exr", ":memory=-1", BL_USAGE, "memory");
    oiiotool("good.exr --attrib bandlimit:spacing wide -o odd.exr");
    bl_test_refuse_file("odd.exr", "", BL_MISMATCH, "wide");
    bl_signal_free(bl_test_open_file("odd.exr", ":spacing=2"));
}

// --- writing ------------------------------------------------------------------------------------

static const float small[] = {-1, -0.5f, 0, 0.5f, 1, 2, -2, NAN};
static const bl_attribute note = {"bandlimit:signal", "gnoise:seed=7"};

static bl_image small_image(void) {
    return (bl_image){.width = 4,
                      .height = 2,
                      .values = small,
                      .spacing = 0.1,
                      .black = -1,
                      .white = 1,
                      .attributes = &note,
                      .attribute_count = 1};
}

static void test_exr_and_tiff_keep_the_floats_and_the_spacing(void **state) {
    (void)state;
    static const char *const names[] = {"small.exr", "small.tif", "SMALL.TIFF"};
    const bl_image image = small_image();
    for (int f = 0; f < 3; f++) {
        bl_message message = {""};
        if (bl_image_write(bl_temporary_path(names[f]), &image, &message) != BL_OK)
            fail_msg("%s", message.text);
        bl_signal *signal = bl_test_open_file(names[f], "");
        assert_near(signal->extent.spacing[0], 0.1, 0);
        for (int i = 0; i < 7; i++)
            assert_near(at(signal, 0.1 * (i % 4), 0.1 * (i / 4)), (double)small[i], 0);
        assert_true(isnan(at(signal, 0.3, 0.1)));
        bl_signal_free(signal);
    }
    const char *const arguments[] = {
        "sh", "-c",
        "oiiotool --info -v small.exr | grep -q 'bandlimit:signal: \"gnoise:seed=7\"' &&"
        " oiiotool --info -v small.tif | grep -q 'bandlimit:signal=gnoise:seed=7'",
        NULL};
    assert_int_equal(bl_temporary_run(bl_temporary_folder(), arguments), 0);
}

static void test_the_same_image_gives_the_same_bytes(void **state) {
    (void)state;
    static const char *const names[] = {"same.exr", "same.tif", "same.png"};
    const bl_image image = small_image();
    for (int f = 0; f < 3; f++) {
        bl_message message = {""};
        size_t size = 0, again_size = 0;
        assert_int_equal(bl_image_write(bl_temporary_path(names[f]), &image, &message), BL_OK);
        char *bytes = bl_temporary_read(bl_temporary_path(names[f]), &size);
        usleep(1100000); // a time of writing would show now
        assert_int_equal(bl_image_write(bl_temporary_path(names[f]), &image, &message), BL_OK);
        char *again = bl_temporary_read(bl_temporary_path(names[f]), &again_size);
        assert_int_equal(size, again_size);
        assert_memory_equal(bytes, again, size);
        free(bytes);
        free(again);
    }
}

static void test_png_codes_are_proportional_to_the_values(void **state) {
    (void)state;
    bl_image image = small_image();
    static const double shares[] = {0, 0.25, 0.5, 0.75, 1, 1, 0, 0};
    for (unsigned bits = 8; bits <= 16; bits += 8) {
        bl_message message = {""};
        image.bits = bits;
        assert_int_equal(bl_image_write(bl_temporary_path("small.png"), &image, &message), BL_OK);
        bl_signal *signal = bl_test_open_file("small.png", ":spacing=1");
        for (int i = 0; i < 8; i++)
            assert_near(at(signal, i % 4, i / 4), shares[i], bits == 8 ? 0.0021 : 1e-5);
        bl_signal_free(signal);
    }
    image.black = image.white = 0; // the finite range: -2 to 2
    bl_message message = {""};
    assert_int_equal(bl_image_write(bl_temporary_path("small.png"), &image, &message), BL_OK);
    bl_signal *signal = bl_test_open_file("small.png", ":spacing=1");
    assert_near(at(signal, 2, 0), 0.5, 0.0021);
    assert_near(at(signal, 2, 1), 0, 0);
    bl_signal_free(signal);
}

// Points of the curve as IEC 61966-2-1 gives it, in codes of 255: its two ends, its linear part,
// and middle grey, 0.214 for the code 127.5.
static void test_png_codes_of_linear_light_follow_srgb(void **state) {
    (void)state;
    static const float values[4] = {0, 0.0031308f, 0.21404f, 1};
    static const double codes[4] = {0, 12.92 * 0.0031308, 0.5, 1};
    const bl_image image = {
        .width = 4, .height = 1, .values = values, .white = 1, .bits = 16, .srgb = 1};
    bl_message message = {""};
    assert_int_equal(bl_image_write(bl_temporary_path("light.png"), &image, &message), BL_OK);
    bl_signal *signal = bl_test_open_file("light.png", ":spacing=1");
    for (int i = 0; i < 4; i++)
        assert_near(at(signal, i, 0), codes[i], 2e-5);
    bl_signal_free(signal);
}

static void test_a_bad_image_is_not_written(void **state) {
    (void)state;
    bl_message message = {""};
    bl_image image = small_image();
    assert_int_equal(bl_image_write(bl_temporary_path("a.gif"), &image, &message), BL_USAGE);
    assert_int_equal(bl_image_write(bl_temporary_path("a"), &image, &message), BL_USAGE);
    assert_int_equal(bl_image_write(bl_temporary_path("no/a.exr"), &image, &message), BL_DEVICE);
    assert_int_equal(bl_image_write("/dev/null/a.png", &image, &message), BL_DEVICE);
    mkdir(bl_temporary_path("is.exr"), 0777);
    assert_int_equal(bl_image_write(bl_temporary_path("is.exr"), &image, &message), BL_DEVICE);
    image.bits = 12;
    assert_int_equal(bl_image_write(bl_temporary_path("a.png"), &image, &message), BL_USAGE);
    image.bits = 8;
    image.width = 0;
    assert_int_equal(bl_image_write(bl_temporary_path("a.png"), &image, &message), BL_USAGE);
    image.width = (size_t)1 << 40;
    assert_int_equal(bl_image_write(bl_temporary_path("a.png"), &image, &message), BL_USAGE);
    assert_int_not_equal(access(bl_temporary_path("a.png"), F_OK), 0);
}

// A disk that fills up at any byte, the last one too: no part of a file is left, not even a hidden
// one, and an earlier file stays. An image that just fits is whole.
static void test_a_disk_that_fills_up_leaves_nothing(void **state) {
    (void)state;
    enum { SIDE = 96 };
    static const char *const names[] = {"full.png", "full.exr", "full.tif"};
    float *values = malloc(sizeof(float) * SIDE * SIDE);
    for (int i = 0; i < SIDE * SIDE; i++)
        values[i] = (float)sin(i * (double)i); // compresses badly
    const bl_image image = {.width = SIDE, .height = SIDE, .values = values, .bits = 16};
    for (int f = 0; f < 3; f++) {
        bl_message message;
        size_t size, size_now;
        const char *path = bl_temporary_path(names[f]);
        assert_int_equal(bl_image_write(path, &image, &message), BL_OK);
        char *bytes = bl_temporary_read(path, &size);
        const size_t limits[] = {1, 100, size / 2, size - 20, size - 1, size};
        size_t files = bl_temporary_files();
        for (int i = 0; i < 6; i++) {
            message.text[0] = '\0';
            bl_temporary_limit_files(limits[i]);
            bl_status status = bl_image_write(path, &image, &message);
            bl_temporary_limit_files(0);
            char *now = bl_temporary_read(path, &size_now);
            if (status != (i < 5 ? BL_DEVICE : BL_OK) ||
                (i < 5 && !strstr(message.text, "File too large")))
                fail_msg("%s of %zu bytes, %zu allowed: status %d, '%s'", names[f], size, limits[i],
                         status, message.text);
            assert_int_equal(size_now, size);
            assert_memory_equal(now, bytes, size);
            assert_int_equal(bl_temporary_files(), files);
            free(now);
        }
        free(bytes);
    }
    free(values);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_white_noise_has_its_variance_and_a_flat_spectrum),
        cmocka_unit_test(test_a_sine_shows_as_one_line),
        cmocka_unit_test(test_integers_are_divided_by_their_full_scale),
        cmocka_unit_test(test_alpha_does_not_change_the_values),
        cmocka_unit_test(test_rows_columns_and_points_agree_in_memory_and_in_blocks),
        cmocka_unit_test(test_a_place_takes_the_nearest_pixel_and_nan_outside),
        cmocka_unit_test(test_a_noise_is_not_taken_for_a_file),
        cmocka_unit_test(test_every_bad_file_is_refused_with_its_reason),
        cmocka_unit_test(test_a_closed_file_is_refused),
        cmocka_unit_test(test_damaged_bytes_never_crash),
        cmocka_unit_test(test_every_bad_setting_is_refused_with_its_reason),
        cmocka_unit_test(test_exr_and_tiff_keep_the_floats_and_the_spacing),
        cmocka_unit_test(test_the_same_image_gives_the_same_bytes),
        cmocka_unit_test(test_png_codes_are_proportional_to_the_values),
        cmocka_unit_test(test_png_codes_of_linear_light_follow_srgb),
        cmocka_unit_test(test_a_bad_image_is_not_written),
        cmocka_unit_test(test_a_disk_that_fills_up_leaves_nothing),
    };
    return bl_run_tests(tests);
}
