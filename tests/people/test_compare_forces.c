/* Forces beside a person's own motion: whose they are, at which times, and where they begin. */
#include "people/compare_subject.h"
#include "support/messages.h"
#include "support/subject_motion.h"

typedef struct measured {
  ambulo__subject subject;
  double onsets[2][AMBULO__MOST_STRIKES];
  int count[2];
} measured;

static ambulo_status read_forces(void **state, const char *file, const char *map,
                                 ambulo_diagnostics *list, measured *m) {
  static const char *const names[] = {"grf.left.x",  "grf.left.y",  "grf.left.z",
                                      "grf.right.x", "grf.right.y", "grf.right.z"};
  ambulo__motion *motion = NULL;
  double *const onsets[2] = {m->onsets[0], m->onsets[1]};
  const char *path = subject_plain(state);
  m->subject = (ambulo__subject){.diagnostics = list, .file = path};
  m->subject.allocator = ambulo__allocator_or_default(NULL);
  assert_int_equal(ambulo__motion_read(path, NULL, NULL, &motion), AMBULO_OK);
  assert_int_equal(ambulo__subject_columns(&m->subject, motion, names, 6), AMBULO_OK);
  ambulo__motion_free(motion);
  return ambulo__subject_forces(&m->subject, file, map, onsets, m->count);
}

static double force_at(const measured *m, const char *column, double t) {
  const ambulo__motion *table = m->subject.table;
  int at = ambulo__motion_column(table, column);
  return table->values[(size_t)lround(100.0 * t) * (size_t)table->columns + (size_t)at];
}

static void by_name_and_by_map(void **state) {
  static const struct {
    const char *left, *right, *map;
  } cases[] = {{"ground_force_l", "ground_force_r", NULL},
               {"ground_force_left", "ground_force_right", NULL},
               {"l_ground_force", "R_ground_force", NULL},
               {"ground_force_calcn_l", "ground_force_calcn_r", NULL},
               {"ground_force_1", "ground_force_2", "left=ground_force_1,right=ground_force_2"}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    static measured m;
    const char *file = subject_forces(state, cases[i].left, cases[i].right, 0.005);
    assert_int_equal(read_forces(state, file, cases[i].map, NULL, &m), AMBULO_OK);
    /* the middle of the left foot's stance; the right foot hangs */
    assert_close(force_at(&m, "grf.left.y", 0.86), 700.0, 0.5);
    assert_close(force_at(&m, "grf.right.y", 0.86), 0.0, 1e-9);
    assert_close(force_at(&m, "grf.right.y", 1.46), 700.0, 0.5);
    assert_close(force_at(&m, "grf.left.x", 0.68), -100.0, 0.2);
    assert_int_equal(m.count[0], 5);
    assert_close(m.onsets[0][0], 0.5 + 0.72 / SUBJECT_PI * asin(20.0 / 700.0), 1e-3);
    assert_close(m.onsets[1][0], 1.1 + 0.72 / SUBJECT_PI * asin(20.0 / 700.0), 1e-3);
    ambulo__subject_free(&m.subject);
  }
}

/* 0 where the file has nothing, and no onset of a push too small to be a step */
static void gaps(void **state) {
  static measured m;
  const char *path = scratch_path(state, "gaps.mot");
  FILE *f = fopen(path, "w");
  assert_non_null(f);
  fprintf(f, "forces\nendheader\ntime\tground_force_l_vy\n");
  for (int k = 0; k <= 200; k++) {
    double t = 1.0 + 0.01 * k;
    int step = t >= 2.0 && t < 2.6, push = t >= 1.3 && t < 1.4;
    if (k < 5) {
      fprintf(f, "%.10g\tnan\n", t);
    } else {
      fprintf(f, "%.10g\t%d\n", t, step ? 800 : push ? 90 : 0);
    }
  }
  assert_int_equal(fclose(f), 0);
  assert_int_equal(read_forces(state, path, NULL, NULL, &m), AMBULO_OK);
  assert_int_equal(m.count[0], 1);
  assert_int_equal(m.count[1], 0);
  assert_close(m.onsets[0][0], 2.0, 0.011);
  assert_close(force_at(&m, "grf.left.y", 0.5), 0.0, 0.0);
  assert_close(force_at(&m, "grf.left.y", 1.02), 0.0, 0.0);
  assert_close(force_at(&m, "grf.left.y", 2.3), 800.0, 1e-9);
  assert_close(force_at(&m, "grf.left.y", 5.0), 0.0, 0.0);
  ambulo__subject_free(&m.subject);
}

static void refusals(void **state) {
  static measured m;
  static const char *const maps[] = {"left=ground_force_3", "paw=ground_force_1", "left"};
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  const char *file = subject_forces(state, "ground_force_1", "ground_force_2", 0.0);
  assert_int_equal(read_forces(state, file, NULL, list, &m), AMBULO_E_SCHEMA);
  assert_message(list, 0, "says whose foot it is; the file has ground_force_1, ground_force_2");
  ambulo__subject_free(&m.subject);
  for (size_t i = 0; i < 3; i++) {
    assert_int_equal(read_forces(state, file, maps[i], list, &m), AMBULO_E_SCHEMA);
    assert_message(list, i + 1, "name no foot and group of this file");
    ambulo__subject_free(&m.subject);
  }
  ambulo_diagnostics_free(list);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(by_name_and_by_map, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(gaps, scratch_open, scratch_close),
      cmocka_unit_test_setup_teardown(refusals, scratch_open, scratch_close)};
  return cmocka_run_group_tests_name("compare/compare_forces", tests, NULL, NULL);
}
