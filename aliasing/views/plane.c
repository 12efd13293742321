// SPDX-License-Identifier: MIT
//
// plane: a level plane seen in perspective, up to the horizon.
//
//   u, v: the pixel, in units of the focal length to the right and down; p: the pitch
//   D = sin p + v cos p, how steeply the ray falls
//   (s, t) = height (u, v sin p - cos p) / D, then turned and moved
//   ds/du = height / D,  ds/dv = -height u cos p / D^2,  dt/dv = height / D^2
//
// Parameters
//   height        of the eye above the plane, units
//   fov           of the image's width, degrees
//   pitch         of the line of sight below the horizon, degrees
//   rotate, x, y  where the eye looks, degrees to the left of -t, and the place below it
//   z, w          of the slice through a solid signal; random where they are not asked for
//
// t runs downwards in the image, towards the eye. At the horizon and above it nothing is seen. It
// ends where D = 1e-6, a million heights away: all numbers stay below 1e30, and a footprint there
// is millions of millions of heights long.
#include "aliasing/view.h"

#include <math.h>
#include <stddef.h>

typedef struct plane_parameters {
    double height, fov, pitch, rotate, x, y, z, w;
} plane_parameters;

static void set(const double *along, double a, double b, double *s, double *t) {
    *s = along[0] * a - along[1] * b;
    *t = -(along[1] * a + along[0] * b);
}

static int see(const void *block, const double size[2], double x, double y, bl_sight *sight) {
    const plane_parameters *p = block;
    const double pixel = 2 * tan(p->fov * (M_PI / 360)) / size[0];
    const double pitch = p->pitch * (M_PI / 180), turn = p->rotate * (M_PI / 180);
    const double along[2] = {cos(turn), sin(turn)}, c = cos(pitch);
    double u = pixel * (x - 0.5 * size[0]), v = pixel * (y - 0.5 * size[1]);
    double fall = sin(pitch) + v * c;
    if (!(fall >= 1e-6))
        return 0;
    double h = p->height, r = 1 / fall, square = pixel * pixel;
    *sight = (bl_sight){.at = {0, 0, p->z, p->w}, .distance = h * r * sqrt(1 + u * u + v * v)};
    set(along, h * r * u, h * r * (c - v * sin(pitch)), &sight->at[0], &sight->at[1]);
    sight->at[0] += p->x;
    sight->at[1] += p->y;
    set(along, pixel * h * r, 0, &sight->across[0], &sight->across[1]);
    set(along, -pixel * h * u * c * r * r, -pixel * h * r * r, &sight->down[0], &sight->down[1]);
    set(along, -square * h * c * r * r, 0, &sight->second[0][1], &sight->second[1][1]);
    set(along, 2 * square * h * u * c * c * r * r * r, 2 * square * h * c * r * r * r,
        &sight->second[0][2], &sight->second[1][2]);
    return 1;
}

// clang-format off
#define REAL(field, usual, measure, least, most, what)                                             \
    {#field, BL_REAL, offsetof(plane_parameters, field), usual, measure, .minimum = least,         \
     .maximum = most, .help = what}
// clang-format on
static const bl_parameter parameters[] = {
    REAL(height, "1", "units", 1e-9, 1e9, "of the eye above the plane"),
    REAL(fov, "60", "degrees", 0.001, 170, "of the image's width"),
    REAL(pitch, "15", "degrees", -90, 90, "of the line of sight below the horizon"),
    REAL(rotate, "0", "degrees", -360, 360, "of the line of sight to the left of -t"),
    REAL(x, "0", "units", -1e12, 1e12, "below the eye"),
    REAL(y, "0", "units", -1e12, 1e12, "below the eye"),
    REAL(z, "0", "units", -1e15, 1e15,
         "of the slice through a solid signal; without the key a random one"),
    REAL(w, "0", "units", -1e15, 1e15, "the same along the fourth axis"),
    {0}};

static const char *const examples[] = {"height=2.5,fov=80,pitch=40,rotate=-35,x=7,y=9", "pitch=90",
                                       NULL};

BL_VIEW_DESCRIPTOR(plane) = {.name = "plane",
                             .title = "plane in perspective",
                             .summary = "A level plane up to the horizon, the sky above it.",
                             .formula = "(s, t) = height (u, v sin p - cos p) / (sin p + v cos p)",
                             .parameters = parameters,
                             .parameters_size = sizeof(plane_parameters),
                             .examples = examples,
                             .see = see};
