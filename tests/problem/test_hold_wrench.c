/* What hands hold in a whole problem: gradients with contacts that share the load, without, and in
 * flight; the same mass fixed to a link; momentum of body and load. */
#include "problem/hold_wrench.h"

#include "ambulo/tools/tools.h"
#include "support/engine_fixture.h"
#include "support/messages.h"

typedef struct held_fixture {
  ambulo_problem *p;
  ambulo_workspace *w;
  double *x;
} held_fixture;

static void open_held(held_fixture *f, const char *name, const char *const *overrides, int count) {
  char path[96];
  unsigned seed = 5;
  problem_path(name, path, sizeof path);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_problem_load(path, overrides, count, NULL, list, &f->p);
  for (size_t i = 0; status && i < ambulo_diagnostics_count(list); i++) {
    char line[500];
    ambulo_diagnostics_format(list, i, line, sizeof line);
    print_error("%s\n", line);
  }
  ambulo_diagnostics_free(list);
  assert_int_equal(status, AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(f->p, NULL, &f->w), AMBULO_OK);
  f->x = calloc((size_t)f->p->variables, sizeof *f->x);
  assert_non_null(f->x);
  for (int j = 0; j < f->p->variables; j++) f->x[j] = 0.2 * random_number(&seed);
}

static void close_held(held_fixture *f) {
  ambulo_workspace_free(f->w);
  ambulo_problem_free(f->p);
  free(f->x);
}

/* rows of M, F, tau and all that the contacts make of them: stored gradients beside central
 * differences of the channels, and the sweep back beside the stored ones */
static void check_outputs(held_fixture *f) {
  ambulo_problem *p = f->p;
  const int outputs = ambulo__plan_rows(p->plan),
            nodes[] = {p->nodes / 3, p->nodes / 2, p->nodes - 12};
  const double h = 3e-5;
  double *gradient = calloc((size_t)p->variables, sizeof *gradient);
  double *y[4];
  for (int k = 0; k < 4; k++) y[k] = calloc((size_t)outputs, sizeof **y);
  for (int n = 0; n < 3; n++) {
    int node = nodes[n], first = ambulo__node_first(p, node);
    int first_output = ambulo__channel_outputs(&p->channels);
    for (int j = first; j < first + ambulo__node_width(p, node); j += 17) {
      const double at[4] = {h, -h, 2 * h, -2 * h};
      double kept = f->x[j];
      for (int k = 0; k < 4; k++) {
        f->x[j] = kept + at[k];
        assert_true(ambulo__evaluate(f->w, f->x) == AMBULO_OK);
        for (int o = 0; o < outputs; o++)
          y[k][o] = f->w->channel[ambulo__lane_index(node, f->w->channel_count, first_output + o)];
      }
      f->x[j] = kept;
      assert_int_equal(ambulo__evaluate_jacobian(f->w, f->x), AMBULO_OK);
      for (int o = 0; o < outputs; o++) {
        double near = (y[0][o] - y[1][o]) / (2 * h), far = (y[2][o] - y[3][o]) / (4 * h);
        ambulo__channel_local_gradient(f->w, node, first_output + o, gradient);
        double size = 1;
        for (int i = 0; i < ambulo__node_width(p, node); i++) size = fmax(size, fabs(gradient[i]));
        assert_close(gradient[j - first] / size, (4 * near - far) / 3 / size, 2e-8);
      }
    }
  }
  for (int k = 0; k < 4; k++) free(y[k]);
  free(gradient);
}

/* the reverse sweep over all rows is the sum of their stored gradients */
static void check_sweep(held_fixture *f) {
  ambulo_problem *p = f->p;
  double *weights = calloc((size_t)p->rows, sizeof *weights);
  double *got = calloc((size_t)p->variables, sizeof *got), size = 1;
  double *want = calloc((size_t)p->variables, sizeof *want);
  unsigned seed = 9;
  for (int r = 0; r < p->rows; r++) weights[r] = random_number(&seed);
  assert_int_equal(ambulo__evaluate_jacobian(f->w, f->x), AMBULO_OK);
  assert_int_equal(ambulo__gradient(f->w, 0, weights, got), AMBULO_OK);
  for (int r = 0; r < p->rows; r++) ambulo__row_add_gradient(f->w, r, weights[r], want);
  for (int j = 0; j < p->variables; j++) size = fmax(size, fabs(want[j]));
  for (int j = 0; j < p->variables; j++) assert_close(got[j] / size, want[j] / size, 1e-11);
  free(weights);
  free(got);
  free(want);
}

#define BOX                                                                                        \
  "load=[{name: box, hands: [hand_r, hand_l], mass: 10, inertia: 0.3, center: [0.05, 0.02, "       \
  "-0.1], force: [20, 5, -8], from: 0.2, to: 2, ramp: 0.3}, {name: bag, hands: [elbow_r], mass: "  \
  "3}]"

static const char *const shared[] = {BOX, "time.intervals=32", "constraints.reach=[]",
                                     "constraints.torque_limits=true", "obstacles=[]"};
static const char *const in_the_air[] = {BOX,
                                         "time.intervals=32",
                                         "constraints.reach=[]",
                                         "constraints.torque_limits=true",
                                         "obstacles=[]",
                                         "ground_reaction.kind=none",
                                         "ground_reaction.minimum_force=0.2",
                                         "objective=none"};
