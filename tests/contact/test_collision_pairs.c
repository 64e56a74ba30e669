/* Which capsules of a shipped body are kept apart: neighbours, pairs that overlap as it stands and
 * pairs that never meet are not; the mirror image of a pair is where one step stands for both. */
#include "support/find_capsule.h"
#include "ambulo/tools/tools.h"
#include "contact/row_families.h"
#include "support/test.h"

#include <string.h>

static ambulo_model *model;
static ambulo_allocator own;

static int open_model(void **state) {
  (void)state;
  own = ambulo__allocator_or_default(NULL);
  return ambulo_model_load("models/lower_body_21.yaml", NULL, NULL, NULL, &model) != AMBULO_OK;
}

static int close_model(void **state) {
  (void)state;
  ambulo_model_free(model);
  return 0;
}

static ambulo_problem_definition definition_of(ambulo_collision_mode mode) {
  ambulo_problem_definition d = ambulo_problem_definition_default();
  d.model = model;
  d.collision.mode = mode;
  d.joint_limits = AMBULO_LIMIT_NODES;
  return d;
}

static int has(const ambulo_capsule_pair *pairs, int count, const char *one, const char *other) {
  int a = find_capsule(model, one), b = find_capsule(model, other);
  int found = 0;
  assert_true(a >= 0 && b >= 0);
  for (int k = 0; k < count; k++)
    found +=
        (pairs[k].one == a && pairs[k].other == b) || (pairs[k].one == b && pairs[k].other == a);
  return found;
}

static void automatic_is_what_can_meet(void **state) {
  (void)state;
  ambulo_problem_definition d = definition_of(AMBULO_COLLISION_AUTOMATIC);
  ambulo__pairs p;
  d.collision.margin = 0.01;
  assert_int_equal(ambulo__pairs_create(&d, &own, &p), AMBULO_OK);
  static const char *const kept[][2] = {{"thigh_l", "thigh_r"}, {"shank_l", "shank_r"},
                                        {"foot_l", "foot_r"},   {"shank_l", "thigh_r"},
                                        {"foot_l", "shank_r"},  {"thigh_l", "shank_r"}};
  for (size_t k = 0; k < sizeof kept / sizeof *kept; k++)
    assert_int_equal(has(p.kept, p.kept_count, kept[k][0], kept[k][1]), 1);
  static const char *const neighbours[][2] = {
      {"thigh_l", "shank_l"}, {"foot_r", "shank_r"}, {"pelvis", "thigh_l"}, {"pelvis", "trunk"}};
  for (size_t k = 0; k < sizeof neighbours / sizeof *neighbours; k++) {
    assert_int_equal(has(p.kept, p.kept_count, neighbours[k][0], neighbours[k][1]), 0);
    assert_int_equal(has(p.left, p.left_count, neighbours[k][0], neighbours[k][1]), 0);
  }
  assert_int_equal(has(p.left, p.left_count, "trunk", "thigh_r"), 1);
  assert_int_equal(has(p.kept, p.kept_count, "trunk", "thigh_r"), 0);
  assert_int_equal(has(p.kept, p.kept_count, "head", "foot_l"), 0); /* the knee is in the way */
  assert_true(p.too_far > 3);
  for (int k = 1; k < p.kept_count; k++) {
    assert_true(p.kept[k].one < p.kept[k].other);
    assert_true(p.kept[k - 1].one < p.kept[k].one ||
                (p.kept[k - 1].one == p.kept[k].one && p.kept[k - 1].other < p.kept[k].other));
  }
  ambulo__pairs_free(&own, &p);
}

/* with limits that are no rows joints may turn anywhere, and more can meet */
static void ranges_count_where_they_are_rows(void **state) {
  (void)state;
  ambulo_problem_definition d = definition_of(AMBULO_COLLISION_AUTOMATIC);
  ambulo__pairs within, anywhere;
  assert_int_equal(ambulo__pairs_create(&d, &own, &within), AMBULO_OK);
  d.joint_limits = AMBULO_LIMIT_OFF;
  assert_int_equal(ambulo__pairs_create(&d, &own, &anywhere), AMBULO_OK);
  assert_true(anywhere.kept_count > within.kept_count);
  assert_int_equal(anywhere.kept_count + anywhere.too_far, within.kept_count + within.too_far);
  ambulo__pairs_free(&own, &within);
  ambulo__pairs_free(&own, &anywhere);
}

