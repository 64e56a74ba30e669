/* Expansion of a regular gait: the whole table, cutting at the ends, refusals. */
#include "ambulo/tools/load.h"
#include "contact/contacts.h"
#include "contact/row_families.h"
#include "contact/schedule.h"
#include "model/model.h"
#include "problem/nlp.h"
#include "solver/explain.h"
#include "support/patched_walker.h"
#include "support/test.h"
#include "support/walker_fixture.h"

static ambulo_gait two_steps(void) {
  ambulo_gait gait = {.size = sizeof(ambulo_gait),
                      .contact_size = sizeof(ambulo_contact),
                      .steps = 2,
                      .first_foot = WALKER_LEFT,
                      .step_length = 0.6,
                      .step_time = 0.7,
                      .step_width = 0.18,
                      .start = 0.05,
                      .heel_strike = -1.0 / 14.0,
                      .foot_flat = 1.0 / 14.0,
                      .heel_off = 6.0 / 14.0,
                      .toe_off = 8.0 / 14.0,
                      .other_step_length = AMBULO_OFF,
                      .other_step_time = AMBULO_OFF};
  return gait;
}

/* stride 1.4 s: a fourteenth of it is 0.1 s */
static void the_table_is_as_written_by_hand(void **state) {
  (void)state;
  static const ambulo_contact expected[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_TOE, 0.0, 0.1, .place = {-0.55, -0.09}},
      {WALKER_LEFT, AMBULO_CONTACT_HEEL, 0.0, 0.1, .place = {0.05, 0.09}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.1, 0.6, .place = {0.05, 0.09}},
      {WALKER_LEFT, AMBULO_CONTACT_TOE, 0.6, 0.8, .place = {0.05, 0.09}},
      {WALKER_RIGHT, AMBULO_CONTACT_HEEL, 0.6, 0.8, .place = {0.65, -0.09}},
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.8, 1.3, .place = {0.65, -0.09}},
      {WALKER_RIGHT, AMBULO_CONTACT_TOE, 1.3, 1.4, .place = {0.65, -0.09}},
      {WALKER_LEFT, AMBULO_CONTACT_HEEL, 1.3, 1.4, .place = {1.25, 0.09}}};
  ambulo_model *model = walker_create(0);
  ambulo_gait gait = two_steps();
  ambulo_contact contacts[8];
  int count = 0;
  assert_int_equal(ambulo_gait_expand(model, &gait, contacts, 8, &count), AMBULO_OK);
  assert_int_equal(count, 8);
  for (int i = 0; i < 8; i++) {
    assert_int_equal(contacts[i].foot, expected[i].foot);
    assert_int_equal(contacts[i].mode, expected[i].mode);
    assert_close(contacts[i].from, expected[i].from, 1e-14);
    assert_close(contacts[i].to, expected[i].to, 1e-14);
    assert_close(contacts[i].place[0], expected[i].place[0], 1e-14);
    assert_close(contacts[i].place[1], expected[i].place[1], 1e-14);
  }
  assert_int_equal(ambulo_gait_expand(model, &gait, contacts, 3, &count), AMBULO_E_LIMIT);
  assert_int_equal(count, 8);
  ambulo_model_free(model);
}

/* A foot that strikes exactly at the end is in contact at that instant; phases of no
 * length do not appear. */
static void the_last_instant_counts(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_gait gait = two_steps();
  gait.heel_strike = 0.0;
  gait.foot_flat = 0.0;
  gait.toe_off = gait.heel_off = 0.5;
  ambulo_contact contacts[16];
  int count = 0;
  assert_int_equal(ambulo_gait_expand(model, &gait, contacts, 16, &count), AMBULO_OK);
  assert_int_equal(count, 3);
  for (int i = 0; i < count; i++) assert_int_equal(contacts[i].mode, AMBULO_CONTACT_FLAT);
  assert_int_equal(contacts[2].foot, WALKER_LEFT);
  assert_close(contacts[2].from, 1.4, 1e-14);
  assert_close(contacts[2].to, 1.4, 1e-14);
  ambulo_model_free(model);
}

