/* batch/plot_curves.c - an output over one axis.
 *
 * A curve joins the cases that differ along the axis alone; columns that go with it (the others
 * of a table) count as the axis. Curves are coloured by the other axis that tells most about
 * the values: the one with the greatest sum of squares between its groups. */
#include "batch/paths.h"
#include "batch/plot.h"
#include "report/svg.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double inset_words = 0.08, inset_numbers = 0.02, value_inset = 0.04;

/* for words; numbers take shades */
static const char *const palette[AMBULO__PLOT_COLOURS] = {
    "#2377bd", "#e0662f", "#2f8f5b", "#8a5fb0", "#b8901f", "#35a3b5", "#b0486f", "#6b7785"};

typedef struct joined {
  unsigned long long curve;
  const ambulo__plot_point *point;
} joined;

typedef struct curves {
  const ambulo__plot *plot;
  unsigned char *tied;      /* [columns] goes with the axis, or never varies */
  ambulo__plot_axis colour; /* column < 0: one colour for all */
  joined *order;            /* [plot->points] by curve, then along the axis */
  double inset;
} curves;

/* 1: the column says nothing that x does not say */
static int goes_with_x(const ambulo__plot *p, int column, const char **first) {
  memset((void *)first, 0, (size_t)p->axis[0].count * sizeof *first);
  int repeats = 0;
  for (int i = 0; i < p->points; i++) {
    const char **seen = &first[p->point[i].place[0]];
    const char *text = ambulo__listing_cell(p->listing, p->point[i].index, column);
    if (*seen && strcmp(*seen, text) != 0) return 0;
    repeats |= *seen != NULL;
    *seen = text;
  }
  return repeats;
}

static int by_curve(const void *left, const void *right) {
  const joined *a = left, *b = right;
  if (a->curve != b->curve) return a->curve < b->curve ? -1 : 1;
  int order = a->point->place[0] - b->point->place[0];
  return order ? order : a->point->index - b->point->index;
}

static void sort_curves(curves *c) {
  const ambulo__plot *p = c->plot;
  for (int i = 0; i < p->points; i++) {
    unsigned long long hash = AMBULO__HASH_START;
    for (int k = AMBULO__LISTING_AXES; k < p->listing->columns; k++)
      if (!c->tied[k])
        hash = ambulo__hash_text(hash, ambulo__listing_cell(p->listing, p->point[i].index, k));
    c->order[i] = (joined){hash, &p->point[i]};
  }
  qsort(c->order, (size_t)p->points, sizeof *c->order, by_curve);
}

/* -------------------------------------------------------------- colours */

static int colour_of(const curves *c, const ambulo__plot_point *point) {
  return ambulo__plot_axis_place(
      &c->colour, ambulo__listing_cell(c->plot->listing, point->index, c->colour.column));
}

/* sum over groups of (sum of deviations)^2 / number */
static double spread_between(const curves *c, double mean) {
  double sum[AMBULO__PLOT_COLOURS] = {0.0}, spread = 0.0;
  int count[AMBULO__PLOT_COLOURS] = {0};
  for (int i = 0; i < c->plot->points; i++) {
    const ambulo__plot_point *point = &c->plot->point[i];
    if (!point->has_value) continue;
    int group = colour_of(c, point);
    sum[group] += point->value - mean;
    count[group]++;
  }
  for (int g = 0; g < c->colour.count; g++)
    if (count[g] > 0) spread += sum[g] * sum[g] / count[g];
  return spread;
}

static ambulo_status choose_colour(curves *c) {
  const ambulo__plot *p = c->plot;
  int best_column = -1;
  double mean = 0.0, best = -1.0;
  for (int i = 0; i < p->points; i++) mean += p->point[i].has_value ? p->point[i].value : 0.0;
  mean /= p->values;
  ambulo_status status = AMBULO_OK;
  for (int k = AMBULO__LISTING_AXES; k < p->listing->columns && !status; k++) {
    if (c->tied[k]) continue;
    status = ambulo__plot_axis_make(p->listing, k, &c->colour);
    if (!status && c->colour.count > 1 && c->colour.count <= AMBULO__PLOT_COLOURS) {
      double spread = spread_between(c, mean);
      if (spread > best) {
        best = spread;
        best_column = k;
      }
    }
    ambulo__plot_axis_free(p->listing, &c->colour);
  }
  if (!status && best_column >= 0)
    status = ambulo__plot_axis_make(p->listing, best_column, &c->colour);
  else
    c->colour.column = -1;
  return status;
}

static void paint_of(const curves *c, int group, char colour[8]) {
  if (c->colour.column >= 0 && c->colour.numeric) {
    ambulo__plot_shade(0.25 + 0.75 * group / (c->colour.count - 1), colour);
  } else {
    memcpy(colour, palette[group], 8);
  }
}

