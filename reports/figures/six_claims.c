// SPDX-License-Identifier: MIT
//
// What the text says of the six spectra, with its loose words made definite:
//   significant   more than 1 % of the variance
//   most          more than half of the variance
//   low, high     below 0.3 and above 0.7 cycles per cell, the ends of gnoise's own band
//   similar       within 3 dB of each other's share in every octave below 1
//   spread widely no octave holds more than half of the variance
//   rising from DC, falling: mean densities at 0-0.05, 0.15-0.25 and 0.45-0.55 cycles per cell
#include <math.h>

#include "reports/figures/six_spectra.h"

static const double significant = 0.01, most = 0.5, similar_db = 3;
static const char share_unit[] = "of the variance";

static const char value_section[] = "peachey2003, Value Noise";
static const char gradient_section[] = "peachey2003, Gradient Noise";
static const char hermite_section[] = "peachey2003, Value-Gradient Noise";
static const char lattice_section[] = "peachey2003, Lattice Convolution Noise";
static const char sparse_section[] = "peachey2003, Sparse Convolution Noise";

static void claim(bl_run *run, const char *source, const char *sentence, const char *reading,
                  const char *unit, double lower, double upper, bl_estimate measured) {
    bl_make_claim(run, source, sentence, reading, unit, lower, upper, measured, "averages");
}

static const char *reading_of(bl_run *run, int noise, int reading) {
    return bl_run_text(run, "%s, %s", bl_six_names[noise], bl_reading_words[reading]);
}

// A claim about the share of one noise's variance in one band, in all readings.
static void claim_share(bl_run *run, const bl_six_spectra *spectra, int noise, double from,
                        double to, double lower, double upper, const char *source,
                        const char *sentence) {
    for (int r = 0; r < BL_READINGS; r++)
        claim(run, source, sentence, reading_of(run, noise, r), share_unit, lower, upper,
              bl_psd_share(spectra->psd[r][noise], from, to));
}

static void claim_value_and_gradient(bl_run *run, const bl_six_spectra *spectra) {
    static const char high[] =
        "Gradient noise has more energy above 0.7 than value noise: its share minus that of "
        "vnoise.";
    static const char low[] =
        "Gradient noise has less energy below 0.3 than value noise: its share minus that of "
        "vnoise.";
    claim_share(run, spectra, BL_VNOISE, 1, INFINITY, 0, significant, value_section,
                "Value noise has no significant energy (no more than 1 %) above frequency 1.");
    claim_share(run, spectra, BL_GNOISE, 0.3, 0.7, most, 1, gradient_section,
                "Most of the energy of gradient noise (over half) lies between 0.3 and 0.7.");
    for (int r = 0; r < BL_READINGS; r++) {
        const bl_psd *g = spectra->psd[r][BL_GNOISE], *v = spectra->psd[r][BL_VNOISE];
        claim(run, gradient_section, high, bl_reading_words[r], share_unit, 0, 1,
              bl_difference(bl_psd_share(g, 0.7, INFINITY), bl_psd_share(v, 0.7, INFINITY)));
    }
    for (int r = 0; r < BL_READINGS; r++) {
        const bl_psd *g = spectra->psd[r][BL_GNOISE], *v = spectra->psd[r][BL_VNOISE];
        claim(run, gradient_section, low, bl_reading_words[r], share_unit, -1, 0,
              bl_difference(bl_psd_share(g, 0, 0.3), bl_psd_share(v, 0, 0.3)));
    }
}

// --- Hermite ------------------------------------------------------------------------------------

// The mean density over two bands of one width, the second against the first, in dB. In a slice and
// a volume it is the power by radius, as the text's spectra are curves over one frequency.
static bl_estimate slope_db(const bl_psd *psd, double low_from, double low_to, double high_from,
                            double high_to) {
    bl_estimate ratio =
        bl_ratio_db(bl_psd_share(psd, high_from, high_to), bl_psd_share(psd, low_from, low_to));
    double widths = 10 * log10((low_to - low_from) / (high_to - high_from));
    ratio.value += widths;
    ratio.lower += widths;
    ratio.upper += widths;
    return ratio;
}

static const double octaves[] = {0, 0.125, 0.25, 0.5, 1};
enum { OCTAVES = 4 };

// The share of the fullest octave; the lowest band reaches down to 0.
static bl_estimate fullest_octave(const bl_psd *psd) {
    bl_estimate fullest = bl_psd_share(psd, octaves[0], octaves[1]);
    for (int k = 1; k < OCTAVES; k++) {
        bl_estimate share = bl_psd_share(psd, octaves[k], octaves[k + 1]);
        if (share.value > fullest.value)
            fullest = share;
    }
    return fullest;
}

