/* retarget/score.c - how well a motion follows what its problem tracks, in words.
 *
 * The distance of a coordinate is that of the result at the nodes from the reference of the first
 * term that tracks it, root mean square over time. A coordinate that is far from it is asked why:
 * where its reference leaves its range, and how much of the time it rests on a limit of angle,
 * speed or torque.
 */
#include "ambulo/tools/retarget.h"

#include "base/text_buffer.h"
#include "problem/nlp.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double degree = 180.0 / 3.14159265358979323846;
static const double far = 5.0;      /* degrees */
static const double at_limit = .01; /* of a limit's range: rests on it */

typedef struct score {
  const ambulo_problem *problem;
  const double *q, *qd, *tau; /* [nodes][d] */
  ambulo__text_buffer *text;
} score;

static const ambulo_term *tracker_of(const ambulo_problem *problem, int c) {
  for (int i = 0; i < problem->definition.term_count; i++) {
    const ambulo_term *term = &problem->definition.terms[i];
    if (term->kind != AMBULO_TRACKING || !term->reference) continue;
    if (!term->scale || term->scale[c] > 0.0) return term;
  }
  return NULL;
}

static double distance(const score *s, const ambulo_term *term, int c) {
  size_t d = (size_t)s->problem->coordinates;
  double sum = 0.0, time = 0.0;
  for (size_t k = 0; k < (size_t)s->problem->nodes; k++) {
    double off = s->q[k * d + (size_t)c] - term->reference[k * d + (size_t)c];
    sum += s->problem->quadrature[k] * off * off;
    time += s->problem->quadrature[k];
  }
  return sqrt(sum / time);
}

/* share of the nodes at which a value rests on either bound */
static double share_at(const score *s, const double *values, const double bounds[2], int c) {
  size_t d = (size_t)s->problem->coordinates;
  double room = at_limit * fmin(bounds[1] - bounds[0], 100.0);
  int count = 0;
  for (size_t k = 0; k < (size_t)s->problem->nodes; k++) {
    double v = values[k * d + (size_t)c];
    count += v < bounds[0] + room || v > bounds[1] - room;
  }
  return (double)count / s->problem->nodes;
}

static void say_range(const score *s, const ambulo_term *term, int c, int *reasons) {
  const ambulo_coordinate *about = &s->problem->model->coordinates[c];
  size_t d = (size_t)s->problem->coordinates;
  double low = INFINITY, high = -INFINITY;
  for (size_t k = 0; k < (size_t)s->problem->nodes; k++) {
    low = fmin(low, term->reference[k * d + (size_t)c]);
    high = fmax(high, term->reference[k * d + (size_t)c]);
  }
  if (low >= about->range[0] && high <= about->range[1]) return;
  int above = high - about->range[1] > about->range[0] - low;
  ambulo__text_append_format(s->text, "%s the motion asks for %.0f degrees, its range ends at %.0f",
                             (*reasons)++ ? "," : ":", degree * (above ? high : low),
                             degree * about->range[above]);
}

static void say_limit(const score *s, const char *what, double share, int *reasons) {
  if (share < 0.02) return;
  ambulo__text_append_format(s->text, "%s it rests on its limit of %s for %.0f %% of the time",
                             (*reasons)++ ? "," : ":", what, 100.0 * share);
}

static void say_why(const score *s, const ambulo_term *term, int c) {
  const ambulo_coordinate *about = &s->problem->model->coordinates[c];
  int reasons = 0;
  say_range(s, term, c, &reasons);
  if (reasons == 0) say_limit(s, "angle", share_at(s, s->q, about->range, c), &reasons);
  say_limit(s, "speed", share_at(s, s->qd, about->speed, c), &reasons);
  if (about->actuated) say_limit(s, "torque", share_at(s, s->tau, about->torque, c), &reasons);
  if (reasons == 0)
    ambulo__text_append(s->text,
                        ": no limit of its own; footholds, balance and other joints ask for it");
}

