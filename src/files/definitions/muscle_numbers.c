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

static void read_item(const ambulo__yaml_node *item, ambulo_muscle *m, unsigned char *fixed) {
  read_number(item, "force", 1e-6, 1e6, AMBULO__FIXED_FORCE, &m->force, fixed);
  read_number(item, "fiber", 1e-6, 2.0, AMBULO__FIXED_FIBER, &m->fiber, fixed);
  read_number(item, "tendon", 0.0, 2.0, AMBULO__FIXED_TENDON, &m->tendon, fixed);
  ambulo__yaml_close(item);
}

/* names: the section's own keys, then muscles */
enum { KEYS = 2 };

void ambulo__muscle_numbers(ambulo__muscle_reader *r, const ambulo__yaml_node *section) {
  int pairs = ambulo__yaml_pairs(section), all = r->count * (r->suffix[0] ? 2 : 1) + KEYS;
  const char **names = ambulo__arena_take(&r->arena, (size_t)all, sizeof *names);
  if (pairs == 0 || !names) return;
  names[0] = "file";
  names[1] = "strength";
  for (int i = KEYS; i < all; i++) names[i] = r->muscles[i - KEYS].name;
  for (int pair = 0; pair < pairs; pair++) {
    const char *key = ambulo__yaml_key(section, pair);
    const ambulo__yaml_node *item = ambulo__yaml_get(section, key);
    const char *nearest = ambulo__nearest(key, names, (size_t)all);
    int i = 0;
    while (i < all && strcmp(names[i], key) != 0) i++;
    if (i >= KEYS && i < all) read_item(item, &r->muscles[i - KEYS], &r->fixed[i - KEYS]);
    if (i == all)
      (void)ambulo__yaml_error(item, AMBULO_E_SCHEMA,
                               nearest
                                   ? ambulo__arena_print(&r->arena, "did you mean '%s'?", nearest)
                                   : "expected 'file', 'strength' or the name of a muscle",
                               "unknown key '%s' in muscles", key);
  }
}
