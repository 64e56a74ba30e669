/* picture/gait_curves.c - small panels: joint angles (degrees) above, torques (N m) below.
 *
 * A panel shows one coordinate or a left-right pair. Shown are hip flexion, knee and ankle if
 * the model has them, then the coordinates with the largest torques; behind them, for a walk, the
 * curves of people. */
#include <math.h>
#include <string.h>

#include "picture/gait_chart.h"
#include "picture/svg.h"

enum { MOST_COLUMNS = 3 };
static const double degrees = 57.295779513082321;

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

/* ------------------------------------------------------------------- drawing */

static void draw_chart(ambulo__gait_chart *c, int coordinate, const char *quantity,
                       const char *title_end, ambulo__gait_people *people,
                       ambulo__text_buffer *text) {
  const ambulo_model *model = c->stride->model;
  ambulo__people_curve beside[2];
  int pair[2] = {coordinate, model->coordinates[coordinate].mirror};
  int count = pair[1] == coordinate ? 1 : 2;
  ambulo__text_buffer title;
  ambulo__text_init_part(&title, text);
  ambulo__coordinate_title(model, coordinate, &title);
  ambulo__text_append(&title, title_end);
  ambulo__svg_label(text, "panel", c->box.x, c->box.y - 14.0, ambulo__text_data(&title));
  ambulo__text_free(&title);
  ambulo__chart_range(c, pair, count);
  for (int j = 0; j < count; j++) {
    beside[j] = ambulo__people_coordinate(people, quantity, pair[j]);
    ambulo__chart_widen(c, &beside[j]);
    if (c->values == c->stride->tau) ambulo__chart_widen_devices(c, pair[j]);
  }
  ambulo__chart_grid(c, text);
  for (int j = count - 1; j >= 0; j--) {
    ambulo__chart_people(c, &beside[j], text);
    people->shown[beside[j].file] |= beside[j].curve != NULL;
  }
  for (int j = count - 1; j >= 0; j--) {
    ambulo__chart_curve(c, pair[j], ambulo__coordinate_side(model, pair[j]), text);
    if (c->values == c->stride->tau) ambulo__chart_devices(c, pair[j], text);
  }
  ambulo__panel axis = c->box;
  axis.y += c->box.height;
  ambulo__time_axis(&axis, 4, "s", text);
}

void ambulo__gait_curves(const ambulo__stride *stride, const ambulo__panel *panel,
                         ambulo__gait_people *people, ambulo__text_buffer *text) {
  const double label_room = 44.0, gap = 30.0, row_room = 74.0;
  int chosen[MOST_COLUMNS];
  int count = choose(stride, chosen);
  if (count == 0) return;
  double width = (panel->width - (double)(count - 1) * gap) / (double)count - label_room;
  double height = (panel->height - row_room) / 2.0;
  for (int j = 0; j < count; j++) {
    int revolute = stride->model->coordinates[chosen[j]].type == AMBULO_REVOLUTE;
    double x = panel->x + (double)j * (width + label_room + gap) + label_room;
    ambulo__gait_chart upper = {.box = {x, panel->y, width, height, stride->duration},
                                .stride = stride,
                                .values = stride->q,
                                .columns = stride->coordinates,
                                .factor = revolute ? degrees : 1.0};
    ambulo__gait_chart lower = upper;
    lower.box.y += height + row_room;
    lower.values = stride->tau;
    lower.factor = 1.0;
    draw_chart(&upper, chosen[j], "q", revolute ? ", degrees" : ", m", people, text);
    draw_chart(&lower, chosen[j], "tau", revolute ? " torque, N m" : " force, N", people, text);
  }
}
