/* solver/solver.c - the solver object: one problem again and again.
 *
 * It has a copy of the problem. Numbers that may change are constants of its rows and its
 * references, so that no matrix, no classification and no memory depends on them:
 *
 *     prescribed end   D^o q_i(t_e) - value = 0: the row's constant is -value
 *     reference        read where the term is evaluated
 *     foothold         constants of the rows of contact, and what the kernels know of the ground
 *                      (problem/moved_foothold.c); rows of a foot that begins to turn stand on more
 *                      channels, so that the factors are set up anew for them
 *
 * An iterate is the pipeline beside the last solution (method/pipeline.h): back onto the
 * equalities, which have moved, then so many inner solves of NLopt's AUGLAG with the multipliers at
 * hand. The first one without any begins far from a solution, on coarser grids if the options say
 * so.
 *
 * Shift by d: the states of the motion at the breakpoints t_k + d, clamped to the end, where rates
 * become zero, make a Hermite spline that the problem's basis takes over. A multiplier that was at
 * t + d is at t, by the densities of method/multipliers.h.
 */
#include "ambulo/again.h"

#include "base/diagnostics.h"
#include "base/machine.h"
#include "method/multipliers.h"
#include "method/pipeline.h"
#include "method/refine.h"
#include "model/neutral_pose.h"
#include "solver/session.h"

#include <math.h>
#include <string.h>

struct ambulo_solver {
  ambulo_allocator allocator;
  ambulo_problem *problem;
  ambulo_options options; /* the caller's */
  ambulo_options budget;  /* the same for one call of ambulo_solver_iterate */
  ambulo__run run;
  ambulo__engine *engine;
  double *x;       /* [variables]: where it stands */
  double *moved;   /* [variables]: where an iterate ends */
  double *rows;    /* [nodes of the Hermite spline][2 d]: scratch of a shift */
  int *end_row;    /* [end values of the definition]: their rows */
  int is_beside;   /* 1: the engine has multipliers of a solution */
  int is_anywhere; /* 1: nothing is known, not even a start */
  ambulo_solver_state state;
};

/* -------------------------------------------------------------------- life */

static void find_end_rows(ambulo_solver *s) {
  const ambulo_problem *p = s->problem;
  int e = 0;
  for (int r = 0; r < p->rows && e < p->definition.end_value_count; r++) {
    unsigned char kind = p->table.rows[r].kind;
    if (kind == AMBULO__KIND_INITIAL_STATE || kind == AMBULO__KIND_FINAL_STATE)
      s->end_row[e++] = r; /* in the order of the definition (contact/ends.c) */
  }
}

static ambulo_status allocate(ambulo_solver *s) {
  const ambulo_problem *p = s->problem;
  size_t n = (size_t)p->variables, d = (size_t)p->coordinates;
  size_t states = (size_t)ambulo__basis_intervals(p->basis) + 1;
  s->x = ambulo__alloc(&s->allocator, n, sizeof *s->x);
  s->moved = ambulo__alloc(&s->allocator, n, sizeof *s->moved);
  s->rows = ambulo__alloc(&s->allocator, states, 2 * d * sizeof *s->rows);
  s->end_row =
      ambulo__alloc(&s->allocator, (size_t)p->definition.end_value_count + 1, sizeof *s->end_row);
  if (!s->x || !s->moved || !s->rows || !s->end_row) return AMBULO_E_MEMORY;
  ambulo__start_pose(p, s->x);
  find_end_rows(s);
  return AMBULO_OK;
}

