/* A body that imitates itself stands as it does; another one turns its segments alike. */
#include "retarget/imitate.h"

#include "support/given_motion.h"

static void imitates(const char *file, double tolerance) {
  person one = person_open(person_file, 0.0), other = person_open(file, 0.0);
  unsigned seed = 11;
  double *q = calloc((size_t)one.model->coordinate_count, sizeof *q);
  double *found = calloc((size_t)other.model->coordinate_count, sizeof *found);
  for (int pose = 0; pose < 20; pose++) {
    ambulo__posture goal, got;
    double miss[AMBULO__SEGMENTS];
    for (int c = 0; c < one.model->coordinate_count; c++) q[c] = 0.4 * even(&seed);
    ambulo__figure_at(&one.figure, q, &goal);
    ambulo__imitate(&other.figure, &goal, found, miss);
    ambulo__figure_at(&other.figure, found, &got);
    for (int s = 0; s < AMBULO__SEGMENTS; s++) {
      if (other.figure.link[s] < 0) continue;
      double off = apart(&goal.turn[s], &got.turn[s]);
      /* arms are pulled toward the start pose */
      assert_true(off < (s < AMBULO__UPPER_ARM ? tolerance : 0.05));
      if (s < AMBULO__UPPER_ARM) assert_close(miss[s], off, 1e-7);
    }
  }
  free(q);
  free(found);
  person_close(&one);
  person_close(&other);
}

static void itself(void **state) {
  (void)state;
  imitates(person_file, 1e-7);
}

/* other shipped bodies have the same joints on other links */
static void another(void **state) {
  (void)state;
  imitates("models/whole_body_31.yaml", 1e-6);
}

/* what a joint cannot do is left over: a knee does not turn aside */
static void says_what_is_missed(void **state) {
  (void)state;
  person p = person_open(person_file, 0.0);
  double *q = calloc((size_t)p.model->coordinate_count, sizeof *q), miss[AMBULO__SEGMENTS];
  static const double forward[3] = {1.0, 0.0, 0.0};
  ambulo__posture goal;
  ambulo__figure_at(&p.figure, q, &goal);
  ambulo__rigid aside = ambulo__rigid_turn(forward, 0.3);
  goal.turn[AMBULO__SHANK] = ambulo__rigid_times(&aside, &goal.turn[AMBULO__SHANK]);
  ambulo__imitate(&p.figure, &goal, q, miss);
  assert_close(miss[AMBULO__SHANK], 0.3, 0.01);
  assert_true(miss[AMBULO__THIGH] < 1e-6);
  free(q);
  person_close(&p);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(itself), cmocka_unit_test(another),
                                     cmocka_unit_test(says_what_is_missed)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
