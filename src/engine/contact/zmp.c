/* contact/zmp.c - the zero-moment point stays inside the support region (Eq. 17').
 *
 * On the plane n . r = h the ZMP is p = (n x M + h F) / (n . F)              (16')
 * with (M, F) the root wrench about the world origin. With forward f, left l = n x f,
 * f x n = -l and l x n = f its coordinates times n . F are
 *
 *     (n.F) p_f = -l . M + h f . F,      (n.F) p_l = f . M + h l . F.
 *
 * A side (a, b), c of the region asks a p_f + b p_l - c >= 0. Multiplied by n . F / mg,
 * which is positive for a body that presses on the ground, this is linear in (M, F):
 *
 *     [ a (-l.M + h f.F) + b (f.M + h l.F) - c n.F ] / mg >= 0,                 m
 *
 * exact distance to the side when n . F = mg. Sides of a polygon with vertices v_k:
 * (a, b) = n x (v_k+1 - v_k) / |v_k+1 - v_k|, c = (a, b) . v_k + margin.
 * The sign of n . F is held by its own row: n.F / mg - minimum_force >= 0.
 */
#include "contact/bounded.h"
#include "model/neutral_pose.h"
#include "contact/support_polygon.h"

#include <math.h>

/* a region smaller than this (m^2, planar: m) is empty */
static const double smallest_region = 1e-9;

/* (17') one side of the support region, without the division by n.F */
static void side_row(const ambulo__gait_context *context, int node, const ambulo__half_plane *side,
                     ambulo__row_table *table) {
  const ambulo_model *model = context->model;
  double a = side->normal[0], b = side->normal[1], c = side->offset;
  double h = context->definition->ground_height, mg = ambulo__model_weight(model);
  ambulo__row_begin(table, AMBULO__KIND_ZMP, "support", side->detail, AMBULO__METRES,
                    AMBULO_NOT_NEGATIVE, node, context->times[node], 0.0);
  for (int i = 0; i < 3; i++) {
    double f = model->forward[i], l = model->left[i], n = model->up[i];
    ambulo__row_term_add(table, node, ambulo__channel_moment(&context->channels, i),
                         (b * f - a * l) / mg);
    ambulo__row_term_add(table, node, ambulo__channel_force(&context->channels, i),
                         (h * (a * f + b * l) - c * n) / mg);
  }
}

static void force_row(const ambulo__gait_context *context, int node, ambulo__row_table *table) {
  double mg = ambulo__model_weight(context->model);
  ambulo__row_begin(table, AMBULO__KIND_NORMAL_FORCE, "ground", "vertical", AMBULO__BODY_WEIGHTS,
                    AMBULO_NOT_NEGATIVE, node, context->times[node],
                    -context->definition->minimum_force);
  for (int i = 0; i < 3; i++) {
    ambulo__row_term_add(table, node, ambulo__channel_force(&context->channels, i),
                         context->model->up[i] / mg);
  }
}

static const char *const mode_words[] = {[AMBULO_CONTACT_HEEL] = "on its heel",
                                         [AMBULO_CONTACT_FLAT] = "flat",
                                         [AMBULO_CONTACT_TOE] = "on its toes"};

static ambulo_status refuse_empty(const ambulo__gait_context *context, int node, double size,
                                  int planar, ambulo_diagnostics *diagnostics) {
  const ambulo_problem_definition *definition = context->definition;
  const int *active = context->active + node * context->model->foot_count;
  const char *foot = "no foot", *mode = "loaded";
  int loaded = 0;
  for (int i = 0; i < context->model->foot_count; i++) {
    if (active[i] < 0) continue;
    foot = context->model->feet[i].name;
    mode = mode_words[definition->contacts[active[i]].mode];
    loaded++;
  }
  if (loaded > 1) {
    foot = "several feet";
    mode = "down";
  }
  const char *hint = definition->support == AMBULO_SUPPORT_HULL
                         ? "the hull of the corners in contact is a line while only heels or toes "
                           "of one foot touch; 'zmp: box' counts the whole foot"
                         : "lower constraints.zmp_margin";
  return ambulo__error(diagnostics, AMBULO_E_PROBLEM, ambulo__nowhere, hint,
                       "constraints.zmp: the support polygon is empty at t = %.6g s (%s %s, margin "
                       "%.6g m, %s %.3g %s); expected a positive %s",
                       context->times[node], foot, mode, definition->support_margin,
                       planar ? "length" : "area", size, planar ? "m" : "m^2",
                       planar ? "length" : "area");
}

/* the region of the feet loaded at a node, refused when it is empty */
static ambulo_status region_at(const ambulo__gait_context *context, const int *active, int node,
                               int planar, ambulo__support_region *region,
                               ambulo_diagnostics *diagnostics) {
  ambulo_status status = ambulo__support_region_of(context->definition, active, planar, region);
  if (status) {
    return ambulo__error(
        diagnostics, status, ambulo__nowhere, NULL,
        "constraints.zmp: too many foot corners at t = %.6g s; expected at most %d",
        context->times[node], AMBULO__POLYGON_CAPACITY - 1);
  }
  if (region->size >= smallest_region) return AMBULO_OK;
  return refuse_empty(context, node, region->size, planar, diagnostics);
}

/* the same contacts as one node before: the region, a constant of the phase, is kept */
static int same_contacts(const ambulo__gait_context *context, int node) {
  int feet = context->model->foot_count;
  const int *active = context->active + node * feet;
  if (node == 0) return 0;
  for (int foot = 0; foot < feet; foot++) {
    if (active[foot] != active[foot - feet]) return 0;
  }
  return 1;
}

/* what the feet did just before a node, where the zero-moment point has to be under that as well;
 * NULL: nowhere else than at the node */
static const int *feet_before(const ambulo__gait_context *context, int node) {
  int differs = 0, feet = context->model->foot_count;
  for (int foot = 0; foot < feet; foot++) {
    ambulo__phases_of_foot phases = ambulo__phases_at(context, AMBULO__OF_FORCES, node, foot);
    int last = node >= ambulo__distinct_nodes(context, AMBULO__OF_FORCES);
    differs |= phases.count > (last ? 0 : 1);
  }
  return differs ? context->before + node * feet : NULL;
}

static void region_rows(const ambulo__gait_context *context, int node, int before,
                        const ambulo__support_region *region, ambulo__row_table *table) {
  table->before = before;
  for (int k = 0; k < region->count; k++) side_row(context, node, &region->side[k], table);
  table->before = 0;
}

ambulo_status ambulo__zmp_rows(const ambulo__gait_context *context, ambulo__row_table *table,
                               ambulo_diagnostics *diagnostics) {
  int planar = !ambulo__model_moves_sideways(context->model);
  ambulo__support_region region = {.count = 0}, earlier;
  int feet = context->model->foot_count;
  int distinct = ambulo__distinct_nodes(context, AMBULO__OF_FORCES);
  for (int node = 0; node < context->nodes; node++) {
    if (context->definition->support != AMBULO_SUPPORT_OFF) {
      ambulo_status status = AMBULO_OK;
      const int *before = feet_before(context, node), *active = context->active + node * feet;
      if (before) status = region_at(context, before, node, planar, &earlier, diagnostics);
      if (!status && node < distinct && !same_contacts(context, node))
        status = region_at(context, active, node, planar, &region, diagnostics);
      if (status) return status;
      if (before) region_rows(context, node, 1, &earlier, table);
      if (node < distinct) region_rows(context, node, 0, &region, table);
    }
    if (node < distinct && context->definition->minimum_force >= 0.0)
      force_row(context, node, table);
  }
  return table->status;
}
