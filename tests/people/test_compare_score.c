/* Scores of curves with known answers, and landmarks of made-up curves. */
#include "people/compare_score.h"
#include "ambulo/tools/compare.h"
#include "support/test.h"

static const ambulo__map_entry entry = {"c", "c", "q.c", 1, 0, 0, AMBULO__UNIT_ANGLE};

static void known_numbers(void **state) {
  (void)state;
  double percent[4] = {0, 25, 50, 100}, mean[4] = {1, 2, 3, 2}, sd[4] = {1, 1, 1, 1};
  double values[4] = {2, 1, 6, 2}, fine[AMBULO__FINE] = {0};
  fine[33] = 6.5;
  ambulo__reference_curve curve = {&entry, 4, percent, mean, sd};
  ambulo_curve_score score;
  ambulo__score_curve(&curve, values, fine, &score);
  assert_int_equal(score.points, 4);
  assert_close(score.rmse, sqrt(11.0 / 4.0), 1e-15);
  /* deviations (-0.75, -1.75, 3.25, -0.75) and (-1, 0, 1, 0): 4 / sqrt(14.75 2) */
  assert_close(score.r, 4.0 / sqrt(29.5), 1e-15);
  assert_close(score.within_2sd, 0.75, 0.0);
  assert_close(score.peak, 6.5, 0.0);
  assert_close(score.peak_time, 16.5, 0.0);
  assert_close(score.reference_peak, 3.0, 0.0);
  assert_close(score.reference_peak_time, 50.0, 0.0);
}

static void what_does_not_exist_is_nan(void **state) {
  (void)state;
  double percent[3] = {0, 50, 100}, mean[3] = {1, 2, 1}, values[3] = {4, 4, 4};
  double fine[AMBULO__FINE] = {0};
  ambulo__reference_curve curve = {&entry, 3, percent, mean, NULL};
  ambulo_curve_score score;
  ambulo__score_curve(&curve, values, fine, &score);
  assert_true(isnan(score.r));
  assert_true(isnan(score.within_2sd));
}

static const ambulo_landmark *find(const ambulo_landmark *landmarks, int count, const char *name) {
  for (int i = 0; i < count; i++) {
    if (strcmp(landmarks[i].name, name) == 0) return &landmarks[i];
  }
  print_error("no landmark %s\n", name);
  fail();
  return NULL;
}

static void landmarks_stand_where_they_should(void **state) {
  (void)state;
  double fine[AMBULO__FINE] = {0};
  ambulo_landmark found[AMBULO__MAX_LANDMARKS];
  int count = 0;
  fine[0] = 4.0;
  fine[30] = 18.0;  /* 15 % */
  fine[90] = 99.0;  /* 45 %: neither loading nor swing */
  fine[147] = 60.0; /* 73.5 % */
  ambulo__knee_landmarks(fine, found, &count);
  assert_close(find(found, count, "knee at strike")->value, 4.0, 0.0);
  assert_close(find(found, count, "knee loading peak")->value, 18.0, 0.0);
  assert_close(find(found, count, "knee swing peak")->value, 60.0, 0.0);
  assert_close(find(found, count, "knee swing peak")->time, 73.5, 0.0);
  fine[124] = -20.0; /* 62 % */
  fine[190] = -50.0; /* 95 % */
  ambulo__ankle_landmarks(fine, found, &count);
  assert_close(find(found, count, "ankle dorsiflexion")->time, 45.0, 0.0);
  assert_close(find(found, count, "ankle push-off")->value, -20.0, 0.0);
  ambulo__forward_landmarks(fine, found, &count);
  assert_close(find(found, count, "forward force smallest")->time, 95.0, 0.0);
  assert_close(find(found, count, "forward force largest")->value, 99.0, 0.0);
}

/* f = 10 + p^2 / 100 N/kg for p percent: the second difference over 2 percent is 8 / 100 */
static void vertical_force_in_body_weights(void **state) {
  (void)state;
  double fine[AMBULO__FINE];
  ambulo_landmark found[AMBULO__MAX_LANDMARKS];
  int count = 0;
  for (int i = 0; i < AMBULO__FINE; i++) fine[i] = 10.0 + 0.25e-2 * i * i;
  ambulo__vertical_landmarks(fine, 10.0, found, &count);
  assert_close(find(found, count, "vertical force roughness")->value, 8e-3, 1e-12);
  assert_true(isnan(find(found, count, "vertical force roughness")->time));
  fine[24] = 30.0;
  fine[60] = 7.0;
  fine[100] = 60.0;
  count = 0;
  ambulo__vertical_landmarks(fine, 10.0, found, &count);
  assert_close(find(found, count, "vertical force first peak")->value, 3.0, 1e-15);
  assert_close(find(found, count, "vertical force first peak")->time, 12.0, 0.0);
  assert_close(find(found, count, "vertical force valley")->value, 0.7, 1e-15);
  assert_close(find(found, count, "vertical force second peak")->time, 50.0, 0.0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(known_numbers),
                                     cmocka_unit_test(what_does_not_exist_is_nan),
                                     cmocka_unit_test(landmarks_stand_where_they_should),
                                     cmocka_unit_test(vertical_force_in_body_weights)};
  return cmocka_run_group_tests_name("compare/compare_score", tests, NULL, NULL);
}
