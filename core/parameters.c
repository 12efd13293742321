// SPDX-License-Identifier: MIT
//
// Parameter blocks: filled from text by a list of parameters, and written back as text.
#include "core/grammar.h"
#include "core/registry.h"

#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_PARAMETERS = 64 };

// Where a value stands in the text, for messages; the default values stand nowhere.
typedef struct place {
    const char *text;
    size_t column;
} place;

static bl_status report_value(const bl_parameter *parameter, const char *value, place at,
                              const char *expected, bl_message *message) {
    return bl_report(message, BL_USAGE, "%s=%s at column %zu of '%s': expected %s", parameter->key,
                     value, at.column, at.text, expected);
}

static bl_status read_integer(const bl_parameter *parameter, const char *value, place at,
                              uint32_t *out, bl_message *message) {
    unsigned long long number;
    if (!bl_read_count(value, &number) || (double)number < parameter->minimum ||
        (double)number > parameter->maximum) {
        char expected[96];
        snprintf(expected, sizeof expected, "a whole number from %.0f to %.0f", parameter->minimum,
                 parameter->maximum);
        return report_value(parameter, value, at, expected, message);
    }
    *out = (uint32_t)number;
    return BL_OK;
}

// A number, or "inf" where no maximum forbids it.
static int read_word(const bl_parameter *parameter, const char *word, double *out) {
    if (isinf(parameter->maximum) && (strcmp(word, "inf") == 0 || strcmp(word, "infinity") == 0)) {
        *out = INFINITY;
        return 1;
    }
    return bl_read_real(word, out);
}

static bl_status read_real(const bl_parameter *parameter, const char *value, place at, double *out,
                           bl_message *message) {
    if (!read_word(parameter, value, out) || *out < parameter->minimum ||
        *out > parameter->maximum) {
        char expected[96];
        snprintf(expected, sizeof expected, "a number from %g to %g", parameter->minimum,
                 parameter->maximum);
        return report_value(parameter, value, at, expected, message);
    }
    return BL_OK;
}

static bl_status report_choice(const bl_parameter *parameter, const char *value, place at,
                               bl_message *message) {
    char where[sizeof message->text];
    snprintf(where, sizeof where, " at column %zu of '%s'", at.column, at.text);
    const bl_unknown unknown = {.what = "value",
                                .word = value,
                                .key = parameter->key,
                                .where = where,
                                .words = parameter->choices};
    return bl_report_unknown(&unknown, message);
}

// A choice written "table:N" matches "table:" followed by a whole number.
static bl_status read_choice(const bl_parameter *parameter, const char *value, place at,
                             void *block, bl_message *message) {
    for (uint32_t i = 0; parameter->choices[i]; i++) {
        const char *choice = parameter->choices[i];
        const char *colon = strchr(choice, ':');
        size_t stem = colon ? (size_t)(colon - choice) + 1 : 0;
        if (colon ? strncmp(value, choice, stem) != 0 : strcmp(value, choice) != 0)
            continue;
        memcpy((char *)block + parameter->offset, &i, sizeof i);
        if (!colon)
            return BL_OK;
        uint32_t number = 0;
        bl_status status = read_integer(parameter, value + stem, (place){at.text, at.column + stem},
                                        &number, message);
        if (status == BL_OK)
            memcpy((char *)block + parameter->number_offset, &number, sizeof number);
        return status;
    }
    return report_choice(parameter, value, at, message);
}

static bl_status read_list(const bl_parameter *parameter, const char *value, place at, void *target,
                           bl_message *message) {
    uint32_t list[BL_LIST_SIZE] = {0};
    size_t count = 0;
    for (const char *word = value; word; count++) {
        const char *comma = strchr(word, ',');
        char one[32];
        size_t length = comma ? (size_t)(comma - word) : strlen(word);
        snprintf(one, sizeof one, "%.*s", (int)(length < 31 ? length : 31), word);
        if (count == BL_LIST_SIZE)
            return report_value(parameter, value, at, "4 numbers at most, one an axis", message);
        bl_status status =
            read_integer(parameter, one, (place){at.text, at.column + (size_t)(word - value)},
                         &list[count], message);
        if (status != BL_OK)
            return status;
        word = comma ? comma + 1 : NULL;
    }
    for (size_t i = 1; count == 1 && i < BL_LIST_SIZE; i++)
        list[i] = list[0];
    memcpy(target, list, sizeof list);
    return BL_OK;
}

