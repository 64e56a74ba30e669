/* Lists of cases that grow: ids by what is asked for, keys by all that a result depends on. */
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/sweep_files.h"
#include "study/study.h"

static ambulo_sweep *begin(void **state) {
  ambulo_sweep *s = NULL;
  scratch_write(scratch_path(state, "p.yaml"), sweep_problem);
  scratch_write(scratch_path(state, "one.yaml"), sweep_model);
  assert_int_equal(ambulo__sweep_begin("s", scratch_path(state, "f.yaml"),
                                       scratch_path(state, "p.yaml"), "", NULL, NULL, &s),
                   AMBULO_OK);
  return s;
}

static int add(ambulo_sweep *s, const char *one, const char *other, int previous) {
  const char *overrides[] = {one, other};
  int index = -1;
  assert_int_equal(ambulo__sweep_append(s, "n", overrides, other ? 2 : 1, previous, NULL, &index),
                   AMBULO_OK);
  return index;
}

static void the_same_is_the_same(void **state) {
  ambulo_sweep *s = begin(state), *t = begin(state);
  int a = add(s, "time.intervals=8", NULL, -1), b = add(s, "time.intervals=9", NULL, -1);
  int c = add(s, "time.intervals=8", NULL, b), d = add(s, "time.intervals=8", "name=x", -1);
  assert_true(a != b && a != c && b != c && d != a);
  assert_int_equal(add(s, "time.intervals=8", NULL, -1), a);
  assert_int_equal(add(s, "time.intervals=8", NULL, b), c);
  assert_int_equal(ambulo_sweep_case_count(s), 4);
  assert_int_equal(s->cases[c].previous, b);
  /* in another order, too */
  int e = add(t, "time.intervals=9", NULL, -1), f = add(t, "time.intervals=8", NULL, e);
  assert_string_equal(t->cases[f].id, s->cases[c].id);
  assert_true(t->cases[f].key == s->cases[c].key);
  for (int i = 0; i < 200; i++) {
    char text[40];
    (void)snprintf(text, sizeof text, "time.duration=%d", i + 1);
    assert_int_equal(add(s, text, NULL, i ? 3 + i : -1), 4 + i);
  }
  ambulo_case one;
  assert_int_equal(ambulo_sweep_case(s, 203, &one), AMBULO_OK);
  assert_string_equal(one.overrides[0], "time.duration=200");
  assert_int_equal(one.previous, 202);
  ambulo_sweep_free(s);
  ambulo_sweep_free(t);
}

/* the base problem and the files that values name are in the key, not in the id */
static void keys_see_files(void **state) {
  ambulo_sweep *s = begin(state);
  scratch_write(scratch_path(state, "two.yaml"), sweep_model);
  int a = add(s, "model=two.yaml", NULL, -1);
  char more[1200];
  (void)snprintf(more, sizeof more, "%s# more\n", sweep_model);
  scratch_write(scratch_path(state, "two.yaml"), more);
  ambulo_sweep *t = begin(state);
  int b = add(t, "model=two.yaml", NULL, -1);
  assert_string_equal(s->cases[a].id, t->cases[b].id);
  assert_true(s->cases[a].key != t->cases[b].key);
  t->base_hash ^= 1;
  int c = add(t, "time.intervals=8", NULL, -1), d = add(s, "time.intervals=8", NULL, -1);
  assert_string_equal(s->cases[d].id, t->cases[c].id);
  assert_true(s->cases[d].key != t->cases[c].key);
  ambulo_sweep_free(s);
  ambulo_sweep_free(t);
}

static void a_base_that_is_none(void **state) {
  ambulo_sweep *s = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(
      ambulo__sweep_begin("s", "f.yaml", scratch_path(state, "none.yaml"), "", NULL, list, &s),
      AMBULO_E_IO);
  assert_null(s);
  assert_message(list, 0, "none.yaml: error[E_IO]");
  ambulo_diagnostics_free(list);
}

static void memory_may_give_out(void **state) {
  ambulo_sweep *ready = begin(state);
  ambulo_sweep_free(ready);
  for (long k = 0; k < 10000; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo_sweep *s = NULL;
    const char *overrides[] = {"time.intervals=8"};
    int index;
    ambulo_status status =
        ambulo__sweep_begin("s", "f.yaml", scratch_path(state, "p.yaml"), "", &allocator, NULL, &s);
    if (!status) status = ambulo__sweep_append(s, "n", overrides, 1, -1, NULL, &index);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo_sweep_free(s);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) return;
  }
  fail();
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_open, scratch_close)
  const struct CMUnitTest tests[] = {TEST(the_same_is_the_same), TEST(keys_see_files),
                                     TEST(a_base_that_is_none), TEST(memory_may_give_out)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
