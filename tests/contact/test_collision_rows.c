/* Rows of capsules, obstacles and reaches on a shipped body: which, at which nodes, how large;
 * their gradients by row, by the reverse sweep and by differences, in any pose; the same after the
 * reader.
 */
#include "ambulo/tools/tools.h"
#include "model/neutral_pose.h"
#include "problem/nlp.h"
#include "support/test.h"

#include <string.h>

static const char task[] =
    "ambulo: 1\nkind: problem\nmodel: models/lower_body_21.yaml\nangles: degrees\n"
    "time: {duration: 1, intervals: 6}\ntrajectory: {intervals: 4}\nobjective: none\n"
    "obstacles:\n"
    "  - {name: crate, center: [0.4, 0.1, 0.3], half_size: [0.2, 0.3, 0.3], heading: 30, margin: "
    "0}\n"
    "  - {name: rail, from: [0.2, -1, 1], to: [0.2, 1, 1.2], radius: 0.03, margin: 0.02,\n"
    "     capsules: [trunk, head]}\n"
    "constraints:\n"
    "  collision: {pairs: [[shank_l, shank_r], [thigh_l, foot_r]], margin: 0.005}\n"
    "  reach:\n"
    "    - {point: head_top, place: [0.1, 0, 1.5], at: 0.5}\n"
    "    - {point: knee_r, place: [0.1, -0.1, 0.5], at: [0, 0.4], tolerance: 0.01}\n";

typedef struct fixture {
  ambulo_problem *p;
  ambulo_workspace *workspace;
  double *x;
} fixture;

static void open_settings(fixture *f, const char *const *settings, int settings_count) {
  assert_int_equal(
      ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                      .text = task,
                                                      .length = sizeof task - 1,
                                                      .name = "task",
                                                      .overrides = settings,
                                                      .override_count = settings_count},
                               NULL, NULL, &f->p),
      AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(f->p, NULL, &f->workspace), AMBULO_OK);
  f->x = calloc((size_t)f->p->variables, sizeof *f->x);
}

static void open_with(fixture *f, const char *override) {
  open_settings(f, &override, override ? 1 : 0);
}

static void close_all(fixture *f) {
  free(f->x);
  ambulo_workspace_free(f->workspace);
  ambulo_problem_free(f->p);
}

static int count(const fixture *f, const char *family, const char *subject, const char *detail) {
  int found = 0;
  for (int r = 0; r < f->p->rows; r++) {
    const ambulo__table_row *row = &f->p->table.rows[r];
    found += !strcmp(row->family, family) && (!subject || !strcmp(row->subject, subject)) &&
             (!detail || !strcmp(row->detail, detail));
  }
  return found;
}

static double first(const fixture *f, const char *family, const char *subject, const char *detail) {
  for (int r = 0; r < f->p->rows; r++) {
    const ambulo__table_row *row = &f->p->table.rows[r];
    if (!strcmp(row->family, family) && !strcmp(row->subject, subject) &&
        !strcmp(row->detail, detail))
      return f->workspace->row_value[r];
  }
  fail();
  return 0.0;
}

static void rows_stand_at_their_nodes(void **state) {
  (void)state;
  fixture f;
  open_with(&f, NULL);
  assert_int_equal(count(&f, "collision", NULL, NULL), 2 * 7);
  assert_int_equal(count(&f, "collision", "shank_r", "shank_l"), 7);
  assert_int_equal(count(&f, "collision", "foot_r", "thigh_l"), 7);
  assert_int_equal(count(&f, "obstacle", NULL, "crate"), 12 * 7);
  assert_int_equal(count(&f, "obstacle", NULL, "rail"), 2 * 7);
  assert_int_equal(count(&f, "reach", "head_top", NULL), 3);   /* equations, at one node */
  assert_int_equal(count(&f, "reach", "knee_r", NULL), 3 * 6); /* at 0, 1/6, 1/3 s */
  assert_int_equal(ambulo_problem_equality_count(f.p), 3);
  /* standing, 0.17 m between the shanks' lines; D and the weights of the smoothed distance */
  double allowance = 0.25 / 6.0, distance = 0.1 + 0.005 + allowance;
  double excess = 0.5 * 1e-3 * (0.16 * 0.16 * 1.75 * 1.75 + 0.05 * 0.05);
  assert_int_equal(ambulo__evaluate(f.workspace, f.x), AMBULO_OK);
  assert_close(first(&f, "collision", "shank_r", "shank_l"),
               0.17 - sqrt(distance * distance + excess), 1e-4);
  /* the middle of the head stands 1.66 m high, the rail's line passes 0.2 m ahead of it at 1.1 */
  assert_close(first(&f, "reach", "head_top", "forward"), -0.1, 1e-9);
  assert_close(first(&f, "reach", "head_top", "up"), 0.534643 * 1.75 + 0.486043 * 1.75 - 1.5, 1e-5);
  double knee = first(&f, "reach", "knee_r", "left lower");
  assert_close(knee, 0.1 - 0.085 + 0.01, 1e-5);
  assert_close(first(&f, "reach", "knee_r", "left upper"), 0.02 - knee, 1e-12);
  close_all(&f);
}

