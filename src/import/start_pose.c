/* import/start_pose.c - the pose that a solve begins at: defaults of the source, on the ground.
 *
 * A default outside its range goes to the nearer end. Then, where a slider that nothing drives goes
 * up between the world and the feet, its default changes by as much as the lowest point of the feet
 * is off the ground.
 */
#include "base/arithmetic.h"
#include "base/numtext.h"
#include "import/body_tree.h"

#include <math.h>

static void keep_in_range(ambulo__tree *tree, ambulo__tree_link *link) {
  ambulo_coordinate *c = &link->coordinate;
  double inside = fmin(c->range[1], fmax(c->range[0], c->default_value));
  if (c->default_value == 0.0 || inside == c->default_value) return;
  ambulo__tree_note(tree, link->node, "%s is %s by default, outside its range: it starts at %s",
                    c->name, ambulo__number_text(c->default_value).text,
                    ambulo__number_text(inside).text);
  c->default_value = inside;
}

/* the slider on the way to a link that goes up and that nothing drives; -1 */
static int lift_of(const ambulo__tree *tree, int link, const double up[3], double *along) {
  int found = -1;
  for (int i = link; i >= 0; i = tree->links[i].parent) {
    const ambulo__tree_link *l = &tree->links[i];
    double axis[3];
    if (l->type != AMBULO_PRISMATIC || l->follows || l->coordinate.actuated) continue;
    ambulo__rigid place = ambulo__tree_start_place(tree, i);
    ambulo__rigid_vector(&place, l->axis, axis);
    double cosine = ambulo__dot(axis, up);
    if (fabs(cosine) < 0.999) continue;
    *along = cosine;
    found = i;
  }
  return found;
}

static void start_pose_stand(ambulo__tree *tree) {
  double up[3], lowest = INFINITY, along = 1.0;
  for (int i = 0; i < 3; i++) up[i] = -tree->gravity[i];
  (void)ambulo__normalize(up);
  for (int f = 0; f < tree->foot_count; f++) {
    const ambulo__tree_foot *foot = &tree->feet[f];
    const int points[4] = {foot->heel[0], foot->heel[1], foot->toe[0], foot->toe[1]};
    for (int k = 0; k < 4; k++) {
      double at[3];
      if (points[k] < 0) continue;
      const ambulo__tree_point *point = &tree->points[points[k]];
      ambulo__rigid place = ambulo__tree_start_place(tree, point->link);
      ambulo__rigid_point(&place, point->position, at);
      lowest = fmin(lowest, ambulo__dot(at, up));
    }
  }
  if (!isfinite(lowest) || fabs(lowest) < 1e-6) return;
  int link = lift_of(tree, tree->points[tree->feet[0].heel[0]].link, up, &along);
  if (link < 0) return;
  ambulo_coordinate *c = &tree->links[link].coordinate;
  double value = c->default_value - lowest / along;
  if (!(value >= c->range[0] && value <= c->range[1])) return;
  c->default_value = fabs(value) < 1e-9 ? 0.0 : value;
  value = c->default_value;
  if (fabs(lowest) > 1e-3)
    ambulo__tree_note(tree, tree->links[link].node,
                      "%s starts at %s m, %s mm %s than in the source, so that the feet stand on "
                      "the ground",
                      c->name, ambulo__three_digits(fabs(value)).text,
                      ambulo__three_digits(1e3 * fabs(lowest)).text,
                      lowest < 0.0 ? "higher" : "lower");
}

void ambulo__find_start(ambulo__tree *tree) {
  for (int i = 0; i < tree->link_count; i++) keep_in_range(tree, &tree->links[i]);
  start_pose_stand(tree);
}
