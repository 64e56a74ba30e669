/* Which column stands for a coordinate, and that two that disagree are never chosen between. */
#include "formats/motion_columns.h"
#include "support/messages.h"
#include "support/motion_text.h"

static ambulo__motion *table(const char *text) {
  ambulo__motion *motion = NULL;
  assert_int_equal(
      motion_read_text(text, strlen(text), "m.csv", AMBULO__MOTION_CSV, NULL, NULL, &motion),
      AMBULO_OK);
  return motion;
}

static int find(const ambulo__motion *motion, const char *name, ambulo__motion_order order) {
  int column = -2;
  assert_int_equal(ambulo__motion_find(motion, "m.csv", name, order, NULL, &column), AMBULO_OK);
  return column;
}

static void every_spelling_is_known(void **state) {
  (void)state;
  static const char *const spellings[3][4] = {
      {"th", "q.th", "/jointset/x/th/value", "/jointset/x/th"},
      {"qd.th", "th_u", "/jointset/x/th/speed", "x/th/speed"},
      {"qdd.th", "/jointset/x/th/accel", "/jointset/x/th/acceleration", "x/th/accel"}};
  for (int order = 0; order < 3; order++) {
    for (int i = 0; i < 4; i++) {
      char text[128];
      snprintf(text, sizeof text, "time,other,%s\n0,1,2\n", spellings[order][i]);
      ambulo__motion *motion = table(text);
      for (int asked = 0; asked < 3; asked++)
        assert_int_equal(find(motion, "th", (ambulo__motion_order)asked), asked == order ? 1 : -1);
      assert_int_equal(find(motion, "h", AMBULO__ORDER_VALUE), -1);
      assert_int_equal(find(motion, "", AMBULO__ORDER_VALUE), -1);
      ambulo__motion_free(motion);
    }
  }
}

static void what_only_resembles_is_left(void **state) {
  (void)state;
  ambulo__motion *motion =
      table("time,/forceset/th,/forceset/th/value,tau.th,xth,q.xth,/a/xth/value,"
            "th/value/more,q.th.x,qd.thx\n0,1,2,3,4,5,6,7,8,9\n");
  for (int order = 0; order < 3; order++)
    assert_int_equal(find(motion, "th", (ambulo__motion_order)order), -1);
  ambulo__motion_free(motion);
}

static void refused(const char *header, ambulo__motion_order order, const char *message) {
  char text[128];
  snprintf(text, sizeof text, "time,%s\n0,1,1\n0.5,2,3\n", header);
  ambulo__motion *motion = table(text);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  int column = -2;
  assert_int_equal(ambulo__motion_find(motion, "m.csv", "th", order, list, &column),
                   AMBULO_E_SCHEMA);
  assert_int_equal(column, -2);
  assert_message(list, 0, message);
  assert_message(list, 0, "differ (2 and 3 at t = 0.5 s)");
  ambulo_diagnostics_free(list);
  ambulo__motion_free(motion);
}

static void columns_that_disagree_are_refused(void **state) {
  (void)state;
  refused("th,q.th", AMBULO__ORDER_VALUE, "'th' and 'q.th' both stand for coordinate 'th'");
  refused("/jointset/x/th/value,/jointset/y/th/value", AMBULO__ORDER_VALUE,
          "'/jointset/x/th/value' and '/jointset/y/th/value'");
  refused("qd.th,th_u", AMBULO__ORDER_RATE, "'qd.th' and 'th_u'");
  refused("qdd.th,/x/th/accel", AMBULO__ORDER_ACCELERATION, "'qdd.th' and '/x/th/accel'");
  ambulo__motion *motion = table("time,th,q.th\n0,1,1\n0.5,2,2\n");
  assert_int_equal(find(motion, "th", AMBULO__ORDER_VALUE), 0);
  ambulo__motion_free(motion);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(every_spelling_is_known),
                                     cmocka_unit_test(what_only_resembles_is_left),
                                     cmocka_unit_test(columns_that_disagree_are_refused)};
  return cmocka_run_group_tests_name("format/motion_columns", tests, NULL, NULL);
}
