/* `ground`, `load`, `ground_reaction`, tolerances and clearance. */
#include "definitions/problem_text.h"
#include "ambulo/tools/load.h"

#define HEAD "ambulo: 1\nkind: problem\nmodel: lower_body_18.yaml\n"
#define REST                                                                                       \
  "objective: none\ntime: {intervals: 4}\n"                                                        \
  "gait: {steps: 2, first_foot: left, step_length: 0.6, step_time: 0.5}\n"

static void expect_reaction(const ambulo_ground_reaction *r) {
  assert_int_equal(r->kind, AMBULO_REACTION_SHARED);
  assert_close(r->moment_arm, 0.06, 1e-15);
  assert_close(r->slant, 0.8, 1e-15);
  assert_close(r->loading_rate, 12.0, 1e-15);
  assert_close(r->flight_tolerance, 0.03, 1e-15);
  assert_close(r->heel_pad, 0.007, 1e-15);
  assert_close(r->friction, 0.4, 1e-15);
  assert_true(isnan(r->free_moment));
  assert_close(r->heel_pressure[0], -0.01, 1e-15);
  assert_close(r->heel_pressure[1], 0.02, 1e-15);
  assert_close(r->heel_roll, 0.05, 1e-15);
  assert_close(r->flat_pressure[0], 0.01, 1e-15);
  assert_close(r->flat_pressure[1], 0.03, 1e-15);
  assert_close(r->toe_pressure[0], -0.03, 1e-15);
  assert_close(r->toe_pressure[1], 0.04, 1e-15);
  assert_close(r->pressure_width, 0.03, 1e-15);
}

static void expect_contacts(const ambulo_problem_definition *d) {
  assert_close(d->minimum_force, 0.1, 1e-15);
  assert_close(d->contact_tolerance, 0.003, 1e-15);
  assert_close(d->orientation_tolerance, 0.02, 1e-15);
  assert_close(d->strike_pitch[0], 0.17453292519943295, 1e-15);
  assert_close(d->strike_pitch[1], 0.3490658503988659, 1e-15);
  assert_close(d->clearance.height, 0.01, 1e-15);
  assert_close(d->clearance.tip_from, 0.4, 1e-15);
  assert_close(d->clearance.ceiling, 0.3, 1e-15);
  assert_close(d->clearance.turn, 0.1, 1e-15);
  assert_close(d->clearance.outward, 0.05, 1e-15);
  assert_close(d->clearance.inward, 0.02, 1e-15);
  assert_close(d->clearance.feet, 0.015, 1e-15);
}

static void everything_is_read(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(
      HEAD REST
      "angles: degrees\n"
      "ground_reaction: {kind: shared, moment_arm: 0.06, slant: 0.8, loading_rate: 12, "
      "flight_tolerance: 0.03, heel_pad: 0.007, friction: 0.4, free_moment: off, minimum_force: "
      "0.1, pressure: "
      "{heel: [-0.01, "
      "0.02], roll: 0.05, flat: [0.01, 0.03], toe: [-0.03, 0.04], width: 0.03}}\n"
      "constraints: {contact_tolerance: 0.003, orientation_tolerance: 0.02, strike_pitch: "
      "[10, 20], clearance: {height: 0.01, tip_from: 0.4, ceiling: 0.3, turn: 0.1, "
      "outward: 0.05, inward: 0.02, feet: 0.015}}\n");
  expect_reaction(&p->definition.ground_reaction);
  expect_contacts(&p->definition);
  ambulo_problem_free(p);
}

static void defaults(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(HEAD REST "ground_reaction: {pressure: off}\n");
  const ambulo_ground_reaction *r = &p->definition.ground_reaction;
  assert_int_equal(r->kind, AMBULO_REACTION_SHARED);
  assert_int_equal(r->pressure, 0);
  assert_close(r->heel_pad, 0.0, 0.0);
  assert_true(!(p->definition.minimum_force >= 0.0));
  assert_true(isnan(p->definition.clearance.height));
  assert_true(isnan(p->definition.clearance.feet));
  assert_close(p->definition.contact_tolerance, 0.0, 0.0);
  ambulo_problem_free(p);
  p = problem_of(HEAD REST);
  assert_int_equal(p->definition.ground_reaction.kind, AMBULO_REACTION_NONE);
  ambulo_problem_free(p);
}

/* gravity (0, -g, 0) on ground that rises along x; the axes stay with the ground */
static void slopes_turn_gravity(void **state) {
  (void)state;
  ambulo_problem *p = problem_of(HEAD REST "angles: degrees\nground: {slope: 30}\n");
  const double *g = ambulo_model_gravity(p->model);
  assert_close(g[0], -9.81 * 0.5, 1e-12);
  assert_close(g[1], -9.81 * sqrt(0.75), 1e-12);
  assert_close(g[2], 0.0, 1e-12);
  assert_close(ambulo_model_up(p->model)[1], 1.0, 1e-15);
  assert_close(ambulo_model_forward(p->model)[0], 1.0, 1e-15);
  ambulo_problem_free(p);
}

