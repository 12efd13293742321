// SPDX-License-Identifier: MIT
//
// The separable lattice noises (vnoise, gnoise, vgnoise, hermite) against brute force: the formula
// at the head of each file, summed over all lattice points within three cells, with kernels written
// here from the textbook and lattice numbers from noises/lattice/lattice.h. It shares with the
// noises neither their cells, nor their loops, nor their kernels.
#include "tests/test.h"

#include "core/hash.h"
#include "core/random.h"
#include "noises/lattice/kernel.h"
#include "noises/lattice/lattice.h"
#include "noises/noise.h"
#include "tests/texts.h"

enum { REACH = 3, ACROSS = 2 * REACH + 1, SAMPLES = 40 };

// --- the kernels, from the textbook -------------------------------------------------------------

typedef double kernel_function(double x);

// Keys (1981) with a = -1/2.
static double catmull_rom(double x) {
    double d = fabs(x);
    if (d <= 1)
        return 1.5 * pow(d, 3) - 2.5 * pow(d, 2) + 1;
    return d <= 2 ? -0.5 * pow(d, 3) + 2.5 * pow(d, 2) - 4 * d + 2 : 0;
}

static double linear(double x) {
    return fmax(0, 1 - fabs(x));
}

// 1 - smoothstep(0, 1, |x|).
static double smooth(double x) {
    double t = fmin(1, fabs(x));
    return 1 - (3 * pow(t, 2) - 2 * pow(t, 3));
}

static double quintic(double x) {
    double t = fmin(1, fabs(x));
    return 1 - (6 * pow(t, 5) - 15 * pow(t, 4) + 10 * pow(t, 3));
}

// Schoenberg (1946): the centred B-spline of degree n is 1/n! times the sum over k = 0..n+1 of
// (-1)^k binomial(n+1, k) max(0, x + (n+1)/2 - k)^n. Left of 0 the sum loses nothing at its end.
static double bspline(int degree, double x) {
    double sum = 0, binomial = 1, factorial = 1;
    for (int k = 0; k <= degree + 1; k++) {
        double base = -fabs(x) + (degree + 1) / 2.0 - k;
        sum += base > 0 ? (k % 2 ? -1 : 1) * binomial * pow(base, degree) : 0;
        binomial = binomial * (degree + 1 - k) / (k + 1);
    }
    for (int k = 2; k <= degree; k++)
        factorial *= k;
    return sum / factorial;
}

static double bspline2(double x) {
    return bspline(2, x);
}

static double bspline3(double x) {
    return bspline(3, x);
}

// The cubic Hermite basis function of a tangent, from both sides of its lattice point.
static double tangent(double x) {
    double t = fabs(x);
    return t < 1 ? (x < 0 ? -1 : 1) * (pow(t, 3) - 2 * pow(t, 2) + t) : 0;
}

typedef struct named_kernel {
    const char *name;
    kernel_function *kernel;
    bl_kernel closed; // the same in noises/lattice/kernel.h
    int interpolates, reproduces_lines;
} named_kernel;

static const named_kernel interps[] = {{"catmull-rom", catmull_rom, BL_KERNEL_CATMULL_ROM, 1, 1},
                                       {"linear", linear, BL_KERNEL_LINEAR, 1, 1},
                                       {"smooth", smooth, BL_KERNEL_SMOOTH, 1, 0},
                                       {"bspline2", bspline2, BL_KERNEL_BSPLINE2, 0, 1},
                                       {"bspline3", bspline3, BL_KERNEL_BSPLINE3, 0, 1}};
static const named_kernel fades[] = {{"cubic", smooth, BL_KERNEL_SMOOTH, 1, 0},
                                     {"quintic", quintic, BL_KERNEL_QUINTIC, 1, 0},
                                     {"linear", linear, BL_KERNEL_LINEAR, 1, 1}};
static const char *const gradient_names[] = {"sphere", "rejection", "edges"};
static const char *const lattice_names[] = {"hash", "perm256"};
enum { INTERPS = 5, FADES = 3, GRADIENTS = 3, LATTICES = 2 };

// --- brute force --------------------------------------------------------------------------------

// What a lattice point c adds at a distance d = p - c.
typedef struct brute {
    bl_lattice lattice;
    kernel_function *interp, *fade;
    bl_gradients gradients;
} brute;

typedef double contribution(const brute *noise, const uint64_t cell[3], const double d[3]);