static bl_status read_text(const bl_parameter *parameter, const char *value, place at, char *target,
                           bl_message *message) {
    if (strlen(value) >= BL_TEXT_SIZE)
        return report_value(parameter, value, at, "a text of less than 512 letters", message);
    snprintf(target, BL_TEXT_SIZE, "%s", value);
    return BL_OK;
}

// Whether a key is `parameter` itself, or one of the dotted keys of a nested signal.
static int key_belongs(const bl_parameter *parameter, const char *key) {
    size_t length = strlen(parameter->key);
    return strncmp(key, parameter->key, length) == 0 &&
           (key[length] == '\0' || (parameter->kind == BL_NESTED && key[length] == '.'));
}

// Appends a dotted setting to the text of the nested signal.
static bl_status read_nested(const bl_parameter *parameter, const bl_setting *setting,
                             const char *text, void *block, bl_message *message) {
    char *target = (char *)block + parameter->offset;
    const char *key = setting->key + strlen(parameter->key) + 1;
    size_t used = strlen(target);
    if (!*key)
        return bl_report(message, BL_USAGE,
                         "'%s' at column %zu of '%s': expected a key after the "
                         "dot",
                         setting->key, setting->key_column, text);
    int length = snprintf(target + used, BL_TEXT_SIZE - used, "%c%s=%s",
                          strchr(target, ':') ? ',' : ':', key, setting->value);
    if (length < 0 || used + (size_t)length >= BL_TEXT_SIZE)
        return bl_report(message, BL_USAGE, "'%s' at column %zu of '%s': too long", setting->key,
                         setting->key_column, text);
    return BL_OK;
}

static bl_status read_value(const bl_parameter *parameter, const char *value, place at, void *block,
                            bl_message *message) {
    char *target = (char *)block + parameter->offset;
    bl_status status = BL_OK;
    switch (parameter->kind) {
    case BL_SEED: {
        unsigned long long seed;
        if (!bl_read_unsigned(value, &seed))
            return report_value(parameter, value, at,
                                "a whole number from 0 to 18446744073709551615, or 0x...", message);
        memcpy(target, &(uint64_t){seed}, sizeof(uint64_t));
        break;
    }
    case BL_INTEGER: {
        uint32_t number = 0;
        if ((status = read_integer(parameter, value, at, &number, message)) == BL_OK)
            memcpy(target, &number, sizeof number);
        break;
    }
    case BL_REAL: {
        double number;
        if ((status = read_real(parameter, value, at, &number, message)) == BL_OK)
            memcpy(target, &number, sizeof number);
        break;
    }
    case BL_CHOICE:
        status = read_choice(parameter, value, at, block, message);
        break;
    case BL_LIST:
        status = read_list(parameter, value, at, target, message);
        break;
    case BL_TEXT:
    case BL_NESTED:
        status = read_text(parameter, value, at, target, message);
        break;
    }
    return status;
}

static bl_status report_key(const bl_parameter *parameters, const bl_setting *setting,
                            const char *text, bl_message *message) {
    const char *keys[MOST_PARAMETERS + 1] = {NULL};
    char where[sizeof message->text];
    for (size_t i = 0; parameters[i].key && i < MOST_PARAMETERS; i++)
        keys[i] = parameters[i].key;
    snprintf(where, sizeof where, " at column %zu of '%s'", setting->key_column, text);
    const bl_unknown unknown = {.what = "key", .word = setting->key, .where = where, .words = keys};
    return bl_report_unknown(&unknown, message);
}

// For a letter of a nested signal's text: the setting that it came from, and its place in the whole
// text. *inside says how much of the text stands before it within the setting.
static const bl_setting *find_origin(const bl_parameter *parameter, const bl_spec *spec,
                                     size_t letter, size_t *inside) {
    size_t stem = strlen(parameter->key), start = strlen(parameter->fallback);
    for (size_t i = 0; i < spec->count; i++)
        if (strcmp(spec->settings[i].key, parameter->key) == 0) {
            start = strlen(spec->settings[i].value);
            *inside = letter;
            if (letter < start)
                return &spec->settings[i];
        }
    for (size_t i = 0; i < spec->count; i++) {
        const bl_setting *setting = &spec->settings[i];
        if (!key_belongs(parameter, setting->key) || strlen(setting->key) <= stem + 1)
            continue;
        size_t length = strlen(setting->key) - stem + strlen(setting->value); // KEY=VALUE
        start++;                                                              // of ':' or ','
        *inside = letter - start;
        if (letter >= start && letter < start + length)
            return setting;
        start += length;
    }
    return NULL;
}

