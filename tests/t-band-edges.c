// SPDX-License-Identifier: MIT
//
// The intervals of the edges of a band hold the edges of the closed form, seen through the same
// window and smoothed alike, as often as they say.
//
// Error rate: 1e-4 a count of edges that are missed (3.9 standard deviations of the binomial).
#include "tests/test.h"

#include "noises/noise.h"
#include "score/properties/band_edges.h"
#include "tests/test_signals.h"
#include "tests/texts.h"

enum { DISTANCES = 2 };
static const double below_db[DISTANCES] = {3, 30};

static bl_psd measure(const bl_signal *signal, unsigned dims, size_t averages, uint64_t seed) {
    bl_psd psd;
    bl_message message = {""};
    bl_psd_settings settings = bl_psd_default_settings(dims);
    settings.rate = 8;
    settings.size = dims == 1 ? 512 : 128;
    settings.averages = averages;
    settings.seed = seed;
    settings.threads = 1;
    if (bl_psd_measure(signal, &settings, &psd, &message) != BL_OK)
        fail_msg("%s: %s", signal->text, message.text);
    return psd;
}

// The outermost bins of a density within some dB of its peak, smoothed by a sum of all bins within
// 0.05 of each.
static void true_edges(const bl_psd *psd, const double *density, double below, double edge[2]) {
    double *smooth = calloc(psd->count, sizeof *smooth), peak = 0;
    for (size_t i = 1; i < psd->count; i++) {
        double number = 0;
        for (size_t j = 1; j < psd->count; j++)
            if (fabs((double)j - (double)i) * psd->width[0] < 0.05 + 0.5 * psd->width[0]) {
                smooth[i] += density[j];
                number++;
            }
        smooth[i] /= number;
        peak = fmax(peak, smooth[i]);
    }
    edge[0] = edge[1] = NAN;
    for (size_t i = psd->count; i-- > 1;)
        if (10 * log10(smooth[i] / peak) >= -below) {
            edge[0] = psd->frequency[i];
            edge[1] = isnan(edge[1]) ? edge[0] : edge[1];
        }
    free(smooth);
}

typedef struct tally {
    double trials, missed, width; // width: of all intervals, in bins
} tally;

static void count(const bl_estimate *found, double truth, double bin, tally *t) {
    assert_true(found->level == 0.95);
    assert_true(found->lower <= found->value && found->value <= found->upper);
    t->trials++;
    t->missed += truth < found->lower || truth > found->upper;
    t->width += (found->upper - found->lower) / bin;
}

static tally cover(const bl_signal *signal, unsigned dims, size_t averages, int distance) {
    tally t = {0};
    size_t repeats = bl_test_scaled(40, 10);
    bl_message message = {""};
    for (size_t r = 0; r < repeats; r++) {
        bl_psd psd = measure(signal, dims, averages, 1 + r);
        bl_band_edges edges[DISTANCES];
        double truth[2];
        if (bl_find_band_edges(&psd, below_db, DISTANCES, 0.95, edges, &message) != BL_OK)
            fail_msg("%s", message.text);
        assert_non_null(psd.theory);
        true_edges(&psd, psd.theory, below_db[distance], truth);
        count(&edges[distance].high, truth[1], psd.width[0], &t);
        if (truth[0] > 2 * psd.width[0]) // an edge at frequency 0 is none
            count(&edges[distance].low, truth[0], psd.width[0], &t);
        bl_psd_free(&psd);
    }
    return t;
}

