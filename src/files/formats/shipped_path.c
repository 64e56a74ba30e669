/* formats/shipped_path.c - files that come with the program, found by their names (paths.h).
 *
 * A name in a file is seen from that file's folder. Where nothing is there, it may be the name of
 * a shipped model or table, `lower_body_21.yaml` or `norms/young_adults.csv`: then it is looked for
 * below the folder in the environment's AMBULO_MODELS, which the program sets to its own. The
 * library has no folder of its own: without the variable only what is beside the file is found.
 */
#include "formats/paths.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

static int is_there(const char *path) {
  struct stat entry;
  return stat(path, &entry) == 0;
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
  if (!folder || !folder[0] || !may_be_shipped(name) || is_there(path)) return AMBULO_OK;
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
