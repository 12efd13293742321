// SPDX-License-Identifier: MIT
//
// The umbrella of the public headers. Each of them documents its functions: purpose, shapes,
// units, ownership, errors, thread safety.
#ifndef BANDLIMIT_H
#define BANDLIMIT_H

#ifdef __cplusplus
extern "C" {
#endif

#include "core/version.h"
#include "core/status.h"
#include "core/footprint.h"
#include "core/signal.h"
#include "core/grid.h"
#include "core/grammar.h"
#include "core/definition.h"
#include "core/hash.h"
#include "core/random.h"
#include "core/statistics.h"
#include "core/verdict.h"
#include "core/piecewise.h"
#include "core/file.h"
#include "noises/noise.h"
#include "filters/filter.h"
#include "filters/primitive.h"
#include "filters/response.h"
#include "filters/pulse_train.h"
#include "filters/checker.h"
#include "filters/summed_area.h"
#include "filters/pyramid.h"
#include "textures/texture.h"
#include "filters/sample_width.h"
#include "aliasing/view.h"
#include "aliasing/reference.h"
#include "aliasing/method.h"
#include "aliasing/alias.h"
#include "score/trade.h"
#include "score/advise.h"
#include "spectra/window.h"
#include "spectra/psd.h"
#include "spectra/autocorrelation.h"
#include "spectra/histogram.h"
#include "spectra/theory.h"
#include "core/image.h"
#include "sources/source.h"

#ifdef __cplusplus
}
#endif

#endif
