/* show/gait_chart.c - one small panel: range, grid, curves, people (gait_chart.h); the contact bars
 * and the time axis (gait_svg.h). */
#include "show/gait_chart.h"

#include "contact/contacts.h"
#include "model/neutral_pose.h"
#include "show/svg.h"

#include <math.h>
#include <string.h>

void ambulo__chart_range(ambulo__gait_chart *c, const int *columns, int count) {
  double low = 0.0, high = 0.0;
  for (int j = 0; j < count; j++) {
    for (int k = 0; k < c->stride->samples; k++) {
      size_t at = (size_t)k * (size_t)c->columns + (size_t)columns[j];
      double value = c->factor * c->values[at];
      if (!isfinite(value)) continue;
      low = fmin(low, value);
      high = fmax(high, value);
    }
  }
  if (high - low < 1e-9) high = low + 1.0;
  c->low = low;
  c->high = high;
}

void ambulo__chart_widen(ambulo__gait_chart *c, const ambulo__people_curve *people) {
  for (int k = 0; k < c->stride->samples; k++) {
    double mean, band;
    if (!ambulo__people_at(people, k, &mean, &band)) continue;
    c->low = fmin(c->low, mean - band);
    c->high = fmax(c->high, mean + band);
  }
}

static double chart_y(const ambulo__gait_chart *c, double value) {
  return c->box.y + c->box.height * (c->high - value) / (c->high - c->low);
}

void ambulo__chart_grid(ambulo__gait_chart *c, ambulo__text_buffer *text) {
  int decimals;
  double step = ambulo__nice_step(c->high - c->low, 4, &decimals);
  /* a curve that passes a line of the grid by less than its own width, as rounding does, needs no
   * further one */
  c->low = floor(c->low / step + 0.02) * step;
  c->high = ceil(c->high / step - 0.02) * step;
  ambulo__text_buffer label;
  ambulo__text_init_part(&label, text);
  int lines = (int)lround((c->high - c->low) / step);
  for (int i = 0; i <= lines; i++) {
    double value = c->low + (double)i * step, y = chart_y(c, value);
    int zero = fabs(value) < 1e-6 * step;
    ambulo__svg_line(text, zero ? "zero" : "grid", c->box.x, y, c->box.x + c->box.width, y);
    ambulo__text_clear(&label);
    ambulo__label_number(&label, value, decimals);
    ambulo__svg_label(text, "end", c->box.x - 8.0, y + 4.0, ambulo__text_data(&label));
  }
  ambulo__text_free(&label);
}

/* -------------------------------------------------------------------- curves */

/* time, or percent of the cycle of a side; of the motion where no feet strike */
static double abscissa(const ambulo__gait_chart *c, ambulo__side side, int k) {
  double t = c->stride->times[k];
  if (!c->cycles) return t;
  if (!ambulo__gait_cycles(c->cycles)) return 100.0 * t / c->stride->duration;
  return ambulo__gait_percent(c->cycles, side, t);
}

typedef struct pen {
  const ambulo__gait_chart *chart;
  int down;
  double at, value; /* where it is */
} pen;

static void go_on(pen *p, double at, double value, ambulo__text_buffer *text) {
  double x = ambulo__panel_time(&p->chart->box, at), y = chart_y(p->chart, value);
  if (p->down)
    ambulo__svg_path_line(text, x, y);
  else
    ambulo__svg_path_move(text, x, y);
  p->down = 1;
  p->at = at;
  p->value = value;
}

/* a cycle that ends between two samples ends and begins on the straight line between them */
static void next_cycle(pen *p, double at, double value, ambulo__text_buffer *text) {
  double before = 100.0 - p->at, both = before + at;
  double seam = both > 0.0 ? p->value + before / both * (value - p->value) : value;
  go_on(p, 100.0, seam, text);
  p->down = 0;
  if (at > 0.0) go_on(p, 0.0, seam, text);
}

static void trace(const ambulo__gait_chart *c, int column, ambulo__side side, const char *style,
                  ambulo__text_buffer *text) {
  pen p = {.chart = c};
  ambulo__svg_path_begin(text, style);
  for (int k = 0; k < c->stride->samples; k++) {
    size_t index = (size_t)k * (size_t)c->columns + (size_t)column;
    double value = c->factor * c->values[index], at = abscissa(c, side, k);
    if (!isfinite(value)) {
      p.down = 0;
      continue;
    }
    if (p.down && at < p.at) next_cycle(&p, at, value, text);
    go_on(&p, at, value, text);
  }
  ambulo__svg_path_end(text);
}

