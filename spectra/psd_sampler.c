// SPDX-License-Identifier: MIT
//
// Where the averages of a measurement stand, and with which seed.
//
// Off a grid, average k of settings.seed starts at a place drawn from stream 2k, and its signal
// draws from a seed of stream 2k + 1. A random place is uniform in +-2^20 on every axis. A lattice
// place is a random lattice point, from which the start moves by a random step within the line or
// the slice: what stands off the line or the slice stays whole, and the phase along it is random.
#include <math.h>
#include <stdlib.h>

#include "core/hash.h"
#include "core/random.h"
#include "spectra/psd_parts.h"
#include "spectra/theory.h"

static const double REACH = 0x1p20; // of random places, in units of the domain
static const double SLIDE = 0x1p12; // of the random step within a lattice line or slice
static const size_t LEAST_SIZE = 8; // below it no window has a main lobe inside the spectrum

static const double default_rate[4] = {0, 16, 8, 4};
static const size_t default_size[4] = {0, 2048, 512, 64};
static const size_t default_averages[4] = {0, 256, 16, 8};

bl_psd_settings bl_psd_default_settings(unsigned dims) {
    return (bl_psd_settings){.dims = dims,
                             .window = BL_WINDOW_BLACKMAN_HARRIS,
                             .axis = {dims == 2 ? 0 : 1, 0, dims == 2 ? 1 : 0},
                             .place = BL_PLACE_RANDOM,
                             .seed = 1,
                             .level = 0.95};
}

size_t bl_psd_usual_averages(const bl_signal *signal, unsigned dims, bl_size size) {
    static const double normal[] = {256, 16, 8};
    if (signal->extent.size[0] || dims < 1 || dims > 3 || size == BL_NORMAL)
        return 0; // an image has the averages that it has
    return (size_t)(normal[dims - 1] * bl_size_pick(size, 0.25, 1, 16));
}

static bl_status check_settings(const bl_psd_settings *settings, bl_message *message) {
    if (settings->dims < 1 || settings->dims > 3)
        return bl_report(message, BL_USAGE,
                         "a spectrum has 1, 2 or 3 dimensions (line, slice, volume), not %u",
                         settings->dims);
    if (!(settings->rate >= 0) || isinf(settings->rate))
        return bl_report(message, BL_USAGE,
                         "the rate is %g samples per unit; give a positive number, or 0 for the "
                         "default",
                         settings->rate);
    if (settings->size != 0 && settings->size < LEAST_SIZE)
        return bl_report(message, BL_USAGE, "%zu samples along an axis are too few; give 8 or more",
                         settings->size);
    if (!(settings->level > 0 && settings->level < 1))
        return bl_report(message, BL_USAGE,
                         "the confidence level is %g; give a number between 0 and 1, as 0.95",
                         settings->level);
    if ((unsigned)settings->window >= BL_WINDOW_COUNT)
        return bl_report(message, BL_USAGE, "there is no window number %d", (int)settings->window);
    if (settings->place != BL_PLACE_RANDOM && settings->place != BL_PLACE_LATTICE)
        return bl_report(message, BL_USAGE, "there is no place number %d", (int)settings->place);
    if (settings->place == BL_PLACE_LATTICE && settings->dims == 3)
        return bl_report(message, BL_USAGE,
                         "a volume stands on no lattice edge or plane; take a random place");
    if (settings->threads < 0)
        return bl_report(message, BL_USAGE,
                         "%d threads cannot be had; give 1 or more, or 0 for all",
                         settings->threads);
    return BL_OK;
}

// --- grids ---

// The grid axis that a direction follows, or BL_AXES if it follows none.
static unsigned followed_axis(const double direction[BL_AXES]) {
    unsigned followed = BL_AXES;
    for (unsigned a = 0; a < BL_AXES; a++)
        if (direction[a] != 0) {
            if (followed != BL_AXES)
                return BL_AXES;
            followed = a;
        }
    return followed;
}

