/* Groups of force columns: every way in which programs name them. */
#include "people/force_columns.h"
#include "support/arm.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/model_text.h"
#include "support/motion_text.h"
#include "support/planar_walker.h"
#include "support/scratch.h"
#include "support/shared_data.h"

static ambulo__motion *table(const char *names) {
  char text[2048];
  size_t used = (size_t)snprintf(text, sizeof text, "time,%s\n0", names);
  for (const char *c = names; c; c = strchr(c + 1, ','))
    used += (size_t)snprintf(text + used, sizeof text - used, ",1");
  snprintf(text + used, sizeof text - used, "\n");
  ambulo__motion *motion = NULL;
  assert_int_equal(
      motion_read_text(text, strlen(text), "f.csv", AMBULO__MOTION_CSV, NULL, NULL, &motion),
      AMBULO_OK);
  return motion;
}

/* the columns of one group, in the order force x y z, point x y z, torque x y z */
static void nine(const char *names, const char *name, const char *tag) {
  ambulo__motion *motion = table(names);
  ambulo__force_columns c;
  assert_int_equal(ambulo__force_columns_find(motion, "f.csv", NULL, NULL, &c), AMBULO_OK);
  if (c.count != 1 || strcmp(c.groups[0].name, name) != 0)
    print_error("%s: %d groups, '%s'\n", names, c.count, c.count ? c.groups[0].name : "");
  assert_int_equal(c.count, 1);
  assert_string_equal(c.groups[0].name, name);
  assert_string_equal(c.groups[0].tag, tag);
  for (int i = 0; i < 3; i++) {
    assert_int_equal(c.groups[0].force[i], i);
    assert_int_equal(c.groups[0].point[i], 3 + i);
    assert_int_equal(c.groups[0].torque[i], 6 + i);
  }
  assert_int_equal(c.groups[0].foot, -1);
  assert_int_equal(ambulo__force_group_named(&c, name, strlen(name)), 0);
  ambulo__force_columns_free(&c);
  ambulo__motion_free(motion);
}

static void every_convention_is_read(void **state) {
  (void)state;
  nine("ground_force_vx,ground_force_vy,ground_force_vz,ground_force_px,ground_force_py,"
       "ground_force_pz,ground_torque_x,ground_torque_y,ground_torque_z",
       "ground_force", "");
  nine("1_ground_force_vx,1_ground_force_vy,1_ground_force_vz,1_ground_force_px,1_ground_force_py,"
       "1_ground_force_pz,1_ground_torque_x,1_ground_torque_y,1_ground_torque_z",
       "1_ground_force", "1");
  nine("ground_force_1_vx,ground_force_1_vy,ground_force_1_vz,ground_force_1_px,ground_force_1_py,"
       "ground_force_1_pz,ground_moment_1_mx,ground_moment_1_my,ground_moment_1_mz",
       "ground_force_1", "1");
  nine("R_ground_force_vx,R_ground_force_vy,R_ground_force_vz,R_ground_force_px,R_ground_force_py,"
       "R_ground_force_pz,R_ground_torque_x,R_ground_torque_y,R_ground_torque_z",
       "R_ground_force", "R");
  nine("ground_force_right_vx,ground_force_right_vy,ground_force_right_vz,ground_force_right_px,"
       "ground_force_right_py,ground_force_right_pz,ground_torque_right_x,ground_torque_right_y,"
       "ground_torque_right_z",
       "ground_force_right", "right");
  nine("ground_force_calcn_r_vx,ground_force_calcn_r_vy,ground_force_calcn_r_vz,"
       "ground_force_calcn_r_px,ground_force_calcn_r_py,ground_force_calcn_r_pz,"
       "ground_force_calcn_r_mx,ground_force_calcn_r_my,ground_force_calcn_r_mz",
       "ground_force_calcn_r", "calcn_r");
  nine("ground_force_calcn_l_vx,ground_force_calcn_l_vy,ground_force_calcn_l_vz,"
       "ground_force_calcn_l_px,ground_force_calcn_l_py,ground_force_calcn_l_pz,"
       "ground_torque_calcn_l_vx,ground_torque_calcn_l_vy,ground_torque_calcn_l_vz",
       "ground_force_calcn_l", "calcn_l");
}

