/* show/summary_json.c - verdict, objective, audit, sizes, effort and versions as JSON.
 *
 * Schema "ambulo-summary/1"; SI units and radians. A row is named by family, subject and detail;
 * violations are >= 0 in the unit given beside them. */
#include "solver/result.h"
#include "show/summary_json.h"

#include "ambulo/parameters.h"
#include "ambulo/tools/load.h"
#include "formats/inputs.h"
#include "base/arithmetic.h"
#include "formats/json_text.h"
#include "people/body_joints.h"
#include "people/stride.h"

#include <math.h>
#include <string.h>

static void objective(ambulo__json *json, const ambulo_problem *problem,
                      const ambulo_result *result) {
  const double *terms = ambulo_result_terms(result);
  ambulo__json_open(json, "objective", '{');
  ambulo__json_number(json, "total", ambulo_result_objective(result));
  ambulo__json_open(json, "terms", '{');
  for (int i = 0; i < ambulo_problem_term_count(problem); i++)
    ambulo__json_number(json, ambulo_problem_term_name(problem, i), terms[i]);
  ambulo__json_close(json, '}');
  ambulo__json_close(json, '}');
}

static void violation_members(ambulo__json *json, const ambulo_violation *v) {
  ambulo__json_number(json, "worst", v->worst);
  ambulo__json_text(json, "unit", v->unit);
  ambulo__json_number(json, "size", v->size);
  ambulo__json_text(json, "family", v->family);
  ambulo__json_text(json, "row", v->subject);
  ambulo__json_text(json, "detail", v->detail);
  ambulo__json_number(json, "time", v->time);
}

static void violation(ambulo__json *json, const char *key, const ambulo_violation *v) {
  ambulo__json_open(json, key, '{');
  violation_members(json, v);
  ambulo__json_close(json, '}');
}

static void audit(ambulo__json *json, const ambulo_result *result) {
  const ambulo_audit *a = ambulo_result_audit(result);
  char fault[640];
  ambulo_fault_text(&a->fault, fault, sizeof fault);
  ambulo__json_open(json, "audit", '{');
  violation(json, "violation", &a->violation);
  violation(json, "dense_violation", &a->dense_violation);
  ambulo__json_number(json, "kkt", a->kkt);
  ambulo__json_number(json, "complementarity", a->complementarity);
  ambulo__json_integer(json, "active_rows", a->active_rows);
  ambulo__json_integer(json, "rank", a->rank);
  ambulo__json_integer(json, "dropped_equalities", a->dropped_equalities);
  ambulo__json_integer(json, "at_lower_bound", a->at_lower_bound);
  ambulo__json_text(json, "fault", a->fault.kind == AMBULO_FAULT_NONE ? NULL : fault);
  ambulo__json_close(json, '}');
  ambulo__json_open(json, "families", '[');
  for (int i = 0; i < ambulo_result_family_count(result); i++)
    violation(json, NULL, ambulo_result_family(result, i));
  ambulo__json_close(json, ']');
}

static void dense_family(ambulo__json *json, const ambulo_dense_family *f) {
  ambulo__json_open(json, NULL, '{');
  violation_members(json, &f->violation);
  ambulo__json_number(json, "tolerance", f->tolerance);
  ambulo__json_integer(json, "holds", f->holds);
  ambulo__json_text(json, "settings", f->settings);
  ambulo__json_text(json, "advice", f->advice);
  ambulo__json_close(json, '}');
}

static void overlap(ambulo__json *json, const ambulo_overlap *o) {
  ambulo__json_open(json, NULL, '{');
  ambulo__json_text(json, "one", o->one);
  ambulo__json_text(json, "other", o->other);
  ambulo__json_number(json, "mm", 1e3 * o->depth);
  ambulo__json_number(json, "time", o->time);
  ambulo__json_close(json, '}');
}

static void between_nodes(ambulo__json *json, const ambulo_result *result) {
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(result);
  if (!dense) return;
  ambulo__json_open(json, "between_nodes", '{');
  ambulo__json_integer(json, "samples", dense->samples);
  ambulo__json_integer(json, "holds", dense->samples > 0 && dense->failing == 0);
  ambulo__json_integer(json, "failing", dense->failing);
  ambulo__json_text(json, "summary", dense->summary);
  ambulo__json_text(json, "reason", dense->reason);
  ambulo__json_integer(json, "intervals", dense->intervals);
  ambulo__json_integer(json, "trajectory_intervals", dense->spline_intervals);
  ambulo__json_open(json, "families", '[');
  for (int i = 0; i < dense->family_count; i++) dense_family(json, &dense->families[i]);
  ambulo__json_close(json, ']');
  ambulo__json_open(json, "overlaps", '[');
  for (int i = 0; i < dense->overlap_count; i++) overlap(json, &dense->overlaps[i]);
  ambulo__json_close(json, ']');
  ambulo__json_close(json, '}');
}

