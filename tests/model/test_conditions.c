/* A model that climbs and carries: what changes, what stays, what is refused. */
#include "base/diagnostics.h"
#include "model/conditions.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/test.h"

#include "ambulo/tools/tools.h"

#include <math.h>
#include <string.h>

static ambulo_model *shipped(void) {
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &model), 0);
  return model;
}

static void nothing_asked_is_a_copy(void **state) {
  (void)state;
  ambulo_model *model = shipped(), *copy = NULL;
  ambulo_conditions conditions = ambulo_conditions_default();
  assert_int_equal(ambulo_model_adapt(model, &conditions, NULL, NULL, &copy), AMBULO_OK);
  assert_ptr_not_equal(copy, model);
  assert_string_equal(copy->name, model->name);
  assert_int_equal(copy->foot_count, model->foot_count);
  assert_memory_equal(copy->gravity, model->gravity, 3 * sizeof(double));
  assert_memory_equal(copy->up, model->up, 3 * sizeof(double));
  assert_memory_equal(copy->forward, model->forward, 3 * sizeof(double));
  assert_memory_equal(copy->left, model->left, 3 * sizeof(double));
  assert_memory_equal(&copy->mass, &model->mass, sizeof(double));
  assert_memory_equal(&copy->stature, &model->stature, sizeof(double));
  for (int i = 0; i < model->link_count; i++) {
    assert_string_equal(copy->links[i].name, model->links[i].name);
    assert_int_equal(copy->links[i].parent, model->links[i].parent);
    assert_memory_equal(copy->links[i].inertia, model->links[i].inertia, 6 * sizeof(double));
  }
  for (int i = 0; i < model->coordinate_count; i++)
    assert_int_equal(copy->coordinates[i].mirror, model->coordinates[i].mirror);
  ambulo_model_free(model);
  ambulo_model_free(copy);
}

/* uphill, gravity has a part against the way; its size, and the ground's axes, stay */
static void a_slope_turns_gravity(void **state) {
  (void)state;
  ambulo_model *model = shipped(), *uphill = NULL, *again = NULL;
  ambulo_conditions conditions = ambulo_conditions_default();
  conditions.slope = 0.1;
  assert_int_equal(ambulo_model_adapt(model, &conditions, NULL, NULL, &uphill), AMBULO_OK);
  const double *g = ambulo_model_gravity(uphill), *f = ambulo_model_forward(uphill);
  const double *n = ambulo_model_up(uphill);
  assert_memory_equal(n, ambulo_model_up(model), 3 * sizeof(double));
  assert_close(g[0] * f[0] + g[1] * f[1] + g[2] * f[2], -9.81 * sin(0.1), 1e-13);
  assert_close(g[0] * n[0] + g[1] * n[1] + g[2] * n[2], -9.81 * cos(0.1), 1e-13);
  conditions.slope = -0.2;
  assert_int_equal(ambulo_model_adapt(uphill, &conditions, NULL, NULL, &again), AMBULO_OK);
  g = ambulo_model_gravity(again);
  assert_close(g[0] * f[0] + g[1] * f[1] + g[2] * f[2], 9.81 * sin(0.2), 1e-13);
  ambulo_model_free(model);
  ambulo_model_free(uphill);
  ambulo_model_free(again);
}

