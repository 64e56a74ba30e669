/* solver/dense_audit.c - the audit between the nodes (dense.h): its families, and in words a line a
 * family that fails and one sentence. */
#include "solver/explain.h"
#include "solver/dense.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MANY = 20000 }; /* intervals: a tenth of a second */

/* ---------------------------------------------------------------- families */

/* NaN first, then the larger ratio */
static int comes_before(const ambulo__dense_entry *a, const ambulo__dense_entry *b) {
  if (isnan(a->ratio) || isnan(b->ratio)) return isnan(a->ratio) && !isnan(b->ratio);
  return a->ratio > b->ratio;
}

static void add_family(ambulo__dense_report *report, int rule) {
  const ambulo__dense_entry *entry = &report->worst.entry[rule];
  int at = report->view.family_count++;
  for (; at > 0; at--) {
    int before = report->family_rule[at - 1];
    if (!comes_before(entry, &report->worst.entry[before])) break;
    report->family_rule[at] = before;
  }
  report->family_rule[at] = rule;
}

static ambulo_dense_family family_of(const ambulo__dense_entry *entry) {
  const ambulo__dense_sample *s = &entry->sample;
  ambulo_dense_family family = {.violation = {.family = s->family,
                                              .subject = s->subject,
                                              .detail = s->detail,
                                              .unit = s->unit,
                                              .time = s->time,
                                              .worst = s->value,
                                              .size = s->tolerance},
                                .tolerance = s->tolerance,
                                .holds = entry->ratio <= 1.0,
                                .settings = "",
                                .advice = ""};
  return family;
}

static void list_families(ambulo__dense_report *report) {
  for (int rule = 0; rule < AMBULO__DENSE_RULES; rule++) {
    if (report->worst.entry[rule].present) add_family(report, rule);
  }
  for (int i = 0; i < report->view.family_count; i++) {
    report->family[i] = family_of(&report->worst.entry[report->family_rule[i]]);
    report->view.failing += !report->family[i].holds;
  }
}

/* ------------------------------------------------------------------- audit */

static void refuse(ambulo__dense_report *report, const char *text) {
  (void)snprintf(report->reason, sizeof report->reason, "%s", text);
}

/* the first message of a grid that could not be built */
static void refuse_for(ambulo__dense_report *report, const ambulo_diagnostics *diagnostics) {
  const ambulo_diagnostic *first = ambulo_diagnostics_get(diagnostics, 0);
  refuse(report, first ? first->message : "the finer grid has too many rows");
}

static ambulo_status measure(const ambulo__dense *dense, const ambulo_problem *p,
                             ambulo__dense_report *report) {
  ambulo__events events;
  ambulo_status status =
      ambulo__events_create(&p->definition, AMBULO__EVENTS_OF_ROWS, &dense->allocator, &events);
  if (status) return status;
  ambulo__dense_worst_of(dense, &events, &report->worst);
  ambulo__free(&dense->allocator, events.time);
  report->view.samples = dense->samples;
  list_families(report);
  return AMBULO_OK;
}

/* why the finer grid is not looked at; NULL: it is */
static const char *obstacle(const ambulo_problem *p, int samples, int in_time) {
  if (samples < 2) return "solver.dense_samples is 1: a grid as coarse as the nodes";
  int possible = ambulo__dense_samples(p, samples);
  if (possible < 2) return "there are too many time intervals for a grid twice as fine";
  return !in_time && p->definition.intervals > MANY / possible ? "no time was left" : NULL;
}

static ambulo_status look(const ambulo_problem *p, const double *x, int samples,
                          const ambulo_allocator *allocator, ambulo__dense_report *report) {
  ambulo__dense dense;
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(allocator);
  if (!diagnostics) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__dense_open(p, x, samples, 0.0, allocator, diagnostics, &dense);
  if (!status) {
    status = measure(&dense, p, report);
    ambulo__dense_close(&dense);
  } else if (status != AMBULO_E_MEMORY) {
    refuse_for(report, diagnostics);
    status = AMBULO_OK;
  }
  ambulo_diagnostics_free(diagnostics);
  return status;
}

