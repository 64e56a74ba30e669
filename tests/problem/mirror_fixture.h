/* Terms with room for every array on lower_body_18; what "alike" means is asked of the objective
 * itself: a motion and its mirror image cost the same. */
#ifndef AMBULO_TESTS_MIRROR_FIXTURE_H
#define AMBULO_TESTS_MIRROR_FIXTURE_H

#include "problem/term.h"

#include "ambulo/tools/tools.h"
#include "model/model.h"
#include "model/neutral_pose.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/test.h"

enum { D = 18, ROTATION = 5, HIP_R = 6, KNEE_R = 9, KNEE_L = 15, MOST_TERMS = 4 };

/* terms with room for every array, all neutral */
typedef struct fixture {
  ambulo_model *model;
  ambulo_term terms[MOST_TERMS];
  double scale[MOST_TERMS][D], offset[MOST_TERMS][D];
  double passive[MOST_TERMS][4 * D], strength[MOST_TERMS][6 * D];
  ambulo_problem_definition definition;
} fixture;

static inline void open_fixture(fixture *f, int count, ambulo_term_kind kind) {
  memset(f, 0, sizeof *f);
  assert_int_equal(ambulo_model_load("models/lower_body_18.yaml", NULL, NULL, NULL, &f->model),
                   AMBULO_OK);
  for (int t = 0; t < count; t++) {
    f->terms[t] = ambulo_term_default(kind);
    for (int i = 0; i < D; i++) f->scale[t][i] = 0.01;
    f->terms[t].scale = f->scale[t];
    f->terms[t].offset = f->offset[t];
    f->terms[t].passive = f->passive[t];
    f->terms[t].strength = f->strength[t];
  }
  f->definition = ambulo_problem_definition_default();
  f->definition.model = f->model;
  f->definition.terms = f->terms;
  f->definition.term_count = count;
  f->definition.ends = AMBULO_ENDS_MIRRORED;
}

/* cost of a made-up motion, less that of its mirror image, relative */
static inline double bias(const fixture *f) {
  ambulo_problem_definition d = f->definition;
  ambulo_problem *problem = NULL;
  ambulo_workspace *workspace = NULL;
  double cost[2];
  d.ends = AMBULO_ENDS_FREE;
  assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &problem), AMBULO_OK);
  assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
  int n = ambulo_problem_variable_count(problem);
  double *x = malloc((size_t)n * sizeof *x), *image = malloc((size_t)n * sizeof *image);
  for (int j = 0; j < n; j++) {
    const ambulo_coordinate *c = ambulo_model_coordinate(f->model, j % D);
    x[j] = 0.3 * sin(1.0 + 1.7 * j);
    image[j - j % D + c->mirror] = c->mirror_sign * x[j];
  }
  assert_int_equal(ambulo_problem_evaluate(problem, workspace, x, &cost[0], NULL, NULL), AMBULO_OK);
  assert_int_equal(ambulo_problem_evaluate(problem, workspace, image, &cost[1], NULL, NULL),
                   AMBULO_OK);
  free(x);
  free(image);
  ambulo_workspace_free(workspace);
  ambulo_problem_free(problem);
  return fabs(cost[0] - cost[1]) / fmax(fabs(cost[0]), 1e-300);
}

/* refused with `phrase`, or accepted (NULL), in agreement with the cost. Closes the fixture. */
static inline void expect(fixture *f, const char *phrase) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo__mirror_terms_check(&f->definition, NULL, list);
  if (phrase) {
    assert_message(list, 0, phrase);
    assert_message(list, 0, "hint: ends: {kind: periodic} predicts both sides");
    assert_true(bias(f) > 1e-9);
  } else {
    if (status) assert_message(list, 0, "nothing");
    assert_true(bias(f) < 1e-10);
  }
  assert_int_equal(status, phrase ? AMBULO_E_PROBLEM : AMBULO_OK);
  f->definition.ends = AMBULO_ENDS_PERIODIC;
  assert_int_equal(ambulo__mirror_terms_check(&f->definition, NULL, NULL), AMBULO_OK);
  ambulo_diagnostics_free(list);
  ambulo_model_free(f->model);
}

#endif
