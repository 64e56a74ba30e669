/* mechanics/plan_inertia.c - merging bodies, factoring their inertia for the kernels, and
 * structural nonzeros of the Jacobians.
 *
 * Inertia I (kg m^2) about the centre of mass in the axes of the frame. With mu the smallest
 * eigenvalue of I, I - mu 1 is positive semidefinite of rank two at most, so that
 *   I = mu 1 + d1 u u^T + d2 w w^T,   u = (1, l0, l1),  w = (0, 1, l2)
 * in the frame's axes taken in the order of falling pivots (Cholesky with pivoting). Rotating I
 * into the world then means rotating two vectors; for an inertia that is diagonal in the frame,
 * u and w are two of the frame's axes, and nothing is rotated at all.
 */
#include "mechanics/plan_layout.h"

#include <math.h>
#include <string.h>

ambulo__mass ambulo__mass_of_link(const ambulo_link *link, const ambulo__placing *placing) {
  ambulo__mass out;
  const double *in = link->inertia;
  double local[3][3] = {{in[0], in[3], in[4]}, {in[3], in[1], in[5]}, {in[4], in[5], in[2]}};
  out.mass = link->mass;
  for (int i = 0; i < 3; i++) {
    out.com[i] = placing->position[i];
    for (int k = 0; k < 3; k++) out.com[i] += placing->rotation[i][k] * link->com[k];
    for (int j = 0; j < 3; j++) {
      double sum = 0;
      for (int k = 0; k < 3; k++) {
        for (int l = 0; l < 3; l++) {
          sum += placing->rotation[i][k] * local[k][l] * placing->rotation[j][l];
        }
      }
      out.inertia[i][j] = sum;
    }
  }
  return out;
}

/* I += mass (|r|^2 1 - r r^T) */
static void add_steiner(double inertia[3][3], double mass, const double r[3]) {
  double square = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      inertia[i][j] += mass * ((i == j ? square : 0) - r[i] * r[j]);
    }
  }
}

void ambulo__mass_add(ambulo__mass *a, const ambulo__mass *b) {
  double total = a->mass + b->mass, to_a[3], to_b[3];
  if (!(total > 0)) return;
  for (int i = 0; i < 3; i++) {
    double com = a->com[i] + b->mass / total * (b->com[i] - a->com[i]);
    to_a[i] = a->com[i] - com;
    to_b[i] = b->com[i] - com;
    a->com[i] = com;
    for (int j = 0; j < 3; j++) a->inertia[i][j] += b->inertia[i][j];
  }
  if (a->mass > 0) add_steiner(a->inertia, a->mass, to_a);
  add_steiner(a->inertia, b->mass, to_b);
  a->mass = total;
}

/* One Jacobi rotation that clears m[p][q]. */
static void jacobi_rotate(double m[3][3], int p, int q) {
  if (m[p][q] == 0) return;
  double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
  double t = copysign(1, theta) / (fabs(theta) + sqrt(theta * theta + 1));
  double c = 1 / sqrt(t * t + 1), s = t * c;
  for (int k = 0; k < 3; k++) {
    double x = m[k][p], y = m[k][q];
    m[k][p] = c * x - s * y;
    m[k][q] = s * x + c * y;
  }
  for (int k = 0; k < 3; k++) {
    double x = m[p][k], y = m[q][k];
    m[p][k] = c * x - s * y;
    m[q][k] = s * x + c * y;
  }
}

static double smallest_eigenvalue(const double inertia[3][3]) {
  double m[3][3];
  memcpy(m, inertia, sizeof m);
  for (int sweep = 0; sweep < 12; sweep++) {
    jacobi_rotate(m, 0, 1);
    jacobi_rotate(m, 0, 2);
    jacobi_rotate(m, 1, 2);
  }
  return fmin(m[0][0], fmin(m[1][1], m[2][2]));
}

void ambulo__mass_factor(const ambulo__mass *mass, ambulo__rigid_body *body) {
  double b[3][3], scale = mass->inertia[0][0] + mass->inertia[1][1] + mass->inertia[2][2];
  memcpy(b, mass->inertia, sizeof b);
  body->mass = mass->mass;
  memcpy(body->com, mass->com, sizeof body->com);
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      if (i != j && fabs(b[i][j]) < 1e-16 * scale) b[i][j] = 0;
    }
  }
  body->base = smallest_eigenvalue((const double(*)[3])b);
  for (int i = 0; i < 3; i++) b[i][i] -= body->base;
  int *order = body->order;
  for (int i = 0; i < 3; i++) order[i] = i;
  int best = b[1][1] > b[0][0] ? 1 : 0;
  if (b[2][2] > b[best][best]) best = 2;
  order[0] = best;
  order[best] = 0;
  double pivot = b[order[0]][order[0]], tiny = 1e-15 * scale;
  body->first = pivot > tiny ? pivot : 0;
  for (int i = 0; i < 2; i++) {
    body->lower[i] = pivot > tiny ? b[order[0]][order[i + 1]] / pivot : 0;
  }
  double rest[2];
  for (int i = 0; i < 2; i++) {
    rest[i] = b[order[i + 1]][order[i + 1]] - body->first * body->lower[i] * body->lower[i];
  }
  if (rest[1] > rest[0]) {
    int axis = order[1];
    double swap = body->lower[0];
    order[1] = order[2];
    order[2] = axis;
    body->lower[0] = body->lower[1];
    body->lower[1] = swap;
    rest[0] = rest[1];
  }
  body->second = rest[0] > tiny ? rest[0] : 0;
  body->lower[2] = 0;
  if (rest[0] > tiny) {
    double off = b[order[1]][order[2]] - body->first * body->lower[0] * body->lower[1];
    body->lower[2] = off / rest[0];
  }
  body->diagonal = body->lower[0] == 0 && body->lower[1] == 0 && body->lower[2] == 0;
}

