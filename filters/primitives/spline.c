// SPDX-License-Identifier: MIT
//
// spline: a Catmull-Rom spline through any number of knots, numbers or colours.
//
//   a cubic on each span (filters/spline.h); 0 gives the second knot, 1 the last but one; outside
//   of [0, 1] x is clamped
//   filtered: the box has the exact mean of each cubic; other filters see filters/average.h
//
// Parameters
//   knots                   4 to 128 of them, as 0;0.3;1;1, or colours R/G/B, linear, as
//                           0/0/0;1/0.5/0;1/1/1;1/1/1
//   component               which part of a colour is the value
//   width, filter, anchor   how it is averaged (filters/primitive.h). The ideal filter, which has
//                           no end, is refused for widths below 1/8192
//
// C1 between the ends: the first derivatives of neighbours agree at a knot, the second do not, in
// general, as against what the text says of it. At both ends, where it is clamped, it is C0. It
// reproduces polynomials up to degree 2. Bound: of each cubic, its Bezier points (k1, k1 + (k2
// - k0)/6, k2 - (k3 - k1)/6, k2) hull it; none for filters with negative lobes. Infinite width: the
// mean of both ends. NaN gives NaN, infinite x the ends. Source: peachey2003, p. 34.
#include "filters/average.h"
#include "filters/primitive.h"
#include "filters/spline.h"

#include <math.h>
#include <string.h>

typedef struct spline_parameters {
    char knots[BL_TEXT_SIZE];
    uint32_t component;
    uint32_t count, colours;
    double knot[4][BL_SPLINE_MOST]; // luminance, red, green, blue; a number is all four
    double place[BL_SPLINE_MOST];   // of the knots that it passes through
    bl_averaging averaging;
} spline_parameters;

// Reads one knot, up to `end`, as one number or three.
static int read_knot(const char *word, const char *end, double rgb[3], int *parts) {
    char copy[64];
    size_t length = (size_t)(end - word);
    if (length == 0 || length >= sizeof copy)
        return 0;
    memcpy(copy, word, length);
    copy[length] = '\0';
    *parts = 0;
    for (char *part = copy; part; (*parts)++) {
        char *slash = strchr(part, '/');
        if (slash)
            *slash++ = '\0';
        if (*parts == 3 || !bl_read_real(part, &rgb[*parts]) || fabs(rgb[*parts]) > 1e300)
            return 0;
        part = slash;
    }
    if (*parts == 1)
        rgb[1] = rgb[2] = rgb[0];
    return *parts == 1 || *parts == 3;
}

static bl_status read_knots(spline_parameters *p, bl_message *message) {
    int parts, first = 0;
    p->count = 0;
    for (const char *word = p->knots; word; p->count++) {
        const char *semicolon = strchr(word, ';');
        const char *end = semicolon ? semicolon : word + strlen(word);
        double rgb[3] = {0};
        if (p->count == BL_SPLINE_MOST)
            return bl_report(message, BL_USAGE, "knots=%s: at most %d knots", p->knots,
                             BL_SPLINE_MOST);
        if (!read_knot(word, end, rgb, &parts))
            return bl_report(message, BL_USAGE,
                             "knots=%s: knot %u, '%.*s', is neither a number nor a colour R/G/B",
                             p->knots, p->count + 1, (int)(end - word), word);
        if (p->count == 0)
            first = parts;
        if (parts != first)
            return bl_report(message, BL_USAGE,
                             "knots=%s: knot %u is %s, but the first is %s; all must be alike",
                             p->knots, p->count + 1, parts == 1 ? "a number" : "a colour",
                             first == 1 ? "a number" : "a colour");
        p->knot[0][p->count] =
            parts == 1 ? rgb[0] : 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
        for (int c = 0; c < 3; c++)
            p->knot[c + 1][p->count] = rgb[c];
        word = semicolon ? semicolon + 1 : NULL;
    }
    if (p->count < BL_SPLINE_LEAST)
        return bl_report(message, BL_USAGE,
                         "knots=%s: a cubic needs at least %d knots, here are %u; separate them "
                         "with ';' and quote the text in a shell",
                         p->knots, BL_SPLINE_LEAST, p->count);
    p->colours = first == 3;
    bl_spline_places(p->count, p->place);
    return BL_OK;
}

