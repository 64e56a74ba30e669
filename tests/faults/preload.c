/* tests/faults/preload.c - LD_PRELOAD: the k-th call of a kind fails, as faults.h says.
 *
 * Functions stand in front of those of the C library. They count from main() on, leave the streams
 * 0 to 2 alone, and fail as a full or broken disk, or a machine without memory, does. What NLopt
 * asks for memory is left alone: of a single request it does not look at the answer, or takes less
 * without a word. That a lasting want of memory is seen before is
 * tests/method/test_nlopt_memory.c's. */
#define _GNU_SOURCE
#include "faults/faults.h"

#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <link.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#pragma GCC visibility push(default)

extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);
extern void *__libc_memalign(size_t, size_t);

static faults *plan; /* NULL: not armed */

/* whether this call fails; its number is taken */
static int fails(fault_kind kind, int reason) {
  if (!plan) return 0;
  long k = __atomic_fetch_add(&plan->count[kind], 1, __ATOMIC_RELAXED);
  if ((int)kind != plan->kind || plan->at < 0) return 0;
  if (plan->way == FAULT_FOR_EVER ? k < plan->at : k != plan->at) return 0;
  __atomic_fetch_add(&plan->hits, 1, __ATOMIC_RELAXED);
  errno = plan->way == FAULT_INTERRUPTED ? EINTR : reason;
  return 1;
}

