/* import/tree_links.c - where links of a tree are, and which are fixed to each other
 * (body_tree.h).
 */
#include "base/arithmetic.h"
#include "import/body_tree.h"

#include <math.h>

/* a link behind its joint, in its parent; the joint stands at `value` */
static ambulo__rigid in_parent(const ambulo__tree_link *l, double value) {
  if (value == 0.0) return l->origin;
  ambulo__rigid step = ambulo__rigid_step(l->type == AMBULO_PRISMATIC, l->axis, value);
  return ambulo__rigid_times(&l->origin, &step);
}

/* `whole`: coordinates from that link on to the world are at 0; -1: none are */
static ambulo__rigid place_of(const ambulo__tree *tree, int link, int start, int whole) {
  ambulo__rigid place = ambulo__rigid_identity();
  for (int i = link; i >= 0; i = tree->links[i].parent) {
    const ambulo__tree_link *l = &tree->links[i];
    if (i == whole) start = 0;
    ambulo__rigid own =
        in_parent(l, l->type == AMBULO_FIXED ? 0.0 : ambulo__tree_stands(tree, i, start));
    place = ambulo__rigid_times(&own, &place);
  }
  return place;
}

ambulo__rigid ambulo__tree_place_at(const ambulo__tree *tree, int link, const double *values) {
  ambulo__rigid place = ambulo__rigid_identity();
  for (int i = link; i >= 0; i = tree->links[i].parent) {
    const ambulo__tree_link *l = &tree->links[i];
    ambulo__rigid own = in_parent(l, l->type == AMBULO_FIXED ? 0.0 : values[i]);
    place = ambulo__rigid_times(&own, &place);
  }
  return place;
}

ambulo__rigid ambulo__tree_place(const ambulo__tree *tree, int link) {
  return place_of(tree, link, 0, -1);
}

ambulo__rigid ambulo__tree_start_place(const ambulo__tree *tree, int link) {
  return place_of(tree, link, 1, -1);
}

int ambulo__tree_leader(const ambulo__tree *tree, int link) {
  while (tree->links[link].type == AMBULO_FIXED && tree->links[link].parent >= 0)
    link = tree->links[link].parent;
  return link;
}

static int joints_on(const ambulo__tree *tree, int leader) {
  int count = 0;
  for (int i = 0; i < tree->link_count; i++) {
    const ambulo__tree_link *link = &tree->links[i];
    if (link->type != AMBULO_FIXED && link->parent >= 0)
      count += ambulo__tree_leader(tree, link->parent) == leader;
  }
  return count;
}

int ambulo__tree_is_end(const ambulo__tree *tree, int link) {
  return joints_on(tree, ambulo__tree_leader(tree, link)) == 0;
}

int ambulo__tree_hangs_on(const ambulo__tree *tree, int link, int above) {
  while (link >= 0 && link != above) link = tree->links[link].parent;
  return link == above;
}

/* Of the links that a joint hangs on a leader, -1: of the first ones, that with the most mass on
 * it: scenes have balls and boxes as well. */
static int heaviest_on(const ambulo__tree *tree, int leader) {
  int best = -1;
  double most = -1.0;
  for (int i = 0; i < tree->link_count; i++) {
    const ambulo__tree_link *link = &tree->links[i];
    double mass = 0.0;
    int on = link->parent < 0 ? -1 : ambulo__tree_leader(tree, link->parent);
    if (on != leader || (link->parent >= 0 && link->type == AMBULO_FIXED)) continue;
    for (int k = i; k < tree->link_count; k++)
      if (ambulo__tree_hangs_on(tree, k, i)) mass += tree->links[k].body.mass;
    if (mass > most) best = i;
    most = fmax(most, mass);
  }
  return best;
}

int ambulo__tree_trunk(const ambulo__tree *tree) {
  for (int i = heaviest_on(tree, -1); i >= 0; i = heaviest_on(tree, i)) {
    ambulo__part body;
    ambulo__tree_whole(tree, i, &body);
    int moves = tree->links[i].type != AMBULO_FIXED;
    if (body.mass > 0.0 || (moves && joints_on(tree, i) > 1)) return i;
  }
  return -1;
}

ambulo__rigid ambulo__tree_pose_of(const ambulo__tree *tree, int link, int start) {
  return place_of(tree, link, start, tree->trunk);
}

void ambulo__tree_whole(const ambulo__tree *tree, int leader, ambulo__part *body) {
  *body = (ambulo__part){0};
  for (int i = 0; i < tree->link_count; i++) {
    const ambulo__tree_link *link = &tree->links[i];
    if (!(link->body.mass > 0.0) || ambulo__tree_leader(tree, i) != leader) continue;
    ambulo__rigid place = ambulo__rigid_identity();
    for (int k = i; k != leader; k = tree->links[k].parent)
      place = ambulo__rigid_times(&tree->links[k].origin, &place);
    ambulo__part part = {.mass = link->body.mass};
    ambulo__rigid_point(&place, link->body.com, part.com);
    ambulo__inertia_turn((const double(*)[3])place.r, link->body.inertia, part.inertia);
    ambulo__part_add(body, &part);
  }
}
