/* exchange/motion_source.c - see motion_source.h. */
#include "exchange/motion_source.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "formats/paths.h"
#include "base/vector.h"
#include "formats/motion_file.h"
#include "people/hand_load.h"
#include "mechanics/pose.h"
#include "model/model.h"

/* ------------------------------------------------------------------------ columns */

typedef struct columns {
  const ambulo__motion *table;
  int missing; /* 1: some column is not there */
} columns;

/* out[row * stride] = column "before name after" */
static void take(columns *c, const char *before, const char *name, const char *after, double *out,
                 size_t stride) {
  char label[3 * AMBULO__MOTION_MAX_NAME];
  (void)snprintf(label, sizeof label, "%s%s%s", before, name, after);
  int column = ambulo__motion_column(c->table, label);
  if (column < 0) c->missing = 1;
  for (int k = 0; column >= 0 && k < c->table->rows; k++)
    out[(size_t)k * stride] =
        c->table->values[(size_t)k * (size_t)c->table->columns + (size_t)column];
}

static void take_vector(columns *c, const char *before, const char *name, const char *after,
                        double *out, size_t stride) {
  for (int i = 0; i < 3; i++) {
    char end[20];
    (void)snprintf(end, sizeof end, "%s.%c", after, "xyz"[i]);
    take(c, before, name, end, out + i, stride);
  }
}

static int has_forces(const ambulo_model *model, const ambulo__motion *table) {
  char label[2 * AMBULO__MOTION_MAX_NAME];
  if (ambulo_model_foot_count(model) == 0) return 0;
  (void)snprintf(label, sizeof label, "grf.%s.x", ambulo_model_foot(model, 0)->name);
  return ambulo__motion_column(table, label) >= 0;
}

/* --------------------------------------------------------------------- the points */

void ambulo__fill_points(const double *time, int rows, int loads, int load, double *points) {
  size_t stride = 3 * (size_t)loads;
  double *point = points + 3 * (size_t)load;
  for (int k = 0, from = 0; k <= rows; k++) {
    if (k < rows && !isfinite(point[(size_t)k * stride])) continue;
    for (int i = from; i < k; i++) {
      int back = from - 1, ahead = k;
      int near = ahead >= rows || (back >= 0 && time[i] - time[back] <= time[ahead] - time[i])
                     ? back
                     : ahead;
      for (int a = 0; a < 3; a++)
        point[(size_t)i * stride + (size_t)a] =
            near < 0 ? 0.0 : point[(size_t)near * stride + (size_t)a];
    }
    from = k + 1;
  }
}

/* ---------------------------------------------------------------------- the loads */

static ambulo_status add_load(ambulo__source *s, const char *name, size_t length, int link,
                              int point) {
  ambulo__source_load *list =
      ambulo__realloc(&s->allocator, s->load, (size_t)s->loads + 1, sizeof *list);
  if (!list) return AMBULO_E_MEMORY;
  s->load = list;
  list[s->loads] = (ambulo__source_load){ambulo__alloc(&s->allocator, length + 1, 1), link, point};
  if (!list[s->loads].name) return AMBULO_E_MEMORY;
  memcpy(list[s->loads++].name, name, length);
  return AMBULO_OK;
}

static ambulo_status find_loads(const ambulo_model *model, const ambulo__motion *table,
                                ambulo__source *s) {
  ambulo_status status = AMBULO_OK;
  for (int i = 0; has_forces(model, table) && !status && i < model->foot_count; i++)
    status = add_load(s, model->feet[i].name, strlen(model->feet[i].name),
                      model->points[model->feet[i].heel[0]].link, -1);
  for (int c = 0; !status && c < table->columns; c++) {
    size_t length = 0;
    int point = ambulo__hand_of_column(model, table->names[c], &length);
    if (point >= 0)
      status =
          add_load(s, table->names[c] + strlen("held."), length, model->points[point].link, point);
  }
  return status;
}

/* the torque is what the force at its point leaves of the moment about the origin */
static void take_foot(columns *c, ambulo__source *s, int i) {
  size_t stride = 3 * (size_t)s->loads, first = 3 * (size_t)i;
  take_vector(c, "grf.", s->load[i].name, "", s->force + first, stride);
  take_vector(c, "cop.", s->load[i].name, "", s->point + first, stride);
  take_vector(c, "moment.", s->load[i].name, "", s->torque + first, stride);
  ambulo__fill_points(s->time, s->rows, s->loads, i, s->point);
  for (size_t k = 0; k < (size_t)s->rows; k++) {
    size_t at = k * stride + first;
    ambulo__add_cross(s->point + at, s->force + at, -1.0, s->torque + at);
  }
}

/* what a hand holds does to it the opposite of what the table says; where the hand is */
static void take_hand(columns *c, const ambulo_model *model, ambulo__pose *pose, ambulo__source *s,
                      int i) {
  const ambulo_point *hand = &model->points[s->load[i].point];
  size_t stride = 3 * (size_t)s->loads, first = 3 * (size_t)i;
  take_vector(c, "held.", s->load[i].name, ".force", s->force + first, stride);
  take_vector(c, "held.", s->load[i].name, ".moment", s->torque + first, stride);
  for (size_t k = 0; k < (size_t)s->rows; k++) {
    size_t at = k * stride + first;
    ambulo__pose_at(pose, s->q + k * (size_t)s->coordinates);
    ambulo__pose_point(pose, hand->link, hand->position, s->point + at);
    for (size_t a = at; a < at + 3; a++) {
      s->force[a] = -s->force[a];
      s->torque[a] = -s->torque[a];
    }
  }
  /* from here on in the words of files that have no dots in names */
  for (char *at = s->load[i].name; *at; at++)
    if (*at == '.') *at = '_';
}

