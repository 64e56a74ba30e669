/* people/stride_loads.c - forces on feet and patches in a mirrored stride.
 *
 * In the mirror image foot m takes the place of foot i, and patches likewise. Across the sagittal
 * plane forces keep their forward and upward parts and turn the one along left, places also move on
 * by the travel and the rise, and a moment about the normal changes its sign:
 *
 *     grf_m = grf_i - 2 (grf_i . l) l,   cop_m = cop_i - 2 (cop_i . l) l + travel f + rise n,
 *     T_m = -T_i
 *
 * and a moment M about the origin, an axial vector, keeps its part along left and turns the others,
 * then has the force further on:
 *
 *     M_m = 2 (M_i . l) l - M_i + (travel f + rise n) x grf_m
 */
#include "base/arithmetic.h"
#include "people/stride.h"

#include <math.h>

/* forces, centres and moments about the origin, then free moments */
static int allocate(const ambulo__stride *s, int of, double **const vectors[3],
                    double **free_moment) {
  size_t count = (size_t)s->samples * (size_t)of;
  int complete = 1;
  if (!of) return 1;
  for (int i = 0; i < 3; i++) {
    *vectors[i] = ambulo__alloc(&s->allocator, 3 * count, sizeof(double));
    complete &= *vectors[i] != NULL;
  }
  *free_moment = ambulo__alloc(&s->allocator, count, sizeof(double));
  return complete && *free_moment;
}

