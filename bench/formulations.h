/* bench/formulations.h - one problem by three formulations (Table 1 of the source paper).
 *
 * Terms and rows of a problem at its nodes t_0 .. t_N are functions of the states s_k = (q, v,
 * a)_k, [3][d], and ambulo evaluates them. To have them at any states, the problem is built once
 * more with a cubic spline of 4 N intervals: then each node has three control points of its own,
 * P_k = B_k^-1 s_k, and a gradient by control points is one by states, g_s = B_k^-T g_P.
 *
 * Forward dynamics, of the inverse dynamics tau = M(q) a + h(q, v) and its Jacobians:
 *
 *     a = M^-1 (tau - h)                                                                (a)
 *     a_tau = M^-1,  a_q = -M^-1 tau_q,  a_v = -M^-1 tau_v   at (q, v, a)               (b)
 *
 * since tau_q dq + tau_v dv + M da = dtau. With y = (q, v), F(y, tau) = (v, a), A = F_y, B = F_tau:
 *
 * State elimination. Unknowns: y_0, tau_0 .. tau_N, linear between nodes. y_k by the Runge-Kutta
 * method of order 4, one step an interval; S_k = dy_k/dx by the same rule on S' = A S + B T, T =
 * dtau/dx.
 *
 * Direct collocation (Hermite-Simpson). Unknowns: y_k, tau_k. Defects, per interval of length h:
 *
 *     y_m = (y_k + y_k+1) / 2 + h (F_k - F_k+1) / 8,  tau_m = (tau_k + tau_k+1) / 2
 *     D = y_k+1 - y_k - h (F_k + 4 F_m + F_k+1) / 6 = 0
 *     D_yk   = -I - h (A_k + 4 A_m (I / 2 + h A_k / 8)) / 6
 *     D_yk+1 =  I - h (A_k+1 + 4 A_m (I / 2 - h A_k+1 / 8)) / 6
 *     D_tk   = -h (B_k + 4 (A_m h B_k / 8 + B_m / 2)) / 6
 *     D_tk+1 = -h (B_k+1 + 4 (-A_m h B_k+1 / 8 + B_m / 2)) / 6
 *
 * Differential inclusion: ambulo's own, control points of q alone.
 *
 * Limits of joints are bounds of collocation's unknowns, limits of torques of both; rows elsewhere.
 * Unknowns are divided by what is large: 1 rad or m, 5 rad/s, the torque that the model can. */
#ifndef AMBULO_BENCH_FORMULATIONS_H
#define AMBULO_BENCH_FORMULATIONS_H

#include "bench.h"

enum { most_dofs = 9, most_states = 2 * most_dofs };
typedef enum formulation_kind {
  ELIMINATION,
  COLLOCATION,
  INCLUSION,
  formulations
} formulation_kind;

typedef struct formulation {
  formulation_kind kind;
  ambulo_problem *problem; /* of INCLUSION as it is, else with 4 N intervals */
  ambulo_workspace *workspace;
  ambulo_mechanics *mechanics;
  int d, nodes, unknowns, equalities, inequalities;
  int rows, *row;         /* [rows] of the problem's rows, those that are kept */
  int torque_limits;      /* 1: the problem has rows of them */
  int control_points;     /* of the problem */
  double h;               /* s */
  double *scale;          /* [unknowns] */
  double *lower, *upper;  /* [unknowns] of scaled unknowns */
  int *window;            /* [nodes][3] control points */
  double *basis;          /* [nodes][3][3] states of control points */
  double *inverse;        /* [nodes][3][3] */
  double *state;          /* [nodes][3][d] */
  double *control;        /* [nodes][d] */
  double *big, *gradient; /* [control_points * d] */
  double *A, *B,
      *F;      /* [nodes + 1] of nodes, the last of a point between: [2d][2d], [2d][d], [2d] */
  double *S;   /* [nodes][2d][unknowns] of ELIMINATION */
  double *K;   /* [5][2d][unknowns] */
  double *all; /* [problem's rows] */
  /* filled by formulation_evaluate: objective, rows c (equal to 0 first, then >= 0), Jacobian dense
   */
  double objective, *slope, *c, *jacobian;
  int finite;
  long evaluations;
} formulation;

