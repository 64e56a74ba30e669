/* contact/step_edge.c - see step_edge.h.
 *
 * With e the horizontal unit vector from one foothold of the foot to its next one, footholds at
 * x = e . p and heights z, L the length of the flat foot from heel to tip, and the step of the
 * other foot, which stands, in between where its height is:
 *
 *     edge between two heights    x = (max x of those behind + L + min x of those ahead) / 2
 *                                 z = the higher one                                       m
 *     plane over the edges        u = unit(n - s e),  s = (z_to - z_from) / (x_to - x_from)
 *                                 u . r = max over the edges of (n - s e) . r / |n - s e|   m
 */
#include "contact/step_edge.h"

#include "contact/foot_outline.h"

#include <math.h>

/* of the way up: shares of the time in the air at which its foot comes over the first edge and past
 * the last one; a foot that goes down is there at 1 less these */
static const double first_edge = 0.38, last_edge = 0.56;

enum { MOST = 3 }; /* footholds on the way: those of the foot, that of the other one */

static const double shortest_way =
    0.05; /* m forward, below which a foot goes up or down on the spot */
static const double same_height = 1e-3; /* m */
static const double same_place = 1e-9;  /* m: rounding */

typedef struct way {
  int count;
  double x[MOST], z[MOST];
} way;

static int is_horizontal(const ambulo_contact *c) {
  return c->normal[0] == 0.0 && c->normal[1] == 0.0;
}

/* of two along forward and left */
static double along(const double direction[2], const double place[3]) {
  return direction[0] * place[0] + direction[1] * place[1];
}

static const ambulo_contact *add_other_foot(const ambulo_problem_definition *d, int foot,
                                            double time, const double direction[2], way *w) {
  const ambulo_contact *c = d->model->feet[foot].mirror >= 0 && d->model->feet[foot].mirror != foot
                                ? ambulo__contact_of(d, d->model->feet[foot].mirror, time)
                                : NULL;
  double low = fmin(w->z[0], w->z[1]), high = fmax(w->z[0], w->z[1]);
  if (!c || !is_horizontal(c) || c->place[2] < low - same_height ||
      c->place[2] > high + same_height)
    return NULL;
  w->x[w->count] = along(direction, c->place);
  w->z[w->count++] = c->place[2];
  return c;
}

/* foothold i is the nearest one so far, or as near as that */
static void approach(ambulo__step_edge *edge, double nearness, int i, double *nearest, int *which) {
  edge->unsure |= fabs(nearness - *nearest) <= same_place;
  if (!(nearness > *nearest)) return;
  *nearest = nearness;
  *which = i;
}

/* the edge between the footholds up to `low` and those from `high` on */
static ambulo__step_edge edge_between(const way *w, double low, double high, double length) {
  int climbs = w->z[1] > w->z[0];
  double behind = -INFINITY, beyond = -INFINITY;
  ambulo__step_edge edge = {.z = high};
  for (int i = 0; i < w->count; i++) {
    int is_low = w->z[i] <= low + same_height, is_high = w->z[i] >= high - same_height;
    if (climbs ? is_low : is_high) approach(&edge, w->x[i], i, &behind, &edge.behind);
    if (climbs ? is_high : is_low) approach(&edge, -w->x[i], i, &beyond, &edge.beyond);
  }
  while (w->z[edge.on] != high) edge.on++;
  edge.x = ambulo__riser_between(behind, length, -beyond);
  return edge;
}

static void set_plane(const ambulo_model *m, double slope, ambulo__step_edges *edges) {
  double size = sqrt(1.0 + slope * slope);
  for (int i = 0; i < 3; i++) edges->above[i] = (m->up[i] - slope * edges->ahead[i]) / size;
}

static void add_edge(ambulo__step_edge edge, double ground, double slope,
                     ambulo__step_edges *edges) {
  edge.z += ground;
  double height = (edge.z - slope * edge.x) / sqrt(1.0 + slope * slope);
  edges->even = edges->count > 0 && fabs(height - edges->height) <= same_place;
  if (edges->count == 0 || height > edges->height) {
    edges->height = height;
    edges->highest = edges->count;
  }
  edges->edge[edges->count++] = edge;
}

double ambulo__step_edge_time(ambulo__span air, const ambulo_contact *from,
                              const ambulo_contact *to, int last) {
  int climbs = to->place[2] > from->place[2];
  double share = climbs ? (last ? last_edge : first_edge) : 1.0 - (last ? first_edge : last_edge);
  return air.from + share * (air.to - air.from);
}

ambulo__step_edges ambulo__step_edges_between(const ambulo_problem_definition *d, int foot,
                                              double time, const ambulo_contact *from,
                                              const ambulo_contact *to) {
  ambulo__step_edges edges = {.count = 0};
  double step[2] = {to->place[0] - from->place[0], to->place[1] - from->place[1]};
  double run = hypot(step[0], step[1]), rise = to->place[2] - from->place[2];
  if (run < shortest_way || fabs(rise) <= same_height || !is_horizontal(from) || !is_horizontal(to))
    return edges;
  double direction[2] = {step[0] / run, step[1] / run}, slope = rise / run;
  double length = ambulo__foot_reach(d->model, foot);
  way w = {.count = 2,
           .x = {along(direction, from->place), along(direction, to->place)},
           .z = {from->place[2], to->place[2]}};
  edges.other = add_other_foot(d, foot, time, direction, &w);
  double low = fmin(w.z[0], w.z[1]), high = fmax(w.z[0], w.z[1]), middle = w.z[w.count - 1];
  for (int i = 0; i < 3; i++)
    edges.ahead[i] = direction[0] * d->model->forward[i] + direction[1] * d->model->left[i];
  set_plane(d->model, slope, &edges);
  if (w.count == MOST && middle > low + same_height && middle < high - same_height) {
    add_edge(edge_between(&w, low, middle, length), d->ground_height, slope, &edges);
    add_edge(edge_between(&w, middle, high, length), d->ground_height, slope, &edges);
  } else {
    add_edge(edge_between(&w, low, high, length), d->ground_height, slope, &edges);
  }
  edges.riser = edges.edge[0].x;
  return edges;
}
