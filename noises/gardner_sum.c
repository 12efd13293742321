// SPDX-License-Identifier: MIT
//
// gardner: Gardner's sum of cosines, the clouds of the text: products of two cosine waves whose
// phases depend on the other coordinate.
//
//   n(x, y) = sum over i = 0 .. terms-1 of  A_i^2 (1/2 + cos a_i) (1/2 + cos b_i)
//   a_i = 2 pi u_i (x + f_i),   f_0 = 0.9,   f_i = 0.9 pi/2 cos(2 pi v_{i-1} y)
//   b_i = 2 pi v_i (y + g_i),   g_0 = 0.7,   g_i = 1.1 pi/2 cos(2 pi u_{i-1} x)
//   u_0 = 0.023, u_{i+1} = u_i (1.9 + 0.1 i);   v_0 = 0.021, v_{i+1} = v_i (2.2 - 0.08 i)
//   A_0 = 0.3, A_{i+1} = 0.707 A_i;   x and y are the coordinates plus the text's offsets 13 and 96
//
// Parameters
//   seed    0: the text's place; any other moves the place by up to 2^10 units along each axis.
//           There is nothing else to draw: it is one function
//   terms   1 to 8; default 5, the text's
//   width   units between samples, 0 to inf, which keeps the mean alone; default 0, which
//           keeps all terms
//   clamp   fade, hard or none: how a term goes whose larger frequency u_i or v_i is beyond
//           1/(2 width); the weights are those of noises/octaves/octaves.h. It leaves its mean
//           A_i^2/4
//
// Units: those of the text's shader; the coarsest wave is 43 units long, the finest of 5 terms 2.5.
// Dimensions: 2.
// Bound: 1/2 + cos lies in [-1/2, 3/2], a product of two in [-3/4, 9/4], times the sum of A_i^2:
// [-0.131, 0.392] for 5 terms. The bounds are closed: they are for one term reached.
// Mean: the sum of A_i^2/4, exact over all the plane. Every cross term has the mean 0, because cos
// a_i is a wave in x whose frequency u_i is no sum of harmonics of the u_{i-1} within b_i and their
// like in y at once: u_2 = 2 u_1, but v_2 = 2.12 v_1.
// Variance: exact for at most 7 terms, from the covariance over places, which is a closed form
// without an end (noises/octaves/gardner_theory.h): its spectrum is one of lines. Band: not stated;
// phases that wave make sidebands beyond the nominal frequencies, at sums with multiples of u_{i-1}
// and v_{i-1}. Class: C-infinity, all derivatives exist.
// Period: that of the frequencies, which are whole multiples of a common one: with 5 terms
// 10869.565... (250000/23) units along x and 3720238.095... (78125000/21) along y; to rounding,
// because these are no doubles. Far: 2^52, where doubles are whole.
// NaN, an infinity, and coordinates beyond 2^62 give NaN. Rows and points are computed in double
// with a cosine of their own, wrong by less than 7e-12, and rounded to float at the end.
//
// Known defects: regular waves shine through (the text's own complaint), the two directions of the
// axes are preferred, and there is no seed but the place.
// Source: peachey2003, pp. 51-52 (cloudplane), after Gardner (1984, 1985). Deviations: the text
// then clamps to [0, 1] before it mixes colours; only the limit at 0 is ever reached; that is left
// to the texture. Its frequencies are radians; here the same numbers as cycles.
#include <math.h>
#include <stddef.h>

#include "core/continuity.h"
#include "core/random.h"
#include "noises/common_parameters.h"
#include "noises/octaves/gardner_theory.h"
#include "noises/lattice/reference.h"
#include "noises/noise.h"
#include "noises/octaves/octaves.h"
#include "noises/lattice/separable.h"

enum { TERMS_MOST = BL_GARDNER_TERMS };

typedef struct gardner_parameters {
    uint64_t seed;
    uint32_t terms, clamp;
    double width;
} gardner_parameters;

#define FIRST_X_PHASE 0.9
#define FIRST_Y_PHASE 0.7
#define X_PHASE BL_GARDNER_X_PHASE
#define Y_PHASE BL_GARDNER_Y_PHASE

