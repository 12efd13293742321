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
//   seed     64 bits, chooses the gradients
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
// density and band are exact (noises/simplex_theory.h). They are functions of the distance alone:
// over random places the noise is isotropic. For r2 = 0.6 the kernel is cut to the shape of the
// simplices, and there is no closed form.
//
// Period: none, and no key for one. Whole numbers shift the lattice into itself along an axis in
// 3-D by multiples of 3 only (u moves by (4, 1, 1), F = 1/3), and in 2-D and 4-D never: F is
// irrational. NaN, infinity and coordinates beyond 2^62 give NaN. The skew is exact: F has 128
// bits, so the noise is as good far out as near; from 2^52 on coordinates are whole numbers.
//
// Known defects: N makes it weaker than gnoise; the variance depends on the place, 0 at the
// corners; slices of the 3-D and 4-D noise are not 2-D noises and have another spectrum.
// Sources: Perlin 2001, Gustavson 2005. Deviations: gradients by hash of 64-bit cells; r2 = 0.5 in
// every dimension, where 0.6 is usual in 3-D and 4-D; the corners' order by ranks, not by a tree of
// comparisons; N from a proof.
#include <stddef.h>

#include "noises/closed_forms.h"
#include "noises/common_parameters.h"
#include "noises/gradient_kernel.h"
#include "noises/noise.h"
#include "noises/simplex_theory.h"

typedef struct simplex_parameters {
    uint64_t seed;
    uint32_t dimensions;
    uint32_t radius2;
} simplex_parameters;

static const char *const radius_choices[] = {"0.5", "0.6", NULL};
static const double radii[] = {0.5, 0.6};

// By radius2 and dims.
static const double normalisations[2][BL_AXES + 1] = {{0, 0, 99, 76, 61}, {0, 0, 34, 32, 26}};

// floor(2^128 F) by 64 bits, from whole square roots of 280 bits; F and G themselves.
static const uint64_t skew_high[] = {0, 0, 0x5db3d742c265539d, 0x5555555555555555,
                                     0x4f1bbcdcbfa53e0a};
static const uint64_t skew_low[] = {0, 0, 0x92ba16b83c5c1dc4, 0x5555555555555555,
                                    0xf9ce60302e76e41a};
static const double skews[] = {0, 0, 0.36602540378443865, 1.0 / 3, 0.30901699437494742};
static const double unskews[] = {0, 0, 0.21132486540518712, 1.0 / 6, 0.13819660112501051};

// --- the simplex of a point ---------------------------------------------------------------------

typedef struct simplex_place {
    uint64_t cell[BL_AXES]; // of the skewed point
    double offset[BL_AXES]; // from corner 0, not skewed
    uint32_t rank[BL_AXES]; // of the fractions: 0 for the largest
} simplex_place;

// The fraction of F S, S the sum of the cells; the whole part, modulo 2^64, to `whole`. In units of
// 2^-64: S times the high half of F modulo 2^128, which two's complement makes right for negative
// sums, and S times the low half, of which a bit is dropped: |S| < 2^64, so |S/2| < 2^63, and its
// product with 64 bits fits.
BL_INLINE double skewed_sum(unsigned dims, __int128 sum, uint64_t *whole) {
    __int128 low = ((__int128)(int64_t)(sum >> 1) * (__int128)skew_low[dims]) >> 63;
    unsigned __int128 all = (unsigned __int128)sum * skew_high[dims] + (unsigned __int128)low;
    *whole = (uint64_t)(all >> 64);
    return (double)(uint64_t)all * 0x1p-64;
}

// Returns 0 outside of the domain. Fractions of u are below 1 + 1 + n, so their floors are small.
BL_INLINE int find_simplex(unsigned dims, const double at[BL_AXES], simplex_place *place) {
    double fraction[BL_AXES], fractions = 0, total = 0;
    __int128 cells = 0;
    for (unsigned a = 0; a < dims; a++) {
        if (!bl_lattice_split(at[a], &place->cell[a], &fraction[a]))
            return 0;
        cells += (int64_t)place->cell[a];
        fractions += fraction[a];
    }
    uint64_t whole;
    double shift = skewed_sum(dims, cells, &whole) + skews[dims] * fractions;
    for (unsigned a = 0; a < dims; a++) {
        double u = fraction[a] + shift, down = floor(u);
        place->cell[a] += whole + (uint64_t)down;
        fraction[a] = u - down;
        total += fraction[a];
    }
    for (unsigned a = 0; a < dims; a++) {
        place->offset[a] = fraction[a] - unskews[dims] * total;
        place->rank[a] = 0;
        for (unsigned b = 0; b < dims; b++)
            place->rank[a] += fraction[b] > fraction[a] || (fraction[b] == fraction[a] && b < a);
    }
    return 1;
}

