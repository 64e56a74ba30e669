/* formats/read_file.c - POSIX reading; see read_file.h for what is refused. */
#include "formats/read_file.h"
#include "formats/file_steps.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PIECE = 65536 };

/* reads to the end or to `limit` + 1 bytes; -1 with errno on failure */
static ssize_t read_all(int file, char *buffer, size_t capacity) {
  size_t length = 0;
  while (length < capacity) {
    ssize_t count = read(file, buffer + length, capacity - length);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return -1;
    if (count == 0) break;
    length += (size_t)count;
  }
  return (ssize_t)length;
}

static const char *hint_about_folder(int folder) {
  struct stat info;
  if (fstatat(folder, "solution.yaml", &info, 0) == 0)
    return "a result folder: its solution.yaml, or its motion.csv, may be meant";
  if (fstatat(folder, "batch.json", &info, 0) == 0)
    return "a batch folder: 'ambulo collect' takes it, and 'ambulo batch --status'";
  return NULL;
}

/* *info of an open file that is a regular one */
static ambulo_status inspect(int file, const char *path, ambulo_diagnostics *diagnostics,
                             struct stat *info) {
  ambulo__place place = {.file = path};
  if (fstat(file, info) != 0) return ambulo__io_error(diagnostics, path, "inspect");
  if (S_ISREG(info->st_mode)) return AMBULO_OK;
  int folder = S_ISDIR(info->st_mode);
  return ambulo__error(diagnostics, AMBULO_E_IO, place, folder ? hint_about_folder(file) : NULL,
                       "not a regular file%s", folder ? " (it is a folder)" : "");
}

static ambulo_status read_open_file(int file, const char *path, size_t limit,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, char **text, size_t *length) {
  ambulo__place place = {.file = path};
  struct stat info;
  ambulo_status status = inspect(file, path, diagnostics, &info);
  if (status) return status;
  if ((unsigned long long)info.st_size > (unsigned long long)limit) {
    return ambulo__error(diagnostics, AMBULO_E_LIMIT, place, NULL,
                         "file too large (got %lld bytes); expected at most %zu",
                         (long long)info.st_size, limit);
  }
  size_t size = (size_t)info.st_size;
  char *data = ambulo__alloc(allocator, size + 1, 1);
  if (!data) {
    return ambulo__error(diagnostics, AMBULO_E_MEMORY, place, NULL, "cannot allocate %zu bytes",
                         size + 1);
  }
  ssize_t count = read_all(file, data, size);
  if (count < 0) {
    status = ambulo__io_error(diagnostics, path, "read");
    ambulo__free(allocator, data);
    return status;
  }
  if ((size_t)count < size) {
    ambulo__free(allocator, data);
    return ambulo__error(diagnostics, AMBULO_E_IO, place, NULL,
                         "ended after %zd of %zu bytes: it was cut short while it was read", count,
                         size);
  }
  data[count] = '\0';
  *text = data;
  *length = (size_t)count;
  return AMBULO_OK;
}

/* O_NONBLOCK: opening a FIFO without a writer would wait for one */
static int open_to_read(const char *path) {
  return open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
}

ambulo_status ambulo__read_file(const char *path, size_t limit, const ambulo_allocator *allocator,
                                ambulo_diagnostics *diagnostics, char **text, size_t *length) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo_status status = ambulo__expect_path(path, "file", diagnostics);
  if (status) return status;
  int file = open_to_read(path);
  if (file < 0) return ambulo__io_error(diagnostics, path, "open");
  status = read_open_file(file, path, limit, &own, diagnostics, text, length);
  close(file);
  return status;
}

ambulo_status ambulo__digest_file(const char *path, ambulo_diagnostics *diagnostics,
                                  char text[AMBULO__SHA256_TEXT]) {
  char piece[PIECE];
  struct stat info;
  ambulo__sha256 hash;
  int file = open_to_read(path);
  if (file < 0) return ambulo__io_error(diagnostics, path, "open");
  ambulo_status status = inspect(file, path, diagnostics, &info);
  ssize_t count = PIECE;
  ambulo__sha256_begin(&hash);
  while (!status && count == PIECE) {
    count = read_all(file, piece, sizeof piece);
    if (count < 0) status = ambulo__io_error(diagnostics, path, "read");
    if (count > 0) ambulo__sha256_add(&hash, piece, (size_t)count);
  }
  close(file);
  if (!status) ambulo__sha256_end(&hash, text);
  return status;
}
