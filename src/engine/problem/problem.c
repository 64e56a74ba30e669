/* problem/problem.c - building a problem: deep copy, grid, schedule, rows, hash.
 *
 * Order of construction (each step may refuse): definition checked and copied -> basis and
 * lane map -> compiled mechanics -> schedule at the nodes -> rows of every family -> counts
 * and hash. After that nothing changes.
 *
 * Reading order: nlp.h, members.h, definition.h, problem.c, variants.c, workspace.c, term.h,
 * evaluate.c, motion.c, row_runs.h, gradient.c, row_gradients.c; derivative_check.c compares them.
 */
#include "model/neutral_pose.h"
#include "problem/nlp.h"
#include "model/model_query.h"
#include "base/arithmetic.h"
#include "contact/devices.h"
#include "contact/schedule.h"
#include "contact/contacts.h"
#include "contact/row_families.h"
#include "problem/term.h"

#include <math.h>
#include <string.h>

#define REFUSE(diagnostics, ...)                                                                   \
  ambulo__error(diagnostics, AMBULO_E_PROBLEM, ambulo__nowhere, NULL, __VA_ARGS__)

/* ------------------------------------------------------------ construction */

static ambulo_status build_basis(ambulo_problem *p, ambulo_diagnostics *diagnostics) {
  const ambulo_problem_definition *d = &p->definition;
  int spline = d->spline_intervals ? d->spline_intervals : d->intervals;
  static const ambulo__basis_kind kinds[] = {AMBULO__BSPLINE, AMBULO__CENTRAL_DIFFERENCE,
                                             AMBULO__HERMITE};
  double *own = NULL;
  ambulo_status status = AMBULO_OK;
  if (d->knots == AMBULO_GRID_EVENTS) {
    own = ambulo__alloc(&p->allocator, (size_t)spline + 1, sizeof *own);
    if (!own) return AMBULO_E_MEMORY;
    status = ambulo__knot_times(d, spline, &p->allocator, diagnostics, own);
  }
  if (!status)
    status =
        ambulo__basis_create(kinds[d->discretization - AMBULO_BSPLINE], d->degree, spline,
                             d->duration, own ? own : d->breakpoints, &p->allocator, &p->basis);
  ambulo__free(&p->allocator, own);
  return status;
}

/* trapezoidal, in each phase by itself: a node on an event has half an interval of both */
static void fill_quadrature(ambulo_problem *p) {
  const ambulo_problem_definition *d = &p->definition;
  int last = p->nodes - 1;
  for (int k = 0; k <= last; k++) {
    int end = k == 0 || k == last;
    p->quadrature[k] = (end ? 0.5 : 1.0) * d->duration / (double)d->intervals;
    if (d->grid == AMBULO_GRID_UNIFORM) continue; /* the same, rounded once */
    p->quadrature[k] = 0.5 * (p->times[k < last ? k + 1 : k] - p->times[k > 0 ? k - 1 : k]);
  }
}

static ambulo_status build_lean(ambulo_problem *p) {
  for (int i = 0; i < p->coordinates; i++) {
    double lean = ambulo__lean(p->model, i);
    if (lean == 0.0) continue;
    if (!p->lean) p->lean = ambulo__alloc(&p->allocator, (size_t)p->coordinates, sizeof *p->lean);
    if (!p->lean) return AMBULO_E_MEMORY;
    p->lean[i] = lean;
  }
  return AMBULO_OK;
}

static ambulo_status build_grid(ambulo_problem *p, ambulo_diagnostics *diagnostics) {
  const ambulo_problem_definition *d = &p->definition;
  ambulo_status status = build_basis(p, diagnostics);
  if (!status) status = build_lean(p);
  if (status) return status;
  p->nodes = d->intervals + 1;
  p->blocks = ambulo__block_count(p->nodes);
  p->times = ambulo__alloc(&p->allocator, (size_t)p->nodes, sizeof *p->times);
  p->quadrature =
      ambulo__alloc(&p->allocator, (size_t)p->blocks * AMBULO__LANES, sizeof *p->quadrature);
  if (!p->times || !p->quadrature) return AMBULO_E_MEMORY;
  status = ambulo__node_times(d, &p->allocator, diagnostics, p->times);
  if (status) return status;
  fill_quadrature(p);
  p->control_points = ambulo__basis_control_points(p->basis);
  p->variables = p->control_points * p->coordinates;
  return ambulo__lane_map_create(p->basis, p->times, p->nodes, p->coordinates, &p->allocator,
                                 &p->map);
}

