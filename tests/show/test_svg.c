/* SVG elements: escapes, rounding, axis steps. */
#include "show/svg.h"
#include "support/test.h"
#include "support/wellformed.h"

static void test_elements(void **state) {
  (void)state;
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__svg_begin(&text, 100.0, 50.0, 0.0, "a & <b>");
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

static int test_svg_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_elements),
                                     cmocka_unit_test(test_nice_steps),
                                     cmocka_unit_test(test_labels)};
  return cmocka_run_group_tests_name("picture/svg", tests, NULL, NULL);
}

/* Labels in the room there is: smaller, then cut by whole signs. */

static void expect(double room, const char *label, const char *want) {
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__svg_label_within(&text, "t", 0.0, 0.0, room, 10.0, label);
  if (strcmp(ambulo__text_data(&text), want) != 0) print_error("%s", ambulo__text_data(&text));
  assert_string_equal(ambulo__text_data(&text), want);
  assert_true(is_xml(ambulo__text_data(&text)));
  ambulo__text_free(&text);
}

/* a letter is 5.8 px wide at 10 px */
static void test_room(void **state) {
  (void)state;
  expect(58.0, "ten&signs!", "<text class=\"t\" x=\"0\" y=\"0\">ten&amp;signs!</text>\n");
  expect(46.4, "ten<signs!",
         "<text class=\"t\" x=\"0\" y=\"0\" style=\"font-size:8px\">ten&lt;signs!</text>\n");
  expect(23.2, "ten signs!",
         "<text class=\"t\" x=\"0\" y=\"0\" style=\"font-size:7px\">ten\xe2\x80\xa6</text>\n");
  /* signs of several bytes stay whole; a combining mark takes no room */
  expect(11.6, "e\xcc\x81\xc3\xa9", "<text class=\"t\" x=\"0\" y=\"0\">e\xcc\x81\xc3\xa9</text>\n");
  expect(20.0, "\xe6\xad\xa9\xe8\xa1\x8c",
         "<text class=\"t\" x=\"0\" y=\"0\">\xe6\xad\xa9\xe8\xa1\x8c</text>\n");
  expect(14.0, "\xe6\xad\xa9\xe8\xa1\x8c\xe6\xad\xa9",
         "<text class=\"t\" x=\"0\" y=\"0\" "
         "style=\"font-size:7px\">\xe6\xad\xa9\xe2\x80\xa6</text>\n");
}

static int test_svg_fit_tests(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_room)};
  return cmocka_run_group_tests_name("picture/svg_fit", tests, NULL, NULL);
}

int main(void) {
  return test_svg_tests() + test_svg_fit_tests();
}
