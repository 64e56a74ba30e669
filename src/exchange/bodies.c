/* exchange/bodies.c - from links to bodies (export.h).
 *
 * A link's transform (model.h) is its joint, about or along the parent's z, then a constant:
 * T(q) = J(z, q) F. Links are taken in order. What lies between a body and the next one is an open
 * chain: before, axes, after. To append a joint about z to it is to append the axis after.R z, as
 * J commutes with nothing but sliders: J(a) after = after J(after.R' a). That needs the two to pass
 * through one point, after.p = 0; behind sliders, or along the one hinge, after.p commutes and
 * moves into `before`. What cannot be appended makes its parent a body without mass.
 */
#include "exchange/export.h"

#include <math.h>
#include <string.h>

#include "base/arithmetic.h"

typedef struct chain {
  int parent, joints;
  int link_of[AMBULO__JOINT_MOST], coordinate[AMBULO__JOINT_MOST];
  double axis[AMBULO__JOINT_MOST][3];
  ambulo__rigid before, after;
} chain;

typedef struct builder {
  ambulo__bodies *bodies;
  chain *open;           /* [links]: the chain that ends in a link that is no body */
  unsigned char *closed; /* [links]: in body_of and place */
  unsigned char *kept;   /* [links]: points or branches need its frame */
} builder;

/* below this, m, two points are one: what is left of sines of right angles */
static const double same_point = 1e-14;
/* sine of the least angle between axes of a joint */
static const double least_angle = 1e-3;

ambulo__rigid ambulo__link_transform(const ambulo_link *link, double q) {
  static const double x[3] = {1, 0, 0}, z[3] = {0, 0, 1};
  int slides = link->type == AMBULO_PRISMATIC;
  const double p[3] = {link->a, 0.0, link->d + (slides ? q : 0.0)};
  ambulo__rigid theta = ambulo__rigid_turn(z, link->theta + (slides ? 0.0 : q)),
                alpha = ambulo__rigid_turn(x, link->alpha);
  ambulo__rigid shift = ambulo__rigid_shift(p), all = ambulo__rigid_times(&theta, &shift);
  return ambulo__rigid_times(&all, &alpha);
}

ambulo__rigid ambulo__ground_turn(const ambulo_model *model, ambulo__ground_axes axes) {
  int up = 0, forward = -1;
  for (int i = 1; i < 3; i++)
    if (fabs(model->up[i]) > fabs(model->up[up])) up = i;
  for (int i = 0; i < 3; i++)
    if (i != up && (forward < 0 || fabs(model->forward[i]) > fabs(model->forward[forward])))
      forward = i;
  ambulo__rigid turn = {.p = {0.0}};
  int row = axes == AMBULO__Y_UP ? 1 : 2, last = 3 - row;
  turn.r[row][up] = model->up[up] < 0.0 ? -1.0 : 1.0;
  turn.r[0][forward] = model->forward[forward] < 0.0 ? -1.0 : 1.0;
  ambulo__cross(turn.r[(last + 1) % 3], turn.r[(last + 2) % 3], turn.r[last]);
  return turn;
}

/* ------------------------------------------------------------------------ bodies */

static void copy_mass(const ambulo_link *link, const ambulo__rigid *place,
                      ambulo__export_body *body) {
  body->mass = link->mass;
  if (!(link->mass > 0.0)) return;
  ambulo__rigid_point(place, link->com, body->com);
  ambulo__inertia_turn((const double(*)[3])place->r, link->inertia, body->inertia);
}

/* the origin of a hinge's body onto its axis; returns where the link's own frame is then */
static ambulo__rigid onto_axis(const ambulo_model *model, chain *c) {
  double along, off[3], local[3];
  if (c->joints != 1 || model->links[c->link_of[0]].type != AMBULO_REVOLUTE)
    return ambulo__rigid_identity();
  along = ambulo__dot(c->axis[0], c->after.p);
  for (int i = 0; i < 3; i++) {
    off[i] = c->after.p[i] - along * c->axis[0][i];
    c->after.p[i] -= off[i];
  }
  ambulo__rigid_back(&c->after, off, local);
  return ambulo__rigid_shift(local);
}