ambulo_status ambulo__dense_audit(const ambulo_problem *p, int samples, int in_time,
                                  const ambulo_allocator *allocator, ambulo_result *result) {
  ambulo__dense_report *report = result->dense;
  if (!report) report = ambulo__alloc(&result->allocator, 1, sizeof *report);
  if (!report) return AMBULO_E_MEMORY;
  memset(report, 0, sizeof *report);
  result->dense = report; /* from here on the result frees it */
  report->view.families = report->family;
  report->view.lines = report->line;
  report->view.summary = report->summary;
  report->view.reason = report->reason;
  report->view.overlaps = report->overlap;
  const char *reason = obstacle(p, samples, in_time);
  if (reason) refuse(report, reason);
  ambulo_status status = reason ? AMBULO_OK : look(p, result->x, samples, allocator, report);
  if (!status)
    status = ambulo__overlaps_find(p, result->x, allocator, report->overlap,
                                   &report->view.overlap_count);
  if (status) return status;
  ambulo_violation none = {.family = "", .subject = "", .detail = "", .unit = "", .size = 1.0};
  none.worst = report->view.samples ? 0.0 : (double)NAN;
  result->audit.dense_violation = report->view.family_count ? report->family[0].violation : none;
  return AMBULO_OK;
}

/* ------------------------------------------------------------------- words */

/* contacts hold within this where more time intervals than the trajectory's are asked for */
#define CONTACT_TOLERANCE "constraints.contact_tolerance=0.002"

/* ... and this many times as many: a trajectory that is held at three nodes for each interval has
 * no more room between them, one held at two sometimes has */
enum { ROOM = 3 };

typedef struct wording {
  const ambulo_problem *problem;
  const ambulo__dense_cure *cure; /* NULL: nothing was predicted */
  ambulo__dense_report *report;
  const char *brief[AMBULO__DENSE_RULES]; /* of each family, what the sentence says about it */
} wording;

/* appends; text beyond the end is cut */
static void append(char *text, size_t size, const char *more) {
  size_t used = strlen(text);
  (void)snprintf(text + used, size - used, "%s", more);
}

/* ---------------------------------------------------------------- settings */

/* "--set time.intervals=50", and the trajectory's intervals where they are not so already */
static void set_intervals(const wording *w, int intervals, int spline_intervals, char *text) {
  char part[80];
  int asked = w->problem->definition.spline_intervals;
  (void)snprintf(part, sizeof part, "--set time.intervals=%d", intervals);
  append(text, AMBULO__DENSE_SETTINGS_SIZE, part);
  if (spline_intervals == asked || (asked == 0 && spline_intervals == intervals)) return;
  (void)snprintf(part, sizeof part, " --set trajectory.intervals=%d", spline_intervals);
  append(text, AMBULO__DENSE_SETTINGS_SIZE, part);
}

static const char more_do_not_help[] = "more intervals do not help";
static const char out_of_reach[] =
    "too far off on a grid this coarse to predict how many intervals it takes";
static const char not_predicted[] = "no time was left to predict how many intervals it takes";
static const char not_finite[] = "not finite";
static const char again[] = "again with ";

static const char *remedy_of(const wording *w, const ambulo__dense_rule *rule, char *settings,
                             char *advice) {
  const ambulo_problem *p = w->problem;
  int spline = ambulo__basis_intervals(p->basis), own = p->definition.intervals;
  switch (rule->remedy) {
  case AMBULO__REMEDY_CONTROL_POINTS:
    if (ambulo__basis_get_kind(p->basis) != AMBULO__BSPLINE) break;
    append(settings, AMBULO__DENSE_SETTINGS_SIZE, "--set constraints.joint_limits=control_points");
    append(advice, AMBULO__DENSE_LINE_SIZE, "limits on the control points hold at all times");
    return again;
  case AMBULO__REMEDY_TOLERANCE:
    if (!ambulo__dense_is_strict(p)) break;
    append(settings, AMBULO__DENSE_SETTINGS_SIZE, "--set " CONTACT_TOLERANCE " ");
    set_intervals(w, ROOM * (own > spline ? own : spline), spline, settings);
    append(advice, AMBULO__DENSE_LINE_SIZE,
           "more intervals do not help while contacts are exact; within a tolerance the same "
           "trajectory has room for more nodes");
    return again;
  case AMBULO__REMEDY_TRANSFER:
    append(advice, AMBULO__DENSE_LINE_SIZE,
           "more intervals do not help: where contacts change the support region jumps, and the "
           "zero-moment point crosses over between two nodes; with ground_reaction (kind: "
           "shared) the load passes gradually, and each foot has a centre of pressure of "
           "its own");
    return more_do_not_help;
  case AMBULO__REMEDY_NONE:
    break;
  }
  append(advice, AMBULO__DENSE_LINE_SIZE, more_do_not_help);
  return more_do_not_help;
}