// --- gradients ----------------------------------------------------------------------------------

typedef struct simplex_gradient {
    float x, y, z, w;
} simplex_gradient;

// From the top bits of a word: exact floats, but for the diagonals in 2-D, whose floats are the
// gradient by definition.
BL_INLINE simplex_gradient gradient_of(unsigned dims, uint32_t word) {
    if (dims == 3) {
        bl_vector g = bl_edge_gradient(word);
        return (simplex_gradient){g.x, g.y, g.z, 0};
    }
    float p = word & 0x20000000u ? -1.0f : 1.0f, q = word & 0x10000000u ? -1.0f : 1.0f,
          r = word & 0x08000000u ? -1.0f : 1.0f;
    uint32_t kind = word >> 30;
    if (dims == 2) {
        // Two kinds of four: the diagonals, and the axes.
        const float diagonal = 0.70710678f;
        int is_diagonal = kind & 1, is_x = kind >> 1;
        return (simplex_gradient){is_diagonal ? diagonal * p
                                  : is_x      ? p
                                              : 0.0f,
                                  is_diagonal ? (is_x ? diagonal : -diagonal)
                                  : is_x      ? 0.0f
                                              : p,
                                  0, 0};
    }
    // The axis `kind` is left out; the three signs go to the others in turn.
    return (simplex_gradient){kind == 0 ? 0.0f : p,
                              kind == 1   ? 0.0f
                              : kind == 0 ? p
                                          : q,
                              kind == 2  ? 0.0f
                              : kind < 2 ? q
                                         : r,
                              kind == 3 ? 0.0f : r};
}

// --- points -------------------------------------------------------------------------------------

typedef struct simplex_block {
    uint32_t add[BL_AXES][2][BL_BLOCK], exclusive[BL_AXES][2][BL_BLOCK];
    uint32_t rank[BL_AXES][BL_BLOCK];
    float offset[BL_AXES][BL_BLOCK], nothing[BL_BLOCK];
} simplex_block;

BL_INLINE void load(simplex_block *block, const bl_lattice *lattice, unsigned dims,
                    const double *const at[BL_AXES], size_t from, size_t count) {
    for (size_t i = 0; i < count; i++) {
        simplex_place place = {0};
        double x[BL_AXES] = {0};
        for (unsigned a = 0; a < dims; a++)
            x[a] = at[a][from + i];
        block->nothing[i] = find_simplex(dims, x, &place) ? 0 : NAN;
        for (unsigned a = 0; a < dims; a++) {
            for (unsigned k = 0; k < 2; k++) {
                bl_lattice_key key = bl_lattice_key_of(lattice, a, place.cell[a] + k);
                block->add[a][k][i] = key.add;
                block->exclusive[a][k][i] = key.exclusive;
            }
            block->offset[a][i] = (float)place.offset[a];
            block->rank[a][i] = place.rank[a];
        }
    }
}

// What a corner adds to point i; corner k is one step further along the k axes of the least ranks.
BL_INLINE float corner_value(const simplex_block *block, unsigned dims, uint32_t k, float radius2,
                             size_t i) {
    uint32_t add = 0, exclusive = 0;
    float d[BL_AXES] = {0}, square = 0;
    const float back = (float)(k * unskews[dims]);
    for (unsigned a = 0; a < dims; a++) {
        int stepped = block->rank[a][i] < k;
        add += stepped ? block->add[a][1][i] : block->add[a][0][i];
        exclusive ^= stepped ? block->exclusive[a][1][i] : block->exclusive[a][0][i];
        d[a] = (block->offset[a][i] + back) - (stepped ? 1.0f : 0.0f);
        square += d[a] * d[a];
    }
    simplex_gradient g = gradient_of(dims, add * exclusive);
    float t = radius2 - square;
    t = t > 0 ? t * t : 0;
    float dot = g.x * d[0] + g.y * d[1];
    if (dims > 2)
        dot += g.z * d[2];
    if (dims > 3)
        dot += g.w * d[3];
    return t * t * dot;
}

