/* mechanics/plan_coupled.c - compiling a body with coupled joints (plan_coupled.h).
 *
 * The row of tau_k is the sum of the rows of the joints that q_k moves, those of coupled ones times
 * f'; its columns are the coordinates of theirs. So it vanishes where all of these do, and follows
 * a row of the root force where it is one joint's that does (plan_inertia.c). The mass matrix stays
 * symmetric; entries below the diagonal are read above it, unless a joint of one of both rows has
 * none of its own there, since it carries the whole body on contacts.
 */
#include "mechanics/plan_coupled.h"

#include <string.h>

static int takes_place(size_t *used, int entries) {
  int at = (int)*used;
  *used += (size_t)entries * AMBULO__LANES;
  return at;
}

/* -------------------------------------------------------------------- the joints */

static void set_follower(ambulo__follower *follower, const ambulo__coupling *coupling, int joint,
                         ambulo__piece **pieces) {
  size_t count = (size_t)coupling->count;
  memcpy(*pieces, coupling->pieces, count * sizeof **pieces);
  *follower = (ambulo__follower){joint, coupling->to, {coupling->to, coupling->count, *pieces}, -1};
  *pieces += count;
}

static ambulo_status set_joints(ambulo__plan *plan, const ambulo_model *model) {
  struct ambulo__coupled_plan *c = plan->coupled;
  const ambulo_allocator *a = &plan->allocator;
  size_t pieces = 0, joints = (size_t)model->coordinate_count + (size_t)model->coupled_count;
  for (int i = 0; i < model->link_count; i++) pieces += (size_t)model->couplings[i].count;
  c->coordinate = ambulo__alloc(a, joints, sizeof *c->coordinate);
  c->follower = ambulo__alloc(a, joints, sizeof *c->follower);
  c->followers = ambulo__alloc(a, (size_t)model->coupled_count, sizeof *c->followers);
  c->pieces = ambulo__alloc(a, pieces, sizeof *c->pieces);
  if (!c->coordinate || !c->follower || !c->followers || !c->pieces) return AMBULO_E_MEMORY;
  ambulo__piece *next = c->pieces;
  for (int i = 0; i < model->link_count; i++) {
    int moved_by = ambulo__moved_by(model, i), joint = c->joint_count;
    if (moved_by < 0) continue;
    c->coordinate[joint] = moved_by;
    c->follower[joint] = model->links[i].coordinate >= 0 ? -1 : c->follower_count;
    c->joint_count++;
    if (c->follower[joint] < 0) continue;
    set_follower(&c->followers[c->follower_count++], &model->couplings[i], joint, &next);
  }
  return AMBULO_OK;
}

/* ---------------------------------------------------------------------- the rows */

static int row_of_joint(const ambulo__plan *plan, int joint) {
  return plan->coupled->open->joints[joint].torque_row;
}

/* The row of tau of a coordinate. */
static void set_row(ambulo__plan *plan, int k) {
  const struct ambulo__coupled_plan *c = plan->coupled;
  int count = 0, vanishing = 0, reacting = 0, following = -1;
  for (int j = 0; j < c->joint_count; j++) {
    if (c->coordinate[j] != k) continue;
    int row = row_of_joint(plan, j);
    count++;
    vanishing += row == AMBULO__ROW_VANISHES;
    reacting |= row == AMBULO__ROW_REACTS;
    if (row == AMBULO__ROW_FOLLOWS) following = j;
  }
  ambulo__joint *joint = &plan->joints[k];
  joint->torque_row = AMBULO__ROW_SPARSE;
  if (reacting) joint->torque_row = AMBULO__ROW_REACTS;
  if (vanishing == count) joint->torque_row = AMBULO__ROW_VANISHES;
  if (count > 1 || following < 0) return;
  joint->torque_row = AMBULO__ROW_FOLLOWS;
  joint->axis = c->open->joints[following].axis;
  joint->sign = c->open->joints[following].sign;
}

