// SPDX-License-Identifier: MIT
#include "aliasing/energy.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "core/fft.h"
#include "core/footprint.h"
#include "core/grid.h"
#include "core/memory.h"

static bl_status check_size(size_t width, size_t height, size_t oversample, bl_message *message) {
    const double most = 0x1p28; // samples; a plan of them is still quick
    double samples = (double)width * (double)height * (double)oversample * (double)oversample;
    if (width < 2 || height < 2 || oversample < 1 || samples > most)
        return bl_report(message, BL_MISMATCH,
                         "an image of %zu x %zu pixels with %zu samples a pixel along each axis "
                         "cannot be transformed; use 2 to 16384 samples along each axis",
                         width, height, oversample);
    return bl_memory_check(8.1 * samples, "the spectrum of an image", message);
}

// Fills rows of 2*(columns/2 + 1) numbers; false if a value is not finite.
static int fill(bl_image_values values, const void *user, const bl_image_spectrum *spectrum,
                const double shift[2], const double jitter[2], double level, const double *across,
                const double *down, int threads) {
    const size_t columns = spectrum->width * spectrum->oversample;
    const size_t rows = spectrum->height * spectrum->oversample;
    const double step = 1.0 / (double)spectrum->oversample;
    int finite = 1;
#pragma omp parallel for schedule(dynamic, 8) num_threads(bl_thread_count(threads))                \
    reduction(&& : finite)
    for (size_t j = 0; j < rows; j++) {
        double *row = spectrum->coefficient + j * 2 * (columns / 2 + 1);
        double x[BL_BATCH], y[BL_BATCH];
        for (size_t done = 0, here; done < columns; done += here) {
            here = columns - done < BL_BATCH ? columns - done : BL_BATCH;
            for (size_t i = 0; i < here; i++) {
                x[i] = shift[0] + step * ((double)(done + i) + jitter[0]);
                y[i] = shift[1] + step * ((double)j + jitter[1]);
            }
            values(user, x, y, here, row + done);
        }
        for (size_t i = 0; i < columns; i++) {
            finite = finite && isfinite(row[i]);
            row[i] = (row[i] - level) * across[i] * down[j];
        }
    }
    return finite;
}

// A Hann window over the image, which stays where it is while the samples move by `jitter` steps.
static void fill_window(size_t size, double jitter, double *out) {
    for (size_t i = 0; i < size; i++) {
        double sine = sin(M_PI * ((double)i + jitter) / (double)size);
        out[i] = sine * sine;
    }
}

// Turns the coefficients below the limit to the phases of a grid without jitter. Beyond it sizes
// alone are asked for.
static void turn_phases(const double jitter[2], bl_image_spectrum *spectrum) {
    const size_t columns = spectrum->width * spectrum->oversample;
    const size_t rows = spectrum->height * spectrum->oversample;
    for (size_t row = 0; row < rows; row++) {
        double m = 2 * row < rows ? (double)row : (double)row - (double)rows;
        double *line = spectrum->coefficient + row * 2 * (columns / 2 + 1);
        if (2 * fabs(m) >= (double)spectrum->height)
            continue;
        for (size_t k = 0; 2 * k < spectrum->width; k++) {
            double phase = -2 * M_PI *
                           ((double)k * jitter[0] / (double)columns + m * jitter[1] / (double)rows);
            double c = cos(phase), s = sin(phase), *z = line + 2 * k;
            double real = z[0] * c - z[1] * s;
            z[1] = z[0] * s + z[1] * c;
            z[0] = real;
        }
    }
}

// The weighted mean square of 1 is 1 after this: a transform of N samples has N times the sum.
static double scale_of(const double *across, size_t columns, const double *down, size_t rows) {
    double x = 0, y = 0;
    for (size_t i = 0; i < columns; i++)
        x += across[i] * across[i];
    for (size_t j = 0; j < rows; j++)
        y += down[j] * down[j];
    return 1 / sqrt(x * y * (double)columns * (double)rows);
}

static bl_status transform(bl_image_values values, const void *user, const double shift[2],
                           const double jitter[2], double level, int threads, double *window,
                           bl_image_spectrum *spectrum, bl_message *message) {
    const size_t columns = spectrum->width * spectrum->oversample;
    const size_t rows = spectrum->height * spectrum->oversample;
    const bl_fft_shape shape = {.kind = BL_FFT_REAL,
                                .precision = BL_FFT_DOUBLE,
                                .dims = 2,
                                .size = {rows, columns},
                                .threads = 1};
    const bl_fft *plan;
    double *down = window + columns;
    fill_window(columns, jitter[0], window);
    fill_window(rows, jitter[1], down);
    bl_status status = bl_fft_plan(&shape, &plan, message);
    if (status != BL_OK)
        return status;
    if (!fill(values, user, spectrum, shift, jitter, level, window, down, threads))
        return bl_report(message, BL_MISMATCH,
                         "the image is not finite everywhere; use a view "
                         "that sees the signal only where it has values");
    bl_fft_run(plan, spectrum->coefficient);
    double scale = scale_of(window, columns, down, rows);
    for (size_t i = 0; i < rows * 2 * (columns / 2 + 1); i++)
        spectrum->coefficient[i] *= scale;
    turn_phases(jitter, spectrum);
    return BL_OK;
}

