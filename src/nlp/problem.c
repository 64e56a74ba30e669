/* nlp/problem.c - building a problem: deep copy, grid, schedule, rows, hash.
 *
 * Order of construction (each step may refuse): definition checked and copied -> basis and
 * lane map -> compiled mechanics -> schedule at the nodes -> rows of every family -> counts
 * and hash. After that nothing changes.
 */
#include "nlp/problem.h"

#include <math.h>
#include <string.h>

enum { DEFINITION_COOKIE = 0x616d6270, MAX_INTERVALS = 100000, MAX_ROWS = 50000000 };

ambulo_problem_definition ambulo_problem_definition_default(void) {
  ambulo_problem_definition definition = {
      .cookie = DEFINITION_COOKIE,
      .duration = 1.0,
      .intervals = 12,
      .discretization = AMBULO_BSPLINE,
      .degree = 3,
      .minimum_force = -1.0,
      .orientation_tolerance = 0.01,
      .clearance = {-1.0, 0.3, 0.35, 0.2, 0.06, 0.03},
      .ground_reaction = {.kind = AMBULO_REACTION_NONE,
                          .transfer = AMBULO_TRANSFER_EARLY,
                          .exponent = 1.4,
                          .shear = 1.0,
                          .friction = 0.5,
                          .free_moment = 0.02,
                          .pressure = 1,
                          .heel_pressure = {-0.02, 0.03},
                          .heel_roll = 0.04,
                          .flat_pressure = {-0.005, 0.02},
                          .toe_pressure = {-0.02, 0.055},
                          .pressure_width = 0.035},
      .ends_order = 1,
  };
  return definition;
}

ambulo_term ambulo_term_default(ambulo_term_kind kind) {
  ambulo_term term = {.kind = kind, .weight = 1.0, .smoothing = 1.0, .power = 2.0, .height = 0.02};
  if (kind == AMBULO_TORQUE_POWER) {
    term.power = 3.0;
    term.smoothing = 0.01;
  }
  if (kind == AMBULO_MECHANICAL_POWER) term.smoothing = 0.05;
  return term;
}

static const ambulo__place nowhere = {NULL, 0, 0, NULL};

#define REFUSE(diagnostics, ...)                                                                   \
  ambulo__error(diagnostics, AMBULO_E_PROBLEM, nowhere, NULL, __VA_ARGS__)

static ambulo_status check_grid(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  if (!(d->duration > 0.0) || !isfinite(d->duration))
    status = REFUSE(list, "time.duration is %g s; expected a positive time", d->duration);
  if (d->intervals < 1 || d->intervals > MAX_INTERVALS)
    status = REFUSE(list, "time.intervals is %d; expected 1 to %d", d->intervals, MAX_INTERVALS);
  if (d->spline_intervals < 0 || d->spline_intervals > MAX_INTERVALS)
    status =
        REFUSE(list, "trajectory.intervals is %d; expected 1 to %d (0: as many as time intervals)",
               d->spline_intervals, MAX_INTERVALS);
  if (d->discretization == AMBULO_BSPLINE && (d->degree < 3 || d->degree > AMBULO__MAX_DEGREE))
    status =
        REFUSE(list, "trajectory.degree is %d; expected 3 to %d", d->degree, AMBULO__MAX_DEGREE);
  for (int i = 0; d->breakpoints && !status && i < d->spline_intervals; i++) {
    if (d->breakpoints[i + 1] > d->breakpoints[i]) continue;
    status = REFUSE(list, "trajectory.breakpoints[%d] is %g s after %g s; expected rising times",
                    i + 1, d->breakpoints[i + 1], d->breakpoints[i]);
  }
  return status;
}

static const char *point_name(const ambulo_model *model, int index) {
  const ambulo_point *point = ambulo_model_point(model, index);
  return point ? point->name : "(none)";
}

