/* solver/step_rows.c - where a foot passes the edges of steps, when footholds move
 * (contact/clearance.c, step_edge.c, in their letters).
 *
 * With s the horizontal step from the foothold left to the next one, |s| long, e = s / |s|, t
 * across it to the left, z the rise between them, m = z / |s|, and an edge at x, height h, midway
 * between the footholds a behind and b beyond it:
 *
 *     e. = t (t.s.) / |s|,   x. = (e. . (a + b) + e . (a. + b.)) / 2,   m. = (z. - m e.s.) / |s|
 *     beside the riser       c = +-(e.r - x)             c. = +-(e. . r - x.)
 *     over the edge          c = N / k - low,  k = |(1, m)|,  N = n.r - h - m (e.r - x)
 *                            c. = (-h. - m. (e.r - x) - m (e. . r - x.)) / k - N m m. / k^3
 *     above a foothold       c = n.r - h - low,  below the ceiling  c = ceiling + h - n.r
 *
 * No derivative by places and heights where two footholds are alike near to the edge, or where the
 * plane lies on both edges: then it depends on the direction in which one of them moves.
 */
#include "solver/step_rows.h"
#include "base/arithmetic.h"
#include "solver/sensitivity_surface.h"

#include <math.h>
#include <string.h>

enum { FOOTHOLDS = 3 };

/* dL by places, along forward and left, and by heights */
typedef struct footholds {
  double by[FOOTHOLDS][3];
} footholds;

static int is_detail(const ambulo__table_row *row, const char *detail) {
  return strcmp(row->detail, detail) == 0;
}

int ambulo__is_step_row(const ambulo__table_row *row) {
  static const char *const details[] = {"behind the edge", "beyond the edge", "low over the edge",
                                        "low", "high"};
  for (int i = 0; i < 5; i++)
    if (is_detail(row, details[i])) return 1;
  return 0;
}

typedef struct way {
  double step[2], run, slope; /* s, |s|, m */
  double e[2], r[2];          /* along forward and left */
} way;

static way way_of(const ambulo_model *m, const ambulo__step_row *step) {
  way w;
  const double *axes[2] = {m->forward, m->left};
  for (int i = 0; i < 2; i++) {
    w.step[i] = step->to->place[i] - step->from->place[i];
    w.r[i] = ambulo__dot(axes[i], step->point);
  }
  w.run = hypot(w.step[0], w.step[1]);
  w.slope = (step->to->place[2] - step->from->place[2]) / w.run;
  for (int i = 0; i < 2; i++) w.e[i] = w.step[i] / w.run;
  return w;
}

/* adds pull times x., and pull times the part of it by e. to by_e */
static void add_edge(const ambulo__step_row *step, const way *w, const ambulo__step_edge *edge,
                     double pull, double by_e[2], footholds *f) {
  const ambulo_contact *holds[FOOTHOLDS] = {step->from, step->to, step->edges.other};
  int ends[2] = {edge->behind, edge->beyond};
  for (int k = 0; k < 2; k++) {
    for (int i = 0; i < 2; i++) {
      f->by[ends[k]][i] += 0.5 * pull * w->e[i];
      by_e[i] += 0.5 * pull * holds[ends[k]]->place[i];
    }
  }
}

/* e. and m. by both ends of the way */
static void add_way(const way *w, const double by_e[2], double by_slope, footholds *f) {
  const double across[2] = {-w->e[1], w->e[0]};
  double turn = (by_e[0] * across[0] + by_e[1] * across[1]) / w->run;
  for (int i = 0; i < 2; i++) {
    double by_step = turn * across[i] - by_slope * w->slope * w->e[i] / w->run;
    f->by[0][i] -= by_step;
    f->by[1][i] += by_step;
  }
  f->by[0][2] -= by_slope / w->run;
  f->by[1][2] += by_slope / w->run;
}

