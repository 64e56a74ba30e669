/* Fronts by the program itself, of a problem whose front is known by formula; stopped, resumed,
 * refused.
 *
 * A rod turns from q = 0 at rest for one second and would be at 1, and is free at the end. The
 * terms are kinematic: with y = q - 1 and the weights a of the acceleration and b of the posture,
 * the best of int a y''^2 + b y^2 dt has
 *
 *     a y'''' + b y = 0,  y(0) = -1, y'(0) = 0, y''(1) = y'''(1) = 0,
 *
 * so y is a sum of e^(+-c t) cos c t, e^(+-c t) sin c t with c = (b / 4a)^(1/4). */
#include "base/diagnostics.h"
#include "study/results.h"
#include "support/fit_files.h"
#include "support/messages.h"

static const char model[] =
    "ambulo: 1\nkind: model\nname: one\nunits: {angle: radians}\ngravity: [0, -9.81, 0]\nforward: "
    "[1, 0, 0]\nlinks:\n"
    "  - {name: rod, parent: none, joint: revolute, dh: [-1.5708, 0, 1, 0], coordinate: {name: "
    "pin, range: [-3, 3]},\n"
    "     body: {mass: 1, com: [-0.5, 0, 0], inertia: [0, 0.1, 0.1, 0, 0, 0]}}\n";
static const char problem[] = "ambulo: 1\nkind: problem\nname: swing\nmodel: one.yaml\n"
                              "angles: radians\ntime: {duration: 1.0, intervals: 200}\ntrajectory: "
                              "{intervals: 50, degree: 4}\n"
                              "ends: {kind: free, initial: {pin: 0}, initial_speed: {pin: 0}}\n"
                              "objective:\n  - {term: acceleration, weight: 0.02}\n"
                              "  - {term: posture, angles: {pin: 1}, scale: {pin: 1}}\n";
static const char study[] = "ambulo: 1\nkind: sweep\nname: s\nbase: p.yaml\n"
                            "front: {terms: [acceleration, posture], points: 9}\n"
                            "outputs: [objective, verdict]\n";

static ambulo_sweep *load(void **state, const char *text) {
  ambulo_sweep *sweep = NULL;
  scratch_write(scratch_path(state, "p.yaml"), problem);
  scratch_write(scratch_path(state, "one.yaml"), model);
  scratch_write(scratch_path(state, "s.yaml"), text);
  assert_int_equal(ambulo_sweep_load(scratch_path(state, "s.yaml"), NULL, NULL, &sweep), AMBULO_OK);
  return sweep;
}

typedef struct stopper {
  int after; /* done; 0: never */
} stopper;

static int stop(void *user, const ambulo_batch_progress *p) {
  const stopper *s = user;
  return s->after > 0 && p->done >= s->after;
}

static ambulo_status run(const ambulo_sweep *sweep, const char *folder, int workers, int after,
                         int force, ambulo_diagnostics *list, ambulo_batch_progress *end) {
  ambulo_batch_options o = ambulo_batch_options_default();
  stopper s = {after};
  o.program = fit_program();
  o.workers = workers;
  o.force = force;
  o.progress = stop;
  o.user = &s;
  return ambulo_batch_run(sweep, folder, &o, NULL, list, end);
}

/* ------------------------------------------------------------ the known front */

enum { STEPS = 2000 };

/* x of A x = b, of four, by elimination with pivots */
static void solve4(double A[4][5], double x[4]) {
  for (int c = 0; c < 4; c++) {
    int pivot = c;
    for (int r = c + 1; r < 4; r++)
      if (fabs(A[r][c]) > fabs(A[pivot][c])) pivot = r;
    for (int k = 0; k < 5; k++) {
      double t = A[c][k];
      A[c][k] = A[pivot][k];
      A[pivot][k] = t;
    }
    for (int r = 0; r < 4; r++) {
      double f = r == c ? 0.0 : A[r][c] / A[c][c];
      for (int k = c; k < 5; k++) A[r][k] -= f * A[c][k];
    }
  }
  for (int r = 0; r < 4; r++) x[r] = A[r][4] / A[r][r];
}

