/* problem/definition_check.c - every check of a problem's definition that needs no grid.
 *
 * Each number has a range, also in definitions built in code: what is not finite, or so large that
 * products of such numbers overflow, is refused here by name instead of spoiling a solve.
 */
#include "contact/collision.h"
#include "problem/problem.h"

#include <math.h>
#include <stdio.h>

enum { MAX_INTERVALS = 100000 };

#define REFUSE(diagnostics, ...)                                                                   \
  ambulo__error(diagnostics, AMBULO_E_PROBLEM, ambulo__nowhere, NULL, __VA_ARGS__)

/* -------------------------------------------------------------- plain numbers */

static const double shortest = 1e-6;  /* s: no motion is shorter */
static const double narrowest = 1e-6; /* m: points nearer than that have no line */
static const double longest = 1e6;    /* m, s: no length or duration of a task is longer */
static const double largest = 1e12;   /* weights, scales and offsets */
static const double everything = HUGE_VAL;

/* `count` numbers that have to lie in [low, high]; infinite ends let infinity pass */
typedef struct number_range {
  const char *name, *unit;
  const double *value;
  int count;
  double low, high;
  int may_be_off;
} number_range;

static int lies_in(const number_range *r, double value) {
  return value >= r->low && value <= r->high && (isfinite(value) || r->high == everything);
}

static ambulo_status check_range(const number_range *r, ambulo_diagnostics *list) {
  const char *space = r->unit[0] ? " " : "";
  for (int i = 0; r->value && i < r->count; i++) {
    if (lies_in(r, r->value[i]) || (r->may_be_off && isnan(r->value[i]))) continue;
    char place[16] = "";
    if (r->count > 1) (void)snprintf(place, sizeof place, "[%d]", i);
    return REFUSE(list, "%s%s is %g%s%s; expected %g to %g%s", r->name, place, r->value[i], space,
                  r->unit, r->low, r->high, r->may_be_off ? ", or AMBULO_OFF" : "");
  }
  return AMBULO_OK;
}

static ambulo_status check_ranges(const number_range *ranges, size_t count,
                                  ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  for (size_t i = 0; i < count; i++) {
    ambulo_status one = check_range(&ranges[i], list);
    if (one) status = one;
  }
  return status;
}

static ambulo_status check_strike_pitch(const double *pitch, ambulo_diagnostics *list) {
  const number_range range = {"constraints.strike_pitch", "rad", pitch, 2, -10.0, 10.0, 0};
  if (isnan(pitch[0]) && isnan(pitch[1])) return AMBULO_OK;
  ambulo_status status = check_range(&range, list);
  if (!status && !(pitch[0] < pitch[1]))
    status =
        REFUSE(list,
               "constraints.strike_pitch is from %g to %g rad; expected rising angles, or both "
               "AMBULO_OFF",
               pitch[0], pitch[1]);
  return status;
}

static ambulo_status check_task(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  const number_range ranges[] = {
      {"constraints.ground_height", "m", &d->ground_height, 1, -longest, longest, 0},
      {"constraints.zmp_margin", "m", &d->support_margin, 1, 0.0, longest, 0},
      {"minimum_force", "body weights", &d->minimum_force, 1, 0.0, largest, 1},
      {"constraints.contact_tolerance", "m", &d->contact_tolerance, 1, -longest, longest, 0},
      {"constraints.orientation_tolerance", "rad", &d->orientation_tolerance, 1, 0.0, 10.0, 0},
      {"ends.travel", "m", &d->travel, 1, -longest, longest, 0},
      {"ends.rise", "m", &d->rise, 1, -longest, longest, 0},
  };
  ambulo_status pitch = check_strike_pitch(d->strike_pitch, list);
  ambulo_status status = check_ranges(ranges, sizeof ranges / sizeof *ranges, list);
  return status ? status : pitch;
}

