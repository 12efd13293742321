// SPDX-License-Identifier: MIT
//
// What a sum of octaves states about itself, from what its basis states: see
// noises/octaves/octaves.h.
#include <math.h>
#include <string.h>

#include "core/quadrature.h"
#include "noises/octaves/octaves.h"

static const bl_octaves *octaves_of(const void *parameters) {
    return ((const bl_octaves_settings *)parameters)->octaves;
}

static double weight_of(const bl_octaves *octaves, unsigned index) {
    return octaves->plan.amplitude[index] * octaves->plan.kept[index];
}

// --- closed forms -------------------------------------------------------------------------------

static int is_periodic(const bl_facts *facts, unsigned dimensions) {
    for (unsigned a = 0; a < dimensions; a++)
        if (!(facts->period[a] == 0))
            return 1;
    return 0;
}

static int are_uncorrelated(const bl_octaves *octaves) {
    const bl_signal *basis = octaves->seeded[0];
    if (octaves->rules.fresh || octaves->plan.evaluated == 1)
        return 1;
    return octaves->plan.ratio >= 1.5 && !bl_octaves_is_sum(basis) &&
           !is_periodic(&basis->facts, basis->dimensions);
}

int bl_octaves_has_closed_form(const void *parameters) {
    const bl_octaves *octaves = octaves_of(parameters);
    // Over seeds, random rotations average the covariance over all directions, which changes it but
    // where it is a function of the distance alone.
    int turned = octaves->rules.rotate && octaves->plan.evaluated > 1 &&
                 octaves->seeded[0]->facts.isotropic != 1;
    return octaves->rules.fold == BL_FOLD_NONE && octaves->plan.evaluated > 0 && !turned &&
           are_uncorrelated(octaves) && bl_signal_has_closed_form(octaves->seeded[0]);
}

double bl_octaves_covariance(const void *parameters, const double lag[BL_AXES]) {
    const bl_octaves *octaves = octaves_of(parameters);
    double sum = 0;
    for (unsigned i = 0; i < octaves->plan.evaluated; i++) {
        const bl_signal *basis = octaves->octave[i].basis;
        double scaled[BL_AXES], weight = weight_of(octaves, i);
        for (int a = 0; a < BL_AXES; a++)
            scaled[a] = lag[a] * octaves->plan.frequency[i];
        sum += weight * weight * basis->functions->covariance(basis->parameters, scaled);
    }
    return sum;
}

double bl_octaves_density(const void *parameters, const double frequency[BL_AXES]) {
    const bl_octaves *octaves = octaves_of(parameters);
    double sum = 0;
    for (unsigned i = 0; i < octaves->plan.evaluated; i++) {
        const bl_signal *basis = octaves->octave[i].basis;
        double scaled[BL_AXES], weight = weight_of(octaves, i), volume = 1;
        for (int a = 0; a < BL_AXES; a++)
            scaled[a] = frequency[a] / octaves->plan.frequency[i];
        for (unsigned a = 0; a < octaves->dimensions; a++)
            volume *= octaves->plan.frequency[i];
        sum += weight * weight / volume * basis->functions->density(basis->parameters, scaled);
    }
    return sum;
}

// The share of the basis's variance above a frequency along x, 1 - 2/R(0) int_0^reach R(t)
// sin(2 pi b t)/(pi t) dt, in panels of a quarter of a unit and half a cycle at most: R is smooth
// between the multiples of a quarter, or its knots are at such multiples.
static double share_above(const bl_signal *basis, double frequency) {
    double below = 0, reach = basis->facts.covariance_reach;
    double panels = ceil(fmax(4, 2 * frequency) * reach), half = 0.5 * reach / panels;
    for (double panel = 0; panel < panels; panel++)
        for (int n = 0; n < BL_QUADRATURE_NODES; n++) {
            double t = half * (2 * panel + 1 + bl_quadrature_node[n]);
            double covariance =
                basis->functions->covariance(basis->parameters, (const double[BL_AXES]){t});
            below += half * bl_quadrature_weight[n] * covariance * sin(2 * M_PI * frequency * t) /
                     (M_PI * t);
        }
    return 1 - 2 * below / basis->facts.variance;
}

// The share of the sum's variance above `frequency`. Octaves far below it have the share at 64,
// which is more than theirs: the integral at a high frequency is long.
static double sum_above(const bl_octaves *octaves, double frequency) {
    const bl_signal *basis = octaves->seeded[0];
    double above = 0, all = 0, last = -1, share = 0;
    for (unsigned i = 0; i < octaves->plan.evaluated; i++) {
        double weight = weight_of(octaves, i);
        double own = fmin(frequency / octaves->plan.frequency[i], 64);
        if (own != last)
            share = fmax(0, share_above(basis, own));
        last = own;
        above += weight * weight * share;
        all += weight * weight;
    }
    return above / all;
}

// --- facts --------------------------------------------------------------------------------------

// The sizes |n| that the basis may have.
static void size_range(const bl_facts *basis, double *least, double *most) {
    *least = fmax(0, fmax(basis->lower, -basis->upper));
    *most = fmax(fabs(basis->lower), fabs(basis->upper));
}

