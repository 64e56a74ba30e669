/* study/fit_report.c - what a fit will do, in words, and what it found, as fit.json (schema:
 * docs/guide-fit.md; fit.h). Nothing in fit.json depends on the machine or on how often the fit was
 * stopped. */
#include "ambulo/tools/report.h"
#include "base/numtext.h"
#include "formats/json_text.h"
#include "study/batch.h"
#include "study/fit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { CANDIDATES = 5 /* of an iteration: four dampings, and one from zero */ };

/* ---------------------------------------------------------------- before the fit */

int ambulo__fit_expected(const ambulo_fit *fit) {
  int fitted = 0;
  for (int c = 0; c < fit->conditions; c++) fitted += !fit->condition[c].held_out;
  return 3 * fit->conditions - fitted + fit->iterations * (fit->parameters + CANDIDATES) * fitted;
}

static void describe_parameter(const ambulo_fit *fit, int i, ambulo__text_buffer *text) {
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

static void describe_condition(const ambulo_fit *fit, int i, ambulo__text_buffer *text) {
  const ambulo__fit_condition *c = &fit->condition[i];
  ambulo__text_append_format(text, "condition    %s%s, %s", c->name,
                             c->held_out ? ", held out" : "",
                             c->reference ? c->reference : "without reference");
  for (int k = 0; k < c->sets; k++) ambulo__text_append_format(text, ", %s", c->set[k]);
  ambulo__text_append_char(text, '\n');
  for (int k = 0; k < c->targets; k++) {
    const ambulo__fit_target *t = &c->target[k];
    const ambulo__fit_curve *curve = &fit->curve[t->curve];
    ambulo__text_append_format(text, "             %s: ", curve->name);
    if (!curve->is_guard) ambulo__text_append_format(text, "%d points", t->points);
    if (isfinite(curve->bound[0]))
      ambulo__text_append_format(text, "at least %s", ambulo__number_text(curve->bound[0]).text);
    if (isfinite(curve->bound[1]))
      ambulo__text_append_format(text, "%sat most %s", isfinite(curve->bound[0]) ? ", " : "",
                                 ambulo__number_text(curve->bound[1]).text);
    ambulo__text_append_format(text, ", deviation %s %s\n", ambulo__number_text(t->sd).text,
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
  for (int i = 0; i < fit->parameters; i++) describe_parameter(fit, i, &buffer);
  for (int i = 0; i < fit->conditions; i++) describe_condition(fit, i, &buffer);
  ambulo__text_append_format(&buffer, "residuals    %d\nsolves       about %d\n", fit->residuals,
                             ambulo__fit_expected(fit));
  ambulo_status status = ambulo__text_status(&buffer);
  char *copy = status ? NULL : ambulo__strdup(&buffer.allocator, ambulo__text_data(&buffer));
  if (!status && !copy) status = AMBULO_E_MEMORY;
  ambulo__text_free(&buffer);
  if (!status) *text = copy;
  return status;
}

/* ---------------------------------------------------------------- what was found */

const ambulo__fit_trial *ambulo__fit_after(const ambulo__fit_outcome *o, int condition) {
  return &o->trial[o->fit->condition[condition].held_out ? AMBULO__FIT_APART : AMBULO__FIT_BEST];
}

/* weighted mean of the held-out conditions' distances; NaN without any, or not evaluated */
static double held_out_distance(const ambulo__fit_outcome *o, int after) {
  double sum = 0.0, weights = 0.0;
  for (int c = 0; c < o->fit->conditions; c++) {
    const ambulo__fit_condition *condition = &o->fit->condition[c];
    const ambulo__fit_trial *t = after ? ambulo__fit_after(o, c) : &o->trial[AMBULO__FIT_FIRST];
    if (!condition->held_out) continue;
    sum += condition->weight * t->apart[c];
    weights += condition->weight;
  }
  return weights > 0.0 ? sum / weights : (double)NAN;
}

int ambulo__fit_bound(const ambulo__fit_outcome *o, int i) {
  const ambulo__fit_parameter *p = &o->fit->parameter[i];
  double u = o->trial[AMBULO__FIT_BEST].u[i], slack = 1e-6 * (p->upper - p->lower);
  if (u <= p->lower + slack) return -1;
  return u >= p->upper - slack;
}

const char *ambulo__fit_ending_name(ambulo_fit_ending ending) {
  static const char *const names[] = {[AMBULO_FIT_NOT_RUN] = "not_run",
                                      [AMBULO_FIT_CONVERGED] = "converged",
                                      [AMBULO_FIT_ITERATIONS] = "iterations",
                                      [AMBULO_FIT_INTERRUPTED] = "interrupted",
                                      [AMBULO_FIT_STUCK] = "stuck"};
  return names[ending];
}

/* ------------------------------------------------------------------------ JSON */

static void write_parameter(const ambulo__fit_outcome *o, int i, ambulo__json *json) {
  static const char *const bounds[] = {"lower", "none", "upper"};
  const ambulo__fit_parameter *p = &o->fit->parameter[i];
  double u = o->trial[AMBULO__FIT_BEST].u[i];
  ambulo__json_open(json, p->name, '{');
  ambulo__json_text(json, "scale", p->scale == AMBULO__FIT_LOG ? "log" : "linear");
  ambulo__json_number(json, "change", ambulo__fit_change(p, u));
  ambulo__json_number(json, "steps", u);
  ambulo__json_text(json, "at_bound", bounds[ambulo__fit_bound(o, i) + 1]);
  ambulo__json_number(json, "sensitivity", o->sensitivity[i]);
  ambulo__json_open(json, "keys", '{');
  for (int k = 0; k < p->keys; k++) {
    ambulo__json_open(json, p->key[k], '{');
    ambulo__json_number(json, "before", p->in_file[k]);
    ambulo__json_number(json, "after", ambulo__fit_value(p, p->in_file[k], u));
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, '}');
  ambulo__json_close(json, '}');
}

static void write_score(ambulo__json *json, const char *key, const ambulo__fit_score *s,
                        const ambulo__fit_curve *curve) {
  ambulo__json_open(json, key, '{');
  ambulo__json_number(json, "z", s->z);
  if (curve->of == AMBULO__FIT_CURVE) {
    ambulo__json_number(json, "rmse", s->rmse);
    ambulo__json_number(json, "r", s->r);
  } else {
    ambulo__json_number(json, "value", s->value);
  }
  if (curve->of != AMBULO__FIT_CURVE && !curve->is_guard)
    ambulo__json_number(json, "reference", s->reference);
  if (!curve->is_guard) ambulo__json_number(json, "range_ratio", s->ratio);
  ambulo__json_close(json, '}');
}

static void write_curves(const ambulo__fit_outcome *o, int index, ambulo__json *json) {
  const ambulo_fit *fit = o->fit;
  const ambulo__fit_condition *c = &fit->condition[index];
  const ambulo__fit_trial *after = ambulo__fit_after(o, index);
  ambulo__json_open(json, "curves", '{');
  for (int k = 0; k < c->targets; k++) {
    const ambulo__fit_target *t = &c->target[k];
    const ambulo__fit_curve *curve = &fit->curve[t->curve];
    ambulo__json_open(json, curve->name, '{');
    ambulo__json_text(json, "unit", ambulo__curve_unit_name(t->entry->unit));
    ambulo__json_number(json, "weight", curve->weight);
    ambulo__json_number(json, "sd", t->sd);
    if (isfinite(curve->bound[0])) ambulo__json_number(json, "at_least", curve->bound[0]);
    if (isfinite(curve->bound[1])) ambulo__json_number(json, "at_most", curve->bound[1]);
    write_score(json, "before", &o->trial[AMBULO__FIT_FIRST].score[index][t->curve], curve);
    if (!isnan(after->apart[index]))
      write_score(json, "after", &after->score[index][t->curve], curve);
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, '}');
}

/* "state": before, after, from_zero; "distance" alike; "result": the folder of the motion after */
static ambulo_status write_states(const ambulo__fit_outcome *o, int index, ambulo__json *json) {
  static const char *const keys[] = {"before", "after", "from_zero"};
  const ambulo__fit_trial *trials[] = {&o->trial[AMBULO__FIT_FIRST], ambulo__fit_after(o, index),
                                       &o->trial[AMBULO__FIT_COLD]};
  ambulo_status status = AMBULO_OK;
  ambulo__json_open(json, "distance", '{');
  for (int k = 0; k < 3; k++) ambulo__json_number(json, keys[k], trials[k]->apart[index]);
  ambulo__json_close(json, '}');
  ambulo__json_open(json, "state", '{');
  for (int k = 0; k < 3 && !status; k++) {
    char state[24];
    status = ambulo__fit_state(o->runner, trials[k]->index[index], state);
    if (!status) ambulo__json_text(json, keys[k], state);
  }
  ambulo__json_close(json, '}');
  int at = trials[1]->index[index];
  if (status || at < 0) return status;
  char *path =
      ambulo__case_path(o->runner->allocator, "solves", o->runner->sweep->cases[at].id, "");
  if (!path) return AMBULO_E_MEMORY;
  ambulo__json_text(json, "result", path);
  ambulo__free(o->runner->allocator, path);
  return AMBULO_OK;
}

static ambulo_status write_condition(const ambulo__fit_outcome *o, int index, ambulo__json *json) {
  const char **overrides = NULL;
  int count = 0;
  ambulo__json_open(json, o->fit->condition[index].name, '{');
  ambulo__json_integer(json, "held_out", o->fit->condition[index].held_out != 0);
  ambulo__json_number(json, "weight", o->fit->condition[index].weight);
  ambulo_status status = write_states(o, index, json);
  if (!status)
    status = ambulo__fit_overrides(o->fit, index, o->trial[AMBULO__FIT_BEST].u, &overrides, &count);
  ambulo__json_open(json, "settings", '[');
  for (int i = 0; i < count; i++) ambulo__json_text(json, NULL, overrides[i]);
  ambulo__json_close(json, ']');
  ambulo__free(&o->fit->allocator, (void *)overrides);
  write_curves(o, index, json);
  ambulo__json_close(json, '}');
  return status;
}

static void write_history(const ambulo__fit_outcome *o, ambulo__json *json) {
  ambulo__json_open(json, "history", '[');
  for (int i = 0; i < o->entries; i++) {
    const ambulo__fit_entry *e = &o->entry[i];
    ambulo__json_open(json, NULL, '{');
    ambulo__json_number(json, "distance", e->step.distance);
    ambulo__json_number(json, "cost", e->step.cost);
    ambulo__json_text(json, "accepted", e->step.accepted);
    ambulo__json_number(json, "damping", e->step.damping);
    ambulo__json_integer(json, "dropped", e->step.dropped);
    ambulo__json_integer(json, "solves", e->solves);
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, ']');
}

static void write_distance(const ambulo__fit_outcome *o, ambulo__json *json) {
  const ambulo__fit_trial *first = &o->trial[AMBULO__FIT_FIRST],
                          *best = &o->trial[AMBULO__FIT_BEST];
  const ambulo__fit_trial *cold = &o->trial[AMBULO__FIT_COLD];
  ambulo__json_open(json, "distance", '{');
  ambulo__json_number(json, "before", first->distance);
  ambulo__json_number(json, "after", best->distance);
  ambulo__json_number(json, "from_zero", cold->complete ? cold->distance : (double)NAN);
  ambulo__json_number(json, "cost_before", first->cost);
  ambulo__json_number(json, "cost_after", best->cost);
  ambulo__json_number(json, "held_out_before", held_out_distance(o, 0));
  ambulo__json_number(json, "held_out_after", held_out_distance(o, 1));
  ambulo__json_close(json, '}');
}

ambulo_status ambulo__fit_json(const ambulo__fit_outcome *o, ambulo__text_buffer *text) {
  ambulo__json json = {text, 0, 1};
  ambulo_versions versions;
  ambulo_versions_get(&versions);
  ambulo__json_open(&json, NULL, '{');
  ambulo__json_text(&json, "schema", "ambulo-fit/1");
  ambulo__json_text(&json, "name", o->fit->name);
  ambulo__json_text(&json, "version", versions.ambulo);
  ambulo__json_text(&json, "problem", o->fit->problem);
  ambulo__json_text(&json, "method", "gauss_newton");
  ambulo__json_text(&json, "ended_by", ambulo__fit_ending_name(o->ending));
  ambulo__json_text(&json, "stuck_condition",
                    o->stuck < 0 ? NULL : o->fit->condition[o->stuck].name);
  ambulo__json_integer(&json, "iterations", o->entries - 1);
  ambulo__json_integer(&json, "solves", o->runner->sweep->case_count);
  ambulo__json_integer(&json, "failed_solves", o->runner->progress.failed);
  write_distance(o, &json);
  ambulo__json_open(&json, "parameters", '{');
  for (int i = 0; i < o->fit->parameters; i++) write_parameter(o, i, &json);
  ambulo__json_close(&json, '}');
  ambulo_status status = AMBULO_OK;
  ambulo__json_open(&json, "conditions", '{');
  for (int c = 0; c < o->fit->conditions && !status; c++) status = write_condition(o, c, &json);
  ambulo__json_close(&json, '}');
  write_history(o, &json);
  ambulo__json_close(&json, '}');
  ambulo__text_append_char(text, '\n');
  return status ? status : ambulo__text_status(text);
}
