// SPDX-License-Identifier: MIT
//
// What the walkers do not hold of the two noises that are older programs: the 16 gradients of
// Perlin's improved noise and the anisotropy they make, and Rayshade's noise against value noise.
//
// Error rates: the statistical test fails a true noise with probability 1e-6.
#include "tests/test.h"

#include "core/random.h"
#include "core/statistics.h"
#include "noises/lattice/lattice.h"
#include "tests/texts.h"

static int is_edge(const double g[3], const int edge[3]) {
    return g[0] == edge[0] && g[1] == edge[1] && g[2] == edge[2];
}

// Each of the 12 edges once, and four of them again; the moments are those of the head.
static void test_the_sixteen_gradients(void **state) {
    (void)state;
    static const int again[4][3] = {{1, 1, 0}, {-1, 1, 0}, {0, -1, 1}, {0, -1, -1}};
    double mean[3] = {0}, moment[3][3] = {{0}};
    int count = 0;
    for (int n = 0; n < 27; n++) {
        const int edge[3] = {n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
        int is = abs(edge[0]) + abs(edge[1]) + abs(edge[2]) == 2, found = 0, expected = is;
        for (int k = 0; k < 4; k++)
            expected += memcmp(edge, again[k], sizeof edge) == 0;
        for (uint32_t entry = 0; entry < 16; entry++) {
            double g[3];
            bl_lattice_gradient(BL_GRADIENTS_EDGES16, entry << 28 | 0x0fffffff, g);
            found += is_edge(g, edge);
        }
        assert_int_equal(found, expected);
        count += found;
    }
    assert_int_equal(count, 16);
    for (uint32_t entry = 0; entry < 16; entry++) {
        double g[3];
        bl_lattice_gradient(BL_GRADIENTS_EDGES16, entry << 28, g);
        for (int a = 0; a < 3; a++) {
            mean[a] += g[a];
            for (int b = 0; b < 3; b++)
                moment[a][b] += g[a] * g[b] / 16;
        }
    }
    for (int a = 0; a < 3; a++) {
        assert_near(mean[a], 0, 0);
        for (int b = 0; b < 3; b++)
            assert_near(moment[a][b], a != b ? 0 : a == 1 ? 3.0 / 4 : 5.0 / 8, 0);
    }
}

// The gradient at a lattice point is the one of its cell, and the noise is 0 there.
static void test_perlin2002_has_its_gradients_on_the_lattice(void **state) {
    (void)state;
    static const char *const texts[] = {"perlin2002:seed=3,lattice=hash", "perlin2002:seed=3"};
    for (int t = 0; t < 2; t++) {
        bl_signal *signal = bl_test_open(texts[t], BL_ISA_BEST);
        bl_lattice lattice = bl_lattice_of(3, t ? BL_LATTICE_PERM256 : BL_LATTICE_HASH);
        for (int n = 0; n < 200; n++) {
            const double at[BL_AXES] = {n % 5 - 2, n / 5 % 8 - 4, n / 40};
            const uint64_t cell[3] = {(uint64_t)(int64_t)at[0], (uint64_t)(int64_t)at[1],
                                      (uint64_t)(int64_t)at[2]};
            double expected[3], found[BL_AXES];
            bl_lattice_gradient(BL_GRADIENTS_EDGES16, bl_lattice_word(&lattice, cell, 0), expected);
            signal->functions->gradient(signal->parameters, at, found);
            assert_near(bl_signal_value(signal, at), 0, 0);
            for (int a = 0; a < 3; a++)
                assert_near(found[a], expected[a], 1e-15);
        }
        bl_signal_free(signal);
    }
}

// The mean square slope along y is 6/5 of that along x at the lattice points, and the noise says so
// in its density: at low frequencies that along an axis is as the second moment of it.
static void test_perlin2002_is_stronger_along_y(void **state) {
    (void)state;
    bl_signal *signal = bl_test_open("perlin2002:lattice=hash", BL_ISA_BEST);
    double density[3];
    for (int a = 0; a < 3; a++) {
        double f[BL_AXES] = {0};
        f[a] = 1e-3;
        density[a] = signal->functions->density(signal->parameters, f);
    }
    assert_near(density[1] / density[0], 1.2, 1e-12);
    assert_near(density[2] / density[0], 1, 1e-12);
    bl_moments difference = {.n = 0};
    for (int n = 0; n < 20000; n++) {
        const double at[BL_AXES] = {n % 40, n / 40 % 25, n / 1000};
        double slope[BL_AXES];
        signal->functions->gradient(signal->parameters, at, slope);
        bl_moments_add(&difference, slope[1] * slope[1] - slope[0] * slope[0]);
    }
    double error = sqrt(bl_moments_variance(&difference) / difference.n);
    assert_near(difference.mean, 1.0 / 8, -bl_normal_quantile(5e-7) * error);
    bl_signal_free(signal);
}

// Seed by seed half of the value noise, and a half.
static void test_rayshade_is_value_noise_in_another_range(void **state) {
    (void)state;
    static const char *const pairs[][2] = {
        {"rayshade:seed=6", "vnoise:seed=6,interp=smooth"},
        {"rayshade:seed=6,weights=linear", "vnoise:seed=6,interp=linear"},
        {"rayshade:lattice=perm256,component=2",
         "vnoise:interp=smooth,lattice=perm256,component=2"}};
    bl_random random = bl_random_seed(3, 0);
    for (int pair = 0; pair < 3; pair++) {
        bl_signal *rayshade = bl_test_open(pairs[pair][0], BL_ISA_BEST),
                  *vnoise = bl_test_open(pairs[pair][1], BL_ISA_BEST);
        for (int n = 0; n < 200; n++) {
            double at[BL_AXES] = {0};
            for (int a = 0; a < 3; a++)
                at[a] = 40 * bl_random_unit(&random) - 20;
            double value = bl_signal_value(rayshade, at);
            assert_near(value, 0.5 + 0.5 * bl_signal_value(vnoise, at), 0);
            assert_true(value > 0 && value < 1);
        }
        if (rayshade->closed_form)
            assert_near(rayshade->facts.variance, vnoise->facts.variance / 4, 1e-16);
        bl_signal_free(rayshade);
        bl_signal_free(vnoise);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_sixteen_gradients),
        cmocka_unit_test(test_perlin2002_has_its_gradients_on_the_lattice),
        cmocka_unit_test(test_perlin2002_is_stronger_along_y),
        cmocka_unit_test(test_rayshade_is_value_noise_in_another_range),
    };
    return bl_run_tests(tests);
}
