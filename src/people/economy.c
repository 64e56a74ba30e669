/* people/economy.c - work of the joints, path of the centre of mass (economy.h). */
#include "people/economy.h"

#include "base/vector.h"
#include "mechanics/pose.h"

#include <math.h>

static const double shortening = 0.25, lengthening = 1.2; /* Margaria (1968) */

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

double ambulo__economy_metabolic(const ambulo__economy *economy) {
  return economy->positive_sum / shortening - economy->negative_sum / lengthening;
}
