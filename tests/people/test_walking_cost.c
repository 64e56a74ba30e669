/* What a walk costs: strides made by hand, whose work, unsteadiness and swinging are known. */
#include "people/walking_cost.h"

#include "ambulo/ambulo.h"
#include "ambulo/tools/load.h"
#include "people/stride.h"
#include "support/fail_alloc.h"
#include "support/test.h"

#include <string.h>

/* the law of the head, with its numbers */
static double law(double limbs, double unsteadiness, double swing, double weight_way) {
  double work = limbs + 2.85 * unsteadiness - 0.0182 * weight_way;
  return fmax(0.0, work) / 0.22 + 0.539 * swing;
}

static const double pi = 3.14159265358979323846;

enum { SAMPLES = 2001 };

/* A body that glides forward at `speed` and goes up and down by `bob` twice a stride. Each foot is
 * on the ground for 60 % of the stride, the left from its beginning, the right from its middle; F
 * is along forward and up; each joint of a leg has the torque tau. */
typedef struct made {
  double speed, bob, force[2], tau, duration;
} made;

typedef struct walk {
  ambulo_problem *problem;
  double *x;
  ambulo__stride stride;
} walk;

static int coordinate_of(const ambulo_model *m, const char *name) {
  for (int i = 0; i < m->coordinate_count; i++)
    if (strcmp(m->coordinates[i].name, name) == 0) return i;
  fail();
  return -1;
}

static int stands(int foot_is_left, double share) {
  double since = share - (foot_is_left ? 0.0 : 0.5);
  since -= floor(since);
  return since <= 0.6;
}

static void fill(walk *w, const made *as) {
  ambulo__stride *s = &w->stride;
  size_t d = (size_t)s->coordinates;
  int forward = coordinate_of(s->model, "pelvis_tx"), up = coordinate_of(s->model, "pelvis_ty");
  memset(s->q, 0, (size_t)s->samples * d * sizeof *s->q);
  s->duration = as->duration;
  for (int k = 0; k < s->samples; k++) {
    double share = (double)k / (s->samples - 1), t = share * as->duration;
    s->times[k] = t;
    s->q[(size_t)k * d + (size_t)forward] = as->speed * t;
    s->q[(size_t)k * d + (size_t)up] = as->bob * sin(4.0 * pi * share);
    for (int i = 0; i < s->coordinates; i++)
      s->tau[(size_t)k * d + (size_t)i] = i % 2 ? as->tau : -as->tau;
    for (int f = 0; f < s->feet; f++) {
      int is_left = strcmp(s->model->feet[f].name, "left") == 0, on = stands(is_left, share);
      double *force = s->grf + 3 * ((size_t)k * (size_t)s->feet + (size_t)f);
      force[0] = on ? as->force[0] : 0.0;
      force[1] = on ? as->force[1] : 0.0;
      force[2] = 0.0;
    }
  }
}

static void open_walk(walk *w, const char *one, const char *other, const made *as) {
  const char *const settings[] = {"time.intervals=30", "trajectory.intervals=9", one, other};
  w->problem = NULL;
  assert_int_equal(ambulo_problem_load("models/walk.yaml", settings,
                                       other ? 4
                                       : one ? 3
                                             : 2,
                                       NULL, NULL, &w->problem),
                   AMBULO_OK);
  w->x = calloc((size_t)w->problem->variables, sizeof *w->x);
  assert_non_null(w->x);
  assert_int_equal(ambulo__stride_create(w->problem, w->x, SAMPLES, NULL, &w->stride), AMBULO_OK);
  fill(w, as);
}

static void close_walk(walk *w) {
  ambulo__stride_free(&w->stride);
  free(w->x);
  ambulo_problem_free(w->problem);
}

static ambulo__walking_cost cost_of(const walk *w) {
  ambulo__walking_cost cost = {.is_walk = -1};
  assert_int_equal(ambulo__walking_cost_of(&w->stride, NULL, &cost), AMBULO_OK);
  return cost;
}

