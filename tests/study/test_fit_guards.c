/* Guards: what is read and refused, conditions without a reference, other bodies, and a fit that a
 * guard stops. */
#include "study/batch.h"
#include "support/fit_files.h"
#include "support/fit_runner.h"

#define WITH(conditions, curves)                                                                   \
  FIT_HEAD FIT_PARAMETERS "conditions:\n" conditions "distance: {curves: {" curves "}}\n"
#define SLOW "  - {name: slow, reference: slow.csv}\n"
#define BARE "  - {name: bare, set: {time.duration: 0.7}, curves: [top]}\n"
#define TOP "top: {curve: pin, of: peak, at_most: 40, sd: 4}"

static void guards_are_read(void **state) {
  ambulo_fit *f = fit_of(
      state, WITH(SLOW BARE, "pin: 1,\n  " TOP ",\n  low: {curve: pin, of: lowest, between: [20, "
                             "21.2], weight: 2, at_least: -3, at_most: 5, sd: 1}"));
  assert_int_equal(f->curve[0].is_guard, 0);
  assert_int_equal(f->curve[1].is_guard, 1);
  assert_true(isinf(f->curve[1].bound[0]) && f->curve[1].bound[0] < 0.0);
  assert_close(f->curve[1].bound[1], 40.0, 0.0);
  assert_close(f->curve[2].bound[0], -3.0, 0.0);
  assert_close(f->curve[2].bound[1], 5.0, 0.0);
  /* every half percent, or closer, with both ends */
  const ambulo__fit_target *t = f->condition[0].target;
  assert_int_equal(f->condition[0].targets, 3);
  assert_int_equal(t[1].points, 201);
  assert_close(t[1].percent[1], 0.5, 1e-12);
  assert_close(t[1].percent[200], 100.0, 1e-12);
  assert_int_equal(t[2].points, 4);
  assert_close(t[2].percent[0], 20.0, 1e-12);
  assert_close(t[2].percent[3], 21.2, 1e-12);
  for (int k = 1; k < 3; k++) {
    assert_null(t[k].mean);
    assert_int_equal(t[k].count, 1);
    assert_string_equal(t[k].entry->result, "q.pin");
  }
  assert_close(t[1].sd, 4.0, 0.0);
  /* the other condition has the guard alone, and no reference */
  assert_null(f->condition[1].reference);
  assert_int_equal(f->condition[1].targets, 1);
  assert_int_equal(f->condition[1].target[0].curve, 1);
  assert_int_equal(f->residuals, 23 + 2 + 1);
  ambulo_fit_free(f);
}

/* without a map of one's own the curves are those of docs/compare.md, by their own names */
static void curves_of_the_built_in_map(void **state) {
  ambulo_fit *f =
      fit_of(state, "ambulo: 1\nkind: fit\nname: swing\nproblem: p.yaml\n" FIT_PARAMETERS
                    "conditions:\n  - {name: bare}\n"
                    "distance: {curves: {\n"
                    "  lumbar_bending_moment: {of: largest, at_most: 0.3, sd: 0.1},\n"
                    "  lumbar_extension_moment: {of: peak, at_most: 0.3, sd: 0.1},\n"
                    "  hip_abduction_moment: {of: peak, at_most: 1.2, sd: 0.1},\n"
                    "  grf_medial: {of: range, at_most: 1.1, sd: 0.1}, hip_flexion: {of: peak, "
                    "at_most: 50, sd: 5},\n  mtp_extension: {of: peak, at_most: 40, sd: 4}}}\n");
  static const char *const results[] = {"tau.lumbar_bending",       "tau.lumbar_extension",
                                        "tau.hip_adduction_{side}", "grf.{foot}.right",
                                        "q.hip_flexion_{side}",     "q.mtp_angle_{side}"};
  assert_int_equal(f->condition[0].targets, 6);
  for (int k = 0; k < 6; k++)
    assert_string_equal(f->condition[0].target[k].entry->result, results[k]);
  assert_int_equal(f->condition[0].target[4].entry->tilted, 1);
  ambulo_fit_free(f);
}