static void letter_case_does_not_part_a_group(void **state) {
  (void)state;
  nine("R_Ground_Force_VX,r_ground_force_vy,R_GROUND_FORCE_VZ,r_ground_force_Px,R_ground_force_py,"
       "r_ground_force_pZ,r_ground_torque_X,R_ground_torque_y,r_Ground_Torque_z",
       "R_ground_force", "R");
}

static void own_columns_have_a_free_moment(void **state) {
  (void)state;
  ambulo__motion *motion = table("q.hip,grf.left.x,grf.left.y,grf.left.z,cop.left.x,cop.left.y,"
                                 "cop.left.z,free_moment.left,grf.my.foot.y,zmp.x,wrench.force.x,"
                                 "moment.left.x,moment.left.z,moment.disc.y");
  ambulo__force_columns c;
  assert_int_equal(ambulo__force_columns_find(motion, "f.csv", NULL, NULL, &c), AMBULO_OK);
  assert_int_equal(c.count, 2);
  assert_string_equal(c.groups[0].tag, "left");
  assert_string_equal(c.groups[1].tag, "my.foot");
  assert_int_equal(c.groups[0].force[2], 3);
  assert_int_equal(c.groups[0].point[0], 4);
  assert_int_equal(c.groups[0].free_moment, 7);
  assert_int_equal(c.groups[0].torque[1], -1);
  assert_int_equal(c.groups[1].force[1], 8);
  assert_int_equal(c.groups[0].moment[0], 11);
  assert_int_equal(c.groups[0].moment[1], -1);
  assert_int_equal(c.groups[0].moment[2], 12);
  assert_int_equal(c.groups[1].moment[2], -1);
  ambulo__force_columns_free(&c);
  ambulo__motion_free(motion);
}

static void what_is_no_force_is_left(void **state) {
  (void)state;
  ambulo__motion *motion =
      table("ground_force,ground_force_vw,ground_force_vxx,playground_force_vx,ground_torque_px,"
            "grf.x,grf..x,cop.left,free_moment.,underground_force_1_vx,ground_forces_vx");
  ambulo__force_columns c;
  assert_int_equal(ambulo__force_columns_find(motion, "f.csv", NULL, NULL, &c), AMBULO_OK);
  for (int i = 0; i < c.count; i++) print_error("took '%s'\n", c.groups[i].name);
  assert_int_equal(c.count, 0);
  ambulo__force_columns_free(&c);
  ambulo__motion_free(motion);
}

static void one_component_has_one_column(void **state) {
  (void)state;
  ambulo__motion *motion = table("ground_torque_1_x,ground_moment_1_mx");
  ambulo__force_columns c;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__force_columns_find(motion, "f.csv", NULL, list, &c), AMBULO_E_SCHEMA);
  assert_message(list, 0,
                 "'ground_torque_1_x' and 'ground_moment_1_mx' are the same component of "
                 "'ground_force_1'");
  ambulo_diagnostics_free(list);
  ambulo__motion_free(motion);
}

/* names and, where they are unique, tags; whatever the letter case */
static void groups_go_by_name_or_tag(void **state) {
  (void)state;
  ambulo__motion *motion =
      table("ground_force_vx,1_ground_force_vx,ground_force_1_vx,R_ground_force_vx");
  ambulo__force_columns c;
  assert_int_equal(ambulo__force_columns_find(motion, "f.csv", NULL, NULL, &c), AMBULO_OK);
  assert_int_equal(c.count, 4);
  static const struct {
    const char *name;
    int index;
  } names[] = {{"ground_force", 0},
               {"1_ground_force", 1},
               {"ground_force_1", 2},
               {"1", -1},
               {"r_GROUND_force", 3},
               {"r", 3},
               {"", -1},
               {"2", -1}};
  for (int i = 0; i < 8; i++)
    assert_int_equal(ambulo__force_group_named(&c, names[i].name, strlen(names[i].name)),
                     names[i].index);
  assert_int_equal(ambulo__force_group_named(&c, "rest", 1), 3);
  ambulo__force_columns_free(&c);
  ambulo__motion_free(motion);
}

