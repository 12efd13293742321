// SPDX-License-Identifier: MIT
//
// wood: solid wood: rings about the z axis, moved by a noise, with fibres along the axis.
//
//   r = sqrt(x^2 + y^2) rings + wobble * noise(x, y, z / 4)
//   g = rise(frac(r)): smoothstep from 0 to 1 over the first 3/4 of a ring, back over the last
//   colour = mix(early, late, g) * (1 + fibre * noise(32 x, 32 y, z))
//
// Parameters
//   seed, noise   any noise of three dimensions; default gnoise
//   rings    in a unit; default 8
//   wobble   of the rings, in rings; default 1
//   fibre    of the fibres; 0 to 0.5; default 0.35
//   filter   none
//            clamp     rings go to their mean, and fibres away, at the Nyquist limit of the width
//            fade      the same, from half the limit on
//            integral  the exact average of the rings over the width along the radius (as if the
//                      noise stood still within it), and fibres faded
//   width, component   see textures/texture.h
//
// Bound: colours are cut to [0, 1]; with the default noise nothing is cut. Mean: half way between
// early and late wood, since a ring's mean is 1/2 and the noise's is 0 (exact far from the axis and
// with a wobble of a ring or more, so it is not stated). Period: none. Class C1, except for the
// axis. NaN and infinite places give NaN, and those beyond 2^50 units (where fibres have no
// fraction).
//
// Source: the text shows solid wood in figure 2.1 without a listing; rings about an axis with noise
// are those of perlin1985. All numbers are ours.
#include <math.h>

#include "filters/octave_fade.h"
#include "textures/colour_spline.h"
#include "textures/noise_source.h"
#include "textures/sampling.h"

typedef struct wood_parameters {
    bl_noise_source noise;
    double rings, wobble, fibre;
    bl_seeing seeing;
} wood_parameters;

enum { NONE, CLAMP, FADE, INTEGRAL }; // the first three as bl_octave_clamp
static const char *const filter_words[] = {"none", "clamp", "fade", "integral", NULL};
static const bl_colour early = {{0.55, 0.30, 0.12}}, late = {{0.22, 0.09, 0.03}};

#define RISE 0.75 // of a ring
#define FIBRES 32 // in a unit, across

static double ring(double r) {
    r -= floor(r);
    return bl_unit_smoothstep(r / RISE) - bl_unit_smoothstep((r - RISE) / (1 - RISE));
}

// The integral from 0.
static double ring_integral(double r) {
    double whole = floor(r), part = r - whole;
    double u = fmin(part / RISE, 1), v = part > RISE ? (part - RISE) / (1 - RISE) : 0;
    return 0.5 * whole + RISE * bl_unit_smoothstep_integral(u) +
           (1 - RISE) * (v - bl_unit_smoothstep_integral(v));
}

static double ring_average(double r, double width) {
    r -= floor(r);
    if (!(width > 1e-9)) // where the difference has fewer digits than the middle
        return ring(r);
    return (ring_integral(r + 0.5 * width) - ring_integral(r - 0.5 * width)) / width;
}

static double share_of_late(const wood_parameters *p, double r, double width) {
    if (p->seeing.filter == INTEGRAL)
        return ring_average(r, width * p->rings);
    double kept = bl_octave_kept(p->rings, (bl_octave_clamp)p->seeing.filter, width);
    return kept < 1 ? 0.5 + (ring(r) - 0.5) * kept : ring(r);
}

// What the two noises of a sample make of it: that of the rings, and that of the fibres.
static bl_colour colour_of(const wood_parameters *p, const double at[BL_AXES], double width,
                           double fibre, const double noise[2]) {
    double r = p->rings * sqrt(at[0] * at[0] + at[1] * at[1]) + p->wobble * noise[0];
    bl_colour seen = bl_colour_mix(early, late, share_of_late(p, r, width));
    for (int c = 0; c < 3; c++)
        seen.rgb[c] *= 1 + (fibre > 0 ? fibre * noise[1] : 0);
    return bl_colour_clamp(seen);
}

// How strong the fibres of a sample are.
static double fibre_of(const wood_parameters *p, double width) {
    bl_octave_clamp clamp =
        p->seeing.filter == INTEGRAL ? BL_CLAMP_FADE : (bl_octave_clamp)p->seeing.filter;
    return p->fibre * bl_octave_kept(FIBRES, clamp, width);
}

