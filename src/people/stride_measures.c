/* people/stride_measures.c - work of the joints, path of the centre of mass (stride_measures.h). */
#include "people/stride_measures.h"

#include "base/arithmetic.h"
#include "contact/row_families.h"
#include "contact/contacts.h"
#include "mechanics/pose.h"
#include "people/stride.h"
#include "trajectory/quadrature.h"

#include <math.h>
#include <string.h>

/* trapezoidal rule on the samples */
static void add_work(const ambulo__stride *s, ambulo__economy *e) {
  size_t d = (size_t)s->coordinates;
  for (int k = 0; k < s->samples; k++) {
    double before = k > 0 ? s->times[k] - s->times[k - 1] : 0.0;
    double after = k + 1 < s->samples ? s->times[k + 1] - s->times[k] : 0.0;
    for (int i = 0; i < s->coordinates; i++) {
      if (!s->model->coordinates[i].actuated) continue;
      size_t at = (size_t)k * d + (size_t)i;
      double work = 0.5 * (before + after) * s->tau[at] * s->qd[at];
      *(work > 0.0 ? &e->positive[i] : &e->negative[i]) += work;
    }
  }
  for (int i = 0; i < s->coordinates; i++) {
    e->positive_sum += e->positive[i];
    e->negative_sum += e->negative[i];
  }
}

typedef struct extent {
  double least, most;
} extent;

static void widen(extent *e, double value) {
  e->least = fmin(e->least, value);
  e->most = fmax(e->most, value);
}

/* how far heels go: standing up and lifting move the centre of mass, but the body goes nowhere */
static void follow_feet(const ambulo__stride *s, ambulo__pose *pose, ambulo__economy *e) {
  const ambulo_model *m = s->model;
  double first[3], last[3];
  const double *end = s->q + (size_t)(s->samples - 1) * (size_t)s->coordinates;
  for (int f = 0; f < m->foot_count; f++) {
    const ambulo_point *heel = &m->points[m->feet[f].heel_center];
    ambulo__pose_at(pose, s->q);
    ambulo__pose_point(pose, heel->link, heel->position, first);
    ambulo__pose_at(pose, end);
    ambulo__pose_point(pose, heel->link, heel->position, last);
    e->feet = fmax(e->feet, ambulo__dot(last, m->forward) - ambulo__dot(first, m->forward));
  }
}

/* the rise is measured from a line from the first to the last place: stairs are no excursion */
static void follow_center(const ambulo__stride *s, ambulo__pose *pose, ambulo__economy *e) {
  const ambulo_model *m = s->model;
  double first[3], last[3], center[3], way[3];
  extent up = {INFINITY, -INFINITY}, left = up;
  size_t d = (size_t)s->coordinates;
  ambulo__pose_at(pose, s->q);
  ambulo__pose_center_of_mass(pose, first);
  ambulo__pose_at(pose, s->q + (size_t)(s->samples - 1) * d);
  ambulo__pose_center_of_mass(pose, last);
  for (int i = 0; i < 3; i++) way[i] = last[i] - first[i];
  double climbed = ambulo__dot(way, m->up);
  for (int k = 0; k < s->samples; k++) {
    double part = (s->times[k] - s->times[0]) / s->duration;
    ambulo__pose_at(pose, s->q + (size_t)k * d);
    ambulo__pose_center_of_mass(pose, center);
    widen(&up, ambulo__dot(center, m->up) - part * climbed);
    widen(&left, ambulo__dot(center, m->left));
  }
  e->distance = ambulo__dot(way, m->forward);
  e->rise = up.most - up.least;
  e->sway = left.most - left.least;
}

ambulo_status ambulo__economy_of(const ambulo__stride *stride, const ambulo_allocator *allocator,
                                 ambulo__economy *economy) {
  ambulo__economy e = {.allocator = ambulo__allocator_or_default(allocator)};
  ambulo__pose pose = {.model = NULL};
  size_t count = (size_t)stride->coordinates;
  e.positive = ambulo__alloc(&e.allocator, count, sizeof *e.positive);
  e.negative = ambulo__alloc(&e.allocator, count, sizeof *e.negative);
  ambulo_status status = e.positive && e.negative ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = ambulo__pose_create(stride->model, &e.allocator, &pose);
  if (status) {
    ambulo__economy_free(&e);
    return status;
  }
  add_work(stride, &e);
  follow_center(stride, &pose, &e);
  follow_feet(stride, &pose, &e);
  ambulo__pose_free(&pose);
  *economy = e;
  return AMBULO_OK;
}

void ambulo__economy_free(ambulo__economy *economy) {
  ambulo__free(&economy->allocator, economy->positive);
  ambulo__free(&economy->allocator, economy->negative);
  economy->positive = economy->negative = NULL;
}

/* impulses of the ground's force, by the quadrature of the motion.
 *
 * Between neighbouring breakpoints of the trajectory and changes of contact the motion is a
 * polynomial and the share of each foot is smooth. Each such piece is integrated by Gauss's rule
 * (trajectory/quadrature.h), so that the sum over feet and patches obeys
 *
 *     sum_f int F_f dt = m (v_com(end) - v_com(0)) - m g (end - 0)
 *
 * to rounding, which sums over the time nodes do not: the force jumps and bends between them. The
 * mirror image of a step (people/stride_loads.c) adds J - 2 (J . l) l of the mirror foot. */

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

