/* Tasks whose answer is known: a body that follows itself, one that is smaller by a factor, and the
 * folder with its problem. */
#include "retarget/retargeting.h"

#include "model/model.h"
#include "support/fail_alloc.h"
#include "support/given_motion.h"
#include "support/messages.h"
#include "support/scratch.h"

static ambulo__given squat_of(void **state, const person *p) {
  const char *path = scratch_path(state, "squat.csv");
  ambulo_retarget_options options = ambulo_retarget_options_default();
  ambulo__given given;
  write_squat(path, 41);
  options.body = p->model;
  assert_int_equal(ambulo__given_read(path, &options, NULL, NULL, &given), AMBULO_OK);
  return given;
}

/* angles are the person's; feet stand all the time where they stood */
static void itself(void **state) {
  person one = person_open(person_file, 0.0), other = person_open(person_file, 0.0);
  ambulo__given given = squat_of(state, &one);
  ambulo__retargeting r;
  assert_int_equal(ambulo__retargeting_make(&given, &one.figure, &other.figure,
                                            AMBULO_TIMES_NOT_SET, 0.0, NULL, &r),
                   AMBULO_OK);
  assert_close(r.ratio, 1.0, 1e-12);
  assert_close(r.time_ratio, 1.0, 1e-12);
  assert_int_equal(r.repeats, 0);
  assert_int_equal(r.flights, 0);
  assert_int_equal(r.footing.count, 2);
  for (int i = 0; i < 2; i++) {
    assert_int_equal(r.footing.stance[i].phases, 1);
    assert_int_equal(r.footing.stance[i].phase[0].tread, AMBULO__ON_SOLE);
    assert_close(r.footing.stance[i].phase[0].to, 2.0, 1e-12);
  }
  static const char *const same[] = {"hip_flexion_r", "knee_angle_l", "ankle_angle_r",
                                     "lumbar_extension", "arm_flex_r"};
  int d = one.model->coordinate_count;
  for (size_t i = 0; i < sizeof same / sizeof *same; i++) {
    int c = ambulo_model_find_coordinate(one.model, same[i]);
    for (int k = 0; k < r.rows; k++) assert_close(r.q[k * d + c], given.q[k * d + c], 1e-6);
  }
  /* the knees bend, so the pelvis comes down by what the legs are shorter */
  int height = ambulo_model_find_coordinate(one.model, "pelvis_ty");
  double bend = acos(-1.0) / 6.0;
  assert_close(r.q[20 * d + height] - r.q[height], -2.0 * 0.42 * (1.0 - cos(bend)), 0.02);
  ambulo__retargeting_free(&r);
  ambulo__given_free(&given);
  person_close(&one);
  person_close(&other);
}

/* a body of 0.8 times the size: lengths so much, times the root of it, or kept */
static void smaller(void **state) {
  person one = person_open(person_file, 1.75), other = person_open(person_file, 1.4);
  ambulo__given given = squat_of(state, &one);
  ambulo__retargeting r;
  static const ambulo_times times[] = {AMBULO_TIMES_SCALED, AMBULO_TIMES_KEPT,
                                       AMBULO_TIMES_NOT_SET};
  for (int i = 0; i < 3; i++) {
    int keep = i > 0; /* it does not fly */
    assert_int_equal(
        ambulo__retargeting_make(&given, &one.figure, &other.figure, times[i], 0.0, NULL, &r),
        AMBULO_OK);
    assert_close(r.ratio, 0.8, 1e-9);
    assert_close(r.time_ratio, keep ? 1.0 : sqrt(0.8), 1e-9);
    assert_close(r.time[r.rows - 1], 2.0 * r.time_ratio, 1e-9);
    for (int k = 0; k < 2; k++) {
      int side = r.footing.stance[k].side;
      assert_close(fabs(r.footing.stance[k].ankle[1]), fabs(other.figure.aside[side]), 0.01);
    }
    ambulo__retargeting_free(&r);
  }
  ambulo__given_free(&given);
  person_close(&one);
  person_close(&other);
}

/* with a belt that takes the feet back, standing is going: no foot stands */
static void belt(void **state) {
  person one = person_open(person_file, 0.0), other = person_open(person_file, 0.0);
  ambulo__given given = squat_of(state, &one);
  ambulo_diagnostics *messages = ambulo_diagnostics_create(NULL);
  ambulo__retargeting r;
  assert_int_equal(ambulo__retargeting_make(&given, &one.figure, &other.figure,
                                            AMBULO_TIMES_NOT_SET, 2.0, messages, &r),
                   AMBULO_E_SCHEMA);
  assert_message(messages, 0, "it never stands");
  ambulo_diagnostics_free(messages);
  ambulo__given_free(&given);
  person_close(&one);
  person_close(&other);
}

static void memory_may_run_out_anywhere(void **state) {
  person one = person_open(person_file, 0.0), other = person_open(person_file, 0.0);
  ambulo__given given = squat_of(state, &one);
  for (long k = 0; k < 100; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo__given failing = given;
    ambulo__retargeting r;
    failing.allocator = fail_alloc_hook(&memory);
    ambulo_status status = ambulo__retargeting_make(&failing, &one.figure, &other.figure,
                                                    AMBULO_TIMES_NOT_SET, 0.0, NULL, &r);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    if (!status) ambulo__retargeting_free(&r);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  ambulo__given_free(&given);
  person_close(&one);
  person_close(&other);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(itself), cmocka_unit_test(smaller),
                                     cmocka_unit_test(belt),
                                     cmocka_unit_test(memory_may_run_out_anywhere)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
