/* report/gait_curves.c - small panels: joint angles (degrees) above, torques (N m) below.
 *
 * A panel shows one coordinate or a left-right pair. Shown are hip flexion, knee and ankle if
 * the model has them, then the coordinates with the largest torques. */
#include <math.h>
#include <string.h>

#include "report/gait_svg.h"
#include "report/skeleton.h"
#include "report/svg.h"

enum { MOST_COLUMNS = 3 };
static const double degrees = 57.295779513082321;

typedef struct chart {
  ambulo__panel box;
  const ambulo__stride *stride;
  const double *values; /* [samples][coordinates] */
  double factor;        /* to the unit shown */
  double low, high;     /* of the axis, in the unit shown */
} chart;

/* ----------------------------------------------------------------- selection */

/* 0 is shown first; all names beyond the known ones rank alike */
static int rank_of(const char *name) {
  static const char *const first[] = {"hip_flexion", "knee", "ankle"};
  for (int i = 0; i < 3; i++) {
    if (strstr(name, first[i])) return i;
  }
  return 3;
}

static double peak(const ambulo__stride *s, const double *values, int i) {
  double largest = 0.0;
  for (int k = 0; k < s->samples; k++) {
    double value = fabs(values[(size_t)k * (size_t)s->coordinates + (size_t)i]);
    if (isfinite(value) && value > largest) largest = value;
  }
  return largest;
}

static int comes_before(const ambulo__stride *s, int a, int b) {
  int rank_a = rank_of(s->model->coordinates[a].name);
  int rank_b = rank_of(s->model->coordinates[b].name);
  if (rank_a != rank_b) return rank_a < rank_b;
  return peak(s, s->tau, a) > peak(s, s->tau, b);
}

/* among equals the model's order, from the trunk outwards, reads best */
static void restore_order(const ambulo__stride *s, int *chosen, int count) {
  for (int i = 1; i < count; i++) {
    for (int j = i; j > 0; j--) {
      int rank = rank_of(s->model->coordinates[chosen[j]].name);
      int before = rank_of(s->model->coordinates[chosen[j - 1]].name);
      if (rank != before || chosen[j] > chosen[j - 1]) break;
      int kept = chosen[j];
      chosen[j] = chosen[j - 1];
      chosen[j - 1] = kept;
    }
  }
}

/* coordinates (the first of each pair) worth showing; returns their number */
static int choose(const ambulo__stride *s, int chosen[MOST_COLUMNS]) {
  int count = 0, any_driven = 0;
  for (int i = 0; i < s->coordinates; i++) any_driven |= s->model->coordinates[i].actuated;
  for (int i = 0; i < s->coordinates; i++) {
    const ambulo_coordinate *c = &s->model->coordinates[i];
    if ((any_driven && !c->actuated) || c->mirror < i) continue;
    int at = count < MOST_COLUMNS ? count++ : MOST_COLUMNS;
    for (; at > 0 && comes_before(s, i, chosen[at - 1]); at--) {
      if (at < MOST_COLUMNS) chosen[at] = chosen[at - 1];
    }
    if (at < MOST_COLUMNS) chosen[at] = i;
  }
  restore_order(s, chosen, count);
  return count;
}

/* "hip_flexion_r" -> "Hip flexion" */
static void pretty_name(const ambulo_model *model, int i, ambulo__text_buffer *out) {
  const ambulo_coordinate *c = &model->coordinates[i];
  size_t length = strlen(c->name);
  if (c->mirror != i && length > 2 && c->name[length - 2] == '_') length -= 2;
  for (size_t k = 0; k < length; k++) {
    char letter = c->name[k] == '_' ? ' ' : c->name[k];
    if (k == 0 && letter >= 'a' && letter <= 'z') letter = (char)(letter - 'a' + 'A');
    ambulo__text_append_char(out, letter);
  }
}

/* ------------------------------------------------------------------- drawing */

