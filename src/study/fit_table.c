/* study/fit_table.c - what a fit found, as a table for people (fit.h). */
#include "study/fit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CELL = 40 };

/* a number in a column of its own, or a dash; a point whatever the locale */
static void append_cell(ambulo__text_buffer *text, double value, int width, int decimals) {
  char cell[CELL] = "-";
  if (isfinite(value)) {
    (void)snprintf(cell, sizeof cell, "%.*f", decimals, value);
    char *comma = strchr(cell, ',');
    if (comma) *comma = '.';
  }
  ambulo__text_append_format(text, " %*s", width, cell);
}

static int decimals_of(const ambulo__fit_target *t) {
  return t->entry->unit == AMBULO__UNIT_ANGLE ? 1 : 3;
}

static const ambulo__fit_score no_score = {(double)NAN, (double)NAN, (double)NAN,
                                           (double)NAN, (double)NAN, (double)NAN};

/* of a target, before and after; NaN where it is not known */
static void scores_of(const ambulo__fit_outcome *o, int condition, const ambulo__fit_target *t,
                      const ambulo__fit_score *scores[2]) {
  const ambulo__fit_trial *after = ambulo__fit_after(o, condition);
  scores[0] = &o->trial[AMBULO__FIT_FIRST].score[condition][t->curve];
  scores[1] = isnan(after->apart[condition]) ? &no_score : &after->score[condition][t->curve];
}

/* the beginning of a line: the condition, where it is its first one */
static void append_name(const ambulo_fit *fit, const ambulo__fit_condition *c,
                        const ambulo__fit_target *t, int is_first, ambulo__text_buffer *text) {
  ambulo__text_append_format(text, "%-12s %-28s %-7s", is_first ? c->name : "",
                             fit->curve[t->curve].name, ambulo__curve_unit_name(t->entry->unit));
}

static void append_curves(const ambulo__fit_outcome *o, ambulo__text_buffer *text) {
  const ambulo_fit *fit = o->fit;
  int any = 0;
  for (int c = 0; c < fit->conditions; c++) {
    const ambulo__fit_condition *condition = &fit->condition[c];
    for (int k = 0, lines = 0; k < condition->targets; k++) {
      const ambulo__fit_target *t = &condition->target[k];
      const ambulo__fit_score *s[2];
      if (fit->curve[t->curve].is_guard) continue;
      if (!any++)
        ambulo__text_append_format(text, "\n%-12s %-28s %-7s %8s %8s %9s %9s %7s %7s %7s %7s\n",
                                   "condition", "curve", "unit", "z", "after", "rmse", "after", "r",
                                   "after", "range", "after");
      scores_of(o, c, t, s);
      append_name(fit, condition, t, lines++ == 0, text);
      for (int i = 0; i < 2; i++) append_cell(text, s[i]->z, 8, 3);
      for (int i = 0; i < 2; i++) append_cell(text, s[i]->rmse, 9, decimals_of(t));
      for (int i = 0; i < 2; i++) append_cell(text, s[i]->r, 7, 3);
      for (int i = 0; i < 2; i++) append_cell(text, s[i]->ratio, 7, 2);
      ambulo__text_append_char(text, '\n');
    }
  }
}

static void append_guards(const ambulo__fit_outcome *o, ambulo__text_buffer *text) {
  const ambulo_fit *fit = o->fit;
  int any = 0;
  for (int c = 0; c < fit->conditions; c++) {
    const ambulo__fit_condition *condition = &fit->condition[c];
    for (int k = 0, lines = 0; k < condition->targets; k++) {
      const ambulo__fit_target *t = &condition->target[k];
      const ambulo__fit_curve *curve = &fit->curve[t->curve];
      const ambulo__fit_score *s[2];
      if (!curve->is_guard) continue;
      if (!any++)
        ambulo__text_append_format(text, "\n%-12s %-28s %-7s %8s %8s %9s %9s %9s %9s\n",
                                   "condition", "guard", "unit", "z", "after", "value", "after",
                                   "at least", "at most");
      scores_of(o, c, t, s);
      append_name(fit, condition, t, lines++ == 0, text);
      for (int i = 0; i < 2; i++) append_cell(text, s[i]->z, 8, 3);
      for (int i = 0; i < 2; i++) append_cell(text, s[i]->value, 9, decimals_of(t));
      for (int i = 0; i < 2; i++) append_cell(text, curve->bound[i], 9, decimals_of(t));
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
  append_guards(o, text);
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