/* what commutes stands as well in front of the joints */
static void move_before(chain *c) {
  ambulo__rigid shift = ambulo__rigid_shift(c->after.p);
  c->before = ambulo__rigid_times(&c->before, &shift);
  memset(c->after.p, 0, sizeof c->after.p);
}

static int all_slide(const ambulo_model *model, const chain *c) {
  for (int i = 0; i < c->joints; i++)
    if (model->links[c->link_of[i]].type != AMBULO_PRISMATIC) return 0;
  return 1;
}

/* after.p commutes with the chain: behind sliders alone, or along their one hinge */
static int commutes(const ambulo_model *model, const chain *c) {
  double off[3];
  int hinges = 0;
  for (int i = 0; i < c->joints; i++) hinges += model->links[c->link_of[i]].type == AMBULO_REVOLUTE;
  if (hinges > 1) return 0;
  if (hinges == 0) return 1;
  ambulo__cross(c->axis[c->joints - 1], c->after.p, off);
  return sqrt(ambulo__dot(off, off)) < same_point;
}

static void close_link(builder *b, int link) {
  ambulo__bodies *bodies = b->bodies;
  const ambulo_model *model = bodies->model;
  chain c = b->open[link];
  if (c.joints && !bodies->single && all_slide(model, &c)) move_before(&c);
  bodies->place[link] = bodies->single ? onto_axis(model, &c) : ambulo__rigid_identity();
  bodies->body_of[link] = bodies->count;
  b->closed[link] = 1;
  ambulo__export_body *body = &bodies->list[bodies->count++];
  *body = (ambulo__export_body){.name = model->links[link].name,
                                .parent = c.parent,
                                .link = link,
                                .joints = c.joints,
                                .before = c.before,
                                .after = c.after};
  memcpy(body->link_of, c.link_of, sizeof body->link_of);
  memcpy(body->coordinate, c.coordinate, sizeof body->coordinate);
  memcpy(body->axis, c.axis, sizeof body->axis);
  copy_mass(&model->links[link], &bodies->place[link], body);
}

/* ------------------------------------------------------------------------ chains */

/* the axis is far from those of its kind, and from their plane */
static int is_independent(const ambulo_model *model, const chain *c, ambulo_joint_type type,
                          const double axis[3]) {
  const double *same[AMBULO__JOINT_MOST];
  int count = 0;
  double normal[3];
  for (int i = 0; i < c->joints; i++)
    if (model->links[c->link_of[i]].type == type) same[count++] = c->axis[i];
  if (count > 2) return 0;
  for (int i = 0; i < count; i++) {
    ambulo__cross(same[i], axis, normal);
    if (sqrt(ambulo__dot(normal, normal)) < least_angle) return 0;
  }
  if (count < 2) return 1;
  ambulo__cross(same[0], same[1], normal);
  return fabs(ambulo__dot(normal, axis)) > least_angle;
}

static int can_append(const ambulo__bodies *bodies, const chain *c, ambulo_joint_type type,
                      const double axis[3]) {
  if (c->joints == 0) return 1;
  if (bodies->single) return 0;
  int slide = all_slide(bodies->model, c);
  int meets = ambulo__dot(c->after.p, c->after.p) <= same_point * same_point;
  if (!slide && (type == AMBULO_PRISMATIC || (!meets && !commutes(bodies->model, c)))) return 0;
  return is_independent(bodies->model, c, type, axis);
}

static chain chain_at(const builder *b, int link) {
  const ambulo__bodies *bodies = b->bodies;
  if (link >= 0 && !b->closed[link]) return b->open[link];
  chain c = {.parent = link < 0 ? -1 : bodies->body_of[link],
             .before = link < 0 ? bodies->world : bodies->place[link],
             .after = ambulo__rigid_identity()};
  return c;
}

