/* people/impulse.c - impulses of the ground's force, by the quadrature of the motion.
 *
 * Between neighbouring breakpoints of the trajectory and changes of contact the motion is a
 * polynomial and the share of each foot is smooth. Each such piece is integrated by Gauss's rule
 * (trajectory/quadrature.h), so that the sum over feet and patches obeys
 *
 *     sum_f int F_f dt = m (v_com(end) - v_com(0)) - m g (end - 0)
 *
 * to rounding, which sums over the time nodes do not: the force jumps and bends between them. The
 * mirror image of a step (people/stride_feet.c) adds J - 2 (J . l) l of the mirror foot. */
#include "people/impulse.h"

#include <math.h>
#include <string.h>

#include "contact/effector.h"
#include "trajectory/quadrature.h"

static int is_inside(const ambulo_problem *p, double t) {
  double duration = ambulo_problem_duration(p);
  return t > 1e-9 * duration && t < (1.0 - 1e-9) * duration;
}

/* inserts t into times[count], which stay sorted and apart */
static void insert(double *times, int *count, double t, double apart) {
  int at = *count;
  while (at > 0 && times[at - 1] > t) at--;
  if ((at > 0 && t - times[at - 1] <= apart) || (at < *count && times[at] - t <= apart)) return;
  memmove(times + at + 1, times + at, (size_t)(*count - at) * sizeof *times);
  times[at] = t;
  ++*count;
}

/* ends of the pieces: sorted, from 0 to T */
static int pieces(const ambulo_problem *p, double *times) {
  double duration = ambulo_problem_duration(p);
  const double *breakpoints = ambulo__basis_breakpoints(p->basis);
  int count = 0;
  times[count++] = 0.0;
  times[count++] = duration;
  for (int i = 1; i < ambulo__basis_intervals(p->basis); i++)
    insert(times, &count, breakpoints[i], 1e-9 * duration);
  for (int i = 0; i < ambulo_problem_contact_count(p); i++) {
    const ambulo_contact *c = ambulo_problem_contact(p, i);
    if (is_inside(p, c->from)) insert(times, &count, c->from, 1e-9 * duration);
    if (is_inside(p, c->to)) insert(times, &count, c->to, 1e-9 * duration);
  }
  return count - 1;
}

static void add_mirror_image(const ambulo_model *model, const double *step, double *impulse) {
  for (int e = 0; e < ambulo__effector_count(model); e++) {
    const double *own = step + 3 * e;
    double *to = impulse + 3 * ambulo__effector_mirror(model, e), aside = 0.0;
    for (int i = 0; i < 3; i++) aside += own[i] * model->left[i];
    for (int i = 0; i < 3; i++) to[i] += own[i] - 2.0 * aside * model->left[i];
  }
}

typedef struct samples {
  double *ends;            /* [pieces + 1] */
  double *times, *weights; /* [pieces][AMBULO__GAUSS_POINTS], s */
  double *feet, *patches;  /* [pieces][AMBULO__GAUSS_POINTS][feet or patches][3], N */
  double *step;            /* [effectors][3], N s */
} samples;

static int allocate(const ambulo_problem *p, const ambulo_allocator *a, samples *s) {
  size_t feet = (size_t)p->model->foot_count, patches = (size_t)p->model->patch_count;
  size_t most =
      (size_t)ambulo__basis_intervals(p->basis) + 2 * (size_t)ambulo_problem_contact_count(p) + 2;
  s->ends = ambulo__alloc(a, most, sizeof(double));
  s->times = ambulo__alloc(a, most * AMBULO__GAUSS_POINTS, sizeof(double));
  s->weights = ambulo__alloc(a, most * AMBULO__GAUSS_POINTS, sizeof(double));
  s->feet = ambulo__alloc(a, most * AMBULO__GAUSS_POINTS * feet * 3, sizeof(double));
  s->patches = ambulo__alloc(a, most * AMBULO__GAUSS_POINTS * patches * 3, sizeof(double));
  s->step = ambulo__alloc(a, (feet + patches) * 3, sizeof(double));
  return s->ends && s->times && s->weights && s->feet && s->patches && s->step;
}

static void release(const ambulo_allocator *a, samples *s) {
  ambulo__free(a, s->ends);
  ambulo__free(a, s->times);
  ambulo__free(a, s->weights);
  ambulo__free(a, s->feet);
  ambulo__free(a, s->patches);
  ambulo__free(a, s->step);
}

static void add_sample(double weight, const double *force, int width, double *step) {
  for (int i = 0; i < width; i++) step[i] += weight * force[i];
}

/* (I.4) Gauss's rule on the pieces */
static ambulo_status integrate(const ambulo_problem *p, ambulo_workspace *workspace,
                               const double *x, samples *s) {
  int shared = p->definition.ground_reaction.kind == AMBULO_REACTION_SHARED;
  int feet = 3 * p->model->foot_count, patches = shared ? 3 * p->model->patch_count : 0;
  int count = AMBULO__GAUSS_POINTS * pieces(p, s->ends);
  for (int k = 0; k < count; k++) {
    const double *end = s->ends + k / AMBULO__GAUSS_POINTS;
    s->times[k] = ambulo__gauss_time(k % AMBULO__GAUSS_POINTS, end[0], end[1], &s->weights[k]);
  }
  ambulo_motion motion = {.size = sizeof motion, .grf = s->feet, .patch_force = s->patches};
  ambulo_status status = ambulo_problem_motion(p, workspace, x, count, s->times, &motion);
  for (int k = 0; k < count; k++) {
    add_sample(s->weights[k], s->feet + (size_t)k * (size_t)feet, feet, s->step);
    add_sample(s->weights[k], s->patches + (size_t)k * (size_t)patches, patches, s->step + feet);
  }
  return status == AMBULO_E_NUMERIC ? AMBULO_OK : status;
}

ambulo_status ambulo__impulses(const ambulo_problem *p, const double *x,
                               const ambulo_allocator *allocator, double *impulse) {
  size_t effectors = (size_t)ambulo__effector_count(p->model);
  if (!p->channels.slots) return AMBULO_OK;
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  samples s = {NULL, NULL, NULL, NULL, NULL, NULL};
  ambulo_workspace *workspace = NULL;
  ambulo_status status = allocate(p, &own, &s) ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = ambulo_workspace_create(p, &own, &workspace);
  if (!status) status = integrate(p, workspace, x, &s);
  if (!status) {
    memcpy(impulse, s.step, 3 * effectors * sizeof *impulse);
    if (ambulo_problem_ends(p) == AMBULO_ENDS_MIRRORED) add_mirror_image(p->model, s.step, impulse);
  }
  ambulo_workspace_free(workspace);
  release(&own, &s);
  return status;
}
