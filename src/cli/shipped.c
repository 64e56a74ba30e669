/* cli/shipped.c - see shipped.h. The folder is found from the place of the program itself, so that
 * an installation may be moved. No file is listed by hand: names are those of the folder,
 * descriptions the files' own. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "cli/shipped.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/output.h"
#include "cli/program.h"

enum { PATH = 4096, LARGEST = 1 << 20 };
static const char variable[] = "AMBULO_MODELS";

static int is_there(const char *path) {
  struct stat info;
  return stat(path, &info) == 0;
}

static int is_file(const char *path) {
  struct stat info;
  return stat(path, &info) == 0 && S_ISREG(info.st_mode);
}

/* nothing of that name: neither a link to nowhere, nor what cannot be looked at now */
static int is_absent(const char *path) {
  struct stat info;
  return lstat(path, &info) != 0 && (errno == ENOENT || errno == ENOTDIR);
}

static int is_folder(const char *path) {
  struct stat info;
  return stat(path, &info) == 0 && S_ISDIR(info.st_mode);
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
  if (length == 0 || length + sizeof ".yaml" > sizeof name || ambulo__cli_is_worker()) return 0;
  if (!is_absent(word) && !is_folder(word)) return 0;
  ambulo__cli_format(name, sizeof name, "%s.yaml", word);
  int here = !is_absent(name) && !is_folder(name) && strlen(name) < size;
  int below = word[0] != '/' && !strstr(word, "..");
  if (here) {
    ambulo__cli_format(buffer, size, "%s", name);
  } else if (!below || !((ambulo__cli_shipped_file(word, buffer, size) && is_file(buffer)) ||
                         (ambulo__cli_shipped_file(name, buffer, size) && is_file(buffer)))) {
    return 0;
  }
  fprintf(stderr, "ambulo: note: '%s' is not here; using %s%s\n", word, here ? "" : "the shipped ",
          buffer);
  return 1;
}

void ambulo__cli_shipped_hint(const char *file) {
  char folder[PATH], path[2 * PATH];
  const char *slash = strrchr(file, '/'), *name = slash ? slash + 1 : file;
  if (!name[0] || !is_absent(file) || !ambulo__cli_shipped_folder(folder, sizeof folder)) return;
  ambulo__cli_format(path, sizeof path, "%s/%s", folder, name);
  if (is_there(path))
    fprintf(stderr,
            "  hint: '%s' is a shipped file: its name without a folder is found from anywhere;\n   "
            "     cp -r \"$(ambulo --models)\" . copies all shipped files to the folder 'models'\n",
            name);
}

/* ---------------------------------------------------------------- the catalogue */

static char *read_text(FILE *file) {
  char *text = malloc(LARGEST + 1);
  size_t length = text ? fread(text, 1, LARGEST, file) : 0;
  if (text) text[length] = '\0';
  return text;
}

char *ambulo__cli_shipped_text(const char *name) {
  char path[PATH];
  FILE *file = ambulo__cli_shipped_file(name, path, sizeof path) ? fopen(path, "rb") : NULL;
  char *text = file ? read_text(file) : NULL;
  if (!file)
    ambulo__cli_error("E_IO", NULL, "the shipped %s cannot be opened", name);
  else if (!text)
    ambulo__cli_error("E_MEMORY", NULL, "not enough memory for %s", name);
  if (file) fclose(file);
  return text;
}

static int ends_sentence(const char *at) {
  return at[0] == '.' && (at[1] == '\0' || at[1] == ' ');
}

/* shortens to what stands before its last colon, or else comma, or else space */
static void shorten(char *line) {
  static const char marks[] = {':', ',', ' '};
  for (size_t i = 0; i < sizeof marks; i++) {
    char *mark = strrchr(line, marks[i]);
    if (!mark || mark < line + 20) continue;
    *mark = '\0';
    return;
  }
}

