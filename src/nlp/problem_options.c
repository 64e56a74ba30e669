/* nlp/problem_options.c - what the problem file asks of the solver. */
#include "nlp/nlp.h"

ambulo_options ambulo_problem_options(const ambulo_problem *problem) {
  return problem->file_options;
}
