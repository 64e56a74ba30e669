/* mechanics/plan.c - compiling a model: from DH links to frames that kernels can run.
 *
 * Only links with a coordinate become frames; every other link is a constant placing (R, p) in
 * the frame it is fixed to. With (R, p) the placing of a link's parent, its transform
 * T = Rot_z(theta) Trans_z(d) Trans_x(a) Rot_x(alpha) reads
 *   fixed:      R <- R Rot_z Rot_x,  p <- p + R Rot_z (a, 0, 0) + R (0, 0, d)
 *   revolute:   the axis is z = R e_z through p. If z = s e_c for a frame axis c, the new frame is
 *               the parent frame turned about e_c by s (q + shift), its origin at p, and the link
 *               is placed at R Rot_x, R (a, 0, d). An oblique axis first turns the frame by R.
 *   prismatic:  the new frame stands at p and slides along z by q; the rest is as if it were fixed.
 * theta is made part of the placing if it is a multiple of 90 degrees, else part of the shift, so
 * that axes stay aligned along the chain; Trans_z may be done before the turn, and is where that
 * lets more axes share an origin. Numbers that stem from cos(pi/2) are rounded to zero.
 */
#include "mechanics/plan_coupled.h"

#include <math.h>
#include <string.h>

static const double snap = 1e-15;

static double snapped(double x) {
  if (fabs(x) < snap) return 0;
  if (fabs(x - 1) < snap) return 1;
  if (fabs(x + 1) < snap) return -1;
  return x;
}

/* r <- r times a rotation by angle that mixes columns u and v. */
static void rotate_columns(double r[3][3], int u, int v, double angle) {
  double c = snapped(cos(angle)), s = snapped(sin(angle));
  for (int i = 0; i < 3; i++) {
    double x = r[i][u], y = r[i][v];
    r[i][u] = snapped(c * x + s * y);
    r[i][v] = snapped(c * y - s * x);
  }
}

static void move(ambulo__placing *placing, double x, double z) {
  for (int i = 0; i < 3; i++) {
    placing->position[i] += placing->rotation[i][0] * x + placing->rotation[i][2] * z;
    if (fabs(placing->position[i]) < snap) placing->position[i] = 0;
  }
}

/* Places the link after its constant transform. */
static void place_fixed(ambulo__placing *placing, const ambulo_link *link) {
  rotate_columns(placing->rotation, 0, 1, link->theta);
  move(placing, link->a, link->d);
  rotate_columns(placing->rotation, 1, 2, link->alpha);
}

/* The frame axis c with z = +-e_c, or -1. An angle of 1.5707963 is not a right one: its sine is 1
 * in double precision, its cosine is 2.7e-8. */
static int aligned_axis(const double rotation[3][3]) {
  for (int i = 0; i < 3; i++) {
    int others_vanish = rotation[(i + 1) % 3][2] == 0 && rotation[(i + 2) % 3][2] == 0;
    if (fabs(rotation[i][2]) == 1 && others_vanish) return i;
  }
  return -1;
}

/* The joint's origin may stand anywhere on the axis. It is the parent's origin
 * if the axis meets that and nothing is gained by leaving it, else the foot of
 * the link's common normal, where the next axes of a compound joint go through.
 * Returns what is left of d. */
static double set_origin(ambulo__joint *joint, ambulo__placing *placing, const ambulo_link *link) {
  double along = 0, away = 0, *p = placing->position, foot[3], distance = 0;
  for (int i = 0; i < 3; i++) along += placing->rotation[i][2] * p[i];
  for (int i = 0; i < 3; i++) {
    away = fmax(away, fabs(p[i] - along * placing->rotation[i][2]));
    foot[i] = snapped(p[i] + placing->rotation[i][2] * link->d);
    distance = fmax(distance, fabs(foot[i]));
  }
  if (away < snap && (distance < snap || link->a != 0)) return link->d;
  joint->has_offset = 1;
  for (int i = 0; i < 3; i++) {
    joint->offset[i] = foot[i];
    p[i] = 0;
  }
  return 0;
}

static void set_turn(ambulo__joint *joint, ambulo__placing *placing) {
  double p[3];
  joint->turned = 1;
  for (int i = 0; i < 3; i++) {
    p[i] = 0;
    for (int k = 0; k < 3; k++) {
      joint->turn[3 * i + k] = placing->rotation[i][k];
      p[i] += placing->rotation[k][i] * placing->position[k];
    }
  }
  for (int i = 0; i < 3; i++) {
    placing->position[i] = p[i];
    for (int k = 0; k < 3; k++) placing->rotation[i][k] = i == k;
  }
}

