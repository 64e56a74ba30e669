/* study/plot_curves.c - an output over one axis.
 *
 * A line joins cases that differ along the axis alone: those that share every other value, of
 * subject, of device, of whatever else the sweep has. Only axes that advance together by the
 * sweep's own word (combine: zip) count as one. Curves are coloured by the other axis that tells
 * most about the values: the one with the greatest sum of squares between its groups. */
#include "formats/text_hash.h"
#include "study/plot.h"
#include "show/svg.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double inset_words = 0.08, inset_numbers = 0.05, value_inset = 0.04;
static const double most_room = 26.0; /* px that a mark may stand aside */
static const double least_mark = 1.6;
enum { MANY_MARKS = 20000, MARK_SIZES = 6 };

/* for words; numbers take shades */
static const char *const palette[AMBULO__PLOT_COLOURS] = {
    "#2377bd", "#e0662f", "#2f8f5b", "#8a5fb0", "#b8901f", "#35a3b5", "#b0486f", "#6b7785"};

typedef struct joined {
  unsigned long long curve;
  const ambulo__plot_point *point;
  ambulo__plot_spot spot;
} joined;

typedef struct curves {
  ambulo__plot *plot;
  ambulo__plot_axis colour; /* column < 0: one colour for all */
  joined *order;            /* [plot->points] by curve, then along the axis */
  double inset, radius;
} curves;

