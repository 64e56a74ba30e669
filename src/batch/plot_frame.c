/* batch/plot_frame.c - title, axes, marks and links that curves and maps share.
 *
 * Links are relative to the batch folder, in which the drawing stands. */
#include "base/numtext.h"
#include "batch/paths.h"
#include "batch/plot.h"
#include "report/svg.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const double ambulo__plot_left = 90.0, ambulo__plot_top = 100.0, ambulo__plot_width = 590.0,
             ambulo__plot_height = 360.0, ambulo__plot_legend = 704.0;
static const double full_width = 880.0, full_height = 530.0, letter = 6.6;
enum { MOST_STATES = 12, MOST_VALUES = 12, LONG_NUMBER = 7 };

/* ---------------------------------------------------------------- title */

static const char *superscript(int digit) {
  static const char *const digits[] = {
      "\xe2\x81\xb0", "\xc2\xb9",     "\xc2\xb2",     "\xc2\xb3",     "\xe2\x81\xb4",
      "\xe2\x81\xb5", "\xe2\x81\xb6", "\xe2\x81\xb7", "\xe2\x81\xb8", "\xe2\x81\xb9"};
  return digits[digit % 10];
}

/* "objective", "max(tau.knee_angle_r) in N m", "audit.violation.worst in 10⁻⁹" */
static void print_output(const ambulo__plot *p, ambulo__text_buffer *text) {
  const char *unit = p->listing->output_unit[p->output];
  int power = p->exponent < 0 ? -p->exponent : p->exponent;
  ambulo__text_append(text, p->listing->output[p->output]);
  if (unit[0] || power) ambulo__text_append(text, " in ");
  if (power) {
    ambulo__text_append(text, p->exponent < 0 ? "10\xe2\x81\xbb" : "10");
    if (power >= 100) ambulo__text_append(text, superscript(power / 100));
    if (power >= 10) ambulo__text_append(text, superscript(power / 10));
    ambulo__text_append(text, superscript(power));
    if (unit[0]) ambulo__text_append(text, " ");
  }
  ambulo__text_append(text, unit);
}

/* "200 cases: 198 optimal, 1 feasible, 1 missing" */
static void print_states(const ambulo__plot *p, ambulo__text_buffer *text) {
  const char *state[MOST_STATES];
  int count[MOST_STATES] = {0}, states = 0;
  for (int i = 0; i < p->points; i++) {
    int s = 0;
    while (s < states && strcmp(state[s], p->point[i].state) != 0) s++;
    if (s == states && states < MOST_STATES) state[states++] = p->point[i].state;
    if (s < states) count[s]++;
  }
  ambulo__text_append_format(text, "%s, %d cases: ", p->listing->name, p->points);
  for (int s = 0; s < states; s++)
    ambulo__text_append_format(text, "%s%d %s", s ? ", " : "", count[s], state[s]);
}

static void append_axis(const ambulo__plot *p, int column, ambulo__text_buffer *text) {
  const char *unit = p->listing->axis_unit[column - AMBULO__LISTING_AXES];
  ambulo__text_append(text, ambulo__listing_title(p->listing, column));
  if (unit[0]) ambulo__text_append_format(text, " in %s", unit);
}