static void compile_revolute(ambulo__joint *joint, ambulo__placing *placing,
                             const ambulo_link *link) {
  double turns = link->theta / (0.5 * acos(-1));
  int constant = fabs(turns - round(turns)) < snap;
  double d = set_origin(joint, placing, link);
  joint->axis = aligned_axis((const double(*)[3])placing->rotation);
  if (joint->axis < 0) {
    set_turn(joint, placing);
    joint->axis = 2;
  }
  joint->sign = placing->rotation[joint->axis][2];
  joint->shift = constant ? 0 : joint->sign * link->theta;
  if (constant) rotate_columns(placing->rotation, 0, 1, link->theta);
  move(placing, link->a, d);
  rotate_columns(placing->rotation, 1, 2, link->alpha);
}

static void compile_prismatic(ambulo__joint *joint, ambulo__placing *placing,
                              const ambulo_link *link) {
  ambulo__placing axes = *placing;
  joint->axis = aligned_axis((const double(*)[3])placing->rotation);
  if (joint->axis < 0) {
    set_turn(joint, &axes);
    joint->axis = 2;
    joint->sign = 1;
  } else {
    joint->sign = placing->rotation[joint->axis][2];
  }
  memcpy(joint->offset, placing->position, sizeof joint->offset);
  memset(placing->position, 0, sizeof placing->position);
  place_fixed(placing, link);
}

static int has_drive(const ambulo_coordinate *c) {
  return c->armature != 0 || c->damping != 0 || c->friction != 0;
}

/* (DH): Compiles one link. Parents come first, so placings[link->parent] is known. */
static void compile_link(ambulo__plan *plan, const ambulo_model *model, const ambulo_link *link,
                         ambulo__placing *placing) {
  if (link->type == AMBULO_FIXED) {
    place_fixed(placing, link);
    return;
  }
  ambulo__joint *joint = &plan->joints[link->coordinate];
  joint->parent = placing->frame;
  joint->revolute = link->type == AMBULO_REVOLUTE;
  joint->driven = has_drive(&model->coordinates[link->coordinate]);
  if (joint->revolute) {
    compile_revolute(joint, placing, link);
  } else {
    compile_prismatic(joint, placing, link);
  }
  placing->frame = link->coordinate + 1;
}

/* Joints that carry the whole body on contacts have no row, and no drive (ambulo__plan_undriven).
 * The entry of jqd of a slider that stands still is nobody's. */
static ambulo_status compile_drives(ambulo__plan *plan, const ambulo_model *model) {
  plan->drives = ambulo__alloc(&plan->allocator, (size_t)plan->coordinates, sizeof *plan->drives);
  if (!plan->drives) return AMBULO_E_MEMORY;
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo_coordinate *c = &model->coordinates[k];
    const ambulo__joint *joint = &plan->joints[k];
    double speed = ambulo__friction_speed(c);
    int above = plan->ancestor_start[k + 1] - plan->ancestor_start[k];
    if (!joint->driven || joint->torque_row == AMBULO__ROW_VANISHES) continue;
    plan->drives[plan->drive_count++] =
        (ambulo__drive){.input = k * AMBULO__LANES,
                        .diagonal = (plan->start[k] + above) * AMBULO__LANES,
                        .alone = !joint->revolute && joint->still,
                        .armature = c->armature,
                        .damping = c->damping,
                        .friction = c->friction,
                        .smoothing = speed * speed};
  }
  return AMBULO_OK;
}

static void set_fixed_load(ambulo__plan *plan, const ambulo__mass *fixed) {
  for (int i = 0; i < 3; i++) plan->fixed_load[3 + i] = -fixed->mass * plan->gravity[i];
  for (int i = 0; i < 3; i++) plan->fixed_first[i] = fixed->mass * fixed->com[i];
  for (int i = 0; i < 3; i++) {
    int u = (i + 1) % 3, v = (i + 2) % 3;
    plan->fixed_load[i] =
        fixed->com[u] * plan->fixed_load[3 + v] - fixed->com[v] * plan->fixed_load[3 + u];
  }
}

