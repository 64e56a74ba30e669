/* stride/stride_feet.c - forces on the feet in a mirrored stride.
 *
 * In the mirror image foot m takes the place of foot i. Across the sagittal plane forces keep
 * their forward and upward parts and turn the one along left, places also move on by the travel
 * and the rise, and a moment about the normal changes its sign:
 *
 *     grf_m = grf_i - 2 (grf_i . l) l,   cop_m = cop_i - 2 (cop_i . l) l + travel f + rise n,
 *     T_m = -T_i
 */
#include <math.h>

#include "stride/stride.h"

ambulo_status ambulo__stride_feet_allocate(ambulo__stride *s) {
  if (!s->feet) return AMBULO_OK;
  size_t count = (size_t)s->samples * (size_t)s->feet;
  s->grf = ambulo__alloc(&s->allocator, 3 * count, sizeof(double));
  s->cop = ambulo__alloc(&s->allocator, 3 * count, sizeof(double));
  s->free_moment = ambulo__alloc(&s->allocator, count, sizeof(double));
  return s->grf && s->cop && s->free_moment ? AMBULO_OK : AMBULO_E_MEMORY;
}

static void mirror_vector(const ambulo_model *model, double *v) {
  double aside = 0.0;
  for (int i = 0; i < 3; i++) aside += v[i] * model->left[i];
  for (int i = 0; i < 3; i++) v[i] -= 2.0 * aside * model->left[i];
}

void ambulo__stride_mirror_place(const ambulo__stride *s, double *place) {
  const ambulo_problem_definition *d = &s->problem->definition;
  mirror_vector(s->model, place);
  for (int i = 0; i < 3; i++)
    place[i] += d->travel * s->model->forward[i] + d->rise * s->model->up[i];
}

static void exchange(double *a, double *b, int count) {
  for (int i = 0; i < count; i++) {
    double kept = a[i];
    a[i] = b[i];
    b[i] = kept;
  }
}

void ambulo__stride_feet_mirror(ambulo__stride *s, int k) {
  size_t first = (size_t)k * (size_t)s->feet;
  for (int i = 0; i < s->feet; i++) {
    size_t at = first + (size_t)i;
    mirror_vector(s->model, s->grf + 3 * at);
    ambulo__stride_mirror_place(s, s->cop + 3 * at);
    s->free_moment[at] = -s->free_moment[at];
  }
  for (int i = 0; i < s->feet; i++) {
    int m = s->model->feet[i].mirror;
    if (m <= i) continue;
    size_t a = first + (size_t)i, b = first + (size_t)m;
    exchange(s->grf + 3 * a, s->grf + 3 * b, 3);
    exchange(s->cop + 3 * a, s->cop + 3 * b, 3);
    exchange(s->free_moment + a, s->free_moment + b, 1);
  }
}

double ambulo__stride_force(const ambulo__stride *s, int k, int foot, const double direction[3]) {
  double weight = ambulo__model_weight(s->model);
  const double *force = s->grf + 3 * ((size_t)k * (size_t)s->feet + (size_t)foot);
  return (force[0] * direction[0] + force[1] * direction[1] + force[2] * direction[2]) / weight;
}

double ambulo__stride_peak(const ambulo__stride *s, int foot) {
  double peak = 0.0;
  for (int k = 0; k < s->samples; k++)
    peak = fmax(peak, ambulo__stride_force(s, k, foot, s->model->up));
  return peak;
}
