/* show/gait_curves.c - small panels: joint angles (degrees) above, torques (N m) below, powers
 * (W).
 *
 * A panel shows one coordinate or a left-right pair. Shown are hip flexion, knee and ankle if
 * the model has them, then the coordinates with the largest torques; behind them, for a walk, the
 * curves of people. */
#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "model/neutral_pose.h"
#include "show/gait_chart.h"
#include "show/svg.h"

#include <math.h>
#include <string.h>

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

/* a row of panels: what of a coordinate, with how many of the unit shown in one of SI's */
typedef struct row {
  const char *quantity;          /* of people (gait_people.h) */
  const char *turning, *sliding; /* what stands behind the name */
  const double *values;          /* [samples][coordinates] */
  double factor[2];              /* of a revolute, of a prismatic coordinate */
} row;

static void draw_title(const ambulo__gait_chart *c, int coordinate, const char *end,
                       ambulo__text_buffer *text) {
  ambulo__text_buffer title;
  ambulo__text_init_part(&title, text);
  ambulo__coordinate_title(c->stride->model, coordinate, &title);
  ambulo__text_append(&title, end);
  ambulo__svg_label_within(text, "panel", c->box.x, c->box.y - 14.0, c->box.width, 13.0,
                           ambulo__text_data(&title));
  ambulo__text_free(&title);
}

static void draw_chart(ambulo__gait_chart *c, int coordinate, const row *r,
                       ambulo__gait_people *people, ambulo__text_buffer *text) {
  const ambulo_model *model = c->stride->model;
  ambulo__people_curve beside[2];
  int pair[2] = {coordinate, model->coordinates[coordinate].mirror};
  int count = pair[1] == coordinate ? 1 : 2, with_devices = c->values == c->stride->tau;
  ambulo__chart_range(c, pair, count);
  for (int j = 0; j < count; j++) {
    beside[j] = ambulo__people_coordinate(people, r->quantity, pair[j]);
    ambulo__chart_widen(c, &beside[j]);
    if (with_devices) ambulo__chart_widen_devices(c, pair[j]);
  }
  ambulo__chart_grid(c, text);
  int both = count == 2 && ambulo__chart_alike(c, &beside[0], &beside[1]);
  for (int j = both ? 0 : count - 1; j >= 0; j--) {
    ambulo__chart_people(c, &beside[j], both, text);
    people->shown[beside[j].file] += beside[j].curve != NULL;
  }
  for (int j = count - 1; j >= 0; j--) {
    ambulo__chart_curve(c, pair[j], ambulo__coordinate_side(model, pair[j]), text);
    if (with_devices) ambulo__chart_devices(c, pair[j], text);
  }
  ambulo__chart_axis(c, text);
}

static void draw_row(const ambulo__gait_chart *first, const row *r, const int *chosen, int count,
                     double pitch, ambulo__gait_people *people, ambulo__text_buffer *text) {
  for (int j = 0; j < count; j++) {
    int slides = first->stride->model->coordinates[chosen[j]].type != AMBULO_REVOLUTE;
    ambulo__gait_chart chart = *first;
    chart.box.x += (double)j * pitch;
    chart.values = r->values;
    chart.factor = r->factor[slides];
    draw_title(&chart, chosen[j], slides ? r->sliding : r->turning, text);
    draw_chart(&chart, chosen[j], r, people, text);
  }
}

/* tau qd, W; NULL: no memory */
static double *powers_of(const ambulo__stride *s, const ambulo_allocator *a) {
  size_t count = (size_t)s->samples * (size_t)s->coordinates;
  double *power = ambulo__alloc(a, count, sizeof *power);
  for (size_t i = 0; power && i < count; i++) power[i] = s->tau[i] * s->qd[i];
  return power;
}

ambulo_status ambulo__gait_curves(const ambulo__stride *stride, const ambulo__panel *panel,
                                  const ambulo__gait_style *style, ambulo__gait_people *people,
                                  ambulo__text_buffer *text) {
  const double label_room = 44.0, gap = 30.0, row_room = 74.0;
  int chosen[MOST_COLUMNS], kg = style->per_kg, rows = style->powers ? 3 : 2;
  int count = choose(stride, chosen);
  if (count == 0) return AMBULO_OK;
  double *power = style->powers ? powers_of(stride, &text->allocator) : NULL;
  if (style->powers && !power) return AMBULO_E_MEMORY;
  double by = kg ? 1.0 / ambulo__gait_mass(stride->model) : 1.0;
  const row row_of[3] = {{"q", ", degrees", ", m", stride->q, {degrees, 1.0}},
                         {"tau",
                          kg ? " torque, N m/kg" : " torque, N m",
                          kg ? " force, N/kg" : " force, N",
                          stride->tau,
                          {by, by}},
                         {"power",
                          kg ? " power, W/kg" : " power, W",
                          kg ? " power, W/kg" : " power, W",
                          power,
                          {by, by}}};
  double pitch = (panel->width + gap) / (double)count;
  double height = (panel->height - (double)(rows - 1) * row_room) / (double)rows;
  ambulo__gait_chart chart = {.box = {panel->x + label_room, panel->y, pitch - gap - label_room,
                                      height, style->percent ? 100.0 : stride->duration},
                              .stride = stride,
                              .columns = stride->coordinates,
                              .cycles = style->percent ? people : NULL};
  for (int i = 0; i < rows; i++) {
    draw_row(&chart, &row_of[i], chosen, count, pitch, people, text);
    chart.box.y += height + row_room;
  }
  ambulo__free(&text->allocator, power);
  return AMBULO_OK;
}

