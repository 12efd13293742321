// SPDX-License-Identifier: MIT
//
// A walk over all signals of the registries that have a seed: a seed beside the text is the seed
// written out in it, and setting a key to the value that it has changes nothing.
#include "tests/test.h"

#include "core/setting.h"
#include "sources/source.h"
#include "tests/texts.h"
#include "textures/texture.h"
#include "filters/primitive.h"

enum { PLACES = 64 };

static const bl_registry *const registries[] = {&bl_noises, &bl_primitives, &bl_textures, NULL};

static void expect_same(const bl_signal *a, const bl_signal *b, int same) {
    int differ = 0;
    for (int i = 0; i < PLACES; i++) {
        const double at[BL_AXES] = {0.37 * i + 0.1, 0.71 * i, 0.13 * i, 0.29 * i};
        const double one = bl_signal_value(a, at), other = bl_signal_value(b, at);
        differ += memcmp(&one, &other, sizeof one) != 0;
    }
    if (same ? differ : !differ)
        fail_msg("%s and %s differ at %d places of %d", a->text, b->text, differ, PLACES);
}

static bl_signal *open_text(const char *text) {
    bl_signal *signal = NULL;
    bl_message message = {""};
    if (bl_source_open(text, BL_ISA_BEST, &signal, &message) != BL_OK)
        fail_msg("%s: %s", text, message.text);
    return signal;
}

static bl_signal *open_seeded(const char *text, uint64_t seed) {
    bl_signal *signal = NULL;
    bl_message message = {""};
    if (bl_source_open_seeded(text, seed, BL_ISA_BEST, &signal, &message) != BL_OK)
        fail_msg("%s: %s", text, message.text);
    return signal;
}

static void check_seed(const char *text) {
    char written[256];
    bl_message message;
    bl_signal *plain = open_text(text), *seeded = open_seeded(text, 3), *refused = NULL;
    snprintf(written, sizeof written, "%s%cseed=3", text, strchr(text, ':') ? ',' : ':');
    bl_signal *out = open_text(written), *again = open_text(seeded->text);
    bl_signal *patched = bl_signal_reseed(plain, 3), *same = open_seeded(written, 3);
    assert_string_equal(seeded->text, out->text);
    assert_string_equal(again->text, out->text);
    expect_same(plain, seeded, 0);
    expect_same(out, seeded, 1);
    expect_same(again, seeded, 1);
    expect_same(patched, seeded, 1);
    expect_same(same, seeded, 1);
    assert_int_equal(bl_source_open_seeded(written, 4, BL_ISA_BEST, &refused, &message), BL_USAGE);
    assert_null(refused);
    assert_non_null(strstr(message.text, "contradict each other"));
    bl_signal *all[] = {plain, seeded, out, again, patched, same};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        bl_signal_free(all[i]);
}

static void test_a_seed_beside_the_text_is_one_within_it(void **state) {
    (void)state;
    size_t with = 0;
    for (size_t r = 0; registries[r]; r++)
        for (size_t i = 0; i < registries[r]->count; i++) {
            const bl_definition *definition = bl_registry_at(registries[r], i);
            bl_message message;
            bl_signal *signal = NULL;
            with += bl_definition_seed(definition) != NULL;
            if (strcmp(definition->name, "image") == 0)
                continue; // it wants a picture
            if (bl_definition_seed(definition)) {
                check_seed(definition->name);
            } else {
                assert_int_equal(
                    bl_source_open_seeded(definition->name, 3, BL_ISA_BEST, &signal, &message),
                    BL_MISMATCH);
                assert_null(signal);
                assert_non_null(strstr(message.text, "has no seed"));
            }
        }
    assert_true(with > 20);
    check_seed("fbm:basis=fbm,octaves=2,basis.basis=vnoise,basis.octaves=2");
    check_seed("marble:basis=vnoise,basis.interp=linear");
    check_seed("wood:noise=gnoise,noise.fade=quintic");
}

// Of every key, and of those of a basis, whose dots are at any depth.
static void check_keys(const char *text) {
    bl_signal *signal = open_text(text);
    bl_spec spec;
    assert_int_equal(bl_spec_parse(signal->text, &spec, NULL), BL_OK);
    for (size_t i = 0; i < spec.count; i++) {
        bl_signal *changed = NULL;
        bl_message message = {""};
        if (bl_signal_with_setting(signal, spec.settings[i].key, spec.settings[i].value, &changed,
                                   &message) != BL_OK)
            fail_msg("%s: %s", signal->text, message.text);
        assert_string_equal(changed->text, signal->text);
        expect_same(changed, signal, 1);
        bl_signal_free(changed);
    }
    bl_spec_free(&spec);
    bl_signal_free(signal);
}

