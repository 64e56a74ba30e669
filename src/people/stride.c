/* people/stride.c - sampling a motion, and adding the mirrored second step (stride.h). */
#include "people/stride.h"

#include "base/arithmetic.h"
#include "contact/contacts.h"

#include <math.h>
#include <string.h>

/* times at which the problem itself is sampled, and which of them stand for the mirrored step */
typedef struct sampling {
  double *base;   /* [samples], in [0, T] */
  char *mirrored; /* [samples] */
} sampling;

static void choose_times(ambulo__stride *s, int wanted, sampling *sample) {
  double step = ambulo_problem_duration(s->problem);
  int intervals = ambulo_problem_node_count(s->problem) - 1;
  for (int k = 0; k < s->samples; k++) {
    double t;
    if (wanted == 0) {
      int second = s->mirrored && k > intervals;
      int node = second ? k - intervals : k;
      sample->base[k] = ambulo_problem_node_time(s->problem, node);
      sample->mirrored[k] = (char)second;
      t = second ? step + sample->base[k] : sample->base[k];
    } else {
      t = (double)k * s->duration / (double)(s->samples - 1);
      int second = s->mirrored && t > step;
      sample->base[k] = second ? t - step : t;
      sample->mirrored[k] = (char)second;
    }
    s->times[k] = t;
  }
}

/* mirrors one [coordinates] row in place; `shift` may be NULL */
static void mirror_row(const ambulo_model *model, double *row, const double *shift,
                       double *scratch) {
  for (int i = 0; i < model->coordinate_count; i++) {
    const ambulo_coordinate *c = &model->coordinates[i];
    scratch[c->mirror] = c->mirror_sign * row[i] + (shift ? shift[c->mirror] : 0.0);
  }
  memcpy(row, scratch, (size_t)model->coordinate_count * sizeof *row);
}

/* scratch: [2][coordinates] */
static void mirror_second_step(ambulo__stride *s, const sampling *sample, double *scratch) {
  double *shift = scratch + s->coordinates;
  for (int i = 0; i < s->coordinates; i++) shift[i] = ambulo__end_shift(&s->problem->definition, i);
  for (int k = 0; k < s->samples; k++) {
    if (!sample->mirrored[k]) continue;
    size_t at = (size_t)k * (size_t)s->coordinates;
    mirror_row(s->model, s->q + at, shift, scratch);
    mirror_row(s->model, s->qd + at, NULL, scratch);
    mirror_row(s->model, s->qdd + at, NULL, scratch);
    mirror_row(s->model, s->tau + at, NULL, scratch);
    ambulo__stride_mirror_place(s, s->zmp + 3 * (size_t)k);
    ambulo__stride_feet_mirror(s, k);
    ambulo__stride_devices_mirror(s, k);
    ambulo__stride_holds_mirror(s, k);
  }
}

static ambulo_status allocate(ambulo__stride *s, sampling *sample, double **scratch) {
  const ambulo_allocator *a = &s->allocator;
  size_t n = (size_t)s->samples, d = (size_t)s->coordinates;
  double **arrays[] = {&s->q, &s->qd, &s->qdd, &s->tau};
  int failed = 0;
  for (int i = 0; i < 4; i++) {
    *arrays[i] = ambulo__alloc(a, n * d, sizeof(double));
    failed |= !*arrays[i];
  }
  s->times = ambulo__alloc(a, n, sizeof(double));
  s->zmp = ambulo__alloc(a, 3 * n, sizeof(double));
  sample->base = ambulo__alloc(a, n, sizeof(double));
  sample->mirrored = ambulo__alloc(a, n, 1);
  *scratch = ambulo__alloc(a, 2 * d, sizeof(double));
  failed |= !s->times || !s->zmp || !sample->base || !sample->mirrored || !*scratch;
  ambulo_status status = failed ? AMBULO_E_MEMORY : ambulo__stride_feet_allocate(s);
  if (!status) status = ambulo__stride_devices_allocate(s);
  return status ? status : ambulo__stride_holds_allocate(s);
}

