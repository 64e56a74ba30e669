/* Text for XML, and OpenSim's angles back to the rotation they are of. */
#include "exchange/export.h"

#include "exchange/rigid.h"
#include "support/random_model.h"
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

/* also where the middle angle is a right one, or nearly */
static void angles(void **state) {
  (void)state;
  static const double near[] = {0, 1e-17, 1e-15, 1e-13, 1e-10, 1e-8, 1e-5, 0.3};
  random_source source = {3};
  const double none[3] = {0, 0, 0};
  for (int i = 0; i < 2000; i++) {
    double given[3], found[3];
    for (int k = 0; k < 3; k++) given[k] = random_between(&source, -4, 4);
    int right = i % 4;
    if (right) given[1] = (right == 1 ? -1 : 1) * (acos(0) - near[(i / 4) % 8]);
    ambulo__rigid a = ambulo__rigid_of_xyz(none, given);
    ambulo__xyz_of_rotation((const double(*)[3])a.r, found);
    ambulo__rigid b = ambulo__rigid_of_xyz(none, found);
    for (int r = 0; r < 3; r++)
      for (int c = 0; c < 3; c++) assert_close(b.r[r][c], a.r[r][c], 2e-15);
    assert_true(fabs(found[1]) <= acos(0));
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(entities), cmocka_unit_test(angles)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
