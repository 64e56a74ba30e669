/* tests/support/faulty_files.h - file operations of which the k-th of a kind fails.
 *
 * The functions below stand in the test program in place of those of the C library, so that the
 * library under test calls them; they go on by another road. Include it in one file of a program.
 *
 *     for (long k = 0;; k++) {
 *       fault_arm(FAULT_READ, k);
 *       status = ...
 *       if (!fault_disarm()) break;      k was beyond the last one
 *     }
 */
#ifndef AMBULO_TESTS_FAULTY_FILES_H
#define AMBULO_TESTS_FAULTY_FILES_H

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

typedef enum fault_kind {
  FAULT_OPEN,
  FAULT_READ,
  FAULT_WRITE,
  FAULT_FSYNC,
  FAULT_RENAME,
  FAULT_CLOSE,
  FAULT_STAT,
  FAULT_OPENDIR,
  FAULT_MKDIR,
  FAULT_KINDS
} fault_kind;

static const char *const fault_names[FAULT_KINDS] = {"open",  "read", "write",   "fsync", "rename",
                                                     "close", "stat", "opendir", "mkdir"};

static struct {
  fault_kind kind;
  long at, count; /* at < 0: none fails */
  int hit;
} fault = {FAULT_KINDS, -1, 0, 0};

static inline void fault_arm(fault_kind kind, long at) {
  fault.kind = kind;
  fault.at = at;
  fault.count = 0;
  fault.hit = 0;
}

/* whether it came to the fault */
static inline int fault_disarm(void) {
  fault.at = -1;
  return fault.hit;
}

static inline int fault_now(fault_kind kind, int reason) {
  if (fault.at < 0 || fault.kind != kind || fault.count++ != fault.at) return 0;
  fault.hit = 1;
  errno = reason;
  return 1;
}

int open(const char *path, int flags, ...);
int open(const char *path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  mode_t mode = flags & O_CREAT ? (mode_t)va_arg(rest, int) : 0;
  va_end(rest);
  return fault_now(FAULT_OPEN, EIO) ? -1 : openat(AT_FDCWD, path, flags, mode);
}

ssize_t read(int file, void *buffer, size_t size) {
  struct iovec piece = {buffer, size};
  return fault_now(FAULT_READ, EIO) ? -1 : readv(file, &piece, 1);
}

/* half of it is out before the disk is full */
ssize_t write(int file, const void *buffer, size_t size) {
  struct iovec piece = {(void *)(uintptr_t)buffer, size};
  if (fault_now(FAULT_WRITE, ENOSPC)) {
    piece.iov_len = size / 2;
    (void)!writev(file, &piece, 1);
    errno = ENOSPC;
    return -1;
  }
  return writev(file, &piece, 1);
}

int fsync(int file) {
  return fault_now(FAULT_FSYNC, EIO) ? -1 : (int)syscall(SYS_fsync, file);
}

int rename(const char *from, const char *to) {
  return fault_now(FAULT_RENAME, EIO) ? -1 : renameat(AT_FDCWD, from, AT_FDCWD, to);
}

int close(int file) {
  int result = (int)syscall(SYS_close, file);
  return fault_now(FAULT_CLOSE, EIO) ? -1 : result;
}

int stat(const char *path, struct stat *info) {
  return fault_now(FAULT_STAT, EIO) ? -1 : fstatat(AT_FDCWD, path, info, 0);
}

DIR *opendir(const char *path) {
  if (fault_now(FAULT_OPENDIR, EIO)) return NULL;
  int file = openat(AT_FDCWD, path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  return file < 0 ? NULL : fdopendir(file);
}

int mkdir(const char *path, mode_t mode) {
  return fault_now(FAULT_MKDIR, ENOSPC) ? -1 : mkdirat(AT_FDCWD, path, mode);
}

#endif
