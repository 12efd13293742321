// SPDX-License-Identifier: MIT
//
// cellular: Worley's cellular noise, the distance to the nearest of random points.
//
//   F1(p) <= F2(p) <= ...  the sorted distances |p - q| of all feature points q
//   n(p) = F1(p), F2(p) or F2(p) - F1(p)
//
// Parameters
//   seed, lattice, component, period   of the places of the feature points
//                                      (noises/lattice/lattice.h)
//   dims     2 or 3
//   points   1 to 4 feature points in each cell
//   value    f1, f2 or f2-f1
//   metric   the length of d = p - q: euclidean, (sum d_a^2)^(1/2); manhattan, sum |d_a|;
//            chebyshev, max |d_a|
//
// Each coordinate of a feature point within its cell is independent, an odd multiple of 2^-21 in
// (0, 1), uniform. Units: coordinates and values in cells.
//
// Bound. Let f be the place of p in its cell, m_a = min(f_a, 1 - f_a) <= 1/2, and m = m_b the least
// of them. A point of the cell of p is off by less than 1 - m_a along each axis, so
//
//   F1 < |(1, ..., 1)| = D:  sqrt d, d and 1 in the three metrics.
//
// D is the supremum: at a lattice point all the cells around it can have their points in the far
// corners. With 2 or more points a cell, F2 < D as well. With one, take the neighbour beyond the
// nearest face: its point is off by less than 1 + m along b and 1 - m_a <= 1 - m along the others.
// The length of (1 + m, 1 - m, ...) is convex in m, so the largest is at an end of [0, 1/2]:
//
//   F2 < max(D, |(3/2, 1/2, ...)|):  sqrt(5/2) for d = 2 and sqrt 3 for d = 3; d; 3/2.
//
// 0 <= F2 - F1 <= F2. Floats keep it: no coordinate of a difference above is nearer than 2^-21 to
// its limit, and all that follows is rounded by less than 2^-22 of itself.
//
// Cells to visit. A cell more than r planes away along an axis a is r + m_a away or more.
//   chebyshev  r = 1: F1 < 1 and F2 < 1 + m <= 1 + m_a.
//   else       r = 2, but 3 for manhattan with d = 3: r is not below the bound.
// Of the (2r + 1)^d cells those stay that are nearer to some place of the middle cell than the
// bound, where a cell k is max(0, |k_a| - 1) away along a. The float loops visit those; fewer will
// not do (for euclidean F1, 3^d give a wrong distance where the points near a lattice point are all
// far from it). The reference knows nothing of it: it goes on, ring by ring, until a ring is
// farther away than the second point that it found.
//
// C0: a crease where two points are equally near, and a kink at a feature point; where there is no
// gradient, it is one of those beside the place, and at a feature point 0. No band is stated:
// creases decay slowly. Mean and variance are not stated, and depend on the place in the cell: the
// lattice shows.
//
// Source: worley1996, which was not at hand; this is the method as the field describes it.
// Deviations: there the number of points of a cell is drawn from a Poisson distribution, which
// hides the lattice and leaves no bound; here it is fixed.
#include <stddef.h>
#include <stdlib.h>

#include "noises/closed_forms.h"
#include "noises/common_parameters.h"
#include "noises/lattice/separable_dimensions.h"
#include "noises/lattice/reference.h"
#include "noises/noise.h"
#include "noises/textbook.h"

enum {
    MOST_AXES = 3,
    MOST_POINTS = 4,
    MOST_REACH = 3,
    MOST_PLANES = 2 * MOST_REACH + 1,
    MOST_CELLS = MOST_PLANES * MOST_PLANES * MOST_PLANES,
    FAR_SQUARES = MOST_AXES * MOST_REACH * MOST_REACH + 1
};

typedef enum cellular_value { F1, F2, F2_LESS_F1 } cellular_value;
typedef enum cellular_metric { EUCLIDEAN, MANHATTAN, CHEBYSHEV } cellular_metric;

static const char *const value_choices[] = {"f1", "f2", "f2-f1", NULL};
static const char *const metric_choices[] = {"euclidean", "manhattan", "chebyshev", NULL};

typedef struct cellular_parameters {
    bl_lattice_settings lattice;
    uint32_t dimensions, points, value, metric;
} cellular_parameters;

