/* study/plot_spread.c - marks side by side instead of on top of each other.
 *
 * Marks that stand at one value of an axis are taken from top to bottom; each takes the free spot
 * nearest to its own among steps to the left and the right ("bee swarm"). */
#include "study/plot.h"

#include <math.h>
#include <stdlib.h>

static int by_height(const void *left, const void *right) {
  const ambulo__plot_spot *a = *(ambulo__plot_spot *const *)left,
                          *b = *(ambulo__plot_spot *const *)right;
  if (a->place != b->place) return a->place - b->place;
  if (a->y != b->y) return a->y < b->y ? -1 : 1;
  return (a > b) - (a < b);
}

/* whether a mark at x would hide one of those above it; side by side they may touch */
static int is_free(ambulo__plot_spot *const *spot, int i, double x, double size) {
  double least = 0.999 * size;
  for (int k = i - 1; k >= 0; k--) {
    if (spot[k]->place != spot[i]->place || spot[i]->y - spot[k]->y >= size) return 1;
    if (hypot(spot[k]->x - x, spot[k]->y - spot[i]->y) < least) return 0;
  }
  return 1;
}

int ambulo__plot_spread(ambulo__plot_spot **spot, int count, double radius, const double *room) {
  double size = 2.0 * radius;
  int hidden = 0;
  qsort((void *)spot, (size_t)count, sizeof *spot, by_height);
  for (int i = 0; i < count; i++) {
    double own = spot[i]->x, most = room[spot[i]->place];
    int found = 0;
    for (int step = 0; !found; step++) {
      int halves = (step + 1) / 2; /* 0, 1, -1, 2, -2 ... */
      double aside = 0.5 * size * halves;
      if (aside > most) break;
      if (step % 2 == 0) aside = -aside;
      found = is_free(spot, i, own + aside, size);
      if (found) spot[i]->x = own + aside;
    }
    hidden += !found;
  }
  return hidden;
}
