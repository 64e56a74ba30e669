/* definitions/problem_solver.c - `solver:` of a problem file: options that ambulo_problem_options()
 * hands out and a caller may still change. */
#include "definitions/problem_reader.h"

static const double gigabyte = 1073741824.0;

/* on, off, true or false */
static int read_switch(const ambulo__yaml_node *node, int fallback) {
  static const char *const words[] = {"off", "on", "false", "true"};
  int choice = ambulo__yaml_choice(node, words, 4, -1);
  return choice < 0 ? fallback : choice % 2;
}

/* 0 in a file: none */
static double read_limit(const ambulo__yaml_node *node) {
  double limit = ambulo__yaml_number_in(node, 0.0, 1e9, 0.0);
  return limit > 0.0 ? limit : AMBULO_OFF;
}

void ambulo__read_solver(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  static const char *const algorithms[] = {"auto", "slsqp", "auglag"};
  static const char *const equalities[] = {"held", "nlopt"};
  ambulo_options *o = &reader->options;
  if (!section) return;
  int algorithm = ambulo__yaml_choice(ambulo__yaml_get(section, "algorithm"), algorithms, 3, 0);
  o->algorithm = (ambulo_algorithm)algorithm;
  int whose = ambulo__yaml_choice(ambulo__yaml_get(section, "equalities"), equalities, 2, 0);
  o->equalities = (ambulo_equalities)(AMBULO_EQUALITIES_HELD + whose);
  o->presolve = read_switch(ambulo__yaml_get(section, "presolve"), o->presolve);
  o->maximum_evaluations = ambulo__yaml_integer(ambulo__yaml_get(section, "maximum_evaluations"), 1,
                                                1000000000, o->maximum_evaluations);
  o->maximum_iterations = ambulo__yaml_integer(ambulo__yaml_get(section, "maximum_iterations"), 1,
                                               1000000000, o->maximum_iterations);
  o->time_limit = read_limit(ambulo__yaml_get(section, "time_limit"));
  o->maximum_memory = gigabyte * read_limit(ambulo__yaml_get(section, "maximum_memory"));
  o->feasibility_tolerance = ambulo__yaml_number_in(
      ambulo__yaml_get(section, "feasibility_tolerance"), 1e-14, 1.0, o->feasibility_tolerance);
  o->optimality_tolerance = ambulo__yaml_number_in(
      ambulo__yaml_get(section, "optimality_tolerance"), 1e-14, 1.0, o->optimality_tolerance);
  o->continuation = read_switch(ambulo__yaml_get(section, "continuation"), o->continuation);
  static const char *const grids[] = {"given", "auto"};
  o->refine = ambulo__yaml_choice(ambulo__yaml_get(section, "grid"), grids, 2, o->refine);
  o->starts =
      ambulo__yaml_integer(ambulo__yaml_get(section, "starts"), 1, AMBULO_MOST_STARTS, o->starts);
  o->dense_samples =
      ambulo__yaml_integer(ambulo__yaml_get(section, "dense_samples"), 1, 1000, o->dense_samples);
  ambulo__yaml_close(section);
}
