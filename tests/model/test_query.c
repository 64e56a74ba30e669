#include "model/model.h"
#include "support/chain_definition.h"

static void by_index(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.definition.stature = 1.8;
  ambulo_model *model = chain_good(&c);
  assert_string_equal(ambulo_model_name(model), "model");
  assert_int_equal(ambulo_model_link_count(model), 3);
  assert_int_equal(ambulo_model_coordinate_count(model), 3);
  assert_int_equal(ambulo_model_point_count(model), 2);
  assert_int_equal(ambulo_model_foot_count(model), 1);
  assert_string_equal(ambulo_model_link(model, 2)->name, "c");
  assert_string_equal(ambulo_model_coordinate(model, 1)->name, "qb");
  assert_string_equal(ambulo_model_point(model, 0)->name, "heel");
  assert_string_equal(ambulo_model_foot(model, 0)->name, "foot");
  assert_close(ambulo_model_mass(model), 7, 0);
  assert_close(ambulo__model_weight(model), 7 * 9.81, 1e-12);
  assert_close(ambulo_model_stature(model), 1.8, 0);
  assert_close(ambulo__model_size(model), 1.8 / 1.75, 1e-15);
  assert_close(ambulo_model_gravity(model)[1], -9.81, 0);
  assert_close(ambulo_model_up(model)[1], 1, 0);
  assert_close(ambulo_model_forward(model)[0], 1, 0);
  assert_close(ambulo_model_left(model)[2], -1, 0);
  for (int index = -1; index <= 3; index += 4) {
    assert_null(ambulo_model_link(model, index));
    assert_null(ambulo_model_coordinate(model, index));
    assert_null(ambulo_model_point(model, index));
    assert_null(ambulo_model_foot(model, index));
  }
  ambulo_model_free(model);
}

static void by_name(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  ambulo_model *model = chain_good(&c);
  assert_int_equal(ambulo_model_find_link(model, "b"), 1);
  assert_int_equal(ambulo_model_find_coordinate(model, "qc"), 2);
  assert_int_equal(ambulo_model_find_point(model, "toe"), 1);
  assert_int_equal(ambulo_model_find_foot(model, "foot"), 0);
  assert_int_equal(ambulo_model_find_link(model, "qc"), -1);
  assert_int_equal(ambulo_model_find_coordinate(model, "Qc"), -1);
  assert_int_equal(ambulo_model_find_point(model, ""), -1);
  assert_int_equal(ambulo_model_find_foot(model, NULL), -1);
  ambulo_model_free(model);
}

static void of_nothing(void **state) {
  (void)state;
  assert_null(ambulo_model_name(NULL));
  assert_int_equal(ambulo_model_link_count(NULL), 0);
  assert_int_equal(ambulo_model_coordinate_count(NULL), 0);
  assert_int_equal(ambulo_model_point_count(NULL), 0);
  assert_int_equal(ambulo_model_foot_count(NULL), 0);
  assert_null(ambulo_model_link(NULL, 0));
  assert_int_equal(ambulo_model_find_link(NULL, "a"), -1);
  assert_close(ambulo_model_mass(NULL) + ambulo_model_stature(NULL), 0, 0);
  assert_null(ambulo_model_gravity(NULL));
  assert_null(ambulo_model_up(NULL));
  assert_null(ambulo_model_forward(NULL));
  assert_null(ambulo_model_left(NULL));
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(by_index), cmocka_unit_test(by_name),
                                     cmocka_unit_test(of_nothing)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
