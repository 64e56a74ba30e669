/* batch/plot_draw.c - curves over one axis, or a heat map over two.
 *
 * Curves join the cases that differ along the axis alone. A cell of a heat map is the mean of
 * the cases that share both values. Every mark carries the name and id of its case and leads
 * to that case's gait.svg; a cell leads to the first of its cases. */
#include "batch/paths.h"
#include "batch/plot.h"
#include "report/svg.h"

#include <math.h>
#include <string.h>

static const double left = 90.0, top = 60.0, width = 560.0, height = 360.0, full_width = 760.0,
                    full_height = 490.0;

typedef struct span {
  double low, high;
} span;

static void widen(span *s, double value) {
  if (value < s->low) s->low = value;
  if (value > s->high) s->high = value;
}

static double place(span s, double value) {
  return s.high > s.low ? (value - s.low) / (s.high - s.low) : 0.5;
}

static void escaped(ambulo__text_buffer *svg, const char *text) {
  for (; *text; text++) {
    const char *entity = *text == '&'   ? "&amp;"
                         : *text == '<' ? "&lt;"
                         : *text == '"' ? "&quot;"
                                        : NULL;
    if (entity) {
      ambulo__text_append(svg, entity);
    } else if ((unsigned char)*text >= 0x20) {
      ambulo__text_append_char(svg, *text);
    }
  }
}

/* opens a link with a tooltip around what is drawn next */
static void begin_case(const ambulo__plot *p, ambulo__text_buffer *svg, int index, double value,
                       int cases) {
  const ambulo__listing *l = p->listing;
  const char *id = ambulo__listing_cell(l, index, AMBULO__LISTING_ID);
  char *path = ambulo__case_path(&l->allocator, ".", id, "/gait.svg");
  ambulo__text_append(svg, "<a href=\"");
  escaped(svg, path ? path : "");
  ambulo__text_append(svg, "\"><title>");
  escaped(svg, ambulo__listing_cell(l, index, AMBULO__LISTING_NAME));
  ambulo__text_append_format(svg, " (%s", id);
  if (cases > 1) ambulo__text_append_format(svg, " and %d more, mean", cases - 1);
  ambulo__text_append(svg, "): ");
  ambulo__text_append_number(svg, value);
  ambulo__text_append(svg, "</title>\n");
  ambulo__free(&l->allocator, path);
}

static void end_case(ambulo__text_buffer *svg) {
  ambulo__text_append(svg, "</a>\n");
}

static void tick_label(ambulo__text_buffer *svg, const char *style, double x, double y,
                       double value, int decimals, const ambulo_allocator *a) {
  ambulo__text_buffer label;
  ambulo__text_init(&label, a);
  ambulo__label_number(&label, value, decimals);
  ambulo__svg_label(svg, style, x, y, ambulo__text_data(&label));
  ambulo__text_free(&label);
}

static void value_ticks(const ambulo__plot *p, ambulo__text_buffer *svg, span s) {
  int decimals = 0;
  double step = ambulo__nice_step(s.high > s.low ? s.high - s.low : 1.0, 6, &decimals);
  double first = ceil(s.low / step - 1e-9) * step;
  int count = (int)floor((s.high - first) / step + 1e-9) + 1;
  for (int i = 0; i < count; i++) {
    double v = first + i * step;
    double y = top + height * (1.0 - place(s, v));
    ambulo__svg_line(svg, "grid", left, y, left + width, y);
    tick_label(svg, "end", left - 8.0, y + 4.0, v, decimals, &p->listing->allocator);
  }
}

/* one label a value of an axis, at its place */
static void axis_labels(const ambulo__plot *p, ambulo__text_buffer *svg, int vertical, span s,
                        double inset) {
  double last = NAN;
  int column = vertical ? p->y_column : p->x_column;
  for (;;) {
    const ambulo__plot_point *next = NULL;
    double best = INFINITY;
    for (int i = 0; i < p->points; i++) {
      double v = vertical ? p->point[i].y : p->point[i].x;
      if (v < best && !(v <= last)) {
        best = v;
        next = &p->point[i];
      }
    }
    if (!next) break;
    const char *text = ambulo__listing_cell(p->listing, next->index, column);
    double at = inset + (1.0 - 2.0 * inset) * place(s, best);
    if (vertical) {
      ambulo__svg_label(svg, "end", left - 8.0, top + height * (1.0 - at) + 4.0, text);
    } else {
      ambulo__svg_label(svg, "middle", left + width * at, top + height + 18.0, text);
    }
    last = best;
  }
}

/* 1: the column goes with x (a table's other columns): equal x, equal cell, and x repeats */
static int goes_with_x(const ambulo__plot *p, int column) {
  int repeats = 0;
  for (int i = 0; i < p->points; i++) {
    int first = 0;
    while (p->point[first].x != p->point[i].x) first++;
    repeats |= first < i;
    if (strcmp(ambulo__listing_cell(p->listing, p->point[i].index, column),
               ambulo__listing_cell(p->listing, p->point[first].index, column)) != 0)
      return 0;
  }
  return repeats;
}

static int same_curve(const ambulo__plot *p, const unsigned char *tied, int a, int b) {
  for (int i = AMBULO__LISTING_AXES; i < p->listing->columns; i++) {
    if (tied[i]) continue;
    if (strcmp(ambulo__listing_cell(p->listing, a, i), ambulo__listing_cell(p->listing, b, i)) != 0)
      return 0;
  }
  return 1;
}

