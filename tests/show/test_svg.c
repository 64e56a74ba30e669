/* SVG elements: escapes, rounding, axis steps. */
#include "show/svg.h"
#include "support/test.h"
#include "support/wellformed.h"

static void test_elements(void **state) {
  (void)state;
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__svg_begin(&text, 100.0, 50.0, "a & <b>");
  ambulo__svg_group_begin(&text, "g");
  ambulo__svg_line(&text, "l", 0.123456, -1e-9, 1.0 / 3.0, 2.0);
  ambulo__svg_path_begin(&text, "p");
  ambulo__svg_path_move(&text, 1.0, 2.0);
  ambulo__svg_path_line(&text, 3.5, 4.25);
  ambulo__svg_path_end(&text);
  ambulo__svg_label(&text, "t", 1.0, 2.0, "\"x\" < y\x01");
  ambulo__svg_circle(&text, "c", 1.0, 2.0, 3.0);
  ambulo__svg_group_end(&text);
  ambulo__svg_end(&text);
  const char *svg = ambulo__text_data(&text);
  assert_true(is_xml(svg));
  assert_non_null(strstr(svg, "<title>a &amp; &lt;b&gt;</title>"));
  assert_non_null(strstr(svg, "x1=\"0.12\" y1=\"0\" x2=\"0.33\" y2=\"2\""));
  assert_non_null(strstr(svg, "d=\"M1 2L3.5 4.25\""));
  assert_non_null(strstr(svg, ">&quot;x&quot; &lt; y<"));
  ambulo__text_free(&text);
}

static void test_nice_steps(void **state) {
  (void)state;
  static const struct {
    double range;
    int parts;
    double step;
    int decimals;
  } cases[] = {{1.1, 9, 0.2, 1},      {10.0, 4, 2.5, 1}, {60.0, 4, 20.0, 0}, {0.9, 9, 0.1, 1},
               {2000.0, 4, 500.0, 0}, {0.0, 4, 1.0, 0},  {0.07, 4, 0.02, 2}, {9.9, 1, 10.0, 0}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    int decimals = -1;
    double step = ambulo__nice_step(cases[i].range, cases[i].parts, &decimals);
    if (decimals != cases[i].decimals)
      print_error("range %g: step %g with %d decimals\n", cases[i].range, step, decimals);
    assert_close(step, cases[i].step, 1e-12);
    assert_int_equal(decimals, cases[i].decimals);
  }
}

static void label(double value, int decimals, const char *expected) {
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__label_number(&text, value, decimals);
  assert_string_equal(ambulo__text_data(&text), expected);
  ambulo__text_free(&text);
}

static void test_labels(void **state) {
  (void)state;
  label(0.1 + 0.2, 1, "0.3");
  label(-20.0, 0,
        "\xe2\x88\x92"
        "20");
  label(-0.0001, 2, "0");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_elements),
                                     cmocka_unit_test(test_nice_steps),
                                     cmocka_unit_test(test_labels)};
  return cmocka_run_group_tests_name("picture/svg", tests, NULL, NULL);
}
