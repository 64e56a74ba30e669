/* tests/support/scratch.h - a scratch folder for tests that touch the file system. */
#ifndef AMBULO_TESTS_SCRATCH_H
#define AMBULO_TESTS_SCRATCH_H

#include "support/test.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

enum { SCRATCH_PATH = 512 };

/* cmocka setup: *state is the path of a fresh folder */
static inline int scratch_open(void **state) {
  const char *parent = getenv("TMPDIR");
  char *path = malloc(SCRATCH_PATH);
  if (!path) return -1;
  snprintf(path, SCRATCH_PATH, "%s/ambulo-test-XXXXXX", parent && *parent ? parent : "/tmp");
  *state = path;
  return mkdtemp(path) ? 0 : -1;
}

/* removes a file or a folder and all below it; links are not followed */
static inline int scratch_remove_at(int parent, const char *name) {
  if (unlinkat(parent, name, 0) == 0) return 0;
  (void)fchmodat(parent, name, 0700, 0);
  int file = openat(parent, name, O_RDONLY | O_DIRECTORY);
  DIR *stream = file >= 0 ? fdopendir(file) : NULL;
  if (!stream) return -1;
  for (struct dirent *entry = readdir(stream); entry; entry = readdir(stream)) {
    if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
    scratch_remove_at(file, entry->d_name);
  }
  closedir(stream);
  return unlinkat(parent, name, AT_REMOVEDIR);
}

/* cmocka teardown */
static inline int scratch_close(void **state) {
  int result = scratch_remove_at(AT_FDCWD, *state);
  free(*state);
  return result;
}

/* "<scratch>/<name>" in one of many rotating buffers */
static inline const char *scratch_path(void **state, const char *name) {
  static char buffers[32][SCRATCH_PATH + 256];
  static int next;
  char *buffer = buffers[next++ % 32];
  snprintf(buffer, sizeof buffers[0], "%s/%s", (const char *)*state, name);
  return buffer;
}

static inline void scratch_write(const char *path, const char *text) {
  FILE *file = fopen(path, "wb");
  assert_non_null(file);
  fwrite(text, 1, strlen(text), file);
  assert_int_equal(fclose(file), 0);
}

/* a whole file, to be freed */
static inline char *read_whole(const char *path) {
  FILE *file = fopen(path, "rb");
  if (!file) print_error("%s does not exist\n", path);
  assert_non_null(file);
  assert_int_equal(fseek(file, 0, SEEK_END), 0);
  size_t length = (size_t)ftell(file);
  rewind(file);
  char *text = malloc(length + 1);
  assert_non_null(text);
  assert_int_equal(fread(text, 1, length, file), length);
  text[length] = '\0';
  fclose(file);
  return text;
}

/* the file holds exactly this text */
static inline void assert_file_equal(const char *path, const char *text) {
  char buffer[4096];
  FILE *file = fopen(path, "rb");
  if (!file) print_error("%s does not exist\n", path);
  assert_non_null(file);
  size_t length = fread(buffer, 1, sizeof buffer - 1, file);
  fclose(file);
  buffer[length] = '\0';
  assert_string_equal(buffer, text);
}

static inline int entries_in(const char *path) {
  int count = 0;
  DIR *stream = opendir(path);
  assert_non_null(stream);
  while (readdir(stream)) count++;
  closedir(stream);
  return count - 2;
}

#endif
