/* solver/dense_audit.c - see dense_audit.h and dense.h. */
#include "solver/dense_audit.h"

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
  const char *reason = obstacle(p, samples, in_time);
  if (reason) refuse(report, reason);
  ambulo_status status = reason ? AMBULO_OK : look(p, result->x, samples, allocator, report);
  if (status) return status;
  ambulo_violation none = {.family = "", .subject = "", .detail = "", .unit = "", .size = 1.0};
  none.worst = report->view.samples ? 0.0 : (double)NAN;
  result->audit.dense_violation = report->view.family_count ? report->family[0].violation : none;
  return AMBULO_OK;
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
  ambulo__dense_words(p, result->verdict, forecast ? &cure : NULL, report);
  if (report->summary[0])
    ambulo__warning(diagnostics, ambulo__nowhere, NULL, "%s", report->summary);
  return AMBULO_OK;
}

const ambulo_dense_audit *ambulo_result_dense_audit(const ambulo_result *result) {
  return result->dense ? &result->dense->view : NULL;
}
