/* exchange/chain.c - joints of several coordinates as links, one coordinate each (body_tree.h).
 *
 * Placements in between are put together. What comes after the last joint is taken into it where
 * that can be: with C = Trans(c) R_C,
 *
 *     P Trans(a q) C = (P C) Trans(R_C' a q)               always
 *     P Rot(a, q) C  = (P C) Rot(R_C' a, q)                for c = 0
 *
 * else the body hangs behind it on a fixed link, which costs nothing.
 */
#include "exchange/body_tree.h"

#include <math.h>
#include <string.h>

static const double nothing = 1e-15; /* m, and as a sine: rounding of a product */

ambulo__chain ambulo__chain_begin(ambulo__tree *tree, int parent, const ambulo__xml_node *node) {
  return (ambulo__chain){
      .tree = tree, .node = node, .parent = parent, .pending = ambulo__rigid_identity()};
}

void ambulo__chain_place(ambulo__chain *chain, const ambulo__rigid *placement) {
  chain->pending = ambulo__rigid_times(&chain->pending, placement);
}

int ambulo__chain_joint(ambulo__chain *chain, ambulo_joint_type type, const double axis[3],
                        const char *coordinate) {
  double unit[3];
  memcpy(unit, axis, sizeof unit);
  (void)ambulo__normalize(unit);
  int link = ambulo__tree_add(chain->tree, coordinate, chain->parent, type, &chain->pending, unit,
                              chain->node);
  chain->pending = ambulo__rigid_identity();
  if (link < 0) return -1;
  chain->parent = link;
  chain->own++;
  return link;
}

static int taken_in(ambulo__tree_link *last, const ambulo__rigid *c) {
  int moves = fabs(c->p[0]) > nothing || fabs(c->p[1]) > nothing || fabs(c->p[2]) > nothing;
  if (last->type == AMBULO_FIXED || (last->type == AMBULO_REVOLUTE && moves)) return 0;
  double axis[3];
  ambulo__rigid_back(c, last->axis, axis);
  last->origin = ambulo__rigid_times(&last->origin, c);
  memcpy(last->axis, axis, sizeof axis);
  return 1;
}

int ambulo__chain_end(ambulo__chain *chain, const char *name) {
  ambulo__tree *tree = chain->tree;
  if (chain->own == 0 || !taken_in(&tree->links[chain->parent], &chain->pending))
    return ambulo__tree_add(tree, name, chain->parent, AMBULO_FIXED, &chain->pending, NULL,
                            chain->node);
  /* the last joint's link becomes the body's */
  ambulo__tree_link *last = &tree->links[chain->parent];
  const char *before = last->name;
  last->name = "";
  int named = ambulo__tree_add(tree, name, -1, AMBULO_FIXED, &chain->pending, NULL, chain->node);
  last = &tree->links[chain->parent];
  last->name = named < 0 ? before : tree->links[named].name;
  if (named >= 0) tree->link_count--;
  return chain->parent;
}

static void joint_named(ambulo__chain *chain, ambulo_joint_type type, const double axis[3],
                        const char *name, const char *part, int actuated) {
  const char *full = ambulo__arena_print(chain->tree->arena, "%.50s_%s", name, part);
  int link = ambulo__chain_joint(chain, type, axis, full);
  if (link >= 0) chain->tree->links[link].coordinate.actuated = actuated;
}

void ambulo__chain_free(ambulo__chain *chain, const char *prefix) {
  static const char *const slides[] = {"tx", "ty", "tz"};
  const ambulo__tree *tree = chain->tree;
  double up[3], left[3], ahead[3];
  for (int i = 0; i < 3; i++) {
    up[i] = -tree->gravity[i];
    ahead[i] = tree->forward[i];
  }
  (void)ambulo__normalize(up);
  double climb = up[0] * ahead[0] + up[1] * ahead[1] + up[2] * ahead[2];
  for (int i = 0; i < 3; i++) ahead[i] -= climb * up[i];
  (void)ambulo__normalize(ahead);
  for (int i = 0; i < 3; i++)
    left[i] = up[(i + 1) % 3] * ahead[(i + 2) % 3] - up[(i + 2) % 3] * ahead[(i + 1) % 3];
  for (int i = 0; i < 3; i++) {
    const double axis[3] = {i == 0, i == 1, i == 2};
    joint_named(chain, AMBULO_PRISMATIC, axis, prefix, slides[i], 0);
  }
  joint_named(chain, AMBULO_REVOLUTE, left, prefix, "tilt", 0);
  joint_named(chain, AMBULO_REVOLUTE, ahead, prefix, "list", 0);
  joint_named(chain, AMBULO_REVOLUTE, up, prefix, "rotation", 0);
}

void ambulo__chain_ball(ambulo__chain *chain, const char *name, int *first) {
  static const char *const parts[] = {"x", "y", "z"};
  *first = chain->tree->link_count;
  for (int i = 0; i < 3; i++) {
    const double axis[3] = {i == 0, i == 1, i == 2};
    joint_named(chain, AMBULO_REVOLUTE, axis, name, parts[i], 1);
  }
}
