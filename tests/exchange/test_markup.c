/* Texts and numbers of XML. */
#include "exchange/export.h"
#include "support/test.h"

static void entities(void **state) {
  (void)state;
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__markup_text(&text, "<x>", "a<b & \"c\">", "</x>");
  assert_string_equal(ambulo__text_data(&text), "<x>a&lt;b &amp; &quot;c&quot;&gt;</x>");
  ambulo__text_clear(&text);
  ambulo__markup_element(&text, 2, "axis", (double[]){-0.0, 0.1, 1e-300}, 3);
  assert_string_equal(ambulo__text_data(&text), "\t\t<axis>0 0.1 1e-300</axis>\n");
  ambulo__text_free(&text);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(entities)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