bl_status bl_image_spectrum_take(bl_image_values values, const void *user, size_t width,
                                 size_t height, size_t oversample, const double shift[2],
                                 const double jitter[2], double level, int threads,
                                 bl_image_spectrum *spectrum, bl_message *message) {
    bl_status status = check_size(width, height, oversample, message);
    if (status != BL_OK)
        return status;
    size_t columns = width * oversample, rows = height * oversample;
    double *window = malloc((columns + rows) * sizeof *window);
    *spectrum = (bl_image_spectrum){width, height, oversample,
                                    bl_fft_buffer(rows * 2 * (columns / 2 + 1) * sizeof(double))};
    if (!window || !spectrum->coefficient)
        status = bl_report(message, BL_DEVICE, "out of memory for the spectrum of an image");
    else
        status = transform(values, user, shift, jitter, level, threads, window, spectrum, message);
    free(window);
    if (status != BL_OK)
        bl_image_spectrum_free(spectrum);
    return status;
}

void bl_image_spectrum_free(bl_image_spectrum *spectrum) {
    free(spectrum->coefficient);
    *spectrum = (bl_image_spectrum){0};
}

// The coefficient at k cycles across and m down the image, k >= 0; its place in the rows.
static const double *at(const bl_image_spectrum *spectrum, size_t k, int64_t m) {
    size_t columns = spectrum->width * spectrum->oversample;
    size_t rows = spectrum->height * spectrum->oversample;
    size_t row = m < 0 ? rows - (size_t)-m : (size_t)m;
    return spectrum->coefficient + (row * (columns / 2 + 1) + k) * 2;
}

// A frequency across stands for its negative too, except for 0 and the last of an even size.
static double weight_of(const bl_image_spectrum *spectrum, size_t k) {
    size_t columns = spectrum->width * spectrum->oversample;
    return k == 0 || 2 * k == columns ? 1 : 2;
}

static double folded(double frequency) {
    return fabs(frequency - nearbyint(frequency));
}

// Keeps the strongest coefficient beyond the limit.
static void note_strongest(double energy, double fx, double fy, double *most,
                           bl_energies *energies) {
    if (!(energy > *most))
        return;
    *most = energy;
    energies->strongest[0] = fx;
    energies->strongest[1] = fy;
    energies->first_alias = hypot(folded(fx), folded(fy));
}

// What several grids say of one coefficient: the mean of its squared sizes, and how much of that is
// power from beyond the grids, which came in with another phase on each (the variance of numbers
// of which as many are seen).
typedef struct bl_seen {
    double square, foreign;
} bl_seen;

static bl_seen seen_of(const double (*z)[2], size_t grids) {
    const double n = (double)grids;
    double real = 0, imaginary = 0, square = 0, spread = 0;
    for (size_t g = 0; g < grids; g++) {
        real += z[g][0] / n;
        imaginary += z[g][1] / n;
        square += (z[g][0] * z[g][0] + z[g][1] * z[g][1]) / n;
    }
    for (size_t g = 0; g < grids; g++)
        spread +=
            (z[g][0] - real) * (z[g][0] - real) + (z[g][1] - imaginary) * (z[g][1] - imaginary);
    return (bl_seen){square, grids > 1 ? spread / (n - 1) : 0};
}

// The coefficient at k and m on each grid, of the sampled image and of what it lacks.
static void see(const bl_image_spectrum *sampled, const bl_image_spectrum *truth, size_t grids,
                size_t k, int64_t m, bl_seen *image, bl_seen *lack) {
    double z[BL_IMAGE_GRIDS][2], d[BL_IMAGE_GRIDS][2] = {0};
    for (size_t g = 0; g < grids; g++) {
        const double *c = at(&sampled[g], k, m), *f = truth ? at(&truth[g], k, m) : c;
        for (int part = 0; part < 2; part++) {
            z[g][part] = c[part];
            d[g][part] = f[part] - c[part];
        }
    }
    *image = seen_of((const double(*)[2])z, grids);
    *lack = seen_of((const double(*)[2])d, grids);
}

bl_energies bl_image_energies(const bl_image_spectrum *sampled, const bl_image_spectrum *truth,
                              size_t grids, size_t rings, double *ring) {
    const size_t columns = sampled->width * sampled->oversample;
    const int64_t rows = (int64_t)(sampled->height * sampled->oversample);
    const double width = (double)sampled->width, height = (double)sampled->height;
    const double ring_of = (double)rings / bl_image_highest(sampled->oversample);
    bl_energies energies = {.first_alias = NAN, .strongest = {NAN, NAN}};
    double most = 0;
    for (size_t i = 0; i < rings; i++)
        ring[i] = 0;
    for (int64_t m = -(rows / 2) + !(rows % 2); m <= rows / 2; m++)
        for (size_t k = 0; k <= columns / 2; k++) {
            const double fx = (double)k / width, fy = (double)m / height;
            const double weight = weight_of(sampled, k);
            const int inside = fabs(fx) < 0.5 && fabs(fy) < 0.5;
            bl_seen image, lack;
            see(sampled, inside ? truth : NULL, grids, k, m, &image, &lack);
            double alias = weight * (inside ? image.foreign : image.square);
            double blur = inside ? weight * (lack.square - lack.foreign) : 0;
            energies.total += weight * image.square;
            energies.alias += alias;
            energies.blur += blur;
            energies.within += inside ? weight * (image.square - image.foreign) : 0;
            note_strongest(alias, fx, fy, &most, &energies);
            if (!rings)
                continue;
            size_t here = (size_t)(ring_of * hypot(fx, fy));
            here = here < rings ? here : rings - 1;
            ring[here] += inside ? blur : alias;
            ring[rings - 1] += inside ? alias : 0;
        }
    return energies;
}

double bl_image_highest(size_t oversample) {
    return (double)oversample * sqrt(0.5);
}
