/* study/fit_describe.c - what was understood of a fit file, before anything is solved. */
#include "base/numtext.h"
#include "study/fit_outcome.h"

#include <math.h>
#include <stdio.h>

static void append_parameter(const ambulo_fit *fit, int i, ambulo__text_buffer *text) {
  const ambulo__fit_parameter *p = &fit->parameter[i];
  ambulo__text_append_format(text, "parameter    %s, %s ", p->name,
                             p->scale == AMBULO__FIT_LOG ? "times" : "plus");
  ambulo__text_append_number(text, p->range[0]);
  ambulo__text_append(text, " to ");
  ambulo__text_append_number(text, p->range[1]);
  ambulo__text_append_char(text, '\n');
  for (int k = 0; k < p->keys; k++) {
    ambulo__text_append_format(text, "             %s: ", p->key[k]);
    if (isnan(p->in_file[k]))
      ambulo__text_append(text, "set by conditions alone");
    else
      ambulo__text_append_number(text, p->in_file[k]);
    ambulo__text_append_char(text, '\n');
  }
}

static void append_condition(const ambulo_fit *fit, int i, ambulo__text_buffer *text) {
  const ambulo__fit_condition *c = &fit->condition[i];
  ambulo__text_append_format(text, "condition    %s%s, %s", c->name,
                             c->held_out ? ", held out" : "", c->reference);
  for (int k = 0; k < c->sets; k++) ambulo__text_append_format(text, ", %s", c->set[k]);
  ambulo__text_append_char(text, '\n');
  for (int k = 0; k < c->targets; k++) {
    const ambulo__fit_target *t = &c->target[k];
    ambulo__text_append_format(text, "             %s: %d points, deviation ",
                               fit->curve[t->curve].name, t->points);
    ambulo__text_append_format(text, "%s %s\n", ambulo__number_text(t->sd).text,
                               ambulo__curve_unit_name(t->entry->unit));
  }
}

ambulo_status ambulo_fit_describe(const ambulo_fit *fit, const ambulo_allocator *allocator,
                                  char **text) {
  if (!fit || !text) return AMBULO_E_ARGUMENT;
  ambulo__text_buffer buffer;
  ambulo__text_init(&buffer, allocator);
  ambulo__text_append_format(&buffer, "fit          %s\nproblem      %s\n", fit->name,
                             fit->problem);
  for (int i = 0; i < fit->parameters; i++) append_parameter(fit, i, &buffer);
  for (int i = 0; i < fit->conditions; i++) append_condition(fit, i, &buffer);
  ambulo__text_append_format(&buffer, "residuals    %d\nsolves       about %d\n", fit->residuals,
                             ambulo__fit_expected(fit));
  ambulo_status status = ambulo__text_status(&buffer);
  char *copy = status ? NULL : ambulo__strdup(&buffer.allocator, ambulo__text_data(&buffer));
  if (!status && !copy) status = AMBULO_E_MEMORY;
  ambulo__text_free(&buffer);
  if (!status) *text = copy;
  return status;
}
