/* What feet and patches got, in summary.json. */
#include "show/reaction_json.h"
#include "support/patched_walker.h"
#include "support/wellformed.h"

#include "ambulo/ambulo.h"

static ambulo_problem *stand(const ambulo_model *model, ambulo_reaction_kind kind) {
  static const ambulo_contact contacts[] = {
      {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {-0.05, -0.09}},
      {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {-0.05, 0.09}},
      OF_PATCH(HAND_R, 0.2, 0.8, {0.4, -0.25, 1.22})};
  ambulo_problem_definition d = ambulo_problem_definition_default();
  ambulo_problem *problem = NULL;
  d.model = model;
  d.contacts = contacts;
  d.contact_count = 3;
  d.intervals = 8;
  d.contact_tolerance = 0.002;
  d.ground_reaction.kind = kind;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &problem), AMBULO_OK);
  return problem;
}

/* {"ground_reaction": ...} of the point of zeros */
static ambulo_status write(const ambulo_problem *problem, const ambulo_allocator *allocator,
                           ambulo__text_buffer *text) {
  ambulo_options options = ambulo_problem_options(problem);
  double *zero = calloc((size_t)ambulo_problem_variable_count(problem), sizeof *zero);
  ambulo_result *result = NULL;
  assert_int_equal(ambulo_audit_point(problem, &options, zero, NULL, NULL, &result), AMBULO_OK);
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo__text_init(text, &own);
  ambulo__json json = {.text = text};
  ambulo__json_open(&json, NULL, '{');
  ambulo_status status = ambulo__reaction_json(&json, problem, result);
  ambulo__json_close(&json, '}');
  if (!status) status = ambulo__text_status(text);
  ambulo_result_free(result);
  free(zero);
  return status;
}

static void patches_in_contact_stand_beside_feet(void **state) {
  (void)state;
  ambulo_model *model = patched_walker(0);
  ambulo_problem *problem = stand(model, AMBULO_REACTION_SHARED);
  ambulo__text_buffer text;
  assert_int_equal(write(problem, NULL, &text), AMBULO_OK);
  const char *json = ambulo__text_data(&text);
  assert_true(is_json(json));
  static const char *const there[] = {"\"right\": {",          "\"left\": {",      "\"hand_r\": {",
                                      "\"impulse_forward\": ", "\"impulse_up\": ", "\"peak\": "};
  for (size_t i = 0; i < sizeof there / sizeof *there; i++) assert_non_null(strstr(json, there[i]));
  assert_null(strstr(json, "hand_l"));
  assert_null(strstr(json, "seat"));
  ambulo__text_free(&text);
  ambulo_problem_free(problem);
  problem = stand(model, AMBULO_REACTION_NONE);
  assert_int_equal(write(problem, NULL, &text), AMBULO_OK);
  assert_null(strstr(ambulo__text_data(&text), "ground_reaction"));
  ambulo__text_free(&text);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(patches_in_contact_stand_beside_feet)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