/* the identifiers of an OpenSim file of external loads */
static void groups_by_the_beginnings_of_their_columns(void **state) {
  (void)state;
  ambulo__motion *motion = table("FP1.Fx,FP1.Fy,FP1.Fz,FP1.COPx,FP1.COPz,T_x,T_y,T_z");
  ambulo__force_columns c;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  int index = -1;
  assert_int_equal(ambulo__force_columns_find(motion, "f.csv", NULL, NULL, &c), AMBULO_OK);
  assert_int_equal(c.count, 0);
  static const char full[] = "FP1.F:FP1.COP:T_,next", forces[] = "FP1.F",
                    wrong[] = "FP2.F:FP1.COP:T_";
  assert_int_equal(ambulo__force_group_add(&c, full, 16, list, &index), AMBULO_OK);
  assert_int_equal(index, 0);
  assert_int_equal(c.groups[0].force[2], 2);
  assert_int_equal(c.groups[0].point[0], 3);
  assert_int_equal(c.groups[0].point[1], -1);
  assert_int_equal(c.groups[0].point[2], 4);
  assert_int_equal(c.groups[0].torque[2], 7);
  assert_string_equal(c.groups[0].name, "FP1.F:FP1.COP:T_");
  assert_int_equal(ambulo__force_group_add(&c, forces, strlen(forces), list, &index), AMBULO_OK);
  assert_int_equal(c.groups[1].force[0], 0);
  assert_int_equal(c.groups[1].point[0], -1);
  assert_int_equal(ambulo__force_group_add(&c, "FP1.F::T_", 9, list, &index), AMBULO_OK);
  assert_int_equal(c.groups[2].point[0], -1);
  assert_int_equal(c.groups[2].torque[0], 5);
  assert_int_equal(ambulo__force_group_add(&c, wrong, strlen(wrong), list, &index),
                   AMBULO_E_SCHEMA);
  assert_message(list, 0, "no columns 'FP2.Fx', 'FP2.Fy', 'FP2.Fz'");
  assert_int_equal(index, 2);
  ambulo__force_columns_free(&c);
  ambulo__motion_free(motion);
  /* OpenSim's own tables of C3D files number the components */
  motion = table("f1_1,f1_2,f1_3,p1_1,p1_2,p1_3,m1_1,m1_2,m1_3");
  assert_int_equal(ambulo__force_columns_find(motion, "f.csv", NULL, NULL, &c), AMBULO_OK);
  assert_int_equal(ambulo__force_group_add(&c, "f1_:p1_:m1_", 11, list, &index), AMBULO_OK);
  for (int i = 0; i < 3; i++) {
    assert_int_equal(c.groups[0].force[i], i);
    assert_int_equal(c.groups[0].point[i], 3 + i);
    assert_int_equal(c.groups[0].torque[i], 6 + i);
  }
  ambulo_diagnostics_free(list);
  ambulo__force_columns_free(&c);
  ambulo__motion_free(motion);
}

static void a_published_file_is_read(void **state) {
  (void)state;
  char path[SCRATCH_PATH];
  if (!shared_data_path("opensim_moco_2dwalking_referenceGRF.sto", path, sizeof path)) skip();
  ambulo__motion *motion = NULL;
  ambulo__force_columns c;
  assert_int_equal(ambulo__motion_read(path, 1, NULL, NULL, &motion), AMBULO_OK);
  assert_int_equal(ambulo__force_columns_find(motion, path, NULL, NULL, &c), AMBULO_OK);
  assert_int_equal(c.count, 2);
  for (int i = 0; i < 2; i++) {
    assert_string_equal(c.groups[i].tag, i ? "l" : "r");
    for (int axis = 0; axis < 3; axis++)
      assert_true(c.groups[i].force[axis] >= 0 && c.groups[i].point[axis] >= 0 &&
                  c.groups[i].torque[axis] >= 0);
  }
  ambulo__force_columns_free(&c);
  ambulo__motion_free(motion);
}

