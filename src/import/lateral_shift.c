/* import/lateral_shift.c - a planar body that stands beside the world's mirror plane moves into
 * it.
 *
 * The mirror plane of a model contains the world's origin. A body whose root moves in the plane of
 * forward and up alone has its side-to-side place for good, and files put it anywhere (OpenSim's
 * walkers of ten coordinates: 2 cm off). Of joints with a mirror partner, the mean of the two
 * places along left at q = 0 is that of the plane they mean; where all agree, the root moves by it.
 * No coordinate feels that. */
#include "import/body_tree.h"

#include "base/arithmetic.h"

#include <math.h>

static const double same = 1e-6, nothing = 1e-9, most = 1.0; /* m */

/* on the way from the world to `link` something moves along left */
static int moves_sideways(const ambulo__tree *t, int link, const double left[3]) {
  for (int i = link; i >= 0; i = t->links[i].parent) {
    double axis[3];
    ambulo__rigid place = ambulo__tree_place(t, i);
    ambulo__rigid_vector(&place, t->links[i].axis, axis);
    double along = fabs(ambulo__dot(axis, left));
    if (t->links[i].type == AMBULO_REVOLUTE && along < 1.0 - nothing) return 1;
    if (t->links[i].type == AMBULO_PRISMATIC && along > nothing) return 1;
  }
  return 0;
}

/* where the plane of all pairs is along left; 0 where they disagree, or there are none */
static int plane_of_pairs(const ambulo__tree *t, const double left[3], double *at) {
  int pairs = 0;
  for (int i = 0; i < t->link_count; i++) {
    const ambulo__tree_link *link = &t->links[i];
    int partner = link->coordinate.mirror;
    if (link->type == AMBULO_FIXED || !link->has_mirror || partner < 0 || partner == i) continue;
    ambulo__rigid own = ambulo__tree_place(t, i), other = ambulo__tree_place(t, partner);
    double middle = 0.5 * (ambulo__dot(own.p, left) + ambulo__dot(other.p, left));
    if (moves_sideways(t, link->parent, left) || (pairs && fabs(middle - *at) > same)) return 0;
    if (!pairs++) *at = middle;
  }
  return pairs > 0;
}

void ambulo__tree_center(ambulo__tree *tree) {
  double axes[3][3], at = 0.0;
  ambulo__tree_axes(tree, axes);
  if (!plane_of_pairs(tree, axes[1], &at) || fabs(at) < same || fabs(at) > most) return;
  for (int i = 0; i < tree->link_count; i++) {
    if (tree->links[i].parent >= 0) continue;
    for (int k = 0; k < 3; k++) tree->links[i].origin.p[k] -= at * axes[1][k];
  }
  ambulo__tree_note(tree, NULL,
                    "the body stands %s mm beside the plane through the origin: it is moved into "
                    "it, which no coordinate feels",
                    ambulo__three_digits(1e3 * fabs(at)).text);
}