static ambulo_status check_clearance(const ambulo_clearance *c, ambulo_diagnostics *list) {
  const number_range ranges[] = {
      {"constraints.clearance.height", "m", &c->height, 1, 0.0, longest, 1},
      {"constraints.clearance.tip_from", "", &c->tip_from, 1, -largest, largest, 0},
      {"constraints.clearance.ceiling", "m", &c->ceiling, 1, -longest, everything, 0},
      {"constraints.clearance.turn", "", &c->turn, 1, 0.0, everything, 0},
      {"constraints.clearance.outward", "m", &c->outward, 1, 0.0, everything, 0},
      {"constraints.clearance.inward", "m", &c->inward, 1, 0.0, everything, 0},
      {"constraints.clearance.feet", "m", &c->feet, 1, 0.0, longest, 1},
  };
  return check_ranges(ranges, sizeof ranges / sizeof *ranges, list);
}

static ambulo_status check_reaction(const ambulo_ground_reaction *r, ambulo_diagnostics *list) {
  const number_range ranges[] = {
      {"ground_reaction.exponent", "", &r->exponent, 1, 1.0, 100.0, 0},
      {"ground_reaction.shear", "", &r->shear, 1, -100.0, 100.0, 0},
      {"ground_reaction.friction", "", &r->friction, 1, 0.0, largest, 1},
      {"ground_reaction.free_moment", "m", &r->free_moment, 1, 0.0, largest, 1},
      {"ground_reaction.heel_pressure", "m", r->heel_pressure, 2, -longest, longest, 0},
      {"ground_reaction.heel_roll", "m", &r->heel_roll, 1, -longest, longest, 0},
      {"ground_reaction.flat_pressure", "m", r->flat_pressure, 2, -longest, longest, 0},
      {"ground_reaction.toe_pressure", "m", r->toe_pressure, 2, -longest, longest, 0},
      {"ground_reaction.pressure_width", "m", &r->pressure_width, 1, 0.0, longest, 0},
      {"ground_reaction.arc_pressure", "m", &r->arc_pressure, 1, 0.0, longest, 0},
      {"ground_reaction.moment_arm", "m", &r->moment_arm, 1, 1e-6, longest, 0},
      {"ground_reaction.slant", "", &r->slant, 1, 1e-6, largest, 0},
      {"ground_reaction.loading_rate", "1/s", &r->loading_rate, 1, 0.0, largest, 1},
      {"ground_reaction.flight_tolerance", "body weights", &r->flight_tolerance, 1, 1e-6, largest,
       0},
  };
  return check_ranges(ranges, sizeof ranges / sizeof *ranges, list);
}

/* -------------------------------------------------------------------- the rest */

/* constants of enumerations go from 1 on; 0 is that nobody chose */
static ambulo_status check_choice(const char *name, int value, int last, const char *expected,
                                  ambulo_diagnostics *list) {
  if (value >= 1 && value <= last) return AMBULO_OK;
  return REFUSE(list, "%s is %s (got %d); expected %s", name, value ? "unknown" : "not set", value,
                expected);
}

static ambulo_status check_choices(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  static const char grids[] = "AMBULO_GRID_UNIFORM or _EVENTS";
  ambulo_status status[] = {
      check_choice("time.grid", (int)d->grid, AMBULO_GRID_EVENTS, grids, list),
      check_choice("trajectory.knots", (int)d->knots, AMBULO_GRID_EVENTS, grids, list),
      check_choice("trajectory.basis", (int)d->discretization, AMBULO_HERMITE,
                   "AMBULO_BSPLINE, _CENTRAL_DIFFERENCE or _HERMITE", list),
      d->ground_reaction.kind == AMBULO_REACTION_TWO_STEP
          ? check_choice("ground_reaction.transfer", (int)d->ground_reaction.transfer,
                         AMBULO_TRANSFER_SMOOTH, "AMBULO_TRANSFER_EARLY, _LINEAR or _SMOOTH", list)
          : AMBULO_OK};
  for (size_t i = 0; i < sizeof status / sizeof *status; i++)
    if (status[i]) return status[i];
  return AMBULO_OK;
}

