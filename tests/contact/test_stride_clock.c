/* Where a foot is in its stride, in motions that repeat and in one that does not. */
#include "contact/stride_clock.h"

#include "support/planar_walker.h"
#include "support/test.h"

static ambulo_contact held(int foot, ambulo_contact_mode mode, double from, double to) {
  return (ambulo_contact){.foot = foot, .mode = mode, .from = from, .to = to, .patch = -1};
}

static ambulo_problem_definition walk_of(ambulo_model *model, ambulo_ends ends, double duration,
                                         const ambulo_contact *contacts, int count) {
  ambulo_problem_definition d = ambulo_problem_definition_default();
  d.model = model;
  d.duration = duration;
  d.ends = ends;
  d.contacts = contacts;
  d.contact_count = count;
  return d;
}

/* one step of 0.5 s: the left foot strikes at 0, the right did half a stride before */
static void test_a_mirrored_step(void **state) {
  (void)state;
  ambulo_model *model = walker_create();
  const ambulo_contact contacts[] = {held(1, AMBULO_CONTACT_HEEL, 0, 0.1),
                                     held(1, AMBULO_CONTACT_FLAT, 0.1, 0.5),
                                     held(0, AMBULO_CONTACT_TOE, 0, 0.12)};
  ambulo_problem_definition d = walk_of(model, AMBULO_ENDS_MIRRORED, 0.5, contacts, 3);
  ambulo__stride_now now;
  for (double t = 0; t < 0.5; t += 0.049) {
    assert_int_equal(ambulo__stride_at(&d, 1, t, &now), 1);
    assert_close(now.share, t, 1e-12);
    assert_close(now.begin[1], 1.0, 1e-12);
    assert_int_equal(now.contact[0], 0);
    assert_int_equal(now.contact[1], 0);
    assert_int_equal(ambulo__stride_at(&d, 0, t, &now), 1);
    assert_close(now.share, 0.5 + t, 1e-12);
    assert_close(now.begin[0], -0.5, 1e-12);
  }
  assert_int_equal(ambulo__stride_at(&d, 0, 0.5, &now), 1);
  assert_close(now.share, 0, 1e-12);
  ambulo_model_free(model);
}

static void test_two_unlike_steps(void **state) {
  (void)state;
  ambulo_model *model = walker_create();
  const ambulo_contact contacts[] = {held(0, AMBULO_CONTACT_FLAT, 0.3, 0.9),
                                     held(1, AMBULO_CONTACT_FLAT, 0, 0.4),
                                     held(1, AMBULO_CONTACT_FLAT, 0.8, 1)};
  ambulo_problem_definition d = walk_of(model, AMBULO_ENDS_PERIODIC, 1, contacts, 3);
  ambulo__stride_now now;
  assert_int_equal(ambulo__stride_at(&d, 0, 0.25, &now), 1);
  assert_close(now.share, 0.95, 1e-12);
  assert_int_equal(ambulo__stride_at(&d, 1, 0.25, &now), 1); /* came down at -0.2 */
  assert_close(now.share, 0.45, 1e-12);
  assert_int_equal(now.contact[0], 2);
  assert_int_equal(now.contact[1], 2);
  d.ends = AMBULO_ENDS_FREE;
  assert_int_equal(ambulo__stride_at(&d, 0, 0.5, &now), 0);
  ambulo_model_free(model);
}

static void test_a_foot_that_stays_down_has_no_stride(void **state) {
  (void)state;
  ambulo_model *model = walker_create();
  const ambulo_contact contact = held(0, AMBULO_CONTACT_FLAT, 0, 1);
  ambulo_problem_definition d = walk_of(model, AMBULO_ENDS_PERIODIC, 1, &contact, 1);
  ambulo__stride_now now;
  assert_int_equal(ambulo__stride_at(&d, 0, 0.5, &now), 0);
  assert_int_equal(ambulo__stride_at(&d, 1, 0.5, &now), 0);
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_a_mirrored_step),
                                     cmocka_unit_test(test_two_unlike_steps),
                                     cmocka_unit_test(test_a_foot_that_stays_down_has_no_stride)};
  return cmocka_run_group_tests_name("gait/stride_clock", tests, NULL, NULL);
}
