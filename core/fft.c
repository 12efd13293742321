// SPDX-License-Identifier: MIT
//
// The only file that knows FFTW: a cache of plans under a lock, and wisdom on disk.
//
// Determinism. FFTW chooses among algorithms that differ in their last bits. An estimated plan is a
// function of the shape alone; a measured one depends on the clock. So a measured plan is used only
// after its wisdom was read from, or has safely arrived on, the disk; a lock file makes a second
// process that wants the same plan at the same moment wait for it and take it. Volumes are always
// estimated, because measuring them costs more than it ever saves.
#include "core/fft.h"

#include <fcntl.h>
#include <fftw3.h>
#include <limits.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <unistd.h>

#include "core/file.h"

enum { LARGE_PAGE = 1 << 21 }; // bytes, on x86-64 and most else

struct bl_fft {
    bl_fft_shape shape;
    void *plan; // an fftw_plan or an fftwf_plan, by shape.precision
    struct bl_fft *next;
};

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static struct bl_fft *plans; // under the lock
static int threads_are_ready;

// --- shapes ---

static int same_shape(const bl_fft_shape *a, const bl_fft_shape *b) {
    int same = a->kind == b->kind && a->precision == b->precision && a->dims == b->dims &&
               a->columns == b->columns && a->threads == b->threads;
    for (unsigned d = 0; d < a->dims; d++)
        same = same && a->size[d] == b->size[d];
    return same;
}

static int is_shape(const bl_fft_shape *shape) {
    if (shape->dims < 1 || shape->dims > 3 || shape->threads < 0)
        return 0;
    for (unsigned d = 0; d < shape->dims; d++)
        if (shape->size[d] < 1)
            return 0;
    if (shape->kind == BL_FFT_REAL || shape->kind == BL_FFT_BACK)
        return 1;
    return shape->dims == 1 && shape->precision == BL_FFT_FLOAT &&
           (shape->kind == BL_FFT_ROW || shape->columns >= 1);
}

size_t bl_fft_bytes(const bl_fft_shape *shape) {
    size_t bytes = shape->precision == BL_FFT_FLOAT ? sizeof(float) : sizeof(double);
    for (unsigned d = 0; d < shape->dims; d++) {
        size_t numbers = shape->size[d];
        if (shape->kind == BL_FFT_COLUMNS) {
            if (__builtin_mul_overflow(numbers, 2 * shape->columns, &numbers))
                return SIZE_MAX;
        } else if (d + 1 == shape->dims) {
            if (numbers > SIZE_MAX - 2)
                return SIZE_MAX;
            numbers = 2 * (numbers / 2 + 1);
        }
        if (__builtin_mul_overflow(bytes, numbers, &bytes))
            return SIZE_MAX;
    }
    return bytes;
}

void *bl_fft_buffer(size_t bytes) {
    if (bytes > SIZE_MAX - 2 * LARGE_PAGE)
        return NULL;
    // Columns of a large slice touch a page each: large pages save a third of the transform.
    size_t alignment = bytes >= 4 * LARGE_PAGE ? LARGE_PAGE : BL_FFT_ALIGNMENT;
    size_t whole = (bytes / alignment + 1) * alignment;
    void *buffer = aligned_alloc(alignment, whole);
    if (buffer && alignment == LARGE_PAGE)
        madvise(buffer, whole, MADV_HUGEPAGE); // a hint: refusal changes nothing
    return buffer;
}

// --- wisdom on disk ---

// The folder of the wisdom, or NULL; a relative XDG_CACHE_HOME is ignored, as its standard asks.
static char *wisdom_folder(void) {
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    char *folder = NULL;
    int length = -1;
    if (cache && cache[0] == '/')
        length = asprintf(&folder, "%s/bandlimit", cache);
    else if ((!cache || !*cache) && home && home[0] == '/')
        length = asprintf(&folder, "%s/.cache/bandlimit", home);
    return length < 0 ? NULL : folder;
}

static char *wisdom_path(const char *folder, bl_fft_precision precision) {
    char *path = NULL;
    const char *name = precision == BL_FFT_FLOAT ? "fftw-float" : "fftw-double";
    return asprintf(&path, "%s/%s.wisdom", folder, name) < 0 ? NULL : path;
}

