// SPDX-License-Identifier: MIT
//
// The loader trusts a file further than a user's file deserves: one that was cut short kills the
// program with SIGBUS, and dlsym finds the functions of every library that the object needs.
#include "sources/shared_object.h"

#include <dlfcn.h>
#include <elf.h>
#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/registry.h"

enum { MOST_SEGMENTS = 256 };

// Whether every segment lies within the file. What is no ELF file at all is left to the loader,
// which has words for it.
static int is_whole(int file, uint64_t size) {
    ElfW(Ehdr) head;
    if (pread(file, &head, sizeof head, 0) != (ssize_t)sizeof head ||
        memcmp(head.e_ident, ELFMAG, SELFMAG) != 0 || head.e_phentsize != sizeof(ElfW(Phdr)) ||
        head.e_phnum > MOST_SEGMENTS)
        return 1;
    for (uint64_t i = 0; i < head.e_phnum; i++) {
        ElfW(Phdr) segment;
        if (head.e_phoff > size ||
            pread(file, &segment, sizeof segment, (off_t)(head.e_phoff + i * sizeof segment)) !=
                (ssize_t)sizeof segment)
            return 0;
        if (segment.p_filesz > size || segment.p_offset > size - segment.p_filesz)
            return 0;
    }
    return 1;
}

static bl_status check_file(const char *path, bl_message *message) {
    struct stat info;
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0)
        return bl_report(message, BL_DEVICE, "cannot read '%s': %s", path, strerror(errno));
    int known = fstat(file, &info) == 0;
    int regular = known && S_ISREG(info.st_mode);
    int whole = regular && is_whole(file, (uint64_t)info.st_size);
    close(file);
    if (!regular)
        return bl_report(message, BL_DEVICE,
                         "cannot read '%s': it is no file but a folder, a "
                         "device or a pipe",
                         path);
    if (!whole)
        return bl_report(message, BL_DEVICE,
                         "cannot read '%s': the shared object ends too early; build it again",
                         path);
    return BL_OK;
}

bl_status bl_shared_object_open(const char *path, void **handle, bl_message *message) {
    char *placed = NULL;
    if (asprintf(&placed, "%s%s", strchr(path, '/') ? "" : "./", path) < 0)
        return bl_report(message, BL_DEVICE, "out of memory");
    bl_status status = check_file(placed, message);
    if (status == BL_OK) {
        *handle = dlopen(placed, RTLD_NOW | RTLD_LOCAL);
        const char *reason = *handle ? NULL : dlerror();
        if (!*handle)
            status = bl_report(message, BL_DEVICE,
                               "cannot load '%s': %s; a plugin is built with cc -fPIC -shared",
                               path, reason ? reason : "no reason is given");
    }
    free(placed);
    return status;
}

bl_status bl_shared_object_find(void *handle, const char *path, const char *symbol,
                                bl_any_function **function, bl_message *message) {
    void *found = dlsym(handle, symbol);
    struct link_map *own = NULL, *home = NULL;
    const ElfW(Sym) *entry = NULL;
    Dl_info info;
    *function = NULL;
    if (!found || dlinfo(handle, RTLD_DI_LINKMAP, &own) != 0 ||
        dladdr1(found, &info, (void **)&home, RTLD_DL_LINKMAP) == 0 || home != own)
        return BL_OK; // none, or that of another library
    int known = dladdr1(found, &info, (void **)&entry, RTLD_DL_SYMENT) != 0 && entry;
    unsigned type = known ? ELF64_ST_TYPE(entry->st_info) : STT_FUNC;
    if (type == STT_OBJECT || type == STT_TLS)
        return bl_report(message, BL_USAGE, "'%s' in '%s' is data; it must be a function", symbol,
                         path);
    memcpy(function, &found, sizeof *function); // POSIX lets a function stand in a void *
    return BL_OK;
}

// --- the names that an object exports ---

typedef struct symbol_table {
    const ElfW(Sym) * symbols;
    const char *names;
    size_t count;
} symbol_table;

// glibc has relocated the pointers of the dynamic section.
static symbol_table find_table(void *handle) {
    struct link_map *map = NULL;
    const uint32_t *hash = NULL, *gnu = NULL;
    symbol_table table = {NULL, NULL, 0};
    if (dlinfo(handle, RTLD_DI_LINKMAP, &map) != 0 || !map->l_ld)
        return table;
    for (const ElfW(Dyn) *entry = map->l_ld; entry->d_tag != DT_NULL; entry++) {
        const void *place = (const void *)entry->d_un.d_ptr;
        if (entry->d_tag == DT_SYMTAB)
            table.symbols = place;
        if (entry->d_tag == DT_STRTAB)
            table.names = place;
        if (entry->d_tag == DT_HASH)
            hash = place;
        if (entry->d_tag == DT_GNU_HASH)
            gnu = place;
    }
    if (hash)
        table.count = hash[1];
    if (!hash && gnu) { // the last chain ends the table
        uint32_t buckets = gnu[0], first = gnu[1], last = 0;
        const uint32_t *bucket = gnu + 4 + (size_t)gnu[2] * (sizeof(ElfW(Addr)) / 4);
        const uint32_t *chain = bucket + buckets;
        for (uint32_t i = 0; i < buckets; i++)
            last = bucket[i] > last ? bucket[i] : last;
        while (last >= first && !(chain[last - first] & 1))
            last++;
        table.count = last >= first ? (size_t)last + 1 : 0;
    }
    if (!table.symbols || !table.names)
        table.count = 0;
    return table;
}

static const char *exported_name(const symbol_table *table, size_t index) {
    static const char *const others[] = {"_init", "_fini"}; // the compiler's own
    const ElfW(Sym) *symbol = &table->symbols[index];
    unsigned binding = ELF64_ST_BIND(symbol->st_info);
    const char *name = table->names + symbol->st_name;
    if (ELF64_ST_TYPE(symbol->st_info) != STT_FUNC || symbol->st_shndx == SHN_UNDEF ||
        (binding != STB_GLOBAL && binding != STB_WEAK) || strcmp(name, others[0]) == 0 ||
        strcmp(name, others[1]) == 0)
        return NULL;
    return name;
}

const char **bl_shared_object_functions(void *handle) {
    symbol_table table = find_table(handle);
    const char **names = calloc(table.count + 1, sizeof *names);
    size_t count = 0;
    for (size_t i = 0; names && i < table.count; i++)
        if (exported_name(&table, i))
            names[count++] = exported_name(&table, i);
    return names;
}
