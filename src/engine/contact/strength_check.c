/* contact/strength_check.c - can the joints carry the body at rest?
 *
 * Standing still in the neutral pose (q = 0), half the weight on each foot, both centres of
 * pressure under the centre of mass. The height z_f of that point of foot f gives the torques:
 *
 *     tau_i = tau_i(gravity alone) - sum_f (m g / 2) dz_f / dq_i
 *
 * by central differences, exact enough for a comparison. The centre of mass follows from the
 * root wrench: F = m g n, M = r x F. A torque beyond its limits is a warning, not an error: a
 * motion need not pass through this pose. Each joint is held against the model's own limits, also
 * with mirrored ends (contact/bounds.h): this pose is symmetric, so its partner is held against its
 * own as well.
 */
#include "mechanics/lagrangian.h"
#include "ambulo/mechanics.h"
#include "base/arithmetic.h"
#include "contact/gait.h"

#include <math.h>

static const double step = 1e-5; /* rad, m */

typedef struct standing {
  const ambulo_model *model;
  double *q, *zero, *tau, *torque, *wrench, *points;
  void *scratch;
} standing;

static ambulo_status evaluate(const standing *s) {
  return ambulo__lagrangian_inverse_dynamics(
      s->model, s->q, s->zero, s->zero,
      &(ambulo_outputs){
          .size = sizeof(ambulo_outputs), .tau = s->tau, .wrench = s->wrench, .points = s->points},
      s->scratch);
}

/* place of the centre of pressure between heel (0) and toe (1) of a foot */
static double pressure_at(const standing *s, const ambulo_foot *foot) {
  const ambulo_model *m = s->model;
  const double *heel = s->points + 3 * foot->heel_center, *toe = s->points + 3 * foot->toe_center;
  /* l . (r x F) = r . (F x l) = |F| r . (n x l) = -|F| r . f */
  double center = -ambulo__dot(m->left, s->wrench) / ambulo__dot(m->up, s->wrench + 3);
  return (center - ambulo__dot(m->forward, heel)) /
         (ambulo__dot(m->forward, toe) - ambulo__dot(m->forward, heel));
}

static double height(const standing *s, const ambulo_foot *foot, double share) {
  const double *heel = s->points + 3 * foot->heel_center, *toe = s->points + 3 * foot->toe_center;
  const double *up = s->model->up;
  return (1.0 - share) * ambulo__dot(up, heel) + share * ambulo__dot(up, toe);
}

/* torque = tau - the feet's part; 1 when the centre of mass stands over both feet */
static ambulo_status stand(standing *s, int *over) {
  const ambulo_model *m = s->model;
  ambulo_status status = evaluate(s);
  if (status) return status;
  double half = 0.5 * ambulo__dot(m->up, s->wrench + 3), share[2] = {0.0, 0.0};
  *over = 1;
  for (int f = 0; f < 2; f++) {
    share[f] = pressure_at(s, &m->feet[f]);
    if (!(share[f] >= 0.0 && share[f] <= 1.0)) *over = 0;
  }
  for (int i = 0; i < m->coordinate_count; i++) s->torque[i] = s->tau[i];
  for (int i = 0; i < m->coordinate_count; i++) {
    for (int side = -1; side <= 1; side += 2) {
      s->q[i] = (double)side * step;
      status = evaluate(s);
      if (status) return status;
      for (int f = 0; f < 2; f++)
        s->torque[i] -= (double)side * half * height(s, &m->feet[f], share[f]) / (2.0 * step);
    }
    s->q[i] = 0.0;
  }
  return AMBULO_OK;
}

static void compare(const standing *s, ambulo_diagnostics *list) {
  for (int i = 0; i < s->model->coordinate_count; i++) {
    const ambulo_coordinate *c = &s->model->coordinates[i];
    const char *unit =
        ambulo__measure_text(ambulo__row_measure(AMBULO__KIND_TORQUE_LIMIT, c->type, 0));
    double tolerance = 1e-3 * fmax(1.0, fabs(s->torque[i]));
    double needed = fabs(s->torque[i]) < 1e-6 ? 0.0 : s->torque[i];
    if (s->torque[i] >= c->torque[0] - tolerance && s->torque[i] <= c->torque[1] + tolerance)
      continue;
    ambulo__warning(list, ambulo__nowhere,
                    "widen the torque limits in the model, or torque_limits: false",
                    "%s needs %.4g %s to carry the body standing still; its torque limits are %.4g "
                    "to %.4g %s",
                    c->name, needed, unit, c->torque[0], c->torque[1], unit);
  }
}

ambulo_status ambulo__strength_check(const ambulo_problem_definition *d,
                                     const ambulo_allocator *allocator, ambulo_diagnostics *list) {
  const ambulo_model *m = d->model;
  int over = 0;
  if (d->ground_reaction.kind == AMBULO_REACTION_NONE || !d->torque_limits || m->foot_count != 2)
    return AMBULO_OK;
  size_t n = (size_t)m->coordinate_count;
  standing s = {.model = m};
  s.q = ambulo__alloc(allocator, 4 * n + 6 + 3 * (size_t)m->point_count, sizeof *s.q);
  s.scratch = ambulo__alloc_aligned(allocator, 1, ambulo__lagrangian_scratch_size(m));
  ambulo_status status = s.q && s.scratch ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) {
    s.zero = s.q + n;
    s.tau = s.zero + n;
    s.torque = s.tau + n;
    s.wrench = s.torque + n;
    s.points = s.wrench + 6;
    status = stand(&s, &over);
  }
  if (!status && over) compare(&s, list);
  ambulo__free(allocator, s.q);
  ambulo__free_aligned(allocator, s.scratch);
  return status;
}
