// SPDX-License-Identifier: MIT
#include "filters/primitive.h"

#include <math.h>
#include <string.h>

#include "filters/average.h"

const char *const bl_anchor_words[] = {"centre", "start", NULL};

int bl_averaging_keeps_bounds(const bl_averaging *averaging) {
    return averaging->width == 0 || bl_filter_keeps_bounds(bl_filter_at(averaging->filter));
}

int bl_averaging_continuity(const bl_averaging *averaging, int continuity) {
    return bl_filter_continuity(bl_filter_at(averaging->filter), averaging->width, continuity);
}

void bl_primitive_period(bl_facts *facts, double period) {
    for (int a = 0; a < BL_AXES; a++)
        facts->period[a] = a ? 0 : period;
}

void bl_primitive_unit_facts(const bl_averaging *averaging, bl_facts *facts) {
    if (bl_averaging_keeps_bounds(averaging)) {
        facts->lower = 0;
        facts->upper = 1;
        facts->bound_proof = "the curve is monotone, and a nowhere negative kernel averages it";
    }
    facts->mean = 0.5;
    facts->continuity = bl_averaging_continuity(averaging, 0);
    bl_primitive_period(facts, 0);
}

// fmod has the sign of x and is exact; a tiny remainder of the other sign would round up to the
// period itself.
double bl_modulo(double x, double period) {
    double rest = fmod(x, period);
    if (rest != 0 && (rest < 0) != (period < 0))
        rest += period;
    return rest == period ? nextafter(period, 0) : rest == 0 ? 0 : rest;
}

double bl_periods(double x, double period) {
    double periods = fmod(x, period) / period; // may round up to 1
    return fabs(periods) >= 1 ? 0 : periods;   // NaN stays
}
