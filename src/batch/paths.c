/* batch/paths.c - see paths.h. */
#include "batch/paths.h"

#include <string.h>

static char *join(const ambulo_allocator *a, const char *const *part, int parts) {
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
  return join(a, part, 5);
}

char *ambulo__case_path(const ambulo_allocator *a, const char *directory, const char *id,
                        const char *ending) {
  size_t length = strlen(id);
  char fan[3] = {'0', '0', '\0'};
  if (length >= 2) memcpy(fan, id + length - 2, 2);
  const char *part[] = {directory, "/cases/", fan, "/", id, ending};
  return join(a, part, 6);
}

unsigned long long ambulo__hash_text(unsigned long long hash, const char *text) {
  do {
    hash = (hash ^ (unsigned char)*text) * 1099511628211ULL;
  } while (*text++);
  return hash;
}

unsigned long long ambulo__hash_word(unsigned long long hash, unsigned long long word) {
  for (int i = 0; i < 8; i++) {
    hash = (hash ^ (word & 0xff)) * 1099511628211ULL;
    word >>= 8;
  }
  return hash;
}
