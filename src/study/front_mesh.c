/* study/front_mesh.c - three terms: triangles of points, whose longest edges are halved (front.h).
 *
 * The triangle of the anchors is cut at the points that were asked for on its edges, in the order
 * in which they were asked for: a point with parents a and b cuts every triangle that has the edge
 * a b into two. A round halves the longest edges that do not refuse, at most one of each triangle.
 * (Bisection of the longest edge keeps triangles from becoming slivers: Rivara 1984.) */
#include "study/front.h"

typedef struct triangle {
  int corner[3];
  int used; /* 1: one of its edges is halved in this round */
} triangle;

typedef struct mesh {
  const ambulo__front *front;
  triangle *triangle; /* [count] */
  int count;
} mesh;

static int corner_of(const triangle *t, int point) {
  for (int i = 0; i < 3; i++)
    if (t->corner[i] == point) return i;
  return -1;
}

/* a point that a triangle may have: its motion is its own */
static int stands(const ambulo__front *f, int k) {
  return f->point[k].standing == AMBULO__FRONT_ON ||
         f->point[k].standing == AMBULO__FRONT_DOMINATED;
}

static void cut(mesh *m, int point) {
  const int *parent = m->front->point[point].parent;
  if (parent[0] < 0 || !stands(m->front, point)) return;
  for (int i = 0, count = m->count; i < count; i++) {
    int a = corner_of(&m->triangle[i], parent[0]), b = corner_of(&m->triangle[i], parent[1]);
    if (a < 0 || b < 0) continue;
    m->triangle[m->count] = m->triangle[i];
    m->triangle[m->count++].corner[a] = point;
    m->triangle[i].corner[b] = point;
  }
}

/* of a triangle that is not used: its longest edge that leads somewhere. Returns its length; 0:
 * none */
static double longest(const mesh *m, const triangle *t, ambulo__front_request *request) {
  static const double shares[] = {0.5, 0.35, 0.65};
  double most = 0.0;
  for (int i = 0; i < 3 && !t->used; i++) {
    int a = t->corner[i], b = t->corner[(i + 1) % 3];
    double length = ambulo__front_distance(m->front, a, b);
    if (length <= most || ambulo__front_is_refused(m->front, a < b ? a : b, a < b ? b : a))
      continue;
    for (int k = 0; k < 3; k++)
      if (ambulo__front_between(m->front, a < b ? a : b, a < b ? b : a, shares[k], request)) break;
    most = length;
  }
  return most;
}

/* the longest edge of all; every triangle that has it is used then. 0: none */
static int take_longest(mesh *m, ambulo__front_request *request) {
  double most = 0.0;
  for (int i = 0; i < m->count; i++) {
    ambulo__front_request one;
    double length = longest(m, &m->triangle[i], &one);
    if (length <= most) continue;
    most = length;
    *request = one;
  }
  for (int i = 0; i < m->count && most > 0.0; i++)
    if (corner_of(&m->triangle[i], request->parent[0]) >= 0 &&
        corner_of(&m->triangle[i], request->parent[1]) >= 0)
      m->triangle[i].used = 1;
  return most > 0.0;
}

ambulo_status ambulo__front_mesh(const ambulo__front *f, const int anchor[AMBULO__FRONT_TERMS],
                                 const ambulo_allocator *a, ambulo__front_request *requests,
                                 int room, int *count) {
  mesh m = {.front = f, .count = 1};
  /* a cut adds one triangle for each of at most two that have the edge */
  m.triangle = ambulo__alloc(a, 2 * (size_t)f->points + 2, sizeof *m.triangle);
  if (!m.triangle) return AMBULO_E_MEMORY;
  m.triangle[0] = (triangle){{anchor[0], anchor[1], anchor[2]}, 0};
  for (int k = 0; k < f->points; k++) cut(&m, k);
  *count = 0;
  while (*count < room && take_longest(&m, &requests[*count])) (*count)++;
  ambulo__free(a, m.triangle);
  return AMBULO_OK;
}