void ambulo__cli_first_sentence(const char *text, char *line, size_t size) {
  size_t length = 0;
  int whole = 1;
  /* lines of the comment are joined; an empty one ends it, and a line such as inDegrees=yes */
  while (text[0] == '#' && text[1] == ' ' && text[2 + strcspn(text + 2, " =\n")] != '=' && whole) {
    const char *end = strchr(text, '\n');
    size_t room = end ? (size_t)(end - text) : strlen(text);
    if (length > 0 && length + 1 < size) line[length++] = ' ';
    for (size_t i = 2; i < room && whole; i++) {
      whole = length + 1 < size;
      if (whole) line[length++] = text[i];
    }
    text += room + (end != NULL);
  }
  line[length] = '\0';
  for (char *at = line; *at; at++) {
    if (!ends_sentence(at)) continue;
    *at = '\0';
    return;
  }
  if (!whole) shorten(line);
}

/* the value of the first line "kind: ..." */
static void read_kind(const char *text, char *kind, size_t size) {
  const char *at = strstr(text, "\nkind: ");
  size_t length = at ? strcspn(at + 7, " \r\n#") : 0;
  ambulo__cli_format(kind, size, "%.*s", (int)length, at ? at + 7 : "");
}

static int ends_with(const char *name, const char *ending) {
  size_t a = strlen(name), b = strlen(ending);
  return a > b && strcmp(name + a - b, ending) == 0;
}

static int describe(const char *name, ambulo__cli_entry *entry) {
  int table = ends_with(name, ".csv");
  if ((!table && !ends_with(name, ".yaml")) || strlen(name) >= sizeof entry->file) return 0;
  char *text = ambulo__cli_shipped_text(name);
  if (!text) return -1;
  ambulo__cli_format(entry->file, sizeof entry->file, "%s", name);
  if (table)
    ambulo__cli_format(entry->kind, sizeof entry->kind, "table");
  else
    read_kind(text, entry->kind, sizeof entry->kind);
  ambulo__cli_first_sentence(text, entry->about, sizeof entry->about);
  free(text);
  return 1;
}

static int by_name(const void *left, const void *right) {
  const ambulo__cli_entry *a = left, *b = right;
  return strcmp(a->file, b->file);
}

/* room for one more; NULL: no memory */
static ambulo__cli_entry *grow(ambulo__cli_entry *list, int count) {
  if (count % 32 != 0) return list;
  return realloc(list, ((size_t)count + 32) * sizeof *list);
}

static int read_folder(DIR *folder, ambulo__cli_entry **entries) {
  int count = 0, one = 0;
  for (const struct dirent *e; one >= 0 && (errno = 0, e = readdir(folder)) != NULL;) {
    ambulo__cli_entry *more = grow(*entries, count);
    if (!more) {
      ambulo__cli_error("E_MEMORY", NULL, "not enough memory for the list of shipped files");
      return -1;
    }
    *entries = more;
    one = describe(e->d_name, &more[count]);
    count += one > 0;
  }
  if (one >= 0 && errno) {
    ambulo__cli_error("E_IO", NULL, "the folder of the shipped models cannot be read: %s",
                      strerror(errno));
    return -1;
  }
  return one < 0 ? -1 : count;
}

int ambulo__cli_catalogue(ambulo__cli_entry **entries) {
  char path[PATH];
  *entries = NULL;
  int there = ambulo__cli_shipped_folder(path, sizeof path);
  DIR *folder = there ? opendir(path) : NULL;
  if (!folder) {
    ambulo__cli_error("E_IO", "'make install' installs them in share/ambulo/models",
                      there ? "the folder of the shipped models cannot be read: %s"
                            : "the shipped models are not found beside the program",
                      there ? strerror(errno) : "");
    return -1;
  }
  int count = read_folder(folder, entries);
  closedir(folder);
  if (count > 0) qsort(*entries, (size_t)count, sizeof **entries, by_name);
  if (count < 0) {
    free(*entries);
    *entries = NULL;
  }
  return count;
}