/* derivative `order` of the four functions at t; those that grow are 1 in size at t = 1 */
static void functions(double c, double t, int order, double f[4]) {
  for (int k = 0; k < 2; k++) {
    double sign = k ? 1.0 : -1.0, e = exp(sign * c * t - (k ? c : 0.0));
    double a = e * cos(c * t), b = e * sin(c * t);
    for (int i = 0; i < order; i++) {
      double da = c * (sign * a - b), db = c * (sign * b + a);
      a = da;
      b = db;
    }
    f[2 * k] = a;
    f[2 * k + 1] = b;
  }
}

/* integrals of q''^2 and (q - 1)^2 of the best motion, by Simpson's rule */
static void best(double a, double b, double value[2]) {
  static const struct {
    double t, value;
    int order;
  } ends[4] = {{0.0, -1.0, 0}, {0.0, 0.0, 1}, {1.0, 0.0, 2}, {1.0, 0.0, 3}};
  double c = pow(b / (4.0 * a), 0.25), A[4][5], x[4], f[4];
  for (int r = 0; r < 4; r++) {
    functions(c, ends[r].t, ends[r].order, A[r]);
    A[r][4] = ends[r].value;
  }
  solve4(A, x);
  value[0] = value[1] = 0.0;
  for (int i = 0; i <= STEPS; i++) {
    double y[2] = {0.0, 0.0}, w = (i == 0 || i == STEPS ? 1.0 : i % 2 ? 4.0 : 2.0) / 3.0 / STEPS;
    for (int k = 0; k < 2; k++) {
      functions(c, (double)i / STEPS, k ? 0 : 2, f);
      for (int j = 0; j < 4; j++) y[k] += x[j] * f[j];
      value[k] += w * y[k] * y[k];
    }
  }
}

static void the_front_is_the_known_one(void **state) {
  ambulo_sweep *sweep = load(state, study);
  const char *folder = scratch_path(state, "b");
  ambulo_batch_census census;
  ambulo_batch_progress end;
  assert_int_equal(run(sweep, folder, 2, 0, 0, NULL, &end), AMBULO_OK);
  assert_true(end.done == end.cases && end.failed == 0 && end.resumed == 0);
  assert_int_equal(ambulo_batch_collect(folder, NULL, NULL, &census), AMBULO_OK);
  assert_true(census.front.terms == 2 && census.front.wanted == 9 && census.front.points >= 9);
  assert_int_equal(census.front.left_out + census.front.refused, 0);
  assert_true(census.front.largest_gap < 1.5 * census.front.mean_gap);
  ambulo__table table;
  assert_int_equal(ambulo__table_open(folder, AMBULO__CELLS, NULL, NULL, &table), AMBULO_OK);
  assert_int_equal(table.report.on, census.front.points);
  const ambulo__front front = table.front;
  double size[2] = {0.0, 0.0};
  for (int k = 0; k < front.points; k++)
    for (int i = 0; i < 2; i++) size[i] = fmax(size[i], front.point[k].value[i]);
  for (int k = 0; k < front.points; k++) {
    const ambulo__front_point *p = &front.point[k];
    double value[2];
    best(p->weight[0], p->weight[1], value);
    for (int i = 0; i < 2; i++) assert_close(p->value[i] / size[i], value[i] / size[i], 0.01);
    assert_close(p->total, p->weight[0] * p->value[0] + p->weight[1] * p->value[1], 1e-9);
  }
  ambulo__table_close(&table);
  ambulo_sweep_free(sweep);
}

/* ---------------------------------------------------------- stopped and resumed */

