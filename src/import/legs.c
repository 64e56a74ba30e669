/* import/legs.c - which limbs are legs, and where they go (body_tree.h).
 *
 * A limb is a link at the end of the body with those above it, up to where limbs part. Its foot is
 * the link named so, else its lowest one by what is fixed to it alone, in the start pose; where
 * both a foot and its toes are on the ground the foot. Legs are the limbs with a foot named so,
 * else those that reach nearly as low as the lowest one; of limbs that part on one leg (rods,
 * cranks) the lowest counts. Names say left and right, else the side of the middle on which a foot
 * is. With two or more on each side they are counted from the front.
 *
 * Forward is across left and up. Left is where links are that names call left, from those they call
 * right; where no name says it, the toes are: a sole reaches further ahead of its ankle than
 * behind.
 */
#include "import/body_tree.h"

#include "base/arithmetic.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MOST_LIMBS = 64 };
static const double reach = 0.15; /* of the height: how much higher a leg without a name may end */
static const double level = 0.02; /* m: no difference in height */
static const double beside = 0.005; /* m: off the middle */

typedef struct limb {
  int top, link;                 /* the link it begins with; the foot */
  int named, known, arm, shaped; /* named a foot; measured; an arm; some link has geometry */
  char side;
  double height, along, across; /* of the lowest point; of the foot's joint */
} limb;

typedef struct body {
  ambulo__tree *tree;
  const double (*axes)[3]; /* forward, left, up */
  int trunk;
  limb limbs[MOST_LIMBS];
  int count;
} body;

static const char *const footed[] = {"foot", "sole", "calcn", NULL};
static const char *const arms[] = {"hand",  "gripper",  "finger", "palm",
                                   "wrist", "shoulder", "elbow",  NULL};

static int says(const char *name, const char *const *words) {
  for (; *words; words++)
    for (const char *c = name; *c; c++)
      if (strncasecmp(c, *words, strlen(*words)) == 0 && strncasecmp(c, "footprint", 9) != 0)
        return 1;
  return 0;
}

/* whether a link, or one fixed to it, has such a name */
static int is_named(const ambulo__tree *tree, int leader, const char *const *words) {
  for (int i = 0; i < tree->link_count; i++)
    if (says(tree->links[i].name, words) && ambulo__tree_leader(tree, i) == leader) return 1;
  return 0;
}

static int joint_above(const ambulo__tree *tree, int leader) {
  int parent = tree->links[leader].parent;
  return parent < 0 ? -1 : ambulo__tree_leader(tree, parent);
}

static int joints_below(const ambulo__tree *tree, int leader) {
  int count = 0;
  for (int i = 0; i < tree->link_count; i++)
    count += tree->links[i].type != AMBULO_FIXED && joint_above(tree, i) == leader;
  return count;
}

static void place_in(const body *b, int link, double at[3]) {
  ambulo__rigid place = ambulo__tree_pose_of(b->tree, link, 1);
  for (int i = 0; i < 3; i++) at[i] = ambulo__dot(b->axes[i], place.p);
}

/* lowest point of what is fixed to a link in the start pose; of its joint, where that has no
 * geometry. *known: it has some. */
static double height_of(body *b, int leader, int *known) {
  double at[3], height;
  place_in(b, leader, at);
  *known = ambulo__height_of(b->tree, leader, b->axes, &height);
  return *known ? height : at[2];
}

/* ------------------------------------------------------------------------- limbs */

static char side_of(const ambulo__tree *tree, int link, int top) {
  for (int i = link; i >= 0; i = tree->links[i].parent) {
    char side = ambulo__side_of_link(tree, i);
    if (side || i == top) return side;
  }
  return 0;
}