/* toes, sole, toes; a stance of less than half a stride leaves times without contact */
static void feet_may_land_on_their_toes(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_gait gait = two_steps();
  ambulo_contact contacts[16];
  int count = 0;
  gait.heel_strike = 0.0;
  gait.heel_off = 4.0 / 14.0;
  gait.toe_off = 5.0 / 14.0;
  gait.forefoot = 1;
  assert_int_equal(ambulo_gait_expand(model, &gait, contacts, 16, &count), AMBULO_OK);
  assert_int_equal(count, 7);
  for (int i = 0; i < 6; i++) {
    assert_int_equal(contacts[i].foot, i < 3 ? WALKER_LEFT : WALKER_RIGHT);
    assert_int_equal(contacts[i].mode, i % 3 == 1 ? AMBULO_CONTACT_FLAT : AMBULO_CONTACT_TOE);
    if (i % 3) assert_close(contacts[i].from, contacts[i - 1].to, 1e-14);
  }
  assert_close(contacts[2].to, 0.5, 1e-14);
  assert_close(contacts[3].from, 0.7, 1e-14);
  assert_int_equal(contacts[6].mode, AMBULO_CONTACT_TOE);
  gait.forefoot = 2;
  assert_int_equal(ambulo_gait_expand(model, &gait, contacts, 16, &count), AMBULO_E_ARGUMENT);
  ambulo_model_free(model);
}

static void impossible_gaits_are_refused(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  const ambulo_gait good = two_steps();
  ambulo_gait bad[] = {good, good, good, good, good, good};
  bad[0].steps = 0;
  bad[1].first_foot = 2;
  bad[2].step_time = 0.0;
  bad[3].foot_flat = 0.7;
  bad[4].toe_off = 1.0;
  bad[5].step_length = NAN;
  int count = -7;
  for (int i = 0; i < 6; i++) {
    assert_int_equal(ambulo_gait_expand(model, &bad[i], NULL, 0, &count), AMBULO_E_ARGUMENT);
    assert_int_equal(count, -7);
  }
  ambulo_model_free(model);
}

/* steps of 0.6 m in 0.5 s to the right and of 0.7 m in 0.6 s to the left: a stride of 1.1 s */
static void steps_may_alternate(void **state) {
  (void)state;
  ambulo_model *model = walker_create(0);
  ambulo_gait gait = two_steps();
  gait.first_foot = WALKER_LEFT;
  gait.step_length = 0.6;
  gait.step_time = 0.5;
  gait.other_step_length = 0.7;
  gait.other_step_time = 0.6;
  gait.heel_strike = 0.0;
  gait.foot_flat = 0.1;
  static const double strikes[] = {-1.1, -0.6, 0.0, 0.5, 1.1, 1.6};
  static const double places[] = {-1.3, -0.7, 0.0, 0.6, 1.3, 1.9};
  for (int s = -2; s <= 3; s++) {
    assert_close(ambulo__gait_strike(&gait, s), strikes[s + 2], 1e-12);
    assert_close(ambulo__gait_place(&gait, s), places[s + 2], 1e-12);
  }
  ambulo_contact contacts[16];
  int count = 0, found = 0;
  assert_int_equal(ambulo_gait_expand(model, &gait, contacts, 16, &count), AMBULO_OK);
  for (int i = 0; i < count; i++) {
    const ambulo_contact *c = &contacts[i];
    if (c->foot != WALKER_RIGHT || c->mode != AMBULO_CONTACT_HEEL || c->from < 0.2) continue;
    assert_close(c->from, 0.5, 1e-12);
    assert_close(c->to, 0.61, 1e-12);
    assert_close(c->place[0] - gait.start, 0.6, 1e-12);
    found = 1;
  }
  assert_true(found);
  ambulo_model_free(model);
}

static int test_expand_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(steps_may_alternate), cmocka_unit_test(the_table_is_as_written_by_hand),
      cmocka_unit_test(the_last_instant_counts), cmocka_unit_test(feet_may_land_on_their_toes),
      cmocka_unit_test(impossible_gaits_are_refused)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* What a gait asks of the legs: figures by hand, and the words about a walk that is none. */

static ambulo_problem *walk(const char *const *overrides, int count) {
  ambulo_problem *problem = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/support/walk_rigid.yaml", overrides, count, NULL, NULL, &problem),
      AMBULO_OK);
  return problem;
}