/* two different points of one link */
static int is_line(const ambulo_model *model, const int point[2]) {
  const ambulo_point *a = ambulo_model_point(model, point[0]);
  const ambulo_point *b = ambulo_model_point(model, point[1]);
  if (!a || !b || a->link != b->link) return 0;
  return a->position[0] != b->position[0] || a->position[1] != b->position[1] ||
         a->position[2] != b->position[2];
}

static ambulo_status check_term(const ambulo_problem_definition *d, int t,
                                ambulo_diagnostics *list) {
  const ambulo_term *term = &d->terms[t];
  const ambulo__term_info *info = ambulo__term_info_of(term->kind);
  if (!info) return REFUSE(list, "objective[%d]: unknown term kind %d", t, (int)term->kind);
  if (!(term->weight >= 0.0) || !isfinite(term->weight))
    return REFUSE(list, "objective[%d] (%s): weight is %g; expected a number >= 0", t, info->name,
                  term->weight);
  int smoothed = term->kind == AMBULO_TORQUE_ABSOLUTE || term->kind == AMBULO_TORQUE_POWER ||
                 term->kind == AMBULO_MECHANICAL_POWER;
  if (smoothed && !(term->smoothing > 0.0))
    return REFUSE(list, "objective[%d] (%s): smoothing is %g; expected a positive number", t,
                  info->name, term->smoothing);
  if (term->kind == AMBULO_TORQUE_POWER && !(term->power >= 2.0 && term->power <= 8.0))
    return REFUSE(list, "objective[%d] (%s): power is %g; expected 2 to 8", t, info->name,
                  term->power);
  if (term->kind == AMBULO_CLEARANCE && !(term->height > 0.0))
    return REFUSE(list, "objective[%d] (%s): height is %g m; expected a positive length", t,
                  info->name, term->height);
  if (term->kind == AMBULO_UPRIGHT && !is_line(d->model, term->point))
    return REFUSE(list, "objective[%d] (%s): points %s and %s; expected two points of one link", t,
                  info->name, point_name(d->model, term->point[0]),
                  point_name(d->model, term->point[1]));
  if (term->kind == AMBULO_TRACKING && !term->reference)
    return REFUSE(list, "objective[%d] (%s): no reference motion", t, info->name);
  if (term->kind == AMBULO_USER_TERM && !term->function)
    return REFUSE(list, "objective[%d] (%s): no function", t, info->name);
  return AMBULO_OK;
}

static ambulo_status check_terms(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  double total = 0.0;
  for (int t = 0; t < d->term_count; t++) {
    ambulo_status one = check_term(d, t, list);
    if (one) status = one;
    total += d->terms[t].weight;
  }
  if (!status && d->term_count > 0 && total == 0.0)
    status = REFUSE(list, "every objective weight is 0; expected a positive one, or no objective");
  for (int i = 0; i < d->user_row_count; i++) {
    if (!d->user_rows[i].function || !d->user_rows[i].name || !d->user_rows[i].unit)
      status = REFUSE(list, "user row %d has no function, name or unit", i);
  }
  return status;
}

static ambulo_status check_ends(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  int coordinates = ambulo_model_coordinate_count(d->model);
  if (d->ends_order < 0 || d->ends_order > 2)
    status = REFUSE(list, "ends.order is %d; expected 0, 1 or 2", d->ends_order);
  for (int i = 0; i < d->end_value_count; i++) {
    const ambulo_end_value *end = &d->end_values[i];
    if (end->coordinate < 0 || end->coordinate >= coordinates)
      status = REFUSE(list, "end value %d names coordinate %d; the model has %d", i,
                      end->coordinate, coordinates);
    if (end->order < 0 || end->order > 2 || !isfinite(end->value))
      status = REFUSE(list, "end value %d: order %d, value %g; expected order 0 to 2, finite", i,
                      end->order, end->value);
  }
  if (!isfinite(d->travel))
    status = REFUSE(list, "ends.travel is %g m; expected a finite length", d->travel);
  return status;
}

