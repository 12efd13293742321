// SPDX-License-Identifier: MIT
#include "noises/tiles/displacement.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/fft.h"
#include "noises/tiles/tile_covariance.h"

const uint32_t bl_displacement_sizes[BL_TILE_AXES] = {256, 64, 0};

// A walk through the levels. Numbers are taken in a fixed order; a class is a run of them whose
// effects are shifts, or reflections in x = y, of one another.
typedef struct walk {
    double *grid;
    size_t width, height; // height 1: a line
    const double *number; // the next one; NULL: only the classes are counted
    size_t taken;
    double total; // of the deviations
    size_t class_start[128];
    unsigned classes;
} walk;

static void begin_class(walk *at, double deviation) {
    at->class_start[at->classes++] = at->taken;
    at->total += deviation;
}

static double take(walk *at, double deviation) {
    at->taken++;
    return at->number ? deviation * *at->number++ : 0;
}

// The number at a place of the periodic grid; sizes are powers of two.
static double *grid_at(const walk *at, size_t x, size_t y) {
    return at->grid + (y & (at->height - 1)) * at->width + (x & (at->width - 1));
}

// --- midpoints ----------------------------------------------------------------------------------

static void divide_line(walk *at, size_t half, double deviation) {
    begin_class(at, deviation);
    for (size_t x = half; x < at->width; x += 2 * half) {
        double middle = (*grid_at(at, x - half, 0) + *grid_at(at, x + half, 0)) / 2;
        *grid_at(at, x, 0) = middle + take(at, deviation);
    }
}

static void divide_squares(walk *at, size_t half, double deviation) {
    begin_class(at, deviation);
    for (size_t y = half; y < at->height; y += 2 * half)
        for (size_t x = half; x < at->width; x += 2 * half) {
            double corners = *grid_at(at, x - half, y - half) + *grid_at(at, x + half, y - half) +
                             *grid_at(at, x - half, y + half) + *grid_at(at, x + half, y + half);
            *grid_at(at, x, y) = corners / 4 + take(at, deviation);
        }
}

static void divide_diamonds(walk *at, size_t half, double deviation) {
    begin_class(at, deviation);
    for (size_t y = 0; y < at->height; y += half)
        for (size_t x = (y & half) ? 0 : half; x < at->width; x += 2 * half) {
            double around = *grid_at(at, x - half, y) + *grid_at(at, x + half, y) +
                            *grid_at(at, x, y - half) + *grid_at(at, x, y + half);
            *grid_at(at, x, y) = around / 4 + take(at, deviation);
        }
}

// A displacement at spacing s, in units of the tile, has the deviation s^H; the spacing of the
// midpoints of squares is 1/sqrt 2 of theirs.
static void walk_midpoints(walk *at, double hurst) {
    for (size_t half = at->width / 2; half >= 1; half /= 2) {
        double deviation = pow(2.0 * (double)half / (double)at->width, hurst);
        if (at->height == 1) {
            divide_line(at, half, deviation);
            continue;
        }
        divide_squares(at, half, deviation);
        divide_diamonds(at, half, deviation * pow(0.5, hurst / 2));
    }
}

// --- successive additions -----------------------------------------------------------------------

// From the points `spacing` apart to those `spacing / ratio` apart, linearly along a line.
static void refine(walk *at, size_t x, size_t y, int down, size_t spacing, size_t ratio) {
    size_t fine = spacing / ratio;
    double first = *grid_at(at, x, y);
    double second = *grid_at(at, down ? x : x + spacing, down ? y + spacing : y);
    for (size_t k = 1; k < ratio; k++) {
        double t = (double)k / (double)ratio;
        *grid_at(at, down ? x : x + k * fine, down ? y + k * fine : y) =
            (1 - t) * first + t * second;
    }
}

static void refine_all(walk *at, size_t spacing, size_t ratio) {
    for (size_t y = 0; y < at->height; y += spacing)
        for (size_t x = 0; x < at->width; x += spacing)
            refine(at, x, y, 0, spacing, ratio);
    for (size_t y = 0; at->height > 1 && y < at->height; y += spacing)
        for (size_t x = 0; x < at->width; x += spacing / ratio)
            refine(at, x, y, 1, spacing, ratio);
}

static void walk_additions(walk *at, double hurst, size_t ratio) {
    size_t most = at->height > 1 && at->height < at->width ? at->height : at->width, spacing = 1;
    while (spacing * ratio < most) // a lattice of one point would be a constant
        spacing *= ratio;
    for (size_t largest = spacing;; spacing /= ratio) {
        double deviation = pow((double)spacing / (double)largest, hurst);
        begin_class(at, deviation);
        for (size_t y = 0; y < at->height; y += spacing)
            for (size_t x = 0; x < at->width; x += spacing)
                *grid_at(at, x, y) += take(at, deviation);
        if (spacing == 1)
            return;
        refine_all(at, spacing, ratio);
    }
}

