/* Rows laid out for evaluation, against the table they come from. */
#include "base/lanes.h"
#include "problem/row_runs.h"
#include "support/fail_alloc.h"
#include "support/random_model.h"
#include "support/test.h"

enum { CHANNELS = 5, NODES = 19, BLOCKS = 3, PLACES = BLOCKS * CHANNELS * AMBULO__LANES };

/* rows of 1, 1, 1, 2, 0, 3, 3 terms again and again; every eleventh on an unknown, every thirteenth
 * of the caller */
static void fill(ambulo__row_table *table) {
  random_source source = {7};
  static const int terms[] = {1, 1, 1, 2, 0, 3, 3};
  ambulo__row_table_init(table, NULL);
  for (int r = 0; r < 200; r++) {
    int node = r % NODES, count = terms[r % 7];
    ambulo__row_begin(table, AMBULO__KIND_ZMP, "s", "d", AMBULO__METRES, AMBULO_EQUAL, node, 0.0,
                      random_between(&source, -1.0, 1.0));
    for (int t = 0; t < count; t++) {
      ambulo__row_term_add(table, (node + t) % NODES, (r + t) % CHANNELS,
                           random_between(&source, -1.0, 1.0));
    }
    if (r % 11 == 0) ambulo__row_term_add(table, -1, 3, 2.0);
    if (r % 13 == 0 && table->row_count) table->rows[table->row_count - 1].user = 0;
  }
}

static int is_left_out(int row) {
  return row % 11 == 0 || row % 13 == 0;
}

static void values_and_adjoints_are_those_of_the_table(void **state) {
  (void)state;
  for (unsigned seed = 1; seed < 20; seed++) {
    ambulo__row_table table;
    ambulo__row_runs runs;
    ambulo_allocator allocator = ambulo__allocator_or_default(NULL);
    double channel[PLACES], adjoint[PLACES], want[PLACES] = {0.0}, value[200], weight[200];
    random_source source = {seed};
    fill(&table);
    assert_int_equal(ambulo__row_runs_create(&table, CHANNELS, &allocator, &runs), AMBULO_OK);
    for (int i = 0; i < PLACES; i++)
      channel[i] = random_between(&source, -1.0, 1.0), adjoint[i] = 0.0;
    for (int r = 0; r < 200; r++)
      value[r] = 1e3, weight[r] = r % 7 ? random_between(&source, -1.0, 1.0) : 0.0;
    ambulo__row_runs_values(&runs, channel, value);
    ambulo__row_runs_adjoint(&runs, weight, adjoint);
    for (int r = 0; r < 200; r++) {
      const ambulo__table_row *row = &table.rows[r];
      double sum = row->constant;
      for (int t = row->first_term; !is_left_out(r) && t < row->first_term + row->term_count; t++) {
        const ambulo__row_term *term = &table.terms[t];
        size_t at = ambulo__lane_index(term->node, CHANNELS, term->channel);
        sum += term->coefficient * channel[at];
        want[at] += weight[r] * term->coefficient;
      }
      assert_close(value[r], is_left_out(r) ? 1e3 : sum, 1e-14);
    }
    for (int i = 0; i < PLACES; i++) assert_close(adjoint[i], want[i], 1e-14);
    ambulo__row_runs_free(&allocator, &runs);
    ambulo__row_table_clear(&table);
  }
}

static void odd_rows_are_listed(void **state) {
  (void)state;
  ambulo__row_table table;
  ambulo__row_runs runs;
  ambulo_allocator allocator = ambulo__allocator_or_default(NULL);
  fill(&table);
  assert_int_equal(ambulo__row_runs_create(&table, CHANNELS, &allocator, &runs), AMBULO_OK);
  int listed = 0, in_runs = 0;
  for (int r = 0; r < 200; r++) {
    if (is_left_out(r)) assert_int_equal(runs.odd[listed++], r);
  }
  assert_int_equal(runs.odd_count, listed);
  for (int i = 0; i < runs.run_count; i++) {
    in_runs += runs.runs[i].count;
    for (int r = runs.runs[i].first; r < runs.runs[i].first + runs.runs[i].count; r++)
      assert_int_equal(table.rows[r].term_count, runs.runs[i].terms);
  }
  assert_int_equal(in_runs + listed, 200);
  ambulo__row_runs_free(&allocator, &runs);
  ambulo__row_table_clear(&table);
}

static void equal_neighbours_are_one_run(void **state) {
  (void)state;
  ambulo__row_table table;
  ambulo__row_runs runs;
  ambulo_allocator allocator = ambulo__allocator_or_default(NULL);
  ambulo__row_table_init(&table, NULL);
  for (int r = 0; r < 50; r++) {
    ambulo__row_begin(&table, AMBULO__KIND_ZMP, "s", "d", AMBULO__METRES, AMBULO_EQUAL, 0, 0.0,
                      0.0);
    for (int t = 0; t < 1 + (r >= 30); t++) ambulo__row_term_add(&table, 0, t, 1.0);
  }
  assert_int_equal(ambulo__row_runs_create(&table, CHANNELS, &allocator, &runs), AMBULO_OK);
  assert_int_equal(runs.run_count, 2);
  assert_int_equal(runs.runs[0].count, 30);
  assert_int_equal(runs.runs[1].first, 30);
  assert_int_equal(runs.runs[1].first_entry, 30);
  ambulo__row_runs_free(&allocator, &runs);
  ambulo__row_table_clear(&table);
}

static void no_memory_leaves_nothing(void **state) {
  (void)state;
  ambulo__row_table table;
  fill(&table);
  for (long k = 0; k < 100; k++) {
    fail_alloc memory = fail_alloc_at(k);
    ambulo_allocator allocator = fail_alloc_hook(&memory);
    ambulo__row_runs runs;
    ambulo_status status = ambulo__row_runs_create(&table, CHANNELS, &allocator, &runs);
    assert_int_equal(status, memory.failed ? AMBULO_E_MEMORY : AMBULO_OK);
    ambulo__row_runs_free(&allocator, &runs);
    assert_int_equal(memory.live, 0);
    if (!memory.failed) break;
    assert_true(k < 10);
  }
  ambulo__row_table_clear(&table);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(values_and_adjoints_are_those_of_the_table),
                                     cmocka_unit_test(odd_rows_are_listed),
                                     cmocka_unit_test(equal_neighbours_are_one_run),
                                     cmocka_unit_test(no_memory_leaves_nothing)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
