/* contact/holds.c - forces at the hands, and the sweep back (holds.h).
 *
 * Kept of a hold: a header with the window, F, G, mu, P_d e / s and the forces and moments at the
 * hands, then the motion of each hand.
 */
#include "contact/devices.h"

#include "base/arithmetic.h"
#include "model/model.h"

#include <math.h>
#include <string.h>

typedef struct held {
  const ambulo_hold *hold;
  int hands;
  ambulo__device_path path[2];
  double center[3], push[3]; /* o and P along the world's axes */
  size_t kept;               /* where its part of what is kept begins */
} held;

struct ambulo__holds {
  ambulo_allocator allocator;
  int coordinates, count;
  double gravity[3];
  char *vanishes; /* [coordinates] 1: tau is zero whatever the hands do */
  held *all;      /* [count] */
  size_t entries;
};

/* The header. */
enum {
  kept_window,
  kept_carried = 1, /* G */
  kept_twist = 4,   /* mu */
  kept_force = 7,   /* f_1, f_2 */
  kept_moment = 13, /* m_1 = m_2 */
  KEPT_HEADER = 16
};

static size_t entries_of(const held *h) {
  size_t sum = KEPT_HEADER;
  for (int k = 0; k < h->hands; k++) sum += ambulo__hand_entries(h->path[k].count);
  return sum;
}

static ambulo__hand_motion motion_of(const held *h, double *kept, int hand) {
  double *at = kept + KEPT_HEADER;
  if (hand == 1) at += ambulo__hand_entries(h->path[0].count);
  return ambulo__hand_motion_in(at, h->path[hand].count);
}

/* what is kept is read only */
static ambulo__hand_motion motion_kept(const held *h, const double *kept, int hand) {
  union {
    const double *constant;
    double *plain;
  } view = {kept};
  return motion_of(h, view.plain, hand);
}

/* ------------------------------------------------------------ compilation */

static ambulo_status compile(const ambulo_model *model, const ambulo_hold *hold,
                             const ambulo_allocator *a, held *h) {
  ambulo_status status = AMBULO_OK;
  h->hold = hold;
  h->hands = hold->hand[1] >= 0 ? 2 : 1;
  ambulo__along_axes(model, hold->center, h->center);
  ambulo__along_axes(model, hold->force, h->push);
  for (int k = 0; k < h->hands && !status; k++) {
    const ambulo_point *point = &model->points[hold->hand[k]];
    status = ambulo__path_create(model, -1, point->link, point->position, a, &h->path[k]);
  }
  return status;
}

ambulo_status ambulo__holds_create(const ambulo_problem_definition *d, const ambulo__plan *plan,
                                   const ambulo_allocator *allocator, ambulo__holds **holds) {
  *holds = NULL;
  if (d->hold_count == 0) return AMBULO_OK;
  ambulo_allocator a = ambulo__allocator_or_default(allocator);
  ambulo__holds *all = ambulo__alloc(&a, 1, sizeof *all);
  if (!all) return AMBULO_E_MEMORY;
  all->allocator = a;
  all->coordinates = d->model->coordinate_count;
  memcpy(all->gravity, d->model->gravity, sizeof all->gravity);
  all->all = ambulo__alloc(&a, (size_t)d->hold_count, sizeof *all->all);
  all->vanishes = ambulo__alloc(&a, (size_t)all->coordinates, 1);
  ambulo_status status = all->all && all->vanishes ? AMBULO_OK : AMBULO_E_MEMORY;
  for (int i = 0; !status && i < all->coordinates; i++)
    all->vanishes[i] = (char)ambulo__plan_vanishes(plan, i);
  for (; !status && all->count < d->hold_count; all->count++) {
    held *h = &all->all[all->count];
    status = compile(d->model, &d->holds[all->count], &a, h);
    h->kept = all->entries;
    all->entries += entries_of(h);
  }
  if (status) {
    ambulo__holds_free(all);
    return status;
  }
  *holds = all;
  return AMBULO_OK;
}

