// SPDX-License-Identifier: MIT
//
// A program of a user's, C and C++ alike, that knows nothing but the installed files: it calls
// every function of bandlimit.h once and says the first thing that is not as the header states. The
// only word on the command line is a folder for its files.
#include <bandlimit.h>
#include <bandlimit_plugin.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bandlimit_message message;

#define HOLDS(condition)                                                                           \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            fprintf(stderr, "line %d: %s does not hold; %s\n", __LINE__, #condition,               \
                    message.text);                                                                 \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)

static bandlimit_signal *open_signal(const char *text) {
    bandlimit_signal *signal = NULL;
    HOLDS(bandlimit_open(text, &signal, &message) == BANDLIMIT_OK);
    return signal;
}

static void refuse(void) {
    bandlimit_signal *signal = NULL;
    bandlimit_facts facts;
    HOLDS(strchr(bandlimit_version(), '.') != NULL);
    HOLDS(bandlimit_open("gnois", &signal, &message) == BANDLIMIT_USAGE && !signal);
    HOLDS(strstr(message.text, "gnoise") != NULL);
    HOLDS(bandlimit_open("gnois", &signal, NULL) == BANDLIMIT_USAGE);
    HOLDS(bandlimit_open("/nowhere/x.exr", &signal, &message) == BANDLIMIT_DEVICE);
    signal = open_signal("gnoise");
    BANDLIMIT_INIT(&facts);
    facts.bytes += 8;
    HOLDS(bandlimit_facts_of(signal, &facts, &message) == BANDLIMIT_USAGE);
    HOLDS(strstr(message.text, "bandlimit_facts") && strstr(message.text, "BANDLIMIT_INIT"));
    bandlimit_close(signal);
    bandlimit_close(NULL);
}

static void sample(void) {
    bandlimit_signal *noise = open_signal("gnoise:seed=7"), *other = NULL;
    bandlimit_facts facts;
    const double start[4] = {0.25, 0.5, 0.75, 0}, step[4] = {0.5, 0, 0, 0};
    const double x[2] = {0.25, 0.75}, y[2] = {0.5, 0.5}, z[2] = {0.75, 0.75};
    float row[2], points[2];
    double slope[4];
    BANDLIMIT_INIT(&facts);
    HOLDS(bandlimit_facts_of(noise, &facts, &message) == BANDLIMIT_OK);
    HOLDS(facts.dimensions == 3 && facts.has_seed && facts.has_gradient && facts.has_closed_form);
    HOLDS(strcmp(facts.text, "gnoise:seed=7") == 0 && strcmp(facts.name, "gnoise") == 0);
    HOLDS(facts.lower < 0 && facts.upper > 0 && facts.bound_proof && facts.samples[0] == 0);
    bandlimit_row(noise, start, step, 2, row);
    bandlimit_points(noise, x, y, z, NULL, 2, points);
    HOLDS(fabsf(row[0] - points[0]) < 1e-6f && fabsf(row[1] - points[1]) < 1e-6f);
    HOLDS(fabs(bandlimit_value(noise, start) - (double)row[0]) < 1e-6);
    HOLDS(bandlimit_gradient(noise, start, slope, &message) == BANDLIMIT_OK && slope[3] == 0);
    HOLDS(bandlimit_reseed(noise, 8, &other, &message) == BANDLIMIT_OK);
    HOLDS(bandlimit_value(other, start) != bandlimit_value(noise, start));
    HOLDS(bandlimit_complaint(noise, &message) == BANDLIMIT_OK);
    bandlimit_close(other);
    bandlimit_close(noise);
    noise = open_signal("step");
    HOLDS(bandlimit_reseed(noise, 8, &other, &message) == BANDLIMIT_MISMATCH);
    bandlimit_close(noise);
}

