/* solver/sensitivity_terms.c - the numbers of the objective's terms, at fixed channels.
 *
 * A term is J_t = weight sum_k w_k sum_j phi(u_jk) (problem/term.h), so that
 *
 *     dJ/dweight = J_t / weight,      dJ/dp = weight sum_k w_k sum_j phi'(u) du/dp
 *
 *     u = scale (y - offset)          du/dscale = y - offset,   du/doffset = -scale
 *     torque over strength            du/dscale = u / scale,    du/doffset = -du/dtau,
 *                                     du/dpeak = -u / peak of the direction that acts; of a
 *                                     limit by its price, peak = limit / price, du/dlimit =
 *                                     -u / limit, du/dprice = u / price
 *     mechanical power, torque rate   du/dscale = u / scale
 *     power tau qd / m                du/d ln m = -u
 *     of that of muscles the part of  du/dk = -(that part) / k
 *       a tendon of stiffness k
 *     ground force F / W - v          du/d ln m = -(u + v),     du/dslope = -dv/dslope
 *     upright, e_0 . (b - a) / L      du/dslope = de_0/dslope . (b - a) / L
 *     clearance, where u > 0,         du/dh = r / H,            du/dH = (r - u) / H
 *       r (1 - (n.p - h) / H)         r the root of the part of the node's time in the air
 *
 * Times of nodes move quadrature weights and what is divided by them, h the interval ahead and r^2
 * the part in the air:
 *
 *     w_k = (t_k+1 - t_k-1) / 2       dJ/dw_k = weight sum_j phi
 *     rates, w = h, of u the part     dJ/dh = weight sum_j (phi - phi' v)
 *       v ~ 1 / h
 *     clearance, u ~ r                dJ/dr^2 = weight w sum_j phi' u / (2 r^2)
 *
 * A slope s turns gravity, -|g| (cos s n + sin s f) in the ground's axes: with v = -g / |g| the
 * vertical and l left, dv/ds = l x v = e_0 and de_0/ds = l x e_0 = -v.
 */
#include "solver/partials.h"

#include "problem/callbacks.h"

#include <math.h>

typedef struct term_sum {
  const ambulo__stationary *s;
  const ambulo_term *term;
  ambulo__partials *partials;
  size_t coordinates; /* first of the term's in scale, offset */
  int index;          /* of the term */
  double up[3];       /* -g / |g| */
} term_sum;

/* weight w_k of a node grows with the time of the node ahead, and shrinks with that before */
static void add_quadrature(const term_sum *t, int node, double by_weight) {
  int last = t->s->problem->nodes - 1;
  t->partials->node_time[node < last ? node + 1 : node] += 0.5 * by_weight;
  t->partials->node_time[node > 0 ? node - 1 : node] -= 0.5 * by_weight;
}

/* part = (t_k+1 - t_k) / (t_k+1 - t_k-1), or what is left of 1 */
static void add_air(const term_sum *t, const ambulo__term_context *context, int node, int foot,
                    double by_part) {
  double part = ambulo__air_part(context, node, foot), *by = t->partials->node_time;
  if (part <= 0.0 || part >= 1.0) return; /* between two phases: neither the first nor the last */
  int at = node * context->model->foot_count + foot, lands = context->active[at] >= 0;
  double ahead = lands ? 1.0 - part : part;
  double pull =
      (lands ? -by_part : by_part) / (context->times[node + 1] - context->times[node - 1]);
  by[node + 1] += pull * (1.0 - ahead);
  by[node] -= pull;
  by[node - 1] += pull * ahead;
}

static void simple_node(const term_sum *t, int node, int i) {
  const ambulo_problem *p = t->s->problem;
  double y = ambulo__stationary_channel(t->s, node, ambulo__term_channel(t->term, &p->channels, i));
  double off = y - ambulo__term_offset(t->term, p->coordinates, node, i);
  double scale = ambulo__term_scale(t->term, i), w = p->quadrature[node];
  ambulo__residual phi = ambulo__term_residual(t->term, scale * off);
  double slope = t->term->weight * w * phi.slope;
  t->partials->weight[t->index] += w * phi.value;
  add_quadrature(t, node, t->term->weight * phi.value);
  t->partials->scale[t->coordinates + (size_t)i] += slope * off;
  t->partials->offset[t->coordinates + (size_t)i] -= slope * scale;
}

/* de_0/ds = -v */
static double upright_by_slope(const term_sum *t, int node) {
  const ambulo_problem *p = t->s->problem;
  double along = 0.0;
  for (int end = 0; end < 2; end++) {
    int first = ambulo__channel_point(&p->channels, t->term->point[end], 0);
    along += (end ? 1.0 : -1.0) * ambulo__stationary_along(t->s, node, first, t->up);
  }
  return -along / ambulo__upright_length(p->model, t->term->point);
}

/* dv/ds = l x v, component `axis` */
static double ahead(const term_sum *t, int axis) {
  const double *l = t->s->problem->model->left;
  int a = (axis + 1) % 3, b = (axis + 2) % 3;
  return l[a] * t->up[b] - l[b] * t->up[a];
}

