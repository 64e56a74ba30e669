/* study/plot_layout.c - room for texts, whose length nobody knows beforehand.
 *
 * A page cannot ask how wide a letter is: widths are estimated from above, for the widest of the
 * usual faces (DejaVu Sans). What is longer than any drawing can bear is cut. */
#include "study/plot.h"

#include <math.h>
#include <string.h>

enum { MOST_HEADING = 60, MOST_LABEL = 32, MOST_NAME = 40, MOST_STATES = 12 };

static const double small = 12.0, plain = 13.0, title = 22.0, gap = 16.0;

static int is_first_byte(char c) {
  return ((unsigned char)c & 0xc0) != 0x80;
}

double ambulo__plot_text_width(const char *text, double size, int bold) {
  int letters = 0;
  for (; *text; text++) letters += is_first_byte(*text);
  return letters * size * (bold ? 0.68 : 0.62);
}

void ambulo__plot_append_cut(ambulo__text_buffer *out, const char *text, int most) {
  int letters = 0;
  const char *c = text;
  for (; *c; c++) {
    letters += is_first_byte(*c);
    if (letters > most) break;
  }
  ambulo__text_append_bytes(out, text, (size_t)(c - text));
  if (*c) ambulo__text_append(out, "\xe2\x80\xa6");
}

static const char *superscript(int digit) {
  static const char *const digits[] = {
      "\xe2\x81\xb0", "\xc2\xb9",     "\xc2\xb2",     "\xc2\xb3",     "\xe2\x81\xb4",
      "\xe2\x81\xb5", "\xe2\x81\xb6", "\xe2\x81\xb7", "\xe2\x81\xb8", "\xe2\x81\xb9"};
  return digits[digit % 10];
}

/* "N m", "10^-9", "10^3 N"; nothing for a plain number */
void ambulo__plot_append_unit(const ambulo__plot *p, ambulo__text_buffer *out) {
  const char *unit = p->listing->output_unit[p->output];
  int power = p->exponent < 0 ? -p->exponent : p->exponent;
  if (power) {
    ambulo__text_append(out, p->exponent < 0 ? "10\xe2\x81\xbb" : "10");
    if (power >= 100) ambulo__text_append(out, superscript(power / 100));
    if (power >= 10) ambulo__text_append(out, superscript(power / 10));
    ambulo__text_append(out, superscript(power));
    if (unit[0]) ambulo__text_append(out, " ");
  }
  ambulo__plot_append_cut(out, unit, MOST_LABEL);
}

/* "objective", "max(tau.knee_angle_r) in N m", "audit.violation.worst in 10^-9" */
void ambulo__plot_append_output(const ambulo__plot *p, ambulo__text_buffer *out) {
  ambulo__plot_append_cut(out, p->listing->output_label[p->output], MOST_HEADING);
  if (!p->listing->output_unit[p->output][0] && !p->exponent) return;
  ambulo__text_append(out, " in ");
  ambulo__plot_append_unit(p, out);
}

void ambulo__plot_append_axis(const ambulo__plot *p, int column, ambulo__text_buffer *out) {
  const char *unit = p->listing->axis_unit[column - AMBULO__LISTING_AXES];
  ambulo__plot_append_cut(out, p->listing->axis_label[column - AMBULO__LISTING_AXES], MOST_HEADING);
  if (!unit[0]) return;
  ambulo__text_append(out, " in ");
  ambulo__plot_append_cut(out, unit, MOST_LABEL);
}

/* "study, 200 cases: 198 optimal, 1 feasible, 1 missing"; "study, 20 of 200 cases: 20 optimal" */
void ambulo__plot_append_states(const ambulo__plot *p, const char *remark,
                                ambulo__text_buffer *text) {
  const char *state[MOST_STATES];
  int count[MOST_STATES] = {0}, states = 0;
  for (int i = 0; i < p->points; i++) {
    int s = 0;
    while (s < states && strcmp(state[s], p->point[i].state) != 0) s++;
    if (s == states && states < MOST_STATES) state[states++] = p->point[i].state;
    if (s < states) count[s]++;
  }
  ambulo__plot_append_cut(text, p->listing->name, MOST_NAME);
  ambulo__text_append_format(text, ", %d", p->points);
  if (p->options.where_count > 0) ambulo__text_append_format(text, " of %d", p->listing->cases);
  ambulo__text_append(text, " cases: ");
  for (int s = 0; s < states; s++)
    ambulo__text_append_format(text, "%s%d %s", s ? ", " : "", count[s], state[s]);
  if (remark[0]) ambulo__text_append_format(text, "; %s", remark);
}

