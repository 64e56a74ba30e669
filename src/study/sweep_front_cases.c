/* study/sweep_front_cases.c - the cases of a front: they grow while it is computed (sweep.h).
 *
 * Point k of the front is case k of the list. A point is named by its place in the list, an anchor
 * by the term that it has least of. */
#include "base/numtext.h"
#include "study/sweep.h"

#include <stdio.h>
#include <string.h>

/* whether a case is an anchor of this term */
static int is_anchor(const char *name, const char *term) {
  static const char lead[] = "least ";
  size_t length = strlen(term);
  if (strncmp(name, lead, sizeof lead - 1) != 0) return 0;
  name += sizeof lead - 1;
  return strncmp(name, term, length) == 0 && (!name[length] || name[length] == ',');
}

static void name_point(const ambulo_sweep *s, const ambulo__front_request *request,
                       char name[AMBULO__SWEEP_TEXT]) {
  int again = 0;
  for (int k = 0; k < s->case_count && request->anchor >= 0; k++)
    again += is_anchor(s->cases[k].name, s->front.name[request->anchor]);
  if (request->anchor >= 0 && again > 0) {
    (void)snprintf(name, AMBULO__SWEEP_TEXT, "least %.200s, %d", s->front.name[request->anchor],
                   again + 1);
  } else if (request->anchor >= 0) {
    (void)snprintf(name, AMBULO__SWEEP_TEXT, "least %.200s", s->front.name[request->anchor]);
  } else if (request->from >= 0 && !s->front.neighbour) {
    (void)snprintf(name, AMBULO__SWEEP_TEXT, "%d from %d", s->case_count + 1, request->from + 1);
  } else {
    (void)snprintf(name, AMBULO__SWEEP_TEXT, "%d", s->case_count + 1);
  }
}

/* the axes' values of a case that was appended */
static ambulo_status set_values(ambulo_sweep *s, const ambulo__front_request *request, int index) {
  int *value = ambulo__realloc(&s->allocator, s->value,
                               (size_t)s->case_capacity * (size_t)s->stride, sizeof *value);
  if (!value) return AMBULO_E_MEMORY;
  s->value = value;
  for (int i = 0; i < s->axes; i++) {
    ambulo__axis *axis = &s->axis[i];
    ambulo_status status = ambulo__axis_add_number(s, axis, request->weight[i], axis->spot);
    if (status) return status;
    value[(size_t)index * (size_t)s->stride + (size_t)i] = axis->count - 1;
  }
  return AMBULO_OK;
}

ambulo_status ambulo__sweep_append_point(ambulo_sweep *s, const ambulo__front_request *request,
                                         ambulo_diagnostics *diagnostics, int *index) {
  char text[AMBULO__FRONT_TERMS][AMBULO__NUMTEXT_SIZE + 64], name[AMBULO__SWEEP_TEXT];
  const char *overrides[AMBULO__FRONT_TERMS];
  int before = s->case_count;
  for (int i = 0; i < s->axes; i++) {
    char number[AMBULO__NUMTEXT_SIZE];
    (void)ambulo__print_double(number, request->weight[i]);
    (void)snprintf(text[i], sizeof text[i], "%.48s=%s", s->axis[i].key, number);
    overrides[i] = text[i];
  }
  name_point(s, request, name);
  ambulo_status status =
      ambulo__sweep_append(s, name, overrides, s->axes, request->from, diagnostics, index);
  if (!status && *index == before) status = set_values(s, request, *index);
  return status;
}
