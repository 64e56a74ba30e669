/* tests/support/walker_solution.h - the solution.yaml of the planar walker's result. */
#ifndef AMBULO_TESTS_WALKER_SOLUTION_H
#define AMBULO_TESTS_WALKER_SOLUTION_H

#include "show/report.h"
#include "support/scratch.h"
#include "support/walker_result.h"

static inline const char *write_solution(void **state, const walk *w) {
  ambulo__text_buffer text;
  ambulo__text_init(&text, NULL);
  ambulo__solution_yaml(w->problem, w->result, &text);
  const char *path = scratch_path(state, "solution.yaml");
  scratch_write(path, ambulo__text_data(&text));
  ambulo__text_free(&text);
  return path;
}

#endif
