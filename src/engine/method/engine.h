/* method/engine.h - everything that one solve on one grid works with.
 *
 * Inside the engine the objective is multiplied by objective_scale and inequality rows are
 * excesses v = -s c <= 0 (row_roles.h):
 *
 *     minimize f(x)   subject to h(x) = 0 (equality), C x = b (border), v(x) <= 0
 *
 *   setup       what the problem and the start decide, once
 *   iterate     x_k, lambda, rho, mu: what a solve moves
 *   linearized  gradients and curvature at x_k, and the factors made of them
 *   last        the last point that was evaluated around x_k (augmented.h)
 *   reached     where the last inner solve ended
 *
 * The scratch of a module is declared in its header, and nobody else looks into it but whom that
 * header names. All memory is taken by ambulo__engine_create; the iterations allocate nothing.
 */
#ifndef AMBULO_METHOD_ENGINE_H
#define AMBULO_METHOD_ENGINE_H

#include "linear/kkt.h"
#include "method/metric.h"
#include "method/row_roles.h"
#include "method/run.h"

/* The same from the first iteration to the last. */
typedef struct ambulo__setup {
  const ambulo_problem *problem;
  const ambulo__row_roles *rows; /* which row plays which role; gradients: see linearized */
  int n, equalities, inequalities, borders;
  double objective_scale;
  double at_rest;    /* |objective| (not scaled) with all unknowns zero */
  double negligible; /* objective (not scaled) that counts as its lower bound 0; < 0: it has none */
  double *negligible_term; /* [terms]: the same, each */
  double *cap;             /* [coordinates]: largest change in one step, rad or m */
} ambulo__setup;

typedef struct ambulo__iterate {
  double *x;                   /* [n]: x_k */
  double *lambda;              /* [inequalities] */
  double *equality_multiplier; /* [equalities]: G + J' l + C' m = 0 at a solution */
  double *border_multiplier;   /* [borders]: m, after a model step */
  double rho, mu;              /* penalty; damping */
  double carried_objective; /* lambda is of another solve (multipliers.h), where the objective (not
                                scaled) came to this; < 0: it is not */
} ambulo__iterate;

/* The linear algebra at x_k. */
typedef struct ambulo__linearized {
  ambulo__row_roles rows; /* with their gradients at x_k */
  ambulo__metric metric;
  ambulo__band base;     /* H0 + mu I */
  double *filled_at;     /* [n]: where H0 was filled in */
  double filled_mu;      /* mu of base; < 0: there is no H0 in it */
  ambulo__band whitener; /* L of H0 + mu I + rho J_A' J_A */
  int assembled;         /* whitener and kkt were made of this base (model_step.c) */
  ambulo__kkt kkt;       /* the same H with the equalities' gradients */
} ambulo__linearized;

/* Values of rows at the point that the workspace holds (point.h). */
typedef struct ambulo__measured {
  double *equality, *border; /* h, C x - b; [equalities], [borders] */
  double *excess;            /* [inequalities]: for whoever has no place of its own */
  double *row_weight;        /* [rows of the problem]: of the last gradient */
} ambulo__measured;

/* A point of the augmented Lagrangian and what belongs to it. */
typedef struct ambulo__trial {
  int n, inequalities, equalities;
  double value;                /* augmented Lagrangian; not < HUGE_VAL: none */
  double objective;            /* f, scaled */
  double violation;            /* worst inequality, relative to its size */
  double gradient_norm;        /* of the reduced, whitened gradient; < 0: not computed */
  double *x;                   /* [n] */
  double *excess;              /* [inequalities] */
  double *multiplier;          /* [inequalities]: max(0, lambda + rho v) */
  double *equality_multiplier; /* [equalities]: once the gradient is there */
} ambulo__trial;

/* A point without a value. E_MEMORY. (point.c) */
ambulo_status ambulo__trial_create(int n, int inequalities, int equalities, ambulo__pool *pool,
                                   ambulo__trial *trial);
/* Between two of one size. */
void ambulo__trial_copy(const ambulo__trial *from, ambulo__trial *to);

typedef struct ambulo__engine {
  const ambulo__setup *setup;
  ambulo_workspace *workspace;
  ambulo__run *run;
  ambulo__pool pool;
  ambulo__iterate iterate;
  ambulo__linearized linearized;
  ambulo__measured measured;
  ambulo__trial reached;                 /* value HUGE_VAL: nowhere yet */
  struct ambulo__last_point *last;       /* augmented.h */
  struct ambulo__quadratic *quadratic;   /* model_step.h */
  struct ambulo__retraction *retraction; /* equalities.h */
  double *polished;                      /* [n]: the point so far, of stopping.c */
} ambulo__engine;

/* Classifies rows, finds the objective's scale, allocates. Both are found at zero, so that they are
 * the same from every start; at `start` where zero has no finite values. `start` must have.
 * Errors: E_MEMORY; E_LIMIT: the run was stopped meanwhile. */
ambulo_status ambulo__engine_create(const ambulo_problem *problem, const double *start,
                                    const ambulo_allocator *allocator, ambulo__run *run,
                                    ambulo_diagnostics *diagnostics, ambulo__engine **engine);
/* The same engine for the rows that are near now (near.c); memory of its pool is gone. E_MEMORY:
 * the engine can only be freed. */
ambulo_status ambulo__engine_renew(ambulo__engine *engine, const double *start);
void ambulo__engine_free(ambulo__engine *engine); /* accepts NULL */

#endif