// Opens and locks the lock file; -1 if the folder cannot be had, written, or locked.
static int lock_wisdom(const char *folder) {
    char *path = NULL;
    int descriptor = -1;
    if (bl_make_folder(folder, NULL) == BL_OK && access(folder, R_OK | W_OK | X_OK) == 0 &&
        asprintf(&path, "%s/lock", folder) >= 0) {
        descriptor = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        free(path);
    }
    if (descriptor >= 0 && flock(descriptor, LOCK_EX) != 0) {
        close(descriptor);
        descriptor = -1;
    }
    return descriptor;
}

static void forget_wisdom(bl_fft_precision precision) {
    if (precision == BL_FFT_FLOAT)
        fftwf_forget_wisdom();
    else
        fftw_forget_wisdom();
}

// Only what stands on disk may steer a plan. A file that is missing or damaged counts as empty.
static void read_wisdom(const char *path, bl_fft_precision precision) {
    forget_wisdom(precision);
    int good = precision == BL_FFT_FLOAT ? fftwf_import_wisdom_from_filename(path)
                                         : fftw_import_wisdom_from_filename(path);
    if (!good)
        forget_wisdom(precision);
}

static bl_status write_wisdom(const char *path, bl_fft_precision precision) {
    bl_file file;
    bl_status status = bl_file_create(path, &file, NULL);
    if (status != BL_OK)
        return status;
    if (precision == BL_FFT_FLOAT)
        fftwf_export_wisdom_to_file(file.stream);
    else
        fftw_export_wisdom_to_file(file.stream);
    return bl_file_commit(&file, NULL);
}

// --- plans ---

// Must come before wisdom is read: it makes new planners, which know nothing.
static void prepare_threads(void) {
    if (threads_are_ready)
        return;
    fftw_init_threads();
    fftwf_init_threads();
    threads_are_ready = 1;
}

static void set_threads(bl_fft_precision precision, int threads) {
    if (precision == BL_FFT_FLOAT)
        fftwf_plan_with_nthreads(threads < 1 ? 1 : threads);
    else
        fftw_plan_with_nthreads(threads < 1 ? 1 : threads);
}

// Every size fits an int and every row 2*(n/2+1) an int too: checked at the door.
static void *make_plan(const bl_fft_shape *shape, void *buffer, void *other, unsigned flags) {
    int size[3];
    for (unsigned d = 0; d < shape->dims; d++)
        size[d] = (int)shape->size[d];
    int dims = (int)shape->dims, columns = (int)shape->columns;
    set_threads(shape->precision, shape->threads);
    if (shape->kind == BL_FFT_ROW)
        return fftwf_plan_dft_r2c_1d(size[0], other, buffer, flags | FFTW_DESTROY_INPUT);
    if (shape->kind == BL_FFT_COLUMNS)
        return fftwf_plan_many_dft(1, size, columns, buffer, NULL, columns, 1, buffer, NULL,
                                   columns, 1, FFTW_FORWARD, flags);
    if (shape->precision == BL_FFT_FLOAT)
        return shape->kind == BL_FFT_REAL
                   ? (void *)fftwf_plan_dft_r2c(dims, size, buffer, buffer, flags)
                   : (void *)fftwf_plan_dft_c2r(dims, size, buffer, buffer, flags);
    return shape->kind == BL_FFT_REAL
               ? (void *)fftw_plan_dft_r2c(dims, size, buffer, buffer, flags)
               : (void *)fftw_plan_dft_c2r(dims, size, buffer, buffer, flags);
}

static void destroy_plan(bl_fft_precision precision, void *plan) {
    if (precision == BL_FFT_FLOAT)
        fftwf_destroy_plan(plan);
    else
        fftw_destroy_plan(plan);
}

// A measured plan whose wisdom is on disk, or NULL.
static void *make_kept_plan(const bl_fft_shape *shape, void *buffer, void *other) {
    char *folder = wisdom_folder();
    char *path = folder ? wisdom_path(folder, shape->precision) : NULL;
    int locked = path ? lock_wisdom(folder) : -1;
    void *plan = NULL;
    if (locked >= 0) {
        read_wisdom(path, shape->precision);
        plan = make_plan(shape, buffer, other, FFTW_MEASURE | FFTW_WISDOM_ONLY);
        if (!plan) {
            plan = make_plan(shape, buffer, other, FFTW_MEASURE);
            if (plan && write_wisdom(path, shape->precision) != BL_OK) {
                destroy_plan(shape->precision, plan);
                plan = NULL;
            }
        }
        close(locked); // which unlocks
    }
    free(path);
    free(folder);
    return plan;
}

