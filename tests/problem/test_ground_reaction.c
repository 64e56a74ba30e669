/* Ground reaction in a whole problem: tests/support/walk_rigid.yaml at a made-up point that moves
 * gently, so that the body presses on the ground. */
#include "support/contact_index.h"
#include "problem/nlp.h"
#include "ambulo/tools/load.h"
#include "support/test.h"

typedef struct fixture {
  ambulo_problem *problem;
  ambulo_workspace *workspace;
  double *x;
  int nodes, d;
} fixture;

static void fixture_open(fixture *f, const char *path) {
  assert_int_equal(ambulo_problem_load(path, NULL, 0, NULL, NULL, &f->problem), AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(f->problem, NULL, &f->workspace), AMBULO_OK);
  f->nodes = ambulo_problem_node_count(f->problem);
  f->d = f->problem->coordinates;
  f->x = calloc((size_t)f->problem->variables, sizeof *f->x);
  for (int i = 0; i < f->problem->variables; i++)
    f->x[i] = (i % f->d < 3 ? 0.01 : 0.1) * sin(0.3 * (i / f->d) + 1.7 * (i % f->d));
}

static void fixture_close(fixture *f) {
  free(f->x);
  ambulo_workspace_free(f->workspace);
  ambulo_problem_free(f->problem);
}

/* the six forces of the root vanish, and what the feet get is what the ground gives */
static void feet_supply_the_root_wrench(void **state) {
  (void)state;
  fixture f;
  fixture_open(&f, "tests/support/walk_rigid.yaml");
  size_t n = (size_t)f.nodes;
  double *tau = calloc(n * (size_t)f.d, sizeof(double)), *wrench = calloc(6 * n, sizeof(double));
  double *grf = calloc(6 * n, sizeof(double)), *cop = calloc(6 * n, sizeof(double));
  double *moment = calloc(6 * n, sizeof(double));
  ambulo_motion motion = {.size = sizeof(ambulo_motion),
                          .tau = tau,
                          .wrench = wrench,
                          .grf = grf,
                          .cop = cop,
                          .grf_moment = moment};
  assert_int_equal(
      ambulo_problem_motion(f.problem, f.workspace, f.x, f.nodes, f.problem->times, &motion),
      AMBULO_OK);
  double weight = 75.0 * 9.81, worst = 0.0, largest = 0.0;
  for (int k = 0; k < f.nodes; k++) {
    for (int i = 0; i < 6; i++) worst = fmax(worst, fabs(tau[k * f.d + i]) / weight);
    double sum[6] = {0.0};
    for (int foot = 0; foot < 2; foot++) {
      const double *force = grf + 6 * k + 3 * foot, *place = cop + 6 * k + 3 * foot;
      double size = fabs(force[0]) + fabs(force[1]) + fabs(force[2]);
      int down = contact_index_at(f.problem, foot, f.problem->times[k]) >= 0;
      if (!down) assert_true(isnan(place[0]) && size == 0.0);
      for (int i = 0; i < 3; i++) {
        sum[i] += moment[6 * k + 3 * foot + i];
        sum[3 + i] += force[i];
      }
    }
    for (int i = 0; i < 6; i++) {
      largest = fmax(largest, fabs(sum[i] - wrench[6 * k + i]) / weight);
    }
  }
  if (worst > 1e-9) print_error("root residual %.3g body weights\n", worst);
  if (largest > 1e-9) print_error("feet less root wrench %.3g body weights\n", largest);
  assert_true(worst <= 1e-9);
  assert_true(largest <= 1e-9);
  free(tau);
  free(wrench);
  free(grf);
  free(cop);
  free(moment);
  fixture_close(&f);
}

static void gradients_agree_with_differences(void **state) {
  (void)state;
  fixture f;
  fixture_open(&f, "tests/support/walk_rigid.yaml");
  ambulo_derivative_error errors[32];
  int count = 0;
  assert_int_equal(
      ambulo_problem_check_derivatives(f.problem, f.workspace, f.x, 0.0, errors, 32, &count),
      AMBULO_OK);
  static const char *const families[] = {"contact",  "clearance", "normal_force",
                                         "pressure", "friction",  "free_moment"};
  for (int i = 0; i < 6; i++) {
    int found = 0;
    for (int e = 0; e < count; e++) {
      if (strcmp(errors[e].family, families[i])) continue;
      found = 1;
      if (errors[e].error > 1e-5)
        print_error("%s %s by %s: %g, differences give %g\n", errors[e].family, errors[e].subject,
                    errors[e].variable, errors[e].analytic, errors[e].numeric);
      assert_true(errors[e].error <= 1e-5);
    }
    if (!found) print_error("no rows of family %s\n", families[i]);
    assert_true(found);
  }
  fixture_close(&f);
}

