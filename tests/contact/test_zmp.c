/* ZMP rows against a force applied at a known point of the ground: M = p x F. */
#include "base/diagnostics.h"
#include "support/row_fixture.h"

static const double body_weight = 72.0 * 9.81;

static const ambulo_contact contacts[] = {
    {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {0.3, 0.09}},
    {WALKER_RIGHT, AMBULO_CONTACT_TOE, 0.0, 1.0, .place = {0.0, -0.09}}};

/* the wrench of force F through p at every node */
static void apply(row_fixture *f, const double p[3], const double force[3]) {
  for (int k = 0; k < ROW_NODES; k++) {
    for (int i = 0; i < 3; i++) {
      int j = (i + 1) % 3, l = (i + 2) % 3;
      *row_channel(f, k, ambulo__channel_force(&f->context.channels, i)) = force[i];
      *row_channel(f, k, ambulo__channel_moment(&f->context.channels, i)) =
          p[j] * force[l] - p[l] * force[j];
    }
  }
}

static void open_left(row_fixture *f, int planar, ambulo_support support) {
  row_fixture_open(f, planar);
  f->definition.contacts = contacts;
  f->definition.contact_count = 2;
  f->definition.support = support;
  for (int k = 0; k < ROW_NODES; k++) f->active[2 * k + WALKER_LEFT] = 0;
}

/* left foot flat: 0.3 to 0.52 m forward, 0.05 to 0.13 m left; ZMP at (0.4, 0.1) */
static void box_rows_are_distances(void **state) {
  (void)state;
  row_fixture f;
  open_left(&f, 0, AMBULO_SUPPORT_BOX);
  f.definition.ground_height = 0.2;
  f.definition.support_margin = 0.01;
  assert_int_equal(ambulo__zmp_rows(&f.context, &f.table, NULL), AMBULO_OK);
  assert_int_equal(f.table.row_count, 4 * ROW_NODES);
  const double p[3] = {0.4, 0.2, -0.1}, force[3] = {35.0, body_weight, -20.0};
  apply(&f, p, force);
  static const char *const names[] = {"back", "front", "right", "left"};
  static const double expected[] = {0.09, 0.11, 0.04, 0.02};
  for (int i = 0; i < 4; i++) {
    assert_close(row_value(&f, row_find(&f, "zmp", "support", names[i], 0.5)), expected[i], 1e-13);
  }
  const double half[3] = {35.0, 0.5 * body_weight, -20.0};
  apply(&f, p, half);
  assert_close(row_value(&f, row_find(&f, "zmp", "support", "back", 0.5)), 0.045, 1e-13);
  row_fixture_close(&f);
}

/* the hull of one flat foot is its box: the same four distances, in another order */
static void hull_rows_are_distances(void **state) {
  (void)state;
  row_fixture f;
  open_left(&f, 0, AMBULO_SUPPORT_HULL);
  assert_int_equal(ambulo__zmp_rows(&f.context, &f.table, NULL), AMBULO_OK);
  const double p[3] = {0.4, 0.0, -0.1}, force[3] = {35.0, body_weight, -20.0};
  apply(&f, p, force);
  static const double expected[] = {0.05, 0.12, 0.03, 0.1};
  for (int i = 0; i < 4; i++) {
    assert_string_equal(f.table.rows[i].detail, "edge");
    assert_close(row_value(&f, i), expected[i], 1e-13);
  }
  row_fixture_close(&f);
}

static void planar_models_have_two_rows(void **state) {
  (void)state;
  row_fixture f;
  open_left(&f, 1, AMBULO_SUPPORT_HULL);
  assert_int_equal(ambulo__zmp_rows(&f.context, &f.table, NULL), AMBULO_OK);
  assert_int_equal(f.table.row_count, 2 * ROW_NODES);
  const double p[3] = {0.4, 0.0, 0.0}, force[3] = {35.0, body_weight, 0.0};
  apply(&f, p, force);
  assert_close(row_value(&f, 0), 0.1, 1e-13);
  assert_close(row_value(&f, 1), 0.12, 1e-13);
  row_fixture_close(&f);
}

static void normal_force_counts_body_weights(void **state) {
  (void)state;
  row_fixture f;
  open_left(&f, 0, AMBULO_SUPPORT_OFF);
  f.definition.minimum_force = 0.3;
  assert_int_equal(ambulo__zmp_rows(&f.context, &f.table, NULL), AMBULO_OK);
  assert_int_equal(f.table.row_count, ROW_NODES);
  const double p[3] = {0, 0, 0}, force[3] = {0, 2.0 * body_weight, 0};
  apply(&f, p, force);
  assert_close(row_value(&f, row_find(&f, "normal_force", "ground", "vertical", 1.0)), 1.7, 1e-14);
  row_fixture_close(&f);
}

/* from the left foot alone to both feet at 0.5 s: the point is over the left one still */
static void events_have_both_regions(void **state) {
  (void)state;
  row_fixture f;
  open_left(&f, 0, AMBULO_SUPPORT_BOX);
  for (int k = 2; k < ROW_NODES; k++) f.active[2 * k + WALKER_RIGHT] = 1;
  row_event(&f, 2, WALKER_RIGHT, -1);
  assert_int_equal(ambulo__zmp_rows(&f.context, &f.table, NULL), AMBULO_OK);
  assert_int_equal(f.table.row_count, 4 * (ROW_NODES + 1));
  assert_int_equal(row_count(&f, "zmp", "support", "back", 0.5), 2);
  assert_int_equal(row_count(&f, "zmp", "support", "back", 0.75), 1);
  const double p[3] = {0.4, 0.0, -0.1}, force[3] = {35.0, body_weight, -20.0};
  apply(&f, p, force);
  double near = INFINITY, far = -INFINITY;
  for (int r = 0; r < f.table.row_count; r++) {
    const ambulo__table_row *row = &f.table.rows[r];
    if (strcmp(row->detail, "back") != 0 || row->time != 0.5) continue;
    near = fmin(near, row_value(&f, r));
    far = fmax(far, row_value(&f, r));
  }
  assert_close(near, 0.1, 1e-13); /* from the left foot's back */
  assert_close(far, row_value(&f, row_find(&f, "zmp", "support", "back", 0.75)), 1e-13);
  assert_true(far > 0.3);
  row_fixture_close(&f);
}

static void empty_regions_are_refused(void **state) {
  (void)state;
  row_fixture f;
  open_left(&f, 0, AMBULO_SUPPORT_HULL);
  f.active[2 * 3 + WALKER_LEFT] = -1;
  f.active[2 * 3 + WALKER_RIGHT] = 1;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo__zmp_rows(&f.context, &f.table, list), AMBULO_E_PROBLEM);
  expect_message(list, "the support polygon is empty at t = 0.75 s (right on its toes, margin 0 m");
  ambulo__diagnostics_clear(list);
  f.definition.support = AMBULO_SUPPORT_BOX;
  f.definition.support_margin = 0.04;
  assert_int_equal(ambulo__zmp_rows(&f.context, &f.table, list), AMBULO_E_PROBLEM);
  expect_message(list, "empty at t = 0 s (left flat, margin 0.04 m");
  ambulo_diagnostics_free(list);
  row_fixture_close(&f);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(box_rows_are_distances),
                                     cmocka_unit_test(hull_rows_are_distances),
                                     cmocka_unit_test(planar_models_have_two_rows),
                                     cmocka_unit_test(normal_force_counts_body_weights),
                                     cmocka_unit_test(events_have_both_regions),
                                     cmocka_unit_test(empty_regions_are_refused)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
