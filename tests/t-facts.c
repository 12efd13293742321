// SPDX-License-Identifier: MIT
//
// What a descriptor states in numbers is true, neither too much nor too little: the continuity
// class, the period, the coordinate where precision ends, the mean, the variance. Walks the
// registry with every choice of every key.
//
// Error rates. A true noise fails each of the tests of mean, of variance and of stationarity with
// probability 1e-6, for all its settings together. Their unit is a batch of one fresh seed: the
// batches are independent whatever happens within one, and the means of a thousand of them are
// normal, as the central limit theorem has it.
#include "tests/test.h"

#include "core/random.h"
#include "core/statistics.h"
#include "tests/jumps.h"
#include "tests/texts.h"

#define ERROR_RATE 1e-6

// --- the settings -------------------------------------------------------------------------------

// All settings of the registry, and some that depend on two keys.
static bl_texts *all_texts(void) {
    static bl_texts list;
    static const char *const more[] = {
        "gnoise:fade=quintic,gradients=edges,lattice=perm256",
        "vgnoise:interp=bspline3,fade=quintic",
        "vgnoise:interp=bspline3,fade=linear,gradients=rejection",
        // Periods as short as the footprint of the kernel.
        "vnoise:interp=bspline2,period=3", "vcnoise:period=4", "vnoise:dims=1,period=4,1,1",
        "hermite:period=3,0,4", "scnoise:period=4,impulses=1",
        "scnoise:period=4,kernel=cosine,count=poisson", "wiener:period=4",
        "perlin2002:lattice=hash,period=3", "spot:period=3", "gabor:period=3,4",
        "fbm:basis.period=4,octaves=2", "scnoise:impulses=1,kernel=table:100,lattice=perm256"};
    if (list.count)
        return &list;
    list = *bl_test_texts();
    for (size_t i = 0; i < sizeof more / sizeof *more; i++)
        snprintf(list.text[list.count++], sizeof list.text[0], "%s", more[i]);
    return &list;
}

static bl_signal *open_signal(const char *text) {
    return bl_test_open(text, BL_ISA_BEST);
}

// The noise's own cell, or the finest one of a sum of octaves, which loses its fraction first.
static double finest_cell(const bl_facts *facts) {
    return facts->cell > 0 ? fmin(facts->cell, facts->far * 0x1p-52) : 1;
}

// A sum all of whose octaves are removed: it has no derivative to jump, and repeats everywhere.
static int is_constant(const bl_signal *signal) {
    return signal->facts.variance == 0 && signal->facts.lower == signal->facts.upper;
}

// --- continuity ---------------------------------------------------------------------------------
//
// tests/jumps.h finds the jumps.

enum { ORDERS = BL_JUMP_ORDERS, LONG = 4096, SHORT = 512, OBLIQUE = BL_AXES };

// A line along an axis at a random place across, or an oblique one, with steps of h or
// about it. It begins at a multiple of h, so that the steps are equal.
static void sample_line(const bl_signal *signal, bl_random *random, unsigned axis, double h,
                        size_t count, double *value) {
    double start[BL_AXES], step[BL_AXES] = {0}, at[BL_AXES];
    for (unsigned a = 0; a < BL_AXES; a++) {
        start[a] = h * floor((40 * bl_random_unit(random) - 20) / h);
        if (a == axis || (axis == OBLIQUE && a < 3))
            step[a] = axis == OBLIQUE ? h * (floor(16 * bl_random_unit(random)) - 7.5) / 8 : h;
    }
    // A long line has no end near a plane or a knot: the largest difference might be in a piece too
    // short for the longer stride.
    if (axis != OBLIQUE && (double)count * h > 1)
        start[axis] = floor(start[axis]) + 0.25;
    for (size_t i = 0; i < count; i++) {
        for (int a = 0; a < BL_AXES; a++)
            at[a] = start[a] + (double)i * step[a];
        value[i] = bl_signal_value(signal, at);
    }
}

