/* people/hand_load.c - forces and moments that hands exert, by the columns of a table
 * (hand_load.h). */
#include "people/hand_load.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/arithmetic.h"
#include "people/motion_fit.h"
#include "mechanics/pose.h"
#include "model/model.h"

enum { HAND = 6 }; /* numbers of a hand: force, moment */

static const char prefix[] = "held.";

/* -------------------------------------------------------------------- columns */

/* "held.LOAD.POINT.force.x", taken apart; point -1: "held.LOAD.power" */
typedef struct label {
  const char *load;
  size_t load_length;
  int point, part; /* part: 0 to 2 of the force, 3 to 5 of the moment */
} label;

static int ends_with(const char *text, size_t length, const char *end) {
  size_t tail = strlen(end);
  return length > tail && strncmp(text + length - tail, end, tail) == 0;
}

/* the longest name of a point that ends the text, behind a dot and a name; both may have dots */
static int point_at_end(const ambulo_model *model, const char *text, size_t length) {
  int best = -1;
  size_t longest = 0;
  for (int i = 0; i < model->point_count; i++) {
    const char *name = model->points[i].name;
    size_t size = strlen(name);
    if (size <= longest || !ends_with(text, length, name)) continue;
    if (length < size + 2 || text[length - size - 1] != '.') continue;
    best = i;
    longest = size;
  }
  return best;
}

typedef enum reading { OTHER, UNKNOWN_COLUMN, UNKNOWN_POINT, POWER, COMPONENT } reading;

static reading read_label(const ambulo_model *model, const char *name, label *l) {
  static const char *const ends[HAND] = {".force.x",  ".force.y",  ".force.z",
                                         ".moment.x", ".moment.y", ".moment.z"};
  size_t head = sizeof prefix - 1;
  if (strncmp(name, prefix, head) != 0) return OTHER;
  *l = (label){.load = name + head, .point = -1, .part = -1};
  size_t length = strlen(l->load);
  for (int i = 0; i < HAND; i++)
    if (ends_with(l->load, length, ends[i])) l->part = i;
  if (l->part < 0) return ends_with(l->load, length, ".power") ? POWER : UNKNOWN_COLUMN;
  length -= strlen(ends[l->part]);
  l->point = point_at_end(model, l->load, length);
  if (l->point < 0) return UNKNOWN_POINT;
  l->load_length = length - strlen(model->points[l->point].name) - 1;
  return COMPONENT;
}

int ambulo__hand_of_column(const ambulo_model *model, const char *column, size_t *length) {
  label l;
  if (read_label(model, column, &l) != COMPONENT || l.part != 0) return -1;
  *length = strlen(l.load) - strlen(".force.x");
  return l.point;
}

int ambulo__has_hand_loads(const ambulo__motion *table) {
  for (int c = 0; c < table->columns; c++)
    if (strncmp(table->names[c], prefix, sizeof prefix - 1) == 0) return 1;
  return 0;
}

/* On its way from the table: which columns a load has. */
typedef struct held {
  int column[2][HAND]; /* -1: none */
} held;

typedef struct reader {
  const ambulo__load_source *source;
  const ambulo__motion *table;
  ambulo__hand_load *load;
  held *columns; /* [loads] */
} reader;

static ambulo_status refuse(const reader *r, const char *format, const char *what, double time) {
  char text[2 * AMBULO__MOTION_MAX_NAME];
  ambulo__place place = {.file = r->source->file};
  (void)snprintf(text, sizeof text, format, what, time);
  return ambulo__error(r->source->doubts->diagnostics, AMBULO_E_SCHEMA, place, NULL, "%s", text);
}

/* its index, made if it is new; -1: out of memory */
static int load_named(reader *r, const label *l) {
  ambulo__hand_load *load = r->load;
  for (int i = 0; i < load->loads; i++) {
    const char *name = load->hold[i].name;
    if (strlen(name) == l->load_length && strncmp(name, l->load, l->load_length) == 0) return i;
  }
  size_t count = (size_t)load->loads + 1;
  ambulo_hold *holds = ambulo__realloc(&load->allocator, load->hold, count, sizeof *holds);
  if (holds) load->hold = holds;
  held *columns = ambulo__realloc(&load->allocator, r->columns, count, sizeof *columns);
  if (columns) r->columns = columns;
  char *name = ambulo__alloc(&load->allocator, l->load_length + 1, 1);
  if (!holds || !columns || !name) {
    ambulo__free(&load->allocator, name);
    return -1;
  }
  memcpy(name, l->load, l->load_length);
  holds[load->loads] = ambulo_hold_default();
  holds[load->loads].name = name;
  for (int i = 0; i < 2 * HAND; i++) columns[load->loads].column[i / HAND][i % HAND] = -1;
  return load->loads++;
}