// Where a message names a key of the nested signal: at its beginning, or in quotes.
static const char *find_key(const char *text, const char *end, const char *key) {
    size_t length = strlen(key);
    if (strncmp(text, key, length) == 0)
        return text;
    for (const char *quote = text; (quote = strchr(quote, '\'')) && quote < end; quote++)
        if (strncmp(quote + 1, key, length) == 0)
            return quote + 1;
    return NULL;
}

// "fade=cubik at column 13 of 'gnoise:fade=cubik': ..." becomes
// "basis.fade=cubik at column 16 of 'fbm:basis.fade=cubik': ...", and what stood before it goes.
static int place_in(const bl_parameter *parameter, const bl_spec *spec, const char *text,
                    const char *nested, bl_message *message) {
    char end[BL_TEXT_SIZE + 8], whole[sizeof message->text];
    size_t column = 0, inside = 0, stem = strlen(parameter->key);
    snprintf(end, sizeof end, " of '%s'", nested);
    const char *begin = message->text, *word = strstr(begin, " at column "), *after = NULL;
    for (; word && !after; word = after ? word : strstr(word + 1, " at column "))
        if (sscanf(word, " at column %zu", &column) == 1) {
            const char *rest = word + strlen(" at column ");
            rest += strspn(rest, "0123456789");
            after = strncmp(rest, end, strlen(end)) == 0 ? rest + strlen(end) : NULL;
            if (after)
                break;
        }
    const bl_setting *origin =
        after && column ? find_origin(parameter, spec, column - 1, &inside) : NULL;
    if (!origin)
        return 0;
    char prefix[BL_TEXT_SIZE + 24];
    snprintf(prefix, sizeof prefix, "in the %s '%s': ", parameter->key, nested);
    if (strncmp(begin, prefix, strlen(prefix)) == 0)
        begin += strlen(prefix);
    int dotted = strlen(origin->key) > stem;
    const char *key = dotted ? find_key(begin, word, origin->key + stem + 1) : NULL;
    if (dotted && !key)
        return 0;
    if (!dotted)
        column = origin->value_column + inside;
    else // of a key, where its first dot-separated name begins
        column = origin->key_column + (inside ? stem + 1 + inside : 0);
    int head = key ? (int)(key - begin) : 0;
    snprintf(whole, sizeof whole, "%.*s%s%s%.*s at column %zu of '%s'%s", head, begin,
             dotted ? parameter->key : "", dotted ? "." : "", (int)(word - begin) - head,
             begin + head, column, text, after);
    memcpy(message->text, whole, sizeof whole);
    return 1;
}

void bl_parameters_place(const bl_parameter *parameters, const bl_spec *spec, const char *text,
                         const void *block, bl_message *message) {
    for (const bl_parameter *parameter = parameters; message && parameter->key; parameter++)
        if (parameter->kind == BL_NESTED &&
            place_in(parameter, spec, text, (const char *)block + parameter->offset, message))
            return;
}

static bl_status read_dotted(const bl_parameter *parameters, const bl_spec *spec, const char *text,
                             void *block, bl_message *message) {
    bl_status status = BL_OK;
    for (size_t i = 0; i < spec->count && status == BL_OK; i++)
        for (const bl_parameter *parameter = parameters; parameter->key; parameter++)
            if (key_belongs(parameter, spec->settings[i].key) &&
                strcmp(parameter->key, spec->settings[i].key) != 0)
                status = read_nested(parameter, &spec->settings[i], text, block, message);
    return status;
}

bl_status bl_parameters_read(const bl_parameter *parameters, const bl_spec *spec, const char *text,
                             void *block, bl_message *message) {
    unsigned char seen[MOST_PARAMETERS] = {0};
    int dotted = 0;
    for (const bl_parameter *parameter = parameters; parameter->key; parameter++) {
        bl_status status =
            read_value(parameter, parameter->fallback, (place){"default", 0}, block, message);
        if (status != BL_OK)
            return status;
    }
    for (size_t i = 0; i < spec->count; i++) {
        const bl_setting *setting = &spec->settings[i];
        size_t index = 0;
        while (parameters[index].key && !key_belongs(&parameters[index], setting->key))
            index++;
        if (!parameters[index].key)
            return report_key(parameters, setting, text, message);
        if (strcmp(parameters[index].key, setting->key) != 0) {
            dotted = 1; // after the names, which may come later
            continue;
        }
        if (seen[index]++)
            return bl_report(message, BL_USAGE, "key '%s' at column %zu of '%s' is given twice",
                             setting->key, setting->key_column, text);
        bl_status status = read_value(&parameters[index], setting->value,
                                      (place){text, setting->value_column}, block, message);
        if (status != BL_OK)
            return status;
    }
    return dotted ? read_dotted(parameters, spec, text, block, message) : BL_OK;
}

