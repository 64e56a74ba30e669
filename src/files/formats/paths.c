/* formats/paths.c - see paths.h. */
#include "formats/paths.h"

#include <string.h>

char *ambulo__join_parts(const ambulo_allocator *a, const char *const *part, int parts) {
  size_t length = 1;
  for (int i = 0; i < parts; i++) length += strlen(part[i]);
  char *path = ambulo__alloc(a, length, 1), *end = path;
  for (int i = 0; path && i < parts; i++) {
    size_t size = strlen(part[i]);
    memcpy(end, part[i], size);
    end += size;
  }
  return path;
}

char *ambulo__sibling_path(const ambulo_allocator *a, const char *file, const char *name) {
  const char *slash = strrchr(file, '/');
  if (name[0] == '/' || !slash) return ambulo__strdup(a, name);
  size_t folder = (size_t)(slash - file) + 1, size = strlen(name) + 1;
  char *path = ambulo__alloc(a, folder + size, 1);
  if (!path) return NULL;
  memcpy(path, file, folder);
  memcpy(path + folder, name, size);
  return path;
}

char *ambulo__join_paths(const ambulo_allocator *a, const char *directory, const char *first,
                         const char *second) {
  const char *part[] = {directory, "/", first, second ? "/" : "", second ? second : ""};
  return ambulo__join_parts(a, part, 5);
}
