/* mechanics/plan_coupled.h - the inside of a plan of a body with coupled joints.
 *
 * Its kernels are those of the same body with a coordinate for every joint, `open`: the J joints'
 * values and rates are worked out from the d coordinates before, and what comes out is folded
 * after (kernel_coupled.h). Of the other members of such a plan only those count that its callers
 * ask for: sizes, pattern and parts. */
#ifndef AMBULO_MECHANICS_PLAN_COUPLED_H
#define AMBULO_MECHANICS_PLAN_COUPLED_H

#include "mechanics/plan_layout.h"

/* A coupled joint. */
typedef struct ambulo__follower {
  int joint, coordinate;
  ambulo__coupling function;
  int diagonal; /* entry of the row of tau of its coordinate, in that column; -1: none */
} ambulo__follower;

/* What an entry of a Jacobian is made of: an entry of `open`. */
typedef struct ambulo__fold {
  int entry, rate, mass; /* places in jq, jqd and jqdd of `open`; rate -1: the row has no rates */
  int row, column;       /* followers that the entry's row and column are those of; -1: none */
  double factor;
} ambulo__fold;

struct ambulo__coupled_plan {
  ambulo__plan *open;
  int *coordinate; /* [joints]: that moves it */
  int *follower;   /* [joints]: index; -1: the joint is its coordinate's own */
  ambulo__follower *followers;
  int joint_count, follower_count;
  ambulo__piece *pieces;
  ambulo__fold *folds; /* entry e of the pattern: fold_start[e] up to fold_start[e + 1] */
  int *fold_start;     /* [entries + 1] */
  int entry_count;     /* without factors */

  /* places in the scratch */
  int motion_at; /* values, speeds, accelerations of the joints, 3 J */
  int slopes_at; /* 5 of each follower: f', f'', f'' qd, 2 f'' qd, f''' qd^2 + f'' qdd */
  int out_at, weights_at, gradient_at, jq_at, jqd_at, jqdd_at;
  int open_at; /* the scratch of `open` */
};

enum { follower_slopes = 5 * AMBULO__LANES };

/* From a model with coupled joints, for ambulo__plan_create and its like; plan has nothing yet but
 * its allocator, and `coupled` with the plan `open`. Errors: E_MEMORY. */
ambulo_status ambulo__coupled_plan_build(ambulo__plan *plan, const ambulo_model *model,
                                         const ambulo__footing *footing);
/* All but `open`. */
void ambulo__coupled_plan_free(ambulo__plan *plan);

#endif
