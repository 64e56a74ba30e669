/* contact/contacts.c - feet and patches, when they are down, and what is in their way in the air.
 */
#include "contact/schedule.h"

#include "base/arithmetic.h"
#include "base/sized.h"
#include "contact/row_families.h"
#include "model/model.h"
#include "model/neutral_pose.h"

#include <math.h>
#include <string.h>

int ambulo__effector_count(const ambulo_model *model) {
  return model->foot_count + model->patch_count;
}

int ambulo__effector_of(const ambulo_model *model, const ambulo_contact *contact) {
  return contact->foot >= 0 ? contact->foot : model->foot_count + contact->patch;
}

int ambulo__effector_patch(const ambulo_model *model, int effector) {
  return effector < model->foot_count ? -1 : effector - model->foot_count;
}

int ambulo__effector_mirror(const ambulo_model *model, int effector) {
  int patch = ambulo__effector_patch(model, effector);
  return patch < 0 ? model->feet[effector].mirror
                   : model->foot_count + model->patches[patch].mirror;
}

const char *ambulo__effector_kind(const ambulo_model *model, int effector) {
  return effector < model->foot_count ? "foot" : "patch";
}

const char *ambulo__effector_name(const ambulo_model *model, int effector) {
  int patch = ambulo__effector_patch(model, effector);
  return patch < 0 ? model->feet[effector].name : model->patches[patch].name;
}

int ambulo__effector_is_known(const ambulo_model *model, const ambulo_contact *contact) {
  if (ambulo__mode_is_of_patch(contact->mode))
    return contact->foot == -1 && contact->patch >= 0 && contact->patch < model->patch_count;
  return contact->foot >= 0 && contact->foot < model->foot_count;
}

int ambulo__patch_is_used(const ambulo_problem_definition *d, int patch) {
  int mirror = d->ends == AMBULO_ENDS_MIRRORED ? d->model->patches[patch].mirror : patch;
  for (int i = 0; i < d->contact_count; i++) {
    const ambulo_contact *c = &d->contacts[i];
    if (c->foot < 0 && (c->patch == patch || c->patch == mirror)) return 1;
  }
  return 0;
}

int ambulo__holds_patches(const ambulo_problem_definition *d) {
  for (int i = 0; i < d->contact_count; i++)
    if (d->contacts[i].foot < 0) return 1;
  return 0;
}

/* contacts, k periods of the motion later.
 *
 *     from, to + k T,   place + k (travel, 0, rise),   with mirrored ends and odd k of the mirror
 *     foot or patch, with place_l, normal_l and heading of the opposite sign
 *
 * Two periods before and after hold whatever touches the motion: no stance or swing of a gait is
 * longer than a stride.
 */

enum { PERIODS = 2 };

int ambulo__image_periods(const ambulo_problem_definition *d) {
  return d->ends == AMBULO_ENDS_FREE ? 0 : PERIODS;
}

static int is_mirrored(const ambulo_problem_definition *d, int period) {
  return d->ends == AMBULO_ENDS_MIRRORED && period % 2 != 0;
}

int ambulo__image_effector(const ambulo_problem_definition *d, int index, int period) {
  int effector = ambulo__effector_of(d->model, &d->contacts[index]);
  return is_mirrored(d, period) ? ambulo__effector_mirror(d->model, effector) : effector;
}

ambulo__span ambulo__image_span(const ambulo_problem_definition *d, int index, int period) {
  double later = period * d->duration;
  return (ambulo__span){d->contacts[index].from + later, d->contacts[index].to + later, index,
                        index};
}

ambulo_contact ambulo__contact_image(const ambulo_problem_definition *d, int index, int period) {
  ambulo_contact image = d->contacts[index];
  ambulo__span span = ambulo__image_span(d, index, period);
  double side = is_mirrored(d, period) ? -1.0 : 1.0;
  int effector = ambulo__image_effector(d, index, period);
  if (image.foot >= 0) {
    image.foot = effector;
  } else {
    image.patch = ambulo__effector_patch(d->model, effector);
  }
  image.from = span.from;
  image.to = span.to;
  image.place[0] += period * d->travel;
  image.place[1] *= side;
  image.place[2] += period * d->rise;
  image.normal[1] *= side;
  image.heading *= side;
  return image;
}

