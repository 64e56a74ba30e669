/* batch/plot_map.c - an output over two axes.
 *
 * A cell of the heat map has the colour of the mean over its cases with a valid solution; each
 * of its cases is a dot at its lower edge, with a colour and a link of its own. Where nearly
 * every case has values of its own (samples), cases are dots in a plane instead. */
#include "batch/plot.h"
#include "report/svg.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double cloud_inset = 0.02, dot = 3.2;
enum { SCALE_STEPS = 24, MOST_DOTS = 60 };

static int by_cell(const void *left, const void *right) {
  const ambulo__plot_point *a = *(ambulo__plot_point *const *)left,
                           *b = *(ambulo__plot_point *const *)right;
  if (a->place[0] != b->place[0]) return a->place[0] - b->place[0];
  if (a->place[1] != b->place[1]) return a->place[1] - b->place[1];
  return a->index - b->index;
}

/* -------------------------------------------------------------- legend */

static void draw_scale(const ambulo__plot *p, ambulo__text_buffer *svg) {
  double x = ambulo__plot_legend, y = ambulo__plot_top, height = 200.0;
  double h = height / SCALE_STEPS;
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
    double at = y + height * (1.0 - ambulo__plot_share(p, first + i * step));
    ambulo__svg_line(svg, "axis", x + 18.0, at, x + 23.0, at);
    ambulo__plot_number(svg, "", x + 28.0, at + 4.0, first + i * step, decimals);
  }
  ambulo__plot_remarks(p, svg, y + height + 36.0);
}

/* --------------------------------------------------------------- cells */

typedef struct cell {
  double x, y, width, height; /* px */
  ambulo__plot_point *const *point;
  int cases, valid;
  double mean; /* of the valid ones */
} cell;

static void draw_dots(const ambulo__plot *p, ambulo__text_buffer *svg, const cell *c) {
  double gap = fmin(3.6 * dot, (c->width - 4.0 * dot) / (c->cases > 1 ? c->cases - 1 : 1));
  double left = c->x + 0.5 * (c->width - gap * (c->cases - 1)), y = c->y + c->height - 3.0 * dot;
  for (int i = 0; i < c->cases; i++) {
    const ambulo__plot_point *point = c->point[i];
    double x = left + gap * i;
    char colour[8];
    ambulo__plot_shade(ambulo__plot_share(p, point->value), colour);
    ambulo__plot_case_begin(p, svg, point);
    if (point->has_value) {
      ambulo__plot_mark(svg, x, y, dot, point->valid ? colour : NULL, "#8b96a2");
    } else {
      ambulo__plot_cross(svg, x, y);
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
  int dots =
      (c->cases > 1 || !c->valid) && c->cases <= MOST_DOTS && c->height >= 34.0 && c->width >= 34.0;
  if (c->valid > 0 && c->width >= 40.0 && c->height >= 16.0)
    ambulo__plot_number(svg, share > 0.45 ? "on-dark" : "on-light", c->x + 0.5 * c->width,
                        c->y + 0.5 * c->height + (dots ? 0.0 : 4.0), c->mean, decimals);
  ambulo__plot_case_end(svg);
  if (dots) draw_dots(p, svg, c);
  if (!dots && c->valid == 0)
    ambulo__plot_cross(svg, c->x + 0.5 * c->width, c->y + 0.5 * c->height);
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

/* calls draw_cell (svg) or widens the scale to the means (no svg) */
static int walk_cells(ambulo__plot *p, ambulo__plot_point *const *order, ambulo__text_buffer *svg) {
  double w = ambulo__plot_width / p->axis[0].count, h = ambulo__plot_height / p->axis[1].count;
  int most = 0;
  for (int first = 0, end; first < p->points; first = end) {
    const int *at = order[first]->place;
    for (end = first + 1;
         end < p->points && order[end]->place[0] == at[0] && order[end]->place[1] == at[1];)
      end++;
    cell c = {.x = ambulo__plot_left + w * at[0],
              .y = ambulo__plot_top + h * (p->axis[1].count - 1 - at[1]),
              .width = w,
              .height = h,
              .point = order + first,
              .cases = end - first};
    measure(&c);
    if (c.cases > most) most = c.cases;
    if (svg) draw_cell(p, svg, &c);
  }
  return most;
}

static void draw_cells(ambulo__plot *p, ambulo__plot_point *const *order,
                       ambulo__text_buffer *svg) {
  char remark[80] = "";
  int most = walk_cells(p, order, NULL);
  if (most > 1) (void)snprintf(remark, sizeof remark, "a cell is the mean of up to %d", most);
  ambulo__plot_begin(p, svg, remark);
  for (int i = 0; i < 2; i++) {
    for (int k = 0; k < p->axis[i].count; k++) p->axis[i].at[k] = k;
    ambulo__plot_labels(p, svg, i, 0.5 / p->axis[i].count, 1);
  }
  walk_cells(p, order, svg);
}

/* --------------------------------------------------------------- cloud */

static void draw_cloud(ambulo__plot *p, ambulo__text_buffer *svg) {
  ambulo__plot_begin(p, svg, "");
  for (int i = 0; i < 2; i++) ambulo__plot_labels(p, svg, i, cloud_inset, 0);
  ambulo__svg_rectangle(svg, "soil", ambulo__plot_left, ambulo__plot_top, ambulo__plot_width,
                        ambulo__plot_height);
  for (int i = 0; i < p->points; i++) {
    const ambulo__plot_point *point = &p->point[i];
    double x =
        ambulo__plot_left +
        ambulo__plot_width * ambulo__plot_axis_share(&p->axis[0], point->place[0], cloud_inset);
    double y = ambulo__plot_top +
               ambulo__plot_height *
                   (1.0 - ambulo__plot_axis_share(&p->axis[1], point->place[1], cloud_inset));
    char colour[8];
    ambulo__plot_shade(ambulo__plot_share(p, point->value), colour);
    ambulo__plot_case_begin(p, svg, point);
    if (point->has_value) {
      ambulo__plot_mark(svg, x, y, 6.0, point->valid ? colour : NULL, "#8b96a2");
    } else {
      ambulo__plot_cross(svg, x, y);
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
  if (p.axis[0].numeric && p.axis[1].numeric && cells > 4.0 * p.points) {
    draw_cloud(&p, svg);
  } else {
    draw_cells(&p, order, svg);
  }
  draw_scale(&p, svg);
  ambulo__free(&p.listing->allocator, (void *)order);
  return AMBULO_OK;
}