// A feature point has a lattice of its own, whose components are its coordinates.
static bl_lattice lattice_of(const cellular_parameters *p, unsigned point) {
    bl_lattice lattice = bl_lattice_open(&p->lattice);
    uint64_t seed = bl_component_seed(p->lattice.seed, p->lattice.component);
    for (unsigned axis = 0; axis < MOST_AXES && point > 0; axis++) {
        // Those of the lattice end at 6.
        uint64_t bits = bl_stream(seed, 16 + MOST_AXES * point + axis);
        lattice.add[axis] = (uint32_t)bits;
        lattice.exclusive[axis] = (uint32_t)(bits >> 32);
    }
    return lattice;
}

// A metric's length, squared for the euclidean one: it grows with the size of each number, also as
// rounded. The third is 0 in two dimensions.
static double size_of(cellular_metric metric, double x, double y, double z) {
    if (metric == EUCLIDEAN)
        return x * x + y * y + z * z;
    if (metric == MANHATTAN)
        return fabs(x) + fabs(y) + fabs(z);
    return fmax(fabs(x), fmax(fabs(y), fabs(z)));
}

// The bound of F1, or of F2, as a size.
static double bound_of(const cellular_parameters *p) {
    cellular_metric metric = (cellular_metric)p->metric;
    int deep = p->dimensions == 3;
    double own = size_of(metric, 1, 1, deep);
    if (p->value == F1 || p->points > 1)
        return own;
    return fmax(own, size_of(metric, 1.5, 0.5, deep ? 0.5 : 0));
}

// --- points -------------------------------------------------------------------------------------

// What a call makes of the parameters. The cells to visit stand in the order of the distances of
// their middles, so that the nearest points come first.
typedef struct cellular {
    cellular_metric metric;
    cellular_value value;
    unsigned dimensions, points;
    bl_lattice lattice[MOST_POINTS];
    bl_lattice_key key[MOST_POINTS][MOST_AXES]; // of a coordinate, and of the axis left out
    uint32_t words256[MOST_POINTS][MOST_AXES][256];
    int reach, cells;
    signed char cell[MOST_CELLS][MOST_AXES];
} cellular;

static double gap_of(int k) {
    return k > 0 ? k - 1 : k < 0 ? -k - 1 : 0;
}

static void choose_cells(cellular *noise, double bound) {
    const int reach = noise->reach, deep = noise->dimensions == 3 ? reach : 0;
    int place[FAR_SQUARES + 1] = {0};
    // First the counts of all squared distances, then the cells.
    for (int pass = 0; pass < 2; pass++) {
        for (int z = -deep; z <= deep; z++)
            for (int y = -reach; y <= reach; y++)
                for (int x = -reach; x <= reach; x++) {
                    int square = x * x + y * y + z * z;
                    if (!(size_of(noise->metric, gap_of(x), gap_of(y), gap_of(z)) < bound))
                        continue;
                    if (pass == 0) {
                        place[square + 1]++;
                        continue;
                    }
                    signed char *cell = noise->cell[place[square]++];
                    cell[0] = (signed char)x;
                    cell[1] = (signed char)y;
                    cell[2] = (signed char)z;
                }
        for (int square = 0; pass == 0 && square < FAR_SQUARES; square++)
            place[square + 1] += place[square];
    }
    noise->cells = place[FAR_SQUARES];
}

static void open_cellular(const cellular_parameters *p, cellular *noise) {
    noise->metric = (cellular_metric)p->metric;
    noise->value = (cellular_value)p->value;
    noise->dimensions = p->dimensions;
    noise->points = p->points;
    for (unsigned n = 0; n < p->points; n++) {
        noise->lattice[n] = lattice_of(p, n);
        for (unsigned a = 0; a < p->dimensions; a++) {
            noise->key[n][a] = bl_lattice_rest(&noise->lattice[n], p->dimensions, a);
            if (p->lattice.kind == BL_LATTICE_PERM256)
                bl_perm256_words(&noise->lattice[n], a, noise->words256[n][a]);
        }
    }
    noise->reach = 2;
    if (noise->metric == CHEBYSHEV)
        noise->reach = 1;
    else if (noise->metric == MANHATTAN && noise->dimensions == 3)
        noise->reach = 3;
    choose_cells(noise, bound_of(p));
}

// The keys of the planes around some points, and their fractions.
typedef struct planes {
    const uint32_t *add[MOST_AXES][MOST_PLANES], *exclusive[MOST_AXES][MOST_PLANES],
        *plane[MOST_AXES][MOST_PLANES];
    const float *fraction[MOST_AXES];
} planes;

