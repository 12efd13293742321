// SPDX-License-Identifier: MIT
//
// The verb `eval`: values at points, given as words or as lines of standard input. Without --json
// the values of the lines that have arrived are printed before more are waited for, so that the
// program can answer another one through a pair of pipes.
#include <math.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/components.h"
#include "cli/json.h"
#include "cli/verb.h"
#include "cli/words.h"

typedef struct eval_settings {
    uint64_t components;
} eval_settings;

// What is carried from line to line.
typedef struct point_reader {
    bl_call *call;
    const bl_signal *signal;
    bl_vector_signal vector;             // the signal and its further components
    json_t *points, *values, *reference; // NULL without --json
    size_t line;
} point_reader;

// A number, or with more than one component an array of numbers.
static json_t *one_or_all(const double *numbers, size_t count) {
    return count == 1 ? bl_json_number(numbers[0]) : bl_json_numbers(numbers, count);
}

// What a source that has failed gives, or what it complains of, is not printed.
static bl_status answer(point_reader *reader, const double at[BL_AXES], size_t given) {
    static const double step[BL_AXES] = {1};
    double values[BL_COMPONENTS_MOST], reference[BL_COMPONENTS_MOST];
    const size_t count = reader->vector.count;
    for (size_t k = 0; k < count; k++) {
        float value;
        bl_signal_row(reader->vector.of[k], at, step, 1, &value);
        values[k] = (double)value;
        if (reader->points)
            reference[k] = bl_signal_value(reader->vector.of[k], at);
        bl_status complaint = bl_signal_complaint(reader->vector.of[k], &reader->call->message);
        if (complaint == BL_MISMATCH) // its words are added at the end of the verb
            return bl_report(&reader->call->message, complaint, "a value is no number");
        if (complaint != BL_OK)
            return complaint;
    }
    if (!reader->points) {
        for (size_t k = 0; k < count; k++) // -0 is 0, and NaN has no sign
            fprintf(reader->call->out, "%.9g%c", isnan(values[k]) ? NAN : values[k] + 0.0,
                    k + 1 < count ? ' ' : '\n');
        return BL_OK;
    }
    json_array_append_new(reader->points, bl_json_numbers(at, given));
    json_array_append_new(reader->values, one_or_all(values, count));
    json_array_append_new(reader->reference, one_or_all(reference, count));
    return BL_OK;
}

// Reads one line: up to four numbers with blanks or one comma between them; # starts a comment.
static bl_status read_line(point_reader *reader, char *line) {
    static const char blanks[] = " \t\r";
    bl_message *message = &reader->call->message;
    double at[BL_AXES] = {0};
    size_t count = 0;
    char where[48];
    snprintf(where, sizeof where, "standard input, line %zu", ++reader->line);
    line[strcspn(line, "#")] = '\0';
    for (char *word = line + strspn(line, blanks), *next; *word; word = next) {
        size_t length = strcspn(word, " \t\r,");
        next = word + length + strspn(word + length, blanks);
        int comma = *next == ',';
        next += comma;
        next += strspn(next, blanks);
        if (length == 0 || (comma && *next == '\0'))
            return bl_report(message, BL_USAGE,
                             "%s: a number is missing at a comma; between two numbers stand blanks "
                             "or one comma",
                             where);
        if (count == BL_AXES)
            return bl_report(message, BL_USAGE, "%s: more than four numbers; a point is X Y Z W",
                             where);
        word[length] = '\0';
        bl_status status =
            bl_read_coordinate(word, bl_signal_far(reader->signal), where, &at[count++], message);
        if (status != BL_OK)
            return status;
    }
    return count ? answer(reader, at, count) : BL_OK;
}

