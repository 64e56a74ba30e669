/* study/plot_map.c - an output over two axes.
 *
 * A cell of the heat map has the colour of the mean over its cases with a valid solution; each
 * of its cases is a dot at its lower edge, with a colour and a link of its own. Where nearly
 * every case has values of its own (samples), cases are dots in a plane instead. */
#include "study/plot.h"
#include "show/svg.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double cloud_inset = 0.02, dot = 3.2, least_dot = 1.6, scale_height = 200.0;
enum { SCALE_STEPS = 24, DOT_SIZES = 4 };

static int by_cell(const void *left, const void *right) {
  const ambulo__plot_point *a = *(ambulo__plot_point *const *)left,
                           *b = *(ambulo__plot_point *const *)right;
  if (a->place[0] != b->place[0]) return a->place[0] - b->place[0];
  if (a->place[1] != b->place[1]) return a->place[1] - b->place[1];
  return a->index - b->index;
}

/* -------------------------------------------------------------- legend */

/* of the unit and the numbers, px */
static double legend_width(const ambulo__plot *p, ambulo__text_buffer *svg) {
  ambulo__text_buffer text;
  ambulo__text_init_part(&text, svg);
  ambulo__plot_append_unit(p, &text);
  double width = ambulo__plot_text_width(ambulo__text_data(&text), 13.0, 1);
  ambulo__text_free(&text);
  return fmax(width, 28.0 + ambulo__plot_text_width("-0.00000", 12.0, 0));
}

static void draw_scale(const ambulo__plot *p, ambulo__text_buffer *svg) {
  double x = p->layout.legend, y = p->layout.top + 22.0, h = scale_height / SCALE_STEPS;
  ambulo__text_buffer text;
  ambulo__text_init_part(&text, svg);
  ambulo__plot_append_unit(p, &text);
  ambulo__svg_label(svg, "panel", x, y - 14.0, ambulo__text_data(&text));
  ambulo__text_free(&text);
  for (int i = 0; i < SCALE_STEPS; i++) {
    char colour[8];
    ambulo__plot_shade(1.0 - (i + 0.5) / SCALE_STEPS, colour);
    ambulo__text_append_format(svg, "<rect x=\"%d\" width=\"18\" y=\"", (int)x);
    ambulo__text_append_number(svg, round(100.0 * (y + i * h)) / 100.0);
    ambulo__text_append_format(svg, "\" height=\"%d\" fill=\"%s\"/>\n", (int)ceil(h), colour);
  }
  int decimals = 0;
  double step = ambulo__nice_step(p->high > p->low ? p->high - p->low : 1.0, 5, &decimals);
  double first = ceil(p->low / step - 1e-9) * step;
  for (int i = 0; i < 12 && first + i * step <= p->high + 1e-9 * step; i++) {
    double at = y + scale_height * (1.0 - ambulo__plot_share(p, first + i * step));
    ambulo__svg_line(svg, "axis", x + 18.0, at, x + 23.0, at);
    ambulo__plot_number(svg, "", x + 28.0, at + 4.0, first + i * step, decimals);
  }
  ambulo__plot_remarks(p, svg, y + scale_height + 36.0);
}

/* --------------------------------------------------------------- cells */

typedef struct cell {
  double x, y, width, height; /* px */
  ambulo__plot_point *const *point;
  int cases, valid;
  double mean; /* of the valid ones */
} cell;

/* Rows of dots in the lower part of a cell: how large, and how many in a row. 0: they do not fit
 * without hiding each other. */
typedef struct dots {
  double radius, gap;
  int columns, rows;
} dots;

static int fit_dots(const cell *c, dots *d) {
  double width = c->width - 8.0, height = 0.5 * c->height - 8.0;
  for (int size = DOT_SIZES; size >= 0; size--) {
    d->radius = least_dot + 0.4 * size;
    d->gap = 2.0 * d->radius + 2.5;
    if (width < d->gap || height < d->gap) continue;
    d->columns = (int)(width / d->gap);
    d->rows = (c->cases + d->columns - 1) / d->columns;
    if (d->rows * d->gap <= height) return 1;
  }
  return 0;
}

static void draw_dots(const ambulo__plot *p, ambulo__text_buffer *svg, const cell *c,
                      const dots *d) {
  int columns = (c->cases + d->rows - 1) / d->rows; /* rows of about one length */
  double left = c->x + 0.5 * (c->width - d->gap * (columns - 1));
  double top = c->y + c->height - 6.0 - d->gap * (d->rows - 0.5);
  for (int i = 0; i < c->cases; i++) {
    const ambulo__plot_point *point = c->point[i];
    int row = i / columns;
    double x = left + d->gap * (i % columns), y = top + d->gap * row;
    char colour[8];
    ambulo__plot_shade(ambulo__plot_share(p, point->value), colour);
    ambulo__plot_case_begin(p, svg, point);
    if (point->has_value) {
      ambulo__plot_mark(svg, x, y, d->radius, point->valid ? colour : NULL, "#8b96a2");
    } else {
      ambulo__plot_cross(svg, x, y, d->radius);
    }
    ambulo__plot_case_end(svg);
  }
}

/* the first case with a valid solution, or else the first */
static const ambulo__plot_point *leader(const cell *c) {
  for (int i = 0; i < c->cases; i++)
    if (c->point[i]->has_value && c->point[i]->valid) return c->point[i];
  return c->point[0];
}

