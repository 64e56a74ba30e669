/* show/gait_chart.c - one small panel: range, grid, curves, people (gait_chart.h). */
#include "show/gait_chart.h"

#include <math.h>

#include "show/svg.h"

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