static bl_gardner_terms terms_of(const void *block) {
    const gardner_parameters *p = block;
    bl_gardner_terms terms = {.x = 13, .y = 96};
    double across = 0.023, up = 0.021, amplitude = 0.3;
    for (unsigned i = 0; i < p->terms; i++) {
        double square = amplitude * amplitude;
        double kept = bl_octave_kept(fmax(across, up), (bl_octave_clamp)p->clamp, p->width);
        terms.all += square;
        terms.lost += (1 - kept) * square / 4;
        if (kept > 0) { // frequencies rise, so the terms kept are the first ones
            terms.across[i] = across;
            terms.up[i] = up;
            terms.square[i] = kept * square;
            terms.count = i + 1;
        }
        across *= 1.9 + i * 0.1;
        up *= 2.2 - i * 0.08;
        amplitude *= 0.707;
    }
    if (terms.count == 0)
        terms.lost = (double)(float)terms.lost; // one number in float and in double
    if (p->seed) {
        bl_random random = bl_random_seed(p->seed, 0);
        terms.x += floor(0x1p30 * bl_random_unit(&random)) * 0x1p-20;
        terms.y += floor(0x1p30 * bl_random_unit(&random)) * 0x1p-20;
    }
    return terms;
}

// --- points -------------------------------------------------------------------------------------

// Whole turns are taken off before a phase is added: the sum of a place of 1e15 and a phase would
// round to an eighth, so that phases a hair apart, as those of floats and doubles, would part.
BL_INLINE double turns_of(double t) {
    return t - floor(t + 0.5);
}

// cos(2 pi t) = sin(z), z = 2 pi (1/4 - |t - round t|) in [-pi/2, pi/2], by its Taylor polynomial
// of degree 15: the error is below the next term, (pi/2)^17 / 17! = 6.1e-12.
BL_INLINE double cosine_of_turns(double t) {
    double r = fabs(turns_of(t));
    double z = 2 * M_PI * (0.25 - r), s = z * z;
    double sum = 1 - s * (1.0 / (14 * 15));
    sum = 1 - s * (1.0 / (12 * 13)) * sum;
    sum = 1 - s * (1.0 / (10 * 11)) * sum;
    sum = 1 - s * (1.0 / (8 * 9)) * sum;
    sum = 1 - s * (1.0 / (6 * 7)) * sum;
    sum = 1 - s * (1.0 / (4 * 5)) * sum;
    sum = 1 - s * (1.0 / (2 * 3)) * sum;
    return z * sum;
}

typedef struct gardner_block {
    double x[BL_BLOCK], y[BL_BLOCK], x_phase[BL_BLOCK], y_phase[BL_BLOCK], sum[BL_BLOCK];
} gardner_block;

static void add_term(gardner_block *restrict block, size_t count, double across, double up,
                     double square) {
#pragma omp simd
    for (size_t i = 0; i < count; i++) {
        double x = turns_of(across * block->x[i]), y = turns_of(up * block->y[i]);
        double first = 0.5 + cosine_of_turns(x + across * block->x_phase[i]);
        double second = 0.5 + cosine_of_turns(y + up * block->y_phase[i]);
        block->sum[i] += square * (first * second);
        block->x_phase[i] = X_PHASE * cosine_of_turns(y);
        block->y_phase[i] = Y_PHASE * cosine_of_turns(x);
    }
}

static void points(const void *parameters, const double *const at[BL_AXES], size_t count,
                   float *out) {
    bl_gardner_terms terms = terms_of(parameters);
    gardner_block block;
    for (size_t done = 0; done < count; done += BL_BLOCK) {
        size_t here = count - done < BL_BLOCK ? count - done : BL_BLOCK;
        for (size_t i = 0; i < here; i++) {
            double x = at[0][done + i], y = at[1][done + i];
            int inside = fabs(x) < 0x1p62 && fabs(y) < 0x1p62;
            block.x[i] = inside ? x + terms.x : 0;
            block.y[i] = inside ? y + terms.y : 0;
            block.x_phase[i] = FIRST_X_PHASE;
            block.y_phase[i] = FIRST_Y_PHASE;
            block.sum[i] = inside ? terms.lost : (double)NAN;
        }
        for (unsigned term = 0; term < terms.count; term++)
            add_term(&block, here, terms.across[term], terms.up[term], terms.square[term]);
        for (size_t i = 0; i < here; i++)
            out[done + i] = (float)block.sum[i];
    }
}

