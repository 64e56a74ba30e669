/* problem/definition_check.c - every check of a problem's definition that needs no grid.
 *
 * Each number has a range (members.h), also in definitions built in code: what is not finite, or so
 * large that products of such numbers overflow, is refused here by name instead of spoiling a
 * solve.
 */
#include "contact/row_families.h"
#include "contact/contacts.h"
#include "contact/devices.h"
#include "problem/definition.h"
#include "problem/term.h"
#include "trajectory/basis.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define REFUSE(diagnostics, ...)                                                                   \
  ambulo__error(diagnostics, AMBULO_E_PROBLEM, ambulo__nowhere, NULL, __VA_ARGS__)

static const double narrowest = 1e-6; /* m: points nearer than that have no line */
static const double largest = 1e12;   /* end values, prices */

/* --------------------------------------------------------------------- the table */

/* A member of a definition, a part or a term, under its name in files. */
typedef struct checked {
  const ambulo_problem_definition *definition; /* NULL: of options */
  const ambulo__member *member;
  const char *owner; /* with what stands behind it: "objective[0] (upright): ", or "" */
  ambulo_status fault;
  ambulo_diagnostics *list;
} checked;

#define REFUSE_MEMBER(c, ...)                                                                      \
  ambulo__error((c)->list, (c)->fault, ambulo__nowhere, NULL, __VA_ARGS__)

static int lies_in(const ambulo__member *m, double value) {
  double range[2];
  ambulo__member_range(m, range);
  if (isnan(value)) return m->flags & AMBULO__MAY_BE_OFF;
  return value >= range[0] && value <= range[1] &&
         (isfinite(value) || m->flags & AMBULO__MAY_BE_INFINITE);
}

static ambulo_status check_numbers(const checked *c, const double *value, size_t count) {
  const ambulo__member *m = c->member;
  for (size_t i = 0; value && i < count; i++) {
    if (lies_in(m, value[i])) continue;
    char place[24] = "";
    if (m->count > 1 || m->type == AMBULO__NUMBER_ARRAY)
      (void)snprintf(place, sizeof place, "[%zu]", i);
    const char *unit = ambulo__quantity_unit(m->quantity);
    double range[2];
    ambulo__member_range(m, range);
    return REFUSE_MEMBER(c, "%s%s%s is %g%s%s; expected %g to %g%s", c->owner, m->key, place,
                         value[i], unit[0] ? " " : "", unit, range[0], range[1],
                         m->flags & AMBULO__MAY_BE_OFF ? ", or AMBULO_OFF" : "");
  }
  int off = m->count == 2 && value ? isnan(value[0]) + isnan(value[1]) : 0;
  if (off == 1)
    return REFUSE_MEMBER(c, "%s%s is [%g, %g]; expected two numbers, or AMBULO_OFF twice", c->owner,
                         m->key, value[0], value[1]);
  if (m->flags & AMBULO__RISING && value && !off && !(value[0] < value[1]))
    return REFUSE_MEMBER(c, "%s%s is [%g, %g]; expected lower < upper", c->owner, m->key, value[0],
                         value[1]);
  return AMBULO_OK;
}

static ambulo_status check_integer(const checked *c, int value) {
  const ambulo__member *m = c->member;
  if (value >= m->low && value <= m->high) return AMBULO_OK;
  return REFUSE_MEMBER(c, "%s%s is %d; expected %g to %g", c->owner, m->key, value, m->low,
                       m->high);
}

/* constants of enumerations go from 1 on where 0 is that nobody chose */
static ambulo_status check_choice(const checked *c, int value) {
  const ambulo__member *m = c->member;
  char expected[160] = "";
  if (value >= m->first_word && value < m->first_word + m->word_count) return AMBULO_OK;
  for (int k = 0; k < m->word_count; k++) {
    size_t used = strlen(expected);
    (void)snprintf(expected + used, sizeof expected - used, "%s%d (%s)",
                   k == 0                   ? ""
                   : k + 1 == m->word_count ? " or "
                                            : ", ",
                   m->first_word + k, m->words[k]);
  }
  return REFUSE_MEMBER(c, "%s%s is %s (got %d); expected %s", c->owner, m->key,
                       value || m->first_word == 0 ? "unknown" : "not set", value, expected);
}

/* the degree is a spline's alone */
static int matters(const ambulo_problem_definition *d, const ambulo__member *m) {
  return !d || d->discretization == AMBULO_BSPLINE || strcmp(m->key, "trajectory.degree") != 0;
}

