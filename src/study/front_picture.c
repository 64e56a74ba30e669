/* study/front_picture.c - DIR/front.svg: a front of two terms as a curve, of three as three
 * panels, one for each two terms, in which the third is the shade of the marks.
 *
 * Values are those of the terms without their weights. A line joins neighbours; it is dashed where
 * no weights lead between them. Points that are not on the front are hollow, where they fit. Each
 * mark leads to the case's gait.svg, relative to the folder, which may be moved. */
#include "formats/atomic_file.h"
#include "formats/paths.h"
#include "study/case_path.h"
#include "study/front_points.h"
#include "study/plot.h"
#include "show/svg.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double panel = 420.0, left = 92.0, top = 112.0, between = 108.0, foot = 76.0;
static const double room = 0.06, near = 0.15, radius = 5.0;
static const char colour[] = "#2377bd";

typedef struct drawing {
  const ambulo__listing *listing;
  const ambulo__front *front;
  const ambulo__front_gap *gap; /* [gaps] of two terms */
  int gaps;
  double low[AMBULO__FRONT_TERMS], high[AMBULO__FRONT_TERMS];
  int exponent[AMBULO__FRONT_TERMS]; /* values are divided by 10 to this power */
} drawing;

/* --------------------------------------------------------------------- ranges */

static int is_on(const ambulo__front_point *p) {
  return p->standing == AMBULO__FRONT_ON;
}

static int fits(const drawing *d, const ambulo__front_point *p) {
  for (int i = 0; i < d->front->terms; i++)
    if (p->value[i] < d->low[i] || p->value[i] > d->high[i]) return 0;
  return 1;
}

static void measure(drawing *d) {
  const ambulo__front *f = d->front;
  for (int i = 0; i < f->terms; i++) {
    double low = INFINITY, high = -INFINITY, most;
    for (int k = 0; k < f->points; k++) {
      if (!is_on(&f->point[k])) continue;
      low = fmin(low, f->point[k].value[i]);
      high = fmax(high, f->point[k].value[i]);
    }
    double wide = high > low ? high - low : fmax(fabs(low), 1e-300);
    d->low[i] = low - room * wide;
    d->high[i] = high + near * wide;
    most = fmax(fabs(d->low[i]), fabs(d->high[i]));
    if (most < 0.01 || most >= 1e5) d->exponent[i] = 3 * (int)floor(log10(most) / 3.0 + 1e-9);
  }
}

/* ---------------------------------------------------------------------- panels */

typedef struct frame {
  double x, y; /* upper left corner */
  int term[2]; /* of the axes */
} frame;

static double place(const drawing *d, const frame *f, int axis, const double *value) {
  int i = f->term[axis];
  double share = (value[i] - d->low[i]) / (d->high[i] - d->low[i]);
  return axis == 0 ? f->x + panel * share : f->y + panel * (1.0 - share);
}

static void axis_name(const drawing *d, int term, ambulo__text_buffer *text) {
  ambulo__text_clear(text);
  ambulo__plot_append_cut(text, d->listing->front.name[term], 40);
  if (d->exponent[term]) ambulo__text_append_format(text, ", in 1e%d", d->exponent[term]);
}

static void draw_axis(const drawing *d, const frame *f, int axis, ambulo__text_buffer *svg) {
  int i = f->term[axis], decimals = 0;
  double unit = pow(10.0, d->exponent[i]), low = d->low[i] / unit, high = d->high[i] / unit;
  double step = ambulo__nice_step(high - low, 5, &decimals), first = ceil(low / step) * step;
  for (int k = 0; k < 12 && first + k * step <= high; k++) {
    double value[AMBULO__FRONT_TERMS] = {0.0}, v = first + k * step;
    value[i] = v * unit;
    double at = place(d, f, axis, value);
    if (axis == 0) {
      ambulo__svg_line(svg, "grid", at, f->y, at, f->y + panel);
      ambulo__plot_number(svg, "middle", at, f->y + panel + 20.0, v, decimals);
    } else {
      ambulo__svg_line(svg, "grid", f->x, at, f->x + panel, at);
      ambulo__plot_number(svg, "end", f->x - 10.0, at + 4.0, v, decimals);
    }
  }
  ambulo__text_buffer text;
  ambulo__text_init_part(&text, svg);
  axis_name(d, i, &text);
  if (axis == 0) {
    ambulo__svg_label(svg, "subtitle middle", f->x + 0.5 * panel, f->y + panel + 46.0,
                      ambulo__text_data(&text));
  } else {
    ambulo__svg_label_turned(svg, "subtitle middle", f->x - 66.0, f->y + 0.5 * panel, -90.0,
                             ambulo__text_data(&text));
  }
  ambulo__text_free(&text);
}

