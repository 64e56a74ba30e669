/* solver/force_rows.c - where the ground's force may act and how large it may be
 * (contact/zmp.c).
 *
 * With (M, F) the root wrench, W = m g, phi = n.F / W, z the zero-moment point, a side (a, b), k:
 *
 *     zmp             c = [a (n.F z_f) + b (n.F z_l) - k n.F] / W      dc/dk = -phi
 *                     n.F z holds h F: dc/dh = (a f + b l) . F / W
 *     support side    k = n_s . v + margin: support_side.c;            dc/dmargin = -phi
 *     normal force    c = phi - least                                  dc/dleast = -1
 *
 * and where contacts share the load sharing_rows.c. All but their constants are measured in W: dc/d
 * ln m = -(c - constant).
 */
#include "solver/partials.h"
#include "base/arithmetic.h"

#include "contact/flight.h"
#include "model/neutral_pose.h"

#include <math.h>

typedef struct force_row {
  const ambulo__stationary *s;
  const ambulo__foot_outline *outlines;
  const ambulo__table_row *row;
  double pull, weight; /* -lambda; m g, N */
} force_row;

/* the side that a row of zmp.c stands for: its coefficients of the moment are (b f - a l) / W */
static ambulo__support_row side_of(const force_row *p) {
  const ambulo_problem *problem = p->s->problem;
  const ambulo_model *model = problem->model;
  int node = p->row->node, moment = ambulo__channel_moment(&problem->channels, 0);
  int force = ambulo__channel_force(&problem->channels, 0);
  double coefficient[3] = {0.0, 0.0, 0.0}, h = problem->definition.ground_height;
  for (int t = 0; t < p->row->term_count; t++) {
    const ambulo__row_term *term = &problem->table.terms[p->row->first_term + t];
    int axis = term->channel - moment;
    if (axis >= 0 && axis < 3) coefficient[axis] = term->coefficient * p->weight;
  }
  double along[3] = {0.0, 0.0, 0.0}; /* f.F, l.F, n.F */
  const double *axes[3] = {model->forward, model->left, model->up};
  for (int i = 0; i < 3; i++)
    along[i] = ambulo__stationary_along(p->s, node, force, axes[i]) / p->weight;
  ambulo__support_row side = {
      .node = node,
      .before = p->row->before,
      .normal = {-ambulo__dot(coefficient, model->left), ambulo__dot(coefficient, model->forward)},
      .force = along[2]};
  side.moment[0] =
      h * along[0] - ambulo__stationary_along(p->s, node, moment, model->left) / p->weight;
  side.moment[1] =
      h * along[1] + ambulo__stationary_along(p->s, node, moment, model->forward) / p->weight;
  return side;
}

static void add_height(const force_row *p, const ambulo__support_row *side,
                       ambulo__partials *partials) {
  const ambulo_problem *problem = p->s->problem;
  int force = ambulo__channel_force(&problem->channels, 0);
  const double *axes[2] = {problem->model->forward, problem->model->left};
  for (int i = 0; i < 2; i++)
    partials->ground_height += p->pull * side->normal[i] / p->weight *
                               ambulo__stationary_along(p->s, side->node, force, axes[i]);
}

static void add_zmp(const force_row *p, int planar, ambulo__partials *partials) {
  ambulo__support_row side = side_of(p);
  side.turns = p->s->problem->definition.support == AMBULO_SUPPORT_HULL && !planar;
  partials->support_margin -= p->pull * side.force;
  add_height(p, &side, partials);
  ambulo__support_side(p->s, p->outlines, &side, p->pull, partials);
}

/* a row of contact/sharing.c */
static int is_of_contact(const force_row *p) {
  const ambulo_problem *problem = p->s->problem;
  int first = ambulo__channel_foot_force(&problem->channels, 0, 0);
  int kind = p->row->kind;
  int of_force = kind == AMBULO__KIND_NORMAL_FORCE || kind == AMBULO__KIND_FRICTION ||
                 kind == AMBULO__KIND_PRESSURE || kind == AMBULO__KIND_FREE_MOMENT;
  return of_force && problem->channels.slots && ambulo__sharing_channel(problem, p->row) >= first;
}

/* a row of contact/flight.c: c = b +- (...) / W, b = e or e h */
static void add_flight(const force_row *p, ambulo__partials *partials) {
  const ambulo_problem *problem = p->s->problem;
  const ambulo__curved *spin = ambulo__row_curved_of(&problem->table, p->row);
  double bound = spin ? spin->of.spin.bound : p->row->constant;
  int r = (int)(p->row - problem->table.rows);
  partials->reaction.flight_tolerance +=
      p->pull * bound / problem->definition.ground_reaction.flight_tolerance;
  partials->log_mass -= p->pull * (p->s->workspace->row_value[r] - bound);
}

/* (S.5) -phi, n.F / W, 1 */
static void add_row(const force_row *p, int planar, ambulo__partials *partials) {
  int r = (int)(p->row - p->s->problem->table.rows);
  int of_forces = 1;
  if (is_of_contact(p)) {
    ambulo__partials_of_sharing(p->s, p->outlines, p->row, p->pull, p->weight, partials);
    const ambulo__arc *arc = ambulo__row_arc_of(&p->s->problem->table, p->row);
    double constant = arc ? arc->slack : p->row->constant;
    partials->log_mass -= p->pull * (p->s->workspace->row_value[r] - constant);
    return;
  }
  switch ((ambulo__row_kind)p->row->kind) {
  case AMBULO__KIND_ZMP:
    add_zmp(p, planar, partials);
    break;
  case AMBULO__KIND_NORMAL_FORCE:
    partials->minimum_force -= p->pull;
    break;
  case AMBULO__KIND_FLIGHT:
    add_flight(p, partials);
    of_forces = 0;
    break;
  default:
    of_forces = 0;
  }
  if (of_forces) partials->log_mass -= p->pull * (p->s->workspace->row_value[r] - p->row->constant);
}

ambulo_status ambulo__partials_of_forces(const ambulo__stationary *s, ambulo__partials *partials) {
  const ambulo_problem *problem = s->problem;
  const ambulo_model *model = problem->model;
  ambulo__foot_outline *outlines = ambulo__foot_outlines(model, &s->workspace->allocator);
  if (!outlines) return AMBULO_E_MEMORY;
  int planar = !ambulo__model_moves_sideways(model);
  force_row p = {.s = s, .outlines = outlines, .weight = ambulo__model_weight(model)};
  for (int r = 0; r < problem->rows; r++) {
    p.row = &problem->table.rows[r];
    p.pull = -s->multiplier[r];
    if (p.pull != 0.0) add_row(&p, planar, partials);
  }
  ambulo__free(&s->workspace->allocator, outlines);
  return AMBULO_OK;
}
