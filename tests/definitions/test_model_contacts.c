#include "support/model_text.h"

#define POINTS                                                                                     \
  "points:\n"                                                                                      \
  "  - {name: h1, link: rod, position: [0, 1, 2]}\n"                                               \
  "  - {name: h2, link: rod, position: [0, 1, 3]}\n"                                               \
  "  - {name: t1, link: rod, position: [1, 1, 2]}\n"                                               \
  "  - {name: t2, link: rod, position: [1, 1, 3]}\n"                                               \
  "  - {name: hc, link: rod, position: [0, 1, 2.5]}\n"                                             \
  "  - {name: tc, link: rod, position: [1, 1, 2.5]}\n"

static void spatial_feet(void **state) {
  (void)state;
  model_case c = model_good(MODEL_HEAD MODEL_ROD POINTS
                            "feet:\n"
                            "  - {name: right, heel: [h1, h2], toe: [t1, t2], heel_center: hc,\n"
                            "     toe_center: tc, mirror: left}\n"
                            "  - {name: left, heel: [h2, h1], toe: [t2, t1], heel_center: hc,\n"
                            "     toe_center: tc, mirror: right}\n");
  const ambulo_foot *foot = ambulo_model_foot(c.model, 0);
  assert_close(ambulo_model_point(c.model, 1)->position[2], 3, 0);
  assert_int_equal(foot->heel[0], 0);
  assert_int_equal(foot->heel[1], 1);
  assert_int_equal(foot->toe[0], 2);
  assert_int_equal(foot->toe[1], 3);
  assert_int_equal(foot->heel_center, 4);
  assert_int_equal(foot->toe_center, 5);
  assert_int_equal(foot->mirror, 1);
  assert_int_equal(ambulo_model_foot(c.model, 1)->mirror, 0);
  model_shut(&c);
}

static void planar_foot(void **state) {
  (void)state;
  model_case c =
      model_good(MODEL_HEAD MODEL_ROD POINTS "feet:\n  - {name: foot, heel: [h1], toe: [t1]}\n");
  const ambulo_foot *foot = ambulo_model_foot(c.model, 0);
  assert_int_equal(foot->heel[1], -1);
  assert_int_equal(foot->toe[1], -1);
  assert_int_equal(foot->heel_center, 0);
  assert_int_equal(foot->toe_center, 2);
  assert_int_equal(foot->mirror, 0);
  model_shut(&c);
}

#define FOOT(text) MODEL_HEAD MODEL_ROD POINTS "feet:\n  - {name: foot, " text "}\n"

static void faults(void **state) {
  (void)state;
  model_bad(MODEL_HEAD MODEL_ROD "points:\n  - {name: tip, link: rood, position: [0, 0, 0]}\n",
            AMBULO_E_MODEL,
            "t.yaml:7:23: error[E_MODEL]: unknown link (got 'rood'); expected the name of a link "
            "of this model\n  hint: did you mean 'rod'?");
  model_bad(MODEL_HEAD MODEL_ROD "points:\n  - {name: tip, link: rod, position: [0, 0]}\n",
            AMBULO_E_SCHEMA, "t.yaml:7:38: error[E_SCHEMA]: got a sequence of 2");
  model_bad(FOOT("heel: [h1], toe: [t3]"), AMBULO_E_MODEL,
            "t.yaml:14:36: error[E_MODEL]: unknown point (got 't3'); expected the name of a point");
  model_bad(FOOT("heel: [], toe: [t1]"), AMBULO_E_SCHEMA,
            "t.yaml:14:24: error[E_SCHEMA]: expected a list of one or two point names");
  model_bad(FOOT("heel: h1, toe: [t1]"), AMBULO_E_SCHEMA,
            "t.yaml:14:24: error[E_SCHEMA]: expected a list of one or two point names");
  model_bad(FOOT("heel: [h1, h2], toe: [t1, t2], heel_center: hc"), AMBULO_E_SCHEMA,
            "t.yaml:14:5: error[E_SCHEMA]: missing required key 'toe_center' in feet[0] ('foot')");
  model_bad(FOOT("heel: [h1], toe: [t1], mirror: fot"), AMBULO_E_MODEL,
            "t.yaml:14:49: error[E_MODEL]: unknown foot (got 'fot'); expected the name of a foot "
            "of this model\n  hint: did you mean 'foot'?");
  model_bad(FOOT("heel: [h1], toe: [h1], toe_center: hc"), AMBULO_E_MODEL,
            "t.yaml:14:5: error[E_MODEL]: foot 'foot' uses one point twice");
  model_bad(FOOT("heel: [h1], tow: [t1], toe: [t1]"), AMBULO_E_SCHEMA,
            "t.yaml:14:30: error[E_SCHEMA]: unknown key 'tow'");
}

static void patches(void **state) {
  (void)state;
  model_case c = model_good(MODEL_HEAD MODEL_ROD POINTS
                            "patches:\n"
                            "  - {name: hand_r, point: h1, size: [0.05, 0.04], mirror: hand_l}\n"
                            "  - {name: hand_l, point: h2, size: [0.05, 0.04], mirror: hand_r}\n"
                            "  - {name: seat, point: hc, size: [0.1, 0.2]}\n");
  const ambulo_patch *hand = ambulo_model_patch(c.model, 0);
  const ambulo_patch *seat = ambulo_model_patch(c.model, 2);
  assert_int_equal(ambulo_model_patch_count(c.model), 3);
  assert_string_equal(hand->name, "hand_r");
  assert_int_equal(hand->point, 0);
  assert_int_equal(hand->mirror, 1);
  assert_close(seat->size[0] / seat->size[1], 0.5, 1e-15);
  assert_close(hand->size[0] / seat->size[0], 0.5, 1e-15);
  assert_int_equal(seat->point, 4);
  assert_int_equal(seat->mirror, 2);
  model_shut(&c);
}

#define PATCH(text) MODEL_HEAD MODEL_ROD POINTS "patches:\n  - {name: hand, " text "}\n"

static void faults_of_patches(void **state) {
  (void)state;
  model_bad(PATCH("point: h3, size: [1, 1]"), AMBULO_E_MODEL,
            "t.yaml:14:25: error[E_MODEL]: unknown point (got 'h3'); expected the name of a point");
  model_bad(PATCH("point: h1"), AMBULO_E_SCHEMA,
            "t.yaml:14:5: error[E_SCHEMA]: missing required key 'size' in patches[0] ('hand')");
  model_bad(PATCH("point: h1, size: [1]"), AMBULO_E_SCHEMA,
            "t.yaml:14:35: error[E_SCHEMA]: got a sequence of 1; expected a sequence of 2");
  model_bad(PATCH("point: h1, size: [1, -1]"), AMBULO_E_MODEL,
            "t.yaml:14:5: error[E_MODEL]: half the width of patch 'hand' is out of range (got -1 "
            "m)");
  model_bad(PATCH("point: h1, size: [1, 1], mirror: hnd"), AMBULO_E_MODEL,
            "t.yaml:14:51: error[E_MODEL]: unknown patch (got 'hnd'); expected the name of a patch "
            "of this model\n  hint: did "
            "you mean 'hand'?");
  model_bad(PATCH("point: h1, size: [1, 1], sise: 1"), AMBULO_E_SCHEMA,
            "t.yaml:14:43: error[E_SCHEMA]: unknown key 'sise' in patches[0] ('hand')\n  hint: did "
            "you mean 'size'?");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(spatial_feet), cmocka_unit_test(planar_foot),
                                     cmocka_unit_test(faults), cmocka_unit_test(patches),
                                     cmocka_unit_test(faults_of_patches)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
