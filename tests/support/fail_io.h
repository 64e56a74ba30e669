/* tests/support/fail_io.h - steps on files that fail at the k-th time.
 *
 * Included by one source of a test program, it defines open, openat, read, write, fsync, close,
 * rename, link and fstat: the library, linked statically, calls these. They do what the system's
 * functions do, but the chosen step fails at its k-th call (from 0), as if by the device:
 *
 *     for (int step = 0; step < FAIL_IO_STEPS; step++)
 *       for (long k = 0;; k++) {
 *         fail_io_arm(step, k);
 *         status = ...;
 *         if (!fail_io_disarm()) break;              k was beyond the last call
 *         assert_int_equal(status, AMBULO_E_IO);
 *       }
 *
 * The source that includes it must define _GNU_SOURCE before every include. */
#ifndef AMBULO_TESTS_FAIL_IO_H
#define AMBULO_TESTS_FAIL_IO_H

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
  FAIL_IO_OPEN,
  FAIL_IO_READ,
  FAIL_IO_SHORT_READ, /* the file ends early, without an error */
  FAIL_IO_WRITE,
  FAIL_IO_NO_WRITE, /* nothing is taken, without an error */
  FAIL_IO_FSYNC,
  FAIL_IO_CLOSE,
  FAIL_IO_RENAME,
  FAIL_IO_LINK,
  FAIL_IO_FSTAT,
  FAIL_IO_STEPS
};

static struct {
  int step; /* -1: none fails */
  long fail_at, count;
  int failed;
} fail_io = {-1, 0, 0, 0};

static inline void fail_io_arm(int step, long k) {
  fail_io.step = step;
  fail_io.fail_at = k;
  fail_io.count = 0;
  fail_io.failed = 0;
}

/* 1 if the fault happened */
static inline int fail_io_disarm(void) {
  fail_io.step = -1;
  return fail_io.failed;
}

static inline int fail_io_now(int step) {
  if (fail_io.step != step || fail_io.count++ != fail_io.fail_at) return 0;
  fail_io.failed = 1;
  errno = EIO;
  return 1;
}

#define FAIL_IO_REAL(type, name, ...)                                                              \
  static type (*real)(__VA_ARGS__);                                                                \
  if (!real) *(void **)(&real) = dlsym(RTLD_NEXT, name)

int open(const char *path, int flags, ...) {
  FAIL_IO_REAL(int, "open", const char *, int, ...);
  va_list arguments;
  va_start(arguments, flags);
  unsigned mode = flags & O_CREAT ? va_arg(arguments, unsigned) : 0;
  va_end(arguments);
  return fail_io_now(FAIL_IO_OPEN) ? -1 : real(path, flags, mode);
}

int openat(int folder, const char *path, int flags, ...) {
  FAIL_IO_REAL(int, "openat", int, const char *, int, ...);
  va_list arguments;
  va_start(arguments, flags);
  unsigned mode = flags & O_CREAT ? va_arg(arguments, unsigned) : 0;
  va_end(arguments);
  return fail_io_now(FAIL_IO_OPEN) ? -1 : real(folder, path, flags, mode);
}

ssize_t read(int file, void *buffer, size_t size) {
  FAIL_IO_REAL(ssize_t, "read", int, void *, size_t);
  if (fail_io_now(FAIL_IO_READ)) return -1;
  return fail_io_now(FAIL_IO_SHORT_READ) ? 0 : real(file, buffer, size);
}

ssize_t write(int file, const void *buffer, size_t size) {
  FAIL_IO_REAL(ssize_t, "write", int, const void *, size_t);
  if (fail_io_now(FAIL_IO_WRITE)) return -1;
  return fail_io_now(FAIL_IO_NO_WRITE) ? 0 : real(file, buffer, size);
}

int fsync(int file) {
  FAIL_IO_REAL(int, "fsync", int);
  return fail_io_now(FAIL_IO_FSYNC) ? -1 : real(file);
}

int close(int file) {
  FAIL_IO_REAL(int, "close", int);
  int result = real(file);
  return fail_io_now(FAIL_IO_CLOSE) ? -1 : result;
}

int rename(const char *from, const char *to) {
  FAIL_IO_REAL(int, "rename", const char *, const char *);
  return fail_io_now(FAIL_IO_RENAME) ? -1 : real(from, to);
}

int link(const char *from, const char *to) {
  FAIL_IO_REAL(int, "link", const char *, const char *);
  return fail_io_now(FAIL_IO_LINK) ? -1 : real(from, to);
}

int fstat(int file, struct stat *info) {
  FAIL_IO_REAL(int, "fstat", int, struct stat *);
  return fail_io_now(FAIL_IO_FSTAT) ? -1 : real(file, info);
}

#endif
