/* What a gait asks of the legs: figures by hand, and the words about a walk that is none. */
#include "contact/task.h"
#include "ambulo/tools/load.h"
#include "model/model.h"
#include "problem/nlp.h"
#include "solver/explain.h"
#include "support/test.h"

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

/* no feet, no contacts, free ends: no speed is claimed */
static void what_is_no_gait_has_none(void **state) {
  (void)state;
  static const char *const free_ends[] = {"ends={kind: free}", "gait.steps=2",
                                          "time.duration=1.08"};
  ambulo_problem *p = NULL;
  assert_int_equal(ambulo_problem_load("models/two_link_reach.yaml", NULL, 0, NULL, NULL, &p),
                   AMBULO_OK);
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
  assert_int_equal(ambulo_problem_load("models/walker_2d_step.yaml", NULL, 0, NULL, NULL, &p),
                   AMBULO_OK);
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
  ambulo_contact contacts[2] = {{.foot = 0, .from = 0.0, .to = 0.2, .place = {0.1, -0.3}},
                                {.foot = 1, .from = 0.2, .to = 0.5, .place = {0.5, 0.0}}};
  ambulo_problem *p = walk(NULL, 0);
  ambulo_problem_definition d = p->definition;
  ambulo_model *model = (ambulo_model *)d.model;
  double leg = ambulo__task_of(&d).leg;
  d.contacts = contacts;
  d.contact_count = 2;
  d.travel = -0.68;
  ambulo__task t = ambulo__task_of(&d);
  assert_close(t.step, 0.4, 1e-12); /* forward alone, of feet that meet at one time */
  assert_close(t.speed, 0.68 / 0.54, 1e-12);
  contacts[1].foot = 0;
  assert_close(ambulo__task_of(&d).step, 0.0, 0); /* of two feet */
  contacts[1].foot = 1;
  contacts[1].from = 0.3;
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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(each_figure_has_its_parts),
                                     cmocka_unit_test(the_figures_are_those_of_the_gait),
                                     cmocka_unit_test(a_slope_has_its_tangent),
                                     cmocka_unit_test(what_is_no_gait_has_none),
                                     cmocka_unit_test(what_is_no_walk_is_told),
                                     cmocka_unit_test(legs_are_measured_along_their_links)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