// Whether there is a jump on one of several fine lines of a cell each: the faces of cells, which
// are few. Where noises have many, the first short line meets one.
static int jumps_somewhere(const bl_signal *signal, unsigned axis, bl_random *random) {
    enum { UNIT = 1 << 17, LINES = 8 };
    static double line[UNIT + 1];
    for (int attempt = 0; attempt < LINES; attempt++) {
        sample_line(signal, random, axis, fmax(1, signal->facts.cell) / UNIT, UNIT + 1, line);
        if (bl_jumps(line, UNIT + 1, 0))
            return 1;
    }
    return 0;
}

// The long line is two (finest) cells and crosses faces and knots; the short one is finer than the
// steps of a table, which a long one cannot tell from a slope.
static void check_continuity(const bl_signal *signal, unsigned axis, bl_random *random) {
    static double fine[SHORT + 1], line[LONG + 1];
    int stated = signal->facts.continuity;
    double cell = finest_cell(&signal->facts);
    sample_line(signal, random, axis, 0x1p-17 * cell, SHORT + 1, fine);
    int jumped = bl_jumps(fine, SHORT + 1, 0);
    if (stated < 0 && !jumped)
        jumped = jumps_somewhere(signal, axis, random);
    if (jumped != (stated < 0))
        fail_msg("%s: states class %d, and %s", signal->text, stated,
                 stated < 0 ? "does not jump" : "jumps");
    if (stated < 0)
        return;
    int found = axis == OBLIQUE || stated + 1 >= ORDERS; // a jump of the next derivative
    for (int attempt = 0; attempt < 20 && (attempt == 0 || !found); attempt++) {
        // The next lines are finer, for noises whose features are small beside the cell; the last
        // ones are of two units, for those whose waves are long beside it.
        double step = attempt < 4 ? 0x1p-11 * cell : attempt < 14 ? 0x1p-14 * cell : 0x1p-11;
        sample_line(signal, random, axis, step, LONG + 1, line);
        for (int order = 0; order <= stated && order < ORDERS; order++)
            if (bl_jumps(line, LONG + 1, (unsigned)order))
                fail_msg("%s: states class %d, and derivative %d jumps on line %u", signal->text,
                         stated, order, axis);
        found = found || bl_jumps(line, LONG + 1, (unsigned)stated + 1);
    }
    if (!found)
        fail_msg("%s: states class %d, and derivative %d does not jump along %c", signal->text,
                 stated, stated + 1, "xyz"[axis]);
}

static void test_the_class_of_continuity_is_the_one_stated(void **state) {
    (void)state;
    bl_texts *list = all_texts();
    for (size_t i = 0; i < list->count; i++) {
        if (!bl_test_takes(i, list->text[i]))
            continue;
        bl_signal *signal = open_signal(list->text[i]);
        bl_random random = bl_random_seed(1, bl_test_stream(list->text[i]));
        for (unsigned axis = 0; axis < signal->dimensions && !is_constant(signal); axis++)
            check_continuity(signal, axis, &random);
        if (!is_constant(signal))
            check_continuity(signal, OBLIQUE, &random);
        bl_signal_free(signal);
    }
}

// The last double below a face lies in the cell below it: its value and its gradient are blends of
// other corners than those on the face.
static void test_hermite_has_one_slope_on_both_sides_of_a_face(void **state) {
    (void)state;
    bl_signal *signal = open_signal("hermite:seed=3");
    bl_random random = bl_random_seed(2, 0);
    double bend = 0;
    for (int trial = 0; trial < 300; trial++) {
        int axis = trial % 3;
        double on[BL_AXES] = {0}, below[BL_AXES], above[BL_AXES], gradient[3][BL_AXES];
        for (int a = 0; a < 3; a++) {
            on[a] = 40 * bl_random_unit(&random) - 20;
            if (a == axis || (trial / 3 >> a) % 4 == 0) // edges and corners too
                on[a] = floor(on[a]);
        }
        memcpy(below, on, sizeof below);
        below[axis] = nextafter(on[axis], -INFINITY);
        assert_near(bl_signal_value(signal, below), bl_signal_value(signal, on), 1e-13);
        signal->functions->gradient(signal->parameters, below, gradient[0]);
        signal->functions->gradient(signal->parameters, on, gradient[1]);
        for (int a = 0; a < 3; a++)
            assert_near(gradient[0][a], gradient[1][a], 1e-12);
        // The second derivative jumps: from slopes 2^-20 away on both sides.
        memcpy(above, on, sizeof above);
        above[axis] += 0x1p-20;
        below[axis] = on[axis] - 0x1p-20;
        signal->functions->gradient(signal->parameters, below, gradient[0]);
        signal->functions->gradient(signal->parameters, above, gradient[2]);
        bend = fmax(bend, fabs(gradient[2][axis] - 2 * gradient[1][axis] + gradient[0][axis]));
    }
    assert_true(bend > 0x1p-20);
    bl_signal_free(signal);
}