/* twice 5 kg at one place weigh as much as 10 kg there; the first model stays as it is */
static void loads_add_up(void **state) {
  (void)state;
  ambulo_model *model = shipped(), *once = NULL, *twice = NULL, *whole = NULL;
  double mass = ambulo_model_mass(model);
  ambulo_conditions c = ambulo_conditions_default();
  c.load_link = ambulo_model_find_link(model, "pelvis");
  c.load_mass = 5.0;
  c.load_position[0] = -0.15;
  assert_int_equal(ambulo_model_adapt(model, &c, NULL, NULL, &once), AMBULO_OK);
  assert_int_equal(ambulo_model_adapt(once, &c, NULL, NULL, &twice), AMBULO_OK);
  c.load_mass = 10.0;
  assert_int_equal(ambulo_model_adapt(model, &c, NULL, NULL, &whole), AMBULO_OK);
  assert_close(ambulo_model_mass(model), mass, 0.0);
  assert_close(ambulo_model_mass(twice), mass + 10.0, 1e-12);
  const ambulo_link *a = ambulo_model_link(twice, c.load_link);
  const ambulo_link *b = ambulo_model_link(whole, c.load_link);
  for (int i = 0; i < 3; i++) assert_close(a->com[i], b->com[i], 1e-14);
  for (int i = 0; i < 6; i++) assert_close(a->inertia[i], b->inertia[i], 1e-13);
  ambulo_model_free(model);
  ambulo_model_free(once);
  ambulo_model_free(twice);
  ambulo_model_free(whole);
}

/* every link can carry, the first one too */
static void loads_on_every_link(void **state) {
  (void)state;
  ambulo_model *model = shipped();
  for (int link = 0; link < ambulo_model_link_count(model); link++) {
    ambulo_model *loaded = NULL;
    ambulo_conditions c = ambulo_conditions_default();
    c.load_link = link;
    c.load_mass = 2.5;
    assert_int_equal(ambulo_model_adapt(model, &c, NULL, NULL, &loaded), AMBULO_OK);
    assert_close(ambulo_model_mass(loaded), ambulo_model_mass(model) + 2.5, 1e-13);
    assert_close(ambulo_model_link(loaded, link)->mass, ambulo_model_link(model, link)->mass + 2.5,
                 1e-13);
    ambulo_model_free(loaded);
  }
  ambulo_model_free(model);
}

static void what_is_refused(void **state) {
  (void)state;
  ambulo_model *model = shipped(), *untouched = model;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_conditions zero;
  memset(&zero, 0, sizeof zero);
  assert_int_equal(ambulo_model_adapt(model, &zero, NULL, list, &untouched), AMBULO_E_ARGUMENT);
  ambulo_conditions wrong[6];
  for (int i = 0; i < 6; i++) wrong[i] = ambulo_conditions_default();
  wrong[0].slope = 0.7;
  wrong[1].slope = (double)NAN;
  wrong[2].load_link = 1000;
  wrong[3].load_link = -2;
  wrong[4].load_link = 0; /* no mass */
  wrong[5] = (ambulo_conditions){
      .size = wrong[0].size, .load_link = 0, .load_mass = 1.0, .load_position = {(double)INFINITY}};
  for (int i = 0; i < 6; i++) {
    ambulo__diagnostics_clear(list);
    assert_int_equal(ambulo_model_adapt(model, &wrong[i], NULL, list, &untouched),
                     AMBULO_E_ARGUMENT);
    assert_message(list, 0, "the conditions are out of range");
  }
  ambulo_conditions level = ambulo_conditions_default();
  assert_int_equal(ambulo_model_adapt(NULL, &level, NULL, NULL, &untouched), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_model_adapt(model, NULL, NULL, NULL, &untouched), AMBULO_E_ARGUMENT);
  assert_int_equal(ambulo_model_adapt(model, &level, NULL, NULL, NULL), AMBULO_E_ARGUMENT);
  assert_ptr_equal(untouched, model);
  ambulo_diagnostics_free(list);
  ambulo_model_free(model);
}

