// SPDX-License-Identifier: MIT
//
// The layer rule, read off the #include lines and off the symbols that the linker joins: each
// folder knows only what stands above it, only core/fft.c knows FFTW, only core/oiio.cpp knows
// OpenImageIO; every source has its licence. From the same arrows: no circle between units
// (tests/circles.h says what a unit is).
#include "tests/test.h"

#include <dirent.h>
#include <unistd.h>

#include "tests/circles.h"

enum { KNOWN_MOST = 10 };

typedef struct layer {
    const char *folder;            // a folder below it is of the same layer
    const char *knows[KNOWN_MOST]; // beside itself
} layer;

static const layer layers[] = {
    {"core", {0}},
    {"filters", {"core"}},
    {"noises", {"core", "filters"}},
    {"textures", {"core", "filters", "noises"}},
    {"sources", {"core", "filters", "noises", "textures"}},
    {"spectra", {"core"}},
    {"aliasing", {"core", "filters", "noises", "textures", "sources", "spectra"}},
    {"score", {"core", "filters", "noises", "textures", "sources", "spectra", "aliasing"}},
    {"reports",
     {"core", "filters", "noises", "textures", "sources", "spectra", "aliasing", "score"}},
    {"api",
     {"core", "filters", "noises", "textures", "sources", "spectra", "aliasing", "score",
      "reports"}},
    {"cli",
     {"core", "filters", "noises", "textures", "sources", "spectra", "aliasing", "score",
      "reports"}},
};
enum { LAYERS = sizeof layers / sizeof *layers };

// What one thing may know beside: the closed forms of the spectra read the descriptors of noises,
// and the noises know of the filters nothing but the fade of octaves. The document for programs is
// for api/ alone.
static int is_allowed_exception(const char *file, const char *known) {
    return strncmp(file, "spectra/theory", 14) == 0 && strcmp(known, "noises/noise.h") == 0;
}

static int is_forbidden_besides(const char *file, const char *known) {
    return (strcmp(known, "include/bandlimit.h") == 0 && strncmp(file, "api/", 4) != 0) ||
           (strncmp(file, "noises/", 7) == 0 && strncmp(known, "filters/", 8) == 0 &&
            strncmp(known, "filters/octave_fade.", 20) != 0);
}

// The layer of a file by its first folder; NULL for a system header.
static const layer *layer_of(const char *file) {
    size_t length = strcspn(file, "/");
    for (size_t i = 0; i < LAYERS && file[length]; i++)
        if (strlen(layers[i].folder) == length && strncmp(layers[i].folder, file, length) == 0)
            return &layers[i];
    return NULL;
}

static int may_know(const char *file, const char *known) {
    const layer *from = layer_of(file), *to = layer_of(known);
    if (is_forbidden_besides(file, known))
        return 0;
    if (!to || is_allowed_exception(file, known))
        return 1;
    for (size_t i = 0; i < KNOWN_MOST && from->knows[i]; i++)
        if (strcmp(from->knows[i], to->folder) == 0)
            return 1;
    return from == to;
}

static void check_libraries(const char *file, const char *include) {
    if (strstr(include, "fftw") && strcmp(file, "core/fft.c") != 0)
        fail_msg("%s includes <%s>: only core/fft.c knows FFTW", file, include);
    if (strstr(include, "OpenImageIO") && strcmp(file, "core/oiio.cpp") != 0)
        fail_msg("%s includes <%s>: only core/oiio.cpp knows OpenImageIO", file, include);
}

static size_t check_file(const char *file, bl_needs *needs) {
    char line[1024], include[256];
    size_t count = 0;
    FILE *stream = fopen(file, "r");
    assert_non_null(stream);
    if (!fgets(line, sizeof line, stream) || !strstr(line, "SPDX-License-Identifier: MIT"))
        fail_msg("%s: the first line must name the licence", file);
    while (fgets(line, sizeof line, stream)) {
        if (sscanf(line, " #include \"%255[^\"]\"", include) == 1) {
            count++;
            if (!may_know(file, include))
                fail_msg("%s includes \"%s\", which stands below its layer", file, include);
            if (needs)
                bl_needs_add(needs, file, include, NULL);
            check_libraries(file, include);
        } else if (sscanf(line, " #include <%255[^>]>", include) == 1) {
            check_libraries(file, include);
        }
    }
    fclose(stream);
    return count;
}