static void add_user_rows(ambulo_problem *p) {
  for (int u = 0; u < p->definition.user_row_count; u++) {
    const ambulo_user_row *user = &p->definition.user_rows[u];
    for (int k = 0; k < p->nodes; k++) {
      if (p->times[k] < user->from - AMBULO__INSTANT || p->times[k] > user->to + AMBULO__INSTANT)
        continue;
      ambulo__row_user(&p->table, user, u, k, p->times[k]);
    }
  }
}

ambulo_status ambulo__problem_build_rows(ambulo_problem *p, ambulo_diagnostics *diagnostics) {
  const ambulo_problem_definition *d = &p->definition;
  ambulo__gait_context context = {d,        p->model, p->basis,  p->channels,
                                  p->times, p->nodes, p->active, p->before};
  ambulo_status status = AMBULO_OK;
  p->table.weight = ambulo__model_weight(p->model);
  if (d->ground_penetration) ambulo__ground_rows(&context, &p->table);
  if (d->contact_tolerance > 0.0) {
    ambulo__contact_tube_rows(&context, &p->table);
  } else if (d->foot_strike) {
    ambulo__foot_strike_rows(&context, &p->table);
  }
  if (d->contact_tolerance > 0.0 || d->foot_strike) ambulo__patch_rows(&context, &p->table);
  if (d->clearance.height >= 0.0) {
    ambulo__clearance_rows(&context, &p->table);
    ambulo__feet_apart_rows(&context, &p->table);
  }
  status = ambulo__zmp_rows(&context, &p->table, diagnostics);
  if (status) return status;
  if (d->ground_reaction.kind == AMBULO_REACTION_SHARED) {
    ambulo__sharing_rows(&context, &p->table);
    ambulo__flight_rows(&context, &p->table);
  }
  ambulo__limit_rows(&context, &p->table);
  ambulo__passive_rows(&context, &p->table);
  status = ambulo__collision_rows(&context, &p->allocator, &p->table);
  if (status) return status;
  ambulo__hold_rows(&context, &p->table);
  ambulo__obstacle_rows(&context, &p->table);
  status = ambulo__reach_rows(&context, &p->table, diagnostics);
  if (status) return status;
  ambulo__tube_rows(&context, &p->table);
  ambulo__end_rows(&context, &p->table);
  add_user_rows(p);
  if (p->table.status == AMBULO_E_INTERNAL)
    return ambulo__error(diagnostics, AMBULO_E_INTERNAL, ambulo__nowhere, NULL,
                         "a constraint row has more terms than its form holds");
  if (p->table.status) return p->table.status;
  p->rows = p->table.row_count;
  p->equalities = 0;
  for (int r = 0; r < p->rows; r++) p->equalities += p->table.rows[r].relation == AMBULO_EQUAL;
  return ambulo__row_runs_create(&p->table, ambulo__channel_count(&p->channels), &p->allocator,
                                 &p->row_runs);
}