static void claim_hermite(bl_run *run, const bl_six_spectra *spectra) {
    for (int r = 0; r < BL_READINGS; r++)
        claim(run, hermite_section,
              "The spectrum of Ward's Hermite noise rises from DC to about 0.2: the density at "
              "0.15-0.25 over that at 0-0.05.",
              reading_of(run, BL_HERMITE, r), "dB", 0, INFINITY,
              slope_db(spectra->psd[r][BL_HERMITE], 0, 0.05, 0.15, 0.25));
    for (int r = 0; r < BL_READINGS; r++)
        claim(run, hermite_section,
              "Beyond 0.2 the spectrum of Hermite noise falls: the density at 0.45-0.55 over that "
              "at 0.15-0.25.",
              reading_of(run, BL_HERMITE, r), "dB", -INFINITY, 0,
              slope_db(spectra->psd[r][BL_HERMITE], 0.15, 0.25, 0.45, 0.55));
    claim_share(
        run, spectra, BL_HERMITE, 1, INFINITY, 0, significant, hermite_section,
        "The spectrum of Hermite noise has fallen to 0 at frequency 1: at most 1 % lies above.");
    for (int r = 0; r < BL_READINGS; r++)
        claim(
            run, hermite_section,
            "The power of Hermite noise is spread widely: the fullest octave holds less than half.",
            reading_of(run, BL_HERMITE, r), share_unit, 0, most,
            fullest_octave(spectra->psd[r][BL_HERMITE]));
    claim_share(run, spectra, BL_HERMITE, 0, 0.5, most, 1, hermite_section,
                "The dominant frequencies of Hermite noise are low: over half of its energy lies "
                "below 0.5.");
}

// --- the convolution noises ---------------------------------------------------------------------

static bl_estimate size_of(bl_estimate e) {
    double lower = fmin(fabs(e.lower), fabs(e.upper)), upper = fmax(fabs(e.lower), fabs(e.upper));
    if (e.lower < 0 && e.upper > 0)
        lower = 0;
    return (bl_estimate){fabs(e.value), lower, upper, e.level, e.samples};
}

// The largest distance in dB between the shares of two noises in the octaves below 1. The limits
// are those of all octaves together.
static bl_estimate largest_distance_db(const bl_psd *a, const bl_psd *b) {
    bl_estimate largest = {0, 0, 0, a->settings.level, 0};
    for (int k = 0; k < OCTAVES; k++) {
        bl_estimate d = size_of(bl_ratio_db(bl_psd_share(a, octaves[k], octaves[k + 1]),
                                            bl_psd_share(b, octaves[k], octaves[k + 1])));
        largest.value = fmax(largest.value, d.value);
        largest.lower = fmax(largest.lower, d.lower);
        largest.upper = fmax(largest.upper, d.upper);
        largest.samples = d.samples;
    }
    return largest;
}

static void claim_similar(bl_run *run, const bl_six_spectra *spectra, int noise, const char *source,
                          const char *sentence) {
    for (int r = 0; r < BL_READINGS; r++)
        claim(run, source, sentence, reading_of(run, noise, r), "dB", 0, similar_db,
              largest_distance_db(spectra->psd[r][noise], spectra->psd[r][BL_VNOISE]));
}

// --- our own claims -----------------------------------------------------------------------------

enum { TEST_BANDS = 8 };

// The largest distance between measured and closed-form shares of eight bands, in standard errors.
static bl_estimate largest_deviation(const bl_psd *psd) {
    static const double edges[TEST_BANDS + 1] = {0, 0.125, 0.25, 0.375, 0.5, 0.7, 1, 1.4, 2};
    double averages = (double)psd->settings.averages;
    double quantile = bl_student_quantile(0.5 + psd->settings.level / 2, averages - 1);
    double largest = 0;
    for (int k = 0; k < TEST_BANDS; k++) {
        bl_estimate off = bl_psd_share_off(psd, edges[k], edges[k + 1]);
        bl_estimate share = bl_psd_share(psd, edges[k], edges[k + 1]);
        double error = (share.upper - share.lower) / (2 * quantile);
        largest = fmax(largest, fabs(off.value) / error);
    }
    return bl_observed(largest, averages);
}

static void claim_our_own(bl_run *run, const bl_six_spectra *spectra) {
    // One chance in a thousand that any of all bands of all spectra with a closed form strays.
    const double error_budget = 1e-3, tests = TEST_BANDS * BL_SIX * (BL_READINGS - 1);
    for (int r = 0; r < BL_READINGS; r++)
        for (int i = 0; i < BL_SIX; i++) {
            const bl_psd *psd = spectra->psd[r][i];
            if (!psd->theory)
                continue;
            double limit = bl_student_quantile(1 - error_budget / (2 * tests),
                                               (double)psd->settings.averages - 1);
            claim(run, "bandlimit",
                  "The measured spectrum agrees with the closed form: the largest deviation of its "
                  "share in eight bands.",
                  reading_of(run, i, r), "standard errors", 0, limit, largest_deviation(psd));
        }
    double residual = 0;
    for (int r = 0; r < BL_READINGS; r++)
        for (int i = 0; i < BL_SIX; i++)
            residual = fmax(residual, spectra->psd[r][i]->parseval_residual);
    bl_make_claim(run, "bandlimit",
                  "Every spectrum sums to its windowed variance, that of the samples times the "
                  "window (Parseval; the variances in the files are without a window).",
                  "largest relative residual of all averages", "", 0, 1e-5,
                  bl_observed(residual, BL_READINGS * BL_SIX), "spectra");
}

void bl_six_spectra_claim(bl_run *run, const bl_six_spectra *spectra) {
    claim_value_and_gradient(run, spectra);
    claim_hermite(run, spectra);
    claim_similar(run, spectra, BL_VCNOISE, lattice_section,
                  "The spectrum of lattice convolution noise is like that of other value noises: "
                  "the largest distance from vnoise in an octave below 1.");
    claim_similar(run, spectra, BL_SCNOISE, sparse_section,
                  "The spectrum of sparse convolution noise is like that of other value noises: "
                  "the largest distance from vnoise in an octave below 1.");
    claim_our_own(run, spectra);
}