// --- the period ---------------------------------------------------------------------------------

enum { PROBES = 24 };

typedef struct probe {
    double value[PROBES];
    float points[PROBES], row[3][PROBES];
} probe;

// The noise at the same places, multiples of 2^-8 near 0, shifted along an axis.
static probe take_probe(const bl_signal *signal, unsigned axis, double shift) {
    probe result;
    double column[BL_AXES][PROBES];
    bl_random random = bl_random_seed(3, 0);
    for (unsigned i = 0; i < PROBES; i++) {
        double at[BL_AXES];
        for (unsigned a = 0; a < BL_AXES; a++)
            at[a] = column[a][i] = (double)(int64_t)(bl_random_bits(&random) % 8192) / 256 - 16 +
                                   (a == axis ? shift : 0);
        result.value[i] = bl_signal_value(signal, at);
        if (i % (PROBES / 3) == 0) {
            unsigned along = i / (PROBES / 3);
            double step[BL_AXES] = {0};
            step[along % signal->dimensions] = 0.375;
            bl_signal_row(signal, at, step, PROBES, result.row[along]);
        }
    }
    bl_signal_points(signal, BL_COLUMNS(column), PROBES, result.points);
    return result;
}

// Equal in nothing, or in everything.
static int all_differ(const probe *a, const probe *b) {
    int differ = memcmp(a->value, b->value, sizeof a->value) != 0 &&
                 memcmp(a->points, b->points, sizeof a->points) != 0;
    for (int along = 0; along < 3; along++)
        differ = differ && memcmp(a->row[along], b->row[along], sizeof a->row[along]) != 0;
    return differ;
}

// Equal in every bit after a period that keeps the places of the probe exact; else to rounding:
// places move by 2^-53 of the period at most, and slopes are below 16 here.
static int is_same(const probe *a, const probe *b, double period) {
    if (period < 0x1p40 && 256 * period == floor(256 * period))
        return memcmp(a, b, sizeof *a) == 0;
    double tolerance = 16 * 0x1p-53 * period + 1e-6;
    int same = 1;
    for (int i = 0; i < PROBES; i++)
        same &= fabs(a->value[i] - b->value[i]) <= tolerance &&
                fabs((double)a->points[i] - (double)b->points[i]) <= tolerance;
    return same;
}

static void check_period(const bl_signal *signal, unsigned axis) {
    static const double primes[] = {2, 3, 5, 7};
    double period = signal->facts.period[axis];
    probe here = take_probe(signal, axis, 0), there;
    for (double times = -1; times <= 1 && period > 0; times += 2) {
        there = take_probe(signal, axis, times * period);
        if (!is_same(&here, &there, period))
            fail_msg("%s: no period of %g along %c", signal->text, period, "xyzw"[axis]);
    }
    for (int n = 0; n < 4 && period > 0; n++) {
        there = take_probe(signal, axis, period / primes[n]);
        if (!all_differ(&here, &there))
            fail_msg("%s: repeats within its period along %c", signal->text, "xyzw"[axis]);
    }
    double unit = fmax(1, signal->facts.cell); // a probe must not stay in a flat cell
    for (int power = 1; power <= 40 && period == 0; power++) {
        there = take_probe(signal, axis, ldexp(unit, power));
        if (!all_differ(&here, &there))
            fail_msg("%s: repeats after 2^%d along %c", signal->text, power, "xyzw"[axis]);
    }
}