static ambulo_status build_schedule(ambulo_problem *p, ambulo_diagnostics *diagnostics) {
  const ambulo_problem_definition *d = &p->definition;
  size_t feet = (size_t)ambulo_model_foot_count(p->model);
  p->active = ambulo__alloc(&p->allocator, (size_t)p->nodes * feet, sizeof *p->active);
  if (!p->active) return AMBULO_E_MEMORY;
  ambulo_status status = ambulo__schedule_fill(d, p->times, p->nodes, p->active, diagnostics);
  if (status) return status;
  if (d->grid == AMBULO_GRID_EVENTS) {
    p->before = ambulo__alloc(&p->allocator, (size_t)p->nodes * feet, sizeof *p->before);
    if (!p->before) return AMBULO_E_MEMORY;
    ambulo__schedule_before(d, p->times, p->nodes, p->active, p->before);
  }
  status = ambulo__schedule_check_reach(d, p->times, p->nodes, p->active, diagnostics);
  if (!status) status = ambulo__devices_check_strides(d, diagnostics);
  ambulo_status ends = ambulo__ends_check(d, p->nodes, p->active, &p->allocator, diagnostics);
  if (!status) status = ends;
  ends = ambulo__schedule_check_ends(d, diagnostics);
  if (!status) status = ends;
  return status ? status : ambulo__strength_check(d, &p->allocator, diagnostics);
}

/* l of the contacts: where all are point feet, which turn nothing, no more than their region. With
 * the reach of a sole their moments would carry a trot, and rows of pressure refuse it. */
static double moment_arm(const ambulo_problem_definition *d, const ambulo__slots *slots) {
  double arm = d->ground_reaction.moment_arm;
  return slots->all_points ? fmin(arm, AMBULO__POINT_REGION) : arm;
}

/* contacts carry what moves the whole body: no torque is left to drive it with */
static ambulo_status check_undriven(const ambulo_problem *p, ambulo_diagnostics *diagnostics) {
  int k = ambulo__plan_undriven(p->plan);
  if (k < 0) return AMBULO_OK;
  return REFUSE(diagnostics,
                "ground_reaction: the contacts carry the whole body, which '%s' moves; expected it "
                "without armature, damping and friction",
                p->model->coordinates[k].name);
}

static ambulo_status build_plan(ambulo_problem *p, ambulo_diagnostics *diagnostics) {
  const ambulo_problem_definition *d = &p->definition;
  if (d->ground_reaction.kind == AMBULO_REACTION_NONE)
    return ambulo__plan_create(p->model, &p->allocator, &p->plan);
  const ambulo_ground_reaction *r = &d->ground_reaction;
  p->slots = ambulo__slots_of(d);
  const ambulo__slots slots = p->slots;
  if (slots.count < 1 || slots.count > AMBULO__MOST_SLOTS)
    return REFUSE(diagnostics,
                  "ground_reaction: the feet of '%s' and its patches in contact press on the "
                  "surroundings with %d links (toes behind a joint count); expected 1 to %d",
                  ambulo_model_name(p->model), slots.count, AMBULO__MOST_SLOTS);
  p->channels.feet = ambulo_model_foot_count(p->model);
  p->channels.slots = slots.count;
  ambulo_status status = ambulo__plan_create_contacts(
      p->model, slots.link, slots.count, moment_arm(d, &slots), r->slant, &p->allocator, &p->plan);
  return status ? status : check_undriven(p, diagnostics);
}

static ambulo_status check_symmetry(const ambulo_problem *p, ambulo_diagnostics *diagnostics) {
  ambulo_status status = ambulo__mirror_check(&p->definition, &p->allocator, diagnostics);
  if (status == AMBULO_E_MEMORY) return status;
  ambulo_status terms = ambulo__mirror_terms_check(&p->definition, &p->allocator, diagnostics);
  ambulo_status bodies = ambulo__collision_mirror_check(&p->definition, diagnostics);
  ambulo_status devices = ambulo__devices_mirror_check(&p->definition, diagnostics);
  if (bodies) status = bodies;
  ambulo_status holds = ambulo__holds_mirror_check(&p->definition, diagnostics);
  if (holds) status = holds;
  return terms ? terms : devices ? devices : status;
}

/* ------------------------------------------------------------- capsules, obstacles */

/* Capsules get points in the model, and their pairs are listed. Rows carry names, and what reports
 * of them outlives the problem that made it: grids that a solve makes for itself. Names of capsules
 * live in the model, which all grids of a problem share. So do they share obstacles' names, which
 * belong to the problem of the first.
 */