static ambulo_status check_node_times(const ambulo_problem_definition *d,
                                      ambulo_diagnostics *list) {
  const double *t = d->node_times;
  double slack = 1e-9 * d->duration;
  if (d->grid != AMBULO_GRID_EVENTS)
    return REFUSE(list, "node_times are given for a uniform grid; expected AMBULO_GRID_EVENTS");
  if (!(t[0] == 0.0 && fabs(t[d->intervals] - d->duration) <= slack))
    return REFUSE(list, "node_times run from %g s to %g s; expected 0 s to %g s", t[0],
                  t[d->intervals], d->duration);
  for (int k = 0; k < d->intervals; k++) {
    if (t[k + 1] > t[k] && t[k + 1] <= d->duration + slack) continue;
    return REFUSE(list, "node_times[%d] is %g s after %g s; expected rising times", k + 1, t[k + 1],
                  t[k]);
  }
  return AMBULO_OK;
}

/* the places of nodes and knots */
static ambulo_status check_places(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  int on_events = d->grid == AMBULO_GRID_EVENTS || d->knots == AMBULO_GRID_EVENTS;
  if (on_events && d->discretization != AMBULO_BSPLINE)
    return REFUSE(list, "a grid on events with basis %s; expected bspline",
                  d->discretization == AMBULO_HERMITE ? "hermite" : "central_difference");
  if (d->breakpoints && d->knots == AMBULO_GRID_EVENTS)
    return REFUSE(list, "trajectory.breakpoints are given and knots on events asked for; expected "
                        "one of the two");
  return d->node_times ? check_node_times(d, list) : AMBULO_OK;
}

static ambulo_status check_grid(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  if (!(d->duration >= shortest && d->duration <= longest))
    status =
        REFUSE(list, "time.duration is %g s; expected %g to %g s", d->duration, shortest, longest);
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
  return status ? status : check_places(d, list);
}

static const char *point_name(const ambulo_model *model, int index) {
  const ambulo_point *point = ambulo_model_point(model, index);
  return point ? point->name : "(none)";
}

/* two points that are apart at q = 0 */
static int is_line(const ambulo_model *model, const int point[2]) {
  if (!ambulo_model_point(model, point[0]) || !ambulo_model_point(model, point[1])) return 0;
  return ambulo__upright_length(model, point) > narrowest;
}

static ambulo_status check_term(const ambulo_problem_definition *d, int t,
                                ambulo_diagnostics *list) {
  const ambulo_term *term = &d->terms[t];
  const ambulo__term_info *info = ambulo__term_info_of(term->kind);
  if (!info)
    return REFUSE(list,
                  "objective[%d]: the kind of the term is %s (got %d); expected an "
                  "ambulo_term_kind",
                  t, term->kind ? "unknown" : "not set", (int)term->kind);
  if (!(term->weight >= 0.0 && term->weight <= largest))
    return REFUSE(list, "objective[%d] (%s): weight is %g; expected 0 to %g", t, info->name,
                  term->weight, largest);
  int has = info->members;
  if (has & AMBULO__TERM_SMOOTHING && !(term->smoothing > 0.0 && term->smoothing <= largest))
    return REFUSE(list, "objective[%d] (%s): smoothing is %g; expected a positive number", t,
                  info->name, term->smoothing);
  if (has & AMBULO__TERM_POWER && !(term->power >= 2.0 && term->power <= 8.0))
    return REFUSE(list, "objective[%d] (%s): power is %g; expected 2 to 8", t, info->name,
                  term->power);
  if (has & AMBULO__TERM_HEIGHT && !(term->height > 0.0 && term->height <= longest))
    return REFUSE(list, "objective[%d] (%s): height is %g m; expected a positive length", t,
                  info->name, term->height);
  if (has & AMBULO__TERM_LINE && !is_line(d->model, term->point))
    return REFUSE(list, "objective[%d] (%s): points %s and %s; expected two points that are apart",
                  t, info->name, point_name(d->model, term->point[0]),
                  point_name(d->model, term->point[1]));
  const char *lack = info->lacks ? info->lacks(d) : NULL;
  if (lack) return REFUSE(list, "objective[%d] (%s): %s", t, info->name, lack);
  if (term->tendon && !(has & AMBULO__TERM_TENDON))
    return REFUSE(list, "objective[%d] (%s): tendons; expected mechanical_power", t, info->name);
  if (has & AMBULO__TERM_REFERENCE && !term->reference)
    return REFUSE(list, "objective[%d] (%s): no reference motion", t, info->name);
  if (has & AMBULO__TERM_CALLBACK && !term->function)
    return REFUSE(list, "objective[%d] (%s): no function", t, info->name);
  return AMBULO_OK;
}

