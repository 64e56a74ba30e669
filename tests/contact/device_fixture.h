/* tests/contact/device_fixture.h - random devices on random trees, and a dense reference in complex
 * numbers: every link is placed from the world on, by matrices, and every coordinate above a point
 * counts, those that both points share too. */
#ifndef TESTS_DEVICE_DEVICE_FIXTURE_H
#define TESTS_DEVICE_DEVICE_FIXTURE_H

#include <complex.h>

#include "contact/devices.h"
#include "model/model.h"
#include "support/random_model.h"
#include "support/test.h"

enum { device_case_count = 160, most_devices = 6, most_coordinates = 40 };

typedef double complex number;

typedef struct device_case {
  random_tree tree;
  ambulo_model *model;
  ambulo_device device[most_devices];
  ambulo_problem_definition definition;
  ambulo__devices *devices;
  int d, n;
  double q[most_coordinates * AMBULO__LANES], qd[most_coordinates * AMBULO__LANES];
  double told[most_devices * AMBULO__LANES], *scratch;
} device_case;

static inline void random_device(random_source *source, const ambulo_model *m,
                                 ambulo_device *device) {
  *device = ambulo_device_default((ambulo_device_kind)(1 + random_below(source, 3)));
  device->name = "device";
  device->stiffness = random_between(source, 1, 300);
  device->rest = random_between(source, -0.3, 0.6);
  device->pretension = random_between(source, -10, 10);
  device->side = (ambulo_device_side)(1 + random_below(source, 3));
  device->smoothing = random_between(source, 0.01, 2);
  device->damping = random_between(source, 0, 20);
  device->amount = random_between(source, -30, 30);
  if (random_unit(source) < 0.3) {
    device->coordinate = random_below(source, m->coordinate_count);
    return;
  }
  for (int end = 0; end < 2; end++) {
    device->link[end] = random_below(source, m->link_count);
    for (int k = 0; k < 3; k++) device->position[end][k] = random_between(source, -0.4, 0.4);
  }
}

static inline void device_case_open(device_case *c, int index) {
  random_source source = {4000 + (uint64_t)index};
  random_tree_make(&c->tree, 91 * (uint64_t)index + 3, 1 + index % (most_coordinates - 2));
  if (index % 4 == 1) random_tree_couple(&c->tree, (uint64_t)index);
  assert_int_equal(ambulo_model_create(&c->tree.definition, NULL, NULL, &c->model), AMBULO_OK);
  c->d = c->model->coordinate_count;
  c->n = 1 + random_below(&source, most_devices);
  for (int i = 0; i < c->n; i++) random_device(&source, c->model, &c->device[i]);
  c->definition = ambulo_problem_definition_default();
  c->definition.model = c->model;
  c->definition.devices = c->device;
  c->definition.device_count = c->n;
  c->devices = NULL;
  assert_int_equal(ambulo__devices_create(&c->definition, NULL, &c->devices), AMBULO_OK);
  for (int i = 0; i < c->d * AMBULO__LANES; i++) {
    c->q[i] = random_pose(&source, index % random_poses);
    c->qd[i] = random_between(&source, -2, 2);
  }
  for (int i = 0; i < c->n * AMBULO__LANES; i++)
    c->told[i] = random_unit(&source) < 0.2 ? 0.0 : random_between(&source, 0.1, 1.0);
  c->scratch = calloc(ambulo__devices_scratch(c->devices) + 1, sizeof *c->scratch);
  assert_non_null(c->scratch);
}

static inline void device_case_close(device_case *c) {
  free(c->scratch);
  ambulo__devices_free(c->devices);
  ambulo_model_free(c->model);
}

/* ---------------------------------------------------------------- reference */

/* where the joint of a link stands, and its derivative by the coordinate that moves it */
static inline number reference_value(const ambulo_model *m, int link, const number *q,
                                     number *slope) {
  const ambulo_link *of = &m->links[link];
  *slope = of->coordinate >= 0;
  if (of->coordinate >= 0) return q[of->coordinate];
  if (of->coupled_to < 0) return 0;
  number x = q[of->coupled_to], sum = 0;
  const ambulo__piece *piece = ambulo__coupling_piece(&m->couplings[link], creal(x));
  for (int i = AMBULO__COUPLING_TERMS - 1; i >= 0; i--) {
    *slope = *slope * (x - piece->at) + sum;
    sum = sum * (x - piece->at) + piece->c[i];
  }
  return sum;
}