static ambulo_status take_component(reader *r, const label *l, int column) {
  int i = load_named(r, l), hand = 0;
  if (i < 0) return AMBULO_E_MEMORY;
  ambulo_hold *hold = &r->load->hold[i];
  while (hand < 2 && hold->hand[hand] >= 0 && hold->hand[hand] != l->point) hand++;
  if (hand == 2)
    return refuse(r, "the load '%s' is held by more than two points; expected one or two hands",
                  hold->name, 0.0);
  hold->hand[hand] = l->point;
  r->columns[i].column[hand][l->part] = column;
  return AMBULO_OK;
}

static void doubt_column(const reader *r, reading what, const char *name, int more) {
  const ambulo_model *model = r->source->model;
  const char *expected =
      "expected held.LOAD.POINT.force.x|y|z, held.LOAD.POINT.moment.x|y|z, held.LOAD.power";
  ambulo__doubt(r->source->doubts, r->source->file,
                what == UNKNOWN_POINT ? "the model it was solved with has the point" : expected,
                what == UNKNOWN_POINT
                    ? "'%s' names no point of model '%s'; %d such column%s left out"
                    : "'%s' says nothing that hands of model '%s' do; %d such column%s left out",
                name, model->name, more, more > 1 ? "s are" : " is");
}

/* every column that is left out is counted, the first named */
static ambulo_status find_columns(reader *r) {
  int left_out[2] = {0, 0}, first[2] = {-1, -1};
  for (int c = 0; c < r->table->columns; c++) {
    label l;
    reading what = read_label(r->source->model, r->table->names[c], &l);
    ambulo_status status = what == COMPONENT ? take_component(r, &l, c) : AMBULO_OK;
    if (status) return status;
    if (what != UNKNOWN_COLUMN && what != UNKNOWN_POINT) continue;
    int kind = what == UNKNOWN_POINT;
    if (left_out[kind]++ == 0) first[kind] = c;
  }
  for (int kind = 0; kind < 2; kind++)
    if (left_out[kind])
      doubt_column(r, kind ? UNKNOWN_POINT : UNKNOWN_COLUMN, r->table->names[first[kind]],
                   left_out[kind]);
  return AMBULO_OK;
}

/* components that a hand lacks, of those that matter to the model */
static ambulo_status doubt_gaps(const reader *r) {
  static const char *const names[2] = {"force", "moment"};
  const ambulo_model *model = r->source->model;
  int idle = -1;
  if (!r->columns) return AMBULO_OK; /* hands hold nothing */
  ambulo_status status = ambulo__idle_axis(model, &r->load->allocator, &idle);
  for (int at = 0; !status && at < 4 * r->load->loads; at++) {
    const ambulo_hold *hold = &r->load->hold[at / 4];
    int hand = at / 2 % 2, moment = at % 2, lacking = 0;
    char letters[8] = "";
    if (hold->hand[hand] < 0) continue;
    for (int k = 0; k < 3; k++) {
      /* what turns a planar body does so about its idle axis alone */
      int matters = idle < 0 || (moment ? k == idle : k != idle);
      if (!matters || r->columns[at / 4].column[hand][3 * moment + k] >= 0) continue;
      size_t used = strlen(letters);
      (void)snprintf(letters + used, sizeof letters - used, "%s%c", lacking++ ? ", " : "",
                     "xyz"[k]);
    }
    if (lacking)
      ambulo__doubt(r->source->doubts, r->source->file, "a column of zeros says that it is zero",
                    "'held.%s.%s' lacks the %s of its %s; it is taken as 0", hold->name,
                    model->points[hold->hand[hand]].name, letters, names[moment]);
  }
  return status;
}

/* --------------------------------------------------------------------- values */

/* force and moment of a hand on the table's own rows, [rows][HAND] */
static ambulo_status take_hand(const reader *r, int load, int hand, double *values) {
  const ambulo_inverse_options *o = r->source->options;
  for (int k = 0; k < r->table->rows; k++) {
    for (int i = 0; i < HAND; i++) {
      int column = r->columns[load].column[hand][i];
      double *value = values + (size_t)k * HAND + (size_t)i;
      *value = column < 0 ? 0.0 : r->table->values[k * r->table->columns + column];
      if (!isfinite(*value))
        return refuse(r, "'%s' is no number (nan) at t = %g s; hands that hold nothing exert 0",
                      r->table->names[column], o->force_time_unit * r->table->time[k]);
    }
  }
  ambulo__filtering filtering = {.time = r->table->time,
                                 .rows = r->table->rows,
                                 .time_unit = o->force_time_unit,
                                 .cutoff = o->force_cutoff,
                                 .order = o->filter_order,
                                 .option = "--grf-filter",
                                 .file = r->source->file,
                                 .diagnostics = r->source->doubts->diagnostics};
  if (isnan(o->force_cutoff)) return AMBULO_OK;
  return ambulo__filter(&filtering, values, HAND, &r->load->allocator);
}

