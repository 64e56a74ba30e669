#include "base/diagnostics.h"
#include "model/model.h"
#include "support/chain_definition.h"
#include "support/find_capsule.h"

static void intervals(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.coordinates[1].range[0] = 2;
  c.coordinates[1].range[1] = -0.5;
  chain_bad(&c, AMBULO_E_MODEL,
            "range limits of coordinate 'qb' contradict each other (got [2, -0.5], in degrees "
            "[114.592, -28.6479])");
  c.coordinates[1].range[1] = NAN;
  chain_bad(&c, AMBULO_E_MODEL, "(got [2, nan])");
  c.coordinates[1].range[1] = 2; /* one value: a fixed coordinate, legal */
  ambulo_model_free(chain_good(&c));
  c.coordinates[2].speed[0] = INFINITY;
  chain_bad(&c, AMBULO_E_MODEL, "speed limits of coordinate 'qc'");
  chain_make(&c);
  c.coordinates[0].torque[1] = -INFINITY;
  chain_bad(&c, AMBULO_E_MODEL, "torque limits of coordinate 'qa'");
}

/* sliders on the world, the first of which moves everything */
static void chain_slides(chain *c) {
  chain_make(c);
  for (int i = 0; i < 2; i++) c->links[i].type = AMBULO_PRISMATIC;
  for (int i = 0; i < 2; i++) c->coordinates[i].actuated = 0;
}

static void drives(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.coordinates[1].armature = -0.5;
  chain_bad(&c, AMBULO_E_MODEL,
            "armature of coordinate 'qb' is out of range (got -0.5 kg m^2); expected 0 to 1e12");
  c.coordinates[1].armature = NAN;
  chain_bad(&c, AMBULO_E_MODEL, "armature of coordinate 'qb' is out of range (got nan kg m^2)");
  c.coordinates[1].armature = 0.5;
  c.coordinates[1].friction = INFINITY;
  chain_bad(&c, AMBULO_E_MODEL, "friction of coordinate 'qb' is out of range (got inf N m)");
  c.coordinates[1].friction = 2;
  c.coordinates[0].damping = 1; /* an acrobat's bar, driven or not: hinged to the world */
  ambulo_model_free(chain_good(&c));
  c.coordinates[0].actuated = 0;
  ambulo_model_free(chain_good(&c));
  chain_slides(&c);
  ambulo_model_free(chain_good(&c));
  c.coordinates[0].damping = 3;
  chain_bad(&c, AMBULO_E_MODEL,
            "coordinate 'qa' moves the whole free body, and no joint is there to have damping (got "
            "3 N s/m); expected 0");
  c.coordinates[0].actuated = 1; /* a cart that is pushed */
  ambulo_model_free(chain_good(&c));
  c.coordinates[1].armature = 3; /* does not move the first link */
  ambulo_model_free(chain_good(&c));
}

static void mirror_pairs(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.coordinates[0].mirror = 1;
  chain_bad(&c, AMBULO_E_MODEL, "mirror image of coordinate 'qa' has another mirror image");
  c.coordinates[1].mirror = 0;
  ambulo_model_free(chain_good(&c));
  chain_make(&c);
  c.coordinates[2].mirror_sign = 0.5;
  chain_bad(&c, AMBULO_E_MODEL, "of coordinate 'qc' has a sign that is neither +1 nor -1");
  c.coordinates[2].mirror_sign = 1;
  c.coordinates[2].mirror = 3;
  chain_bad(&c, AMBULO_E_MODEL, "of coordinate 'qc' does not exist");
}

static void unlike_pairs(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.coordinates[0].mirror = 1;
  c.coordinates[1].mirror = 0;
  c.links[1].type = AMBULO_PRISMATIC;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_create(&c.definition, NULL, list, &model), AMBULO_E_MODEL);
  assert_message(list, 0, "mirror image of coordinate 'qa' is of another kind");
  assert_message(list, 1, "mirror image of coordinate 'qb' is of another kind");
  ambulo__diagnostics_clear(list);
  c.links[1].type = AMBULO_REVOLUTE;
  c.coordinates[1].mirror_sign = -1;
  assert_int_equal(ambulo_model_create(&c.definition, NULL, list, &model), AMBULO_E_MODEL);
  assert_message(list, 0, "mirror image of coordinate 'qa' has another sign");
  ambulo_diagnostics_free(list);
}

static void points(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.points[1].link = 3;
  chain_bad(&c, AMBULO_E_MODEL,
            "link of point 'toe' does not exist (got index 3); expected 0 to 2");
  chain_make(&c);
  c.points[0].position[2] = NAN;
  chain_bad(&c, AMBULO_E_MODEL, "position of point 'heel' is out of range");
}