/* the first link of the leg that a link belongs to: while names say one side, or nothing parts */
static int top_of(const body *b, int link, char side) {
  const ambulo__tree *t = b->tree;
  for (int above = joint_above(t, link); above >= 0 && above != b->trunk;
       above = joint_above(t, link)) {
    int same = side ? side_of(t, above, above) == side : joints_below(t, above) == 1;
    if (!same && joints_below(t, above) > 1) return link;
    if (!same && ambulo__tree_leader(t, above) == b->trunk) return link;
    link = above;
  }
  return link;
}

/* the foot of the limb that ends with a link */
static limb limb_of(body *b, int end) {
  ambulo__tree *t = b->tree;
  limb l = {.link = end};
  for (int i = end; i >= 0 && i != b->trunk; i = joint_above(t, i)) {
    if (i != end && joints_below(t, i) > 1) break;
    int known = 0, named = is_named(t, i, footed);
    double height = height_of(b, i, &known);
    double most = l.height + (known ? 1e-3 : -1e-3);
    if (named != l.named ? l.named : i != end && height > most) continue;
    l.link = i;
    l.height = height;
    l.known = known;
    l.named = named;
  }
  char side = side_of(t, l.link, l.link);
  l.top = top_of(b, l.link, side);
  l.side = side ? side : side_of(t, l.link, l.top);
  for (int k = 0; k < t->solid_count; k++)
    l.shaped |= ambulo__tree_leader(t, t->solids[k].link) == l.link;
  for (int i = l.link; !l.named && i >= 0 && i != b->trunk; i = joint_above(t, i))
    l.arm |= is_named(t, i, arms);
  double at[3];
  place_in(b, l.link, at);
  l.along = at[0];
  l.across = at[1];
  return l;
}

/* of limbs of one leg one stays: that with a named foot, then the lower one */
static void add_limb(body *b, limb l) {
  for (int i = 0; i < b->count; i++) {
    limb *other = &b->limbs[i];
    if (other->top != l.top) continue;
    int better = l.named != other->named   ? l.named
                 : l.known != other->known ? l.known
                                           : l.height < other->height;
    if (better) *other = l;
    return;
  }
  if (b->count < MOST_LIMBS) b->limbs[b->count++] = l;
}

static void find_limbs(body *b) {
  const ambulo__tree *t = b->tree;
  b->trunk = t->trunk;
  for (int i = 0; i < t->link_count && b->trunk >= 0; i++)
    if (t->links[i].type != AMBULO_FIXED && i != b->trunk && joints_below(t, i) == 0 &&
        ambulo__tree_hangs_on(t, i, b->trunk))
      add_limb(b, limb_of(b, i));
  if (b->count == 0 && b->trunk >= 0 && is_named(t, b->trunk, footed))
    b->limbs[b->count++] = (limb){.link = b->trunk, .top = b->trunk, .named = 1, .known = 1};
}

static void keep(body *b, int (*wanted)(const limb *l, double most), double most) {
  int kept = 0;
  for (int i = 0; i < b->count; i++)
    if (wanted(&b->limbs[i], most)) b->limbs[kept++] = b->limbs[i];
  b->count = kept;
}

static int with_name(const limb *l, double most) {
  (void)most;
  return l->named;
}

static int may_be_a_leg(const limb *l, double most) {
  (void)most;
  return !l->arm && l->shaped;
}

static int not_higher(const limb *l, double most) {
  return l->height <= most;
}

/* Which limbs are legs. *legless: limbs have geometry, and none of them reaches lower than the
 * trunk.
 */
static void keep_legs(body *b, int *legless) {
  double lowest = INFINITY, top = -INFINITY, at[3];
  int named = 0, known = 0, shaped = 0;
  for (int i = 0; i < b->count; i++) {
    named |= b->limbs[i].named;
    shaped |= b->limbs[i].shaped;
  }
  *legless = 0;
  if (named) {
    keep(b, with_name, 0.0);
    return;
  }
  keep(b, may_be_a_leg, 0.0);
  for (int i = 0; i < b->count; i++) lowest = fmin(lowest, b->limbs[i].height);
  for (int i = 0; i < b->tree->link_count; i++) {
    place_in(b, i, at);
    top = fmax(top, at[2]);
  }
  double trunk = b->trunk < 0 ? INFINITY : height_of(b, b->trunk, &known);
  if (!(lowest < trunk - level)) b->count = 0;
  keep(b, not_higher, lowest + reach * fmax(top - lowest, 0.0));
  *legless = shaped && b->count == 0;
}