static const made plain = {1.25, 0.0, {40.0, 400.0}, 5.0, 1.1};

/* steady: feet that push forward work F v; one that brakes is not paid for */
static void limbs_work_on_a_gliding_body(void **state) {
  (void)state;
  walk w;
  made braking = plain;
  braking.force[0] = -40.0;
  open_walk(&w, NULL, NULL, &plain);
  ambulo__walking_cost cost = cost_of(&w);
  assert_int_equal(cost.is_walk, 1);
  assert_close(cost.distance, 1.25 * 1.1, 1e-12);
  assert_close(cost.limbs, 2.0 * 40.0 * 1.25 * 0.6 * 1.1, 2e-3 * cost.limbs);
  assert_close(cost.unsteadiness, 0.0, 1e-9);
  fill(&w, &braking);
  assert_close(cost_of(&w).limbs, 0.0, 1e-9);
  close_walk(&w);
}

/* height a sin(2 w t): mean square of its rate is (2 w a)^2 / 2 */
static void unsteadiness_is_of_the_center_of_mass(void **state) {
  (void)state;
  walk w;
  made bobbing = plain;
  bobbing.bob = 0.02;
  open_walk(&w, NULL, NULL, &bobbing);
  double rate = 4.0 * pi / 1.1 * 0.02, m = w.problem->model->mass;
  ambulo__walking_cost cost = cost_of(&w);
  assert_close(cost.unsteadiness, m * 0.5 * rate * rate * 1.1, 1e-4 * cost.unsteadiness);
  assert_true(cost.unsteadiness > 1.0);
  close_walk(&w);
}

/* 0.4 of the stride in the air, once, with the joints of that leg at 5 N m each: n^2 I / A^2 = sum
 * / A */
static void swinging_counts_torque_over_time(void **state) {
  (void)state;
  walk w;
  made fast = plain;
  fast.duration = 0.55;
  open_walk(&w, NULL, NULL, &plain);
  int joints = 0;
  const ambulo_model *m = w.problem->model;
  for (int i = 0; i < m->coordinate_count; i++) {
    const char *name = m->coordinates[i].name;
    joints += m->coordinates[i].actuated && strcmp(name + strlen(name) - 2, "_r") == 0;
  }
  assert_true(joints >= 6);
  double slow = cost_of(&w).swing;
  assert_close(slow, 2.0 * 5.0 * joints / (0.4 * 1.1), 5e-3 * slow);
  fill(&w, &fast);
  assert_close(cost_of(&w).swing, 2.0 * slow, 1e-9 * slow);
  close_walk(&w);
}

static void the_estimate_is_the_law(void **state) {
  (void)state;
  walk w;
  made bobbing = plain;
  bobbing.bob = 0.02;
  open_walk(&w, "load={link: thorax, mass: 8, position: [0, 0.25, 0]}", NULL, &bobbing);
  ambulo__walking_cost cost = cost_of(&w);
  assert_close(w.problem->model->mass, 83.0, 1e-9);
  assert_close(cost.net,
               law(cost.limbs, cost.unsteadiness, cost.swing, 75.0 * 9.81 * cost.distance),
               1e-9 * cost.net);
  assert_close(cost.per_kg_metre, cost.net / (75.0 * cost.distance), 1e-12 * cost.net);
  assert_true(cost.per_kg_metre > 0.5);
  assert_true(isnan(cost.people)); /* who carry nothing */
  bobbing.force[0] = -40.0;
  bobbing.bob = 0.0;
  fill(&w, &bobbing); /* tendons give back no more than there is */
  cost = cost_of(&w);
  assert_close(cost.net, 0.539 * cost.swing, 1e-9 * cost.net);
  close_walk(&w);
}

/* lengths times l, times with its root, forces with weight: a dynamically similar walk costs as
 * much by kg and metre */
