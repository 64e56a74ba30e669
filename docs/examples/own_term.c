/* own_term.c - a term and a row of your own on a walk of a file.
 *
 *     cc own_term.c $(pkg-config --cflags --libs ambulo) -o own_term
 *     ./own_term models/walk_normal.yaml
 *
 * The term prices the knees' power, (tau qd)^2; the row keeps the head above a height that the walk
 * would rather leave. Both are compared with differences before anything is solved. */
#include <ambulo/tools/tools.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct walker {
  int knee[2], head, up; /* coordinates, a point, the axis that points up */
  double height;         /* m */
} walker;

static double knee_power(void *user, const ambulo_node_state *state,
                         ambulo_node_gradient *gradient) {
  const walker *w = user;
  double sum = 0.0;
  for (int side = 0; side < 2; side++) {
    int i = w->knee[side];
    double power = state->tau[i] * state->qd[i];
    sum += power * power;
    if (!gradient) continue;
    gradient->tau[i] += 2.0 * power * state->qd[i];
    gradient->qd[i] += 2.0 * power * state->tau[i];
  }
  return sum;
}

/* m above the height, >= 0 */
static double head_above(void *user, const ambulo_node_state *state,
                         ambulo_node_gradient *gradient) {
  const walker *w = user;
  if (gradient) gradient->points[3 * w->head + w->up] += 1.0;
  return state->points[3 * w->head + w->up] - w->height;
}

static ambulo_status extend(const ambulo_problem *base, walker *w, ambulo_diagnostics *messages,
                            ambulo_problem **extended) {
  ambulo_term term = ambulo_term_default(AMBULO_USER_TERM);
  term.name = "knee power";
  term.weight = 1e-6; /* per W^2 s */
  term.function = knee_power;
  term.user = w;
  ambulo_user_row row = ambulo_user_row_default(); /* >= 0 at every node */
  row.name = "head height";
  row.unit = "m";
  row.function = head_above;
  row.user = w;
  ambulo_extension extension = ambulo_extension_default();
  extension.terms = &term;
  extension.term_count = 1;
  extension.user_rows = &row;
  extension.user_row_count = 1;
  return ambulo_problem_extend(base, &extension, NULL, messages, extended);
}

/* largest disagreement of the gradients with differences, of the two functions */
static ambulo_status check(const ambulo_problem *problem) {
  ambulo_workspace *workspace = NULL;
  ambulo_derivative_error errors[100];
  int count = 0, n = ambulo_problem_variable_count(problem);
  double *x = calloc((size_t)n, sizeof *x);
  ambulo_status status = x ? ambulo_workspace_create(problem, NULL, &workspace) : AMBULO_E_MEMORY;
  for (int i = 0; !status && i < n; i++) x[i] = 0.1 * (i % 7 - 3);
  if (!status)
    status = ambulo_problem_check_derivatives(problem, workspace, x, 0.0, errors, 100, &count);
  for (int i = 0; i < count; i++)
    if (errors[i].family[0] == 'k' || errors[i].family[0] == 'h')
      printf("gradient of %s: error %.0e\n", errors[i].family, errors[i].error);
  ambulo_workspace_free(workspace);
  free(x);
  return status;
}

/* lowest head (m) and largest power of the knees (W) at the nodes */
static ambulo_status show(const ambulo_problem *problem, const walker *w, const char *name,
                          ambulo_diagnostics *messages) {
  ambulo_workspace *workspace = NULL;
  ambulo_result *result = NULL;
  double q[200], qd[200], tau[200], points[600], least = 1e9, most = 0.0;
  ambulo_motion motion = ambulo_motion_default();
  motion.q = q;
  motion.qd = qd;
  motion.tau = tau;
  motion.points = points;
  ambulo_status status = ambulo_workspace_create(problem, NULL, &workspace);
  if (!status) status = ambulo_solve(problem, NULL, NULL, NULL, messages, &result);
  for (int k = 0; !status && k < ambulo_problem_node_count(problem); k++) {
    double time = ambulo_problem_node_time(problem, k);
    status = ambulo_problem_motion(problem, workspace, ambulo_result_x(result), 1, &time, &motion);
    double head = points[3 * w->head + w->up];
    if (head < least) least = head;
    for (int side = 0; side < 2; side++) {
      double power = tau[w->knee[side]] * qd[w->knee[side]];
      if (power * power > most * most) most = power < 0.0 ? -power : power;
    }
  }
  if (!status)
    printf("%-8s %s: head at least %.4f m, knees at most %.1f W\n", name,
           ambulo_verdict_name(ambulo_result_verdict(result)), least, most);
  ambulo_result_free(result);
  ambulo_workspace_free(workspace);
  return status;
}

int main(int argc, char **argv) {
  ambulo_diagnostics *messages = ambulo_diagnostics_create(NULL);
  ambulo_problem *base = NULL, *extended = NULL;
  ambulo_status status = ambulo_problem_load(argc > 1 ? argv[1] : "models/walk_normal.yaml", NULL,
                                             0, NULL, messages, &base);
  if (!status) {
    const ambulo_model *model = ambulo_problem_model(base);
    walker w = {{ambulo_model_find_coordinate(model, "knee_angle_r"),
                 ambulo_model_find_coordinate(model, "knee_angle_l")},
                ambulo_model_find_point(model, "head_top"),
                1,
                1.755};
    status = extend(base, &w, messages, &extended);
    if (!status) status = check(extended);
    if (!status) status = show(base, &w, "before", messages);
    if (!status) status = show(extended, &w, "after", messages);
  }
  for (size_t i = 0; status && i < ambulo_diagnostics_count(messages); i++)
    fprintf(stderr, "%s\n", ambulo_diagnostics_get(messages, i)->message);
  ambulo_problem_free(extended); /* before what it extends */
  ambulo_problem_free(base);
  ambulo_diagnostics_free(messages);
  return ambulo_status_exit_code(status);
}