static int listed(const void *array, int count) {
  return count == 0 || (count > 0 && array);
}

static int arrays_are_there(const ambulo_problem_definition *d) {
  return listed(d->contacts, d->contact_count) && listed(d->terms, d->term_count) &&
         listed(d->end_values, d->end_value_count) && listed(d->tubes, d->tube_count) &&
         listed(d->user_rows, d->user_row_count);
}

ambulo_status ambulo__definition_check(const ambulo_problem_definition *d,
                                       ambulo_diagnostics *diagnostics) {
  if (!d || d->cookie != DEFINITION_COOKIE || !d->model || !arrays_are_there(d))
    return AMBULO_E_ARGUMENT;
  ambulo_status status = check_grid(d, diagnostics);
  ambulo_status terms = check_terms(d, diagnostics);
  ambulo_status ends = check_ends(d, diagnostics);
  if (!status) status = terms;
  if (!status) status = ends;
  if (!status) status = ambulo__tubes_check(d, diagnostics);
  if (d->support_margin < 0.0)
    status =
        REFUSE(diagnostics, "constraints.zmp_margin is %g m; expected >= 0", d->support_margin);
  return status;
}

/* ------------------------------------------------------------ construction */

static ambulo_status build_grid(ambulo_problem *p) {
  const ambulo_problem_definition *d = &p->definition;
  int spline = d->spline_intervals ? d->spline_intervals : d->intervals;
  static const ambulo__basis_kind kinds[] = {AMBULO__BSPLINE, AMBULO__CENTRAL_DIFFERENCE,
                                             AMBULO__HERMITE};
  ambulo_status status =
      ambulo__basis_create(kinds[d->discretization], d->degree, spline, d->duration, d->breakpoints,
                           &p->allocator, &p->basis);
  if (status) return status;
  p->nodes = d->intervals + 1;
  p->blocks = ambulo__block_count(p->nodes);
  p->times = ambulo__alloc(&p->allocator, (size_t)p->nodes, sizeof *p->times);
  p->quadrature =
      ambulo__alloc(&p->allocator, (size_t)p->blocks * AMBULO__LANES, sizeof *p->quadrature);
  if (!p->times || !p->quadrature) return AMBULO_E_MEMORY;
  for (int k = 0; k < p->nodes; k++) {
    p->times[k] = (double)k * d->duration / (double)d->intervals;
    int end = k == 0 || k == d->intervals;
    p->quadrature[k] = (end ? 0.5 : 1.0) * d->duration / (double)d->intervals;
  }
  p->control_points = ambulo__basis_control_points(p->basis);
  p->variables = p->control_points * p->coordinates;
  return ambulo__lane_map_create(p->basis, p->times, p->nodes, p->coordinates, &p->allocator,
                                 &p->map);
}

static void add_user_rows(ambulo_problem *p) {
  for (int u = 0; u < p->definition.user_row_count; u++) {
    const ambulo_user_row *user = &p->definition.user_rows[u];
    for (int k = 0; k < p->nodes; k++) {
      if (p->times[k] < user->from - 1e-9 || p->times[k] > user->to + 1e-9) continue;
      ambulo__row_begin(&p->table, user->name, "", "", user->unit, user->relation, k, p->times[k],
                        0.0);
      if (!p->table.status) p->table.rows[p->table.row_count - 1].user = u;
    }
  }
}

