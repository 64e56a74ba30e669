/* study/plot_frame.c - title, axes and their values, which curves and maps share. */
#include "base/numtext.h"
#include "study/plot.h"
#include "show/svg.h"

#include <math.h>
#include <string.h>

enum { MOST_VALUES = 12, LONG_NUMBER = 7, MOST_LABEL = 32 };

/* ---------------------------------------------------------------- title */

static void axis_names(const ambulo__plot *p, ambulo__text_buffer *svg) {
  const ambulo__plot_layout *y = &p->layout;
  ambulo__text_buffer text;
  ambulo__text_init_part(&text, svg);
  ambulo__plot_append_axis(p, p->axis[0].column, &text);
  ambulo__svg_label(svg, "subtitle middle", y->left + 0.5 * y->width, y->page_height - 22.0,
                    ambulo__text_data(&text));
  ambulo__text_clear(&text);
  if (p->axis[1].column >= 0) {
    ambulo__plot_append_axis(p, p->axis[1].column, &text);
  } else {
    ambulo__plot_append_output(p, &text);
  }
  ambulo__svg_label_turned(svg, "subtitle middle", y->name, y->top + 0.5 * y->height, -90.0,
                           ambulo__text_data(&text));
  ambulo__text_free(&text);
}

void ambulo__plot_begin(const ambulo__plot *p, ambulo__text_buffer *svg, const char *remark) {
  const ambulo__plot_layout *y = &p->layout;
  ambulo__text_buffer text;
  ambulo__text_init_part(&text, svg);
  ambulo__plot_append_output(p, &text);
  ambulo__svg_begin(svg, y->page_width, y->page_height, ambulo__text_data(&text));
  ambulo__svg_label(svg, "title", y->left, 34.0, ambulo__text_data(&text));
  ambulo__text_clear(&text);
  ambulo__plot_append_states(p, remark, &text);
  ambulo__svg_label(svg, "subtitle", y->left, 56.0, ambulo__text_data(&text));
  ambulo__text_clear(&text);
  ambulo__plot_append_where(p, &text);
  if (text.length > 0) ambulo__svg_label(svg, "subtitle", y->left, 74.0, ambulo__text_data(&text));
  ambulo__text_free(&text);
  axis_names(p, svg);
}

/* ----------------------------------------------------------------- axes */

void ambulo__plot_number(ambulo__text_buffer *svg, const char *style, double x, double y,
                         double value, int decimals) {
  ambulo__text_buffer label;
  ambulo__text_init_part(&label, svg);
  ambulo__label_number(&label, value, decimals);
  ambulo__svg_label(svg, style, x, y, ambulo__text_data(&label));
  ambulo__text_free(&label);
}

/* label of a value at its share of the axis; *end: pixels that are taken, later ones are left out
 * where they would run into them */
static void label_at(const ambulo__plot *p, ambulo__text_buffer *svg, int which, double share,
                     const char *text, double *end) {
  const ambulo__plot_layout *l = &p->layout;
  int upright = which || l->slanted;
  double length = which ? l->height : l->width;
  double half = 0.5 * (upright ? 15.0 : ambulo__plot_text_width(text, 12.0, 0) + 4.0);
  if (share * length - half < *end) return;
  *end = share * length + half;
  double x = l->left + l->width * share, y = l->top + l->height;
  if (which) {
    ambulo__svg_label(svg, "end", l->left - 8.0, y - l->height * share + 4.0, text);
  } else if (l->slanted) {
    ambulo__svg_label_turned(svg, "end", x + 4.0, y + 16.0, -40.0, text);
  } else {
    ambulo__svg_label(svg, "middle", x, y + 20.0, text);
  }
}

/* numbers that take too much room as they are written */
static int is_long(const ambulo__plot_axis *axis) {
  size_t longest = 0;
  for (int i = 0; i < axis->count; i++) {
    size_t length = strlen(axis->text[i]);
    if (length > longest) longest = length;
  }
  return axis->numeric && longest > LONG_NUMBER;
}

/* the values as they are written, or rounded to what tells them apart */
static void label_values(const ambulo__plot *p, ambulo__text_buffer *svg, int which, double inset) {
  const ambulo__plot_axis *axis = &p->axis[which];
  double end = -INFINITY, first = 0.0, last = 0.0, number = 0.0;
  int decimals = 0, rounded = is_long(axis);
  const char *ends[] = {axis->text[0], axis->text[axis->count - 1]};
  if (rounded) {
    (void)ambulo__parse_double(ends[0], strlen(ends[0]), &first);
    (void)ambulo__parse_double(ends[1], strlen(ends[1]), &last);
    (void)ambulo__nice_step(last - first, 2 * axis->count, &decimals);
  }
  ambulo__text_buffer label;
  ambulo__text_init_part(&label, svg);
  for (int i = 0; i < axis->count; i++) {
    ambulo__text_clear(&label);
    if (rounded && ambulo__parse_double(axis->text[i], strlen(axis->text[i]), &number)) {
      ambulo__label_number(&label, number, decimals);
    } else {
      ambulo__plot_append_cut(&label, axis->text[i], MOST_LABEL);
    }
    label_at(p, svg, which, ambulo__plot_axis_share(axis, i, inset), ambulo__text_data(&label),
             &end);
  }
  ambulo__text_free(&label);
}

/* round numbers in the range of the axis */
static void label_range(const ambulo__plot *p, ambulo__text_buffer *svg, int which, double inset) {
  const ambulo__plot_axis *axis = &p->axis[which];
  double low = axis->at[0], span = axis->at[axis->count - 1] - low, end = -INFINITY;
  int decimals = 0;
  double step = ambulo__nice_step(span, 6, &decimals), first = ceil(low / step - 1e-9) * step;
  ambulo__text_buffer label;
  ambulo__text_init_part(&label, svg);
  for (int i = 0; i < 16 && first + i * step <= low + span * (1.0 + 1e-9); i++) {
    double share = inset + (1.0 - 2.0 * inset) * (first + i * step - low) / span;
    ambulo__text_clear(&label);
    ambulo__label_number(&label, first + i * step, decimals);
    label_at(p, svg, which, share, ambulo__text_data(&label), &end);
  }
  ambulo__text_free(&label);
}

void ambulo__plot_labels(const ambulo__plot *p, ambulo__text_buffer *svg, int which, double inset,
                         int cells) {
  const ambulo__plot_axis *axis = &p->axis[which];
  int many = axis->count > MOST_VALUES || is_long(axis);
  if (axis->numeric && !cells && many && axis->count > 1) {
    label_range(p, svg, which, inset);
  } else {
    label_values(p, svg, which, inset);
  }
}

double ambulo__plot_share(const ambulo__plot *p, double value) {
  return p->high > p->low ? (value - p->low) / (p->high - p->low) : 0.5;
}

void ambulo__plot_grid(const ambulo__plot *p, ambulo__text_buffer *svg) {
  const ambulo__plot_layout *l = &p->layout;
  int decimals = 0;
  double step = ambulo__nice_step(p->high > p->low ? p->high - p->low : 1.0, 6, &decimals);
  double first = ceil(p->low / step - 1e-9) * step;
  int count = (int)floor((p->high - first) / step + 1e-9) + 1;
  for (int i = 0; i < count; i++) {
    double v = first + i * step;
    double y = l->top + l->height * (1.0 - ambulo__plot_share(p, v));
    ambulo__svg_line(svg, "grid", l->left, y, l->left + l->width, y);
    ambulo__plot_number(svg, "end", l->left - 12.0, y + 4.0, v, decimals);
  }
}