static void same_file(void **state, const char *name) {
  char path[2][64], *text[2];
  for (int i = 0; i < 2; i++) {
    (void)snprintf(path[i], sizeof path[i], "%s/%s", i ? "wild" : "calm", name);
    text[i] = read_whole(scratch_path(state, path[i]));
    assert_non_null(text[i]);
  }
  assert_string_equal(text[0], text[1]);
  assert_true(strlen(text[0]) > 100);
  for (int i = 0; i < 2; i++) free(text[i]);
}

static void resumed_runs_give_the_same_bytes(void **state) {
  ambulo_sweep *sweep = load(state, study);
  ambulo_batch_progress end;
  ambulo_batch_census census;
  assert_int_equal(run(sweep, scratch_path(state, "calm"), 2, 0, 0, NULL, &end), AMBULO_OK);
  int all = end.done, stops = 0;
  for (int after = 1; after <= all; after++) {
    assert_int_equal(run(sweep, scratch_path(state, "wild"), 1, after, 0, NULL, &end), AMBULO_OK);
    stops += end.done < end.cases;
    assert_true(end.done >= after || end.done == end.cases);
  }
  assert_true(stops > 3);
  assert_int_equal(run(sweep, scratch_path(state, "wild"), 1, 0, 0, NULL, &end), AMBULO_OK);
  assert_int_equal(end.done, all);
  assert_true(end.resumed >= all - 1);
  for (int i = 0; i < 2; i++)
    assert_int_equal(
        ambulo_batch_collect(scratch_path(state, i ? "wild" : "calm"), NULL, NULL, &census),
        AMBULO_OK);
  same_file(state, "results.csv");
  same_file(state, "results.jsonl");
  same_file(state, "cases.tsv");
  ambulo_sweep_free(sweep);
}

static void other_inputs_are_refused(void **state) {
  ambulo_sweep *sweep = load(state, study), *other;
  ambulo_batch_progress end;
  const char *folder = scratch_path(state, "b");
  assert_int_equal(run(sweep, folder, 2, 0, 0, NULL, &end), AMBULO_OK);
  other = load(state, "ambulo: 1\nkind: sweep\nname: s\nbase: p.yaml\n"
                      "front: {terms: [acceleration, posture], points: 7}\n");
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(run(other, folder, 2, 0, 0, list, &end), AMBULO_E_PROBLEM);
  assert_message(list, 0, "the front changed (was: acceleration 0.02, posture 1; 9 points");
  /* the ends are the same, and stay */
  assert_int_equal(run(other, folder, 2, 0, 1, NULL, &end), AMBULO_OK);
  assert_true(end.resumed >= 2 && end.done == end.cases);
  ambulo_batch_options o = ambulo_batch_options_default();
  o.shards = 2;
  ambulo__diagnostics_clear(list);
  assert_int_equal(ambulo_batch_run(sweep, folder, &o, NULL, list, &end), AMBULO_E_ARGUMENT);
  assert_message(list, 0, "the points of a front follow from each other");
  ambulo_diagnostics_free(list);
  ambulo_sweep_free(other);
  ambulo_sweep_free(sweep);
}

/* solves that fail leave a table and words, no front */
static void without_ends_there_is_no_front(void **state) {
  ambulo_sweep *sweep = load(state, study);
  ambulo_batch_options o = ambulo_batch_options_default();
  ambulo_batch_progress end;
  ambulo_batch_census census;
  const char *folder = scratch_path(state, "b");
  o.program = "/bin/false";
  assert_int_equal(ambulo_batch_run(sweep, folder, &o, NULL, NULL, &end), AMBULO_OK);
  assert_true(end.done == 2 && end.cases == 2 && end.failed == 2);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_batch_collect(folder, NULL, list, &census), AMBULO_OK);
  assert_message(list, 0, "no front: 'least acceleration' has no valid solution");
  assert_int_equal(census.front.points, 0);
  ambulo_diagnostics_free(list);
  ambulo_sweep_free(sweep);
}

