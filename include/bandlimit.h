// SPDX-License-Identifier: MIT
//
// bandlimit for programs: procedural noises and textures, and what can be measured of them.
//
//   1  statuses, messages, structs      6  sampling under a view
//   2  signals                          7  cost against error
//   3  values                           8  figures
//   4  what there is                    9  images
//   5  spectra and verdicts
//
//   bandlimit_message message;
//   bandlimit_signal *noise;
//   bandlimit_spectrum spectrum;
//   BANDLIMIT_INIT(&spectrum);
//   if (bandlimit_open("gnoise:seed=7", &noise, &message) == BANDLIMIT_OK &&
//       bandlimit_spectrum_measure(noise, NULL, &spectrum, &message) == BANDLIMIT_OK)
//       printf("variance %g\n", spectrum.variance.value);
//
//   cc program.c $(pkg-config --cflags --libs bandlimit)
//
// The archive libbandlimit.a needs what it is made of besides: `pkg-config --static --libs`.
//
// This one header is all that a program needs; a noise of the user's own, as a shared object, needs
// bandlimit_plugin.h and nothing else. The command line does the same with the same texts, so that
// `bandlimit help` and `bandlimit show gnoise` explain them too. The library never prints, never
// exits, and keeps no state but tables that are made once.
//
// Units: a coordinate is in the unit of the signal's domain, which is the lattice cell of a noise;
// frequencies are in cycles per unit, never radians. Arrays of places have four coordinates, of
// which a signal of fewer dimensions ignores the last ones. NaN stands for "not known".
//
// Threads: every function may be called from several threads at once, and a signal may be read by
// several at once. What is measured uses as many threads as `threads` says (0: as OpenMP does), and
// its numbers are the same for any number of them, times aside.
#ifndef BANDLIMIT_H
#define BANDLIMIT_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

// --- 1. statuses, messages, structs -------------------------------------------------------------

// How a call ended. The numbers are the exit statuses of the program.
typedef enum bandlimit_status {
    BANDLIMIT_OK = 0,       // done
    BANDLIMIT_FAULT = 2,    // a measurement contradicts itself (Parseval's equation)
    BANDLIMIT_MISMATCH = 3, // inputs that do not fit together, or do not fit in memory
    BANDLIMIT_DEVICE = 4,   // a file, a program, a device or the memory allocator refused
    BANDLIMIT_USAGE = 64    // an unknown word, a value out of its range, a struct of another size
} bandlimit_status;

// One sentence that says what went wrong, where, and what to do. The caller owns it; it is written
// only where a status is not BANDLIMIT_OK, and may be NULL everywhere.
typedef struct bandlimit_message {
    char text[1024];
} bandlimit_message;

// The structs below that begin with `bytes` may grow in a later version. Their owner calls
// BANDLIMIT_INIT before anything else is done with them: it sets `bytes` to the size that this
// header knows, and all else to 0, which means the usual wherever nothing else is said. The library
// refuses another size than its own with BANDLIMIT_USAGE, so that a program and a library of
// different versions notice each other.
#define BANDLIMIT_INIT(object)                                                                     \
    ((void)memset((object), 0, sizeof *(object)), (void)((object)->bytes = sizeof *(object)))

// The version of the library that runs, as "0.1.0"; a constant.
const char *bandlimit_version(void);

// A measured number with its two-sided interval. Never grows.
typedef struct bandlimit_estimate {
    double value, lower, upper;
    double level;   // of the interval: 0.95; 1: exact; 0: there is no interval
    double samples; // independent ones behind it
} bandlimit_estimate;

// What a measurement says about a limit or a claim.
typedef enum bandlimit_verdict {
    BANDLIMIT_PASS,         // the whole interval lies within the limit
    BANDLIMIT_INCONCLUSIVE, // it straddles the limit
    BANDLIMIT_FAIL,         // it lies outside
    BANDLIMIT_NOT_RUN       // there was nothing to measure
} bandlimit_verdict;

// How long a measurement may take, where its settings leave it open.
typedef enum bandlimit_effort {
    BANDLIMIT_NORMAL, // up to a minute or so
    BANDLIMIT_QUICK,  // seconds
    BANDLIMIT_FULL    // a night
} bandlimit_effort;

