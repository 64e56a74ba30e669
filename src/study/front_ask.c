/* study/front_ask.c - what to solve next (front.h).
 *
 * First the anchors. Then, round by round: a point in a valley is solved once more from the motion
 * that beat it; and as many new points are shared out among the gaps as are wanted, one after the
 * other to the gap that would be left widest. Of them at most three a gap are asked for at a time:
 * where they end tells better where the others should be. Once there are as many as are wanted, a
 * gap that is too wide is halved, until none is, or all that are refuse; in all at most
 * three times as many solves as points. All follows from the points alone, so that a run that is
 * repeated asks for the same. */
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
  /* where these were solved for: the chord's own, and then what is left */
  static const double other[] = {0.5, 0.35, 0.65};
  for (int i = 0; i < 3 && added > 0 && count == 0 && room > 0; i++)
    count += ambulo__front_between(f, gap->a, gap->b, other[i], &requests[count]);
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
  return ambulo__front_mesh(f, anchor, a, requests, room, count);
}