static void similar_walks_cost_the_same(void **state) {
  (void)state;
  walk w;
  made bobbing = plain, similar;
  bobbing.bob = 0.02;
  open_walk(&w, NULL, NULL, &bobbing);
  double one = cost_of(&w).per_kg_metre, l = 1.4 / 1.75, heavy = 40.0 / 75.0;
  close_walk(&w);
  similar = (made){
      1.25 * sqrt(l), 0.02 * l, {40.0 * heavy, 400.0 * heavy}, 5.0 * heavy * l, 1.1 * sqrt(l)};
  open_walk(&w, "subject.stature=1.4", "subject.mass=40", &similar);
  assert_close(cost_of(&w).per_kg_metre, one, 1e-9);
  close_walk(&w);
}

static void people_are_known_on_the_level(void **state) {
  (void)state;
  walk w;
  assert_close(ambulo__people_walking_cost(1.25), 2.2785, 1e-4);
  assert_close(ambulo__people_walking_cost(1.25), 4.0981 / 1.25 - 1.0, 1e-4);
  assert_true(isnan(ambulo__people_walking_cost(0.6)) && isnan(ambulo__people_walking_cost(1.9)));
  assert_true(isnan(ambulo__people_walking_cost(NAN)));
  open_walk(&w, NULL, NULL, &plain);
  assert_close(cost_of(&w).people, ambulo__people_walking_cost(1.25), 1e-9);
  close_walk(&w);
  open_walk(&w, "ground.slope=3", NULL, &plain);
  assert_int_equal(cost_of(&w).is_walk, 1);
  assert_true(isnan(cost_of(&w).people));
  close_walk(&w);
}

/* a flight, a foot that stays, a way that leads nowhere, and somebody else who works */
static void what_is_no_walk_has_no_cost(void **state) {
  (void)state;
  walk w;
  made on_the_spot = plain;
  on_the_spot.speed = 0.0;
  open_walk(&w, NULL, NULL, &on_the_spot);
  assert_int_equal(cost_of(&w).is_walk, 0);
  fill(&w, &plain);
  assert_int_equal(cost_of(&w).is_walk, 1);
  memset(w.stride.grf + 3 * 2 * 700, 0, 3 * 2 * sizeof(double));
  assert_int_equal(cost_of(&w).is_walk, 0);
  fill(&w, &plain);
  for (int k = 0; k < SAMPLES; k++) w.stride.grf[3 * 2 * k] = 1.0;
  assert_int_equal(cost_of(&w).is_walk, 0);
  close_walk(&w);
  open_walk(&w,
            "devices=[{name: exo_r, kind: spring, coordinate: ankle_angle_r, stiffness: 150, "
            "rest: -60, side: above, mirror: true}]",
            NULL, &plain);
  assert_int_equal(cost_of(&w).is_walk, 0);
  close_walk(&w);
}

static void memory_may_run_out(void **state) {
  (void)state;
  walk w;
  open_walk(&w, NULL, NULL, &plain);
  for (int at = 0;; at++) {
    fail_alloc memory = fail_alloc_at(at);
    ambulo_allocator failing = fail_alloc_hook(&memory);
    ambulo__walking_cost cost = {.is_walk = 7};
    ambulo_status status = ambulo__walking_cost_of(&w.stride, &failing, &cost);
    assert_int_equal(memory.live, 0);
    if (status == AMBULO_OK) {
      assert_true(at > 1);
      break;
    }
    assert_int_equal(status, AMBULO_E_MEMORY);
    assert_int_equal(cost.is_walk, 7);
  }
  close_walk(&w);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(limbs_work_on_a_gliding_body),
      cmocka_unit_test(unsteadiness_is_of_the_center_of_mass),
      cmocka_unit_test(swinging_counts_torque_over_time),
      cmocka_unit_test(the_estimate_is_the_law),
      cmocka_unit_test(similar_walks_cost_the_same),
      cmocka_unit_test(people_are_known_on_the_level),
      cmocka_unit_test(what_is_no_walk_has_no_cost),
      cmocka_unit_test(memory_may_run_out),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