// A checkerboard of black and white: its mean is a half, and its point is a colour.
static void filter(void) {
    bandlimit_signal *board = open_signal("checkerboard:filter=exact");
    const double x[2] = {0.3, 0.3}, y[2] = {0.3, 0.3};
    const double across[4] = {0, 0, 0, 0}, down[4] = {0, 0, 0, 0};
    const double wide[4] = {INFINITY, INFINITY, INFINITY, INFINITY};
    const bandlimit_footprint footprints[2] = {bandlimit_footprint_of(across, down),
                                               bandlimit_footprint_upright(wide)};
    double values[2], rgb[6];
    bandlimit_filtered(board, x, y, NULL, NULL, footprints, 2, values);
    bandlimit_colour(board, x, y, NULL, NULL, footprints, 2, rgb);
    HOLDS(values[0] != values[1] && isfinite(values[1]));
    HOLDS(isfinite(rgb[0]) && rgb[0] != rgb[3]);
    bandlimit_close(board);
}

static void list(void) {
    bandlimit_entry entry;
    bandlimit_parameter parameter;
    size_t parameters = 0;
    BANDLIMIT_INIT(&entry);
    BANDLIMIT_INIT(&parameter);
    for (int kind = BANDLIMIT_NOISES; kind <= BANDLIMIT_FIGURES; kind++) {
        const bandlimit_kind which = (bandlimit_kind)kind;
        HOLDS(bandlimit_count(which) > 2);
        for (size_t i = 0; i < bandlimit_count(which); i++) {
            HOLDS(bandlimit_entry_at(which, i, &entry, &message) == BANDLIMIT_OK);
            HOLDS(entry.name && entry.title && entry.summary);
            for (size_t p = 0; p < entry.parameters; p++, parameters++) {
                HOLDS(bandlimit_parameter_at(which, i, p, &parameter, &message) == BANDLIMIT_OK);
                HOLDS(parameter.key && parameter.kind && parameter.help && parameter.fallback);
                HOLDS(!parameter.choices == (strcmp(parameter.kind, "choice") != 0));
            }
        }
        HOLDS(bandlimit_entry_at(which, bandlimit_count(which), &entry, &message) ==
              BANDLIMIT_USAGE);
    }
    HOLDS(parameters > 50 && bandlimit_count((bandlimit_kind)99) == 0);
}

static void measure(const bandlimit_signal *noise) {
    bandlimit_spectrum_settings settings;
    bandlimit_spectrum spectrum;
    bandlimit_band_limit limit;
    bandlimit_autocorrelation correlation;
    bandlimit_histogram_settings of_histogram;
    bandlimit_histogram histogram;
    BANDLIMIT_INIT(&settings);
    BANDLIMIT_INIT(&spectrum);
    BANDLIMIT_INIT(&limit);
    BANDLIMIT_INIT(&correlation);
    BANDLIMIT_INIT(&of_histogram);
    BANDLIMIT_INIT(&histogram);
    settings.effort = of_histogram.effort = BANDLIMIT_QUICK;
    for (settings.dims = 1; settings.dims <= 3; settings.dims++) {
        settings.size = settings.dims == 3 ? 64 : 128;
        HOLDS(bandlimit_spectrum_measure(noise, &settings, &spectrum, &message) == BANDLIMIT_OK);
        HOLDS(spectrum.dims == settings.dims && spectrum.size == settings.size);
        HOLDS(spectrum.variance.lower < spectrum.variance.value && spectrum.theory);
        HOLDS((spectrum.plane != NULL) == (settings.dims == 2));
        const bandlimit_estimate share = bandlimit_spectrum_share(&spectrum, 0, INFINITY);
        HOLDS(fabs(share.value - 1) < 1e-6);
        limit.limit_db = -2;
        limit.to = 1.25;
        HOLDS(bandlimit_check(&spectrum, &limit, &message) == BANDLIMIT_OK);
        HOLDS(limit.leak_db < 0 && limit.verdict == BANDLIMIT_PASS);
        bandlimit_spectrum_free(&spectrum);
        HOLDS(!spectrum.owned && spectrum.bytes == sizeof spectrum);
    }
    HOLDS(bandlimit_check(&spectrum, &limit, &message) == BANDLIMIT_USAGE); // of no spectrum
    HOLDS(bandlimit_spectrum_measure(noise, &settings, &spectrum, &message) == BANDLIMIT_USAGE);
    settings.bytes--;
    HOLDS(bandlimit_spectrum_measure(noise, &settings, &spectrum, &message) == BANDLIMIT_USAGE);
    bandlimit_spectrum_free(&spectrum); // nothing was measured: nothing to free
    BANDLIMIT_INIT(&settings);
    settings.effort = BANDLIMIT_QUICK;
    HOLDS(bandlimit_autocorrelation_measure(noise, &settings, 2, &correlation, &message) ==
          BANDLIMIT_OK);
    HOLDS(correlation.lower[0] < correlation.covariance[0] && correlation.theory);
    bandlimit_autocorrelation_free(&correlation);
    HOLDS(bandlimit_histogram_measure(noise, &of_histogram, &histogram, &message) == BANDLIMIT_OK);
    HOLDS(histogram.bins == 64 && histogram.quantiles == 9 && histogram.samples == 65536);
    HOLDS(histogram.quantile[4].lower <= histogram.quantile[4].value);
    HOLDS(histogram.edges[0] < histogram.edges[64] && histogram.kurtosis > 1);
    bandlimit_histogram_free(&histogram);
}