static int has_ending(const char *name, const char *ending) {
    const char *dot = strrchr(name, '.');
    return dot && name[0] != '.' && strcmp(dot, ending) == 0;
}

typedef size_t visitor(const char *file, const char *name, void *user);

// Visits every file below a folder; returns the sum of what the visits return.
static size_t walk(const char *folder, visitor *visit, void *user) {
    size_t sum = 0;
    DIR *directory = opendir(folder);
    if (!directory)
        return 0; // a folder of a part that is not built yet
    for (struct dirent *entry; (entry = readdir(directory));) {
        char file[512];
        if (entry->d_name[0] == '.')
            continue;
        snprintf(file, sizeof file, "%s/%s", folder, entry->d_name);
        sum += entry->d_type == DT_DIR ? walk(file, visit, user) : visit(file, entry->d_name, user);
    }
    closedir(directory);
    return sum;
}

static size_t visit_source(const char *file, const char *name, void *user) {
    return has_ending(name, ".c") || has_ending(name, ".h") || has_ending(name, ".cpp")
               ? check_file(file, user)
               : 0;
}

static size_t check_includes(bl_needs *needs) {
    size_t includes = 0;
    for (size_t i = 0; i < LAYERS; i++)
        includes += walk(layers[i].folder, visit_source, needs);
    return includes;
}

static void test_each_folder_includes_only_what_stands_above_it(void **state) {
    (void)state;
    assert_true(check_includes(NULL) > 500); // the tests run from the top of the tree
}

// --- symbols ------------------------------------------------------------------------------------

enum { SYMBOLS_MOST = 60000, NAME_SIZE = 160 };

typedef struct symbol {
    char name[NAME_SIZE];
    char file[NAME_SIZE]; // the object below the build folder: "noises/tiles/tile.o"
    int defined;
} symbol;

typedef struct symbols {
    symbol *list;
    size_t count;
} symbols;

static const char *build_folder(void) {
    const char *folder = getenv("BL_BUILD");
    return folder ? folder : "build";
}

// Objects of sources that have moved on stay in the build folder; they do not count.
static int has_source(const char *object) {
    static const char *const endings[] = {"c", "cpp"};
    char source[NAME_SIZE];
    for (size_t i = 0; i < 2; i++) {
        snprintf(source, sizeof source, "%.*s.%s", (int)strcspn(object, "."), object, endings[i]);
        if (access(source, R_OK) == 0)
            return 1;
    }
    return 0;
}

// Adds the symbols of all objects below a folder; returns how many objects there are. One program
// reads them all: one for each object takes ten times as long.
static size_t read_objects(const char *folder, symbols *all) {
    char command[600], line[1024], last[NAME_SIZE] = "";
    size_t objects = 0;
    int is_ours = 0;
    snprintf(command, sizeof command, "find '%s' -name '*.o' -exec nm -A -P -g {} +", folder);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    while (fgets(line, sizeof line, pipe)) {
        symbol *next = &all->list[all->count];
        char kind, *file = line + strlen(build_folder()) + 1, *end = strstr(line, ": ");
        assert_non_null(end);
        *end = '\0';
        if (strcmp(file, last) != 0) {
            snprintf(last, sizeof last, "%s", file);
            is_ours = has_source(file);
            objects += (size_t)is_ours;
        }
        if (sscanf(end + 2, "%159s %c", next->name, &kind) != 2 ||
            strncmp(next->name, "_Z", 2) == 0 || !is_ours)
            continue;
        snprintf(next->file, sizeof next->file, "%s", file);
        next->defined = kind != 'U' && kind != 'w' && kind != 'v';
        assert_true(++all->count < SYMBOLS_MOST);
    }
    assert_int_equal(pclose(pipe), 0);
    return objects;
}

static int by_name(const void *a, const void *b) {
    return strcmp(((const symbol *)a)->name, ((const symbol *)b)->name);
}

// Checks all uses of one name; the first `count` symbols of the list have it.
static size_t check_uses(const symbol *list, size_t count, bl_needs *needs) {
    size_t arrows = 0;
    for (size_t d = 0; d < count; d++)
        for (size_t u = 0; list[d].defined && u < count; u++) {
            if (list[u].defined)
                continue;
            arrows++;
            if (!may_know(list[u].file, list[d].file))
                fail_msg("%s uses %s of %s, which stands below its layer", list[u].file,
                         list[d].name, list[d].file);
            if (needs)
                bl_needs_add(needs, list[u].file, list[d].file, list[d].name);
        }
    return arrows;
}

