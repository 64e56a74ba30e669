/* Efforts of devices, scaled one by one; none where the scale is 0. */
#include "form_fixture.h"

enum { DEVICES = 3, EFFORT_CHANNELS = 4 * 2 + 6 + 3 * 2 + DEVICES };

static void efforts_times_their_scale(void **state) {
  (void)state;
  static const double scale[DEVICES] = {0.5, 0.0, 2.0};
  double lanes[EFFORT_CHANNELS * AMBULO__LANES];
  ambulo_model *model = arm_create();
  ambulo_term term = ambulo_term_default(AMBULO_DEVICE_EFFORT);
  for (int i = 0; i < EFFORT_CHANNELS * AMBULO__LANES; i++) lanes[i] = sin(1.7 * i);
  const ambulo__term_context context = {
      .model = model,
      .channels = {.coordinates = 2, .points = 2, .devices = DEVICES},
      .channel_count = EFFORT_CHANNELS,
      .lanes = lanes,
      .nodes = FORM_NODES};
  assert_int_equal(ambulo__channel_count(&context.channels), EFFORT_CHANNELS);
  assert_string_equal(ambulo__term_info_of(term.kind)->name, "device_effort");
  for (int scaled = 0; scaled < 2; scaled++) {
    term.device_scale = scaled ? scale : NULL;
    assert_int_equal(ambulo__term_forms(&term, &context, 1), DEVICES);
    for (int i = 0; i < DEVICES; i++) {
      double factor = scaled ? scale[i] : 1.0;
      int channel = EFFORT_CHANNELS - DEVICES + i;
      ambulo__form form;
      ambulo__term_form(&term, &context, 1, i, &form);
      assert_int_equal(form.count, factor != 0.0);
      assert_close(form.u, factor * lanes[channel * AMBULO__LANES + 1], 1e-15);
      if (!form.count) continue;
      assert_int_equal(form.channel[0], channel);
      assert_int_equal(form.ahead[0], 0);
      assert_close(form.slope[0], factor, 0.0);
    }
  }
  ambulo_model_free(model);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(efforts_times_their_scale)};
  return cmocka_run_group_tests_name("objective/device_effort", tests, NULL, NULL);
}