static void sensitivity(ambulo__json *json, const ambulo_sensitivity *s) {
  ambulo__json_open(json, NULL, '{');
  ambulo__json_text(json, "name", s->name);
  if (s->with[0]) {
    ambulo__json_text(json, "with", s->with);
    ambulo__json_number(json, "with_sign", s->with_sign);
  }
  ambulo__json_text(json, "unit", s->unit);
  ambulo__json_number(json, "value", s->value);
  ambulo__json_number(json, "file_value", s->file_value);
  ambulo__json_number(json, "derivative", s->derivative);
  ambulo__json_number(json, "error", s->error);
  ambulo__json_number(json, "step", s->step);
  ambulo__json_number(json, "share", s->share);
  ambulo__json_text(json, "words", s->words);
  ambulo__json_close(json, '}');
}

/* how the objective changes with every number of the problem, or why that is not known */
static void list_sensitivities(ambulo__json *json, const ambulo_sensitivity_list *list) {
  const ambulo_sensitivity_list none = {.reason =
                                            "not asked for; ambulo solve --sensitivities has them"};
  if (!list) list = &none;
  ambulo__json_open(json, "sensitivities", '[');
  for (int i = 0; i < list->count; i++) sensitivity(json, &list->items[i]);
  ambulo__json_close(json, ']');
  ambulo__json_text(json, "no_sensitivities", list->reason[0] ? list->reason : NULL);
}

/* what became of the numbers that were free; nothing where none was */
static void free_parameters(ambulo__json *json, const ambulo_result *result) {
  static const char *const bounds[] = {[AMBULO_AT_LOWER] = "lower", [AMBULO_AT_UPPER] = "upper"};
  const ambulo_parameters_outcome *o = ambulo_result_parameters(result);
  if (!o) return;
  ambulo__json_open(json, "free", '{');
  ambulo__json_text(json, "per", o->per == AMBULO_PER_DISTANCE ? "distance" : "none");
  ambulo__json_number(json, "distance", o->distance);
  ambulo__json_number(json, "objective", o->objective);
  ambulo__json_number(json, "first_objective", o->first);
  ambulo__json_open(json, "parameters", '[');
  for (int i = 0; i < o->count; i++) {
    const ambulo_parameter_value *p = &o->items[i];
    ambulo__json_open(json, NULL, '{');
    ambulo__json_text(json, "name", p->name);
    ambulo__json_text(json, "unit", p->unit);
    ambulo__json_number(json, "value", p->value);
    ambulo__json_number(json, "lower", p->lower);
    ambulo__json_number(json, "upper", p->upper);
    ambulo__json_number(json, "first", p->first);
    ambulo__json_number(json, "derivative", p->derivative);
    ambulo__json_text(json, "at_bound", bounds[p->bound]);
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, ']');
  ambulo__json_integer(json, "converged", o->converged);
  ambulo__json_text(json, "ending", o->ending);
  ambulo__json_integer(json, "solves", o->solves);
  ambulo__json_integer(json, "failed", o->failed);
  ambulo__json_integer(json, "evaluations", o->evaluations);
  ambulo__json_number(json, "seconds", o->seconds);
  ambulo__json_close(json, '}');
}

static void conflict(ambulo__json *json, const ambulo_conflict *c) {
  static const char *const answers[] = {"not tried", "no", "yes"};
  ambulo__json_open(json, NULL, '{');
  violation(json, "shared", &c->shared);
  ambulo__json_text(json, "alone", answers[c->alone + 1]);
  if (c->alone == 1) {
    violation(json, "relaxation", &c->relaxation);
    ambulo__json_open(json, "others", '[');
    for (int i = 0; i < c->other_count; i++) violation(json, NULL, &c->others[i]);
    ambulo__json_close(json, ']');
  }
  ambulo__json_close(json, '}');
}

static void on_limit(ambulo__json *json, const ambulo_on_limit *l) {
  ambulo__json_open(json, NULL, '{');
  ambulo__json_text(json, "family", l->family);
  ambulo__json_text(json, "row", l->subject);
  ambulo__json_text(json, "detail", l->detail);
  ambulo__json_number(json, "bound", l->bound);
  ambulo__json_text(json, "unit", l->unit);
  ambulo__json_number(json, "from", l->from);
  ambulo__json_number(json, "to", l->to);
  ambulo__json_integer(json, "nodes", l->nodes);
  ambulo__json_close(json, '}');
}