BL_INLINE void points_of(const simplex_parameters *p, unsigned dims,
                         const double *const at[BL_AXES], size_t count, float *out) {
    const bl_lattice lattice = bl_lattice_of(p->seed, BL_LATTICE_HASH);
    const float radius2 = (float)radii[p->radius2], scale = (float)normalisations[p->radius2][dims];
    simplex_block block;
    for (size_t done = 0; done < count; done += BL_BLOCK) {
        size_t here = count - done < BL_BLOCK ? count - done : BL_BLOCK;
        float sum[BL_BLOCK] = {0};
        load(&block, &lattice, dims, at, done, here);
        for (uint32_t k = 0; k <= dims; k++)
#pragma omp simd
            for (size_t i = 0; i < here; i++)
                sum[i] += corner_value(&block, dims, k, radius2, i);
        for (size_t i = 0; i < here; i++)
            out[done + i] = sum[i] * scale + block.nothing[i];
    }
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

static void row(const void *block, const double start[BL_AXES], const double step[BL_AXES],
                size_t count, float *out) {
    bl_row_by_points(points, block, start, step, 0, count, out);
}

// --- the reference in double --------------------------------------------------------------------

static double reference(const void *block, const double at[BL_AXES], double gradient[BL_AXES]) {
    const simplex_parameters *p = block;
    const unsigned dims = p->dimensions;
    const bl_lattice lattice = bl_lattice_of(p->seed, BL_LATTICE_HASH);
    const double scale = normalisations[p->radius2][dims];
    simplex_place place;
    double sum = 0, slopes[BL_AXES] = {0};
    int inside = find_simplex(dims, at, &place);
    for (uint32_t k = 0; inside && k <= dims; k++) {
        uint32_t add = 0, exclusive = 0;
        double d[BL_AXES] = {0}, square = 0, dot = 0;
        for (unsigned a = 0; a < dims; a++) {
            int stepped = place.rank[a] < k;
            bl_lattice_key key = bl_lattice_key_of(&lattice, a, place.cell[a] + (stepped ? 1 : 0));
            add += key.add;
            exclusive ^= key.exclusive;
            d[a] = place.offset[a] - stepped + k * unskews[dims];
            square += d[a] * d[a];
        }
        simplex_gradient g = gradient_of(dims, add * exclusive);
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

static double value(const void *block, const double at[BL_AXES]) {
    return reference(block, at, NULL);
}

static void gradient(const void *block, const double at[BL_AXES], double out[BL_AXES]) {
    reference(block, at, out);
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
    return p->radius2 == 0;
}

static unsigned dimensions_of(const void *block) {
    const simplex_parameters *p = block;
    return p->dimensions;
}

static void describe(const void *block, bl_facts *facts) {
    facts->lower = -1;
    facts->upper = 1;
    facts->bound_proof =
        "the sum over the corners of the largest g . d times the kernel, certified "
        "over the simplex by branch and bound, times N";
    facts->mean = 0;
    facts->continuity = has_closed_form(block) ? 3 : -1;
    for (int axis = 0; axis < BL_AXES; axis++)
        facts->period[axis] = 0;
    facts->cell = 0; // its planes are not at whole numbers
    facts->far = 0x1p52;
    if (!has_closed_form(block))
        return;
    facts->isotropic = 1;
    facts->covariance_reach = M_SQRT2;
    facts->variance = covariance(block, (const double[BL_AXES]){0});
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

static const bl_parameter parameters[] = {
    BL_SEED_PARAMETER(simplex_parameters, seed, "the gradients"),
    BL_DIMENSIONS_PARAMETER(simplex_parameters, 2, 4, "3"),
    {.key = "radius2",
     .kind = BL_CHOICE,
     .offset = offsetof(simplex_parameters, radius2),
     .choices = radius_choices,
     .fallback = "0.5",
     .unit = "units^2",
     .help = "squared radius of the kernel; 0.6 is not continuous"},
    {.key = NULL}};

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
    .seed_offset = offsetof(simplex_parameters, seed),
    .dimensions_of = dimensions_of,
    .describe = describe,
    .has_closed_form = has_closed_form,
    .textbook = textbook,
    .functions = {BL_NOISE_FUNCTIONS, .gradient = gradient, BL_NOISE_CLOSED_FORM},
};
