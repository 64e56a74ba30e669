#include "support/chain_definition.h"

static void intervals(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.coordinates[1].range[0] = 2;
  c.coordinates[1].range[1] = -0.5;
  chain_bad(&c, AMBULO_E_MODEL,
            "range limits of coordinate 'qb' contradict each other (got [2, -0.5], in degrees "
            "[114.592, -28.6479])");
  c.coordinates[1].range[1] = NAN;
  chain_bad(&c, AMBULO_E_MODEL, "(got [2, nan])");
  c.coordinates[1].range[1] = 2; /* one value: a fixed coordinate, legal */
  ambulo_model_free(chain_good(&c));
  c.coordinates[2].speed[0] = INFINITY;
  chain_bad(&c, AMBULO_E_MODEL, "speed limits of coordinate 'qc'");
  chain_make(&c);
  c.coordinates[0].torque[1] = -INFINITY;
  chain_bad(&c, AMBULO_E_MODEL, "torque limits of coordinate 'qa'");
}

static void mirror_pairs(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.coordinates[0].mirror = 1;
  chain_bad(&c, AMBULO_E_MODEL, "mirror image of coordinate 'qa' has another mirror image");
  c.coordinates[1].mirror = 0;
  ambulo_model_free(chain_good(&c));
  chain_make(&c);
  c.coordinates[2].mirror_sign = 0.5;
  chain_bad(&c, AMBULO_E_MODEL, "of coordinate 'qc' has a sign that is neither +1 nor -1");
  c.coordinates[2].mirror_sign = 1;
  c.coordinates[2].mirror = 3;
  chain_bad(&c, AMBULO_E_MODEL, "of coordinate 'qc' does not exist");
}

static void unlike_pairs(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.coordinates[0].mirror = 1;
  c.coordinates[1].mirror = 0;
  c.links[1].type = AMBULO_PRISMATIC;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_create(&c.definition, NULL, list, &model), AMBULO_E_MODEL);
  assert_message(list, 0, "mirror image of coordinate 'qa' is of another kind");
  assert_message(list, 1, "mirror image of coordinate 'qb' is of another kind");
  ambulo_diagnostics_clear(list);
  c.links[1].type = AMBULO_REVOLUTE;
  c.coordinates[1].mirror_sign = -1;
  assert_int_equal(ambulo_model_create(&c.definition, NULL, list, &model), AMBULO_E_MODEL);
  assert_message(list, 0, "mirror image of coordinate 'qa' has another sign");
  ambulo_diagnostics_free(list);
}

static void points(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.points[1].link = 3;
  chain_bad(&c, AMBULO_E_MODEL,
            "link of point 'toe' does not exist (got index 3); expected 0 to 2");
  chain_make(&c);
  c.points[0].position[2] = NAN;
  chain_bad(&c, AMBULO_E_MODEL, "position of point 'heel' is out of range");
}

static void feet(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.feet[0].heel[0] = -1;
  chain_bad(&c, AMBULO_E_MODEL, "foot 'foot' refers to points that do not exist");
  chain_make(&c);
  c.feet[0].toe_center = 2;
  chain_bad(&c, AMBULO_E_MODEL, "refers to points that do not exist");
  chain_make(&c);
  c.feet[0].toe[1] = 0;
  chain_bad(&c, AMBULO_E_MODEL, "foot 'foot' has two corners at one end and one at the other");
  chain_make(&c);
  c.feet[0].toe[0] = 0;
  chain_bad(&c, AMBULO_E_MODEL, "foot 'foot' uses one point twice");
  chain_make(&c);
  c.feet[0].toe_center = 0;
  chain_bad(&c, AMBULO_E_MODEL, "uses one point twice");
  chain_make(&c);
  c.feet[0].mirror = 1;
  chain_bad(&c, AMBULO_E_MODEL, "mirror image of foot 'foot' does not exist (got index 1)");
  c.definition.foot_count = 2;
  chain_bad(&c, AMBULO_E_MODEL, "mirror image of foot 'foot' has another mirror image itself");
  c.feet[1].mirror = 0;
  ambulo_model_free(chain_good(&c));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(intervals), cmocka_unit_test(mirror_pairs),
                                     cmocka_unit_test(unlike_pairs), cmocka_unit_test(points),
                                     cmocka_unit_test(feet)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
