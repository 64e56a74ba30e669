/* Tables as text: the exact text, and numbers that come back bit by bit. */
#include "support/test.h"
#include "format/motion_file.h"

static ambulo__motion *make_motion(int rows) {
  const char *names[2] = {"q.hip", "q.knee"};
  ambulo__motion *motion = NULL;
  assert_int_equal(ambulo__motion_create(rows, 2, names, NULL, &motion), AMBULO_OK);
  for (int r = 0; r < rows; r++) {
    motion->time[r] = r / 3.0;
    motion->values[2 * r] = sin(r * 1e3) * pow(10.0, r % 600 - 300);
    motion->values[2 * r + 1] = r % 2 ? -0.0 : 0.1 * r;
  }
  return motion;
}

static void texts_are_as_documented(void **state) {
  (void)state;
  ambulo__motion *motion = make_motion(2);
  motion->values[0] = 0.5;
  motion->values[2] = -2.0;
  motion->time[1] = 0.25;
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__motion_write_csv(motion, "SI units\nradians", &text);
  assert_string_equal(ambulo__text_data(&text), "# SI units\n# radians\ntime,q.hip,q.knee\n"
                                                "0,0.5,0\n0.25,-2,-0\n");
  ambulo__text_clear(&text);
  motion->in_degrees = 1;
  ambulo__motion_write_csv(motion, NULL, &text);
  assert_int_equal(strncmp(ambulo__text_data(&text), "# inDegrees=yes\ntime,", 21), 0);
  ambulo__text_clear(&text);
  ambulo__motion_write_sto(motion, "walk", &text);
  assert_string_equal(ambulo__text_data(&text),
                      "walk\nversion=1\nnRows=2\nnColumns=3\ninDegrees=yes\nendheader\n"
                      "time\tq.hip\tq.knee\n0\t0.5\t0\n0.25\t-2\t-0\n");
  ambulo__text_free(&text);
  ambulo__motion_free(motion);
}

static void round_trip(const ambulo__motion *motion, const ambulo__text_buffer *text) {
  ambulo__motion *back = NULL;
  assert_int_equal(ambulo__motion_read_text(ambulo__text_data(text), text->length, "text",
                                            AMBULO__MOTION_AUTO, NULL, NULL, &back),
                   AMBULO_OK);
  assert_int_equal(back->rows, motion->rows);
  assert_int_equal(back->columns, motion->columns);
  assert_int_equal(back->in_degrees, motion->in_degrees);
  size_t rows = (size_t)motion->rows;
  assert_memory_equal(back->time, motion->time, rows * sizeof(double));
  assert_memory_equal(back->values, motion->values, 2 * rows * sizeof(double));
  for (int c = 0; c < 2; c++) assert_string_equal(back->names[c], motion->names[c]);
  ambulo__motion_free(back);
}

static void numbers_come_back_bit_by_bit(void **state) {
  (void)state;
  ambulo__motion *motion = make_motion(1000);
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  for (int degrees = 0; degrees < 2; degrees++) {
    motion->in_degrees = degrees;
    ambulo__text_clear(&text);
    ambulo__motion_write_csv(motion, "comment, with = signs", &text);
    round_trip(motion, &text);
    ambulo__text_clear(&text);
    ambulo__motion_write_sto(motion, "title", &text);
    round_trip(motion, &text);
  }
  ambulo__text_free(&text);
  ambulo__motion_free(motion);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(texts_are_as_documented),
      cmocka_unit_test(numbers_come_back_bit_by_bit),
  };
  return cmocka_run_group_tests_name("format/table_write", tests, NULL, NULL);
}
