/* The ground's force between the nodes: of motions whose force is known, and of a walk by another
 * route (ambulo_problem_motion). */
#include "problem/nlp.h"
#include "solver/dense.h"
#include "support/dense_fixture.h"
#include "support/engine_fixture.h"
#include "support/toed_body.h"

static dense_largest largest_of(const ambulo__dense *dense, const char *subject) {
  dense_largest largest = {.subject = subject, .after = -1.0, .before = 100.0};
  ambulo__dense_force(dense, dense_keep_largest, &largest);
  return largest;
}

/* F_n = M (g + a): straight for a height that is one parabola over all the time */
static void a_straight_force_has_no_error(void **state) {
  (void)state;
  dense_fixture f;
  dense_open(&f, 20);
  dense_move(&f, 1, 0.8, 0.1, 2.0);
  dense_look(&f, 10);
  dense_largest total = largest_of(&f.dense, "total");
  assert_int_equal(total.count, 201);
  assert_true(total.sample.value < 1e-12);
  /* without ground reaction the feet's forces are not known */
  assert_int_equal(largest_of(&f.dense, "left").count, 0);
  dense_close(&f);
}

/* one control point of the height: the acceleration is bent at the knots, which are no nodes */
static void a_bent_force_is_off_by_what_the_basis_says(void **state) {
  (void)state;
  dense_fixture f;
  dense_open(&f, 20);
  ambulo_problem *own = f.problem, *kept;
  assert_int_equal(ambulo__problem_with_grid(own, 20, 7, NULL, &kept), AMBULO_OK);
  double want = 0.0, *x = calloc((size_t)kept->variables, sizeof *x);
  x[5 * WALKER_COORDINATES + 1] = 0.05;
  for (int j = 0; j <= 200; j++) {
    double a[3];
    for (int k = 0; k < 3; k++) {
      ambulo__basis_point at;
      int node = k == 0 ? j : k == 1 ? j / 10 * 10 : (j + 9) / 10 * 10;
      ambulo__basis_at(kept->basis, node * 0.55 / 200, &at);
      a[k] = 0.0;
      for (int i = 0; i < at.span; i++) a[k] += at.first + i == 5 ? 0.05 * at.weight[2][i] : 0.0;
    }
    want = fmax(want, fabs(a[0] - (a[1] + (a[2] - a[1]) * (j % 10) / 10.0)));
  }
  ambulo__dense dense;
  assert_int_equal(ambulo__dense_open(kept, x, 10, 0.0, NULL, NULL, &dense), AMBULO_OK);
  assert_true(want > 0.1);
  double g = ambulo__model_weight(kept->model) / kept->model->mass;
  assert_close(largest_of(&dense, "total").sample.value, want / g, 1e-9);
  ambulo__dense_close(&dense);
  free(x);
  ambulo_problem_free(kept);
  dense_close(&f);
}

/* of each foot: the same differences of what motion.csv would hold */
static void compare_feet(const ambulo_problem *p) {
  enum { SAMPLES = 10, FEET = 2 };
  ambulo_workspace *w = NULL;
  ambulo__dense dense;
  int nodes = (p->nodes - 1) * SAMPLES + 1;
  unsigned seed = 5;
  double *x = calloc((size_t)p->variables, sizeof *x);
  double *times = calloc((size_t)nodes, sizeof *times);
  double *grf = calloc((size_t)nodes * FEET * 3, sizeof *grf);
  for (int i = 0; i < p->variables; i++) x[i] = 0.02 * random_number(&seed);
  for (int j = 0; j < nodes; j++) times[j] = p->definition.duration * j / (nodes - 1);
  ambulo_motion motion = {.size = sizeof(ambulo_motion), .grf = grf};
  assert_int_equal(ambulo_workspace_create(p, NULL, &w), AMBULO_OK);
  assert_int_equal(ambulo_problem_motion(p, w, x, nodes, times, &motion), AMBULO_OK);
  assert_int_equal(ambulo__dense_open(p, x, SAMPLES, 0.0, NULL, NULL, &dense), AMBULO_OK);
  for (int foot = 0; foot < FEET; foot++) {
    double want = 0.0;
    for (int j = 0; j < nodes; j++) {
      int a = j / SAMPLES * SAMPLES, b = a + SAMPLES < nodes ? a + SAMPLES : a;
      double n[3];
      const int at[3] = {j, a, b};
      for (int k = 0; k < 3; k++) {
        n[k] = 0.0;
        for (int axis = 0; axis < 3; axis++)
          n[k] += p->model->up[axis] * grf[3 * (FEET * at[k] + foot) + axis];
      }
      want = fmax(want, fabs(n[0] - (n[1] + (n[2] - n[1]) * (j - a) / SAMPLES)));
    }
    want /= ambulo__model_weight(p->model);
    assert_true(want > 1e-3);
    assert_close(largest_of(&dense, p->model->feet[foot].name).sample.value, want, 1e-9);
  }
  ambulo__dense_close(&dense);
  ambulo_workspace_free(w);
  free(x);
  free(times);
  free(grf);
}

static void each_foot_has_its_own(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/walk_rigid");
  compare_feet(p);
  ambulo_problem_free(p);
}

/* standing and stepping on feet in two parts, which share their load */
static void both_parts_of_a_foot_are_summed(void **state) {
  (void)state;
  static const ambulo_contact contacts[] = {
      {TOED_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 0.6, .place = {0.0, -0.1}},
      {TOED_RIGHT, AMBULO_CONTACT_TOE, 0.6, 1.0, .place = {0.0, -0.1}},
      {TOED_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.0, 0.1}}};
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_model *model = toed_body();
  ambulo_problem *p = NULL;
  d.model = model;
  d.contacts = contacts;
  d.contact_count = 3;
  d.ground_reaction.kind = AMBULO_REACTION_SHARED;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &p), AMBULO_OK);
  assert_int_equal(p->channels.slots, 4);
  compare_feet(p);
  ambulo_problem_free(p);
  ambulo_model_free(model);
}

static void a_body_that_nothing_carries_has_none(void **state) {
  (void)state;
  ambulo_problem *p = load_problem("support/two_link_reach");
  ambulo__dense dense;
  double *x = calloc((size_t)p->variables, sizeof *x);
  assert_int_equal(ambulo__dense_open(p, x, 10, 0.0, NULL, NULL, &dense), AMBULO_OK);
  assert_int_equal(largest_of(&dense, NULL).count, 0);
  ambulo__dense_close(&dense);
  free(x);
  ambulo_problem_free(p);
}

/* without gravity nothing weighs: there is no share of the weight to be off by */
static void without_weight_there_is_no_share_of_it(void **state) {
  (void)state;
  dense_fixture f;
  dense_open(&f, 20);
  dense_move(&f, 1, 0.8, 0.1, 2.0);
  dense_look(&f, 10);
  for (int i = 0; i < 3; i++) f.model->gravity[i] = 0.0;
  assert_int_equal(largest_of(&f.dense, NULL).count, 0);
  dense_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(a_straight_force_has_no_error),
      cmocka_unit_test(a_bent_force_is_off_by_what_the_basis_says),
      cmocka_unit_test(each_foot_has_its_own),
      cmocka_unit_test(both_parts_of_a_foot_are_summed),
      cmocka_unit_test(a_body_that_nothing_carries_has_none),
      cmocka_unit_test(without_weight_there_is_no_share_of_it),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