static void bounds_that_are_none(void **state) {
#define TRY(curve) WITH(SLOW, "pin: 1, top: " curve)
  fit_refused(state, TRY("{curve: pin, at_most: 4, sd: 1}"),
              "fit.yaml:11:56: error[E_SCHEMA]: 'at_most' bounds a number of a curve; expected "
              "'of: peak', 'lowest', 'largest' or 'range' with it");
  fit_refused(state, TRY("{curve: pin, of: peak, at_most: 4}"),
              "fit.yaml:11:34: error[E_SCHEMA]: missing required key 'sd'");
  fit_refused(state, TRY("{curve: pin, of: peak, at_least: 5, at_most: 4, sd: 1}"),
              "fit.yaml:11:79: error[E_SCHEMA]: at_least 5 and at_most 4; expected the first not "
              "above the other");
  fit_refused(state, TRY("{curve: pin, of: peak, at_most: 4, sd: 0}"), "a deviation of 0");
  fit_refused(state, TRY("{curve: pin, of: peak, at_most: x, sd: 1}"), "fit.yaml:11:66: error");
  fit_refused(state, TRY("{curve: pin, of: peak, at_most: 4, sd: 1, reference: slow.csv}"),
              "fit.yaml:11:76: error[E_SCHEMA]: unknown key 'reference'");
  fit_refused(state, TRY("{curve: pni, of: peak, at_most: 4, sd: 1}"),
              "fit.yaml:11:42: error[E_SCHEMA]: the guard 'top' is of no curve of the column map "
              "(got 'pni'); expected one");
  fit_refused(state, TRY("{curve: pni, of: peak, at_most: 4, sd: 1}"), "did you mean 'pin'?");
}

static void references_and_guards(void **state) {
  fit_refused(state, WITH("  - {name: bare, curves: [top, pin]}\n", "pin: 1, " TOP),
              "fit.yaml:10:32: error[E_SCHEMA]: condition 'bare' has no reference, which its curve "
              "'pin' needs");
  fit_refused(state, WITH("  - {name: bare}\n", "pin: 1, " TOP),
              "fit.yaml:10:5: error[E_SCHEMA]: condition 'bare' has no reference, which its curve "
              "'pin' needs");
  fit_refused(
      state, WITH("  - {name: both, reference: slow.csv, curves: [top]}\n", "pin: 1, " TOP),
      "fit.yaml:10:29: error[E_SCHEMA]: all curves of condition 'both' are guards, which no "
      "reference bounds");
}

/* ---------------------------------------------------------------------- trials */

/* a guard that holds changes neither the distance nor a residual of the others */
static void one_that_holds_changes_nothing(void **state) {
  static const char *const texts[] = {
      WITH(SLOW, "pin: 1"),
      WITH(SLOW "  - {name: bare, curves: [top]}\n",
           "pin: 1, top: {curve: pin, of: peak, weight: 7, at_most: 80, sd: 1}")};
  double distance[2], first[2];
  for (int i = 0; i < 2; i++) {
    fit_runner w;
    fit_runner_open(state, texts[i], &w);
    assert_int_equal(ambulo__fit_evaluate(&w.runner, AMBULO__FIT_ALL, NULL, w.trial, 1), AMBULO_OK);
    distance[i] = w.trial->distance;
    first[i] = w.trial->residual[0];
    if (i) assert_close(w.trial->apart[1], 0.0, 0.0);
    fit_runner_close(&w);
  }
  assert_true(distance[0] > 0.1);
  assert_close(distance[1], distance[0], 0.0);
  assert_close(first[1], first[0], 0.0);
}

