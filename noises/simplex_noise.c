// SPDX-License-Identifier: MIT
//
// simplex: simplex noise, gradients at the points of a lattice of simplices with a radial kernel.
//
//   n(p) = N sum over the n+1 corners c of the simplex around p of (g_c . d) w(|d|^2),  d = p - c
//   w(q) = (r2 - q)^4 for q < r2, else 0
//
// The skew u_i = p_i + F sum_j p_j, F = (sqrt(n+1) - 1)/n, makes the corners whole numbers: the
// simplices are those of the cubes, cut along their diagonals by the order of the fractions of u.
// Back goes d_i = u_i - G sum_j u_j, G = (1 - 1/sqrt(n+1))/n.
//
// Parameters
//   seed, lattice, component, period   of the gradients (noises/lattice/lattice.h); the cells are
//            those of the skewed lattice. A period is a multiple of 3, and for dims=3 alone
//   dims     n = 2 to 4, default 3: coordinates beyond them are ignored
//   radius2  r2 = 0.5 (default), or 0.6 as is often seen
//
// Units: those of the coordinates. The edges of a simplex that join corners k steps apart have the
// length sqrt(k (n+1-k)/(n+1)): 0.82 in 2-D, 0.87 and 1 in 3-D, 0.89 and 1.10 in 4-D. The lattice
// has sqrt(n+1) points a unit of volume.
//
// Gradients: 2-D 8 unit vectors, 45 degrees apart; 3-D the 12 edges of the cube (1,1,0), of length
// sqrt 2; 4-D the 32 vectors (0,1,1,1) of length sqrt 3; all signs and places. Their mean is 0 and
// E[g g^T] = 1/2, 2/3, 3/4 times I.
//
// Kernel and class. The facets of the simplices lie in u_i = m and u_i - u_j = m, planes with the
// normals e_i + F 1 and e_i - e_j, both of length sqrt 2 because n F^2 + 2 F = 1: whatever n, a
// corner is 1/sqrt 2 from the facet opposite to it. So r2 = 1/2 is the largest radius whose ball
// stays within the simplices around the corner: there the terms end in a zero of fourth order, and
// the noise is C3. With r2 = 0.6 a corner is dropped at the opposite facet while it still weighs
// (0.1)^4 N |g . d|, up to 0.0024 in 2-D, 0.0032 in 3-D and 0.0032 in 4-D: class -1 in every
// dimension, 2-D too.
//
// Bound: |n| < 1. N is the reciprocal of the largest sum, rounded down to where it is certified
// (t-simplex, by branch and bound), the worst gradient at each corner:
//   r2 = 0.5   2-D 0.0100802, N = 99     3-D 0.0130072, N = 76     4-D 0.0159293, N = 61
//   r2 = 0.6   2-D 0.0288816, N = 34     3-D 0.0305849, N = 32     4-D 0.0367301, N = 26
//
// Mean 0. For r2 = 0.5 the sum is one over all points of the lattice, and covariance, variance,
// density and band are exact (noises/lattice/simplex_theory.h) where no two cells share a number.
// They are functions of the distance alone: over random places the noise is isotropic. The variance
// is the same with any period, because 3 is more than the sqrt 2 that two gradients which meet are
// apart. For r2 = 0.6 the kernel is cut to the shape of the simplices, and there is no closed form.
//
// Period: what the key sets. Whole numbers shift the lattice into itself along an axis in 3-D by
// multiples of 3 only (u moves by (4, 1, 1), F = 1/3), and in 2-D and 4-D never: F is irrational.
// lattice=perm256 repeats after 256 in the skewed numbers: after 768 units in 3-D, never in 2-D and
// 4-D.
// NaN, infinity and coordinates beyond 2^62 give NaN. The skew is good to 2^-52 of a
// cell everywhere (noises/lattice/simplex_place.h), so the noise is as good far out as near; from
// 2^52 on coordinates are whole numbers.
//
// Known defects: N makes it weaker than gnoise; the variance depends on the place, 0 at the
// corners; slices of the 3-D and 4-D noise are not 2-D noises and have another spectrum.
// Sources: Perlin 2001, Gustavson 2005. Deviations: gradients by hash of 64-bit cells; r2 = 0.5 in
// every dimension, where 0.6 is usual in 3-D and 4-D; the corners' order by ranks, not by a tree of
// comparisons; N from a proof.
#include <stddef.h>

#include "noises/closed_forms.h"
#include "noises/common_parameters.h"
#include "noises/lattice/reference.h"
#include "noises/noise.h"
#include "noises/lattice/simplex_place.h"
#include "noises/lattice/simplex_points.h"
#include "noises/lattice/simplex_theory.h"
#include "noises/textbook.h"

typedef struct simplex_parameters {
    bl_lattice_settings lattice;
    uint32_t dimensions;
    uint32_t radius2;
} simplex_parameters;

static const char *const radius_choices[] = {"0.5", "0.6", NULL};
static const double radii[] = {0.5, 0.6};

// By radius2 and dims.
static const double normalisations[2][BL_AXES + 1] = {{0, 0, 99, 76, 61}, {0, 0, 34, 32, 26}};

