// SPDX-License-Identifier: MIT
#include "core/memory.h"

#include <stdio.h>
#include <unistd.h>

// The kernel's own estimate counts the page cache that it would give up, which sysconf does not;
// where /proc is not mounted, three quarters of the physical pages stand in for it.
size_t bl_memory_available(void) {
    size_t kilobytes = 0;
    char line[128];
    FILE *info = fopen("/proc/meminfo", "r");
    while (info && fgets(line, sizeof line, info))
        if (sscanf(line, "MemAvailable: %zu", &kilobytes) == 1)
            break;
    if (info)
        fclose(info);
    if (kilobytes)
        return kilobytes * 1024;
    long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    return pages > 0 && page > 0 ? (size_t)pages / 4 * 3 * (size_t)page : (size_t)1 << 30;
}

bl_status bl_memory_check(double bytes, const char *what, bl_message *message) {
    double available = (double)bl_memory_available();
    if (bytes <= available)
        return BL_OK;
    return bl_report(message, BL_MISMATCH,
                     "%.0f bytes (%.3g GB) of memory for %s are more than the %.3g GB available; "
                     "use a smaller size or fewer averages",
                     bytes, bytes * 1e-9, what, available * 1e-9);
}
