/* tests/support/problem_path.h - the file of a named problem: of models/, or with "support/" before
 * its name one of tests/support/. */
#ifndef AMBULO_TESTS_PROBLEM_PATH_H
#define AMBULO_TESTS_PROBLEM_PATH_H

#include <stdio.h>
#include <string.h>

static inline const char *problem_path(const char *name, char *path, size_t size) {
  int of_tests = strncmp(name, "support/", 8) == 0;
  (void)snprintf(path, size, "%s/%s.yaml", of_tests ? "tests" : "models", name);
  return path;
}

#endif