static ambulo_status set_up(ambulo_solver *s, const ambulo_problem *problem,
                            ambulo_diagnostics *diagnostics) {
  ambulo_status status = ambulo__solve_check_memory(problem, &s->options, diagnostics);
  if (status) return status;
  status = ambulo__problem_with_grid(problem, problem->definition.intervals,
                                     ambulo__basis_intervals(problem->basis), &s->allocator,
                                     &s->problem);
  if (!status) status = allocate(s);
  ambulo__run_begin(&s->run, &s->options);
  if (!status)
    status =
        ambulo__engine_create(s->problem, s->x, &s->allocator, &s->run, diagnostics, &s->engine);
  if (!status && (s->options.algorithm == AMBULO_SLSQP || !s->engine->setup->rows->regular))
    status = ambulo__error(diagnostics, AMBULO_E_ARGUMENT, ambulo__nowhere, NULL,
                           "a solver object works by AUGLAG; expected a problem without rows of "
                           "the caller that span the grid, and not algorithm slsqp");
  return status;
}

ambulo_status ambulo_solver_create(const ambulo_problem *problem, const ambulo_options *options,
                                   const ambulo_allocator *allocator,
                                   ambulo_diagnostics *diagnostics, ambulo_solver **solver) {
  if (!problem || !solver) return AMBULO_E_ARGUMENT;
  ambulo_options own;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo_status status = ambulo__options_own(problem, options, diagnostics, &own);
  if (status) return status;
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  ambulo_solver *s = ambulo__alloc(&a, 1, sizeof *s);
  if (!s) return AMBULO_E_MEMORY;
  s->allocator = a;
  s->options = own;
  s->is_anywhere = 1;
  status = set_up(s, problem, diagnostics);
  if (status) {
    ambulo_solver_free(s);
    return ambulo__conclude(diagnostics, errors, status, NULL);
  }
  *solver = s;
  return AMBULO_OK;
}

void ambulo_solver_free(ambulo_solver *s) {
  if (!s) return;
  ambulo_allocator a = s->allocator;
  ambulo__engine_free(s->engine);
  ambulo__free(&a, s->end_row);
  ambulo__free(&a, s->rows);
  ambulo__free(&a, s->moved);
  ambulo__free(&a, s->x);
  ambulo_problem_free(s->problem);
  ambulo__free(&a, s);
}

/* ------------------------------------------------------------ what may change */

/* values at the last point are those of other numbers */
static void forget_values(ambulo_solver *s) {
  s->engine->workspace->has_values = s->engine->workspace->has_jacobian = 0;
}

ambulo_status ambulo_solver_start(ambulo_solver *s, const double *x,
                                  const ambulo_multipliers *multipliers) {
  if (!s || !x) return AMBULO_E_ARGUMENT;
  forget_values(s);
  if (ambulo__evaluate(s->engine->workspace, x)) return AMBULO_E_PROBLEM;
  memcpy(s->x, x, (size_t)s->problem->variables * sizeof *x);
  ambulo__multipliers_transfer(multipliers, s->engine);
  s->is_beside = multipliers != NULL;
  s->is_anywhere = 0;
  return AMBULO_OK;
}

ambulo_status ambulo_solver_set_end(ambulo_solver *s, int coordinate, int order, int final,
                                    double value) {
  if (!s || !isfinite(value)) return AMBULO_E_ARGUMENT;
  ambulo_problem *p = s->problem;
  for (int e = 0; e < p->definition.end_value_count; e++) {
    ambulo_end_value *end = (ambulo_end_value *)&p->definition.end_values[e]; /* the copy's own */
    if (end->coordinate != coordinate || end->order != order || !end->final != !final) continue;
    end->value = value;
    p->table.rows[s->end_row[e]].constant = -value;
    p->row_runs.constant[s->end_row[e]] = -value;
    forget_values(s);
    return AMBULO_OK;
  }
  return AMBULO_E_ARGUMENT;
}

/* an engine for rows that stand on other channels, with the multipliers of the last one */
static ambulo_status renew_engine(ambulo_solver *s) {
  ambulo_multipliers *m = NULL;
  ambulo__engine *engine = NULL;
  ambulo_status status = AMBULO_OK;
  if (s->is_beside) status = ambulo__multipliers_save(s->engine, &s->allocator, &m);
  if (m) m->objective = s->state.objective;
  if (!status)
    status = ambulo__engine_create(s->problem, s->x, &s->allocator, &s->run, NULL, &engine);
  if (!status) {
    ambulo__engine_free(s->engine);
    s->engine = engine;
    ambulo__multipliers_transfer(m, engine);
  }
  ambulo_multipliers_free(m);
  return status;
}