static void test_the_period_is_the_one_stated(void **state) {
    (void)state;
    bl_texts *list = all_texts();
    for (size_t i = 0; i < list->count; i++) {
        bl_signal *signal = open_signal(list->text[i]);
        for (unsigned axis = 0; axis < signal->dimensions && !is_constant(signal); axis++)
            check_period(signal, axis);
        bl_signal_free(signal);
    }
}

// --- far ----------------------------------------------------------------------------------------
//
// facts.far is the coordinate beyond which the fraction within a cell is lost: beyond it the noise
// is one number all over a cell, and at a quarter of it there still are some. The cell is the
// noise's own, or the finest one of a sum of octaves, which loses its fraction first.

enum { EIGHTHS = 8 };

// How many different numbers the noise takes at the eighths of the cell that begins at `lower`,
// as far as a double can tell them: by the reference, by points and by a row.
static void count_numbers(const bl_signal *signal, unsigned axis, double lower, int numbers[3]) {
    double cell = finest_cell(&signal->facts);
    double start[BL_AXES] = {0.3, -7.6, 11.7, 0.2}, step[BL_AXES] = {0}, column[BL_AXES][EIGHTHS];
    double seen[3][EIGHTHS];
    float points[EIGHTHS], row[EIGHTHS];
    start[axis] = lower;
    step[axis] = cell / EIGHTHS;
    for (int a = 0; a < BL_AXES; a++)
        for (int i = 0; i < EIGHTHS; i++)
            column[a][i] = start[a] + i * step[a];
    bl_signal_row(signal, start, step, EIGHTHS, row);
    bl_signal_points(signal, BL_COLUMNS(column), EIGHTHS, points);
    for (int way = 0; way < 3; way++)
        numbers[way] = 0;
    for (int i = 0; i < EIGHTHS &&
                    (i == 0 || column[axis][i] < fmax(lower + cell, nextafter(lower, INFINITY)));
         i++) {
        const double at[BL_AXES] = {column[0][i], column[1][i], column[2][i], column[3][i]};
        seen[0][i] = bl_signal_value(signal, at);
        seen[1][i] = (double)points[i];
        seen[2][i] = (double)row[i];
        for (int way = 0; way < 3; way++) {
            int known = 0;
            for (int j = 0; j < i; j++)
                known |= seen[way][j] == seen[way][i];
            numbers[way] += !known;
        }
    }
}

static void test_the_fraction_ends_where_it_is_stated_to(void **state) {
    (void)state;
    static const char *const ways[] = {"the reference", "points", "a row"};
    static const double scales[] = {0.25, -0.25, 1, 2, -2};
    bl_texts *list = all_texts();
    for (size_t i = 0; i < list->count; i++) {
        bl_signal *signal = open_signal(list->text[i]);
        for (unsigned axis = 0; axis < signal->dimensions && !is_constant(signal); axis++)
            for (int s = 0; s < 5; s++) {
                int numbers[3] = {0};
                double cell = finest_cell(&signal->facts);
                double lower = floor(scales[s] * signal->facts.far / cell) * cell;
                for (int next = 0; numbers[0] < 3 && next < 64; next++)
                    count_numbers(signal, axis, next * cell, numbers);
                if (numbers[0] < 3 && fabs(scales[s]) < 1)
                    continue; // flat in its cells: nothing to lose
                count_numbers(signal, axis, lower, numbers);
                // Between the spots of a sparse noise a cell may have none.
                for (int next = 1; fabs(scales[s]) < 1 && numbers[0] < 3 && next < 64; next++)
                    count_numbers(signal, axis, lower + next * cell, numbers);
                for (int way = 0; way < 3; way++)
                    if (fabs(scales[s]) < 1 ? numbers[way] < 3 : numbers[way] != 1)
                        fail_msg(
                            "%s: states that it loses the fraction at 2^%g; %s has %d numbers "
                            "in the cell at %c = %g * 2^%g",
                            list->text[i], log2(signal->facts.far), ways[way], numbers[way],
                            "xyzw"[axis], scales[s], log2(signal->facts.far));
            }
        bl_signal_free(signal);
    }
}

