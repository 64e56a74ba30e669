/* Tables of cases: a form once, what is the same once, what is in proportion as a ratio. */
#include "show/case_table.h"

#include "support/fail_alloc.h"
#include "support/test.h"

enum { MOST = 8 };

typedef struct table {
  ambulo__case_data cases[MOST];
  int count;
} table;

/* a case with leaves separated by '|' */
static void add(table *t, const char *form, const char *leaves) {
  ambulo__case_data *d = &t->cases[t->count++];
  memset(d, 0, sizeof *d);
  ambulo__text_init(&d->form, NULL);
  ambulo__text_init(&d->leaves, NULL);
  ambulo__text_append(&d->form, form);
  d->leaf_count = 1;
  for (const char *c = leaves; *c; c++) {
    d->leaf_count += *c == '|';
    ambulo__text_append_char(&d->leaves, *c == '|' ? '\0' : *c);
  }
  ambulo__text_append_char(&d->leaves, '\0');
}

static void done(table *t) {
  for (int i = 0; i < t->count; i++) ambulo__case_data_free(&t->cases[i]);
}

static void assert_table(const table *t, const char *want, const int *forms) {
  ambulo__text_buffer out;
  int form[MOST];
  ambulo__text_init(&out, NULL);
  assert_int_equal(ambulo__case_table(&out, t->cases, t->count, form), AMBULO_OK);
  assert_string_equal(ambulo__text_data(&out), want);
  for (int i = 0; i < t->count; i++) assert_int_equal(form[i], forms[i]);
  ambulo__text_free(&out);
}

static void columns(void **state) {
  (void)state;
  table t = {.count = 0};
  add(&t, "[0,1,2,3,4,5,6]", "5|\"a\"|2|4|\"x\"|null|0");
  add(&t, "[0,1,2,3,4,5,6]", "5|\"a\"|3|6.00003|\"y\"|1|3");
  add(&t, "[0,1,2,3,4,5,6]", "5|\"a\"|-4|-8|\"x\"|2|-4");
  assert_table(&t,
               "[{\"tree\":[0,1,2,3,4,5,6],\"columns\":[[5],[\"a\"],[2,3,-4],{\"of\":2,\"by\":2},"
               "[\"x\",\"y\",\"x\"],[null,1,2],[0,3,-4]]}]",
               (int[]){0, 0, 0});
  done(&t);
}

/* the ratio has to hold in every row, to five digits */
static void proportions(void **state) {
  (void)state;
  table t = {.count = 0};
  add(&t, "[0,1,2,3]", "0|0|0|1");
  add(&t, "[0,1,2,3]", "1.5|3|3.0001|3");
  add(&t, "[0,1,2,3]", "2|4|4|4");
  assert_table(&t,
               "[{\"tree\":[0,1,2,3],\"columns\":[[0,1.5,2],{\"of\":0,\"by\":2},[0,3.0001,4],"
               "[1,3,4]]}]",
               (int[]){0, 0, 0});
  done(&t);
}

static void forms(void **state) {
  (void)state;
  table t = {.count = 0};
  add(&t, "{\"a\":0}", "1");
  add(&t, "{\"b\":0}", "2");
  add(&t, "{\"a\":0}", "3");
  assert_table(&t,
               "[{\"tree\":{\"a\":0},\"columns\":[[1,3]]},{\"tree\":{\"b\":0},\"columns\":[[2]]}]",
               (int[]){0, 1, 0});
  done(&t);
}

static void memory_may_run_out_anywhere(void **state) {
  (void)state;
  table t = {.count = 0};
  add(&t, "{\"a\":0}", "1");
  add(&t, "{\"a\":0}", "2");
  for (long k = 0;; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__text_buffer out;
    int form[MOST];
    ambulo__text_init(&out, &allocator);
    ambulo_status status = ambulo__case_table(&out, t.cases, t.count, form);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__text_free(&out);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
  }
  done(&t);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(columns),
      cmocka_unit_test(proportions),
      cmocka_unit_test(forms),
      cmocka_unit_test(memory_may_run_out_anywhere),
  };
  return cmocka_run_group_tests_name("page/case_table", tests, NULL, NULL);
}
