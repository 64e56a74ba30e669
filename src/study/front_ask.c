/* study/front_ask.c - what to solve next (front.h).
 *
 * First the anchors. Then, round by round: a point in a valley is solved once more from the motion
 * that beat it; and as many new points are shared out among the gaps as are wanted, one after the
 * other to the gap that would be left widest. Of them at most three a gap are asked for at a time:
 * where they end tells better where the others should be. Once there are as many as are wanted, a
 * gap that is too wide is halved, until none is, or all that are refuse; in all at most
 * three times as many solves as points. All follows from the points alone, so that a run that is
 * repeated asks for the same.
 *
 * Three terms: the triangle of the anchors is cut at the points that were asked for on its edges,
 * in the order in which they were asked for: a point with parents a and b cuts every triangle that
 * has the edge a b into two. A round halves the longest edges that do not refuse, at most one of
 * each triangle. (Bisection of the longest edge keeps triangles from becoming slivers: Rivara
 * 1984.) */
#include "study/front.h"

#include <math.h>

static const double widest = 1.5, least_widest = 1.2;
enum { MOST_AT_ONCE = 3, MOST_SOLVES = 3 };

/* points in valleys, from what is better, unless that was tried */
static int ask_retries(const ambulo__front *f, ambulo__front_request *requests, int room) {
  int count = 0;
  for (int k = 0; k < f->points && count < room; k++) {
    const ambulo__front_point *p = &f->point[k];
    if (p->standing != AMBULO__FRONT_BEATEN || p->from == p->better) continue;
    int again = 0;
    for (int j = 0; j < f->points; j++) {
      int same = j != k && f->point[j].from >= 0;
      for (int i = 0; i < f->terms; i++) same &= f->point[j].weight[i] == p->weight[i];
      again |= same;
    }
    if (again) continue;
    ambulo__front_request *r = &requests[count++];
    *r = (ambulo__front_request){.from = p->better, .parent = {p->better, k}, .anchor = -1};
    for (int i = 0; i < f->terms; i++) r->weight[i] = p->weight[i];
  }
  return count;
}

/* new points of each gap, added[count] */
static void share_out(const ambulo__front_gap *gap, int count, int points, int *added) {
  for (int k = 0; k < points; k++) {
    int widest_gap = -1;
    double most = 0.0;
    for (int i = 0; i < count; i++) {
      if (gap[i].refused || gap[i].length / (added[i] + 1) <= most) continue;
      most = gap[i].length / (added[i] + 1);
      widest_gap = i;
    }
    if (widest_gap >= 0) added[widest_gap]++;
  }
}

static int ask_in_gap(const ambulo__front *f, const ambulo__front_gap *gap, int added,
                      ambulo__front_request *requests, int room) {
  int count = 0, at_once = added < MOST_AT_ONCE ? added : MOST_AT_ONCE;
  for (int i = 1; i <= at_once && count < room; i++) {
    double u = (double)i / (at_once + 1);
    count += ambulo__front_between(f, gap->a, gap->b, u, &requests[count]);
  }
  if (count == 0 && added > 0 && room > 0)
    count = ambulo__front_try(f, gap->a, gap->b, &requests[0]);
  return count;
}

/* How wide a gap may be: 1.5 of the mean of those that do not refuse; but no less than 1.2 of what
 * it would be if the wanted points were shared out over them exactly, or else points would be added
 * where nothing is wide. */
static double widest_allowed(const ambulo__front *f, const ambulo__front_gap *gap, int gaps) {
  double sum = 0.0;
  int open = 0, refused = 0;
  for (int i = 0; i < gaps; i++) {
    refused += gap[i].refused;
    open += !gap[i].refused;
    sum += gap[i].refused ? 0.0 : gap[i].length;
  }
  int shares = f->wanted - 1 - refused;
  if (open == 0) return INFINITY;
  return fmax(widest * sum / open, least_widest * sum / (shares > 0 ? shares : 1));
}

static int ask_in_gaps(const ambulo__front *f, const ambulo__front_gap *gap, int gaps, int *added,
                       ambulo__front_request *requests, int room) {
  int on = gaps + 1, count = 0;
  double most = widest_allowed(f, gap, gaps);
  if (on < f->wanted) share_out(gap, gaps, f->wanted - on, added);
  for (int i = 0; i < gaps && on >= f->wanted; i++)
    added[i] = !gap[i].refused && gap[i].length > most;
  for (int i = 0; i < gaps && count < room; i++)
    count += ask_in_gap(f, &gap[i], added[i], requests + count, room - count);
  return count;
}

static ambulo_status ask_curve(const ambulo__front *f, const ambulo__front_report *report,
                               const ambulo_allocator *a, ambulo__front_request *requests, int room,
                               int *count) {
  size_t size = (size_t)report->on + 1;
  ambulo__front_gap *gap = ambulo__alloc(a, size, sizeof *gap);
  int *added = ambulo__alloc(a, size, sizeof *added), gaps = 0;
  ambulo_status status = gap && added ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) {
    ambulo__front_gaps(f, gap, &gaps);
    *count = ask_in_gaps(f, gap, gaps, added, requests, room);
  }
  ambulo__free(a, gap);
  ambulo__free(a, added);
  return status;
}