void ambulo__plot_begin(const ambulo__plot *p, ambulo__text_buffer *svg, const char *remark) {
  ambulo__text_buffer text;
  ambulo__text_init_part(&text, svg);
  print_output(p, &text);
  ambulo__svg_begin(svg, full_width, full_height, ambulo__text_data(&text));
  ambulo__svg_label(svg, "title", ambulo__plot_left, 36.0, ambulo__text_data(&text));
  ambulo__text_clear(&text);
  print_states(p, &text);
  if (remark[0]) ambulo__text_append_format(&text, "; %s", remark);
  ambulo__svg_label(svg, "subtitle", ambulo__plot_left, 58.0, ambulo__text_data(&text));
  ambulo__text_clear(&text);
  append_axis(p, p->axis[0].column, &text);
  ambulo__svg_label(svg, "subtitle middle", ambulo__plot_left + 0.5 * ambulo__plot_width,
                    ambulo__plot_top + ambulo__plot_height + 46.0, ambulo__text_data(&text));
  if (p->axis[1].column >= 0) {
    ambulo__text_clear(&text);
    append_axis(p, p->axis[1].column, &text);
    ambulo__svg_label(svg, "subtitle", ambulo__plot_left - 60.0, ambulo__plot_top - 12.0,
                      ambulo__text_data(&text));
  }
  ambulo__text_free(&text);
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
static void label_at(ambulo__text_buffer *svg, int which, double share, const char *text,
                     double *end) {
  double length = which ? ambulo__plot_height : ambulo__plot_width;
  double half = 0.5 * (which ? 15.0 : letter * (double)strlen(text) + 8.0);
  if (share * length - half < *end) return;
  *end = share * length + half;
  if (which) {
    double y = ambulo__plot_top + ambulo__plot_height * (1.0 - share);
    ambulo__svg_label(svg, "end", ambulo__plot_left - 8.0, y + 4.0, text);
  } else {
    double x = ambulo__plot_left + ambulo__plot_width * share;
    ambulo__svg_label(svg, "middle", x, ambulo__plot_top + ambulo__plot_height + 20.0, text);
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
static void label_values(const ambulo__plot_axis *axis, ambulo__text_buffer *svg, int which,
                         double inset) {
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
      ambulo__text_append(&label, axis->text[i]);
    }
    label_at(svg, which, ambulo__plot_axis_share(axis, i, inset), ambulo__text_data(&label), &end);
  }
  ambulo__text_free(&label);
}

/* round numbers in the range of the axis */
static void label_range(const ambulo__plot_axis *axis, ambulo__text_buffer *svg, int which,
                        double inset) {
  double low = axis->at[0], span = axis->at[axis->count - 1] - low, end = -INFINITY;
  int decimals = 0;
  double step = ambulo__nice_step(span, 6, &decimals), first = ceil(low / step - 1e-9) * step;
  ambulo__text_buffer label;
  ambulo__text_init_part(&label, svg);
  for (int i = 0; i < 16 && first + i * step <= low + span * (1.0 + 1e-9); i++) {
    double share = inset + (1.0 - 2.0 * inset) * (first + i * step - low) / span;
    ambulo__text_clear(&label);
    ambulo__label_number(&label, first + i * step, decimals);
    label_at(svg, which, share, ambulo__text_data(&label), &end);
  }
  ambulo__text_free(&label);
}

void ambulo__plot_labels(const ambulo__plot *p, ambulo__text_buffer *svg, int which, double inset,
                         int cells) {
  const ambulo__plot_axis *axis = &p->axis[which];
  int many = axis->count > MOST_VALUES || is_long(axis);
  if (axis->numeric && !cells && many && axis->count > 1) {
    label_range(axis, svg, which, inset);
  } else {
    label_values(axis, svg, which, inset);
  }
}

double ambulo__plot_share(const ambulo__plot *p, double value) {
  return p->high > p->low ? (value - p->low) / (p->high - p->low) : 0.5;
}

void ambulo__plot_grid(const ambulo__plot *p, ambulo__text_buffer *svg) {
  int decimals = 0;
  double step = ambulo__nice_step(p->high > p->low ? p->high - p->low : 1.0, 6, &decimals);
  double first = ceil(p->low / step - 1e-9) * step;
  int count = (int)floor((p->high - first) / step + 1e-9) + 1;
  for (int i = 0; i < count; i++) {
    double v = first + i * step;
    double y = ambulo__plot_top + ambulo__plot_height * (1.0 - ambulo__plot_share(p, v));
    ambulo__svg_line(svg, "grid", ambulo__plot_left, y, ambulo__plot_left + ambulo__plot_width, y);
    ambulo__plot_number(svg, "end", ambulo__plot_left - 12.0, y + 4.0, v, decimals);
  }
}

/* ---------------------------------------------------------------- cases */

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

void ambulo__plot_cross(ambulo__text_buffer *svg, double x, double y) {
  for (int i = -1; i <= 1; i += 2)
    ambulo__svg_line(svg, "left-cross", x - 4.0, y - 4.0 * i, x + 4.0, y + 4.0 * i);
}

void ambulo__plot_shade(double share, char colour[8]) {
  double s = fmax(0.0, fmin(1.0, share));
  (void)snprintf(colour, 8, "#%02x%02x%02x", (unsigned)(228.0 - 210.0 * s),
                 (unsigned)(239.0 - 185.0 * s), (unsigned)(250.0 - 130.0 * s));
}

void ambulo__plot_remarks(const ambulo__plot *p, ambulo__text_buffer *svg, double y) {
  int invalid = 0;
  for (int i = 0; i < p->points; i++) invalid += p->point[i].has_value && !p->point[i].valid;
  double x = ambulo__plot_legend + 6.0;
  if (invalid > 0) {
    ambulo__plot_mark(svg, x, y - 4.0, 3.5, NULL, "");
    ambulo__svg_label(svg, "", x + 12.0, y, "no valid solution");
    y += 20.0;
  }
  if (p->values < p->points) {
    ambulo__plot_cross(svg, x, y - 4.0);
    ambulo__svg_label(svg, "", x + 12.0, y, "no value");
  }
}