#define NEXT(result, name, arguments)                                                              \
  static result(*next) arguments;                                                                  \
  if (!next) *(void **)&next = dlsym(RTLD_NEXT, #name)

/* ------------------------------------------------------------------- memory */

static uintptr_t nlopt_from, nlopt_to; /* its text and data; empty: it is linked in */

static int find_nlopt(struct dl_phdr_info *object, size_t size, void *unused) {
  (void)size, (void)unused;
  if (!strstr(object->dlpi_name, "libnlopt")) return 0;
  for (int i = 0; i < object->dlpi_phnum; i++) {
    uintptr_t from = object->dlpi_addr + object->dlpi_phdr[i].p_vaddr;
    if (object->dlpi_phdr[i].p_type != PT_LOAD) continue;
    if (!nlopt_from) nlopt_from = from;
    nlopt_to = from + object->dlpi_phdr[i].p_memsz;
  }
  return 1;
}

static int no_memory(const void *caller) {
  uintptr_t from = (uintptr_t)caller;
  return !(from >= nlopt_from && from < nlopt_to) && fails(FAULT_MEMORY, ENOMEM);
}
#define NO_MEMORY no_memory(__builtin_return_address(0))

void *malloc(size_t size) {
  return NO_MEMORY ? NULL : __libc_malloc(size);
}
void *calloc(size_t count, size_t size) {
  return NO_MEMORY ? NULL : __libc_calloc(count, size);
}
void *realloc(void *old, size_t size) {
  return NO_MEMORY ? NULL : __libc_realloc(old, size);
}
void *aligned_alloc(size_t alignment, size_t size) {
  return NO_MEMORY ? NULL : __libc_memalign(alignment, size);
}
int posix_memalign(void **block, size_t alignment, size_t size) {
  if (NO_MEMORY) return ENOMEM;
  *block = __libc_memalign(alignment, size);
  return *block ? 0 : ENOMEM;
}

/* -------------------------------------------------------------------- files */

/* what the machine is, is not on a disk */
static int of_the_system(const char *path) {
  return strncmp(path, "/proc", 5) == 0 || strncmp(path, "/sys", 4) == 0;
}

static int open_at(int folder, const char *path, int flags, mode_t mode) {
  if (!of_the_system(path) && fails(FAULT_OPEN, EIO)) return -1;
  return (int)syscall(SYS_openat, folder, path, flags, mode);
}
int __open_2(const char *path, int flags);
int __open_2(const char *path, int flags) {
  return open_at(AT_FDCWD, path, flags, 0);
}
#define MODE(last)                                                                                 \
  va_list rest;                                                                                    \
  va_start(rest, last);                                                                            \
  mode_t mode = (last)&O_CREAT ? (mode_t)va_arg(rest, int) : 0;                                    \
  va_end(rest)
int open(const char *path, int flags, ...) {
  MODE(flags);
  return open_at(AT_FDCWD, path, flags, mode);
}
int openat(int folder, const char *path, int flags, ...) {
  MODE(flags);
  return open_at(folder, path, flags, mode);
}
FILE *fopen(const char *path, const char *mode) {
  NEXT(FILE *, fopen, (const char *, const char *));
  return !of_the_system(path) && fails(FAULT_OPEN, EIO) ? NULL : next(path, mode);
}
FILE *tmpfile(void) {
  NEXT(FILE *, tmpfile, (void));
  return fails(FAULT_OPEN, EIO) ? NULL : next();
}

ssize_t read(int file, void *buffer, size_t size) {
  if (file > 2 && fails(FAULT_READ, EIO)) {
    if (plan->way != FAULT_SHORT || size < 2) return -1;
    size /= 2;
  }
  return syscall(SYS_read, file, buffer, size);
}
ssize_t pread(int file, void *buffer, size_t size, off_t at) {
  if (fails(FAULT_READ, EIO)) {
    if (plan->way != FAULT_SHORT || size < 2) return -1;
    size /= 2;
  }
  return syscall(SYS_pread64, file, buffer, size, at);
}
ssize_t write(int file, const void *buffer, size_t size) {
  if (file > 2 && fails(FAULT_WRITE, ENOSPC)) {
    if (plan->way != FAULT_SHORT || size < 2) return -1;
    size /= 2;
  }
  return syscall(SYS_write, file, buffer, size);
}
ssize_t pwrite(int file, const void *buffer, size_t size, off_t at) {
  if (fails(FAULT_WRITE, ENOSPC)) {
    if (plan->way != FAULT_SHORT || size < 2) return -1;
    size /= 2;
  }
  return syscall(SYS_pwrite64, file, buffer, size, at);
}
int ftruncate(int file, off_t size) {
  return fails(FAULT_WRITE, EIO) ? -1 : (int)syscall(SYS_ftruncate, file, size);
}
int fsync(int file) {
  (void)file;
  return fails(FAULT_FSYNC, EIO) ? -1 : 0; /* none of these files has to outlive the machine */
}
int close(int file) {
  int result = (int)syscall(SYS_close, file);
  return file > 2 && fails(FAULT_CLOSE, EIO) ? -1 : result;
}

int rename(const char *from, const char *to) {
  return fails(FAULT_RENAME, EIO) ? -1 : renameat(AT_FDCWD, from, AT_FDCWD, to);
}
int link(const char *from, const char *to) {
  return fails(FAULT_RENAME, EIO) ? -1 : linkat(AT_FDCWD, from, AT_FDCWD, to, 0);
}
int mkdir(const char *path, mode_t mode) {
  return fails(FAULT_MKDIR, ENOSPC) ? -1 : mkdirat(AT_FDCWD, path, mode);
}
int unlinkat(int folder, const char *path, int flags) {
  return fails(FAULT_UNLINK, EIO) ? -1 : (int)syscall(SYS_unlinkat, folder, path, flags);
}
int unlink(const char *path) {
  return unlinkat(AT_FDCWD, path, 0);
}
int rmdir(const char *path) {
  return unlinkat(AT_FDCWD, path, AT_REMOVEDIR);
}

int fstatat(int folder, const char *path, struct stat *entry, int flags) {
  NEXT(int, fstatat, (int, const char *, struct stat *, int));
  return fails(FAULT_STAT, EIO) ? -1 : next(folder, path, entry, flags);
}
int stat(const char *path, struct stat *entry) {
  return fstatat(AT_FDCWD, path, entry, 0);
}
int lstat(const char *path, struct stat *entry) {
  return fstatat(AT_FDCWD, path, entry, AT_SYMLINK_NOFOLLOW);
}
int fstat(int file, struct stat *entry) {
  return fstatat(file, "", entry, AT_EMPTY_PATH);
}
int access(const char *path, int mode) {
  return !of_the_system(path) && fails(FAULT_STAT, EIO) ? -1 : faccessat(AT_FDCWD, path, mode, 0);
}
char *realpath(const char *path, char *resolved) {
  NEXT(char *, realpath, (const char *, char *));
  return fails(FAULT_STAT, EIO) ? NULL : next(path, resolved);
}

DIR *opendir(const char *path) {
  NEXT(DIR *, opendir, (const char *));
  return fails(FAULT_FOLDER, EIO) ? NULL : next(path);
}
DIR *fdopendir(int file) {
  NEXT(DIR *, fdopendir, (int));
  return fails(FAULT_FOLDER, EIO) ? NULL : next(file);
}
struct dirent *readdir(DIR *stream) {
  NEXT(struct dirent *, readdir, (DIR *));
  return fails(FAULT_FOLDER, EIO) ? NULL : next(stream);
}

int posix_spawn(pid_t *process, const char *path, const posix_spawn_file_actions_t *files,
                const posix_spawnattr_t *attributes, char *const arguments[],
                char *const variables[]) {
  NEXT(int, posix_spawn,
       (pid_t *, const char *, const posix_spawn_file_actions_t *, const posix_spawnattr_t *,
        char *const[], char *const[]));
  if (fails(FAULT_SPAWN, EAGAIN)) return EAGAIN;
  return next(process, path, files, attributes, arguments, variables);
}
int pipe(int ends[2]) {
  return fails(FAULT_SPAWN, EMFILE) ? -1 : (int)syscall(SYS_pipe2, ends, 0);
}

/* --------------------------------------------------------------------- main */

static int (*real_main)(int, char **, char **);

static int counted_main(int count, char **words, char **variables) {
  const char *path = getenv(FAULTS_VARIABLE);
  int file = path ? (int)syscall(SYS_openat, AT_FDCWD, path, O_RDWR | O_CLOEXEC) : -1;
  void *place =
      file < 0 ? MAP_FAILED : mmap(NULL, sizeof *plan, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (file >= 0) (void)syscall(SYS_close, file);
  (void)dl_iterate_phdr(find_nlopt, NULL);
  faults *found = place == MAP_FAILED ? NULL : place;
  if (found && found->worker == (getenv("AMBULO_WORKER") != NULL)) plan = found;
  return real_main(count, words, variables);
}

int __libc_start_main(int (*start)(int, char **, char **), int count, char **words,
                      int (*first)(int, char **, char **), void (*last)(void), void (*loader)(void),
                      void *stack);
int __libc_start_main(int (*start)(int, char **, char **), int count, char **words,
                      int (*first)(int, char **, char **), void (*last)(void), void (*loader)(void),
                      void *stack) {
  NEXT(int, __libc_start_main,
       (int (*)(int, char **, char **), int, char **, int (*)(int, char **, char **),
        void (*)(void), void (*)(void), void *));
  real_main = start;
  return next(counted_main, count, words, first, last, loader, stack);
}