/* thigh and shank of de Leva's men at 1.75 m, heel 0.05 m behind and 0.075 m below the ankle */
static void the_figures_are_those_of_the_gait(void **state) {
  (void)state;
  ambulo_problem *p = walk(NULL, 0);
  ambulo__task t = ambulo__task_of(&p->definition);
  double leg = 1.75 * (0.242504 + 0.249282) + 0.0901388;
  assert_true(t.is_gait);
  assert_close(t.leg, leg, 1e-3);
  assert_close(t.speed, 0.68 / 0.54, 1e-12);
  assert_close(t.step, 0.68, 1e-12);
  assert_close(t.step_time, 0.54, 1e-12);
  assert_close(t.gravity, 9.81, 1e-12);
  assert_close(t.froude, 0.68 * 0.68 / (0.54 * 0.54 * 9.81 * t.leg), 1e-12);
  assert_close(t.grade, 0.0, 1e-12);
  ambulo_problem_free(p);
}

static void a_slope_has_its_tangent(void **state) {
  (void)state;
  static const char *const up[] = {"ground={slope: 10}"}, *const down[] = {"ground={slope: -10}"};
  for (int i = 0; i < 2; i++) {
    ambulo_problem *p = walk(i ? down : up, 1);
    ambulo__task t = ambulo__task_of(&p->definition);
    assert_close(t.grade, (i ? -1.0 : 1.0) * 0.17632698070846498, 1e-12);
    assert_close(t.gravity, 9.81, 1e-12);
    ambulo_problem_free(p);
  }
}

/* no feet, no steps, free ends: no speed is claimed */
static void what_is_no_gait_has_none(void **state) {
  (void)state;
  static const char *const free_ends[] = {"ends={kind: free}", "gait.steps=2",
                                          "time.duration=1.08"};
  ambulo_problem *p = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/support/two_link_reach.yaml", NULL, 0, NULL, NULL, &p), AMBULO_OK);
  assert_false(ambulo__task_of(&p->definition).is_gait);
  ambulo_problem_free(p);
  p = walk(free_ends, 3);
  ambulo__task t = ambulo__task_of(&p->definition);
  assert_true(t.is_gait && t.speed == 0.0 && t.froude == 0.0 && t.grade == 0.0);
  assert_close(t.step, 0.68, 1e-12);
  p->definition.contact_count = 0;
  assert_false(ambulo__task_of(&p->definition).is_gait);
  ambulo_problem_free(p);
}

/* all lines about the task */
static void tell(const ambulo_problem *p, char *text, size_t size) {
  ambulo__explanation *out = calloc(1, sizeof *out);
  ambulo__explain_task(p, out);
  text[0] = '\0';
  for (int i = 0; i < out->view.line_count; i++) {
    size_t used = strlen(text);
    (void)snprintf(text + used, size - used, "%s\n", out->line[i]);
  }
  free(out);
}

