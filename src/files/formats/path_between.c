/* formats/path_between.c - the way from one folder to another (paths.h). */
#define _XOPEN_SOURCE 700 /* realpath */
#include "formats/paths.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

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