/* one that is broken adds its z, by the weights of what is compared; alone, by its own */
static void one_that_is_broken(void **state) {
  fit_runner w;
  fit_runner_open(state,
                  WITH("  - {name: slow, reference: slow.csv, weight: 3}\n" BARE,
                       "pin: 2, top: {curve: pin, of: peak, weight: 7, at_most: 54, sd: 3}"),
                  &w);
  const ambulo__fit_trial *t = w.trial;
  assert_int_equal(ambulo__fit_evaluate(&w.runner, AMBULO__FIT_ALL, NULL, w.trial, 1), AMBULO_OK);
  double pin = t->score[0][0].z, slow = t->score[0][1].z, bare = t->score[1][1].z, sum = 0.0;
  assert_true(slow > 0.5 && bare > 0.5 && pin > 0.5);
  assert_true(t->score[1][1].value > 54.0);
  for (int k = 0; k < w.fit->residuals; k++) sum += t->residual[k] * t->residual[k];
  assert_close(t->distance, (3.0 * (2.0 * pin + 7.0 * slow) + 7.0 * bare) / 6.0, 1e-12);
  assert_close(sum, t->distance, 1e-12);
  assert_close(t->apart[0], (2.0 * pin + 7.0 * slow) / 2.0, 1e-12);
  assert_close(t->apart[1], bare, 1e-12);
  fit_runner_close(&w);
  fit_runner_open(
      state,
      WITH("  - {name: bare}\n", "top: {curve: pin, of: peak, weight: 7, at_most: 54, sd: 3}"), &w);
  assert_int_equal(ambulo__fit_evaluate(&w.runner, AMBULO__FIT_ALL, NULL, w.trial, 1), AMBULO_OK);
  assert_true(w.trial->distance > 0.5);
  assert_close(w.trial->distance, w.trial->score[0][0].z, 1e-12);
  fit_runner_close(&w);
}

/* -------------------------------------------------------------- bodies and fits */

/* of the body that is solved for a condition */
static double mass_of(const fit_runner *w, int condition) {
  const char *id = w->runner.sweep->cases[w->trial->index[condition]].id;
  char *folder = ambulo__case_path(&w->allocator, w->runner.solves, id, "");
  ambulo__cycle cycle;
  assert_int_equal(ambulo__cycle_open(folder, &w->fit->compare, NULL, NULL, &cycle), AMBULO_OK);
  double mass = cycle.mass;
  ambulo__cycle_close(&cycle);
  ambulo__free(&w->allocator, folder);
  return mass;
}

/* conditions may be other subjects: a shorter rod takes less torque per mass */
static void bodies(void **state) {
  static const char model[] =
      "ambulo: 1\nkind: model\nname: one\nunits: {angle: radians, length: stature, mass: "
      "body_mass, torque: weight_stature}\nsubject: {mass: 70, stature: 2, sex: male}\n"
      "gravity: [0, -9.81, 0]\nforward: [1, 0, 0]\nlinks:\n"
      "  - {name: rod, parent: none, joint: revolute, dh: [-1.5708, 0, 0.5, 0], coordinate: {name: "
      "pin, range: [-3, 3]},\n     body: {mass: 1, com: [-0.25, 0, 0], gyration: [0, 0.1, 0.1]}}\n";
  static const double masses[] = {70.0, 35.0, 60.0};
  fit_runner w;
  char problem[sizeof fit_problem];
  memcpy(problem, fit_problem, sizeof problem);
  memcpy(strstr(problem, "one.yaml"), "man.yaml", 8);
  scratch_write(scratch_path(state, "man.yaml"), model);
  scratch_write(scratch_path(state, "man_swings.yaml"), problem);
  scratch_write(scratch_path(state, "turn.csv"),
                "curve,reference,result,unit\nturn,turn,tau.pin,N m/kg\n");
  fit_runner_open(state,
                  "ambulo: 1\nkind: fit\nname: swing\nproblem: man_swings.yaml\n"
                  "compare: {map: turn.csv, foot: left}\n" FIT_PARAMETERS
                  "conditions:\n  - {name: usual}\n  - {name: light, set: {subject.mass: 35}}\n"
                  "  - {name: short, set: {subject.mass: 60, subject.stature: 1.5}}\n"
                  "distance: {curves: {turn: {of: largest, at_most: 1, sd: 100}}}\n",
                  &w);
  const ambulo__fit_trial *t = w.trial;
  assert_int_equal(ambulo__fit_evaluate(&w.runner, AMBULO__FIT_ALL, NULL, w.trial, 1), AMBULO_OK);
  for (int c = 0; c < 3; c++) assert_close(mass_of(&w, c), masses[c], 1e-9);
  double usual = t->score[0][0].value, light = t->score[1][0].value, shorter = t->score[2][0].value;
  assert_true(usual > 0.5);
  assert_close(light, usual, 0.1 * usual);
  assert_true(shorter < 0.85 * usual);
  fit_runner_close(&w);
}