// --- both ---------------------------------------------------------------------------------------

static walk walk_all(const bl_displacement *settings, const double *numbers, double *grid) {
    uint32_t size[BL_TILE_AXES];
    bl_tile_sizes(&settings->tile, bl_displacement_sizes, size);
    walk at = {.grid = grid, .width = size[0], .height = size[1], .number = numbers};
    memset(grid, 0, at.width * at.height * sizeof *grid);
    if (settings->all)
        walk_additions(&at, settings->hurst, settings->lacunarity);
    else
        walk_midpoints(&at, settings->hurst);
    return at;
}

size_t bl_displacement_count(const bl_displacement *settings) {
    uint32_t size[BL_TILE_AXES];
    bl_tile_sizes(&settings->tile, bl_displacement_sizes, size);
    // All points but the first; with additions those of every coarser level again, whose number
    // falls at least by half from level to level.
    return (settings->all ? 2 : 1) * bl_tile_count(size);
}

double bl_displacement_fill(const bl_displacement *settings, const double *numbers, double *grid) {
    return walk_all(settings, numbers, grid).total;
}

// The mean of the square over places: the sum over i, j of g_i g_j rho(i-j) divided by the count,
// where rho is the kernel's autocorrelation, axis by axis: the mean of g (rho * g). `work` has room
// for the grid.
static double mean_square(const double *grid, const size_t size[2], const double rho[4],
                          double *work) {
    size_t count = size[0] * size[1];
    double sum = 0;
    for (size_t y = 0; y < size[1]; y++)
        for (size_t x = 0; x < size[0]; x++) {
            const double *row = grid + y * size[0];
            double here = rho[0] * row[x];
            for (size_t lag = 1; lag < 4; lag++)
                here +=
                    rho[lag] * (row[(x + lag) & (size[0] - 1)] + row[(x - lag) & (size[0] - 1)]);
            work[y * size[0] + x] = here;
        }
    for (size_t y = 0; y < size[1]; y++)
        for (size_t x = 0; x < size[0]; x++) {
            double here = size[1] > 1 ? rho[0] * work[y * size[0] + x] : work[x];
            for (size_t lag = 1; size[1] > 1 && lag < 4; lag++)
                here += rho[lag] * (work[((y + lag) & (size[1] - 1)) * size[0] + x] +
                                    work[((y - lag) & (size[1] - 1)) * size[0] + x]);
            sum += grid[y * size[0] + x] * here;
        }
    return sum / (double)count;
}

// The classes of random numbers. `grid` is overwritten.
static walk find_classes(const bl_displacement *settings, double *grid) {
    walk classes = walk_all(settings, NULL, grid);
    classes.class_start[classes.classes] = classes.taken;
    return classes;
}

// Fills the grid with what one number of a class does, as weights of the reading kernel; returns
// how many numbers the class has. All of `one` is 0, before and after.
static double spread_one(const bl_displacement *settings, const walk *classes, unsigned c,
                         double *one, const uint32_t size[BL_TILE_AXES], double *grid) {
    size_t start = classes->class_start[c];
    one[start] = 1;
    walk_all(settings, one, grid);
    one[start] = 0;
    bl_tile_prefilter(grid, size, (bl_tile_kernel)settings->tile.interp);
    return (double)(classes->class_start[c + 1] - start);
}

bl_status bl_displacement_variance(const bl_displacement *settings, double *variance,
                                   bl_message *message) {
    uint32_t size[BL_TILE_AXES];
    bl_tile_sizes(&settings->tile, bl_displacement_sizes, size);
    size_t count = bl_tile_count(size), numbers = bl_displacement_count(settings);
    double *grid = malloc(2 * count * sizeof *grid), *one = calloc(numbers, sizeof *one), rho[4];
    if (!grid || !one) {
        free(grid);
        free(one);
        return bl_report(message, BL_DEVICE, "out of memory for a tile of %zu numbers", count);
    }
    // rho(l) is the mean of its transform bl_tile_power times cos(2 pi v l); of 16 frequencies,
    // exactly, because rho has 7 lags.
    bl_tile_kernel kernel = (bl_tile_kernel)settings->tile.interp;
    for (int lag = 0; lag < 4; lag++) {
        rho[lag] = 0;
        for (int i = 0; i < 16; i++)
            rho[lag] += bl_tile_power(kernel, i / 16.0) * cos(2 * M_PI * i * lag / 16) / 16;
    }
    const walk classes = find_classes(settings, grid);
    *variance = 0;
    for (unsigned c = 0; c < classes.classes; c++) {
        double members = spread_one(settings, &classes, c, one, size, grid);
        *variance +=
            members * mean_square(grid, (const size_t[]){size[0], size[1]}, rho, grid + count);
    }
    free(grid);
    free(one);
    return BL_OK;
}

