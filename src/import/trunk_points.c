/* import/trunk_points.c - two points on the trunk of a person: `lumbar`, the joint, and
 * `head_top`, by which problems keep it upright.
 *
 * OpenSim's models have a torso with the head on it, its origin in the lumbar joint. Its centre of
 * mass is at c in its frame, n up there at q = 0. The top of the head is 2.25 times as high, as in
 * people (0.32 and 0.72 m), and as far ahead:
 *
 *     head_top = c + 1.25 (n . c) n                                                     m */
#include "base/arithmetic.h"
#include "import/body_tree.h"

#include <string.h>

static int trunk_of_person(const ambulo__tree *tree) {
  static const char *const names[] = {"torso", "thorax", "trunk"};
  int found = -1;
  if (ambulo__tree_find_coordinate(tree, "lumbar_extension") < 0) return -1;
  for (int i = 0; i < 3 && found < 0; i++) found = ambulo__tree_find(tree, names[i]);
  return found >= 0 && tree->links[found].body.mass > 0.0 ? found : -1;
}

static void up_in(const ambulo__tree *tree, int link, double up[3]) {
  ambulo__rigid place = ambulo__rigid_identity();
  double world[3];
  for (int i = link; i >= 0; i = tree->links[i].parent)
    place = ambulo__rigid_times(&tree->links[i].origin, &place);
  for (int i = 0; i < 3; i++) world[i] = -tree->gravity[i];
  (void)ambulo__normalize(world);
  ambulo__rigid_back(&place, world, up);
}

void ambulo__find_trunk_points(ambulo__tree *tree) {
  static const double origin[3] = {0, 0, 0};
  int link = trunk_of_person(tree);
  double up[3], top[3];
  if (link < 0) return;
  for (int i = 0; i < tree->point_count; i++)
    if (strcmp(tree->points[i].name, "lumbar") == 0 ||
        strcmp(tree->points[i].name, "head_top") == 0)
      return;
  const double *com = tree->links[link].body.com;
  up_in(tree, link, up);
  double height = ambulo__dot(up, com);
  if (!(height > 0.0)) return;
  for (int i = 0; i < 3; i++) top[i] = com[i] + 1.25 * height * up[i];
  (void)ambulo__tree_add_point(tree, "lumbar", link, origin);
  (void)ambulo__tree_add_point(tree, "head_top", link, top);
}
