/* own_problem.c - a problem made in code: a pendulum from rest at 0 to rest at 1 rad, with a term
 * and a row of its own.
 *
 *     cc own_problem.c $(pkg-config --cflags --libs ambulo) -o own_problem
 *     ./own_problem
 *
 * The term is the square of the power, the row keeps the rod's tip below 1.3 m/s. */
#include <ambulo/ambulo.h>
#include <ambulo/tools/load.h>
#include <math.h>
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

/* a point of a link, and how fast it may be */
typedef struct watched {
  const ambulo_model *model;
  int link;
  double local[3], limit; /* link frame, m; m/s */
} watched;

/* limit^2 - v'v, m^2/s^2, v the velocity of the point */
static double below_speed(void *user, const ambulo_node_state *state,
                          ambulo_node_gradient *gradient) {
  const watched *w = user;
  double v[3], position_q[3], velocity_q[3]; /* of one coordinate; else [3][d] */
  ambulo_point_motion motion = ambulo_point_motion_default();
  motion.velocity = v;
  motion.position_q = position_q;
  motion.velocity_q = velocity_q;
  if (ambulo_model_point_motion(w->model, w->link, w->local, state->q, state->qd, &motion))
    return NAN;
  for (int r = 0; r < 3 && gradient; r++) {
    gradient->q[0] -= 2.0 * v[r] * velocity_q[r];
    gradient->qd[0] -= 2.0 * v[r] * position_q[r]; /* velocity is linear in qd */
  }
  return w->limit * w->limit - v[0] * v[0] - v[1] * v[1] - v[2] * v[2];
}

int main(void) {
  ambulo_model *model = NULL;
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  ambulo_status status = ambulo_model_load("models/pendulum.yaml", NULL, NULL, NULL, &model);

  int coordinates = 1;
  watched tip = {model, 0, {0.0, 0.0, 0.0}, 1.3}; /* the rod's frame stands at its tip */
  ambulo_term terms[2] = {ambulo_term_default(AMBULO_TORQUE_SQUARED),
                          ambulo_term_default(AMBULO_USER_TERM)};
  terms[1].name = "power squared";
  terms[1].weight = 0.01;
  terms[1].function = power_squared;
  terms[1].user = &coordinates;
  ambulo_user_row row = {"tip speed", "m^2/s^2", AMBULO_NOT_NEGATIVE, 0.0, 1.0, below_speed, &tip};
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
