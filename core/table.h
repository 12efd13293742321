// SPDX-License-Identifier: MIT
//
// How a result is told. A result declares its values once, as fields: the key, what a reader calls
// it, its digits, and where it stands in the struct that was measured. The lines on a terminal, the
// data file, the JSON object and the page all come from this declaration, and so they agree.
//
//     typedef struct way { char *name; bl_estimate error; double ns; int front; } way;
//
//     #define AT(member) .offset = offsetof(way, member)
//     static const bl_field fields[] = {
//         {"front", "", BL_CELL_FLAG, AT(front)},
//         {"way", "way", BL_CELL_WORD, AT(name)},
//         {"error", "error", BL_CELL_ESTIMATE, AT(error), .digits = 3, .limits = ""},
//         {"ns_per_sample", "ns", BL_CELL_REAL, AT(ns), .digits = 4},
//         {0}};
//     bl_table table = BL_TABLE(fields, ways, 2);
//     table.level = 0.95;
//
// bl_table_print, columns as wide as their words, numbers at the right:
//        way    error  95 % interval       ns
//     *  box   0.0962  0.0961 to 0.0963     -
//        tent  0.0245  0.0241 to 0.025   6.99
// bl_table_csv, with all digits; what is missing is empty:
//     front,way,error,error_lower,error_upper,ns_per_sample
//     1,box,0.0962,0.0961,0.0963,
// bl_table_json (reports/table_json.h), where it is null:
//     [{"front": true, "way": "box", "error": 0.0962, "error_lower": 0.0961, ...}, ...]
// bl_table_html (reports/html.h), a <table> of the same words as on the terminal.
//
// A record is a single row told downwards, a value a line: the head of a result.
#ifndef BL_CORE_TABLE_H
#define BL_CORE_TABLE_H

#include <stddef.h>
#include <stdio.h>

#include "core/verdict.h"

// What stands at the offset of a field.
typedef enum bl_cell_kind {
    BL_CELL_NONE,     // of a cell: this row has no such value
    BL_CELL_REAL,     // double; not a number: missing
    BL_CELL_ESTIMATE, // double[3], a value and its limits, as a bl_estimate begins
    BL_CELL_COUNT,    // size_t or uint64_t
    BL_CELL_UNSIGNED, // unsigned int, or an int that is not negative
    BL_CELL_FLAG,     // int: a star or nothing; 1 or 0; true or false
    BL_CELL_WORD,     // const char *; NULL: missing
    BL_CELL_LETTERS,  // char[], a word within the struct
    BL_CELL_VERDICT,  // bl_verdict, in its colour
    BL_CELL_LIST      // double[length]: in JSON an array, in a table not shown
} bl_cell_kind;

// The value of one field in one row.
typedef struct bl_cell {
    bl_cell_kind kind;          // UNSIGNED has become COUNT, and LETTERS WORD
    double value, lower, upper; // REAL and ESTIMATE
    size_t count;               // COUNT, FLAG, and the length of a LIST
    const char *word;
    bl_verdict verdict;
    const double *list;
    char text[160]; // room for a word that is made
} bl_cell;

// The forms in which a value is told.
enum { BL_IN_TEXT = 1, BL_IN_CSV = 2, BL_IN_JSON = 4 };

typedef struct bl_table bl_table;

typedef struct bl_field {
    const char *key;     // in JSON and as the header of CSV; NULL ends a list of fields
    const char *heading; // on a terminal and a page; NULL: not told there
    bl_cell_kind kind;
    size_t offset; // of the value in the row
    // Optional: whether a row has such a value at all; else it is missing.
    int (*when)(const void *row);
    // Optional, for a value that stands nowhere: fills the cell, which comes with its kind and as a
    // number that is missing. A word may be made in cell->text.
    void (*find)(const bl_table *table, size_t row, bl_cell *cell);
    size_t length;      // BL_CELL_LIST: numbers of it, at most
    int digits;         // significant ones on a terminal and a page; 0: 4
    int decimals;       // so many behind the point in their place
    const char *unit;   // behind the value in a record, behind the heading on a page
    const char *limits; // BL_CELL_ESTIMATE: heading of the interval; "": "95 % interval", by the
                        // level of the table; NULL: told in CSV and JSON alone
    int bare_limits;    // their keys are `lower` and `upper`, and not KEY_lower and KEY_upper
    int forms;          // BL_IN_TEXT and so on; 0: all
    int is_power; // BL_CELL_ESTIMATE: never below 0; an estimate that is not above 0 is told in
                  // words by its upper limit, as <0.01
    int optional; // no column for it in CSV and JSON if no row has it, as in text always
    int absent;   // the JSON of a row without it has no such key, and not null
} bl_field;

struct bl_table {
    const bl_field *fields;
    const void *rows;
    size_t count;  // of rows
    size_t stride; // bytes of a row; 0: one struct of pointers to arrays, each NULL or a column
    size_t every;  // tells every so many rows, of which there are `count`; 0: each
    double level;  // of the intervals
    int coloured;  // for a terminal that shows the colours of verdicts
    const void *context; // for the functions of the fields
};

// A table of an array of structs, and a record of one struct.
#define BL_TABLE(its_fields, its_rows, its_count)                                                  \
    ((bl_table){.fields = (its_fields),                                                            \
                .rows = (its_rows),                                                                \
                .count = (its_count),                                                              \
                .stride = sizeof *(its_rows)})
#define BL_RECORD(its_fields, its_struct) BL_TABLE(its_fields, its_struct, 1)

// --- the writers --------------------------------------------------------------------------------

// For a terminal, at most 100 columns wide where the last one is of words, which are wrapped. What
// is missing is "-"; a column that no row has is left out.
void bl_table_print(const bl_table *table, FILE *out);
// A line for each value: heading, value, unit, interval. What is missing is "not known", or left
// out if it is optional.
void bl_record_print(const bl_table *record, FILE *out);

// One line of headers and a line a row, RFC 4180 except for line feeds alone. Lists are left out.
void bl_table_csv(const bl_table *table, FILE *out);
// Comments: "# key: value".
void bl_record_csv(const bl_table *record, FILE *out);

// --- for writers --------------------------------------------------------------------------------

// The value of a field in a row; a word of it may stand in the cell itself.
void bl_cell_find(const bl_table *table, const bl_field *field, size_t row, bl_cell *cell);
int bl_cell_is_missing(const bl_cell *cell);
// Whether the field is told in this form: some row has it, for a column that may be left out.
int bl_field_is_told(const bl_table *table, const bl_field *field, int form);
// The key of a limit, "lower" or "upper".
typedef struct bl_limit_key {
    char text[80];
} bl_limit_key;
bl_limit_key bl_field_limit_key(const bl_field *field, const char *which);

// The cell as it is told on a terminal or a page, "-" if it is missing; and its interval. The text
// may stand in the cell.
const char *bl_cell_text(const bl_field *field, bl_cell *cell);
const char *bl_cell_limits_text(const bl_field *field, bl_cell *cell);
// Whether the limits are told there, and under what heading, made in `text`.
const char *bl_field_limits_heading(const bl_table *table, const bl_field *field, char text[64]);

#endif
