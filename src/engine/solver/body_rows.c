/* solver/body_rows.c - margins, places of obstacles, places and tolerances of reaches.
 *
 * Rows of capsules (contact/solid.h) keep D = radii + margin + a T, a T the allowance for what
 * passes between the nodes, and know the obstacle by how far the capsule is from its place p:
 *
 *     dc/dmargin = -D / sqrt(D^2 + W),   dc/dT = a dc/dmargin,   dc/dp = -(dc/da + dc/db)
 *
 * with the slopes by both ends a, b of the capsule, p the middle of a box; by ends of a capsule
 * that stands still those of contact/segments.h. Places stand above the ground's height h, whose
 * slope is that of their third number. A reach at the place p, within w along each axis,
 *
 *     (x - p) + w >= 0, (p - x) + w >= 0, or x - p = 0      dc/dp = -+1, dc/dw = 1
 *
 * x the point, or how far it is from the one that the place is relative to: then h does not count.
 */
#include "solver/partials.h"

#include "base/arithmetic.h"

#include <math.h>
#include <string.h>

static void add_solid(const ambulo__stationary *s, const ambulo__table_row *row,
                      const ambulo__solid *solid, double pull, ambulo__partials *partials) {
  const ambulo_problem *p = s->problem;
  const ambulo_workspace *w = s->workspace;
  double size = sqrt(solid->distance * solid->distance + ambulo__solid_excess(solid));
  double by_margin = -pull * solid->distance / size, by_place[2][3];
  partials->duration +=
      by_margin * ambulo__passing_allowance(&p->definition) / p->definition.duration;
  if (solid->about < 0) {
    partials->collision_margin += by_margin;
    return;
  }
  const double *axes[] = {p->model->forward, p->model->left, p->model->up};
  const double *y = w->channel + ambulo__lane_index(row->node, w->channel_count, 0);
  partials->obstacle_margin[solid->about] += by_margin;
  ambulo__solid_by_place(solid, y, AMBULO__LANES, by_place);
  for (int k = 0; k < 6; k++)
    partials->obstacle_place[6 * solid->about + k] +=
        pull * ambulo__dot(by_place[k / 3], axes[k % 3]);
  for (int end = 0; end < 2; end++)
    partials->ground_height += pull * ambulo__dot(by_place[end], axes[2]);
}

/* the reach that a row belongs to, rows of one stand one after the other; its axis from the detail
 */
static void add_reach(const ambulo_problem *p, const ambulo__table_row *row, int reach, double pull,
                      ambulo__partials *partials) {
  int axis = row->detail[0] == 'f' ? 0 : row->detail[0] == 'l' ? 1 : 2;
  int is_upper = row->relation == AMBULO_NOT_NEGATIVE && strstr(row->detail, "upper") != NULL;
  double by_place = is_upper ? pull : -pull;
  partials->reach_place[3 * reach + axis] += by_place;
  if (axis == 2 && !p->definition.reaches[reach].is_relative) partials->ground_height += by_place;
  if (row->relation == AMBULO_NOT_NEGATIVE) partials->reach_tolerance[reach] += pull;
}

/* how many rows a reach has: of each of its nodes a pair along each axis, or an equation */
static int rows_of_reach(const ambulo_problem *p, int reach) {
  const ambulo_reach *r = &p->definition.reaches[reach];
  int nodes = 0;
  for (int k = 0; k < p->nodes; k++)
    nodes += p->times[k] >= r->from - AMBULO__INSTANT && p->times[k] <= r->to + AMBULO__INSTANT;
  return nodes * (r->tolerance > 0.0 ? 6 : 3);
}

/* (S.19) of margins, places and tolerances */
void ambulo__partials_of_bodies(const ambulo__stationary *s, ambulo__partials *partials) {
  const ambulo_problem *p = s->problem;
  int reach = -1, left = 0;
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    const ambulo__solid *solid = ambulo__row_solid_of(&p->table, row);
    double pull = -s->multiplier[r];
    if (solid && pull != 0.0) add_solid(s, row, solid, pull, partials);
    if (row->kind != AMBULO__KIND_REACH) continue;
    while (left == 0) left = rows_of_reach(p, ++reach);
    left--;
    add_reach(p, row, reach, pull, partials);
  }
}
