/* Motions for OpenSim's tools: motion.mot, grf.mot and external_loads.xml in a folder. */
#include "ambulo/tools/export.h"
#include "support/messages.h"
#include "support/scratch.h"
#include "support/still_walker.h"

static double cell(const char *text, const char *column, int row) {
  const char *head = strstr(text, "endheader\n") + 10, *at = head;
  int index = 0;
  for (; strncmp(at, column, strlen(column)) != 0 || !strchr("\t\n", at[strlen(column)]); index++) {
    at = strpbrk(at, "\t\n");
    assert_non_null(at);
    assert_true(*at++ == '\t');
  }
  for (at = head; row >= 0; row--) at = strchr(at, '\n') + 1;
  for (; index > 0; index--) at = strchr(at, '\t') + 1;
  return strtod(at, NULL);
}

static char *folder_text(const char *folder, const char *name) {
  char path[600];
  (void)snprintf(path, sizeof path, "%s/%s", folder, name);
  return read_whole(path);
}

static void a_folder_for_opensim(void **state) {
  ambulo_model *model = walker();
  const char *motion = scratch_path(state, "m.csv"), *folder = scratch_path(state, "out");
  scratch_write(motion, motion_text);
  assert_int_equal(ambulo_export(model, motion, folder, NULL, NULL, NULL), AMBULO_OK);
  assert_int_equal(entries_in(folder), 4);
  char *mot = folder_text(folder, "motion.mot"), *grf = folder_text(folder, "grf.mot"),
       *loads = folder_text(folder, "external_loads.xml");
  assert_non_null(strstr(mot, "inDegrees=yes\n"));
  assert_close(cell(mot, "knee_angle_r", 1), 0.5 * 180 / acos(-1), 1e-13);
  assert_close(cell(mot, "pelvis_ty", 1), 0.1 + 0.534643 * 1.75, 1e-12);
  assert_close(cell(grf, "ground_force_right_vy", 3), 700, 1e-12);
  assert_close(cell(grf, "ground_force_right_px", 4), 0.2, 1e-12);
  assert_close(cell(grf, "ground_force_right_px", 1), 0.1, 1e-12); /* in the air: the next one */
  assert_close(cell(grf, "ground_torque_right_y", 3), 3, 1e-12);
  assert_close(cell(grf, "ground_force_left_px", 3), 0, 0); /* never down */
  assert_non_null(strstr(loads, "<applied_to_body>foot_r</applied_to_body>"));
  assert_non_null(strstr(loads, "<torque_identifier>ground_torque_right_</torque_identifier>"));
  free(mot);
  free(grf);
  free(loads);
  ambulo_model_free(model);
}

/* what a force without a place turns, 5 N m about z, stands beside a place that it borrows */
static void a_moment_without_a_place(void **state) {
  ambulo_model *model = walker();
  const char *motion = scratch_path(state, "m.csv"), *folder = scratch_path(state, "out");
  scratch_write(motion,
                "time,q.pelvis_ty,grf.right.x,grf.right.y,grf.right.z,cop.right.x,cop.right.y,"
                "cop.right.z,free_moment.right,moment.right.x,moment.right.y,moment.right.z,"
                "grf.left.y\n"
                "0,0.1,8,-0.1,0,nan,nan,nan,0,0,0,5,0\n0.1,0.1,10,700,0,0.1,0,0,0,0,0,70,0\n"
                "0.2,0.1,10,700,0,0.2,0,0,0,0,0,140,0\n0.3,0.1,10,700,0,0.2,0,0,0,0,0,140,0\n");
  assert_int_equal(ambulo_export(model, motion, folder, NULL, NULL, NULL), AMBULO_OK);
  char *grf = folder_text(folder, "grf.mot");
  assert_close(cell(grf, "ground_force_right_px", 0), 0.1, 1e-12);
  assert_close(cell(grf, "ground_torque_right_z", 0), 5.0 + 0.1 * 0.1, 1e-12);
  assert_close(cell(grf, "ground_torque_right_z", 2), 0.0, 1e-12);
  free(grf);
  ambulo_model_free(model);
}

/* a bag pulls the pelvis down: the opposite of what it exerts, where it is */
static void what_hands_hold(void **state) {
  ambulo_model *model = walker();
  const char *motion = scratch_path(state, "m.csv"), *folder = scratch_path(state, "out");
  scratch_write(motion,
                "time,q.pelvis_tx,q.pelvis_ty,held.bag.pelvis.force.x,held.bag.pelvis.force.y,"
                "held.bag.pelvis.moment.z\n0,0,0.1,8,90,4\n0.1,0.2,0.1,8,90,4\n"
                "0.2,0.5,0.1,8,90,4\n0.3,0.6,0.1,8,90,4\n");
  assert_int_equal(ambulo_export(model, motion, folder, NULL, NULL, NULL), AMBULO_OK);
  char *grf = folder_text(folder, "grf.mot"), *loads = folder_text(folder, "external_loads.xml");
  assert_close(cell(grf, "ground_force_bag_pelvis_vx", 1), -8, 1e-12);
  assert_close(cell(grf, "ground_force_bag_pelvis_vy", 1), -90, 1e-12);
  assert_close(cell(grf, "ground_torque_bag_pelvis_z", 1), -4, 1e-12);
  assert_close(cell(grf, "ground_force_bag_pelvis_px", 1), 0.2, 1e-12);
  assert_close(cell(grf, "ground_force_bag_pelvis_py", 1), 0.1 + 0.534643 * 1.75, 1e-12);
  assert_non_null(strstr(loads, "<applied_to_body>pelvis</applied_to_body>"));
  free(grf);
  free(loads);
  ambulo_model_free(model);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(a_folder_for_opensim), TEST(a_moment_without_a_place),
                                     TEST(what_hands_hold)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