static ambulo_status check_member(const checked *c, const void *item) {
  const ambulo__member *m = c->member;
  const char *at = (const char *)item + m->at;
  int has_range = m->low < m->high, integer = 0;
  if (m->type == AMBULO__INTEGER || m->type == AMBULO__CHOICE) memcpy(&integer, at, sizeof integer);
  if (m->type == AMBULO__CHOICE) return check_choice(c, integer);
  if (m->type == AMBULO__INTEGER && has_range) return check_integer(c, integer);
  if ((m->type == AMBULO__NUMBER || m->type == AMBULO__FILE_ANGLE) && has_range)
    return check_numbers(c, (const double *)(const void *)at, (size_t)m->count);
  if (m->type == AMBULO__NUMBER_ARRAY && has_range)
    return check_numbers(c, ambulo__member_array(m, item),
                         ambulo__member_length(m, c->definition, item) * (size_t)m->count);
  return AMBULO_OK;
}

/* every member with a range, of a structure that c->owner names ("": keys are whole paths), and of
 * its parts; of a term what its kind has; the last fault */
static ambulo_status check_members(checked c, const ambulo__structure *s, const void *item,
                                   int kinds) {
  ambulo_status status = AMBULO_OK;
  for (int i = 0; i < s->count; i++) {
    const ambulo__member *m = &s->members[i];
    ambulo_status one = AMBULO_OK;
    char part[48];
    c.member = m;
    if (m->type == AMBULO__PART) {
      checked inner = c;
      (void)snprintf(part, sizeof part, "%s.", m->key);
      inner.owner = part;
      one = check_members(inner, m->of, (const char *)item + m->at, 0);
    } else if (m->key && (!m->of_kinds || m->of_kinds & kinds) && matters(c.definition, m))
      one = check_member(&c, item);
    if (one) status = one;
  }
  return status;
}

ambulo_status ambulo__option_ranges_check(const ambulo_options *options, ambulo_diagnostics *list) {
  checked c = {.owner = "", .fault = AMBULO_E_ARGUMENT, .list = list};
  return check_members(c, &ambulo__options_members, options, 0);
}

/* arrays of which there are items */
static int arrays_are_there(const ambulo__structure *s, const void *item) {
  int all = 1;
  for (int i = 0; i < s->count; i++) {
    const ambulo__member *m = &s->members[i];
    int count = 0;
    if (m->type == AMBULO__PART) all &= arrays_are_there(m->of, (const char *)item + m->at);
    if (m->type != AMBULO__ITEMS) continue;
    memcpy(&count, (const char *)item + m->count_at, sizeof count);
    all &= count == 0 || (count > 0 && ambulo__member_array(m, item));
  }
  return all;
}

/* --------------------------------------------------------------------------- grid */

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

static ambulo_status check_breakpoints(const ambulo_problem_definition *d,
                                       ambulo_diagnostics *list) {
  for (int i = 0; d->breakpoints && i < d->spline_intervals; i++) {
    if (d->breakpoints[i + 1] > d->breakpoints[i]) continue;
    return REFUSE(list, "trajectory.breakpoints[%d] is %g s after %g s; expected rising times",
                  i + 1, d->breakpoints[i + 1], d->breakpoints[i]);
  }
  return AMBULO_OK;
}

/* -------------------------------------------------------------------------- terms */

static const char *point_name(const ambulo_model *model, int index) {
  const ambulo_point *point = ambulo_model_point(model, index);
  return point ? point->name : "(none)";
}

/* two points that are apart at q = 0 */
static int is_line(const ambulo_model *model, const int point[2]) {
  if (!ambulo_model_point(model, point[0]) || !ambulo_model_point(model, point[1])) return 0;
  return ambulo__upright_length(model, point) > narrowest;
}

