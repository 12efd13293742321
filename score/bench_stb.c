// SPDX-License-Identifier: MIT
//
// stb_perlin as a peer of the benchmark, where its header is installed.
#include "score/bench.h"

#if __has_include(<stb/stb_perlin.h>)
#define BL_STB_HEADER <stb/stb_perlin.h>
#elif __has_include(<stb_perlin.h>)
#define BL_STB_HEADER <stb_perlin.h>
#endif

#ifdef BL_STB_HEADER
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#define STB_PERLIN_IMPLEMENTATION
#include BL_STB_HEADER
#pragma GCC diagnostic pop

static double stb_value(double x, double y, double z) {
    return (double)stb_perlin_noise3((float)x, (float)y, (float)z, 0, 0, 0);
}

bl_peer_function bl_peer_stb(void) {
    return stb_value;
}
#else
bl_peer_function bl_peer_stb(void) {
    return NULL;
}
#endif
