/* definitions/one_step.c - a gait of several steps starts at one of them, solved and repeated.
 *
 * A solve from zero of k steps costs about k^2 of one. The steps are alike, so that one, with
 * mirrored ends, on its share of nodes and knots, is nearly the solution of all; of unlike steps or
 * an asymmetric body it is the stride, with periodic ends. Both motion and multipliers are
 * repeated.
 *
 * What has a time or a place of its own within the motion, such as a reference, a reach or an
 * obstacle, has none in a single step: there the solve starts from zero. */
#include "ambulo/tools/load.h"
#include "base/sized.h"
#include "contact/schedule.h"
#include "definitions/motion_repeat.h"
#include "method/multipliers.h"
#include "problem/nlp.h"

#include <math.h>

static const double share_of_time = 0.5; /* of a time limit, at most */
enum { LEAST_INTERVALS = 8 };            /* of the trajectory; on fewer a step is another motion */

/* -------------------------------------------------------------- the problem of a period */

static int has_timed_loads(const ambulo_problem_definition *d) {
  int timed = 0;
  for (int i = 0; i < d->device_count; i++) timed |= d->devices[i].clock == AMBULO_DEVICE_BY_TIME;
  for (int i = 0; i < d->hold_count; i++)
    timed |= d->holds[i].from > 0.0 || d->holds[i].to < d->duration;
  return timed;
}

static int has_references(const ambulo_problem_definition *d) {
  int references = d->tube_count > 0;
  for (int t = 0; t < d->term_count; t++) references |= ambulo__term_follows(&d->terms[t]);
  return references;
}

/* whether each period of the motion is asked for the same */
static int is_alike(const ambulo_problem *p) {
  const ambulo_problem_definition *d = &p->definition;
  if (!p->keys.gait || p->extends || d->ends == AMBULO_ENDS_FREE || d->end_value_count > 0)
    return 0;
  if (d->breakpoints || d->node_times || d->reach_count > 0 || d->obstacle_count > 0) return 0;
  return !has_references(d) && !has_timed_loads(d);
}

/* intervals of a period */
static int share(int intervals, int steps, int period) {
  return (int)round((double)intervals * period / steps);
}

/* *one becomes NULL where there is no such problem */
static ambulo_status create(const ambulo_problem *p, int period, const ambulo_allocator *a,
                            ambulo_problem **one) {
  ambulo_problem_definition d = p->definition;
  ambulo_gait gait = p->keys.walk;
  int steps = gait.steps, count = 0;
  double part = (double)period / steps;
  *one = NULL;
  d.intervals = share(d.intervals, steps, period);
  d.spline_intervals = share(d.spline_intervals, steps, period);
  if ((d.spline_intervals ? d.spline_intervals : d.intervals) < LEAST_INTERVALS * period)
    return AMBULO_OK;
  gait.steps = period;
  if (ambulo_gait_expand(d.model, &gait, NULL, 0, &count) != AMBULO_E_LIMIT) return AMBULO_OK;
  ambulo_contact *contacts = ambulo__alloc(a, (size_t)count, sizeof *contacts);
  if (!contacts) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo_gait_expand(d.model, &gait, contacts, count, &count);
  d.contacts = contacts;
  d.contact_count = count;
  d.ends = period == 1 ? AMBULO_ENDS_MIRRORED : AMBULO_ENDS_PERIODIC;
  d.duration *= part;
  d.travel *= part;
  d.rise *= part;
  if (!status) status = ambulo_problem_create(&d, a, NULL, one);
  ambulo__free(a, contacts);
  if (!status && *one) (*one)->keys.walk = gait;
  return status == AMBULO_E_MEMORY ? status : AMBULO_OK;
}

/* of one step, or of two; *period: which */
static ambulo_status create_period(const ambulo_problem *p, const ambulo_allocator *a, int *period,
                                   ambulo_problem **one) {
  int steps = p->keys.walk.steps;
  ambulo_status status = AMBULO_OK;
  *one = NULL;
  for (*period = p->keys.unlike_steps ? 2 : 1; *period <= 2; ++*period) {
    if (steps <= *period || steps % *period != 0) break;
    status = create(p, *period, a, one);
    if (status || *one) break;
  }
  return status;
}

/* ---------------------------------------------------------------------- its solve */

static int show(void *user, const ambulo_progress *inner) {
  const ambulo_options *options = user;
  ambulo_progress progress = *inner;
  progress.stage = "one step";
  return options->progress ? options->progress(options->user, &progress) : 0;
}

/* *result becomes NULL where none of its motions holds the rows */
static ambulo_status solve(const ambulo_problem *one, const ambulo_options *options,
                           const ambulo_allocator *a, ambulo_result **result) {
  ambulo_options own = *options;
  own.progress = show;
  own.user = (void *)options;
  own.multipliers = NULL;
  own.dense_samples = 1; /* a start has to hold at the nodes alone */
  if (own.time_limit > 0.0) own.time_limit *= share_of_time;
  ambulo_status status = ambulo_solve(one, &own, NULL, a, NULL, result);
  if (status) return status == AMBULO_E_MEMORY ? status : AMBULO_OK;
  if (ambulo_verdict_is_solution(ambulo_result_verdict(*result))) return AMBULO_OK;
  ambulo_result_free(*result);
  *result = NULL;
  return AMBULO_OK;
}

static ambulo_status repeat(const ambulo_problem *p, const ambulo_problem *one, int period,
                            const ambulo_result *result, const ambulo_allocator *a, double *x,
                            ambulo_multipliers **multipliers) {
  ambulo_multipliers *m = NULL;
  int count = p->keys.walk.steps / period;
  ambulo_status status = ambulo_multipliers_of(one, result, a, &m);
  if (!status)
    status = ambulo__motion_repeat(one->basis, ambulo_result_x(result), count, one->definition.ends,
                                   p, x);
  if (status) {
    ambulo_multipliers_free(m);
    return status;
  }
  m->periods = count;
  m->mirrored = period == 1;
  *multipliers = m;
  return AMBULO_OK;
}

ambulo_status ambulo_start_from_step(const ambulo_problem *problem, const ambulo_options *options,
                                     const ambulo_allocator *allocator, double *x,
                                     ambulo_multipliers **multipliers) {
  ambulo_options own;
  if (!problem || !x || !multipliers || !AMBULO__OWN(ambulo_options, &own, options))
    return AMBULO_E_ARGUMENT;
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  ambulo_problem *one = NULL;
  ambulo_result *result = NULL;
  int period = 1;
  *multipliers = NULL;
  if (own.starts > 1 || !is_alike(problem)) return AMBULO_OK;
  ambulo_status status = create_period(problem, &a, &period, &one);
  if (!status && one) status = solve(one, &own, &a, &result);
  if (!status && result) status = repeat(problem, one, period, result, &a, x, multipliers);
  ambulo_result_free(result);
  ambulo_problem_free(one);
  return status;
}
