// SPDX-License-Identifier: MIT
//
// gabor: Gabor noise, a sparse convolution of Poisson impulses with Gabor kernels: power in a band
// around a chosen frequency, in one direction or in all.
//
//   n(p) = 1/sqrt N  sum over cells c, impulses k of  w_ck g(|d|) cos(2 pi (F u.d + phi_ck)),
//   d = p - c - x_ck,   g(r) = e^(-pi a^2 r^2) for r < 1, 0 beyond
//
// x_ck uniform in the cell; the number of impulses in a cell is Poisson with mean N (impulses.h).
//
// Parameters
//   seed, lattice, component, period   of the impulses, as for every lattice noise
//   frequency    F, 0 to 4 cycles a cell
//   bandwidth    a, 1 to 4 cycles a cell: g falls to e^-pi = 4.3 % at r = 1/a. The spectrum is a
//                Gaussian of standard deviation a / (2 sqrt pi) = 0.28 a around F
//   kind         anisotropic: one direction u; isotropic: a direction of its own for each impulse,
//                uniform on the circle
//   orientation  -360 to 360 degrees, of u from x towards y, of kind=anisotropic
//   phase        random: w = 1, phi uniform (lagae2011); zero: w uniform in (-1, 1), phi = 0, the
//                kernel of lagae2009
//   impulses     N, 1 to 64 a cell
//
// Kernel and cell. The paper truncates g where it falls to a threshold T, at the radius
// r = sqrt(-ln T / pi) / a, and takes cells of that size, so that the 3 x 3 cells around a point
// hold all that reaches it. Here the cell is 1 and so is the radius: T = e^(-pi a^2), 4.3 % for
// a = 1 (the paper's 5 % is a = 0.976, about the lower end), 3.5e-6 for a = 2, 1.5e-22 for a = 4.
// A wanted pair (F', a') in other units is that of F = F'/a', a = 1, scaled by a'.
//
// Bound: each of the 9 cells in reach has at most M impulses, the largest count that occurs, of
// size at most 1: 9 M / sqrt N.
// Spectrum: E[w^2] |K^(f)|^2, E[w^2] = 1 or (1 - 2^-40)/3, exactly, truncation included
// (gabor_forms.h): without the cut it is two Gaussians at +-F u, or their mean over the circle: a
// ring, in closed form with I0. Variance A/2 = (1 - e^(-2 pi a^2)) / (4 a^2) for random phase. DC:
// the Gaussians reach f = 0, where the density is e^(-2 pi F^2/a^2) of what one Gaussian has at its
// middle, twice (random phase) or four times (zero phase): for F = 0.6, a = 1 and
// random phase the density at 0 is 0.21 of the peak, for F = 2 2.4e-11. The integral of a zero
// phase kernel is G(F), tiny, not 0. Stationary in every respect (but for the 2^-32 of impulses.h);
// kind=isotropic is isotropic. Band: stated is the exact leak beyond F + a. Class: discontinuous,
// by steps of T at the rims of the kernels. Once (2 pi a^2)^3 T is below 2^-53 (a > 3.6) no
// derivative up to the third shows it in double, and C3 is stated. Period: that of the lattice.
// NaN, infinity and coordinates beyond 2^62 give NaN; from 2^52 on the fraction is lost.
//
// Source: lagae2009 (phase=zero), lagae2011 (phase=random). Deviations: numbers come from the hash
// of the lattice, not from a generator seeded by the cell; two dimensions only; the factor
// 1/sqrt N keeps the contrast when N changes.
//
// Float results are within 1e-6 for each impulse in reach.
#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include "noises/closed_forms.h"
#include "noises/common_parameters.h"
#include "noises/float_functions.h"
#include "noises/impulses/gabor_forms.h"
#include "noises/impulses/impulse_profiles.h"
#include "noises/impulses/impulses.h"
#include "noises/lattice/reference.h"
#include "noises/noise.h"
#include "noises/lattice/separable.h"
#include "noises/textbook_loops.h"

typedef struct gabor_parameters {
    bl_lattice_settings lattice;
    uint32_t impulses, kind, phase;
    double frequency, bandwidth, orientation;
} gabor_parameters;

enum { KIND_ISOTROPIC, KIND_ANISOTROPIC };
enum { PHASE_RANDOM, PHASE_ZERO };