static void what_is_no_walk_is_told(void **state) {
  (void)state;
  static const struct {
    const char *overrides[3];
    int count;
    const char *phrases[3];
    const char *absent;
  } cases[] = {{{NULL}, 0, {NULL}, "walk"},
               {{"gait.speed=3.5", "time.duration=null"},
                2,
                {"would need a pull of 1.31 body weights", "from about 2.2 m/s on legs of 0.951 m",
                 "asked for: 3.5 m/s in steps of 0.68 m, 5.15 a second"},
                "longest"},
               {{"gait.speed=2.6", "time.duration=null"},
                2,
                {"hardly a walk", "0.72 of", "2.6 m/s"},
                "no walk"},
               {{"gait.speed=2.1", "time.duration=null"}, 2, {NULL}, "walk"},
               {{"gait.step_length=1.2"},
                1,
                {"no walk: a walk with these steps would need legs of 1.03 m"},
                "\n\n"},
               {{"gait.step_length=1.1"}, 1, {NULL}, "legs"},
               {{"ground={slope: 30}"},
                1,
                {"slip on a slope of 30 deg unless friction is 0.577"},
                "running"},
               {{"ground={slope: -30}"},
                1,
                {"slip on a slope of -30 deg unless friction is 0.577"},
                "legs of"},
               {{"ground={slope: 26}"}, 1, {NULL}, "slip"},
               {{"ground={slope: 30}", "ground_reaction.friction=off"}, 2, {NULL}, "slip"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    char text[2000];
    ambulo_problem *p = walk(cases[i].overrides, cases[i].count);
    tell(p, text, sizeof text);
    for (int k = 0; k < 3 && cases[i].phrases[k]; k++) {
      if (!strstr(text, cases[i].phrases[k])) print_error("case %d says\n%s\n", (int)i, text);
      assert_non_null(strstr(text, cases[i].phrases[k]));
    }
    if (strstr(text, cases[i].absent)) print_error("case %d says\n%s\n", (int)i, text);
    assert_null(strstr(text, cases[i].absent));
    ambulo_problem_free(p);
  }
}

/* planar legs hang on links of a whole length; a leg that slides has none */
static void legs_are_measured_along_their_links(void **state) {
  (void)state;
  ambulo_problem *p = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/support/walker_2d_step.yaml", NULL, 0, NULL, NULL, &p), AMBULO_OK);
  double leg = ambulo__task_of(&p->definition).leg;
  assert_true(leg > 0.85 && leg < 1.05);
  ambulo_model *model = p->owned_model;
  int link = model->points[model->feet[0].heel_center].link;
  while (model->links[link].coordinate < 0) link = model->links[link].parent;
  model->links[link].type = AMBULO_PRISMATIC;
  int other = model->points[model->feet[1].heel_center].link;
  while (model->links[other].coordinate < 0) other = model->links[other].parent;
  model->links[other].type = AMBULO_PRISMATIC;
  assert_false(ambulo__task_of(&p->definition).is_gait);
  ambulo_problem_free(p);
}

/* by hand: feet that hand over, one foot alone, backward, legs of two lengths */
static void each_figure_has_its_parts(void **state) {
  (void)state;
  ambulo_contact steps[2] = {{.foot = 0, .from = 0.0, .to = 0.2, .place = {0.1, -0.3}},
                             {.foot = 1, .from = 0.2, .to = 0.5, .place = {0.5, 0.0}}};
  ambulo_problem *p = walk(NULL, 0);
  ambulo_problem_definition d = p->definition;
  ambulo_model *model = (ambulo_model *)d.model;
  double leg = ambulo__task_of(&d).leg;
  d.contacts = steps;
  d.contact_count = 2;
  d.travel = -0.68;
  ambulo__task t = ambulo__task_of(&d);
  assert_close(t.step, 0.4, 1e-12); /* forward alone, of feet that meet at one time */
  assert_close(t.speed, 0.68 / 0.54, 1e-12);
  steps[1].foot = 0;
  assert_close(ambulo__task_of(&d).step, 0.0, 0); /* of two feet */
  steps[1].foot = 1;
  steps[1].from = 0.3;
  assert_close(ambulo__task_of(&d).step, 0.0, 0); /* between them is flight */
  double *left = model->points[model->feet[1].heel_center].position;
  double *right = model->points[model->feet[0].heel_center].position;
  memset(left, 0, 3 * sizeof *left);
  assert_close(ambulo__task_of(&d).leg, leg, 1e-12); /* the longer one */
  memset(right, 0, 3 * sizeof *right);
  double shank = ambulo__task_of(&d).leg;
  right[2] = 0.3;
  assert_close(ambulo__task_of(&d).leg, shank + 0.3, 1e-12);
  int feet = model->foot_count;
  model->foot_count = 1;
  assert_false(ambulo__task_of(&d).is_gait);
  model->foot_count = feet;
  ambulo_problem_free(p);
}

static int test_task_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(each_figure_has_its_parts),
                                     cmocka_unit_test(the_figures_are_those_of_the_gait),
                                     cmocka_unit_test(a_slope_has_its_tangent),
                                     cmocka_unit_test(what_is_no_gait_has_none),
                                     cmocka_unit_test(what_is_no_walk_is_told),
                                     cmocka_unit_test(legs_are_measured_along_their_links)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_expand_tests() + test_task_tests();
}
