/* people/joint_contact.c - see joint_contact.h. */
#include "people/joint_contact.h"

#include <string.h>

#include "base/arithmetic.h"
#include "mechanics/pose.h"

int ambulo__cuts(const ambulo_muscles *muscles, int most, ambulo__cut *cuts) {
  int count = 0;
  for (int i = 0; i < muscles->count; i++)
    for (int p = 0; p < muscles->muscles[i].pull_count; p++) {
      const ambulo_muscle_pull *pull = &muscles->muscles[i].pulls[p];
      int known = 0;
      for (int k = 0; k < count; k++) known |= !strcmp(cuts[k].name, pull->joint);
      if (known || count == most) continue;
      cuts[count++] = (ambulo__cut){pull->joint, pull->link, pull->axes};
    }
  return count;
}

/* ------------------------------------------------------------- accelerations */

typedef struct link_motion {
  double w[3], wd[3], a[3]; /* of its frame, world */
} link_motion;

static void add(double *to, double factor, const double *v) {
  for (int k = 0; k < 3; k++) to[k] += factor * v[k];
}

/* a += w' x r + w x (w x r) */
static void add_turning(const link_motion *m, const double r[3], double a[3]) {
  double swept[3];
  ambulo__add_cross(m->wd, r, 1.0, a);
  ambulo__cross(m->w, r, swept);
  ambulo__add_cross(m->w, swept, 1.0, a);
}

static void move_link(const ambulo__pose *pose, int index, const double *q, const double *qd,
                      const double *qdd, link_motion *all) {
  static const link_motion world = {{0.0}, {0.0}, {0.0}};
  const double origin[3] = {0.0, 0.0, 0.0}, along[3] = {0.0, 0.0, 1.0};
  const ambulo_link *link = &pose->model->links[index];
  const link_motion *parent = link->parent < 0 ? &world : &all[link->parent];
  link_motion *m = &all[index];
  double from[3], end[3], at[3], z[3], r[3], f[AMBULO__COUPLING_SLOPES];
  (void)ambulo__joint_value(pose->model, index, q, f);
  const int c = ambulo__moved_by(pose->model, index);
  const double speed = c < 0 ? 0.0 : qd[c], rate = f[0] * speed;
  const double gain = c < 0 ? 0.0 : f[0] * qdd[c] + f[1] * speed * speed;
  ambulo__pose_point(pose, link->parent, origin, from);
  ambulo__pose_point(pose, link->parent, along, end);
  ambulo__pose_point(pose, index, origin, at);
  for (int k = 0; k < 3; k++) {
    z[k] = end[k] - from[k];
    r[k] = at[k] - from[k];
  }
  *m = *parent;
  if (link->type == AMBULO_REVOLUTE) {
    add(m->w, rate, z);
    add(m->wd, gain, z);
    ambulo__add_cross(parent->w, z, rate, m->wd);
  }
  add_turning(m, r, m->a);
  if (link->type == AMBULO_PRISMATIC) {
    add(m->a, gain, z);
    ambulo__add_cross(parent->w, z, 2.0 * rate, m->a);
  }
}

/* m (a - g) of each link's own body, world */
static void inertial(const ambulo__pose *pose, const double *q, const double *qd, const double *qdd,
                     link_motion *all, double *forces) {
  const ambulo_model *model = pose->model;
  for (int i = 0; i < model->link_count; i++) {
    const ambulo_link *link = &model->links[i];
    const double origin[3] = {0.0, 0.0, 0.0};
    double at[3], center[3], r[3], a[3];
    move_link(pose, i, q, qd, qdd, all);
    ambulo__pose_point(pose, i, origin, at);
    ambulo__pose_point(pose, i, link->com, center);
    for (int k = 0; k < 3; k++) r[k] = center[k] - at[k];
    memcpy(a, all[i].a, sizeof a);
    add_turning(&all[i], r, a);
    for (int k = 0; k < 3; k++) forces[3 * i + k] = link->mass * (a[k] - model->gravity[k]);
  }
}

/* ---------------------------------------------------------------------- cuts */

static int is_below(const ambulo_model *model, int link, int cut) {
  while (link >= 0 && link != cut) link = model->links[link].parent;
  return link == cut;
}

