/* tests/support/moved_problem.h - a problem file with one number changed, and its Lagrangian.
 *
 * The name of a sensitivity is the path of an override; values are written in the file's units. */
#ifndef AMBULO_TESTS_MOVED_PROBLEM_H
#define AMBULO_TESTS_MOVED_PROBLEM_H

#include "model/model.h"
#include "ambulo/tools/load.h"
#include "problem/nlp.h"
#include "support/test.h"

enum { MOST_WITH = 6 };

/* ... where the file is written for another body; NAN: of terms, whose units are many */
static inline double size_in_file(const ambulo_problem *problem, const ambulo_sensitivity *s) {
  const ambulo__problem_keys *keys = &problem->keys;
  int of_task = strncmp(s->name, "gait.step_l", 11) == 0 || strstr(s->name, "ground_height") ||
                strcmp(s->name, "subject.stature") == 0 || strncmp(s->name, "ends.", 5) == 0 ||
                strstr(s->name, "tubes");
  if (!keys->written_for) return 1.0;
  if (strncmp(s->name, "objective[", 10) == 0) return (double)NAN;
  if (strcmp(s->unit, "body weights/s") == 0) return 1.0 / sqrt(keys->longer);
  return strcmp(s->unit, "m") == 0 && !of_task ? keys->longer : 1.0;
}

/* SI units and radians per unit of the file */
static inline double unit_in_file(const ambulo_problem *problem, const ambulo_sensitivity *s) {
  static const char *const cosines[] = {"constraints.orientation_tolerance",
                                        "constraints.clearance.turn"};
  const ambulo__model_units *units = &problem->model->units;
  int of_model = strncmp(s->name, "model.", 6) == 0;
  int turns = strncmp(s->unit, "rad", 3) == 0;
  for (int i = 0; i < 2; i++)
    if (strcmp(s->name, cosines[i]) == 0) return 1.0;
  if (!of_model)
    return size_in_file(problem, s) *
           (turns && problem->keys.radians > 0.0 ? problem->keys.radians : 1.0);
  if (turns) return units->angle;
  /* drives of hinges */
  if (strstr(s->name, "armature")) return units->mass * units->length * units->length;
  if (strstr(s->name, "damping") || strstr(s->name, "friction")) return units->moment;
  if (strcmp(s->unit, "N m") == 0) return units->moment;
  if (strcmp(s->unit, "N") == 0) return units->force;
  return units->length;
}

/* `base` (may be NULL) are overrides that stay; NULL when the problem is refused */
static inline ambulo_problem *moved_problem(const char *path, const char *const *base, int count,
                                            const ambulo_problem *problem,
                                            const ambulo_sensitivity *s, double by) {
  char text[400], with[MOST_WITH][400];
  const char *overrides[20 + MOST_WITH], *names = s->with;
  ambulo_problem *moved = NULL;
  double unit = unit_in_file(problem, s), value = s->value + by;
  (void)snprintf(text, sizeof text, "%s=%.17g", s->name, value / unit);
  for (int i = 0; i < count; i++) overrides[i] = base[i];
  overrides[count++] = text;
  for (int k = 0; *names; k++) { /* "a, b" */
    int length = (int)strcspn(names, ",");
    assert_true(k < MOST_WITH);
    (void)snprintf(with[k], sizeof with[k], "%.*s=%.17g", length, names,
                   s->with_sign * value / unit);
    overrides[count++] = with[k];
    names += length;
    names += strspn(names, ", ");
  }
  (void)!ambulo_problem_load(path, overrides, count, NULL, NULL, &moved);
  return moved;
}

/* f - sum lambda c at x; NAN when the problem has other rows. The sum carries what rounding drops
 * (Neumaier): multipliers are random, so that the rows cancel and the sum is far smaller than they.
 */
static inline double lagrangian_at(const ambulo_problem *problem, const double *x,
                                   const double *multiplier, int rows) {
  ambulo_workspace *workspace = NULL;
  double value = NAN, *row = calloc((size_t)rows + 1, sizeof *row);
  if (ambulo_problem_row_count(problem) == rows) {
    assert_int_equal(ambulo_workspace_create(problem, NULL, &workspace), AMBULO_OK);
    assert_int_equal(ambulo_problem_evaluate(problem, workspace, x, &value, NULL, row), AMBULO_OK);
    double dropped = 0.0;
    for (int r = 0; r < rows; r++) {
      double next = -multiplier[r] * row[r], sum = value + next;
      dropped += fabs(value) >= fabs(next) ? (value - sum) + next : (next - sum) + value;
      value = sum;
    }
    value += dropped;
  }
  ambulo_workspace_free(workspace);
  free(row);
  return value;
}

#endif