// --- 2. signals ---------------------------------------------------------------------------------

// Anything with values over space: a noise, a primitive, a texture, an image, the user's own
// function or program. It never changes after it is opened.
typedef struct bandlimit_signal bandlimit_signal;

// Opens a signal by its text:
//
//   gnoise:seed=7,lattice=hash      name and settings; bandlimit_entry_at lists names and keys
//   grain.exr:spacing=0.0625        an image; vol.raw:size=64x64x64 bare samples
//   ./mine.so:noise,seed=3          a function of bandlimit_plugin.h
//   cmd:./mine.py --octaves 3       a program that answers points on a pipe
//
// The caller ends with bandlimit_close. Errors: BANDLIMIT_USAGE for an unknown name, key or word
// (with its column and the nearest one), BANDLIMIT_DEVICE for a file, a program or memory,
// BANDLIMIT_MISMATCH for settings or a file that do not fit.
bandlimit_status bandlimit_open(const char *text, bandlimit_signal **signal,
                                bandlimit_message *message);

// A copy that draws other random numbers, for the caller to close. Errors: BANDLIMIT_MISMATCH for a
// signal without a seed, BANDLIMIT_DEVICE for memory.
bandlimit_status bandlimit_reseed(const bandlimit_signal *signal, uint64_t seed,
                                  bandlimit_signal **copy, bandlimit_message *message);

// Closes a signal that nobody uses any more; NULL is fine.
void bandlimit_close(bandlimit_signal *signal);

// What a signal is able to do and states about itself. Texts live as long as the signal.
typedef struct bandlimit_facts {
    size_t bytes;
    const char *text;    // that opens it again
    const char *name;    // "gnoise", "image", ...
    unsigned dimensions; // 1 to 4
    int has_seed, has_gradient, has_filter, has_colour, has_closed_form;
    double lower, upper;             // hard bound of the values
    const char *bound_proof;         // how it is proved, in words; NULL: there is none
    double mean, variance;           // over places and seeds
    double band_from, band_to;       // the claimed band along an axis, cycles per unit ...
    double leak_db;                  // ... and the share of the variance outside of it, dB
    int continuity;                  // 0 for C0, 1 for C1, ...; -1: discontinuous; -2: not stated
    int is_stationary, is_isotropic; // 1: claims it
    double period[4];                // along each axis, units; 0: none
    double cell;                     // the distance of the planes of its lattice; 0: it has none
    double far;                      // the coordinate beyond which precision is lost
    size_t samples[4];               // of an image, along each axis; 0: has values everywhere
    double spacing[4];               // of these samples, units
} bandlimit_facts;

// Fills the facts. Errors: BANDLIMIT_USAGE for another size.
bandlimit_status bandlimit_facts_of(const bandlimit_signal *signal, bandlimit_facts *facts,
                                    bandlimit_message *message);

// What went wrong while values were asked for, of a signal whose source can fail (a program, an
// image on a disk): NaN says where, this says why. BANDLIMIT_OK if nothing did.
bandlimit_status bandlimit_complaint(const bandlimit_signal *signal, bandlimit_message *message);

// --- 3. values ----------------------------------------------------------------------------------

// NaN and infinite coordinates, and those beyond 2^62, give NaN. `out` is the caller's and apart
// from what is read.

// A row, the fastest way: out[i] is the value at start + i * step, each coordinate computed in
// double as start[a] + (double)i * step[a].
void bandlimit_row(const bandlimit_signal *signal, const double start[4], const double step[4],
                   size_t count, float *out);

// Scattered points: out[i] is the value at (x[i], y[i], z[i], w[i]); an array that the signal's
// dimensions do not reach may be NULL.
void bandlimit_points(const bandlimit_signal *signal, const double *x, const double *y,
                      const double *z, const double *w, size_t count, float *out);

// One value in double throughout, the reference that rows and points are tested against.
double bandlimit_value(const bandlimit_signal *signal, const double at[4]);

// The analytic gradient at one point; the entries past the dimensions are 0. Errors:
// BANDLIMIT_MISMATCH for a signal without one.
bandlimit_status bandlimit_gradient(const bandlimit_signal *signal, const double at[4],
                                    double gradient[4], bandlimit_message *message);

