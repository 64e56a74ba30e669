/* study/sweep_table.c - axes from a CSV table: one column an axis, one row a case. */
#include "base/numtext.h"
#include "formats/paths.h"
#include "formats/read_file.h"
#include "formats/foreign_format.h"
#include "formats/table_text.h"
#include "study/sweep.h"

#include <string.h>

enum { MOST_TABLE_BYTES = 64 << 20 };

typedef struct table {
  ambulo_sweep *sweep;
  ambulo__axis_group *group;
} table;

static ambulo__place place_of(const table *t, ambulo__spot spot) {
  spot.in_table = 1;
  return ambulo__spot_place(t->sweep, spot);
}

static ambulo_status fault(const table *t, ambulo__spot spot, const char *what) {
  return ambulo__error(t->sweep->diagnostics, AMBULO_E_SCHEMA, place_of(t, spot), NULL, "%s", what);
}

static ambulo_status add_header(table *t, const ambulo__table_line *line) {
  ambulo__table_cell cell;
  size_t position = 0;
  while (ambulo__table_next_cell(line, AMBULO__CELLS_COMMA, &position, &cell)) {
    char key[AMBULO__SWEEP_TEXT];
    ambulo__spot spot = {line->number, cell.column, 1};
    ambulo__axis *axis;
    if (cell.length == 0 || cell.length >= sizeof key)
      return fault(t, spot, "a column has no name; expected a key of the problem");
    memcpy(key, cell.start, cell.length);
    key[cell.length] = '\0';
    ambulo_status status = ambulo__sweep_add_axis(t->sweep, "", key, spot, &axis);
    if (status) return status;
    t->group->axes++;
  }
  return AMBULO_OK;
}

/* a column holds numbers or words, as its first cell does */
static ambulo_status check_cell(const table *t, const ambulo__axis *axis,
                                const ambulo__table_cell *cell, ambulo__spot spot) {
  double number;
  if (cell->length == 0) return fault(t, spot, "the cell is empty; expected a value");
  if (axis->count == 0) return AMBULO_OK;
  const char *first = ambulo__axis_text(axis, 0);
  int numbers = ambulo__parse_double(first, strlen(first), &number);
  if (numbers == ambulo__parse_double(cell->start, cell->length, &number)) return AMBULO_OK;
  return ambulo__error(t->sweep->diagnostics, AMBULO_E_SCHEMA, place_of(t, spot), NULL,
                       "got '%.*s' in column '%s', which begins with '%s' in line %d; expected %s",
                       cell->length < 40 ? (int)cell->length : 40, cell->start, axis->key, first,
                       axis->value[0].spot.line, numbers ? "a number" : "a word");
}

static ambulo_status add_row(table *t, const ambulo__table_line *line) {
  ambulo__table_cell cell;
  size_t position = 0;
  int column = 0, cells = ambulo__table_count_cells(line, AMBULO__CELLS_COMMA);
  if (cells != t->group->axes) {
    ambulo__spot spot = {line->number, 1, 1};
    return ambulo__error(t->sweep->diagnostics, AMBULO_E_SCHEMA, place_of(t, spot), NULL,
                         "the row has %d cells; expected %d, as the header", cells, t->group->axes);
  }
  while (ambulo__table_next_cell(line, AMBULO__CELLS_COMMA, &position, &cell)) {
    ambulo__axis *axis = &t->sweep->axis[t->group->first + column++];
    ambulo__spot spot = {line->number, cell.column, 1};
    ambulo_status status = check_cell(t, axis, &cell, spot);
    if (!status) status = ambulo__axis_add_text(t->sweep, axis, cell.start, cell.length, spot);
    if (status) return status;
  }
  t->group->count++;
  return AMBULO_OK;
}

static ambulo_status read_lines(table *t, const char *text, size_t length) {
  ambulo__table_line line = {NULL, 0, 0, 0};
  ambulo_status status = AMBULO_OK;
  int header = 1;
  while (!status && ambulo__table_next_line(text, length, &line)) {
    if (ambulo__table_line_is_empty(&line) || line.start[0] == '#') continue;
    status = header ? add_header(t, &line) : add_row(t, &line);
    header = 0;
  }
  ambulo__spot end = {line.number, 1, 1};
  if (!status && t->group->count == 0)
    return fault(t, end, "no row below the header; expected at least one");
  return status;
}

ambulo_status ambulo__sweep_read_table(ambulo_sweep *sweep, const ambulo__yaml_node *node) {
  const char *name = ambulo__yaml_file_name(node);
  if (!name[0]) return AMBULO_E_SCHEMA;
  char *text = NULL;
  size_t length = 0;
  ambulo_status status =
      ambulo__named_file(&sweep->allocator, sweep->path, name, ambulo__yaml_place(node),
                         sweep->diagnostics, &sweep->table);
  if (status) return status;
  status = ambulo__read_file(sweep->table, MOST_TABLE_BYTES, &sweep->allocator, sweep->diagnostics,
                             &text, &length);
  if (!status)
    status =
        ambulo__refuse_foreign(text, length, AMBULO__TAKES_CSV, sweep->table, sweep->diagnostics);
  if (status) {
    ambulo__free(&sweep->allocator, text);
    return ambulo__yaml_error(node, status, NULL, "the table '%s' could not be read", sweep->table);
  }
  table t = {sweep, &sweep->group[sweep->groups]};
  t.group->first = sweep->axes;
  status = read_lines(&t, text, length);
  if (t.group->axes > 0) sweep->groups++;
  ambulo__free(&sweep->allocator, text);
  return status;
}
