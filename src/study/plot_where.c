/* study/plot_where.c - which cases are drawn: comparisons of columns of the table. */
#include "study/plot.h"
#include "study/sweep.h"

#include <stdio.h>
#include <string.h>

enum { WORDS = 4 };

static const char *const words[WORDS] = {"id", "name", "state", NULL};

static int axis_of(const ambulo__listing *l, const char *name) {
  for (int i = AMBULO__LISTING_AXES; i < l->columns; i++)
    if (strcmp(ambulo__listing_title(l, i), name) == 0) return i;
  return -1;
}

static int is_column(const ambulo__listing *l, const char *name) {
  for (int i = 0; words[i]; i++)
    if (strcmp(words[i], name) == 0) return 1;
  return axis_of(l, name) >= 0 || ambulo__listing_output(l, name) >= 0;
}

static ambulo_status no_column(const ambulo__plot *p, const char *condition, const char *left) {
  const ambulo__listing *l = p->listing;
  const char *known[AMBULO__LISTING_NAMES];
  int count = 0;
  for (int i = 0; words[i]; i++) known[count++] = words[i];
  for (int i = AMBULO__LISTING_AXES; i < l->columns && count < AMBULO__LISTING_NAMES; i++)
    known[count++] = ambulo__listing_title(l, i);
  for (int i = 0; i < l->outputs && count < AMBULO__LISTING_NAMES; i++)
    known[count++] = l->output_label[i];
  const char *near = ambulo__nearest(left, known, (size_t)count);
  char hint[AMBULO__SWEEP_TEXT + 40] = "the first line of results.csv names the columns";
  if (near) (void)snprintf(hint, sizeof hint, "did you mean '%.200s'?", near);
  ambulo__place place = {p->directory, 0, 0, NULL};
  return ambulo__error(p->diagnostics, AMBULO_E_ARGUMENT, place, hint,
                       "no column of the table in '%.200s'; expected NAME < VALUE", condition);
}

ambulo_status ambulo__plot_check_where(const ambulo__plot *p) {
  ambulo__place place = {p->directory, 0, 0, NULL};
  for (int i = 0; i < p->options.where_count; i++) {
    const char *condition = p->options.where[i] ? p->options.where[i] : "";
    char left[AMBULO__SWEEP_TEXT], right[AMBULO__SWEEP_TEXT];
    if (!ambulo__filter_sides(condition, left, right))
      return ambulo__error(
          p->diagnostics, AMBULO_E_ARGUMENT, place, NULL,
          "'%.200s' is no comparison; expected NAME < VALUE with < <= > >= == !=", condition);
    if (!is_column(p->listing, left) && !is_column(p->listing, right))
      return no_column(p, condition, left);
  }
  return AMBULO_OK;
}

typedef struct row {
  const ambulo__listing *listing;
  const ambulo__gathered *one;
  int empty; /* a side has no value in this case */
} row;

static const char *text_of(void *user, const char *name) {
  row *r = user;
  const ambulo__listing *l = r->listing;
  const char *text = NULL;
  int axis = axis_of(l, name), output = ambulo__listing_output(l, name);
  if (axis >= 0) {
    text = ambulo__listing_cell(l, r->one->index, axis);
  } else if (strcmp(name, "state") == 0) {
    text = r->one->state;
  } else if (strcmp(name, "name") == 0) {
    text = ambulo__listing_cell(l, r->one->index, AMBULO__LISTING_NAME);
  } else if (strcmp(name, "id") == 0) {
    text = ambulo__listing_cell(l, r->one->index, AMBULO__LISTING_ID);
  } else if (output >= 0) {
    text = r->one->value[output].text;
  }
  if (text && !text[0]) r->empty = 1;
  return text;
}

ambulo_status ambulo__plot_passes(const ambulo__plot *p, const ambulo__gathered *one, int *holds) {
  *holds = 1;
  for (int i = 0; i < p->options.where_count && *holds; i++) {
    row r = {p->listing, one, 0};
    int held = ambulo__filter_holds(p->options.where[i], text_of, &r);
    if (held < 0 && !r.empty) {
      ambulo__place place = {p->directory, 0, 0, NULL};
      return ambulo__error(p->diagnostics, AMBULO_E_ARGUMENT, place, NULL,
                           "'%.200s' compares words by size in case '%.60s'; expected == or != "
                           "with words",
                           p->options.where[i],
                           ambulo__listing_cell(p->listing, one->index, AMBULO__LISTING_NAME));
    }
    *holds = held > 0;
  }
  return AMBULO_OK;
}
