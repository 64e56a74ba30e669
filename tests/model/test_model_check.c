#include "model/check.h"
#include "support/chain_definition.h"

static void arguments(void **state) {
  (void)state;
  chain c;
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_create(NULL, NULL, NULL, &model), AMBULO_E_ARGUMENT);
  chain_make(&c);
  assert_int_equal(ambulo_model_create(&c.definition, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  c.definition.size = 0;
  chain_bad(&c, AMBULO_E_ARGUMENT, NULL);
  chain_make(&c);
  c.definition.links = NULL;
  chain_bad(&c, AMBULO_E_ARGUMENT, NULL);
  chain_make(&c);
  c.definition.point_count = -1;
  chain_bad(&c, AMBULO_E_ARGUMENT, NULL);
  assert_null(model);
}

/* a billion links are refused before anything is read or allocated */
static void sizes(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.definition.link_count = 1000000000;
  chain_bad(&c, AMBULO_E_LIMIT, "too many links (got 1000000000); expected at most 4096");
  chain_make(&c);
  c.definition.point_count = 5000;
  chain_bad(&c, AMBULO_E_LIMIT, "too many points");
  chain_make(&c);
  c.definition.foot_count = 65;
  chain_bad(&c, AMBULO_E_LIMIT, "too many feet");
  chain_make(&c);
  c.definition.link_count = 0;
  chain_bad(&c, AMBULO_E_MODEL, "the model cannot move");
  chain_make(&c);
  c.definition.coordinate_count = 2;
  chain_bad(&c, AMBULO_E_MODEL, "(got 2 coordinates for 3 such links)");
  chain_make(&c);
  c.links[1].type = AMBULO_JOINT_TYPE_NOT_SET;
  chain_bad(&c, AMBULO_E_MODEL, "not set (got 0); expected");
}

static void names(void **state) {
  (void)state;
  static const char *const bad[] = {"", "a/b", "a\nb", "\x1b[31m", "a b", "\xc3\xa4"};
  chain c;
  for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
    chain_make(&c);
    c.links[1].name = bad[i];
    chain_bad(&c, AMBULO_E_MODEL, "link name is not allowed");
  }
  chain_make(&c);
  c.coordinates[0].name = NULL;
  chain_bad(&c, AMBULO_E_MODEL, "coordinate name is not allowed");
  char text[80] = "";
  memset(text, 'x', 65);
  chain_make(&c);
  c.points[0].name = text;
  chain_bad(&c, AMBULO_E_MODEL, "point name is not allowed");
  text[64] = '\0';
  ambulo_model_free(chain_good(&c));
  c.definition.name = "a title with spaces";
  ambulo_model_free(chain_good(&c));
  c.definition.name = "";
  chain_bad(&c, AMBULO_E_MODEL, "model name is not allowed");
  c.definition.name = "two\nlines";
  chain_bad(&c, AMBULO_E_MODEL, "model name is not allowed");
}

static void duplicates(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.links[2].name = "a";
  chain_bad(&c, AMBULO_E_MODEL, "two links are named 'a'; expected different names");
  chain_make(&c);
  c.coordinates[1].name = "qa";
  chain_bad(&c, AMBULO_E_MODEL, "two coordinates are named 'qa'");
  chain_make(&c);
  c.points[1].name = "heel";
  chain_bad(&c, AMBULO_E_MODEL, "two points are named 'heel'");
  chain_make(&c);
  c.definition.foot_count = 2;
  c.feet[1].name = "foot";
  chain_bad(&c, AMBULO_E_MODEL, "two feet are named 'foot'");
}

static void world(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.definition.gravity[1] = 0;
  chain_bad(&c, AMBULO_E_MODEL, "gravity must be finite and not zero");
  c.definition.gravity[1] = NAN;
  chain_bad(&c, AMBULO_E_MODEL, "(got [0, nan, 0])");
  chain_make(&c);
  c.definition.forward[0] = 0;
  chain_bad(&c, AMBULO_E_MODEL, "`forward` must not be zero or vertical (got [0, 0, 0])");
  c.definition.forward[1] = 3;
  chain_bad(&c, AMBULO_E_MODEL, "must not be zero or vertical (got [0, 3, 0])");
  chain_make(&c);
  c.definition.stature = -1;
  chain_bad(&c, AMBULO_E_MODEL, "stature is out of range (got -1)");
}

/* one run finds them all */
static void all_faults_at_once(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.links[0].mass = -1;
  c.links[1].a = NAN;
  c.coordinates[2].range[0] = INFINITY;
  c.definition.gravity[1] = 0;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__model_check(&c.definition, NULL, list), AMBULO_E_MODEL);
  assert_int_equal(ambulo_diagnostics_error_count(list), 4);
  ambulo_diagnostics_free(list);
}

/* numbers that are not finite, or whose products overflow, in every place that holds one; no limit
 * is what an infinite one means */
static void absurd_numbers(void **state) {
  (void)state;
  static const double absurd[] = {NAN, 1e308, -1e308, INFINITY, -INFINITY};
  chain c;
  chain_make(&c);
  ambulo_link *link = &c.links[1];
  ambulo_coordinate *coordinate = &c.coordinates[1];
  double *const numbers[] = {&link->theta,
                             &link->d,
                             &link->a,
                             &link->alpha,
                             &link->mass,
                             &link->com[2],
                             &link->inertia[0],
                             &link->inertia[5],
                             &c.points[1].position[1],
                             &c.definition.gravity[1],
                             &c.definition.forward[0],
                             &c.definition.stature,
                             &coordinate->range[0],
                             &coordinate->range[1],
                             &coordinate->speed[0],
                             &coordinate->speed[1],
                             &coordinate->torque[0],
                             &coordinate->torque[1]};
  const size_t limits = 12;
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
    size_t first = numbers[i] == &c.definition.stature; /* of which NaN is unknown */
    for (size_t k = first; k < (i < limits ? 5 : 3); k++) {
      double kept = *numbers[i];
      ambulo_model *model = NULL;
      *numbers[i] = absurd[k];
      ambulo_status status = ambulo_model_create(&c.definition, NULL, NULL, &model);
      if (status != AMBULO_E_MODEL) print_error("number %zu as %g passes\n", i, absurd[k]);
      assert_int_equal(status, AMBULO_E_MODEL);
      *numbers[i] = kept;
    }
  }
  ambulo_model_free(chain_good(&c));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(arguments),     cmocka_unit_test(sizes),
      cmocka_unit_test(names),         cmocka_unit_test(duplicates),
      cmocka_unit_test(world),         cmocka_unit_test(all_faults_at_once),
      cmocka_unit_test(absurd_numbers)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