static inline void *bench_array(size_t count, size_t size) {
  void *array = calloc(count ? count : 1, size);
  if (!array) exit(1);
  return array;
}

/* ----------------------------------------------------------- forward dynamics */

/* X = M^-1 X of count right-hand sides, [d][count]; M is destroyed */
static inline void solve_dense(int d, double *M, double *X, int count) {
  for (int c = 0; c < d; c++) {
    int pivot = c;
    for (int r = c + 1; r < d; r++)
      if (fabs(M[r * d + c]) > fabs(M[pivot * d + c])) pivot = r;
    for (int k = 0; k < d && pivot != c; k++) {
      double t = M[c * d + k];
      M[c * d + k] = M[pivot * d + k];
      M[pivot * d + k] = t;
    }
    for (int k = 0; k < count && pivot != c; k++) {
      double t = X[c * count + k];
      X[c * count + k] = X[pivot * count + k];
      X[pivot * count + k] = t;
    }
    for (int r = 0; r < d; r++) {
      double f = r == c ? 0.0 : M[r * d + c] / M[c * d + c];
      for (int k = c; k < d && f != 0.0; k++) M[r * d + k] -= f * M[c * d + k];
      for (int k = 0; k < count && f != 0.0; k++) X[r * count + k] -= f * X[c * count + k];
    }
  }
  for (int r = 0; r < d; r++)
    for (int k = 0; k < count; k++) X[r * count + k] /= M[r * d + r];
}

/* eqs. (a), (b): F [2d], A [2d][2d], B [2d][d] at y = (q, v) and tau. Returns 0 where not finite.
 */
static inline int forward(formulation *f, const double *y, const double *tau, double *F, double *A,
                          double *B) {
  int d = f->d, two = 2 * d;
  double zero[most_dofs] = {0.0}, h[most_dofs], M[most_dofs * most_dofs], N[most_dofs * most_dofs];
  double tq[most_dofs * most_dofs], tv[most_dofs * most_dofs], X[most_dofs * 3 * most_dofs];
  ambulo_jacobians mass = {.size = sizeof(ambulo_jacobians), .tau_qdd = M},
                   rest = {.tau_q = tq, .tau_qd = tv};
  if (ambulo_mechanics_inverse_dynamics(
          f->mechanics, 1, y, y + d, zero,
          &(ambulo_outputs){.size = sizeof(ambulo_outputs), .tau = h}) ||
      ambulo_mechanics_jacobians(f->mechanics, 1, y, y + d, zero, &mass))
    return 0;
  memcpy(N, M, sizeof M);
  for (int i = 0; i < d; i++) {
    F[i] = y[d + i];
    F[d + i] = tau[i] - h[i];
  }
  solve_dense(d, N, F + d, 1);
  if (ambulo_mechanics_jacobians(f->mechanics, 1, y, y + d, F + d, &rest)) return 0;
  for (int r = 0; r < d; r++)
    for (int k = 0; k < d; k++) {
      X[r * 3 * d + k] = -tq[r * d + k];
      X[r * 3 * d + d + k] = -tv[r * d + k];
      X[r * 3 * d + two + k] = r == k;
    }
  solve_dense(d, M, X, 3 * d);
  memset(A, 0, (size_t)(two * two) * sizeof *A);
  memset(B, 0, (size_t)(two * d) * sizeof *B);
  for (int r = 0; r < d; r++) {
    A[r * two + d + r] = 1.0;
    memcpy(A + (d + r) * two, X + r * 3 * d, (size_t)two * sizeof *A);
    memcpy(B + (d + r) * d, X + r * 3 * d + two, (size_t)d * sizeof *B);
  }
  return 1;
}