/* forces on each foot and on each patch in contact, in body weights: upward
 * and forward.
 *
 * A foot's side is that of its heel at q = 0: of two left where it stands further along left.
 */

enum { MOST_CURVES = 16 };

/* the curves: effectors and the colours that they have */
typedef struct curves {
  int count, effector[MOST_CURVES], column[MOST_CURVES];
  ambulo__side side[MOST_CURVES];
} curves;

static double along_left(const ambulo_model *model, int foot) {
  double r[3];
  ambulo__neutral_point(model, model->feet[foot].heel_center, r);
  return r[0] * model->left[0] + r[1] * model->left[1] + r[2] * model->left[2];
}

static ambulo__side side_of(const ambulo_model *model, int effector) {
  int patch = ambulo__effector_patch(model, effector);
  if (patch >= 0) return ambulo__gait_patch_side(model, patch);
  double other = model->foot_count == 2 ? along_left(model, 1 - effector) : 0.0;
  return along_left(model, effector) > other ? AMBULO__LEFT : AMBULO__RIGHT;
}

static curves curves_of(const ambulo__stride *s) {
  curves all = {.count = 0};
  for (int e = 0; e < s->feet + s->patches && all.count < MOST_CURVES; e++) {
    if (!ambulo__gait_shows(s, e)) continue;
    all.effector[all.count] = e;
    all.side[all.count] = side_of(s->model, e);
    all.column[all.count] = all.count;
    all.count++;
  }
  return all;
}

static double force_along(const ambulo__stride *s, int k, int effector, const double direction[3]) {
  int patch = ambulo__effector_patch(s->model, effector);
  if (patch < 0) return ambulo__stride_force(s, k, effector, direction);
  return ambulo__dot(ambulo__stride_patch_force(s, k, patch), direction) /
         ambulo__model_weight(s->model);
}

/* the people's, behind the two feet */
static void draw_people(ambulo__gait_chart *c, const char *name, ambulo__gait_people *people,
                        ambulo__text_buffer *text) {
  ambulo__people_curve right = ambulo__people_force(people, name, AMBULO__RIGHT);
  ambulo__people_curve left = ambulo__people_force(people, name, AMBULO__LEFT);
  ambulo__chart_widen(c, &right);
  ambulo__chart_widen(c, &left);
  ambulo__chart_grid(c, text);
  int both = ambulo__chart_alike(c, &left, &right);
  if (!both) ambulo__chart_people(c, &right, 0, text);
  ambulo__chart_people(c, &left, both, text);
  people->shown[left.file] += left.curve != NULL;
}

static void draw_force(ambulo__gait_chart *c, const curves *all, const char *name, double *values,
                       ambulo__gait_people *people, ambulo__text_buffer *text) {
  const ambulo__stride *s = c->stride;
  int upward = strcmp(name, "up") == 0;
  const double *direction = upward ? s->model->up : s->model->forward;
  for (int k = 0; k < s->samples; k++) {
    for (int i = 0; i < all->count; i++)
      values[k * all->count + i] = force_along(s, k, all->effector[i], direction);
  }
  ambulo__svg_label(text, "panel", c->box.x, c->box.y - 14.0,
                    people->per_kg
                        ? upward ? "Ground reaction upward, N/kg" : "Ground reaction forward, N/kg"
                    : upward ? "Ground reaction upward, body weights"
                             : "Ground reaction forward, body weights");
  ambulo__chart_range(c, all->column, all->count);
  draw_people(c, name, people, text);
  for (int i = all->count - 1; i >= 0; i--) ambulo__chart_curve(c, i, all->side[i], text);
  ambulo__chart_axis(c, text);
}

ambulo_status ambulo__gait_forces(const ambulo__stride *stride, const ambulo__panel *panel,
                                  const ambulo__gait_style *style, ambulo__gait_people *people,
                                  ambulo__text_buffer *text) {
  const double label_room = 44.0, gap = 30.0;
  curves all = curves_of(stride);
  if (all.count == 0) return AMBULO_OK;
  size_t count = (size_t)stride->samples * (size_t)all.count;
  double *values = ambulo__alloc(&text->allocator, count, sizeof *values);
  if (!values) return AMBULO_E_MEMORY;
  double width = 0.5 * (panel->width - gap) - label_room;
  double mass = ambulo__gait_mass(stride->model);
  ambulo__gait_chart up = {.box = {panel->x + label_room, panel->y, width, panel->height,
                                   style->percent ? 100.0 : stride->duration},
                           .stride = stride,
                           .values = values,
                           .columns = all.count,
                           .factor =
                               style->per_kg ? ambulo__model_weight(stride->model) / mass : 1.0,
                           .cycles = style->percent ? people : NULL};
  ambulo__gait_chart ahead = up;
  ahead.box.x += width + label_room + gap;
  draw_force(&up, &all, "up", values, people, text);
  draw_force(&ahead, &all, "forward", values, people, text);
  ambulo__free(&text->allocator, values);
  return AMBULO_OK;
}
