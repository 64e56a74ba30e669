/* Column maps: the built-in ones, a file, its faults. */
#include "people/compare.h"
#include "support/messages.h"
#include "support/scratch.h"

static const ambulo__map_entry *entry(const ambulo__map *map, const char *curve) {
  for (int i = 0; i < map->count; i++) {
    if (strcmp(map->entries[i].curve, curve) == 0) return &map->entries[i];
  }
  print_error("no curve %s\n", curve);
  fail();
  return NULL;
}

static void built_in_signs(void **state) {
  (void)state;
  ambulo__map map;
  assert_int_equal(ambulo__map_default(AMBULO__LAYOUT_QUANTITY, NULL, &map), AMBULO_OK);
  assert_int_equal(map.count, 15);
  assert_close(entry(&map, "hip_extension_moment")->factor, -1.0, 0.0);
  assert_close(entry(&map, "ankle_plantarflexion_moment")->factor, -1.0, 0.0);
  assert_int_equal(entry(&map, "hip_flexion")->tilted, 1);
  assert_int_equal(entry(&map, "pelvis_up_obliquity")->opposite, 1);
  ambulo__map_free(&map);
  assert_int_equal(ambulo__map_default(AMBULO__LAYOUT_WIDE, NULL, &map), AMBULO_OK);
  assert_int_equal(entry(&map, "hip_flexion")->tilted, 0);
  assert_string_equal(entry(&map, "grf_forward")->result, "grf.{foot}.forward");
  assert_string_equal(ambulo__curve_unit_name(entry(&map, "grf_forward")->unit), "N/kg");
  ambulo__map_free(&map);
}

/* of a curve with two lines the one by its own name, else the first */
static void the_line_of_a_curve(void **state) {
  (void)state;
  ambulo__map map;
  assert_int_equal(ambulo__map_default(AMBULO__LAYOUT_WIDE, NULL, &map), AMBULO_OK);
  const ambulo__map_entry *found = ambulo__map_find(&map, "hip_flexion");
  assert_string_equal(found->reference, "hip_flexion");
  assert_int_equal(found->tilted, 1);
  assert_null(ambulo__map_find(&map, "hip flexion"));
  for (int i = 0; i < map.count; i++) memcpy(map.entries[i].reference, "x", 2);
  found = ambulo__map_find(&map, "hip_flexion");
  assert_int_equal(found - map.entries, 0);
  ambulo__map_free(&map);
}

static void from_a_file(void **state) {
  const char *path = scratch_path(state, "map.csv");
  ambulo__map map;
  scratch_write(path, "unit,curve,reference,result,factor,right_factor,tilted\n"
                      "deg,knee,knee angle,q.knee_{side},-1,,\n"
                      "N m/kg,turn,a/b,tau.x,2,-2,1\n");
  assert_int_equal(ambulo__map_read(path, NULL, NULL, &map), AMBULO_OK);
  assert_int_equal(map.count, 2);
  assert_close(map.entries[0].factor, -1.0, 0.0);
  assert_int_equal(map.entries[0].opposite, 0);
  assert_int_equal(map.entries[1].opposite, 1);
  assert_int_equal(map.entries[1].tilted, 1);
  assert_int_equal(map.entries[1].unit, AMBULO__UNIT_MOMENT);
  assert_string_equal(map.entries[1].reference, "a/b");
  ambulo__map_free(&map);
}

static void faults(void **state) {
  static const char *const cases[][2] = {
      {"curve,reference,unit\na,b,deg\n", "map.csv:1:1: error[E_SCHEMA]: no column 'result'"},
      {"curve,reference,result,unit\na,b,c,mm\n", "map.csv:2:7: error[E_SCHEMA]: unknown unit"},
      {"curve,reference,result,unit\n,b,c,deg\n", "map.csv:2:1: error[E_SCHEMA]: the curve's name"},
      {"curve,reference,result,unit,factor\na,b,c,deg,x\n",
       "map.csv:2:11: error[E_SCHEMA]: factor"},
      {"curve,reference,result,unit,tilted\na,b,c,deg,2\n", "expected plus or minus the factor"}};
  const char *path = scratch_path(state, "map.csv");
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    ambulo__map map;
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    scratch_write(path, cases[i][0]);
    assert_int_equal(ambulo__map_read(path, NULL, list, &map), AMBULO_E_SCHEMA);
    assert_message(list, 0, cases[i][1]);
    ambulo_diagnostics_free(list);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(built_in_signs), cmocka_unit_test(the_line_of_a_curve),
      cmocka_unit_test_setup_teardown(from_a_file, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(faults, scratch_open, scratch_close)};
  return cmocka_run_group_tests_name("compare/compare_map", tests, NULL, NULL);
}