static void every_allocation_may_fail(void **state) {
  (void)state;
  ambulo__motion *motion = table("ground_force_vx,1_ground_force_vx,ground_force_1_vx");
  for (long k = 0; k < 100; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    ambulo__force_columns c;
    ambulo_status status = ambulo__force_columns_find(motion, "f.csv", &hook, NULL, &c);
    if (!status) ambulo__force_columns_free(&c);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
    assert_true(k < 99);
  }
  ambulo__motion_free(motion);
}

static int test_force_columns_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_convention_is_read),
                                     cmocka_unit_test(letter_case_does_not_part_a_group),
                                     cmocka_unit_test(own_columns_have_a_free_moment),
                                     cmocka_unit_test(what_is_no_force_is_left),
                                     cmocka_unit_test(one_component_has_one_column),
                                     cmocka_unit_test(groups_go_by_name_or_tag),
                                     cmocka_unit_test(groups_by_the_beginnings_of_their_columns),
                                     cmocka_unit_test(a_published_file_is_read),
                                     cmocka_unit_test(every_allocation_may_fail)};
  return cmocka_run_group_tests_name("inverse/force_columns", tests, NULL, NULL);
}

/* Missing components are said, unless the model cannot feel them. */

/* messages of a table whose one group belongs to foot 0 */
static ambulo_diagnostics *messages_of(const ambulo_model *model, const char *names,
                                       ambulo_status expected) {
  char text[512];
  size_t used = (size_t)snprintf(text, sizeof text, "time,%s\n0", names);
  for (const char *c = names; c; c = strchr(c + 1, ','))
    used += (size_t)snprintf(text + used, sizeof text - used, ",1");
  snprintf(text + used, sizeof text - used, "\n");
  ambulo__motion *motion = NULL;
  ambulo__force_columns c;
  ambulo__doubts doubts = {ambulo_diagnostics_create(NULL), 0, 0, 0};
  assert_int_equal(
      motion_read_text(text, strlen(text), "f.csv", AMBULO__MOTION_CSV, NULL, NULL, &motion),
      AMBULO_OK);
  assert_int_equal(ambulo__force_columns_find(motion, "f.csv", NULL, NULL, &c), AMBULO_OK);
  c.groups[0].foot = 0;
  assert_int_equal(ambulo__force_columns_complete(&c, model, &doubts), expected);
  ambulo__force_columns_free(&c);
  ambulo__motion_free(motion);
  return doubts.diagnostics;
}

static void check(const ambulo_model *model, const char *names, const char *const *messages) {
  ambulo_diagnostics *list = messages_of(model, names, AMBULO_OK);
  size_t count = 0;
  while (messages[count]) count++;
  if (ambulo_diagnostics_count(list) != count) print_error("%s\n", names);
  assert_int_equal(ambulo_diagnostics_count(list), count);
  for (size_t i = 0; i < count; i++) assert_message(list, i, messages[i]);
  ambulo_diagnostics_free(list);
}

#define F "ground_force_r_v"
#define P "ground_force_r_p"
#define T "ground_torque_r_"

static void a_planar_model_feels_its_plane(void **state) {
  (void)state;
  ambulo_model *model = planar_walker_create();
  int axis = -1;
  assert_int_equal(ambulo__idle_axis(model, NULL, &axis), AMBULO_OK);
  assert_int_equal(axis, 2);
  check(model, F "x," F "y," P "x," P "y," T "z", (const char *[]){NULL});
  check(
      model, F "y," P "x," P "y," T "z",
      (const char *[]){"warning: 'ground_force_r' of foot 'right' lacks the x of its force", NULL});
  check(model, F "x," F "y," P "y," T "z", (const char *[]){"warning: ", NULL});
  check(model, F "x," F "y," P "x," T "z",
        (const char *[]){"note: 'ground_force_r' of foot 'right' has no y of its points", NULL});
  check(model, F "x," F "y",
        (const char *[]){"note: 'ground_force_r' of foot 'right' has no torques", NULL});
  ambulo_diagnostics_free(messages_of(model, F "z," P "x", AMBULO_E_SCHEMA));
  ambulo_model_free(model);
}