void ambulo__chart_axis(const ambulo__gait_chart *c, ambulo__text_buffer *text) {
  ambulo__panel axis = c->box;
  axis.y += axis.height;
  ambulo__time_axis(&axis, 4, c->cycles ? "%" : "s", text);
}

void ambulo__chart_curve(const ambulo__gait_chart *c, int column, ambulo__side side,
                         ambulo__text_buffer *text) {
  static const char *const styles[] = {"trunk curve", "left curve", "right curve"};
  trace(c, column, side, styles[side], text);
}

static ambulo__gait_chart of_devices(const ambulo__gait_chart *c) {
  ambulo__gait_chart efforts = *c;
  efforts.values = c->stride->effort;
  efforts.columns = c->stride->devices;
  return efforts;
}

static int is_at(const ambulo__gait_chart *c, int device, int coordinate) {
  return c->stride->problem->definition.devices[device].coordinate == coordinate;
}

void ambulo__chart_widen_devices(ambulo__gait_chart *c, int coordinate) {
  for (int i = 0; i < c->stride->devices; i++) {
    ambulo__gait_chart efforts = of_devices(c);
    if (!is_at(c, i, coordinate)) continue;
    ambulo__chart_range(&efforts, &i, 1);
    c->low = fmin(c->low, efforts.low);
    c->high = fmax(c->high, efforts.high);
  }
}

void ambulo__chart_devices(const ambulo__gait_chart *c, int coordinate, ambulo__text_buffer *text) {
  static const char *const styles[] = {"trunk worn", "left worn", "right worn"};
  const ambulo__gait_chart efforts = of_devices(c);
  ambulo__side side = ambulo__coordinate_side(c->stride->model, coordinate);
  for (int i = 0; i < c->stride->devices; i++)
    if (is_at(c, i, coordinate)) trace(&efforts, i, side, styles[side], text);
}

/* -------------------------------------------------------------------- people */

/* the places along the axis where people are drawn: the samples, or the whole percents */
static int places(const ambulo__gait_chart *c) {
  return c->cycles ? 101 : c->stride->samples;
}

static int people_at(const ambulo__gait_chart *c, const ambulo__people_curve *people, int k,
                     double *mean, double *band) {
  if (c->cycles) return ambulo__people_at_percent(people, (double)k, mean, band);
  return ambulo__people_at(people, k, mean, band);
}

/* mean + factor * band at the places from, from + step, ..., before `to` */
static void trace_people(const ambulo__gait_chart *c, const ambulo__people_curve *people, int from,
                         int to, int step, double factor, ambulo__text_buffer *text) {
  for (int k = from; k != to; k += step) {
    double mean, band, at = c->cycles ? (double)k : c->stride->times[k];
    double x = ambulo__panel_time(&c->box, at);
    (void)people_at(c, people, k, &mean, &band);
    double y = chart_y(c, mean + factor * band);
    if (k == from && step > 0) {
      ambulo__svg_path_move(text, x, y);
    } else {
      ambulo__svg_path_line(text, x, y);
    }
  }
}

int ambulo__chart_alike(const ambulo__gait_chart *c, const ambulo__people_curve *a,
                        const ambulo__people_curve *b) {
  return c->cycles && a->curve && a->curve == b->curve && a->scale == b->scale;
}

void ambulo__chart_people(const ambulo__gait_chart *c, const ambulo__people_curve *people, int both,
                          ambulo__text_buffer *text) {
  static const char *const bands[] = {"both-people", "left-people", "right-people"};
  static const char *const lines[] = {"trunk people", "left people", "right people"};
  int count = places(c);
  if (!people->curve) return;
  int has_band = people->curve->sd != NULL;
  ambulo__svg_path_begin(text, (has_band ? bands : lines)[both ? AMBULO__MIDDLE : people->side]);
  for (int from = 0; from < count; from++) {
    double mean, band;
    int to = from;
    while (to < count && people_at(c, people, to, &mean, &band)) to++;
    if (to > from) trace_people(c, people, from, to, 1, has_band, text);
    if (to > from && has_band) trace_people(c, people, to - 1, from - 1, -1, -1.0, text);
    from = to;
  }
  ambulo__svg_path_end(text);
}

/* -------------------------------- contact bars of feet and patches, and the time axis */

enum { BAR_SAMPLES = 2400 };
static const double bar_height = 14.0, bar_pitch = 19.0;

static const char *const side_bar[] = {"trunk-bar", "left-bar", "right-bar"};
static const char *const side_partial[] = {"trunk-bar partial", "left-bar partial",
                                           "right-bar partial"};
static const char *const side_text[] = {"panel end", "left-text end", "right-text end"};
static const char *const mode_words[] = {"", "heel", "flat", "toe", "down"};
static const double in_the_middle = 1e-3; /* m */

