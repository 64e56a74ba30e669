/* problem/row_runs.c - the linear rows, laid out for evaluation (row_runs.h). */
#include "problem/row_runs.h"

#include "base/lanes.h"

#include <limits.h>

static int is_odd(const ambulo__row_table *table, int row) {
  const ambulo__table_row *r = &table->rows[row];
  int odd = r->user >= 0;
  for (int t = 0; t < r->term_count; t++) odd |= table->terms[r->first_term + t].node < 0;
  return odd;
}

/* 0 if a place does not fit an int: more than 16 GB of lanes */
static int place(const ambulo__row_table *table, int channels, int row, ambulo__row_runs *out,
                 int entry) {
  const ambulo__table_row *r = &table->rows[row];
  for (int t = 0; t < r->term_count; t++) {
    const ambulo__row_term *term = &table->terms[r->first_term + t];
    size_t at = ambulo__lane_index(term->node, channels, term->channel);
    if (at > INT_MAX) return 0;
    out->coefficient[entry + t] = term->coefficient;
    out->at[entry + t] = (int)at;
  }
  return 1;
}

static int continues(const ambulo__row_run *run, int row, int terms) {
  return run->first + run->count == row && run->terms == terms;
}

/* the number of runs with this row */
static int append(ambulo__row_run *runs, int count, int row, int terms, int entry) {
  if (count > 0 && continues(&runs[count - 1], row, terms)) {
    runs[count - 1].count++;
    return count;
  }
  ambulo__row_run run = {row, 1, terms, entry};
  runs[count] = run;
  return count + 1;
}

ambulo_status ambulo__row_runs_create(const ambulo__row_table *table, int channels,
                                      const ambulo_allocator *allocator, ambulo__row_runs *out) {
  size_t rows = (size_t)table->row_count, terms = (size_t)table->term_count;
  ambulo__row_runs empty = {0};
  *out = empty;
  out->runs = ambulo__alloc(allocator, rows, sizeof *out->runs);
  out->constant = ambulo__alloc(allocator, rows, sizeof *out->constant);
  out->coefficient = ambulo__alloc(allocator, terms, sizeof *out->coefficient);
  out->at = ambulo__alloc(allocator, terms, sizeof *out->at);
  out->odd = ambulo__alloc(allocator, rows, sizeof *out->odd);
  if (!out->runs || !out->constant || !out->coefficient || !out->at || !out->odd)
    return AMBULO_E_MEMORY;
  int entry = 0;
  for (int r = 0; r < table->row_count; r++) {
    out->constant[r] = table->rows[r].constant;
    if (is_odd(table, r)) {
      out->odd[out->odd_count++] = r;
      continue;
    }
    int count = table->rows[r].term_count;
    if (!place(table, channels, r, out, entry)) return AMBULO_E_MEMORY;
    out->run_count = append(out->runs, out->run_count, r, count, entry);
    entry += count;
  }
  return AMBULO_OK;
}

void ambulo__row_runs_free(const ambulo_allocator *allocator, ambulo__row_runs *runs) {
  ambulo__free(allocator, runs->runs);
  ambulo__free(allocator, runs->constant);
  ambulo__free(allocator, runs->coefficient);
  ambulo__free(allocator, runs->at);
  ambulo__free(allocator, runs->odd);
}

/* `terms` is that of the run, as a constant where rows with so many are common: the inner loop is
 * unrolled then. */
static inline void run_values(const ambulo__row_runs *runs, const ambulo__row_run *run, int terms,
                              const double *restrict channel, double *restrict value) {
  const double *restrict constant = runs->constant + run->first;
  const double *restrict coefficient = runs->coefficient + run->first_entry;
  const int *restrict at = runs->at + run->first_entry;
  for (int r = 0; r < run->count; r++, coefficient += terms, at += terms) {
    double sum = constant[r];
    for (int t = 0; t < terms; t++) sum += coefficient[t] * channel[at[t]];
    value[run->first + r] = sum;
  }
}

void ambulo__row_runs_values(const ambulo__row_runs *runs, const double *channel, double *value) {
  for (int i = 0; i < runs->run_count; i++) {
    const ambulo__row_run *run = &runs->runs[i];
    if (run->terms == 1) {
      run_values(runs, run, 1, channel, value);
    } else {
      run_values(runs, run, run->terms, channel, value);
    }
  }
}

static inline void run_adjoint(const ambulo__row_runs *runs, const ambulo__row_run *run, int terms,
                               const double *restrict weight, double *restrict adjoint) {
  const double *restrict coefficient = runs->coefficient + run->first_entry;
  const int *restrict at = runs->at + run->first_entry;
  for (int r = 0; r < run->count; r++, coefficient += terms, at += terms) {
    double lambda = weight[run->first + r];
    if (lambda == 0.0) continue;
    for (int t = 0; t < terms; t++) adjoint[at[t]] += lambda * coefficient[t];
  }
}

void ambulo__row_runs_adjoint(const ambulo__row_runs *runs, const double *weight, double *adjoint) {
  for (int i = 0; i < runs->run_count; i++) {
    const ambulo__row_run *run = &runs->runs[i];
    if (run->terms == 1) {
      run_adjoint(runs, run, 1, weight, adjoint);
    } else {
      run_adjoint(runs, run, run->terms, weight, adjoint);
    }
  }
}