static void test_setting_a_key_to_its_value_changes_nothing(void **state) {
    (void)state;
    check_keys("gnoise:seed=7,fade=quintic,dims=2");
    check_keys("scnoise:kernel=table:100,seed=5");
    check_keys(
        "fbm:basis=fbm,octaves=2,seed=9,basis.octaves=3,basis.basis=vnoise,"
        "basis.basis.interp=linear");
    check_keys("marble:basis=vnoise,basis.interp=linear,seed=2,filter=fade,width=0.25");
    check_keys("brick:filter=exact,width=0.1");
}

// The copy's block has the seed, and its text has that of the original.
static void test_a_setting_keeps_the_seed_of_a_reseeded_copy(void **state) {
    (void)state;
    bl_signal *plain = open_text("gnoise"), *fresh = bl_signal_reseed(plain, 8), *changed = NULL;
    assert_int_equal(bl_signal_with_setting(fresh, "fade", "quintic", &changed, NULL), BL_OK);
    assert_string_equal(changed->text, "gnoise:seed=8,fade=quintic");
    bl_signal_free(plain);
    bl_signal_free(fresh);
    bl_signal_free(changed);
}

static void test_a_text_is_edited_at_any_depth(void **state) {
    (void)state;
    static const char *const cases[][4] = {
        {"n", "a", "1", "n:a=1"},
        {"n:a=1,b=2", "a", "3", "n:a=3,b=2"},
        {"n:b=2", "basis.basis.seed", "3", "n:b=2,basis.basis.seed=3"},
        {"n:basis=g,basis.seed=1,c=1,2", "basis.seed", "3", "n:basis=g,basis.seed=3,c=1,2"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *text = NULL;
        assert_int_equal(bl_text_set(cases[i][0], cases[i][1], cases[i][2], &text, NULL), BL_OK);
        assert_string_equal(text, cases[i][3]);
        free(text);
    }
    char *text = NULL;
    assert_int_equal(bl_text_set("n:a", "a", "1", &text, NULL), BL_USAGE);
    assert_null(text);
}

static void test_a_signal_goes_into_a_text_and_a_key_out_of_it(void **state) {
    (void)state;
    static const char *const nested[][3] = {
        {"n", "g", "n:basis=g"},
        {"n:a=1", "g:seed=3,list=1,2", "n:a=1,basis=g,basis.seed=3,basis.list=1,2"},
        {"n", "g:kernel=table:100,basis=h", "n:basis=g,basis.kernel=table:100,basis.basis=h"},
        {"n", "g:k=1,k=2", "n:basis=g,basis.k=1,basis.k=2"}}; // which its opening refuses
    static const char *const dropped[][2] = {{"n:seed=1", "n"},
                                             {"n:seed=1,a=2", "n:a=2"},
                                             {"n:a=1,2,seed=1,b=3", "n:a=1,2,b=3"},
                                             {"n:basis.seed=1,seed=2", "n:basis.seed=1"},
                                             {"n:basis.seed=1", "n:basis.seed=1"}};
    char *text = NULL;
    for (size_t i = 0; i < sizeof nested / sizeof *nested; i++) {
        assert_int_equal(bl_text_nest(nested[i][0], "basis", nested[i][1], &text, NULL), BL_OK);
        assert_string_equal(text, nested[i][2]);
        free(text);
    }
    for (size_t i = 0; i < sizeof dropped / sizeof *dropped; i++) {
        assert_int_equal(bl_text_drop(dropped[i][0], "seed", &text, NULL), BL_OK);
        assert_string_equal(text, dropped[i][1]);
        free(text);
    }
    text = NULL;
    assert_int_equal(bl_text_nest("n", "basis", "g:a", &text, NULL), BL_USAGE);
    assert_null(text);
}

static void test_the_text_of_a_signal_is_told_without_its_seed(void **state) {
    (void)state;
    static const char *const cases[][2] = {
        {"gnoise:seed=3,fade=quintic", "gnoise:fade=quintic"},
        {"fbm:seed=2,basis.interp=linear,basis=vnoise", "fbm:basis=vnoise,basis.interp=linear"},
        {"step", "step"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal;
        assert_int_equal(bl_source_open(cases[i][0], BL_ISA_BEST, &signal, NULL), BL_OK);
        char *text = bl_source_text_unseeded(signal);
        assert_string_equal(text, cases[i][1]);
        free(text);
        bl_signal_free(signal);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_seed_beside_the_text_is_one_within_it),
        cmocka_unit_test(test_setting_a_key_to_its_value_changes_nothing),
        cmocka_unit_test(test_a_setting_keeps_the_seed_of_a_reseeded_copy),
        cmocka_unit_test(test_a_text_is_edited_at_any_depth),
        cmocka_unit_test(test_a_signal_goes_into_a_text_and_a_key_out_of_it),
        cmocka_unit_test(test_the_text_of_a_signal_is_told_without_its_seed),
    };
    return bl_run_tests(tests);
}
