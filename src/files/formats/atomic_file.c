/* formats/atomic_file.c - temporary name, write, fsync, close, rename, fsync of the folder. */
#include "formats/atomic_file.h"
#include "formats/file_steps.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#define NAME_ATTEMPTS 100

/* devices and FIFOs: no temporary, and nothing to flush */
static ambulo_status write_directly(const char *path, const char *data, size_t length,
                                    ambulo_diagnostics *diagnostics) {
  int file = open(path, O_WRONLY | O_CLOEXEC);
  if (file < 0) return ambulo__io_error(diagnostics, path, "open for writing");
  ambulo_status status = AMBULO_OK;
  if (ambulo__write_all(file, data, length) != 0) {
    status = ambulo__io_error(diagnostics, path, "write");
  }
  if (close(file) != 0 && status == AMBULO_OK) {
    status = ambulo__io_error(diagnostics, path, "close");
  }
  return status;
}

/* creates the temporary; *name is the caller's, also when -1 is returned */
static int open_temporary(const char *path, const ambulo_allocator *allocator, char **name) {
  for (int k = 0; k < NAME_ATTEMPTS; k++) {
    *name = ambulo__sibling_name(allocator, path, "tmp", k);
    if (!*name) return -1;
    int file = open(*name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0 || errno != EEXIST || k == NAME_ATTEMPTS - 1) return file;
    ambulo__free(allocator, *name);
  }
  return -1;
}

static ambulo_status fill(int file, const char *path, const char *data, size_t length,
                          ambulo_diagnostics *diagnostics) {
  ambulo_status status = AMBULO_OK;
  if (ambulo__write_all(file, data, length) != 0) {
    status = ambulo__io_error(diagnostics, path, "write");
  } else if (fsync(file) != 0) {
    status = ambulo__io_error(diagnostics, path, "flush to disk");
  }
  if (close(file) != 0 && status == AMBULO_OK) {
    status = ambulo__io_error(diagnostics, path, "close");
  }
  return status;
}

/* link, unlike rename, never replaces: of two writers one loses. Where the file system has
 * no links, the check made before writing must do. */
static int move_into_place(const char *temporary, const char *path, int replace) {
  if (replace) return rename(temporary, path);
  if (link(temporary, path) == 0) return 0;
  int unsupported = errno == EPERM || errno == ENOTSUP || errno == ENOSYS;
  return unsupported ? rename(temporary, path) : -1;
}

/* Everything that may fail for want of memory comes before the rename: afterwards the new
 * file is there and must not be reported missing. */
static ambulo_status write_through_temporary(const char *path, const char *data, size_t length,
                                             int replace, const ambulo_allocator *allocator,
                                             ambulo_diagnostics *diagnostics) {
  char *temporary = NULL, *parent = ambulo__parent_path(allocator, path);
  int file = parent ? open_temporary(path, allocator, &temporary) : -1;
  ambulo_status status = AMBULO_OK;
  if (!parent || !temporary) {
    status = ambulo__io_memory_error(diagnostics, path);
  } else if (file < 0) {
    status = ambulo__io_error(diagnostics, path, "create");
  } else {
    status = fill(file, path, data, length, diagnostics);
    if (status == AMBULO_OK && move_into_place(temporary, path, replace) != 0) {
      status = ambulo__io_error(diagnostics, path, "create");
    }
    if (status != AMBULO_OK || !replace) unlink(temporary);
  }
  if (status == AMBULO_OK && ambulo__sync_folder(parent) != 0) {
    status = ambulo__io_error(diagnostics, path, "flush the folder of");
  }
  ambulo__free(allocator, temporary);
  ambulo__free(allocator, parent);
  return status;
}

ambulo_status ambulo__write_file(const char *path, const char *data, size_t length, int replace,
                                 const ambulo_allocator *allocator,
                                 ambulo_diagnostics *diagnostics) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo__place place = {.file = path};
  struct stat info;
  ambulo_status status = ambulo__expect_path(path, "file to write", diagnostics);
  if (status) return status;
  if (stat(path, &info) == 0) {
    if (S_ISDIR(info.st_mode)) {
      return ambulo__error(diagnostics, AMBULO_E_IO, place, NULL,
                           "cannot write: a folder of that name exists");
    }
    if (!S_ISREG(info.st_mode)) return write_directly(path, data, length, diagnostics);
    if (!replace) {
      return ambulo__error(diagnostics, AMBULO_E_IO, place, NULL, "the file exists already");
    }
  }
  return write_through_temporary(path, data, length, replace, &own, diagnostics);
}
