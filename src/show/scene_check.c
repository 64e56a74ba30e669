/* show/scene_check.c - whether a scene that is read back can be shown (page.h).
 *
 * A page counts in what it is given: a text where a number belongs, a time without end or a million
 * samples would keep it busy for ever. So only what show/scene.c writes is let in: texts under the
 * keys of names, numbers everywhere else. */
#include "show/page.h"

#include <math.h>
#include <string.h>

enum { LEAST_SAMPLES = 2, MOST_SAMPLES = 100000 };
static const double longest = 1e6; /* s */

static int is_text_key(const char *key) {
  static const char *const keys[] = {
      "schema", "problem", "model", "input_hash", "name",  "kind", "side",     "unit",
      "shape",  "point",   "mode",  "people",     "group", "link", "vertices", "triangles"};
  for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
    if (strcmp(key, keys[i]) == 0) return 1;
  return 0;
}

/* `key`: of the mapping that it stands in, or that its list does */
static void check_node(const ambulo__yaml_node *node, const char *key) {
  if (ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) {
    for (int i = 0; i < ambulo__yaml_pairs(node); i++)
      check_node(ambulo__yaml_value(node, i), ambulo__yaml_key(node, i));
  } else if (ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE)) {
    for (int i = 0; i < ambulo__yaml_items(node); i++) check_node(ambulo__yaml_item(node, i), key);
  } else if (!is_text_key(key) && strcmp(ambulo__yaml_text(node), "null") != 0) {
    (void)ambulo__yaml_number(node, 0.0);
  }
}

void ambulo__page_check_scene(const ambulo__yaml_node *root) {
  const ambulo__yaml_node *units = ambulo__yaml_get(root, "units");
  const ambulo__yaml_node *samples = ambulo__yaml_get(root, "samples");
  const ambulo__yaml_node *duration = ambulo__yaml_get(root, "duration");
  if (samples) (void)ambulo__yaml_integer(samples, LEAST_SAMPLES, MOST_SAMPLES, LEAST_SAMPLES);
  if (duration) (void)ambulo__yaml_number_in(duration, 1e-9, longest, 1.0);
  for (int i = 0; ambulo__yaml_is(units, AMBULO__YAML_MAPPING) && i < ambulo__yaml_pairs(units);
       i++)
    (void)ambulo__yaml_number_in(ambulo__yaml_value(units, i), 1e-12, 1e12, 1.0);
  check_node(root, "");
}