/* -------------------------------------------------------------------- three terms */

typedef struct triangle {
  int corner[3];
  int used; /* 1: one of its edges is halved in this round */
} triangle;

typedef struct mesh {
  const ambulo__front *front;
  triangle *triangle; /* [count] */
  int count;
} mesh;

static int corner_of(const triangle *t, int point) {
  for (int i = 0; i < 3; i++)
    if (t->corner[i] == point) return i;
  return -1;
}

/* a point that a triangle may have: its motion is its own */
static int stands(const ambulo__front *f, int k) {
  return f->point[k].standing == AMBULO__FRONT_ON ||
         f->point[k].standing == AMBULO__FRONT_DOMINATED;
}

static void cut(mesh *m, int point) {
  const int *parent = m->front->point[point].parent;
  if (parent[0] < 0 || !stands(m->front, point)) return;
  for (int i = 0, count = m->count; i < count; i++) {
    int a = corner_of(&m->triangle[i], parent[0]), b = corner_of(&m->triangle[i], parent[1]);
    if (a < 0 || b < 0) continue;
    m->triangle[m->count] = m->triangle[i];
    m->triangle[m->count++].corner[a] = point;
    m->triangle[i].corner[b] = point;
  }
}

/* of a triangle that is not used: its longest edge that leads somewhere. Returns its length; 0:
 * none */
static double longest(const mesh *m, const triangle *t, ambulo__front_request *request) {
  double most = 0.0;
  for (int i = 0; i < 3 && !t->used; i++) {
    int a = t->corner[i], b = t->corner[(i + 1) % 3];
    double length = ambulo__front_distance(m->front, a, b);
    if (a > b) {
      a = b;
      b = t->corner[i];
    }
    if (length <= most || ambulo__front_is_refused(m->front, a, b)) continue;
    (void)ambulo__front_try(m->front, a, b, request);
    most = length;
  }
  return most;
}

/* the longest edge of all; every triangle that has it is used then. 0: none */
static int take_longest(mesh *m, ambulo__front_request *request) {
  double most = 0.0;
  for (int i = 0; i < m->count; i++) {
    ambulo__front_request one;
    double length = longest(m, &m->triangle[i], &one);
    if (length <= most) continue;
    most = length;
    *request = one;
  }
  for (int i = 0; i < m->count && most > 0.0; i++)
    if (corner_of(&m->triangle[i], request->parent[0]) >= 0 &&
        corner_of(&m->triangle[i], request->parent[1]) >= 0)
      m->triangle[i].used = 1;
  return most > 0.0;
}

static ambulo_status ask_mesh(const ambulo__front *f, const int anchor[AMBULO__FRONT_TERMS],
                              const ambulo_allocator *a, ambulo__front_request *requests, int room,
                              int *count) {
  mesh m = {.front = f, .count = 1};
  /* a cut adds one triangle for each of at most two that have the edge */
  m.triangle = ambulo__alloc(a, 2 * (size_t)f->points + 2, sizeof *m.triangle);
  if (!m.triangle) return AMBULO_E_MEMORY;
  m.triangle[0] = (triangle){{anchor[0], anchor[1], anchor[2]}, 0};
  for (int k = 0; k < f->points; k++) cut(&m, k);
  *count = 0;
  while (*count < room && take_longest(&m, &requests[*count])) (*count)++;
  ambulo__free(a, m.triangle);
  return AMBULO_OK;
}

/* -------------------------------------------------------------------- what is next */

ambulo_status ambulo__front_ask(ambulo__front *f, const ambulo_allocator *a,
                                ambulo__front_request *requests, int room, int *count) {
  int anchor[AMBULO__FRONT_TERMS];
  double lowest[AMBULO__FRONT_TERMS], range[AMBULO__FRONT_TERMS];
  ambulo__front_request first[AMBULO__FRONT_TERMS];
  ambulo__front_report report;
  *count = 0;
  ambulo__front_judge(f, &report);
  int ready = ambulo__front_anchors(f, anchor, lowest, range, first, count);
  for (int i = 0; i < *count && i < room; i++) requests[i] = first[i];
  if (!ready || !report.conflict) return AMBULO_OK;
  int left = MOST_SOLVES * f->wanted - f->points;
  if (room > left) room = left;
  *count = ask_retries(f, requests, room);
  if (*count > 0 || room <= 0) return AMBULO_OK;
  if (f->terms == 2) return ask_curve(f, &report, a, requests, room, count);
  if (report.on >= f->wanted) return AMBULO_OK;
  if (room > f->wanted - report.on) room = f->wanted - report.on;
  return ask_mesh(f, anchor, a, requests, room, count);
}
