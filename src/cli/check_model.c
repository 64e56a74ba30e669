/* cli/check_model.c - Jacobians of torques, root wrench and points against differences.
 *
 * At a few fixed poses each of q, qd, qdd is moved in one coordinate at a time; four-point
 * central differences (error h^4) give
 *
 *     df/du = (8 (f(h) - f(-h)) - (f(2h) - f(-2h))) / (12 h)
 *
 * and the error of an entry is its disagreement over max(1, largest entry of the Jacobian). */
#include "cli/check_model.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { POSES = 4, OUTPUTS = 3, INPUTS = 3 };

typedef struct tables {
  const ambulo_model *model;
  ambulo_mechanics *mechanics;
  int d, size[OUTPUTS];      /* numbers in tau, wrench, points */
  double *state[INPUTS];     /* q, qd, qdd [d] */
  double *value[4][OUTPUTS]; /* at the four moved states */
  double *jacobian[OUTPUTS][INPUTS];
  double error[OUTPUTS][INPUTS];
  int worst_row[OUTPUTS][INPUTS], worst_column[OUTPUTS][INPUTS];
} tables;

static int allocate(tables *t) {
  int failed = 0;
  size_t d = (size_t)t->d + 1;
  for (int i = 0; i < INPUTS; i++) failed |= !(t->state[i] = calloc(d, sizeof(double)));
  for (int o = 0; o < OUTPUTS; o++) {
    size_t size = (size_t)t->size[o] + 1;
    for (int k = 0; k < 4; k++) failed |= !(t->value[k][o] = calloc(size, sizeof(double)));
    for (int i = 0; i < INPUTS; i++)
      failed |= !(t->jacobian[o][i] = calloc(size * d, sizeof(double)));
  }
  return failed;
}

static void release(tables *t) {
  for (int i = 0; i < INPUTS; i++) free(t->state[i]);
  for (int o = 0; o < OUTPUTS; o++) {
    for (int k = 0; k < 4; k++) free(t->value[k][o]);
    for (int i = 0; i < INPUTS; i++) free(t->jacobian[o][i]);
  }
  ambulo_mechanics_free(t->mechanics);
}

static void compare(tables *t, int o, int i, int column, double step) {
  double scale = 1.0;
  size_t entries = (size_t)t->size[o] * (size_t)t->d;
  for (size_t e = 0; e < entries; e++) scale = fmax(scale, fabs(t->jacobian[o][i][e]));
  for (int r = 0; r < t->size[o]; r++) {
    double near = t->value[2][o][r] - t->value[1][o][r];
    double far = t->value[3][o][r] - t->value[0][o][r];
    double numeric = (8.0 * near - far) / (12.0 * step);
    double analytic = t->jacobian[o][i][(size_t)r * (size_t)t->d + (size_t)column];
    double error = fabs(analytic - numeric) / scale;
    if (isnan(t->error[o][i]) || error <= t->error[o][i]) continue; /* NaN is the worst */
    t->error[o][i] = error;
    t->worst_row[o][i] = r;
    t->worst_column[o][i] = column;
  }
}

static ambulo_status check_pose(tables *t) {
  const double step = 1e-3;
  ambulo_jacobians all = {sizeof all,        t->jacobian[0][0], t->jacobian[0][1],
                          t->jacobian[0][2], t->jacobian[1][0], t->jacobian[1][1],
                          t->jacobian[1][2], t->jacobian[2][0]};
  ambulo_status status =
      ambulo_mechanics_jacobians(t->mechanics, 1, t->state[0], t->state[1], t->state[2], &all);
  for (int i = 0; i < INPUTS && !status; i++) {
    for (int c = 0; c < t->d && !status; c++) {
      static const double moves[4] = {-2.0, -1.0, 1.0, 2.0};
      double kept = t->state[i][c];
      for (int k = 0; k < 4 && !status; k++) {
        t->state[i][c] = kept + moves[k] * step;
        status = ambulo_mechanics_inverse_dynamics(t->mechanics, 1, t->state[0], t->state[1],
                                                   t->state[2],
                                                   &(ambulo_outputs){.size = sizeof(ambulo_outputs),
                                                                     .tau = t->value[k][0],
                                                                     .wrench = t->value[k][1],
                                                                     .points = t->value[k][2]});
      }
      t->state[i][c] = kept;
      for (int o = 0; o < OUTPUTS && !status; o++) {
        if (o < 2 || i == 0) compare(t, o, i, c, step);
      }
    }
  }
  return status;
}