static double lattice_number(const bl_lattice *lattice, const uint64_t cell[3], unsigned part) {
    return (double)bl_lattice_value(bl_lattice_word(lattice, cell, part)) * 0x1p-31;
}

static double value_at(const brute *noise, const uint64_t cell[3], const double d[3]) {
    return lattice_number(&noise->lattice, cell, 0) * noise->interp(d[0]) * noise->interp(d[1]) *
           noise->interp(d[2]);
}

static double gradient_at(const brute *noise, const uint64_t cell[3], const double d[3]) {
    double g[3];
    bl_lattice_gradient(noise->gradients, bl_lattice_word(&noise->lattice, cell, 0), g);
    return (g[0] * d[0] + g[1] * d[1] + g[2] * d[2]) * noise->fade(d[0]) * noise->fade(d[1]) *
           noise->fade(d[2]);
}

static double hermite_at(const brute *noise, const uint64_t cell[3], const double d[3]) {
    double sum = 0;
    for (unsigned part = 0; part < 4; part++) {
        double product = lattice_number(&noise->lattice, cell, part);
        for (unsigned a = 0; a < 3; a++)
            product *= part == 1 + a ? tangent(d[a]) : smooth(d[a]);
        sum += product;
    }
    return sum;
}

static double brute_sum(const brute *noise, contribution *add, const double at[3]) {
    double sum = 0;
    for (int n = 0; n < ACROSS * ACROSS * ACROSS; n++) {
        const int offset[3] = {n % ACROSS - REACH, n / ACROSS % ACROSS - REACH,
                               n / ACROSS / ACROSS - REACH};
        uint64_t cell[3];
        double d[3];
        for (int a = 0; a < 3; a++) {
            double point = floor(at[a]) + offset[a];
            cell[a] = (uint64_t)(int64_t)point;
            d[a] = at[a] - point; // exact: both are multiples of the last place of at[a], or
                                  // the result is rounded at 2^-53 of a cell
        }
        // The kernels here all end at two cells: most of the points only have to be looked at.
        if (fabs(d[0]) < 2.5 && fabs(d[1]) < 2.5 && fabs(d[2]) < 2.5)
            sum += add(noise, cell, d);
    }
    return sum;
}

// A noise to be tested: a weighted sum of up to two parts.
typedef struct subject {
    char text[128];
    int parts;
    double weight[2];
    brute noise[2];
    contribution *add[2];
} subject;

static double brute_value(const subject *one, const double at[3]) {
    double sum = 0;
    for (int part = 0; part < one->parts; part++)
        sum += one->weight[part] * brute_sum(&one->noise[part], one->add[part], at);
    return sum;
}

static subject value_subject(uint64_t seed, int interp, int lattice) {
    subject one = {.parts = 1, .weight = {1}, .add = {value_at}};
    snprintf(one.text, sizeof one.text, "vnoise:seed=%llu,interp=%s,lattice=%s",
             (unsigned long long)seed, interps[interp].name, lattice_names[lattice]);
    one.noise[0].lattice = bl_lattice_of(seed, (bl_lattice_kind)lattice);
    one.noise[0].interp = interps[interp].kernel;
    return one;
}

static subject gradient_subject(uint64_t seed, int fade, int gradients, int lattice) {
    subject one = {.parts = 1, .weight = {1}, .add = {gradient_at}};
    snprintf(one.text, sizeof one.text, "gnoise:seed=%llu,fade=%s,gradients=%s,lattice=%s",
             (unsigned long long)seed, fades[fade].name, gradient_names[gradients],
             lattice_names[lattice]);
    one.noise[0].lattice = bl_lattice_of(seed, (bl_lattice_kind)lattice);
    one.noise[0].fade = fades[fade].kernel;
    one.noise[0].gradients = (bl_gradients)gradients;
    return one;
}

// The parts draw from the streams 16 and 17 of the seed.
static subject sum_subject(uint64_t seed, int interp, int fade, int gradients, int lattice) {
    subject one = value_subject(bl_stream(seed, 16), interp, lattice);
    subject other = gradient_subject(bl_stream(seed, 17), fade, gradients, lattice);
    one.parts = 2;
    one.weight[0] = -0.75;
    one.weight[1] = 2.5;
    one.noise[1] = other.noise[0];
    one.add[1] = other.add[0];
    snprintf(one.text, sizeof one.text,
             "vgnoise:seed=%llu,value=-0.75,gradient=2.5,interp=%s,fade=%s,gradients=%s,lattice=%s",
             (unsigned long long)seed, interps[interp].name, fades[fade].name,
             gradient_names[gradients], lattice_names[lattice]);
    return one;
}