static bl_status find_span(bl_sampler *sampler, int spanned[BL_AXES], size_t *shortest,
                           bl_message *message) {
    const bl_extent *extent = &sampler->signal->extent;
    const char *name = sampler->signal->text, axes[] = "xyzw";
    *shortest = SIZE_MAX;
    sampler->spacing = 0;
    for (unsigned d = 0; d < sampler->settings.dims; d++) {
        unsigned a = followed_axis(sampler->directions[d]);
        if (a == BL_AXES || extent->size[a] == 0)
            return bl_report(message, BL_MISMATCH,
                             "'%s' has samples on a grid only: a line must run along one of its "
                             "axes, and a slice or volume span axes that it has",
                             name);
        for (unsigned b = 0; b < BL_AXES; b++) // either way along the axis is the same spectrum
            sampler->directions[d][b] = a == b;
        spanned[a] = 1;
        if (extent->size[a] < LEAST_SIZE)
            return bl_report(message, BL_MISMATCH,
                             "'%s' has %zu samples along %c; its spectrum in %u dimensions needs "
                             "8 or more there",
                             name, extent->size[a], axes[a], sampler->settings.dims);
        double spacing = extent->spacing[a];
        if (sampler->spacing != 0 && fabs(spacing / sampler->spacing - 1) > 1e-9)
            return bl_report(message, BL_MISMATCH,
                             "'%s' has different spacings along its axes (%g and %g); rings need "
                             "one",
                             name, sampler->spacing, spacing);
        sampler->spacing = spacing;
        *shortest = extent->size[a] < *shortest ? extent->size[a] : *shortest;
    }
    if (!(sampler->spacing > 0) || isinf(sampler->spacing))
        return bl_report(message, BL_MISMATCH,
                         "'%s' has a spacing of %g units; it must be positive", name,
                         sampler->spacing);
    return BL_OK;
}

// Lines: what fits, up to the default. Slices and volumes: all of it for one average, else half of
// it, so that overlapped patches give averages to judge the spread by.
static size_t grid_size(const bl_psd_settings *settings, size_t shortest) {
    size_t size = shortest;
    if (settings->dims == 1 && size > default_size[1])
        size = default_size[1];
    if (settings->dims > 1 && settings->averages != 1 && shortest >= 64)
        size = shortest / 2;
    return size / 2 * 2;
}

// Patches overlap by half, or less where they spread to span the whole grid. Averages above the
// wanted number are taken away first from the axes not transformed, where neighbours are alike.
static void lay_patches(bl_sampler *sampler, const int spanned[BL_AXES]) {
    const bl_extent *extent = &sampler->signal->extent;
    size_t size = sampler->settings.size, wanted = sampler->settings.averages, total = 1;
    if (wanted == 0)
        wanted = sampler->settings.dims == 1 ? default_averages[1] : SIZE_MAX;
    for (unsigned a = 0; a < BL_AXES; a++) {
        sampler->patch_length[a] = spanned[a] ? size : 1;
        sampler->patches[a] = extent->size[a] ? extent->size[a] : 1;
        if (spanned[a])
            sampler->patches[a] = (extent->size[a] - size) / ((size + 1) / 2) + 1;
        total *= sampler->patches[a];
    }
    for (int round = 0; round < 2; round++)
        for (unsigned a = 0; a < BL_AXES; a++)
            if (total > wanted && spanned[a] == round) {
                size_t others = total / sampler->patches[a];
                sampler->patches[a] = wanted > others ? wanted / others : 1;
                total = others * sampler->patches[a];
            }
    sampler->settings.averages = total;
    for (unsigned a = 0; a < BL_AXES; a++)
        if (spanned[a] && sampler->patches[a] > 1) {
            size_t patches = sampler->patches[a], shift = (extent->size[a] - size) / (patches - 1);
            double factor = 1; // Welch 1967: the variance of a mean of correlated powers
            for (size_t j = 1; j < patches && j * shift < size; j++)
                factor += 2 * (1 - (double)j / (double)patches) *
                          bl_window_overlap(sampler->settings.window, size, j * shift);
            sampler->overlap *= factor;
        }
}