static const char *const kinds[] = {"isotropic", "anisotropic", NULL};
static const char *const phases[] = {"random", "zero", NULL};

#define AT(field) offsetof(gabor_parameters, field)
static const bl_parameter parameters[] = {
    BL_LATTICE_PARAMETERS(gabor_parameters, "the impulses"),
    {"frequency", BL_REAL, AT(frequency), "0.6", "cycles a cell", .minimum = 0, .maximum = 4,
     .help = "of the kernel's wave, the middle of the band"},
    {"bandwidth", BL_REAL, AT(bandwidth), "1", "cycles a cell", .minimum = 1, .maximum = 4,
     .help = "of the kernel's Gaussian, which falls to 4.3 % at one over it"},
    {"kind", BL_CHOICE, AT(kind), "isotropic", "", .choices = kinds,
     .help = "a direction of its own for each impulse, or one for all"},
    {"orientation", BL_REAL, AT(orientation), "0", "degrees", .minimum = -360, .maximum = 360,
     .help = "of the waves of kind=anisotropic, from x towards y"},
    {"phase", BL_CHOICE, AT(phase), "random", "", .choices = phases,
     .help = "random, or zero with a random weight as in lagae2009"},
    IMPULSE_MEAN_PARAMETER(gabor_parameters, "8"),
    {0}};
#undef AT

// --- the kernel ---------------------------------------------------------------------------------

typedef struct impulse_kernel {
    double frequency, direction[2]; // u
    float wave[2];                  // F u, of kind=anisotropic
    float rate;                     // g = 2^(-rate r^2)
} impulse_kernel;

// The direction of an orientation in degrees; multiples of 90 are exact.
static void find_direction(double degrees, double direction[2]) {
    double turn = remainder(degrees, 360);
    direction[0] = fabs(turn) == 90 ? 0 : cos(turn * (M_PI / 180));
    direction[1] = fabs(turn) == 180 ? 0 : sin(turn * (M_PI / 180));
}

static impulse_kernel kernel_of(const gabor_parameters *p) {
    impulse_kernel kernel = {.frequency = p->frequency};
    find_direction(p->orientation, kernel.direction);
    for (int a = 0; a < 2; a++)
        kernel.wave[a] = (float)(p->frequency * kernel.direction[a]);
    kernel.rate = (float)(M_PI * M_LOG2E * p->bandwidth * p->bandwidth);
    return kernel;
}

enum { FORM_RANDOM_ISOTROPIC, FORM_RANDOM, FORM_ZERO_ISOTROPIC, FORM_ZERO };

static int form_of(const gabor_parameters *p) {
    return 2 * (p->phase == PHASE_ZERO) + (p->kind == KIND_ANISOTROPIC);
}

// A fraction of a turn, from -1/2 to 1/2.
static inline float turn_of(uint32_t word) {
    return (float)(int32_t)word * 0x1p-32f;
}

typedef struct impulse_mark {
    float wave[2], amplitude, phase;
} impulse_mark;

static inline __attribute__((always_inline)) impulse_mark
impulse_mark_of(const impulse_kernel *kernel, const int form, uint32_t third, uint32_t fourth) {
    impulse_mark mark = {{kernel->wave[0], kernel->wave[1]}, 1, 0};
    if (form == FORM_RANDOM_ISOTROPIC || form == FORM_ZERO_ISOTROPIC) {
        float turn = turn_of(third), frequency = (float)kernel->frequency;
        mark.wave[0] = frequency * bl_float_cosine(turn);
        mark.wave[1] = frequency * bl_float_sine(turn);
    }
    if (form == FORM_ZERO || form == FORM_ZERO_ISOTROPIC)
        mark.amplitude = bl_lattice_value(fourth) * (float)BL_LATTICE_UNIT;
    else
        mark.phase = turn_of(fourth);
    return mark;
}

static inline __attribute__((always_inline)) float impulse_term(const impulse_kernel *kernel,
                                                                const int form, impulse_mark mark,
                                                                double x, double y, double z) {
    (void)form, (void)z;
    double square = x * x + y * y; // the reference decides alike
    float envelope = bl_float_exp2(-kernel->rate * (float)square) * mark.amplitude;
    float cycles = mark.wave[0] * (float)x + mark.wave[1] * (float)y + mark.phase;
    float share = envelope * bl_float_cosine(cycles);
    return square < 1 ? share : 0;
}

