/* tests/contact/hold_fixture.h - random holds on random trees, and a reference in complex numbers:
 * accelerations by the 4 x 4 products of Hollerbach (docs/equations.md, 4 to 6), forces by the law
 * of ambulo/hold.h written as it stands there, and what they ask of the body by virtual work. */
#ifndef TESTS_DEVICE_HOLD_FIXTURE_H
#define TESTS_DEVICE_HOLD_FIXTURE_H

#include "contact/device_fixture.h"
#include "contact/devices.h"

enum { hold_case_count = 120, most_holds = 3, hold_points = 4 };
static const char *const hold_point_names[hold_points] = {"a", "b", "c", "d"};

typedef struct hold_case {
  random_tree tree;
  ambulo_model *model;
  ambulo__plan *plan;
  ambulo_hold hold[most_holds];
  ambulo_problem_definition definition;
  ambulo__holds *holds;
  int d, n;
  double q[3][most_coordinates * AMBULO__LANES]; /* q, qd, qdd */
  double told[most_holds * AMBULO__LANES], *kept;
} hold_case;

static inline void random_hold(random_source *source, const ambulo_model *m, int pair,
                               ambulo_hold *hold) {
  *hold = ambulo_hold_default();
  hold->name = "box";
  hold->hand[0] = random_below(source, m->point_count);
  hold->mass = random_between(source, 0, 12);
  for (int k = 0; k < 3; k++) hold->force[k] = random_between(source, -80, 80);
  if (!pair) return;
  hold->hand[1] = (hold->hand[0] + 1 + random_below(source, m->point_count - 1)) % m->point_count;
  hold->inertia = random_between(source, 0, 0.5);
  for (int k = 0; k < 3; k++) hold->center[k] = random_between(source, -0.2, 0.2);
}

static inline void hold_case_open(hold_case *c, int index) {
  random_source source = {7000 + (uint64_t)index};
  random_tree_make(&c->tree, 57 * (uint64_t)index + 5, 1 + index % (most_coordinates - 2));
  c->tree.definition.point_count = hold_points;
  for (int i = 0; i < hold_points; i++) { /* the last two are on one link, the last one */
    int links = c->tree.definition.link_count;
    c->tree.points[i] = (ambulo_point){.name = hold_point_names[i],
                                       .link = i < 2 ? random_below(&source, links) : links - 1};
    for (int k = 0; k < 3; k++) c->tree.points[i].position[k] = random_between(&source, -0.4, 0.4);
  }
  c->tree.definition.points = c->tree.points;
  assert_int_equal(ambulo_model_create(&c->tree.definition, NULL, NULL, &c->model), AMBULO_OK);
  assert_int_equal(ambulo__plan_create(c->model, NULL, &c->plan), AMBULO_OK);
  c->d = c->model->coordinate_count;
  c->n = 1 + random_below(&source, most_holds);
  for (int i = 0; i < c->n; i++) random_hold(&source, c->model, i != 1, &c->hold[i]);
  c->definition = ambulo_problem_definition_default();
  c->definition.model = c->model;
  c->definition.holds = c->hold;
  c->definition.hold_count = c->n;
  assert_int_equal(ambulo__holds_create(&c->definition, c->plan, NULL, &c->holds), AMBULO_OK);
  for (int o = 0; o < 3; o++)
    for (int i = 0; i < c->d * AMBULO__LANES; i++) c->q[o][i] = random_between(&source, -2, 2);
  for (int i = 0; i < c->n * AMBULO__LANES; i++)
    c->told[i] = random_unit(&source) < 0.2 ? 0.0 : random_between(&source, 0.1, 1.0);
  c->kept = calloc(ambulo__holds_entries(c->holds) + 1, sizeof *c->kept);
  assert_non_null(c->kept);
}

static inline void hold_case_close(hold_case *c) {
  free(c->kept);
  ambulo__holds_free(c->holds);
  ambulo__plan_free(c->plan);
  ambulo_model_free(c->model);
}

/* ---------------------------------------------------------------- reference */

typedef struct hold_motion {
  number q[most_coordinates], qd[most_coordinates], qdd[most_coordinates];
} hold_motion;

static inline void lane_of(const hold_case *c, int lane, hold_motion *s) {
  for (int i = 0; i < c->d; i++) {
    s->q[i] = c->q[0][i * AMBULO__LANES + lane];
    s->qd[i] = c->q[1][i * AMBULO__LANES + lane];
    s->qdd[i] = c->q[2][i * AMBULO__LANES + lane];
  }
}

/* out = a b + out, 4 x 4, times `factor` */
static inline void add_product(const number a[16], const number b[16], number factor,
                               number out[16]) {
  for (int r = 0; r < 4; r++)
    for (int k = 0; k < 4; k++)
      for (int j = 0; j < 4; j++) out[4 * r + k] += factor * a[4 * r + j] * b[4 * j + k];
}

/* T, dT/dq, d2T/dq2 of a joint */
static inline void joint_matrices(const ambulo_link *of, const number *q, number t[3][16]) {
  number move = of->coordinate >= 0 ? q[of->coordinate] : 0;
  int turns = of->type == AMBULO_REVOLUTE;
  number theta = of->theta + (turns ? move : 0), along = of->d + (turns ? 0 : move);
  number ct = ccos(theta), st = csin(theta);
  double ca = cos(of->alpha), sa = sin(of->alpha), a = of->a;
  const number zero[16] = {ct, -st * ca, st * sa, a * ct, st, ct * ca, -ct * sa, a * st,
                           0,  sa,       ca,      along,  0,  0,       0,        1};
  const number one[16] = {-st, -ct * ca, ct * sa, -a * st, ct, -st * ca, st * sa, a * ct};
  const number two[16] = {-ct, st * ca, -st * sa, -a * ct, -st, -ct * ca, ct * sa, -a * st};
  memcpy(t[0], zero, sizeof zero);
  memset(t[1], 0, sizeof t[1]);
  memset(t[2], 0, sizeof t[2]);
  if (turns) memcpy(t[1], one, sizeof one);
  if (turns) memcpy(t[2], two, sizeof two);
  if (!turns) t[1][11] = 1;
}

