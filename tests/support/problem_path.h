/* tests/support/problem_path.h - the file of a named problem: of models/, or with "two_step/"
 * before its name one of tests/two_step/, the walks and bodies with the prescribed split of the
 * load. Those stay as they are, whatever becomes of the shipped ones: tests of the engine hold
 * numbers of them. */
#ifndef AMBULO_TESTS_PROBLEM_PATH_H
#define AMBULO_TESTS_PROBLEM_PATH_H

#include <stdio.h>
#include <string.h>

static inline const char *problem_path(const char *name, char *path, size_t size) {
  int kept = strncmp(name, "two_step/", 9) == 0;
  (void)snprintf(path, size, "%s/%s.yaml", kept ? "tests" : "models", name);
  return path;
}

#endif