static ambulo_status take_loads(columns *c, const ambulo_model *model, ambulo__source *s) {
  ambulo__pose pose = {.model = NULL};
  ambulo_status status = ambulo__pose_create(model, &s->allocator, &pose);
  for (int i = 0; !status && i < s->loads; i++) {
    if (s->load[i].point < 0)
      take_foot(c, s, i);
    else
      take_hand(c, model, &pose, s, i);
  }
  if (!status) ambulo__pose_free(&pose);
  return status;
}

/* ------------------------------------------------------------------------- reading */

static ambulo_status allocate(const ambulo_model *model, const ambulo__motion *table,
                              ambulo__source *s) {
  size_t rows = (size_t)table->rows, d = (size_t)ambulo_model_coordinate_count(model);
  s->rows = table->rows;
  s->coordinates = (int)d;
  ambulo_status status = find_loads(model, table, s);
  if (status) return status;
  size_t loads = (size_t)s->loads;
  double **const fields[] = {&s->time,   &s->q,     &s->qd,    &s->qdd,   &s->tau,
                             &s->wrench, &s->force, &s->point, &s->torque};
  const size_t sizes[] = {1, d, d, d, d, 6, 3 * loads, 3 * loads, 3 * loads};
  for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
    *fields[i] = ambulo__alloc(&s->allocator, rows * sizes[i], sizeof(double));
    if (!*fields[i]) return AMBULO_E_MEMORY;
  }
  return AMBULO_OK;
}

static ambulo_status fill(const ambulo_model *model, const ambulo__motion *table,
                          ambulo__source *s) {
  ambulo_status status = allocate(model, table, s);
  if (status) return status;
  columns c = {.table = table};
  size_t d = (size_t)s->coordinates;
  memcpy(s->time, table->time, (size_t)table->rows * sizeof *s->time);
  for (size_t i = 0; i < d; i++) {
    const char *name = ambulo_model_coordinate(model, (int)i)->name;
    take(&c, "q.", name, "", s->q + i, d);
    take(&c, "qd.", name, "", s->qd + i, d);
    take(&c, "qdd.", name, "", s->qdd + i, d);
    take(&c, "tau.", name, "", s->tau + i, d);
  }
  take_vector(&c, "wrench.", "moment", "", s->wrench, 6);
  take_vector(&c, "wrench.", "force", "", s->wrench + 3, 6);
  status = take_loads(&c, model, s);
  if (status) return status;
  return c.missing ? AMBULO_E_INTERNAL : AMBULO_OK;
}

/* the file's own columns */
static ambulo_status read_table(const char *path, ambulo_diagnostics *diagnostics,
                                ambulo__source *s) {
  ambulo_status status = ambulo__motion_read_gaps(path, &s->allocator, diagnostics, &s->table);
  if (!status && s->table->rows != s->rows) status = AMBULO_E_INTERNAL;
  return status;
}

static ambulo_status read_text(const ambulo_model *model, const char *motion, const char *text,
                               const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                               ambulo__source *source) {
  ambulo__motion *table = NULL;
  ambulo_status status = ambulo__table_read(text, strlen(text), motion, AMBULO__MOTION_CSV, 0,
                                            allocator, diagnostics, &table);
  if (!status) status = fill(model, table, source);
  ambulo__motion_free(table);
  return status;
}

/* DIR/motion.csv of a folder, else NULL; *status E_MEMORY */
static char *table_of_folder(const ambulo_allocator *allocator, const char *motion,
                             ambulo_status *status) {
  struct stat about;
  if (stat(motion, &about) != 0 || !S_ISDIR(about.st_mode)) return NULL;
  char *path = ambulo__join_paths(allocator, motion, "motion.csv", NULL);
  if (!path) *status = AMBULO_E_MEMORY;
  return path;
}

ambulo_status ambulo__source_read(const ambulo_model *model, const char *motion,
                                  const ambulo_inverse_options *options, int other_forces,
                                  const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo__source *source) {
  ambulo__source s = {.allocator = ambulo__allocator_or_default(allocator), .name = "motion"};
  ambulo_inverse_options how = options ? *options : ambulo_inverse_options_default();
  ambulo_status status = AMBULO_OK;
  how.other_forces |= other_forces;
  char *text = NULL, *inner = table_of_folder(&s.allocator, motion, &status);
  const char *path = inner ? inner : motion;
  if (!status)
    status = ambulo_inverse_dynamics_motion(
        model, path, NULL, &how, allocator, diagnostics,
        &(ambulo_inverse_outputs){.size = sizeof(ambulo_inverse_outputs), .text = &text});
  if (!status) status = read_text(model, path, text, allocator, diagnostics, &s);
  if (!status) status = read_table(path, NULL, &s);
  ambulo__free(&s.allocator, text);
  ambulo__free(&s.allocator, inner);
  if (status)
    ambulo__source_free(&s);
  else
    *source = s;
  return status;
}

void ambulo__source_free(ambulo__source *s) {
  double *const fields[] = {s->time,   s->q,     s->qd,    s->qdd,   s->tau,
                            s->wrench, s->force, s->point, s->torque};
  for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
    ambulo__free(&s->allocator, fields[i]);
  for (int i = 0; i < s->loads; i++) ambulo__free(&s->allocator, s->load[i].name);
  ambulo__free(&s->allocator, s->load);
  ambulo__motion_free(s->table);
  *s = (ambulo__source){.rows = 0};
}