static void add_planes(planes *around, const bl_point_block *block, int from) {
    for (unsigned axis = 0; axis < block->dimensions; axis++) {
        const bl_axis_block *keys = &block->axis[axis];
        around->fraction[axis] = keys->fraction;
        for (int knot = 0; knot < block->knots; knot++) {
            around->add[axis][from + knot] = keys->add[knot];
            around->exclusive[axis][from + knot] = keys->exclusive[knot];
            around->plane[axis][from + knot] = keys->plane[knot];
        }
    }
}

BL_INLINE float larger(float a, float b) {
    return a > b ? a : b;
}

BL_INLINE float smaller(float a, float b) {
    return a < b ? a : b;
}

BL_INLINE float size_of_floats(cellular_metric metric, unsigned dimensions, float x, float y,
                               float z) {
    if (metric == EUCLIDEAN)
        return dimensions == 3 ? (x * x + y * y) + z * z : x * x + y * y;
    if (metric == MANHATTAN)
        return dimensions == 3 ? (fabsf(x) + fabsf(y)) + fabsf(z) : fabsf(x) + fabsf(y);
    float flat = larger(fabsf(x), fabsf(y));
    return dimensions == 3 ? larger(flat, fabsf(z)) : flat;
}

// How far away cell k is from a fraction along an axis. A feature point's q - f lies between -f and
// 1 - f, all three exact multiples of 2^-24, and adding k rounds all alike: it is not nearer.
BL_INLINE float gap_of_floats(float k, float fraction) {
    return larger(0, larger(k - fraction, -((1 - fraction) + k)));
}

// The words of a cell at some lanes: what the keys of its planes make, before the coordinate's own
// key (lattice=hash), or the index (lattice=perm256).
typedef struct lane_words {
    uint32_t add[BL_LANES], exclusive[BL_LANES];
} lane_words;

BL_INLINE void cell_words(const cellular *noise, const planes *around, const signed char *cell,
                          unsigned dimensions, size_t from, lane_words *restrict words) {
    const int x = cell[0] + noise->reach, y = cell[1] + noise->reach,
              z = dimensions == 3 ? cell[2] + noise->reach : 0;
    if (noise->lattice[0].kind == BL_LATTICE_PERM256) {
        for (size_t i = 0; i < BL_LANES; i++) {
            const uint64_t there[BL_AXES] = {
                around->plane[0][x][from + i], around->plane[1][y][from + i],
                dimensions == 3 ? around->plane[2][z][from + i] : 0, 0};
            words->add[i] = bl_perm256_index_in(dimensions, there);
        }
        return;
    }
    const uint32_t *restrict ax = around->add[0][x] + from, *restrict ay = around->add[1][y] + from;
    const uint32_t *restrict ex = around->exclusive[0][x] + from, *restrict ey =
                                                                      around->exclusive[1][y] +
                                                                      from;
    // In two dimensions z is not read.
    const uint32_t *restrict az = dimensions == 3 ? around->add[2][z] + from : ax;
    const uint32_t *restrict ez = dimensions == 3 ? around->exclusive[2][z] + from : ex;
#pragma omp simd
    for (size_t i = 0; i < BL_LANES; i++) {
        words->add[i] = ax[i] + ay[i] + (dimensions == 3 ? az[i] : 0);
        words->exclusive[i] = ex[i] ^ ey[i] ^ (dimensions == 3 ? ez[i] : 0);
    }
}

// The coordinates of a feature point in its cell, exactly.
BL_INLINE void feature_points(const cellular *noise, unsigned point, unsigned dimensions,
                              const lane_words *restrict words, float (*restrict place)[BL_LANES]) {
    for (unsigned axis = 0; axis < dimensions; axis++) {
        const bl_lattice_key key = noise->key[point][axis];
        const uint32_t *restrict table = noise->words256[point][axis];
        float *restrict to = place[axis];
        if (noise->lattice[0].kind == BL_LATTICE_PERM256) {
            for (size_t i = 0; i < BL_LANES; i++)
                to[i] = bl_lattice_value(table[words->add[i]]) * 0x1p-32f + 0.5f;
            continue;
        }
#pragma omp simd
        for (size_t i = 0; i < BL_LANES; i++) {
            uint32_t word = (words->add[i] + key.add) * (words->exclusive[i] ^ key.exclusive);
            to[i] = bl_lattice_value(word) * 0x1p-32f + 0.5f;
        }
    }
}