static void loads_are_carried(void **state) {
  (void)state;
  ambulo_problem *p =
      problem_of(HEAD REST "load: {link: pelvis, mass: 20, position: [-0.2, 0.3, 0]}\n");
  ambulo_problem *free_handed = problem_of(HEAD REST);
  int link = ambulo_model_find_link(p->model, "pelvis");
  const ambulo_link *with = ambulo_model_link(p->model, link);
  const ambulo_link *without = ambulo_model_link(free_handed->model, link);
  assert_close(ambulo_model_mass(p->model), 95.0, 1e-9);
  assert_close(with->mass, without->mass + 20.0, 1e-12);
  assert_close(with->com[0] * with->mass, without->com[0] * without->mass - 4.0, 1e-9);
  assert_close(with->com[1] * with->mass, without->com[1] * without->mass + 6.0, 1e-9);
  ambulo_problem_free(p);
  ambulo_problem_free(free_handed);
}

/* the same in code: the hash sees every number of model and problem, the values every bit */
static void code_and_file_give_one_problem(void **state) {
  (void)state;
  ambulo_problem *from_file =
      problem_of(HEAD REST "angles: radians\nground: {slope: 0.09}\n"
                           "load: {link: pelvis, mass: 20, position: [-0.2, 0.3, 0.01]}\n"
                           "ground_reaction: {kind: shared}\n");
  ambulo_model *plain = NULL, *adapted = NULL;
  assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &plain), 0);
  ambulo_conditions conditions = ambulo_conditions_default();
  conditions.slope = 0.09;
  conditions.load_link = ambulo_model_find_link(plain, "pelvis");
  conditions.load_mass = 20.0;
  const double position[3] = {-0.2, 0.3, 0.01};
  memcpy(conditions.load_position, position, sizeof position);
  assert_int_equal(ambulo_model_adapt(plain, &conditions, NULL, NULL, &adapted), AMBULO_OK);
  ambulo_problem_definition definition = from_file->definition;
  definition.model = adapted;
  ambulo_problem *from_code = NULL;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &from_code), AMBULO_OK);
  assert_true(ambulo_problem_hash(from_code) == ambulo_problem_hash(from_file));
  definition.model = plain;
  ambulo_problem *level = NULL;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &level), AMBULO_OK);
  assert_true(ambulo_problem_hash(level) != ambulo_problem_hash(from_file));
  ambulo_problem_free(level);
  ambulo_problem_free(from_code);
  ambulo_problem_free(from_file);
  ambulo_model_free(adapted);
  ambulo_model_free(plain);
}

static void faults_are_placed(void **state) {
  (void)state;
  expect_refusal(HEAD REST "ground: {slope: 5}\n", AMBULO_E_SCHEMA,
                 "does not state its unit; expected 'angles:");
  expect_refusal(HEAD REST "angles: degrees\nground: {slope: 50}\n", AMBULO_E_SCHEMA,
                 "p.yaml:8:17: error[E_SCHEMA]: a slope of");
  expect_refusal(HEAD REST "load: {link: pelvs, mass: 20, position: [0, 0, 0]}\n", AMBULO_E_PROBLEM,
                 "unknown link (got 'pelvs'); expected a link of the model\n"
                 "  hint: did you mean 'pelvis'?");
  expect_refusal(HEAD REST "ground_reaction: {kind: twostep}\n", AMBULO_E_SCHEMA,
                 "expected one of: none, shared");
  expect_refusal(HEAD REST "ground_reaction: {pressure: {toe: [0.1, 0]}}\n", AMBULO_E_PROBLEM,
                 "expected lower < upper");
  expect_refusal(HEAD REST "angles: degrees\nconstraints: {strike_pitch: [24, 12]}\n",
                 AMBULO_E_PROBLEM, "expected two rising angles");
  expect_refusal(HEAD REST "constraints: {clearance: {tip_from: 0.3}}\n", AMBULO_E_SCHEMA,
                 "'height'");
  expect_refusal(PENDULUM "objective: none\ntime: {duration: 1, intervals: 4}\n"
                          "ground_reaction: {kind: shared}\n",
                 AMBULO_E_PROBLEM, "with 0 links");
}

/* the law of earlier versions: one line, at its place, with what to write instead */
static void a_prescribed_split_is_refused(void **state) {
  (void)state;
  expect_refusal(
      HEAD REST "ground_reaction: {kind: two_step, transfer: early, exponent: 1.4, "
                "shear: 1}\n",
      AMBULO_E_SCHEMA,
      "p.yaml:7:25: error[E_SCHEMA]: the prescribed split of the load is no longer a law "
      "(got 'two_step'); expected shared or none\n"
      "  hint: write 'kind: shared', and leave out transfer, exponent and shear");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(everything_is_read),
                                     cmocka_unit_test(defaults),
                                     cmocka_unit_test(slopes_turn_gravity),
                                     cmocka_unit_test(loads_are_carried),
                                     cmocka_unit_test(code_and_file_give_one_problem),
                                     cmocka_unit_test(a_prescribed_split_is_refused),
                                     cmocka_unit_test(faults_are_placed)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
