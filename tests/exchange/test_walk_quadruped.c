/* Walks, trots and bounds on four legs: contacts follow from the gait, and the text is a problem.
 */
#include "support/walk_case.h"

#include <math.h>

static import_case quadruped(void) {
  static const char *const pose[] = {"front_left_knee=-1.4",     "front_right_knee=-1.4",
                                     "hind_left_knee=-1.4",      "hind_right_knee=-1.4",
                                     "front_left_hip_pitch=0.7", "front_right_hip_pitch=0.7",
                                     "hind_left_hip_pitch=0.7",  "hind_right_hip_pitch=0.7"};
  ambulo_import_options options = ambulo_import_options_default();
  options.pose = pose;
  options.pose_count = 8;
  return import_file("tests/users/quadruped.urdf", &options);
}

static void print(import_case *c, const char *gait, int symmetric, ambulo__walker *w,
                  ambulo__text_buffer *text) {
  assert_int_equal(ambulo__walker_measure(c->model, NULL, NULL, w), AMBULO_OK);
  w->file = "quadruped.yaml";
  w->symmetric = symmetric;
  ambulo__text_init(text, NULL);
  ambulo__walk_of_quadruped(w, gait, text);
  assert_int_equal(ambulo__text_status(text), AMBULO_OK);
}

static int count_of(const char *text, const char *what) {
  int count = 0;
  for (const char *at = strstr(text, what); at; at = strstr(at + 1, what)) count++;
  return count;
}

/* front before hind, left before right; feet that are one point */
static void four_feet_are_told_apart(void **state) {
  (void)state;
  static const char *const names[] = {"fl", "fr", "hl", "hr"};
  import_case c = quadruped();
  ambulo__walker w;
  assert_int_equal(ambulo__walker_measure(c.model, NULL, NULL, &w), AMBULO_OK);
  assert_int_equal(w.feet, 4);
  assert_int_equal(w.symmetric, 1);
  for (int i = 0; i < 4; i++) {
    const ambulo_foot *foot = ambulo_model_foot(c.model, w.foot[i]);
    assert_string_equal(foot->name, names[i]);
    assert_int_equal(foot->heel_center, foot->toe_center);
    assert_true((w.at[i][0] > 0.0) == (i < 2));
    assert_true((w.at[i][1] > 0.0) == (i % 2 == 0));
  }
  assert_close(w.leg, 0.2 + 0.2 * cos(0.7) + 0.02, 1e-6); /* thigh, shank and ball upward */
  ambulo__walker_free(&w);
  import_shut(&c);
}

/* half a trot: two feet all the time, the other two for the 10 % of a stride in which pairs change,
 * where the image of their partners, half a stride before, left them */
static void pairs_of_a_trot_change(void **state) {
  (void)state;
  import_case c = quadruped();
  ambulo__walker w;
  ambulo__text_buffer text;
  print(&c, "trot", 1, &w, &text);
  const char *t = ambulo__text_data(&text);
  double half = walk_value(t, "duration: "), travel = walk_value(t, "travel: ");
  assert_int_equal(count_of(t, "{foot: "), 4);
  assert_non_null(strstr(t, "kind: mirrored"));
  assert_close(walk_value(t, "{foot: fl, mode: flat, from: 0, to: ") / half, 1.0, 1e-8);
  assert_close(walk_value(t, "{foot: fr, mode: flat, from: 0, to: ") / half, 0.2, 1e-8);
  const char *left = strstr(strstr(t, "foot: fl"), "place"),
             *right = strstr(strstr(t, "foot: fr"), "place");
  assert_close(walk_value(left, "place: [") - walk_value(right, "place: ["), travel, 1e-8);
  ambulo__text_free(&text);
  ambulo__walker_free(&w);
  import_shut(&c);
}

/* sides that differ, and bounds, take a whole stride */
static void whole_strides(void **state) {
  (void)state;
  import_case c = quadruped();
  static const struct {
    const char *gait;
    int symmetric, contacts;
  } cases[] = {{"trot", 0, 6}, {"bound", 1, 4}, {"walk", 0, 7}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    ambulo__walker w;
    ambulo__text_buffer text;
    print(&c, cases[i].gait, cases[i].symmetric, &w, &text);
    assert_int_equal(count_of(ambulo__text_data(&text), "{foot: "), cases[i].contacts);
    assert_non_null(strstr(ambulo__text_data(&text), "kind: periodic"));
    ambulo__text_free(&text);
    ambulo__walker_free(&w);
  }
  import_shut(&c);
}

static void gaits_have_names(void **state) {
  (void)state;
  assert_true(ambulo__is_gait_of_four("trot"));
  assert_false(ambulo__is_gait_of_four("gallop"));
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(four_feet_are_told_apart), cmocka_unit_test(pairs_of_a_trot_change),
      cmocka_unit_test(whole_strides), cmocka_unit_test(gaits_have_names)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
