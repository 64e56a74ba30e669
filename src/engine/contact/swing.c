/* contact/swing.c - see swing.h. */
#include "contact/swing.h"

#include "base/arithmetic.h"
#include "contact/contacts.h"
#include "contact/foot.h"
#include "model/model.h"

#include <math.h>

int ambulo__swing_contacts(const ambulo_problem_definition *d, int foot, double time,
                           ambulo_contact *from, ambulo_contact *to) {
  int last = ambulo__image_periods(d), has_from = 0, has_to = 0;
  for (int i = 0; i < d->contact_count; i++) {
    for (int period = -last; period <= last; period++) {
      ambulo_contact image = ambulo__contact_image(d, i, period);
      if (image.foot != foot) continue;
      if (image.to <= time + AMBULO__INSTANT && (!has_from || image.to > from->to)) {
        *from = image;
        has_from = 1;
      } else if (image.from >= time - AMBULO__INSTANT && (!has_to || image.from < to->from)) {
        *to = image;
        has_to = 1;
      }
    }
  }
  if (!has_from && has_to) *from = *to;
  if (!has_to && has_from) *to = *from;
  return has_from || has_to;
}

int ambulo__swing_source(const ambulo_problem_definition *d, const ambulo_contact *image,
                         int *period) {
  int last = ambulo__image_periods(d);
  for (int i = 0; i < d->contact_count; i++) {
    for (*period = -last; *period <= last; (*period)++) {
      ambulo__span span = ambulo__image_span(d, i, *period);
      if (ambulo__image_effector(d, i, *period) == image->foot && span.from == image->from &&
          span.to == image->to)
        return i;
    }
  }
  return -1;
}

ambulo__contact_frame ambulo__surface_below(const ambulo_problem_definition *d, int foot,
                                            double time) {
  ambulo_contact from = {.foot = foot}, to = from;
  const ambulo_contact *contact = ambulo__contact_of(d, foot, time);
  if (contact) return ambulo__contact_frame_of(d, contact);
  (void)ambulo__swing_contacts(d, foot, time, &from, &to);
  return ambulo__contact_frame_of(d, to.place[2] < from.place[2] ? &to : &from);
}

/*
 * With e the horizontal unit vector from one foothold of the foot to its next one, footholds at
 * x = e . p and heights z, L the length of the flat foot from heel to tip, and the step of the
 * other foot, which stands, in between where its height is:
 *
 *     edge between two heights    x = (max x of those behind + L + min x of those ahead) / 2
 *                                 z = the higher one                                       m
 *     plane over the edges        u = unit(n - s e),  s = (z_to - z_from) / (x_to - x_from)
 *                                 u . r = max over the edges of (n - s e) . r / |n - s e|   m
 */

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

/* the links from the foot to the first one that another foot hangs on too, not included */
static int is_shared(const ambulo_model *model, int link) {
  int feet = 0;
  for (int f = 0; f < model->foot_count; f++) {
    int i = model->points[model->feet[f].heel_center].link;
    while (i >= 0 && i != link) i = model->links[i].parent;
    feet += i == link;
  }
  return feet > 1;
}

/* straight: sqrt(a^2 + d^2) of each link; d of the uppermost only moves the joint along its axis */
static double leg_length(const ambulo_model *model, int foot) {
  const ambulo_point *heel = &model->points[model->feet[foot].heel_center];
  const double *p = heel->position;
  double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  for (int i = heel->link; i >= 0 && !is_shared(model, i); i = model->links[i].parent) {
    const ambulo_link *link = &model->links[i];
    int first = link->parent < 0 || is_shared(model, link->parent);
    if (link->type == AMBULO_PRISMATIC) return 0.0; /* as long as it likes */
    length += first ? fabs(link->a) : hypot(link->a, link->d);
  }
  return length;
}

/* along forward, of feet that are down together or hand over */
static double longest_step(const ambulo_problem_definition *d) {
  double longest = 0.0;
  for (int i = 0; i < d->contact_count; i++) {
    for (int j = 0; j < i; j++) {
      const ambulo_contact *a = &d->contacts[i], *b = &d->contacts[j];
      if (a->foot < 0 || b->foot < 0 || a->foot == b->foot ||
          fmin(a->to, b->to) < fmax(a->from, b->from) - AMBULO__INSTANT)
        continue;
      longest = fmax(longest, fabs(a->place[0] - b->place[0]));
    }
  }
  return longest;
}

ambulo__task ambulo__task_of(const ambulo_problem_definition *d) {
  const ambulo_model *model = d->model;
  ambulo__task task = {0};
  double along = 0.0, against = 0.0;
  for (int f = 0; f < model->foot_count; f++) task.leg = fmax(task.leg, leg_length(model, f));
  if (model->foot_count < 2 || d->contact_count == 0 || !(task.leg > 0.0)) return (ambulo__task){0};
  for (int k = 0; k < 3; k++) {
    along -= model->gravity[k] * model->forward[k];
    against -= model->gravity[k] * model->up[k];
  }
  task.is_gait = 1;
  task.gravity = hypot(along, against);
  task.step = longest_step(d);
  if (d->ends == AMBULO_ENDS_FREE || !(task.gravity > 0.0)) return task;
  task.speed = fabs(d->travel) / d->duration;
  task.froude = task.speed * task.speed / (task.gravity * task.leg);
  task.grade = along / against;
  if (task.speed > 0.0) task.step_time = task.step / task.speed;
  return task;
}