// What one sample sees: the two derivatives of the coordinates, to the next sample on the right and
// to the next one below, and how wide that is along each axis. 0 all over is a point, and infinite
// widths stand for the mean. Never grows.
typedef struct bandlimit_footprint {
    double across[4], down[4]; // units a sample
    double width[4];           // units, 0 to INFINITY
} bandlimit_footprint;

// The footprint of these derivatives, with the widths |across| + |down| along each axis
// (peachey2003, p. 61), which are never too narrow for a box; and the upright one of these widths.
bandlimit_footprint bandlimit_footprint_of(const double across[4], const double down[4]);
bandlimit_footprint bandlimit_footprint_upright(const double width[4]);

// The values as the signal's own key `filter` filters them: out[i] at (x[i], y[i], z[i], w[i]) for
// footprints[i]; arrays as above. Of a signal that cannot filter, the plain values.
void bandlimit_filtered(const bandlimit_signal *signal, const double *x, const double *y,
                        const double *z, const double *w, const bandlimit_footprint *footprints,
                        size_t count, double *out);

// Likewise the linear red, green and blue, three numbers a sample; of a signal without a colour,
// its value thrice.
void bandlimit_colour(const bandlimit_signal *signal, const double *x, const double *y,
                      const double *z, const double *w, const bandlimit_footprint *footprints,
                      size_t count, double *rgb);

// --- 4. what there is ---------------------------------------------------------------------------

typedef enum bandlimit_kind {
    BANDLIMIT_NOISES,     // signals ...
    BANDLIMIT_PRIMITIVES, // ... to be opened ...
    BANDLIMIT_TEXTURES,   // ... by name
    BANDLIMIT_FILTERS,    // kernels: words of the keys that choose one
    BANDLIMIT_VIEWS,      // chapter 6
    BANDLIMIT_METHODS,    // of sampling a view, chapter 6
    BANDLIMIT_TRADES,     // chapter 7
    BANDLIMIT_PROPERTIES, // of the scorecard, chapter 5
    BANDLIMIT_FIGURES     // chapter 8
} bandlimit_kind;

// One thing. Texts are constants; those that a kind does not have are NULL.
typedef struct bandlimit_entry {
    size_t bytes;
    const char *name;    // "gnoise"
    const char *title;   // "gradient noise"
    const char *summary; // one sentence, or the question that it answers
    const char *formula;
    const char *paper;   // key and page: "peachey2003, p. 75"
    unsigned dimensions; // of a signal, by default; else 0
    size_t parameters;   // keys of its text
} bandlimit_entry;

// How many things of a kind there are; 0 for a number that is no kind.
size_t bandlimit_count(bandlimit_kind kind);

// Fills the entry at an index below the count. Errors: BANDLIMIT_USAGE past the end and for another
// size.
bandlimit_status bandlimit_entry_at(bandlimit_kind kind, size_t index, bandlimit_entry *entry,
                                    bandlimit_message *message);

// One key of an entry's text. Texts are constants.
typedef struct bandlimit_parameter {
    size_t bytes;
    const char *key;
    const char *kind;        // "seed", "integer", "real", "choice", "list", "text" or "signal"
    double minimum, maximum; // of an integer, a real, a list
    const char *fallback;    // the default, as text
    const char *unit;        // "" if none
    const char *help;
    const char *const *choices; // the words of a choice, ended by NULL; else NULL
} bandlimit_parameter;

// Fills parameter `number`, from 0, of the entry at an index. Errors as above.
bandlimit_status bandlimit_parameter_at(bandlimit_kind kind, size_t index, size_t number,
                                        bandlimit_parameter *parameter, bandlimit_message *message);

// --- 5. spectra and verdicts --------------------------------------------------------------------

// A measurement averages over independent random places and, where the signal has one, fresh seeds;
// an image is measured on its own samples. Settings that are NULL stand for all the usual ones.
// Results hold arrays, which belong to them: the caller ends with their _free, and they can be
// measured anew after that. After an error there is nothing to free.
// Errors of all: BANDLIMIT_USAGE for a setting out of its range and for another size,
// BANDLIMIT_MISMATCH for what the signal or the memory does not have and for values that are not
// finite, BANDLIMIT_DEVICE for memory and for a source that fails.