/* joins one more contact to the span; 0: none touches it from outside */
static int grow(const ambulo_problem_definition *d, int effector, int modes, ambulo__span *span) {
  int last = ambulo__image_periods(d);
  for (int i = 0; i < d->contact_count; i++) {
    if (!(modes & 1 << d->contacts[i].mode)) continue;
    for (int period = -last; period <= last; period++) {
      ambulo__span image = ambulo__image_span(d, i, period);
      int touches =
          image.from <= span->to + AMBULO__INSTANT && image.to >= span->from - AMBULO__INSTANT;
      int reaches =
          image.from < span->from - AMBULO__INSTANT || image.to > span->to + AMBULO__INSTANT;
      if (!touches || !reaches || ambulo__image_effector(d, i, period) != effector) continue;
      if (image.from < span->from) {
        span->from = image.from;
        span->begins = i;
      }
      if (image.to > span->to) {
        span->to = image.to;
        span->ends = i;
      }
      return 1;
    }
  }
  return 0;
}

ambulo__span ambulo__uninterrupted(const ambulo_problem_definition *d, int effector, int modes,
                                   ambulo__span span) {
  while (grow(d, effector, modes, &span)) continue;
  return span;
}

/* which contact holds a foot or patch when, and how long it is down or in the
 * air.
 *
 * Schedules are cut at 0 and T. A motion that repeats goes on beyond both: its contacts are
 * repeated a period earlier and later, of the mirror foot when the ends are mirrored.
 */

int ambulo__contact_holds(const ambulo_contact *contact, double duration, double time) {
  if (time < contact->from - AMBULO__INSTANT) return 0;
  if (time < contact->to - AMBULO__INSTANT) return 1;
  return contact->to >= duration - AMBULO__INSTANT && time <= duration + AMBULO__INSTANT;
}

const ambulo_contact *ambulo__contact_of(const ambulo_problem_definition *d, int effector,
                                         double time) {
  for (int i = 0; i < d->contact_count; i++) {
    const ambulo_contact *c = &d->contacts[i];
    if (ambulo__effector_of(d->model, c) == effector && ambulo__contact_holds(c, d->duration, time))
      return c;
  }
  return NULL;
}

const ambulo_contact *ambulo__contact_before(const ambulo_problem_definition *d, int effector,
                                             double time) {
  for (int i = 0; i < d->contact_count; i++) {
    const ambulo_contact *c = &d->contacts[i];
    if (ambulo__effector_of(d->model, c) == effector && c->from < time - AMBULO__INSTANT &&
        time <= c->to + AMBULO__INSTANT)
      return c;
  }
  return NULL;
}

int ambulo__loaded_span(const ambulo_problem_definition *d, int effector, double time,
                        ambulo__span *span) {
  const ambulo_contact *contact = ambulo__contact_of(d, effector, time);
  if (!contact) return 0;
  int own = (int)(contact - d->contacts);
  *span = ambulo__uninterrupted(d, effector, AMBULO__ANY_MODE, ambulo__image_span(d, own, 0));
  return 1;
}

ambulo__span ambulo__air_span(const ambulo_problem_definition *d, int foot, double time) {
  int last = ambulo__image_periods(d);
  ambulo__span air = {-(last + 1) * d->duration, (last + 2) * d->duration, -1, -1};
  if (last == 0) air = (ambulo__span){0.0, d->duration, -1, -1};
  for (int i = 0; i < d->contact_count; i++) {
    for (int period = -last; period <= last; period++) {
      ambulo__span image = ambulo__image_span(d, i, period);
      if (ambulo__image_effector(d, i, period) != foot) continue;
      if (image.to <= time + AMBULO__INSTANT && image.to > air.from) {
        air.from = image.to;
        air.begins = i;
      }
      if (image.from >= time - AMBULO__INSTANT && image.from < air.to) {
        air.to = image.from;
        air.ends = i;
      }
    }
  }
  return air;
}

/* ---------------------------------------------------------------- in the air */

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
