// SPDX-License-Identifier: MIT
//
// Every source that is cited by a key is in REFERENCES.md: the papers of the noises and of the
// figures, and whatever else reads like a key (letters and a year, as perlin1985) in the sources;
// and its table of figures has every figure beside its source, and no other.
#include "tests/test.h"

#include <ctype.h>
#include <dirent.h>

#include "noises/noise.h"
#include "reports/figure.h"

enum { KEYS_MOST = 256, KEY_SIZE = 32 };

static char keys[KEYS_MOST][KEY_SIZE];
static size_t key_count;

static char *read_whole(const char *path) {
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("cannot read %s; run the tests at the top of the repository", path);
    char *text = NULL;
    size_t size = 0;
    ssize_t length = getdelim(&text, &size, '\0', file);
    fclose(file);
    assert_true(length > 0);
    return text;
}

static int is_key(const char *key) {
    for (size_t i = 0; i < key_count; i++)
        if (strcmp(keys[i], key) == 0)
            return 1;
    return 0;
}

// The keys of the tables: rows that begin with "| `key` |".
static int read_keys(void **state) {
    (void)state;
    char *text = read_whole("REFERENCES.md");
    for (char *at = text; (at = strstr(at, "\n| `")); at += 4) {
        assert_true(key_count < KEYS_MOST);
        char *key = keys[key_count];
        assert_int_equal(sscanf(at, "\n| `%31[a-z0-9]` |", key), 1);
        if (is_key(key))
            fail_msg("REFERENCES.md has %s twice", key);
        key_count++;
    }
    free(text);
    return 0;
}

// Whether a word is three letters or more and then a year from 1900 to 2099: what a key looks like.
static int looks_like_a_key(const char *word, size_t length) {
    if (length < 7 || (strncmp(word + length - 4, "19", 2) && strncmp(word + length - 4, "20", 2)))
        return 0;
    for (size_t i = 0; i < length; i++)
        if (i < length - 4 ? !islower((unsigned char)word[i]) : !isdigit((unsigned char)word[i]))
            return 0;
    return 1;
}

// Counts the keys in a text; fails on one that is not listed.
static size_t check_keys(const char *text, const char *where) {
    size_t count = 0;
    while (*text) {
        size_t length = 0;
        while (isalnum((unsigned char)text[length]) || text[length] == '_')
            length++;
        if (looks_like_a_key(text, length)) {
            char key[KEY_SIZE];
            snprintf(key, sizeof key, "%.*s", (int)length, text);
            if (!is_key(key))
                fail_msg("%s cites %s, which is not in REFERENCES.md", where, key);
            count++;
        }
        text += length ? length : 1;
    }
    return count;
}

// A source is one key or more, or this project.
static void check_source(const char *paper, const char *name) {
    assert_non_null(paper);
    if (check_keys(paper, name) == 0 && strncmp(paper, "bandlimit", 9) != 0)
        fail_msg("%s: \"%s\" has no key of REFERENCES.md", name, paper);
}

static void test_the_papers_of_noises_are_listed(void **state) {
    (void)state;
    for (size_t n = 0; n < bl_noise_count(); n++) {
        const bl_noise *noise = bl_noise_at(n, BL_ISA_BASELINE);
        check_source(noise->paper, noise->name);
    }
}

static void test_the_papers_of_figures_are_listed(void **state) {
    (void)state;
    assert_true(bl_figure_count() > 0);
    for (size_t n = 0; n < bl_figure_count(); n++)
        check_source(bl_figure_at(n)->paper, bl_figure_at(n)->name);
}

// Rows "| source | `figure`, `figure` |", the source being a key or "bandlimit": our own.
static void test_the_table_of_figures_is_that_of_the_registry(void **state) {
    (void)state;
    char *text = read_whole("REFERENCES.md"), *row = strstr(text, "\n| source | figures |");
    size_t listed = 0;
    assert_non_null(row);
    for (row = strtok(row, "\n"); row && *row == '|'; row = strtok(NULL, "\n")) {
        char source[KEY_SIZE] = "", name[64];
        sscanf(row, "| %31[a-z0-9]", source);
        for (char *at = strchr(row + 2, '|'); at && (at = strchr(at, '`'));
             at += strlen(name) + 2) {
            assert_int_equal(sscanf(at, "`%63[^`]", name), 1);
            const bl_figure *figure = bl_figure_find(name);
            if (!figure || strncmp(figure->paper, source, strlen(source)) != 0)
                fail_msg("REFERENCES.md: %s is no figure of %s", name, source);
            listed++;
        }
    }
    assert_int_equal(listed, bl_figure_count());
    free(text);
}

// Names of noises and of functions look like keys too: `perlin2002` is both, hart2001_1 neither.
static void test_the_keys_in_the_sources_are_listed(void **state) {
    (void)state;
    static const char *const folders[] = {"core",
                                          "filters",
                                          "filters/primitives",
                                          "noises",
                                          "noises/lattice",
                                          "noises/impulses",
                                          "noises/tiles",
                                          "noises/octaves",
                                          "textures",
                                          "sources",
                                          "spectra",
                                          "aliasing",
                                          "aliasing/views",
                                          "aliasing/methods",
                                          "score",
                                          "score/properties",
                                          "score/trades",
                                          "reports",
                                          "reports/figures",
                                          "cli"};
    size_t count = 0;
    for (size_t f = 0; f < sizeof folders / sizeof *folders; f++) {
        DIR *folder = opendir(folders[f]);
        assert_non_null(folder);
        for (struct dirent *entry; (entry = readdir(folder));) {
            char path[512];
            const char *ending = strrchr(entry->d_name, '.');
            if (!ending || (strcmp(ending, ".c") && strcmp(ending, ".h") && strcmp(ending, ".def")))
                continue;
            snprintf(path, sizeof path, "%s/%s", folders[f], entry->d_name);
            char *text = read_whole(path);
            count += check_keys(text, path);
            free(text);
        }
        closedir(folder);
    }
    assert_true(count > 50);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_papers_of_noises_are_listed),
        cmocka_unit_test(test_the_papers_of_figures_are_listed),
        cmocka_unit_test(test_the_table_of_figures_is_that_of_the_registry),
        cmocka_unit_test(test_the_keys_in_the_sources_are_listed),
    };
    bl_set_filter();
    return cmocka_run_group_tests(tests, read_keys, NULL);
}