/* what is not there is said to be not a number */
static void other_problems_have_no_forces_on_feet(void **state) {
  (void)state;
  fixture f;
  fixture_open(&f, "tests/support/walk_without_reaction.yaml");
  double grf[6], cop[6], twist[2], moment[6], time = 0.1;
  ambulo_motion motion = {.size = sizeof(ambulo_motion),
                          .grf = grf,
                          .cop = cop,
                          .free_moment = twist,
                          .grf_moment = moment};
  assert_int_equal(ambulo_problem_motion(f.problem, f.workspace, f.x, 1, &time, &motion),
                   AMBULO_OK);
  for (int i = 0; i < 6; i++) assert_true(isnan(grf[i]) && isnan(cop[i]) && isnan(moment[i]));
  assert_true(isnan(twist[0]) && isnan(twist[1]));
  assert_int_equal(f.problem->definition.ground_reaction.kind, AMBULO_REACTION_NONE);
  fixture_close(&f);
}

static void check_channel_gradients(const char *path) {
  fixture f;
  fixture_open(&f, path);
  ambulo_workspace *w = f.workspace;
  const double step = 1e-5;
  for (int node = 1; node < f.nodes; node += 9) {
    int first = ambulo__node_first(f.problem, node), width = ambulo__node_width(f.problem, node);
    size_t size = (size_t)(w->channel_count * width);
    double *want = calloc(size, sizeof *want), *got = calloc(size, sizeof *got);
    for (int j = 0; j < width; j++) {
      double here = f.x[first + j];
      for (int side = -1; side <= 1; side += 2) {
        f.x[first + j] = here + side * step;
        assert_int_equal(ambulo__evaluate(w, f.x), AMBULO_OK);
        for (int c = 0; c < w->channel_count; c++)
          want[c * width + j] +=
              side * w->channel[ambulo__lane_index(node, w->channel_count, c)] / (2.0 * step);
      }
      f.x[first + j] = here;
    }
    assert_int_equal(ambulo__evaluate_jacobian(w, f.x), AMBULO_OK);
    for (int c = 0; c < w->channel_count; c++) {
      double largest = 1e-3, worst = 0.0;
      ambulo__channel_local_gradient(w, node, c, got + c * width);
      for (int j = 0; j < width; j++) {
        largest = fmax(largest, fabs(want[c * width + j]));
        worst = fmax(worst, fabs(got[c * width + j] - want[c * width + j]));
      }
      if (worst > 1e-6 * largest) print_error("node %d, channel %d: %g\n", node, c, worst);
      assert_true(worst <= 1e-6 * largest);
    }
    free(want);
    free(got);
  }
  fixture_close(&f);
}

/* by central differences, of every channel: also of those whose rows are parts of others, with
 * ground reaction (contacts, centre of mass) and without (torques of the root's sliders) */
static void channel_gradients_agree_with_differences(void **state) {
  (void)state;
  check_channel_gradients("tests/support/walk_rigid.yaml");
  check_channel_gradients("models/yardstick_12.yaml");
}

/* Ends that match up to speeds repeat places, not forces: at the last node the rows on forces stand
 * in their own right, or the step would end with any force at all. One foot is in the air there. */
static void forces_at_the_end_are_held_unless_they_repeat(void **state) {
  (void)state;
  static const char *const orders[] = {"ends.order=0", "ends.order=1", "ends.order=2"};
  static const char phases[] =
      "gait.phases={heel_strike: -0.13, foot_flat: -0.05, heel_off: 0.3, toe_off: 0.49}";
  static const char *const of_forces[] = {"normal_force", "pressure", "friction", "free_moment"};
  for (int order = 0; order <= 2; order++) {
    ambulo_problem *p = NULL;
    int forces[4] = {0}, places = 0;
    const char *overrides[] = {orders[order], phases};
    assert_int_equal(
        ambulo_problem_load("tests/support/walk_rigid.yaml", overrides, 2, NULL, NULL, &p),
        AMBULO_OK);
    assert_int_equal(contact_index_at(p, 1, ambulo_problem_duration(p)), -1);
    assert_true(contact_index_at(p, 0, ambulo_problem_duration(p)) >= 0);
    assert_int_equal(contact_index_at(p, 0, ambulo_problem_duration(p) + 0.01), -1);
    for (int r = 0; r < p->rows; r++) {
      const ambulo__table_row *row = &p->table.rows[r];
      if (row->node != p->nodes - 1) continue;
      for (int k = 0; k < 4; k++) forces[k] += !strcmp(row->family, of_forces[k]);
      places += !strcmp(row->family, "contact") || !strcmp(row->family, "clearance");
    }
    for (int k = 0; k < 4; k++) assert_int_equal(forces[k] > 0, order < 2);
    assert_int_equal(places, 0);
    ambulo_problem_free(p);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(feet_supply_the_root_wrench),
      cmocka_unit_test(gradients_agree_with_differences),
      cmocka_unit_test(channel_gradients_agree_with_differences),
      cmocka_unit_test(forces_at_the_end_are_held_unless_they_repeat),
      cmocka_unit_test(other_problems_have_no_forces_on_feet)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