ambulo_status ambulo__stride_feet_allocate(ambulo__stride *s) {
  double **const of_feet[3] = {&s->grf, &s->cop, &s->grf_moment};
  double **const of_patches[3] = {&s->patch_force, &s->patch_cop, &s->patch_moment};
  int feet = allocate(s, s->feet, of_feet, &s->free_moment);
  int patches = allocate(s, s->patches, of_patches, &s->patch_free_moment);
  return feet && patches ? AMBULO_OK : AMBULO_E_MEMORY;
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

/* what feet or patches carry at one time */
typedef struct carried {
  double *force, *cop, *free_moment, *moment;
} carried;

/* of the mirrored force */
static void mirror_moment(const ambulo__stride *s, const double *force, double *moment) {
  double on[3] = {0.0, 0.0, 0.0};
  mirror_vector(s->model, moment);
  for (int i = 0; i < 3; i++) moment[i] = -moment[i];
  ambulo__stride_mirror_place(s, on);
  ambulo__add_cross(on, force, 1.0, moment);
}

static void mirror_all(const ambulo__stride *s, const carried *c, int count) {
  for (int i = 0; i < count; i++) {
    mirror_vector(s->model, c->force + 3 * i);
    ambulo__stride_mirror_place(s, c->cop + 3 * i);
    c->free_moment[i] = -c->free_moment[i];
    mirror_moment(s, c->force + 3 * i, c->moment + 3 * i);
  }
}

/* i takes the place of m, its mirror image, and m that of i */
static void exchange_sides(const carried *c, int i, int m) {
  if (m <= i) return;
  exchange(c->force + 3 * i, c->force + 3 * m, 3);
  exchange(c->cop + 3 * i, c->cop + 3 * m, 3);
  exchange(c->free_moment + i, c->free_moment + m, 1);
  exchange(c->moment + 3 * i, c->moment + 3 * m, 3);
}

void ambulo__stride_feet_mirror(ambulo__stride *s, int k) {
  size_t foot = (size_t)k * (size_t)s->feet, patch = (size_t)k * (size_t)s->patches;
  if (s->feet > 0) {
    carried feet = {s->grf + 3 * foot, s->cop + 3 * foot, s->free_moment + foot,
                    s->grf_moment + 3 * foot};
    mirror_all(s, &feet, s->feet);
    for (int i = 0; i < s->feet; i++) exchange_sides(&feet, i, s->model->feet[i].mirror);
  }
  if (s->patches > 0) {
    carried patches = {s->patch_force + 3 * patch, s->patch_cop + 3 * patch,
                       s->patch_free_moment + patch, s->patch_moment + 3 * patch};
    mirror_all(s, &patches, s->patches);
    for (int i = 0; i < s->patches; i++) exchange_sides(&patches, i, s->model->patches[i].mirror);
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

const double *ambulo__stride_patch_force(const ambulo__stride *s, int k, int patch) {
  return s->patch_force + 3 * ((size_t)k * (size_t)s->patches + (size_t)patch);
}

double ambulo__stride_patch_peak(const ambulo__stride *s, int patch) {
  double peak = 0.0;
  for (int k = 0; k < s->samples; k++) {
    const double *f = ambulo__stride_patch_force(s, k, patch);
    peak = fmax(peak, sqrt(ambulo__dot(f, f)) / ambulo__model_weight(s->model));
  }
  return peak;
}

/* what devices do over a stride (stride.h).
 *
 * In the mirrored step a device does what its partner did, with the opposite sign at a coordinate
 * that the mirror turns round; power stays. Work by the trapezoidal rule on the samples.
 */

ambulo_status ambulo__stride_devices_allocate(ambulo__stride *s) {
  size_t count = (size_t)s->samples * (size_t)s->devices;
  double **arrays[] = {&s->effort, &s->along, &s->power};
  for (int i = 0; s->devices && i < 3; i++) {
    *arrays[i] = ambulo__alloc(&s->allocator, count, sizeof(double));
    if (!*arrays[i]) return AMBULO_E_MEMORY;
  }
  return AMBULO_OK;
}

static void stride_devices_exchange(double *row, int a, int b, double sign) {
  double own = row[a];
  row[a] = sign * row[b];
  if (a != b) row[b] = sign * own;
}

void ambulo__stride_devices_mirror(ambulo__stride *s, int k) {
  size_t at = (size_t)k * (size_t)s->devices;
  for (int i = 0; i < s->devices; i++) {
    double sign;
    int partner = ambulo__device_partner(&s->problem->definition, i, &sign);
    if (partner < i) continue;
    stride_devices_exchange(s->effort + at, i, partner, sign);
    stride_devices_exchange(s->along + at, i, partner, sign);
    stride_devices_exchange(s->power + at, i, partner, 1.0);
  }
}

ambulo__device_work ambulo__stride_device_work(const ambulo__stride *s, int device) {
  ambulo__device_work work = {0.0, 0.0, 0.0};
  for (int k = 0; k < s->samples; k++) {
    size_t at = (size_t)k * (size_t)s->devices + (size_t)device;
    double before = k > 0 ? s->times[k] - s->times[k - 1] : 0.0;
    double after = k + 1 < s->samples ? s->times[k + 1] - s->times[k] : 0.0;
    double part = 0.5 * (before + after) * s->power[at];
    *(part > 0.0 ? &work.positive : &work.negative) += part;
    if (fabs(s->effort[at]) > fabs(work.peak)) work.peak = s->effort[at];
  }
  return work;
}

/* forces of hands over a stride (stride.h).
 *
 * In the mirrored step hands take one another's place: a force loses the part to the left twice, a
 * moment, which the mirror turns round, that in the mirror's plane. Work by the trapezoidal rule on
 * the samples.
 */

ambulo_status ambulo__stride_holds_allocate(ambulo__stride *s) {
  size_t count = (size_t)s->samples * (size_t)s->holds;
  if (s->holds == 0) return AMBULO_OK;
  s->hold_force = ambulo__alloc(&s->allocator, 6 * count, sizeof(double));
  s->hold_moment = ambulo__alloc(&s->allocator, 6 * count, sizeof(double));
  s->hold_power = ambulo__alloc(&s->allocator, count, sizeof(double));
  return s->hold_force && s->hold_moment && s->hold_power ? AMBULO_OK : AMBULO_E_MEMORY;
}

/* v - 2 (v . l) l, with a sign of its own */
static void reflect(const double left[3], double sign, double v[3]) {
  double part = 2.0 * ambulo__dot(left, v);
  for (int k = 0; k < 3; k++) v[k] = sign * (v[k] - part * left[k]);
}

static void stride_holds_exchange(const double left[3], double sign, double pair[6]) {
  for (int k = 0; k < 3; k++) {
    double own = pair[k];
    pair[k] = pair[3 + k];
    pair[3 + k] = own;
  }
  reflect(left, sign, pair);
  reflect(left, sign, pair + 3);
}

void ambulo__stride_holds_mirror(ambulo__stride *s, int k) {
  for (int i = 0; i < s->holds; i++) {
    size_t at = 6 * ((size_t)k * (size_t)s->holds + (size_t)i);
    if (s->problem->definition.holds[i].hand[1] < 0) {
      reflect(s->model->left, 1.0, s->hold_force + at);
      continue;
    }
    stride_holds_exchange(s->model->left, 1.0, s->hold_force + at);
    stride_holds_exchange(s->model->left, -1.0, s->hold_moment + at);
  }
}

ambulo__hand_peak ambulo__stride_hand_peak(const ambulo__stride *s, int hold, int hand) {
  ambulo__hand_peak peak = {0.0, 0.0, 0.0, 0.0};
  for (int k = 0; k < s->samples; k++) {
    size_t at = 6 * ((size_t)k * (size_t)s->holds + (size_t)hold) + 3 * (size_t)hand;
    const double *f = s->hold_force + at, *m = s->hold_moment + at;
    double force = sqrt(ambulo__dot(f, f)), moment = sqrt(ambulo__dot(m, m));
    if (force > peak.force) peak.force_time = s->times[k];
    if (moment > peak.moment) peak.moment_time = s->times[k];
    peak.force = fmax(peak.force, force);
    peak.moment = fmax(peak.moment, moment);
  }
  return peak;
}

void ambulo__stride_hold_work(const ambulo__stride *s, int hold, double work[2]) {
  work[0] = work[1] = 0.0;
  for (int k = 0; k < s->samples; k++) {
    double before = k > 0 ? s->times[k] - s->times[k - 1] : 0.0;
    double after = k + 1 < s->samples ? s->times[k + 1] - s->times[k] : 0.0;
    double power = s->hold_power[(size_t)k * (size_t)s->holds + (size_t)hold];
    work[power > 0.0 ? 0 : 1] += 0.5 * (before + after) * power;
  }
}