// --- points -------------------------------------------------------------------------------------

BL_INLINE void points_of(const simplex_parameters *p, unsigned dims,
                         const double *const at[BL_AXES], size_t count, float *out) {
    const bl_lattice lattice = bl_lattice_open(&p->lattice);
    simplex_points(&lattice, dims, (float)radii[p->radius2],
                   (float)normalisations[p->radius2][dims], at, count, out);
}

static void points(const void *block, const double *const at[BL_AXES], size_t count, float *out) {
    const simplex_parameters *p = block;
    if (p->dimensions == 2)
        points_of(p, 2, at, count, out);
    else if (p->dimensions == 3)
        points_of(p, 3, at, count, out);
    else
        points_of(p, 4, at, count, out);
}

BL_ROW_OF_POINTS

// --- the reference in double --------------------------------------------------------------------

typedef struct simplex_lattice {
    bl_lattice lattice;
    uint32_t words256[256]; // of lattice=perm256
} simplex_lattice;

static simplex_lattice open_lattice(const void *block) {
    const simplex_parameters *p = block;
    simplex_lattice opened;
    opened.lattice = bl_lattice_open(&p->lattice);
    if (opened.lattice.kind == BL_LATTICE_PERM256)
        bl_perm256_words(&opened.lattice, 0, opened.words256);
    return opened;
}

static double reference(const simplex_parameters *p, const simplex_lattice *opened,
                        const double at[BL_AXES], double gradient[BL_AXES]) {
    const unsigned dims = p->dimensions;
    const double scale = normalisations[p->radius2][dims];
    simplex_place place;
    double sum = 0, slopes[BL_AXES] = {0};
    uint32_t rank[BL_AXES] = {0};
    int inside = simplex_place_of(dims, at, &place);
    if (inside)
        simplex_ranks(dims, place.fraction, rank);
    for (uint32_t k = 0; inside && k <= dims; k++) {
        uint64_t corner[BL_AXES] = {0};
        double d[BL_AXES] = {0}, square = 0, dot = 0;
        for (unsigned a = 0; a < dims; a++) {
            int stepped = rank[a] < k;
            corner[a] = place.cell[a] + (stepped ? 1 : 0);
            d[a] = simplex_offset(dims, place.fraction[a], place.total) - stepped +
                   k * simplex_unskews[dims];
            square += d[a] * d[a];
        }
        simplex_gradient g = simplex_gradient_of(
            dims, simplex_word(&opened->lattice, dims, corner, opened->words256));
        const double components[BL_AXES] = {g.x, g.y, g.z, g.w};
        double t = fmax(0, radii[p->radius2] - square);
        for (unsigned a = 0; a < dims; a++)
            dot += components[a] * d[a];
        sum += scale * dot * (t * t) * (t * t);
        for (unsigned a = 0; a < dims; a++)
            slopes[a] += scale * t * t * t * (components[a] * t - 8 * dot * d[a]);
    }
    for (int a = 0; gradient && a < BL_AXES; a++)
        gradient[a] = inside ? slopes[a] : NAN;
    return inside ? sum : NAN;
}

static double value_at(const void *block, const simplex_lattice *lattice,
                       const double at[BL_AXES]) {
    return reference(block, lattice, at, NULL);
}

BL_VALUES_OF_OPENED(simplex_lattice, open_lattice)

static void gradient(const void *block, const double at[BL_AXES], double out[BL_AXES]) {
    const simplex_lattice lattice = open_lattice(block);
    reference(block, &lattice, at, out);
}

// --- closed forms and facts ---------------------------------------------------------------------

// N^2 E[g_a^2].
static double strength(const simplex_parameters *p) {
    static const double second_moment[] = {0, 0, 1.0 / 2, 2.0 / 3, 3.0 / 4};
    double scale = normalisations[p->radius2][p->dimensions];
    return scale * scale * second_moment[p->dimensions];
}

static double length_of(const simplex_parameters *p, const double v[BL_AXES]) {
    double square = 0;
    for (unsigned a = 0; a < p->dimensions; a++)
        square += v[a] * v[a];
    return sqrt(square);
}

static double covariance(const void *block, const double lag[BL_AXES]) {
    const simplex_parameters *p = block;
    return strength(p) * bl_simplex_covariance(p->dimensions, length_of(p, lag));
}

static double density(const void *block, const double frequency[BL_AXES]) {
    const simplex_parameters *p = block;
    return strength(p) * bl_simplex_density(p->dimensions, length_of(p, frequency));
}

static int has_closed_form(const void *block) {
    const simplex_parameters *p = block;
    return p->radius2 == 0 && bl_lattice_is_hash(&p->lattice);
}

// Cells that lie further apart than two kernels reach may share their numbers.
static int has_variance(const simplex_parameters *p) {
    return p->radius2 == 0 && bl_lattice_differs_within(&p->lattice, p->dimensions, M_SQRT2);
}