// --- mean and variance --------------------------------------------------------------------------

enum { BATCH = 64 };

// The mean of values or of squares over many batches, and its standard error.
typedef struct batch_means {
    bl_moments value, square;
} batch_means;

static double standard_error(const bl_moments *moments) {
    return sqrt(bl_moments_variance(moments) / moments->n);
}

// A batch has a fresh seed and 64 places, 8 cells apart or more; at a given place in the cell, or
// anywhere.
static void add_batch(const bl_signal *signal, bl_random *random, const double *phase,
                      batch_means *means) {
    double column[BL_AXES][BATCH], base[BL_AXES], mean = 0, square = 0;
    float out[BATCH];
    bl_signal *fresh = bl_signal_reseed(signal, bl_random_bits(random));
    assert_non_null(fresh);
    for (int a = 0; a < BL_AXES; a++)
        base[a] = floor(2e6 * bl_random_unit(random)) - 1e6;
    for (int i = 0; i < BATCH; i++)
        for (int a = 0; a < BL_AXES; a++) {
            double place = 8 * bl_random_unit(random);
            column[a][i] = base[a] + 16 * (i >> 2 * a & 3) +
                           (phase ? floor(place) + (a < 3 ? phase[a] : 0) : place);
        }
    bl_signal_points(fresh, BL_COLUMNS(column), BATCH, out);
    for (int i = 0; i < BATCH; i++) {
        mean += (double)out[i] / BATCH;
        square += (double)out[i] * (double)out[i] / BATCH;
    }
    bl_moments_add(&means->value, mean);
    bl_moments_add(&means->square, square);
    bl_signal_free(fresh);
}

static batch_means measure(const bl_signal *signal, uint64_t stream, const double *phase) {
    batch_means means = {.value = {.n = 0}};
    bl_random random = bl_random_seed(4, stream);
    for (size_t batch = 0; batch < bl_test_scaled(1024, 512); batch++)
        add_batch(signal, &random, phase, &means);
    return means;
}

static void test_mean_and_variance_are_the_ones_stated(void **state) {
    (void)state;
    bl_texts *list = all_texts();
    // Two-sided, one error rate for all the means and one for all the variances.
    double limit = -bl_normal_quantile(ERROR_RATE / (double)list->count / 2);
    for (size_t i = 0; i < list->count; i++) {
        if (!bl_test_takes(i, list->text[i]))
            continue;
        bl_signal *signal = open_signal(list->text[i]);
        const bl_facts *facts = &signal->facts;
        batch_means means = measure(signal, i, NULL);
        double mean = means.value.mean, error = standard_error(&means.value);
        double rounding = 1e-12 * fabs(mean); // of a constant, which has no error
        if (!isnan(facts->mean) && !(fabs(mean - facts->mean) <= limit * error + rounding))
            fail_msg("%s: mean %g +- %g, stated %g", list->text[i], mean, error, facts->mean);
        double square = means.square.mean, expected = facts->variance + facts->mean * facts->mean;
        error = standard_error(&means.square);
        if (!isnan(facts->variance) && !isnan(facts->mean) &&
            !(fabs(square - expected) <= limit * error + 1e-12 * square))
            fail_msg("%s: mean square %g +- %g, stated %g", list->text[i], square, error, expected);
        bl_signal_free(signal);
    }
}

