// SPDX-License-Identifier: MIT
//
// What the views of a solid object share: an eye that looks at its centre, and the coordinates that
// the signal takes there.
//
// The eye stands on the negative y axis and looks along it; z is up. The object is turned about its
// own axis (z), then tilted towards the eye about x. All numbers are jets in the pixel's place, so
// that derivatives are exact.
#ifndef BL_ALIASING_OBJECT_VIEW_H
#define BL_ALIASING_OBJECT_VIEW_H

#include <math.h>
#include <stddef.h>

#include "aliasing/jet.h"
#include "aliasing/view.h"

typedef struct bl_object_view {
    double distance, fov, tilt, turn, scale;
    uint32_t coordinates; // 0 surface, 1 solid
} bl_object_view;

// clang-format off
#define BL_OBJECT_REAL(block, field, usual, measure, least, most, what)                            \
    {#field, BL_REAL, offsetof(block, object.field), usual, measure, .minimum = least,             \
     .maximum = most, .help = what}

// The keys of bl_object_view, for a block that has it as `object`, with the file's own words of the
// coordinates, the usual distance and tilt as text, and the nearest distance.
#define BL_OBJECT_PARAMETERS(block, words, usual, tilted, nearest)                                 \
    BL_OBJECT_REAL(block, distance, usual, "units", nearest, 1e6, "of the eye from the centre"),   \
    BL_OBJECT_REAL(block, fov, "45", "degrees", 0.001, 170, "of the image's width"),               \
    BL_OBJECT_REAL(block, tilt, tilted, "degrees", -90, 90, "of the upper end towards the eye"),   \
    BL_OBJECT_REAL(block, turn, "0", "degrees", -360, 360, "about the object's own axis"),         \
    BL_OBJECT_REAL(block, scale, "8", "units", 1e-9, 1e9,                                          \
                   "of the signal once around, or solid, in a unit"),                              \
    {"coordinates", BL_CHOICE, offsetof(block, object.coordinates), "surface", "",                 \
     .choices = words,                                                                             \
     .help = "angles of the surface, or places of the object for a solid signal"}
// clang-format on

typedef struct bl_jet_vector {
    bl_jet axis[3];
} bl_jet_vector;

// The unit direction in which the pixel at (x, y) looks, and where the eye stands, both in the
// object's own axes.
static inline bl_jet_vector bl_object_ray(const bl_object_view *view, const double size[2],
                                          double x, double y, double eye[3]) {
    const double pixel = 2 * tan(view->fov * (M_PI / 360)) / size[0];
    double tilt = view->tilt * (M_PI / 180), turn = view->turn * (M_PI / 180);
    // Rows of the rotation into the object's axes: the inverse of turning and then tilting.
    const double c = cos(turn), s = sin(turn), ct = cos(tilt), st = sin(tilt);
    const double into[3][3] = {{c, s * ct, s * st}, {-s, c * ct, c * st}, {0, -st, ct}};
    const bl_jet camera[3] = {bl_jet_linear(pixel * (x - 0.5 * size[0]), pixel, 0),
                              bl_jet_constant(1),
                              bl_jet_linear(-pixel * (y - 0.5 * size[1]), 0, -pixel)};
    bl_jet squares = bl_jet_constant(0);
    bl_jet_vector ray;
    for (int a = 0; a < 3; a++)
        squares = bl_jet_add(squares, bl_jet_multiply(camera[a], camera[a]));
    bl_jet shorter = bl_jet_reciprocal(bl_jet_root(squares));
    for (int a = 0; a < 3; a++) {
        ray.axis[a] = bl_jet_constant(0);
        for (int b = 0; b < 3; b++)
            ray.axis[a] = bl_jet_add(ray.axis[a],
                                     bl_jet_scale(bl_jet_multiply(camera[b], shorter), into[a][b]));
        eye[a] = -view->distance * into[a][1];
    }
    return ray;
}

static inline bl_jet_vector bl_object_place(const double eye[3], const bl_jet_vector *ray,
                                            bl_jet far) {
    bl_jet_vector place;
    for (int a = 0; a < 3; a++)
        place.axis[a] = bl_jet_add(bl_jet_constant(eye[a]), bl_jet_multiply(far, ray->axis[a]));
    return place;
}

static inline void bl_object_set(bl_sight *sight, int axis, bl_jet coordinate) {
    sight->at[axis] = coordinate.value;
    sight->across[axis] = coordinate.first[0];
    sight->down[axis] = coordinate.first[1];
    for (int i = 0; i < 3; i++)
        sight->second[axis][i] = coordinate.second[i];
}

// The sight of a solid signal.
static inline void bl_object_set_solid(const bl_object_view *view, const bl_jet_vector *place,
                                       bl_sight *sight) {
    for (int a = 0; a < 3; a++)
        bl_object_set(sight, a, bl_jet_scale(place->axis[a], view->scale));
}

#endif