static void check_symbols(bl_needs *needs) {
    symbols all = {.list = calloc(SYMBOLS_MOST, sizeof *all.list)};
    size_t objects = 0, arrows = 0, same;
    assert_non_null(all.list);
    for (size_t i = 0; i < LAYERS; i++) {
        char folder[256];
        snprintf(folder, sizeof folder, "%s/%s", build_folder(), layers[i].folder);
        objects += read_objects(folder, &all);
    }
    qsort(all.list, all.count, sizeof *all.list, by_name);
    for (size_t i = 0; i < all.count; i += same) {
        for (same = 1;
             i + same < all.count && strcmp(all.list[i].name, all.list[i + same].name) == 0;)
            same++;
        arrows += check_uses(&all.list[i], same, needs);
    }
    free(all.list);
    assert_true(objects > 200 && arrows > 1000);
}

static void test_each_folder_links_only_what_stands_above_it(void **state) {
    (void)state;
    check_symbols(NULL);
}

static void test_no_circle_ties_units(void **state) {
    (void)state;
    char circles[4096];
    bl_needs *needs = bl_needs_new();
    check_includes(needs);
    check_symbols(needs);
    assert_true(needs->count > 200);
    if (bl_circles(needs, circles, sizeof circles))
        fail_msg("units need each other, so that none stands alone:\n%s", circles);
    bl_needs_free(needs);
}

static void test_the_check_sees_a_forbidden_arrow(void **state) {
    (void)state;
    assert_false(may_know("core/x.c", "noises/noise.h"));
    assert_false(may_know("noises/x.c", "spectra/psd.h"));
    assert_false(may_know("noises/tiles/x.o", "filters/filter.o"));
    assert_false(may_know("textures/image.o", "reports/x.o"));
    assert_false(may_know("spectra/psd.c", "noises/noise.h"));
    assert_true(may_know("spectra/theory.c", "noises/noise.h"));
    assert_true(may_know("noises/octaves/x.o", "filters/octave_fade.o"));
    assert_true(may_know("reports/figures/x.c", "reports/run.h"));
    assert_true(may_know("core/x.c", "sys/stat.h"));
    assert_false(may_know("reports/x.c", "include/bandlimit.h"));
    assert_false(may_know("cli/x.c", "api/api.h"));
    assert_true(may_know("api/x.c", "include/bandlimit.h"));
    const symbol upward[] = {{"bl_x", "reports/x.o", 1}, {"bl_x", "reports/y.o", 0}};
    assert_int_equal(check_uses(upward, 2, NULL), 1);
}

static void check_unit(const char *file, const char *expected) {
    char unit[BL_UNIT_NAME];
    bl_unit_of(file, unit);
    assert_string_equal(unit, expected);
}

static void test_the_check_sees_a_circle(void **state) {
    (void)state;
    char circles[1024];
    bl_needs *needs = bl_needs_new();
    check_unit("noises/tiles/tile_points.h", "noises/tiles/tile");
    check_unit("noises/tiles/tile.c", "noises/tiles/tile");
    check_unit("noises/gradient_noise.v3.o", "noises/gradient_noise");
    check_unit("core/table_csv.o", "core/table");
    bl_needs_add(needs, "a/x.c", "a/y.h", NULL);
    bl_needs_add(needs, "a/y.c", "b/z.h", NULL);
    bl_needs_add(needs, "a/w.c", "a/x.h", NULL);
    bl_needs_add(needs, "a/x.c", "a/x.h", NULL);
    assert_int_equal(bl_circles(needs, circles, sizeof circles), 0);
    bl_needs_add(needs, "b/z.o", "a/x.o", "bl_x");
    assert_int_equal(bl_circles(needs, circles, sizeof circles), 1);
    assert_non_null(strstr(circles, "a circle of a/x a/y b/z\n"));
    assert_non_null(strstr(circles, "  a/x.c includes a/y.h\n"));
    assert_non_null(strstr(circles, "  b/z.o uses bl_x of a/x.o\n"));
    assert_null(strstr(circles, "a/w"));
    bl_needs_free(needs);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_folder_includes_only_what_stands_above_it),
        cmocka_unit_test(test_each_folder_links_only_what_stands_above_it),
        cmocka_unit_test(test_no_circle_ties_units),
        cmocka_unit_test(test_the_check_sees_a_forbidden_arrow),
        cmocka_unit_test(test_the_check_sees_a_circle),
    };
    return bl_run_tests(tests);
}
