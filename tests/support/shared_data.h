/* tests/support/shared_data.h - reference curves that are not part of the project. */
#ifndef AMBULO_TESTS_SHARED_DATA_H
#define AMBULO_TESTS_SHARED_DATA_H

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#ifndef AMBULO_SOURCE_DIR
#define AMBULO_SOURCE_DIR "."
#endif

/* Path of a reference file: in $AMBULO_SHARED_DATA, else in ../shared/data beside the
 * checkout; 0 when it is not there. */
static inline int shared_data_path(const char *name, char *path, size_t size) {
  const char *folder = getenv("AMBULO_SHARED_DATA");
  if (folder) {
    snprintf(path, size, "%s/%s", folder, name);
  } else {
    snprintf(path, size, "%s/../shared/data/%s", AMBULO_SOURCE_DIR, name);
  }
  return access(path, R_OK) == 0;
}

#endif