static void append_link(builder *b, int index) {
  const ambulo_model *model = b->bodies->model;
  const ambulo_link *link = &model->links[index];
  static const double z[3] = {0, 0, 1};
  ambulo__rigid constant = ambulo__link_transform(link, 0.0);
  chain c = chain_at(b, link->parent);
  if (link->type != AMBULO_FIXED) {
    double axis[3];
    ambulo__rigid_vector(&c.after, z, axis);
    if (!can_append(b->bodies, &c, link->type, axis)) {
      close_link(b, link->parent);
      c = chain_at(b, link->parent);
      memcpy(axis, z, sizeof axis);
    }
    if (c.joints && commutes(model, &c)) move_before(&c);
    memcpy(c.axis[c.joints], axis, sizeof axis);
    c.link_of[c.joints] = index;
    c.coordinate[c.joints++] = link->coordinate;
  }
  ambulo__rigid *last = c.joints ? &c.after : &c.before;
  *last = ambulo__rigid_times(last, &constant);
  b->open[index] = c;
}

static void add_link(builder *b, int index) {
  ambulo__bodies *bodies = b->bodies;
  append_link(b, index);
  const chain *c = &b->open[index];
  int has_mass = bodies->model->links[index].mass > 0.0;
  if (c->joints == 0 && !has_mass) {
    bodies->body_of[index] = c->parent;
    bodies->place[index] = c->before;
    b->closed[index] = 1;
  } else if (has_mass || bodies->single || b->kept[index]) {
    close_link(b, index);
  }
}

/* A point that stays where it is while the joints behind it turn: a hinge's origin (place_open). */
static int is_center(const ambulo_model *model, const ambulo_point *point) {
  return model->links[point->link].type == AMBULO_REVOLUTE &&
         ambulo__dot(point->position, point->position) == 0.0;
}

/* frames that are asked for: of leaves, of branches, of points */
static void find_kept(builder *b) {
  const ambulo_model *model = b->bodies->model;
  for (int i = 0; i < model->link_count; i++) {
    int children = 0;
    for (int k = i + 1; k < model->link_count; k++) children += model->links[k].parent == i;
    b->kept[i] = children != 1;
  }
  for (int i = 0; i < model->point_count; i++)
    if (!is_center(model, &model->points[i])) b->kept[model->points[i].link] = 1;
}

/* Links that became parts of a joint: fixed in the body behind them with all its joints done, else
 * by their origin alone, through which the hinges that follow go. */
static void place_open(builder *b) {
  ambulo__bodies *bodies = b->bodies;
  const ambulo_model *model = bodies->model;
  for (int i = model->link_count - 1; i >= 0; i--) {
    int child = i + 1;
    if (b->closed[i]) continue;
    while (child < model->link_count && model->links[child].parent != i) child++;
    bodies->body_of[i] = bodies->body_of[child];
    const ambulo__export_body *body = &bodies->list[bodies->body_of[i]];
    ambulo__rigid back = ambulo__rigid_inverse(&body->after);
    bodies->place[i] = b->open[i].joints == body->joints
                           ? ambulo__rigid_times(&back, &b->open[i].after)
                           : ambulo__rigid_shift(back.p);
  }
}

/* ------------------------------------------------------------------ sliders of a root */

/* Where orthogonal sliders that nothing drives carry a body from the ground, its place at q = 0
 * along them becomes part of their values: they then count from the ground's origin. */
static void count_from_ground(ambulo__bodies *bodies, ambulo__export_body *body) {
  const ambulo_coordinate *coordinates = bodies->model->coordinates;
  double rest[3];
  int sliders = 0;
  while (sliders < body->joints &&
         bodies->model->links[body->link_of[sliders]].type == AMBULO_PRISMATIC)
    sliders++;
  for (int i = 0; i < sliders; i++) {
    if (body->coordinate[i] < 0 || coordinates[body->coordinate[i]].actuated) return;
    for (int k = 0; k < i; k++)
      if (fabs(ambulo__dot(body->axis[i], body->axis[k])) > 1e-12) return;
  }
  memcpy(rest, body->before.p, sizeof rest);
  for (int i = 0; i < sliders; i++) {
    double axis[3];
    ambulo__rigid_vector(&body->before, body->axis[i], axis);
    double along = ambulo__dot(axis, body->before.p);
    bodies->offset[body->coordinate[i]] = along;
    for (int k = 0; k < 3; k++) rest[k] -= along * axis[k];
  }
  for (int k = 0; k < 3 && sliders; k++)
    body->before.p[k] = fabs(rest[k]) < same_point ? 0.0 : rest[k];
}