static subject hermite_subject(uint64_t seed, int lattice) {
    subject one = {.parts = 1, .weight = {1}, .add = {hermite_at}};
    snprintf(one.text, sizeof one.text, "hermite:seed=%llu,lattice=%s", (unsigned long long)seed,
             lattice_names[lattice]);
    one.noise[0].lattice = bl_lattice_of(seed, (bl_lattice_kind)lattice);
    return one;
}

// --- the comparison -----------------------------------------------------------------------------

static bl_signal *open(const char *text) {
    return bl_test_open(text, BL_ISA_BEST);
}

// Around 0 and far away, on both sides; where the loops change their way (2^27) and where the high
// half of a cell number changes (2^31, 2^32).
static const double centres[] = {0,       1e6,    1e9,     -1e6,   -1e9,    0x1p27,
                                 -0x1p27, 0x1p31, -0x1p31, 0x1p32, -0x1p40, 0x1p45};
// On lattice planes, close to both sides of them, and about the half integers.
static const double edges[] = {0, 1e-9, -1e-9, 0x1p-20, -0x1p-20, 0.5, 0.5 - 1e-9, 0.5 + 1e-9};
enum { CENTRES = sizeof centres / sizeof *centres, EDGES = sizeof edges / sizeof *edges };

// Every third coordinate is near a cell's boundary, the others are anywhere.
static void choose_place(bl_random *random, size_t index, double at[BL_AXES]) {
    double centre = centres[index % CENTRES];
    for (int a = 0; a < 3; a++) {
        double near = 12 * bl_random_unit(random) - 6;
        if (bl_random_bits(random) % 3 == 0)
            near = floor(near) + edges[bl_random_bits(random) % EDGES];
        at[a] = centre + near;
    }
    at[3] = 0;
}

static void compare(const subject *one, const double at[], double actual, double tolerance,
                    const char *way) {
    double expected = brute_value(one, at);
    if (!(fabs(actual - expected) <= tolerance))
        fail_msg("%s, %s at (%.17g, %.17g, %.17g): %.17g, by brute force %.17g", one->text, way,
                 at[0], at[1], at[2], actual, expected);
}

static void compare_values(const subject *one, const bl_signal *signal, bl_random *random) {
    for (size_t i = 0; i < bl_test_scaled(960, 48); i++) {
        double at[BL_AXES];
        choose_place(random, i, at);
        compare(one, at, bl_signal_value(signal, at), 1e-13, "value");
    }
}

static void compare_points(const subject *one, const bl_signal *signal, bl_random *random) {
    double column[BL_AXES][SAMPLES];
    float out[SAMPLES];
    for (size_t batch = 0; batch < bl_test_scaled(12, 2); batch++) {
        for (size_t i = 0; i < SAMPLES; i++) {
            double at[BL_AXES];
            // Batches all near the origin take the faster of two ways.
            choose_place(random, batch % 2 ? i : 0, at);
            for (int a = 0; a < BL_AXES; a++)
                column[a][i] = at[a];
        }
        bl_signal_points(signal, BL_COLUMNS(column), SAMPLES, out);
        for (size_t i = 0; i < SAMPLES; i++) {
            const double at[BL_AXES] = {column[0][i], column[1][i], column[2][i], 0};
            compare(one, at, (double)out[i], 32 * 0x1p-24 * signal->facts.upper, "points");
        }
    }
}

static void compare_rows(const subject *one, const bl_signal *signal, bl_random *random) {
    static const double steps[] = {0.05, -0.3, 1, 0x1p-10, -1.4, 0.5, 3};
    float out[SAMPLES];
    for (size_t n = 0; n < bl_test_scaled(5 * CENTRES, CENTRES); n++) {
        double start[BL_AXES], step[BL_AXES] = {0};
        choose_place(random, n, start);
        step[n % 3] = steps[n % 7];
        bl_signal_row(signal, start, step, SAMPLES, out);
        for (size_t i = n % 5; i < SAMPLES; i += 5) {
            double at[BL_AXES];
            for (int a = 0; a < BL_AXES; a++)
                at[a] = start[a] + (double)i * step[a];
            compare(one, at, (double)out[i], 32 * 0x1p-24 * signal->facts.upper, "row");
        }
    }
}