static void every_allocation_may_fail(void **state) {
  (void)state;
  ambulo_model *model = shipped();
  ambulo_conditions conditions = ambulo_conditions_default();
  conditions.slope = 0.1;
  for (long k = 0; k < 1000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_model *adapted = NULL;
    ambulo_status status = ambulo_model_adapt(model, &conditions, &allocator, NULL, &adapted);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo_model_free(adapted);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  ambulo_model_free(model);
}

static void expect_same_numbers(const double *got, const double *want, int count) {
  for (int i = 0; i < count; i++) {
    if (isfinite(want[i]))
      assert_close(got[i], want[i], 1e-13);
    else
      assert_true(got[i] == want[i]);
  }
}

/* a file read for another subject, and the same model made that size */
static void another_size_is_another_subject(void **state) {
  (void)state;
  static const char *const files[] = {"models/whole_body_29.yaml", "models/lower_body_18.yaml"};
  static const char *const drive[] = {"links[shank_l].coordinate.armature=0.001",
                                      "links[shank_l].coordinate.damping=0.01",
                                      "links[shank_l].coordinate.friction=0.02"};
  for (int f = 0; f < 2; f++) {
    ambulo_model *model = NULL, *other = NULL;
    ambulo_subject subject = ambulo_subject_default();
    assert_int_equal(ambulo_model_load_with(files[f], drive, 3, NULL, NULL, NULL, &model), 0);
    subject.mass = 1.25 * model->units.mass;
    subject.stature = 0.8 * model->stature;
    assert_int_equal(ambulo_model_load_with(files[f], drive, 3, &subject, NULL, NULL, &other), 0);
    ambulo__model_resize(model, 1.25, 0.8);
    assert_close(model->mass, other->mass, 1e-13);
    assert_close(model->stature, other->stature, 1e-13);
    expect_same_numbers(&model->units.angle, &other->units.angle, 5);
    for (int i = 0; i < model->link_count; i++) {
      const ambulo_link *got = &model->links[i], *want = &other->links[i];
      expect_same_numbers(&got->theta, &want->theta, 4);
      expect_same_numbers(&got->mass, &want->mass, 10);
    }
    for (int i = 0; i < model->coordinate_count; i++) {
      expect_same_numbers(model->coordinates[i].range, other->coordinates[i].range, 6);
      assert_close(model->coordinates[i].default_value, other->coordinates[i].default_value, 1e-13);
      expect_same_numbers(&model->coordinates[i].armature, &other->coordinates[i].armature, 3);
    }
    for (int i = 0; i < model->point_count; i++)
      expect_same_numbers(model->points[i].position, other->points[i].position, 3);
    expect_same_numbers(model->neutral, other->neutral, 3 * model->point_count);
    for (int i = 0; i < model->capsule_count; i++)
      expect_same_numbers(model->capsules[i].from, other->capsules[i].from, 7);
    ambulo_model_free(model);
    ambulo_model_free(other);
  }
}

/* put down again, also from a link that has nothing but its load */
static void what_is_carried_is_put_down(void **state) {
  (void)state;
  static const double place[3] = {0.1, -0.2, 0.05};
  ambulo_model *model = shipped(), *same = shipped();
  int empty = 0;
  while (model->links[empty].mass != 0.0) empty++;
  int full = ambulo_model_find_link(model, "shank_r");
  ambulo__model_carry(model, full, 7.0, place);
  ambulo__model_carry(model, empty, 3.0, place);
  ambulo__model_put_down(model);
  assert_int_equal(model->load_count, 0);
  assert_close(model->mass, same->mass, 1e-13);
  expect_same_numbers(&model->links[full].mass, &same->links[full].mass, 10);
  expect_same_numbers(&model->links[empty].mass, &same->links[empty].mass, 10);
  ambulo_model_free(model);
  ambulo_model_free(same);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(nothing_asked_is_a_copy),
                                     cmocka_unit_test(another_size_is_another_subject),
                                     cmocka_unit_test(what_is_carried_is_put_down),
                                     cmocka_unit_test(a_slope_turns_gravity),
                                     cmocka_unit_test(loads_add_up),
                                     cmocka_unit_test(loads_on_every_link),
                                     cmocka_unit_test(what_is_refused),
                                     cmocka_unit_test(every_allocation_may_fail)};
  return cmocka_run_group_tests_name("model/conditions", tests, NULL, NULL);
}