/* the pairs of the definition as they came out; a copy of the list belongs to the definition */
static ambulo_status resolve_pairs(ambulo_problem *p) {
  ambulo_collision *c = &p->definition.collision;
  ambulo__pairs pairs;
  ambulo_status status = ambulo__pairs_create(&p->definition, &p->allocator, &pairs);
  if (status) return status;
  ambulo_capsule_pair *kept = ambulo__alloc(&p->allocator, (size_t)pairs.kept_count, sizeof *kept);
  if (!kept) {
    ambulo__pairs_free(&p->allocator, &pairs);
    return AMBULO_E_MEMORY;
  }
  if (pairs.kept_count > 0) memcpy(kept, pairs.kept, (size_t)pairs.kept_count * sizeof *kept);
  ambulo__definition_set_pairs(&p->allocator, &p->definition, kept, pairs.kept_count);
  if (c->mode != AMBULO_COLLISION_OFF) c->mode = AMBULO_COLLISION_PAIRS;
  p->pairs = pairs;
  return AMBULO_OK;
}

static ambulo_status extend_model(ambulo_problem *p, ambulo_diagnostics *diagnostics) {
  const ambulo_model *m = p->definition.model;
  size_t count = (size_t)m->capsule_count;
  int missing = 0, *used = ambulo__alloc(&p->allocator, count, sizeof *used);
  if (!used) return AMBULO_E_MEMORY;
  for (int i = 0; i < m->capsule_count; i++) {
    used[i] = ambulo__capsule_is_used(&p->definition, i);
    missing += used[i] && m->capsule_point[i] < 0;
  }
  ambulo_status status = AMBULO_OK;
  if (missing > 0) {
    status =
        ambulo__model_with_capsule_points(m, used, &p->allocator, diagnostics, &p->extended_model);
    if (!status) p->definition.model = p->extended_model;
  }
  ambulo__free(&p->allocator, used);
  return status;
}

static ambulo_status add_bodies(ambulo_problem *p, ambulo_diagnostics *diagnostics) {
  ambulo_status status = resolve_pairs(p);
  return status ? status : extend_model(p, diagnostics);
}

/* a copy of the obstacles with copies of their names, both freed by the caller */
static ambulo_status copy_obstacles(const ambulo_problem_definition *d,
                                    const ambulo_allocator *allocator, ambulo_obstacle **obstacles,
                                    char **names) {
  size_t size = 1, count = (size_t)d->obstacle_count;
  for (size_t i = 0; i < count; i++) size += strlen(d->obstacles[i].name) + 1;
  *names = ambulo__alloc(allocator, size, 1);
  *obstacles = ambulo__alloc(allocator, count, sizeof **obstacles);
  if (!*names || !*obstacles) return AMBULO_E_MEMORY;
  char *end = *names;
  for (size_t i = 0; i < count; i++) {
    size_t length = strlen(d->obstacles[i].name) + 1;
    (*obstacles)[i] = d->obstacles[i];
    (*obstacles)[i].name = memcpy(end, d->obstacles[i].name, length);
    end += length;
  }
  return AMBULO_OK;
}

/* ------------------------------------------------------------------- the whole */

static ambulo_status build(ambulo_problem *p, ambulo_diagnostics *diagnostics) {
  ambulo_status status = add_bodies(p, diagnostics);
  if (status) return status;
  p->model = p->definition.model;
  p->coordinates = ambulo_model_coordinate_count(p->model);
  p->channels.coordinates = p->coordinates;
  p->channels.points = ambulo_model_point_count(p->model);
  p->channels.devices = p->definition.device_count;
  status = build_grid(p, diagnostics);
  if (!status) status = build_plan(p, diagnostics);
  if (!status) status = ambulo__devices_create(&p->definition, &p->allocator, &p->devices);
  if (!status) status = ambulo__holds_create(&p->definition, p->plan, &p->allocator, &p->holds);
  if (!status && p->holds && ambulo__plan_contacts(p->plan) > 0)
    p->taken_at = ambulo__plan_take_wrench(p->plan);
  if (!status) status = ambulo__check_memory(p, diagnostics);
  ambulo_status symmetry = status ? AMBULO_OK : check_symmetry(p, diagnostics);
  if (symmetry == AMBULO_E_MEMORY) return symmetry;
  if (!status) status = build_schedule(p, diagnostics);
  if (!status) status = symmetry;
  if (!status) status = ambulo__ground_fill(p, &p->allocator, p->times, p->nodes, &p->ground);
  if (!status)
    status =
        ambulo__devices_tell(&p->definition, &p->allocator, p->times, p->nodes, &p->time_factors);
  if (!status) status = ambulo__problem_build_rows(p, diagnostics);
  if (status) return status;
  p->kernels = ambulo__kernels_select();
  return AMBULO_OK;
}