static void compare_all(const subject *one, uint64_t stream) {
    bl_signal *signal = open(one->text);
    bl_random random = bl_random_seed(1, stream);
    compare_values(one, signal, &random);
    compare_points(one, signal, &random);
    compare_rows(one, signal, &random);
    bl_signal_free(signal);
}

static void test_vnoise_is_the_sum_over_the_lattice(void **state) {
    (void)state;
    for (int n = 0; n < INTERPS * LATTICES; n++) {
        subject one = value_subject(n == 3 ? UINT64_MAX : (uint64_t)n, n % INTERPS, n / INTERPS);
        compare_all(&one, (uint64_t)n);
    }
}

static void test_gnoise_is_the_sum_over_the_lattice(void **state) {
    (void)state;
    for (int n = 0; n < FADES * GRADIENTS * LATTICES; n++) {
        subject one = gradient_subject((uint64_t)n * 77, n % FADES, n / FADES % GRADIENTS,
                                       n / FADES / GRADIENTS);
        compare_all(&one, 100 + (uint64_t)n);
    }
}

static void test_vgnoise_is_the_weighted_sum_of_two_streams(void **state) {
    (void)state;
    for (int n = 0; n < INTERPS * LATTICES; n++) {
        subject one =
            sum_subject(5 + (uint64_t)n, n % INTERPS, n % FADES, n / 2 % GRADIENTS, n / INTERPS);
        compare_all(&one, 200 + (uint64_t)n);
    }
}

static void test_hermite_is_the_sum_over_the_lattice(void **state) {
    (void)state;
    for (int n = 0; n < 3 * LATTICES; n++) {
        subject one = hermite_subject(n == 4 ? UINT64_MAX : (uint64_t)n, n % LATTICES);
        compare_all(&one, 300 + (uint64_t)n);
    }
}

// --- at the lattice points ----------------------------------------------------------------------

// Lattice points near and far, and what a signal says there in its three ways.
typedef struct lattice_points {
    double at[BL_AXES][SAMPLES];
    uint64_t cell[SAMPLES][3];
    double value[SAMPLES], gradient[SAMPLES][BL_AXES];
    float points[SAMPLES], row[SAMPLES]; // row: one along each axis in turn, from the point on
} lattice_points;

static void visit_lattice(const bl_signal *signal, uint64_t stream, lattice_points *visit) {
    bl_random random = bl_random_seed(2, stream);
    for (size_t i = 0; i < SAMPLES; i++) {
        double at[BL_AXES] = {0};
        for (int a = 0; a < 3; a++) {
            at[a] = centres[i % CENTRES] + floor(12 * bl_random_unit(&random)) - 6;
            visit->cell[i][a] = (uint64_t)(int64_t)at[a];
        }
        for (int a = 0; a < BL_AXES; a++)
            visit->at[a][i] = at[a];
        visit->value[i] = bl_signal_value(signal, at);
        signal->functions->gradient(signal->parameters, at, visit->gradient[i]);
        // The last sample of a row of nine that comes from half a cell and more away.
        double start[BL_AXES], step[BL_AXES] = {0};
        float row[9];
        memcpy(start, at, sizeof start);
        step[i % 3] = i % 2 ? 0.125 : -0.25;
        start[i % 3] -= 8 * step[i % 3];
        bl_signal_row(signal, start, step, 9, row);
        visit->row[i] = row[8];
    }
    bl_signal_points(signal, BL_COLUMNS(visit->at), SAMPLES, visit->points);
}

static void test_gnoise_is_zero_on_the_lattice_and_has_the_lattice_gradient(void **state) {
    (void)state;
    for (int n = 0; n < FADES * GRADIENTS * LATTICES; n++) {
        subject one = gradient_subject(9 + (uint64_t)n, n % FADES, n / FADES % GRADIENTS,
                                       n / FADES / GRADIENTS);
        bl_signal *signal = open(one.text);
        lattice_points visit;
        visit_lattice(signal, (uint64_t)n, &visit);
        for (size_t i = 0; i < SAMPLES; i++) {
            double g[3];
            bl_lattice_gradient(one.noise[0].gradients,
                                bl_lattice_word(&one.noise[0].lattice, visit.cell[i], 0), g);
            assert_near(visit.value[i], 0, 0);
            assert_near((double)visit.points[i], 0, 0);
            assert_near((double)visit.row[i], 0, 0);
            // With fade=linear the noise has a kink there, and no gradient.
            for (int a = 0; a < 3 && fades[n % FADES].kernel != linear; a++)
                assert_near(visit.gradient[i][a], g[a], 1e-13);
        }
        bl_signal_free(signal);
    }
}