/* Merges the bodies frame by frame; what is fixed to the world becomes a constant load. */
static void collect_bodies(ambulo__plan *plan, const ambulo_model *model,
                           const ambulo__placing *placings, ambulo__mass *masses) {
  for (int i = 0; i < model->link_count; i++) {
    if (!(model->links[i].mass > 0)) continue;
    ambulo__mass mass = ambulo__mass_of_link(&model->links[i], &placings[i]);
    ambulo__mass_add(&masses[placings[i].frame], &mass);
  }
  set_fixed_load(plan, &masses[0]);
  plan->mass = masses[0].mass;
  plan->frames[0].body = -1;
  for (int k = 1; k <= plan->coordinates; k++) {
    plan->frames[k].body = -1;
    if (!(masses[k].mass > 0)) continue;
    ambulo__rigid_body *body = &plan->body[plan->bodies];
    ambulo__mass_factor(&masses[k], body);
    body->frame = k;
    plan->mass += body->mass;
    plan->frames[k].body = plan->bodies++;
  }
}

static void collect_points(ambulo__plan *plan, const ambulo_model *model,
                           const ambulo__placing *placings) {
  for (int i = 0; i < plan->points; i++) {
    const ambulo__placing *placing = &placings[model->points[i].link];
    plan->point[i].frame = placing->frame;
    for (int r = 0; r < 3; r++) {
      double sum = placing->position[r];
      for (int k = 0; k < 3; k++) sum += placing->rotation[r][k] * model->points[i].position[k];
      plan->point[i].position[r] = sum;
    }
  }
}