// Up to BL_BATCH samples.
static void see_batch(const wood_parameters *p, const bl_samples *samples, double *rgb) {
    bl_gathered rings = {.count = 0}, fibres = {.count = 0};
    double width[BL_BATCH], fibre[BL_BATCH], noise[BL_BATCH], noises[BL_BATCH][2];
    for (size_t i = 0; i < samples->count; i++) {
        const bl_footprint *footprint = bl_samples_footprint(samples, i);
        double at[BL_AXES], widest = bl_footprint_widest(footprint, 3);
        bl_samples_place(samples, i, at);
        if (!bl_texture_is_seen(at, footprint, 3) || fabs(at[0]) > 0x1p50 || fabs(at[1]) > 0x1p50) {
            bl_colour_put(bl_colour_missing, rgb + 3 * i);
        } else if (bl_footprint_is_whole(footprint, 3) ||
                   (isinf(widest) && p->seeing.filter != NONE)) {
            bl_colour_put(bl_colour_mix(early, late, 0.5), rgb + 3 * i);
        } else {
            width[i] = isinf(widest) ? 0 : widest;
            fibre[i] = fibre_of(p, width[i]);
            bl_gather(&rings, i, (const double[BL_AXES]){at[0], at[1], 0.25 * at[2]});
            if (fibre[i] > 0)
                bl_gather(&fibres, i,
                          (const double[BL_AXES]){FIBRES * at[0], FIBRES * at[1], at[2]});
        }
    }
    bl_signal_values_gathered(p->noise.signal, &rings, noise);
    for (size_t k = 0; k < rings.count; k++)
        noises[rings.of[k]][0] = noise[k];
    bl_signal_values_gathered(p->noise.signal, &fibres, noise);
    for (size_t k = 0; k < fibres.count; k++)
        noises[fibres.of[k]][1] = noise[k];
    for (size_t k = 0; k < rings.count; k++) {
        size_t i = rings.of[k];
        double at[BL_AXES];
        bl_samples_place(samples, i, at);
        bl_colour_put(colour_of(p, at, width[i], fibre[i], noises[i]), rgb + 3 * i);
    }
}

BL_TEXTURE_BATCH_ABILITIES(wood_parameters)

static bl_status build(void *block, bl_opener *open, bl_message *message) {
    (void)open;
    wood_parameters *p = block;
    return bl_noise_source_open(&p->noise, p->noise.text, 3, message);
}

static void release(void *block) {
    bl_noise_source_close(&((wood_parameters *)block)->noise);
}

static void describe(const void *block, bl_facts *facts) {
    const wood_parameters *p = block;
    const bl_colour ends[] = {{{0, 0, 0}}, {{1, 1, 1}}};
    *facts = bl_facts_unknown();
    bl_texture_bound(facts, p->seeing.component, ends, 2, "colours are cut to [0, 1]");
    for (int a = 0; a < 2; a++)
        facts->period[a] = 0;
    facts->far = 0x1p50 / FIBRES;
}

// clang-format off
#define NUMBER(field, usual, most, in, what)                                                       \
    {#field, BL_REAL, offsetof(wood_parameters, field), usual, in, .maximum = most,                \
     .help = what}
// clang-format on
static const bl_parameter parameters[] = {
    BL_NOISE_SOURCE_PARAMETERS(wood_parameters, noise, "gnoise"),
    NUMBER(rings, "8", 1e6, "rings per unit", "along the radius"),
    NUMBER(wobble, "1", 1e6, "rings", "of the rings, times the noise"),
    NUMBER(fibre, "0.35", 0.5, "", "how much darker and lighter fibres are"),
    BL_SEEING_PARAMETERS(wood_parameters, filter_words),
    {0}};

BL_TEXTURE_DESCRIPTOR(wood) = {
    .name = "wood",
    .title = "solid wood",
    .summary = "Rings about the z axis, moved by a noise, with fibres along it.",
    .formula = "mix(early, late, ring(r rings + wobble noise)) (1 + fibre noise)",
    .paper = "peachey2003, fig. 2.1",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(wood_parameters),
    .describe = describe,
    .picture = {.scale = 2, .at = {0.6, 0.25, 0.4}, .normal = {0.2, -1, 0.3}},
    .functions = {BL_TEXTURE_FUNCTIONS, .build = build, .release = release}};