/* rows of the 3 x 4 frame of a link, and in front of its joint */
static inline void reference_frame(const ambulo_model *m, int link, const number *q, int before,
                                   number frame[12]) {
  number above[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  if (link < 0) {
    memcpy(frame, above, sizeof above);
    return;
  }
  const ambulo_link *of = &m->links[link];
  reference_frame(m, of->parent, q, 0, above);
  number slope, move = before ? 0 : reference_value(m, link, q, &slope);
  number theta = of->theta + (of->type == AMBULO_REVOLUTE ? move : 0);
  number along = of->d + (of->type == AMBULO_PRISMATIC ? move : 0);
  number ct = ccos(theta), st = csin(theta), ca = cos(of->alpha), sa = sin(of->alpha);
  const number t[12] = {ct,       -st * ca,   st * sa, of->a * ct, st, ct * ca,
                        -ct * sa, of->a * st, 0,       sa,         ca, along};
  if (before) {
    memcpy(frame, above, sizeof above);
    return;
  }
  for (int r = 0; r < 3; r++) {
    for (int k = 0; k < 4; k++) {
      number sum = k == 3 ? above[4 * r + 3] : 0;
      for (int j = 0; j < 3; j++) sum += above[4 * r + j] * t[4 * j + k];
      frame[4 * r + k] = sum;
    }
  }
}

static inline void reference_point(const ambulo_model *m, int link, const double local[3],
                                   const number *q, number point[3]) {
  number f[12];
  reference_frame(m, link, q, 0, f);
  for (int r = 0; r < 3; r++)
    point[r] =
        f[4 * r] * local[0] + f[4 * r + 1] * local[1] + f[4 * r + 2] * local[2] + f[4 * r + 3];
}

/* adds factor u . dp/dq to slope[d] */
static inline void reference_slopes(const ambulo_model *m, int link, const number p[3],
                                    const number *q, const number u[3], double factor,
                                    number *slope) {
  for (; link >= 0; link = m->links[link].parent) {
    number f[12], arm[3], turned[3], sum = 0, by;
    const int coordinate = ambulo__moved_by(m, link);
    if (coordinate < 0) continue;
    (void)reference_value(m, link, q, &by);
    reference_frame(m, link, q, 1, f);
    const number z[3] = {f[2], f[6], f[10]};
    for (int k = 0; k < 3; k++) arm[k] = p[k] - f[4 * k + 3];
    for (int k = 0; k < 3; k++) {
      int i = (k + 1) % 3, j = (k + 2) % 3;
      turned[k] = z[i] * arm[j] - z[j] * arm[i];
    }
    for (int k = 0; k < 3; k++)
      sum += u[k] * (m->links[link].type == AMBULO_REVOLUTE ? turned[k] : z[k]);
    slope[coordinate] += factor * by * sum;
  }
}

/* s, and ds/dq */
static inline number reference_along(const ambulo_model *m, const ambulo_device *v, const number *q,
                                     number *slope) {
  number a[3], b[3], u[3], square = 1e-18; /* (1 nm)^2, as in the source */
  memset(slope, 0, (size_t)m->coordinate_count * sizeof *slope);
  if (v->coordinate >= 0) {
    slope[v->coordinate] = 1;
    return q[v->coordinate];
  }
  reference_point(m, v->link[0], v->position[0], q, a);
  reference_point(m, v->link[1], v->position[1], q, b);
  for (int k = 0; k < 3; k++) square += (b[k] - a[k]) * (b[k] - a[k]);
  number s = csqrt(square);
  for (int k = 0; k < 3; k++) u[k] = (b[k] - a[k]) / s;
  reference_slopes(m, v->link[0], a, q, u, -1, slope);
  reference_slopes(m, v->link[1], b, q, u, 1, slope);
  return s;
}

/* r and its integral of a spring of one side */
static inline number reference_ramp(number x, double b, number *energy) {
  number u = x / b + 0.5;
  *energy = 0;
  if (creal(u) <= 0) return 0;
  if (creal(u) >= 1) {
    *energy = 0.5 * x * x + b * b / 40;
    return x;
  }
  *energy = b * b * (u * u * u * u / 4 - u * u * u * u * u / 10);
  return b * (u * u * u - u * u * u * u / 2);
}

/* E, and the energy that a spring holds at that */
static inline number reference_effort(const ambulo_device *v, number s, number sd, double factor,
                                      number *energy) {
  double g = v->coordinate >= 0 ? 1 : -1;
  number x = s - v->rest + v->pretension / v->stiffness, h = x;
  *energy = 0;
  if (v->kind == AMBULO_DEVICE_DAMPER) return -g * factor * v->damping * sd;
  if (v->kind == AMBULO_DEVICE_ACTUATOR) return factor * v->amount;
  *energy = 0.5 * x * x;
  if (v->side == AMBULO_DEVICE_ABOVE) h = reference_ramp(x, v->smoothing, energy);
  if (v->side == AMBULO_DEVICE_BELOW) h = -reference_ramp(-x, v->smoothing, energy);
  *energy *= factor * v->stiffness;
  return -g * factor * v->stiffness * h;
}

/* E, its generalized forces added to force[d], times `factor` */
static inline number reference_device(const ambulo_model *m, const ambulo_device *v,
                                      const number *q, const number *qd, double told,
                                      number *force) {
  number slope[most_coordinates], sd = 0, energy;
  number s = reference_along(m, v, q, slope);
  for (int i = 0; i < m->coordinate_count; i++) sd += slope[i] * qd[i];
  number effort = reference_effort(v, s, sd, told, &energy);
  for (int i = 0; i < m->coordinate_count; i++)
    force[i] += (v->coordinate >= 0 ? 1 : -1) * effort * slope[i];
  return effort;
}

static inline void lane_state(const device_case *c, int lane, number *q, number *qd) {
  for (int i = 0; i < c->d; i++) {
    q[i] = c->q[i * AMBULO__LANES + lane];
    qd[i] = c->qd[i * AMBULO__LANES + lane];
  }
}

/* Forces of all at a lane, and the efforts; `step` on entry k of q and then qd, -1: none. */
static inline void reference_all(const device_case *c, int lane, int k, double step, number *force,
                                 number *effort) {
  number q[most_coordinates], qd[most_coordinates];
  lane_state(c, lane, q, qd);
  if (k >= 0 && k < c->d) q[k] += step * I;
  if (k >= c->d) qd[k - c->d] += step * I;
  memset(force, 0, (size_t)c->d * sizeof *force);
  for (int i = 0; i < c->n; i++)
    effort[i] =
        reference_device(c->model, &c->device[i], q, qd, c->told[i * AMBULO__LANES + lane], force);
}

#endif
