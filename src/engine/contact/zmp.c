/* contact/zmp.c - support regions from the places of loaded feet.
 *
 * Corners stand at place + outline (contact/contacts.h): constants of a phase, because
 * the foot-strike rows hold the feet there. The margin moves every side inwards.
 */
#include "contact/row_families.h"

#include "contact/contacts.h"
#include "contact/rows.h"
#include "model/neutral_pose.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* points closer than this to a line are on it, m^2 */
static const double flat_area = 1e-12;

/* twice the area of the triangle o a b; positive when it turns left */
static double turn(const double o[2], const double a[2], const double b[2]) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

static int compare_points(const void *left, const void *right) {
  const double *a = left, *b = right;
  if (a[0] != b[0]) return a[0] < b[0] ? -1 : 1;
  if (a[1] != b[1]) return a[1] < b[1] ? -1 : 1;
  return 0;
}

static void push(ambulo__polygon *polygon, int keep, const double p[2]) {
  while (polygon->count >= keep + 2 && turn(polygon->vertex[polygon->count - 2],
                                            polygon->vertex[polygon->count - 1], p) <= flat_area) {
    polygon->count--;
  }
  polygon->vertex[polygon->count][0] = p[0];
  polygon->vertex[polygon->count][1] = p[1];
  polygon->count++;
}

void ambulo__convex_hull(double (*points)[2], int count, ambulo__polygon *polygon) {
  polygon->count = 0;
  if (count <= 0) return;
  qsort(points, (size_t)count, sizeof *points, compare_points);
  for (int i = 0; i < count; i++) push(polygon, 0, points[i]);
  int lower = polygon->count;
  for (int i = count - 2; i >= 0; i--) push(polygon, lower - 1, points[i]);
  if (polygon->count > 1) polygon->count--; /* the last point is the first again */
}

double ambulo__polygon_area(const ambulo__polygon *polygon) {
  double twice = 0.0;
  for (int i = 1; i + 1 < polygon->count; i++) {
    twice += turn(polygon->vertex[0], polygon->vertex[i], polygon->vertex[i + 1]);
  }
  return 0.5 * twice;
}

static ambulo__half_plane side_of(const ambulo__polygon *polygon, int k, double margin) {
  const double *v = polygon->vertex[k], *w = polygon->vertex[(k + 1) % polygon->count];
  double length = hypot(w[0] - v[0], w[1] - v[1]);
  ambulo__half_plane side = {.detail = "edge"};
  side.normal[0] = -(w[1] - v[1]) / length;
  side.normal[1] = (w[0] - v[0]) / length;
  side.offset = side.normal[0] * v[0] + side.normal[1] * v[1] + margin;
  return side;
}

/* Keeps the part of `polygon` inside `side` (Sutherland and Hodgman). */
static void clip(ambulo__polygon *polygon, const ambulo__half_plane *side) {
  ambulo__polygon kept = {.count = 0};
  for (int i = 0; i < polygon->count; i++) {
    const double *v = polygon->vertex[i], *w = polygon->vertex[(i + 1) % polygon->count];
    double at_v = side->normal[0] * v[0] + side->normal[1] * v[1] - side->offset;
    double at_w = side->normal[0] * w[0] + side->normal[1] * w[1] - side->offset;
    if (at_v >= 0.0 && kept.count < AMBULO__POLYGON_CAPACITY) {
      memcpy(kept.vertex[kept.count++], v, sizeof kept.vertex[0]);
    }
    if ((at_v < 0.0) != (at_w < 0.0) && kept.count < AMBULO__POLYGON_CAPACITY) {
      double s = at_v / (at_v - at_w);
      kept.vertex[kept.count][0] = v[0] + s * (w[0] - v[0]);
      kept.vertex[kept.count][1] = v[1] + s * (w[1] - v[1]);
      kept.count++;
    }
  }
  *polygon = kept;
}

void ambulo__polygon_inset(const ambulo__polygon *polygon, double margin, ambulo__polygon *inset) {
  *inset = *polygon;
  for (int k = 0; k < polygon->count && inset->count > 0; k++) {
    ambulo__half_plane side = side_of(polygon, k, margin);
    clip(inset, &side);
  }
}

