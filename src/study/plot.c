/* study/plot.c - choosing what a drawing shows: which axes, which output, which cases. */
#include "study/plot.h"
#include "base/sized.h"
#include "formats/atomic_file.h"
#include "formats/paths.h"
#include "show/svg.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WORD = 200 };

static ambulo_status no_such(const ambulo__plot *p, const char *what, const char *name) {
  const ambulo__listing *l = p->listing;
  const char *known[AMBULO__LISTING_NAMES];
  int count = 0, axis = strcmp(what, "axis") == 0;
  for (int i = AMBULO__LISTING_AXES; axis && i < l->columns && count < AMBULO__LISTING_NAMES; i++)
    known[count++] = ambulo__listing_title(l, i);
  for (int i = 0; !axis && i < l->outputs && count < AMBULO__LISTING_NAMES; i++)
    known[count++] = l->output_label[i];
  const char *near = ambulo__nearest(name, known, (size_t)count);
  char hint[WORD + 40] = "the first line of results.csv names axes and outputs";
  if (near) (void)snprintf(hint, sizeof hint, "did you mean '%.200s'?", near);
  ambulo__place place = {p->directory, 0, 0, NULL};
  return ambulo__error(p->diagnostics, AMBULO_E_ARGUMENT, place, hint,
                       "no %s '%s' in this batch; expected X:OUTPUT or X,Y:OUTPUT", what, name);
}

static int find_axis(const ambulo__listing *l, const char *name) {
  for (int i = AMBULO__LISTING_AXES; i < l->columns; i++)
    if (strcmp(ambulo__listing_title(l, i), name) == 0) return i;
  return -1;
}

/* "X:OUTPUT" or "X,Y:OUTPUT" */
static ambulo_status parse(ambulo__plot *p, const char *text) {
  const ambulo__listing *l = p->listing;
  char axes[WORD], *second;
  const char *colon = strchr(text, ':');
  if (!colon || (size_t)(colon - text) >= sizeof axes) return no_such(p, "plot", text);
  memcpy(axes, text, (size_t)(colon - text));
  axes[colon - text] = '\0';
  second = strchr(axes, ',');
  if (second) *second++ = '\0';
  p->axis[0].column = find_axis(l, axes);
  p->axis[1].column = second ? find_axis(l, second) : -1;
  if (p->axis[0].column < 0) return no_such(p, "axis", axes);
  if (second && p->axis[1].column < 0) return no_such(p, "axis", second);
  p->output = ambulo__listing_output(l, colon + 1);
  return p->output >= 0 ? AMBULO_OK : no_such(p, "output", colon + 1);
}

static ambulo_status add_point(void *user, const ambulo__gathered *one) {
  ambulo__plot *p = user;
  int holds = 1;
  ambulo_status status = ambulo__plot_passes(p, one, &holds);
  if (status || !holds) return status;
  const ambulo__output *value = &one->value[p->output];
  ambulo__plot_point *point = &p->point[p->points++];
  point->index = one->index;
  (void)snprintf(point->state, sizeof point->state, "%.20s", one->state);
  point->valid = one->valid;
  point->has_value = value->kind == AMBULO__OUTPUT_NUMBER && isfinite(value->number);
  point->value = point->has_value ? value->number : 0.0;
  p->values += point->has_value;
  return AMBULO_OK;
}

/* Small and large numbers are shown as multiples of a thousand to some power. */
static void scale(ambulo__plot *p) {
  int all = 1;
  double most = 0.0;
  for (int i = 0; i < p->points; i++) {
    if (p->point[i].has_value && p->point[i].valid) all = 0;
    most = fmax(most, fabs(p->point[i].value));
  }
  if (most > 0.0 && (most < 0.01 || most >= 1e5))
    p->exponent = 3 * (int)floor(log10(most) / 3.0 + 1e-9);
  p->low = INFINITY;
  p->high = -INFINITY;
  for (int i = 0; i < p->points; i++) {
    ambulo__plot_point *point = &p->point[i];
    point->value /= pow(10.0, p->exponent);
    if (!point->has_value || !(point->valid || all)) continue;
    p->low = fmin(p->low, point->value);
    p->high = fmax(p->high, point->value);
  }
}

