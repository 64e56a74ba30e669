/* study/case_path.c - see case_path.h. */
#include "study/case_path.h"
#include "formats/paths.h"

#include <string.h>

char *ambulo__case_path(const ambulo_allocator *a, const char *directory, const char *id,
                        const char *ending) {
  size_t length = strlen(id);
  char fan[3] = {'0', '0', '\0'};
  if (length >= 2) memcpy(fan, id + length - 2, 2);
  const char *part[] = {directory, "/cases/", fan, "/", id, ending};
  return ambulo__join_parts(a, part, 6);
}