/* a third term that would have the rod elsewhere */
static void three_terms_share_a_front(void **state) {
  char whole[2048];
  ambulo_sweep *sweep = load(state, study);
  ambulo_sweep_free(sweep);
  (void)snprintf(whole, sizeof whole,
                 "%s  - {term: posture, name: back, angles: {pin: -1}, scale: {pin: 1}}\n",
                 problem);
  scratch_write(scratch_path(state, "p.yaml"), whole);
  scratch_write(scratch_path(state, "s.yaml"),
                "ambulo: 1\nkind: sweep\nname: s\nbase: p.yaml\nstart_from: neighbour\n"
                "front: {terms: [acceleration, posture, back], points: 14}\n");
  assert_int_equal(ambulo_sweep_load(scratch_path(state, "s.yaml"), NULL, NULL, &sweep), AMBULO_OK);
  ambulo_batch_progress end;
  ambulo_batch_census census;
  const char *folder = scratch_path(state, "b");
  assert_int_equal(run(sweep, folder, 2, 0, 0, NULL, &end), AMBULO_OK);
  assert_int_equal(ambulo_batch_collect(folder, NULL, NULL, &census), AMBULO_OK);
  assert_true(census.front.terms == 3 && census.front.points >= 14);
  assert_int_equal(census.front.left_out, 0);
  assert_true(census.front.largest_gap < 5.0 * census.front.mean_gap);
  ambulo_sweep_free(sweep);
}

/* Solves by a script: J_1 = 1 - J_0 - 0.1 sin 2 pi J_0, whose second half is not convex; the best
 * of 200 motions. $9 and $11 are weights as --set has them. */
static const char wave_worker[] =
    "#!/bin/sh\n"
    "for a in \"$@\"; do case $a in objective?0?.weight=*) u=${a#*=} ;; objective?1?.weight=*) "
    "v=${a#*=} ;; esac; done\n"
    "mkdir -p \"$5\" && cd \"$5\" || exit 4\n"
    "awk -v u=$u -v v=$v 'BEGIN { best = 1e9; for (i = 0; i <= 200; i++) { s = i / 200; w = 1 - s "
    "- "
    "0.1 * sin(6.283185307 * s); t = u * s + v * w; if (t < best) { best = t; a = u * s; b = v * w "
    "} "
    "} printf \"{\\\"verdict\\\": \\\"optimal\\\", \\\"objective\\\": {\\\"total\\\": %.12g, "
    "\\\"terms\\\": {\\\"acceleration\\\": %.12g, \\\"posture\\\": %.12g}}, \\\"audit\\\": "
    "{\\\"violation\\\": {\\\"worst\\\": 1e-9}}}\\n\", best, a, b }' >summary.json\n"
    "echo 'ambulo: 1' >solution.yaml\n";

static void gaps_are_told(void **state) {
  ambulo_sweep *sweep = load(state, study);
  ambulo_batch_options o = ambulo_batch_options_default();
  ambulo_batch_progress end;
  ambulo_batch_census census;
  const char *folder = scratch_path(state, "b");
  scratch_write(scratch_path(state, "worker"), wave_worker);
  assert_int_equal(chmod(scratch_path(state, "worker"), 0700), 0);
  o.program = scratch_path(state, "worker");
  assert_int_equal(ambulo_batch_run(sweep, folder, &o, NULL, NULL, &end), AMBULO_OK);
  assert_true(end.failed == 0 && end.done > 9);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_batch_collect(folder, NULL, list, &census), AMBULO_OK);
  assert_int_equal(census.front.refused, 1);
  assert_message(list, 0, "no weights lead between the points");
  assert_message(list, 0, "acceleration 0.285 to 1)");
  ambulo_diagnostics_free(list);
  ambulo_sweep_free(sweep);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(the_front_is_the_known_one, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(resumed_runs_give_the_same_bytes, scratch_open,
                                      scratch_close),
      cmocka_unit_test_setup_teardown(other_inputs_are_refused, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(without_ends_there_is_no_front, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(three_terms_share_a_front, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(gaps_are_told, scratch_open, scratch_close),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