/* "where speed < 1.5 and sex == male" */
void ambulo__plot_append_where(const ambulo__plot *p, ambulo__text_buffer *text) {
  for (int i = 0; i < p->options.where_count; i++) {
    ambulo__text_append(text, i ? " and " : "where ");
    ambulo__plot_append_cut(text, p->options.where[i], MOST_NAME);
  }
}

/* the values of an axis as they are written, the widest and all of them; px */
static double widest(const ambulo__plot_axis *axis, double *sum) {
  double most = 0.0;
  *sum = 0.0;
  for (int i = 0; i < axis->count; i++) {
    double width =
        fmin(ambulo__plot_text_width(axis->text[i], small, 0), (MOST_LABEL + 1) * small * 0.62);
    *sum += width + 10.0;
    most = fmax(most, width);
  }
  return most;
}

static double heading_width(const ambulo__plot *p, int column, ambulo__text_buffer *svg) {
  ambulo__text_buffer text;
  ambulo__text_init_part(&text, svg);
  ambulo__plot_append_axis(p, column, &text);
  double width = ambulo__plot_text_width(ambulo__text_data(&text), plain, 1);
  ambulo__text_free(&text);
  return width;
}

double ambulo__plot_legend_width(const ambulo__plot *p, const ambulo__plot_axis *axis,
                                 ambulo__text_buffer *svg) {
  double sum = 0.0;
  return fmax(heading_width(p, axis->column, svg), 18.0 + widest(axis, &sum));
}

/* of the lines above the panel, px */
static double lines_width(const ambulo__plot *p, const char *remark, ambulo__text_buffer *svg) {
  ambulo__text_buffer text;
  ambulo__text_init_part(&text, svg);
  ambulo__plot_append_output(p, &text);
  double width = ambulo__plot_text_width(ambulo__text_data(&text), title, 1);
  ambulo__text_clear(&text);
  ambulo__plot_append_states(p, remark, &text);
  width = fmax(width, ambulo__plot_text_width(ambulo__text_data(&text), plain, 0));
  ambulo__text_clear(&text);
  ambulo__plot_append_where(p, &text);
  width = fmax(width, ambulo__plot_text_width(ambulo__text_data(&text), plain, 0));
  ambulo__text_free(&text);
  return width;
}

void ambulo__plot_arrange(ambulo__plot *p, int cells, double legend, const char *remark,
                          ambulo__text_buffer *svg) {
  ambulo__plot_layout *y = &p->layout;
  double sum = 0.0, words = cells ? widest(&p->axis[1], &sum) : 7.0 * small * 0.62;
  double values = widest(&p->axis[0], &sum);
  *y = (ambulo__plot_layout){.top = 92.0, .width = 590.0, .height = 360.0};
  /* numbers that are too many are thinned out; words are all named */
  y->slanted = !p->axis[0].numeric && sum > y->width;
  double lean = y->slanted ? values * 0.77 : 0.0, drop = y->slanted ? values * 0.64 : 0.0;
  y->left = fmax(90.0, fmax(50.0 + words, lean - 10.0));
  y->name = y->left - words - 26.0;
  y->legend = y->left + y->width + 24.0;
  double remarks = p->values < p->points ? 150.0 : 0.0;
  y->page_width = fmax(880.0, y->legend + fmax(legend, remarks) + gap);
  y->page_width = fmax(y->page_width, y->left + lines_width(p, remark, svg) + gap);
  y->page_height = y->top + y->height + 70.0 + drop;
}
