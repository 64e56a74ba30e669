/* contact/reaction.c - what the ground can supply ("pressure", "friction", "free_moment").
 *
 * Root wrench (M, F) about the world origin, F_n = n.F, W = m g. All rows are linear in the
 * channels; none divides by F_n.
 *
 * Centre of pressure of loaded foot j: the ZMP shifted by s_j = a_1 D (foot 0) or -a_0 D (foot 1),
 * contact/loading.h. A side `normal . c_j >= offset` of the foot's box is the side
 * `normal . zmp >= offset - normal . s_j` of zmp.c. The box, from the heel centre's foothold, along
 * forward, with L the distance of heel and toe centre:
 *
 *     heel   [b_0, b_1 + roll p]    p from 0 at the strike to 1 when the foot is flat
 *     flat   [b_0, L + b_1]
 *     toe    [L + b_0, L + b_1]     and the width to either side of the track
 *
 * Friction, per direction e = f, l:  mu F_n -+ e.F >= 0, of the total and of each loaded foot; in
 * body weights. Free moment: |T_0 + T_1| <= bound W, in m when divided by W. The sum of the feet's
 * free moments is that of the whole, T = M.F / F_n.
 */
#include "contact/bounded.h"
#include "contact/loading.h"
#include "model/neutral_pose.h"
#include "contact/support_polygon.h"

#include <math.h>

static const double smallest_share = 1e-6;

typedef struct node_context {
  const ambulo__gait_context *context;
  const ambulo__foot_outline *outlines;
  int node, planar;
  double weight; /* m g, N */
  ambulo__load load;
  ambulo__row_table *table;
} node_context;

/* ------------------------------------------------------- centres of pressure */

/* ends of the box along forward, from the heel's foothold */
static void box_of(const node_context *n, const ambulo_contact *contact, double box[2]) {
  const ambulo_problem_definition *d = n->context->definition;
  const ambulo_ground_reaction *r = &d->ground_reaction;
  double length = n->outlines[contact->foot].length, time = n->context->times[n->node];
  if (contact->mode == AMBULO_CONTACT_FLAT) {
    box[0] = r->flat_pressure[0];
    box[1] = length + r->flat_pressure[1];
  } else if (contact->mode == AMBULO_CONTACT_TOE) {
    box[0] = length + r->toe_pressure[0];
    box[1] = length + r->toe_pressure[1];
  } else {
    box[0] = r->heel_pressure[0];
    box[1] = r->heel_pressure[1] + r->heel_roll * ambulo__heel_roll_at(d, contact, time).part;
  }
}

static void contact_pressure_rows(const node_context *n, int foot, const ambulo_contact *contact) {
  const ambulo__gait_context *context = n->context;
  double shift[2], box[2], factor = foot == 0 ? n->load.share[1] : -n->load.share[0];
  for (int i = 0; i < 2; i++) shift[i] = factor * n->load.apart[i];
  box_of(n, contact, box);
  double x = contact->place[0] - shift[0], y = contact->place[1] - shift[1];
  double width = context->definition->ground_reaction.pressure_width;
  ambulo__half_plane sides[4] = {{{1.0, 0.0}, x + box[0], "back"},
                                 {{-1.0, 0.0}, -(x + box[1]), "front"},
                                 {{0.0, 1.0}, y - width, "right"},
                                 {{0.0, -1.0}, -(y + width), "left"}};
  const char *name = context->model->feet[foot].name;
  for (int k = 0; k < (n->planar ? 2 : 4); k++)
    ambulo__zmp_side_row(context, n->node, AMBULO__KIND_PRESSURE, name, &sides[k], n->table);
}

static void pressure_rows(const node_context *n, int foot) {
  ambulo__phases_of_foot phases = ambulo__phases_at(n->context, AMBULO__OF_FORCES, n->node, foot);
  if (n->load.share[foot] <= smallest_share) return;
  for (int i = 0; i < phases.count; i++) {
    int contact = phases.contact[i];
    n->table->before = ambulo__phase_is_before(n->context, i);
    if (contact >= 0) contact_pressure_rows(n, foot, &n->context->definition->contacts[contact]);
  }
  n->table->before = 0;
}

/* ------------------------------------------------------------------- friction */

static void friction_bounds(const node_context *n, int first, const char *subject,
                            const double direction[3], const char *lower, const char *upper) {
  const ambulo_model *model = n->context->model;
  double mu = n->context->definition->ground_reaction.friction;
  ambulo__bounded_name name = {AMBULO__KIND_FRICTION, subject, lower, upper, AMBULO__BODY_WEIGHTS};
  for (int sign = -1; sign <= 1; sign += 2) {
    ambulo__linear form = {.count = 0};
    ambulo__linear_add(&form, first, model->up, mu / n->weight);
    ambulo__linear_add(&form, first, direction, -sign / n->weight);
    ambulo__bounded_name one = name;
    one.lower = sign > 0 ? upper : lower;
    ambulo__bounded_rows(n->context, n->node, &one, &form, 0.0, INFINITY, n->table);
  }
}

static void friction_rows(const node_context *n, int first, const char *subject) {
  const ambulo_model *model = n->context->model;
  friction_bounds(n, first, subject, model->forward, "backward", "forward");
  if (!n->planar) friction_bounds(n, first, subject, model->left, "to the right", "to the left");
}

/* ---------------------------------------------------------------- free moment */

static void free_moment_rows(const node_context *n) {
  double bound = n->context->definition->ground_reaction.free_moment;
  ambulo__linear form = {.count = 2};
  for (int foot = 0; foot < 2; foot++) {
    form.channel[foot] = ambulo__channel_free_moment(&n->context->channels, foot);
    form.coefficient[foot] = 1.0 / n->weight;
  }
  ambulo__bounded_name name = {AMBULO__KIND_FREE_MOMENT, "ground", "to the right", "to the left",
                               AMBULO__METRES};
  ambulo__bounded_rows(n->context, n->node, &name, &form, -bound, bound, n->table);
}

static void node_rows(const node_context *n) {
  const ambulo__gait_context *context = n->context;
  const ambulo_ground_reaction *r = &context->definition->ground_reaction;
  for (int foot = 0; r->pressure && foot < 2; foot++) pressure_rows(n, foot);
  if (n->node >= ambulo__distinct_nodes(context, AMBULO__OF_FORCES)) return;
  if (r->friction >= 0.0) {
    friction_rows(n, ambulo__channel_force(&context->channels, 0), "total");
    for (int foot = 0; foot < 2; foot++) {
      double share = n->load.share[foot];
      if (share <= smallest_share || share >= 1.0) continue;
      friction_rows(n, ambulo__channel_foot_force(&context->channels, foot, 0),
                    context->model->feet[foot].name);
    }
  }
  if (r->free_moment >= 0.0 && !n->planar) free_moment_rows(n);
}

/* (W.7) boxes of pressure, friction, free moment */
void ambulo__reaction_rows(const ambulo__gait_context *context, ambulo__row_table *table) {
  const ambulo_model *model = context->model;
  ambulo__foot_outline *outlines = ambulo__foot_outlines(model, &table->allocator);
  if (!outlines) {
    table->status = AMBULO_E_MEMORY;
    return;
  }
  node_context n = {.context = context, .outlines = outlines, .table = table};
  n.planar = !ambulo__model_moves_sideways(model);
  n.weight = ambulo__model_weight(model);
  for (n.node = 0; n.node < context->nodes; n.node++) {
    n.load = ambulo__load_at(context->definition, outlines, context->times[n.node]);
    node_rows(&n);
  }
  ambulo__free(&table->allocator, outlines);
}
