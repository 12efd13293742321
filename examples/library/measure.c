// SPDX-License-Identifier: MIT
//
// A program that uses the library: opens a signal by its text, looks at it, measures its spectrum,
// and judges its band. The exit status is the verdict, as that of `bandlimit check` is.
//
//   cc measure.c $(pkg-config --cflags --libs bandlimit) -o measure
//   ./measure gnoise:seed=7
#include <bandlimit.h>

#include <stdio.h>
#include <stdlib.h>

static int complain(const bandlimit_message *message, bandlimit_status status) {
    fprintf(stderr, "measure: %s\n", message->text);
    return (int)status;
}

// Eight values along x, a quarter of a cell apart.
static void print_values(const bandlimit_signal *signal) {
    const double start[4] = {0.1, 0.2, 0.3, 0}, step[4] = {0.25, 0, 0, 0};
    float values[8];
    bandlimit_row(signal, start, step, 8, values);
    for (int i = 0; i < 8; i++)
        printf("%s%.6f", i ? " " : "values ", (double)values[i]);
    putchar('\n');
}

static int judge(const bandlimit_signal *signal) {
    static const char *const words[] = {"pass", "inconclusive", "fail", "not run"};
    bandlimit_message message;
    bandlimit_spectrum_settings settings;
    bandlimit_spectrum spectrum;
    bandlimit_band_limit limit;
    BANDLIMIT_INIT(&settings);
    BANDLIMIT_INIT(&spectrum);
    BANDLIMIT_INIT(&limit);
    settings.effort = BANDLIMIT_QUICK;
    bandlimit_status status = bandlimit_spectrum_measure(signal, &settings, &spectrum, &message);
    if (status != BANDLIMIT_OK)
        return complain(&message, status);
    printf("variance %.4g (%.4g to %.4g), %zu bins up to %g cycles per unit\n",
           spectrum.variance.value, spectrum.variance.lower, spectrum.variance.upper,
           spectrum.count, spectrum.frequency[spectrum.count - 1]);
    limit.to = 2;
    limit.limit_db = -20;
    status = bandlimit_check(&spectrum, &limit, &message);
    if (status == BANDLIMIT_OK)
        printf("%.1f dB of the variance lie beyond %g cycles per unit: %s\n", limit.leak_db,
               limit.to, words[limit.verdict]);
    bandlimit_spectrum_free(&spectrum);
    return status == BANDLIMIT_OK ? (int)limit.verdict : complain(&message, status);
}

int main(int count, char **arguments) {
    bandlimit_message message;
    bandlimit_signal *signal;
    bandlimit_status status =
        bandlimit_open(count > 1 ? arguments[1] : "gnoise:seed=7", &signal, &message);
    if (status != BANDLIMIT_OK)
        return complain(&message, status);
    print_values(signal);
    int verdict = judge(signal);
    bandlimit_close(signal);
    return verdict;
}