#include "noises/impulses/impulse_points.h"

// --- the reference ------------------------------------------------------------------------------

typedef struct gabor_sum {
    const gabor_parameters *p;
    impulse_kernel kernel;
    int sloped; // whether the gradient is asked for
    double value, gradient[2];
} gabor_sum;

static void add_kernel(void *context, const double d[IMPULSE_AXES], uint32_t third,
                       uint32_t fourth) {
    gabor_sum *sum = context;
    const gabor_parameters *p = sum->p;
    double square = d[0] * d[0] + d[1] * d[1];
    if (!(square < 1))
        return;
    double ux = sum->kernel.direction[0], uy = sum->kernel.direction[1], phase = 0, weight = 1;
    if (p->kind == KIND_ISOTROPIC) {
        ux = cos(2 * M_PI * (double)turn_of(third));
        uy = sin(2 * M_PI * (double)turn_of(third));
    }
    if (p->phase == PHASE_ZERO)
        weight = (double)bl_lattice_value(fourth) * BL_LATTICE_UNIT;
    else
        phase = (double)turn_of(fourth);
    double rate = M_PI * p->bandwidth * p->bandwidth, envelope = weight * exp(-rate * square);
    double angle = 2 * M_PI * (p->frequency * (ux * d[0] + uy * d[1]) + phase);
    double wave = envelope * cos(angle);
    sum->value += wave;
    if (!sum->sloped)
        return;
    double slope = -2 * M_PI * p->frequency * envelope * sin(angle);
    sum->gradient[0] += slope * ux - 2 * rate * d[0] * wave;
    sum->gradient[1] += slope * uy - 2 * rate * d[1] * wave;
}

typedef struct gabor_opened {
    impulse_source source;
    impulse_kernel kernel;
} gabor_opened;

static gabor_opened open_gabor(const void *block) {
    const gabor_parameters *p = block;
    gabor_opened opened = {.kernel = kernel_of(p)};
    impulse_source_open(&opened.source, &p->lattice, p->impulses, 1);
    return opened;
}

static gabor_sum evaluate(const gabor_parameters *p, const gabor_opened *opened,
                          const double at[BL_AXES], int sloped) {
    gabor_sum sum = {.p = p, .kernel = opened->kernel, .sloped = sloped};
    if (!impulse_visit(&opened->source, 2, 1, at, add_kernel, &sum))
        sum.value = sum.gradient[0] = sum.gradient[1] = NAN;
    double scale = 1 / sqrt(p->impulses);
    sum.value *= scale;
    sum.gradient[0] *= scale;
    sum.gradient[1] *= scale;
    return sum;
}

static double value_at(const void *block, const gabor_opened *opened, const double at[BL_AXES]) {
    return evaluate(block, opened, at, 0).value;
}

BL_VALUES_OF_OPENED(gabor_opened, open_gabor)

// Between the rims of the kernels.
static void gradient(const void *block, const double at[BL_AXES], double out[BL_AXES]) {
    const gabor_opened opened = open_gabor(block);
    const gabor_sum sum = evaluate(block, &opened, at, 1);
    out[0] = sum.gradient[0];
    out[1] = sum.gradient[1];
    out[2] = out[3] = 0;
}

// --- points and rows ----------------------------------------------------------------------------

static void points(const void *block, const double *const at[BL_AXES], size_t count, float *out) {
    const gabor_parameters *p = block;
    impulse_source source;
    impulse_kernel kernel = kernel_of(p);
    float scale = (float)(1 / sqrt(p->impulses));
    impulse_source_open(&source, &p->lattice, p->impulses, 1);
    switch (form_of(p)) {
    case FORM_RANDOM_ISOTROPIC:
        impulse_points(&source, &kernel, FORM_RANDOM_ISOTROPIC, 2, 1, scale, at, count, out);
        return;
    case FORM_RANDOM:
        impulse_points(&source, &kernel, FORM_RANDOM, 2, 1, scale, at, count, out);
        return;
    case FORM_ZERO_ISOTROPIC:
        impulse_points(&source, &kernel, FORM_ZERO_ISOTROPIC, 2, 1, scale, at, count, out);
        return;
    default:
        impulse_points(&source, &kernel, FORM_ZERO, 2, 1, scale, at, count, out);
    }
}