// Adds `weight` times the powers of the grid's harmonics; `buffer` has room for a transform.
static void add_powers(const bl_tile *tile, const bl_fft *plan, const double *grid, double weight,
                       double *buffer, double *powers) {
    const size_t width = tile->size[0], height = tile->size[1];
    const double scale = weight / ((double)(width * height) * (double)(width * height));
    for (size_t y = 0; y < height; y++)
        memcpy(buffer + y * (width + 2), grid + y * width, width * sizeof *grid);
    bl_fft_run(plan, buffer);
    for (size_t i = 0; i < height * (width + 2); i += 2)
        powers[i] += scale * (buffer[i] * buffer[i] + buffer[i + 1] * buffer[i + 1]);
}

// The random numbers are independent, so the powers of what each one does add up; those of a class
// have the same: the grids around a midpoint are their own reflections in x = y.
static bl_status find_covariance(const bl_displacement *settings, double variance, bl_tile *tile,
                                 bl_message *message) {
    const bl_fft *plan;
    bl_fft_shape shape = {.kind = BL_FFT_REAL,
                          .precision = BL_FFT_DOUBLE,
                          .dims = 3,
                          .size = {1, tile->size[1], tile->size[0]}};
    bl_status status = bl_fft_plan(&shape, &plan, message);
    if (status != BL_OK)
        return status;
    double *powers = bl_tile_powers(tile), *buffer = bl_fft_buffer(bl_fft_bytes(&shape));
    double *grid = malloc(bl_tile_count(tile->size) * sizeof *grid);
    double *one = calloc(bl_displacement_count(settings), sizeof *one);
    if (powers && buffer && grid && one) {
        const walk classes = find_classes(settings, grid);
        for (unsigned c = 0; c < classes.classes; c++) {
            double members = spread_one(settings, &classes, c, one, tile->size, grid);
            add_powers(tile, plan, grid, members / variance, buffer, powers);
        }
        status = bl_tile_set_powers(tile, powers, message);
    } else {
        status = bl_report(message, BL_DEVICE, "out of memory for a tile of %zu numbers",
                           bl_tile_count(tile->size));
        free(powers);
    }
    free(buffer);
    free(grid);
    free(one);
    return status;
}

bl_status bl_displacement_build(const bl_displacement *settings, double *scale, bl_tile *tile,
                                bl_message *message) {
    if (*scale == 0) {
        double variance;
        bl_status status = bl_displacement_variance(settings, &variance, message);
        if (status != BL_OK)
            return status;
        *scale = 1 / sqrt(variance);
    }
    bl_tile_begin(tile, &settings->tile, bl_displacement_sizes, settings->tile.samples);
    if (bl_tile_wants_covariance(tile)) {
        bl_status status = find_covariance(settings, 1 / (*scale * *scale), tile, message);
        if (status != BL_OK)
            return status;
    }
    size_t count = bl_tile_count(tile->size), numbers = bl_displacement_count(settings);
    double *grid = malloc(count * sizeof *grid), *number = malloc(numbers * sizeof *number);
    bl_status status = BL_DEVICE;
    if (grid && number) {
        bl_random random = bl_random_seed(settings->tile.seed, settings->all ? 21 : 20);
        bl_tile_numbers(&random, number, numbers);
        bl_displacement_fill(settings, number, grid);
        bl_tile_prefilter(grid, tile->size, (bl_tile_kernel)settings->tile.interp);
        status = bl_tile_make(tile, grid, *scale, message);
    } else {
        bl_report(message, BL_DEVICE, "out of memory for a tile of %zu numbers", count);
    }
    free(grid);
    free(number);
    if (status != BL_OK)
        bl_tile_release(tile);
    return status;
}

void bl_displacement_describe(const bl_displacement *settings, double scale, const bl_tile *tile,
                              bl_facts *facts) {
    bl_tile_kernel kernel = (bl_tile_kernel)settings->tile.interp;
    double total = 0;
    // The deviations alone: no grid of this size is needed, but one is the simplest.
    double *grid = malloc(bl_tile_count(tile->size) * sizeof *grid);
    if (grid)
        total = bl_displacement_fill(settings, NULL, grid);
    free(grid);
    double bound = grid ? total * scale * BL_TILE_NUMBER : INFINITY;
    bound *= pow(bl_tile_prefilter_gain(kernel) * bl_tile_gain(kernel), tile->dimensions);
    bl_tile_describe(tile, facts);
    facts->lower = -bound;
    facts->upper = bound;
    facts->bound_proof =
        "every displacement is below 3.4642 deviations, and midpoints are means of what is there: "
        "their sum over the levels, times the largest sum of the kernel's weights";
    facts->variance = 1;
}
