// SPDX-License-Identifier: MIT
//
// Closed forms of noises that are sums of independent terms: a noise file lists its terms, and the
// functions here give its covariance, its density and the facts that follow from them.
//
// A lattice term is the noise  sum over cells c of a_c k_x(x - c_x) k_y(y - c_y) k_z(z - c_z)  with
// uncorrelated numbers a_c of mean 0 and a given variance. Over a uniformly random place in the
// cell its covariance is variance * product of rho_b(lag_b), because the mean over the place turns
// the sum over cells into an integral, and its density variance * product of |k^_b(f_b)|^2. Terms
// that share no random number, or uncorrelated ones, add up.
//
// A radial term is the same with one kernel of the distance: variance * R(|lag|) and
// variance * |K^(|f|)|^2. It holds for impulses on the lattice (over places) and for impulses at
// independent uniform places in each cell: a uniform place in every cell is uniform in space, and
// the cross terms vanish because the amplitudes are independent of mean 0. The second needs no mean
// over places: such a noise is stationary to second order, exactly.
//
// In d dimensions, 1 to 4, the products run over the first d axes, and components of lags and
// frequencies beyond them are not read. Radial terms have three dimensions.
//
// The forms assume that different lattice points have uncorrelated numbers. A table of 256 numbers
// repeats them (rows of a slice are shifts of one another), so lattice=perm256 has none.
#ifndef BL_NOISES_CLOSED_FORMS_H
#define BL_NOISES_CLOSED_FORMS_H

#include "core/signal.h"
#include "noises/lattice/kernel.h"
#include "noises/lattice/lattice.h"

enum { BL_TERMS_MOST = 12 };

typedef struct bl_term {
    double variance;
    bl_kernel kernel[BL_AXES];
    int radial; // 1: the radial Catmull-Rom kernel, `kernel` is not read
} bl_term;

typedef struct bl_terms {
    int count;
    unsigned dimensions; // 0 means 3
    bl_term term[BL_TERMS_MOST];
} bl_terms;

// The variance of n equally likely values, the odd multiples of 1/n in (-1, 1): (1 - n^-2)/3.
#define BL_VALUE_VARIANCE(n) ((1 - 1.0 / ((double)(n) * (double)(n))) / 3)

// sum_c a_c k(x) k(y) k(z), or as many axes as the terms have dimensions.
void bl_terms_add_value(bl_terms *terms, double variance, bl_kernel kernel);
// sum_c g_c . d w(x) w(y) w(z), with E[g_a g_b] = variance if a = b, else 0; `ramp` is d w(d): one
// term an axis, with the ramp along that axis and w along the others.
void bl_terms_add_gradient(bl_terms *terms, double variance, bl_kernel ramp, bl_kernel weight);
void bl_terms_add_radial(bl_terms *terms, double variance);
// Adds all terms of another noise, times a factor, that draws independent numbers.
void bl_terms_add_scaled(bl_terms *terms, const bl_terms *other, double factor);

double bl_terms_covariance(const bl_terms *terms, const double lag[BL_AXES]);
double bl_terms_density(const bl_terms *terms, const double frequency[BL_AXES]);
double bl_terms_variance(const bl_terms *terms);

// The share of the variance above a frequency, of the spectrum along the x axis at random places.
double bl_terms_share_above(const bl_terms *terms, double frequency);
// The same for any covariance that is smooth between whole lags and 0 from `reach` on.
typedef double bl_covariance(const void *parameters, const double lag[BL_AXES]);
double bl_covariance_share_above(bl_covariance *covariance, const void *parameters, double reach,
                                 double frequency);

// Fills mean 0 and, if `holds` (the noise has these kernels, and not tables of them), what the
// lattice allows. The variance, at a random place and seed, where all numbers within the kernels'
// footprint differ, lattice=hash and no period shorter than it; and of lattice=perm256 without a
// period, exactly, from how often numbers meet again (noises/lattice/lattice_repeats.h; not in four
// dimensions). On lattice=hash without any period also the covariance's reach, and the fact that
// along an axis all but leak_db of the variance lies in [0, 1]: the exact share outside, rounded up
// to the next hundredth of a dB. Otherwise these stay "not stated": numbers of a short period that
// meet again move the variance, and a coarse table of the kernel leaks far more than the kernel.
void bl_terms_describe(const bl_terms *terms, int holds, const bl_lattice_settings *lattice,
                       bl_facts *facts);

// Hard bounds |n| <= value, in exact arithmetic, and how they are proved (noises/lattice/bounds.c).
// `table` is the entries a unit of a tabulated kernel, 0 for the exact one.
typedef struct bl_bound {
    double value;
    const char *proof;
} bl_bound;

bl_bound bl_bound_value(bl_kernel kernel);               // values in (-1, 1), three axes
bl_bound bl_bound_gradient(bl_kernel weight, int edges); // unit vectors, or the 12 edges
// The same in 1 to 4 dimensions; the edges are those of noises/lattice/lattice_dimensions.h.
bl_bound bl_bound_value_in(bl_kernel kernel, unsigned dimensions);
bl_bound bl_bound_gradient_in(bl_kernel weight, int edges, unsigned dimensions);
bl_bound bl_bound_hermite(void); // values and tangents in (-1, 1)
bl_bound bl_bound_lattice_convolution(unsigned table);
bl_bound bl_bound_sparse_convolution(unsigned table); // any number of impulses a cell

// The facts that every lattice noise states alike: a range of that bound on both sides of 0, the
// class, the periods of the lattice, its cell, and where a double loses the fraction.
void bl_lattice_describe(bl_bound bound, int continuity, const bl_lattice_settings *lattice,
                         bl_facts *facts);

// Whether a noise has the closed form of a lattice without repeats; its parameter block begins with
// its bl_lattice_settings.
int bl_lattice_has_closed_form(const void *block);

// In a noise file, after its `static bl_terms terms_of(const void *block)`: the functions
// `covariance` and `density` of the noise that those terms make.
#define BL_CLOSED_FORM_OF_TERMS                                                                    \
    static double covariance(const void *block, const double lag[BL_AXES]) {                       \
        bl_terms terms = terms_of(block);                                                          \
        return bl_terms_covariance(&terms, lag);                                                   \
    }                                                                                              \
    static double density(const void *block, const double frequency[BL_AXES]) {                    \
        bl_terms terms = terms_of(block);                                                          \
        return bl_terms_density(&terms, frequency);                                                \
    }

#endif