static void feet(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  c.feet[0].heel[0] = -1;
  char said[160];
  (void)snprintf(said, sizeof said,
                 "foot 'foot' refers to points that do not exist; expected point indices 0 to %d (",
                 c.definition.point_count - 1);
  chain_bad(&c, AMBULO_E_MODEL, said);
  chain_make(&c);
  c.feet[0].toe_center = 2;
  chain_bad(&c, AMBULO_E_MODEL, "refers to points that do not exist");
  chain_make(&c);
  c.feet[0].toe[1] = 0;
  chain_bad(&c, AMBULO_E_MODEL, "foot 'foot' has two corners at one end and one at the other");
  chain_make(&c);
  c.feet[0].toe[0] = 0;
  chain_bad(&c, AMBULO_E_MODEL, "foot 'foot' uses one point twice");
  chain_make(&c);
  c.feet[0].toe_center = 0;
  chain_bad(&c, AMBULO_E_MODEL, "uses one point twice");
  chain_make(&c);
  c.feet[0].mirror = 1;
  chain_bad(&c, AMBULO_E_MODEL, "mirror image of foot 'foot' does not exist (got index 1)");
  c.definition.foot_count = 2;
  chain_bad(&c, AMBULO_E_MODEL, "mirror image of foot 'foot' has another mirror image itself");
  c.feet[1].mirror = 0;
  ambulo_model_free(chain_good(&c));
}

static void patches(void **state) {
  (void)state;
  static const struct {
    ambulo_patch patch;
    const char *said;
  } bad[] = {
      {{"hand", 2, {0.1, 0.1}, -1},
       "point of patch 'hand' does not exist (got index 2); expected 0 to 1"},
      {{"hand", 0, {0.0, 0.1}, -1},
       "half the length of patch 'hand' is out of range (got 0 m); expected more than 0"},
      {{"hand", 0, {0.1, INFINITY}, -1}, "half the width of patch 'hand' is out of range"},
      {{"foot", 0, {0.1, 0.1}, -1}, "a patch and a foot are both named 'foot'"},
      {{"other", 0, {0.1, 0.1}, -1}, "two patches are named 'other'"},
      {{"ha nd", 0, {0.1, 0.1}, -1}, "patch name is not allowed (got 'ha nd')"},
      {{"hand", 0, {0.1, 0.1}, 2}, "mirror image of patch 'hand' does not exist (got index 2)"},
      {{"hand", 0, {0.1, 0.1}, 1},
       "mirror image of patch 'hand' has another mirror image itself; expected a pair"},
  };
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    chain c;
    chain_make(&c);
    ambulo_patch two[] = {bad[i].patch, {"other", 1, {0.1, 0.1}, -1}};
    c.definition.patches = two;
    c.definition.patch_count = 2;
    chain_bad(&c, AMBULO_E_MODEL, bad[i].said);
  }
}

/* names and sizes are the model's own; a copy under other conditions has them too */
static void patches_are_kept(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  char name[] = "palm";
  ambulo_patch two[] = {{name, 1, {0.1, 0.2}, 1}, {"back", 0, {0.3, 0.4}, 0}};
  c.definition.patches = two;
  c.definition.patch_count = 2;
  ambulo_model *model = chain_good(&c), *adapted = NULL;
  name[0] = 'x';
  two[0].size[0] = 9.0;
  ambulo_conditions load = ambulo_conditions_default();
  load.load_link = 2;
  load.load_mass = 1.0;
  assert_int_equal(ambulo_model_adapt(model, &load, NULL, NULL, &adapted), AMBULO_OK);
  for (int i = 0; i < 2; i++) {
    const ambulo_model *m = i ? adapted : model;
    assert_int_equal(ambulo_model_patch_count(m), 2);
    const ambulo_patch *palm = ambulo_model_patch(m, 0);
    assert_string_equal(palm->name, "palm");
    assert_int_equal(palm->point, 1);
    assert_close(palm->size[0], 0.1, 0.0);
    assert_close(palm->size[1], 0.2, 0.0);
    assert_int_equal(palm->mirror, 1);
    assert_int_equal(ambulo__find_patch(m, "back"), 1);
    assert_int_equal(ambulo__find_patch(m, "foot"), -1);
    assert_int_equal(ambulo__find_patch(m, NULL), -1);
    assert_null(ambulo_model_patch(m, 2));
    assert_null(ambulo_model_patch(m, -1));
  }
  assert_int_equal(ambulo_model_patch_count(NULL), 0);
  assert_null(ambulo_model_patch(NULL, 0));
  ambulo_model_free(adapted);
  ambulo_model_free(model);
  c.definition.patches = NULL;
  chain_bad(&c, AMBULO_E_ARGUMENT, NULL);
  c.definition.patches = two;
  c.definition.patch_count = 65;
  chain_bad(&c, AMBULO_E_LIMIT, "too many patches (got 65); expected at most 64");
}