static void draw_legend(const curves *c, ambulo__text_buffer *svg) {
  const ambulo__listing *l = c->plot->listing;
  double x = ambulo__plot_legend, y = ambulo__plot_top + 8.0;
  if (c->colour.column >= 0) {
    const char *unit = l->axis_unit[c->colour.column - AMBULO__LISTING_AXES];
    ambulo__text_buffer text;
    ambulo__text_init_part(&text, svg);
    ambulo__text_append_format(&text, "%s%s%s", ambulo__listing_title(l, c->colour.column),
                               unit[0] ? " in " : "", unit);
    ambulo__svg_label(svg, "panel", x, y, ambulo__text_data(&text));
    ambulo__text_free(&text);
  }
  for (int g = 0; c->colour.column >= 0 && g < c->colour.count; g++) {
    char colour[8];
    paint_of(c, g, colour);
    y += 20.0;
    ambulo__plot_mark(svg, x + 6.0, y - 4.0, 4.5, colour, "#fff");
    ambulo__svg_label(svg, "", x + 18.0, y, c->colour.text[g]);
  }
  ambulo__plot_remarks(c->plot, svg, y + 30.0);
}

/* ---------------------------------------------------------------- curves */

static double x_of(const curves *c, const ambulo__plot_point *point) {
  return ambulo__plot_left +
         ambulo__plot_width * ambulo__plot_axis_share(&c->plot->axis[0], point->place[0], c->inset);
}

static double y_of(const curves *c, const ambulo__plot_point *point) {
  double share = fmax(0.0, fmin(1.0, ambulo__plot_share(c->plot, point->value)));
  return ambulo__plot_top + ambulo__plot_height * (1.0 - share);
}

/* many points are small ones */
static double radius_of(const curves *c) {
  return c->plot->points > 2000 ? 2.0 : c->plot->points > 500 ? 3.0 : 4.0;
}

static void draw_curve(const curves *c, ambulo__text_buffer *svg, int first, int end) {
  char colour[8];
  const joined *o = c->order;
  paint_of(c, c->colour.column >= 0 ? colour_of(c, o[first].point) : 0, colour);
  const ambulo__plot_point *last = NULL;
  ambulo__text_append_format(svg, "<g stroke=\"%s\" stroke-opacity=\"0.55\">\n", colour);
  for (int i = first; i < end; i++) {
    if (!o[i].point->has_value || !o[i].point->valid) continue;
    if (last)
      ambulo__svg_line(svg, "thin", x_of(c, last), y_of(c, last), x_of(c, o[i].point),
                       y_of(c, o[i].point));
    last = o[i].point;
  }
  ambulo__text_append(svg, "</g>\n");
  for (int i = first; i < end; i++) {
    const ambulo__plot_point *point = o[i].point;
    ambulo__plot_case_begin(c->plot, svg, point);
    if (point->has_value) {
      ambulo__plot_mark(svg, x_of(c, point), y_of(c, point), radius_of(c),
                        point->valid ? colour : NULL, "#fff");
    } else {
      ambulo__plot_cross(svg, x_of(c, point), ambulo__plot_top + ambulo__plot_height - 6.0);
    }
    ambulo__plot_case_end(svg);
  }
}

static ambulo_status prepare(curves *c) {
  const ambulo__plot *p = c->plot;
  const ambulo_allocator *a = &p->listing->allocator;
  c->tied = ambulo__alloc(a, (size_t)p->listing->columns, 1);
  c->order = ambulo__alloc(a, (size_t)p->points, sizeof *c->order);
  const char **first = ambulo__alloc(a, (size_t)p->axis[0].count, sizeof *first);
  int ready = c->tied && c->order && first;
  for (int i = AMBULO__LISTING_AXES; ready && i < p->listing->columns; i++)
    c->tied[i] = i == p->axis[0].column || goes_with_x(p, i, first);
  ambulo__free(a, (void *)first);
  if (!ready) return AMBULO_E_MEMORY;
  sort_curves(c);
  return choose_colour(c);
}

ambulo_status ambulo__plot_curves(const ambulo__plot *plot, ambulo__text_buffer *svg) {
  ambulo__plot p = *plot; /* with room above and below */
  double room = value_inset * (p.high > p.low ? p.high - p.low : 1.0);
  p.low -= room;
  p.high += room;
  curves c = {.plot = &p, .inset = p.axis[0].numeric ? inset_numbers : inset_words};
  c.colour.column = -1;
  ambulo_status status = prepare(&c);
  if (!status) {
    ambulo__plot_begin(&p, svg, "");
    ambulo__plot_grid(&p, svg);
    ambulo__svg_line(svg, "axis", ambulo__plot_left, ambulo__plot_top + ambulo__plot_height,
                     ambulo__plot_left + ambulo__plot_width,
                     ambulo__plot_top + ambulo__plot_height);
    ambulo__plot_labels(&p, svg, 0, c.inset, 0);
    for (int first = 0, end; first < p.points; first = end) {
      for (end = first + 1; end < p.points && c.order[end].curve == c.order[first].curve;) end++;
      draw_curve(&c, svg, first, end);
    }
    draw_legend(&c, svg);
  }
  const ambulo_allocator *a = &p.listing->allocator;
  ambulo__free(a, c.tied);
  ambulo__free(a, c.order);
  if (c.colour.column >= 0) ambulo__plot_axis_free(p.listing, &c.colour);
  return status;
}