/* structural nonzeros of the Jacobians.
 *
 * Coordinates are numbered parents first, so that in the row of tau_i the ancestors of i come
 * before i and its descendants after it. Moment and force depend on every coordinate, a point on
 * the coordinates between it and the world.
 *
 * Without ground reaction, a displacement of all moving bodies along s meets the force on all of
 * them: tau = s . (F - F_0), with F_0 the weight, constant, of the bodies fixed to the world. If s
 * is plus or minus a world axis k, and stands still, then the row is plus or minus that of F_k. A
 * chain of such joints, beginning at the world, has no entries: the root of most bodies. (Behind
 * another joint, as an oblique one or one with a drive, they keep their rows, so that kernels find
 * those without entries first among the ancestors.)
 *
 * Contacts: plan_steps.c.
 */

/* Coordinate of the parent frame, -1 at the world. */
static int parent_of(const ambulo__plan *plan, int coordinate) {
  return plan->joints[coordinate].parent - 1;
}

static int is_ancestor(const ambulo__plan *plan, int ancestor, int coordinate) {
  while (coordinate > ancestor) coordinate = parent_of(plan, coordinate);
  return coordinate == ancestor;
}

static int depth_of(const ambulo__plan *plan, int coordinate) {
  int depth = 0;
  for (int k = coordinate; k >= 0; k = parent_of(plan, k)) depth++;
  return depth;
}

/* Writes the chain from the world to `coordinate`, ascending, ending before out + depth. */
static void write_chain(const ambulo__plan *plan, int coordinate, int *out) {
  int place = depth_of(plan, coordinate);
  for (int k = coordinate; k >= 0; k = parent_of(plan, k)) out[--place] = k;
}

/* Whether the row of tau is, but for its sign, the row of a component of the root force. */
static int follows_force(const ambulo__plan *plan, int k) {
  const ambulo__joint *joint = &plan->joints[k];
  int above = parent_of(plan, k);
  if (plan->contacts > 0 || joint->revolute || joint->turned || joint->driven) return 0;
  if (above >= 0 && plan->joints[above].torque_row != AMBULO__ROW_FOLLOWS) return 0;
  for (int i = 0; i < plan->bodies; i++) {
    if (!is_ancestor(plan, k, plan->body[i].frame - 1)) return 0;
  }
  return 1;
}

static void find_followers(ambulo__plan *plan) {
  for (int k = 0; k < plan->coordinates; k++) {
    if (follows_force(plan, k)) plan->joints[k].torque_row = AMBULO__ROW_FOLLOWS;
  }
}

static int has_entries(const ambulo__plan *plan, int i) {
  int row = plan->joints[i].torque_row;
  return row == AMBULO__ROW_SPARSE || row == AMBULO__ROW_REACTS;
}

static int in_torque_row(const ambulo__plan *plan, int i, int j) {
  return has_entries(plan, i) && (is_ancestor(plan, j, i) || is_ancestor(plan, i, j));
}

static void count_entries(ambulo__plan *plan, size_t *pairs) {
  int d = plan->coordinates, count = 0;
  *pairs = 0;
  for (int i = 0; i < d; i++) *pairs += (size_t)depth_of(plan, i) - 1;
  for (int i = 0; i < d; i++) {
    for (int j = 0; j < d; j++) count += in_torque_row(plan, i, j);
  }
  count += 6 * d;
  plan->dynamic_count = count;
  for (int i = 0; i < plan->points; i++) count += 3 * depth_of(plan, plan->point[i].frame - 1);
  plan->count = count;
}

/* Rows that depend on all coordinates. */
static void fill_full_rows(ambulo__plan *plan, int row, int rows, int *at) {
  for (int i = 0; i < rows; i++) {
    plan->start[row + i] = *at;
    for (int j = 0; j < plan->coordinates; j++) plan->column[(*at)++] = j;
  }
}