static int print_table(const tables *t, double tolerance) {
  static const char *const outputs[] = {"torque", "root wrench", "points"};
  static const char *const inputs[] = {"q", "qd", "qdd"};
  int wrong = 0;
  printf("  %-26s %-10s %s\n", "Jacobian", "error", "worst entry");
  for (int o = 0; o < OUTPUTS; o++) {
    for (int i = 0; i < (o < 2 ? INPUTS : 1); i++) {
      int bad = !(t->error[o][i] <= tolerance), row = t->worst_row[o][i];
      char label[64];
      snprintf(label, sizeof label, "%s by %s", outputs[o], inputs[i]);
      printf("  %-26s %-10.1e row %d", label, t->error[o][i], row);
      if (o == 0) printf(" (%s)", ambulo_model_coordinate(t->model, row)->name);
      if (o == 2 && t->size[2]) printf(" (%s)", ambulo_model_point(t->model, row / 3)->name);
      printf(", %s%s\n", ambulo_model_coordinate(t->model, t->worst_column[o][i])->name,
             bad ? "  WRONG" : "");
      wrong += bad;
    }
  }
  return wrong;
}

static ambulo_status check(tables *t) {
  ambulo_status status = ambulo_mechanics_create(t->model, NULL, &t->mechanics);
  for (int pose = 0; pose < POSES && !status; pose++) {
    for (int c = 0; c < t->d; c++) {
      double phase = 1.0 + 2.39996 * (double)(c + 31 * pose);
      t->state[0][c] = 0.8 * sin(phase);
      t->state[1][c] = 2.0 * sin(2.0 * phase);
      t->state[2][c] = 10.0 * sin(3.0 * phase);
    }
    status = check_pose(t);
  }
  return status;
}

ambulo_status ambulo__cli_check_model(const char *file, const ambulo_model *model, double tolerance,
                                      int *wrong) {
  tables t;
  memset(&t, 0, sizeof t);
  t.model = model;
  t.d = ambulo_model_coordinate_count(model);
  t.size[0] = t.d;
  t.size[1] = 6;
  t.size[2] = 3 * ambulo_model_point_count(model);
  int links = ambulo_model_link_count(model);
  printf("%s: model '%s', %d link%s, %d coordinate%s, %.3f kg\n", file, ambulo_model_name(model),
         links, links == 1 ? "" : "s", t.d, t.d == 1 ? "" : "s", ambulo_model_mass(model));
  ambulo_status status = allocate(&t) ? AMBULO_E_MEMORY : check(&t);
  if (!status) *wrong += print_table(&t, tolerance);
  release(&t);
  return status;
}

/* the lowest of the points that the feet stand on, and its height along up; -1: none */
static int lowest_point(const ambulo_model *model, const double *places, double *height) {
  const double *up = ambulo_model_up(model);
  int lowest = -1;
  for (int f = 0; f < ambulo_model_foot_count(model); f++) {
    const ambulo_foot *foot = ambulo_model_foot(model, f);
    const int points[4] = {foot->heel[0], foot->heel[1], foot->toe[0], foot->toe[1]};
    for (int k = 0; k < 4; k++) {
      if (points[k] < 0) continue;
      const double *p = places + 3 * points[k];
      double at = p[0] * up[0] + p[1] * up[1] + p[2] * up[2];
      if (lowest >= 0 && at >= *height) continue;
      lowest = points[k];
      *height = at;
    }
  }
  return lowest;
}

/* q[coordinates] of the start pose; 1 if that is not q = 0 */
static int start_pose(const ambulo_model *model, double *q) {
  int other = 0;
  for (int i = 0; i < ambulo_model_coordinate_count(model); i++) {
    q[i] = ambulo_model_coordinate(model, i)->default_value;
    other |= q[i] != 0.0;
  }
  return other;
}

ambulo_status ambulo__cli_check_standing(const ambulo_model *model, double ground) {
  static const double level = 1e-3; /* m */
  size_t d = (size_t)ambulo_model_coordinate_count(model);
  size_t points = (size_t)ambulo_model_point_count(model);
  double *q = calloc(d + 1, sizeof *q), *zero = calloc(d + 1, sizeof *zero);
  double *places = calloc(3 * points + 1, sizeof *places);
  double height = ground;
  ambulo_mechanics *mechanics = NULL;
  ambulo_status status =
      q && zero && places ? ambulo_mechanics_create(model, NULL, &mechanics) : AMBULO_E_MEMORY;
  int other = q && start_pose(model, q);
  if (!status)
    status = ambulo_mechanics_inverse_dynamics(
        mechanics, 1, q, zero, zero,
        &(ambulo_outputs){.size = sizeof(ambulo_outputs), .points = places});
  int lowest = status ? -1 : lowest_point(model, places, &height);
  if (lowest >= 0 && fabs(height - ground) > level)
    printf("  at %s the feet are off the ground: %s is %.3f m %s it, which a solve from %s has to "
           "make up\n",
           other ? "the start pose" : "q = 0", ambulo_model_point(model, lowest)->name,
           fabs(height - ground), height > ground ? "above" : "below", other ? "there" : "zero");
  ambulo_mechanics_free(mechanics);
  free(q);
  free(zero);
  free(places);
  return status;
}
