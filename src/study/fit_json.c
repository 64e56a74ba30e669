/* study/fit_json.c - fit.json (outcome.h; schema: docs/guide-fit.md). Nothing in it depends on the
 * machine or on how often the fit was stopped. */
#include "ambulo/tools/report.h"
#include "study/case_path.h"
#include "study/fit_outcome.h"
#include "formats/json_text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void write_boolean(ambulo__json *json, const char *key, int value) {
  ambulo__json_integer(json, key, value != 0);
}

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
                        int is_curve) {
  ambulo__json_open(json, key, '{');
  ambulo__json_number(json, "z", s->z);
  if (is_curve) {
    ambulo__json_number(json, "rmse", s->rmse);
    ambulo__json_number(json, "r", s->r);
  } else {
    ambulo__json_number(json, "value", s->value);
    ambulo__json_number(json, "reference", s->reference);
  }
  ambulo__json_number(json, "range_ratio", s->ratio);
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
    int at = index * fit->curves + t->curve, is_curve = curve->of == AMBULO__FIT_CURVE;
    ambulo__json_open(json, curve->name, '{');
    ambulo__json_text(json, "unit", ambulo__curve_unit_name(t->entry->unit));
    ambulo__json_number(json, "weight", curve->weight);
    ambulo__json_number(json, "sd", t->sd);
    write_score(json, "before", &o->trial[AMBULO__FIT_FIRST].score[at], is_curve);
    if (!isnan(after->apart[index])) write_score(json, "after", &after->score[at], is_curve);
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
  write_boolean(json, "held_out", o->fit->condition[index].held_out);
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
  ambulo__json_number(json, "held_out_before", ambulo__fit_held_out(o, 0));
  ambulo__json_number(json, "held_out_after", ambulo__fit_held_out(o, 1));
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
