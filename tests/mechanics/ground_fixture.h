/* tests/mechanics/ground_fixture.h - random trees on two feet, and the lower body.
 *
 * A foot is put on any link: on limbs, on each other's ancestors, on the same link, on massless
 * links, or on the world. Shares of the lanes are 1, 0, and between; the ground lies below the
 * centre of mass. */
#ifndef TESTS_MECHANICS_GROUND_FIXTURE_H
#define TESTS_MECHANICS_GROUND_FIXTURE_H

#include <complex.h>

#include "kernel_fixture.h"
#include "ambulo/tools/load.h"
#include "mechanics/plan_layout.h"
#include "support/ground_reference.h"

enum { ground_case_count = 160, ground_max_rows = 200, shipped_count = 2 };

static const char *const shipped_bodies[shipped_count] = {"models/lower_body_18.yaml",
                                                          "models/yardstick_body.yaml"};

typedef struct ground_case {
  kernel_case body;
  ambulo_foot feet[2];
  double *ground; /* [AMBULO__GROUND_ENTRIES][lanes] */
  double height;
  int foot_row;
} ground_case;

static inline void ground_add_feet(ground_case *c, random_source *source) {
  random_tree *tree = &c->body.tree;
  static const char *const names[] = {"heel_0", "toe_0", "heel_1", "toe_1"};
  if (tree->definition.point_count > 2) tree->definition.point_count = 2;
  for (int i = 0; i < 4; i++) {
    ambulo_point *point = &tree->points[tree->definition.point_count++];
    point->name = names[i];
    point->link = random_below(source, tree->definition.link_count);
    for (int k = 0; k < 3; k++) point->position[k] = random_length(source);
  }
  for (int f = 0; f < 2; f++) {
    int heel = tree->definition.point_count - 4 + 2 * f, toe = heel + 1;
    ambulo_foot foot = {.name = f ? "right" : "left", .heel_center = heel, .toe_center = toe};
    foot.heel[0] = heel;
    foot.toe[0] = toe;
    foot.heel[1] = foot.toe[1] = foot.mirror = -1;
    c->feet[f] = foot;
  }
  tree->definition.feet = c->feet;
  tree->definition.foot_count = 2;
}

/* State of a lane as complex pairs, with a step in coordinate k of q, qd, qdd (-1: none). */
static inline void ground_reference(const ground_case *c, const double *state, int k, double step,
                                    const double *ground, double *rows) {
  int d = c->body.d;
  double z[2 * 3 * max_d];
  for (int i = 0; i < 3 * d; i++) {
    z[2 * i] = state[i];
    z[2 * i + 1] = i == k ? step : 0;
  }
  assert_int_equal(ground_reaction_reference(c->body.model, c->height, ground, z, z + 2 * d,
                                             z + 4 * d, rows, c->body.reference_scratch),
                   AMBULO_OK);
}

static inline void ground_of_lane(const ground_case *c, int lane, double *ground) {
  for (int i = 0; i < AMBULO__GROUND_ENTRIES; i++) ground[i] = c->ground[i * AMBULO__LANES + lane];
}

static inline void ground_fill(ground_case *c, random_source *source) {
  const double *up = c->body.model->up;
  for (int lane = 0; lane < AMBULO__LANES; lane++) {
    double d[3], along = 0, share = lane < 2 ? lane : random_unit(source);
    for (int i = 0; i < 3; i++) {
      d[i] = random_between(source, -0.6, 0.6);
      along += up[i] * d[i];
    }
    c->ground[lane] = share;
    for (int i = 0; i < 3; i++) {
      c->ground[(1 + i) * AMBULO__LANES + lane] = d[i] - along * up[i];
    }
    c->ground[4 * AMBULO__LANES + lane] = lane == 2 ? 0 : lane == 3 ? 1 : random_unit(source);
  }
}

/* The lowest centre of mass of the lanes, along the normal. */
static inline double ground_lowest_center(const ground_case *c) {
  double lowest = INFINITY, state[3 * max_d];
  double complex rows[ground_max_rows];
  for (int lane = 0; lane < AMBULO__LANES; lane++) {
    double ground[AMBULO__GROUND_ENTRIES], center = 0;
    case_state(&c->body, lane, state);
    ground_of_lane(c, lane, ground);
    ground_reference(c, state, -1, 0, ground, (double *)rows);
    for (int i = 0; i < 3; i++) {
      center += c->body.model->up[i] * creal(rows[c->foot_row + 8 + i]);
    }
    lowest = fmin(lowest, center);
  }
  return lowest;
}