static void add_riser(const ambulo__step_row *step, const way *w, footholds *f) {
  double pull = is_detail(step->row, "behind the edge") ? step->pull : -step->pull;
  double by_e[2] = {pull * w->r[0], pull * w->r[1]};
  add_edge(step, w, &step->edges.edge[0], -pull, by_e, f);
  add_way(w, by_e, 0.0, f);
}

static void add_plane(const ambulo_model *m, const ambulo__step_row *step, const way *w,
                      footholds *f) {
  const ambulo__step_edge *edge = &step->edges.edge[step->edges.highest];
  double size = sqrt(1.0 + w->slope * w->slope);
  double ahead = w->e[0] * w->r[0] + w->e[1] * w->r[1] - edge->x;
  double above = ambulo__dot(m->up, step->point) - edge->z - w->slope * ahead;
  double pull = step->pull / size, by_e[2];
  for (int i = 0; i < 2; i++) by_e[i] = -pull * w->slope * w->r[i];
  f->by[edge->on][2] -= pull;
  add_edge(step, w, edge, pull * w->slope, by_e, f);
  add_way(w, by_e, -pull * (ahead + above * w->slope / (size * size)), f);
}

static void add_foothold(const ambulo__stationary *s, const ambulo__step_row *step, int which,
                         const double by[3], ambulo__partials *partials) {
  const ambulo_problem_definition *d = &s->problem->definition;
  const ambulo_model *m = d->model;
  ambulo__surface_pull pull = {{0.0}, {0.0}};
  for (int i = 0; i < 3; i++)
    pull.origin[i] = by[0] * m->forward[i] + by[1] * m->left[i] + by[2] * m->up[i];
  if (which < 2) {
    ambulo__surface_of_image(s, which ? step->to : step->from, &pull, partials);
  } else if (step->edges.other) {
    ambulo__surface_of_contact(s, (int)(step->edges.other - d->contacts), &pull, partials);
  }
}

int ambulo__step_is_unclear(const ambulo__step_row *step) {
  const ambulo__step_edges *e = &step->edges;
  if (is_detail(step->row, "low over the edge")) return e->even || e->edge[e->highest].unsure;
  return !is_detail(step->row, "low") && !is_detail(step->row, "high") && e->edge[0].unsure;
}

void ambulo__step_unclear(const ambulo__stationary *s, const ambulo__step_row *step,
                          ambulo__partials *partials) {
  static const double nothing[3] = {(double)NAN, (double)NAN, (double)NAN};
  for (int k = 0; k < FOOTHOLDS; k++) add_foothold(s, step, k, nothing, partials);
}

/* (S.18) +-(e. . r - x.), (-h. - (m (e.r - x)).) / k - N m m. / k^3, -+h. */
int ambulo__partials_of_step(const ambulo__stationary *s, const ambulo__step_row *step,
                             ambulo__partials *partials) {
  const ambulo_model *m = s->problem->model;
  int high = is_detail(step->row, "high"), over = is_detail(step->row, "low over the edge");
  int low = is_detail(step->row, "low"), beside = !high && !over && !low;
  int climbs = step->to->place[2] > step->from->place[2];
  int past = step->row->time > step->first_edge + AMBULO__INSTANT;
  double pull = high ? -step->pull : step->pull;
  way w = way_of(m, step);
  footholds f = {{{0.0}}};
  if (beside) add_riser(step, &w, &f);
  if (over) add_plane(m, step, &w, &f);
  if (low) f.by[past][2] -= pull;
  if (high) f.by[climbs][2] -= pull;
  if (!beside) partials->ground_height -= over ? pull / sqrt(1.0 + w.slope * w.slope) : pull;
  for (int k = 0; k < FOOTHOLDS; k++) add_foothold(s, step, k, f.by[k], partials);
  if (ambulo__step_is_unclear(step)) ambulo__step_unclear(s, step, partials);
  return high ? -1 : !beside;
}