/* 1: all joints of the coordinate have their rows of the mass matrix. */
static int is_whole(const ambulo__plan *plan, int k) {
  const struct ambulo__coupled_plan *c = plan->coupled;
  for (int j = 0; j < c->joint_count; j++)
    if (c->coordinate[j] == k && row_of_joint(plan, j) == AMBULO__ROW_VANISHES) return 0;
  return 1;
}

/* ------------------------------------------------------------------- the entries */

/* Adds to the entry in column `column` what row `from` of `open` has there. */
static void add_folds(ambulo__plan *plan, int from, int follower, int column, double factor) {
  struct ambulo__coupled_plan *c = plan->coupled;
  ambulo__plan_pattern p = ambulo__plan_get_pattern(c->open);
  for (int e = p.start[from]; e < p.start[from + 1]; e++) {
    int joint = p.column[e], rate = p.rate_start[from];
    if (c->coordinate[joint] != column) continue;
    int at = rate < 0 ? -1 : rate + e - p.start[from];
    c->folds[c->fold_start[c->entry_count + 1]++] =
        (ambulo__fold){e * AMBULO__LANES,
                       at < 0 ? -1 : at * AMBULO__LANES,
                       at < 0 ? -1 : p.by_qdd[at] * AMBULO__LANES,
                       follower,
                       c->follower[joint],
                       factor};
  }
}

/* The same of all rows of `open` that are in a row. */
static void add_row_folds(ambulo__plan *plan, int row, int column) {
  struct ambulo__coupled_plan *c = plan->coupled;
  if (row >= plan->coordinates) {
    add_folds(plan, row - plan->coordinates + c->joint_count, -1, column, 1);
    return;
  }
  for (int j = 0; j < c->joint_count; j++) {
    ambulo__row_part part[AMBULO__MOST_PARTS];
    if (c->coordinate[j] != row || row_of_joint(plan, j) == AMBULO__ROW_VANISHES) continue;
    (void)ambulo__plan_parts(c->open, j, part);
    add_folds(plan, part[0].row, c->follower[j], column, part[0].factor);
  }
}

static int has_entries(const ambulo__plan *plan, int row) {
  if (row < plan->coordinates) {
    int kind = plan->joints[row].torque_row;
    return kind == AMBULO__ROW_SPARSE || kind == AMBULO__ROW_REACTS;
  }
  return row < plan->coordinates + 6 + 3 * plan->points;
}

static void fill_entries(ambulo__plan *plan) {
  struct ambulo__coupled_plan *c = plan->coupled;
  const int rows = ambulo__plan_rows(plan);
  for (int row = 0; row < rows; row++) {
    plan->start[row] = c->entry_count;
    plan->rate_start[row] = row < plan->coordinates + 6 ? c->entry_count : -1;
    for (int k = 0; k < plan->coordinates && has_entries(plan, row); k++) {
      c->fold_start[c->entry_count + 1] = c->fold_start[c->entry_count];
      add_row_folds(plan, row, k);
      if (c->fold_start[c->entry_count + 1] == c->fold_start[c->entry_count]) continue;
      plan->column[c->entry_count++] = k;
    }
    if (row < plan->coordinates + 6) plan->dynamic_count = c->entry_count;
  }
  plan->start[rows] = plan->count = c->entry_count;
}

/* The entry of a row in a column, -1: none. */
static int entry_of(const ambulo__plan *plan, int row, int column) {
  for (int e = plan->start[row]; e < plan->start[row + 1]; e++)
    if (plan->column[e] == column) return e;
  return -1;
}

