/* study/plot_axes.c - the values of an axis, in order, and where they stand. */
#include "base/numtext.h"
#include "study/plot.h"

#include <stdlib.h>
#include <string.h>

typedef struct entry {
  const char *text;
  double number;
  int first; /* point it was first seen in */
} entry;

static int by_number(const void *left, const void *right) {
  const entry *a = left, *b = right;
  if (a->number != b->number) return a->number < b->number ? -1 : 1;
  return (a->first > b->first) - (a->first < b->first);
}

static int by_text(const void *left, const void *right) {
  const entry *a = left, *b = right;
  int order = strcmp(a->text, b->text);
  return order ? order : (a->first > b->first) - (a->first < b->first);
}

static int by_first(const void *left, const void *right) {
  const entry *a = left, *b = right;
  return (a->first > b->first) - (a->first < b->first);
}

/* sorted entries without their repetitions; their number */
static int unique(entry *e, int count, int numeric) {
  int kept = 0;
  for (int i = 0; i < count; i++) {
    int again = kept > 0 && (numeric ? e[i].number == e[kept - 1].number
                                     : strcmp(e[i].text, e[kept - 1].text) == 0);
    if (!again) e[kept++] = e[i];
  }
  return kept;
}

ambulo_status ambulo__plot_axis_make(const ambulo__listing *l, const ambulo__plot_point *point,
                                     int points, int column, ambulo__plot_axis *axis) {
  entry *e = ambulo__alloc(&l->allocator, (size_t)points, sizeof *e);
  if (!e) return AMBULO_E_MEMORY;
  axis->column = column;
  axis->numeric = 1;
  for (int k = 0; k < points; k++) {
    e[k].text = ambulo__listing_cell(l, point[k].index, column);
    e[k].first = k;
    axis->numeric &= ambulo__parse_double(e[k].text, strlen(e[k].text), &e[k].number);
  }
  qsort(e, (size_t)points, sizeof *e, axis->numeric ? by_number : by_text);
  axis->count = unique(e, points, axis->numeric);
  if (!axis->numeric) qsort(e, (size_t)axis->count, sizeof *e, by_first);
  axis->text = ambulo__alloc(&l->allocator, (size_t)axis->count, sizeof *axis->text);
  axis->at = ambulo__alloc(&l->allocator, (size_t)axis->count, sizeof *axis->at);
  for (int i = 0; axis->text && axis->at && i < axis->count; i++) {
    axis->text[i] = e[i].text;
    axis->at[i] = axis->numeric ? e[i].number : i;
  }
  ambulo__free(&l->allocator, e);
  return axis->text && axis->at ? AMBULO_OK : AMBULO_E_MEMORY;
}

void ambulo__plot_axis_free(const ambulo__listing *l, ambulo__plot_axis *axis) {
  ambulo__free(&l->allocator, (void *)axis->text);
  ambulo__free(&l->allocator, axis->at);
  memset(axis, 0, sizeof *axis);
}

int ambulo__plot_axis_place(const ambulo__plot_axis *axis, const char *text) {
  double number = 0.0;
  int low = 0, high = axis->count - 1;
  if (!axis->numeric) {
    while (low < high && strcmp(axis->text[low], text) != 0) low++;
    return low;
  }
  (void)ambulo__parse_double(text, strlen(text), &number);
  while (low < high) {
    int middle = low + (high - low) / 2;
    if (axis->at[middle] < number) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

double ambulo__plot_axis_share(const ambulo__plot_axis *axis, int place, double inset) {
  double first = axis->at[0], last = axis->at[axis->count - 1];
  double share = last > first ? (axis->at[place] - first) / (last - first) : 0.5;
  return inset + (1.0 - 2.0 * inset) * share;
}