static void a_spatial_model_feels_all(void **state) {
  (void)state;
  ambulo_model *model = NULL;
  int axis = 7;
  assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &model), 0);
  assert_int_equal(ambulo__idle_axis(model, NULL, &axis), AMBULO_OK);
  assert_int_equal(axis, -1);
  check(model, F "x," F "y," F "z," P "x," P "y," P "z," T "y", (const char *[]){NULL});
  check(model, F "y," P "x," P "y," P "z," T "y",
        (const char *[]){"lacks the x, z of its force; it is taken as 0", NULL});
  check(model, "grf.right.x,grf.right.y,grf.right.z,moment.right.x,moment.right.y,moment.right.z",
        (const char *[]){NULL});
  check(model,
        "grf.right.x,grf.right.y,grf.right.z,cop.right.x,cop.right.y,cop.right.z,"
        "free_moment.right,moment.right.z",
        (const char *[]){"warning: 'grf.right' of foot 'right' lacks the x, y of its moment; the "
                         "others are left out",
                         NULL});
  check(model, F "x," F "y," F "z," P "x," T "y",
        (const char *[]){"note: 'ground_force_r' of foot 'right' has no y of its points; they are "
                         "taken to be on the ground",
                         "warning: 'ground_force_r' of foot 'right' lacks the z of its points",
                         NULL});
  ambulo_model_free(model);
}

static void an_arm_in_a_plane_is_planar_too(void **state) {
  (void)state;
  ambulo_model *model = arm_create();
  int axis = -1;
  assert_int_equal(ambulo__idle_axis(model, NULL, &axis), AMBULO_OK);
  assert_int_equal(axis, 2);
  ambulo_model_free(model);
}

static int idle_axis_of(const char *links) {
  char text[1024];
  ambulo_model *model = NULL;
  int axis = 7;
  snprintf(text, sizeof text, "%s%s", MODEL_HEAD "links:\n", links);
  assert_int_equal(ambulo_model_load_text(text, strlen(text), "t.yaml", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  assert_int_equal(ambulo__idle_axis(model, NULL, &axis), AMBULO_OK);
  ambulo_model_free(model);
  return axis;
}

/* z is to the right: one joint that leaves the plane is enough */
static void one_joint_out_of_the_plane(void **state) {
  (void)state;
#define LINK "parent: none, joint: "
  assert_int_equal(
      idle_axis_of("  - {name: a, " LINK "revolute, dh: [0, 0, 1, 0], " MODEL_BODY "}\n"), 2);
  assert_int_equal(
      idle_axis_of("  - {name: a, " LINK "prismatic, dh: [0, 0, 1, 0], " MODEL_BODY "}\n"), -1);
  assert_int_equal(
      idle_axis_of("  - {name: b, " LINK "fixed, dh: [0, 0, 0, 90]}\n"
                   "  - {name: a, parent: b, joint: revolute, dh: [0, 0, 1, 0], " MODEL_BODY "}\n"),
      -1);
  assert_int_equal(
      idle_axis_of("  - {name: b, " LINK "fixed, dh: [0, 0, 0, 90]}\n"
                   "  - {name: a, parent: b, joint: prismatic, dh: [0, 0, 1, 0], " MODEL_BODY
                   "}\n"),
      2);
}

static int test_force_complete_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_planar_model_feels_its_plane),
                                     cmocka_unit_test(a_spatial_model_feels_all),
                                     cmocka_unit_test(an_arm_in_a_plane_is_planar_too),
                                     cmocka_unit_test(one_joint_out_of_the_plane)};
  return cmocka_run_group_tests_name("inverse/force_complete", tests, NULL, NULL);
}

int main(void) {
  return test_force_columns_tests() + test_force_complete_tests();
}