static void find_range(chart *c, const int *coordinates, int count) {
  double low = 0.0, high = 0.0;
  for (int j = 0; j < count; j++) {
    for (int k = 0; k < c->stride->samples; k++) {
      size_t at = (size_t)k * (size_t)c->stride->coordinates + (size_t)coordinates[j];
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

static double chart_y(const chart *c, double value) {
  return c->box.y + c->box.height * (c->high - value) / (c->high - c->low);
}

/* horizontal grid; the range grows to whole steps */
static void draw_grid(chart *c, ambulo__text_buffer *text) {
  int decimals;
  double step = ambulo__nice_step(c->high - c->low, 4, &decimals);
  c->low = floor(c->low / step + 1e-9) * step;
  c->high = ceil(c->high / step - 1e-9) * step;
  ambulo__text_buffer label;
  ambulo__text_init(&label, &text->allocator);
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

static void draw_curve(const chart *c, int coordinate, ambulo__text_buffer *text) {
  static const char *const styles[] = {"trunk curve", "left curve", "right curve"};
  ambulo__side side = ambulo__coordinate_side(c->stride->model, coordinate);
  int pen_down = 0;
  ambulo__svg_path_begin(text, styles[side]);
  for (int k = 0; k < c->stride->samples; k++) {
    size_t at = (size_t)k * (size_t)c->stride->coordinates + (size_t)coordinate;
    double value = c->factor * c->values[at];
    double x = ambulo__panel_time(&c->box, c->stride->times[k]);
    if (!isfinite(value)) {
      pen_down = 0;
    } else if (pen_down) {
      ambulo__svg_path_line(text, x, chart_y(c, value));
    } else {
      ambulo__svg_path_move(text, x, chart_y(c, value));
      pen_down = 1;
    }
  }
  ambulo__svg_path_end(text);
}

static void draw_chart(chart *c, int coordinate, const char *quantity, ambulo__text_buffer *text) {
  const ambulo_model *model = c->stride->model;
  int pair[2] = {coordinate, model->coordinates[coordinate].mirror};
  int count = pair[1] == coordinate ? 1 : 2;
  ambulo__text_buffer title;
  ambulo__text_init(&title, &text->allocator);
  pretty_name(model, coordinate, &title);
  ambulo__text_append(&title, quantity);
  ambulo__svg_label(text, "panel", c->box.x, c->box.y - 14.0, ambulo__text_data(&title));
  ambulo__text_free(&title);
  find_range(c, pair, count);
  draw_grid(c, text);
  for (int j = count - 1; j >= 0; j--) draw_curve(c, pair[j], text);
  ambulo__panel axis = c->box;
  axis.y += c->box.height;
  ambulo__time_axis(&axis, 4, "s", text);
}

void ambulo__gait_curves(const ambulo__stride *stride, const ambulo__panel *panel,
                         ambulo__text_buffer *text) {
  const double label_room = 44.0, gap = 30.0, row_room = 74.0;
  int chosen[MOST_COLUMNS];
  int count = choose(stride, chosen);
  if (count == 0) return;
  double width = (panel->width - (double)(count - 1) * gap) / (double)count - label_room;
  double height = (panel->height - row_room) / 2.0;
  for (int j = 0; j < count; j++) {
    int revolute = stride->model->coordinates[chosen[j]].type == AMBULO_REVOLUTE;
    double x = panel->x + (double)j * (width + label_room + gap) + label_room;
    chart upper = {.box = {x, panel->y, width, height, stride->duration},
                   .stride = stride,
                   .values = stride->q,
                   .factor = revolute ? degrees : 1.0};
    chart lower = upper;
    lower.box.y += height + row_room;
    lower.values = stride->tau;
    lower.factor = 1.0;
    draw_chart(&upper, chosen[j], revolute ? ", degrees" : ", m", text);
    draw_chart(&lower, chosen[j], revolute ? " torque, N m" : " force, N", text);
  }
}
