/* gait.svg: well-formed, one group a figure, survives motions that are not finite. */
#include "model/conditions.h"
#include "ambulo/tools/load.h"
#include "show/gait_svg.h"
#include "support/arm.h"
#include "support/walker_result.h"
#include "support/wellformed.h"

static void test_walk(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  assert_int_equal(ambulo__gait_svg(w.problem, w.result, NULL, &text), AMBULO_OK);
  const char *svg = ambulo__text_data(&text);
  assert_true(is_xml(svg));
  int figures = occurrences(svg, "<g class=\"figure\">");
  if (figures < 9 || figures > 15) print_error("%d figures\n", figures);
  assert_true(figures >= 9 && figures <= 15);
  /* each figure has one path a leg; three panels of angles and three of torques have one
   * curve a side */
  assert_int_equal(occurrences(svg, "<path class=\"left\""), figures);
  assert_int_equal(occurrences(svg, "<path class=\"right\""), figures);
  assert_int_equal(occurrences(svg, "<circle class=\"head\""), figures);
  assert_int_equal(occurrences(svg, "<path class=\"left curve\""), 6);
  assert_int_equal(occurrences(svg, "<path class=\"right curve\""), 6);
  assert_non_null(strstr(svg, "Hip flexion torque, N m"));
  assert_non_null(strstr(svg, "feasible"));
  assert_null(strstr(svg, "infeasible"));
  assert_null(strstr(svg, "nan"));
  ambulo__text_free(&text);
  walk_close(&w);
}

static void test_not_finite(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  int n = ambulo_problem_variable_count(w.problem);
  for (int i = 0; i < n; i++) w.result->x[i] = i % 2 ? (double)NAN : 1e200;
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  assert_int_equal(ambulo__gait_svg(w.problem, w.result, NULL, &text), AMBULO_OK);
  assert_true(is_xml(ambulo__text_data(&text)));
  assert_null(strstr(ambulo__text_data(&text), "nan"));
  assert_null(strstr(ambulo__text_data(&text), "inf"));
  ambulo__text_free(&text);
  walk_close(&w);
}

/* no feet, no sides, nothing that moves on */
static void test_arm(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  ambulo_problem_definition definition = arm_definition(model);
  definition.name = "a <swing> & more";
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_problem_create(&definition, NULL, NULL, &problem), AMBULO_OK);
  assert_int_equal(ambulo__result_create(problem, NULL, &result), AMBULO_OK);
  arm_point(result->x, ambulo_problem_variable_count(problem), 0.7);
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  assert_int_equal(ambulo__gait_svg(problem, result, NULL, &text), AMBULO_OK);
  const char *svg = ambulo__text_data(&text);
  assert_true(is_xml(svg));
  assert_non_null(strstr(svg, "a &lt;swing&gt; &amp; more"));
  assert_int_equal(occurrences(svg, "<path class=\"trunk\""),
                   occurrences(svg, "<g class=\"figure\">"));
  assert_int_equal(occurrences(svg, "<path class=\"trunk curve\""), 4);
  assert_null(strstr(svg, "class=\"ground\""));
  ambulo__text_free(&text);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

/* figures stand upright on one line that rises as the ground does; what is too steep is drawn level
 * and says so */