// The two least sizes at BL_LANES points. A cell that is no nearer than what was found at all of
// them is left out, which changes no bit.
BL_INLINE void search_lanes(const cellular *noise, const planes *around, size_t from,
                            cellular_metric metric, unsigned dimensions, float *restrict found,
                            float *restrict found_second) {
    const float *restrict fx = around->fraction[0] + from, *restrict fy =
                                                               around->fraction[1] + from;
    const float *restrict fz = dimensions == 3 ? around->fraction[2] + from : fx;
    float first[BL_LANES], second[BL_LANES], place[MOST_AXES][BL_LANES] = {{0}};
    const float *limit = noise->value == F1 ? first : second;
    lane_words words;
    for (size_t i = 0; i < BL_LANES; i++)
        first[i] = second[i] = INFINITY;
    for (int c = 0; c < noise->cells; c++) {
        const signed char *cell = noise->cell[c];
        const float kx = cell[0], ky = cell[1], kz = cell[2];
        uint32_t nearer = 0;
#pragma omp simd reduction(| : nearer)
        for (size_t i = 0; i < BL_LANES; i++) {
            float gap = size_of_floats(metric, dimensions, gap_of_floats(kx, fx[i]),
                                       gap_of_floats(ky, fy[i]), gap_of_floats(kz, fz[i]));
            nearer |= gap < limit[i];
        }
        if (!nearer)
            continue;
        cell_words(noise, around, cell, dimensions, from, &words);
        for (unsigned n = 0; n < noise->points; n++) {
            feature_points(noise, n, dimensions, &words, place);
#pragma omp simd
            for (size_t i = 0; i < BL_LANES; i++) {
                float size = size_of_floats(metric, dimensions, (place[0][i] - fx[i]) + kx,
                                            (place[1][i] - fy[i]) + ky, (place[2][i] - fz[i]) + kz);
                second[i] = smaller(second[i], larger(first[i], size));
                first[i] = smaller(first[i], size);
            }
        }
    }
    memcpy(found, first, sizeof first);
    memcpy(found_second, second, sizeof second);
}

BL_INLINE void search_in(const cellular *noise, const planes *around, size_t from,
                         unsigned dimensions, float *first, float *second) {
    if (noise->metric == EUCLIDEAN)
        search_lanes(noise, around, from, EUCLIDEAN, dimensions, first, second);
    else if (noise->metric == MANHATTAN)
        search_lanes(noise, around, from, MANHATTAN, dimensions, first, second);
    else
        search_lanes(noise, around, from, CHEBYSHEV, dimensions, first, second);
}

static void value_of_sizes(const cellular *noise, size_t lanes, float *restrict first,
                           float *restrict second, float *restrict value) {
    if (noise->metric == EUCLIDEAN) {
#pragma omp simd
        for (size_t i = 0; i < lanes; i++) {
            first[i] = sqrtf(first[i]);
            second[i] = sqrtf(second[i]);
        }
    }
    // A search for the first alone may have left out all others: the second is then infinite.
    if (noise->value == F1) {
        memcpy(value, first, lanes * sizeof *value);
        return;
    }
    const float share = noise->value == F2 ? 0 : 1;
#pragma omp simd
    for (size_t i = 0; i < lanes; i++)
        value[i] = second[i] - share * first[i];
}

static void cellular_points(const void *opened, const double *const at[BL_AXES], size_t count,
                            float *out) {
    const cellular *noise = opened;
    const int planes_an_axis = 2 * noise->reach + 1;
    const int near = planes_an_axis < BL_KNOTS ? planes_an_axis : BL_KNOTS;
    bl_point_block block, more; // the planes that one block has no room for
    planes around;
    float first[BL_BLOCK], second[BL_BLOCK], value[BL_BLOCK];
    bl_point_block_begin_in(&block, &noise->lattice[0], noise->dimensions, -noise->reach, near);
    add_planes(&around, &block, 0);
    if (planes_an_axis > near) {
        bl_point_block_begin_in(&more, &noise->lattice[0], noise->dimensions, near - noise->reach,
                                planes_an_axis - near);
        add_planes(&around, &more, near);
    }
    for (size_t done = 0; done < count; done += BL_BLOCK) {
        size_t here = count - done < BL_BLOCK ? count - done : BL_BLOCK;
        bl_point_block_load(&block, at, done, here);
        if (planes_an_axis > near)
            bl_point_block_load(&more, at, done, here);
        for (size_t from = 0; from < block.lanes; from += BL_LANES)
            if (noise->dimensions == 3)
                search_in(noise, &around, from, 3, first + from, second + from);
            else
                search_in(noise, &around, from, 2, first + from, second + from);
        value_of_sizes(noise, block.lanes, first, second, value);
        bl_point_block_store(&block, value, 1, here, out + done);
    }
}

