/* own_problem.c - a problem made in code: a pendulum from rest at 0 to rest at 1 rad, with a term
 * and a row of its own.
 *
 *     cc own_problem.c $(pkg-config --cflags --libs ambulo) -o own_problem
 *     ./own_problem
 *
 * The term is the square of the power, the row keeps the swing below 1.3 rad/s. */
#include <ambulo/ambulo.h>
#include <ambulo/tools/load.h>
#include <stdio.h>

/* power squared, summed over the coordinates: (tau qd)^2 */
static double power_squared(void *user, const ambulo_node_state *state,
                            ambulo_node_gradient *gradient) {
  int d = *(const int *)user;
  double sum = 0.0;
  for (int i = 0; i < d; i++) {
    double power = state->tau[i] * state->qd[i];
    sum += power * power;
    if (gradient) {
      gradient->tau[i] += 2.0 * power * state->qd[i];
      gradient->qd[i] += 2.0 * power * state->tau[i];
    }
  }
  return sum;
}

/* no faster than the caller's limit, rad/s */
static double below_speed(void *user, const ambulo_node_state *state,
                          ambulo_node_gradient *gradient) {
  if (gradient) gradient->qd[0] -= 1.0;
  return *(const double *)user - state->qd[0];
}

int main(void) {
  ambulo_model *model = NULL;
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  ambulo_status status = ambulo_model_load("models/pendulum.yaml", NULL, NULL, NULL, &model);

  int coordinates = 1;
  double fastest = 1.3;
  ambulo_term terms[2] = {ambulo_term_default(AMBULO_TORQUE_SQUARED),
                          ambulo_term_default(AMBULO_USER_TERM)};
  terms[1].name = "power squared";
  terms[1].weight = 0.01;
  terms[1].function = power_squared;
  terms[1].user = &coordinates;
  ambulo_user_row row = {"speed", "rad/s", AMBULO_NOT_NEGATIVE, 0.0, 1.0, below_speed, &fastest};
  /* from rest at 0 to rest at 1 rad */
  ambulo_end_value ends[4] = {{0, 0, 0, 0.0}, {0, 1, 0, 0.0}, {0, 0, 1, 1.0}, {0, 1, 1, 0.0}};

  ambulo_problem_definition definition = ambulo_problem_definition_default();
  definition.name = "swing";
  definition.model = model;
  definition.terms = terms;
  definition.term_count = 2;
  definition.user_rows = &row;
  definition.user_row_count = 1;
  definition.end_values = ends;
  definition.end_value_count = 4;
  if (!status) status = ambulo_problem_create(&definition, NULL, NULL, &problem);

  ambulo_options options = ambulo_options_default();
  if (!status) status = ambulo_solve(problem, &options, NULL, NULL, NULL, &result);
  if (!status)
    printf("%s: %.4f of which %.4f power squared\n",
           ambulo_verdict_name(ambulo_result_verdict(result)), ambulo_result_objective(result),
           ambulo_result_terms(result)[1]);
  ambulo_result_free(result);
  ambulo_problem_free(problem);
  ambulo_model_free(model);
  return ambulo_status_exit_code(status);
}
