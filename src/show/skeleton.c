/* show/skeleton.c - lines of a stick figure (skeleton.h). */
#include "show/skeleton.h"
#include "model/neutral_pose.h"
#include "base/arithmetic.h"

#include <math.h>
#include <string.h>

static const double shortest_line = 0.01; /* m */
/* of the whole: below, what is fixed to a link is a sensor, a kneecap (0.0012), a cover */
static const double lightest_body = 0.002;
static const double head_radius = 0.105; /* m, of an adult */

/* --------------------------------------------------------------------- sides */

static void fill_sides(ambulo__skeleton *skeleton) {
  const ambulo_model *model = skeleton->model;
  for (int i = 0; i < model->link_count; i++) {
    const ambulo_link *link = &model->links[i];
    ambulo__side own = AMBULO__MIDDLE;
    if (link->coordinate >= 0) own = ambulo__coordinate_side(model, link->coordinate);
    if (own == AMBULO__MIDDLE && link->parent >= 0) own = skeleton->side[link->parent];
    skeleton->side[i] = own;
  }
}

/* --------------------------------------------------------------------- lines */

static void add_bone(ambulo__skeleton *skeleton, int from, const double *from_at, int to,
                     const double *to_at, ambulo__side side, double head) {
  if (skeleton->bone_count == skeleton->bone_capacity) return;
  ambulo__bone *bone = &skeleton->bones[skeleton->bone_count++];
  static const double origin[3] = {0.0, 0.0, 0.0};
  bone->link[0] = from;
  bone->link[1] = to;
  memcpy(bone->at[0], from_at ? from_at : origin, sizeof origin);
  memcpy(bone->at[1], to_at ? to_at : origin, sizeof origin);
  bone->side = side;
  bone->head = head;
}

/* 1 if nothing between the world and link i, itself included, has a mass */
static int is_massless_root(const ambulo_model *model, int i) {
  for (; i >= 0; i = model->links[i].parent) {
    if (model->links[i].mass > 0.0) return 0;
  }
  return 1;
}

/* 1 if the line from the parent's joint to this link's is drawn */
static int has_own_line(const ambulo__skeleton *skeleton, int i) {
  const ambulo_model *model = skeleton->model;
  const ambulo_link *link = &model->links[i];
  if (is_massless_root(model, i) || !skeleton->bears[i]) return 0;
  if (link->coordinate >= 0 && !model->coordinates[link->coordinate].actuated) return 0;
  if (link->type == AMBULO_PRISMATIC) return 1;
  return hypot(link->a, link->d) > shortest_line;
}

/* a step along the joint's own axis does not turn with the joint: it belongs to the parent */
static ambulo__side line_side(const ambulo__skeleton *skeleton, int i) {
  const ambulo_link *link = &skeleton->model->links[i];
  int along_axis = link->type == AMBULO_REVOLUTE && fabs(link->a) <= shortest_line;
  return along_axis && link->parent >= 0 ? skeleton->side[link->parent] : skeleton->side[i];
}

/* heel and toe centres of the feet; the line runs ankle - heel - toe - ankle */
static void add_feet(ambulo__skeleton *skeleton) {
  const ambulo_model *model = skeleton->model;
  for (int f = 0; f < model->foot_count; f++) {
    const ambulo_point *heel = &model->points[model->feet[f].heel_center];
    const ambulo_point *toe = &model->points[model->feet[f].toe_center];
    ambulo__side side = skeleton->side[heel->link];
    add_bone(skeleton, heel->link, NULL, heel->link, heel->position, side, 0.0);
    add_bone(skeleton, heel->link, heel->position, toe->link, toe->position, side, 0.0);
    add_bone(skeleton, toe->link, toe->position, heel->link, NULL, side, 0.0);
  }
}

static int link_has_point(const ambulo_model *model, int link) {
  for (int p = 0; p < model->point_count; p++) {
    if (model->points[p].link == link) return 1;
  }
  return 0;
}