static void test_slope(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  assert_int_equal(ambulo__gait_svg(w.problem, w.result, NULL, &text), AMBULO_OK);
  assert_null(strstr(ambulo__text_data(&text), "hill"));
  ambulo__text_clear(&text);
  ambulo_model *model = w.model;
  ambulo__model_tilt(model, 5.0 / 57.295779513082321);
  assert_int_equal(ambulo__gait_svg(w.problem, w.result, NULL, &text), AMBULO_OK);
  const char *svg = ambulo__text_data(&text), *ground = strstr(svg, "<line class=\"ground\"");
  double x1, y1, x2, y2;
  assert_true(is_xml(svg));
  assert_non_null(strstr(svg, "uphill 5\xc2\xb0<"));
  assert_non_null(ground);
  assert_int_equal(sscanf(ground,
                          "<line class=\"ground\" x1=\"%lf\" y1=\"%lf\" x2=\"%lf\" y2=\"%lf", &x1,
                          &y1, &x2, &y2),
                   4);
  assert_close((y1 - y2) / (x2 - x1), tan(5.0 / 57.295779513082321), 1e-4);
  int figures = occurrences(svg, "<g class=\"figure\">");
  assert_int_equal(occurrences(svg, "<g class=\"turned\" transform=\"rotate(-5 "), figures);
  for (const char *turned = svg; (turned = strstr(turned, "rotate(-5 ")) != NULL; turned++) {
    double x, y; /* it turns about a place on the ground */
    assert_int_equal(sscanf(turned, "rotate(-5 %lf %lf)", &x, &y), 2);
    assert_close(y, y1 + (y2 - y1) * (x - x1) / (x2 - x1), 0.03);
  }
  ambulo__text_clear(&text);
  ambulo__model_tilt(model, 65.0 / 57.295779513082321);
  assert_int_equal(ambulo__gait_svg(w.problem, w.result, NULL, &text), AMBULO_OK);
  assert_non_null(strstr(ambulo__text_data(&text), "(drawn level)"));
  assert_null(strstr(ambulo__text_data(&text), "rotate("));
  ambulo__text_free(&text);
  walk_close(&w);
}

/* each figure stands on its own piece of stairs, instead of all on one line */
static void test_stairs(void **state) {
  (void)state;
  for (int rises = 0; rises < 2; rises++) {
    walk w;
    walk_open(&w, 12);
    w.problem->definition.rise = rises ? 0.17 : 0.0;
    ambulo__text_buffer text;
    ambulo__text_init(&text, NULL);
    assert_int_equal(ambulo__gait_svg(w.problem, w.result, NULL, &text), AMBULO_OK);
    const char *svg = ambulo__text_data(&text);
    int figures = occurrences(svg, "<g class=\"figure\">");
    assert_true(is_xml(svg));
    assert_int_equal(occurrences(svg, "<line class=\"ground\""), rises ? 0 : 1);
    assert_int_equal(occurrences(svg, "<path class=\"edge\""), rises ? figures : 0);
    assert_int_equal(occurrences(svg, "<path class=\"soil\""), rises ? figures : 0);
    ambulo__text_free(&text);
    walk_close(&w);
  }
}

/* each figure has its wall, all of them within the margins */
static void walls_stay_on_the_page(void **state) {
  (void)state;
  static const char mark[] = "<rect class=\"obstacle\" x=\"";
  static const char *const nearer[] = {"obstacles[wall].center=[0.8, 0, 0.9]"};
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_problem_load("models/push_wall.yaml", nearer, 1, NULL, NULL, &problem),
                   AMBULO_OK);
  assert_int_equal(ambulo__result_create(problem, NULL, &result), AMBULO_OK);
  const ambulo_model *model = ambulo_problem_model(problem); /* an arm stretched out to it */
  int count = ambulo_model_coordinate_count(model);
  int shoulder = ambulo_model_find_coordinate(model, "arm_flex_r");
  assert_true(shoulder >= 0);
  for (int i = shoulder; i < result->variables; i += count) result->x[i] = 1.57;
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  assert_int_equal(ambulo__gait_svg(problem, result, NULL, &text), AMBULO_OK);
  const char *svg = ambulo__text_data(&text);
  int walls = 0;
  double before = 0.0;
  for (const char *at = strstr(svg, mark); at; at = strstr(at + 1, mark), walls++) {
    double x = strtod(at + sizeof mark - 1, NULL);
    double width = strtod(strstr(at, "width=\"") + 7, NULL);
    if (x + width > 1160.0) print_error("a wall from %g to %g\n", x, x + width);
    assert_true(x >= 40.0 && x + width <= 1160.0);
    assert_true(walls == 0 || x > before);
    before = x + width;
  }
  assert_int_equal(walls, occurrences(svg, "<g class=\"figure\">"));
  assert_true(walls >= 7);
  ambulo__text_free(&text);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(walls_stay_on_the_page),
                                     cmocka_unit_test(test_walk),
                                     cmocka_unit_test(test_slope),
                                     cmocka_unit_test(test_stairs),

                                     cmocka_unit_test(test_not_finite),
                                     cmocka_unit_test(test_arm)};
  return cmocka_run_group_tests_name("picture/gait_svg", tests, NULL, NULL);
}