static void test_a_period_shorter_than_the_kernel_has_no_variance(void **state) {
    (void)state;
    static const struct {
        const char *text;
        int stated;
    } cases[] = {{"vnoise:period=4", 1},
                 {"vnoise:period=0,3", 0},
                 {"vnoise:dims=1,period=4,1,1", 1},
                 {"vnoise:interp=bspline2,period=2", 0},
                 {"gnoise:period=2", 1},
                 {"gnoise:period=4,1", 0},
                 {"gnoise:period=9,lattice=perm256", 0},
                 {"vgnoise:period=3", 0},
                 {"hermite:period=1", 0},
                 {"vcnoise:period=3", 0},
                 {"vcnoise:period=9,kernel=table:100", 0},
                 {"scnoise:period=3", 0},
                 {"scnoise:period=9,kernel=table:100", 0},
                 {"wiener:period=3", 0},
                 {"spot:period=1", 0},
                 {"spot:period=1,radius=0.5", 1},
                 {"gabor:period=1", 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bl_signal *signal = open_signal(cases[i].text);
        if (isnan(signal->facts.variance) == cases[i].stated || signal->closed_form)
            fail_msg("%s: variance %g, closed form %d", cases[i].text, signal->facts.variance,
                     signal->closed_form);
        bl_signal_free(signal);
    }
}

// --- stationarity -------------------------------------------------------------------------------

// The sum over the 8 corners of the half cell (vertex, edges, faces, centre) of the squared
// deviation of the variance there from the one stated, in standard errors: chi-square with 8
// degrees of freedom for a noise whose variance is the same everywhere.
static double phase_statistic(const char *text, uint64_t stream) {
    bl_signal *signal = open_signal(text);
    double sum = 0;
    for (unsigned n = 0; n < 8; n++) {
        const double phase[3] = {(n & 1) / 2.0, (n >> 1 & 1) / 2.0, (n >> 2) / 2.0};
        batch_means means = measure(signal, stream + n, phase);
        double deviation = means.square.mean - signal->facts.variance;
        double error = standard_error(&means.square);
        sum += deviation * deviation / (error * error); // infinite for gnoise at a vertex
    }
    bl_signal_free(signal);
    return sum;
}

static void test_impulse_noises_have_the_same_variance_all_over_the_cell(void **state) {
    (void)state;
    static const char *const stationary[] = {"scnoise",
                                             "scnoise:impulses=1",
                                             "scnoise:impulses=8",
                                             "scnoise:kernel=gaussian,count=poisson",
                                             "spot",
                                             "spot:count=fixed,impulses=1,shape=square",
                                             "spot:dims=3,shape=disc,radius=0.5",
                                             "gabor",
                                             "gabor:kind=anisotropic,phase=zero,impulses=1"};
    enum { STATIONARY = sizeof stationary / sizeof *stationary };
    double limit = bl_chi_square_quantile(1 - ERROR_RATE / STATIONARY, 8);
    for (unsigned n = 0; n < STATIONARY; n++)
        assert_less(phase_statistic(stationary[n], 1000 + 8 * n), limit);
}

// The power of the test above: the noises whose variance depends on the place in the cell.
static void test_lattice_noises_show_their_cell_in_the_variance(void **state) {
    (void)state;
    static const char *const cyclic[] = {"vnoise",
                                         "vnoise:interp=linear",
                                         "vnoise:interp=bspline2",
                                         "vnoise:interp=bspline3",
                                         "gnoise",
                                         "gnoise:fade=quintic",
                                         "gnoise:gradients=edges",
                                         "vgnoise",
                                         "hermite",
                                         "vcnoise"};
    enum { CYCLIC = sizeof cyclic / sizeof *cyclic };
    double limit = bl_chi_square_quantile(1 - ERROR_RATE / 3, 8);
    for (unsigned n = 0; n < CYCLIC; n++) {
        double statistic = phase_statistic(cyclic[n], 2000 + 8 * n);
        if (!(statistic > 2 * limit))
            fail_msg("%s: %g is not beyond %g", cyclic[n], statistic, 2 * limit);
    }
    bl_signal *signal = open_signal("gnoise");
    batch_means at_vertex = measure(signal, 3000, (const double[]){0, 0, 0});
    assert_near(at_vertex.square.mean, 0, 0);
    bl_signal_free(signal);
}

// --- closed forms -------------------------------------------------------------------------------

// The variance is the covariance at 0, and that is 0 from its reach on along every axis, whatever
// the other lags are, and not yet at 7/10 of it: the reach of a square spot is that of its circle,
// sqrt 2 too large.
static void test_the_covariance_ends_at_its_reach(void **state) {
    (void)state;
    bl_texts *list = all_texts();
    size_t seen = 0;
    for (size_t i = 0; i < list->count; i++) {
        bl_signal *signal = open_signal(list->text[i]);
        double reach = signal->facts.covariance_reach, inside = 0;
        if (signal->closed_form)
            assert_near(signal->functions->covariance(signal->parameters, (double[BL_AXES]){0}),
                        signal->facts.variance, 1e-9 * signal->facts.variance);
        int ends = bl_signal_has_density(signal);
        for (unsigned axis = 0; ends && axis < signal->dimensions; axis++, seen++) {
            for (int n = 0; n < 8; n++) {
                double lag[BL_AXES] = {n * 0.03, n * 0.02, n * 0.05, n * 0.04};
                lag[axis] = (n % 2 ? -1 : 1) * reach * (1 + n * n * 0.01);
                assert_near(signal->functions->covariance(signal->parameters, lag), 0, 0);
                memset(lag, 0, sizeof lag);
                lag[axis] = reach * (0.6 + 0.0125 * n);
                inside += fabs(signal->functions->covariance(signal->parameters, lag));
            }
        }
        if (ends && !(inside > 0))
            fail_msg("%s: has no covariance at 7/10 of its reach of %g", list->text[i], reach);
        bl_signal_free(signal);
    }
    assert_true(seen > 100);
}

// Isotropic is what has a density of the length of the frequency alone; that of the others differs
// between directions by a thousandth of its peak at least. The quadratures are good to 1e-9.
static void test_isotropy_is_stated_where_the_density_has_no_direction(void **state) {
    (void)state;
    static const double directions[][BL_AXES] = {
        {0.6, 0.8, 0, 0}, {0.8, -0.6, 0, 0}, {0, 1, 0, 0}, {2 / 3.0, -1 / 3.0, 2 / 3.0, 0}};
    bl_texts *list = all_texts();
    size_t seen[2] = {0};
    for (size_t i = 0; i < list->count; i++) {
        bl_signal *signal = open_signal(list->text[i]);
        double peak = 0, most = 0, cell = signal->facts.cell > 0 ? signal->facts.cell : 1;
        int directed = signal->dimensions > 1; // all that has one dimension is without one
        directed &= bl_signal_has_density(signal);
        for (double f = 0.1; directed && f < 2.5; f += 0.15) {
            const double along[BL_AXES] = {f / cell};
            double first = signal->functions->density(signal->parameters, along);
            peak = fmax(peak, first);
            for (int d = 0; d < (signal->dimensions > 2 ? 4 : 3); d++) {
                double at[BL_AXES];
                for (int a = 0; a < BL_AXES; a++)
                    at[a] = directions[d][a] * f / cell;
                double other = signal->functions->density(signal->parameters, at);
                peak = fmax(peak, other);
                most = fmax(most, fabs(other - first));
            }
        }
        int isotropic = signal->facts.isotropic == 1;
        if (peak > 0 && (isotropic ? most > 1e-8 * peak : most < 1e-3 * peak))
            fail_msg("%s: states %s, and its density differs by %g of its peak", list->text[i],
                     isotropic ? "isotropy" : "a direction", most / peak);
        seen[isotropic] += peak > 0;
        bl_signal_free(signal);
    }
    assert_true(seen[0] > 30 && seen[1] > 10);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_class_of_continuity_is_the_one_stated),
        cmocka_unit_test(test_hermite_has_one_slope_on_both_sides_of_a_face),
        cmocka_unit_test(test_the_period_is_the_one_stated),
        cmocka_unit_test(test_the_fraction_ends_where_it_is_stated_to),
        cmocka_unit_test(test_mean_and_variance_are_the_ones_stated),
        cmocka_unit_test(test_a_period_shorter_than_the_kernel_has_no_variance),
        cmocka_unit_test(test_impulse_noises_have_the_same_variance_all_over_the_cell),
        cmocka_unit_test(test_lattice_noises_show_their_cell_in_the_variance),
        cmocka_unit_test(test_the_covariance_ends_at_its_reach),
        cmocka_unit_test(test_isotropy_is_stated_where_the_density_has_no_direction),
    };
    return bl_run_tests(tests);
}