static bl_status make_entry(const bl_fft_shape *shape, struct bl_fft **entry, bl_message *message) {
    void *buffer = bl_fft_buffer(bl_fft_bytes(shape)); // planning may overwrite it
    void *other = shape->kind == BL_FFT_ROW ? bl_fft_buffer(bl_fft_bytes(shape)) : NULL;
    *entry = calloc(1, sizeof **entry);
    if (!buffer || !*entry || (shape->kind == BL_FFT_ROW && !other)) {
        free(buffer);
        free(other);
        free(*entry);
        return bl_report(message, BL_DEVICE,
                         "out of memory planning a transform (%zu bytes); use a smaller size",
                         bl_fft_bytes(shape));
    }
    (*entry)->shape = *shape;
    if (shape->dims < 3)
        (*entry)->plan = make_kept_plan(shape, buffer, other);
    if (!(*entry)->plan) {
        forget_wisdom(shape->precision);
        (*entry)->plan = make_plan(shape, buffer, other, FFTW_ESTIMATE);
    }
    free(buffer);
    free(other);
    if ((*entry)->plan)
        return BL_OK;
    free(*entry);
    return bl_report(message, BL_DEVICE, "the transform library refused a transform of %zu samples",
                     shape->size[0]);
}

static const struct bl_fft *find_entry(const bl_fft_shape *shape) {
    for (const struct bl_fft *entry = plans; entry; entry = entry->next)
        if (same_shape(&entry->shape, shape))
            return entry;
    return NULL;
}

bl_status bl_fft_plan(const bl_fft_shape *shape, const bl_fft **plan, bl_message *message) {
    if (!is_shape(shape))
        return bl_report(message, BL_USAGE, "a transform needs 1 to 3 sizes, each at least 1");
    for (unsigned d = 0; d < shape->dims; d++)
        if (shape->size[d] > INT_MAX - 2 || shape->columns > INT_MAX)
            return bl_report(message, BL_MISMATCH,
                             "a transform of %zu samples along an axis is too long; at most %d",
                             shape->size[d], INT_MAX - 2);
    bl_status status = BL_OK;
    pthread_mutex_lock(&lock);
    prepare_threads();
    *plan = find_entry(shape);
    if (!*plan) {
        struct bl_fft *entry;
        status = make_entry(shape, &entry, message);
        if (status == BL_OK) {
            entry->next = plans;
            plans = entry;
            *plan = entry;
        }
    }
    pthread_mutex_unlock(&lock);
    return status;
}

void bl_fft_run(const bl_fft *plan, void *buffer) {
    int back = plan->shape.kind == BL_FFT_BACK;
    if (plan->shape.kind == BL_FFT_COLUMNS)
        fftwf_execute_dft(plan->plan, buffer, buffer);
    else if (plan->shape.precision == BL_FFT_FLOAT && back)
        fftwf_execute_dft_c2r(plan->plan, buffer, buffer);
    else if (plan->shape.precision == BL_FFT_FLOAT)
        fftwf_execute_dft_r2c(plan->plan, buffer, buffer);
    else if (back)
        fftw_execute_dft_c2r(plan->plan, buffer, buffer);
    else
        fftw_execute_dft_r2c(plan->plan, buffer, buffer);
}

void bl_fft_run_row(const bl_fft *plan, float *samples, float *spectrum) {
    fftwf_execute_dft_r2c(plan->plan, samples, (fftwf_complex *)spectrum);
}

bl_status bl_fft_bare_2d(size_t size, int threads, const bl_fft **plan, bl_message *message) {
    bl_fft_shape shape = {.kind = BL_FFT_REAL,
                          .precision = BL_FFT_FLOAT,
                          .dims = 2,
                          .size = {size, size},
                          .threads = threads};
    return bl_fft_plan(&shape, plan, message);
}

int bl_fft_keeps_wisdom(char **folder) {
    *folder = wisdom_folder();
    int locked = *folder ? lock_wisdom(*folder) : -1;
    if (locked >= 0)
        close(locked);
    return locked >= 0;
}

void bl_fft_forget(void) {
    pthread_mutex_lock(&lock);
    while (plans) {
        struct bl_fft *next = plans->next;
        destroy_plan(plans->shape.precision, plans->plan);
        free(plans);
        plans = next;
    }
    forget_wisdom(BL_FFT_FLOAT);
    forget_wisdom(BL_FFT_DOUBLE);
    pthread_mutex_unlock(&lock);
}
