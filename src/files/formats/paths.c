/* formats/paths.c - see paths.h. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "formats/paths.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

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

/* ------------------------------------------------- from one folder to another */

/* length of the parts that both have, up to and without a '/' */
static size_t common(const char *a, const char *b) {
  size_t length = 0;
  for (size_t i = 0;; i++) {
    int end_a = a[i] == '\0' || a[i] == '/', end_b = b[i] == '\0' || b[i] == '/';
    if (end_a && end_b) length = i;
    if (a[i] == '\0' || a[i] != b[i]) return length;
  }
}

static char *way(const ambulo_allocator *allocator, const char *from, const char *to) {
  size_t same = common(from, to), up = 0;
  for (const char *c = from + same; *c; c++) up += *c == '/' && c[1] != '\0';
  const char *rest = to + same;
  while (*rest == '/') rest++;
  size_t length = strlen(rest);
  char *path = ambulo__alloc(allocator, 3 * up + length + 2, 1), *at = path;
  if (!path) errno = ENOMEM;
  if (!path) return NULL;
  for (size_t i = 0; i < up; i++, at += 3) memcpy(at, "../", 3);
  memcpy(at, rest, length);
  at += length;
  if (length > 0) *at++ = '/';
  *at = '\0';
  return path;
}

char *ambulo__path_between(const ambulo_allocator *allocator, const char *from, const char *to) {
  char *a = realpath(from, NULL), *b = realpath(to, NULL);
  char *path = a && b ? way(allocator, a, b) : NULL;
  free(a);
  free(b);
  return path;
}

/* files that come with the program, found by their names (paths.h).
 *
 * A name in a file is seen from that file's folder. Where nothing is there, it may be the name of
 * a shipped model or table, `lower_body_21.yaml` or `norms/young_adults.csv`: then it is looked for
 * below the folder in the environment's AMBULO_MODELS, which the program sets to its own. The
 * library has no folder of its own: without the variable only what is beside the file is found.
 */

static int is_there(const char *path) {
  struct stat entry;
  return stat(path, &entry) == 0;
}

/* nothing of that name: neither a link to nowhere, nor what cannot be looked at now */
static int is_absent(const char *path) {
  struct stat entry;
  return lstat(path, &entry) != 0 && (errno == ENOENT || errno == ENOTDIR);
}

/* a relative name that stays below its folder */
static int may_be_shipped(const char *name) {
  if (!name[0] || name[0] == '/') return 0;
  for (const char *part = name; part; part = strchr(part, '/')) {
    part += *part == '/';
    if (strncmp(part, "..", 2) == 0 && (part[2] == '/' || part[2] == '\0')) return 0;
  }
  return 1;
}

ambulo_status ambulo__shipped_path(const ambulo_allocator *a, const char *path, const char *name,
                                   char **shipped) {
  const char *folder = getenv("AMBULO_MODELS");
  *shipped = NULL;
  if (!folder || !folder[0] || !may_be_shipped(name) || !is_absent(path)) return AMBULO_OK;
  char *found = ambulo__join_paths(a, folder, name, NULL);
  if (!found) return AMBULO_E_MEMORY;
  if (is_there(found)) {
    *shipped = found;
  } else {
    ambulo__free(a, found);
  }
  return AMBULO_OK;
}

static int noted(const ambulo_diagnostics *list, const char *name, const char *path) {
  for (size_t i = 0; i < ambulo_diagnostics_count(list); i++) {
    const ambulo_diagnostic *d = ambulo_diagnostics_get(list, i);
    if (d->severity == AMBULO_NOTE && strstr(d->message, name) && strstr(d->message, path))
      return 1;
  }
  return 0;
}

void ambulo__note_shipped(ambulo_diagnostics *diagnostics, ambulo__place place, const char *name,
                          const char *path) {
  if (!noted(diagnostics, name, path))
    ambulo__note(diagnostics, place, "'%s' is not here; using the shipped %s", name, path);
}

ambulo_status ambulo__named_file(const ambulo_allocator *a, const char *file, const char *name,
                                 ambulo__place place, ambulo_diagnostics *diagnostics,
                                 char **path) {
  char *shipped = NULL, *beside = ambulo__sibling_path(a, file, name);
  if (!beside) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__shipped_path(a, beside, name, &shipped);
  if (status || shipped) ambulo__free(a, beside);
  if (status) return status;
  if (shipped) ambulo__note_shipped(diagnostics, place, name, shipped);
  *path = shipped ? shipped : beside;
  return AMBULO_OK;
}

char *ambulo__parent_path(const ambulo_allocator *allocator, const char *path) {
  const char *slash = strrchr(path, '/');
  if (!slash) return ambulo__strdup(allocator, ".");
  char *parent = ambulo__strdup(allocator, path);
  if (parent) parent[slash == path ? 1 : slash - path] = '\0';
  return parent;
}

char *ambulo__sibling_name(const ambulo_allocator *allocator, const char *path, const char *kind,
                           int k) {
  size_t size = strlen(path) + strlen(kind) + 48;
  char *name = ambulo__alloc(allocator, size, 1);
  if (name) snprintf(name, size, "%s.%s-%ld-%d", path, kind, (long)getpid(), k);
  return name;
}
