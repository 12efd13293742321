// SPDX-License-Identifier: MIT
#include "tests/float_error.h"

#include <math.h>

#include "core/random.h"

enum { PLACES = 512 };

double bl_test_float_error(const bl_signal *signal) {
    bl_random random = bl_random_seed(77, 0);
    double square = 0, slopes = 0;
    for (int i = 0; i < PLACES; i++) {
        double at[BL_AXES], cell = signal->facts.cell > 0 ? signal->facts.cell : 1;
        for (int a = 0; a < BL_AXES; a++)
            at[a] = 64 * cell * (bl_random_unit(&random) - 0.5);
        double value = bl_signal_value(signal, at);
        square += value * value / PLACES;
        for (unsigned a = 0; a < signal->dimensions; a++) {
            double step = 1e-4 * cell, before = at[a];
            at[a] = before + step;
            double slope = (bl_signal_value(signal, at) - value) / 1e-4; // in a cell
            at[a] = before;
            slopes += slope * slope / PLACES;
        }
    }
    double bound = fmax(fabs(signal->facts.lower), fabs(signal->facts.upper));
    double usual = 12 * (1 + sqrt(square) + sqrt(slopes)), most = 32 * fmax(1, bound);
    return 0x1p-24 * (usual < most ? usual : most);
}