static void draw_curve(const drawing *d, const frame *f, ambulo__text_buffer *svg) {
  for (int i = 0; i < d->gaps; i++) {
    const double *a = d->front->point[d->gap[i].a].value, *b = d->front->point[d->gap[i].b].value;
    int broken = d->gap[i].refused;
    ambulo__text_append_format(svg, "<g stroke=\"%s\" stroke-opacity=\"0.6\"%s>\n", colour,
                               broken ? " stroke-dasharray=\"3 5\"" : "");
    ambulo__svg_line(svg, "curve", place(d, f, 0, a), place(d, f, 1, a), place(d, f, 0, b),
                     place(d, f, 1, b));
    ambulo__text_append(svg, "</g>\n");
  }
}

static const char *name_of(const drawing *d, int k) {
  return ambulo__listing_cell(d->listing, k, AMBULO__LISTING_NAME);
}

/* the place along the front, as in the table; above and to the right */
static void draw_name(const drawing *d, int k, double x, double y, ambulo__text_buffer *svg) {
  char name[16];
  (void)snprintf(name, sizeof name, "%d", d->front->point[k].place + 1);
  ambulo__svg_label(svg, "", x + 7.0, y - 6.0, name);
}

static ambulo_status draw_point(const drawing *d, const frame *f, int k, ambulo__text_buffer *svg) {
  const ambulo__front_point *p = &d->front->point[k];
  const ambulo__listing *l = d->listing;
  double x = place(d, f, 0, p->value), y = place(d, f, 1, p->value);
  const char *id = ambulo__listing_cell(l, k, AMBULO__LISTING_ID);
  char *path = ambulo__case_path(&l->allocator, ".", id, "/gait.svg"), fill[8];
  if (!path) return AMBULO_E_MEMORY;
  ambulo__text_append_format(svg, "<a href=\"%s\"><title>", path);
  if (is_on(p)) ambulo__text_append_format(svg, "place %d, ", p->place + 1);
  ambulo__text_append_format(svg, "case '%s':", name_of(d, k));
  for (int i = 0; i < d->front->terms; i++) {
    ambulo__text_append_format(svg, "%s %s ", i ? "," : "", l->front.name[i]);
    ambulo__text_append_number(svg, p->value[i]);
  }
  if (!is_on(p)) ambulo__text_append_format(svg, " (%s)", ambulo__front_word(p->standing));
  ambulo__text_append(svg, "</title>\n");
  (void)snprintf(fill, sizeof fill, "%s", colour);
  if (d->front->terms == 3) ambulo__plot_shade(p->z[3 - f->term[0] - f->term[1]], fill);
  ambulo__plot_mark(svg, x, y, radius, is_on(p) ? fill : NULL, "#1d2733");
  if (is_on(p)) draw_name(d, k, x, y, svg);
  ambulo__text_append(svg, "</a>\n");
  ambulo__free(&l->allocator, path);
  return AMBULO_OK;
}

static ambulo_status draw_panel(const drawing *d, const frame *f, ambulo__text_buffer *svg) {
  ambulo_status status = AMBULO_OK;
  for (int axis = 0; axis < 2; axis++) draw_axis(d, f, axis, svg);
  ambulo__svg_line(svg, "axis", f->x, f->y + panel, f->x + panel, f->y + panel);
  ambulo__svg_line(svg, "axis", f->x, f->y, f->x, f->y + panel);
  draw_curve(d, f, svg);
  for (int on = 0; on < 2; on++)
    for (int k = 0; k < d->front->points && !status; k++) {
      const ambulo__front_point *p = &d->front->point[k];
      if (p->solved && is_on(p) == on && fits(d, p)) status = draw_point(d, f, k, svg);
    }
  return status;
}

