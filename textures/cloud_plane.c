// SPDX-License-Identifier: MIT
//
// cloudplane: Gardner's clouds on a flat sky.
//
//   colour = mix(sky, cloud, clamp(gardner(s, t), 0, 1)),  gardner as in noises/gardner_sum.c
//
// Parameters
//   seed     0: the text's place; any other moves it
//   terms    1 to 8; default 5, the text's
//   contrast 0 to 100: what the sum is multiplied by before it is clamped; default 1, the text's,
//            with which no cloud has more than 39 % of white
//   filter   none
//            clamp, fade  terms whose frequency is beyond the Nyquist limit of the width are
//                         removed, at once or from half the limit on, and leave their mean. What
//                         their folding at 0 would have given to the mean is lost
//   width, component   see textures/texture.h
//
// A term's part in the sum is the difference of two sums, so that no loop over terms stands here:
// sum over i of kept_i (g_i - g_{i-1}) + (1 - kept_i) mean_i, of which only the g_i that stand
// between different weights are evaluated.
//
// Bound: between sky and cloud. Mean: not stated; infinite width gives the midpoint rule over 64 x
// 64 places. Period: that of gardner, in thousands of units. NaN and infinite places give NaN.
//
// Source: peachey2003, pp. 51-52. The text's `clamp` never acts above 0.39; it cuts at 0.
#include <math.h>
#include <stdio.h>

#include "filters/octave_fade.h"
#include "textures/noise_source.h"
#include "textures/sampling.h"
#include "textures/texture.h"

enum { TERMS_MOST = 8 };

typedef struct cloud_plane_parameters {
    uint64_t seed;
    uint32_t terms;
    double contrast;
    bl_seeing seeing;
    bl_signal *sum[TERMS_MOST]; // of the first 1, 2, ... terms; made on opening
    bl_colour mean;
} cloud_plane_parameters;

enum { NONE, CLAMP, FADE }; // as bl_octave_clamp
static const char *const filter_words[] = {"none", "clamp", "fade", NULL};
static const bl_colour sky = {{0.16, 0.35, 0.78}}, cloud = {{1, 1, 1}};

// The larger frequency of a term, of both axes, and the mean of its product (gardner_sum.c).
static double kept_of(unsigned term, bl_octave_clamp clamp, double width) {
    double across = 0.023, up = 0.021;
    for (unsigned i = 0; i < term; i++) {
        across *= 1.9 + i * 0.1;
        up *= 2.2 - i * 0.08;
    }
    return bl_octave_kept(fmax(across, up), clamp, width);
}

// The sums of terms at many places, for samples of these widths. A place needs the sum of the first
// terms only where the last of them and the next have different weights.
static void sum_terms(const cloud_plane_parameters *p, const bl_gathered *places,
                      const double *width, double *sum) {
    const bl_octave_clamp clamp = (bl_octave_clamp)p->seeing.filter;
    double here[BL_BATCH], next[BL_BATCH], noise[BL_BATCH], mean_before = 0;
    for (size_t k = 0; k < places->count; k++) {
        sum[k] = 0;
        here[k] = kept_of(0, clamp, width[k]);
    }
    for (unsigned i = 0; i < p->terms; i++) {
        bl_gathered asked;
        asked.count = 0;
        for (size_t k = 0; k < places->count; k++) {
            next[k] = i + 1 < p->terms ? kept_of(i + 1, clamp, width[k]) : 0;
            if (here[k] != next[k])
                bl_gather(&asked, k, (const double[BL_AXES]){places->at[0][k], places->at[1][k]});
        }
        bl_signal_values_gathered(p->sum[i], &asked, noise);
        for (size_t n = 0; n < asked.count; n++)
            sum[asked.of[n]] += (here[asked.of[n]] - next[asked.of[n]]) * noise[n];
        double mean = p->sum[i]->facts.mean;
        for (size_t k = 0; k < places->count; k++) {
            sum[k] += (1 - here[k]) * (mean - mean_before);
            here[k] = next[k];
        }
        mean_before = mean;
    }
}

static bl_colour colour_of(const cloud_plane_parameters *p, double sum) {
    double share = p->contrast * sum;
    return bl_colour_mix(sky, cloud, share <= 0 ? 0 : share >= 1 ? 1 : share);
}

