/* An explanation in words: what was found is said, what was not found or not tried is not. */
#include "solver/explain.h"
#include "solver/result.h"
#include "support/engine_fixture.h"

typedef struct told {
  ambulo_problem *problem;
  ambulo_result result;
  ambulo__explanation out;
  char text[8000];
} told;

static ambulo_violation violation(const char *family, double worst) {
  return (ambulo_violation){.family = family,
                            .subject = "knee",
                            .detail = "upper",
                            .unit = "rad",
                            .time = 0.25,
                            .worst = worst,
                            .size = 1.0};
}

/* two families in conflict, nothing tried, nothing on a limit */
static told *open_told(void) {
  told *t = calloc(1, sizeof *t);
  t->problem = load_problem("pendulum_swing");
  t->result.audit.violation = violation("joint_limit", 0.5);
  ambulo__explanation *out = &t->out;
  out->view.contradictory = out->contradictory;
  out->view.conflicts = out->conflict;
  out->view.on_limits = out->on_limit;
  out->view.lines = out->line;
  out->view.suggestion = out->suggestion;
  out->view.settings = out->settings;
  out->view.complete = out->view.confirmed = 1;
  out->view.conflict_count = 2;
  for (int i = 0; i < 2; i++) {
    out->conflict[i].shared = violation(i ? "zmp" : "joint_limit", 0.2);
    out->conflict[i].relaxation = violation(i ? "zmp" : "joint_limit", 0.3);
    out->conflict[i].alone = -1;
  }
  return t;
}

static int says(told *t, const char *phrase) {
  t->out.view.line_count = 0;
  t->text[0] = '\0';
  ambulo__explain_lines(t->problem, &t->result, &t->out);
  for (int i = 0; i < t->out.view.line_count; i++) {
    size_t used = strlen(t->text);
    (void)snprintf(t->text + used, sizeof t->text - used, "%s\n", t->out.line[i]);
  }
  return strstr(t->text, phrase) != NULL;
}

static void close_told(told *t) {
  ambulo_problem_free(t->problem);
  free(t);
}

static void conflicts_are_told_by_how_they_were_found(void **state) {
  (void)state;
  told *t = open_told();
  assert_true(says(t, "worst row of the point returned: joint_limit, 0.5 rad at knee upper, t = "
                      "0.25 s\nin conflict, where every row gives way a little:\n"
                      "  joint_limit: 0.2 rad at knee upper, t = 0.25 s\n  zmp: 0.2 rad"));
  assert_false(says(t, "cut short"));
  t->out.view.complete = t->out.view.confirmed = 0;
  assert_true(says(t, "still violated, where every row gives way a little:"));
  assert_true(says(t, "cut short by the time limit: not every family could be tried"));
  assert_false(says(t, "to blame"));
  close_told(t);
}

static void what_was_tried_alone_is_told(void **state) {
  (void)state;
  told *t = open_told();
  assert_false(says(t, "dropping")); /* nothing was tried */
  assert_true(says(t, "no single family of rows is to blame: several have to give way"));
  t->out.conflict[0].alone = 0;
  assert_true(says(t, "dropping joint_limit alone did not make the problem feasible"));
  assert_false(says(t, "dropping zmp"));
  t->out.conflict[1].alone = 1;
  t->out.conflict[1].other_count = 1;
  t->out.conflict[1].others[0] = violation("zmp", 0.01);
  assert_true(says(t, "relaxing zmp alone is enough: by 0.3 rad at knee upper, t = 0.25 s\n"
                      "  and 0.01 rad at knee upper"));
  assert_false(says(t, "to blame"));
  close_told(t);
}

static void limits_and_settings_end_it(void **state) {
  (void)state;
  told *t = open_told();
  assert_false(says(t, "suggestion"));
  t->out.view.on_limit_count = 1;
  t->out.on_limit[0] = (ambulo_on_limit){.family = "joint_limit",
                                         .subject = "hip",
                                         .detail = "",
                                         .unit = "rad",
                                         .bound = 1.5,
                                         .from = 0.5,
                                         .to = 0.5,
                                         .nodes = 1};
  assert_true(says(t, "on its limit: joint_limit hip, 1.5 rad, t = 0.5 s\n"));
  t->out.on_limit[0].to = 0.75;
  t->out.on_limit[0].nodes = 6;
  assert_true(says(t, "on its limit: joint_limit hip, 1.5 rad, t = 0.5 to 0.75 s (6 nodes)\n"));
  (void)snprintf(t->out.suggestion, sizeof t->out.suggestion, "do less");
  t->out.view.setting_count = 1;
  t->out.settings[0] = "a.b=[1, 2]";
  assert_true(says(t, "suggestion: do less\n  --set 'a.b=[1, 2]'\n"));
  t->out.view.feasible_point = 1; /* then nothing was in conflict */
  assert_true(says(t, "the solver missed it"));
  assert_false(says(t, "suggestion"));
  close_told(t);
}

static void lines_have_room(void **state) {
  (void)state;
  told *t = open_told();
  for (int i = 0; i < AMBULO__MOST_LINES + 5; i++) ambulo__explain_line(&t->out, "line %d", i);
  assert_int_equal(t->out.view.line_count, AMBULO__MOST_LINES);
  assert_string_equal(t->out.line[AMBULO__MOST_LINES - 1], t->out.text[AMBULO__MOST_LINES - 1]);
  close_told(t);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(conflicts_are_told_by_how_they_were_found),
                                     cmocka_unit_test(what_was_tried_alone_is_told),
                                     cmocka_unit_test(limits_and_settings_end_it),
                                     cmocka_unit_test(lines_have_room)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
