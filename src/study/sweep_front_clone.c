/* study/sweep_front_clone.c - a front's sweep that may grow, while the caller's stays as it was
 * loaded (sweep.h). */
#include "study/sweep.h"

static char *copy(const ambulo_sweep *s, const char *text, ambulo_status *status) {
  char *made = text ? ambulo__strdup(&s->allocator, text) : NULL;
  if (text && !made) *status = AMBULO_E_MEMORY;
  return made;
}

static ambulo_status clone_axes(const ambulo_sweep *s, ambulo_sweep *c) {
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < s->axes && !status; i++) {
    ambulo__axis *axis = NULL;
    status = ambulo__sweep_add_axis(c, s->axis[i].name, s->axis[i].key, s->axis[i].spot, &axis);
  }
  return status;
}

static ambulo_status clone_outputs(const ambulo_sweep *s, ambulo_sweep *c) {
  ambulo_status status = AMBULO_OK;
  c->output = ambulo__alloc(&c->allocator, (size_t)s->outputs, sizeof *c->output);
  if (!c->output) return AMBULO_E_MEMORY;
  for (int i = 0; i < s->outputs; i++) {
    c->output[i].path = copy(c, s->output[i].path, &status);
    c->output[i].label = copy(c, s->output[i].label, &status);
    c->output[i].unit = copy(c, s->output[i].unit, &status);
    c->output[i].known_unit = s->output[i].known_unit;
    c->outputs++;
  }
  return status;
}

ambulo_status ambulo__sweep_clone_front(const ambulo_sweep *s, ambulo_sweep **clone) {
  ambulo_sweep *c = ambulo__alloc(&s->allocator, 1, sizeof *c);
  ambulo_status status = AMBULO_OK;
  if (!c) return AMBULO_E_MEMORY;
  c->allocator = s->allocator;
  c->chain_axis = -1;
  c->case_seconds = s->case_seconds;
  c->case_megabytes = s->case_megabytes;
  c->problem_hash = s->problem_hash;
  c->text_hash = s->text_hash;
  c->base_hash = s->base_hash;
  c->front = s->front;
  for (int i = 0; i < AMBULO__FRONT_TERMS; i++)
    c->front.name[i] = copy(c, s->front.name[i], &status);
  c->name = copy(c, s->name, &status);
  c->path = copy(c, s->path, &status);
  c->base = copy(c, s->base, &status);
  if (!status) status = clone_axes(s, c);
  if (!status) status = clone_outputs(s, c);
  c->stride = c->axes > 0 ? c->axes : 1;
  if (status) {
    ambulo_sweep_free(c);
  } else {
    *clone = c;
  }
  return status;
}