static bl_status open_on_grid(bl_sampler *sampler, bl_message *message) {
    bl_psd_settings *settings = &sampler->settings;
    const char *name = sampler->signal->text;
    int spanned[BL_AXES] = {0};
    size_t shortest;
    bl_status status = find_span(sampler, spanned, &shortest, message);
    if (status != BL_OK)
        return status;
    if (settings->rate != 0 && fabs(settings->rate * sampler->spacing - 1) > 1e-9)
        return bl_report(message, BL_MISMATCH,
                         "'%s' has %.9g samples per unit, not %.9g; leave the rate out", name,
                         1 / sampler->spacing, settings->rate);
    settings->rate = 1 / sampler->spacing;
    if (settings->size == 0)
        settings->size = grid_size(settings, shortest);
    if (settings->size > shortest)
        return bl_report(message, BL_MISMATCH,
                         "%zu samples along each axis were asked for, and '%s' has %zu; give at "
                         "most %zu",
                         settings->size, name, shortest, shortest);
    lay_patches(sampler, spanned);
    return BL_OK;
}

// --- places ---

bl_status bl_sampler_open(const bl_signal *signal, const bl_psd_settings *settings,
                          bl_sampler *sampler, bl_message *message) {
    bl_status status = check_settings(settings, message);
    if (status != BL_OK)
        return status;
    *sampler = (bl_sampler){.signal = signal, .settings = *settings, .overlap = 1};
    if (!bl_directions(settings->dims, settings->axis, sampler->directions))
        return bl_report(message, BL_USAGE,
                         "the axis (%g, %g, %g) has no direction; give a vector "
                         "that is finite and not zero",
                         settings->axis[0], settings->axis[1], settings->axis[2]);
    if (signal->dimensions != 0 && settings->dims > signal->dimensions)
        return bl_report(message, BL_MISMATCH,
                         "'%s' has %u dimension%s and no spectrum in %u; ask for at most %u",
                         signal->text, signal->dimensions, signal->dimensions == 1 ? "" : "s",
                         settings->dims, signal->dimensions);
    status = bl_signal_check_statistics(signal, message);
    if (status != BL_OK)
        return status;
    for (unsigned a = 0; a < BL_AXES; a++)
        sampler->on_grid |= signal->extent.size[a] != 0;
    if (sampler->on_grid)
        return open_on_grid(sampler, message);
    if (!bl_theory_reaches(signal, settings->dims, sampler->directions))
        return bl_report(message, BL_MISMATCH,
                         "'%s' has %u dimension%s, and does not change along the others; %s",
                         signal->text, signal->dimensions, signal->dimensions == 1 ? "" : "s",
                         settings->dims == 1 ? "choose an axis within them"
                                             : "choose z, the axis normal to x and y");
    bl_psd_settings *resolved = &sampler->settings;
    if (resolved->rate == 0)
        resolved->rate = default_rate[resolved->dims];
    if (resolved->size == 0)
        resolved->size = default_size[resolved->dims];
    if (resolved->averages == 0)
        resolved->averages = default_averages[resolved->dims];
    sampler->spacing = 1 / resolved->rate;
    return BL_OK;
}

size_t bl_sampler_samples(const bl_sampler *sampler) {
    size_t samples = sampler->settings.size;
    for (unsigned d = 1; d < sampler->settings.dims; d++)
        samples *= sampler->settings.size;
    return samples;
}

// Patch `index` of `patches` on an axis: spread from end to end; rows stand in the middle of their
// share.
static size_t patch_start(size_t extent, size_t length, size_t patches, size_t index) {
    if (length == 1)
        return (size_t)(((double)index + 0.5) * (double)extent / (double)patches);
    if (patches == 1)
        return (extent - length) / 2;
    return index * ((extent - length) / (patches - 1));
}

