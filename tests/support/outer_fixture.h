/* tests/support/outer_fixture.h - runs over free parameters. */
#ifndef AMBULO_TESTS_OUTER_FIXTURE_H
#define AMBULO_TESTS_OUTER_FIXTURE_H

#include "ambulo/tools/tools.h"
#include "support/fail_alloc.h"
#include "support/messages.h"
#include "support/test.h"

#include <stdio.h>
#include <string.h>

#define PLANAR "tests/support/walker_2d_step.yaml"
#define REACH "tests/support/two_link_reach.yaml"

#define AT_A_SPEED                                                                                 \
  "time.duration=null", "gait.step_length=null", "gait.speed=1.26", "gait.step_time=0.54"

typedef struct solved {
  ambulo_problem *problem, *best;
  ambulo_result *result;
  const ambulo_parameters_outcome *outcome;
} solved;

static inline ambulo_problem *load(const char *file, const char *const *overrides, int count) {
  ambulo_problem *problem = NULL;
  assert_int_equal(ambulo_problem_load(file, overrides, count, NULL, NULL, &problem), AMBULO_OK);
  return problem;
}

static inline solved solve(const char *file, const char *const *overrides, int count,
                           const ambulo_options *options) {
  solved s = {.problem = load(file, overrides, count)};
  assert_int_equal(
      ambulo_solve_parameters(s.problem, NULL, options, NULL, NULL, &s.best, &s.result), AMBULO_OK);
  s.outcome = ambulo_result_parameters(s.result);
  assert_non_null(s.outcome);
  return s;
}

static inline void release(solved *s) {
  ambulo_result_free(s->result);
  ambulo_problem_free(s->best);
  ambulo_problem_free(s->problem);
}

#endif