/* settings and advice of one family that fails; returns what the sentence says */
static const char *advise(const wording *w, int i) {
  int rule = w->report->family_rule[i], own = w->problem->definition.intervals;
  char *settings = w->report->settings[i], *advice = w->report->advice[i], look[100] = "";
  const char *brief = again;
  if (isnan(w->report->worst.entry[rule].ratio)) {
    append(advice, AMBULO__DENSE_LINE_SIZE, "the motion overflows there");
    return not_finite;
  }
  if (!w->cure) {
    append(advice, AMBULO__DENSE_LINE_SIZE, not_predicted);
    return not_predicted;
  }
  if (w->cure->cured[rule]) {
    set_intervals(w, w->cure->intervals, w->cure->spline_intervals, settings);
    append(advice, AMBULO__DENSE_LINE_SIZE, "more intervals help");
  } else if (w->cure->out_of_reach[rule]) {
    set_intervals(w, 2 * own, ambulo__dense_spline_intervals(w->problem, 2 * own), look);
    append(advice, AMBULO__DENSE_LINE_SIZE, out_of_reach);
    append(advice, AMBULO__DENSE_LINE_SIZE, "; look again with ");
    append(advice, AMBULO__DENSE_LINE_SIZE, look);
    brief = out_of_reach;
  } else {
    brief = remedy_of(w, ambulo__dense_rule_at(rule), settings, advice);
  }
  return brief;
}

/* ------------------------------------------------------------------- lines */

/* "slip: 0.0162 m (toe_medial_r along the ground, t = 0.1296 s; tolerance 0.001 m): ..." */
static void write_line(const wording *w, int i) {
  ambulo__dense_report *report = w->report;
  const ambulo_dense_family *f = &report->family[i];
  const ambulo_violation *v = &f->violation;
  char value[80], place[300];
  char *line = report->line_text[report->view.line_count];
  (void)snprintf(value, sizeof value, "%.3g %s", v->worst, v->unit);
  if (!ambulo__bodies_in_words(w->problem, v, place, sizeof place))
    (void)snprintf(place, sizeof place, "%s%s%s, t = %.4g s", v->subject, v->detail[0] ? " " : "",
                   v->detail, v->time);
  (void)snprintf(line, AMBULO__DENSE_LINE_SIZE, "%s: %s (%s; tolerance %.3g %s): %s%s%s", v->family,
                 isfinite(v->worst) ? value : not_finite, place, f->tolerance, v->unit, f->advice,
                 f->settings[0] ? "; " : "", f->settings);
  report->line[report->view.line_count++] = line;
}

/* ---------------------------------------------------------------- sentence */

/* 1 if the sentence says the same about both; of what holds it says nothing */
static int is_alike(const wording *w, int a, int b) {
  return w->brief[a] == w->brief[b] && strcmp(w->report->settings[a], w->report->settings[b]) == 0;
}

static int kind_of(const wording *w, int i) {
  return (int)ambulo__dense_rule_at(w->report->family_rule[i])->kind;
}

