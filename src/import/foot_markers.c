/* import/foot_markers.c - heels and toes of a foot without geometry, from markers and toe bodies.
 *
 * Models of people that are made for muscles have no geometry that touches the ground, but their
 * heel bone has its frame low at the heel, and toes are a body of their own behind the ball. So, at
 * q = 0,
 *
 *   heel     where the hindmost marker is that is called a heel's (R.Heel, RHEE, RCAL), else the
 *            frame of the foot's link
 *   toe      the frame of a link below it that is called toes, else the foremost marker that is
 *            called a toe's
 *   height   the lower of the two frames; without toes, the lowest of frame and markers
 *   width    two fifths of the length, about the frames: that of people's soles at the ball
 *
 * Both sides of a body get the mean of their lengths and heights, so that a few millimetres between
 * the markers of the one and the other side do not make it lopsided. */
#include "import/body_tree.h"

#include "base/arithmetic.h"

#include <math.h>
#include <string.h>
#include <strings.h>

static const double width_share = 0.4, shortest = 0.02, longest = 1.0; /* m */

enum { MOST_MARKERS = 2000 };

void ambulo__tree_add_marker(ambulo__tree *t, const char *name, int link, const double at[3]) {
  if (t->marker_count >= MOST_MARKERS ||
      !ambulo__arena_grow(t->arena, &t->markers, t->marker_count, &t->marker_capacity,
                          sizeof *t->markers))
    return;
  ambulo__tree_point marker = {.name = name, .link = link};
  memcpy(marker.position, at, sizeof marker.position);
  t->markers[t->marker_count++] = marker;
}

static int says(const char *name, const char *const *words, size_t count) {
  for (size_t i = 0; i < count; i++)
    for (const char *c = name; *c; c++)
      if (strncasecmp(c, words[i], strlen(words[i])) == 0) return 1;
  return 0;
}

static int is_heel(const char *name) {
  static const char *const words[] = {"heel", "hee", "cal"};
  return says(name, words, 3);
}

static int is_toe(const char *name) {
  static const char *const words[] = {"toe"};
  return says(name, words, 1);
}

static int is_below(const ambulo__tree *t, int link, int foot) {
  for (; link >= 0; link = t->links[link].parent)
    if (link == foot) return 1;
  return 0;
}

/* along forward, left and up of a place on a link at q = 0 */
static void seen(const ambulo__tree *t, int link, const double local[3], const double axes[3][3],
                 double at[3]) {
  double world[3];
  ambulo__rigid place = ambulo__tree_place(t, link);
  ambulo__rigid_point(&place, local, world);
  for (int i = 0; i < 3; i++) at[i] = ambulo__dot(world, axes[i]);
}

/* what is known of the foot of one side */
typedef struct guess {
  double heel[3], toe[3], height;
  const char *heel_of, *toe_of;
} guess;

static void take_markers(const ambulo__tree *t, int foot, const double axes[3][3], int has_toes,
                         guess *g) {
  for (int i = 0; i < t->marker_count; i++) {
    const ambulo__tree_point *m = &t->markers[i];
    int heel = is_heel(m->name), toe = !has_toes && !heel && is_toe(m->name);
    double at[3];
    if ((!heel && !toe) || !is_below(t, m->link, foot)) continue;
    seen(t, m->link, m->position, axes, at);
    if (heel && at[0] < g->heel[0]) {
      g->heel[0] = at[0];
      g->heel_of = m->name;
    }
    if (toe && (!g->toe_of || at[0] > g->toe[0])) {
      memcpy(g->toe, at, sizeof at);
      g->toe_of = m->name;
    }
    if (!has_toes) g->height = fmin(g->height, at[2]);
  }
}

/* 0: it has no toes to tell */
static int look(const ambulo__tree *t, int foot, const double axes[3][3], guess *g) {
  static const double origin[3] = {0, 0, 0};
  *g = (guess){.heel_of = t->links[foot].name};
  seen(t, foot, origin, axes, g->heel);
  g->height = g->heel[2];
  for (int i = 0; i < t->link_count && !g->toe_of; i++) {
    if (i == foot || !is_toe(t->links[i].name) || !is_below(t, i, foot)) continue;
    seen(t, i, origin, axes, g->toe);
    g->toe_of = t->links[i].name;
    g->height = fmin(g->height, g->toe[2]);
  }
  take_markers(t, foot, axes, g->toe_of != NULL, g);
  double length = g->toe[0] - g->heel[0];
  return g->toe_of && length > shortest && length < longest;
}

/* the foot of the other side */
static int partner(const ambulo__tree *t, int foot) {
  char name[AMBULO__MAX_NAME + 1];
  if (!ambulo__other_side(t->links[foot].name, name, sizeof name)) return -1;
  return ambulo__tree_find(t, name);
}

int ambulo__sole_of_markers(ambulo__tree *tree, int link, const char *foot, const double axes[3][3],
                            ambulo__sole *sole) {
  guess own, other;
  if (!look(tree, link, axes, &own)) return 0;
  int opposite = partner(tree, link);
  int both = opposite >= 0 && look(tree, opposite, axes, &other);
  if (!both) other = own;
  double across = 0.5 * (own.heel[1] + own.toe[1]);
  *sole = (ambulo__sole){.height = 0.5 * (own.height + other.height)};
  sole->along[0] = 0.5 * (own.heel[0] + other.heel[0]);
  sole->along[1] = 0.5 * (own.toe[0] + other.toe[0]);
  double half = 0.5 * width_share * (sole->along[1] - sole->along[0]);
  sole->across[0] = across - half;
  sole->across[1] = across + half;
  ambulo__tree_note(tree, tree->links[link].node,
                    "%s: it has no geometry that touches the ground: the foot '%s' has its heel "
                    "at %s and its toe at %s; --heel %s=%s:X,Y,Z with --toe place them otherwise",
                    tree->links[link].name, foot, own.heel_of, own.toe_of, foot,
                    tree->links[link].name);
  return 1;
}