static void judge(const bandlimit_signal *noise) {
    static const char *const only[] = {"range", "gradient", NULL}, *const wrong[] = {"rang", NULL};
    bandlimit_score_settings settings;
    bandlimit_score score;
    bandlimit_property property;
    bandlimit_estimate estimate;
    size_t run = 0;
    BANDLIMIT_INIT(&settings);
    BANDLIMIT_INIT(&score);
    BANDLIMIT_INIT(&property);
    settings.effort = BANDLIMIT_QUICK;
    settings.only = wrong;
    HOLDS(bandlimit_score_measure(noise, &settings, &score, &message) == BANDLIMIT_USAGE);
    settings.only = only;
    HOLDS(bandlimit_score_measure(noise, &settings, &score, &message) == BANDLIMIT_OK);
    HOLDS(score.verdict == BANDLIMIT_PASS && score.count == bandlimit_count(BANDLIMIT_PROPERTIES));
    for (size_t i = 0; i < score.count; i++) {
        HOLDS(bandlimit_property_at(&score, i, &property, &message) == BANDLIMIT_OK);
        run += property.verdict == BANDLIMIT_PASS;
        for (size_t k = 0; k < property.numbers; k++)
            HOLDS(bandlimit_property_number(&score, i, k, &estimate) != NULL);
        HOLDS(!bandlimit_property_number(&score, i, property.numbers, &estimate));
    }
    HOLDS(run == 2);
    bandlimit_score_free(&score);
}

static void look(void) {
    static const char *const methods[] = {"point", "exact"};
    bandlimit_signal *board = open_signal("checkerboard");
    bandlimit_view_settings settings;
    bandlimit_alias alias;
    bandlimit_alias_row row;
    bandlimit_advice advice;
    BANDLIMIT_INIT(&settings);
    BANDLIMIT_INIT(&alias);
    BANDLIMIT_INIT(&row);
    BANDLIMIT_INIT(&advice);
    settings.effort = BANDLIMIT_QUICK;
    settings.width = settings.height = 16;
    settings.methods = methods;
    settings.method_count = 2;
    HOLDS(bandlimit_alias_measure(board, &settings, &alias, &message) == BANDLIMIT_OK);
    HOLDS(alias.count == 2 && alias.width == 16 && alias.seen == 1 && alias.reference);
    for (size_t i = 0; i < 2; i++) {
        HOLDS(bandlimit_alias_row_at(&alias, i, &row, &message) == BANDLIMIT_OK);
        HOLDS(strcmp(row.method, methods[i]) == 0 && row.image && row.mse.value >= 0);
    }
    HOLDS(bandlimit_alias_row_at(&alias, 2, &row, &message) == BANDLIMIT_USAGE);
    bandlimit_alias_free(&alias);
    settings.tolerance = 0.5;
    HOLDS(bandlimit_advise(board, &settings, &advice, &message) == BANDLIMIT_OK);
    HOLDS(advice.verdict == BANDLIMIT_PASS && advice.method && advice.ns > 0);
    bandlimit_advice_free(&advice);
    bandlimit_close(board);
}