/* -1 in the air */
static int mode_at(const ambulo__stride *stride, int effector, double t) {
  const ambulo_contact *contact = ambulo__stride_contact(stride, effector, t);
  return contact ? (int)contact->mode : -1;
}

static void draw_span(const ambulo__panel *panel, double y, double from, double to, int mode,
                      ambulo__side side, ambulo__text_buffer *text) {
  double x = ambulo__panel_time(panel, from), width = ambulo__panel_time(panel, to) - x;
  int whole = ambulo__mode_is_flat(mode) || ambulo__mode_is_of_patch(mode);
  ambulo__svg_rectangle(text, whole ? side_bar[side] : side_partial[side], x, y, width, bar_height);
  if (width > 30.0)
    ambulo__svg_label(text, "inbar", x + width / 2.0, y + bar_height - 3.5, mode_words[mode]);
}

static void draw_bar(const ambulo__stride *stride, int effector, ambulo__side side, double y,
                     const ambulo__panel *panel, ambulo__text_buffer *text) {
  ambulo__svg_rectangle(text, "lane", panel->x, y, panel->width, bar_height);
  int mode = mode_at(stride, effector, 0.0);
  double from = 0.0;
  for (int k = 1; k <= BAR_SAMPLES; k++) {
    double t = stride->duration * (double)k / (double)BAR_SAMPLES;
    int now = k == BAR_SAMPLES ? -2 : mode_at(stride, effector, t);
    if (now == mode) continue;
    if (mode >= 0) draw_span(panel, y, from, t, mode, side, text);
    mode = now;
    from = t;
  }
}

int ambulo__gait_shows(const ambulo__stride *stride, int effector) {
  int patch = ambulo__effector_patch(stride->model, effector);
  return patch < 0 || ambulo__patch_is_used(&stride->problem->definition, patch);
}

/* a foot's by its name, a patch's by where its middle is at q = 0 */
static ambulo__side side_of(const ambulo_model *model, int effector) {
  const char *name = ambulo__effector_name(model, effector);
  int patch = ambulo__effector_patch(model, effector);
  if (patch >= 0) return ambulo__gait_patch_side(model, patch);
  if (strstr(name, "right") || !strcmp(name, "r")) return AMBULO__RIGHT;
  return strstr(name, "left") || !strcmp(name, "l") ? AMBULO__LEFT : AMBULO__MIDDLE;
}

ambulo__side ambulo__gait_patch_side(const ambulo_model *model, int patch) {
  double r[3];
  ambulo__neutral_point(model, model->patches[patch].point, r);
  double aside = r[0] * model->left[0] + r[1] * model->left[1] + r[2] * model->left[2];
  if (aside > in_the_middle) return AMBULO__LEFT;
  return aside < -in_the_middle ? AMBULO__RIGHT : AMBULO__MIDDLE;
}

double ambulo__gait_bars(const ambulo__stride *stride, const ambulo__panel *panel,
                         ambulo__text_buffer *text) {
  const ambulo_model *model = stride->model;
  if (ambulo_problem_contact_count(stride->problem) == 0) return 0.0;
  double y = panel->y;
  for (int e = 0; e < ambulo__effector_count(model); e++) {
    if (!ambulo__gait_shows(stride, e)) continue;
    ambulo__side side = side_of(model, e);
    draw_bar(stride, e, side, y, panel, text);
    ambulo__svg_label_within(text, side_text[side], panel->x - 10.0, y + bar_height - 3.0,
                             panel->x - 14.0, 12.0, ambulo__effector_name(model, e));
    y += bar_pitch;
  }
  return y - panel->y;
}

void ambulo__time_axis(const ambulo__panel *panel, int parts, const char *unit,
                       ambulo__text_buffer *text) {
  int decimals;
  double step = ambulo__nice_step(panel->duration, parts, &decimals);
  ambulo__text_buffer label;
  ambulo__text_init_part(&label, text);
  ambulo__svg_line(text, "axis", panel->x, panel->y, panel->x + panel->width, panel->y);
  int last = (int)(panel->duration / step + 1e-6);
  for (int i = 0; i <= last; i++) {
    double t = (double)i * step, x = ambulo__panel_time(panel, t);
    ambulo__svg_line(text, "axis", x, panel->y, x, panel->y + 4.0);
    ambulo__text_clear(&label);
    ambulo__label_number(&label, t, decimals);
    if (i == last && unit) ambulo__text_append_format(&label, " %s", unit);
    ambulo__svg_label(text, "middle", x, panel->y + 18.0, ambulo__text_data(&label));
  }
  ambulo__text_free(&label);
}