/* the point that follows on the same curve: the least x above; NULL: none */
static const ambulo__plot_point *follower(const ambulo__plot *p, const unsigned char *tied,
                                          const ambulo__plot_point *from) {
  const ambulo__plot_point *next = NULL;
  for (int i = 0; i < p->points; i++) {
    const ambulo__plot_point *q = &p->point[i];
    if (q->x > from->x && (!next || q->x < next->x) && same_curve(p, tied, from->index, q->index))
      next = q;
  }
  return next;
}

static ambulo_status draw_curves(const ambulo__plot *p, ambulo__text_buffer *svg, span x,
                                 span value) {
  const ambulo_allocator *allocator = &p->listing->allocator;
  unsigned char *tied = ambulo__alloc(allocator, (size_t)p->listing->columns, 1);
  if (!tied) return AMBULO_E_MEMORY;
  for (int i = AMBULO__LISTING_AXES; i < p->listing->columns; i++)
    tied[i] = i == p->x_column || goes_with_x(p, i);
  for (int i = 0; i < p->points; i++) {
    const ambulo__plot_point *a = &p->point[i], *b = follower(p, tied, a);
    if (b)
      ambulo__svg_line(svg, "axis", left + width * place(x, a->x),
                       top + height * (1.0 - place(value, a->value)), left + width * place(x, b->x),
                       top + height * (1.0 - place(value, b->value)));
  }
  for (int i = 0; i < p->points; i++) {
    const ambulo__plot_point *a = &p->point[i];
    begin_case(p, svg, a->index, a->value, 1);
    ambulo__svg_circle(svg, "right-bar", left + width * place(x, a->x),
                       top + height * (1.0 - place(value, a->value)), 3.5);
    end_case(svg);
  }
  ambulo__free(allocator, tied);
  return AMBULO_OK;
}

/* light to dark blue, in steps of lightness that look even */
static void paint(ambulo__text_buffer *svg, double x, double y, double w, double h, double share) {
  int red = (int)(235.0 - 215.0 * share), green = (int)(243.0 - 180.0 * share),
      blue = (int)(251.0 - 120.0 * share);
  ambulo__text_append_format(svg,
                             "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" "
                             "fill=\"#%02x%02x%02x\"/>\n",
                             (int)x, (int)y, (int)ceil(w), (int)ceil(h), (unsigned)red,
                             (unsigned)green, (unsigned)blue);
}

/* distinct values along one axis */
static int count_places(const ambulo__plot *p, int vertical) {
  int count = 0;
  for (int i = 0; i < p->points; i++) {
    int seen = 0;
    for (int j = 0; j < i && !seen; j++)
      seen = vertical ? p->point[j].y == p->point[i].y : p->point[j].x == p->point[i].x;
    count += !seen;
  }
  return count;
}

/* mean and number of the points in the cell of point i; 0: an earlier point has drawn it */
static int cell_of(const ambulo__plot *p, int i, double *mean) {
  int cases = 0;
  double sum = 0.0;
  for (int j = 0; j < p->points; j++) {
    if (p->point[j].x != p->point[i].x || p->point[j].y != p->point[i].y) continue;
    if (j < i) return 0;
    sum += p->point[j].value;
    cases++;
  }
  *mean = sum / cases;
  return cases;
}

static void draw_map(const ambulo__plot *p, ambulo__text_buffer *svg, span x, span y, span value) {
  int columns = count_places(p, 0), rows = count_places(p, 1);
  double w = width / columns, h = height / rows;
  for (int i = 0; i < p->points; i++) {
    double mean = 0.0;
    int cases = cell_of(p, i, &mean);
    if (cases == 0) continue;
    double at = left + (width - w) * place(x, p->point[i].x);
    double down = top + (height - h) * (1.0 - place(y, p->point[i].y));
    begin_case(p, svg, p->point[i].index, mean, cases);
    paint(svg, at, down, w, h, place(value, mean));
    tick_label(svg, place(value, mean) > 0.5 ? "inbar" : "middle", at + 0.5 * w,
               down + 0.5 * h + 4.0, mean, 3, &p->listing->allocator);
    end_case(svg);
  }
}

ambulo_status ambulo__plot_draw(const ambulo__plot *p, ambulo__text_buffer *svg) {
  span x = {INFINITY, -INFINITY}, y = x, value = x;
  for (int i = 0; i < p->points; i++) {
    double mean = p->point[i].value;
    widen(&x, p->point[i].x);
    widen(&y, p->point[i].y);
    if (p->y_column < 0 || cell_of(p, i, &mean) > 0) widen(&value, mean);
  }
  const char *output = p->listing->output[p->output];
  ambulo_status status = AMBULO_OK;
  ambulo__svg_begin(svg, full_width, full_height, output);
  ambulo__svg_label(svg, "title", left, 36.0, output);
  ambulo__svg_label(svg, "subtitle middle", left + 0.5 * width, top + height + 42.0,
                    ambulo__listing_title(p->listing, p->x_column));
  if (p->y_column < 0) {
    value_ticks(p, svg, value);
    axis_labels(p, svg, 0, x, 0.0);
    status = draw_curves(p, svg, x, value);
  } else {
    ambulo__svg_label(svg, "subtitle end", left - 8.0, top - 10.0,
                      ambulo__listing_title(p->listing, p->y_column));
    axis_labels(p, svg, 0, x, 0.5 / count_places(p, 0));
    axis_labels(p, svg, 1, y, 0.5 / count_places(p, 1));
    draw_map(p, svg, x, y, value);
  }
  ambulo__svg_end(svg);
  return status ? status : ambulo__text_status(svg);
}