static void named_pairs_are_those_and_their_images(void **state) {
  (void)state;
  ambulo_problem_definition d = definition_of(AMBULO_COLLISION_PAIRS);
  const ambulo_capsule_pair named[3] = {
      {find_capsule(model, "shank_l"), find_capsule(model, "thigh_r")},
      {find_capsule(model, "thigh_r"), find_capsule(model, "shank_l")},
      {find_capsule(model, "foot_r"), find_capsule(model, "foot_l")}};
  ambulo__pairs p;
  d.collision.pairs = named;
  d.collision.pair_count = 3;
  assert_int_equal(ambulo__pairs_create(&d, &own, &p), AMBULO_OK);
  assert_int_equal(p.kept_count, 2);
  ambulo__pairs_free(&own, &p);
  d.ends = AMBULO_ENDS_MIRRORED;
  assert_int_equal(ambulo__pairs_create(&d, &own, &p), AMBULO_OK);
  assert_int_equal(p.kept_count, 3);
  assert_int_equal(has(p.kept, 3, "shank_r", "thigh_l"), 1);
  ambulo__pairs_free(&own, &p);
  d.collision.mode = AMBULO_COLLISION_OFF;
  assert_int_equal(ambulo__pairs_create(&d, &own, &p), AMBULO_OK);
  assert_int_equal(p.kept_count + p.left_count + p.too_far, 0);
}

/* shanks 0.17 m apart, of 0.05 m each; thighs of 0.07 */
static void gaps_as_the_body_stands(void **state) {
  (void)state;
  ambulo_capsule_pair pair = {find_capsule(model, "shank_l"), find_capsule(model, "shank_r")};
  double gap = 0.0;
  assert_int_equal(ambulo__rest_gap(model, pair, &own, &gap), AMBULO_OK);
  assert_close(gap, 0.07, 1e-4);
  pair.one = find_capsule(model, "thigh_l");
  pair.other = find_capsule(model, "thigh_r");
  assert_int_equal(ambulo__rest_gap(model, pair, &own, &gap), AMBULO_OK);
  assert_close(gap, 0.03, 1e-4);
  pair.one = find_capsule(model, "trunk");
  assert_int_equal(ambulo__rest_gap(model, pair, &own, &gap), AMBULO_OK);
  assert_true(gap < 0.0);
}

/* named, the pairs that were found are those that are kept, in the same order */
static void found_pairs_may_be_named(void **state) {
  (void)state;
  ambulo_problem_definition d = definition_of(AMBULO_COLLISION_AUTOMATIC);
  ambulo__pairs found, named;
  d.ends = AMBULO_ENDS_MIRRORED;
  d.collision.margin = 0.02;
  assert_int_equal(ambulo__pairs_create(&d, &own, &found), AMBULO_OK);
  d.collision.mode = AMBULO_COLLISION_PAIRS;
  d.collision.pairs = found.kept;
  d.collision.pair_count = found.kept_count;
  assert_int_equal(ambulo__pairs_create(&d, &own, &named), AMBULO_OK);
  assert_true(found.kept_count > 4);
  assert_int_equal(found.kept_count, named.kept_count);
  assert_memory_equal(found.kept, named.kept, (size_t)found.kept_count * sizeof *found.kept);
  ambulo__pairs_free(&own, &found);
  ambulo__pairs_free(&own, &named);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(automatic_is_what_can_meet),
                                     cmocka_unit_test(found_pairs_may_be_named),
                                     cmocka_unit_test(ranges_count_where_they_are_rows),
                                     cmocka_unit_test(named_pairs_are_those_and_their_images),
                                     cmocka_unit_test(gaps_as_the_body_stands)};
  return cmocka_run_group_tests(tests, open_model, close_model);
}