static ambulo_status build_rows(ambulo_problem *p, ambulo_diagnostics *diagnostics) {
  const ambulo_problem_definition *d = &p->definition;
  ambulo__gait_frame frame = {d, p->model, p->basis, p->channels, p->times, p->nodes, p->active};
  ambulo_status status = AMBULO_OK;
  if (d->ground_penetration) ambulo__ground_rows(&frame, &p->table);
  if (d->contact_tolerance > 0.0) {
    ambulo__contact_tube_rows(&frame, &p->table);
  } else if (d->foot_strike) {
    ambulo__foot_strike_rows(&frame, &p->table);
  }
  if (d->clearance.height >= 0.0) ambulo__clearance_rows(&frame, &p->table);
  status = ambulo__zmp_rows(&frame, &p->table, diagnostics);
  if (status) return status;
  if (p->channels.feet) ambulo__reaction_rows(&frame, &p->table);
  ambulo__limit_rows(&frame, &p->table);
  ambulo__tube_rows(&frame, &p->table);
  ambulo__end_rows(&frame, &p->table);
  add_user_rows(p);
  if (p->table.status) return p->table.status;
  p->rows = p->table.row_count;
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
  status = ambulo__schedule_check_reach(d, p->times, p->nodes, p->active, diagnostics);
  ambulo_status ends = ambulo__ends_check(d, p->nodes, p->active, &p->allocator, diagnostics);
  if (!status) status = ends;
  return status ? status : ambulo__strength_check(d, &p->allocator, diagnostics);
}

static ambulo_status build_plan(ambulo_problem *p, ambulo_diagnostics *diagnostics) {
  const ambulo_problem_definition *d = &p->definition;
  if (d->ground_reaction.kind == AMBULO_REACTION_NONE)
    return ambulo__plan_create(p->model, &p->allocator, &p->plan);
  int feet = ambulo_model_foot_count(p->model);
  if (feet != 2)
    return REFUSE(diagnostics, "ground_reaction: the model '%s' has %d feet; expected 2",
                  ambulo_model_name(p->model), feet);
  p->channels.feet = feet;
  return ambulo__plan_create_grounded(p->model, d->ground_height, &p->allocator, &p->plan);
}

static ambulo_status build(ambulo_problem *p, ambulo_diagnostics *diagnostics) {
  p->model = p->definition.model;
  p->coordinates = ambulo_model_coordinate_count(p->model);
  p->channels.coordinates = p->coordinates;
  p->channels.points = ambulo_model_point_count(p->model);
  ambulo_status status = build_grid(p);
  if (!status) status = build_plan(p, diagnostics);
  if (!status) status = build_schedule(p, diagnostics);
  if (!status) status = ambulo__ground_fill(p, &p->allocator, p->times, p->nodes, &p->ground);
  if (!status) status = build_rows(p, diagnostics);
  if (status) return status;
  p->kernels = ambulo__kernels_select();
  return AMBULO_OK;
}

ambulo_status ambulo__problem_create_unnamed(const ambulo_problem_definition *definition,
                                             const ambulo_allocator *allocator,
                                             ambulo_diagnostics *diagnostics,
                                             ambulo_problem **problem) {
  ambulo_status status = ambulo__definition_check(definition, diagnostics);
  if (status) return status;
  ambulo_allocator own = ambulo__allocator_or_default(allocator);
  ambulo_problem *p = ambulo__alloc(&own, 1, sizeof *p);
  if (!p) return AMBULO_E_MEMORY;
  p->allocator = own;
  p->file_options = ambulo_options_default();
  ambulo__row_table_init(&p->table, &own);
  status = ambulo__definition_copy(definition, &own, &p->definition);
  if (!status) status = build(p, diagnostics);
  if (status) {
    ambulo_problem_free(p);
    return status;
  }
  *problem = p;
  return AMBULO_OK;
}

ambulo_status ambulo_problem_create(const ambulo_problem_definition *definition,
                                    const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, ambulo_problem **problem) {
  if (!problem) return AMBULO_E_ARGUMENT;
  ambulo_status status =
      ambulo__problem_create_unnamed(definition, allocator, diagnostics, problem);
  if (!status) (*problem)->hash = ambulo__problem_hash_of(*problem);
  return status;
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
  ambulo__row_runs_free(&a, &p->row_runs);
  ambulo__free(&a, p->active);
  ambulo__free_aligned(&a, p->ground);
  ambulo__definition_free(&a, &p->definition);
  ambulo_model_free(p->owned_model);
  ambulo__free(&a, p);
}