ambulo_status ambulo__stride_create(const ambulo_problem *problem, const double *x, int samples,
                                    const ambulo_allocator *allocator, ambulo__stride *stride) {
  if (samples < 0 || samples == 1) return AMBULO_E_ARGUMENT;
  int intervals = ambulo_problem_node_count(problem) - 1;
  ambulo__stride s = {.allocator = ambulo__allocator_or_default(allocator), .problem = problem};
  s.model = ambulo_problem_model(problem);
  s.coordinates = ambulo_model_coordinate_count(s.model);
  s.feet = problem->channels.feet;
  s.devices = problem->channels.devices;
  s.holds = problem->definition.hold_count;
  if (problem->definition.ground_reaction.kind == AMBULO_REACTION_SHARED)
    s.patches = s.model->patch_count;
  s.mirrored = ambulo_problem_ends(problem) == AMBULO_ENDS_MIRRORED;
  s.duration = (s.mirrored ? 2.0 : 1.0) * ambulo_problem_duration(problem);
  s.samples = samples ? samples : (s.mirrored ? 2 : 1) * intervals + 1;
  sampling sample = {NULL, NULL};
  double *scratch = NULL;
  ambulo_workspace *workspace = NULL;
  ambulo_status status = allocate(&s, &sample, &scratch);
  if (!status) status = ambulo__workspace_create_for_values(problem, allocator, &workspace);
  if (!status) {
    choose_times(&s, samples, &sample);
    ambulo_motion motion = {.size = sizeof motion,
                            .q = s.q,
                            .qd = s.qd,
                            .qdd = s.qdd,
                            .tau = s.tau,
                            .zmp = s.zmp,
                            .grf = s.grf,
                            .cop = s.cop,
                            .free_moment = s.free_moment,
                            .grf_moment = s.grf_moment,
                            .patch_force = s.patch_force,
                            .patch_cop = s.patch_cop,
                            .patch_free_moment = s.patch_free_moment,
                            .patch_moment = s.patch_moment,
                            .device_effort = s.effort,
                            .device_along = s.along,
                            .device_power = s.power,
                            .hold_force = s.hold_force,
                            .hold_moment = s.hold_moment,
                            .hold_power = s.hold_power};
    status = ambulo_problem_motion(problem, workspace, x, s.samples, sample.base, &motion);
    /* a motion that blew up is still shown, holes and all */
    if (status == AMBULO_E_NUMERIC) status = AMBULO_OK;
  }
  if (!status && scratch) mirror_second_step(&s, &sample, scratch);
  ambulo_workspace_free(workspace);
  ambulo__free(&s.allocator, sample.base);
  ambulo__free(&s.allocator, sample.mirrored);
  ambulo__free(&s.allocator, scratch);
  if (status) {
    ambulo__stride_free(&s);
  } else {
    *stride = s;
  }
  return status;
}

void ambulo__stride_free(ambulo__stride *s) {
  ambulo__free(&s->allocator, s->times);
  ambulo__free(&s->allocator, s->q);
  ambulo__free(&s->allocator, s->qd);
  ambulo__free(&s->allocator, s->qdd);
  ambulo__free(&s->allocator, s->tau);
  ambulo__free(&s->allocator, s->zmp);
  ambulo__free(&s->allocator, s->grf);
  ambulo__free(&s->allocator, s->cop);
  ambulo__free(&s->allocator, s->free_moment);
  ambulo__free(&s->allocator, s->grf_moment);
  ambulo__free(&s->allocator, s->patch_force);
  ambulo__free(&s->allocator, s->patch_cop);
  ambulo__free(&s->allocator, s->patch_free_moment);
  ambulo__free(&s->allocator, s->patch_moment);
  ambulo__free(&s->allocator, s->effort);
  ambulo__free(&s->allocator, s->along);
  ambulo__free(&s->allocator, s->power);
  ambulo__free(&s->allocator, s->hold_force);
  ambulo__free(&s->allocator, s->hold_moment);
  ambulo__free(&s->allocator, s->hold_power);
}

