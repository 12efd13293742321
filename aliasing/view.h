// SPDX-License-Identifier: MIT
//
// The contract of a view, and the registry of all views: what the pixels of an image see of a
// texture.
//
// A view is one file in aliasing/views/, which ends with one descriptor, and one line in views.def.
// It gives for every place of the image the exact texture coordinates and their derivatives, so
// that the width of a sample is known and not guessed. A view is named as `plane:height=1,fov=60`.
#ifndef BL_ALIASING_VIEW_H
#define BL_ALIASING_VIEW_H

#include <stddef.h>

#include "core/registry.h"
#include "core/grammar.h"
#include "core/signal.h"
#include "filters/sample_width.h"

// What one place of the image sees.
typedef struct bl_sight {
    double at[BL_AXES];        // texture coordinates
    double across[BL_AXES];    // their derivative to the right, units per pixel
    double down[BL_AXES];      // and downwards
    double second[BL_AXES][3]; // second derivatives: right right, right down, down down
    double distance;           // from the eye, units; 1 for a view without an eye
} bl_sight;

// How wide the sample of a pixel is taken to be along each axis.
typedef struct bl_width_rule {
    bl_width_estimator estimator;
    double scale; // a factor on all widths
    double k;     // of BL_WIDTH_DISTANCE: units a unit of distance
} bl_width_rule;

// The footprint of a pixel that sees this: its sides are the first derivatives, its widths follow
// the rule. (Second derivatives, by which sides differ within a pixel, are left out.) An estimate
// without derivatives, as that of the distance, makes an upright footprint.
bl_footprint bl_sight_footprint(const bl_sight *sight, const bl_width_rule *rule);

typedef struct bl_view_kind {
    BL_ENTRY(title, summary);
    const char *formula; // from pixels to texture coordinates
    const bl_parameter *parameters;
    size_t parameters_size;
    // Optional: settings that the tests try besides the defaults, ended by NULL.
    const char *const *examples;
    // Optional: whether the parameters fit together. Errors: BL_USAGE.
    bl_status (*validate)(const void *parameters, bl_message *message);
    // What is seen at (x, y), in pixels from the upper left corner of an image of this size (a
    // pixel's own centre stands at halves); 0 if nothing is (the sky), and the sight is left alone.
    int (*see)(const void *parameters, const double size[2], double x, double y, bl_sight *sight);
    // The coordinates are straight in x and y, so that the footprint is the same all over.
    int affine;
} bl_view_kind;

BL_REGISTRY(bl_view_kind, bl_view, bl_views)

typedef struct bl_view {
    const bl_view_kind *kind;
    void *parameters;      // owned
    char *text;            // canonical, owned
    size_t width, height;  // of the image, pixels
    double zoom;           // of the image about its middle, for moving pictures; 1 when opened
    double pan[2];         // of the image, pixels to the right and down; 0 when opened
    double depth[BL_AXES]; // added to the coordinates (aliasing/depth.h); 0 when opened
    int asked[BL_AXES];    // the text asks for the place along this axis: by the keys z and w
} bl_view;

// Opens a view by its text, for images of this size; the caller ends with bl_view_close. Errors:
// BL_USAGE for an unknown name, key or value, BL_DEVICE out of memory. Thread-safe.
bl_status bl_view_open(const char *text, size_t width, size_t height, bl_view *view,
                       bl_message *message);
void bl_view_close(bl_view *view);

// What the view sees at a place of its image; 0 for nothing. Thread-safe.
int bl_view_see(const bl_view *view, double x, double y, bl_sight *sight);

// The centres of the pixels from number `first` on, row by row: up to BL_BATCH, as many as there
// are, which is what it returns.
size_t bl_view_pixels(const bl_view *view, size_t first, double x[BL_BATCH], double y[BL_BATCH]);

// Names the descriptor of a view file: BL_VIEW_DESCRIPTOR(plane) = {...};
#define BL_VIEW_DESCRIPTOR(stem)                                                                   \
    extern const bl_view_kind bl_view_##stem;                                                      \
    const bl_view_kind bl_view_##stem

#endif
