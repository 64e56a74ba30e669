/* gait/row_table.c - two growing arrays: rows, and the terms they consist of. */
#include "gait/row_table.h"

#include <limits.h>
#include <string.h>

void ambulo__row_table_init(ambulo__row_table *table, const ambulo_allocator *allocator) {
  ambulo__row_table empty = {.allocator = ambulo__allocator_or_default(allocator), .weight = 1.0};
  *table = empty;
}

void ambulo__row_table_clear(ambulo__row_table *table) {
  if (!table) return;
  ambulo__free(&table->allocator, table->rows);
  ambulo__free(&table->allocator, table->terms);
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

double ambulo__unit_size(const ambulo__row_table *table, const char *unit) {
  const struct {
    const char *unit;
    double size;
  } sizes[] = {{"N", table->weight}, {"N m", table->weight}, {"m/s", 10.0},
               {"rad/s", 10.0},      {"m/s^2", 100.0},       {"rad/s^2", 100.0}};
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
    if (strcmp(unit, sizes[i].unit) == 0) return sizes[i].size;
  }
  return 1.0;
}

void ambulo__row_begin(ambulo__row_table *table, const char *family, const char *subject,
                       const char *detail, const char *unit, ambulo_relation relation, int node,
                       double time, double constant) {
  if (table->status) return;
  void *rows = table->rows;
  int grown =
      grow(&table->allocator, &rows, table->row_count, &table->row_capacity, sizeof *table->rows);
  table->rows = rows;
  if (!grown) {
    table->status = AMBULO_E_MEMORY;
    return;
  }
  ambulo__table_row row = {.family = family,
                           .subject = subject,
                           .detail = detail,
                           .unit = unit,
                           .relation = relation,
                           .node = node,
                           .time = time,
                           .constant = constant,
                           .size = ambulo__unit_size(table, unit),
                           .first_term = table->term_count,
                           .user = -1};
  table->rows[table->row_count++] = row;
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
