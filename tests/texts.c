// SPDX-License-Identifier: MIT
#include "tests/texts.h"

#include "tests/test.h"

static void add_text(bl_texts *list, const char *name, const char *key, const char *value) {
    assert_true(list->count < BL_TEXTS_MOST);
    snprintf(list->text[list->count++], sizeof list->text[0], key ? "%s:%s=%s" : "%s", name, key,
             value);
}

static void add_choices(bl_texts *list, const char *name, const bl_parameter *parameter) {
    for (const char *const *choice = parameter->choices; *choice; choice++) {
        char value[64];
        const char *colon = strchr(*choice, ':');
        snprintf(value, sizeof value, "%s", *choice);
        if (colon)
            snprintf(value, sizeof value, "%.*s:%.0f", (int)(colon - *choice), *choice,
                     fmax(100, parameter->minimum));
        add_text(list, name, parameter->key, value);
    }
}

static void add_settings(bl_texts *list, const char *name, const bl_parameter *parameter) {
    char value[64];
    int has_range = parameter->kind == BL_INTEGER || parameter->kind == BL_REAL;
    if (parameter->kind == BL_CHOICE)
        add_choices(list, name, parameter);
    if (parameter->kind == BL_SEED)
        add_text(list, name, parameter->key, "18446744073709551615");
    for (int end = 0; end < 2 && has_range; end++) {
        snprintf(value, sizeof value, "%.17g", end ? parameter->maximum : parameter->minimum);
        add_text(list, name, parameter->key, value);
    }
    for (const char *const *example = parameter->examples; example && *example; example++)
        add_text(list, name, parameter->key, *example);
}

const bl_texts *bl_test_texts(void) {
    static bl_texts list;
    if (list.count)
        return &list;
    for (size_t i = 0; i < bl_noise_count(); i++) {
        const bl_noise *noise = bl_noise_at(i, BL_ISA_BEST);
        add_text(&list, noise->name, NULL, NULL);
        for (const bl_parameter *p = noise->parameters; p->key; p++)
            add_settings(&list, noise->name, p);
    }
    return &list;
}

bl_signal *bl_test_open(const char *text, bl_isa isa) {
    bl_signal *signal = NULL;
    bl_message message = {""};
    if (bl_noise_open(text, isa, &signal, &message) != BL_OK)
        fail_msg("%s: %s", text, message.text);
    return signal;
}