void ambulo__holds_free(ambulo__holds *holds) {
  if (!holds) return;
  ambulo_allocator a = holds->allocator;
  for (int i = 0; i < holds->count; i++) {
    ambulo__path_free(&a, &holds->all[i].path[0]);
    ambulo__path_free(&a, &holds->all[i].path[1]);
  }
  ambulo__free(&a, holds->all);
  ambulo__free(&a, holds->vanishes);
  ambulo__free(&a, holds);
}

size_t ambulo__holds_entries(const ambulo__holds *holds) {
  return holds ? holds->entries : 0;
}

/* ------------------------------------------------------------------ forces */

/* d = p_2 - p_1 and e = a_2 - a_1; returns d . d */
static double line_of(const held *h, const double *kept, double d[3], double e[3]) {
  const ambulo__hand_motion one = motion_kept(h, kept, 0), other = motion_kept(h, kept, 1);
  for (int k = 0; k < 3; k++) {
    d[k] = other.place[k] - one.place[k];
    e[k] = other.acceleration[k] - one.acceleration[k];
  }
  return ambulo__dot(d, d);
}

/* (H.3) what each hand has of the force, and the moments */
static void share_out(const held *h, double *kept) {
  const double window = kept[kept_window], *carried = kept + kept_carried;
  double d[3], e[3], couple[3], *twist = kept + kept_twist;
  double square = line_of(h, kept, d, e), stretch = ambulo__dot(d, e) / square;
  ambulo__cross(h->center, carried, twist);
  ambulo__cross(twist, d, couple);
  double about = ambulo__dot(d, twist) / (2.0 * square);
  for (int k = 0; k < 3; k++) {
    double half = 0.5 * (carried[k] + window * h->push[k]);
    double apart = (window * h->hold->inertia * (e[k] - stretch * d[k]) + couple[k]) / square;
    kept[kept_force + k] = half - apart;
    kept[kept_force + 3 + k] = half + apart;
    kept[kept_moment + k] = about * d[k];
  }
}

/* (H.2) F = w (m (a_c - g) + P) */
static void keep_one(const ambulo__holds *all, const held *h, const double *q, const double *qd,
                     const double *qdd, double window, double *kept) {
  memset(kept, 0, KEPT_HEADER * sizeof *kept);
  kept[kept_window] = window;
  if (window == 0.0) return;
  for (int hand = 0; hand < h->hands; hand++) {
    const ambulo__hand_motion motion = motion_of(h, kept, hand);
    ambulo__hand_move(&h->path[hand], q, qd, qdd, &motion);
    for (int k = 0; k < 3; k++) kept[kept_carried + k] += motion.acceleration[k] / h->hands;
  }
  for (int k = 0; k < 3; k++) {
    double *carried = kept + kept_carried + k;
    *carried = window * h->hold->mass * (*carried - all->gravity[k]);
    kept[kept_force + k] = *carried + window * h->push[k];
  }
  if (h->hands == 2) share_out(h, kept);
}

void ambulo__holds_keep(const ambulo__holds *all, const double *q, const double *qd,
                        const double *qdd, const double *told, double *kept) {
  for (int i = 0; i < all->count; i++)
    keep_one(all, &all->all[i], q, qd, qdd, told[i * AMBULO__LANES], kept + all->all[i].kept);
}

/* tau += J . f + z . m */
void ambulo__holds_add_torques(const ambulo__holds *all, const double *kept_of_node, double *tau) {
  for (int i = 0; i < all->count; i++) {
    const held *h = &all->all[i];
    const double *kept = kept_of_node + h->kept;
    for (int hand = 0; kept[kept_window] != 0.0 && hand < h->hands; hand++) {
      const ambulo__hand_motion motion = motion_kept(h, kept, hand);
      for (int j = 0; j < h->path[hand].count; j++) {
        const ambulo__path_joint *joint = &h->path[hand].joints[j];
        if (all->vanishes[joint->coordinate]) continue;
        double *torque = tau + (size_t)joint->coordinate * AMBULO__LANES;
        *torque += ambulo__dot(motion.slope + 3 * j, kept + kept_force + 3 * hand);
        if (joint->turns) *torque += ambulo__dot(motion.axis + 3 * j, kept + kept_moment);
      }
    }
  }
}