// Answers the whole lines of the buffer and moves the rest to its start.
static bl_status read_lines(point_reader *reader, char *buffer, size_t *length) {
    char *start = buffer, *end = buffer + *length;
    for (char *feed; (feed = memchr(start, '\n', (size_t)(end - start))); start = feed + 1) {
        *feed = '\0';
        if (strlen(start) != (size_t)(feed - start))
            return bl_report(&reader->call->message, BL_USAGE,
                             "standard input, line %zu: a byte 0; points are lines of text",
                             reader->line + 1);
        bl_status status = read_line(reader, start);
        if (status != BL_OK)
            return status;
    }
    *length = (size_t)(end - start);
    memmove(buffer, start, *length);
    return BL_OK;
}

static bl_status read_input(point_reader *reader) {
    enum { SIZE = 1 << 16 };
    static char buffer[SIZE + 1];
    size_t length = 0;
    bl_status status = BL_OK;
    while (status == BL_OK) {
        ssize_t got = read(STDIN_FILENO, buffer + length, SIZE - length);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return bl_report(&reader->call->message, BL_DEVICE, "cannot read standard input: %s",
                             strerror(errno));
        if (got == 0) {
            if (length > 0) // a last line without a line feed
                buffer[length++] = '\n';
            return read_lines(reader, buffer, &length);
        }
        length += (size_t)got;
        status = read_lines(reader, buffer, &length);
        if (status == BL_OK && length == SIZE)
            return bl_report(&reader->call->message, BL_USAGE,
                             "standard input, line %zu: longer than %d letters", reader->line + 1,
                             SIZE);
        // A reader that has gone shows here; main reports it.
        if (!reader->points && fflush(reader->call->out) != 0)
            return BL_OK;
    }
    return status;
}

static bl_status read_words(point_reader *reader) {
    static const char *const names[] = {"X", "Y", "Z", "W"};
    const bl_words *words = &reader->call->operands;
    double at[BL_AXES] = {0};
    for (size_t i = 1; i < words->count; i++) {
        bl_status status = bl_read_coordinate(words->words[i], bl_signal_far(reader->signal),
                                              names[i - 1], &at[i - 1], &reader->call->message);
        if (status != BL_OK)
            return status;
    }
    return answer(reader, at, words->count - 1);
}

static bl_status run_eval(bl_call *call) {
    bl_signal *signal;
    bl_status status = bl_call_open_seeded(call, &signal);
    if (status != BL_OK)
        return status;
    const eval_settings *settings = call->settings;
    point_reader reader = {.call = call, .signal = signal};
    status = bl_vector_signal_open(signal, settings->components, &reader.vector, &call->message);
    if (status != BL_OK) {
        bl_signal_free(signal);
        return status;
    }
    json_t *object = bl_json_start(call);
    if (object) {
        bl_json_set_text(object, "signal", signal->text);
        json_object_set_new(object, "points", reader.points = json_array());
        json_object_set_new(object, "values", reader.values = json_array());
        json_object_set_new(object, "reference", reader.reference = json_array());
    }
    status = call->operands.count > 1 ? read_words(&reader) : read_input(&reader);
    bl_vector_signal_free(&reader.vector);
    bl_signal_free(signal);
    return status;
}

static const bl_option options[] = {BL_COMPONENTS_OPTION(eval_settings, components), {0}};

const bl_verb bl_verb_eval = {
    .name = "eval",
    .operands = "SIGNAL [X [Y [Z [W]]]]",
    .summary = "values at points, from arguments or stdin",
    .text =
        "Prints the value at the point X Y Z W in lattice cells; coordinates left out are 0, and "
        "those that the signal does not have are ignored. Without X, points are read from standard "
        "input, one a line, numbers with blanks or one comma between them, # starting a comment; "
        "one value is printed for each, or with --components a line of as many. Values are floats, "
        "as in rows of samples; --json gives the double reference too. Where the signal has no "
        "value, nan is printed (null in JSON).",
    .least = 1,
    .most = 1 + BL_AXES,
    .output_help = "write the values to PATH instead of stdout",
    .options = options,
    .settings_size = sizeof(eval_settings),
    .run = run_eval,
};
