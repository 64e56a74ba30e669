/* solver/bound_rows.c - limits, tubes, and what is asked of the ends.
 *
 *     limit     y - lo >= 0, hi - y >= 0             dc/dlo = -1, dc/dhi = 1
 *     mirrored  lo, hi = s (limit - shift) of m       dc/dlimit = 1 of its upper one, -1 of its
 *                                                     lower one, dc/dtravel = +-s shift'_m
 *     tube      (q - r) + w >= 0, (r - q) + w >= 0    dc/dw = 1
 *     ends      D^o q - value = 0                     dc/dvalue = -1
 *               q(T) - .. - shift = 0                 dc/dtravel = -shift'
 *
 * m is the partner, + on the lower side; shift' = a . f, the axis of the root's translation along
 * forward (contact/ends.c), and a . n by the rise. rad, m, per s, N m, N. A limit of a coordinate
 * that is fixed, lo = hi, has no partial: half of it alone cannot move.
 */
#include "solver/partials.h"

#include "contact/bounds.h"
#include "contact/gait.h"

#include <math.h>

/* shift' of coordinate i: ambulo__end_shift is linear in travel and rise */
static double shift_per_travel(const ambulo_problem_definition *definition, int i) {
  ambulo_problem_definition unit = *definition;
  unit.travel = 1.0;
  unit.rise = 0.0;
  return ambulo__end_shift(&unit, i);
}

static double shift_per_rise(const ambulo_problem_definition *definition, int i) {
  ambulo_problem_definition unit = *definition;
  unit.travel = 0.0;
  unit.rise = 1.0;
  return ambulo__end_shift(&unit, i);
}

static int coordinate_of(const ambulo_problem *p, const ambulo__row_term *term) {
  return term->channel % p->coordinates; /* q, qd, tau, and unknowns, are laid out alike */
}

static void add_limit(const ambulo_problem *p, const ambulo__table_row *row, double pull,
                      ambulo__partials *partials) {
  const ambulo_problem_definition *d = &p->definition;
  const ambulo__row_term *term = p->table.terms + row->first_term;
  ambulo_limited what = (ambulo_limited)ambulo__row_kind_entry_of(row->kind)->limited;
  int i = coordinate_of(p, term), is_low = term->coefficient > 0.0;
  if (row->relation == AMBULO_EQUAL) return;
  ambulo__bounds bounds = ambulo__bounds_of(d, i, what);
  const ambulo__bound *bound = is_low ? &bounds.low : &bounds.high;
  partials->limit[2 * (ambulo__limited_place(what) * p->coordinates + bound->owner) +
                  bound->is_upper] += bound->is_upper ? pull : -pull;
  if (bound->later == 0.0 || what != AMBULO_LIMITED_POSITION) return;
  double turned = p->model->coordinates[i].mirror_sign * (is_low ? pull : -pull);
  partials->travel += turned * shift_per_travel(d, bound->owner);
  partials->end_rise += turned * shift_per_rise(d, bound->owner);
}

/* the first tube after number `tube` that has rows at all */
static int next_tube(const ambulo_problem *p, int tube) {
  for (tube++; tube + 1 < p->definition.tube_count; tube++) {
    for (int i = 0; i < p->coordinates; i++)
      if (isfinite(p->definition.tubes[tube].half_width[i])) return tube;
  }
  return tube;
}

static void add_matching(const ambulo_problem *p, const ambulo__table_row *row, double pull,
                         ambulo__partials *partials) {
  const ambulo__row_term *term = p->table.terms + row->first_term;
  if (term->channel >= p->coordinates) return; /* rates do not travel */
  partials->travel -= pull * shift_per_travel(&p->definition, term->channel);
  partials->end_rise -= pull * shift_per_rise(&p->definition, term->channel);
}

/* (S.3) -1, 1, -shift' */
void ambulo__partials_of_bounds(const ambulo__stationary *s, ambulo__partials *partials) {
  const ambulo_problem *p = s->problem;
  int ends = 0, tube = -1, node_before = -1; /* both stand in the table in the definition's order */
  for (int r = 0; r < p->rows; r++) {
    const ambulo__table_row *row = &p->table.rows[r];
    double pull = -s->multiplier[r];
    if (ambulo__row_kind_entry_of(row->kind)->limited != AMBULO__NOT_LIMITED) {
      add_limit(p, row, pull, partials);
    } else if (row->kind == AMBULO__KIND_INITIAL_STATE || row->kind == AMBULO__KIND_FINAL_STATE) {
      partials->end_value[ends++] -= pull;
    } else if (row->kind == AMBULO__KIND_PERIODIC || row->kind == AMBULO__KIND_MIRRORED) {
      add_matching(p, row, pull, partials);
    } else if (row->kind == AMBULO__KIND_TRACKING_TUBE) {
      int i = coordinate_of(p, p->table.terms + row->first_term);
      if (tube < 0 || row->node < node_before) tube = next_tube(p, tube);
      node_before = row->node;
      if (row->relation != AMBULO_EQUAL) partials->half_width[tube * p->coordinates + i] += pull;
    }
  }
}