void ambulo__holds_add_wrench(const ambulo__holds *all, const double *kept_of_node, double *wrench,
                              int stride) {
  for (int i = 0; i < all->count; i++) {
    const held *h = &all->all[i];
    const double *kept = kept_of_node + h->kept;
    for (int hand = 0; kept[kept_window] != 0.0 && hand < h->hands; hand++) {
      const double *force = kept + kept_force + 3 * hand;
      double moment[3];
      ambulo__cross(motion_kept(h, kept, hand).place, force, moment);
      for (int k = 0; k < 3; k++) {
        wrench[k * stride] += moment[k] + kept[kept_moment + k];
        wrench[(3 + k) * stride] += force[k];
      }
    }
  }
}

ambulo__hold_state ambulo__hold_at(const ambulo__holds *all, int hold, const double *kept_of_node) {
  const held *h = &all->all[hold];
  const double *kept = kept_of_node + h->kept;
  ambulo__hold_state state = {.window = kept[kept_window]};
  for (int hand = 0; state.window != 0.0 && hand < h->hands; hand++) {
    memcpy(state.force[hand], kept + kept_force + 3 * hand, sizeof state.force[hand]);
    memcpy(state.moment[hand], kept + kept_moment, sizeof state.moment[hand]);
    state.power += ambulo__dot(motion_kept(h, kept, hand).velocity, state.force[hand]);
  }
  return state;
}

/* ------------------------------------------------------------ the sweep back */

static double weight_on(const ambulo__holds *all, const ambulo__hold_adjoints *x, int coordinate) {
  if (all->vanishes[coordinate]) return 0.0;
  if (x->tau) return x->tau[(size_t)coordinate * AMBULO__LANES];
  return x->coordinate == coordinate ? 1.0 : 0.0;
}

/* Adjoints of a hand: of its acceleration and place; its virtual motion. */
typedef struct pull {
  double slide[3], turn[3];         /* u, t */
  double acceleration[3], place[3]; /* a', p' */
} pull;

/* u and t; 0 if nothing weighs on the hand */
static int virtual_motion(const ambulo__holds *all, const held *h, const double *kept, int hand,
                          const ambulo__hold_adjoints *x, pull *p) {
  const ambulo__hand_motion motion = motion_kept(h, kept, hand);
  int weighs = 0;
  for (int k = 0; k < 3; k++) {
    p->turn[k] = x->wrench[k];
    p->slide[k] = x->wrench[3 + k];
    p->acceleration[k] = p->place[k] = 0.0;
    weighs |= p->turn[k] != 0.0 || p->slide[k] != 0.0;
  }
  ambulo__add_cross(x->wrench, motion.place, 1.0, p->slide);
  for (int j = 0; j < h->path[hand].count; j++) {
    const ambulo__path_joint *joint = &h->path[hand].joints[j];
    double y = weight_on(all, x, joint->coordinate);
    if (y == 0.0) continue;
    weighs = 1;
    for (int k = 0; k < 3; k++) {
      p->slide[k] += y * motion.slope[3 * j + k];
      if (joint->turns) p->turn[k] += y * motion.axis[3 * j + k];
    }
  }
  return weighs;
}

/* a' and d' of two hands, by the equations of holds.h */
static void pull_apart(const held *h, const double *kept, pull p[2]) {
  const double window = kept[kept_window], *mu = kept + kept_twist;
  const double mass = window * h->hold->mass, turn = window * h->hold->inertia;
  double d[3], e[3], l[3], t[3], across[3], of_center[3], s = line_of(h, kept, d, e);
  for (int k = 0; k < 3; k++) {
    l[k] = p[1].slide[k] - p[0].slide[k];
    t[k] = p[0].turn[k] + p[1].turn[k];
  }
  double le = ambulo__dot(l, e), ld = ambulo__dot(l, d), de = ambulo__dot(d, e);
  double td = ambulo__dot(t, d), dm = ambulo__dot(d, mu), b[3];
  ambulo__cross(d, l, across);
  for (int k = 0; k < 3; k++) b[k] = across[k] / s + d[k] * td / (2.0 * s);
  ambulo__cross(b, h->center, of_center);
  double twisted = ambulo__dot(mu, across), by_line[3];
  ambulo__cross(l, mu, by_line);
  for (int k = 0; k < 3; k++) {
    double middle = 0.5 * (p[0].slide[k] + p[1].slide[k]);
    double both = 0.5 * mass * (middle + of_center[k]);
    double apart = turn * (l[k] - d[k] * ld / s) / s;
    double line = turn * (-2.0 * d[k] * le - l[k] * de - e[k] * ld + 4.0 * d[k] * ld * de / s);
    line = (line - 2.0 * d[k] * twisted - d[k] * td * dm) / (s * s);
    line += by_line[k] / s + (t[k] * dm + mu[k] * td) / (2.0 * s);
    p[0].acceleration[k] = both - apart;
    p[1].acceleration[k] = both + apart;
    p[0].place[k] = -line;
    p[1].place[k] = line;
  }
}