static void draw_cell(const ambulo__plot *p, ambulo__text_buffer *svg, const cell *c) {
  char colour[8] = "#eef0f2";
  double share = ambulo__plot_share(p, c->mean);
  int decimals = 0;
  (void)ambulo__nice_step(p->high > p->low ? p->high - p->low : 1.0, 60, &decimals);
  if (c->valid > 0) ambulo__plot_shade(share, colour);
  ambulo__plot_case_begin(p, svg, leader(c));
  ambulo__text_append_format(
      svg, "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" fill=\"%s\"/>\n", (int)floor(c->x),
      (int)floor(c->y), (int)ceil(c->width), (int)ceil(c->height), colour);
  dots d;
  int dotted = (c->cases > 1 || !c->valid) && fit_dots(c, &d);
  if (c->valid > 0 && c->width >= 40.0 && c->height >= 16.0)
    ambulo__plot_number(svg, share > 0.45 ? "on-dark" : "on-light", c->x + 0.5 * c->width,
                        c->y + (dotted ? 0.3 : 0.5) * c->height + 4.0, c->mean, decimals);
  ambulo__plot_case_end(svg);
  if (dotted) draw_dots(p, svg, c, &d);
  if (!dotted && c->valid == 0)
    ambulo__plot_cross(svg, c->x + 0.5 * c->width, c->y + 0.5 * c->height, dot);
}

static void measure(cell *c) {
  c->valid = 0;
  c->mean = 0.0;
  for (int i = 0; i < c->cases; i++) {
    if (!c->point[i]->has_value || !c->point[i]->valid) continue;
    c->mean += c->point[i]->value;
    c->valid++;
  }
  if (c->valid > 0) c->mean /= c->valid;
}

/* the end of the cell that begins at `first` */
static int end_of_cell(const ambulo__plot *p, ambulo__plot_point *const *order, int first) {
  const int *at = order[first]->place;
  int end = first + 1;
  while (end < p->points && order[end]->place[0] == at[0] && order[end]->place[1] == at[1]) end++;
  return end;
}

static int most_in_a_cell(const ambulo__plot *p, ambulo__plot_point *const *order) {
  int most = 0;
  for (int first = 0, end; first < p->points; first = end) {
    end = end_of_cell(p, order, first);
    if (end - first > most) most = end - first;
  }
  return most;
}

static void walk_cells(const ambulo__plot *p, ambulo__plot_point *const *order,
                       ambulo__text_buffer *svg) {
  const ambulo__plot_layout *l = &p->layout;
  double w = l->width / p->axis[0].count, h = l->height / p->axis[1].count;
  for (int first = 0, end; first < p->points; first = end) {
    const int *at = order[first]->place;
    end = end_of_cell(p, order, first);
    cell c = {.x = l->left + w * at[0],
              .y = l->top + h * (p->axis[1].count - 1 - at[1]),
              .width = w,
              .height = h,
              .point = order + first,
              .cases = end - first};
    measure(&c);
    draw_cell(p, svg, &c);
  }
}

static void draw_cells(ambulo__plot *p, ambulo__plot_point *const *order,
                       ambulo__text_buffer *svg) {
  char remark[80] = "";
  int most = most_in_a_cell(p, order);
  if (most > 1) (void)snprintf(remark, sizeof remark, "a cell is the mean of up to %d", most);
  ambulo__plot_arrange(p, 1, legend_width(p, svg), remark, svg);
  ambulo__plot_begin(p, svg, remark);
  for (int i = 0; i < 2; i++) {
    for (int k = 0; k < p->axis[i].count; k++) p->axis[i].at[k] = k;
    ambulo__plot_labels(p, svg, i, 0.5 / p->axis[i].count, 1);
  }
  walk_cells(p, order, svg);
}

/* --------------------------------------------------------------- cloud */

static void draw_cloud(ambulo__plot *p, ambulo__text_buffer *svg) {
  const ambulo__plot_layout *l = &p->layout;
  ambulo__plot_arrange(p, 0, legend_width(p, svg), "", svg);
  /* many points are small ones, so that most of them are seen */
  double radius = fmax(1.8, fmin(6.0, 0.2 * sqrt(l->width * l->height / p->points)));
  ambulo__plot_begin(p, svg, "");
  for (int i = 0; i < 2; i++) ambulo__plot_labels(p, svg, i, cloud_inset, 0);
  ambulo__svg_rectangle(svg, "soil", l->left, l->top, l->width, l->height);
  for (int i = 0; i < p->points; i++) {
    const ambulo__plot_point *point = &p->point[i];
    double x =
        l->left + l->width * ambulo__plot_axis_share(&p->axis[0], point->place[0], cloud_inset);
    double y = l->top + l->height * (1.0 - ambulo__plot_axis_share(&p->axis[1], point->place[1],
                                                                   cloud_inset));
    char colour[8];
    ambulo__plot_shade(ambulo__plot_share(p, point->value), colour);
    ambulo__plot_case_begin(p, svg, point);
    if (point->has_value) {
      ambulo__plot_mark(svg, x, y, radius, point->valid ? colour : NULL, "#8b96a2");
    } else {
      ambulo__plot_cross(svg, x, y, radius);
    }
    ambulo__plot_case_end(svg);
  }
}

ambulo_status ambulo__plot_map(const ambulo__plot *plot, ambulo__text_buffer *svg) {
  ambulo__plot p = *plot;
  ambulo__plot_point **order =
      ambulo__alloc(&p.listing->allocator, (size_t)p.points, sizeof *order);
  if (!order) return AMBULO_E_MEMORY;
  for (int i = 0; i < p.points; i++) order[i] = &p.point[i];
  qsort((void *)order, (size_t)p.points, sizeof *order, by_cell);
  double cells = (double)p.axis[0].count * p.axis[1].count;
  int cloud = p.axis[0].numeric && p.axis[1].numeric && cells > 4.0 * p.points;
  if (cloud) {
    draw_cloud(&p, svg);
  } else {
    draw_cells(&p, order, svg);
  }
  draw_scale(&p, svg);
  ambulo__free(&p.listing->allocator, (void *)order);
  return AMBULO_OK;
}
