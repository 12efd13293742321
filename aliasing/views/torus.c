// SPDX-License-Identifier: MIT
//
// torus: a ring of radius 1 with a tube of radius 0.4, in the middle of the image.
//
//   g(p) = sqrt((sqrt(x^2 + y^2) - 1)^2 + z^2) - 0.4, the distance from the surface
//   surface: (s, t) = scale / (2 pi) (angle around the axis, -angle around the tube)
//   solid: scale (x, y, z)
//
// The eye walks along its ray by g, which cannot step through the surface, and ends with Newton's
// steps; two more of them on jets make the derivatives exact, since each doubles the order that is
// right. Nothing is seen where the ray only grazes: closer than 1e-6 in the cosine of its angle.
//
// Parameters: `tube`, and those of aliasing/object_view.h.
#include "aliasing/object_view.h"

typedef struct torus_parameters {
    double tube;
    bl_object_view object;
} torus_parameters;

enum { STEPS = 400 };

static bl_jet distance_at(const bl_jet_vector *place, double tube) {
    const bl_jet *p = place->axis;
    bl_jet ring = bl_jet_root(bl_jet_add(bl_jet_multiply(p[0], p[0]), bl_jet_multiply(p[1], p[1])));
    bl_jet out = bl_jet_subtract(ring, bl_jet_constant(1));
    bl_jet axis = bl_jet_root(bl_jet_add(bl_jet_multiply(out, out), bl_jet_multiply(p[2], p[2])));
    return bl_jet_subtract(axis, bl_jet_constant(tube));
}

static double distance_from(const double p[3], double tube) {
    return hypot(hypot(p[0], p[1]) - 1, p[2]) - tube;
}

// How fast the distance from the surface changes along the ray.
static double slope_along(const double p[3], const bl_jet_vector *ray) {
    double ring = hypot(p[0], p[1]), axis = hypot(ring - 1, p[2]);
    double outwards = (ring - 1) / (axis * ring);
    return outwards * (p[0] * ray->axis[0].value + p[1] * ray->axis[1].value) +
           p[2] / axis * ray->axis[2].value;
}

// Walks to the surface; 0 if the ray passes it.
static int walk(const torus_parameters *p, const double eye[3], const bl_jet_vector *ray,
                double *far) {
    const double end = p->object.distance + 2 + p->tube;
    double place[3], gap = INFINITY;
    *far = 0;
    for (int i = 0; i < STEPS && *far < end; i++) {
        for (int a = 0; a < 3; a++)
            place[a] = eye[a] + *far * ray->axis[a].value;
        gap = distance_from(place, p->tube);
        double slope = slope_along(place, ray);
        if (fabs(gap) < 1e-13)
            return slope < -1e-6;
        // Near the surface Newton's step is longer than the safe one, and still on this side.
        *far += gap < 1e-3 && slope < -0.2 ? -gap / slope : gap;
    }
    return fabs(gap) < 1e-9 && *far < end && slope_along(place, ray) < -1e-6;
}

static int see(const void *block, const double size[2], double x, double y, bl_sight *sight) {
    const torus_parameters *p = block;
    const bl_object_view *view = &p->object;
    double eye[3], start;
    bl_jet_vector ray = bl_object_ray(view, size, x, y, eye);
    if (!walk(p, eye, &ray, &start))
        return 0;
    bl_jet far = bl_jet_constant(start);
    for (int i = 0; i < 2; i++) {
        bl_jet_vector place = bl_object_place(eye, &ray, far);
        const double at[3] = {place.axis[0].value, place.axis[1].value, place.axis[2].value};
        // The slope need not be a jet: what it lacks is of the order that the next step mends.
        far = bl_jet_subtract(
            far, bl_jet_scale(distance_at(&place, p->tube), 1 / slope_along(at, &ray)));
    }
    bl_jet_vector place = bl_object_place(eye, &ray, far);
    const bl_jet *q = place.axis;
    *sight = (bl_sight){.distance = far.value};
    if (view->coordinates == 1) {
        bl_object_set_solid(view, &place, sight);
        return 1;
    }
    double unit = view->scale / (2 * M_PI);
    bl_jet ring = bl_jet_root(bl_jet_add(bl_jet_multiply(q[0], q[0]), bl_jet_multiply(q[1], q[1])));
    bl_jet around = bl_jet_angle(q[1], q[0]);
    bl_jet tube = bl_jet_angle(q[2], bl_jet_subtract(ring, bl_jet_constant(1)));
    bl_object_set(sight, 0, bl_jet_scale(around, unit));
    bl_object_set(sight, 1, bl_jet_scale(tube, -unit));
    return 1;
}

static const char *const words[] = {"surface", "solid", NULL};
static const bl_parameter parameters[] = {
    {"tube", BL_REAL, offsetof(torus_parameters, tube), "0.4", "radii of the ring", .minimum = 0.01,
     .maximum = 0.9, .help = "radius of the tube"},
    BL_OBJECT_PARAMETERS(torus_parameters, words, "4", "45", 2),
    {0}};

static const char *const examples[] = {"tube=0.7,tilt=80,turn=33,distance=3",
                                       "coordinates=solid,tilt=10", NULL};

BL_VIEW_DESCRIPTOR(torus) = {
    .name = "torus",
    .title = "torus",
    .summary = "A ring: angles around it, or a solid signal.",
    .formula = "(s, t) = scale / (2 pi) (around the axis, -around the tube)",
    .parameters = parameters,
    .parameters_size = sizeof(torus_parameters),
    .examples = examples,
    .see = see};
