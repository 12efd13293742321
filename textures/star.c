// SPDX-License-Identifier: MIT
//
// star: a yellow star in the middle of the unit square, on a field of blue.
//
//   (s, t) - (1/2, 1/2) in polar coordinates, folded onto half a point of the star, is inside if it
//   lies on the inner side of the edge from (rmax, 0) to rmin (cos pi/n, sin pi/n)
//
// Parameters
//   npoints      3 to 32; default 5
//   rmin, rmax   radius of the notches and of the tips, units; defaults 0.07 and 0.2
//   form         corrected; printed: the text takes the fraction of a point (0 to 1/2) for the
//                angle in radians, so that edges become curves and the star too fat
//   filter   none
//            boxstep, smoothstep  the step across the edge becomes a ramp or a cubic as wide as the
//                                 sample's box across the edge. Right along an edge; not at tips
//                                 and notches, nor where the sample is wider than the star
//            exact                the area of the star within the box of the sample; of the
//                                 corrected form, and for widths above 0 along both axes or none
//   width, component   see textures/texture.h
//
// Bound: between two colours. Mean over the plane, and infinite width: the field. Period: none.
// NaN and infinite places give NaN.
//
// Source: peachey2003, pp. 46-48.
#include <math.h>

#include "textures/star_shape.h"
#include "textures/texture.h"

typedef struct star_parameters {
    uint32_t npoints, form;
    double rmin, rmax;
    bl_seeing seeing;
} star_parameters;

enum { NONE, BOXSTEP, SMOOTHSTEP, EXACT }; // the first three as bl_edge
static const char *const filter_words[] = {"none", "boxstep", "smoothstep", "exact", NULL};
static const char *const form_words[] = {"corrected", "printed", NULL};
static const bl_colour field_colour = {{0.05, 0.12, 0.4}}, star_colour = {{1.0, 0.5161, 0.0}};

static double share_of_star(const star_parameters *p, const double at[BL_AXES],
                            const double width[BL_AXES]) {
    const bl_star star = {
        .points = p->npoints, .inner = p->rmin, .outer = p->rmax, .printed = (int)p->form};
    double s = at[0] - 0.5, t = at[1] - 0.5;
    if (isinf(width[0]) || isinf(width[1]))
        return 0;
    if (p->seeing.filter == EXACT && width[0] > 0 && width[1] > 0)
        return bl_star_coverage(&star, s, t, width);
    return bl_star_step(
        &star, p->seeing.filter == EXACT ? BL_EDGE_SHARP : (bl_edge)p->seeing.filter, s, t, width);
}

static bl_colour see(const star_parameters *p, const double at[BL_AXES],
                     const bl_footprint *footprint) {
    return bl_colour_mix(field_colour, star_colour, share_of_star(p, at, footprint->width));
}

BL_TEXTURE_ABILITIES(star_parameters, 2)

static bl_status validate(const void *block, bl_message *message) {
    const star_parameters *p = block;
    if (p->form && p->seeing.filter == EXACT)
        return bl_report(message, BL_USAGE,
                         "filter=exact knows the area of the star with straight edges; use "
                         "form=corrected, or another filter");
    return BL_OK;
}

static void describe(const void *block, bl_facts *facts) {
    const star_parameters *p = block;
    const bl_colour ends[] = {field_colour, star_colour};
    int point = p->seeing.width == 0 || p->seeing.filter == NONE;
    *facts = bl_facts_unknown();
    bl_texture_bound(facts, p->seeing.component, ends, 2, "it lies between two colours");
    bl_texture_mean(facts, p->seeing.component, field_colour);
    facts->continuity = point ? -1 : p->seeing.filter == EXACT ? 0 : -2;
    facts->period[0] = facts->period[1] = 0;
}

// clang-format off
#define RADIUS(field, usual, what)                                                                 \
    {#field, BL_REAL, offsetof(star_parameters, field), usual, "units", .minimum = 1e-6,           \
     .maximum = 1e6, .help = what}
// clang-format on
static const bl_parameter parameters[] = {
    {"npoints", BL_INTEGER, offsetof(star_parameters, npoints), "5", "", .minimum = 3,
     .maximum = BL_STAR_POINTS_MOST, .help = "tips of the star"},
    RADIUS(rmin, "0.07", "from the centre to the notches"),
    RADIUS(rmax, "0.2", "from the centre to the tips"),
    {"form", BL_CHOICE, offsetof(star_parameters, form), "corrected", "", .choices = form_words,
     .help = "or as printed, with the wrong angle"},
    BL_SEEING_PARAMETERS(star_parameters, filter_words),
    {0}};

BL_TEXTURE_DESCRIPTOR(star) = {.name = "star",
                               .title = "star",
                               .summary = "A star in the middle of the unit square.",
                               .formula = "mix(field, star, step(0, distance to the edge inwards))",
                               .paper = "peachey2003, p. 46",
                               .dimensions = 2,
                               .parameters = parameters,
                               .parameters_size = sizeof(star_parameters),
                               .validate = validate,
                               .describe = describe,
                               .picture = {.scale = 0.5, .at = {0.5, 0.5}},
                               .functions = {BL_TEXTURE_FUNCTIONS}};
