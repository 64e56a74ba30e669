/* definitions/problem_holds.c - what hands hold: items of `load` with `hands`. */
#include "definitions/problem_reader.h"

#include <string.h>

static void read_hands(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                       ambulo_hold *hold) {
  int count = ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE) ? ambulo__yaml_items(node) : 0;
  if (count < 1 || count > 2) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "'hands' is not a list of one or two points of the model");
    return;
  }
  for (int i = 0; i < count; i++)
    hold->hand[i] = ambulo__read_name_of(reader, ambulo__yaml_item(node, i), AMBULO__NAMED_POINT);
}

/* behind those that are there; NULL without memory */
static ambulo_hold *add_hold(ambulo__problem_reader *reader) {
  ambulo_problem_definition *d = &reader->definition;
  size_t count = (size_t)d->hold_count;
  ambulo_hold *holds = ambulo__reader_alloc(reader, count + 1, sizeof *holds);
  if (!holds) return NULL;
  if (count > 0) memcpy(holds, d->holds, count * sizeof *holds);
  holds[count] = ambulo_hold_default();
  d->holds = holds;
  d->hold_count++;
  return &holds[count];
}

void ambulo__read_hold(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  ambulo_hold *hold = add_hold(reader);
  if (!hold) return;
  const ambulo__yaml_node *name = ambulo__yaml_get(section, "name");
  hold->name = name ? ambulo__yaml_name(name) : "load";
  read_hands(reader, ambulo__yaml_get(section, "hands"), hold);
  ambulo__read_members(reader, section, &ambulo__hold_members, "", hold);
  ambulo__yaml_close(section);
}