/* ----------------------------------------------------------------------- page */

static void draw_titles(const drawing *d, const ambulo__front_report *r, double width,
                        ambulo__text_buffer *svg) {
  const ambulo__front *f = d->front;
  ambulo__text_buffer text;
  ambulo__text_init_part(&text, svg);
  for (int i = 0; i < f->terms; i++)
    ambulo__text_append_format(&text, "%s%.40s", i ? " against " : "", d->listing->front.name[i]);
  ambulo__svg_begin(svg, width, top + panel + foot, ambulo__text_data(&text));
  ambulo__svg_label(svg, "title", left - 58.0, 36.0, ambulo__text_data(&text));
  ambulo__text_clear(&text);
  ambulo__text_append_format(&text, "%.40s: %d points, largest gap %.1f mean gaps",
                             d->listing->name, r->on, r->mean > 0.0 ? r->largest / r->mean : 0.0);
  int others = r->beaten + r->dominated;
  if (others > 0) ambulo__text_append_format(&text, "; %d left out that another beats", others);
  ambulo__svg_label(svg, "subtitle", left - 58.0, 60.0, ambulo__text_data(&text));
  ambulo__text_clear(&text);
  for (int i = 0; i < f->terms; i++) {
    double low = d->low[i], high = d->high[i], wide = (high - low) / (1.0 + room + near);
    low += room * wide;
    ambulo__text_append_format(&text, "%s%.40s up to ", i ? ", " : "", d->listing->front.name[i]);
    ambulo__label_number(&text, low > 0.0 ? 100.0 * wide / low : 0.0, 0);
    ambulo__text_append(&text, " % above its least");
  }
  ambulo__svg_label(svg, "subtitle", left - 58.0, 80.0, ambulo__text_data(&text));
  if (f->terms == 3)
    ambulo__svg_label(svg, "subtitle", left - 58.0, 98.0,
                      "the darker a mark, the more of the term that its panel lacks");
  ambulo__text_free(&text);
}

static ambulo_status draw_page(const drawing *d, const ambulo__front_report *report,
                               ambulo__text_buffer *svg) {
  static const int pairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};
  int panels = d->front->terms == 3 ? 3 : 1;
  double pitch = panel + between, width = left + panels * pitch - between + 40.0;
  ambulo_status status = AMBULO_OK;
  draw_titles(d, report, fmax(width, 700.0), svg);
  for (int i = 0; i < panels && !status; i++) {
    frame f = {left + i * pitch, top, {pairs[i][0], pairs[i][1]}};
    status = draw_panel(d, &f, svg);
  }
  ambulo__svg_end(svg);
  return status ? status : ambulo__text_status(svg);
}

ambulo_status ambulo__front_draw(const char *directory, const ambulo__listing *l,
                                 const ambulo__front *front, const ambulo__front_report *report,
                                 ambulo_diagnostics *diagnostics) {
  const ambulo_allocator *a = &l->allocator;
  drawing d = {.listing = l, .front = front};
  ambulo__text_buffer svg;
  ambulo__text_init(&svg, a);
  ambulo__front_gap *gap = ambulo__alloc(a, (size_t)report->on + 1, sizeof *gap);
  char *path = ambulo__join_paths(a, directory, "front.svg", NULL);
  ambulo_status status = gap && path ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status && report->on > 0) {
    d.gap = gap;
    if (front->terms == 2) ambulo__front_gaps(front, gap, &d.gaps);
    measure(&d);
    status = draw_page(&d, report, &svg);
    if (!status)
      status = ambulo__write_file(path, ambulo__text_data(&svg), svg.length, 1, a, diagnostics);
  }
  ambulo__text_free(&svg);
  ambulo__free(a, gap);
  ambulo__free(a, path);
  return status;
}
