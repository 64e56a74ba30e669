/* Labels in the room there is: smaller, then cut by whole signs. */
#include "show/svg.h"
#include "support/test.h"
#include "support/wellformed.h"

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

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_room)};
  return cmocka_run_group_tests_name("picture/svg_fit", tests, NULL, NULL);
}