/* ------------------------------------------------------- terms and rows by states */

/* states of all nodes to control points, each node having three of its own */
static inline void states_to_points(formulation *f) {
  for (int k = 0; k < f->nodes; k++)
    for (int i = 0; i < f->d; i++)
      for (int p = 0; p < 3; p++) {
        double sum = 0.0;
        for (int o = 0; o < 3; o++)
          sum += f->inverse[9 * k + 3 * p + o] * f->state[(3 * k + o) * f->d + i];
        f->big[f->window[3 * k + p] * f->d + i] = sum;
      }
}

/* adds the gradient by control points, as one by the unknowns, to out [unknowns]: first by the
 * states of a node, then by what these depend on */
static inline void add_gradient(const formulation *f, double *out) {
  int d = f->d, two = 2 * d, n = f->unknowns;
  for (int k = 0; k < f->nodes; k++) {
    double g[3 * most_dofs], gy[most_states] = {0.0}, gt[most_dofs] = {0.0};
    int any = 0;
    for (int o = 0; o < 3; o++)
      for (int i = 0; i < d; i++) {
        double sum = 0.0;
        for (int p = 0; p < 3; p++)
          sum += f->inverse[9 * k + 3 * p + o] * f->gradient[f->window[3 * k + p] * d + i];
        g[o * d + i] = sum;
        any |= sum != 0.0;
      }
    if (!any) continue;
    const double *A = f->A + k * two * two + d * two, *B = f->B + k * two * d + d * d;
    for (int i = 0; i < two; i++) gy[i] = g[i];
    for (int r = 0; r < d; r++) {
      for (int i = 0; i < two; i++) gy[i] += g[two + r] * A[r * two + i];
      for (int i = 0; i < d; i++) gt[i] += g[two + r] * B[r * d + i];
    }
    if (f->kind == COLLOCATION) {
      for (int i = 0; i < two; i++) out[k * 3 * d + i] += gy[i] * f->scale[k * 3 * d + i];
      for (int i = 0; i < d; i++) out[k * 3 * d + two + i] += gt[i] * f->scale[k * 3 * d + two + i];
      continue;
    }
    for (int r = 0; r < two; r++)
      for (int j = 0; j < n && gy[r] != 0.0; j++) out[j] += gy[r] * f->S[(k * two + r) * n + j];
    for (int i = 0; i < d; i++) out[two + k * d + i] += gt[i] * f->scale[two + k * d + i];
  }
}

/* objective, rows and their gradients, of states and dynamics that are set */
static inline int evaluate_problem(formulation *f, int first_equality, const double *x) {
  int n = f->unknowns, equality = first_equality, inequality = f->equalities;
  if (ambulo_problem_evaluate(f->problem, f->workspace, x, &f->objective, NULL, f->all)) return 0;
  memset(f->slope, 0, (size_t)n * sizeof *f->slope);
  if (ambulo_problem_gradient(f->problem, f->workspace, x, 1.0, NULL, f->gradient)) return 0;
  if (f->kind == INCLUSION) {
    memcpy(f->slope, f->gradient, (size_t)n * sizeof *f->slope);
  } else {
    add_gradient(f, f->slope);
  }
  for (int i = 0; i < f->rows; i++) {
    ambulo_row row;
    if (ambulo_problem_row(f->problem, f->row[i], &row)) return 0;
    int at = row.relation == AMBULO_EQUAL ? equality++ : inequality++;
    double size = strcmp(row.unit, "N m") == 0 ? 20.0 : strcmp(row.unit, "rad/s") == 0 ? 5.0 : 1.0;
    if (ambulo_problem_row_gradient(f->problem, f->workspace, x, f->row[i], f->gradient)) return 0;
    f->c[at] = f->all[f->row[i]] / size;
    for (int j = 0; j < f->control_points * f->d; j++) f->gradient[j] /= size;
    double *J = f->jacobian + (size_t)at * (size_t)n;
    if (f->kind == INCLUSION) {
      memcpy(J, f->gradient, (size_t)n * sizeof *J);
    } else {
      memset(J, 0, (size_t)n * sizeof *J);
      add_gradient(f, J);
    }
  }
  return isfinite(f->objective);
}

