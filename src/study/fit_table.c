/* study/fit_table.c - what a fit found, as a table for people (outcome.h). */
#include "study/fit_outcome.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CELL = 40 };

/* a number in a column of its own, or a dash; a point whatever the locale */
static void append_cell(ambulo__text_buffer *text, double value, int width, int decimals) {
  char cell[CELL] = "-";
  if (!isnan(value)) {
    (void)snprintf(cell, sizeof cell, "%.*f", decimals, value);
    char *comma = strchr(cell, ',');
    if (comma) *comma = '.';
  }
  ambulo__text_append_format(text, " %*s", width, cell);
}

static int decimals_of(const ambulo__fit_target *t) {
  return t->entry->unit == AMBULO__UNIT_ANGLE ? 1 : 3;
}

static void append_curves(const ambulo__fit_outcome *o, ambulo__text_buffer *text) {
  const ambulo_fit *fit = o->fit;
  ambulo__text_append_format(text, "\n%-12s %-28s %-7s %8s %8s %9s %9s %7s %7s %7s %7s\n",
                             "condition", "curve", "unit", "z", "after", "rmse", "after", "r",
                             "after", "range", "after");
  for (int c = 0; c < fit->conditions; c++) {
    const ambulo__fit_condition *condition = &fit->condition[c];
    const ambulo__fit_trial *first = &o->trial[AMBULO__FIT_FIRST], *after = ambulo__fit_after(o, c);
    for (int k = 0; k < condition->targets; k++) {
      const ambulo__fit_target *t = &condition->target[k];
      int at = c * fit->curves + t->curve, known = !isnan(after->apart[c]);
      const ambulo__fit_score none = {(double)NAN, (double)NAN, (double)NAN,
                                      (double)NAN, (double)NAN, (double)NAN};
      const ambulo__fit_score *s = &first->score[at], *e = known ? &after->score[at] : &none;
      ambulo__text_append_format(text, "%-12s %-28s %-7s", k == 0 ? condition->name : "",
                                 fit->curve[t->curve].name,
                                 ambulo__curve_unit_name(t->entry->unit));
      append_cell(text, s->z, 8, 3);
      append_cell(text, e->z, 8, 3);
      append_cell(text, s->rmse, 9, decimals_of(t));
      append_cell(text, e->rmse, 9, decimals_of(t));
      append_cell(text, s->r, 7, 3);
      append_cell(text, e->r, 7, 3);
      append_cell(text, s->ratio, 7, 2);
      append_cell(text, e->ratio, 7, 2);
      ambulo__text_append_char(text, '\n');
    }
  }
}

static void append_conditions(const ambulo__fit_outcome *o, ambulo__text_buffer *text) {
  ambulo__text_append_format(text, "\n%-12s %9s %9s %9s\n", "distance", "before", "after",
                             "from zero");
  for (int c = 0; c < o->fit->conditions; c++) {
    ambulo__text_append_format(text, "%-12s", o->fit->condition[c].name);
    append_cell(text, o->trial[AMBULO__FIT_FIRST].apart[c], 9, 4);
    append_cell(text, ambulo__fit_after(o, c)->apart[c], 9, 4);
    append_cell(text, o->trial[AMBULO__FIT_COLD].apart[c], 9, 4);
    ambulo__text_append(text, o->fit->condition[c].held_out ? "  held out\n" : "\n");
  }
  const ambulo__fit_trial *cold = &o->trial[AMBULO__FIT_COLD];
  ambulo__text_append_format(text, "%-12s", "fitted");
  append_cell(text, o->trial[AMBULO__FIT_FIRST].distance, 9, 4);
  append_cell(text, o->trial[AMBULO__FIT_BEST].distance, 9, 4);
  append_cell(text, cold->complete ? cold->distance : (double)NAN, 9, 4);
  ambulo__text_append_char(text, '\n');
}

static void append_parameters(const ambulo__fit_outcome *o, ambulo__text_buffer *text) {
  static const char *const bounds[] = {"  at its lower bound", "", "  at its upper bound"};
  ambulo__text_append_format(text, "\n%-24s %-7s %10s %12s %12s %12s\n", "parameter", "scale",
                             "change", "before", "after", "sensitivity");
  for (int i = 0; i < o->fit->parameters; i++) {
    const ambulo__fit_parameter *p = &o->fit->parameter[i];
    double u = o->trial[AMBULO__FIT_BEST].u[i], own = p->in_file[0];
    ambulo__text_append_format(text, "%-24s %-7s", p->name,
                               p->scale == AMBULO__FIT_LOG ? "times" : "plus");
    append_cell(text, ambulo__fit_change(p, u), 10, 4);
    append_cell(text, own, 12, 6);
    append_cell(text, isnan(own) ? own : ambulo__fit_value(p, own, u), 12, 6);
    append_cell(text, o->sensitivity[i], 12, 4);
    ambulo__text_append_format(text, "%s\n", bounds[ambulo__fit_bound(o, i) + 1]);
  }
}

void ambulo__fit_table(const ambulo__fit_outcome *o, ambulo__text_buffer *text) {
  append_curves(o, text);
  append_conditions(o, text);
  append_parameters(o, text);
  ambulo__text_append_format(text, "\nended by     %s after %d iterations",
                             ambulo__fit_ending_name(o->ending), o->entries - 1);
  if (o->stuck >= 0)
    ambulo__text_append_format(text, ": every solve of condition '%s' failed",
                               o->fit->condition[o->stuck].name);
  ambulo__text_append_format(text, "\nsolves       %d, %d of them without a valid solution\n",
                             o->runner->sweep->case_count, o->runner->progress.failed);
}
