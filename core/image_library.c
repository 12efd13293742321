// SPDX-License-Identifier: MIT
#include "core/image_library.h"

#include <dlfcn.h>
#include <limits.h>
#include <link.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/version.h"

// The Makefile tells where the libraries are installed, absolute and from the folder of programs.
#ifndef BL_LIBRARY_FOLDER
#define BL_LIBRARY_FOLDER "/usr/local/lib"
#define BL_LIBRARY_FROM_PROGRAM "../lib"
#endif

static const bl_image_library *loaded;
static bl_message refusal;

// The folder of the program or shared object that this code is in, with a '/' at its end; "" if
// nothing tells. The link map of a program has no name, and the system knows it better anyway.
static void find_own_folder(char folder[PATH_MAX]) {
    Dl_info info;
    struct link_map *map = NULL;
    const char *file = "/proc/self/exe";
    if (dladdr1(&loaded, &info, (void **)&map, RTLD_DL_LINKMAP) && map && map->l_name[0])
        file = map->l_name;
    char *slash = realpath(file, folder) ? strrchr(folder, '/') : NULL;
    if (slash)
        slash[1] = 0;
    else
        folder[0] = 0;
}

// Takes the table out of a file that is there.
static void open_file(const char *path) {
    void *object = dlopen(path, RTLD_LAZY | RTLD_LOCAL);
    const char *reason = object ? NULL : dlerror();
    const bl_image_library *table = object ? dlsym(object, BL_IMAGE_LIBRARY_SYMBOL) : NULL;
    if (!object)
        bl_report(&refusal, BL_DEVICE,
                  "images need OpenImageIO, and '%s' does not load: %s; install OpenImageIO's "
                  "libraries",
                  path, reason ? reason : "no reason given");
    else if (!table || strcmp(table->version, BL_VERSION) != 0)
        bl_report(&refusal, BL_DEVICE,
                  "'%s' is of version %s and this is bandlimit " BL_VERSION
                  "; install both from one build",
                  path, table ? table->version : "unknown");
    else
        loaded = table;
}

static void load(void) {
    static const char *const places[] = {"", "../", "bandlimit/",
                                         BL_LIBRARY_FROM_PROGRAM "/bandlimit/", NULL};
    char own[PATH_MAX], path[2 * PATH_MAX];
    const char *named = getenv("BANDLIMIT_IMAGES");
    if (named && *named) {
        open_file(named);
        return;
    }
    find_own_folder(own);
    for (int i = 0; own[0] && places[i]; i++) {
        snprintf(path, sizeof path, "%s%s" BL_IMAGE_LIBRARY_FILE, own, places[i]);
        if (access(path, F_OK) == 0) {
            open_file(path);
            return;
        }
    }
    const char *configured = BL_LIBRARY_FOLDER "/bandlimit/" BL_IMAGE_LIBRARY_FILE;
    if (access(configured, F_OK) == 0) {
        open_file(configured);
        return;
    }
    bl_report(&refusal, BL_DEVICE,
              "images need " BL_IMAGE_LIBRARY_FILE
              ", which is neither '%s', nor in bandlimit/ or " BL_LIBRARY_FROM_PROGRAM
              "/bandlimit/ from there, nor '%s'; install bandlimit again, or name the file in "
              "BANDLIMIT_IMAGES",
              own, configured);
}

bl_status bl_image_library_load(const bl_image_library **library, bl_message *message) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, load);
    *library = loaded;
    return loaded ? BL_OK : bl_report(message, BL_DEVICE, "%s", refusal.text);
}
