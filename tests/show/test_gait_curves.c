/* gait.svg of a grounded walk: two more panels, one curve a foot in each. */
#include "solver/result.h"
#include "ambulo/tools/load.h"
#include "show/gait_svg.h"
#include "support/test.h"
#include "support/wellformed.h"

static void panels_of_ground_reaction(void **state) {
  (void)state;
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  assert_int_equal(
      ambulo_problem_load("tests/support/walk_rigid.yaml", NULL, 0, NULL, NULL, &problem),
      AMBULO_OK);
  assert_int_equal(ambulo__result_create(problem, NULL, &result), AMBULO_OK);
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  assert_int_equal(ambulo__gait_svg(problem, result, NULL, &text), AMBULO_OK);
  const char *svg = ambulo__text_data(&text);
  assert_true(is_xml(svg));
  assert_non_null(strstr(svg, "Ground reaction upward, body weights"));
  assert_non_null(strstr(svg, "Ground reaction forward, body weights"));
  assert_int_equal(occurrences(svg, "<path class=\"left curve\""), 6 + 2);
  assert_int_equal(occurrences(svg, "<path class=\"right curve\""), 6 + 2);
  ambulo__text_free(&text);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(panels_of_ground_reaction)};
  return cmocka_run_group_tests_name("picture/gait_forces", tests, NULL, NULL);
}