// Up to BL_BATCH samples.
static void see_batch(const cloud_plane_parameters *p, const bl_samples *samples, double *rgb) {
    bl_gathered inside = {.count = 0};
    double width[BL_BATCH], sum[BL_BATCH];
    for (size_t i = 0; i < samples->count; i++) {
        const bl_footprint *footprint = bl_samples_footprint(samples, i);
        double at[BL_AXES];
        bl_samples_place(samples, i, at);
        if (!bl_texture_is_seen(at, footprint, 2)) {
            bl_colour_put(bl_colour_missing, rgb + 3 * i);
        } else if (bl_footprint_is_whole(footprint, 2)) {
            bl_colour_put(p->mean, rgb + 3 * i);
        } else {
            width[inside.count] = bl_footprint_widest(footprint, 2);
            bl_gather(&inside, i, at);
        }
    }
    sum_terms(p, &inside, width, sum);
    for (size_t k = 0; k < inside.count; k++)
        bl_colour_put(colour_of(p, sum[k]), rgb + 3 * inside.of[k]);
}

BL_TEXTURE_BATCH_ABILITIES(cloud_plane_parameters)

static void release(void *block) {
    cloud_plane_parameters *p = block;
    for (int i = 0; i < TERMS_MOST; i++) {
        bl_signal_free(p->sum[i]);
        p->sum[i] = NULL;
    }
}

// Places over 1000 x 1000 units, which have 23 waves of the coarsest term across.
static bl_colour mean_of(const cloud_plane_parameters *p) {
    enum { PLACES = 64 };
    _Static_assert((int)PLACES <= (int)BL_BATCH, "a row is one batch");
    static const double points[PLACES];
    bl_colour mean = {{0, 0, 0}};
    for (int j = 0; j < PLACES; j++) {
        bl_gathered places = {.count = 0};
        double sum[BL_BATCH];
        for (int i = 0; i < PLACES; i++)
            bl_gather(
                &places, (size_t)i,
                (const double[BL_AXES]){1000 * (i + 0.5) / PLACES, 1000 * (j + 0.5) / PLACES});
        sum_terms(p, &places, points, sum);
        for (int i = 0; i < PLACES; i++) {
            bl_colour seen = colour_of(p, sum[i]);
            for (int c = 0; c < 3; c++)
                mean.rgb[c] += seen.rgb[c] / ((double)PLACES * PLACES);
        }
    }
    return mean;
}

static bl_status build(void *block, bl_opener *open, bl_message *message) {
    (void)open;
    cloud_plane_parameters *p = block;
    bl_status status = BL_OK;
    for (int i = 0; i < TERMS_MOST; i++) // of a copied block, those of the other
        p->sum[i] = NULL;
    for (unsigned i = 0; i < p->terms && status == BL_OK; i++) {
        bl_noise_source terms = {.seed = p->seed};
        char text[32];
        snprintf(text, sizeof text, "gardner:terms=%u", i + 1);
        status = bl_noise_source_open(&terms, text, 2, message);
        p->sum[i] = terms.signal;
    }
    if (status == BL_OK)
        p->mean = mean_of(p);
    else
        release(p);
    return status;
}

static void describe(const void *block, bl_facts *facts) {
    const cloud_plane_parameters *p = block;
    const bl_colour ends[] = {sky, cloud};
    *facts = bl_facts_unknown();
    bl_texture_bound(facts, p->seeing.component, ends, 2, "it lies between two colours");
    facts->continuity = 0; // the clamp bends it
    for (int a = 0; a < 2; a++)
        facts->period[a] = p->sum[p->terms - 1]->facts.period[a];
}

static const bl_parameter parameters[] = {
    {"seed", BL_SEED, offsetof(cloud_plane_parameters, seed), "0", "",
     .help = "of the place; 0 is the text's"},
    {"terms", BL_INTEGER, offsetof(cloud_plane_parameters, terms), "5", "", .minimum = 1,
     .maximum = TERMS_MOST, .help = "how many products of waves"},
    {"contrast", BL_REAL, offsetof(cloud_plane_parameters, contrast), "1", "", .maximum = 100,
     .help = "what the sum is multiplied by; 2.5 makes the thickest cloud white"},
    BL_SEEING_PARAMETERS(cloud_plane_parameters, filter_words),
    {0}};

BL_TEXTURE_DESCRIPTOR(cloud_plane) = {
    .name = "cloudplane",
    .title = "clouds on a flat sky",
    .summary = "Gardner's sum of cosines between the colours of sky and cloud.",
    .formula = "mix(sky, cloud, clamp(contrast gardner(s, t), 0, 1))",
    .paper = "peachey2003, p. 51",
    .dimensions = 2,
    .parameters = parameters,
    .parameters_size = sizeof(cloud_plane_parameters),
    .describe = describe,
    .picture = {.scale = 80},
    .functions = {BL_TEXTURE_FUNCTIONS, .build = build, .release = release}};
