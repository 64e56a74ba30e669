/* cli/catalogue.c - see catalogue.h. Nothing is listed here by hand: names are those of the folder,
 * descriptions the files' own. */
#include "cli/catalogue.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/format.h"
#include "cli/output.h"
#include "cli/shipped.h"

enum { PATH = 4096, LARGEST = 1 << 20 };

/* ----------------------------------------------------------------- one file */

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

/* ------------------------------------------------------------------- folder */

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
  for (struct dirent *e = readdir(folder); e && one >= 0; e = readdir(folder)) {
    ambulo__cli_entry *more = grow(*entries, count);
    if (!more) {
      ambulo__cli_error("E_MEMORY", NULL, "not enough memory for the list of shipped files");
      return -1;
    }
    *entries = more;
    one = describe(e->d_name, &more[count]);
    count += one > 0;
  }
  return one < 0 ? -1 : count;
}

int ambulo__cli_catalogue(ambulo__cli_entry **entries) {
  char path[PATH];
  *entries = NULL;
  int there = ambulo__cli_shipped_folder(path, sizeof path);
  DIR *folder = there ? opendir(path) : NULL;
  if (!folder) {
    ambulo__cli_error("E_IO", "'make install' puts them beside it, in share/ambulo/models",
                      there ? "the folder of the shipped models cannot be read: %s"
                            : "the shipped models are not where the program is",
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