BL_ROW_OF_POINTS

// --- the plain loop -----------------------------------------------------------------------------

// A generator a cell: eight impulses a cell on average.
static float textbook(float x, float y, float z) {
    (void)z;
    int cell_x = bl_textbook_floor(x), cell_y = bl_textbook_floor(y);
    float fx = x - (float)cell_x, fy = y - (float)cell_y, sum = 0;
    for (int i = -1; i <= 1; i++)
        for (int j = -1; j <= 1; j++) {
            uint32_t state = bl_textbook_cell(cell_x + i, cell_y + j);
            int count = bl_textbook_poisson(&state, 0.00033546263f); // e^-8
            for (int n = 0; n < count; n++) {
                float dx = fx - ((float)i + bl_textbook_uniform(&state));
                float dy = fy - ((float)j + bl_textbook_uniform(&state));
                float angle = 6.2831853f * bl_textbook_uniform(&state);
                float phase = 6.2831853f * bl_textbook_uniform(&state);
                float square = dx * dx + dy * dy;
                if (square < 1)
                    sum += expf(-3.1415927f * square) *
                           cosf(3.7699112f * (dx * cosf(angle) + dy * sinf(angle)) + phase);
            }
        }
    return sum * 0.35355339f; // 1/sqrt 8
}

// --- what it states -----------------------------------------------------------------------------

static bl_gabor gabor_of(const gabor_parameters *p) {
    bl_gabor gabor = {.frequency = p->frequency,
                      .bandwidth = p->bandwidth,
                      .isotropic = p->kind == KIND_ISOTROPIC,
                      .zero_phase = p->phase == PHASE_ZERO};
    find_direction(p->orientation, gabor.direction);
    return gabor;
}

static double square_weight(const gabor_parameters *p) {
    return p->phase == PHASE_ZERO ? BL_VALUE_VARIANCE(1 << 20) : 1;
}

static double covariance(const void *block, const double lag[BL_AXES]) {
    bl_gabor gabor = gabor_of(block);
    return square_weight(block) * bl_gabor_covariance(&gabor, lag[0], lag[1]);
}

static double density(const void *block, const double frequency[BL_AXES]) {
    bl_gabor gabor = gabor_of(block);
    return square_weight(block) * bl_gabor_density(&gabor, frequency[0], frequency[1]);
}

static void describe(const void *block, bl_facts *facts) {
    const gabor_parameters *p = block;
    facts->mean = 0;
    if (bl_lattice_has_closed_form(block))
        bl_impulses_describe(covariance, p, 2, 2, p->frequency + p->bandwidth, facts);
    else if (bl_lattice_differs_within(&p->lattice, 2, 2))
        facts->variance = covariance(p, (const double[BL_AXES]){0});
    facts->stationary = bl_lattice_has_closed_form(block);
    facts->isotropic = facts->stationary && p->kind == KIND_ISOTROPIC;
    bl_bound bound = {9.0 * impulse_count_most(p->impulses, 1) / sqrt(p->impulses),
                      "kernels of size at most 1; the 9 cells in reach times the most impulses of "
                      "a cell, over the root of their mean number"};
    double rate = 2 * M_PI * p->bandwidth * p->bandwidth;
    int smooth = rate * rate * rate * exp(-rate / 2) < 0x1p-52;
    bl_lattice_describe(bound, smooth ? 3 : -1, &p->lattice, facts);
}

BL_NOISE_DESCRIPTOR(gabor_noise) = {
    .name = "gabor",
    .title = "Gabor noise",
    .summary = "Gabor kernels at Poisson places: power in a band, in one direction or in all.",
    .formula = "1/sqrt N sum over cells c and impulses k of w_ck g(|d|) cos(2 pi (F u.d + phi_ck))",
    .paper = "lagae2009",
    .dimensions = 2,
    .parameters = parameters,
    .parameters_size = sizeof(gabor_parameters),
    .describe = describe,
    .has_closed_form = bl_lattice_has_closed_form,
    .textbook = textbook,
    .functions = {BL_NOISE_FUNCTIONS, .values = values, .gradient = gradient, BL_NOISE_CLOSED_FORM},
};
