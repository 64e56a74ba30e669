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
#include "cli/own_program.h"

enum { PATH = 4096 };
static const char variable[] = "AMBULO_MODELS";

static int is_there(const char *path) {
  struct stat info;
  return stat(path, &info) == 0;
}

static int is_file(const char *path) {
  struct stat info;
  return stat(path, &info) == 0 && S_ISREG(info.st_mode);
}

/* the folder of the program, without links */
static int own_folder(char folder[PATH]) {
  char own[PATH];
  char *plain = ambulo__cli_own_program(own, sizeof own) ? realpath(own, NULL) : NULL;
  char *slash = plain ? strrchr(plain, '/') : NULL;
  int fits = slash && strlen(plain) < PATH;
  if (slash) *slash = '\0';
  if (fits) ambulo__cli_format(folder, PATH, "%s", plain);
  free(plain);
  return fits;
}

static int beside_program(char *buffer, size_t size) {
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

int ambulo__cli_shipped_folder(char *buffer, size_t size) {
  const char *named = getenv(variable);
  if (!named || !named[0]) return beside_program(buffer, size);
  if (strlen(named) >= size || !is_there(named)) return 0;
  ambulo__cli_format(buffer, size, "%s", named);
  return 1;
}

int ambulo__cli_shipped_file(const char *name, char *buffer, size_t size) {
  char folder[PATH], path[2 * PATH];
  if (!ambulo__cli_shipped_folder(folder, sizeof folder)) return 0;
  ambulo__cli_format(path, sizeof path, "%s/%s", folder, name);
  int fits = is_there(path) && strlen(path) < size;
  if (fits) ambulo__cli_format(buffer, size, "%s", path);
  return fits;
}

void ambulo__cli_shipped_announce(void) {
  char folder[PATH];
  const char *named = getenv(variable);
  if (named && named[0]) return;
  if (beside_program(folder, sizeof folder)) (void)setenv(variable, folder, 1);
}

int ambulo__cli_find_file(const char *word, char *buffer, size_t size) {
  char name[PATH];
  size_t length = strlen(word);
  if (length == 0 || length + sizeof ".yaml" > sizeof name || is_file(word)) return 0;
  ambulo__cli_format(name, sizeof name, "%s.yaml", word);
  int here = is_file(name) && strlen(name) < size, below = word[0] != '/' && !strstr(word, "..");
  if (here) {
    ambulo__cli_format(buffer, size, "%s", name);
  } else if (!below || !((ambulo__cli_shipped_file(word, buffer, size) && is_file(buffer)) ||
                         (ambulo__cli_shipped_file(name, buffer, size) && is_file(buffer)))) {
    return 0;
  }
  fprintf(stderr, "ambulo: note: '%s' is not here: %s%s is taken\n", word,
          here ? "" : "the shipped ", buffer);
  return 1;
}

void ambulo__cli_shipped_hint(const char *file) {
  char folder[PATH], path[2 * PATH];
  const char *slash = strrchr(file, '/'), *name = slash ? slash + 1 : file;
  if (!name[0] || is_there(file) || !ambulo__cli_shipped_folder(folder, sizeof folder)) return;
  ambulo__cli_format(path, sizeof path, "%s/%s", folder, name);
  if (is_there(path))
    fprintf(stderr,
            "  hint: '%s' is one of the shipped files; cp -r \"$(ambulo --models)\" . copies them "
            "to the folder 'models' here,\n        and without a folder before it the name alone "
            "is found from anywhere\n",
            name);
}