static void share_masses(ambulo__plan *plan) {
  struct ambulo__coupled_plan *c = plan->coupled;
  for (int e = 0; e < plan->dynamic_count; e++) plan->by_qdd[e] = e;
  for (int row = 0; row < plan->coordinates; row++) {
    for (int e = plan->start[row]; e < plan->start[row + 1] && plan->column[e] < row; e++) {
      int upper = entry_of(plan, plan->column[e], row);
      if (upper >= 0 && is_whole(plan, row) && is_whole(plan, plan->column[e]))
        plan->by_qdd[e] = upper;
    }
  }
  for (int f = 0; f < c->follower_count; f++) {
    int k = c->followers[f].coordinate;
    c->followers[f].diagonal = entry_of(plan, k, k);
  }
}

static ambulo_status build_pattern(ambulo__plan *plan) {
  struct ambulo__coupled_plan *c = plan->coupled;
  const ambulo_allocator *a = &plan->allocator;
  size_t rows = (size_t)ambulo__plan_rows(plan), d = (size_t)plan->coordinates;
  size_t full = d + 6 + 3 * (size_t)plan->points, joints = (size_t)c->joint_count;
  plan->start = ambulo__alloc(a, rows + 1, sizeof(int));
  plan->rate_start = ambulo__alloc(a, rows, sizeof(int));
  plan->column = ambulo__alloc(a, full * d, sizeof(int));
  plan->by_qdd = ambulo__alloc(a, (d + 6) * d, sizeof(int));
  c->fold_start = ambulo__alloc(a, full * d + 2, sizeof(int));
  c->folds = ambulo__alloc(a, (full - d + joints) * joints, sizeof *c->folds);
  if (!plan->start || !plan->rate_start || !plan->column || !plan->by_qdd || !c->fold_start ||
      !c->folds)
    return AMBULO_E_MEMORY;
  for (int k = 0; k < plan->coordinates; k++) set_row(plan, k);
  fill_entries(plan);
  share_masses(plan);
  if (plan->contacts > 0) ambulo__plan_contact_factors(plan);
  return AMBULO_OK;
}

/* -------------------------------------------------------------------- the scratch */

static void place(ambulo__plan *plan) {
  struct ambulo__coupled_plan *c = plan->coupled;
  size_t *used = &plan->scratch;
  const int rows = ambulo__plan_rows(c->open);
  c->motion_at = takes_place(used, 3 * c->joint_count);
  c->slopes_at = takes_place(used, 5 * c->follower_count);
  c->out_at = takes_place(used, rows);
  c->weights_at = takes_place(used, rows);
  c->gradient_at = takes_place(used, 3 * c->joint_count);
  c->jq_at = takes_place(used, c->open->count);
  c->jqd_at = takes_place(used, c->open->dynamic_count);
  c->jqdd_at = takes_place(used, c->open->dynamic_count);
  c->open_at = (int)*used;
  *used += c->open->scratch;
}

ambulo_status ambulo__coupled_plan_build(ambulo__plan *plan, const ambulo_model *model,
                                         const ambulo__footing *footing) {
  plan->coordinates = model->coordinate_count;
  plan->points = model->point_count;
  plan->contacts = footing->count;
  plan->joints =
      ambulo__alloc(&plan->allocator, (size_t)plan->coordinates + 1, sizeof *plan->joints);
  if (!plan->joints) return AMBULO_E_MEMORY;
  ambulo_status status = set_joints(plan, model);
  if (status != AMBULO_OK) return status;
  plan->mass = plan->coupled->open->mass;
  status = build_pattern(plan);
  if (status == AMBULO_OK) place(plan);
  return status;
}

void ambulo__coupled_plan_free(ambulo__plan *plan) {
  struct ambulo__coupled_plan *c = plan->coupled;
  if (!c) return;
  ambulo__free(&plan->allocator, c->coordinate);
  ambulo__free(&plan->allocator, c->follower);
  ambulo__free(&plan->allocator, c->followers);
  ambulo__free(&plan->allocator, c->pieces);
  ambulo__free(&plan->allocator, c->folds);
  ambulo__free(&plan->allocator, c->fold_start);
  ambulo__free(&plan->allocator, c);
}
