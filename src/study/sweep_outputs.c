/* study/sweep_outputs.c - what is collected, and how the table and drawings call it. */
#include "study/sweep.h"

#include <string.h>

ambulo_status ambulo__sweep_copy(ambulo_sweep *s, const ambulo__yaml_node *node, char **copy) {
  if (!node) return AMBULO_OK;
  *copy = ambulo__strdup(&s->allocator, ambulo__yaml_text(node));
  return *copy ? AMBULO_OK : AMBULO_E_MEMORY;
}

ambulo_status ambulo__sweep_read_label(ambulo_sweep *s, ambulo__axis *axis,
                                       const ambulo__yaml_node *node) {
  ambulo_status status = ambulo__sweep_copy(s, ambulo__yaml_get(node, "label"), &axis->label);
  return status ? status : ambulo__sweep_copy(s, ambulo__yaml_get(node, "unit"), &axis->unit);
}

/* a text, or {output, label, unit} */
static ambulo_status read_output(ambulo_sweep *s, const ambulo__yaml_node *node,
                                 ambulo__sweep_output *output) {
  int is_mapping = ambulo__yaml_is(node, AMBULO__YAML_MAPPING);
  const ambulo__yaml_node *path = is_mapping ? ambulo__yaml_require(node, "output") : node;
  ambulo_status status = path ? ambulo__sweep_copy(s, path, &output->path) : AMBULO_E_SCHEMA;
  if (!status && !output->path[0])
    status = ambulo__yaml_error(path, AMBULO_E_SCHEMA, NULL, "no output; expected one");
  if (!is_mapping) return status;
  if (!status) status = ambulo__sweep_copy(s, ambulo__yaml_get(node, "label"), &output->label);
  if (!status) status = ambulo__sweep_copy(s, ambulo__yaml_get(node, "unit"), &output->unit);
  return ambulo__sweep_close(node, status);
}

static const char *title_of(const ambulo__sweep_output *output) {
  return output->label ? output->label : output->path;
}

/* whether another column of the table has this title */
static int is_taken(const ambulo_sweep *s, const char *label, int own) {
  static const char *const words[] = {"id", "name", "state", "front", "place", "better"};
  for (size_t i = 0; i < (s->front.terms > 0 ? 6 : 3); i++)
    if (strcmp(words[i], label) == 0) return 1;
  for (int i = 0; i < s->axes; i++)
    if (strcmp(s->axis[i].name, label) == 0) return 1;
  for (int i = 0; i < s->front.terms; i++)
    if (strcmp(s->front.name[i], label) == 0) return 1;
  for (int i = 0; i < s->outputs; i++) {
    const ambulo__sweep_output *other = &s->output[i];
    if (i != own && (strcmp(title_of(other), label) == 0 || strcmp(other->path, label) == 0))
      return 1;
  }
  return 0;
}

static ambulo_status check_label(ambulo_sweep *s, const ambulo__yaml_node *node, int i) {
  const char *label = s->output[i].label;
  if (!label) return AMBULO_OK;
  const ambulo__yaml_node *at = ambulo__yaml_get(node, "label");
  if (!label[0])
    return ambulo__yaml_error(at, AMBULO_E_SCHEMA, NULL, "the label is empty; expected a text");
  if (!is_taken(s, label, i)) return AMBULO_OK;
  return ambulo__yaml_error(at, AMBULO_E_SCHEMA, NULL,
                            "the label '%s' is that of another column of the table; expected "
                            "another one",
                            label);
}

ambulo_status ambulo__sweep_read_outputs(ambulo_sweep *s, const ambulo__yaml_node *node) {
  int items = ambulo__yaml_items(node);
  ambulo_status status = AMBULO_OK;
  s->output = ambulo__alloc(&s->allocator, (size_t)items, sizeof *s->output);
  if (!s->output) return AMBULO_E_MEMORY;
  for (int i = 0; i < items && !status; i++)
    status = read_output(s, ambulo__yaml_item(node, i), &s->output[s->outputs++]);
  for (int i = 0; i < items && !status; i++) status = check_label(s, ambulo__yaml_item(node, i), i);
  return status;
}
