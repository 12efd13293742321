// SPDX-License-Identifier: MIT
//
// A box is cut, along each axis, into at most three spans of the image with weights: of a clamped
// image the edge pixel on either side and what stands within; of one that wraps all of it, as often
// as it fits, and the rest on one side of the seam or on both. The sum over the box is that over
// all pairs of spans.
#include "filters/summed_area.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

// A number and what its rounding left.
typedef struct pair {
    double sum, rest;
} pair;

struct bl_summed_area {
    size_t width, height; // of the image; the table is one larger each way, with zeros first
    bl_sums sums;
    bl_continuation continuation;
    void *entry; // float, double or pair
};

// --- arithmetic of pairs ------------------------------------------------------------------------

// The error of a sum of two doubles is a double (Knuth).
static pair add(pair a, double b) {
    double sum = a.sum + b, part = sum - a.sum;
    double error = (a.sum - (sum - part)) + (b - part) + a.rest;
    pair result = {sum + error, 0};
    result.rest = error - (result.sum - sum);
    return result;
}

static pair add_pair(pair a, pair b) {
    a = add(a, b.sum);
    return add(a, b.rest);
}

// A double as two of 26 bits, whose products with each other are exact (Veltkamp, Dekker).
static pair halves(double a) {
    double turned = a * 134217729.0; // 2^27 + 1
    double high = turned - (turned - a);
    return (pair){high, a - high};
}

// w a, with the error of the product.
static pair scale(pair a, double w) {
    pair x = halves(a.sum), y = halves(w);
    double product = a.sum * w;
    double error = ((x.sum * y.sum - product) + x.sum * y.rest + x.rest * y.sum) + x.rest * y.rest;
    return add((pair){product, 0}, error + a.rest * w);
}

static pair subtract(pair a, pair b) {
    return add_pair(a, (pair){-b.sum, -b.rest});
}

// --- making -------------------------------------------------------------------------------------

static size_t entry_size(bl_sums sums) {
    return sums == BL_SUMS_COMPENSATED ? sizeof(pair)
           : sums == BL_SUMS_DOUBLE    ? sizeof(double)
                                       : sizeof(float);
}

static pair read_entry(const bl_summed_area *table, size_t i, size_t j) {
    size_t index = j * (table->width + 1) + i;
    switch (table->sums) {
    case BL_SUMS_COMPENSATED:
        return ((const pair *)table->entry)[index];
    case BL_SUMS_DOUBLE:
        return (pair){((const double *)table->entry)[index], 0};
    default:
        return (pair){(double)((const float *)table->entry)[index], 0};
    }
}

static void write_entry(bl_summed_area *table, size_t i, size_t j, pair value) {
    size_t index = j * (table->width + 1) + i;
    switch (table->sums) {
    case BL_SUMS_COMPENSATED:
        ((pair *)table->entry)[index] = value;
        break;
    case BL_SUMS_DOUBLE:
        ((double *)table->entry)[index] = value.sum;
        break;
    default:
        ((float *)table->entry)[index] = (float)value.sum;
    }
}

// One more pixel of a row, or a row more on the sums above it, as the table adds.
static pair accumulate(bl_sums sums, pair a, pair b) {
    switch (sums) {
    case BL_SUMS_COMPENSATED:
        return add_pair(a, b);
    case BL_SUMS_FLOAT:
        return (pair){(double)((float)a.sum + (float)b.sum), 0};
    default:
        return (pair){a.sum + b.sum, 0};
    }
}

// `above`: the sums of the row above, kept apart from the table, which may have rounded them.
static void fill(bl_summed_area *table, const float *values, pair *above) {
    for (size_t j = 0; j < table->height; j++) {
        pair row = {0, 0};
        for (size_t i = 0; i < table->width; i++) {
            pair pixel = {(double)values[j * table->width + i], 0};
            row = accumulate(table->sums, row, pixel);
            above[i] = accumulate(table->sums, above[i], row);
            write_entry(table, i + 1, j + 1, above[i]);
        }
    }
}

static bl_status check(const float *values, size_t width, size_t height, bl_message *message) {
    if (!width || !height)
        return bl_report(message, BL_USAGE,
                         "a summed-area table of %zu by %zu pixels: give an "
                         "image that has some",
                         width, height);
    for (size_t n = 0; n < width * height; n++)
        if (!isfinite(values[n]))
            return bl_report(message, BL_USAGE,
                             "pixel (%zu, %zu) of the image is not finite, and every sum to its "
                             "right and below would not be: replace it first",
                             n % width, n / width);
    return BL_OK;
}

bl_status bl_summed_area_make(const float *values, size_t width, size_t height, bl_sums sums,
                              bl_continuation continuation, bl_summed_area **out,
                              bl_message *message) {
    bl_status status = check(values, width, height, message);
    if (status != BL_OK)
        return status;
    bl_summed_area *table = malloc(sizeof *table);
    pair *above = calloc(width, sizeof *above);
    // An image that fits in memory has fewer than 2^62 floats, and the table a third more at most
    // of rows and columns; calloc refuses what does not fit.
    void *entry = width < SIZE_MAX / entry_size(sums) - 1
                      ? calloc(height + 1, (width + 1) * entry_size(sums))
                      : NULL;
    if (!table || !above || !entry) {
        free(table);
        free(above);
        free(entry);
        return bl_report(message, BL_DEVICE, "out of memory for a table of %zu by %zu sums",
                         width + 1, height + 1);
    }
    *table = (bl_summed_area){width, height, sums, continuation, entry};
    fill(table, values, above);
    free(above);
    *out = table;
    return BL_OK;
}

void bl_summed_area_free(bl_summed_area *table) {
    if (table)
        free(table->entry);
    free(table);
}

