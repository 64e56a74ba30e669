/* study/front_gap.c - the weights that lead between two points of a front (front.h). */
#include "study/front.h"

#include <math.h>

/* shares of the way that are tried where the first ones lead nowhere; the chord's own is 1/2 */
static const double shares[] = {0.5, 0.35, 0.65};
enum { SHARES = sizeof shares / sizeof *shares };

/* eq. (chord); where noise hides it, the middle */
static double tie(const ambulo__front *f, int a, int b) {
  const ambulo__front_point *A = &f->point[a], *B = &f->point[b];
  double ga = ambulo__front_total(f, A->weight, b) - A->total;
  double gb = ambulo__front_total(f, B->weight, a) - B->total;
  if (!(ga > 0.0) || !(gb > 0.0)) return 0.5;
  return ga / (ga + gb);
}

static int find(const ambulo__front *f, const double *weight) {
  for (int k = 0; k < f->points; k++) {
    int same = 1;
    for (int i = 0; i < f->terms; i++) same &= f->point[k].weight[i] == weight[i];
    if (same) return k;
  }
  return -1;
}

int ambulo__front_between(const ambulo__front *f, int a, int b, double u,
                          ambulo__front_request *request) {
  double best = tie(f, a, b), t = u * best / (u * best + (1.0 - u) * (1.0 - best));
  *request = (ambulo__front_request){.from = -1, .parent = {a, b}, .anchor = -1};
  for (int i = 0; i < f->terms; i++)
    request->weight[i] =
        ambulo__front_round((1.0 - t) * f->point[a].weight[i] + t * f->point[b].weight[i]);
  if (f->neighbour) request->from = u <= 0.5 ? a : b;
  return find(f, request->weight) < 0;
}

/* A solve at the chord's own weights that came back to a or b settles it; one that failed or ended
 * in a valley does not, and other shares are tried. */
int ambulo__front_is_refused(const ambulo__front *f, int a, int b) {
  ambulo__front_request request;
  for (int i = 0; i < SHARES; i++) {
    if (ambulo__front_between(f, a, b, shares[i], &request)) return 0;
    ambulo__front_standing s = f->point[find(f, request.weight)].standing;
    if (i == 0 && (s == AMBULO__FRONT_ON || s == AMBULO__FRONT_REPEATS)) return 1;
  }
  return 1;
}

void ambulo__front_gaps(const ambulo__front *f, ambulo__front_gap *gap, int *count) {
  int on = 0;
  for (int k = 0; k < f->points; k++) {
    if (f->point[k].standing != AMBULO__FRONT_ON) continue;
    int place = f->point[k].place;
    if (place > 0) gap[place - 1].b = k;
    gap[place].a = k;
    on++;
  }
  *count = on > 0 ? on - 1 : 0;
  for (int i = 0; i < *count; i++) {
    gap[i].length = ambulo__front_distance(f, gap[i].a, gap[i].b);
    gap[i].refused = ambulo__front_is_refused(f, gap[i].a, gap[i].b);
  }
}
