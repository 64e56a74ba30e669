/* study/plot_marks.c - the mark of a case: its link, its tooltip, its colour.
 *
 * Links are relative to the batch folder, in which the drawing stands. */
#include "study/case_path.h"
#include "study/plot.h"
#include "show/svg.h"

#include <math.h>
#include <stdio.h>

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

void ambulo__plot_case_begin(const ambulo__plot *p, ambulo__text_buffer *svg,
                             const ambulo__plot_point *point) {
  const ambulo__listing *l = p->listing;
  const char *id = ambulo__listing_cell(l, point->index, AMBULO__LISTING_ID);
  char *path = ambulo__case_path(&l->allocator, ".", id, point->has_value ? "/gait.svg" : ".json");
  ambulo__text_append(svg, "<a href=\"");
  if (!path) svg->failed = 1;
  escaped(svg, path ? path : "");
  ambulo__text_append(svg, "\"><title>");
  escaped(svg, ambulo__listing_cell(l, point->index, AMBULO__LISTING_NAME));
  ambulo__text_append_format(svg, " (%s), %s", id, point->state);
  if (point->has_value) {
    ambulo__text_append(svg, ": ");
    ambulo__text_append_number(svg, point->value * pow(10.0, p->exponent));
    ambulo__text_append_format(svg, " %s", l->output_unit[p->output]);
  }
  ambulo__text_append(svg, "</title>\n");
  ambulo__free(&l->allocator, path);
}

void ambulo__plot_case_end(ambulo__text_buffer *svg) {
  ambulo__text_append(svg, "</a>\n");
}

static void attribute(ambulo__text_buffer *svg, const char *name, double value) {
  ambulo__text_append_format(svg, " %s=\"", name);
  ambulo__text_append_number(svg, round(value * 100.0) / 100.0);
  ambulo__text_append_char(svg, '"');
}

void ambulo__plot_mark(ambulo__text_buffer *svg, double x, double y, double radius,
                       const char *fill, const char *edge) {
  ambulo__text_append(svg, "<circle");
  attribute(svg, "cx", x);
  attribute(svg, "cy", y);
  attribute(svg, "r", radius);
  ambulo__text_append_format(svg, " fill=\"%s\" stroke=\"%s\" stroke-width=\"%s\"/>\n",
                             fill ? fill : "#fff", fill ? edge : "#c8501c", fill ? "0.7" : "1.8");
}

void ambulo__plot_cross(ambulo__text_buffer *svg, double x, double y, double radius) {
  double arm = 0.8 * radius;
  for (int i = -1; i <= 1; i += 2)
    ambulo__svg_line(svg, "left-cross", x - arm, y - arm * i, x + arm, y + arm * i);
}

void ambulo__plot_shade(double share, char colour[8]) {
  double s = fmax(0.0, fmin(1.0, share));
  (void)snprintf(colour, 8, "#%02x%02x%02x", (unsigned)(228.0 - 210.0 * s),
                 (unsigned)(239.0 - 185.0 * s), (unsigned)(250.0 - 130.0 * s));
}

void ambulo__plot_remarks(const ambulo__plot *p, ambulo__text_buffer *svg, double y) {
  int invalid = 0;
  for (int i = 0; i < p->points; i++) invalid += p->point[i].has_value && !p->point[i].valid;
  double x = p->layout.legend + 6.0;
  if (invalid > 0) {
    ambulo__plot_mark(svg, x, y - 4.0, 3.5, NULL, "");
    ambulo__svg_label(svg, "", x + 12.0, y, "no valid solution");
    y += 20.0;
  }
  if (p->values < p->points) {
    ambulo__plot_cross(svg, x, y - 4.0, 5.0);
    ambulo__svg_label(svg, "", x + 12.0, y, "no value");
  }
}