static void strength_form(const term_sum *t, int i, const ambulo__form *form, double slope) {
  size_t at = t->coordinates + (size_t)i;
  double scale = ambulo__term_scale(t->term, i);
  t->partials->scale[at] += slope * form->u / scale;
  t->partials->offset[at] -= slope * form->slope[0];
  if (!t->term->strength) return;
  int down = form->u < 0.0;
  double peak = t->term->strength[6 * i + 3 * down];
  if (!(peak > 0.0)) return;
  if (t->term->strength_is_limits) {
    int limit = ambulo__limited_place(AMBULO_LIMITED_TORQUE) * t->s->problem->coordinates + i;
    double price = t->term->price ? t->term->price[2 * i + !down] : 1.0;
    t->partials->limit[2 * limit + !down] -= (down ? -1.0 : 1.0) * slope * form->u / (peak * price);
    t->partials->price[2 * at + (size_t)!down] += slope * form->u / price;
  } else {
    t->partials->strength[2 * at + (size_t)down] -= slope * form->u / peak;
  }
}

static void clearance_form(const term_sum *t, const ambulo__term_context *context, int node, int j,
                           const ambulo__form *form, double slope) {
  int foot = ambulo__clearance_foot(j);
  double part = ambulo__air_part(context, node, foot), root = sqrt(part);
  add_air(t, context, node, foot, 0.5 * slope * form->u / part);
  t->partials->ground_height += slope * root / t->term->height;
  t->partials->height[t->index] += slope * (root - form->u) / t->term->height;
}

static void composite_form(const term_sum *t, const ambulo__term_context *context, int node, int j,
                           const ambulo__form *form, double slope) {
  size_t at = t->coordinates + (size_t)j;
  switch (t->term->kind) {
  case AMBULO_TORQUE_POWER:
    strength_form(t, j, form, slope);
    break;
  case AMBULO_MECHANICAL_POWER:
    t->partials->log_mass -= slope * form->u;
    if (t->term->tendon && t->term->tendon[j] > 0.0)
      t->partials->tendon[at] -= slope * form->difference / t->term->tendon[j];
    t->partials->scale[at] += slope * form->u / ambulo__term_scale(t->term, j);
    break;
  case AMBULO_TORQUE_RATE:
    t->partials->scale[at] += slope * form->u / ambulo__term_scale(t->term, j);
    break;
  case AMBULO_FORCE_RATE:
    t->partials->log_mass -= slope * form->u;
    break;
  case AMBULO_GROUND_FORCE:
    t->partials->log_mass -= slope * (form->u + t->up[j]);
    t->partials->slope -= slope * ahead(t, j);
    break;
  case AMBULO_UPRIGHT:
    if (j == 0) t->partials->slope += slope * upright_by_slope(t, node);
    break;
  case AMBULO_CLEARANCE:
    clearance_form(t, context, node, j, form, slope);
    break;
  default:
    break;
  }
}

static void composite_node(const term_sum *t, const ambulo__term_context *context, int node) {
  double w = ambulo__term_quadrature(t->s->problem, t->term, node);
  int count = ambulo__term_forms(t->term, context, node);
  for (int j = 0; j < count; j++) {
    ambulo__form form;
    ambulo__term_form(t->term, context, node, j, &form);
    if (!form.count) continue;
    ambulo__residual phi = ambulo__term_residual(t->term, form.u);
    t->partials->weight[t->index] += w * phi.value;
    if (ambulo__term_is_rate(t->term)) {
      double by_step = t->term->weight * (phi.value - phi.slope * form.difference);
      t->partials->node_time[node + 1] += by_step;
      t->partials->node_time[node] -= by_step;
    } else {
      add_quadrature(t, node, t->term->weight * phi.value);
    }
    composite_form(t, context, node, j, &form, t->term->weight * w * phi.slope);
  }
}

static void sum_term(const term_sum *t) {
  const ambulo_problem *p = t->s->problem;
  ambulo__term_context context = ambulo__term_context_of(t->s->workspace);
  for (int node = 0; node < p->nodes; node++) {
    if (ambulo__is_user_term(t->term)) {
      t->partials->weight[t->index] +=
          p->quadrature[node] * ambulo__user_term_value(t->s->workspace, t->term, node);
    } else if (ambulo__term_is_simple(t->term)) {
      for (int i = 0; i < p->coordinates; i++) simple_node(t, node, i);
    } else {
      composite_node(t, &context, node);
    }
  }
}

/* (S.6) J_t / weight, weight w phi' du/dp */
void ambulo__partials_of_terms(const ambulo__stationary *s, ambulo__partials *partials) {
  const ambulo_problem *p = s->problem;
  const double *g = p->model->gravity;
  double size = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  for (int k = 0; k < p->definition.term_count; k++) {
    term_sum t = {s, &p->definition.terms[k], partials, (size_t)k * (size_t)p->coordinates, k, {0}};
    for (int i = 0; i < 3; i++) t.up[i] = size > 0.0 ? -g[i] / size : 0.0;
    sum_term(&t);
  }
}
