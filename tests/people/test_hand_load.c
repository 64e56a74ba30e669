/* What hands hold, from the columns of a file: on an arm by hand, and all that is doubted. */
#include "support/arm.h"
#include "ambulo/tools/load.h"
#include "support/fail_alloc.h"
#include "support/inverse_table.h"
#include "support/scratch.h"

#define REST "time,shoulder,elbow,qd.shoulder,qd.elbow,qdd.shoulder,qdd.elbow"
#define FORCE "held.box.hand.force.x,held.box.hand.force.y,held.box.hand.force.z"
#define MOMENT "held.box.hand.moment.x,held.box.hand.moment.y,held.box.hand.moment.z"
#define NOTE "note: what its hands hold (held.*) is added to the torques"

static ambulo__motion *of(void **state, const ambulo_model *model, const char *text,
                          const ambulo_inverse_options *options, ambulo_diagnostics *list,
                          ambulo_status expected) {
  const char *path = scratch_path(state, "motion.csv");
  scratch_write(path, text);
  return inverse_of(model, path, options, list, expected);
}

/* rows of a table: three times of one pose, with what stands behind it */
static const char *rows(char text[2000], const char *head, const char *held) {
  int used = snprintf(text, 2000, "%s\n", head);
  for (int k = 0; k < 3; k++)
    used +=
        snprintf(text + used, 2000 - (size_t)used, "%g,0.3,0.4,0.5,-0.2,0,0%s\n", 0.1 * k, held);
  return text;
}

/* of a planar chain: tau_i = (p - o_i) x f + m about z, P = f . v */
static void a_hand_has_leverage(void **state) {
  char text[2000];
  ambulo_model *model = arm_create();
  ambulo__motion *bare = of(state, model, rows(text, REST, ""), NULL, NULL, AMBULO_OK);
  ambulo__motion *m = of(state, model, rows(text, REST "," FORCE "," MOMENT, ",7,-3,2,0.1,0.2,0.5"),
                         NULL, NULL, AMBULO_OK);
  const double px = 0.3 * cos(0.3) + 0.25 * cos(0.7), py = 0.3 * sin(0.3) + 0.25 * sin(0.7);
  const double ex = px - 0.3 * cos(0.3), ey = py - 0.3 * sin(0.3);
  const double at_elbow = ex * -3.0 - ey * 7.0, at_shoulder = px * -3.0 - py * 7.0;
  for (int k = 0; k < 3; k++) {
    assert_close(table_cell(m, k, "tau.elbow") - table_cell(bare, k, "tau.elbow"), at_elbow + 0.5,
                 1e-13);
    assert_close(table_cell(m, k, "tau.shoulder") - table_cell(bare, k, "tau.shoulder"),
                 at_shoulder + 0.5, 1e-13);
    assert_close(table_cell(m, k, "wrench.force.x") - table_cell(bare, k, "wrench.force.x"), 7.0,
                 1e-12);
    assert_close(table_cell(m, k, "wrench.moment.x") - table_cell(bare, k, "wrench.moment.x"),
                 py * 2.0 + 0.1, 1e-12);
    assert_close(table_cell(m, k, "wrench.moment.z") - table_cell(bare, k, "wrench.moment.z"),
                 at_shoulder + 0.5, 1e-12);
    assert_close(table_cell(m, k, "held.box.power"), 0.5 * at_shoulder - 0.2 * at_elbow, 1e-13);
    assert_close(table_cell(m, k, "power.elbow"), -0.2 * table_cell(m, k, "tau.elbow"), 1e-13);
    assert_close(table_cell(m, k, "held.box.hand.moment.y"), 0.2, 0.0);
  }
  ambulo__motion_free(bare);
  ambulo__motion_free(m);
  ambulo_model_free(model);
}

/* two hands, a name with dots, another load: all of them add up */
static void loads_add_up(void **state) {
  char text[2000];
  ambulo_model *model = arm_create();
  ambulo__motion *one = of(state, model,
                           rows(text,
                                REST ",held.a.hand.force.y,held.a.hand.force.x,"
                                     "held.a.hand.moment.z",
                                ",-4,2,1"),
                           NULL, NULL, AMBULO_OK);
  ambulo__motion *two = of(state, model,
                           rows(text,
                                REST ",held.a.b.hand.force.y,held.a.b.hand.force.x,"
                                     "held.a.b.hand.moment.z,held.a.b.forearm.force.x,"
                                     "held.a.b.forearm.force.y,held.a.b.forearm.moment.z,"
                                     "held.c.hand.force.x,held.c.hand.force.y,"
                                     "held.c.hand.moment.z",
                                ",-3,3,1,0,0,0,-1,-1,0"),
                           NULL, NULL, AMBULO_OK);
  assert_close(table_cell(one, 1, "tau.shoulder"), table_cell(two, 1, "tau.shoulder"), 1e-13);
  assert_close(table_cell(one, 1, "held.a.power"),
               table_cell(two, 1, "held.a.b.power") + table_cell(two, 1, "held.c.power"), 1e-13);
  assert_close(table_cell(two, 1, "held.a.b.forearm.force.x"), 0.0, 0.0);
  ambulo__motion_free(one);
  ambulo__motion_free(two);
  ambulo_model_free(model);
}

/* messages of a motion with such columns */
static void check(void **state, const char *head, const char *held, ambulo_status expected,
                  const char *const *messages) {
  char text[2000];
  ambulo_model *model = arm_create();
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo__motion_free(of(state, model, rows(text, head, held), NULL, list, expected));
  assert_messages(list, messages);
  ambulo_model_free(model);
}

