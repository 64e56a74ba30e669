/* Blocks of cases: forms, families and motions, each case where the head says it is. */
#include "show/case_block.h"

#include "support/fail_alloc.h"
#include "support/inflate.h"
#include "support/packed_motions.h"
#include "support/yaml.h"

enum { CASES = 6 };

static ambulo__case_data cases[CASES];

static void one_case(int i, const char *form, const char *kinds, int samples) {
  ambulo__case_data *d = cases + i;
  memset(d, 0, sizeof *d);
  ambulo__text_init(&d->form, NULL);
  ambulo__text_init(&d->leaves, NULL);
  ambulo__text_init(&d->kinds, NULL);
  ambulo__text_append(&d->form, form);
  ambulo__text_append_format(&d->leaves, "%d", 10 + i);
  ambulo__text_append_char(&d->leaves, '\0');
  ambulo__text_append(&d->kinds, kinds);
  d->leaf_count = 1;
  d->samples = samples;
  d->length = strlen(kinds) * (size_t)samples;
  d->motion = malloc(d->length * sizeof *d->motion + 1);
  for (size_t k = 0; k < d->length; k++)
    d->motion[k] = (float)((unsigned)(i + 1) * (k % 7) + (k * k * (unsigned)(i + 2)) % 11) / 4.0f;
}

static void make_cases(void) {
  one_case(0, "{\"a\":0}", "la", 9);
  one_case(1, "{\"a\":0}", "f", 6);
  one_case(2, "{\"b\":0}", "la", 9);
  one_case(3, "{\"a\":0}", "", 0);
  one_case(4, "{\"b\":0}", "f", 6);
  one_case(5, "{\"b\":0}", "f", 2); /* fewer samples: a family of its own */
}

static void free_cases(void) {
  for (int i = 0; i < CASES; i++) ambulo__case_data_free(cases + i);
}

/* the block of `count` cases, unpacked; to be freed */
static char *block(int count, ambulo__case_quality quality, size_t *size) {
  ambulo__text_buffer out;
  ambulo__text_init(&out, NULL);
  assert_int_equal(ambulo__case_block(&out, cases, count, &quality), AMBULO_OK);
  assert_true(out.data[0] == '"' && out.data[out.length - 1] == '"');
  out.data[out.length - 1] = '\0';
  size_t bytes;
  char *packed = unbase64(out.data + 1, &bytes);
  char *text = (char *)unpacked(packed, bytes, size);
  free(packed);
  ambulo__text_free(&out);
  return text;
}

static void assert_motion(const double *got, const ambulo__case_data *want, int every,
                          double finer) {
  for (size_t s = 0; s < want->kinds.length; s++)
    for (int k = 0; k < want->samples; k += every)
      assert_true(fabs(*got++ -
                       finer * (double)want->motion[s * (size_t)want->samples + (size_t)k]) <= 0.5);
}

static void two_families(void **state) {
  (void)state;
  size_t size;
  make_cases();
  char *text = block(CASES, (ambulo__case_quality){4, 2.0}, &size);
  assert_string_equal(
      text,
      "{\"every\":4,\"steps\":{\"l\":0.001,\"a\":0.0017,\"t\":0.005,\"p\":0.005,\"f\":0.001},"
      "\"forms\":[{\"tree\":{\"a\":0},\"columns\":[[10,11,13]]},{\"tree\":{\"b\":0},"
      "\"columns\":[[12,14,15]]}],\"families\":[{\"kinds\":\"la\",\"samples\":3,\"count\":2},{"
      "\"kinds\":\"f\",\"samples\":6,\"count\":2},{\"kinds\":\"\",\"samples\":0,\"count\":1},{"
      "\"kinds\":\"f\",\"samples\":2,\"count\":1}],"
      "\"cases\":[[0,0],[0,1],[1,0],[0,2],[1,1],[1,3]]}");
  size_t at = strlen(text) + 1;
  packed_motions p = read_motions(text + at, size - at, 2, 2, 3);
  assert_motion(p.values, cases + 0, 4, 2.0);
  assert_motion(p.values + 6, cases + 2, 4, 2.0);
  free(p.values);
  at += p.length;
  p = read_motions(text + at, size - at, 2, 1, 6); /* five intervals: all samples are kept */
  assert_motion(p.values, cases + 1, 1, 2.0);
  assert_motion(p.values + 6, cases + 4, 1, 2.0);
  free(p.values);
  at += p.length;
  p = read_motions(text + at, size - at, 1, 1, 2);
  assert_motion(p.values, cases + 5, 1, 2.0);
  free(p.values);
  assert_int_equal(at + p.length, size);
  free(text);
  free_cases();
}

static void the_first_of_them(void **state) {
  (void)state;
  size_t size;
  make_cases();
  char *text = block(1, (ambulo__case_quality){1, 1.0}, &size);
  assert_non_null(strstr(text, "\"families\":[{\"kinds\":\"la\",\"samples\":9,\"count\":1}],"
                               "\"cases\":[[0,0]]}"));
  free(text);
  free_cases();
}

static void memory_may_run_out_anywhere(void **state) {
  (void)state;
  make_cases();
  for (long k = 0;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__text_buffer out;
    ambulo__text_init(&out, &allocator);
    ambulo_status status = ambulo__case_block(&out, cases, CASES, &(ambulo__case_quality){1, 1.0});
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__text_free(&out);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  free_cases();
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(two_families),
      cmocka_unit_test(the_first_of_them),
      cmocka_unit_test(memory_may_run_out_anywhere),
  };
  return cmocka_run_group_tests_name("page/case_block", tests, NULL, NULL);
}