/* both of a priced coordinate's limits, for strength that is limits */
static ambulo_status check_limits(const ambulo_problem_definition *d, int t,
                                  ambulo_diagnostics *list) {
  const ambulo_term *term = &d->terms[t];
  if (!term->strength_is_limits && term->price)
    return REFUSE(list, "objective[%d]: prices without strength: limits", t);
  if (!term->strength_is_limits) return AMBULO_OK;
  if (!ambulo__term_has(term, AMBULO__TERM_CURVES))
    return REFUSE(list, "objective[%d]: strength is limits; expected torque_power", t);
  for (int i = 0; i < ambulo_model_coordinate_count(d->model); i++) {
    const ambulo_coordinate *c = ambulo_model_coordinate(d->model, i);
    if (ambulo__term_scale(term, i) == 0.0) continue;
    for (int side = 0; side < 2 && term->price; side++) {
      double price = term->price[2 * i + side];
      if (!(price > 0.0 && price <= largest))
        return REFUSE(list, "objective[%d]: a price of %g for %s; expected a positive one", t,
                      price, c->name);
    }
    if (isfinite(c->torque[0]) && isfinite(c->torque[1]) && c->torque[0] < 0.0 &&
        c->torque[1] > 0.0)
      continue;
    return REFUSE(list,
                  "objective[%d]: strength is limits, and %s has none in the model; expected "
                  "torque limits on both sides of 0, or a scale of 0",
                  t, c->name);
  }
  return AMBULO_OK;
}

static ambulo_status check_term_arrays(const ambulo_problem_definition *d, int t,
                                       ambulo_diagnostics *list) {
  const ambulo_term *term = &d->terms[t];
  int n = ambulo_model_coordinate_count(d->model);
  char scale[64], offset[64], passive[64], strength[64], reference[64], tendon[64];
  (void)snprintf(scale, sizeof scale, "objective[%d]: scale", t);
  (void)snprintf(offset, sizeof offset, "objective[%d]: offset", t);
  (void)snprintf(passive, sizeof passive, "objective[%d]: passive", t);
  (void)snprintf(strength, sizeof strength, "objective[%d]: strength", t);
  (void)snprintf(reference, sizeof reference, "objective[%d]: reference", t);
  (void)snprintf(tendon, sizeof tendon, "objective[%d]: tendon", t);
  int samples = d->intervals > 0 && d->intervals <= MAX_INTERVALS ? d->intervals + 1 : 0;
  const number_range ranges[] = {
      {scale, "", term->scale, n, -largest, largest, 0},
      {offset, "", term->offset, n, -largest, largest, 0},
      {passive, "", term->passive, 4 * n, -largest, largest, 0},
      {strength, "", term->strength, 6 * n, -largest, largest, 0},
      {reference, "", term->reference, n * samples, -largest, largest, 0},
      {scale, "", term->device_scale, d->device_count, 0.0, largest, 0},
      {tendon, " N m/rad", term->tendon, n, 0.0, largest, 0},
  };
  return check_ranges(ranges, sizeof ranges / sizeof *ranges, list);
}

