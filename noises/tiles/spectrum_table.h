// SPDX-License-Identifier: MIT
//
// A power spectrum as the user's table: two columns, frequency and density, linear between its rows
// and 0 outside of them.
//
// The file: CSV, the frequency in cycles a unit in the first column, the density in value^2 per
// (cycle a unit)^dims in the second; further columns are ignored, lines that begin with # and empty
// ones too, and so is one header line. Frequencies rise; densities are not negative.
#ifndef BL_NOISES_TILES_SPECTRUM_TABLE_H
#define BL_NOISES_TILES_SPECTRUM_TABLE_H

#include <stddef.h>

#include "core/status.h"

typedef struct bl_spectrum_table {
    size_t count; // of the rows, at least 2
    double *frequency, *density;
    unsigned users;
} bl_spectrum_table;

// Reads a file; on success the caller is its user. Errors: BL_DEVICE for a file that cannot be
// read and out of memory, BL_USAGE, with the line's number, for one that is no such table.
bl_status bl_spectrum_table_read(const char *path, bl_spectrum_table **table, bl_message *message);

// A table serves many signals: one more user, one less. The last one frees it. Thread-safe.
void bl_spectrum_table_keep(bl_spectrum_table *table);
void bl_spectrum_table_drop(bl_spectrum_table *table);

double bl_spectrum_table_density(const bl_spectrum_table *table, double frequency);

#endif