static void points(const void *block, const double *const at[BL_AXES], size_t count, float *out) {
    cellular noise;
    open_cellular(block, &noise);
    cellular_points(&noise, at, count, out);
}

// Neighbouring samples leave out the same cells, which is all that a row could know.
static void row(const void *block, const double start[BL_AXES], const double step[BL_AXES],
                size_t count, float *out) {
    cellular noise;
    open_cellular(block, &noise);
    bl_row_by_points(cellular_points, &noise, start, step, 0, count, out);
}

// --- the reference in double --------------------------------------------------------------------

typedef struct nearest {
    double distance, away[MOST_AXES]; // from the feature point to the place
} nearest;

static double distance_of(cellular_metric metric, const double away[MOST_AXES]) {
    double size = size_of(metric, away[0], away[1], away[2]);
    return metric == EUCLIDEAN ? sqrt(size) : size;
}

// The derivative of a distance along an axis.
static double slope_of(cellular_metric metric, const nearest *point, unsigned axis) {
    double d = point->away[axis], sign = (d > 0) - (d < 0);
    if (metric == EUCLIDEAN)
        return point->distance > 0 ? d / point->distance : 0;
    if (metric == MANHATTAN)
        return sign;
    for (unsigned other = 0; other < axis; other++)
        if (fabs(point->away[other]) == point->distance)
            return 0;
    return fabs(d) == point->distance ? sign : 0;
}

// Sorts the feature points of cell k, counted from the place's own, into the two nearest.
static void visit(const cellular_parameters *p, const bl_lattice *lattices,
                  const uint64_t cell[BL_AXES], const double fraction[MOST_AXES],
                  const int k[MOST_AXES], nearest found[2]) {
    uint64_t there[BL_AXES] = {0};
    for (unsigned a = 0; a < p->dimensions; a++)
        there[a] = cell[a] + (uint64_t)(int64_t)k[a];
    for (unsigned n = 0; n < p->points; n++) {
        nearest point = {0};
        for (unsigned a = 0; a < p->dimensions; a++) {
            uint32_t word = bl_lattice_word_in(&lattices[n], p->dimensions, there, a);
            point.away[a] = fraction[a] - k[a] - (bl_lattice_value(word) * 0x1p-32 + 0.5);
        }
        point.distance = distance_of((cellular_metric)p->metric, point.away);
        if (point.distance < found[0].distance) {
            found[1] = found[0];
            found[0] = point;
        } else if (point.distance < found[1].distance)
            found[1] = point;
    }
}

static void visit_ring(const cellular_parameters *p, const bl_lattice *lattices,
                       const uint64_t cell[BL_AXES], const double fraction[MOST_AXES], int ring,
                       nearest found[2]) {
    const int deep = p->dimensions == 3 ? ring : 0;
    for (int z = -deep; z <= deep; z++)
        for (int y = -ring; y <= ring; y++)
            for (int x = -ring; x <= ring; x++)
                if (size_of(CHEBYSHEV, x, y, z) == ring)
                    visit(p, lattices, cell, fraction, (const int[]){x, y, z}, found);
}

typedef struct cellular_lattices {
    bl_lattice of[MOST_POINTS]; // the feature points of a cell
} cellular_lattices;

static cellular_lattices open_lattices(const void *block) {
    const cellular_parameters *p = block;
    cellular_lattices lattices;
    for (unsigned n = 0; n < p->points; n++)
        lattices.of[n] = lattice_of(p, n);
    return lattices;
}

static double reference(const cellular_parameters *p, const cellular_lattices *lattices,
                        const double at[BL_AXES], double gradient[BL_AXES]) {
    uint64_t cell[BL_AXES] = {0};
    double fraction[MOST_AXES] = {0};
    nearest found[2] = {{.distance = INFINITY}, {.distance = INFINITY}};
    int inside = 1;
    for (unsigned a = 0; a < p->dimensions; a++)
        inside &= bl_lattice_split(at[a], &cell[a], &fraction[a]);
    // A ring's cells are ring - 1 away or more along some axis, in every metric.
    for (int ring = 0; inside && ring - 1 < found[1].distance; ring++)
        visit_ring(p, lattices->of, cell, fraction, ring, found);
    const double of_first = p->value == F1 ? 1 : p->value == F2 ? 0 : -1;
    const double of_second = p->value == F1 ? 0 : 1;
    for (unsigned a = 0; gradient && a < BL_AXES; a++) {
        gradient[a] = inside ? 0 : NAN;
        if (inside && a < p->dimensions)
            gradient[a] = of_second * slope_of((cellular_metric)p->metric, &found[1], a) +
                          of_first * slope_of((cellular_metric)p->metric, &found[0], a);
    }
    return inside ? of_second * found[1].distance + of_first * found[0].distance : NAN;
}

