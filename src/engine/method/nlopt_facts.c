/* method/nlopt_facts.c - see nlopt_facts.h. */
#include "method/nlopt_facts.h"

#include <nlopt.h>
#include <stdlib.h>

const char *ambulo__nlopt_name(int result) {
  const char *name = nlopt_result_to_string((nlopt_result)result);
  return name ? name : "unknown result";
}

/* glibc keeps freed blocks of up to 1032 bytes for requests of their own size class; larger ones
 * are cut up for whatever comes next. So every block asked for here is larger than that. */
enum { BLOCKS = 4 };
static const size_t smallest = 4096; /* bytes: more than NLopt's options, and than is cached */

int ambulo__nlopt_can_copy(unsigned n) {
  void *block[BLOCKS];
  int all = 1;
  for (int i = 0; i < BLOCKS; i++) {
    size_t size = (size_t)n * sizeof(double) + smallest;
    block[i] = malloc(i == 0 ? smallest : size);
    all = all && block[i];
  }
  for (int i = 0; i < BLOCKS; i++) free(block[i]);
  return all;
}
