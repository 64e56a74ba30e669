/* Missing components are said, unless the model cannot feel them. */
#include "people/force_columns.h"
#include "ambulo/tools/load.h"
#include "support/arm.h"
#include "support/messages.h"
#include "support/model_text.h"
#include "support/planar_walker.h"
#include "support/motion_text.h"

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
  ambulo_model *model = walker_create();
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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(a_planar_model_feels_its_plane),
                                     cmocka_unit_test(a_spatial_model_feels_all),
                                     cmocka_unit_test(an_arm_in_a_plane_is_planar_too),
                                     cmocka_unit_test(one_joint_out_of_the_plane)};
  return cmocka_run_group_tests_name("inverse/force_complete", tests, NULL, NULL);
}
