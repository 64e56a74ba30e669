/* show/case_table.c - see case_table.h. */
#include "show/case_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/numtext.h"

/* of numbers of six digits, and of their ratio */
static const double alike = 1e-5;

/* leaves of one form: [rows][columns] */
typedef struct table {
  int rows, columns;
  const char **text;
  double *number; /* NaN: a text, or null */
} table;

static int column_is(const table *t, int column, int (*holds)(const table *, int, int)) {
  for (int i = 0; i < t->rows; i++)
    if (!holds(t, i, column)) return 0;
  return 1;
}

static int is_first(const table *t, int row, int column) {
  return strcmp(t->text[row * t->columns + column], t->text[column]) == 0;
}

static int is_number(const table *t, int row, int column) {
  return !isnan(t->number[row * t->columns + column]);
}

/* 1: the column is *ratio times column `of`, whose largest number tells the ratio best */
static int is_multiple(const table *t, int column, int of, double *ratio) {
  int best = 0;
  for (int i = 1; i < t->rows; i++)
    if (fabs(t->number[i * t->columns + of]) > fabs(t->number[best * t->columns + of])) best = i;
  *ratio = t->number[best * t->columns + column] / t->number[best * t->columns + of];
  for (int i = 0; i < t->rows; i++) {
    double value = t->number[i * t->columns + column];
    if (!(fabs(value - *ratio * t->number[i * t->columns + of]) <= alike * fabs(value))) return 0;
  }
  return 1;
}

static void append_column(ambulo__text_buffer *out, const table *t, int column) {
  int same = column_is(t, column, is_first);
  int numbers = !same && column_is(t, column, is_number);
  double ratio;
  for (int of = 0; numbers && of < column; of++) {
    if (!is_multiple(t, column, of, &ratio)) continue;
    ambulo__text_append_format(out, "{\"of\":%d,\"by\":", of);
    ambulo__text_append_number(out, ratio);
    ambulo__text_append_char(out, '}');
    return;
  }
  ambulo__text_append_char(out, '[');
  for (int i = 0; i < (same ? 1 : t->rows); i++) {
    if (i) ambulo__text_append_char(out, ',');
    ambulo__text_append(out, t->text[i * t->columns + column]);
  }
  ambulo__text_append_char(out, ']');
}

static void fill_row(table *t, int row, const ambulo__case_data *data) {
  const char *text = ambulo__text_data(&data->leaves);
  for (int i = 0; i < t->columns; i++, text += strlen(text) + 1) {
    double *number = t->number + row * t->columns + i;
    t->text[row * t->columns + i] = text;
    if (!ambulo__parse_double(text, strlen(text), number)) *number = (double)NAN;
  }
}

static ambulo_status append_form(ambulo__text_buffer *out, const ambulo__case_data *cases,
                                 int count, const int *form, int first) {
  const ambulo_allocator *a = &out->allocator;
  table t = {.columns = cases[first].leaf_count};
  for (int i = first; i < count; i++) t.rows += form[i] == form[first];
  size_t cells = (size_t)t.rows * (size_t)t.columns;
  t.text = ambulo__alloc(a, cells, sizeof *t.text);
  t.number = ambulo__alloc(a, cells, sizeof *t.number);
  ambulo_status status = t.text && t.number ? AMBULO_OK : AMBULO_E_MEMORY;
  for (int i = first, row = 0; i < count && !status; i++)
    if (form[i] == form[first]) fill_row(&t, row++, cases + i);
  ambulo__text_append(out, "{\"tree\":");
  ambulo__text_append(out, ambulo__text_data(&cases[first].form));
  ambulo__text_append(out, ",\"columns\":[");
  for (int i = 0; i < t.columns && !status; i++) {
    if (i) ambulo__text_append_char(out, ',');
    append_column(out, &t, i);
  }
  ambulo__text_append(out, "]}");
  ambulo__free(a, t.number);
  ambulo__free(a, (void *)t.text);
  return status;
}

ambulo_status ambulo__case_table(ambulo__text_buffer *out, const ambulo__case_data *cases,
                                 int count, int *form) {
  ambulo_status status = AMBULO_OK;
  int forms = 0;
  for (int i = 0; i < count; i++) {
    form[i] = -1;
    for (int k = i - 1; k >= 0 && form[i] < 0; k--)
      if (strcmp(ambulo__text_data(&cases[k].form), ambulo__text_data(&cases[i].form)) == 0)
        form[i] = form[k];
    if (form[i] < 0) form[i] = forms++;
  }
  ambulo__text_append_char(out, '[');
  for (int i = 0, next = 0; i < count && !status; i++) {
    if (form[i] != next) continue;
    if (next++) ambulo__text_append_char(out, ',');
    status = append_form(out, cases, count, form, i);
  }
  ambulo__text_append_char(out, ']');
  return status ? status : ambulo__text_status(out);
}
