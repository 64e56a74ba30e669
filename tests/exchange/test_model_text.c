/* OpenSim's angles back to the rotation they are of, and what becomes of drives. */
#include "exchange/export.h"

#include "ambulo/tools/export.h"
#include "base/diagnostics.h"
#include "import/rigid.h"
#include "model/model.h"
#include "support/import_case.h"
#include "support/messages.h"
#include "support/random_model.h"
#include "support/scratch.h"
#include "support/still_walker.h"
#include "support/test.h"

/* also where the middle angle is a right one, or nearly */
static void angles(void **state) {
  (void)state;
  static const double near[] = {0, 1e-17, 1e-15, 1e-13, 1e-10, 1e-8, 1e-5, 0.3};
  random_source source = {3};
  const double none[3] = {0, 0, 0};
  for (int i = 0; i < 2000; i++) {
    double given[3], found[3];
    for (int k = 0; k < 3; k++) given[k] = random_between(&source, -4, 4);
    int right = i % 4;
    if (right) given[1] = (right == 1 ? -1 : 1) * (acos(0) - near[(i / 4) % 8]);
    ambulo__rigid a = ambulo__rigid_of_xyz(none, given);
    ambulo__xyz_of_rotation((const double(*)[3])a.r, found);
    ambulo__rigid b = ambulo__rigid_of_xyz(none, found);
    for (int r = 0; r < 3; r++)
      for (int c = 0; c < 3; c++) assert_close(b.r[r][c], a.r[r][c], 2e-15);
    assert_true(fabs(found[1]) <= acos(0));
  }
}

/* the axes of three rows; 1: the last one stands for no coordinate */
static int read_rows(const char **text, double axis[3][3]) {
  const char *constant = NULL;
  for (int row = 0; row < 3; row++) {
    *text = strstr(*text, "<axis>") + strlen("<axis>");
    assert_int_equal(sscanf(*text, "%lf %lf %lf", &axis[row][0], &axis[row][1], &axis[row][2]), 3);
    constant = strstr(*text, "<Constant");
  }
  return constant && constant < strstr(*text, "</TransformAxis>");
}

/* OpenSim solves for turns about three axes: those that are made up keep away from the plane of
 * those that are given, as far as one of x, y, z can */
static void axes_that_are_made_up(void **state) {
  int checked = 0;
  for (uint64_t seed = 1; seed < 200; seed++) {
    random_tree *tree = malloc(sizeof *tree);
    ambulo_model *model = NULL;
    ambulo_export_options o = ambulo_export_options_default();
    const char *path = scratch_path(state, "m.osim");
    random_tree_make(tree, seed, 1 + (int)(seed % 9));
    if (seed % 3 == 0) random_tree_put_on_root(tree, seed);
    assert_int_equal(ambulo_model_create(&tree->definition, NULL, NULL, &model), AMBULO_OK);
    o.overwrite = 1;
    assert_int_equal(ambulo_export(model, NULL, path, &o, NULL, NULL), AMBULO_OK);
    char *text = read_whole(path);
    for (const char *at = strstr(text, "<SpatialTransform>"); at;
         at = strstr(at, "<SpatialTransform>")) {
      double a[3][3], n[3];
      for (int slides = 0; slides < 2; slides++) {
        if (!read_rows(&at, a)) continue;
        for (int i = 0; i < 3; i++) {
          int j = (i + 1) % 3, k = (i + 2) % 3;
          n[i] = a[0][j] * a[1][k] - a[0][k] * a[1][j];
        }
        double size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        double height = fabs(n[0] * a[2][0] + n[1] * a[2][1] + n[2] * a[2][2]);
        assert_true(height >= 0.57 * size); /* 1 / sqrt(3) */
        checked++;
      }
    }
    free(text);
    ambulo_model_free(model);
    free(tree);
  }
  assert_true(checked > 100);
}

/* a URDF has what brakes, but no rotors; OpenSim's bodies none of it */
static void drives(void **state) {
  skip_without_expat();
  const char *file = scratch_path(state, "m.urdf");
  ambulo_model *model = walker();
  ambulo_export_options o = ambulo_export_options_default();
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  o.format = AMBULO_EXPORT_URDF;
  o.overwrite = 1;
  ambulo_coordinate *knee =
      &model->coordinates[ambulo_model_find_coordinate(model, "knee_angle_r")];
  knee->armature = 0.25;
  knee->damping = 0.5;
  knee->friction = 2;
  assert_int_equal(ambulo_export(model, NULL, file, &o, NULL, list), AMBULO_OK);
  assert_message(list, 1, "armature of 1 coordinates is left out");
  import_case back = import_file(file, NULL);
  const ambulo_coordinate *c =
      ambulo_model_coordinate(back.model, ambulo_model_find_coordinate(back.model, "knee_angle_r"));
  assert_close(c->damping, 0.5, 0);
  assert_close(c->friction, 2, 0);
  assert_close(c->armature, 0, 0);
  import_shut(&back);
  ambulo__diagnostics_clear(list);
  o.format = AMBULO_EXPORT_OPENSIM;
  assert_int_equal(ambulo_export(model, NULL, file, &o, NULL, list), AMBULO_OK);
  assert_message(list, 0, "armature, damping and friction of 1 coordinates are left out");
  ambulo_diagnostics_free(list);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(drives, scratch_open, scratch_close),
      cmocka_unit_test(angles),
      cmocka_unit_test_setup_teardown(axes_that_are_made_up, scratch_open, scratch_close)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
