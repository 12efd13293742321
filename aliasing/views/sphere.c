// SPDX-License-Identifier: MIT
//
// sphere: a sphere of radius 1 in the middle of the image.
//
//   |eye + far d| = 1, the nearer of two:  far = -b - sqrt(b^2 - c),  b = eye . d,  c = eye^2 - 1
//   surface: (s, t) = scale / (2 pi) (longitude, -latitude)
//   solid: scale (x, y, z)
//
// Parameters: those of aliasing/object_view.h. At the poles longitude has no derivative, and
// nothing is seen at those two places; nor is it at the very rim, where b^2 - c is below 1e-12.
#include "aliasing/object_view.h"

typedef struct sphere_parameters {
    bl_object_view object;
} sphere_parameters;

static int see(const void *block, const double size[2], double x, double y, bl_sight *sight) {
    const bl_object_view *view = &((const sphere_parameters *)block)->object;
    double eye[3];
    bl_jet_vector ray = bl_object_ray(view, size, x, y, eye);
    bl_jet b = bl_jet_constant(0);
    for (int a = 0; a < 3; a++)
        b = bl_jet_add(b, bl_jet_scale(ray.axis[a], eye[a]));
    double c = view->distance * view->distance - 1;
    bl_jet discriminant = bl_jet_subtract(bl_jet_multiply(b, b), bl_jet_constant(c));
    if (!(discriminant.value > 1e-12))
        return 0;
    bl_jet far = bl_jet_subtract(bl_jet_scale(b, -1), bl_jet_root(discriminant));
    bl_jet_vector place = bl_object_place(eye, &ray, far);
    const bl_jet *p = place.axis;
    bl_jet ring = bl_jet_add(bl_jet_multiply(p[0], p[0]), bl_jet_multiply(p[1], p[1]));
    if (view->coordinates == 0 && !(ring.value > 1e-24))
        return 0;
    *sight = (bl_sight){.distance = far.value};
    if (view->coordinates == 1) {
        bl_object_set_solid(view, &place, sight);
        return 1;
    }
    double unit = view->scale / (2 * M_PI);
    bl_object_set(sight, 0, bl_jet_scale(bl_jet_angle(p[1], p[0]), unit));
    bl_object_set(sight, 1, bl_jet_scale(bl_jet_angle(p[2], bl_jet_root(ring)), -unit));
    return 1;
}

static const char *const words[] = {"surface", "solid", NULL};
static const bl_parameter parameters[] = {
    BL_OBJECT_PARAMETERS(sphere_parameters, words, "3", "20", 1.001), {0}};

static const char *const examples[] = {"distance=1.5,tilt=-50,turn=70,fov=90",
                                       "coordinates=solid,scale=3", NULL};

BL_VIEW_DESCRIPTOR(sphere) = {.name = "sphere",
                              .title = "sphere",
                              .summary = "A sphere: longitude and latitude, or a solid signal.",
                              .formula = "(s, t) = scale / (2 pi) (longitude, -latitude)",
                              .parameters = parameters,
                              .parameters_size = sizeof(sphere_parameters),
                              .examples = examples,
                              .see = see};