BL_ROW_OF_POINTS

// --- the reference in double --------------------------------------------------------------------

static double wave(double turns, double *slope) {
    double angle = 2 * M_PI * turns_of(turns);
    *slope = -2 * M_PI * sin(angle); // by the turns
    return cos(angle);
}

static double reference(const bl_gardner_terms *terms, const double at[BL_AXES],
                        double gradient[BL_AXES]) {
    double x = at[0] + terms->x, y = at[1] + terms->y, sum = terms->lost;
    double x_phase = FIRST_X_PHASE, y_phase = FIRST_Y_PHASE, x_phase_slope = 0, y_phase_slope = 0;
    int inside = fabs(at[0]) < 0x1p62 && fabs(at[1]) < 0x1p62;
    for (int a = 0; gradient && a < BL_AXES; a++)
        gradient[a] = inside ? 0 : NAN;
    for (unsigned i = 0; inside && i < terms->count; i++) {
        double u = terms->across[i], v = terms->up[i], slopes[4];
        double x_turns = turns_of(u * x), y_turns = turns_of(v * y);
        double first = 0.5 + wave(x_turns + u * x_phase, &slopes[0]);
        double second = 0.5 + wave(y_turns + v * y_phase, &slopes[1]);
        sum += terms->square[i] * first * second;
        if (gradient) {
            double to_first = terms->square[i] * second * slopes[0] * u;
            double to_second = terms->square[i] * first * slopes[1] * v;
            gradient[0] += to_first + to_second * y_phase_slope;
            gradient[1] += to_first * x_phase_slope + to_second;
        }
        x_phase = X_PHASE * wave(y_turns, &slopes[2]);
        y_phase = Y_PHASE * wave(x_turns, &slopes[3]);
        x_phase_slope = X_PHASE * slopes[2] * v;
        y_phase_slope = Y_PHASE * slopes[3] * u;
    }
    return inside ? sum : NAN;
}

static double value_at(const void *block, const bl_gardner_terms *terms, const double at[BL_AXES]) {
    (void)block;
    return reference(terms, at, NULL);
}

BL_VALUES_OF_OPENED(bl_gardner_terms, terms_of)

static void gradient(const void *parameters, const double at[BL_AXES], double out[BL_AXES]) {
    const bl_gardner_terms terms = terms_of(parameters);
    reference(&terms, at, out);
}

// u_i = 0.023 prod (19 + j)/10 and v_i = 0.021 prod (220 - 8 j)/100, j < i, as whole numbers over
// 10^3 denominator^7: the largest is 21 * 220 * 212 ... 172 < 2^58.
typedef struct multipliers {
    uint64_t first, start, denominator;
    int64_t change;
} multipliers;
#define X_MULTIPLIERS ((multipliers){23, 19, 10, 1})
#define Y_MULTIPLIERS ((multipliers){21, 220, 100, -8})

// Waves whose frequencies are whole multiples of a number repeat after one over it, and after
// nothing smaller if it is the largest such number.
static double period_of(unsigned count, multipliers m) {
    uint64_t common = 0, unit = 1;
    for (unsigned i = 0; i < TERMS_MOST - 1; i++)
        unit *= m.denominator;
    for (unsigned i = 0; i < count; i++) {
        uint64_t frequency = m.first;
        for (unsigned j = 0; j < TERMS_MOST - 1; j++)
            frequency *= j < i ? m.start + (uint64_t)(m.change * (int64_t)j) : m.denominator;
        for (uint64_t rest; frequency; frequency = rest) { // Euclid
            rest = common % frequency;
            common = frequency;
        }
    }
    return 1000.0 * (double)unit / (double)common;
}

