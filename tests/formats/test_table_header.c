/* Lines above the column names: units, sizes, and whose motion it is. */
#include "formats/table_header.h"
#include "support/messages.h"

static ambulo__table_header take(const char *text, int number, int is_sto) {
  ambulo__table_header header = ambulo__table_header_default();
  ambulo__table_line line = {.start = text, .length = strlen(text), .number = number};
  assert_int_equal(ambulo__table_header_take(&line, is_sto, "f", NULL, &header), AMBULO_OK);
  return header;
}

static void the_unit_of_angles(void **state) {
  (void)state;
  static const struct {
    const char *line;
    int is_sto, degrees, stated;
  } lines[] = {{"inDegrees=yes", 1, 1, 1},
               {" indegrees = No ", 1, 0, 1},
               {"# inDegrees=yes", 0, 1, 1},
               {"inDegrees=yes", 0, 0, 0},
               {"Angles are in degrees.", 1, 1, 1},
               {"angles  are in\tdegrees", 1, 1, 1},
               {"Angles are in radians.", 1, 0, 1},
               {"Angles are in a file", 1, 0, 0},
               {"Angles are", 1, 0, 0},
               {"# Angles are in degrees.", 0, 0, 0},
               {"", 1, 0, 0},
               {"", 0, 0, 0}};
  for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
    ambulo__table_header header = take(lines[i].line, 2, lines[i].is_sto);
    if (header.in_degrees != lines[i].degrees || header.unit_stated != lines[i].stated)
      print_error("line '%s'\n", lines[i].line);
    assert_int_equal(header.in_degrees, lines[i].degrees);
    assert_int_equal(header.unit_stated, lines[i].stated);
  }
}

/* OpenSim writes both; the key decides */
static void the_key_goes_before_the_sentence(void **state) {
  (void)state;
  ambulo__table_header header = ambulo__table_header_default();
  static const char *const texts[] = {"inDegrees=no", "Angles are in degrees."};
  for (int i = 0; i < 4; i++) {
    const char *text = texts[i % 2];
    ambulo__table_line line = {.start = text, .length = strlen(text), .number = i + 1};
    assert_int_equal(ambulo__table_header_take(&line, 1, "f", NULL, &header), AMBULO_OK);
  }
  assert_int_equal(header.in_degrees, 0);
}

static void sizes_of_the_table(void **state) {
  (void)state;
  assert_int_equal(take("nRows=7", 1, 1).declared_rows, 7);
  assert_int_equal(take("datarows = 8", 1, 1).declared_rows, 8);
  assert_int_equal(take("nColumns=9", 1, 1).declared_columns, 9);
  assert_int_equal(take("# nRows=7", 1, 0).declared_rows, -1);
  assert_int_equal(take("datarows 8", 1, 1).declared_rows, 8); /* SIMM */
  assert_int_equal(take("datacolumns\t9 ", 1, 1).declared_columns, 9);
  assert_int_equal(take("datarows 8 of 9", 1, 1).declared_rows, -1);
  assert_int_equal(take("name datarows", 1, 1).declared_rows, -1);
  assert_int_equal(take("version=1", 2, 1).has_version, 1);
  assert_int_equal(take("# version=1", 2, 0).has_version, 0);
  ambulo__table_header header = ambulo__table_header_default();
  ambulo__table_line line = {.start = "nRows=x", .length = 7, .number = 3};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__table_header_take(&line, 1, "f.sto", list, &header), AMBULO_E_SCHEMA);
  assert_message(list, 0, "f.sto:3:7: error[E_SCHEMA]: not a count (got 'x')");
  ambulo_diagnostics_free(list);
}

static void whose_motion_it_is(void **state) {
  (void)state;
  static const char text[] = "# ambulo motion: mass 72.5 kg, gravity 0.5 -9.75 0 m/s^2; SI units";
  ambulo__table_header header = take(text, 1, 0);
  assert_close(header.body_mass, 72.5, 0.0);
  assert_close(header.gravity[0], 0.5, 0.0);
  assert_close(header.gravity[1], -9.75, 0.0);
  assert_true(isnan(take(text, 2, 0).body_mass));
  assert_true(isnan(take(text, 1, 1).body_mass));
  assert_true(isnan(take("# ambulo motion: mass x kg, gravity 0 0 0 m", 1, 0).body_mass));
  assert_true(isnan(take("# ambulo motion: mass 70 kg, gravity 0", 1, 0).body_mass));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(the_unit_of_angles), cmocka_unit_test(the_key_goes_before_the_sentence),
      cmocka_unit_test(sizes_of_the_table), cmocka_unit_test(whose_motion_it_is)};
  return cmocka_run_group_tests_name("format/table_header", tests, NULL, NULL);
}
