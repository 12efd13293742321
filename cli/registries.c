// SPDX-License-Identifier: MIT
#include "cli/registries.h"

#include "aliasing/method.h"
#include "cli/verb.h"
#include "filters/primitive.h"
#include "reports/figure.h"
#include "score/score.h"
#include "score/trade.h"
#include "sources/source.h"
#include "textures/texture.h"

const bl_registry *const bl_registries[] = {
    &bl_noises,  &bl_primitives, &bl_filters,    &bl_textures, &bl_sources, &bl_views,
    &bl_methods, &bl_trades,     &bl_properties, &bl_figures,  &bl_verbs,   NULL};