static void what_is_missing_or_strange_is_said(void **state) {
  check(state, REST "," FORCE "," MOMENT ",held.box.power", ",1,2,3,4,5,6,7", AMBULO_OK,
        (const char *[]){NOTE, NULL});
  check(state, REST ",held.box.hand.force.x,held.box.hand.moment.x,held.box.hand.moment.y",
        ",1,2,3", AMBULO_OK,
        (const char *[]){"warning: 'held.box.hand' lacks the y of its force; it is taken as 0",
                         "warning: 'held.box.hand' lacks the z of its moment; it is taken as 0",
                         NOTE, NULL});
  check(state, REST "," FORCE "," MOMENT ",held.box.palm.force.x,held.box.palm.force.y",
        ",1,2,3,4,5,6,7,8", AMBULO_OK,
        (const char *[]){"warning: 'held.box.palm.force.x' names no point of model 'arm'; 2 such "
                         "columns are left out",
                         NOTE, NULL});
  check(
      state, REST "," FORCE "," MOMENT ",held.box.mass", ",1,2,3,4,5,6,7", AMBULO_OK,
      (const char *[]){"warning: 'held.box.mass' says nothing that hands of model 'arm' do; 1 such "
                       "column is left out",
                       NOTE, NULL});
  check(state, REST ",held.hand.force.x", ",1", AMBULO_OK,
        (const char *[]){"warning: 'held.hand.force.x' names no point of model 'arm'", NULL});
  check(state, REST "," FORCE "," MOMENT, ",nan,2,3,4,5,6", AMBULO_E_SCHEMA,
        (const char *[]){"", "", "", NULL});
}

/* a body that has a third point */
static void two_hands_at_most(void **state) {
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/whole_body_29.yaml", NULL, NULL, NULL, &model), 0);
  const char *path = scratch_path(state, "motion.csv");
  char text[600];
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  snprintf(text, sizeof text,
           "time,pelvis_ty,held.box.%s.force.x,held.box.%s.force.x,held.box.%s.force.x\n"
           "0,0,1,2,3\n1,0,1,2,3\n2,0,1,2,3\n3,0,1,2,3\n",
           ambulo_model_point(model, 0)->name, ambulo_model_point(model, 1)->name,
           ambulo_model_point(model, 2)->name);
  scratch_write(path, text);
  assert_null(inverse_of(model, path, NULL, list, AMBULO_E_SCHEMA));
  assert_message(list, ambulo_diagnostics_count(list) - 1,
                 "the load 'box' is held by more than two points; expected one or two hands");
  ambulo_diagnostics_free(list);
  ambulo_model_free(model);
}

/* of the file of forces where the motion has none, between its rows; left out with all forces */
static void loads_of_another_file(void **state) {
  char text[2000];
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/walker_2d.yaml", NULL, NULL, NULL, &model), 0);
  const char *point = ambulo_model_point(model, 0)->name, *names[2] = {"right", "left"};
  const char *forces = scratch_path(state, "forces.csv"), *path = scratch_path(state, "m.csv");
  snprintf(text, sizeof text,
           "time,held.bag.%s.force.x,held.bag.%s.force.y,held.bag.%s.moment.z,grf.%s.x,grf.%s.y,"
           "grf.%s.x,grf.%s.y\n-1,0,0,0,0,0,0,0\n7,80,0,0,0,0,0,0\n",
           point, point, point, names[0], names[0], names[1], names[1]);
  scratch_write(forces, text);
  scratch_write(path, "time,q.pelvis_ty\n0,0.1\n1,0.1\n2,0.1\n3,0.1\n");
  ambulo_inverse_options options = ambulo_inverse_options_default();
  options.forces = forces;
  ambulo__motion *m = inverse_of(model, path, &options, NULL, AMBULO_OK);
  for (int k = 0; k < 4; k++)
    assert_close(table_cell(m, k, "wrench.force.x"), 10.0 * (k + 1), 1e-9);
  options.without_forces = 1;
  ambulo__motion *without = inverse_of(model, path, &options, NULL, AMBULO_OK);
  assert_close(table_cell(without, 3, "wrench.force.x"), 0.0, 1e-9);
  ambulo__motion_free(m);
  ambulo__motion_free(without);
  ambulo_model_free(model);
}

static void every_allocation_may_fail(void **state) {
  char text[2000];
  ambulo_model *model = arm_create();
  const char *path = scratch_path(state, "motion.csv");
  scratch_write(path, rows(text, REST "," FORCE "," MOMENT, ",1,2,3,4,5,6"));
  for (long k = 0; k < 400; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator hook = fail_alloc_hook(&memory);
    char *out = NULL;
    ambulo_status status = ambulo_inverse_dynamics_motion(
        model, path, NULL, NULL, &hook, NULL,
        &(ambulo_inverse_outputs){.size = sizeof(ambulo_inverse_outputs), .text = &out});
    ambulo_text_free(out, &hook);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
    assert_true(k < 399);
  }
  ambulo_model_free(model);
}

#define SCRATCH_TEST(f) cmocka_unit_test_setup_teardown(f, scratch_open, scratch_close)

int main(void) {
  const struct CMUnitTest tests[] = {SCRATCH_TEST(a_hand_has_leverage),
                                     SCRATCH_TEST(loads_add_up),
                                     SCRATCH_TEST(what_is_missing_or_strange_is_said),
                                     SCRATCH_TEST(two_hands_at_most),
                                     SCRATCH_TEST(loads_of_another_file),
                                     SCRATCH_TEST(every_allocation_may_fail)};
  return cmocka_run_group_tests_name("inverse/hand_load", tests, NULL, NULL);
}