typedef enum bandlimit_window {
    BANDLIMIT_BLACKMAN_HARRIS, // 4 terms, side lobes below -92 dB (Harris 1978)
    BANDLIMIT_HANN,
    BANDLIMIT_RECTANGLE
} bandlimit_window;

typedef struct bandlimit_spectrum_settings {
    size_t bytes;
    unsigned dims;   // 1 line (also for 0), 2 slice, 3 volume
    double rate;     // samples per unit; 0: an image's own, or 16, 8, 4 by dims
    size_t size;     // samples along each axis; 0: an image's own, or 2048, 512, 64
    size_t averages; // 0: by the effort, 256, 16, 8 normally
    bandlimit_window window;
    int on_lattice; // 1: along lattice edges, in lattice planes; 0: at random places
    double axis[3]; // of a line, normal of a slice; all 0: x of a line, z of a slice
    uint64_t seed;  // of places and fresh seeds; 0 stands for 1
    double level;   // of the intervals; 0: 0.95
    int threads;
    bandlimit_effort effort;
} bandlimit_spectrum_settings;

typedef struct bandlimit_spectrum {
    size_t bytes;
    unsigned dims; // as measured, like the next three
    double rate;
    size_t size, averages;
    size_t count;                // bins, from frequency 0 to half the rate
    const double *frequency;     // of a bin, cycles per unit; its mean radius in a slice or volume
    const double *measure;       // length, area or volume of the bin: power = psd * measure
    const double *psd;           // value^2 per (cycle per unit)^dims; one-sided along a line
    const double *lower, *upper; // limits of psd
    const double *theory;        // what the closed form gives through this window; NULL: not known
    const double *anisotropy_db; // of the rings of a slice or volume (Ulichney 1987); else NULL
    const double *plane;         // of a slice: the half plane, size rows of size / 2 + 1; else NULL
    double mean;                 // which was removed
    bandlimit_estimate variance;
    double variance_theory; // NaN: not known
    double guard;           // how far the window smears power, cycles per unit
    double parseval_residual;
    void *owned; // the library's
} bandlimit_spectrum;

// The power spectral density with its confidence limits, averaged periodograms (Welch 1967).
// BANDLIMIT_FAULT if Parseval's equation does not hold.
bandlimit_status bandlimit_spectrum_measure(const bandlimit_signal *signal,
                                            const bandlimit_spectrum_settings *settings,
                                            bandlimit_spectrum *spectrum,
                                            bandlimit_message *message);
void bandlimit_spectrum_free(bandlimit_spectrum *spectrum);

// The share of the variance between two frequencies, cycles per unit; `to` may be INFINITY.
bandlimit_estimate bandlimit_spectrum_share(const bandlimit_spectrum *spectrum, double from,
                                            double to);

// A limit on what may lie outside of a band: the caller fills the first four.
typedef struct bandlimit_band_limit {
    size_t bytes;
    double from, to; // cycles per unit; `to` may be INFINITY, and 0 stands for 1
    double limit_db; // allowed outside, dB of the variance; 0 stands for -30
    double guard;    // beyond both edges, not judged, cycles per unit; 0: the band itself is
    double leak_db, lower_db, upper_db; // found outside; -INFINITY: nothing at all
    size_t needed_averages;             // that would settle an inconclusive verdict; 0: not known
    bandlimit_verdict verdict;
} bandlimit_band_limit;

// Judges a spectrum by a limit. BANDLIMIT_MISMATCH where nothing can be judged: a constant signal,
// a band that nothing was measured in or outside of.
bandlimit_status bandlimit_check(const bandlimit_spectrum *spectrum, bandlimit_band_limit *limit,
                                 bandlimit_message *message);

typedef struct bandlimit_autocorrelation {
    size_t bytes;
    size_t count;                             // lags 0, 1, ... samples
    const double *lag;                        // units
    const double *covariance, *lower, *upper; // of the value with itself a lag away
    const double *theory;                     // the closed form; NULL: not known
    double mean;                              // which was removed
    void *owned;                              // the library's
} bandlimit_autocorrelation;

