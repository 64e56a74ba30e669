/* contact/row_table.c - growing arrays: rows, the terms they consist of, families. */
#include "contact/row_table.h"

#include <limits.h>
#include <math.h>
#include <string.h>

void ambulo__row_table_init(ambulo__row_table *table, const ambulo_allocator *allocator) {
  ambulo__row_table empty = {.allocator = ambulo__allocator_or_default(allocator), .weight = 1.0};
  *table = empty;
}

void ambulo__row_table_clear(ambulo__row_table *table) {
  if (!table) return;
  ambulo__free(&table->allocator, table->rows);
  ambulo__free(&table->allocator, table->terms);
  ambulo__free(&table->allocator, table->curved);
  ambulo__free(&table->allocator, table->group_row);
  ambulo__row_table_init(table, &table->allocator);
}

/* Doubles `*array` when `count` has reached `*capacity`; 0 when memory runs out. */
static int grow(const ambulo_allocator *allocator, void **array, int count, int *capacity,
                size_t size) {
  if (count < *capacity) return 1;
  if (*capacity > INT_MAX / 2) return 0;
  int larger = *capacity ? 2 * *capacity : 64;
  void *moved = ambulo__realloc(allocator, *array, (size_t)larger, size);
  if (!moved) return 0;
  *array = moved;
  *capacity = larger;
  return 1;
}

static int same_family(const ambulo__table_row *a, const ambulo__table_row *b) {
  if (a->kind != b->kind) return 0;
  return a->kind != AMBULO__KIND_USER || strcmp(a->family, b->family) == 0;
}

/* The number of the family of the row that comes next, which begins one if need be; -1 without
 * memory. Neighbours mostly share theirs, and there are few. */
static int group_of(ambulo__row_table *table, const ambulo__table_row *row) {
  for (int g = table->group_count - 1; g >= 0; g--) {
    if (same_family(&table->rows[table->group_row[g]], row)) return g;
  }
  void *groups = table->group_row;
  int grown = grow(&table->allocator, &groups, table->group_count, &table->group_capacity,
                   sizeof *table->group_row);
  table->group_row = groups;
  if (!grown) return -1;
  table->group_row[table->group_count] = table->row_count;
  return table->group_count++;
}

static void append(ambulo__row_table *table, ambulo__table_row row) {
  if (table->status) return;
  void *rows = table->rows;
  int grown =
      grow(&table->allocator, &rows, table->row_count, &table->row_capacity, sizeof *table->rows);
  table->rows = rows;
  row.group = grown ? group_of(table, &row) : -1;
  if (row.group < 0) {
    table->status = AMBULO_E_MEMORY;
    return;
  }
  row.size = ambulo__measure_size(row.measure, table->weight);
  row.first_term = table->term_count;
  table->rows[table->row_count++] = row;
}

void ambulo__row_begin(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                       const char *detail, ambulo__measure measure, ambulo_relation relation,
                       int node, double time, double constant) {
  ambulo__table_row row = {.kind = (unsigned char)kind,
                           .measure = (unsigned char)measure,
                           .family = ambulo__row_family(kind),
                           .subject = subject,
                           .detail = detail,
                           .unit = ambulo__measure_text(measure),
                           .relation = (unsigned char)relation,
                           .before = table->before != 0,
                           .node = node,
                           .time = time,
                           .constant = constant,
                           .user = -1};
  append(table, row);
}

void ambulo__row_user(ambulo__row_table *table, const ambulo_user_row *user, int index, int node,
                      double time) {
  ambulo__table_row row = {.kind = AMBULO__KIND_USER,
                           .measure = (unsigned char)ambulo__measure_of_text(user->unit),
                           .family = user->name,
                           .subject = "",
                           .detail = "",
                           .unit = user->unit,
                           .relation = (unsigned char)user->relation,
                           .node = node,
                           .time = time,
                           .user = index};
  append(table, row);
}

static void append_curved(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                          const char *detail, int node, double time, const ambulo__curved *row) {
  void *curved = table->curved;
  if (table->status) return;
  int grown =
      grow(&table->allocator, &curved, table->curved_count, &table->curved_capacity, sizeof *row);
  table->curved = curved;
  if (!grown) {
    table->status = AMBULO_E_MEMORY;
    return;
  }
  ambulo__row_begin(table, kind, subject, detail, AMBULO__METRES, AMBULO_NOT_NEGATIVE, node, time,
                    0.0);
  if (table->status) return;
  table->curved[table->curved_count] = *row;
  table->rows[table->row_count - 1].user = table->curved_count++;
}

void ambulo__row_arc(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                     const char *detail, int node, double time, const ambulo__arc *arc) {
  ambulo__curved row = {.form = AMBULO__CURVED_ARC, .of.arc = *arc};
  append_curved(table, kind, subject, detail, node, time, &row);
}

void ambulo__row_apart(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                       const char *detail, int node, double time, const ambulo__apart *apart) {
  ambulo__curved row = {.form = AMBULO__CURVED_APART, .of.apart = *apart};
  append_curved(table, kind, subject, detail, node, time, &row);
}

void ambulo__row_solid(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                       const char *detail, int node, double time, const ambulo__solid *solid) {
  ambulo__curved row = {.form = AMBULO__CURVED_SOLID, .of.solid = *solid};
  append_curved(table, kind, subject, detail, node, time, &row);
}

void ambulo__row_spin(ambulo__row_table *table, ambulo__row_kind kind, const char *subject,
                      const char *detail, int node, double time, const ambulo__spin *spin) {
  ambulo__curved row = {.form = AMBULO__CURVED_SPIN, .of.spin = *spin};
  append_curved(table, kind, subject, detail, node, time, &row);
}

double ambulo__row_missed(const ambulo__table_row *row, double value) {
  if (!isfinite(value)) return HUGE_VAL;
  return row->relation == AMBULO_EQUAL ? fabs(value) : fmax(0.0, -value);
}

int ambulo__rows_alike(const ambulo__table_row *a, const ambulo__table_row *b) {
  return a->group == b->group && strcmp(a->subject, b->subject) == 0 &&
         strcmp(a->detail, b->detail) == 0;
}

void ambulo__row_term_add(ambulo__row_table *table, int node, int channel, double coefficient) {
  if (table->status || coefficient == 0.0) return;
  void *terms = table->terms;
  int grown = grow(&table->allocator, &terms, table->term_count, &table->term_capacity,
                   sizeof *table->terms);
  table->terms = terms;
  if (!grown) {
    table->status = AMBULO_E_MEMORY;
    return;
  }
  ambulo__row_term term = {node, channel, coefficient};
  table->terms[table->term_count++] = term;
  table->rows[table->row_count - 1].term_count++;
}