typedef struct impulse_samples {
  double *ends;            /* [pieces + 1] */
  double *times, *weights; /* [pieces][AMBULO__GAUSS_POINTS], s */
  double *feet, *patches;  /* [pieces][AMBULO__GAUSS_POINTS][feet or patches][3], N */
  double *step;            /* [effectors][3], N s */
} impulse_samples;

static int allocate(const ambulo_problem *p, const ambulo_allocator *a, impulse_samples *s) {
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

static void release(const ambulo_allocator *a, impulse_samples *s) {
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
                               const double *x, impulse_samples *s) {
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
  impulse_samples s = {NULL, NULL, NULL, NULL, NULL, NULL};
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

typedef struct approaches {
  const ambulo_problem *problem;
  ambulo__approach *list;
  ambulo__solid *solid; /* [count], with ends at 0 and 6 of `ends` */
  int *capsule[2];      /* [count]; of an obstacle the second is -1 */
  int count;
} approaches;

static void add(approaches *a, const ambulo__solid *solid, int one, int other) {
  const ambulo_model *m = a->problem->model;
  int is_obstacle = other < 0, at = a->count++;
  a->solid[at] = *solid;
  a->solid[at].one = 0;
  a->solid[at].other = 6;
  a->capsule[0][at] = one;
  a->capsule[1][at] = other;
  a->list[at] = (ambulo__approach){m->capsules[one].name,
                                   is_obstacle ? a->problem->definition.obstacles[solid->about].name
                                               : m->capsules[other].name,
                                   is_obstacle, (double)NAN, (double)NAN};
}

static void list_all(approaches *a) {
  const ambulo_problem_definition *d = &a->problem->definition;
  int pairs = ambulo_problem_pairs(a->problem, 0, NULL);
  for (int k = 0; k < pairs; k++) {
    ambulo__solid solid = ambulo__solid_of_pair(d, d->collision.pairs[k]);
    add(a, &solid, d->collision.pairs[k].one, d->collision.pairs[k].other);
  }
  for (int o = 0; o < d->obstacle_count; o++) {
    for (int i = 0; i < ambulo__obstacle_capsules(d, o); i++) {
      int capsule = ambulo__obstacle_capsule(d, o, i);
      ambulo__solid solid = ambulo__solid_near_obstacle(d, o, capsule);
      add(a, &solid, capsule, -1);
    }
  }
}

static void look(approaches *a, const ambulo__pose *pose, double time) {
  for (int k = 0; k < a->count; k++) {
    double ends[12] = {0.0};
    for (int c = 0; c < 2 && a->capsule[c][k] >= 0; c++) {
      const ambulo_capsule *capsule = &a->problem->model->capsules[a->capsule[c][k]];
      ambulo__pose_point(pose, capsule->link, capsule->from, ends + 6 * c);
      ambulo__pose_point(pose, capsule->link, capsule->to, ends + 6 * c + 3);
    }
    double gap = ambulo__solid_gap(&a->solid[k], ends, 1);
    if (!(gap >= a->list[k].gap)) { /* also the first one */
      a->list[k].gap = gap;
      a->list[k].time = time;
    }
  }
}

static int approach_allocate(approaches *a, size_t most, const ambulo_allocator *allocator) {
  a->list = ambulo__alloc(allocator, most, sizeof *a->list);
  a->solid = ambulo__alloc(allocator, most, sizeof *a->solid);
  a->capsule[0] = ambulo__alloc(allocator, 2 * most, sizeof *a->capsule[0]);
  a->capsule[1] = a->capsule[0] ? a->capsule[0] + most : NULL;
  return a->list && a->solid && a->capsule[0];
}

ambulo_status ambulo__approaches(const ambulo_problem *p, const double *x, int samples,
                                 const ambulo_allocator *allocator, ambulo__approach **list,
                                 int *count) {
  approaches a = {.problem = p};
  ambulo__stride stride = {.samples = 0};
  ambulo__pose pose = {.model = NULL};
  size_t most = (size_t)ambulo_problem_pairs(p, 0, NULL);
  for (int o = 0; o < p->definition.obstacle_count; o++)
    most += (size_t)ambulo__obstacle_capsules(&p->definition, o);
  ambulo_status status = approach_allocate(&a, most + 1, allocator) ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = ambulo__pose_create(p->model, allocator, &pose);
  if (!status) status = ambulo__stride_create(p, x, samples, allocator, &stride);
  if (!status) {
    list_all(&a);
    for (int k = 0; k < stride.samples; k++) {
      ambulo__pose_at(&pose, stride.q + (size_t)k * (size_t)stride.coordinates);
      look(&a, &pose, stride.times[k]);
    }
    *list = a.list;
    *count = a.count;
    a.list = NULL;
  }
  ambulo__stride_free(&stride);
  ambulo__pose_free(&pose);
  ambulo__free(allocator, a.list);
  ambulo__free(allocator, a.solid);
  ambulo__free(allocator, a.capsule[0]);
  return status;
}