/* -------------------------------------------------------------- state elimination */

/* K = A (S + step * before) + B T for the stage whose torques are (1 - u) tau_k + u tau_k+1 */
static inline void stage_slope(const formulation *f, int k, double u, double step,
                               const double *before, const double *A, const double *B, double *K) {
  int d = f->d, two = 2 * d, n = f->unknowns;
  const double *S = f->S + (size_t)(k * two * n);
  memset(K, 0, (size_t)(two * n) * sizeof *K);
  for (int r = 0; r < two; r++) {
    for (int i = 0; i < two; i++) {
      double a = A[r * two + i];
      for (int j = 0; j < n && a != 0.0; j++)
        K[r * n + j] += a * (S[i * n + j] + (before ? step * before[i * n + j] : 0.0));
    }
    for (int i = 0; i < d; i++) {
      int here = two + k * d + i, next = here + d;
      K[r * n + here] += (1.0 - u) * B[r * d + i] * f->scale[here];
      if (u > 0.0) K[r * n + next] += u * B[r * d + i] * f->scale[next];
    }
  }
}

/* one step from node k to k + 1, with sensitivities */
static inline int step_forward(formulation *f, int k) {
  static const double share[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0, 2.0, 2.0, 1.0};
  int d = f->d, two = 2 * d, n = f->unknowns;
  double y[most_states], F[4][most_states], tau[most_dofs];
  double A[most_states * most_states], B[most_states * most_dofs];
  const double *from = f->state + 3 * k * d;
  for (int s = 0; s < 4; s++) {
    for (int i = 0; i < two; i++) y[i] = from[i] + (s ? f->h * share[s] * F[s - 1][i] : 0.0);
    for (int i = 0; i < d; i++)
      tau[i] = (1.0 - share[s]) * f->control[k * d + i] + share[s] * f->control[(k + 1) * d + i];
    if (!forward(f, y, tau, F[s], A, B)) return 0;
    stage_slope(f, k, share[s], f->h * share[s], s ? f->K + (s - 1) * two * n : NULL, A, B,
                f->K + s * two * n);
  }
  double *to = f->state + 3 * (k + 1) * d, *S = f->S + (size_t)(k * two * n), *next = S + two * n;
  memcpy(to, from, (size_t)two * sizeof *to);
  memcpy(next, S, (size_t)(two * n) * sizeof *next);
  for (int s = 0; s < 4; s++) {
    for (int i = 0; i < two; i++) to[i] += f->h / 6.0 * weight[s] * F[s][i];
    for (int i = 0; i < two * n; i++) next[i] += f->h / 6.0 * weight[s] * f->K[s * two * n + i];
  }
  return 1;
}

static inline int set_node(formulation *f, int k) {
  int d = f->d, two = 2 * d;
  double *s = f->state + 3 * k * d, *F = f->F + k * two;
  if (!forward(f, s, f->control + k * d, F, f->A + k * two * two, f->B + k * two * d)) return 0;
  memcpy(s + two, F + d, (size_t)d * sizeof *s);
  return 1;
}

static inline int eliminate(formulation *f, const double *x) {
  int d = f->d, two = 2 * d, n = f->unknowns;
  memset(f->S, 0, (size_t)(two * n) * sizeof *f->S);
  for (int i = 0; i < two; i++) {
    f->state[i] = x[i] * f->scale[i];
    f->S[i * n + i] = f->scale[i];
  }
  for (int i = 0; i < f->nodes * d; i++) f->control[i] = x[two + i] * f->scale[two + i];
  for (int k = 0; k < f->nodes; k++) {
    if (!set_node(f, k)) return 0;
    if (k + 1 < f->nodes && !step_forward(f, k)) return 0;
  }
  states_to_points(f);
  return evaluate_problem(f, 0, f->big);
}

