// SPDX-License-Identifier: MIT
#include "filters/pyramid.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

enum { LEVELS_MOST = 65 }; // halving a size_t down to 1

typedef struct level {
    size_t width, height;
    double *values;
} level;

struct bl_pyramid {
    bl_continuation continuation;
    size_t count;
    level levels[LEVELS_MOST];
};

// --- making -------------------------------------------------------------------------------------

// Beyond 4.2 widths the Gaussian leaves less than 2^-53 of its step.
static const double endless_reach = 4.2;

static double reach_of(const bl_filter *filter) {
    return isfinite(filter->support) ? filter->support : endless_reach;
}

// The pixel at an index that may stand outside: of a row of `length`.
static size_t continued(double index, size_t length, bl_continuation continuation) {
    double last = (double)length - 1;
    if (continuation == BL_WRAPPED)
        index -= (double)length * floor(index / (double)length);
    return (size_t)fmin(fmax(index, 0), last); // within [0, last]
}

// Halves lines of `from` numbers that stand `stride` apart to `to` numbers.
static void halve_line(const double *line, size_t from, double *out, size_t to, size_t stride,
                       const bl_filter *filter, bl_continuation continuation) {
    double width = (double)from / (double)to, reach = reach_of(filter) * width;
    for (size_t n = 0; n < to; n++) {
        double middle = ((double)n + 0.5) * width, sum = 0;
        double first = floor(middle - reach), end = ceil(middle + reach);
        // The ends are 0 and 1 even where the steps are not, quite.
        double below = 0;
        for (double k = first; k < end; k++) {
            double above = k + 1 < end ? filter->step((k + 1 - middle) / width) : 1;
            sum += (above - below) * line[continued(k, from, continuation) * stride];
            below = above;
        }
        out[n * stride] = sum;
    }
}

// Rows first, into `between` (narrower, as high), then columns. A side of one pixel stays as it is:
// its continuation is that pixel, and the weights add to 1.
static void halve(const level *from, level *to, double *between, const bl_filter *filter,
                  bl_continuation continuation) {
    for (size_t j = 0; j < from->height; j++)
        halve_line(from->values + j * from->width, from->width, between + j * to->width, to->width,
                   1, filter, continuation);
    for (size_t i = 0; i < to->width; i++)
        halve_line(between + i, from->height, to->values + i, to->height, to->width, filter,
                   continuation);
}

static size_t half(size_t length) {
    return length / 2 + length % 2;
}

static int make_level(bl_pyramid *pyramid, size_t n, const bl_filter *filter) {
    const level *from = &pyramid->levels[n - 1];
    level *to = &pyramid->levels[n];
    to->width = half(from->width);
    to->height = half(from->height);
    // No more numbers than `from` has, which are in memory.
    to->values = malloc(sizeof *to->values * to->width * to->height);
    double *between = malloc(sizeof *between * to->width * from->height);
    int made = to->values && between;
    if (made) {
        pyramid->count = n + 1;
        halve(from, to, between, filter, pyramid->continuation);
    }
    free(between);
    return made;
}

static int fill(bl_pyramid *pyramid, const float *values, size_t width, size_t height,
                const bl_filter *filter) {
    if (height > SIZE_MAX / sizeof(double) / width)
        return 0;
    level *image = &pyramid->levels[0];
    *image = (level){width, height, malloc(sizeof *image->values * width * height)};
    if (!image->values)
        return 0;
    for (size_t n = 0; n < width * height; n++)
        image->values[n] = (double)values[n];
    pyramid->count = 1;
    while (pyramid->levels[pyramid->count - 1].width > 1 ||
           pyramid->levels[pyramid->count - 1].height > 1)
        if (!make_level(pyramid, pyramid->count, filter))
            return 0;
    return 1;
}

bl_status bl_pyramid_make(const float *values, size_t width, size_t height, const bl_filter *filter,
                          bl_continuation continuation, bl_pyramid **out, bl_message *message) {
    if (!width || !height)
        return bl_report(message, BL_USAGE,
                         "a pyramid of %zu by %zu pixels: give an image that has some", width,
                         height);
    if (fabs(filter->step(-reach_of(filter))) > 0x1p-50)
        return bl_report(message, BL_USAGE,
                         "the filter '%s' has no end, so no pixel of a pyramid would have one: use "
                         "box, mitchell, lanczos or another that falls off",
                         filter->name);
    bl_pyramid *pyramid = calloc(1, sizeof *pyramid);
    if (pyramid) {
        pyramid->continuation = continuation;
        if (fill(pyramid, values, width, height, filter)) {
            *out = pyramid;
            return BL_OK;
        }
    }
    bl_pyramid_free(pyramid);
    return bl_report(message, BL_DEVICE, "out of memory for a pyramid of %zu by %zu pixels", width,
                     height);
}

void bl_pyramid_free(bl_pyramid *pyramid) {
    for (size_t n = 0; pyramid && n < LEVELS_MOST; n++)
        free(pyramid->levels[n].values);
    free(pyramid);
}

// --- reading ------------------------------------------------------------------------------------

size_t bl_pyramid_levels(const bl_pyramid *pyramid) {
    return pyramid->count;
}

void bl_pyramid_size(const bl_pyramid *pyramid, size_t n, size_t *width, size_t *height) {
    *width = n < pyramid->count ? pyramid->levels[n].width : 0;
    *height = n < pyramid->count ? pyramid->levels[n].height : 0;
}

double bl_pyramid_pixel(const bl_pyramid *pyramid, size_t n, size_t i, size_t j) {
    if (n >= pyramid->count || i >= pyramid->levels[n].width || j >= pyramid->levels[n].height)
        return NAN;
    return pyramid->levels[n].values[j * pyramid->levels[n].width + i];
}

// Between the middles of the pixels of one level; (x, y) in pixels of the image.
static double bilinear(const bl_pyramid *pyramid, size_t n, double x, double y) {
    const level *image = &pyramid->levels[0], *here = &pyramid->levels[n];
    double across = x * ((double)here->width / (double)image->width) - 0.5;
    double down = y * ((double)here->height / (double)image->height) - 0.5;
    double i = floor(across), j = floor(down), u = across - i, v = down - j;
    size_t left = continued(i, here->width, pyramid->continuation);
    size_t right = continued(i + 1, here->width, pyramid->continuation);
    size_t top = continued(j, here->height, pyramid->continuation);
    size_t bottom = continued(j + 1, here->height, pyramid->continuation);
    const double *above = here->values + top * here->width;
    const double *below = here->values + bottom * here->width;
    return (1 - v) * ((1 - u) * above[left] + u * above[right]) +
           v * ((1 - u) * below[left] + u * below[right]);
}

double bl_pyramid_value(const bl_pyramid *pyramid, double x, double y, double width) {
    if (!isfinite(x) || !isfinite(y) || isnan(width))
        return NAN;
    double last = (double)(pyramid->count - 1);
    double at = fmin(fmax(width > 1 ? log2(width) : 0, 0), last), n = floor(at);
    double finer = bilinear(pyramid, (size_t)n, x, y); // 0 <= n <= last
    if (at == n)
        return finer;
    return finer + (at - n) * (bilinear(pyramid, (size_t)n + 1, x, y) - finer);
}