/* 1: cases that differ in this column are not joined */
static int separates(const ambulo__plot *p, int column) {
  int x = p->axis[0].column, zipped = AMBULO__LISTING_AXES + p->listing->zipped;
  return column != x && !(x < zipped && column < zipped);
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
      if (separates(p, k))
        hash = ambulo__hash_text(hash, ambulo__listing_cell(p->listing, p->point[i].index, k));
    c->order[i] = (joined){.curve = hash, .point = &p->point[i]};
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

/* 1: one value of the column at each value of x */
static int goes_with_x(const ambulo__plot *p, int column, const char **first) {
  memset((void *)first, 0, (size_t)p->axis[0].count * sizeof *first);
  for (int i = 0; i < p->points; i++) {
    const char **seen = &first[p->point[i].place[0]];
    const char *text = ambulo__listing_cell(p->listing, p->point[i].index, column);
    if (*seen && strcmp(*seen, text) != 0) return 0;
    *seen = text;
  }
  return 1;
}

static double mean_value(const ambulo__plot *p) {
  double sum = 0.0;
  for (int i = 0; i < p->points; i++) sum += p->point[i].has_value ? p->point[i].value : 0.0;
  return sum / p->values;
}

static ambulo_status find_colour(curves *c, const char **first) {
  const ambulo__plot *p = c->plot;
  int best_column = -1;
  double mean = mean_value(p), best = -1.0;
  ambulo_status status = AMBULO_OK;
  for (int k = AMBULO__LISTING_AXES; k < p->listing->columns && !status; k++) {
    if (!separates(p, k)) continue;
    status = ambulo__plot_axis_make(p->listing, p->point, p->points, k, &c->colour);
    int another_x = c->colour.count == p->axis[0].count && goes_with_x(p, k, first);
    if (!status && !another_x && c->colour.count > 1 && c->colour.count <= AMBULO__PLOT_COLOURS) {
      double spread = spread_between(c, mean);
      if (spread > best) {
        best = spread;
        best_column = k;
      }
    }
    ambulo__plot_axis_free(p->listing, &c->colour);
  }
  c->colour.column = -1;
  if (status || best_column < 0) return status;
  return ambulo__plot_axis_make(p->listing, p->point, p->points, best_column, &c->colour);
}

static ambulo_status choose_colour(curves *c) {
  const ambulo_allocator *a = &c->plot->listing->allocator;
  const char **first = ambulo__alloc(a, (size_t)c->plot->axis[0].count, sizeof *first);
  ambulo_status status = first ? find_colour(c, first) : AMBULO_E_MEMORY;
  ambulo__free(a, (void *)first);
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
  const ambulo__plot *p = c->plot;
  double x = p->layout.legend, y = p->layout.top + 8.0;
  ambulo__text_buffer text;
  ambulo__text_init_part(&text, svg);
  if (c->colour.column >= 0) {
    ambulo__plot_append_axis(p, c->colour.column, &text);
    ambulo__svg_label(svg, "panel", x, y, ambulo__text_data(&text));
  }
  for (int g = 0; c->colour.column >= 0 && g < c->colour.count; g++) {
    char colour[8];
    paint_of(c, g, colour);
    y += 20.0;
    ambulo__plot_mark(svg, x + 6.0, y - 4.0, 4.5, colour, "#fff");
    ambulo__text_clear(&text);
    ambulo__plot_append_cut(&text, c->colour.text[g], 32);
    ambulo__svg_label(svg, "", x + 18.0, y, ambulo__text_data(&text));
  }
  ambulo__text_free(&text);
  ambulo__plot_remarks(p, svg, y + 30.0);
}

/* ---------------------------------------------------------------- places */

static double x_of(const curves *c, int place) {
  const ambulo__plot *p = c->plot;
  return p->layout.left + p->layout.width * ambulo__plot_axis_share(&p->axis[0], place, c->inset);
}

/* cases without a value stand at the foot of the panel */
static double y_of(const curves *c, const ambulo__plot_point *point) {
  const ambulo__plot_layout *l = &c->plot->layout;
  if (!point->has_value) return l->top + l->height - 6.0;
  double share = fmax(0.0, fmin(1.0, ambulo__plot_share(c->plot, point->value)));
  return l->top + l->height * (1.0 - share);
}

/* what a mark may stand aside: less than half of the way to the next value */
static double room_at(const curves *c, int place) {
  double room = most_room, x = x_of(c, place);
  if (place > 0) room = fmin(room, 0.35 * (x - x_of(c, place - 1)));
  if (place + 1 < c->plot->axis[0].count) room = fmin(room, 0.35 * (x_of(c, place + 1) - x));
  return room;
}

/* As large as leaves none hidden, as far as that goes. Of very many marks most are hidden wherever
 * they stand. */
static ambulo_status place_marks(curves *c) {
  const ambulo__plot *p = c->plot;
  const ambulo_allocator *a = &p->listing->allocator;
  ambulo__plot_spot **spot = ambulo__alloc(a, (size_t)p->points, sizeof *spot);
  double *room = ambulo__alloc(a, (size_t)p->axis[0].count, sizeof *room);
  int ready = spot && room, hidden = 1, many = p->points > MANY_MARKS;
  for (int i = 0; ready && i < p->axis[0].count; i++) room[i] = room_at(c, i);
  for (int size = many ? 0 : MARK_SIZES; ready && hidden && size >= 0; size--) {
    c->radius = least_mark + 0.4 * size;
    for (int i = 0; i < p->points; i++) {
      const ambulo__plot_point *point = c->order[i].point;
      int place = point->place[0];
      c->order[i].spot = (ambulo__plot_spot){x_of(c, place), y_of(c, point), place};
      spot[i] = &c->order[i].spot;
    }
    hidden = many ? 0 : ambulo__plot_spread(spot, p->points, c->radius + 0.4, room);
  }
  ambulo__free(a, (void *)spot);
  ambulo__free(a, room);
  return ready ? AMBULO_OK : AMBULO_E_MEMORY;
}

/* ---------------------------------------------------------------- curves */

static void draw_line(const curves *c, ambulo__text_buffer *svg, int first, int end,
                      const char *colour) {
  const joined *o = c->order, *last = NULL;
  ambulo__text_append_format(svg, "<g stroke=\"%s\" stroke-opacity=\"0.55\">\n", colour);
  for (int i = first; i < end; i++) {
    if (!o[i].point->has_value || !o[i].point->valid) continue;
    if (last && last->spot.place != o[i].spot.place)
      ambulo__svg_line(svg, "thin", last->spot.x, last->spot.y, o[i].spot.x, o[i].spot.y);
    last = &o[i];
  }
  ambulo__text_append(svg, "</g>\n");
}

static void draw_curve(const curves *c, ambulo__text_buffer *svg, int first, int end) {
  char colour[8];
  const joined *o = c->order;
  paint_of(c, c->colour.column >= 0 ? colour_of(c, o[first].point) : 0, colour);
  if (end - first > 1) draw_line(c, svg, first, end, colour);
  for (int i = first; i < end; i++) {
    const ambulo__plot_point *point = o[i].point;
    ambulo__plot_case_begin(c->plot, svg, point);
    if (point->has_value) {
      ambulo__plot_mark(svg, o[i].spot.x, o[i].spot.y, c->radius, point->valid ? colour : NULL,
                        "#fff");
    } else {
      ambulo__plot_cross(svg, o[i].spot.x, o[i].spot.y, c->radius);
    }
    ambulo__plot_case_end(svg);
  }
}

static ambulo_status prepare(curves *c, ambulo__text_buffer *svg) {
  ambulo__plot *p = c->plot;
  c->order = ambulo__alloc(&p->listing->allocator, (size_t)p->points, sizeof *c->order);
  if (!c->order) return AMBULO_E_MEMORY;
  sort_curves(c);
  ambulo_status status = choose_colour(c);
  if (status) return status;
  double legend = c->colour.column >= 0 ? ambulo__plot_legend_width(p, &c->colour, svg) : 0.0;
  ambulo__plot_arrange(p, 0, legend, "", svg);
  return place_marks(c);
}

static void draw(const curves *c, ambulo__text_buffer *svg) {
  const ambulo__plot *p = c->plot;
  const ambulo__plot_layout *l = &p->layout;
  ambulo__plot_begin(p, svg, "");
  ambulo__plot_grid(p, svg);
  ambulo__svg_line(svg, "axis", l->left, l->top + l->height, l->left + l->width,
                   l->top + l->height);
  ambulo__plot_labels(p, svg, 0, c->inset, 0);
  for (int first = 0, end; first < p->points; first = end) {
    for (end = first + 1; end < p->points && c->order[end].curve == c->order[first].curve;) end++;
    draw_curve(c, svg, first, end);
  }
  draw_legend(c, svg);
}

ambulo_status ambulo__plot_curves(const ambulo__plot *plot, ambulo__text_buffer *svg) {
  ambulo__plot p = *plot; /* with room above and below */
  double room = value_inset * (p.high > p.low ? p.high - p.low : 1.0);
  p.low -= room;
  p.high += room;
  curves c = {.plot = &p, .inset = p.axis[0].numeric ? inset_numbers : inset_words};
  c.colour.column = -1;
  ambulo_status status = prepare(&c, svg);
  if (!status) draw(&c, svg);
  ambulo__free(&p.listing->allocator, c.order);
  if (c.colour.column >= 0) ambulo__plot_axis_free(p.listing, &c.colour);
  return status;
}