static const char *const flying[] = {
    "load=[{name: ball, hands: [head_top, hip_r], mass: 6, inertia: 0.2, center: [0.05, 0.02, "
    "-0.1], from: 0.2, to: 1.15, ramp: 0.1}]",
    "constraints.torque_limits=true"};

static void test_gradients(void **state) {
  (void)state;
  static const struct {
    const char *name;
    const char *const *overrides;
    int count;
  } cases[] = {{"lift", shared, 5}, {"lift", in_the_air, 8}, {"jump", flying, 2}};
  for (int i = 0; i < 3; i++) {
    held_fixture f;
    open_held(&f, cases[i].name, cases[i].overrides, cases[i].count);
    assert_int_equal(f.p->taken_at > 0, i != 1);
    check_outputs(&f);
    check_sweep(&f);
    close_held(&f);
  }
}

/* A mass in one hand all along is the same mass on the hand's link: torques, root wrench and what
 * the contacts carry, but that the law that shares the load looks at the centre of mass of the body
 * alone; with no preference for it (slant 1) there is no difference. */
static void test_a_mass_in_a_hand_is_a_mass_on_its_link(void **state) {
  (void)state;
  const char *const in_hand[] = {"load={hands: [hand_r], mass: 7}", "ground_reaction.slant=1",
                                 "time.intervals=32", "constraints.reach=[]", "obstacles=[]"};
  char on_link[160];
  held_fixture f, g;
  open_held(&f, "lift", in_hand, 5);
  const ambulo_point *hand = ambulo_model_point(f.p->model, f.p->definition.holds[0].hand[0]);
  (void)snprintf(on_link, sizeof on_link,
                 "load={link: forearm_r, mass: 7, position: [%.17g, %.17g, %.17g]}",
                 hand->position[0], hand->position[1], hand->position[2]);
  const char *const fixed[] = {on_link, "ground_reaction.slant=1", "time.intervals=32",
                               "constraints.reach=[]", "obstacles=[]"};
  open_held(&g, "lift", fixed, 5);
  assert_int_equal(ambulo__evaluate(f.w, f.x), AMBULO_OK);
  assert_int_equal(ambulo__evaluate(g.w, f.x), AMBULO_OK);
  int first = ambulo__channel_outputs(&f.p->channels);
  int last = ambulo__channel_center(&f.p->channels, 0);
  double largest = 0;
  for (int k = 0; k < f.p->nodes; k++)
    for (int c = first; c < last; c++) {
      size_t at = ambulo__lane_index(k, f.w->channel_count, c);
      largest = fmax(largest, fabs(g.w->channel[at]));
      assert_close(f.w->channel[at] / 1e3, g.w->channel[at] / 1e3, 1e-9);
    }
  assert_true(largest > 100);
  close_held(&f);
  close_held(&g);
}

/* What the contacts carry is the root wrench, with the load in it; and the root wrench is the
 * body's without it and the hands' forces, exactly, inside the window and outside. */
static void test_momentum(void **state) {
  (void)state;
  const char *without[] = {"load=null", "time.intervals=32", "constraints.reach=[]",
                           "constraints.torque_limits=true", "obstacles=[]"};
  held_fixture f, g;
  open_held(&f, "lift", shared, 5);
  open_held(&g, "lift", without, 5);
  enum { TIMES = 40, COUNT = 2 };
  double times[TIMES], wrench[TIMES][6], bare[TIMES][6], force[TIMES][COUNT][2][3];
  double grf[TIMES][2][3];
  for (int k = 0; k < TIMES; k++) times[k] = f.p->definition.duration * k / (TIMES - 1);
  ambulo_motion a = {.size = sizeof(ambulo_motion),
                     .wrench = wrench[0],
                     .hold_force = force[0][0][0],
                     .grf = grf[0][0]};
  ambulo_motion b = {.size = sizeof(ambulo_motion), .wrench = bare[0]};
  assert_int_equal(ambulo_problem_motion(f.p, f.w, f.x, TIMES, times, &a), AMBULO_OK);
  assert_int_equal(ambulo_problem_motion(g.p, g.w, f.x, TIMES, times, &b), AMBULO_OK);
  for (int k = 0; k < TIMES; k++) {
    for (int i = 0; i < 3; i++) {
      double hands = force[k][0][0][i] + force[k][0][1][i] + force[k][1][0][i];
      assert_close(wrench[k][3 + i] - bare[k][3 + i], hands, 1e-9);
      assert_close(grf[k][0][i] + grf[k][1][i], wrench[k][3 + i], 1e-9);
      int outside = times[k] <= 0.2 || times[k] >= 2.0;
      if (outside) assert_close(fabs(force[k][0][0][i]) + fabs(force[k][0][1][i]), 0, 0);
      assert_close(force[k][1][1][i], 0, 0);
    }
  }
  close_held(&f);
  close_held(&g);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_gradients),
      cmocka_unit_test(test_a_mass_in_a_hand_is_a_mass_on_its_link),
      cmocka_unit_test(test_momentum),
  };
  return cmocka_run_group_tests_name("nlp/held", tests, NULL, NULL);
}
