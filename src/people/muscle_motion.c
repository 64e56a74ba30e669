/* people/muscle_motion.c - the motion of an analysis of muscles, from a table or a stride. */
#include <stdio.h>
#include <string.h>

#include "people/muscle_analysis.h"
#include "people/plausibility.h"

static ambulo_status allocate(ambulo_muscle_analysis *a, int rows) {
  const size_t n = (size_t)rows, d = (size_t)a->muscles->model->coordinate_count,
               m = (size_t)a->muscles->count, f = (size_t)a->muscles->model->foot_count,
               j = (size_t)a->values.joints;
  const struct {
    double **array;
    size_t each;
  } arrays[] = {{&a->times, 1},   {&a->q, d},           {&a->qd, d},         {&a->qdd, d},
                {&a->tau, d},     {&a->tau_rate, d},    {&a->grf, 3 * f},    {&a->activation, m},
                {&a->force, m},   {&a->length, m},      {&a->speed, m},      {&a->metabolic, m},
                {&a->reserve, d}, {&a->contact, 3 * j}, {&a->between, 3 * j}};
  for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
    *arrays[i].array = ambulo__alloc(&a->allocator, n * arrays[i].each, sizeof(double));
    if (!*arrays[i].array) return AMBULO_E_MEMORY;
  }
  return AMBULO_OK;
}

static void copy_column(const ambulo__motion *motion, int column, int entries, int entry,
                        double *to) {
  for (int k = 0; k < motion->rows; k++)
    to[(size_t)k * (size_t)entries + (size_t)entry] =
        motion->values[(size_t)k * (size_t)motion->columns + (size_t)column];
}

static ambulo_status read_coordinates(ambulo_muscle_analysis *a, const ambulo__motion *motion,
                                      ambulo_diagnostics *diagnostics) {
  static const char *const prefixes[] = {"q", "qd", "qdd", "tau"};
  const ambulo_model *model = a->muscles->model;
  double *const to[] = {a->q, a->qd, a->qdd, a->tau};
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < model->coordinate_count; i++)
    for (int k = 0; k < 4; k++) {
      char name[AMBULO__MOTION_MAX_NAME + 1];
      (void)snprintf(name, sizeof name, "%s.%s", prefixes[k], model->coordinates[i].name);
      int column = ambulo__motion_column(motion, name);
      if (column >= 0) {
        copy_column(motion, column, model->coordinate_count, i, to[k]);
        continue;
      }
      ambulo__place place = {.file = a->motion};
      if (!status)
        status = ambulo__error(diagnostics, AMBULO_E_SCHEMA, place,
                               "'ambulo inverse MODEL MOTION -o FILE' makes one of a motion",
                               "no column '%s'; expected a table of 'ambulo solve' or 'ambulo "
                               "inverse' of this body",
                               name);
    }
  return status;
}

static void warn_of_forces(const ambulo_muscle_analysis *a, const char *foot,
                           ambulo_diagnostics *diagnostics) {
  ambulo__warning(diagnostics, (ambulo__place){.file = a->motion}, NULL,
                  "no columns 'grf.%s.x|y|z'; contact forces leave out the ground's", foot);
}

static void read_forces(ambulo_muscle_analysis *a, const ambulo__motion *motion,
                        ambulo_diagnostics *diagnostics) {
  static const char axes[] = "xyz";
  const ambulo_model *model = a->muscles->model;
  const char *lacking = NULL; /* the first foot whose force is not known */
  for (int f = 0; f < model->foot_count; f++)
    for (int k = 0; k < 3; k++) {
      char name[AMBULO__MOTION_MAX_NAME + 1];
      (void)snprintf(name, sizeof name, "grf.%s.%c", model->feet[f].name, axes[k]);
      int column = ambulo__motion_column(motion, name);
      if (column < 0) {
        if (!lacking) lacking = model->feet[f].name;
        continue;
      }
      a->has_grf = 1;
      copy_column(motion, column, 3 * model->foot_count, 3 * f + k, a->grf);
    }
  if (lacking) warn_of_forces(a, lacking, diagnostics);
}

static ambulo_status read_hands(ambulo_muscle_analysis *a, const ambulo__motion *motion,
                                ambulo_diagnostics *diagnostics) {
  const ambulo_inverse_options options = ambulo_inverse_options_default();
  ambulo__doubts doubts = {.diagnostics = diagnostics};
  const ambulo__load_source source = {.model = a->muscles->model,
                                      .file = a->motion,
                                      .table = motion,
                                      .options = &options,
                                      .times = a->times,
                                      .rows = motion->rows,
                                      .doubts = &doubts};
  if (!ambulo__has_hand_loads(motion)) return AMBULO_OK;
  ambulo_status status = ambulo__hand_load_read(&source, &a->allocator, &a->hands);
  a->holds = a->hands.loads;
  a->hold = a->hands.hold;
  a->hand_force = a->hands.force;
  return status;
}

ambulo_status ambulo__muscle_motion_read(ambulo_muscle_analysis *a,
                                         ambulo_diagnostics *diagnostics) {
  ambulo__motion *motion = NULL;
  ambulo_status status = ambulo__motion_read(a->motion, 0, &a->allocator, diagnostics, &motion);
  const ambulo__place place = {.file = a->motion};
  if (!status && motion->rows < 2)
    status = ambulo__error(diagnostics, AMBULO_E_SCHEMA, place, NULL,
                           "the table has one row; expected at least 2");
  if (!status && motion->in_degrees)
    status = ambulo__error(diagnostics, AMBULO_E_SCHEMA, place, NULL,
                           "angles are in degrees; expected a table of 'ambulo solve' or 'ambulo "
                           "inverse', in radians");
  if (!status) status = allocate(a, motion->rows);
  if (!status) {
    a->values.rows = motion->rows;
    memcpy(a->times, motion->time, (size_t)motion->rows * sizeof *a->times);
    status = read_coordinates(a, motion, diagnostics);
    if (!status) read_forces(a, motion, diagnostics);
    if (!status) status = read_hands(a, motion, diagnostics);
    ambulo__doubt_body(&(ambulo__doubts){.diagnostics = diagnostics}, a->motion, motion,
                       a->muscles->model);
  }
  ambulo__motion_free(motion);
  return status;
}

ambulo_status ambulo__muscle_motion_copy(ambulo_muscle_analysis *a, const ambulo__stride *s,
                                         ambulo_diagnostics *diagnostics) {
  const size_t all = (size_t)s->samples * (size_t)s->coordinates * sizeof *s->q;
  ambulo_status status = allocate(a, s->samples);
  if (status) return status;
  a->values.rows = s->samples;
  a->has_grf = s->feet > 0;
  memcpy(a->times, s->times, (size_t)s->samples * sizeof *s->times);
  memcpy(a->q, s->q, all);
  memcpy(a->qd, s->qd, all);
  memcpy(a->qdd, s->qdd, all);
  memcpy(a->tau, s->tau, all);
  if (a->has_grf) memcpy(a->grf, s->grf, 3 * (size_t)s->samples * (size_t)s->feet * sizeof *s->grf);
  a->holds = s->holds;
  a->hold = s->problem->definition.holds;
  a->hand_force = s->hold_force;
  if (!a->has_grf && a->muscles->model->foot_count > 0)
    warn_of_forces(a, a->muscles->model->feet[0].name, diagnostics);
  return AMBULO_OK;
}
