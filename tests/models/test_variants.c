/* Shipped walks that say that everything else is as in another: with what they name put back they
 * are that other one, to the last number. */
#include "ambulo/tools/tools.h"
#include "support/shared_data.h"
#include "support/test.h"

enum { MOST_SETTINGS = 9 };

static unsigned long long hash_of(const char *name, const char *const *settings, int count) {
  char path[512];
  ambulo_problem *problem = NULL;
  (void)snprintf(path, sizeof path, "%s/models/%s.yaml", AMBULO_SOURCE_DIR, name);
  assert_int_equal(ambulo_problem_load(path, settings, count, NULL, NULL, &problem), AMBULO_OK);
  unsigned long long hash = ambulo_problem_hash(problem);
  ambulo_problem_free(problem);
  return hash;
}

typedef struct variant {
  const char *name, *of;
  const char *put_back[MOST_SETTINGS]; /* up to the first NULL */
} variant;

static const variant variants[] = {
    {"walk_ankle_exoskeleton", "walk", {"devices=null", "gait.speed=1.28"}},
    {"walk_knee_brace",
     "walk",
     {"devices=null", "gait.steps=1", "ends.kind=mirrored", "time.intervals=96",
      "trajectory.intervals=14"}},
    {"walk_backpack", "walk", {"load=null"}},
    {"walk_exotendon", "walk", {"devices=null", "free=null", "gait.step_time=null"}},
    {"walk_loaded", "walk_normal", {"load=null"}},
    {"walk_uphill",
     "walk_normal",
     {"ground=null", "gait.step_time=null", "gait.step_length=0.68", "time.duration=0.54",
      "time.intervals=80"}},
    {"walk_asymmetric",
     "walk_normal",
     {"gait.steps=1", "gait.step_length=0.68", "gait.step_time=null", "time.duration=0.54",
      "time.intervals=80", "trajectory.intervals=22", "ends.kind=mirrored"}},
    {"walk_carrying",
     "walk_whole_body",
     {"time.intervals=96", "trajectory.intervals=14", "load=null", "constraints.reach=null",
      "objective[arm_posture].angles.arm_flex_r=14", "objective[arm_posture].angles.arm_flex_l=14",
      "objective[arm_posture].angles.elbow_flex_r=22",
      "objective[arm_posture].angles.elbow_flex_l=22", "objective[arm_posture].weight=0.05"}},
};

static void the_rest_is_as_they_say(void **state) {
  (void)state;
  for (size_t i = 0; i < sizeof variants / sizeof *variants; i++) {
    const variant *v = &variants[i];
    int count = 0;
    while (count < MOST_SETTINGS && v->put_back[count]) count++;
    unsigned long long own = hash_of(v->name, v->put_back, count), other = hash_of(v->of, NULL, 0);
    if (own != other) print_error("%s differs otherwise, too, from %s\n", v->name, v->of);
    assert_true(own == other);
    assert_true(hash_of(v->name, NULL, 0) != other);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_rest_is_as_they_say)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
