/* The start pose is a motion at rest in every basis, and a solve begins there. */
#include "problem/problem.h"
#include "ambulo/tools/load.h"

#include "support/test.h"

/* a slider of 2 kg whose default is 0.75 m */
static const char text[] =
    "ambulo: 1\nkind: model\nname: m\nunits: {angle: radians}\nlinks:\n"
    "  - {name: a, parent: none, joint: prismatic, origin: {xyz: [0, 0, 0]}, axis: [1, 0, 0],\n"
    "     coordinate: {name: x, range: [-1, 1], default: 0.75},\n"
    "     body: {mass: 2, com: [0, 0, 0], gyration: [1, 1, 1]}}\n"
    "  - {name: b, parent: a, joint: revolute, origin: {xyz: [0, 0, 0]}, axis: [0, 0, 1],\n"
    "     coordinate: {name: q}, body: {mass: 2, com: [0, 0, 0], gyration: [1, 1, 1]}}\n";

static void at_rest(void **state) {
  (void)state;
  static const ambulo_discretization bases[] = {AMBULO_BSPLINE, AMBULO_CENTRAL_DIFFERENCE,
                                                AMBULO_HERMITE};
  ambulo_model *model = NULL;
  assert_int_equal(ambulo_model_load_text(text, sizeof text - 1, "m", NULL, NULL, NULL, &model),
                   AMBULO_OK);
  assert_close(ambulo_model_coordinate(model, 0)->default_value, 0.75, 0);
  for (int b = 0; b < 3; b++) {
    ambulo_term term = ambulo_term_default(AMBULO_ACCELERATION);
    ambulo_problem_definition d = ambulo_problem_definition_default();
    ambulo_problem *problem = NULL;
    ambulo_result *result = NULL;
    d.model = model;
    d.discretization = bases[b];
    d.duration = 1.0;
    d.intervals = 48; /* coarser grids come first */
    d.terms = &term;
    d.term_count = 1;
    assert_int_equal(ambulo_problem_create(&d, NULL, NULL, &problem), AMBULO_OK);
    /* nothing asks for another motion: a solve ends where it began */
    assert_int_equal(ambulo_solve(problem, NULL, NULL, NULL, NULL, &result), AMBULO_OK);
    const double *x = ambulo_result_x(result);
    for (int k = 0; k <= 24; k++) {
      ambulo__basis_point at;
      double q[3][2] = {{0}};
      ambulo__basis_at(problem->basis, k / 24.0, &at);
      for (int o = 0; o < 3; o++)
        for (int s = 0; s < at.span; s++)
          for (int i = 0; i < 2; i++) q[o][i] += at.weight[o][s] * x[(at.first + s) * 2 + i];
      assert_close(q[0][0], 0.75, 1e-12);
      assert_close(q[0][1], 0.0, 1e-12);
      for (int o = 1; o < 3; o++) assert_close(q[o][0], 0.0, 1e-9);
    }
    ambulo_result_free(result);
    ambulo_problem_free(problem);
  }
  ambulo_model_free(model);
}

static void out_of_range(void **state) {
  (void)state;
  ambulo_model *model = NULL;
  char other[sizeof text];
  memcpy(other, text, sizeof text);
  memcpy(strstr(other, "0.75"), "1.75", 4);
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  assert_int_equal(ambulo_model_load_text(other, sizeof text - 1, "m", NULL, NULL, list, &model),
                   AMBULO_E_MODEL);
  char said[300];
  ambulo_diagnostics_format(list, 0, said, sizeof said);
  assert_non_null(strstr(
      said, "the default of coordinate 'x' is out of its range (got 1.75); expected -1 to 1"));
  ambulo_diagnostics_free(list);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(at_rest), cmocka_unit_test(out_of_range)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
