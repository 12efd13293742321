// SPDX-License-Identifier: MIT
//
// What the codes of a file stand for: light for a picture, numbers for data. The files are made
// here, byte by byte, so that their chunks are known.
#include "tests/test.h"

#include "core/colourspace.h"
#include "sources/source.h"
#include "tests/temporary.h"

// --- files --------------------------------------------------------------------------------------

typedef struct bytes {
    unsigned char data[16384];
    size_t size;
} bytes;

static void put(bytes *b, const void *data, size_t size) {
    assert_true(b->size + size <= sizeof b->data);
    memcpy(b->data + b->size, data, size);
    b->size += size;
}

static void put_number(bytes *b, uint32_t number, int is_big) {
    unsigned char four[4];
    for (int i = 0; i < 4; i++)
        four[i] = (unsigned char)(number >> 8 * (is_big ? 3 - i : i));
    put(b, four, 4);
}

static uint32_t crc_of(const unsigned char *data, size_t size) {
    uint32_t crc = UINT32_MAX;
    for (size_t i = 0; i < size; i++) {
        crc ^= data[i];
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    return ~crc;
}

static void put_chunk(bytes *b, const char *name, const void *data, size_t size) {
    put_number(b, (uint32_t)size, 1);
    put(b, name, 4);
    put(b, data, size);
    put_number(b, crc_of(b->data + b->size - size - 4, size + 4), 1);
}

// A PNG of 2 x 1 pixels of 1, 3 or 4 channels of 8 or 16 bits; `gamma` in 1/100000, 0 for no chunk.
static const char *write_png(const char *name, int channels, int bits, const int *codes,
                             uint32_t gamma, int has_srgb) {
    static const int types[] = {0, 0, 4, 2, 6};
    bytes file = {.size = 0}, head = {.size = 0}, row = {.size = 0}, packed = {.size = 0};
    put(&file, "\x89PNG\r\n\x1a\n", 8);
    put_number(&head, 2, 1);
    put_number(&head, 1, 1);
    put(&head,
        (const unsigned char[]){(unsigned char)bits, (unsigned char)types[channels], 0, 0, 0}, 5);
    put_chunk(&file, "IHDR", head.data, head.size);
    head.size = 0;
    put_number(&head, gamma, 1);
    if (gamma)
        put_chunk(&file, "gAMA", head.data, 4);
    if (has_srgb)
        put_chunk(&file, "sRGB", "", 1);
    put(&row, "", 1);
    for (int i = 0; i < 2 * channels; i++) {
        const unsigned char two[2] = {(unsigned char)(codes[i] >> 8), (unsigned char)codes[i]};
        put(&row, bits == 16 ? two : two + 1, (size_t)bits / 8);
    }
    uint32_t a = 1, d = 0; // Adler
    for (size_t i = 0; i < row.size; i++)
        a = (a + row.data[i]) % 65521, d = (d + a) % 65521;
    const unsigned char stored[] = {
        0x78, 1, 1, (unsigned char)row.size, 0, (unsigned char)~row.size, 0xff};
    put(&packed, stored, sizeof stored);
    put(&packed, row.data, row.size);
    put_number(&packed, d << 16 | a, 1);
    put_chunk(&file, "IDAT", packed.data, packed.size);
    put_chunk(&file, "IEND", "", 0);
    const char *path = bl_temporary_path(name);
    bl_temporary_write(path, file.data, file.size);
    return path;
}

static void put_attribute(bytes *b, const char *name, const char *type, const void *data,
                          size_t size) {
    put(b, name, strlen(name) + 1);
    put(b, type, strlen(type) + 1);
    put_number(b, (uint32_t)size, 0);
    put(b, data, size);
}

// An EXR of one row with a channel "id" of 32-bit whole numbers.
static const char *write_ids(const char *name, const uint32_t *ids, uint32_t count) {
    bytes file = {.size = 0}, list = {.size = 0}, box = {.size = 0};
    const float one = 1, centre[2] = {0};
    put_number(&file, 20000630, 0);
    put_number(&file, 2, 0);
    put(&list, "id", 3);
    put(&list, (const uint32_t[]){0, 0, 1, 1}, 16);
    put(&list, "", 1);
    put(&box, (const uint32_t[]){0, 0, count - 1, 0}, 16);
    put_attribute(&file, "channels", "chlist", list.data, list.size);
    put_attribute(&file, "compression", "compression", "", 1);
    put_attribute(&file, "dataWindow", "box2i", box.data, box.size);
    put_attribute(&file, "displayWindow", "box2i", box.data, box.size);
    put_attribute(&file, "lineOrder", "lineOrder", "", 1);
    put_attribute(&file, "pixelAspectRatio", "float", &one, 4);
    put_attribute(&file, "screenWindowCenter", "v2f", centre, 8);
    put_attribute(&file, "screenWindowWidth", "float", &one, 4);
    put(&file, "", 1);
    put_number(&file, (uint32_t)file.size + 8, 0);
    put_number(&file, 0, 0);
    put_number(&file, 0, 0);
    put_number(&file, 4 * count, 0);
    put(&file, ids, 4 * count);
    const char *path = bl_temporary_path(name);
    bl_temporary_write(path, file.data, file.size);
    return path;
}

// --- reading ------------------------------------------------------------------------------------

static bl_signal *open_text(const char *before, const char *path, const char *after) {
    char text[4096];
    bl_signal *signal;
    bl_message message = {""};
    snprintf(text, sizeof text, "%s%s%s", before, path, after);
    if (bl_source_open(text, BL_ISA_BEST, &signal, &message) != BL_OK)
        fail_msg("%s", message.text);
    return signal;
}

// The value at x, and what the signal says of its source.
static double value_of(const char *before, const char *path, const char *after, double x,
                       const char *says) {
    char note[256];
    bl_signal *signal = open_text(before, path, after);
    double value = bl_signal_value(signal, (const double[BL_AXES]){x, x < 1 ? x : 0});
    bl_signal_note(signal, note, sizeof note);
    bl_signal_free(signal);
    if (!strstr(note, says))
        fail_msg("%s%s%s says '%s' and not '%s'", before, path, after, note, says);
    return value;
}

static double picture_value(const char *path, const char *after, const char *says) {
    return value_of("image:path=", path, after, 0.25, says);
}

static void check_is_usage(const char *before, const char *path, const char *after) {
    char text[4096];
    bl_signal *signal;
    bl_message message = {""};
    snprintf(text, sizeof text, "%s%s%s", before, path, after);
    assert_int_equal(bl_source_open(text, BL_ISA_BEST, &signal, &message), BL_USAGE);
    assert_non_null(strstr(message.text, "gamma2.2"));
}

// --- the curves ---------------------------------------------------------------------------------

// IEC 61966-2-1: the two pieces meet, and the code 0.5 is the light 0.21404.
static void test_the_curve_of_srgb_and_its_inverse(void **state) {
    (void)state;
    for (int i = -100; i <= 1100; i++)
        assert_near(bl_srgb_decode(bl_srgb_encode(i / 1000.0)), i / 1000.0, 3e-8);
    assert_near(bl_srgb_decode(0.5), 0.2140411, 1e-7);
    assert_near(bl_srgb_encode(0.0031308), bl_srgb_encode(0.0031308 + 1e-12), 1e-7);
}

static void test_the_words_of_files_are_known(void **state) {
    (void)state;
    static const struct {
        const char *word;
        double power;
        int known;
        bl_colourspace space;
    } cases[] = {{"sRGB", 0, 1, {BL_COLOURS_SRGB, 0}},
                 {"srgb_rec709_scene", 0, 1, {BL_COLOURS_SRGB, 0}},
                 {"Linear", 0, 1, {BL_COLOURS_LINEAR, 0}},
                 {"lin_rec709", 0, 1, {BL_COLOURS_LINEAR, 0}},
                 {"scene_linear", 0, 1, {BL_COLOURS_LINEAR, 0}},
                 {"Gamma2.2", 2.2, 1, {BL_COLOURS_POWER, 2.2}},
                 {"GammaCorrected", 1.8, 1, {BL_COLOURS_POWER, 1.8}},
                 {"GammaCorrected", 1, 1, {BL_COLOURS_LINEAR, 0}},
                 {"GammaCorrected", 0, 0, {BL_COLOURS_LINEAR, 0}},
                 {"g22_rec709_tx", 0, 1, {BL_COLOURS_POWER, 2.2}},
                 {"g18_rec709", 0, 1, {BL_COLOURS_POWER, 1.8}},
                 {"KodakLog", 0, 0, {BL_COLOURS_LINEAR, 0}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_colourspace space;
        assert_int_equal(bl_colourspace_of_file(cases[i].word, cases[i].power, &space),
                         cases[i].known);
        assert_int_equal(space.curve, cases[i].space.curve);
        assert_near(space.power, cases[i].space.power, 1e-12);
    }
}

// --- pictures -----------------------------------------------------------------------------------

// The numbers by hand: ((128/255 + 0.055)/1.055)^2.4 = 0.21586, (128/255)^2.2 = 0.21952,
// 128/255 = 0.50196; of 16 bits 40000/65535 is 0.61036, and 0.33077 of sRGB.
static void test_light_follows_what_the_file_says(void **state) {
    (void)state;
    static const int grey[] = {128, 128}, deep[] = {40000, 40000};
    static const int clear[] = {128, 128, 128, 64, 128, 128, 128, 64};
    const char *plain = write_png("plain.png", 1, 8, grey, 0, 0);
    assert_near(picture_value(plain, ",amount=0", "the curve of sRGB"), 0.215861, 1e-6);
    const char *gamma = write_png("gamma.png", 1, 8, grey, 45455, 0);
    assert_near(picture_value(gamma, ",amount=0", "the power 2.2"), 0.219520, 1e-5);
    const char *both = write_png("both.png", 1, 8, grey, 45455, 1); // the sRGB chunk is stronger
    assert_near(picture_value(both, ",amount=0", "the curve of sRGB"), 0.215861, 1e-6);
    const char *linear = write_png("linear.png", 1, 8, grey, 100000, 0);
    assert_near(picture_value(linear, ",amount=0", "linear (the file says"), 0.501961, 1e-6);
    const char *fine = write_png("fine.png", 1, 16, deep, 0, 1);
    assert_near(picture_value(fine, ",amount=0", "the curve of sRGB"), 0.330774, 1e-6);
    const char *alpha = write_png("alpha.png", 4, 8, clear, 0, 1);
    assert_near(picture_value(alpha, ",amount=0", "alpha is left aside"), 0.215861, 1e-6);
}

static void test_colourspace_overrides_the_file(void **state) {
    (void)state;
    static const int grey[] = {128, 128};
    const char *path = write_png("gamma.png", 1, 8, grey, 45455, 0);
    static const struct {
        const char *word, *says;
        double value;
    } cases[] = {{"linear", "linear (as asked)", 0.501961},
                 {"srgb", "the curve of sRGB (as asked)", 0.215861},
                 {"gamma1.8", "the power 1.8 (as asked)", 0.289205},
                 {"1.8", "the power 1.8 (as asked)", 0.289205},
                 {"1", "linear (as asked)", 0.501961},
                 {"file", "Gamma2.2", 0.219520}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char after[64];
        snprintf(after, sizeof after, ",amount=0,colourspace=%s", cases[i].word);
        assert_near(picture_value(path, after, cases[i].says), cases[i].value, 1e-5);
    }
    check_is_usage("image:path=", path, ",colourspace=acescg");
    check_is_usage("image:path=", path, ",colourspace=0");
    check_is_usage("image:path=", path, ",colourspace=gamma");
    check_is_usage("image:path=", path, ",colourspace=2.2x");
    check_is_usage("", path, ":colourspace=1e9");
}

// Black and white in codes: the mean of light, not of codes, by every filter.
static void test_filters_average_light(void **state) {
    (void)state;
    static const int codes[] = {0, 188};
    const double light = pow((188 / 255.0 + 0.055) / 1.055, 2.4) / 2;
    const char *path = write_png("pair.png", 1, 8, codes, 0, 1);
    static const char *const filters[] = {"mean", "sat", "mip", "anisotropic"};
    for (size_t i = 0; i < sizeof filters / sizeof *filters; i++) {
        char after[64];
        snprintf(after, sizeof after, ",amount=0,filter=%s", filters[i]);
        bl_signal *signal = open_text("image:path=", path, after);
        const double width[BL_AXES] = {2, 2, 0, 0};
        assert_near(bl_signal_filtered(signal, (const double[BL_AXES]){0.3, 0.3}, width), light,
                    1e-6);
        bl_signal_free(signal);
    }
}

// --- data ---------------------------------------------------------------------------------------

static void test_data_is_as_stored_unless_light_is_asked_for(void **state) {
    (void)state;
    static const int clear[] = {128, 64, 32, 100, 255, 0, 0, 200};
    const char *path = write_png("data.png", 4, 8, clear, 0, 1);
    assert_near(value_of("", path, "", 0, "uint8 of the channel R, as stored over 255"),
                128 / 255.0, 1e-7);
    assert_near(
        value_of("", path, ":colourspace=file", 0, "the curve of sRGB (the file says sRGB)"),
        0.215861, 1e-6);
    assert_near(value_of("", path, ":channel=G,colourspace=2", 0, "the power 2 (as asked)"),
                64 / 255.0 * 64 / 255.0, 1e-7);
    // An opacity is no colour.
    assert_near(value_of("", path, ":channel=A,colourspace=srgb", 1, "uint8 of the channel A"),
                200 / 255.0, 1e-7);
    // Read in blocks.
    assert_near(value_of("", path, ":colourspace=srgb,memory=0", 0, "sRGB"), 0.215861, 1e-6);
}

static void test_numbers_of_things_stay_whole(void **state) {
    (void)state;
    static const uint32_t ids[] = {0, 1, 57, 65535, 1000003, 16777213, 16777216, 4294967040u};
    const char *path = write_ids("ids.exr", ids, 8);
    for (int i = 0; i < 8; i++)
        assert_near(value_of("", path, ":channel=id", i, "uint of the channel id, as stored"),
                    ids[i], 0);
    for (int i = 0; i < 5; i++) // in blocks through floats, which are exact up to 2^22
        assert_near(value_of("", path, ":channel=id,memory=0", i, "as stored"), ids[i], 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_curve_of_srgb_and_its_inverse),
        cmocka_unit_test(test_the_words_of_files_are_known),
        cmocka_unit_test(test_light_follows_what_the_file_says),
        cmocka_unit_test(test_colourspace_overrides_the_file),
        cmocka_unit_test(test_filters_average_light),
        cmocka_unit_test(test_data_is_as_stored_unless_light_is_asked_for),
        cmocka_unit_test(test_numbers_of_things_stay_whole),
    };
    return bl_run_tests(tests);
}