static double number_at(ambulo__yaml *document, const char *path) {
  const ambulo__yaml_node *node = ambulo__yaml_at(document, path);
  if (!node) print_error("no %s\n", path);
  assert_non_null(node);
  return ambulo__yaml_number(node, (double)NAN);
}

/* a swing to 1.2 rad */
static void write_swing(void **state) {
  FILE *f = fopen(scratch_path(state, "swing.csv"), "w");
  assert_non_null(f);
  fprintf(f, "percent,pin,pin sd\n");
  for (int p = 0; p < 100; p += 5) {
    double s = 0.01 * p;
    fprintf(f, "%d,%.12g,2\n", p, 68.75 * s * s * (3.0 - 2.0 * s));
  }
  assert_int_equal(fclose(f), 0);
}

/* the fit of the swing with a guard of its peak; *top, *distance: at the end */
static void fit_swing(void **state, const char *guard, const char *says, double *top,
                      double *distance) {
  char text[1024], *report = NULL;
  ambulo_fit_options o = ambulo_fit_options_default();
  ambulo__yaml *document = NULL;
  o.program = fit_program();
  o.workers = 1;
  o.force = 1;
  (void)snprintf(text, sizeof text,
                 FIT_HEAD FIT_PARAMETERS
                 "conditions:\n  - {name: slow, reference: swing.csv}\n"
                 "distance: {curves: {pin: 1, top: {curve: pin, of: peak, %s}}}\n",
                 guard);
  write_swing(state);
  ambulo_fit *fit = fit_of(state, text);
  assert_int_equal(ambulo_fit_run(fit, scratch_path(state, "out"), &o, NULL, NULL, NULL, &report),
                   AMBULO_OK);
  assert_non_null(strstr(report, "guard  "));
  assert_non_null(strstr(report, says));
  assert_int_equal(ambulo__yaml_load(scratch_path(state, "out/fit.json"), NULL, NULL, &document),
                   AMBULO_OK);
  *top = number_at(document, "conditions.slow.curves.top.after.value");
  *distance = number_at(document, "distance.after");
  assert_close(number_at(document, "conditions.slow.curves.top.at_most"),
               strstr(guard, "90") ? 90.0 : 63.0, 0.0);
  assert_int_equal(ambulo__yaml_at(document, "conditions.slow.curves.top.at_least") != NULL,
                   strstr(guard, "at_least") != NULL);
  assert_null(ambulo__yaml_at(document, "conditions.slow.curves.top.after.reference"));
  ambulo__yaml_free(document);
  free(report);
  ambulo_fit_free(fit);
}

/* The reference swings further than the guard allows, which holds at first: its differences there
 * are 0. The fit goes up to it, neither beyond nor back. */
static void a_fit_that_a_guard_stops(void **state) {
  double top[2], distance[2];
  fit_swing(state, "at_most: 90, sd: 0.2", "-      90.0\n", &top[0], &distance[0]);
  fit_swing(state, "at_least: 20, at_most: 63, sd: 0.2", "20.0      63.0\n", &top[1], &distance[1]);
  assert_true(top[0] > 66.0);
  assert_close(top[1], 63.0, 0.3);
  assert_true(distance[1] > distance[0]);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {
      TEST(guards_are_read),
      TEST(curves_of_the_built_in_map),
      TEST(bounds_that_are_none),
      TEST(references_and_guards),
      TEST(one_that_holds_changes_nothing),
      TEST(one_that_is_broken),
      TEST(bodies),
      TEST(a_fit_that_a_guard_stops),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