/* ------------------------------------------------------------------------- names */

static int from_the_front(const void *a, const void *b) {
  const limb *first = a, *second = b;
  double ahead = second->along - first->along;
  if (fabs(ahead) > 1e-3) return ahead > 0.0 ? 1 : -1;
  return (first->side == 'r') - (second->side == 'r');
}

/* fl, fr, ml, ..: which of `count` on a side, from the front */
static const char *name_of(ambulo__arena *arena, int at, int count, char side) {
  static const char *const places[] = {"", "", "fh", "fmh"};
  if (count == 1) return side == 'l' ? "left" : "right";
  if (count <= 3) return ambulo__arena_print(arena, "%c%c", places[count][at], side);
  return ambulo__arena_print(arena, "%c%d", side, at + 1);
}

static int count_side(const body *b, char side) {
  int count = 0;
  for (int i = 0; i < b->count; i++) count += b->limbs[i].side == side;
  return count;
}

static int name_legs(body *b, ambulo__leg *legs, int most) {
  int used = 0;
  double middle = 0.0;
  for (int i = 0; i < b->count; i++) middle += b->limbs[i].across / b->count;
  for (int i = 0; i < b->count; i++) {
    limb *l = &b->limbs[i];
    double off = l->across - middle;
    if (!l->side && fabs(off) > beside) l->side = off > 0.0 ? 'l' : 'r';
  }
  int left = count_side(b, 'l'), right = count_side(b, 'r'), seen[2] = {0, 0};
  int sided = left == right || left + right == 1;
  qsort(b->limbs, (size_t)b->count, sizeof b->limbs[0], from_the_front);
  if (left <= 1 && right <= 1)
    for (int i = 1; i < b->count; i++) /* the right one first, as of old */
      if (b->limbs[i].side == 'r' && b->limbs[i - 1].side != 'r') {
        limb other = b->limbs[i];
        b->limbs[i] = b->limbs[i - 1];
        b->limbs[i - 1] = other;
      }
  for (int i = 0; i < b->count && used < most; i++) {
    const limb *l = &b->limbs[i];
    int k = l->side == 'r';
    legs[used].link = l->link;
    legs[used++].name = sided && l->side
                            ? name_of(b->tree->arena, seen[k]++, k ? right : left, l->side)
                            : b->tree->links[l->link].name;
  }
  return used;
}

int ambulo__find_legs(ambulo__tree *tree, const double axes[3][3], ambulo__leg *legs, int most,
                      int *legless) {
  body b = {.tree = tree, .axes = axes};
  find_limbs(&b);
  keep_legs(&b, legless);
  return name_legs(&b, legs, most);
}

/* ------------------------------------------------------------------- what is wrong */

static double lowest_of(const body *b, const ambulo__tree_foot *foot) {
  const int points[4] = {foot->heel[0], foot->heel[1], foot->toe[0], foot->toe[1]};
  double lowest = INFINITY;
  for (int k = 0; k < 4; k++) {
    double at[3];
    if (points[k] < 0) continue;
    const ambulo__tree_point *p = &b->tree->points[points[k]];
    ambulo__rigid place = ambulo__tree_pose_of(b->tree, p->link, 1);
    ambulo__rigid_point(&place, p->position, at);
    lowest = fmin(lowest, ambulo__dot(at, b->axes[2]));
  }
  return lowest;
}