// The autocovariance along the line of the settings, out to the lag `reach`; 0: half the line.
bandlimit_status bandlimit_autocorrelation_measure(const bandlimit_signal *signal,
                                                   const bandlimit_spectrum_settings *settings,
                                                   double reach,
                                                   bandlimit_autocorrelation *autocorrelation,
                                                   bandlimit_message *message);
void bandlimit_autocorrelation_free(bandlimit_autocorrelation *autocorrelation);

typedef struct bandlimit_histogram_settings {
    size_t bytes;
    size_t samples;  // 0: by the effort, 2^20 normally; an image gives all its own
    size_t bins;     // 0: 64
    double from, to; // both 0: the observed range
    uint64_t seed;   // 0 stands for 1
    double level;    // 0: 0.95
    int threads;
    bandlimit_effort effort;
} bandlimit_histogram_settings;

typedef struct bandlimit_histogram {
    size_t bytes;
    size_t samples, outside; // seen, and those outside of the bins
    bandlimit_estimate mean, variance;
    double skewness, kurtosis;           // 0 and 3 for a normal distribution; NaN for a constant
    double minimum, maximum;             // observed ...
    double minimum_at[4], maximum_at[4]; // ... and where
    size_t bins;
    const double *edges;  // bins + 1
    const size_t *counts; // bins
    size_t quantiles;
    const double *quantile_p; // 0.001 to 0.999
    const bandlimit_estimate *quantile;
    void *owned; // the library's
} bandlimit_histogram;

// The distribution of the values.
bandlimit_status bandlimit_histogram_measure(const bandlimit_signal *signal,
                                             const bandlimit_histogram_settings *settings,
                                             bandlimit_histogram *histogram,
                                             bandlimit_message *message);
void bandlimit_histogram_free(bandlimit_histogram *histogram);

typedef struct bandlimit_score_settings {
    size_t bytes;
    double alpha;            // that any failure of a correct signal shows by chance; 0: 1e-6
    const char *const *only; // names of properties, ended by NULL; NULL: all
    int strict;    // 1: missing an ideal that the signal does not claim counts in the verdict
    uint64_t seed; // 0 stands for 1
    double level;  // 0: 0.95
    int threads;
    bandlimit_effort effort;
} bandlimit_score_settings;

typedef struct bandlimit_score {
    size_t bytes;
    size_t count;              // properties
    bandlimit_verdict verdict; // the worst; see `strict`
    void *owned;               // the library's
} bandlimit_score;

typedef struct bandlimit_property {
    size_t bytes;
    const char *name;
    bandlimit_verdict verdict;
    int against_claim;  // 1: judged by what the signal claims, 0: by the ideal
    const char *cell;   // in short: "C1", "-31.2 dB"
    const char *reason; // one sentence: what was found, against what it was judged
    size_t numbers;
} bandlimit_property;

// The scorecard of an ideal noise (peachey2003, p. 68): repeatable, of a known range, band-limited,
// without periods, stationary, isotropic, and more. Times of the property `cost` are disturbed by
// whatever else runs.
bandlimit_status bandlimit_score_measure(const bandlimit_signal *signal,
                                         const bandlimit_score_settings *settings,
                                         bandlimit_score *score, bandlimit_message *message);
// Fills one property, whose texts live as long as the score. Errors: BANDLIMIT_USAGE past the end.
bandlimit_status bandlimit_property_at(const bandlimit_score *score, size_t index,
                                       bandlimit_property *property, bandlimit_message *message);
// A number of a property; its name is a constant with the unit in it, NULL past the end.
const char *bandlimit_property_number(const bandlimit_score *score, size_t index, size_t number,
                                      bandlimit_estimate *estimate);
void bandlimit_score_free(bandlimit_score *score);

// --- 6. sampling under a view -------------------------------------------------------------------

// A view says what the pixels of an image see of a texture: "flat", "plane:height=1,fov=60". A
// method says how a pixel is sampled: "point", "supersample:n=4,pattern=jitter", or a word of the
// texture's own key `filter`. t runs downwards in the image. Errors as in chapter 5.
typedef struct bandlimit_view_settings {
    size_t bytes;
    const char *view;           // NULL: "flat", and "plane" for advice
    size_t width, height;       // pixels; 0: 128, or 64 of a quick one
    const char *const *methods; // texts ...
    size_t method_count;        // ... and how many; 0: the signal's own and the usual ones
    int gaussian;               // the pixel: 0 a box, 1 a Gaussian of half a pixel
    double tolerance;           // of advice: of the luminance; 0: 1/255 ...
    int largest;                // ... of the worst pixel, or (0) of the root mean square
    const char *cache;          // folder of converged references; NULL: none is kept
    uint64_t seed;              // 0 stands for 1
    int threads;
    bandlimit_effort effort;
} bandlimit_view_settings;

