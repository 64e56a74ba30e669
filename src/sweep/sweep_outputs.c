/* sweep/sweep_outputs.c - what is collected, and how drawings call it. */
#include "sweep/sweep.h"

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

ambulo_status ambulo__sweep_read_outputs(ambulo_sweep *s, const ambulo__yaml_node *node) {
  int items = ambulo__yaml_items(node);
  ambulo_status status = AMBULO_OK;
  s->output = ambulo__alloc(&s->allocator, (size_t)items, sizeof *s->output);
  if (!s->output) return AMBULO_E_MEMORY;
  for (int i = 0; i < items && !status; i++)
    status = read_output(s, ambulo__yaml_item(node, i), &s->output[s->outputs++]);
  return status;
}