static inline void ground_compile(ground_case *c, double height) {
  ambulo__plan_free(c->body.plan);
  c->body.plan = NULL;
  c->height = height;
  assert_int_equal(ambulo__plan_create_grounded(c->body.model, height, NULL, &c->body.plan),
                   AMBULO_OK);
}

/* Numbers from 0: random trees; -1 and -2: the shipped bodies. */
static inline void ground_case_open(ground_case *c, int number) {
  random_source source = {500 + (uint64_t)(number + shipped_count)};
  kernel_case *b = &c->body;
  b->number = number;
  b->model = NULL;
  b->plan = NULL;
  if (number >= 0) {
    random_tree_make(&b->tree, 31 * (uint64_t)number + 3, 1 + number % 40);
    ground_add_feet(c, &source);
    assert_int_equal(ambulo_model_create(&b->tree.definition, NULL, NULL, &b->model), AMBULO_OK);
  } else {
    const char *path = shipped_bodies[-1 - number];
    assert_int_equal(ambulo_model_load(path, NULL, NULL, NULL, &b->model), AMBULO_OK);
  }
  ground_compile(c, -1e3);
  b->d = ambulo__plan_coordinates(b->plan);
  b->rows = ambulo__plan_rows(b->plan);
  c->foot_row = ambulo__plan_first_foot_row(b->plan);
  assert_in_range(b->rows, 1, ground_max_rows);
  size_t d = (size_t)b->d;
  b->q = lane_array(d);
  b->qd = lane_array(d);
  b->qdd = lane_array(d);
  b->weights = lane_array((size_t)b->rows);
  b->out = lane_array((size_t)b->rows);
  b->scratch = lane_array(ambulo__plan_scratch(b->plan) / AMBULO__LANES);
  b->reference_scratch = malloc(ambulo_lagrangian_scratch_size(b->model));
  c->ground = lane_array(AMBULO__GROUND_ENTRIES);
  assert_non_null(b->reference_scratch);
  int regime = number < 0 ? 1 : number % 5;
  for (int i = 0; i < b->d * AMBULO__LANES; i++) {
    b->q[i] = random_pose(&source, regime);
    b->qd[i] = random_between(&source, -0.5, 0.5);
    b->qdd[i] = random_between(&source, -0.5, 0.5);
  }
  for (int i = 0; i < b->rows * AMBULO__LANES; i++) b->weights[i] = random_between(&source, -1, 1);
  ground_fill(c, &source);
  ground_compile(c, ground_lowest_center(c) - random_between(&source, 0.6, 1.2));
}

static inline void ground_case_close(ground_case *c) {
  free(c->ground);
  case_close(&c->body);
}

static inline void ground_forward(ground_case *c, const ambulo__kernels *kernels) {
  case_outputs(&c->body, kernels, c->ground);
}

/* Newtons: the weight of the whole body. */
static inline double ground_weight(const ground_case *c) {
  const double *g = c->body.model->gravity;
  return c->body.model->mass * sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
}

/* Dense [3][rows][d] of the reference, in one lane. */
static inline void ground_reference_jacobian(const ground_case *c, int lane, double *jacobian) {
  const double step = 1e-40;
  const kernel_case *b = &c->body;
  double state[3 * max_d], ground[AMBULO__GROUND_ENTRIES];
  double complex rows[ground_max_rows];
  case_state(b, lane, state);
  ground_of_lane(c, lane, ground);
  for (int k = 0; k < 3 * b->d; k++) {
    ground_reference(c, state, k, step, ground, (double *)rows);
    for (int row = 0; row < b->rows; row++) {
      jacobian[(k / b->d * b->rows + row) * b->d + k % b->d] = cimag(rows[row]) / step;
    }
  }
}

/* Groups of rows whose entries are compared on one scale, ends exclusive. */
enum { ground_groups = 5 };
static const char *const ground_group_names[ground_groups] = {
    "generalized forces, root wrench", "points", "foot 0", "foot 1", "centre of mass"};

static inline void ground_group_ends(const ground_case *c, int ends[ground_groups]) {
  int d = c->body.d, foot = c->foot_row;
  const int all[ground_groups] = {d + 6, foot, foot + 4, foot + 8, foot + 11};
  memcpy(ends, all, sizeof all);
}

#endif