static double average_of(const spline_parameters *p, uint32_t component, const bl_filter *filter,
                         double x, double width) {
    const bl_spline spline = {
        .knot = p->knot[component], .count = p->count, .stride = 1, .place = p->place};
    return bl_spline_average(&spline, filter, x, width);
}

static double average(const spline_parameters *p, const bl_filter *filter, double x, double width) {
    return average_of(p, p->component, filter, x, width);
}

BL_PRIMITIVE_ABILITIES(spline_parameters)

static void colour(const void *block, const bl_samples *samples, double *rgb) {
    const spline_parameters *p = block;
    const bl_filter *filter = bl_filter_at(p->averaging.filter);
    for (size_t i = 0; i < samples->count; i++) {
        double width = bl_samples_footprint(samples, i)->width[0];
        double x = bl_averaging_centre(&p->averaging, samples->at[0][i], width);
        for (uint32_t c = 0; c < 3; c++)
            rgb[3 * i + c] = average_of(p, c + 1, filter, x, width);
    }
}

static bl_status build(void *block, bl_opener *open, bl_message *message) {
    (void)open;
    return read_knots(block, message);
}

static bl_status validate(const void *block, bl_message *message) {
    spline_parameters copy = *(const spline_parameters *)block;
    bl_status status = read_knots(&copy, message);
    return status == BL_OK ? bl_check_averaging(bl_filter_at(copy.averaging.filter),
                                                copy.averaging.width, 1, message)
                           : status;
}

static void describe(const void *block, bl_facts *facts) {
    const spline_parameters *p = block;
    const double *k = p->knot[p->component];
    *facts = bl_facts_unknown();
    if (bl_averaging_keeps_bounds(&p->averaging)) {
        facts->lower = INFINITY;
        facts->upper = -INFINITY;
        for (uint32_t i = 0; i + 3 < p->count; i++, k++) {
            double in = k[1] + (k[2] - k[0]) / 6, out = k[2] - (k[3] - k[1]) / 6;
            double size = fmax(fmax(fabs(k[0]), fabs(k[1])), fmax(fabs(k[2]), fabs(k[3])));
            facts->lower = fmin(facts->lower, fmin(fmin(k[1], k[2]), fmin(in, out)) - 1e-15 * size);
            facts->upper = fmax(facts->upper, fmax(fmax(k[1], k[2]), fmax(in, out)) + 1e-15 * size);
        }
        facts->bound_proof =
            "Bezier points hull each cubic, and a nowhere negative kernel "
            "averages it";
    }
    facts->mean = 0.5 * p->knot[p->component][1] + 0.5 * p->knot[p->component][p->count - 2];
    facts->continuity = bl_averaging_continuity(&p->averaging, 0);
    bl_primitive_period(facts, 0);
}

static const char *const components[] = {"luminance", "red", "green", "blue", NULL};
static const char *const examples[] = {"0/0/0;1/0.5/0;1/1/1;1/1/1", "1;1;1;1", "0;3;-2;1;5;0;0",
                                       NULL};

static const bl_parameter parameters[] = {
    {"knots", BL_TEXT, offsetof(spline_parameters, knots), "0;0;0.8;0.3;1;1", "knots",
     .examples = examples,
     .help = "numbers, or linear colours R/G/B, with ';' between them; the outer two set slopes"},
    {"component", BL_CHOICE, offsetof(spline_parameters, component), "luminance", "",
     .choices = components, .help = "of a colour, that the value is"},
    BL_AVERAGING_PARAMETERS(spline_parameters),
    {0}};

BL_PRIMITIVE_DESCRIPTOR(spline) = {
    .name = "spline",
    .title = "Catmull-Rom spline",
    .summary = "A smooth curve through evenly spaced knots, numbers or colours.",
    .formula = "cubics that pass a knot with half the difference of its neighbours as slope",
    .paper = "peachey2003, p. 34",
    .dimensions = 1,
    .parameters = parameters,
    .parameters_size = sizeof(spline_parameters),
    .validate = validate,
    .describe = describe,
    .functions = {BL_PRIMITIVE_FUNCTIONS, .colour = colour, .build = build}};
