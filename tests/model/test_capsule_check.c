/* Capsules of a definition: links, sizes, names and mirror pairs. */
#include "support/find_capsule.h"
#include "support/chain_definition.h"

static void capsules(void **state) {
  (void)state;
  static const struct {
    ambulo_capsule capsule;
    const char *said;
  } bad[] = {
      {{"arm", 3, {0}, {0}, 0.1, -1},
       "link of capsule 'arm' does not exist (got index 3); expected 0 to 2"},
      {{"arm", -1, {0}, {0}, 0.1, -1}, "link of capsule 'arm' does not exist (got index -1)"},
      {{"arm", 0, {0}, {0}, 0.0, -1},
       "radius of capsule 'arm' is out of range (got 0 m); expected more than 0, at most 10 m"},
      {{"arm", 0, {0}, {0}, NAN, -1}, "radius of capsule 'arm' is out of range"},
      {{"arm", 0, {0}, {0.0, 0.0, INFINITY}, 0.1, -1}, "'to' of capsule 'arm' is out of range"},
      {{"arm", 0, {NAN}, {0}, 0.1, -1}, "'from' of capsule 'arm' is out of range"},
      {{"other", 0, {0}, {0}, 0.1, -1}, "two capsules are named 'other'"},
      {{"a b", 0, {0}, {0}, 0.1, -1}, "capsule name is not allowed (got 'a b')"},
      {{"arm", 0, {0}, {0}, 0.1, 2}, "mirror image of capsule 'arm' does not exist (got index 2)"},
      {{"arm", 0, {0}, {0}, 0.1, 1},
       "mirror image of capsule 'arm' has another mirror image itself; expected a pair"},
  };
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    chain c;
    chain_make(&c);
    ambulo_capsule two[] = {bad[i].capsule, {"other", 1, {0}, {0}, 0.1, -1}};
    c.definition.capsules = two;
    c.definition.capsule_count = 2;
    chain_bad(&c, AMBULO_E_MODEL, bad[i].said);
  }
}

static void a_model_keeps_its_capsules(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  ambulo_capsule two[] = {{"a", 2, {0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}, 0.1, 1},
                          {"b", 1, {0}, {0}, 0.2, 0}};
  c.definition.capsules = two;
  c.definition.capsule_count = 2;
  ambulo_model *m = chain_good(&c);
  const ambulo_capsule *a = ambulo_model_capsule(m, 0);
  assert_int_equal(ambulo_model_capsule_count(m), 2);
  assert_string_equal(a->name, "a");
  assert_int_equal(a->link, 2);
  assert_close(a->to[1], 0.5, 0.0);
  assert_int_equal(a->mirror, 1);
  assert_int_equal(find_capsule(m, "b"), 1);
  assert_int_equal(find_capsule(m, "c"), -1);
  assert_null(ambulo_model_capsule(m, 2));
  ambulo_conditions conditions = ambulo_conditions_default();
  ambulo_model *adapted = NULL;
  conditions.slope = 0.1;
  assert_int_equal(ambulo_model_adapt(m, &conditions, NULL, NULL, &adapted), AMBULO_OK);
  assert_close(ambulo_model_capsule(adapted, 1)->radius, 0.2, 0.0);
  ambulo_model_free(adapted);
  ambulo_model_free(m);
  c.definition.capsule_count = -1;
  m = NULL;
  assert_int_equal(ambulo_model_create(&c.definition, NULL, NULL, &m), AMBULO_E_ARGUMENT);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(capsules),
                                     cmocka_unit_test(a_model_keeps_its_capsules)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
