/* export/motion_source.c - see motion_source.h. */
#include "export/motion_source.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "base/paths.h"
#include "format/motion_file.h"

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

static void take_vector(columns *c, const char *before, const char *name, double *out,
                        size_t stride) {
  static const char *const ends[] = {".x", ".y", ".z"};
  for (int i = 0; i < 3; i++) take(c, before, name, ends[i], out + i, stride);
}

static int has_forces(const ambulo_model *model, const ambulo__motion *table) {
  char label[2 * AMBULO__MOTION_MAX_NAME];
  if (ambulo_model_foot_count(model) == 0) return 0;
  (void)snprintf(label, sizeof label, "grf.%s.x", ambulo_model_foot(model, 0)->name);
  return ambulo__motion_column(table, label) >= 0;
}

/* --------------------------------------------------------------------- the points */

/* rows without a point take that of the nearest row with one */
static void fill_points(ambulo__source *s, int foot) {
  size_t stride = 3 * (size_t)s->feet;
  double *point = s->point + 3 * foot;
  for (int k = 0, from = 0; k <= s->rows; k++) {
    if (k < s->rows && !isfinite(point[(size_t)k * stride])) continue;
    for (int i = from; i < k; i++) {
      int back = from - 1, ahead = k;
      int near = ahead >= s->rows ||
                         (back >= 0 && s->time[i] - s->time[back] <= s->time[ahead] - s->time[i])
                     ? back
                     : ahead;
      for (int a = 0; a < 3; a++)
        point[(size_t)i * stride + (size_t)a] =
            near < 0 ? 0.0 : point[(size_t)near * stride + (size_t)a];
    }
    from = k + 1;
  }
}

/* ------------------------------------------------------------------------- reading */

static ambulo_status allocate(const ambulo_model *model, const ambulo__motion *table,
                              ambulo__source *s) {
  size_t rows = (size_t)table->rows, d = (size_t)ambulo_model_coordinate_count(model);
  s->rows = table->rows;
  s->coordinates = (int)d;
  s->feet = has_forces(model, table) ? ambulo_model_foot_count(model) : 0;
  size_t feet = (size_t)s->feet;
  double **const fields[] = {&s->time,   &s->q,     &s->qd,    &s->qdd,        &s->tau,
                             &s->wrench, &s->force, &s->point, &s->free_moment};
  const size_t sizes[] = {1, d, d, d, d, 6, 3 * feet, 3 * feet, feet};
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
  size_t d = (size_t)s->coordinates, feet = (size_t)s->feet;
  memcpy(s->time, table->time, (size_t)table->rows * sizeof *s->time);
  for (size_t i = 0; i < d; i++) {
    const char *name = ambulo_model_coordinate(model, (int)i)->name;
    take(&c, "q.", name, "", s->q + i, d);
    take(&c, "qd.", name, "", s->qd + i, d);
    take(&c, "qdd.", name, "", s->qdd + i, d);
    take(&c, "tau.", name, "", s->tau + i, d);
  }
  take_vector(&c, "wrench.", "moment", s->wrench, 6);
  take_vector(&c, "wrench.", "force", s->wrench + 3, 6);
  for (size_t foot = 0; foot < feet; foot++) {
    const char *name = ambulo_model_foot(model, (int)foot)->name;
    take_vector(&c, "grf.", name, s->force + 3 * foot, 3 * feet);
    take_vector(&c, "cop.", name, s->point + 3 * foot, 3 * feet);
    take(&c, "free_moment.", name, "", s->free_moment + foot, feet);
    fill_points(s, (int)foot);
  }
  return c.missing ? AMBULO_E_INTERNAL : AMBULO_OK;
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
                                  const ambulo_inverse_options *options,
                                  const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo__source *source) {
  ambulo__source s = {.allocator = ambulo__allocator_or_default(allocator), .name = "motion"};
  ambulo_status status = AMBULO_OK;
  char *text = NULL, *inner = table_of_folder(&s.allocator, motion, &status);
  const char *path = inner ? inner : motion;
  if (!status)
    status = ambulo_inverse_dynamics_motion(
        model, path, NULL, options, allocator, diagnostics,
        &(ambulo_inverse_outputs){.size = sizeof(ambulo_inverse_outputs), .text = &text});
  if (!status) status = read_text(model, path, text, allocator, diagnostics, &s);
  ambulo__free(&s.allocator, text);
  ambulo__free(&s.allocator, inner);
  if (status)
    ambulo__source_free(&s);
  else
    *source = s;
  return status;
}

void ambulo__source_free(ambulo__source *s) {
  double *const fields[] = {s->time,   s->q,     s->qd,    s->qdd,        s->tau,
                            s->wrench, s->force, s->point, s->free_moment};
  for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
    ambulo__free(&s->allocator, fields[i]);
  *s = (ambulo__source){.rows = 0};
}