typedef struct bandlimit_alias {
    size_t bytes;
    size_t count; // methods
    size_t width, height;
    double seen;             // share of the pixels that see the signal
    const double *reference; // the converged image: rows of pixels of linear red, green, blue
    double reference_error;  // its root mean square error
    void *owned;             // the library's
} bandlimit_alias;

// What one method leaves. Energies are squares of the luminance.
typedef struct bandlimit_alias_row {
    size_t bytes;
    const char *method;
    bandlimit_estimate alias; // energy that folds into the image
    bandlimit_estimate blur;  // energy that is missing within
    bandlimit_estimate mse, ssim, flicker;
    double psnr_db, max_error;
    double predicted_alias, predicted_blur; // of a stationary signal seen flat; NaN: none
    double samples;                         // of the signal, a pixel
    double ns, ns_lowest, ns_highest;       // of a pixel
    const double *image;                    // as the reference
} bandlimit_alias_row;

// Alias, blur, error and cost of methods side by side, against a converged reference.
bandlimit_status bandlimit_alias_measure(const bandlimit_signal *signal,
                                         const bandlimit_view_settings *settings,
                                         bandlimit_alias *alias, bandlimit_message *message);
// Fills one row, whose texts and image live as long as the result.
bandlimit_status bandlimit_alias_row_at(const bandlimit_alias *alias, size_t index,
                                        bandlimit_alias_row *row, bandlimit_message *message);
void bandlimit_alias_free(bandlimit_alias *alias);

typedef struct bandlimit_advice {
    size_t bytes;
    bandlimit_verdict verdict; // pass: `method` is within the tolerance; fail: none is
    const char *method;        // the cheapest that is within; else the one of the least error
    bandlimit_estimate error;  // of it
    double ns;                 // of a pixel
    const char *cheaper;       // the next cheaper one; NULL: there is none
    bandlimit_estimate cheaper_error;
    double cheaper_ns;
    double least_width, most_width; // of the samples that the view takes, units
    unsigned octaves, octaves_seen; // of a sum of octaves; 0 of any other signal
    void *owned;                    // the library's
} bandlimit_advice;

// The cheapest way to sample a signal under a view within a tolerance.
bandlimit_status bandlimit_advise(const bandlimit_signal *signal,
                                  const bandlimit_view_settings *settings, bandlimit_advice *advice,
                                  bandlimit_message *message);
void bandlimit_advice_free(bandlimit_advice *advice);

// --- 7. cost against error ----------------------------------------------------------------------

typedef struct bandlimit_trade_settings {
    size_t bytes;
    const char *view; // of textures; NULL: the trade's own
    uint64_t seed;    // 0 stands for 1
    int threads;
    bandlimit_effort effort;
} bandlimit_trade_settings;

typedef struct bandlimit_trade {
    size_t bytes;
    size_t count;                        // alternatives
    const char *error_name, *error_unit; // constants, like the next
    const char *sample;                  // what is timed
    void *owned;                         // the library's
} bandlimit_trade;

typedef struct bandlimit_alternative {
    size_t bytes;
    const char *name;
    bandlimit_estimate error;         // 0: exact
    double largest;                   // the largest error seen; NaN: not looked for
    double ns, ns_lowest, ns_highest; // a sample: the median and the quarters
    int is_on_front;                  // no other is as cheap and as good
} bandlimit_alternative;

// Every alternative of one choice (the name of a trade) for a signal, with its error and its time;
// NULL for the trades that have no signal. Errors: BANDLIMIT_USAGE for an unknown trade,
// BANDLIMIT_MISMATCH where the signal has no such choice, and those of chapter 5.
bandlimit_status bandlimit_trade_measure(const bandlimit_signal *signal, const char *name,
                                         const bandlimit_trade_settings *settings,
                                         bandlimit_trade *trade, bandlimit_message *message);