static void say_coordinates(const score *s) {
  double worst = 0.0;
  int count = 0, beyond = 0;
  for (int c = 0; c < s->problem->coordinates; c++) {
    const ambulo_coordinate *about = &s->problem->model->coordinates[c];
    const ambulo_term *term = tracker_of(s->problem, c);
    if (!term || about->type != AMBULO_REVOLUTE) continue;
    double rms = degree * distance(s, term, c);
    ambulo__text_append_format(s->text, "  %-28s %6.1f", about->name, rms);
    if (rms > far) say_why(s, term, c);
    ambulo__text_append(s->text, "\n");
    worst = fmax(worst, rms);
    beyond += rms > far;
    count++;
  }
  ambulo__text_append_format(s->text, "%d of %d angles within %.0f degrees rms; worst %.1f\n",
                             count - beyond, count, far, worst);
}

/* mm, the larger of what rows at the nodes and the audit between them say */
static double worst_of(const ambulo_result *result, const char *const *families, int count) {
  const ambulo_dense_audit *dense = ambulo_result_dense_audit(result);
  double worst = 0.0;
  for (int i = 0; i < count; i++) {
    for (int k = 0; dense && k < dense->family_count; k++) {
      const ambulo_violation *v = &dense->families[k].violation;
      if (strcmp(v->family, families[i]) == 0 && strcmp(v->unit, "m") == 0)
        worst = fmax(worst, 1000.0 * v->worst);
    }
  }
  return worst;
}

static void say_feet(const score *s, const ambulo_result *result) {
  static const char *const slips[] = {"slip", "foot_strike", "contact"}, *const sinks[] = {
                                                                             "ground_penetration",
                                                                             "contact",
                                                                             "clearance"};
  /* within the tolerance of contacts a foot may be anywhere */
  double play = 1000.0 * fmax(0.0, s->problem->definition.contact_tolerance);
  ambulo__text_append_format(s->text,
                             "feet slip by up to %.2f mm, and sink in by up to %.2f mm (with the "
                             "contact tolerance of %.1f mm)\n",
                             play + worst_of(result, slips, 3), play + worst_of(result, sinks, 3),
                             play);
}

ambulo_status ambulo_retarget_report(const ambulo_problem *problem, const ambulo_result *result,
                                     const ambulo_allocator *allocator, char **text) {
  if (!problem || !result || !text) return AMBULO_E_ARGUMENT;
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  size_t size = (size_t)problem->nodes * (size_t)problem->coordinates;
  double *values = ambulo__alloc(&own, 3 * size, sizeof *values);
  ambulo_workspace *workspace = NULL;
  ambulo__text_buffer out;
  ambulo__text_init(&out, &own);
  ambulo_status status =
      values ? ambulo_workspace_create(problem, allocator, &workspace) : AMBULO_E_MEMORY;
  if (!status) {
    ambulo_motion motion = ambulo_motion_default();
    motion.q = values;
    motion.qd = values + size;
    motion.tau = values + 2 * size;
    status = ambulo_problem_motion(problem, workspace, ambulo_result_x(result), problem->nodes,
                                   problem->times, &motion);
    if (status == AMBULO_E_NUMERIC) status = AMBULO_OK; /* what is there is shown */
  }
  if (!status) {
    score s = {problem, values, values + size, values + 2 * size, &out};
    ambulo__text_append(&out, "distance from the angles of the motion, degrees rms\n");
    say_coordinates(&s);
    say_feet(&s, result);
    status = ambulo__text_status(&out);
  }
  if (!status) {
    *text = ambulo__strdup(&own, ambulo__text_data(&out));
    if (!*text) status = AMBULO_E_MEMORY;
  }
  ambulo__text_free(&out);
  ambulo_workspace_free(workspace);
  ambulo__free(&own, values);
  return status;
}