static void start_on_grid(const bl_sampler *sampler, size_t average, double start[BL_AXES]) {
    const bl_extent *extent = &sampler->signal->extent;
    for (unsigned a = 0; a < BL_AXES; a++) {
        size_t index = average % sampler->patches[a];
        average /= sampler->patches[a];
        start[a] = 0;
        if (extent->size[a])
            start[a] =
                extent->spacing[a] * (double)patch_start(extent->size[a], sampler->patch_length[a],
                                                         sampler->patches[a], index);
    }
}

void bl_sampler_start(const bl_sampler *sampler, size_t average, double start[BL_AXES]) {
    if (sampler->on_grid) {
        start_on_grid(sampler, average, start);
        return;
    }
    bl_random random = bl_random_seed(sampler->settings.seed, 2 * (uint64_t)average);
    for (unsigned a = 0; a < BL_AXES; a++)
        start[a] = (2 * bl_random_unit(&random) - 1) * REACH;
    if (sampler->settings.place == BL_PLACE_RANDOM)
        return;
    for (unsigned a = 0; a < BL_AXES; a++)
        start[a] = floor(start[a]);
    for (unsigned d = 0; d < sampler->settings.dims; d++) {
        double slide = bl_random_unit(&random) * SLIDE;
        for (unsigned a = 0; a < BL_AXES; a++)
            start[a] += slide * sampler->directions[d][a];
    }
}

void bl_sampler_fill(const bl_sampler *sampler, size_t average, float *out, size_t pitch,
                     int threads) {
    const bl_psd_settings *settings = &sampler->settings;
    size_t size = settings->size, rows = bl_sampler_samples(sampler) / size;
    double start[BL_AXES], step[BL_AXES];
    bl_sampler_start(sampler, average, start);
    for (unsigned a = 0; a < BL_AXES; a++)
        step[a] = sampler->directions[0][a] * sampler->spacing;
    bl_signal *fresh = NULL;
    if (!sampler->on_grid)
        fresh =
            bl_signal_reseed(sampler->signal, bl_stream(settings->seed, 2 * (uint64_t)average + 1));
    const bl_signal *signal = fresh ? fresh : sampler->signal;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads) if (threads > 1 && rows > 1)
    for (size_t row = 0; row < rows; row++) {
        double at[BL_AXES], along[2] = {(double)(row % size), (double)(row / size)};
        for (unsigned a = 0; a < BL_AXES; a++) {
            at[a] = start[a];
            for (unsigned d = 1; d < settings->dims; d++)
                at[a] += along[d - 1] * sampler->directions[d][a] * sampler->spacing;
        }
        bl_signal_row(signal, at, step, size, out + row * pitch);
    }
    bl_signal_free(fresh);
}

bl_status bl_sampler_check(const bl_sampler *sampler, size_t average, const float *samples,
                           size_t pitch, bl_message *message) {
    size_t size = sampler->settings.size, count = bl_sampler_samples(sampler);
    for (size_t i = 0; i < count; i++) {
        float value = samples[i / size * pitch + i % size];
        if (isfinite(value))
            continue;
        double at[BL_AXES];
        size_t along[3] = {i % size, i / size % size, i / size / size};
        bl_sampler_start(sampler, average, at);
        for (unsigned d = 0; d < sampler->settings.dims; d++)
            for (unsigned a = 0; a < BL_AXES; a++)
                at[a] += (double)along[d] * sampler->directions[d][a] * sampler->spacing;
        return bl_report(
            message, BL_MISMATCH,
            "'%s' gives %g at (%.9g, %.9g, %.9g, %.9g); a spectrum needs finite values",
            sampler->signal->text, (double)value, at[0], at[1], at[2], at[3]);
    }
    return BL_OK;
}