// Fills one alternative, whose name lives as long as the trade.
bandlimit_status bandlimit_alternative_at(const bandlimit_trade *trade, size_t index,
                                          bandlimit_alternative *alternative,
                                          bandlimit_message *message);
void bandlimit_trade_free(bandlimit_trade *trade);

// --- 8. figures ---------------------------------------------------------------------------------

typedef struct bandlimit_reproduce_settings {
    size_t bytes;
    const char *folder; // NULL: "out"; made if missing
    int pdf;            // 1: a PDF of every plot too
    uint64_t seed;      // 0 stands for 1
    int threads;
    bandlimit_effort effort;
    // Optional: called before each step, from the calling thread, with the figures done so far.
    void (*progress)(void *user, size_t done, size_t total, const char *figure, const char *step);
    void *user;
} bandlimit_reproduce_settings;

typedef struct bandlimit_reproduction {
    size_t bytes;
    size_t count;              // claims, of all figures in their order
    bandlimit_verdict verdict; // the worst of our own claims; one of a paper fails nothing
    const char *page;          // path of index.html
    double seconds;
    void *owned; // the library's
} bandlimit_reproduction;

typedef struct bandlimit_figure_claim {
    size_t bytes;
    const char *figure;   // the name
    const char *sentence; // what is claimed
    const char *source;   // "peachey2003, p. 72", or "bandlimit" for our own
    const char *unit;
    double expected_lower, expected_upper; // -INFINITY, INFINITY: open
    bandlimit_estimate measured;
    bandlimit_verdict verdict;
} bandlimit_figure_claim;

// Measures, draws and judges the figures named (count 0: all), each in a folder of its own with its
// data, plots and images, and writes index.html. Runs gnuplot. Errors: BANDLIMIT_USAGE for an
// unknown name, BANDLIMIT_DEVICE for files and gnuplot, and those of chapter 5.
bandlimit_status bandlimit_reproduce(const char *const *names, size_t count,
                                     const bandlimit_reproduce_settings *settings,
                                     bandlimit_reproduction *reproduction,
                                     bandlimit_message *message);
// Fills one claim, whose texts live as long as the reproduction.
bandlimit_status bandlimit_figure_claim_at(const bandlimit_reproduction *reproduction, size_t index,
                                           bandlimit_figure_claim *claim,
                                           bandlimit_message *message);
void bandlimit_reproduction_free(bandlimit_reproduction *reproduction);

// --- 9. images ----------------------------------------------------------------------------------

// These load OpenImageIO when the first of them is called, as opening an image does; where it is
// not installed they end with BANDLIMIT_DEVICE.

typedef struct bandlimit_image {
    size_t bytes;
    size_t width, height;
    size_t channels;     // 1 grey (also for 0), 3 colour; 2 or 4 numbers, not in PNG
    const float *values; // height rows of width pixels of channels values; row 0 is the top
    double spacing;      // units between pixels; 0: not stated
    double black, white; // PNG: values shown as 0 and as full scale; both 0: the finite range
    unsigned bits;       // PNG: 8 (also for 0) or 16
    int srgb;            // PNG: 1: values are linear light, codes follow the curve of sRGB
    void *owned;         // the library's, of an image that was read
} bandlimit_image;

// Writes .exr or .tif as 32-bit floats, .png as codes proportional to the values, by the ending of
// the name. The file appears whole or not at all. Errors: BANDLIMIT_USAGE for another ending, size
// or depth; BANDLIMIT_DEVICE for the file.
bandlimit_status bandlimit_image_write(const char *path, const bandlimit_image *image,
                                       bandlimit_message *message);

// Reads one channel, by its name or index (NULL: the first), of any format that OpenImageIO knows;
// floats are as stored, integers are divided by their full scale. The caller ends with
// bandlimit_image_free. Errors: BANDLIMIT_DEVICE for the file and memory, BANDLIMIT_USAGE for the
// channel, BANDLIMIT_MISMATCH for what is not one plane of pixels.
bandlimit_status bandlimit_image_read(const char *path, const char *channel, bandlimit_image *image,
                                      bandlimit_message *message);
void bandlimit_image_free(bandlimit_image *image);

#ifdef __cplusplus
}
#endif

#endif