// The shortest decimal that reads back as the same double; whole numbers that a user would write
// without an exponent have none.
static void print_real(double value, char *out, size_t size) {
    int whole = fabs(value) >= 1 && fabs(value) < 1e6 ? 1 + (int)log10(fabs(value)) : 1;
    for (int digits = whole; digits <= 17; digits++) {
        snprintf(out, size, "%.*g", digits, value);
        if (strtod(out, NULL) == value)
            return;
    }
}

// All four numbers but the zeros at the end, or one where all are the same.
static void print_list(const char *source, char *out, size_t size) {
    uint32_t list[BL_LIST_SIZE];
    size_t count = BL_LIST_SIZE, used = 0;
    memcpy(list, source, sizeof list);
    while (count > 2 && list[count - 1] == 0)
        count--;
    if (list[0] == list[1] && list[1] == list[2] && list[2] == list[3])
        count = 1;
    for (size_t i = 0; i < count; i++)
        used += (size_t)snprintf(out + used, size - used, "%s%" PRIu32, i ? "," : "", list[i]);
}

static void print_value(const bl_parameter *parameter, const void *block, char *out, size_t size) {
    const char *source = (const char *)block + parameter->offset;
    uint64_t seed;
    uint32_t number = 0;
    double real;
    switch (parameter->kind) {
    case BL_SEED:
        memcpy(&seed, source, sizeof seed);
        snprintf(out, size, "%" PRIu64, seed);
        break;
    case BL_INTEGER:
        memcpy(&number, source, sizeof number);
        snprintf(out, size, "%" PRIu32, number);
        break;
    case BL_REAL:
        memcpy(&real, source, sizeof real);
        print_real(real, out, size);
        break;
    case BL_CHOICE: {
        memcpy(&number, source, sizeof number);
        const char *choice = parameter->choices[number];
        const char *colon = strchr(choice, ':');
        int stem = colon ? (int)(colon - choice) + 1 : (int)strlen(choice);
        snprintf(out, size, "%.*s", stem, choice);
        if (colon) {
            memcpy(&number, (const char *)block + parameter->number_offset, sizeof number);
            snprintf(out + stem, size - (size_t)stem, "%" PRIu32, number);
        }
        break;
    }
    case BL_LIST:
        print_list(source, out, size);
        break;
    case BL_TEXT:
    case BL_NESTED:
        snprintf(out, size, "%s", source);
        break;
    }
}

// Whether a printed value says the same as the default, which may be written otherwise (1/2,
// 0x10).
static int is_default(const bl_parameter *parameter, const char *value) {
    double real, fallback;
    unsigned long long number, other;
    if (parameter->kind == BL_REAL)
        return read_word(parameter, value, &real) &&
               read_word(parameter, parameter->fallback, &fallback) && real == fallback;
    if (parameter->kind == BL_NESTED && strchr(value, ':'))
        return 0; // settings of a signal within are always told
    if (parameter->kind == BL_SEED || parameter->kind == BL_INTEGER)
        return bl_read_unsigned(value, &number) && bl_read_unsigned(parameter->fallback, &other) &&
               number == other;
    return strcmp(value, parameter->fallback) == 0;
}

char *bl_parameters_text(const char *name, const bl_parameter *parameters, const void *block) {
    bl_spec spec = {.name = strdup(name)};
    bl_status status = spec.name ? BL_OK : BL_DEVICE;
    for (const bl_parameter *p = parameters; p->key && status == BL_OK; p++) {
        char value[BL_TEXT_SIZE];
        print_value(p, block, value, sizeof value);
        if (is_default(p, value))
            continue;
        status = p->kind == BL_NESTED ? bl_spec_nest(&spec, p->key, value, NULL) : BL_USAGE;
        if (status == BL_USAGE) // no signal within, or one whose text cannot be read
            status = bl_spec_set(&spec, p->key, value, NULL);
    }
    char *text = status == BL_OK ? bl_spec_text(&spec) : NULL;
    bl_spec_free(&spec);
    return text;
}