/* where s of the way between two ends is */
static void on_the_way(const double from[3], const double to[3], double s, double at[3]) {
  for (int i = 0; i < 3; i++) at[i] = from[i] + s * (to[i] - from[i]);
}

/* the rail and the crate of the task, beside the head that stands at q = 0, by trying all places of
 * both: x forward, y up, z right */
static double tried(double ends[2][3], double weight, int is_crate) {
  static const double rail[2][3] = {{0.2, 1.0, 1.0}, {0.2, 1.2, -1.0}};
  static const double center[3] = {0.4, 0.3, -0.1}, half[3] = {0.2, 0.3, 0.3};
  const double c = cos(0.5235987755982988), l = 0.5; /* 30 degrees to the left, -z */
  const double axes[3][3] = {{c, 0.0, -l}, {-l, 0.0, -c}, {0.0, 1.0, 0.0}};
  enum { STEPS = 1000 };
  double least = INFINITY;
  for (int i = 0; i <= STEPS; i++) {
    double s = (double)i / STEPS, x[3], y[3];
    on_the_way(ends[0], ends[1], s, x);
    for (int j = 0; j <= STEPS; j++) {
      double t = (double)j / STEPS, square = weight * (s - 0.5) * (s - 0.5);
      if (is_crate) {
        for (int k = 0; k < 3; k++) {
          double along = 0.0;
          for (int m = 0; m < 3; m++) along += axes[k][m] * (x[m] - center[m]);
          square += pow(fmax(0.0, fabs(along) - half[k]), 2.0);
        }
        least = fmin(least, square);
        break;
      }
      on_the_way(rail[0], rail[1], t, y);
      square += weight * (t - 0.5) * (t - 0.5);
      for (int k = 0; k < 3; k++) square += (x[k] - y[k]) * (x[k] - y[k]);
      least = fmin(least, square);
    }
  }
  return sqrt(least);
}

static void obstacles_are_where_they_say(void **state) {
  (void)state;
  fixture f;
  double ends[2][3];
  open_with(&f, NULL);
  const ambulo_model *m = f.p->model;
  const ambulo_capsule *head = NULL;
  for (int i = 0; i < m->capsule_count; i++)
    if (!strcmp(m->capsules[i].name, "head")) head = &m->capsules[i];
  assert_non_null(head);
  ambulo__neutral_place(m, head->link, head->from, ends[0]);
  ambulo__neutral_place(m, head->link, head->to, ends[1]);
  double square = head->radius * head->radius;
  for (int i = 0; i < 3; i++) square += pow(ends[1][i] - ends[0][i], 2.0);
  double weight = 1e-3 * square, allowance = 0.25 / 6.0;
  assert_int_equal(ambulo__evaluate(f.workspace, f.x), AMBULO_OK);
  double distance = head->radius + 0.03 + 0.02 + allowance;
  assert_close(first(&f, "obstacle", "head", "rail"),
               tried(ends, weight, 0) - sqrt(distance * distance + 0.5 * weight), 1e-6);
  distance = head->radius + allowance;
  assert_close(first(&f, "obstacle", "head", "crate"),
               tried(ends, weight, 1) - sqrt(distance * distance + 0.25 * weight), 1e-6);
  close_all(&f);
}

/* the way between two points: of both, all along, and no matter how high the ground is */
static void places_may_be_relative(void **state) {
  (void)state;
  static const char *const settings[] = {
      "constraints.reach=[{point: knee_r, relative_to: ankle_l, place: [0.1, -0.2, 0.5], "
      "tolerance: 0.01}]",
      "constraints.ground_height=0.3"};
  fixture f;
  open_settings(&f, settings, 2);
  assert_int_equal(count(&f, "reach", "knee_r", NULL), 7 * 6);
  assert_int_equal(ambulo__evaluate(f.workspace, f.x), AMBULO_OK);
  assert_close(first(&f, "reach", "knee_r", "forward lower"), 0.0 - 0.1 + 0.01, 1e-9);
  assert_close(first(&f, "reach", "knee_r", "left upper"), 0.01 - (-0.17 + 0.2), 1e-5);
  assert_close(first(&f, "reach", "knee_r", "up lower"), 0.249282 * 1.75 - 0.5 + 0.01, 1e-5);
  close_all(&f);
}