/* "slip, contact: again with --set time.intervals=50", of family i and those after it */
static void append_group(const wording *w, int i, char *text) {
  ambulo__dense_report *report = w->report;
  const char *last = NULL;
  for (int k = i; k < report->view.family_count; k++) {
    int kind = kind_of(w, k), named = 0;
    if (!is_alike(w, i, k)) continue;
    for (int j = i; j < k; j++) named |= is_alike(w, i, j) && kind_of(w, j) == kind;
    if (named) continue;
    if (last) append(text, AMBULO__DENSE_SUMMARY_SIZE, ", ");
    append(text, AMBULO__DENSE_SUMMARY_SIZE, last = report->family[k].violation.family);
  }
  append(text, AMBULO__DENSE_SUMMARY_SIZE, ": ");
  append(text, AMBULO__DENSE_SUMMARY_SIZE, w->brief[i]);
  append(text, AMBULO__DENSE_SUMMARY_SIZE, report->settings[i]);
}

static void write_summary(const wording *w, ambulo_verdict verdict) {
  const char *at_nodes = ambulo_verdict_name(ambulo__verdict_at_nodes(verdict));
  ambulo__dense_report *report = w->report;
  char *text = report->summary;
  if (report->view.samples == 0) {
    (void)snprintf(text, AMBULO__DENSE_SUMMARY_SIZE,
                   "%s at the nodes; between them nothing is known: %s", at_nodes, report->reason);
    return;
  }
  if (report->view.failing == 0) return;
  int far_off = !ambulo_verdict_is_solution(verdict);
  (void)snprintf(text, AMBULO__DENSE_SUMMARY_SIZE, "%s%s", at_nodes,
                 far_off ? " at the nodes only" : ", but a little off between the nodes");
  for (int i = 0; i < report->view.family_count; i++) {
    int said = 0;
    if (report->family[i].holds) continue;
    for (int k = 0; k < i; k++) said |= is_alike(w, k, i);
    if (said) continue;
    append(text, AMBULO__DENSE_SUMMARY_SIZE, "; ");
    append_group(w, i, text);
  }
}

void ambulo__dense_words(const ambulo_problem *p, ambulo_verdict verdict,
                         const ambulo__dense_cure *cure, ambulo__dense_report *report) {
  wording w = {.problem = p, .cure = cure, .report = report};
  report->view.line_count = 0;
  report->summary[0] = '\0';
  for (int i = 0; i < report->view.family_count; i++) {
    ambulo_dense_family *f = &report->family[i];
    if (f->holds) continue;
    report->settings[i][0] = report->advice[i][0] = '\0';
    w.brief[i] = advise(&w, i);
    f->settings = report->settings[i];
    f->advice = report->advice[i];
    write_line(&w, i);
  }
  write_summary(&w, verdict);
}

/* ------------------------------------------------------------------ advice */

static ambulo_status forecast_cure(const ambulo_problem *p, const ambulo_result *result,
                                   const ambulo_allocator *allocator, ambulo__dense_cure *cure) {
  ambulo__events events;
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo_status status =
      ambulo__events_create(&p->definition, AMBULO__EVENTS_OF_ROWS, &own, &events);
  if (status) return status;
  status = ambulo__dense_cure_find(p, result->x, &events, &result->dense->worst, allocator, cure);
  ambulo__free(&own, events.time);
  return status;
}

ambulo_status ambulo__dense_advise(const ambulo_problem *p, int in_time,
                                   const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo_result *result) {
  ambulo__dense_report *report = result->dense;
  ambulo__dense_cure cure;
  if (!report || (result->verdict != AMBULO_OPTIMAL && result->verdict != AMBULO_FEASIBLE))
    return AMBULO_OK;
  int forecast = in_time && report->view.failing > 0;
  if (forecast) {
    ambulo_status status = forecast_cure(p, result, allocator, &cure);
    if (status) return status;
    report->view.intervals = cure.intervals;
    report->view.spline_intervals = cure.spline_intervals;
  }
  if (report->view.failing > 0) {
    double ratio = report->worst.entry[report->family_rule[0]].ratio;
    result->verdict = ambulo__verdict_between_nodes(result->verdict, ratio);
  }
  ambulo__dense_words(p, result->verdict, forecast ? &cure : NULL, report);
  if (report->summary[0])
    ambulo__warning(diagnostics, ambulo__nowhere, NULL, "%s", report->summary);
  return AMBULO_OK;
}

const ambulo_dense_audit *ambulo_result_dense_audit(const ambulo_result *result) {
  return result->dense ? &result->dense->view : NULL;
}
