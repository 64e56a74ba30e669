/* motion.csv and motion.sto read back to the same bits. */
#include "formats/motion_write.h"
#include "formats/motion_file.h"
#include "people/stride.h"
#include "support/walker_result.h"
#include "support/motion_text.h"

static ambulo__motion_table table_of(const ambulo__stride *s) {
  ambulo__motion_table table = {.model = s->model,
                                .name = "a walk",
                                .samples = s->samples,
                                .times = s->times,
                                .q = s->q,
                                .qd = s->qd,
                                .qdd = s->qdd,
                                .tau = s->tau,
                                .zmp = s->zmp};
  return table;
}

static ambulo__motion *read_back(const ambulo__text_buffer *text, ambulo__motion_format format) {
  ambulo__motion *motion = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status =
      motion_read_text(ambulo__text_data(text), text->length, "text", format, NULL, list, &motion);
  if (status) {
    char message[400];
    ambulo_diagnostics_format(list, 0, message, sizeof message);
    print_error("%s\n", message);
  }
  ambulo_diagnostics_free(list);
  assert_int_equal(status, AMBULO_OK);
  return motion;
}

static void same_bits(const ambulo__motion *motion, const char *prefix, const ambulo__stride *s,
                      const double *values) {
  for (int i = 0; i < s->coordinates; i++) {
    char name[80];
    snprintf(name, sizeof name, "%s%s", prefix, s->model->coordinates[i].name);
    int column = ambulo__motion_column(motion, name);
    if (column < 0) print_error("no column %s\n", name);
    assert_true(column >= 0);
    for (int k = 0; k < s->samples; k++)
      assert_memory_equal(&motion->values[k * motion->columns + column],
                          &values[k * s->coordinates + i], sizeof(double));
  }
}

static void test_csv_round_trip(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo__stride s;
  assert_int_equal(ambulo__stride_create(w.problem, w.result->x, 40, NULL, &s), AMBULO_OK);
  /* readers ask for finite numbers; a flight has no zero-moment point */
  for (int k = 0; k < 3 * s.samples; k++)
    if (!isfinite(s.zmp[k])) s.zmp[k] = 0.0;
  ambulo__motion_table table = table_of(&s);
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__motion_csv(&table, &text);
  static const char start[] = "# ambulo motion: mass ";
  assert_memory_equal(ambulo__text_data(&text), start, strlen(start));
  assert_non_null(strstr(ambulo__text_data(&text), " m/s^2; SI units and radians: time s; q rad"));
  ambulo__motion *motion = read_back(&text, AMBULO__MOTION_CSV);
  assert_int_equal(motion->rows, 40);
  assert_int_equal(motion->columns, 4 * WALKER_COORDINATES + 3);
  assert_memory_equal(motion->time, s.times, (size_t)s.samples * sizeof(double));
  same_bits(motion, "q.", &s, s.q);
  same_bits(motion, "qd.", &s, s.qd);
  same_bits(motion, "qdd.", &s, s.qdd);
  same_bits(motion, "tau.", &s, s.tau);
  assert_true(ambulo__motion_column(motion, "zmp.y") >= 0);
  ambulo__motion_free(motion);
  ambulo__text_free(&text);
  ambulo__stride_free(&s);
  walk_close(&w);
}

static void test_sto_round_trip(void **state) {
  (void)state;
  walk w;
  walk_open(&w, 12);
  ambulo__stride s;
  assert_int_equal(ambulo__stride_create(w.problem, w.result->x, 0, NULL, &s), AMBULO_OK);
  ambulo__motion_table table = table_of(&s);
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__motion_sto(&table, &text);
  assert_non_null(strstr(ambulo__text_data(&text), "inDegrees=no\n"));
  ambulo__motion *motion = read_back(&text, AMBULO__MOTION_STO);
  assert_int_equal(motion->columns, WALKER_COORDINATES);
  assert_int_equal(motion->in_degrees, 0);
  same_bits(motion, "", &s, s.q);
  ambulo__motion_free(motion);
  ambulo__text_free(&text);
  ambulo__stride_free(&s);
  walk_close(&w);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_csv_round_trip),
                                     cmocka_unit_test(test_sto_round_trip)};
  return cmocka_run_group_tests_name("format/motion_csv", tests, NULL, NULL);
}