static ambulo_status compile(ambulo__plan *plan, const ambulo_model *model,
                             const ambulo__footing *footing) {
  const ambulo_allocator *allocator = &plan->allocator;
  ambulo_status status = AMBULO_E_MEMORY;
  size_t frames = (size_t)plan->coordinates + 1;
  ambulo__placing *placings = ambulo__alloc(allocator, (size_t)model->link_count, sizeof *placings);
  ambulo__mass *masses = ambulo__alloc(allocator, frames, sizeof *masses);
  if (!placings || !masses) goto done;
  for (int i = 0; i < model->link_count; i++) {
    const ambulo_link *link = &model->links[i];
    ambulo__placing world = {0, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
    placings[i] = link->parent >= 0 ? placings[link->parent] : world;
    compile_link(plan, model, link, &placings[i]);
  }
  collect_bodies(plan, model, placings, masses);
  collect_points(plan, model, placings);
  if (footing->count > 0 && ambulo__plan_carriers(plan, footing, placings)) goto done;
  ambulo__plan_place(plan);
  status = ambulo__plan_pattern_build(plan);
  if (status == AMBULO_OK) status = compile_drives(plan, model);
  if (status == AMBULO_OK) status = ambulo__plan_steps_build(plan);
  if (status == AMBULO_OK) status = ambulo__plan_local_build(plan);
done:
  ambulo__free(allocator, placings);
  ambulo__free(allocator, masses);
  return status;
}

static ambulo_status create(const ambulo_model *model, const ambulo__footing *footing,
                            const ambulo_allocator *allocator, ambulo__plan **out);

/* The plan of a body with coupled joints, around that of the body with a coordinate for every
 * joint. */
static ambulo_status create_coupled(const ambulo_model *model, const ambulo__footing *footing,
                                    ambulo__plan *plan) {
  const ambulo_allocator *a = &plan->allocator;
  ambulo_model open = *model;
  plan->coupled = ambulo__alloc(a, 1, sizeof *plan->coupled);
  open.links = ambulo__alloc(a, (size_t)model->link_count, sizeof *open.links);
  size_t joints = (size_t)model->coordinate_count + (size_t)model->coupled_count;
  open.coordinates = ambulo__alloc(a, joints, sizeof *open.coordinates);
  open.coordinate_count = open.coupled_count = 0;
  ambulo_status status =
      plan->coupled && open.links && open.coordinates ? AMBULO_OK : AMBULO_E_MEMORY;
  for (int i = 0; !status && i < model->link_count; i++) {
    const int own = model->links[i].coordinate;
    open.links[i] = model->links[i];
    if (open.links[i].type == AMBULO_FIXED) continue;
    open.coordinates[open.coordinate_count] =
        own >= 0 ? model->coordinates[own] : ambulo_coordinate_default(); /* without a drive */
    open.links[i].coordinate = open.coordinate_count++;
  }
  if (!status) status = create(&open, footing, a, &plan->coupled->open);
  if (!status) status = ambulo__coupled_plan_build(plan, model, footing);
  ambulo__free(a, open.links);
  ambulo__free(a, open.coordinates);
  return status;
}

static ambulo_status create(const ambulo_model *model, const ambulo__footing *footing,
                            const ambulo_allocator *allocator, ambulo__plan **out) {
  ambulo_status status = AMBULO_E_MEMORY;
  ambulo_allocator memory = ambulo__allocator_or_default(allocator);
  ambulo__plan *plan = ambulo__alloc(&memory, 1, sizeof *plan);
  if (!plan) return AMBULO_E_MEMORY;
  plan->allocator = memory;
  if (model->coupled_count > 0) {
    status = create_coupled(model, footing, plan);
    if (status != AMBULO_OK) goto failed;
    *out = plan;
    return AMBULO_OK;
  }
  plan->coordinates = model->coordinate_count;
  plan->points = model->point_count;
  memcpy(plan->gravity, model->gravity, sizeof plan->gravity);
  size_t frames = (size_t)plan->coordinates + 1;
  plan->frames = ambulo__alloc(&memory, frames, sizeof *plan->frames);
  plan->joints = ambulo__alloc(&memory, frames, sizeof *plan->joints);
  plan->body = ambulo__alloc(&memory, frames, sizeof *plan->body);
  plan->point = ambulo__alloc(&memory, (size_t)plan->points, sizeof *plan->point);
  if (!plan->frames || !plan->joints || !plan->body || !plan->point) goto failed;
  status = compile(plan, model, footing);
  if (status != AMBULO_OK) goto failed;
  *out = plan;
  return AMBULO_OK;
failed:
  ambulo__plan_free(plan);
  return status;
}

ambulo_status ambulo__plan_create(const ambulo_model *model, const ambulo_allocator *allocator,
                                  ambulo__plan **plan) {
  const ambulo__footing none = {0};
  return create(model, &none, allocator, plan);
}

static int is_positive(double value) {
  return value > 0 && isfinite(value);
}

ambulo_status ambulo__plan_create_contacts(const ambulo_model *model, const int *link, int count,
                                           double moment_arm, double slant,
                                           const ambulo_allocator *allocator, ambulo__plan **plan) {
  ambulo__footing footing = {.count = count, .moment_arm = moment_arm, .slant = slant};
  if (count < 1 || count > AMBULO__MOST_CONTACTS) return AMBULO_E_ARGUMENT;
  if (!is_positive(moment_arm) || !is_positive(slant)) return AMBULO_E_ARGUMENT;
  for (int c = 0; c < count; c++) {
    if (link[c] < 0 || link[c] >= model->link_count) return AMBULO_E_ARGUMENT;
    footing.link[c] = link[c];
  }
  return create(model, &footing, allocator, plan);
}

void ambulo__plan_free(ambulo__plan *plan) {
  if (!plan) return;
  ambulo_allocator memory = plan->allocator;
  ambulo__plan_steps_free(plan);
  ambulo__plan_local_free(plan);
  if (plan->coupled) ambulo__plan_free(plan->coupled->open);
  ambulo__coupled_plan_free(plan);
  ambulo__free(&memory, plan->frames);
  ambulo__free(&memory, plan->joints);
  ambulo__free(&memory, plan->body);
  ambulo__free(&memory, plan->point);
  ambulo__free(&memory, plan->start);
  ambulo__free(&memory, plan->column);
  ambulo__free(&memory, plan->ancestor_start);
  ambulo__free(&memory, plan->ancestor);
  ambulo__free(&memory, plan->upper);
  ambulo__free(&memory, plan->rate_start);
  ambulo__free(&memory, plan->by_qdd);
  ambulo__free(&memory, plan->roots);
  ambulo__free(&memory, plan->drives);
  ambulo__free(&memory, plan);
}

/* what a plan needs. */

int ambulo__plan_vanishes(const ambulo__plan *plan, int coordinate) {
  return plan->joints[coordinate].torque_row == AMBULO__ROW_VANISHES;
}

int ambulo__plan_undriven(const ambulo__plan *plan) {
  if (plan->coupled) {
    int joint = ambulo__plan_undriven(plan->coupled->open);
    return joint < 0 ? -1 : plan->coupled->coordinate[joint];
  }
  for (int k = 0; k < plan->coordinates; k++) {
    const ambulo__joint *joint = &plan->joints[k];
    if (joint->driven && joint->torque_row == AMBULO__ROW_VANISHES) return k;
  }
  return -1;
}

size_t ambulo__plan_take_wrench(ambulo__plan *plan) {
  struct ambulo__coupled_plan *c = plan->coupled;
  if (c) {
    size_t at = ambulo__plan_take_wrench(c->open);
    plan->scratch = (size_t)c->open_at + ambulo__plan_scratch(c->open);
    return (size_t)c->open_at + at;
  }
  plan->taken_at = plan->scratch;
  plan->scratch += (size_t)12 * AMBULO__LANES;
  return plan->taken_at;
}

size_t ambulo__plan_scratch(const ambulo__plan *plan) {
  return plan->scratch;
}
