// SPDX-License-Identifier: MIT
#include "noises/closed_forms.h"

#include <assert.h>
#include <math.h>

#include "core/quadrature.h"
#include "noises/lattice/lattice_repeats.h"

static void add(bl_terms *terms, bl_term term) {
    assert(terms->count < BL_TERMS_MOST);
    terms->term[terms->count++] = term;
}

static int axes(const bl_terms *terms) {
    return terms->dimensions ? (int)terms->dimensions : 3;
}

static bl_term product_term(double variance, bl_kernel kernel) {
    return (bl_term){.variance = variance, .kernel = {kernel, kernel, kernel, kernel}};
}

void bl_terms_add_value(bl_terms *terms, double variance, bl_kernel kernel) {
    add(terms, product_term(variance, kernel));
}

void bl_terms_add_gradient(bl_terms *terms, double variance, bl_kernel ramp, bl_kernel weight) {
    for (int axis = 0; axis < axes(terms); axis++) {
        bl_term term = product_term(variance, weight);
        term.kernel[axis] = ramp;
        add(terms, term);
    }
}

void bl_terms_add_radial(bl_terms *terms, double variance) {
    add(terms, (bl_term){.variance = variance, .radial = 1});
}

void bl_terms_add_scaled(bl_terms *terms, const bl_terms *other, double factor) {
    for (int i = 0; i < other->count; i++) {
        bl_term term = other->term[i];
        term.variance *= factor * factor;
        add(terms, term);
    }
}

static double length(const double v[BL_AXES]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

double bl_terms_covariance(const bl_terms *terms, const double lag[BL_AXES]) {
    double sum = 0;
    for (int i = 0; i < terms->count; i++) {
        const bl_term *term = &terms->term[i];
        double product = term->variance;
        if (term->radial)
            product *= bl_radial_correlation(length(lag));
        else
            for (int a = 0; a < axes(terms) && product != 0; a++)
                product *= bl_kernel_correlation(term->kernel[a], lag[a]);
        sum += product;
    }
    return sum;
}

double bl_terms_density(const bl_terms *terms, const double frequency[BL_AXES]) {
    double sum = 0;
    for (int i = 0; i < terms->count; i++) {
        const bl_term *term = &terms->term[i];
        double product = 1;
        if (term->radial)
            product = bl_radial_transform(length(frequency));
        else
            for (int a = 0; a < axes(terms); a++)
                product *= bl_kernel_transform(term->kernel[a], frequency[a]);
        sum += term->variance * product * product;
    }
    return sum;
}

double bl_terms_variance(const bl_terms *terms) {
    return bl_terms_covariance(terms, (const double[BL_AXES]){0});
}

static double reach(const bl_terms *terms) {
    double most = 0;
    for (int i = 0; i < terms->count; i++)
        for (int a = 0; a < axes(terms); a++) {
            const bl_term *term = &terms->term[i];
            double own = term->radial ? BL_RADIAL_REACH : 2 * bl_kernel_support(term->kernel[a]);
            most = fmax(most, own);
        }
    return most;
}

// The share below b is int R(t) sin(2 pi b t)/(pi t) dt over all lags t along the axis, divided by
// R(0). R is a polynomial (over t) between whole lags, or smooth; panels of one cycle at most.
double bl_covariance_share_above(bl_covariance *covariance, const void *parameters, double reach,
                                 double frequency) {
    double below = 0, panels = ceil(reach * ceil(fmax(fabs(frequency), 2)));
    double half = 0.5 * reach / panels;
    for (double panel = 0; panel < panels; panel++)
        for (int n = 0; n < BL_QUADRATURE_NODES; n++) {
            double t = half * (2 * panel + 1 + bl_quadrature_node[n]);
            below += half * bl_quadrature_weight[n] *
                     covariance(parameters, (const double[BL_AXES]){t}) *
                     sin(2 * M_PI * frequency * t) / (M_PI * t);
        }
    return 1 - 2 * below / covariance(parameters, (const double[BL_AXES]){0});
}

static double covariance_of_terms(const void *terms, const double lag[BL_AXES]) {
    return bl_terms_covariance(terms, lag);
}

double bl_terms_share_above(const bl_terms *terms, double frequency) {
    return bl_covariance_share_above(covariance_of_terms, terms, reach(terms), frequency);
}

// The variance on lattice=perm256 without a period: numbers that meet again within two kernels'
// reach add their covariance, as often as they do. NAN in four dimensions.
static double variance_of_permutation(const bl_terms *terms) {
    const int most = BL_REPEATS_REACH; // the reach is 4 at most, from where on there is none
    double sum = 0;
    if (axes(terms) > 3)
        return NAN;
    for (int z = axes(terms) > 2 ? -most : 0; z <= (axes(terms) > 2 ? most : 0); z++)
        for (int y = axes(terms) > 1 ? -most : 0; y <= (axes(terms) > 1 ? most : 0); y++)
            for (int x = -most; x <= most; x++) {
                double share = bl_perm256_repeats((unsigned)axes(terms), (const int[]){x, y, z});
                if (share > 0)
                    sum += share * bl_terms_covariance(terms, (const double[BL_AXES]){x, y, z});
            }
    return sum;
}

static int has_no_period(const bl_lattice_settings *lattice) {
    return !(lattice->period[0] | lattice->period[1] | lattice->period[2] | lattice->period[3]);
}

void bl_terms_describe(const bl_terms *terms, int holds, const bl_lattice_settings *lattice,
                       bl_facts *facts) {
    facts->mean = 0;
    if (holds && bl_lattice_differs_within(lattice, (unsigned)axes(terms), reach(terms)))
        facts->variance = bl_terms_variance(terms);
    else if (holds && lattice->kind == BL_LATTICE_PERM256 && has_no_period(lattice))
        facts->variance = variance_of_permutation(terms);
    if (!holds || !bl_lattice_is_hash(lattice))
        return;
    facts->covariance_reach = reach(terms);
    facts->band_from = 0;
    facts->band_to = 1;
    facts->leak_db = ceil(1000 * log10(bl_terms_share_above(terms, 1))) / 100;
}