// --- spans --------------------------------------------------------------------------------------

enum { SPANS = 3 };
typedef struct span {
    double from, to; // in pixels of the image, 0 <= from <= to <= length
    double weight;   // its share of the box is weight * (to - from)
} span;

static int clamped_spans(double middle, double size, double length, span out[SPANS]) {
    double left = middle - 0.5 * size, right = middle + 0.5 * size;
    double before = fmin(fmax(-left, 0), size), after = fmin(fmax(right - length, 0), size);
    int count = 0;
    if (before > 0)
        out[count++] = (span){0, 1, before / size};
    if (after > 0)
        out[count++] = (span){length - 1, length, after / size};
    if (right > 0 && left < length)
        out[count++] = (span){fmax(left, 0), fmin(right, length), 1 / size};
    return count;
}

static int wrapped_spans(double middle, double size, double length, span out[SPANS]) {
    double rest = fmod(size, length), whole = nearbyint((size - rest) / length);
    // The remainder is a box of the size `rest` around the same middle, or half an image further if
    // the number of whole images is odd.
    middle = remainder(middle, length) + (fmod(whole, 2) == 0 ? 0 : 0.5 * length);
    double left = fmod(middle - 0.5 * rest + 2 * length, length), right = left + rest;
    int count = 0;
    if (whole > 0)
        out[count++] = (span){0, length, whole / size};
    if (rest > 0)
        out[count++] = (span){left, fmin(right, length), 1 / size};
    if (right > length)
        out[count++] = (span){0, right - length, 1 / size};
    return count;
}

static int pixel_span(double middle, double length, bl_continuation continuation, span out[SPANS]) {
    double at = floor(middle);
    if (continuation == BL_WRAPPED)
        at -= length * floor(at / length);
    at = fmin(fmax(at, 0), length - 1);
    out[0] = (span){at, at + 1, 1};
    return 1;
}

static int endless_spans(double length, bl_continuation continuation, span out[SPANS]) {
    if (continuation == BL_WRAPPED) {
        out[0] = (span){0, length, 1 / length};
        return 1;
    }
    out[0] = (span){0, 1, 0.5};
    out[1] = (span){length - 1, length, 0.5};
    return 2;
}

static int find_spans(double middle, double size, double length, bl_continuation continuation,
                      span out[SPANS]) {
    size = fabs(size);
    if (isinf(size))
        return endless_spans(length, continuation, out);
    if (size < 0x1p-20)
        return pixel_span(middle, length, continuation, out);
    return continuation == BL_WRAPPED ? wrapped_spans(middle, size, length, out)
                                      : clamped_spans(middle, size, length, out);
}

// --- reading ------------------------------------------------------------------------------------

// A place in the table: the entry before it, and how far it is past it.
typedef struct place {
    size_t i, j;
    double u, v;
} place;

// The last entry has no neighbour and needs none. 0 <= x <= width, which is a size_t.
static place find_place(const bl_summed_area *table, double x, double y) {
    place at = {table->width - 1, table->height - 1, 0, 0};
    if (x < (double)table->width)
        at.i = (size_t)x;
    if (y < (double)table->height)
        at.j = (size_t)y;
    at.u = x - (double)at.i;
    at.v = y - (double)at.j;
    return at;
}

// The integral of the image from (0, 0) to the place: bilinear between four entries. Only their
// differences are scaled, so that no weight is rounded before it meets a large sum.
static pair integral(const bl_summed_area *table, place at) {
    pair corner = read_entry(table, at.i, at.j), right = read_entry(table, at.i + 1, at.j);
    pair below = read_entry(table, at.i, at.j + 1), far = read_entry(table, at.i + 1, at.j + 1);
    pair across = subtract(right, corner), down = subtract(below, corner);
    pair both = subtract(subtract(far, right), down);
    pair sum = add_pair(corner, scale(across, at.u));
    sum = add_pair(sum, scale(down, at.v));
    return add_pair(sum, scale(scale(both, at.u), at.v));
}

static double plain_integral(const bl_summed_area *table, place at) {
    double corner = read_entry(table, at.i, at.j).sum;
    double across = read_entry(table, at.i + 1, at.j).sum - corner;
    double down = read_entry(table, at.i, at.j + 1).sum - corner;
    double both = read_entry(table, at.i + 1, at.j + 1).sum - corner - across - down;
    return corner + at.u * across + at.v * (down + at.u * both);
}

// D + A - B - C.
static double box_sum(const bl_summed_area *table, span x, span y) {
    place a = find_place(table, x.from, y.from), b = find_place(table, x.to, y.from);
    place c = find_place(table, x.from, y.to), d = find_place(table, x.to, y.to);
    if (table->sums != BL_SUMS_COMPENSATED)
        return plain_integral(table, d) - plain_integral(table, b) -
               (plain_integral(table, c) - plain_integral(table, a));
    pair right = subtract(integral(table, d), integral(table, b));
    pair sum = subtract(right, subtract(integral(table, c), integral(table, a)));
    return sum.sum + sum.rest;
}

double bl_summed_area_mean(const bl_summed_area *table, double x, double y, const double size[2]) {
    if (!isfinite(x) || !isfinite(y) || isnan(size[0]) || isnan(size[1]))
        return NAN;
    span across[SPANS], down[SPANS];
    int columns = find_spans(x, size[0], (double)table->width, table->continuation, across);
    int rows = find_spans(y, size[1], (double)table->height, table->continuation, down);
    double sum = 0;
    for (int j = 0; j < rows; j++)
        for (int i = 0; i < columns; i++)
            sum += across[i].weight * down[j].weight * box_sum(table, across[i], down[j]);
    return sum;
}
