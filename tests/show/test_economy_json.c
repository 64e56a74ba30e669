/* "work" and "center_of_mass" of summary.json. */
#include "show/economy_json.h"
#include "people/stride_measures.h"
#include "support/fail_alloc.h"
#include "support/test.h"
#include "support/wellformed.h"

#include "ambulo/tools/tools.h"

#include <string.h>

/* {...} of a problem's point of zeros */
static void write(const char *file, ambulo__text_buffer *text) {
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  ambulo_allocator own = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo_problem_load(file, NULL, 0, NULL, NULL, &problem), AMBULO_OK);
  ambulo_options options = ambulo_problem_options(problem);
  options.maximum_iterations = 2;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  ambulo__text_init(text, &own);
  ambulo__json json = {.text = text};
  ambulo__json_open(&json, NULL, '{');
  assert_int_equal(ambulo__economy_json(&json, problem, result), AMBULO_OK);
  ambulo__json_close(&json, '}');
  assert_true(is_json(ambulo__text_data(text)));
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

static double number(const char *json, const char *key) {
  const char *at = strstr(json, key);
  assert_non_null(at);
  return strtod(at + strlen(key), NULL);
}

/* the numbers of one coordinate */
static void expect_of(const char *json, const char *name, const ambulo__economy *e, int i) {
  char key[64];
  (void)snprintf(key, sizeof key, "\"%s\": {", name);
  const char *at = strstr(json, key);
  assert_non_null(at);
  assert_close(number(at, "\"positive\": "), e->positive[i], 1e-9 * e->positive_sum);
  assert_close(number(at, "\"negative\": "), e->negative[i], 1e-9 * e->positive_sum);
}

/* as people/stride_measures.h has it by itself; nothing is left allocated */
static void the_numbers_are_the_economys(void **state) {
  (void)state;
  fail_alloc memory = fail_alloc_at(-1);
  ambulo_allocator counting = fail_alloc_hook(&memory);
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  ambulo__stride stride;
  ambulo__economy economy;
  ambulo__text_buffer text;
  assert_int_equal(ambulo_problem_load("models/walk_normal.yaml", NULL, 0, NULL, NULL, &problem),
                   AMBULO_OK);
  ambulo_options options = ambulo_problem_options(problem);
  options.maximum_iterations = 2;
  assert_int_equal(ambulo_solve(problem, &options, NULL, NULL, NULL, &result), AMBULO_OK);
  ambulo__text_init(&text, &counting);
  ambulo__json json = {.text = &text};
  assert_int_equal(ambulo__economy_json(&json, problem, result), AMBULO_OK);
  assert_int_equal(ambulo__stride_create(problem, ambulo_result_x(result), 1001, NULL, &stride),
                   AMBULO_OK);
  assert_int_equal(ambulo__economy_of(&stride, NULL, &economy), AMBULO_OK);
  const char *data = ambulo__text_data(&text);
  double way = economy.distance * problem->model->mass;
  assert_close(number(data, "\"rise\": "), economy.rise, 1e-9);
  assert_close(number(data, "\"sway\": "), economy.sway, 1e-9);
  assert_true(fabs(economy.rise - economy.sway) > 1e-6);
  assert_close(number(data, "\"negative\": "), economy.negative_sum, 1e-8 * economy.positive_sum);
  assert_close(number(data, "\"negative_per_kg_metre\": "), economy.negative_sum / way, 1e-8);
  for (int i = 0; i < stride.coordinates; i++)
    if (problem->model->coordinates[i].actuated)
      expect_of(data, problem->model->coordinates[i].name, &economy, i);
  ambulo__economy_free(&economy);
  ambulo__stride_free(&stride);
  ambulo__text_free(&text);
  assert_int_equal(memory.live, 0);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

static void a_walk_says_what_it_costs(void **state) {
  (void)state;
  ambulo__text_buffer text;
  write("models/walk_normal.yaml", &text);
  const char *json = ambulo__text_data(&text);
  double positive = number(json, "\"positive\": "), negative = number(json, "\"negative\": ");
  double distance = number(json, "\"distance\": ");
  assert_true(positive > 0.0 && negative < 0.0);
  assert_close(number(json, "\"metabolic\": "), positive / 0.25 - negative / 1.2, 1e-9 * positive);
  assert_close(number(json, "\"positive_per_kg_metre\": "), positive / (75.0 * distance),
               1e-9 * positive);
  assert_close(number(json, "\"metabolic_per_kg_metre\": ") * 75.0 * distance,
               number(json, "\"metabolic\": "), 1e-9 * positive);
  assert_non_null(strstr(json, "\"ankle_angle_r\": {"));
  assert_null(strstr(json, "pelvis_tilt"));
  assert_true(number(json, "\"rise\": ") > 0.0 && number(json, "\"sway\": ") > 0.0);
  ambulo__text_free(&text);
}

/* without ground reaction torques are not those of joints; standing there is no metre, nor where
 * feet stay and the centre of mass moves, as in lifting */
static void what_there_is_not_is_not_said(void **state) {
  (void)state;
  ambulo__text_buffer text;
  write("models/walk_without_reaction.yaml", &text);
  assert_null(strstr(ambulo__text_data(&text), "\"work\""));
  assert_non_null(strstr(ambulo__text_data(&text), "\"center_of_mass\": {"));
  ambulo__text_free(&text);
  write("models/stand_quietly.yaml", &text);
  assert_non_null(strstr(ambulo__text_data(&text), "\"work\": {"));
  assert_null(strstr(ambulo__text_data(&text), "per_kg_metre"));
  ambulo__text_free(&text);
  write("models/lift.yaml", &text);
  assert_true(number(ambulo__text_data(&text), "\"distance\": ") > 0.01);
  assert_null(strstr(ambulo__text_data(&text), "per_kg_metre"));
  ambulo__text_free(&text);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_walk_says_what_it_costs),
                                     cmocka_unit_test(the_numbers_are_the_economys),
                                     cmocka_unit_test(what_there_is_not_is_not_said)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
