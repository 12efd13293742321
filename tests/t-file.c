// SPDX-License-Identifier: MIT
//
// Files appear whole or not at all.
#include "tests/test.h"

#include <dirent.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/file.h"

static char folder[] = "/tmp/bandlimit-file-XXXXXX";

static int make_folder(void **state) {
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state) {
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

static const char *path_of(const char *name) {
    static char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static size_t files_in_folder(void) {
    DIR *directory = opendir(folder);
    size_t count = 0;
    for (struct dirent *entry; (entry = readdir(directory));)
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(directory);
    return count;
}

static void read_back(const char *path, char *out, size_t size) {
    FILE *stream = fopen(path, "r");
    assert_non_null(stream);
    size_t got = fread(out, 1, size - 1, stream);
    out[got] = '\0';
    fclose(stream);
}

static void write_file(const char *path, const char *text) {
    bl_file file;
    bl_message message;
    assert_int_equal(bl_file_create(path, &file, &message), BL_OK);
    fputs(text, file.stream);
    assert_int_equal(bl_file_commit(&file, &message), BL_OK);
}

static void test_a_committed_file_is_whole_and_alone(void **state) {
    (void)state;
    char text[32];
    write_file(path_of("a.csv"), "first\n");
    write_file(path_of("a.csv"), "second\n");
    read_back(path_of("a.csv"), text, sizeof text);
    assert_string_equal(text, "second\n");
    assert_int_equal(files_in_folder(), 1);
}

static void test_a_discarded_file_leaves_the_old_one(void **state) {
    (void)state;
    char text[32];
    bl_file file;
    write_file(path_of("a.csv"), "kept\n");
    assert_int_equal(bl_file_create(path_of("a.csv"), &file, NULL), BL_OK);
    fputs("half", file.stream);
    bl_file_discard(&file);
    read_back(path_of("a.csv"), text, sizeof text);
    assert_string_equal(text, "kept\n");
    assert_int_equal(files_in_folder(), 1);
}

static void test_bad_targets_are_refused_with_their_reason(void **state) {
    (void)state;
    bl_file file;
    bl_message message;
    assert_int_equal(bl_file_create(folder, &file, &message), BL_DEVICE);
    assert_non_null(strstr(message.text, "folder"));
    assert_int_equal(bl_file_create(path_of("missing/a.csv"), &file, &message), BL_DEVICE);
    assert_non_null(strstr(message.text, "missing/a.csv"));
    assert_int_equal(bl_file_create("", &file, &message), BL_USAGE);
}

static void test_a_full_disk_is_noticed(void **state) {
    (void)state;
    bl_file file;
    bl_message message;
    assert_int_equal(bl_file_create("/dev/full", &file, &message), BL_OK);
    fputs("text", file.stream);
    assert_int_equal(bl_file_commit(&file, &message), BL_DEVICE);
    assert_non_null(strstr(message.text, "No space left"));
}

// A write that fails long before the end, in a file larger than any buffer, is not forgotten.
static void test_a_file_that_fills_up_half_way_is_removed(void **state) {
    (void)state;
    bl_file file;
    bl_message message;
    struct rlimit limit;
    write_file(path_of("a.csv"), "kept\n");
    size_t files = files_in_folder();
    assert_int_equal(bl_file_create(path_of("a.csv"), &file, &message), BL_OK);
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    const struct rlimit small = {10000, limit.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    for (int i = 0; i < 100000; i++)
        fputs("0123456789\n", file.stream);
    fflush(file.stream);
    bl_status status = bl_file_commit(&file, &message);
    setrlimit(RLIMIT_FSIZE, &limit);
    assert_int_equal(status, BL_DEVICE);
    assert_non_null(strstr(message.text, "File too large"));
    char text[32];
    read_back(path_of("a.csv"), text, sizeof text);
    assert_string_equal(text, "kept\n");
    assert_int_equal(files_in_folder(), files);
}

static void test_a_link_stays_and_what_it_stands_for_is_replaced(void **state) {
    (void)state;
    char target[256], text[32];
    struct stat info;
    snprintf(target, sizeof target, "%s", path_of("target.csv"));
    write_file(target, "old\n");
    assert_int_equal(symlink(target, path_of("link.csv")), 0);
    write_file(path_of("link.csv"), "new\n");
    assert_int_equal(lstat(path_of("link.csv"), &info), 0);
    assert_true(S_ISLNK(info.st_mode));
    read_back(target, text, sizeof text);
    assert_string_equal(text, "new\n");
}

static void test_a_link_to_nothing_is_refused(void **state) {
    (void)state;
    bl_file file;
    bl_message message;
    assert_int_equal(symlink("nowhere/file", path_of("dangling")), 0);
    assert_int_equal(bl_file_create(path_of("dangling"), &file, &message), BL_DEVICE);
    assert_non_null(strstr(message.text, "dangling"));
}

static void test_folders_are_made_with_their_parents(void **state) {
    (void)state;
    bl_message message;
    struct stat info;
    assert_int_equal(bl_make_folder(path_of("p/q/r"), &message), BL_OK);
    assert_int_equal(bl_make_folder(path_of("p/q/r"), &message), BL_OK);
    assert_int_equal(stat(path_of("p/q/r"), &info), 0);
    write_file(path_of("p/file"), "");
    assert_int_equal(bl_make_folder(path_of("p/file/below"), &message), BL_DEVICE);
    assert_non_null(strstr(message.text, "in the way"));
}

// Between opening and closing a folder of that name has come: the last step of all, the renaming,
// fails, is told, and leaves nothing beside.
static void test_a_name_that_cannot_be_taken_is_told(void **state) {
    (void)state;
    bl_file file;
    bl_message message = {""};
    char target[256];
    snprintf(target, sizeof target, "%s", path_of("taken.csv"));
    size_t files = files_in_folder();
    assert_int_equal(bl_file_create(target, &file, &message), BL_OK);
    fputs("text", file.stream);
    assert_int_equal(mkdir(target, 0777), 0);
    assert_int_equal(bl_file_commit(&file, &message), BL_DEVICE);
    assert_non_null(strstr(message.text, "taken.csv"));
    assert_non_null(strstr(message.text, "Is a directory"));
    assert_null(file.stream);
    assert_int_equal(files_in_folder(), files + 1); // the folder alone

    write_file(path_of("other.csv"), "text");
    char other[256];
    snprintf(other, sizeof other, "%s", path_of("other.csv"));
    assert_int_equal(bl_file_install(other, target, &message), BL_DEVICE);
    assert_int_equal(access(other, F_OK), -1);
    assert_int_equal(rmdir(target), 0);
}

static void test_temporary_names_differ_and_keep_the_ending(void **state) {
    (void)state;
    char *a = bl_file_temporary_name("x/y.exr"), *b = bl_file_temporary_name("x/y.exr");
    assert_string_not_equal(a, b);
    assert_true(strncmp(a, "x/", 2) == 0);
    assert_string_equal(a + strlen(a) - 4, ".exr");
    free(a);
    free(b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_committed_file_is_whole_and_alone),
        cmocka_unit_test(test_a_discarded_file_leaves_the_old_one),
        cmocka_unit_test(test_bad_targets_are_refused_with_their_reason),
        cmocka_unit_test(test_a_full_disk_is_noticed),
        cmocka_unit_test(test_a_file_that_fills_up_half_way_is_removed),
        cmocka_unit_test(test_a_link_stays_and_what_it_stands_for_is_replaced),
        cmocka_unit_test(test_a_link_to_nothing_is_refused),
        cmocka_unit_test(test_folders_are_made_with_their_parents),
        cmocka_unit_test(test_a_name_that_cannot_be_taken_is_told),
        cmocka_unit_test(test_temporary_names_differ_and_keep_the_ending),
    };
    bl_set_filter();
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
