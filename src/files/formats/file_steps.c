/* formats/file_steps.c - see file_steps.h. */
#include "formats/file_steps.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

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

char *ambulo__sibling_name(const ambulo_allocator *allocator, const char *path, const char *kind,
                           int k) {
  size_t size = strlen(path) + strlen(kind) + 48;
  char *name = ambulo__alloc(allocator, size, 1);
  if (name) snprintf(name, size, "%s.%s-%ld-%d", path, kind, (long)getpid(), k);
  return name;
}

char *ambulo__join_path(const ambulo_allocator *allocator, const char *folder, const char *name) {
  size_t size = strlen(folder) + strlen(name) + 2;
  char *path = ambulo__alloc(allocator, size, 1);
  if (path) snprintf(path, size, "%s/%s", folder, name);
  return path;
}

char *ambulo__parent_path(const ambulo_allocator *allocator, const char *path) {
  const char *slash = strrchr(path, '/');
  if (!slash) return ambulo__strdup(allocator, ".");
  char *parent = ambulo__strdup(allocator, path);
  if (parent) parent[slash == path ? 1 : slash - path] = '\0';
  return parent;
}

int ambulo__write_all(int file, const char *data, size_t length) {
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