/* links of the same leg, and without one of the same side */
void ambulo__check_feet(ambulo__tree *tree, const double axes[3][3]) {
  body b = {.tree = tree, .axes = axes};
  find_limbs(&b);
  for (int f = 0; f < tree->foot_count; f++) {
    const ambulo__tree_foot *foot = &tree->feet[f];
    int leader = ambulo__tree_leader(tree, foot->link), lowest = -1;
    char side = side_of(tree, leader, leader);
    int top = top_of(&b, leader, side);
    double own = lowest_of(&b, foot), least = own - level;
    for (int i = 0; i < tree->link_count; i++) {
      int known = 0;
      if (tree->links[i].type == AMBULO_FIXED || i == leader || i == b.trunk) continue;
      if (top_of(&b, i, side_of(tree, i, i)) != top) continue;
      double height = height_of(&b, i, &known);
      if (!known || !(height < least)) continue;
      least = height;
      lowest = i;
    }
    if (lowest >= 0)
      ambulo__tree_note(tree, tree->links[leader].node,
                        "the foot '%s' is on %s, which is not the lowest link of its leg: in the "
                        "start pose %s is %s m lower; --foot %s=LINK chooses another",
                        foot->name, tree->links[foot->link].name, tree->links[lowest].name,
                        ambulo__three_digits(own - least).text, foot->name);
  }
}

/* ----------------------------------------------------------------------- forward */

/* sum of what leads from links that are called right to their partners; its length against that of
 * all of them */
static double left_by_names(const ambulo__tree *tree, const double up[3], double left[3]) {
  double size = 0.0;
  for (int i = 0; i < 3; i++) left[i] = 0.0;
  for (int i = 0; i < tree->link_count; i++) {
    int other = ambulo__partner_link(tree, i);
    if (other < 0 || ambulo__side_of_link(tree, i) != 'l') continue;
    ambulo__rigid a = ambulo__tree_place(tree, i), b = ambulo__tree_place(tree, other);
    double apart[3];
    for (int k = 0; k < 3; k++) apart[k] = a.p[k] - b.p[k];
    double rise = ambulo__dot(apart, up);
    for (int k = 0; k < 3; k++) left[k] += apart[k] - rise * up[k];
    size += sqrt(ambulo__dot(apart, apart));
  }
  double length = ambulo__normalize(left);
  return size > beside ? length / size : 0.0;
}

/* how far the soles reach ahead of their joints, less how far behind, m */
static double ahead_by_soles(ambulo__tree *tree, const double axes[3][3]) {
  enum { MOST = 2 };
  ambulo__leg legs[MOST];
  int legless = 0, count = ambulo__find_legs(tree, axes, legs, MOST, &legless);
  double ahead = 0.0;
  for (int k = 0; k < count; k++) {
    ambulo__sole sole;
    int leader = ambulo__tree_leader(tree, legs[k].link);
    if (!ambulo__sole_of(tree, leader, axes, &sole) || sole.is_point) continue;
    ambulo__rigid place = ambulo__tree_pose_of(tree, leader, sole.start);
    double at = ambulo__dot(axes[0], place.p);
    ahead += sole.along[1] + sole.along[0] - 2.0 * at;
  }
  return ahead;
}

/* the axis of the world within 10 degrees; 0: none */
static int nearest_axis(double v[3]) {
  for (int i = 0; i < 3; i++) {
    if (fabs(v[i]) < 0.985) continue;
    double sign = v[i] > 0.0 ? 1.0 : -1.0;
    for (int k = 0; k < 3; k++) v[k] = k == i ? sign : 0.0;
    return 1;
  }
  return 0;
}

int ambulo__find_forward(ambulo__tree *tree) {
  double axes[3][3], left[3], forward[3];
  ambulo__tree_axes(tree, axes);
  double agreed = left_by_names(tree, axes[2], left);
  ambulo__cross(left, axes[2], forward);
  int backwards = !(agreed > 0.0) && ahead_by_soles(tree, (const double(*)[3])axes) < -level;
  if (!backwards && !(agreed > 0.5 && nearest_axis(forward))) return 0;
  for (int i = 0; i < 3; i++) tree->forward[i] = backwards ? -tree->forward[i] : forward[i];
  return 1;
}