static void test_interpolating_value_noise_is_its_lattice_value_on_the_lattice(void **state) {
    (void)state;
    for (int n = 0; n < INTERPS * LATTICES; n++) {
        if (!interps[n % INTERPS].interpolates)
            continue;
        subject one = value_subject(31 + (uint64_t)n, n % INTERPS, n / INTERPS);
        bl_signal *signal = open(one.text);
        lattice_points visit;
        visit_lattice(signal, (uint64_t)n, &visit);
        for (size_t i = 0; i < SAMPLES; i++) {
            double v = lattice_number(&one.noise[0].lattice, visit.cell[i], 0);
            assert_near(visit.value[i], v, 0);
            assert_near((double)visit.points[i], v, 0);
            assert_near((double)visit.row[i], v, 0);
        }
        bl_signal_free(signal);
    }
}

static void test_hermite_is_its_value_and_its_tangents_on_the_lattice(void **state) {
    (void)state;
    for (int n = 0; n < LATTICES; n++) {
        subject one = hermite_subject(40 + (uint64_t)n, n);
        bl_signal *signal = open(one.text);
        lattice_points visit;
        visit_lattice(signal, (uint64_t)n, &visit);
        for (size_t i = 0; i < SAMPLES; i++) {
            const bl_lattice *lattice = &one.noise[0].lattice;
            double v = lattice_number(lattice, visit.cell[i], 0);
            assert_near(visit.value[i], v, 0);
            assert_near((double)visit.points[i], v, 0);
            assert_near((double)visit.row[i], v, 0x1p-24);
            for (unsigned a = 0; a < 3; a++)
                assert_near(visit.gradient[i][a], lattice_number(lattice, visit.cell[i], 1 + a), 0);
        }
        bl_signal_free(signal);
    }
}

// --- the kernels --------------------------------------------------------------------------------

// The kernels that the comparison above takes, and those of the closed forms.
static void check_kernel(const named_kernel *one) {
    for (double t = 0; t < 1; t += 0x1p-9) {
        double sum = 0, closed = 0, line = 0;
        for (int c = -REACH; c <= REACH; c++) {
            double k = one->kernel(t - c);
            assert_near(bl_kernel_value(one->closed, t - c), k, 1e-14);
            sum += k;
            closed += bl_kernel_value(one->closed, t - c);
            line += c * k;
        }
        assert_near(sum, 1, 1e-14);
        assert_near(closed, 1, 1e-14);
        if (one->reproduces_lines)
            assert_near(line, t, 1e-14);
    }
    for (int c = -REACH; one->interpolates && c <= REACH; c++)
        assert_near(one->kernel(c), c == 0, 0);
}

static void test_every_kernel_is_a_partition_of_unity(void **state) {
    (void)state;
    for (int n = 0; n < INTERPS; n++)
        check_kernel(&interps[n]);
    for (int n = 0; n < FADES; n++)
        check_kernel(&fades[n]);
    for (double x = -2; x <= 2; x += 0x1p-9)
        assert_near(bl_kernel_value(BL_KERNEL_TANGENT, x), tangent(x), 1e-15);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_vnoise_is_the_sum_over_the_lattice),
        cmocka_unit_test(test_gnoise_is_the_sum_over_the_lattice),
        cmocka_unit_test(test_vgnoise_is_the_weighted_sum_of_two_streams),
        cmocka_unit_test(test_hermite_is_the_sum_over_the_lattice),
        cmocka_unit_test(test_gnoise_is_zero_on_the_lattice_and_has_the_lattice_gradient),
        cmocka_unit_test(test_interpolating_value_noise_is_its_lattice_value_on_the_lattice),
        cmocka_unit_test(test_hermite_is_its_value_and_its_tangents_on_the_lattice),
        cmocka_unit_test(test_every_kernel_is_a_partition_of_unity),
    };
    return bl_run_tests(tests);
}
