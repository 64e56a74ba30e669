/* tests/support/walker_result.h - the planar walker with a result that no solver made. */
#ifndef AMBULO_TESTS_WALKER_RESULT_H
#define AMBULO_TESTS_WALKER_RESULT_H

#include "solver/result.h"
#include "support/planar_walker.h"
#include "support/test.h"

typedef struct walk {
  ambulo_model *model;
  ambulo_problem *problem;
  ambulo_result *result;
} walk;

static inline void walk_open(walk *w, int intervals) {
  w->model = planar_walker_create();
  assert_non_null(w->model);
  w->problem = walker_problem(w->model, intervals);
  assert_non_null(w->problem);
  assert_int_equal(ambulo__result_create(w->problem, NULL, &w->result), AMBULO_OK);
  walker_point(w->problem, w->result->x);
  w->result->objective = w->result->term[0] = 0.1 + 0.2;
  w->result->audit.violation =
      (ambulo_violation){"foot_strike", "left_heel", "forward", "m", 0.25, 3e-7, 1.0};
  w->result->audit.dense_violation = w->result->audit.violation;
  w->result->audit.kkt = 0.0;
  w->result->verdict = AMBULO_FEASIBLE;
  snprintf(w->result->ending, sizeof w->result->ending, "made by \"hand\"\n");
}

static inline void walk_close(walk *w) {
  ambulo_result_free(w->result);
  ambulo_problem_free(w->problem);
  ambulo_model_free(w->model);
}

/* the whole file, to be freed */
static inline char *read_text(const char *path) {
  FILE *file = fopen(path, "rb");
  if (!file) print_error("%s does not exist\n", path);
  assert_non_null(file);
  fseek(file, 0, SEEK_END);
  size_t length = (size_t)ftell(file);
  rewind(file);
  char *text = malloc(length + 1);
  assert_non_null(text);
  assert_int_equal(fread(text, 1, length, file), length);
  text[length] = '\0';
  fclose(file);
  return text;
}

#endif