static double covariance(const void *parameters, const double lag[BL_AXES]) {
    bl_gardner_terms terms = terms_of(parameters);
    return bl_gardner_covariance(&terms, lag);
}

static int has_closed_form(const void *parameters) {
    unsigned count = terms_of(parameters).count;
    return count > 0 && count <= BL_GARDNER_KNOWN;
}

static void describe(const void *parameters, bl_facts *facts) {
    bl_gardner_terms terms = terms_of(parameters);
    double kept = 0;
    for (unsigned i = 0; i < terms.count; i++)
        kept += terms.square[i];
    facts->lower = terms.lost - 0.75 * kept;
    facts->upper = terms.lost + 2.25 * kept;
    facts->bound_proof = "products of two numbers in [-1/2, 3/2] lie in [-3/4, 9/4]";
    facts->mean = terms.count ? terms.all / 4 : terms.lost;
    if (terms.count == 0)
        facts->variance = 0;
    if (has_closed_form(parameters)) {
        facts->variance = bl_gardner_covariance(&terms, (const double[BL_AXES]){0});
        facts->covariance_reach = INFINITY;
    }
    facts->continuity = BL_CONTINUITY_ALL;
    for (int a = 0; a < BL_AXES; a++)
        facts->period[a] = 0;
    if (terms.count) {
        facts->period[0] = period_of(terms.count, X_MULTIPLIERS);
        facts->period[1] = period_of(terms.count, Y_MULTIPLIERS);
    }
    facts->cell = 0;
    facts->far = 0x1p52;
}

// The text's cloud plane, in radians, a call a point.
static float textbook(float x, float y, float z) {
    (void)z;
    float sum = 0, amplitude = 0.3f, x_phase = 0.9f, y_phase = 0.7f;
    float across = 6.2831853f * 0.023f, up = 6.2831853f * 0.021f;
    x += 13;
    y += 96;
    for (int i = 0; i < 5; i++) {
        float first = amplitude * (0.5f + cosf(across * (x + x_phase)));
        float second = amplitude * (0.5f + cosf(up * (y + y_phase)));
        sum += first * second;
        x_phase = 1.5707963f * 0.9f * cosf(up * y);
        y_phase = 1.5707963f * 1.1f * cosf(across * x);
        across *= 1.9f + (float)i * 0.1f;
        up *= 2.2f - (float)i * 0.08f;
        amplitude *= 0.707f;
    }
    return sum;
}

static const bl_parameter parameters[] = {
    BL_SEED_PARAMETER(gardner_parameters, seed, "the place; 0 is the text's"),
    {"terms", BL_INTEGER, offsetof(gardner_parameters, terms), "5", "", .minimum = 1,
     .maximum = TERMS_MOST, .help = "how many products of waves"},
    {"width", BL_REAL, offsetof(gardner_parameters, width), "0", "units", .maximum = INFINITY,
     .help = "between samples: terms beyond 1/(2 width) are removed; 0 keeps all"},
    {"clamp", BL_CHOICE, offsetof(gardner_parameters, clamp), "fade", "",
     .choices = bl_octave_clamps,
     .help = "how terms beyond the Nyquist limit of the width are removed"},
    {0}};

BL_NOISE_DESCRIPTOR(gardner_sum) = {
    .name = "gardner",
    .title = "Gardner's cosine sum",
    .summary = "Products of two cosine waves, each with a phase that waves along the other axis.",
    .formula = "n(x,y) = sum_i A_i^2 (1/2 + cos a_i(x; y)) (1/2 + cos b_i(y; x))",
    .paper = "peachey2003, pp. 51-52",
    .dimensions = 2,
    .parameters = parameters,
    .parameters_size = sizeof(gardner_parameters),
    .describe = describe,
    .textbook = textbook,
    .textbook_settings = "",
    .has_closed_form = has_closed_form,
    .functions = {BL_NOISE_FUNCTIONS, .values = values, .gradient = gradient,
                  .covariance = covariance},
};