/* "results_speed_objective.svg", "results_speed_objective_where_sex___male.svg" */
static ambulo_status name_file(const ambulo__plot *p, const char *plot, char **path) {
  const ambulo_allocator *a = &p->listing->allocator;
  ambulo__text_buffer name;
  ambulo__text_init(&name, a);
  ambulo__text_append(&name, "results_");
  ambulo__plot_append_cut(&name, plot, WORD - 20);
  for (int i = 0; i < p->options.where_count; i++) {
    ambulo__text_append(&name, i ? "_and_" : "_where_");
    ambulo__plot_append_cut(&name, p->options.where[i], WORD / 8);
  }
  for (size_t i = 0; i < name.length; i++)
    if (!isalnum((unsigned char)name.data[i])) name.data[i] = '_';
  if (name.length > WORD) name.length = WORD;
  if (name.data) name.data[name.length] = '\0';
  ambulo__text_append(&name, ".svg");
  ambulo_status status = ambulo__text_status(&name);
  if (!status) *path = ambulo__join_paths(a, p->directory, ambulo__text_data(&name), NULL);
  if (!status && !*path) status = AMBULO_E_MEMORY;
  ambulo__text_free(&name);
  return status;
}

static ambulo_status collect_points(ambulo__plot *p, const char *plot) {
  const ambulo__listing *l = p->listing;
  p->point = ambulo__alloc(&l->allocator, (size_t)l->cases, sizeof *p->point);
  ambulo_status status = p->point ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = ambulo__gather(p->directory, l, AMBULO__GATHER_OUTPUTS, add_point, p, NULL);
  if (!status && p->values == 0) return no_such(p, "number for the output of", plot);
  for (int i = 0; i < 2 && !status && p->axis[i].column >= 0; i++) {
    status = ambulo__plot_axis_make(l, p->point, p->points, p->axis[i].column, &p->axis[i]);
    for (int k = 0; k < p->points && !status; k++)
      p->point[k].place[i] = ambulo__plot_axis_place(
          &p->axis[i], ambulo__listing_cell(l, p->point[k].index, p->axis[i].column));
  }
  if (!status) scale(p);
  return status;
}

static ambulo_status draw(ambulo__plot *p, const char *plot, char **file) {
  const ambulo_allocator *a = &p->listing->allocator;
  char *path = NULL;
  ambulo_status status = collect_points(p, plot);
  ambulo__text_buffer svg;
  ambulo__text_init(&svg, a);
  if (!status)
    status = p->axis[1].column < 0 ? ambulo__plot_curves(p, &svg) : ambulo__plot_map(p, &svg);
  ambulo__svg_end(&svg);
  if (!status) status = ambulo__text_status(&svg);
  if (!status) status = name_file(p, plot, &path);
  if (!status)
    status = ambulo__write_file(path, ambulo__text_data(&svg), svg.length, 1, a, p->diagnostics);
  if (status) {
    ambulo__free(a, path);
  } else {
    *file = path;
  }
  ambulo__text_free(&svg);
  ambulo__free(a, p->point);
  for (int i = 0; i < 2; i++) ambulo__plot_axis_free(p->listing, &p->axis[i]);
  return status;
}

AMBULO__FILL(ambulo_plot_options, {.size = size})

static int acceptable(const ambulo_plot_options *o) {
  return o->where_count >= 0 && (o->where || o->where_count == 0);
}

ambulo_status ambulo_batch_plot(const char *directory, const char *plot,
                                const ambulo_plot_options *options,
                                const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                                char **file) {
  ambulo__plot p = {.directory = directory, .diagnostics = diagnostics};
  if (!AMBULO__OWN(ambulo_plot_options, &p.options, options)) return AMBULO_E_ARGUMENT;
  if (!directory || !plot || !file || !acceptable(&p.options)) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo__listing listing;
  ambulo_status status = ambulo__listing_load(directory, allocator, diagnostics, &listing);
  if (!status) {
    p.listing = &listing;
    status = parse(&p, plot);
    if (!status) status = ambulo__plot_check_where(&p);
    if (!status) status = draw(&p, plot, file);
    ambulo__listing_free(&listing);
  }
  return ambulo__conclude(diagnostics, errors, status, directory);
}