static void trade(void) {
    bandlimit_signal *noise = open_signal("bias");
    bandlimit_trade_settings settings;
    bandlimit_trade trade;
    bandlimit_alternative alternative;
    BANDLIMIT_INIT(&settings);
    BANDLIMIT_INIT(&trade);
    BANDLIMIT_INIT(&alternative);
    settings.effort = BANDLIMIT_QUICK;
    HOLDS(bandlimit_trade_measure(noise, "nothing", &settings, &trade, &message) ==
          BANDLIMIT_USAGE);
    HOLDS(bandlimit_trade_measure(noise, "octaves", &settings, &trade, &message) ==
          BANDLIMIT_MISMATCH);
    HOLDS(bandlimit_trade_measure(noise, "curve-form", &settings, &trade, &message) ==
          BANDLIMIT_OK);
    HOLDS(trade.count > 1 && trade.error_name && trade.sample);
    HOLDS(bandlimit_alternative_at(&trade, 0, &alternative, &message) == BANDLIMIT_OK);
    HOLDS(alternative.name && alternative.ns > 0);
    bandlimit_trade_free(&trade);
    bandlimit_close(noise);
}

static void count_step(void *user, size_t done, size_t total, const char *figure,
                       const char *step) {
    (void)step;
    *(int *)user += done < total && figure;
}

static void reproduce(const char *folder) {
    static const char *const names[] = {"peachey-2.9"};
    bandlimit_reproduce_settings settings;
    bandlimit_reproduction reproduction;
    bandlimit_figure_claim claim;
    int steps = 0;
    BANDLIMIT_INIT(&settings);
    BANDLIMIT_INIT(&reproduction);
    BANDLIMIT_INIT(&claim);
    settings.folder = folder;
    settings.effort = BANDLIMIT_QUICK;
    settings.progress = count_step;
    settings.user = &steps;
    HOLDS(bandlimit_reproduce(names, 1, &settings, &reproduction, &message) == BANDLIMIT_OK);
    HOLDS(reproduction.page && reproduction.count > 0 && steps > 0);
    HOLDS(bandlimit_figure_claim_at(&reproduction, reproduction.count - 1, &claim, &message) ==
          BANDLIMIT_OK);
    HOLDS(claim.sentence && claim.source && strcmp(claim.figure, names[0]) == 0);
    HOLDS(bandlimit_figure_claim_at(&reproduction, reproduction.count, &claim, &message) ==
          BANDLIMIT_USAGE);
    bandlimit_reproduction_free(&reproduction);
}

static void draw(const char *folder) {
    static const float values[6] = {0, 1, 2, 3, 4, 5};
    char path[1024];
    bandlimit_image image;
    BANDLIMIT_INIT(&image);
    image.width = 3;
    image.height = 2;
    image.values = values;
    image.spacing = 0.5;
    snprintf(path, sizeof path, "%s/user.exr", folder);
    HOLDS(bandlimit_image_write(path, &image, &message) == BANDLIMIT_OK);
    BANDLIMIT_INIT(&image);
    HOLDS(bandlimit_image_read(path, NULL, &image, &message) == BANDLIMIT_OK);
    HOLDS(image.width == 3 && image.height == 2 && image.spacing == 0.5);
    HOLDS(memcmp(image.values, values, sizeof values) == 0);
    bandlimit_image_free(&image);
    HOLDS(!image.values);
    HOLDS(bandlimit_image_read(path, "7", &image, &message) == BANDLIMIT_USAGE);
}

int main(int count, char **arguments) {
    HOLDS(count == 2);
    bandlimit_signal *noise = open_signal("gnoise:seed=7");
    refuse();
    sample();
    filter();
    list();
    measure(noise);
    judge(noise);
    look();
    trade();
    reproduce(arguments[1]);
    draw(arguments[1]);
    bandlimit_close(noise);
    return 0;
}