// An interval ends on bins, where the limits of bins on both sides are taken, so that it holds the
// edge more often than each limit does: at most 5 % are missed. Both distances are of one spectrum
// a trial, whence half of the trials count. The widths show that intervals are not vague instead: a
// hundredth of the power at the edge is within some bins, half of it within a quarter cycle.
static void test_intervals_of_edges_hold_those_of_the_closed_forms(void **state) {
    (void)state;
    static const char *const texts[] = {"gnoise", "vnoise", "vgnoise", "vcnoise", "scnoise"};
    static const double widest[DISTANCES] = {16, 8};
    double missed = 0, trials = 0;
    for (size_t n = 0; n < sizeof texts / sizeof *texts; n++) {
        bl_signal *signal = bl_test_open(texts[n], BL_ISA_BEST);
        for (unsigned dims = 1; dims <= 2; dims++)
            for (int d = 0; d < DISTANCES; d++) {
                tally t = cover(signal, dims, dims == 1 ? 64 : 8, d);
                double limit = 0.05 + 3.9 * sqrt(0.05 * 0.95 / t.trials);
                if (t.missed > limit * t.trials || t.width > widest[d] * t.trials)
                    fail_msg("%s in %u dimensions, %g dB: %g of %g missed, %g bins wide", texts[n],
                             dims, below_db[d], t.missed, t.trials, t.width / t.trials);
                missed += t.missed;
                trials += t.trials;
            }
        bl_signal_free(signal);
    }
    assert_less(missed / trials, 0.05 + 3.9 * sqrt(0.05 * 0.95 / (0.5 * trials)));
}

// sinc^4 falls to half of its peak at the f whose sinc is 10^-0.075, and for good below a
// thousandth between the first zero and the first side lobe, which is 26.5 dB down and counts.
static void test_edges_of_a_hat_are_those_of_its_transform(void **state) {
    (void)state;
    bl_signal *hat = bl_test_hat(1);
    bl_psd psd = measure(hat, 1, 4096, 1);
    bl_band_edges edges[DISTANCES];
    double low = 0.1, high = 0.9;
    assert_int_equal(bl_find_band_edges(&psd, below_db, DISTANCES, 0.95, edges, NULL), BL_OK);
    for (int i = 0; i < 60; i++) {
        double f = 0.5 * (low + high), sinc = sin(M_PI * f) / (M_PI * f);
        *(pow(sinc, 4) > pow(10, -0.3) ? &low : &high) = f;
    }
    assert_near(edges[0].high.value, low, 0.05); // the smoothing
    assert_true(edges[1].high.value > 1.3 && edges[1].high.value < 2);
    assert_true(edges[0].low.value < 0.05 && edges[1].low.value < 0.05);
    bl_psd_free(&psd);
    bl_signal_free(hat);
}

// Averages that count as a quarter of their number have limits twice as far from the ratios.
static void test_averages_that_are_alike_widen_the_intervals(void **state) {
    (void)state;
    bl_signal *hat = bl_test_hat(1);
    bl_psd psd = measure(hat, 1, 64, 1);
    bl_band_edges apart[DISTANCES], alike[DISTANCES];
    assert_near(psd.correlation, 1, 0);
    assert_int_equal(bl_find_band_edges(&psd, below_db, 2, 0.95, apart, NULL), BL_OK);
    psd.correlation = 4;
    assert_int_equal(bl_find_band_edges(&psd, below_db, 2, 0.95, alike, NULL), BL_OK);
    for (int d = 0; d < DISTANCES; d++) {
        assert_true(alike[d].high.value == apart[d].high.value);
        assert_true(alike[d].high.lower < apart[d].high.lower);
        assert_true(alike[d].high.upper > apart[d].high.upper);
    }
    bl_psd_free(&psd);
    bl_signal_free(hat);
}

// The spread of one average over others is unknown.
static void test_one_average_has_edges_without_an_interval(void **state) {
    (void)state;
    bl_signal *hat = bl_test_hat(1);
    bl_psd psd = measure(hat, 1, 1, 1);
    bl_band_edges edges[DISTANCES];
    assert_int_equal(bl_find_band_edges(&psd, below_db, DISTANCES, 0.95, edges, NULL), BL_OK);
    assert_true(edges[0].high.level == 0 && edges[0].high.value > 0);
    bl_psd_free(&psd);
    bl_signal_free(hat);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_intervals_of_edges_hold_those_of_the_closed_forms),
        cmocka_unit_test(test_edges_of_a_hat_are_those_of_its_transform),
        cmocka_unit_test(test_averages_that_are_alike_widen_the_intervals),
        cmocka_unit_test(test_one_average_has_edges_without_an_interval),
    };
    return bl_run_tests(tests);
}
