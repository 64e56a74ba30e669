/* solver/ground_split.c - the tangent of the ground's wrenches on two feet.
 *
 * The equations of mechanics/kernel_ground.h, in their letters, changed by p (a dot):
 *
 *     z. = n.c. - height.,    p = a_0 a_1,    p. = a_0. (a_1 - a_0)
 *     gain. = (kappa. p + kappa p.) / z - gain z. / z
 *     V. = n x M. + height F. + height. F,     Y. = p F. + p. F + gain. V + gain V.
 *     X. = D. x Y + D x Y.,    h. = (gain. F_n + gain F_n.) D + gain F_n D.
 *     T. = (M. . F + M . F. - T F_n.) / F_n
 *     (M_0, F_0). = a_0 (M, F). + a_0. (M, F) + (X., -h.),
 *     (M_1, F_1). = a_1 (M, F). - a_0. (M, F) - (X., -h.),   T_f. = a_f T. +- a_0. T
 *     tau_i. = S_i . (load of i). - sum over its feet of S_i . W_f.
 */
#include "solver/node_forces.h"
#include "base/vector.h"

#include <string.h>

static void add(const double a[3], double factor, double out[3]) {
  for (int i = 0; i < 3; i++) out[i] += factor * a[i];
}

/* what the node's ground is: shares, D, kappa; root wrench; z, gain, V, Y, T */
typedef struct ground {
  double share[2], product, kappa, apart[3];
  double wrench[6], normal, height, gain, lever[3], passing[3], twist;
} ground;

static ground ground_at(const ambulo__node_forces *f) {
  const ambulo_problem *p = f->s->problem;
  const double *up = p->model->up;
  const double *lane = p->ground + ambulo__lane_index(f->node, AMBULO__GROUND_ENTRIES, 0);
  double h = p->definition.ground_height;
  ground g = {.share = {lane[0], 1.0 - lane[0]}, .kappa = lane[4 * AMBULO__LANES]};
  g.product = g.share[0] * g.share[1];
  for (int i = 0; i < 3; i++) g.apart[i] = lane[(1 + i) * AMBULO__LANES];
  for (int i = 0; i < 6; i++)
    g.wrench[i] =
        ambulo__stationary_channel(f->s, f->node, ambulo__channel_moment(&p->channels, i));
  int center = ambulo__channel_center(&p->channels, 0);
  g.height = ambulo__stationary_along(f->s, f->node, center, up) - h;
  g.normal = ambulo__dot(up, g.wrench + 3);
  g.gain = g.kappa * g.product / g.height;
  ambulo__add_cross(up, g.wrench, 1.0, g.lever);
  add(g.wrench + 3, h, g.lever);
  add(g.wrench + 3, g.product, g.passing);
  add(g.lever, g.gain, g.passing);
  g.twist = ambulo__dot(g.wrench, g.wrench + 3) / g.normal;
  return g;
}

/* (X., -h.): what passes from foot 1 to foot 0 */
static void passed_tangent(const ambulo__node_forces *f, const ground *g, double out[6]) {
  const ambulo_problem *p = f->s->problem;
  const double *up = p->model->up, *force = f->wrench + 3;
  double rise = ambulo__dot(up, f->center) - f->height;
  double product = f->share * (g->share[1] - g->share[0]);
  double gain = (f->shear * g->product + g->kappa * product - g->gain * rise) / g->height;
  double lever[3] = {0}, passing[3] = {0}, normal = ambulo__dot(up, force);
  ambulo__add_cross(up, f->wrench, 1.0, lever);
  add(force, p->definition.ground_height, lever);
  add(g->wrench + 3, f->height, lever);
  add(force, g->product, passing);
  add(g->wrench + 3, product, passing);
  add(g->lever, gain, passing);
  add(lever, g->gain, passing);
  memset(out, 0, 6 * sizeof *out);
  ambulo__add_cross(f->apart, g->passing, 1.0, out);
  ambulo__add_cross(g->apart, passing, 1.0, out);
  add(g->apart, -(gain * g->normal + g->gain * normal), out + 3);
  add(f->apart, -g->gain * g->normal, out + 3);
}

/* (S.8a) the weights of what only a plan with ground reaction has, and the feet's part of the
 * torques */
double ambulo__ground_split_pull(const ambulo__node_forces *f) {
  const ambulo_problem *p = f->s->problem;
  const ambulo__channels *c = &p->channels;
  const ground g = ground_at(f);
  double passed[6], sum = 0.0;
  passed_tangent(f, &g, passed);
  double twist = (ambulo__dot(f->wrench, g.wrench + 3) + ambulo__dot(g.wrench, f->wrench + 3) -
                  g.twist * ambulo__dot(p->model->up, f->wrench + 3)) /
                 g.normal;
  for (int foot = 0; foot < 2; foot++) {
    double wrench[6], share = foot ? -f->share : f->share;
    for (int i = 0; i < 6; i++)
      wrench[i] =
          g.share[foot] * f->wrench[i] + share * g.wrench[i] + (foot ? -passed[i] : passed[i]);
    int link = p->model->points[p->model->feet[foot].heel_center].link;
    for (; link >= 0; link = p->model->links[link].parent) {
      int i = p->model->links[link].coordinate;
      if (i < 0) continue;
      sum -= ambulo__stationary_adjoint(f->s, f->node, ambulo__channel_tau(c, i)) *
             ambulo__node_forces_joint(f, i, wrench);
    }
    int force = ambulo__channel_foot_force(c, foot, 0);
    for (int i = 0; i < 3; i++)
      sum += ambulo__stationary_adjoint(f->s, f->node, force + i) * wrench[3 + i];
    sum += ambulo__stationary_adjoint(f->s, f->node, force + 3) *
           (g.share[foot] * twist + share * g.twist);
  }
  int center = ambulo__channel_center(c, 0);
  for (int i = 0; i < 3; i++)
    sum += ambulo__stationary_adjoint(f->s, f->node, center + i) * f->center[i];
  return sum;
}
