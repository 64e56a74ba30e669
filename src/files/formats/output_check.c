/* formats/output_check.c - see output_check.h. */
#include "formats/output_check.h"

#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST = 4096 };

int ambulo__file_says(const char *path, const char *text, size_t within) {
  char start[MOST + 1];
  size_t length = 0, wanted = within < MOST ? within : MOST;
  int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return 0;
  while (length < wanted) {
    ssize_t count = read(file, start + length, wanted - length);
    if (count <= 0) break;
    length += (size_t)count;
  }
  close(file);
  size_t size = strlen(text);
  for (size_t at = 0; at + size <= length; at++) {
    if (memcmp(start + at, text, size) == 0) return 1;
  }
  return 0;
}

/* tables of earlier versions began with their units */
static int is_own(const char *path) {
  static const char *const marks[] = {AMBULO__OWN_MARK, "# SI units and radians: time s; q rad"};
  for (int i = 0; i < 2; i++) {
    if (ambulo__file_says(path, marks[i], strlen(marks[i]))) return 1;
  }
  return 0;
}

ambulo_status ambulo__output_check(const char *output, const char *const *inputs, int count,
                                   int force, ambulo_diagnostics *diagnostics) {
  ambulo__place place = {.file = output};
  struct stat there, input;
  static const char hint[] = "give another name, or --force (in C: overwrite)";
  if (force || stat(output, &there) != 0 || !S_ISREG(there.st_mode)) return AMBULO_OK;
  for (int i = 0; i < count; i++) {
    if (!inputs[i] || stat(inputs[i], &input) != 0) continue;
    if (input.st_dev != there.st_dev || input.st_ino != there.st_ino) continue;
    return ambulo__error(diagnostics, AMBULO_E_IO, place, hint,
                         "the output is the input '%s' itself; it is not written over", inputs[i]);
  }
  if (there.st_size == 0 || is_own(output)) return AMBULO_OK;
  return ambulo__error(diagnostics, AMBULO_E_IO, place, hint,
                       "the file exists, and ambulo did not write it; it is not written over");
}