static void fill_rows(ambulo__plan *plan) {
  int d = plan->coordinates, row = 0, at = 0;
  for (int i = 0; i < d; i++) {
    plan->start[row++] = at;
    for (int j = 0; j < d; j++) {
      if (in_torque_row(plan, i, j)) plan->column[at++] = j;
    }
  }
  fill_full_rows(plan, row, 6, &at);
  row += 6;
  for (int i = 0; i < 3 * plan->points; i++) {
    int coordinate = plan->point[i / 3].frame - 1;
    plan->start[row++] = at;
    write_chain(plan, coordinate, plan->column + at);
    at += depth_of(plan, coordinate);
  }
  for (; row <= ambulo__plan_rows(plan); row++) plan->start[row] = at;
}

static void fill_rate_starts(ambulo__plan *plan) {
  for (int row = 0; row < ambulo__plan_rows(plan); row++) {
    plan->rate_start[row] = row < plan->coordinates + 6 ? plan->start[row] : -1;
  }
}

static void fill_ancestors(ambulo__plan *plan) {
  int at = 0;
  for (int i = 0; i < plan->coordinates; i++) {
    int depth = depth_of(plan, i);
    plan->ancestor_start[i] = at;
    for (int k = parent_of(plan, i), place = at + depth - 2; k >= 0; k = parent_of(plan, k)) {
      plan->ancestor[place--] = k;
    }
    for (int t = 0; t < depth - 1; t++, at++) {
      int j = plan->ancestor[at], entry = plan->start[j];
      plan->upper[at] = -1;
      if (!has_entries(plan, j)) continue;
      while (plan->column[entry] != i) entry++;
      plan->upper[at] = entry;
    }
  }
  plan->ancestor_start[plan->coordinates] = at;
}

/* Where the row of tau_i has the inertia that couples it with q_j, j above i, there the row of
 * tau_j has it with q_i; and if q_j is a displacement along world axis k, the row of F_k. */
static int mirrored(const ambulo__plan *plan, int i, int ancestor, int entry) {
  int axis = ambulo__plan_world_axis(&plan->joints[plan->ancestor[ancestor]]);
  if (plan->upper[ancestor] >= 0) return plan->upper[ancestor];
  return axis < 0 ? entry : plan->start[plan->coordinates + 3 + axis] + i;
}

static void fill_mass_entries(ambulo__plan *plan) {
  for (int e = 0; e < plan->dynamic_count; e++) plan->by_qdd[e] = e;
  for (int i = 0; i < plan->coordinates; i++) {
    int entry = plan->start[i];
    if (!has_entries(plan, i)) continue;
    for (int at = plan->ancestor_start[i]; at < plan->ancestor_start[i + 1]; at++, entry++) {
      plan->by_qdd[entry] = mirrored(plan, i, at, entry);
    }
  }
}

ambulo_status ambulo__plan_pattern_build(ambulo__plan *plan) {
  const ambulo_allocator *allocator = &plan->allocator;
  size_t pairs, rows = (size_t)ambulo__plan_rows(plan);
  find_followers(plan);
  count_entries(plan, &pairs);
  plan->start = ambulo__alloc(allocator, rows + 1, sizeof(int));
  plan->column = ambulo__alloc(allocator, (size_t)plan->count, sizeof(int));
  plan->rate_start = ambulo__alloc(allocator, rows, sizeof(int));
  plan->by_qdd = ambulo__alloc(allocator, (size_t)plan->dynamic_count, sizeof(int));
  plan->ancestor_start = ambulo__alloc(allocator, (size_t)plan->coordinates + 1, sizeof(int));
  plan->ancestor = ambulo__alloc(allocator, pairs, sizeof(int));
  plan->upper = ambulo__alloc(allocator, pairs, sizeof(int));
  if (!plan->start || !plan->column || !plan->rate_start || !plan->by_qdd ||
      !plan->ancestor_start || !plan->ancestor || !plan->upper) {
    return AMBULO_E_MEMORY;
  }
  fill_rows(plan);
  fill_rate_starts(plan);
  fill_ancestors(plan);
  fill_mass_entries(plan);
  if (plan->contacts > 0) ambulo__plan_contact_factors(plan);
  return AMBULO_OK;
}

int ambulo__plan_parts(const ambulo__plan *plan, int row,
                       ambulo__row_part part[AMBULO__MOST_PARTS]) {
  if (plan->contacts > 0) return ambulo__plan_contact_parts(plan, row, part);
  part[0] = (ambulo__row_part){row, 0, -1, 1};
  if (row >= plan->coordinates) return 1;
  const ambulo__joint *joint = &plan->joints[row];
  if (joint->torque_row == AMBULO__ROW_FOLLOWS) /* its axis is one of the world frame */
    part[0] = (ambulo__row_part){plan->coordinates + 3 + joint->axis, 0, -1, joint->sign};
  return 1;
}

ambulo__plan_pattern ambulo__plan_get_pattern(const ambulo__plan *plan) {
  ambulo__plan_pattern pattern = {plan->start,  plan->column,        plan->rate_start,
                                  plan->by_qdd, plan->dynamic_count, plan->count};
  return pattern;
}
