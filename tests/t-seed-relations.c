// SPDX-License-Identifier: MIT
//
// The property `seeds`: a relation of the signals of any two related seeds is found, in whatever
// bit it is, and good noises have none.
//
// Error rates: a good noise fails with 1e-6 by definition; a relation of r = 0.2 in one bit stands
// 6 standard deviations of a correlation of 768 products out, and is missed with less than 1e-2.
#include "tests/test.h"

#include "core/hash.h"
#include "core/random.h"
#include "noises/noise.h"
#include "tests/scores.h"
#include "tests/test_signals.h"
#include "tests/texts.h"

// gnoise of a seed that is bent, and a share of gnoise of another bent seed added to it.
typedef struct block {
    uint64_t seed;
    int which;
    bl_signal *main, *added;
} block;

enum {
    BIT_0 = 0,
    BIT_63 = 63, // the wave of all other bits, r = 0.3 in one bit
    NEGATIVE,    // the signals of s and ~s differ by the sign alone
    DOUBLE,      // s and 2 s are one
    SHIFTED,     // the seed's low bits move the noise along y
    SHIFTED_TWO, // ... by two cells each
    DIAGONAL,    // ... along y and against z
    SIGN,        // s and -s are one
    HALVES,      // the halves of the seed are added
    HIGH_HALF,   // the upper half is dead
    SMALL_PAIR,  // the seeds 3 and 17 have r = 0.25
    ADDED_BITS,  // s and s + 2^32 have r = 0.5
    GOOD,
    CASES
};

static double shift_of(const block *b) {
    return b->which == SHIFTED || b->which == DIAGONAL ? (double)(b->seed & 0xff)
           : b->which == SHIFTED_TWO                   ? 2 * (double)(b->seed & 0xff)
                                                       : 0;
}

static double against(const block *b) {
    return b->which == DIAGONAL ? shift_of(b) : 0;
}

static double share_of(const block *b) {
    if (b->which <= BIT_63)
        return 0.65; // r = 0.65^2 / (1 + 0.65^2) = 0.3
    if (b->which == SMALL_PAIR)
        return b->seed == 3 || b->seed == 17 ? 0.577 : 0; // 1/4
    return b->which == ADDED_BITS ? 1 : 0;
}

static uint64_t bent(const block *b) {
    uint64_t s = b->seed;
    if (b->which == NEGATIVE)
        return s >> 63 ? ~s : s;
    if (b->which == DOUBLE)
        return s ? s >> __builtin_ctzll(s) : 0;
    if (b->which == SHIFTED || b->which == SHIFTED_TWO || b->which == DIAGONAL)
        return s >> 8;
    if (b->which == SIGN)
        return s >> 63 ? 0 - s : s;
    if (b->which == HALVES)
        return (s >> 32) + (s & 0xffffffff);
    return b->which == HIGH_HALF ? s & 0xffffffff : s;
}

static uint64_t added(const block *b) {
    if (b->which <= BIT_63)
        return bl_mix((b->seed & ~(UINT64_C(1) << b->which)) + 77);
    return b->which == SMALL_PAIR ? 12345 : bl_mix((b->seed & 0xffffffff) + 77);
}

static double value(const void *parameters, const double at[BL_AXES]) {
    const block *b = parameters;
    const double place[BL_AXES] = {at[0], at[1] + shift_of(b), at[2] - against(b), 0};
    double sign = b->which == NEGATIVE && b->seed >> 63 ? -1 : 1;
    return sign * bl_signal_value(b->main, place) + share_of(b) * bl_signal_value(b->added, place);
}

