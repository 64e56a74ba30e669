/* tests/people/walk_muscles.h - the muscles of models/walk.yaml, solved once for all tests of a
 * program, and its table with something changed. */
#ifndef TESTS_PEOPLE_WALK_MUSCLES_H
#define TESTS_PEOPLE_WALK_MUSCLES_H

#include "ambulo/tools/tools.h"
#include "formats/motion_file.h"
#include "support/messages.h"
#include "support/scratch.h"

typedef struct walk_muscles {
  void *scratch;
  ambulo_problem *problem;
  ambulo_result *result;
  const ambulo_model *model;
  ambulo_muscles *muscles;
  ambulo__motion *table;
  char path[SCRATCH_PATH + 64], other[SCRATCH_PATH + 64]; /* the table; what a test writes */
} walk_muscles;

/* cmocka setup and teardown of a group */
static inline int open_walk_muscles(void **state) {
  static walk_muscles w;
  char folder[SCRATCH_PATH + 16];
  if (scratch_open(&w.scratch)) return -1;
  (void)snprintf(folder, sizeof folder, "%s/walk", (char *)w.scratch);
  (void)snprintf(w.path, sizeof w.path, "%s/motion.csv", folder);
  (void)snprintf(w.other, sizeof w.other, "%s/other.csv", (char *)w.scratch);
  ambulo_report_options report = ambulo_report_options_default();
  if (ambulo_problem_load("models/walk.yaml", NULL, 0, NULL, NULL, &w.problem) ||
      ambulo_solve(w.problem, NULL, NULL, NULL, NULL, &w.result) ||
      ambulo_report_write(w.problem, w.result, folder, &report, NULL, NULL) ||
      ambulo__motion_read(w.path, 0, NULL, NULL, &w.table))
    return -1;
  w.model = ambulo_problem_model(w.problem);
  *state = &w;
  return ambulo_muscles_load("models/leg_muscles.yaml", w.model, NULL, NULL, &w.muscles) ? -1 : 0;
}

static inline int close_walk_muscles(void **state) {
  walk_muscles *w = *state;
  ambulo__motion_free(w->table);
  ambulo_muscles_free(w->muscles);
  ambulo_result_free(w->result);
  ambulo_problem_free(w->problem);
  return scratch_close(&w->scratch);
}

static inline double *cell_of(const walk_muscles *w, int row, const char *prefix,
                              const char *coordinate) {
  char name[100];
  (void)snprintf(name, sizeof name, "%s.%s", prefix, coordinate);
  int column = ambulo__motion_column(w->table, name);
  assert_true(column >= 0);
  return &w->table->values[row * w->table->columns + column];
}

/* The first rows of the table, without the column `left_out` (NULL: with all), below a comment. */
static inline void write_table(const walk_muscles *w, const char *comment, int rows,
                               const char *left_out) {
  FILE *file = fopen(w->other, "w");
  assert_non_null(file);
  fprintf(file, "# %s\ntime", comment);
  for (int c = 0; c < w->table->columns; c++)
    if (!left_out || strcmp(w->table->names[c], left_out) != 0)
      fprintf(file, ",%s", w->table->names[c]);
  for (int k = 0; k < rows; k++) {
    fprintf(file, "\n%.17g", w->table->time[k]);
    for (int c = 0; c < w->table->columns; c++)
      if (!left_out || strcmp(w->table->names[c], left_out) != 0)
        fprintf(file, ",%.17g", w->table->values[k * w->table->columns + c]);
  }
  fprintf(file, "\n");
  assert_int_equal(fclose(file), 0);
}

static inline ambulo_muscle_analysis *analysis_of(const walk_muscles *w, const char *path,
                                                  const ambulo_muscle_options *options) {
  ambulo_muscle_analysis *a = NULL;
  assert_int_equal(ambulo_muscle_analysis_create(w->muscles, path, options, NULL, NULL, &a),
                   AMBULO_OK);
  return a;
}

#endif