static void explanation(ambulo__json *json, const ambulo_result *result) {
  const ambulo_explanation *e = ambulo_result_explanation(result);
  if (!e) return;
  ambulo__json_open(json, "explanation", '{');
  ambulo__json_integer(json, "complete", e->complete);
  ambulo__json_integer(json, "confirmed", e->confirmed);
  ambulo__json_integer(json, "feasible_point", e->feasible_point);
  ambulo__json_text(json, "suggestion", e->suggestion);
  ambulo__json_open(json, "settings", '[');
  for (int i = 0; i < e->setting_count; i++) ambulo__json_text(json, NULL, e->settings[i]);
  ambulo__json_close(json, ']');
  ambulo__json_open(json, "lines", '[');
  for (int i = 0; i < e->line_count; i++) ambulo__json_text(json, NULL, e->lines[i]);
  ambulo__json_close(json, ']');
  ambulo__json_open(json, "contradictory", '[');
  for (int i = 0; i < e->contradictory_count; i++) violation(json, NULL, &e->contradictory[i]);
  ambulo__json_close(json, ']');
  ambulo__json_open(json, "conflicts", '[');
  for (int i = 0; i < e->conflict_count; i++) conflict(json, &e->conflicts[i]);
  ambulo__json_close(json, ']');
  ambulo__json_open(json, "on_limits", '[');
  for (int i = 0; i < e->on_limit_count; i++) on_limit(json, &e->on_limits[i]);
  ambulo__json_close(json, ']');
  ambulo__json_close(json, '}');
}

static void sizes(ambulo__json *json, const ambulo_problem *problem) {
  int rows = ambulo_problem_row_count(problem);
  int equalities = ambulo_problem_equality_count(problem);
  const ambulo_model *model = ambulo_problem_model(problem);
  ambulo__json_open(json, "sizes", '{');
  ambulo__json_integer(json, "coordinates", ambulo_model_coordinate_count(model));
  ambulo__json_integer(json, "variables", ambulo_problem_variable_count(problem));
  ambulo__json_integer(json, "equalities", equalities);
  ambulo__json_integer(json, "inequalities", rows - equalities);
  ambulo__json_integer(json, "nodes", ambulo_problem_node_count(problem));
  ambulo__json_close(json, '}');
}

static void vector(ambulo__json *json, const char *key, const double value[3]) {
  ambulo__json_open(json, key, '[');
  for (int i = 0; i < 3; i++) ambulo__json_number(json, NULL, value[i]);
  ambulo__json_close(json, ']');
}

/* those that the body calls or counts otherwise than people do */
static void joints(ambulo__json *json, const ambulo_model *model) {
  ambulo__body_joint list[AMBULO__BODY_JOINTS];
  int any = 0;
  ambulo__body_joints(model, list);
  for (int i = 0; i < AMBULO__BODY_JOINTS; i++) {
    if (list[i].coordinate < 0) continue;
    const char *name = ambulo_model_coordinate(model, list[i].coordinate)->name;
    if (list[i].sign > 0 && strcmp(name, list[i].name) == 0) continue;
    if (!any) ambulo__json_open(json, "joints", '{');
    any = 1;
    ambulo__json_open(json, list[i].name, '{');
    ambulo__json_text(json, "coordinate", name);
    ambulo__json_integer(json, "sign", list[i].sign);
    ambulo__json_close(json, '}');
  }
  if (any) ambulo__json_close(json, '}');
}

static void body(ambulo__json *json, const ambulo_model *model) {
  double size = -ambulo__dot(ambulo_model_gravity(model), ambulo_model_up(model));
  ambulo__json_open(json, "body", '{');
  ambulo__json_number(json, "mass", ambulo_model_mass(model));
  ambulo__json_number(json, "gravity", size);
  vector(json, "up", ambulo_model_up(model));
  vector(json, "forward", ambulo_model_forward(model));
  joints(json, model);
  ambulo__json_close(json, '}');
}

static ambulo_status foot_strikes(ambulo__json *json, const ambulo_problem *problem) {
  const ambulo_allocator *a = &json->text->allocator;
  ambulo__strike *strikes =
      ambulo__alloc(a, (size_t)ambulo__most_strikes(problem), sizeof *strikes);
  if (!strikes) return AMBULO_E_MEMORY;
  int count = ambulo__strikes(problem, strikes);
  ambulo__json_open(json, "strikes", '[');
  for (int i = 0; i < count; i++) {
    const ambulo_foot *foot = ambulo_model_foot(ambulo_problem_model(problem), strikes[i].foot);
    ambulo__json_open(json, NULL, '{');
    ambulo__json_text(json, "foot", foot->name);
    ambulo__json_number(json, "time", strikes[i].time);
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, ']');
  ambulo__free(a, strikes);
  return AMBULO_OK;
}