static void points(const void *parameters, const double *const at[BL_AXES], size_t count,
                   float *out) {
    const block *b = parameters;
    for (size_t from = 0, n; from < count; from += n) {
        double y[BL_BATCH], z[BL_BATCH];
        float other[BL_BATCH];
        n = count - from < BL_BATCH ? count - from : BL_BATCH;
        for (size_t i = 0; i < n; i++)
            y[i] = at[1][from + i] + shift_of(b), z[i] = at[2][from + i] - against(b);
        const double *const moved[BL_AXES] = {at[0] + from, y, z, at[3] + from};
        bl_signal_points(b->main, moved, n, out + from);
        bl_signal_points(b->added, moved, n, other);
        float sign = b->which == NEGATIVE && b->seed >> 63 ? -1 : 1;
        for (size_t i = 0; i < n; i++)
            out[from + i] = sign * out[from + i] + (float)share_of(b) * other[i];
    }
}

static bl_status open_gnoise(uint64_t seed, bl_signal **signal, bl_message *message) {
    char text[64];
    snprintf(text, sizeof text, "gnoise:seed=%llu", (unsigned long long)seed);
    return bl_noise_open(text, BL_ISA_BEST, signal, message);
}

static bl_status build(void *parameters, bl_opener *open, bl_message *message) {
    block *b = parameters;
    (void)open;
    bl_status status = open_gnoise(bent(b), &b->main, message);
    if (status == BL_OK)
        status = open_gnoise(added(b), &b->added, message);
    if (status != BL_OK)
        bl_signal_free(b->main);
    return status;
}

static void release(void *parameters) {
    block *b = parameters;
    bl_signal_free(b->main);
    bl_signal_free(b->added);
}

static bl_signal *make(int which) {
    static const bl_signal_functions functions = {
        .points = points, .value = value, .build = build, .release = release};
    block b = {.seed = 5, .which = which};
    return bl_test_built(&functions, &b, sizeof b, offsetof(block, seed), "related");
}

static void check(int which, uint64_t seed, bl_verdict verdict, const char *told) {
    bl_signal *signal = make(which);
    bl_score_property found = bl_test_score(signal, "seeds", BL_QUICK, seed);
    if (found.verdict != verdict || !strstr(found.reason, told))
        fail_msg("case %d, seed %llu: %s: '%s' does not tell '%s'", which, (unsigned long long)seed,
                 bl_verdict_word(found.verdict), found.reason, told);
    bl_signal_free(signal);
}

static void test_a_relation_in_any_one_bit_is_found(void **state) {
    (void)state;
    for (int bit = BIT_0; bit <= BIT_63; bit++) {
        char told[32];
        if (!bl_test_walk(bit % (bl_test_scaled(8, 0) >= 8 ? 3 : 9) == 0))
            continue;
        snprintf(told, sizeof told, "differ in bit %d ", bit);
        check(bit, 1 + (uint64_t)bit, BL_VERDICT_FAIL, told);
    }
}

static void test_each_relation_is_named(void **state) {
    (void)state;
    check(NEGATIVE, 1, BL_VERDICT_FAIL, "each other's complement are related: r = -");
    check(DOUBLE, 1, BL_VERDICT_FAIL, "double each other");
    check(SHIFTED, 1, BL_VERDICT_FAIL, "cells away");
    check(SHIFTED_TWO, 1, BL_VERDICT_FAIL, "2, +0) cells away");
    check(DIAGONAL, 1, BL_VERDICT_FAIL, "cells away");
    check(SIGN, 1, BL_VERDICT_FAIL, "differ by the sign");
    check(HALVES, 1, BL_VERDICT_FAIL, "have exchanged halves");
    check(HIGH_HALF, 1, BL_VERDICT_FAIL,
          "32 bits of the seed do nothing at most places, the first "
          "is bit 32");
    check(SMALL_PAIR, 1, BL_VERDICT_FAIL, "the seeds 3 and 17 are related");
    check(ADDED_BITS, 1, BL_VERDICT_FAIL, "are related: r = 0.");
    for (uint64_t seed = 1; seed <= (uint64_t)bl_test_scaled(10, 2); seed++)
        check(GOOD, seed, BL_VERDICT_PASS, "all 64 bits count");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_relation_in_any_one_bit_is_found),
        cmocka_unit_test(test_each_relation_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