int ambulo__free_root(const ambulo_model *model) {
  int at = -1, coordinates = 0;
  for (;;) {
    int child = -1, children = 0;
    for (int k = 0; k < model->link_count; k++) {
      if (model->links[k].parent != at) continue;
      child = k;
      children++;
    }
    if (children != 1) break;
    int c = model->links[child].coordinate;
    if (c >= 0 && (model->coordinates[c].actuated || coordinates == 6)) break;
    coordinates += c >= 0;
    at = child;
    if (model->links[at].mass > 0.0) break;
  }
  return coordinates > 0 ? at : -1;
}

/* ------------------------------------------------------------------------ building */

static void build(builder *b) {
  ambulo__bodies *bodies = b->bodies;
  const ambulo_model *model = bodies->model;
  find_kept(b);
  for (int i = 0; i < model->link_count; i++) {
    int waits = bodies->root >= 0 && i < bodies->root; /* the way to the root: its only ancestors */
    if (waits) {
      bodies->body_of[i] = -1;
      bodies->place[i] = ambulo__rigid_identity();
      b->closed[i] = 1;
    } else if (i == bodies->root) {
      b->open[i] = (chain){
          .parent = -1, .before = ambulo__rigid_identity(), .after = ambulo__rigid_identity()};
      close_link(b, i);
    } else {
      add_link(b, i);
    }
  }
  place_open(b);
}

static ambulo_status create(const ambulo_model *model, int single, int root,
                            const ambulo_allocator *allocator, ambulo__bodies *bodies) {
  size_t links = (size_t)model->link_count;
  ambulo__bodies made = {.allocator = ambulo__allocator_or_default(allocator),
                         .model = model,
                         .single = single,
                         .root = root};
  builder b = {.bodies = &made};
  made.world = ambulo__ground_turn(model, single ? AMBULO__Z_UP : AMBULO__Y_UP);
  made.list = ambulo__alloc(&made.allocator, links, sizeof *made.list);
  made.body_of = ambulo__alloc(&made.allocator, links, sizeof *made.body_of);
  made.place = ambulo__alloc(&made.allocator, links, sizeof *made.place);
  made.offset =
      ambulo__alloc(&made.allocator, (size_t)model->coordinate_count, sizeof *made.offset);
  b.open = ambulo__alloc(&made.allocator, links, sizeof *b.open);
  b.closed = ambulo__alloc(&made.allocator, links, sizeof *b.closed);
  b.kept = ambulo__alloc(&made.allocator, links, sizeof *b.kept);
  int complete =
      made.list && made.body_of && made.place && made.offset && b.open && b.closed && b.kept;
  if (complete) build(&b);
  for (int i = 0; complete && !single && i < made.count; i++)
    if (made.list[i].parent < 0) count_from_ground(&made, &made.list[i]);
  ambulo__free(&made.allocator, b.open);
  ambulo__free(&made.allocator, b.closed);
  ambulo__free(&made.allocator, b.kept);
  if (!complete) {
    ambulo__bodies_free(&made);
    return AMBULO_E_MEMORY;
  }
  *bodies = made;
  return AMBULO_OK;
}

ambulo_status ambulo__bodies_merged(const ambulo_model *model, const ambulo_allocator *allocator,
                                    ambulo__bodies *bodies) {
  return create(model, 0, -1, allocator, bodies);
}

ambulo_status ambulo__bodies_single(const ambulo_model *model, int free_root,
                                    const ambulo_allocator *allocator, ambulo__bodies *bodies) {
  return create(model, 1, free_root ? ambulo__free_root(model) : -1, allocator, bodies);
}

void ambulo__bodies_free(ambulo__bodies *bodies) {
  ambulo__free(&bodies->allocator, bodies->list);
  ambulo__free(&bodies->allocator, bodies->body_of);
  ambulo__free(&bodies->allocator, bodies->place);
  ambulo__free(&bodies->allocator, bodies->offset);
  *bodies = (ambulo__bodies){.count = 0};
}

void ambulo__body_point(const ambulo__bodies *bodies, int link, const double local[3],
                        double out[3]) {
  ambulo__rigid_point(&bodies->place[link], local, out);
}