/* a . (b x c) */
static double triple(const double a[3], const double b[3], const double c[3]) {
  double turned[3];
  ambulo__cross(b, c, turned);
  return ambulo__dot(a, turned);
}

/* (H.4) the gradient of one hand: down the chain with O_j, up with U_j and Z_j */
static void add_gradient(const ambulo__holds *all, const held *h, const double *kept, int hand,
                         const pull *p, const ambulo__hold_adjoints *x) {
  const ambulo__hand_motion motion = motion_kept(h, kept, hand);
  const double *force = kept + kept_force + 3 * hand, *moment = kept + kept_moment;
  const int n = h->path[hand].count;
  double above[3] = {0.0}, below[3] = {0.0}, turns_below[3] = {0.0};
  for (int j = 0; j < n; j++) {
    const ambulo__path_joint *joint = &h->path[hand].joints[j];
    const double *slope = motion.slope + 3 * j;
    size_t at = (size_t)joint->coordinate * (size_t)x->stride;
    double y = joint->turns ? weight_on(all, x, joint->coordinate) : 0.0;
    for (int k = 0; k < 3; k++) above[k] += y * motion.axis[3 * j + k];
    x->q[at] += ambulo__dot(p->acceleration, motion.slope_gain + 3 * j) +
                ambulo__dot(p->place, slope) + triple(force, above, slope);
    x->qd[at] += 2.0 * ambulo__dot(p->acceleration, motion.slope_rate + 3 * j);
    x->qdd[at] += ambulo__dot(p->acceleration, slope);
  }
  for (int j = n - 1; j >= 0; j--) {
    const ambulo__path_joint *joint = &h->path[hand].joints[j];
    const double *z = motion.axis + 3 * j;
    double y = weight_on(all, x, joint->coordinate);
    if (joint->turns)
      x->q[(size_t)joint->coordinate * (size_t)x->stride] +=
          triple(force, z, below) + triple(moment, z, turns_below);
    for (int k = 0; k < 3; k++) {
      below[k] += y * motion.slope[3 * j + k];
      if (joint->turns) turns_below[k] += y * z[k];
    }
  }
}

static void reverse_one(const ambulo__holds *all, const held *h, const double *kept,
                        const ambulo__hold_adjoints *x) {
  pull p[2];
  int weighs = 0;
  for (int hand = 0; hand < h->hands; hand++)
    weighs |= virtual_motion(all, h, kept, hand, x, &p[hand]);
  if (!weighs) return;
  if (h->hands == 2) pull_apart(h, kept, p);
  for (int k = 0; h->hands == 1 && k < 3; k++)
    p[0].acceleration[k] = kept[kept_window] * h->hold->mass * p[0].slide[k];
  for (int hand = 0; hand < h->hands; hand++) {
    ambulo__add_cross(kept + kept_force + 3 * hand, x->wrench, 1.0, p[hand].place);
    add_gradient(all, h, kept, hand, &p[hand], x);
  }
}

void ambulo__holds_reverse(const ambulo__holds *all, const double *kept_of_node,
                           const ambulo__hold_adjoints *x) {
  for (int i = 0; i < all->count; i++) {
    const double *kept = kept_of_node + all->all[i].kept;
    if (kept[kept_window] != 0.0) reverse_one(all, &all->all[i], kept, x);
  }
}