/* Adds the corners of a loaded foot to `count` points; -1 when there are more than a polygon holds.
 */
static int collect_foot(const ambulo_problem_definition *definition, const ambulo_contact *contact,
                        const ambulo__foot_outline *outline, int count, double (*points)[2]) {
  for (int c = 0; c < outline->count; c++) {
    if (definition->support == AMBULO_SUPPORT_HULL &&
        !ambulo__corner_in_contact(contact->mode, outline->is_heel[c])) {
      continue;
    }
    /* a hull may hold one vertex more while it is being closed */
    if (count + 1 >= AMBULO__POLYGON_CAPACITY) return -1;
    const double *corner = outline->place[c];
    points[count][0] = contact->place[0] + corner[0];
    points[count++][1] = contact->place[1] + corner[1];
  }
  return count;
}

static int collect(const ambulo_problem_definition *definition, const int *active,
                   double (*points)[2]) {
  int count = 0;
  for (int foot = 0; foot < definition->model->foot_count && count >= 0; foot++) {
    if (active[foot] < 0) continue;
    ambulo__foot_outline outline = ambulo__foot_outline_of(definition->model, foot);
    count = collect_foot(definition, &definition->contacts[active[foot]], &outline, count, points);
  }
  return count;
}

static void add_side(ambulo__support_region *region, double forward, double left, double bound,
                     const char *detail) {
  ambulo__half_plane side = {{forward, left}, bound, detail};
  region->side[region->count++] = side;
}

/* `axes` 1: forward extent only; 2: also the extent along left */
static void make_box(double (*points)[2], int count, double margin, int axes,
                     ambulo__support_region *region) {
  double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
  for (int i = 0; i < count; i++) {
    for (int axis = 0; axis < 2; axis++) {
      low[axis] = fmin(low[axis], points[i][axis]);
      high[axis] = fmax(high[axis], points[i][axis]);
    }
  }
  add_side(region, 1.0, 0.0, low[0] + margin, "back");
  add_side(region, -1.0, 0.0, -high[0] + margin, "front");
  region->size = fmax(0.0, high[0] - low[0] - 2.0 * margin);
  if (axes < 2) return;
  add_side(region, 0.0, 1.0, low[1] + margin, "right");
  add_side(region, 0.0, -1.0, -high[1] + margin, "left");
  region->size *= fmax(0.0, high[1] - low[1] - 2.0 * margin);
}

ambulo_status ambulo__support_region_of(const ambulo_problem_definition *definition,
                                        const int *active, int planar,
                                        ambulo__support_region *region) {
  double points[AMBULO__POLYGON_CAPACITY][2];
  double margin = definition->support_margin;
  int count = collect(definition, active, points);
  if (count < 0) return AMBULO_E_LIMIT;
  region->count = 0;
  region->size = 0.0;
  if (count == 0) return AMBULO_OK;
  if (planar || definition->support == AMBULO_SUPPORT_BOX) {
    make_box(points, count, margin, planar ? 1 : 2, region);
    return AMBULO_OK;
  }
  ambulo__polygon hull, inset;
  ambulo__convex_hull(points, count, &hull);
  if (hull.count < 3) return AMBULO_OK;
  ambulo__polygon_inset(&hull, margin, &inset);
  for (int k = 0; k < hull.count; k++) region->side[region->count++] = side_of(&hull, k, margin);
  region->size = ambulo__polygon_area(&inset);
  return AMBULO_OK;
}

/* the zero-moment point stays inside the support region (Eq. 17').
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

static ambulo_status refuse_empty(const ambulo__gait_context *context, int node, double size,
                                  int planar, ambulo_diagnostics *diagnostics) {
  const ambulo_problem_definition *definition = context->definition;
  const int *active = context->active + node * context->model->foot_count;
  const char *foot = "no foot", *mode = "loaded";
  int loaded = 0;
  for (int i = 0; i < context->model->foot_count; i++) {
    if (active[i] < 0) continue;
    foot = context->model->feet[i].name;
    mode = ambulo__mode_of(definition->contacts[active[i]].mode)->posture;
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