static bl_status validate(const void *block, bl_message *message) {
    const simplex_parameters *p = block;
    for (unsigned a = 0; a < p->dimensions; a++) {
        uint32_t period = p->lattice.period[a];
        if (period && p->dimensions != 3)
            return bl_report(message, BL_USAGE,
                             "period=%u: simplices of %u dimensions never fall on themselves after "
                             "a shift along an axis; take dims=3, or leave `period` out",
                             period, p->dimensions);
        if (period % 3)
            return bl_report(message, BL_USAGE,
                             "period=%u along %c: the simplices fall on themselves after multiples "
                             "of 3 only; the next one is %u",
                             period, "xyzw"[a],
                             period > UINT32_MAX - 2 ? period - period % 3
                                                     : period + 3 - period % 3);
    }
    return BL_OK;
}

// lattice=perm256 repeats after 256 in the skewed numbers, which a shift by 768 reaches; a period
// that is a multiple of it adds nothing.
static double period_of(const simplex_parameters *p, unsigned axis) {
    double own = p->lattice.period[axis];
    if (p->lattice.kind == BL_LATTICE_PERM256 && p->dimensions == 3 && axis < 3 &&
        fmod(own, 768) == 0)
        return 768;
    return own;
}

static void describe(const void *block, bl_facts *facts) {
    const simplex_parameters *p = block;
    facts->lower = -1;
    facts->upper = 1;
    facts->bound_proof =
        "the sum over the corners of the largest g . d times the kernel, certified "
        "over the simplex by branch and bound, times N";
    facts->mean = 0;
    facts->continuity = p->radius2 == 0 ? 3 : -1;
    for (unsigned axis = 0; axis < BL_AXES; axis++)
        facts->period[axis] = period_of(p, axis);
    facts->cell = 0; // its planes are not at whole numbers
    facts->far = 0x1p52;
    if (has_variance(p))
        facts->variance = covariance(block, (const double[BL_AXES]){0});
    if (!has_closed_form(block))
        return;
    facts->isotropic = 1;
    facts->covariance_reach = M_SQRT2;
    facts->band_from = 0;
    facts->band_to = 2;
    double above = bl_covariance_share_above(covariance, block, M_SQRT2, 2);
    facts->leak_db = ceil(1000 * log10(above)) / 100;
}

// --- the usual loop in float --------------------------------------------------------------------

static float textbook(float x, float y, float z) {
    float skew = (x + y + z) * (1 / 3.0f);
    int i = bl_textbook_floor(x + skew), j = bl_textbook_floor(y + skew),
        k = bl_textbook_floor(z + skew);
    float back = (float)(i + j + k) * (1 / 6.0f);
    float d[3] = {x - ((float)i - back), y - ((float)j - back), z - ((float)k - back)};
    // The first step is along the largest, the last along the smallest; the middle has the rest.
    int first = d[0] >= d[1] ? (d[0] >= d[2] ? 0 : 2) : (d[1] >= d[2] ? 1 : 2);
    int last = d[0] < d[1] ? (d[0] < d[2] ? 0 : 2) : (d[1] < d[2] ? 1 : 2);
    int at[3] = {i, j, k};
    float sum = 0;
    for (int corner = 0; corner < 4; corner++) {
        if (corner > 0) {
            int axis = corner == 1 ? first : corner == 3 ? last : 3 - first - last;
            at[axis]++;
            d[axis] -= 1;
            for (int a = 0; a < 3; a++)
                d[a] += 1 / 6.0f;
        }
        float t = 0.5f - d[0] * d[0] - d[1] * d[1] - d[2] * d[2];
        if (t <= 0)
            continue;
        int index = bl_textbook_index(at[0], at[1], at[2]);
        bl_vector g = bl_edge16_gradient((uint32_t)(index % 12) << 28);
        sum += t * t * t * t * (g.x * d[0] + g.y * d[1] + g.z * d[2]);
    }
    return 76 * sum;
}

// Multiples of 3.
static const char *const period_examples[] = {"6,9,12", "3", "6,0,300,9", NULL};

static const bl_parameter parameters[] = {
    BL_LATTICE_PARAMETERS_OF(simplex_parameters, "the gradients", "hash", period_examples),
    BL_DIMENSIONS_PARAMETER(simplex_parameters, 2, 4, "3"),
    {"radius2", BL_CHOICE, offsetof(simplex_parameters, radius2), "0.5", "units^2",
     .choices = radius_choices, .help = "squared radius of the kernel; 0.6 is not continuous"},
    {0}};

BL_NOISE_DESCRIPTOR(simplex_noise) = {
    .name = "simplex",
    .title = "simplex noise",
    .summary = "Gradients at the corners of a lattice of simplices, with a radial kernel.",
    .formula =
        "n(p) = N sum_c (g_c . d) max(0, 1/2 - |d|^2)^4, d = p - c, c the corners of the "
        "simplex around p",
    .paper = "perlin2001, gustavson2005",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(simplex_parameters),
    .validate = validate,
    .describe = describe,
    .has_closed_form = has_closed_form,
    .textbook = textbook,
    .functions = {BL_NOISE_FUNCTIONS, .values = values, .gradient = gradient, BL_NOISE_CLOSED_FORM},
};
