/* Turns and places of segments against what they are by definition. */
#include "support/given_motion.h"

static void turns_and_vectors(void **state) {
  (void)state;
  unsigned seed = 3;
  const double sizes[] = {0.0, 1e-12, 1e-3, 1.0, 3.0, 3.14159265358979 - 1e-12};
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
    double v[3] = {even(&seed), even(&seed), even(&seed)}, back[3];
    assert_true(ambulo__normalize(v) > 0.0);
    for (int k = 0; k < 3; k++) v[k] *= sizes[i];
    ambulo__rigid turn = ambulo__turn_of_vector(v);
    ambulo__turn_vector(&turn, back);
    ambulo__rigid again = ambulo__turn_of_vector(back);
    for (int r = 0; r < 3; r++)
      for (int c = 0; c < 3; c++) assert_close(again.r[r][c], turn.r[r][c], 1e-8);
  }
}

/* at q = 0 the shipped body stands upright: every segment is as it is when standing */
static void stands_upright(void **state) {
  (void)state;
  person p = person_open(person_file, 0.0);
  double *q = calloc((size_t)p.model->coordinate_count, sizeof *q);
  ambulo__posture posture;
  ambulo__rigid same = ambulo__rigid_identity();
  ambulo__figure_at(&p.figure, q, &posture);
  for (int s = 0; s < AMBULO__SEGMENTS; s++) assert_true(apart(&posture.turn[s], &same) < 0.2);
  for (int side = 0; side < 2; side++) {
    double hip = posture.ankle[side][2] - posture.heel[side][2];
    assert_true(hip > 0.05 && hip < 0.12);
    assert_true(posture.toe[side][0] > posture.heel[side][0] + 0.1);
  }
  assert_true(posture.heel[1][1] > 0.03 && posture.heel[0][1] < -0.03);
  assert_true(p.figure.leg > 0.8 && p.figure.leg < 1.0);
  free(q);
  person_close(&p);
}

/* heel and ball are where the model's points are, whatever the pose: within the few millimetres by
 * which the axes of the ankle miss each other */
static void soles_are_where_points_are(void **state) {
  (void)state;
  person p = person_open(person_file, 0.0);
  unsigned seed = 5;
  double *q = calloc((size_t)p.model->coordinate_count, sizeof *q);
  for (int pose = 0; pose < 20; pose++) {
    ambulo__posture posture;
    for (int c = 0; c < p.model->coordinate_count; c++) q[c] = 0.5 * even(&seed);
    ambulo__figure_at(&p.figure, q, &posture);
    for (int side = 0; side < 2; side++) {
      const ambulo_point *heel = &p.model->points[p.model->feet[p.figure.foot[side]].heel_center];
      double world[3], at[3], off = 0.0;
      ambulo__pose_point(&p.figure.pose, heel->link, heel->position, world);
      ambulo__rigid_vector(&p.figure.axes, world, at);
      for (int k = 0; k < 3; k++) off += pow(at[k] - posture.heel[side][k], 2);
      assert_true(sqrt(off) < 0.006);
    }
  }
  free(q);
  person_close(&p);
}

/* a turn about up of the whole body turns every segment by it */
static void headings(void **state) {
  (void)state;
  person p = person_open(person_file, 0.0);
  double *q = calloc((size_t)p.model->coordinate_count, sizeof *q);
  ambulo__posture posture;
  q[ambulo_model_find_coordinate(p.model, "pelvis_rotation")] = 0.7;
  ambulo__figure_at(&p.figure, q, &posture);
  assert_close(ambulo__heading_of(&posture.turn[AMBULO__PELVIS]), 0.7, 1e-12);
  assert_close(ambulo__heading_of(&posture.turn[AMBULO__FOOT]), 0.7, 0.1);
  free(q);
  person_close(&p);
}

static void memory_may_run_out(void **state) {
  (void)state;
  person p = person_open(person_file, 0.0);
  ambulo__figure other = {.model = NULL};
  ambulo__segment_map none = {.slides = 0};
  assert_int_equal(ambulo__figure_create(p.model, &none, "body", NULL, NULL, &other),
                   AMBULO_E_MODEL);
  ambulo__figure_free(&other);
  person_close(&p);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(turns_and_vectors), cmocka_unit_test(stands_upright),
      cmocka_unit_test(soles_are_where_points_are), cmocka_unit_test(headings),
      cmocka_unit_test(memory_may_run_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
