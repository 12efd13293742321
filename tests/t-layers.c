// SPDX-License-Identifier: MIT
//
// The layer rule, read off the #include lines: each folder includes only what stands above it, only
// core/fft.c knows FFTW, only reports/oiio.cpp knows OpenImageIO; every source has its licence.
#include "tests/test.h"

#include <dirent.h>

typedef struct layer {
    const char *folder;
    const char *may_include[10];
} layer;

static const layer layers[] = {
    {"core", {"core"}},
    {"filters", {"core", "filters"}},
    {"filters/primitives", {"core", "filters"}},
    {"noises", {"core", "filters", "noises"}},
    {"spectra", {"core", "spectra"}},
    {"textures", {"core", "filters", "noises", "spectra", "textures"}},
    {"aliasing", {"core", "filters", "noises", "spectra", "textures", "aliasing"}},
    {"aliasing/views", {"core", "filters", "noises", "spectra", "textures", "aliasing"}},
    {"aliasing/methods", {"core", "filters", "noises", "spectra", "textures", "aliasing"}},
    {"aliasing/trades", {"core", "filters", "noises", "spectra", "textures", "aliasing"}},
    {"score", {"core", "filters", "noises", "spectra", "textures", "aliasing", "score"}},
    {"reports",
     {"core", "filters", "noises", "spectra", "textures", "aliasing", "score", "reports"}},
    {"reports/figures",
     {"core", "filters", "noises", "spectra", "textures", "aliasing", "score", "reports",
      "reports/figures"}},
    {"cli",
     {"core", "filters", "noises", "spectra", "textures", "aliasing", "score", "reports", "cli"}},
};

// The closed forms of the spectra may read the descriptors of the noises.
static int is_allowed_exception(const char *file, const char *include) {
    return strncmp(file, "spectra/theory", 14) == 0 && strcmp(include, "noises/noise.h") == 0;
}

static const layer *layer_of(const char *folder) {
    for (size_t i = 0; i < sizeof layers / sizeof *layers; i++)
        if (strcmp(layers[i].folder, folder) == 0)
            return &layers[i];
    return NULL; // a system header's
}

static int layer_allows(const layer *from, const char *file, const char *include) {
    char folder[64];
    const char *slash = strrchr(include, '/');
    snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - include) : 0, include);
    if (!layer_of(folder))
        return 1;
    for (size_t i = 0; i < 10 && from->may_include[i]; i++)
        if (strcmp(from->may_include[i], folder) == 0)
            return 1;
    return is_allowed_exception(file, include);
}

static void check_libraries(const char *file, const char *include) {
    if (strstr(include, "fftw") && strcmp(file, "core/fft.c") != 0)
        fail_msg("%s includes <%s>: only core/fft.c knows FFTW", file, include);
    if (strstr(include, "OpenImageIO") && strcmp(file, "reports/oiio.cpp") != 0)
        fail_msg("%s includes <%s>: only reports/oiio.cpp knows OpenImageIO", file, include);
}

static size_t check_file(const layer *from, const char *file) {
    char line[1024], include[256];
    size_t count = 0;
    FILE *stream = fopen(file, "r");
    assert_non_null(stream);
    if (!fgets(line, sizeof line, stream) || !strstr(line, "SPDX-License-Identifier: MIT"))
        fail_msg("%s: the first line must name the licence", file);
    while (fgets(line, sizeof line, stream)) {
        if (sscanf(line, " #include \"%255[^\"]\"", include) == 1) {
            count++;
            if (!layer_allows(from, file, include))
                fail_msg("%s includes \"%s\", which stands below its layer", file, include);
            check_libraries(file, include);
        } else if (sscanf(line, " #include <%255[^>]>", include) == 1) {
            check_libraries(file, include);
        }
    }
    fclose(stream);
    return count;
}

static int is_source(const char *name) {
    const char *dot = strrchr(name, '.');
    return dot && name[0] != '.' &&
           (strcmp(dot, ".c") == 0 || strcmp(dot, ".h") == 0 || strcmp(dot, ".cpp") == 0);
}

static void test_each_folder_includes_only_what_stands_above_it(void **state) {
    (void)state;
    size_t includes = 0;
    for (size_t i = 0; i < sizeof layers / sizeof *layers; i++) {
        DIR *directory = opendir(layers[i].folder);
        if (!directory)
            continue; // a folder of a part that is not built yet
        for (struct dirent *entry; (entry = readdir(directory));) {
            char file[512];
            snprintf(file, sizeof file, "%s/%s", layers[i].folder, entry->d_name);
            if (is_source(entry->d_name))
                includes += check_file(&layers[i], file);
        }
        closedir(directory);
    }
    assert_true(includes > 50); // the tests run from the top of the tree
}

static void test_the_check_sees_a_forbidden_include(void **state) {
    (void)state;
    assert_false(layer_allows(layer_of("core"), "core/x.c", "noises/noise.h"));
    assert_false(layer_allows(layer_of("noises"), "noises/x.c", "spectra/psd.h"));
    assert_false(layer_allows(layer_of("spectra"), "spectra/psd.c", "noises/noise.h"));
    assert_true(layer_allows(layer_of("spectra"), "spectra/theory.c", "noises/noise.h"));
    assert_true(layer_allows(layer_of("core"), "core/x.c", "sys/stat.h"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_folder_includes_only_what_stands_above_it),
        cmocka_unit_test(test_the_check_sees_a_forbidden_include),
    };
    return bl_run_tests(tests);
}