static ambulo_status take_hands(const reader *r, double *values) {
  ambulo__hand_load *load = r->load;
  for (int at = 0; at < 2 * load->loads; at++) {
    if (load->hold[at / 2].hand[at % 2] < 0) continue;
    ambulo_status status = take_hand(r, at / 2, at % 2, values);
    if (status) return status;
    for (int k = 0; k < load->rows; k++) {
      double now[HAND];
      size_t to = 3 * ((size_t)k * 2 * (size_t)load->loads + (size_t)at);
      ambulo__load_between(r->table, r->source->options->force_time_unit, values, HAND,
                           r->source->times[k], now);
      memcpy(load->force + to, now, 3 * sizeof *now);
      memcpy(load->moment + to, now + 3, 3 * sizeof *now);
    }
  }
  return AMBULO_OK;
}

static ambulo_status fill(reader *r) {
  ambulo__hand_load *load = r->load;
  const ambulo_allocator *a = &load->allocator;
  ambulo_status status = find_columns(r);
  if (!status) status = doubt_gaps(r);
  if (status || load->loads == 0) return status;
  status = ambulo__load_times_check(r->source, r->table);
  if (status) return status;
  size_t count = (size_t)load->rows * (size_t)load->loads;
  load->force = ambulo__alloc(a, 6 * count, sizeof(double));
  load->moment = ambulo__alloc(a, 6 * count, sizeof(double));
  load->power = ambulo__alloc(a, count, sizeof(double));
  double *values = ambulo__alloc(a, HAND * (size_t)r->table->rows, sizeof *values);
  int complete = load->force && load->moment && load->power && values;
  status = complete ? take_hands(r, values) : AMBULO_E_MEMORY;
  ambulo__free(a, values);
  return status;
}

ambulo_status ambulo__hand_load_read(const ambulo__load_source *source,
                                     const ambulo_allocator *allocator, ambulo__hand_load *load) {
  ambulo__hand_load l = {.allocator = ambulo__allocator_or_default(allocator),
                         .rows = source->rows};
  ambulo__motion *read = NULL;
  reader r = {.source = source, .table = source->table, .load = &l};
  ambulo_status status = AMBULO_OK;
  if (!r.table) {
    status = ambulo__motion_read(source->file, 1, &l.allocator, source->doubts->diagnostics, &read);
    r.table = read;
  }
  if (!status && r.table) status = fill(&r);
  ambulo__free(&l.allocator, r.columns);
  ambulo__motion_free(read);
  if (status) {
    ambulo__hand_load_free(&l);
  } else {
    *load = l;
  }
  return status;
}

void ambulo__hand_load_free(ambulo__hand_load *load) {
  union {
    const char *constant;
    char *plain;
  } name;
  for (int i = 0; i < load->loads; i++) {
    name.constant = load->hold[i].name;
    ambulo__free(&load->allocator, name.plain);
  }
  ambulo__free(&load->allocator, load->hold);
  ambulo__free(&load->allocator, load->force);
  ambulo__free(&load->allocator, load->moment);
  ambulo__free(&load->allocator, load->power);
}

/* ------------------------------------------------------------------- applying */

/* (I.5) one hand of one row: tau [d], wrench [6]; returns the power of its force */
static double apply_hand(const ambulo_model *model, const ambulo__pose *pose, int point,
                         const double force[3], const double moment[3], const double *q,
                         const double *qd, double *tau, double *wrench) {
  const ambulo_point *hand = &model->points[point];
  double place[3], lever[3], zero[3] = {0.0, 0.0, 0.0}, power = 0.0;
  ambulo__pose_point(pose, hand->link, hand->position, place);
  ambulo__cross(place, force, lever);
  for (int k = 0; k < 3; k++) {
    wrench[k] += lever[k] + moment[k];
    wrench[3 + k] += force[k];
  }
  for (int link = hand->link; link >= 0; link = model->links[link].parent) {
    double slope[AMBULO__COUPLING_SLOPES];
    int i = ambulo__moved_by(model, link);
    if (i < 0) continue;
    (void)ambulo__joint_value(model, link, q, slope);
    double by_force = slope[0] * ambulo__load_share(model, pose->frames, link, force, lever);
    tau[i] += by_force + slope[0] * ambulo__load_share(model, pose->frames, link, zero, moment);
    power += qd[i] * by_force;
  }
  return power;
}

ambulo_status ambulo__hand_load_apply(ambulo__hand_load *load, const ambulo_model *model,
                                      const double *q, const double *qd, double *tau,
                                      double *wrench) {
  ambulo__pose pose = {.model = NULL};
  size_t d = (size_t)model->coordinate_count, loads = (size_t)load->loads;
  ambulo_status status = ambulo__pose_create(model, &load->allocator, &pose);
  if (status) return status;
  for (size_t k = 0; k < (size_t)load->rows; k++) {
    ambulo__pose_at(&pose, q + k * d);
    for (size_t i = 0; i < 2 * loads; i++) {
      size_t at = 3 * (2 * k * loads + i);
      int point = load->hold[i / 2].hand[i % 2];
      if (point < 0) continue;
      load->power[k * loads + i / 2] +=
          apply_hand(model, &pose, point, load->force + at, load->moment + at, q + k * d,
                     qd + k * d, tau + k * d, wrench + 6 * k);
    }
  }
  ambulo__pose_free(&pose);
  return AMBULO_OK;
}