/* A, B, C of a link */
static inline void link_matrices(const ambulo_model *m, int link, const hold_motion *s,
                                 number abc[3][16]) {
  number above[3][16], t[3][16], rate = 0, gain = 0;
  memset(abc, 0, 3 * sizeof *abc);
  if (link < 0) {
    for (int k = 0; k < 4; k++) abc[0][5 * k] = 1;
    return;
  }
  const ambulo_link *of = &m->links[link];
  link_matrices(m, of->parent, s, above);
  joint_matrices(of, s->q, t);
  if (of->coordinate >= 0) {
    rate = s->qd[of->coordinate];
    gain = s->qdd[of->coordinate];
  }
  add_product(above[0], t[0], 1, abc[0]);
  add_product(above[1], t[0], 1, abc[1]);
  add_product(above[0], t[1], rate, abc[1]);
  add_product(above[2], t[0], 1, abc[2]);
  add_product(above[1], t[1], 2 * rate, abc[2]);
  add_product(above[0], t[2], rate * rate, abc[2]);
  add_product(above[0], t[1], gain, abc[2]);
}

/* place, velocity, acceleration of a point of the model */
static inline void reference_motion(const ambulo_model *m, int point, const hold_motion *s,
                                    number out[3][3]) {
  const double *r = m->points[point].position;
  number abc[3][16];
  link_matrices(m, m->points[point].link, s, abc);
  for (int o = 0; o < 3; o++)
    for (int k = 0; k < 3; k++)
      out[o][k] = abc[o][4 * k] * r[0] + abc[o][4 * k + 1] * r[1] + abc[o][4 * k + 2] * r[2] +
                  abc[o][4 * k + 3];
}

static inline number dot(const number a[3], const number b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cross(const number a[3], const number b[3], number out[3]) {
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    out[i] = a[j] * b[k] - a[k] * b[j];
  }
}

static inline void world(const ambulo_model *m, const double along[3], number out[3]) {
  for (int k = 0; k < 3; k++)
    out[k] = along[0] * m->forward[k] + along[1] * m->left[k] + along[2] * m->up[k];
}

/* f of both hands and the moment of each */
static inline void reference_forces(const ambulo_model *m, const ambulo_hold *h, double window,
                                    const hold_motion *s, number f[2][3], number moment[3]) {
  number one[3][3], two[3][3], o[3], push[3], carried[3], total[3];
  int pair = h->hand[1] >= 0;
  world(m, h->center, o);
  world(m, h->force, push);
  reference_motion(m, h->hand[0], s, one);
  reference_motion(m, h->hand[pair], s, two);
  for (int k = 0; k < 3; k++) {
    carried[k] = window * h->mass * (0.5 * (one[2][k] + two[2][k]) - m->gravity[k]);
    total[k] = carried[k] + window * push[k];
    moment[k] = f[1][k] = 0;
    f[0][k] = total[k];
  }
  if (!pair) return;
  number line[3], bend[3], twist[3], couple[3];
  for (int k = 0; k < 3; k++) {
    line[k] = two[0][k] - one[0][k];
    bend[k] = two[2][k] - one[2][k];
  }
  number square = dot(line, line), stretch = dot(line, bend) / square;
  cross(o, carried, twist);
  cross(twist, line, couple);
  for (int k = 0; k < 3; k++) {
    number apart = window * h->inertia * (bend[k] - line[k] * stretch) / square;
    apart += couple[k] / square;
    f[0][k] = 0.5 * total[k] - apart;
    f[1][k] = 0.5 * total[k] + apart;
    moment[k] = 0.5 * line[k] * dot(line, twist) / square;
  }
}

/* adds z . m to slope[d] of the joints above a link that turn */
static inline void reference_turns(const ambulo_model *m, int link, const number *q,
                                   const number moment[3], number *slope) {
  for (; link >= 0; link = m->links[link].parent) {
    number frame[12];
    if (m->links[link].coordinate < 0 || m->links[link].type != AMBULO_REVOLUTE) continue;
    reference_frame(m, link, q, 1, frame);
    const number z[3] = {frame[2], frame[6], frame[10]};
    slope[m->links[link].coordinate] += dot(z, moment);
  }
}

/* tau[d] and the wrench[6] that all holds add at a lane, of a state that is near it */
static inline void reference_holds(const hold_case *c, int lane, const hold_motion *s, number *tau,
                                   number wrench[6]) {
  memset(tau, 0, (size_t)c->d * sizeof *tau);
  memset(wrench, 0, 6 * sizeof *wrench);
  for (int i = 0; i < c->n; i++) {
    const ambulo_hold *h = &c->hold[i];
    number f[2][3], moment[3];
    reference_forces(c->model, h, c->told[i * AMBULO__LANES + lane], s, f, moment);
    for (int hand = 0; hand < 2 && h->hand[hand] >= 0; hand++) {
      number at[3][3], about[3];
      int link = c->model->points[h->hand[hand]].link;
      reference_motion(c->model, h->hand[hand], s, at);
      reference_slopes(c->model, link, at[0], s->q, f[hand], 1, tau);
      reference_turns(c->model, link, s->q, moment, tau);
      cross(at[0], f[hand], about);
      for (int k = 0; k < 3; k++) {
        wrench[k] += about[k] + moment[k];
        wrench[3 + k] += f[hand][k];
      }
    }
  }
}

#endif