/* what hands below the cut exert on what they hold */
static void add_hands(const ambulo_model *model, const ambulo__cut *cut,
                      const ambulo__cut_motion *motion, int row, double sum[3]) {
  for (int i = 0; i < 2 * motion->holds; i++) {
    int point = motion->hold[i / 2].hand[i % 2];
    if (point < 0 || !is_below(model, model->points[point].link, cut->link)) continue;
    add(sum, 1.0, motion->hand_force + 3 * (2 * motion->holds * row + i));
  }
}

/* (M.7): what the masses below and hands need less what the ground gives, along the axes of the cut
 */
static void cut_force(const ambulo__pose *pose, const ambulo__cut *cut, const double *forces,
                      const ambulo__cut_motion *motion, int row, double out[3]) {
  const ambulo_model *model = pose->model;
  const double *frame = pose->frames + 12 * cut->axes;
  const double *grf = motion->grf ? motion->grf + 3 * row * model->foot_count : NULL;
  double sum[3] = {0.0, 0.0, 0.0};
  for (int i = 0; i < model->link_count; i++)
    if (is_below(model, i, cut->link)) add(sum, 1.0, forces + 3 * i);
  for (int f = 0; grf && f < model->foot_count; f++)
    if (is_below(model, model->points[model->feet[f].heel_center].link, cut->link))
      add(sum, -1.0, grf + 3 * f);
  add_hands(model, cut, motion, row, sum);
  for (int c = 0; c < 3; c++)
    out[c] = frame[c] * sum[0] + frame[4 + c] * sum[1] + frame[8 + c] * sum[2];
}

static double power_of(double x, int exponent) {
  double power = 1.0;
  while (exponent-- > 0) power *= x;
  return power;
}

/* C -= f_i of every muscle that crosses the joint */
static void take_muscles(const ambulo_muscles *muscles, const ambulo__cut *cut, const double *q,
                         const double *force, double contact[3]) {
  for (int i = 0; i < muscles->count; i++) {
    const ambulo_muscle *m = &muscles->muscles[i];
    for (int p = 0; p < m->pull_count; p++) {
      const ambulo_muscle_pull *pull = &m->pulls[p];
      if (strcmp(pull->joint, cut->name) != 0) continue;
      for (int t = 0; t < pull->term_count; t++) {
        double term = force[i];
        for (int k = 0; k < m->coordinate_count; k++)
          term *= power_of(q[m->coordinates[k]], pull->exponents[t][k]);
        add(contact, term, pull->slopes[t]);
      }
    }
  }
}

ambulo_status ambulo__joint_contact(const ambulo_muscles *muscles, const ambulo__cut *cuts,
                                    int count, const ambulo__cut_motion *motion,
                                    const ambulo_allocator *allocator, double *contact,
                                    double *between) {
  const ambulo_model *model = muscles->model;
  size_t d = (size_t)model->coordinate_count, links = (size_t)model->link_count;
  ambulo__pose pose = {.model = NULL};
  link_motion *all = ambulo__alloc(allocator, links, sizeof *all);
  double *forces = ambulo__alloc(allocator, 3 * links, sizeof *forces);
  ambulo_status status =
      all && forces ? ambulo__pose_create(model, allocator, &pose) : AMBULO_E_MEMORY;
  for (int k = 0; k < motion->rows && !status; k++) {
    size_t at = (size_t)k * d;
    ambulo__pose_at(&pose, motion->q + at);
    inertial(&pose, motion->q + at, motion->qd + at, motion->qdd + at, all, forces);
    for (int c = 0; c < count; c++) {
      double *out = contact + 3 * ((size_t)k * (size_t)count + (size_t)c);
      cut_force(&pose, &cuts[c], forces, motion, k, out);
      if (between) memcpy(between + (out - contact), out, 3 * sizeof *out);
      take_muscles(muscles, &cuts[c], motion->q + at,
                   motion->force + (size_t)k * (size_t)muscles->count, out);
    }
  }
  ambulo__pose_free(&pose);
  ambulo__free(allocator, all);
  ambulo__free(allocator, forces);
  return status;
}