ambulo_status ambulo_solver_set_foothold(ambulo_solver *s, int contact, const double place[2],
                                         double heading) {
  ambulo__moved moved;
  if (!s || !place || !isfinite(place[0]) || !isfinite(place[1]) || !isfinite(heading))
    return AMBULO_E_ARGUMENT;
  ambulo_status status = ambulo__problem_move_foothold(s->problem, contact, place, heading, &moved);
  if (status) return status;
  if (!ambulo__moved_is_alike(s->problem, &moved)) {
    status = renew_engine(s);
    if (status) ambulo__problem_swap_moved(s->problem, &moved);
  }
  ambulo__moved_free(s->problem, &moved);
  forget_values(s);
  return status;
}

ambulo_status ambulo_solver_set_reference(ambulo_solver *s, int term, const double *reference) {
  if (!s || !reference || term < 0 || term >= s->problem->definition.term_count)
    return AMBULO_E_ARGUMENT;
  const ambulo_problem *p = s->problem;
  ambulo_term *own_term = (ambulo_term *)&p->definition.terms[term]; /* the copy's own */
  size_t width = 0;
  const double **followed = ambulo__term_reference(own_term, p->model, &width);
  if (!followed) return AMBULO_E_ARGUMENT;
  double *own = (double *)*followed;
  size_t count = (size_t)p->nodes * width;
  int gaps = !ambulo__term_has(own_term, AMBULO__TERM_REFERENCE);
  for (size_t i = 0; i < count; i++)
    if (!isfinite(reference[i]) && !(gaps && isnan(reference[i]))) return AMBULO_E_ARGUMENT;
  memcpy(own, reference, count * sizeof *own);
  forget_values(s);
  return AMBULO_OK;
}

const ambulo_problem *ambulo_solver_problem(const ambulo_solver *s) {
  return s ? s->problem : NULL;
}

/* states at the breakpoints, `time` later */
static void sample_later(ambulo_solver *s, double time, double interval) {
  const ambulo_problem *p = s->problem;
  int d = p->coordinates, last = ambulo__basis_intervals(p->basis);
  double duration = ambulo__basis_duration(p->basis);
  for (int k = 0; k <= last; k++) {
    double *row = s->rows + 2 * (size_t)k * (size_t)d, t = k * interval + time;
    int rests = t >= duration;
    ambulo__basis_point point;
    ambulo__basis_at(p->basis, rests ? duration : t, &point);
    memset(row, 0, 2 * (size_t)d * sizeof *row);
    for (int j = 0; j < point.span; j++) {
      const double *control = s->x + (size_t)(point.first + j) * (size_t)d;
      for (int i = 0; i < d; i++) {
        row[i] += point.weight[0][j] * control[i];
        row[d + i] += rests ? 0.0 : interval * point.weight[1][j] * control[i];
      }
    }
  }
}

static ambulo_status shift_motion(ambulo_solver *s, double time, double *x) {
  const ambulo_problem *p = s->problem;
  int intervals = ambulo__basis_intervals(p->basis);
  double duration = ambulo__basis_duration(p->basis);
  ambulo__basis *hermite = NULL;
  ambulo_status status =
      ambulo__basis_create(AMBULO__HERMITE, 3, intervals, duration, NULL, &s->allocator, &hermite);
  if (status) return status;
  sample_later(s, time, duration / intervals);
  status = ambulo__basis_transfer(hermite, s->rows, p->basis, x, p->coordinates, &s->allocator);
  ambulo__basis_free(hermite);
  return status;
}

