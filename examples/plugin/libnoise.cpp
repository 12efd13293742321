// SPDX-License-Identifier: MIT
//
// The gradient and the value noise of libnoise (Debian: libnoise-dev), in C++.
#include <cmath>

#include <libnoise/noise.h>

#include "bandlimit_plugin.h"

namespace {

// libnoise turns coordinates into ints; beyond them it has no value.
bool in_range(const double *p) {
    return std::fabs(p[0]) < 1e9 && std::fabs(p[1]) < 1e9 && std::fabs(p[2]) < 1e9;
}

void claim(bandlimit_claims *claims) {
    claims->dims = 3;
    claims->continuity = 1; // QUALITY_STD: the cubic fade
    claims->cell = 1;
    claims->band_from = 0; // measured: -27 dB of the variance lie above 1, and -34 dB of value
    claims->band_to = 1;
    claims->leak_db = -25;
}

} // namespace

BANDLIMIT_EXPORT double gradient(const double p[4], unsigned, uint64_t seed, void *) {
    return in_range(p) ? noise::GradientCoherentNoise3D(p[0], p[1], p[2], static_cast<int>(seed),
                                                        noise::QUALITY_STD)
                       : std::nan("");
}

BANDLIMIT_EXPORT void gradient_claims(bandlimit_claims *claims) {
    claim(claims);
}

BANDLIMIT_EXPORT double value(const double p[4], unsigned, uint64_t seed, void *) {
    return in_range(p) ? noise::ValueCoherentNoise3D(p[0], p[1], p[2], static_cast<int>(seed),
                                                     noise::QUALITY_STD)
                       : std::nan("");
}

BANDLIMIT_EXPORT void value_claims(bandlimit_claims *claims) {
    claim(claims);
    // A weighted mean of lattice values, which are 1 - n / 2^30 for a whole number n: of 31 bits,
    // and the mean stands in -1 to 1. As Debian builds it n has a sign, so half of the lattice
    // values lie above 1, up to 3.
    claims->lower = -1;
    claims->upper = 3;
}
