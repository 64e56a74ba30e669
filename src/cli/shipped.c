/* cli/shipped.c - see shipped.h. The folder is found from the place of the program itself, so that
 * an installation may be moved. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "cli/format.h"
#include "cli/shipped.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/output.h"

enum { PATH = 4096 };

static int is_there(const char *path) {
  struct stat info;
  return stat(path, &info) == 0;
}

/* the folder of the program, without links */
static int own_folder(char folder[PATH]) {
  ssize_t length = readlink("/proc/self/exe", folder, PATH - 1);
  if (length <= 0) return 0;
  folder[length] = '\0';
  char *slash = strrchr(folder, '/');
  if (slash) *slash = '\0';
  return slash != NULL;
}

int ambulo__cli_shipped_folder(char *buffer, size_t size) {
  /* installed; built; built as a variant */
  static const char *const places[] = {"../share/ambulo/models", "../models", "../../models"};
  char folder[PATH], path[2 * PATH];
  if (!own_folder(folder)) return 0;
  for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
    ambulo__cli_format(path, sizeof path, "%s/%s/walk_normal.yaml", folder, places[i]);
    if (!is_there(path)) continue;
    ambulo__cli_format(path, sizeof path, "%s/%s", folder, places[i]);
    char *plain = realpath(path, NULL);
    int fits = plain && strlen(plain) < size;
    if (fits) ambulo__cli_format(buffer, size, "%s", plain);
    free(plain);
    return fits;
  }
  return 0;
}

int ambulo__cli_shipped_file(const char *name, char *buffer, size_t size) {
  char folder[PATH], path[2 * PATH];
  if (!ambulo__cli_shipped_folder(folder, sizeof folder)) return 0;
  ambulo__cli_format(path, sizeof path, "%s/%s", folder, name);
  int fits = is_there(path) && strlen(path) < size;
  if (fits) ambulo__cli_format(buffer, size, "%s", path);
  return fits;
}

void ambulo__cli_shipped_hint(const char *file) {
  char folder[PATH], path[2 * PATH];
  const char *slash = strrchr(file, '/'), *name = slash ? slash + 1 : file;
  if (!name[0] || is_there(file) || !ambulo__cli_shipped_folder(folder, sizeof folder)) return;
  ambulo__cli_format(path, sizeof path, "%s/%s", folder, name);
  if (is_there(path))
    fprintf(stderr,
            "  hint: '%s' is one of the shipped files; cp -r \"$(ambulo --models)\" . copies them "
            "to the folder 'models' here\n",
            name);
}