ambulo_status ambulo_solver_shift(ambulo_solver *s, double time) {
  if (!s || !(time >= 0.0 && time <= s->problem->definition.duration)) return AMBULO_E_ARGUMENT;
  ambulo_multipliers *m = NULL;
  ambulo_status status = shift_motion(s, time, s->moved);
  if (!status && s->is_beside) {
    double objective = s->state.objective;
    status = ambulo__multipliers_save(s->engine, &s->allocator, &m);
    if (m) m->objective = objective;
  }
  if (!status) memcpy(s->x, s->moved, (size_t)s->problem->variables * sizeof *s->x);
  if (m) ambulo__multipliers_shift(m, time / s->problem->definition.duration);
  if (!status) ambulo__multipliers_transfer(m, s->engine);
  ambulo_multipliers_free(m);
  s->is_anywhere = 0;
  return status;
}

/* ------------------------------------------------------------------ iterations */

static void tell(ambulo_solver *s, double begin) {
  ambulo_solver_state *state = &s->state;
  const ambulo_problem *p = s->problem;
  ambulo_workspace *w = s->engine->workspace;
  forget_values(s);
  w->leaves_far_out = 0;
  memset(&state->worst, 0, sizeof state->worst);
  state->worst.size = 1.0;
  state->worst.family = state->worst.subject = state->worst.detail = state->worst.unit = "";
  if (!ambulo__evaluate(w, s->x)) {
    state->objective = w->objective;
    for (int r = 0; r < p->rows; r++) {
      double missed = ambulo__row_violation(p, r, w->row_value[r]) / p->table.rows[r].size;
      if (missed > ambulo__relative(&state->worst))
        state->worst = ambulo__violation_of(p, r, w->row_value[r]);
    }
  }
  state->x = s->x;
  state->feasible = ambulo__relative(&state->worst) <= s->options.feasibility_tolerance;
  state->ending = s->run.ending;
  state->converged = s->run.ending == AMBULO_ENDING_CONVERGED ||
                     s->run.ending == AMBULO_ENDING_SETTLED ||
                     s->run.ending == AMBULO_ENDING_VANISHED;
  state->iterations = s->run.iterations;
  state->evaluations = s->run.evaluations;
  state->seconds = ambulo__seconds_now() - begin;
}

static ambulo_status work(ambulo_solver *s) {
  ambulo__engine *e = s->engine;
  ambulo__stage stage = s->is_beside ? AMBULO__BESIDE : AMBULO__FAR;
  int levels = 0;
  ambulo_status status = AMBULO_OK;
  if (s->is_anywhere && s->options.continuation)
    status = ambulo__refine(e, &s->allocator, s->x, &levels);
  if (s->is_beside && e->iterate.carried_objective < 0.0)
    e->iterate.carried_objective = fabs(s->state.objective);
  double *x = s->moved;
  memcpy(x, s->x, (size_t)s->problem->variables * sizeof *x);
  if (!status) status = ambulo__pipeline(e, stage, x);
  if (status == AMBULO_E_NUMERIC) status = AMBULO_OK; /* the state tells */
  if (ambulo__violation_at(e, x) < HUGE_VAL)
    memcpy(s->x, x, (size_t)s->problem->variables * sizeof *x);
  s->is_anywhere = 0;
  s->is_beside = e->reached.value < HUGE_VAL;
  return status;
}

ambulo_status ambulo_solver_iterate(ambulo_solver *s, int iterations, double seconds,
                                    const ambulo_solver_state **state) {
  if (!s || !state || iterations < 1 || seconds <= 0.0) return AMBULO_E_ARGUMENT;
  double begin = ambulo__seconds_now();
  s->budget = s->options;
  s->budget.maximum_iterations = iterations;
  s->budget.time_limit = seconds;
  forget_values(s);
  ambulo__run_begin(&s->run, &s->budget);
  s->run.unpolished = 1;
  ambulo_status status = work(s);
  if (status) return status;
  tell(s, begin);
  *state = &s->state;
  return AMBULO_OK;
}

ambulo_status ambulo_solver_result(const ambulo_solver *s, ambulo_diagnostics *diagnostics,
                                   ambulo_result **result) {
  if (!s) return AMBULO_E_ARGUMENT;
  return ambulo_audit_point(s->problem, &s->options, s->x, &s->allocator, diagnostics, result);
}
