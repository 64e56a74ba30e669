/* batch/plot.c - choosing the points of a drawing: which axes, which output, which cases. */
#include "batch/plot.h"
#include "base/atomic_file.h"
#include "base/numtext.h"
#include "batch/paths.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { WORD = 200 };

static ambulo_status no_such(ambulo_diagnostics *diagnostics, const char *directory,
                             const char *what, const char *name) {
  ambulo__place place = {directory, 0, 0, NULL};
  return ambulo__error(diagnostics, AMBULO_E_ARGUMENT, place,
                       "the first line of results.csv names axes and outputs",
                       "no %s '%s' in this batch; expected X:OUTPUT or X,Y:OUTPUT", what, name);
}

static int find_axis(const ambulo__listing *l, const char *name) {
  for (int i = AMBULO__LISTING_AXES; i < l->columns; i++)
    if (strcmp(ambulo__listing_title(l, i), name) == 0) return i;
  return -1;
}

/* "X:OUTPUT" or "X,Y:OUTPUT" */
static ambulo_status parse(ambulo__plot *p, const char *directory, const char *text,
                           ambulo_diagnostics *diagnostics) {
  char axes[WORD], *second;
  const char *colon = strchr(text, ':');
  if (!colon || (size_t)(colon - text) >= sizeof axes)
    return no_such(diagnostics, directory, "plot", text);
  memcpy(axes, text, (size_t)(colon - text));
  axes[colon - text] = '\0';
  second = strchr(axes, ',');
  if (second) *second++ = '\0';
  p->x_column = find_axis(p->listing, axes);
  p->y_column = second ? find_axis(p->listing, second) : -1;
  if (p->x_column < 0) return no_such(diagnostics, directory, "axis", axes);
  if (second && p->y_column < 0) return no_such(diagnostics, directory, "axis", second);
  for (p->output = 0; p->output < p->listing->outputs; p->output++)
    if (strcmp(p->listing->output[p->output], colon + 1) == 0) return AMBULO_OK;
  return no_such(diagnostics, directory, "output", colon + 1);
}

static int find_seen(const ambulo__plot *p, int axis, const char *text) {
  int place = 0;
  while (place < p->seen_count[axis] && strcmp(p->seen[axis][place], text) != 0) place++;
  return place;
}

/* the number of a cell; on an axis that is listed: its place in the list */
static double place_of(const ambulo__plot *p, int index, int axis) {
  const char *text = ambulo__listing_cell(p->listing, index, axis ? p->y_column : p->x_column);
  double number = 0.0;
  if (p->seen[axis]) return find_seen(p, axis, text);
  (void)ambulo__parse_double(text, strlen(text), &number);
  return number;
}

/* lists the distinct texts of an axis: of words, and both axes of a heat map */
static ambulo_status list_axis(ambulo__plot *p, int axis) {
  const ambulo__listing *l = p->listing;
  int column = axis ? p->y_column : p->x_column, listed = p->y_column >= 0;
  double number;
  for (int k = 0; column >= 0 && k < l->cases && !listed; k++) {
    const char *text = ambulo__listing_cell(l, k, column);
    listed = !ambulo__parse_double(text, strlen(text), &number);
  }
  if (column < 0 || !listed) return AMBULO_OK;
  p->seen[axis] = ambulo__alloc(&l->allocator, (size_t)l->cases, sizeof *p->seen[axis]);
  if (!p->seen[axis]) return AMBULO_E_MEMORY;
  for (int k = 0; k < l->cases; k++) {
    const char *text = ambulo__listing_cell(l, k, column);
    int place = find_seen(p, axis, text);
    p->seen[axis][place] = text;
    p->seen_count[axis] += place == p->seen_count[axis];
  }
  return AMBULO_OK;
}

static ambulo_status add_point(void *user, const ambulo__gathered *one) {
  ambulo__plot *p = user;
  const ambulo__output *value = &one->value[p->output];
  if (value->kind != AMBULO__OUTPUT_NUMBER) return AMBULO_OK;
  ambulo__plot_point *point = &p->point[p->points++];
  point->index = one->index;
  point->value = value->number;
  point->x = place_of(p, one->index, 0);
  point->y = p->y_column < 0 ? 0.0 : place_of(p, one->index, 1);
  return AMBULO_OK;
}

static char *file_name(const ambulo_allocator *a, const char *directory, const char *plot) {
  char name[WORD + 16];
  int length = snprintf(name, sizeof name, "results_%.180s.svg", plot);
  for (int i = 0; i < length - 4; i++)
    if (!isalnum((unsigned char)name[i])) name[i] = '_';
  return ambulo__join_paths(a, directory, name, NULL);
}

static ambulo_status draw(ambulo__plot *p, const char *directory, const char *plot,
                          ambulo_diagnostics *diagnostics, char **file) {
  const ambulo_allocator *a = &p->listing->allocator;
  p->point = ambulo__alloc(a, (size_t)p->listing->cases, sizeof *p->point);
  ambulo_status status = p->point ? list_axis(p, 0) : AMBULO_E_MEMORY;
  if (!status) status = list_axis(p, 1);
  if (!status) status = ambulo__gather(directory, p->listing, 1, add_point, p, NULL);
  if (!status && p->points == 0)
    status = no_such(diagnostics, directory, "number for the output of", plot);
  ambulo__text_buffer svg;
  ambulo__text_init(&svg, a);
  if (!status) status = ambulo__plot_draw(p, &svg);
  char *path = file_name(a, directory, plot);
  if (!status && !path) status = AMBULO_E_MEMORY;
  if (!status)
    status = ambulo__write_file(path, ambulo__text_data(&svg), svg.length, 1, a, diagnostics);
  if (status) {
    ambulo__free(a, path);
  } else {
    *file = path;
  }
  ambulo__text_free(&svg);
  ambulo__free(a, p->point);
  ambulo__free(a, (void *)p->seen[0]);
  ambulo__free(a, (void *)p->seen[1]);
  return status;
}

ambulo_status ambulo_batch_plot(const char *directory, const char *plot,
                                const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                char **file) {
  if (!directory || !plot || !file) return AMBULO_E_ARGUMENT;
  ambulo__listing listing;
  ambulo_status status = ambulo__listing_load(directory, allocator, diagnostics, &listing);
  if (status) return status;
  ambulo__plot p;
  memset(&p, 0, sizeof p);
  p.listing = &listing;
  status = parse(&p, directory, plot, diagnostics);
  if (!status) status = draw(&p, directory, plot, diagnostics, file);
  ambulo__listing_free(&listing);
  return status;
}
