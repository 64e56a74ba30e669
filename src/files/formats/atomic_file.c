/* formats/atomic_file.c - temporary name, write, fsync, close, rename, fsync of the folder. */
#include "formats/atomic_file.h"

#include "formats/paths.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ----------------------------------------------------------------------- steps */

ambulo_status ambulo__io_error(ambulo_diagnostics *diagnostics, const char *path,
                               const char *action) {
  ambulo__place place = {.file = path};
  int reason = errno;
  return ambulo__error(diagnostics, reason == ENOMEM ? AMBULO_E_MEMORY : AMBULO_E_IO, place, NULL,
                       "cannot %s: %s", action, strerror(reason));
}

ambulo_status ambulo__io_memory_error(ambulo_diagnostics *diagnostics, const char *path) {
  ambulo__place place = {.file = path};
  return ambulo__error(diagnostics, AMBULO_E_MEMORY, place, NULL, "out of memory");
}

ambulo_status ambulo__expect_path(const char *path, const char *what,
                                  ambulo_diagnostics *diagnostics) {
  if (!path || path[0]) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                       "the name of the %s is empty; expected a path", what);
}

/* write(2) until all is out; 0, or -1 with errno */
static int write_all(int file, const char *data, size_t length) {
  while (length > 0) {
    ssize_t count = write(file, data, length);
    if (count < 0 && errno == EINTR) continue;
    if (count == 0) errno = EIO; /* nothing taken, no reason given: not to be tried for ever */
    if (count <= 0) return -1;
    data += count;
    length -= (size_t)count;
  }
  return 0;
}

ambulo_status ambulo__fill_file(int file, const char *path, const char *data, size_t length,
                                int flush, ambulo_diagnostics *diagnostics) {
  ambulo_status status = AMBULO_OK;
  if (file < 0) return ambulo__io_error(diagnostics, path, "open for writing");
  if (write_all(file, data, length) != 0) {
    status = ambulo__io_error(diagnostics, path, "write");
  } else if (flush && fsync(file) != 0) {
    status = ambulo__io_error(diagnostics, path, "flush to disk");
  }
  if (close(file) != 0 && status == AMBULO_OK) {
    status = ambulo__io_error(diagnostics, path, "close");
  }
  return status;
}

int ambulo__sync_folder(const char *path) {
  int folder = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return -1;
  int result = fsync(folder);
  int reason = errno;
  close(folder);
  if (result != 0 && (reason == EINVAL || reason == ENOTSUP || reason == EROFS)) return 0;
  errno = reason;
  return result;
}

/* ------------------------------------------------------------------- whole files */

#define NAME_ATTEMPTS 100

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

/* link, unlike rename, never replaces: of two writers one loses. Where the file system has
 * no links, the check made before writing must do. */
static int move_into_place(const char *temporary, const char *path, int replace) {
  if (replace) return rename(temporary, path);
  if (link(temporary, path) == 0) return 0;
  int unsupported = errno == EPERM || errno == ENOTSUP || errno == ENOSYS;
  return unsupported ? rename(temporary, path) : -1;
}

/* Every allocation comes before the rename: afterwards the new
 * file is there and must not be reported missing. */
static ambulo_status write_through_temporary(const char *path, const char *data, size_t length,
                                             int replace, const ambulo_allocator *allocator,
                                             ambulo_diagnostics *diagnostics) {
  char *temporary = NULL, *parent = ambulo__parent_path(allocator, path);
  int file = parent ? open_temporary(path, allocator, &temporary) : -1;
  ambulo_status status = AMBULO_OK;
  if (!parent || !temporary) {
    (void)ambulo__io_memory_error(diagnostics, path);
    status = AMBULO_E_MEMORY;
  } else if (file < 0) {
    status = ambulo__io_error(diagnostics, path, "create");
  } else {
    status = ambulo__fill_file(file, path, data, length, 1, diagnostics);
    if (status == AMBULO_OK && move_into_place(temporary, path, replace) != 0) {
      status = ambulo__io_error(diagnostics, path, "create");
    }
    if ((status != AMBULO_OK || !replace) && unlink(temporary) != 0 && errno != ENOENT) {
      ambulo__place place = {.file = temporary};
      ambulo__warning(diagnostics, place, NULL, "this file stays here: it cannot be removed: %s",
                      strerror(errno));
    }
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
    /* devices and FIFOs: no temporary, and nothing to flush */
    if (!S_ISREG(info.st_mode))
      return ambulo__fill_file(open(path, O_WRONLY | O_CLOEXEC), path, data, length, 0,
                               diagnostics);
    if (!replace) {
      return ambulo__error(diagnostics, AMBULO_E_IO, place, NULL, "the file exists already");
    }
  }
  return write_through_temporary(path, data, length, replace, &own, diagnostics);
}