// Whether the derivative of a sum of folds can jump where that of the basis does not: where the
// basis crosses 0, if it can, and where the weight min(1, gain s) of a ridge reaches 1, if some
// squares in its range are below 1/gain and others above. Squares in between are always weights
// below 1, or always 1. A range that is not stated (NaN) can do everything.
static int has_kinks(const bl_octaves *octaves) {
    const bl_octaves_rules *rules = &octaves->rules;
    const bl_facts *basis = &octaves->seeded[0]->facts;
    if (rules->fold == BL_FOLD_NONE)
        return 0;
    if (!(basis->lower >= 0 || basis->upper <= 0))
        return 1;
    if (rules->fold == BL_FOLD_SIZE || octaves->plan.count < 2)
        return 0;
    double least, most;
    size_range(basis, &least, &most);
    double low = rules->ridge_offset - least, high = rules->ridge_offset - most; // high <= low
    double smallest = low > 0 && high < 0 ? 0 : fmin(low * low, high * high);
    double largest = fmax(low * low, high * high);
    // All squares that a weight multiplies are at most `largest`; if the first weights are 1, the
    // later ones are too.
    return !(rules->ridge_gain * largest <= 1 || rules->ridge_gain * smallest >= 1);
}

static void describe_range(const bl_octaves *octaves, bl_facts *facts) {
    const bl_facts *basis = &octaves->seeded[0]->facts;
    double low = basis->lower, high = basis->upper;
    facts->bound_proof = "the sum over the octaves of amplitude times the bound of the basis";
    if (octaves->rules.fold != BL_FOLD_NONE)
        size_range(basis, &low, &high);
    if (octaves->rules.fold == BL_FOLD_RIDGE) {
        // The square is largest at an end of the sizes, and so is its mean; weights are 1 at most.
        double near = octaves->rules.ridge_offset - low, far = octaves->rules.ridge_offset - high;
        facts->bound_proof =
            "the sum over the octaves of amplitude times the largest square; the "
            "weights are 1 at most";
        facts->lower = facts->upper = 0;
        for (unsigned i = 0; i < octaves->plan.count; i++)
            facts->upper += octaves->plan.amplitude[i] * fmax(near * near, far * far);
        return;
    }
    facts->lower = facts->upper = octaves->constant;
    for (unsigned i = 0; i < octaves->plan.evaluated; i++) {
        facts->lower += weight_of(octaves, i) * low;
        facts->upper += weight_of(octaves, i) * high;
    }
}

// A period of the first octave, times the power of two that makes it one of all of them, if that is
// not beyond the places that have one.
static double period_of(const bl_octaves *octaves, unsigned axis) {
    double own = octaves->seeded[0]->facts.period[axis], times = 1;
    const double *frequency = octaves->plan.frequency;
    if (!(own > 0) || (octaves->rules.rotate && octaves->plan.evaluated > 1))
        return own > 0 ? 0 : own;
    for (unsigned i = 1; i < octaves->plan.evaluated; i++)
        while (times < 0x1p52 && fmod(times * (frequency[i] / frequency[0]), 1) != 0)
            times *= 2;
    return times < 0x1p30 ? own / frequency[0] * times : 0;
}

static void describe_constant(const bl_octaves *octaves, bl_facts *facts) {
    facts->lower = facts->upper = facts->mean = octaves->constant;
    facts->bound_proof = "a constant: all octaves are removed";
    facts->variance = 0;
    facts->continuity = octaves->seeded[0]->facts.continuity;
    memset(facts->period, 0, sizeof facts->period);
    facts->cell = 0;
    facts->far = 0x1p52;
    facts->stationary = facts->isotropic = 1;
}

static void describe_moments(const bl_octaves *octaves, bl_facts *facts) {
    const bl_facts *basis = &octaves->seeded[0]->facts;
    double square = 0;
    facts->mean = 0;
    for (unsigned i = 0; i < octaves->plan.count; i++)
        facts->mean += octaves->plan.amplitude[i] * basis->mean;
    for (unsigned i = 0; i < octaves->plan.evaluated; i++)
        square += weight_of(octaves, i) * weight_of(octaves, i);
    if (are_uncorrelated(octaves))
        facts->variance = square * basis->variance;
    // Octaves of one seed meet at the origin, where their sum varies more.
    int meet = !octaves->rules.fresh && !octaves->rules.shift && octaves->plan.evaluated > 1;
    facts->stationary = basis->stationary && !meet;
    facts->isotropic = basis->isotropic;
}

void bl_octaves_describe(const void *parameters, bl_facts *facts) {
    const bl_octaves *octaves = octaves_of(parameters);
    const bl_facts *basis = &octaves->seeded[0]->facts;
    const double *frequency = octaves->plan.frequency;
    unsigned evaluated = octaves->plan.evaluated;
    if (evaluated == 0) {
        describe_constant(octaves, facts);
        return;
    }
    describe_range(octaves, facts);
    if (octaves->rules.fold == BL_FOLD_NONE)
        describe_moments(octaves, facts);
    facts->continuity = basis->continuity > 0 && has_kinks(octaves) ? 0 : basis->continuity;
    for (unsigned a = 0; a < BL_AXES; a++)
        facts->period[a] = period_of(octaves, a);
    facts->cell = basis->cell / frequency[0];
    // Halved until the highest octave, its cell rounded up to a power of two, has lost its
    // fraction.
    int exponent;
    frexp(frequency[evaluated - 1], &exponent);
    facts->far = fmin(0x1p61, ldexp(basis->far, 1 - exponent));
    if (!bl_octaves_has_closed_form(parameters))
        return;
    facts->covariance_reach = basis->covariance_reach / frequency[0];
    if (isinf(facts->covariance_reach)) // no density, of which to take shares
        return;
    facts->band_from = 0;
    facts->band_to = octaves->top * frequency[evaluated - 1];
    facts->leak_db = ceil(1000 * log10(sum_above(octaves, facts->band_to))) / 100;
}