static int are_points(const ambulo_model *model, const ambulo_term *term) {
  for (int i = 0; i < term->mark_count; i++)
    if (!ambulo_model_point(model, term->marks[i])) return 0;
  return term->mark_count > 0;
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
  int has = info->members;
  if (has & AMBULO__TERM_LINE && !is_line(d->model, term->point))
    return REFUSE(list, "objective[%d] (%s): points %s and %s; expected two points that are apart",
                  t, info->name, point_name(d->model, term->point[0]),
                  point_name(d->model, term->point[1]));
  const char *lack = info->lacks ? info->lacks(d) : NULL;
  if (lack) return REFUSE(list, "objective[%d] (%s): %s", t, info->name, lack);
  if (term->tendon && !(has & AMBULO__TERM_TENDON))
    return REFUSE(list, "objective[%d] (%s): tendons; expected mechanical_power", t, info->name);
  if (ambulo__term_follows(term) && !term->reference && !term->mark_reference &&
      !term->foot_reference)
    return REFUSE(list, "objective[%d] (%s): no reference motion", t, info->name);
  if (has & AMBULO__TERM_MARKS && !are_points(d->model, term))
    return REFUSE(list, "objective[%d] (%s): the points are not those of the model", t, info->name);
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

static ambulo_status check_numbers_of_term(const ambulo_problem_definition *d, int t,
                                           ambulo_diagnostics *list) {
  const ambulo__term_info *info = ambulo__term_info_of(d->terms[t].kind);
  char owner[64];
  (void)snprintf(owner, sizeof owner, "objective[%d] (%s): ", t, info->name);
  checked c = {d, NULL, owner, AMBULO_E_PROBLEM, list};
  return check_members(c, &ambulo__term_members, &d->terms[t], info->members);
}

static ambulo_status check_terms(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  double total = 0.0;
  for (int t = 0; t < d->term_count; t++) {
    ambulo_status one = check_term(d, t, list);
    if (!one) one = check_numbers_of_term(d, t, list);
    if (!one) one = check_limits(d, t, list);
    if (one) status = one;
    total += d->terms[t].weight;
  }
  if (!status && d->term_count > 0 && total == 0.0)
    status = REFUSE(list, "every objective weight is 0; expected a positive one, or no objective");
  for (int i = 0; i < d->user_row_count; i++) {
    if (!d->user_rows[i].function || !d->user_rows[i].name || !d->user_rows[i].unit)
      status = REFUSE(list, "user row %d has no function, name or unit", i);
    int relation = (int)d->user_rows[i].relation;
    if (relation < AMBULO_EQUAL || relation > AMBULO_NOT_NEGATIVE)
      status = REFUSE(list,
                      "the relation of user row %d is %s (got %d); expected AMBULO_EQUAL or "
                      "AMBULO_NOT_NEGATIVE",
                      i, relation ? "unknown" : "not set", relation);
    if (isnan(d->user_rows[i].from) || isnan(d->user_rows[i].to))
      status = REFUSE(list, "user row %d is asked for from %g s to %g s; expected times", i,
                      d->user_rows[i].from, d->user_rows[i].to);
  }
  return status;
}

/* --------------------------------------------------------------------------- ends */

static ambulo_status check_ends(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  ambulo_status status = AMBULO_OK;
  int coordinates = ambulo_model_coordinate_count(d->model);
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

static ambulo_status check_strike_pitch(const double *pitch, ambulo_diagnostics *list) {
  if ((isnan(pitch[0]) && isnan(pitch[1])) || pitch[0] < pitch[1]) return AMBULO_OK;
  return REFUSE(list,
                "constraints.strike_pitch is from %g to %g rad; expected rising angles, or both "
                "AMBULO_OFF",
                pitch[0], pitch[1]);
}

/* a pad goes with the forces of the ground, within what a foot may be off */
static ambulo_status check_heel_pad(const ambulo_problem_definition *d, ambulo_diagnostics *list) {
  double pad = d->ground_reaction.heel_pad;
  if (pad == 0.0) return AMBULO_OK;
  if (d->ground_reaction.kind == AMBULO_REACTION_NONE)
    return REFUSE(list,
                  "ground_reaction.heel_pad is %g m and no forces press on it; expected kind "
                  "shared, or 0",
                  pad);
  for (int i = 0; i < ambulo_model_foot_count(d->model); i++) {
    ambulo__foot_outline foot = ambulo__foot_outline_of(d->model, i);
    const double *touch = foot.touch;
    if (touch[1] - touch[0] > narrowest) continue;
    return REFUSE(list,
                  "ground_reaction.heel_pad is %g m, and heel and ball of '%s' touch at %g m and "
                  "%g m along the foot; expected a ball that is ahead",
                  pad, ambulo_model_foot(d->model, i)->name, touch[0], touch[1]);
  }
  if (d->contact_tolerance > 0.0) return AMBULO_OK;
  return REFUSE(list,
                "ground_reaction.heel_pad is %g m without constraints.contact_tolerance, and heels "
                "are held rigidly; expected a tolerance, or 0",
                pad);
}

ambulo_status ambulo__definition_check(const ambulo_problem_definition *d,
                                       ambulo_diagnostics *diagnostics) {
  const ambulo__structure *all = &ambulo__definition_members;
  if (!d || d->size != sizeof *d || !d->model || !arrays_are_there(all, d))
    return AMBULO_E_ARGUMENT;
  checked c = {d, NULL, "", AMBULO_E_PROBLEM, diagnostics};
  ambulo_status status = check_members(c, all, d, 0);
  if (!status) status = check_breakpoints(d, diagnostics);
  if (!status) status = check_places(d, diagnostics);
  ambulo_status others[] = {check_terms(d, diagnostics),
                            check_ends(d, diagnostics),
                            check_strike_pitch(d->strike_pitch, diagnostics),
                            status ? AMBULO_OK : check_heel_pad(d, diagnostics),
                            status ? AMBULO_OK : ambulo__tubes_check(d, diagnostics),
                            ambulo__collision_check(d, diagnostics),
                            ambulo__devices_check(d, diagnostics),
                            ambulo__holds_check(d, diagnostics)};
  for (size_t i = 0; i < sizeof others / sizeof *others; i++)
    if (!status) status = others[i];
  return status;
}