/* -------------------------------------------------- what must not be written over */

enum { MOST = 4096 };

int ambulo__file_says(const char *path, const char *text, size_t within) {
  char start[MOST + 1];
  size_t length = 0, wanted = within < MOST ? within : MOST;
  int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return 0;
  while (length < wanted) {
    ssize_t count = read(file, start + length, wanted - length);
    if (count <= 0) break;
    length += (size_t)count;
  }
  close(file);
  size_t size = strlen(text);
  for (size_t at = 0; at + size <= length; at++) {
    if (memcmp(start + at, text, size) == 0) return 1;
  }
  return 0;
}

/* tables of earlier versions began with their units */
static int is_own(const char *path) {
  static const char *const marks[] = {AMBULO__OWN_MARK, "# SI units and radians: time s; q rad"};
  for (int i = 0; i < 2; i++) {
    if (ambulo__file_says(path, marks[i], strlen(marks[i]))) return 1;
  }
  return 0;
}

static int is_same(const struct stat *a, const struct stat *b) {
  return a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

/* of an input that is a folder: one of its files; -1 with errno: it cannot be known */
static int is_in_folder(const struct stat *there, const char *folder) {
  int found = 0;
  DIR *stream = opendir(folder);
  struct stat entry;
  if (!stream) return -1;
  for (const struct dirent *e; !found && (errno = 0, e = readdir(stream)) != NULL;) {
    if (fstatat(dirfd(stream), e->d_name, &entry, 0) == 0)
      found = is_same(&entry, there);
    else if (errno != ENOENT && errno != ELOOP)
      found = -1;
    if (found) break;
  }
  int reason = errno;
  (void)closedir(stream);
  errno = reason;
  return !found && reason ? -1 : found;
}

/* 1: a file is there; 0: none; -1 with errno: it cannot be known */
static int look(const char *path, struct stat *entry) {
  if (stat(path, entry) == 0) return 1;
  return errno == ENOENT || errno == ENOTDIR ? 0 : -1;
}

ambulo_status ambulo__output_check(const char *output, const char *const *inputs, int count,
                                   int force, ambulo_diagnostics *diagnostics) {
  ambulo__place place = {.file = output};
  struct stat there, input;
  static const char hint[] = "give another name, or --force (in C: overwrite)";
  int found = force ? 0 : look(output, &there);
  if (found < 0) return ambulo__io_error(diagnostics, output, "inspect");
  if (!found || !S_ISREG(there.st_mode)) return AMBULO_OK;
  for (int i = 0; i < count; i++) {
    found = inputs[i] ? look(inputs[i], &input) : 0;
    if (!found) continue;
    int within = found > 0 && S_ISDIR(input.st_mode) ? is_in_folder(&there, inputs[i]) : 0;
    if (found < 0 || within < 0) return ambulo__io_error(diagnostics, inputs[i], "inspect");
    if (!within && !is_same(&input, &there)) continue;
    return ambulo__error(
        diagnostics, AMBULO_E_IO, place, hint, "the output is %s '%s'%s; it is not written over",
        within ? "a file of the input" : "the input", inputs[i], within ? "" : " itself");
  }
  if (there.st_size == 0 || is_own(output)) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_IO, place, hint,
                       "the file exists, and ambulo did not write it; it is not written over");
}