/* a regular walk as it came out; of unlike steps the mean */
static void gait(ambulo__json *json, const ambulo_problem *problem) {
  const ambulo_gait *walk = &problem->keys.walk;
  if (!problem->keys.gait) return;
  double steps = walk->steps, duration = ambulo_problem_duration(problem);
  double stride = ambulo__gait_strike(walk, 2), duty = walk->toe_off - walk->heel_strike;
  double travel = ambulo__gait_place(walk, walk->steps);
  ambulo__json_open(json, "gait", '{');
  ambulo__json_number(json, "steps", steps);
  ambulo__json_number(json, "step_time", duration / steps);
  ambulo__json_number(json, "step_length", travel / steps);
  ambulo__json_number(json, "step_width", walk->step_width);
  ambulo__json_number(json, "speed", travel / duration);
  ambulo__json_number(json, "stride_frequency", steps / (2.0 * duration));
  ambulo__json_number(json, "duty_factor", duty);
  ambulo__json_number(json, "contact_time", duty * stride);
  ambulo__json_number(json, "flight_time", fmax(0.0, 0.5 - duty) * stride);
  ambulo__json_close(json, '}');
}

static void nlopt(ambulo__json *json, const ambulo_result *result) {
  const ambulo_nlopt_work *work = ambulo_result_nlopt(result);
  ambulo__json_open(json, "nlopt", '{');
  ambulo__json_integer(json, "calls", work->calls);
  ambulo__json_integer(json, "outer_iterations", work->outer);
  ambulo__json_integer(json, "inner_evaluations", work->inner);
  ambulo__json_number(json, "seconds", work->seconds);
  ambulo__json_integer(json, "result", work->result);
  ambulo__json_text(json, "result_name", work->result_name);
  ambulo__json_close(json, '}');
}

static void effort(ambulo__json *json, const ambulo_result *result) {
  const ambulo_timing *timing = ambulo_result_timing(result);
  ambulo__json_integer(json, "iterations", ambulo_result_iterations(result));
  ambulo__json_integer(json, "evaluations", ambulo_result_evaluations(result));
  ambulo__json_open(json, "seconds", '{');
  ambulo__json_number(json, "total", timing->total);
  ambulo__json_number(json, "evaluate", timing->evaluate);
  ambulo__json_number(json, "linear_algebra", timing->linear_algebra);
  ambulo__json_number(json, "nlopt", timing->nlopt);
  ambulo__json_close(json, '}');
  nlopt(json, result);
}

void ambulo__summary_json(const ambulo_problem *problem, const ambulo_result *result,
                          const ambulo_report_options *options,
                          const ambulo_muscle_analysis *muscles, ambulo__text_buffer *text) {
  ambulo__json writer = {.text = text, .first = 1};
  ambulo__json *json = &writer;
  ambulo_verdict verdict = ambulo_result_verdict(result);
  ambulo__json_open(json, NULL, '{');
  ambulo__json_text(json, "schema", "ambulo-summary/1");
  ambulo__json_text(json, "problem", ambulo_problem_name(problem));
  ambulo__json_text(json, "model", ambulo_model_name(ambulo_problem_model(problem)));
  ambulo__json_text(json, "verdict", ambulo_verdict_name(verdict));
  ambulo__json_text(json, "ended_by", ambulo__ending_name(ambulo_result_ending_code(result)));
  ambulo__json_text(json, "ending", ambulo_result_ending(result));
  ambulo__json_number(json, "duration", ambulo_problem_duration(problem));
  body(json, ambulo_problem_model(problem));
  ambulo_status status = foot_strikes(json, problem);
  gait(json, problem);
  objective(json, problem, result);
  free_parameters(json, result);
  if (!status) status = ambulo__reaction_json(json, problem, result);
  if (!status) status = ambulo__economy_json(json, problem, result, muscles != NULL);
  if (muscles) ambulo__muscle_json(json, "muscles", muscles);
  if (!status) status = ambulo__approach_json(json, problem, result);
  if (!status) status = ambulo__devices_json(json, problem, result);
  if (!status) status = ambulo__holds_json(json, problem, result);
  audit(json, result);
  between_nodes(json, result);
  explanation(json, result);
  list_sensitivities(json, options->sensitivities);
  sizes(json, problem);
  ambulo__starts_json(json, result);
  ambulo__resolution_json(json, result);
  effort(json, result);
  ambulo__history_json(json, result);
  ambulo__versions_json(json);
  ambulo__json_hash(json, "input_hash", ambulo_problem_hash(problem));
  ambulo__inputs_json(options->inputs ? options->inputs : ambulo_problem_inputs(problem), json);
  ambulo__json_close(json, '}');
  if (status) text->failed = 1; /* only an allocation can fail */
}
