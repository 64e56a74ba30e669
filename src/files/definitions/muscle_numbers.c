/* definitions/muscle_numbers.c - numbers of single muscles that a problem file gives: soleus_r:
 * {force: 4000}, in `muscles`.
 *
 * They are those of the person, N and m, in place of what the muscles file, the size of the body
 * and factors of strength have come to. All else stays as it is, strains of tendons too.
 */
#include "definitions/muscle_reader.h"

#include <string.h>

static void read_number(const ambulo__yaml_node *item, const char *key, double least, double most,
                        int bit, double *number, unsigned char *fixed) {
  const ambulo__yaml_node *node = ambulo__yaml_get(item, key);
  if (!node) return;
  *number = ambulo__yaml_number_in(node, least, most, *number);
  *fixed |= (unsigned char)bit;
}

void ambulo__muscle_numbers(ambulo__muscle_reader *r, const ambulo__yaml_node *section) {
  int pairs = ambulo__yaml_pairs(section), all = r->count * (r->suffix[0] ? 2 : 1);
  for (int pair = 0; pair < pairs; pair++)
    for (int i = 0; i < all; i++) {
      ambulo_muscle *m = &r->muscles[i];
      if (strcmp(ambulo__yaml_key(section, pair), m->name) != 0) continue;
      const ambulo__yaml_node *item = ambulo__yaml_get(section, m->name);
      read_number(item, "force", 1e-6, 1e6, AMBULO__FIXED_FORCE, &m->force, &r->fixed[i]);
      read_number(item, "fiber", 1e-6, 2.0, AMBULO__FIXED_FIBER, &m->fiber, &r->fixed[i]);
      read_number(item, "tendon", 0.0, 2.0, AMBULO__FIXED_TENDON, &m->tendon, &r->fixed[i]);
      ambulo__yaml_close(item);
    }
}
