/* people/walking_cost.c - see walking_cost.h. Sums are over the intervals of the samples: work of a
 * foot is its mean force times the way of the centre of mass. */
#include "people/walking_cost.h"

#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "mechanics/pose.h"

#include <math.h>

static const double efficiency = 0.22;
static const double damping = 2.85;      /* 1/s */
static const double recoil = 0.0182;     /* of m g D */
static const double force = 0.539;       /* s */
static const double shortest_way = 0.01; /* m */

double ambulo__people_walking_cost(double speed) {
  if (!(speed >= 0.65 && speed <= 1.85)) return NAN;
  return (2.02 + 1.33 * speed * speed - 1.25) / speed;
}

static double size_of(const double v[3]) {
  return sqrt(ambulo__dot(v, v));
}

static const double *force_of(const ambulo__stride *s, int k, int foot) {
  return s->grf + 3 * ((size_t)k * (size_t)s->feet + (size_t)foot);
}

static int in_air(const ambulo__stride *s, int k, int foot) {
  return !(size_of(force_of(s, k, foot)) > 1e-9 * ambulo__model_weight(s->model));
}

/* how often it comes down, the end being followed by the beginning */
static int landings(const ambulo__stride *s, int foot) {
  int count = 0;
  for (int k = 1; k < s->samples; k++) count += in_air(s, k - 1, foot) && !in_air(s, k, foot);
  return count + (in_air(s, s->samples - 1, foot) && !in_air(s, 0, foot));
}

static int is_walk(const ambulo__stride *s) {
  const ambulo_problem_definition *d = &s->problem->definition;
  ambulo_ends ends = ambulo_problem_ends(s->problem);
  if (ends != AMBULO_ENDS_MIRRORED && ends != AMBULO_ENDS_PERIODIC) return 0;
  if (s->feet < 2 || s->devices || s->holds) return 0;
  for (int p = 0; p < s->patches; p++)
    if (ambulo__patch_is_used(d, p)) return 0;
  for (int k = 0; k < s->samples; k++) {
    int air = 0;
    for (int f = 0; f < s->feet; f++) air += in_air(s, k, f);
    if (air == s->feet) return 0;
  }
  for (int f = 0; f < s->feet; f++)
    if (landings(s, f) == 0) return 0;
  return 1;
}

/* sum of |tau| of the joints from the foot to the root */
static double leg_torque(const ambulo__stride *s, int k, int foot) {
  const ambulo_model *m = s->model;
  const double *tau = s->tau + (size_t)k * (size_t)s->coordinates;
  double sum = 0.0;
  for (int i = m->points[m->feet[foot].heel_center].link; i >= 0; i = m->links[i].parent) {
    int c = m->links[i].coordinate;
    if (c >= 0 && m->coordinates[c].actuated) sum += fabs(tau[c]);
  }
  return sum;
}

/* n^2 I / A^2 */
static double swing_of(const ambulo__stride *s, int foot) {
  double air = 0.0, torque = 0.0, times = landings(s, foot);
  for (int k = 0; k + 1 < s->samples; k++) {
    if (!in_air(s, k, foot) || !in_air(s, k + 1, foot)) continue;
    double step = s->times[k + 1] - s->times[k];
    air += step;
    torque += 0.5 * step * (leg_torque(s, k, foot) + leg_torque(s, k + 1, foot));
  }
  return air > 0.0 ? times * times * torque / (air * air) : 0.0;
}

/* W and U, from places[samples][3] of the centre of mass */
static void follow(const ambulo__stride *s, const double *places, ambulo__walking_cost *cost) {
  const double *last = places + 3 * (size_t)(s->samples - 1);
  double span = s->times[s->samples - 1] - s->times[0];
  for (int k = 0; k + 1 < s->samples; k++) {
    const double *here = places + 3 * (size_t)k;
    double step = s->times[k + 1] - s->times[k], way[3], off[3];
    if (!(step > 0.0)) continue;
    for (int i = 0; i < 3; i++) {
      way[i] = here[3 + i] - here[i];
      off[i] = way[i] / step - (last[i] - places[i]) / span;
    }
    cost->unsteadiness += s->model->mass * step * ambulo__dot(off, off);
    for (int f = 0; f < s->feet; f++) {
      double work =
          0.5 * (ambulo__dot(force_of(s, k, f), way) + ambulo__dot(force_of(s, k + 1, f), way));
      cost->limbs += fmax(0.0, work);
    }
  }
}

static double people_there(const ambulo__stride *s, double distance) {
  const ambulo_model *m = s->model;
  const double *g = m->gravity;
  int level = fabs(ambulo__dot(g, m->forward)) < 1e-6 * size_of(g);
  if (!level || ambulo__model_load_mass(m) > 0.0) return NAN;
  return ambulo__people_walking_cost(distance / s->duration);
}

/* (I.6) the law of the head */
static void estimate(const ambulo__stride *s, ambulo__walking_cost *cost) {
  const ambulo_model *m = s->model;
  double g = size_of(m->gravity), mass = m->mass - ambulo__model_load_mass(m);
  double time = sqrt(ambulo__model_size(m) * 9.81 / g);
  double work =
      cost->limbs + damping / time * cost->unsteadiness - recoil * mass * g * cost->distance;
  cost->net = fmax(0.0, work) / efficiency + force * time * cost->swing;
  cost->per_kg_metre = cost->net / (mass * cost->distance);
  cost->people = people_there(s, cost->distance);
}

ambulo_status ambulo__walking_cost_of(const ambulo__stride *s, const ambulo_allocator *allocator,
                                      ambulo__walking_cost *cost) {
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  ambulo__walking_cost c = {.is_walk = 0};
  ambulo__pose pose = {.model = NULL};
  if (!is_walk(s)) {
    *cost = c;
    return AMBULO_OK;
  }
  double *places = ambulo__alloc(&a, 3 * (size_t)s->samples, sizeof *places), way[3];
  ambulo_status status = places ? ambulo__pose_create(s->model, &a, &pose) : AMBULO_E_MEMORY;
  for (int k = 0; !status && k < s->samples; k++) {
    ambulo__pose_at(&pose, s->q + (size_t)k * (size_t)s->coordinates);
    ambulo__pose_center_of_mass(&pose, places + 3 * (size_t)k);
  }
  if (!status) {
    const double *last = places + 3 * (size_t)(s->samples - 1);
    for (int i = 0; i < 3; i++) way[i] = last[i] - places[i];
    c.distance = ambulo__dot(way, s->model->forward);
    c.is_walk = c.distance >= shortest_way;
    follow(s, places, &c);
    for (int f = 0; f < s->feet; f++) c.swing += swing_of(s, f);
    if (c.is_walk) estimate(s, &c);
    *cost = c;
  }
  ambulo__pose_free(&pose);
  ambulo__free(&a, places);
  return status;
}
