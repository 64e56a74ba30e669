/* exchange/motion_source.c - see export.h. */
#include "exchange/export.h"

#include "base/arithmetic.h"
#include "formats/motion_file.h"
#include "formats/paths.h"
#include "mechanics/pose.h"
#include "model/model.h"
#include "people/hand_load.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

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
  ambulo_status status = ambulo__motion_read(path, 1, &s->allocator, diagnostics, &s->table);
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

/*
 * Along the links from the world, T(q) = J(z, q) F (bodies.c). With z the joint's axis, R and o the
 * frame before it, r the way of F's origin after the turn, all in the ground's axes:
 *
 *   hinge   w+ = w + z q'      w'+ = w' + z q'' + w x z q'
 *           v+ = v + w+ x r    a+ = a + w'+ x r + w+ x (w+ x r)
 *   slider  s = z q + r        v+ = v + w x s + z q'
 *           a+ = a + w' x s + w x (w x s) + 2 w x z q' + z q''
 */

/* v += w x s; a += w' x s + w x (w x s) */
static void carry(ambulo__frame_motion *m, const double s[3]) {
  double turn[3], out[3];
  ambulo__cross(m->spin, s, turn);
  for (int i = 0; i < 3; i++) m->velocity[i] += turn[i];
  ambulo__cross(m->spin, turn, out);
  for (int i = 0; i < 3; i++) m->acceleration[i] += out[i];
  ambulo__cross(m->spin_rate, s, out);
  for (int i = 0; i < 3; i++) m->acceleration[i] += out[i];
}

static void turn_about(ambulo__frame_motion *m, const double z[3], double rate, double second) {
  double gyro[3];
  ambulo__cross(m->spin, z, gyro);
  for (int i = 0; i < 3; i++) {
    m->spin_rate[i] += z[i] * second + gyro[i] * rate;
    m->spin[i] += z[i] * rate;
  }
}

static void slide_along(ambulo__frame_motion *m, const double z[3], double rate, double second) {
  double gyro[3];
  ambulo__cross(m->spin, z, gyro);
  for (int i = 0; i < 3; i++) {
    m->acceleration[i] += z[i] * second + 2.0 * gyro[i] * rate;
    m->velocity[i] += z[i] * rate;
  }
}

static void pass_link(const ambulo_model *model, int index, const double *q, const double *qd,
                      const double *qdd, ambulo__frame_motion *m) {
  static const double z_axis[3] = {0, 0, 1};
  const ambulo_link *link = &model->links[index];
  int c = ambulo__moved_by(model, index), hinge = link->type == AMBULO_REVOLUTE;
  double s[3], z[3], f[AMBULO__COUPLING_SLOPES];
  ambulo__rigid t = ambulo__link_transform(link, ambulo__joint_value(model, index, q, f));
  double rate = c < 0 ? 0.0 : f[0] * qd[c];
  double gain = c < 0 ? 0.0 : f[0] * qdd[c] + f[1] * qd[c] * qd[c];
  ambulo__rigid_vector(&m->place, z_axis, z);
  ambulo__rigid_vector(&m->place, t.p, s);
  if (c >= 0 && hinge) turn_about(m, z, rate, gain);
  carry(m, s);
  if (c >= 0 && !hinge) slide_along(m, z, rate, gain);
  m->place = ambulo__rigid_times(&m->place, &t);
}

void ambulo__frame_motion_of(const ambulo_model *model, int link, const ambulo__rigid *world,
                             const double *q, const double *qd, const double *qdd,
                             ambulo__frame_motion *motion) {
  if (link < 0) {
    *motion = (ambulo__frame_motion){.place = *world};
    return;
  }
  ambulo__frame_motion_of(model, model->links[link].parent, world, q, qd, qdd, motion);
  pass_link(model, link, q, qd, qdd, motion);
}

/* The largest of the four squares is at least a quarter: nothing is divided by less than 1/2. */
void ambulo__quaternion_of(const double r[3][3], const double *before, double q[4]) {
  double trace = r[0][0] + r[1][1] + r[2][2];
  int most = 3; /* w */
  for (int i = 0; i < 3; i++)
    if (r[i][i] > (most == 3 ? trace : r[most][most])) most = i;
  if (most == 3) {
    q[3] = 1.0 + trace;
    q[0] = r[2][1] - r[1][2];
    q[1] = r[0][2] - r[2][0];
    q[2] = r[1][0] - r[0][1];
  } else {
    int i = most, j = (i + 1) % 3, k = (i + 2) % 3;
    q[i] = 1.0 + r[i][i] - r[j][j] - r[k][k];
    q[j] = r[j][i] + r[i][j];
    q[k] = r[k][i] + r[i][k];
    q[3] = r[k][j] - r[j][k];
  }
  double size = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]), same = q[3];
  if (before) same = q[0] * before[0] + q[1] * before[1] + q[2] * before[2] + q[3] * before[3];
  if (same < 0.0) size = -size;
  for (int i = 0; i < 4; i++) q[i] /= size;
}
