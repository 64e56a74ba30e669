/* method/engine.h - everything that one solve on one grid works with.
 *
 * Inside the engine the objective is multiplied by objective_scale and inequality rows are
 * excesses v = -s c <= 0 (rows_split.h):
 *
 *     minimize f(x)   subject to h(x) = 0 (equality), C x = b (border), v(x) <= 0
 *
 * All memory is taken by ambulo__engine_create; nothing below allocates.
 */
#ifndef AMBULO_METHOD_ENGINE_H
#define AMBULO_METHOD_ENGINE_H

#include "linear/kkt.h"
#include "method/metric.h"
#include "linear/mixing.h"
#include "method/rows_split.h"
#include "method/run.h"

/* A point of the augmented Lagrangian and what belongs to it. */
typedef struct ambulo__trial {
  double value;                /* augmented Lagrangian; HUGE_VAL: none */
  double objective;            /* f, scaled */
  double violation;            /* worst inequality, relative to its size */
  double gradient_norm;        /* of the reduced, whitened gradient; < 0: not computed */
  double *x;                   /* [n] */
  double *excess;              /* [inequalities] */
  double *multiplier;          /* [inequalities]: max(0, lambda + rho v) */
  double *equality_multiplier; /* [equalities] */
} ambulo__trial;

typedef struct ambulo__engine {
  const ambulo_problem *problem;
  ambulo_workspace *workspace;
  ambulo__run *run;
  ambulo__pool pool;
  int n, equalities, inequalities, borders;
  ambulo__rows_split rows;
  ambulo__metric metric;
  ambulo__band base;     /* H0 + mu I at the centre */
  ambulo__band whitener; /* L of H0 + mu I + rho J_A' J_A */
  ambulo__kkt kkt;       /* the same H with the equalities' gradients at the centre */
  ambulo__mixing retraction, adjoint;
  double objective_scale, mu, rho;
  double adjoint_tolerance;    /* relative error of a reduced gradient */
  double retraction_tolerance; /* worst equality of a retracted point */
  double at_rest;              /* |objective| (not scaled) with all unknowns zero */
  double negligible; /* objective (not scaled) that counts as its lower bound 0; < 0: it has none */
  double *negligible_term;         /* [terms]: the same, each */
  double *cap;                     /* [coordinates]: largest change in one step, rad or m */
  double *center;                  /* [n] */
  double *lambda;                  /* [inequalities] */
  double *equality_multiplier;     /* [equalities]: G + J' l + C' m = 0 at a solution */
  double *border_multiplier;       /* [borders]: m, after a model step */
  double *h, *b, *dual, *balanced; /* [equalities], [borders], [equalities] twice */
  double *row_weight;              /* [rows of the problem] */
  int *active, *active_next;       /* [inequalities] */
  int *added;                      /* [inequalities]: rows that the whitener holds */
  int assembled, warm;
  double *best_total, *best_curved, *best_linear;
  double *along, *linear; /* [inequalities] */
  double *gradient, *step, *total, *curved, *curved_total, *previous, *previous_right; /* [n] */
  double *iterate;        /* [n]: whitened point that NLopt works on */
  double *w, *w_gradient; /* [n]: whitened point held in `held`, gradient there */
  int has_held, has_held_gradient;
  double carried_objective; /* lambda is from a coarser grid (carry.c), where the objective (not
                               scaled) came to this; < 0: it is not */
  double ceiling;           /* highest value of the augmented Lagrangian since the centre was set */
  ambulo__trial held;       /* the last point */
  ambulo__trial reached;    /* where the last inner solve ended */
} ambulo__engine;

/* Classifies rows, finds the objective's scale, allocates. Both are found at zero, so that they are
 * the same from every start; at `start` where zero has no finite values. `start` must have.
 * Errors: E_MEMORY. */
ambulo_status ambulo__engine_create(const ambulo_problem *problem, const double *start,
                                    const ambulo_allocator *allocator, ambulo__run *run,
                                    ambulo_diagnostics *diagnostics, ambulo__engine **engine);
