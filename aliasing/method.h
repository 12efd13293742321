// SPDX-License-Identifier: MIT
//
// The contract of a sampling method, and the registry of all methods: the ways from a signal and a
// view to the colour of a pixel.
//
// A method is one file in aliasing/methods/, which ends with one descriptor, and one line in
// methods.def. It is named as `supersample:n=4,pattern=jitter,pixel=gaussian`. Every word of a
// texture's own key `filter` names a method too: the texture filters itself for the width that the
// view's derivatives give.
#ifndef BL_ALIASING_METHOD_H
#define BL_ALIASING_METHOD_H

#include "aliasing/view.h"
#include "core/registry.h"
#include "core/definition.h"
#include "filters/sample_width.h"

// What is sampled: all of it constant, and shared by threads.
typedef struct bl_scene {
    const bl_signal *signal;
    const bl_view *view;
    double background[3]; // where the view sees nothing
    double mean[3];       // the mean colour of the signal, for those who fade to it
    uint64_t seed;        // of sampling patterns
} bl_scene;

typedef struct bl_method_kind {
    BL_ENTRY(title, summary);
    const bl_parameter *parameters;
    size_t parameters_size;
    // Fills rgb[3 i] and the two behind it with the colour of the sample of one pixel's width
    // centred at (x[i], y[i]), in pixels. A method uses nothing but the scene, so that pixels may
    // be asked in any order, in any batch and from any thread.
    void (*sample)(const void *parameters, const bl_scene *scene, const double *x, const double *y,
                   size_t count, double *rgb);
    // The samples of the signal that a pixel takes, for the report.
    double (*samples)(const void *parameters);
    // Optional: the transform of the weights with which the signal is seen, at a frequency in
    // cycles per pixel to the right and down; 1 at 0. NAN where these parameters have none: a
    // method that is not linear, or not the same for all places.
    double (*response)(const void *parameters, double fx, double fy);
} bl_method_kind;

BL_REGISTRY(bl_method_kind, bl_method, bl_methods)

typedef struct bl_method {
    const bl_method_kind *kind;
    void *parameters;  // owned
    char *text;        // as in reports: "integral", "supersample:n=4"; owned
    bl_signal *signal; // the signal as this method reads it (with its word of `filter`); owned, but
                       // for one that cannot be copied (a file), which is the caller's
    int borrowed;
} bl_method;

// Opens a method for a signal, which must outlive it: a word of the signal's key `filter`, or one
// of the registry with its settings. The caller ends with bl_method_close. Errors: BL_USAGE for an
// unknown name (with the nearest), key or value; BL_DEVICE out of memory.
bl_status bl_method_open(const char *text, const bl_signal *signal, bl_method *method,
                         bl_message *message);
void bl_method_close(bl_method *method);

// The key whose words are the ways that the signal filters itself: "filter", or "clamp" of a sum of
// octaves; NULL for a signal that has none.
const char *bl_method_own_key(const bl_signal *signal);
// The words of this key, ended by NULL (at once, without a key); and whether a word is one of them.
const char *const *bl_method_own_words(const bl_signal *signal);
int bl_method_is_own(const bl_signal *signal, const char *word);
// Opens the signal with this word of its own for samples of a width, a number as text. The caller
// frees it. Errors: BL_USAGE if the signal, or its other settings, have no such word.
bl_status bl_method_open_own(const bl_signal *signal, const char *word, const char *width,
                             bl_signal **filtered, bl_message *message);

// The unfiltered colours of what the view sees at each (x, y), in pixels, 3 numbers a place; the
// background where it sees nothing. What methods sample. Thread-safe.
void bl_scene_points(const bl_scene *scene, const double *x, const double *y, size_t count,
                     double *rgb);
// The same at one place.
void bl_scene_point(const bl_scene *scene, double x, double y, double rgb[3]);
// The same as the signal filters itself for the footprints of the pixels.
void bl_scene_filtered(const bl_scene *scene, const bl_width_rule *rule, const double *x,
                       const double *y, size_t count, double *rgb);

// Names the descriptor of a method file: BL_METHOD_DESCRIPTOR(supersample) = {...};
#define BL_METHOD_DESCRIPTOR(stem)                                                                 \
    extern const bl_method_kind bl_method_##stem;                                                  \
    const bl_method_kind bl_method_##stem

#endif
