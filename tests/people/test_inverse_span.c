/* Parts of a motion: what is asked for, and what forces cover. */
#include "ambulo/tools/load.h"
#include "support/inverse_table.h"
#include "support/scratch.h"

#include <math.h>

static ambulo_model *pendulum(void) {
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/pendulum.yaml", NULL, NULL, NULL, &model), AMBULO_OK);
  return model;
}

/* a swing of 41 rows, 1 s to 5 s, whose rates are a spline's */
static const char *swing(void **state) {
  const char *path = scratch_path(state, "swing.csv");
  FILE *f = fopen(path, "w");
  assert_non_null(f);
  fprintf(f, "time,swing\n");
  for (int k = 0; k <= 40; k++) fprintf(f, "%.10g,%.17g\n", 1.0 + 0.1 * k, sin(0.7 * k));
  assert_int_equal(fclose(f), 0);
  return path;
}

/* rows of a part have what they have in the whole */
static void parts_are_rows_of_the_whole(void **state) {
  ambulo_model *model = pendulum();
  const char *path = swing(state);
  ambulo__motion *whole = inverse_of(model, path, NULL, NULL, AMBULO_OK);
  static const struct {
    double from, to;
    int first, rows;
  } cases[] = {
      {2.0, 3.0, 10, 11}, {AMBULO_OFF, 1.25, 0, 3}, {4.95, AMBULO_OFF, 40, 1}, {-1.0, 9.0, 0, 41}};
  for (int i = 0; i < 4; i++) {
    ambulo_inverse_options options = ambulo_inverse_options_default();
    options.from = cases[i].from;
    options.to = cases[i].to;
    ambulo__motion *part = inverse_of(model, path, &options, NULL, AMBULO_OK);
    assert_int_equal(part->rows, cases[i].rows);
    for (int k = 0; k < part->rows; k++) {
      int own = cases[i].first + k;
      assert_close(part->time[k], whole->time[own], 0.0);
      assert_close(table_cell(part, k, "tau.swing"), table_cell(whole, own, "tau.swing"), 0.0);
      assert_close(table_cell(part, k, "qdd.swing"), table_cell(whole, own, "qdd.swing"), 0.0);
    }
    ambulo__motion_free(part);
  }
  ambulo__motion_free(whole);
  ambulo_model_free(model);
}

static void no_rows_are_an_error(void **state) {
  ambulo_model *model = pendulum();
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_inverse_options options = ambulo_inverse_options_default();
  options.from = 6.0;
  assert_null(inverse_of(model, swing(state), &options, list, AMBULO_E_SCHEMA));
  assert_message(list, 0, "no rows from 6 to 5 s; the motion lasts from 1 to 5 s");
  options.to = 5.5;
  assert_null(inverse_of(model, swing(state), &options, NULL, AMBULO_E_ARGUMENT));
  ambulo_diagnostics_free(list);
  ambulo_model_free(model);
}

/* 0.1 to 0.9 s of 0 to 1 s; nothing where they have too little in common */
static void forces_leave_the_rows_they_cover(void **state) {
  static const struct {
    double begin, end;
    int rows; /* 0: refused */
  } cases[] = {{0.1, 0.9, 9}, {-1.0, 0.55, 6}, {0.0, 1.0, 11}, {0.95, 3.0, 0}, {2.0, 3.0, 0}};
  ambulo_model *model = NULL;
  const char *path = scratch_path(state, "stand.csv");
  assert_int_equal(ambulo_model_load("models/opensim_2d_gait10.yaml", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  FILE *f = fopen(path, "w");
  assert_non_null(f);
  fprintf(f, "time,pelvis_ty\n");
  for (int k = 0; k <= 10; k++) fprintf(f, "%.10g,0.9\n", 0.1 * k);
  assert_int_equal(fclose(f), 0);
  for (int i = 0; i < 5; i++) {
    char text[256];
    const char *forces = scratch_path(state, "forces.csv");
    (void)snprintf(text, sizeof text,
                   "time,ground_force_r_vy,ground_force_l_vy\n%g,300,300\n%g,300,300\n",
                   cases[i].begin, cases[i].end);
    scratch_write(forces, text);
    ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
    ambulo_inverse_options options = ambulo_inverse_options_default();
    options.forces = forces;
    ambulo__motion *part =
        inverse_of(model, path, &options, list, cases[i].rows ? AMBULO_OK : AMBULO_E_SCHEMA);
    if (part) assert_int_equal(part->rows, cases[i].rows);
    if (part) assert_close(part->time[0], fmax(cases[i].begin, 0.0), 1e-12);
    int told = 0;
    for (size_t m = 0; m < ambulo_diagnostics_count(list); m++)
      told |= strstr(ambulo_diagnostics_get(list, m)->message, "are used") != NULL;
    assert_int_equal(told, cases[i].rows > 0 && cases[i].rows < 11);
    ambulo__motion_free(part);
    ambulo_diagnostics_free(list);
  }
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(parts_are_rows_of_the_whole, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(no_rows_are_an_error, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(forces_leave_the_rows_they_cover, scratch_open,
                                      scratch_close),
  };
  return cmocka_run_group_tests_name("people/inverse_span", tests, NULL, NULL);
}