/* parents stand before their children */
static void find_joints(ambulo__skeleton *skeleton) {
  const ambulo_model *model = skeleton->model;
  double whole = 0.0;
  for (int i = 0; i < model->link_count; i++) {
    const ambulo_link *link = &model->links[i];
    int stays = link->parent >= 0 && link->type != AMBULO_PRISMATIC &&
                hypot(link->a, link->d) <= shortest_line;
    skeleton->joint[i] = stays ? skeleton->joint[link->parent] : i;
    whole += link->mass;
  }
  for (int i = model->link_count - 1; i >= 0; i--) {
    const ambulo_link *link = &model->links[i];
    skeleton->bears[i] |= link->mass > lightest_body * whole || link_has_point(model, i) ||
                          (link->coordinate >= 0 && link->mass > 0.0);
    if (link->parent >= 0) skeleton->bears[link->parent] |= skeleton->bears[i];
  }
}

/* 1 if something is drawn from the joint of link i: a line to the next joint, or to a point */
static int is_joined(const ambulo__skeleton *skeleton, int i) {
  const ambulo_model *model = skeleton->model;
  for (int k = 0; k < model->link_count; k++) {
    int parent = model->links[k].parent;
    if (skeleton->joint[k] == skeleton->joint[i] && link_has_point(model, k)) return 1;
    if (parent >= 0 && skeleton->joint[parent] == skeleton->joint[i] && has_own_line(skeleton, k))
      return 1;
  }
  return 0;
}

/* the line to the head stops below it: the bone's second end is the centre of the head */
static void add_head(ambulo__skeleton *skeleton, const ambulo_point *top) {
  double length = 0.0, center[3];
  for (int k = 0; k < 3; k++) length += top->position[k] * top->position[k];
  length = sqrt(length);
  double radius = length > 3.0 * head_radius ? head_radius : length / 3.0;
  double part = length > 0.0 ? (length - radius) / length : 0.0;
  for (int k = 0; k < 3; k++) center[k] = part * top->position[k];
  add_bone(skeleton, top->link, NULL, top->link, center, skeleton->side[top->link], radius);
}

static int carries_a_foot(const ambulo_model *model, int link) {
  for (int f = 0; f < model->foot_count; f++) {
    const ambulo_foot *foot = &model->feet[f];
    if (model->points[foot->heel_center].link == link ||
        model->points[foot->toe_center].link == link)
      return 1;
  }
  return 0;
}

/* a limb that ends in no joint, a forearm with its hand, reaches to its furthest point */
static void add_limb_ends(ambulo__skeleton *skeleton, int head) {
  const ambulo_model *model = skeleton->model;
  for (int i = 0; i < model->link_count; i++) {
    int is_parent = 0, furthest = -1;
    for (int k = 0; k < model->link_count; k++) is_parent |= model->links[k].parent == i;
    if (is_parent || i == head || has_own_line(skeleton, i) || carries_a_foot(model, i)) continue;
    double length = shortest_line;
    for (int p = 0; p < model->point_count; p++) {
      const double *at = model->points[p].position;
      double away = hypot(hypot(at[0], at[1]), at[2]);
      if (model->points[p].link != i || away <= length) continue;
      furthest = p;
      length = away;
    }
    if (furthest >= 0)
      add_bone(skeleton, i, NULL, i, model->points[furthest].position, skeleton->side[i], 0.0);
  }
}

static void add_lines(ambulo__skeleton *skeleton) {
  const ambulo_model *model = skeleton->model;
  for (int i = 0; i < model->link_count; i++) {
    const ambulo_link *link = &model->links[i];
    if (has_own_line(skeleton, i)) {
      add_bone(skeleton, link->parent, NULL, i, NULL, line_side(skeleton, i), 0.0);
    } else if (link->mass > 0.0 && skeleton->bears[i] && !is_joined(skeleton, i)) {
      double length = hypot(hypot(link->com[0], link->com[1]), link->com[2]);
      if (length > shortest_line) add_bone(skeleton, i, NULL, i, link->com, skeleton->side[i], 0.0);
    }
  }
  add_feet(skeleton);
  int top = ambulo_model_find_point(model, "head_top");
  if (top >= 0) add_head(skeleton, &model->points[top]);
  add_limb_ends(skeleton, top >= 0 ? model->points[top].link : -1);
}