/* ground that is higher takes places along */
static void places_are_above_the_ground(void **state) {
  (void)state;
  fixture f, g;
  open_with(&f, NULL);
  open_with(&g, "constraints.ground_height=0.25");
  assert_int_equal(ambulo__evaluate(f.workspace, f.x), AMBULO_OK);
  int up = ambulo_model_find_coordinate(g.p->model, "pelvis_ty");
  for (int c = 0; c < g.p->control_points; c++) g.x[c * g.p->coordinates + up] = 0.25;
  assert_int_equal(ambulo__evaluate(g.workspace, g.x), AMBULO_OK);
  for (int r = 0; r < f.p->rows; r++)
    assert_close(f.workspace->row_value[r], g.workspace->row_value[r], 1e-9);
  close_all(&f);
  close_all(&g);
}

/* the gradient of a weighted sum by the reverse sweep, and that of each row by itself */
static void gradients_are_those_of_the_values(void **state) {
  (void)state;
  fixture f;
  open_with(&f, NULL);
  int n = f.p->variables, m = f.p->rows;
  double *weight = calloc((size_t)m, sizeof *weight), *sweep = calloc((size_t)n, sizeof *sweep);
  double *by_rows = calloc((size_t)n, sizeof *by_rows);
  for (int pose = 0; pose < 4; pose++) {
    static const double sizes[] = {0.0, 0.1, 0.6, 2.0};
    for (int j = 0; j < n; j++) f.x[j] = sizes[pose] * sin(3.0 * j + pose);
    for (int r = 0; r < m; r++) weight[r] = cos(r);
    assert_int_equal(ambulo__evaluate_jacobian(f.workspace, f.x), AMBULO_OK);
    assert_int_equal(ambulo__gradient(f.workspace, 0.0, weight, sweep), AMBULO_OK);
    memset(by_rows, 0, (size_t)n * sizeof *by_rows);
    for (int r = 0; r < m; r++) ambulo__row_add_gradient(f.workspace, r, weight[r], by_rows);
    for (int j = 0; j < n; j++) assert_close(sweep[j], by_rows[j], 1e-12);
    int off = 0;
    for (int j = 0; j < n; j++) {
      double here = f.x[j], value[2] = {0.0, 0.0};
      for (int side = 0; side < 2; side++) {
        f.x[j] = here + (side ? 1e-6 : -1e-6);
        assert_int_equal(ambulo__evaluate(f.workspace, f.x), AMBULO_OK);
        for (int r = 0; r < m; r++) value[side] += weight[r] * f.workspace->row_value[r];
      }
      f.x[j] = here;
      off += fabs((value[1] - value[0]) / 2e-6 - sweep[j]) > 1e-6 * (1.0 + fabs(sweep[j]));
    }
    assert_true(off <= n / 50); /* where two ways out of the crate are equally long */
  }
  free(weight);
  free(sweep);
  free(by_rows);
  close_all(&f);
}

/* points of the body keep their numbers, capsules' come behind; the body is the same */
static void the_model_has_the_capsules_points(void **state) {
  (void)state;
  fixture f;
  ambulo_model *plain = NULL;
  open_with(&f, NULL);
  assert_int_equal(ambulo_model_load("models/lower_body_21.yaml", NULL, NULL, NULL, &plain), 0);
  const ambulo_model *m = ambulo_problem_model(f.p);
  int points = ambulo_model_point_count(plain);
  assert_int_equal(ambulo_model_point_count(m), points + 2 * 12);
  for (int i = 0; i < points; i++)
    assert_string_equal(ambulo_model_point(m, i)->name, ambulo_model_point(plain, i)->name);
  assert_true(ambulo_model_find_point(m, "shank_l.to") >= points);
  assert_close(ambulo_model_mass(m), ambulo_model_mass(plain), 0.0);
  ambulo_model_free(plain);
  close_all(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(rows_stand_at_their_nodes),
                                     cmocka_unit_test(obstacles_are_where_they_say),
                                     cmocka_unit_test(places_are_above_the_ground),
                                     cmocka_unit_test(places_may_be_relative),
                                     cmocka_unit_test(gradients_are_those_of_the_values),
                                     cmocka_unit_test(the_model_has_the_capsules_points)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