static int test_contact_check_tests(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(intervals),    cmocka_unit_test(drives),
      cmocka_unit_test(mirror_pairs), cmocka_unit_test(unlike_pairs),
      cmocka_unit_test(points),       cmocka_unit_test(feet),
      cmocka_unit_test(patches),      cmocka_unit_test(patches_are_kept)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Capsules of a definition: links, sizes, names and mirror pairs. */

static void capsules(void **state) {
  (void)state;
  static const struct {
    ambulo_capsule capsule;
    const char *said;
  } bad[] = {
      {{"arm", 3, {0}, {0}, 0.1, -1},
       "link of capsule 'arm' does not exist (got index 3); expected 0 to 2"},
      {{"arm", -1, {0}, {0}, 0.1, -1}, "link of capsule 'arm' does not exist (got index -1)"},
      {{"arm", 0, {0}, {0}, 0.0, -1},
       "radius of capsule 'arm' is out of range (got 0 m); expected more than 0, at most 10 m"},
      {{"arm", 0, {0}, {0}, NAN, -1}, "radius of capsule 'arm' is out of range"},
      {{"arm", 0, {0}, {0.0, 0.0, INFINITY}, 0.1, -1}, "'to' of capsule 'arm' is out of range"},
      {{"arm", 0, {NAN}, {0}, 0.1, -1}, "'from' of capsule 'arm' is out of range"},
      {{"other", 0, {0}, {0}, 0.1, -1}, "two capsules are named 'other'"},
      {{"a b", 0, {0}, {0}, 0.1, -1}, "capsule name is not allowed (got 'a b')"},
      {{"arm", 0, {0}, {0}, 0.1, 2}, "mirror image of capsule 'arm' does not exist (got index 2)"},
      {{"arm", 0, {0}, {0}, 0.1, 1},
       "mirror image of capsule 'arm' has another mirror image itself; expected a pair"},
  };
  for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
    chain c;
    chain_make(&c);
    ambulo_capsule two[] = {bad[i].capsule, {"other", 1, {0}, {0}, 0.1, -1}};
    c.definition.capsules = two;
    c.definition.capsule_count = 2;
    chain_bad(&c, AMBULO_E_MODEL, bad[i].said);
  }
}

static void a_model_keeps_its_capsules(void **state) {
  (void)state;
  chain c;
  chain_make(&c);
  ambulo_capsule two[] = {{"a", 2, {0.1, 0.2, 0.3}, {0.4, 0.5, 0.6}, 0.1, 1},
                          {"b", 1, {0}, {0}, 0.2, 0}};
  c.definition.capsules = two;
  c.definition.capsule_count = 2;
  ambulo_model *m = chain_good(&c);
  const ambulo_capsule *a = ambulo_model_capsule(m, 0);
  assert_int_equal(ambulo_model_capsule_count(m), 2);
  assert_string_equal(a->name, "a");
  assert_int_equal(a->link, 2);
  assert_close(a->to[1], 0.5, 0.0);
  assert_int_equal(a->mirror, 1);
  assert_int_equal(find_capsule(m, "b"), 1);
  assert_int_equal(find_capsule(m, "c"), -1);
  assert_null(ambulo_model_capsule(m, 2));
  ambulo_conditions conditions = ambulo_conditions_default();
  ambulo_model *adapted = NULL;
  conditions.slope = 0.1;
  assert_int_equal(ambulo_model_adapt(m, &conditions, NULL, NULL, &adapted), AMBULO_OK);
  assert_close(ambulo_model_capsule(adapted, 1)->radius, 0.2, 0.0);
  ambulo_model_free(adapted);
  ambulo_model_free(m);
  c.definition.capsule_count = -1;
  m = NULL;
  assert_int_equal(ambulo_model_create(&c.definition, NULL, NULL, &m), AMBULO_E_ARGUMENT);
}

static int test_capsule_check_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(capsules),
                                     cmocka_unit_test(a_model_keeps_its_capsules)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void) {
  return test_contact_check_tests() + test_capsule_check_tests();
}