ambulo_status ambulo__problem_build(const ambulo_problem_definition *definition,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, ambulo_problem **problem) {
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo_problem *p = ambulo__alloc(&own, 1, sizeof *p);
  if (!p) return AMBULO_E_MEMORY;
  p->allocator = own;
  ambulo__row_table_init(&p->table, &own);
  ambulo_status status = ambulo__definition_copy(definition, &own, &p->definition);
  if (!status) status = build(p, diagnostics);
  if (status) {
    ambulo_problem_free(p);
    return status;
  }
  p->hash = ambulo__definition_hash(&p->definition, p->model);
  *problem = p;
  return AMBULO_OK;
}

/* with names of obstacles of its own */
static ambulo_status create(const ambulo_problem_definition *definition,
                            const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics,
                            ambulo_problem **problem) {
  ambulo_problem_definition named = *definition;
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo_obstacle *obstacles = NULL;
  char *names = NULL;
  ambulo_status status = ambulo__definition_check(definition, diagnostics);
  if (!status && definition->obstacle_count > 0) {
    status = copy_obstacles(definition, &own, &obstacles, &names);
    named.obstacles = obstacles;
  }
  if (!status) status = ambulo__problem_build(&named, allocator, diagnostics, problem);
  ambulo__free(&own, obstacles);
  if (status)
    ambulo__free(&own, names);
  else
    (*problem)->obstacle_names = names;
  return status;
}

ambulo_status ambulo_problem_create(const ambulo_problem_definition *definition,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, ambulo_problem **problem) {
  if (!problem) return AMBULO_E_ARGUMENT;
  size_t errors = ambulo_diagnostics_error_count(diagnostics);
  ambulo__taken_definition own;
  ambulo_status status = ambulo__definition_take(definition, allocator, &own);
  if (!status) status = create(&own.definition, allocator, diagnostics, problem);
  ambulo__definition_drop(&own);
  return ambulo__conclude(diagnostics, errors, status, NULL);
}

void ambulo_problem_free(ambulo_problem *p) {
  if (!p) return;
  ambulo_allocator a = p->allocator;
  ambulo__row_table_clear(&p->table);
  ambulo__lane_map_free(p->map);
  ambulo__basis_free(p->basis);
  ambulo__plan_free(p->plan);
  ambulo__free(&a, p->times);
  ambulo__free(&a, p->quadrature);
  ambulo__free(&a, p->lean);
  ambulo__row_runs_free(&a, &p->row_runs);
  ambulo__free(&a, p->active);
  ambulo__free(&a, p->before);
  ambulo__free_aligned(&a, p->ground);
  ambulo__free_aligned(&a, p->time_factors);
  ambulo__devices_free(p->devices);
  ambulo__holds_free(p->holds);
  ambulo__definition_free(&a, &p->definition);
  ambulo__pairs_free(&a, &p->pairs);
  ambulo__free(&a, p->obstacle_names);
  ambulo__free(&a, p->inputs);
  ambulo_model_free(p->extended_model);
  ambulo_muscles_free(p->owned_muscles);
  ambulo_model_free(p->owned_model);
  ambulo__free(&a, p->free);
  ambulo__free(&a, p);
}