ambulo_status ambulo__skeleton_create(const ambulo_model *model, const ambulo_allocator *allocator,
                                      ambulo__skeleton *skeleton) {
  ambulo__skeleton s = {.allocator = ambulo__allocator_or_default(allocator), .model = model};
  size_t links = (size_t)model->link_count;
  s.bone_capacity = 2 * model->link_count + 3 * model->foot_count + 1;
  s.bones = ambulo__alloc(&s.allocator, (size_t)s.bone_capacity, sizeof *s.bones);
  s.side = ambulo__alloc(&s.allocator, links, sizeof *s.side);
  s.joint = ambulo__alloc(&s.allocator, links, sizeof *s.joint);
  s.bears = ambulo__alloc(&s.allocator, links, sizeof *s.bears);
  ambulo_status status = ambulo__pose_create(model, &s.allocator, &s.pose);
  if (status || !s.bones || !s.side || !s.joint || !s.bears) {
    ambulo__skeleton_free(&s);
    return AMBULO_E_MEMORY;
  }
  fill_sides(&s);
  find_joints(&s);
  add_lines(&s);
  *skeleton = s;
  return AMBULO_OK;
}

void ambulo__skeleton_free(ambulo__skeleton *skeleton) {
  ambulo__free(&skeleton->allocator, skeleton->bones);
  ambulo__free(&skeleton->allocator, skeleton->side);
  ambulo__free(&skeleton->allocator, skeleton->joint);
  ambulo__free(&skeleton->allocator, skeleton->bears);
  ambulo__pose_free(&skeleton->pose);
}

/* ----------------------------------------------------- names of coordinates */

static const double apart = 0.001; /* m: joints nearer than that stand in the median plane */

static int is_letter(char c, char letter) {
  return c == letter || c == letter - 'a' + 'A';
}

static int begins_with(const char *text, const char *word) {
  while (*word && is_letter(*text, *word)) text++, word++;
  return *word == '\0';
}

/* where two names part */
static size_t parting(const char *a, const char *b) {
  size_t i = 0;
  while (a[i] && a[i] == b[i]) i++;
  return i;
}

static ambulo__side side_of_names(const char *own, const char *other) {
  size_t at = parting(own, other);
  if (is_letter(own[at], 'l') && is_letter(other[at], 'r')) return AMBULO__LEFT;
  if (is_letter(own[at], 'r') && is_letter(other[at], 'l')) return AMBULO__RIGHT;
  return AMBULO__MIDDLE;
}

static double stands_left(const ambulo_model *model, int coordinate) {
  static const double origin[3] = {0.0, 0.0, 0.0};
  double world[3];
  ambulo__neutral_place(model, model->coordinate_link[coordinate], origin, world);
  return ambulo__dot(world, model->left);
}

ambulo__side ambulo__coordinate_side(const ambulo_model *model, int coordinate) {
  const ambulo_coordinate *c = &model->coordinates[coordinate];
  if (c->mirror == coordinate) return AMBULO__MIDDLE;
  ambulo__side named = side_of_names(c->name, model->coordinates[c->mirror].name);
  if (named != AMBULO__MIDDLE) return named;
  double left = stands_left(model, coordinate) - stands_left(model, c->mirror);
  if (fabs(left) > apart) return left > 0.0 ? AMBULO__LEFT : AMBULO__RIGHT;
  return c->mirror > coordinate ? AMBULO__RIGHT : AMBULO__LEFT;
}

/* the letters of the side: from[0] up to from[1]; none where the names do not say it */
static void find_side(const char *own, const char *other, size_t from[2]) {
  from[0] = from[1] = parting(own, other);
  if (side_of_names(own, other) == AMBULO__MIDDLE) return;
  const char *at = own + from[0];
  from[1] += begins_with(at, "left") ? 4 : begins_with(at, "right") ? 5 : 1;
}

void ambulo__coordinate_title(const ambulo_model *model, int coordinate, ambulo__text_buffer *out) {
  const ambulo_coordinate *c = &model->coordinates[coordinate];
  size_t side[2];
  find_side(c->name, model->coordinates[c->mirror].name, side);
  int space = 0, first = 1;
  for (size_t k = 0; c->name[k]; k++) {
    char letter = c->name[k];
    if (k >= side[0] && k < side[1]) continue;
    if (letter == '_' || letter == ' ') {
      space = !first;
      continue;
    }
    if (space) ambulo__text_append_char(out, ' ');
    if (first && letter >= 'a' && letter <= 'z') letter = (char)(letter - 'a' + 'A');
    ambulo__text_append_char(out, letter);
    space = first = 0;
  }
}