const ambulo_contact *ambulo__stride_contact(const ambulo__stride *s, int effector, double t) {
  double step = ambulo_problem_duration(s->problem);
  if (s->mirrored && t > step) {
    t -= step;
    effector = ambulo__effector_mirror(s->model, effector);
  }
  return ambulo__contact_of(&s->problem->definition, effector, t);
}

/* a contact of `foot` that lasts until `time`; one that only begins there is the next strike */
static int ends_at(const ambulo_problem *problem, int foot, double time) {
  for (int i = 0; i < ambulo_problem_contact_count(problem); i++) {
    const ambulo_contact *c = ambulo_problem_contact(problem, i);
    if (c->foot == foot && fabs(c->to - time) <= AMBULO__INSTANT &&
        c->from < time - AMBULO__INSTANT)
      return 1;
  }
  return 0;
}

static int begins_loaded(const ambulo_problem *problem, int foot) {
  ambulo_ends ends = ambulo_problem_ends(problem);
  if (ends == AMBULO_ENDS_FREE) return 1;
  if (ends == AMBULO_ENDS_MIRRORED)
    foot = ambulo_model_foot(ambulo_problem_model(problem), foot)->mirror;
  return ends_at(problem, foot, ambulo_problem_duration(problem));
}

/* 1 if the two are one event of a motion that repeats after `period` (0: it does not) */
static int is_same(const ambulo__strike *a, const ambulo__strike *b, double period) {
  double apart = fabs(a->time - b->time);
  return a->foot == b->foot &&
         (apart <= AMBULO__INSTANT || fabs(apart - period) <= AMBULO__INSTANT);
}

/* inserts by time, unless it is there; of one event the earlier time stays */
static void insert(ambulo__strike *strikes, int *count, ambulo__strike one, double period) {
  for (int i = 0; i < *count; i++) {
    if (!is_same(&strikes[i], &one, period)) continue;
    if (strikes[i].time <= one.time + AMBULO__INSTANT) return;
    for (int k = i; k + 1 < *count; k++) strikes[k] = strikes[k + 1];
    --*count;
    break;
  }
  int at = (*count)++;
  for (; at > 0 && strikes[at - 1].time > one.time; at--) strikes[at] = strikes[at - 1];
  strikes[at] = one;
}

int ambulo__most_strikes(const ambulo_problem *problem) {
  return 2 * ambulo_problem_contact_count(problem) + 1;
}

int ambulo__strikes(const ambulo_problem *problem, ambulo__strike *strikes) {
  const ambulo_model *model = ambulo_problem_model(problem);
  double duration = ambulo_problem_duration(problem);
  ambulo_ends ends = ambulo_problem_ends(problem);
  int mirrored = ends == AMBULO_ENDS_MIRRORED, count = 0;
  double period = ends == AMBULO_ENDS_FREE ? 0.0 : (mirrored ? 2.0 : 1.0) * duration;
  for (int i = 0; i < ambulo_problem_contact_count(problem); i++) {
    const ambulo_contact *c = ambulo_problem_contact(problem, i);
    if (c->foot < 0) continue;
    int follows = c->from <= AMBULO__INSTANT ? begins_loaded(problem, c->foot)
                                             : ends_at(problem, c->foot, c->from);
    if (follows) continue;
    insert(strikes, &count, (ambulo__strike){c->foot, c->from}, period);
    if (!mirrored) continue;
    int mirror = ambulo_model_foot(model, c->foot)->mirror;
    insert(strikes, &count, (ambulo__strike){mirror, c->from + duration}, period);
  }
  return count;
}
