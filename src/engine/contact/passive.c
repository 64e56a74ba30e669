/* contact/passive.c - coordinates that nothing drives: rows "passive".
 *
 * Of a coordinate that is not actuated, or that a device drives alone (a prosthesis), with tau what
 * inverse dynamics asks of it less what devices give (springs, dampers):
 *
 *     tau_i = 0            N m, N
 *
 * A spline cannot hold that at all times, nor at more nodes than its accelerations have
 * coefficients for: with K intervals these are a spline of degree p - 2 with K + p - 2. So there is
 * one equation at the node nearest to each of its Greville abscissae (collocation), which is every
 * node where a trajectory has as many knots as nodes. What is left between them is looked at on
 * the finer grid (solver/dense.h).
 *
 * A coordinate that carries every mass is the body's way through the world. What touches the body
 * supplies its force: with ground reaction tau_i vanishes identically, and without, the ground
 * under a walk of zero-moment points is left untold, as is what carries a floating body of which no
 * contact is given. So it has rows only where the body is hinged to the world and nothing else
 * touches it, as an acrobat on a bar.
 */
#include "contact/row_families.h"

#include "model/neutral_pose.h"

#include <math.h>

int ambulo__is_passive(const ambulo_problem_definition *d, int coordinate) {
  const ambulo_model *m = d->model;
  for (int v = 0; v < d->device_count; v++) {
    if (d->devices[v].coordinate == coordinate && d->devices[v].alone) return 1;
  }
  if (m->coordinates[coordinate].actuated) return 0;
  int supplied = d->contact_count > 0 || d->ground_reaction.kind != AMBULO_REACTION_NONE;
  for (int i = 0; i < m->coordinate_count; i++) supplied |= ambulo__is_root_translation(m, i);
  return !(supplied && ambulo__carries_whole_body(m, coordinate));
}

/* the j-th Greville abscissa of the accelerations' splines, of degree p - 2 on the same
 * breakpoints: the mean of p - 2 knots, of which both end knots stand p + 1 times in the
 * trajectory's */
static double collocation_time(const ambulo__basis *basis, int j) {
  int degree = ambulo__basis_degree(basis) - 2;
  double sum = 0.0;
  for (int k = 0; k < degree; k++) sum += basis->knots[j + 3 + k];
  return sum / degree;
}

/* 1 if no node is nearer to some time of collocation */
static int is_collocated(const ambulo__gait_context *context, int node) {
  const ambulo__basis *basis = context->basis;
  if (ambulo__basis_get_kind(basis) != AMBULO__BSPLINE) return 1;
  const double *t = context->times;
  int last = context->nodes - 1, count = ambulo__basis_control_points(basis) - 2;
  double from = node == 0 ? -INFINITY : 0.5 * (t[node - 1] + t[node]);
  double to = node == last ? INFINITY : 0.5 * (t[node] + t[node + 1]);
  for (int j = 0; j < count; j++) {
    double time = collocation_time(basis, j);
    if (time > from && time <= to) return 1;
  }
  return 0;
}

/* (14.j) tau = 0 of what is not actuated */
void ambulo__passive_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  const ambulo_model *m = context->model;
  int distinct = ambulo__distinct_nodes(context, AMBULO__OF_FORCES);
  for (int node = 0; node < distinct; node++) {
    if (!is_collocated(context, node)) continue;
    for (int i = 0; i < m->coordinate_count; i++) {
      const ambulo_coordinate *c = &m->coordinates[i];
      if (!ambulo__is_passive(context->definition, i)) continue;
      ambulo__row_begin(table, AMBULO__KIND_PASSIVE, c->name, "driven",
                        ambulo__row_measure(AMBULO__KIND_PASSIVE, c->type, 0), AMBULO_EQUAL, node,
                        context->times[node], 0.0);
      ambulo__row_term_add(table, node, ambulo__channel_tau(&context->channels, i), 1.0);
    }
  }
}