/* -------------------------------------------------------------- direct collocation */

/* row r of A_m X, of matrices [2d][2d] and [2d][columns] */
static inline double product(const double *A, const double *X, int two, int columns, int r, int c) {
  double sum = 0.0;
  for (int i = 0; i < two; i++) sum += A[r * two + i] * X[i * columns + c];
  return sum;
}

static inline int defects(formulation *f, int k) {
  int d = f->d, two = 2 * d, n = f->unknowns;
  double h = f->h, y[most_states] = {0.0}, tau[most_dofs] = {0.0}, Fm[most_states];
  double Am[most_states * most_states], Bm[most_states * most_dofs];
  const double *a = f->state + 3 * k * d, *b = a + 3 * d;
  for (int i = 0; i < two; i++)
    y[i] = 0.5 * (a[i] + b[i]) + h / 8.0 * (f->F[k * two + i] - f->F[(k + 1) * two + i]);
  for (int i = 0; i < d; i++) tau[i] = 0.5 * (f->control[k * d + i] + f->control[(k + 1) * d + i]);
  if (!forward(f, y, tau, Fm, Am, Bm)) return 0;
  for (int r = 0; r < two; r++) {
    int at = k * two + r, size = 3 * k * d + r;
    double *J = f->jacobian + (size_t)at * (size_t)n, s = 1.0 / f->scale[size];
    memset(J, 0, (size_t)n * sizeof *J);
    f->c[at] =
        s * (b[r] - a[r] - h / 6.0 * (f->F[k * two + r] + 4.0 * Fm[r] + f->F[(k + 1) * two + r]));
    for (int end = 0; end < 2; end++) {
      const double *A = f->A + (k + end) * two * two, *B = f->B + (k + end) * two * d;
      double sign = end ? 1.0 : -1.0, e = (end ? -h : h) / 8.0;
      int first = 3 * (k + end) * d;
      for (int c = 0; c < two; c++) {
        double mid = 0.5 * Am[r * two + c] + e * product(Am, A, two, two, r, c);
        double value = (r == c ? sign : 0.0) - h / 6.0 * (A[r * two + c] + 4.0 * mid);
        J[first + c] = s * value * f->scale[first + c];
      }
      for (int c = 0; c < d; c++) {
        double mid = e * product(Am, B, two, d, r, c) + 0.5 * Bm[r * d + c];
        double value = -h / 6.0 * (B[r * d + c] + 4.0 * mid);
        J[first + two + c] = s * value * f->scale[first + two + c];
      }
    }
  }
  return 1;
}

static inline int collocate(formulation *f, const double *x) {
  int d = f->d, two = 2 * d;
  for (int k = 0; k < f->nodes; k++) {
    const double *z = x + 3 * k * d, *s = f->scale + 3 * k * d;
    for (int i = 0; i < two; i++) f->state[3 * k * d + i] = z[i] * s[i];
    for (int i = 0; i < d; i++) f->control[k * d + i] = z[two + i] * s[two + i];
    if (!set_node(f, k)) return 0;
  }
  for (int k = 0; k + 1 < f->nodes; k++)
    if (!defects(f, k)) return 0;
  states_to_points(f);
  return evaluate_problem(f, two * (f->nodes - 1), f->big);
}

/* f->finite: all of it is */
static inline void formulation_evaluate(formulation *f, const double *x) {
  f->evaluations++;
  f->finite = f->kind == ELIMINATION   ? eliminate(f, x)
              : f->kind == COLLOCATION ? collocate(f, x)
                                       : evaluate_problem(f, 0, x);
}

#endif
