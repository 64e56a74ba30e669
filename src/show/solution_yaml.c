/* show/solution_yaml.c - writing control points (docs/results.md has the keys). */
#include "show/solution_yaml.h"

#include "problem/nlp.h"

static void number_list(ambulo__text_buffer *text, const double *values, int count) {
  ambulo__text_append_char(text, '[');
  for (int i = 0; i < count; i++) {
    if (i) ambulo__text_append(text, ", ");
    ambulo__text_append_number(text, values[i]);
  }
  ambulo__text_append(text, "]\n");
}

static void trajectory(const ambulo__basis *basis, ambulo__text_buffer *text) {
  static const char *const words[] = {"bspline", "central_difference", "hermite"};
  ambulo__basis_kind kind = ambulo__basis_get_kind(basis);
  int intervals = ambulo__basis_intervals(basis);
  ambulo__text_append_format(text, "trajectory:\n  basis: %s\n", words[kind]);
  if (kind == AMBULO__BSPLINE)
    ambulo__text_append_format(text, "  degree: %d\n", ambulo__basis_degree(basis));
  ambulo__text_append_format(text, "  intervals: %d\n", intervals);
  if (kind != AMBULO__BSPLINE) return;
  ambulo__text_append(text, "  breakpoints: ");
  number_list(text, ambulo__basis_breakpoints(basis), intervals + 1);
}

void ambulo__solution_yaml(const ambulo_problem *problem, const ambulo_result *result,
                           ambulo__text_buffer *text) {
  const ambulo_model *model = problem->model;
  const double *x = ambulo_result_x(result);
  ambulo_verdict verdict = ambulo_result_verdict(result);
  ambulo__text_append_format(text, "# verdict: %s\n# SI units and radians\n",
                             ambulo_verdict_name(verdict));
  ambulo__text_append(text, "ambulo: 1\nkind: solution\nduration: ");
  ambulo__text_append_number(text, ambulo_problem_duration(problem));
  ambulo__text_append_char(text, '\n');
  trajectory(problem->basis, text);
  ambulo__text_append(text, "coordinates: [");
  for (int i = 0; i < model->coordinate_count; i++) {
    if (i) ambulo__text_append(text, ", ");
    ambulo__text_append(text, model->coordinates[i].name);
  }
  ambulo__text_append(text, "]\ncontrol_points:\n");
  for (int c = 0; c < problem->control_points; c++) {
    ambulo__text_append(text, "  - ");
    number_list(text, x + (size_t)c * (size_t)problem->coordinates, problem->coordinates);
  }
}