void ambulo__engine_free(ambulo__engine *engine); /* accepts NULL */
/* Whether the point that the workspace holds has an objective next to its lower bound, zero. */
int ambulo__engine_at_lower_bound(const ambulo__engine *engine);

/* Worst |h| and |C x - b| at the point that the workspace holds, relative to the sizes of the
 * rows; fills engine->h, b. */
double ambulo__engine_equality_error(ambulo__engine *engine);
/* Excesses at the point held; returns the worst relative to the size of its row (>= 0). */
double ambulo__engine_excess(const ambulo__engine *engine, double *excess);
/* Gradient of f + sum p v + sum l h at the point held (p, l may be NULL). E_NUMERIC: it is not
 * finite, which the run remembers. */
ambulo_status ambulo__engine_gradient(ambulo__engine *engine, const double *p, const double *l,
                                      double *gradient);
/* base = metric + mu I at the point held. 1: it is not finite, which is told to the run. */
int ambulo__engine_fill_metric(ambulo__engine *engine, double mu);
/* Factor <= 1 that keeps a step below `share` of every coordinate's cap. */
double ambulo__engine_step_limit(const ambulo__engine *engine, const double *step, double share);

/* restore.c: damped Newton steps of least length to h = 0, C x = b. Returns the error
 * left; x moves. E_NUMERIC when no finite point was found. */
ambulo_status ambulo__restore(ambulo__engine *engine, double *x, double *error);

/* retraction.c: moves y along the metric's normal directions until |h| <= retraction_tolerance; the
 * workspace then holds it. 0 when that fails. */
int ambulo__retract(ambulo__engine *engine, double *y);
/* retraction.c: z, the gradient's tangent representative: see there. p as in
 * ambulo__engine_gradient. Uses and updates engine->equality_multiplier. E_NUMERIC as there. */
ambulo_status ambulo__reduced_gradient(ambulo__engine *engine, const double *p, double *z);

/* model_step.c: minimizes the piecewise quadratic model at the centre, sets whitener and
 * kkt; step in engine->total. Returns 0; 1 when a factorization failed; 2 when a value or a
 * derivative at the centre is not finite, which the run remembers. */
int ambulo__model_step(ambulo__engine *engine, double *predicted);
/* model_step.c: its inner part: minimizes phi for the base, gradient, linear (excesses at
 * d = 0), lambda and rho that the engine holds; step in engine->total, forces of the rows in
 * engine->held.multiplier. Returns 1 when settled with the factor of the final active set,
 * 2 when done otherwise, -1 when a factorization failed or the run is late. *phi: decrease
 * (<= 0). */
int ambulo__model_minimize(ambulo__engine *engine, int roughly, double *phi);

/* augmented.c: augmented Lagrangian at retract(center + L^-T w); the result in
 * engine->held. gradient [n] may be NULL. A point that cannot be reached, or
 * where something is not finite, has a finite value above that of the centre. */
double ambulo__augmented(ambulo__engine *engine, const double *w, double *gradient);

/* polish.c: moves x by a few Newton steps until the inequalities hold to a fifth of the
 * tolerance; 1 on success, else x stays. engine->reached must belong to x. */
int ambulo__polish(ambulo__engine *engine, double *x);

/* augmented.c: a point and what belongs to it. */
void ambulo__trial_copy(const ambulo__engine *engine, const ambulo__trial *from, ambulo__trial *to);

/* pipeline.c: the whole method from x (in and out); run->ending says why it ended. The last
 * multipliers stay in engine->lambda and engine->equality_multiplier. */
typedef enum ambulo__stage {
  AMBULO__COARSE, /* a coarse grid whose solution only starts the next one: wide tolerances */
  AMBULO__FAR,    /* from anywhere */
  AMBULO__NEAR    /* from a point that nearly satisfies the rows, and stays in its valley */
} ambulo__stage;
ambulo_status ambulo__pipeline(ambulo__engine *engine, ambulo__stage stage, double *x);

#endif
