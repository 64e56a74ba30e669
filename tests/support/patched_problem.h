/* tests/support/patched_problem.h - problems of the walker with hands and a seat
 * (support/patched_walker.h), and motions of them. */
#ifndef AMBULO_TESTS_PATCHED_PROBLEM_H
#define AMBULO_TESTS_PATCHED_PROBLEM_H

#include "ambulo/ambulo.h"
#include "support/messages.h"
#include "support/patched_walker.h"

static const double weight = 72.0 * 9.81;

static inline ambulo_problem_definition definition_of(const ambulo_model *model,
                                                      const ambulo_contact *contacts, int count) {
  ambulo_problem_definition d = ambulo_problem_definition_default();
  d.model = model;
  d.contacts = contacts;
  d.contact_count = count;
  d.intervals = 8;
  d.ground_reaction.kind = AMBULO_REACTION_SHARED;
  d.contact_tolerance = 0.002;
  return d;
}

static inline ambulo_problem *create(const ambulo_problem_definition *d) {
  ambulo_problem *problem = NULL;
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_problem_create(d, NULL, list, &problem);
  if (status) assert_message(list, 0, "no message");
  ambulo_diagnostics_free(list);
  assert_int_equal(status, AMBULO_OK);
  return problem;
}

/* a problem at a point whose control points are waves, and what reads motions of it */
typedef struct posed {
  ambulo_problem *problem;
  ambulo_workspace *workspace;
  double *x;
} posed;

static inline posed pose(const ambulo_problem_definition *d, double size, double rate) {
  posed p = {.problem = create(d)};
  int n = ambulo_problem_variable_count(p.problem), q = ambulo_model_coordinate_count(d->model);
  assert_int_equal(ambulo_workspace_create(p.problem, NULL, &p.workspace), AMBULO_OK);
  p.x = calloc((size_t)n, sizeof *p.x);
  for (int i = 0; i < n; i++) p.x[i] = size * sin(rate * (i / q) + 1.3 * (i % q));
  return p;
}

static inline void read_motion(const posed *p, int count, const double *times,
                               ambulo_motion *motion) {
  assert_int_equal(ambulo_problem_motion(p->problem, p->workspace, p->x, count, times, motion),
                   AMBULO_OK);
}

static inline void unpose(posed *p) {
  free(p->x);
  ambulo_workspace_free(p->workspace);
  ambulo_problem_free(p->problem);
}

/* both feet flat, and a hand on something from 0.2 to 0.8 s */
static const ambulo_contact feet_and_hand[] = {
    {WALKER_RIGHT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {-0.05, -0.09}},
    {WALKER_LEFT, AMBULO_CONTACT_FLAT, 0.0, 1.0, .place = {-0.05, 0.09}},
    OF_PATCH(HAND_R, 0.2, 0.8, {0.4, -0.25, 1.22})};

#endif