static ambulo_status check_terms(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  double total = 0.0;
  for (int t = 0; t < d->term_count; t++) {
    ambulo_status one = check_term(d, t, list);
    if (!one) one = check_term_arrays(d, t, list);
    if (!one) one = check_limits(d, t, list);
    if (one) status = one;
    total += d->terms[t].weight;
  }
  if (!status && d->term_count > 0 && total == 0.0)
    status = REFUSE(list, "every objective weight is 0; expected a positive one, or no objective");
  for (int i = 0; i < d->user_row_count; i++) {
    if (!d->user_rows[i].function || !d->user_rows[i].name || !d->user_rows[i].unit)
      status = REFUSE(list, "user row %d has no function, name or unit", i);
    char place[48];
    (void)snprintf(place, sizeof place, "the relation of user row %d", i);
    ambulo_status chosen = check_choice(place, (int)d->user_rows[i].relation, AMBULO_NOT_NEGATIVE,
                                        "AMBULO_EQUAL or AMBULO_NOT_NEGATIVE", list);
    if (chosen) status = chosen;
    if (isnan(d->user_rows[i].from) || isnan(d->user_rows[i].to))
      status = REFUSE(list, "user row %d is asked for from %g s to %g s; expected times", i,
                      d->user_rows[i].from, d->user_rows[i].to);
  }
  return status;
}

static ambulo_status check_ends(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  int coordinates = ambulo_model_coordinate_count(d->model);
  if (d->ends_order < 0 || d->ends_order > 2)
    status = REFUSE(list, "ends.order is %d; expected 0, 1 or 2", d->ends_order);
  if (d->ends == AMBULO_ENDS_FREE && d->rise != 0.0)
    status =
        REFUSE(list, "ends.rise is %g with free ends; expected 0, or ends that match", d->rise);
  for (int i = 0; i < d->end_value_count; i++) {
    const ambulo_end_value *end = &d->end_values[i];
    if (end->coordinate < 0 || end->coordinate >= coordinates)
      status = REFUSE(list, "end value %d names coordinate %d; the model has %d", i,
                      end->coordinate, coordinates);
    if (end->order < 0 || end->order > 2 || !(fabs(end->value) <= largest))
      status = REFUSE(list, "end value %d: order %d, value %g; expected order 0 to 2, at most %g",
                      i, end->order, end->value, largest);
  }
  return status;
}

static int listed(const void *array, int count) {
  return count == 0 || (count > 0 && array);
}

static int arrays_are_there(const ambulo_problem_definition *d) {
  return listed(d->contacts, d->contact_count) && listed(d->terms, d->term_count) &&
         listed(d->end_values, d->end_value_count) && listed(d->tubes, d->tube_count) &&
         listed(d->user_rows, d->user_row_count) && listed(d->obstacles, d->obstacle_count) &&
         listed(d->reaches, d->reach_count) &&
         listed(d->collision.pairs, d->collision.pair_count) &&
         listed(d->devices, d->device_count) && listed(d->holds, d->hold_count);
}

ambulo_status ambulo__definition_check(const ambulo_problem_definition *d,
                                       ambulo_diagnostics *diagnostics) {
  if (!d || d->size != sizeof *d || !d->model || !arrays_are_there(d)) return AMBULO_E_ARGUMENT;
  ambulo_status status = check_choices(d, diagnostics);
  if (!status) status = check_grid(d, diagnostics);
  ambulo_status terms = check_terms(d, diagnostics);
  ambulo_status ends = check_ends(d, diagnostics);
  if (!status) status = terms;
  if (!status) status = ends;
  if (!status) status = ambulo__tubes_check(d, diagnostics);
  ambulo_status numbers[] = {check_task(d, diagnostics),
                             check_clearance(&d->clearance, diagnostics),
                             check_reaction(&d->ground_reaction, diagnostics),
                             ambulo__collision_check(d, diagnostics),
                             ambulo__devices_check(d, diagnostics),
                             ambulo__holds_check(d, diagnostics)};
  for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
    if (numbers[i]) status = numbers[i];
  }
  return status;
}