static double value_at(const void *block, const cellular_lattices *lattices,
                       const double at[BL_AXES]) {
    return reference(block, lattices, at, NULL);
}

BL_VALUES_OF_OPENED(cellular_lattices, open_lattices)

static void gradient(const void *block, const double at[BL_AXES], double out[BL_AXES]) {
    const cellular_lattices lattices = open_lattices(block);
    reference(block, &lattices, at, out);
}

// --- facts --------------------------------------------------------------------------------------

static void describe(const void *block, bl_facts *facts) {
    const cellular_parameters *p = block;
    double size = bound_of(p);
    bl_bound bound = {p->metric == EUCLIDEAN ? sqrt(size) : size,
                      "the farthest corner of the cell, and for the second of one point a cell of "
                      "the neighbour beyond the nearest face"};
    bl_lattice_describe(bound, 0, &p->lattice, facts);
    facts->lower = 0;
}

// One point a cell: the 27 cells around, and those beyond only if they can have a nearer one.
static float textbook_nearest(const int cell[3], const float fraction[3], int from, int to,
                              float least) {
    for (int k = -to; k <= to; k++)
        for (int j = -to; j <= to; j++)
            for (int i = -to; i <= to; i++) {
                if (abs(i) < from && abs(j) < from && abs(k) < from)
                    continue;
                int index = bl_textbook_index(cell[0] + i, cell[1] + j, cell[2] + k);
                const float *place = &bl_textbook_data.places[3 * index];
                float dx = (float)i + place[0] - fraction[0],
                      dy = (float)j + place[1] - fraction[1],
                      dz = (float)k + place[2] - fraction[2];
                float square = dx * dx + dy * dy + dz * dz;
                least = square < least ? square : least;
            }
    return least;
}

static float textbook(float x, float y, float z) {
    const float at[3] = {x, y, z};
    int cell[3];
    float fraction[3], edge = 1;
    for (int a = 0; a < 3; a++) {
        cell[a] = bl_textbook_floor(at[a]);
        fraction[a] = at[a] - (float)cell[a];
        edge = smaller(edge, smaller(fraction[a], 1 - fraction[a]));
    }
    float least = textbook_nearest(cell, fraction, 0, 1, INFINITY);
    if (least > (1 + edge) * (1 + edge))
        least = textbook_nearest(cell, fraction, 2, 2, least);
    return sqrtf(least);
}

static const bl_parameter parameters[] = {
    BL_LATTICE_PARAMETERS(cellular_parameters, "the places of the feature points"),
    BL_DIMENSIONS_PARAMETER(cellular_parameters, 2, 3, "3"),
    {"points", BL_INTEGER, offsetof(cellular_parameters, points), "1", "", .minimum = 1,
     .maximum = MOST_POINTS, .help = "feature points in each cell"},
    {"value", BL_CHOICE, offsetof(cellular_parameters, value), "f1", "", .choices = value_choices,
     .help = "the distance to the nearest feature point, to the second, or their difference"},
    {"metric", BL_CHOICE, offsetof(cellular_parameters, metric), "euclidean", "",
     .choices = metric_choices, .help = "how distances are measured"},
    {0}};

BL_NOISE_DESCRIPTOR(cellular_noise) = {
    .name = "cellular",
    .title = "cellular noise",
    .summary = "The distance to the nearest of random points, or to the second nearest.",
    .formula = "n(p) = F1 | F2 | F2 - F1, F1 <= F2 <= ... the sorted |p - q|, q feature points",
    .paper = "worley1996",
    .dimensions = 3,
    .parameters = parameters,
    .parameters_size = sizeof(cellular_parameters),
    .describe = describe,
    .textbook = textbook,
    .textbook_settings = BL_TEXTBOOK_VALUES,
    .functions =
        {.row = row, .points = points, .value = value, .values = values, .gradient = gradient},
};
