/* definitions/problem_grid.c - `time:`, `trajectory:` and `solver:` of a problem file. */
#include "definitions/problem_reader.h"

static const char *const grids[] = {"uniform", "events"}; /* ambulo_grid */

void ambulo__read_time(ambulo__problem_reader *reader, const ambulo__yaml_node *root) {
  ambulo_problem_definition *d = &reader->definition;
  if (!ambulo__yaml_require(root, "time")) return;
  const ambulo__yaml_node *time = ambulo__reader_section(root, "time");
  if (!time) return;
  const ambulo__yaml_node *duration =
      reader->gait ? ambulo__yaml_get(time, "duration") : ambulo__yaml_require(time, "duration");
  ambulo__read_member(reader, duration, &ambulo__definition_members, "time.duration", d);
  reader->has_duration = duration != NULL;
  ambulo__read_members(reader, time, &ambulo__definition_members, "time.", d);
  reader->grid = ambulo__yaml_get(time, "grid");
  ambulo__yaml_close(time);
}

static void read_breakpoints(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                             const ambulo__yaml_node *intervals) {
  ambulo_problem_definition *d = &reader->definition;
  int count = ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE) ? ambulo__yaml_items(node) : 0;
  if (count < 2) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "breakpoints are not a list; expected rising times from 0 to the "
                             "duration, s");
    return;
  }
  double *values = ambulo__reader_alloc(reader, (size_t)count, sizeof *values);
  if (!values || !ambulo__yaml_numbers(node, count, values)) return;
  if (intervals && d->spline_intervals != count - 1) {
    (void)ambulo__yaml_error(
        node, AMBULO_E_SCHEMA, NULL,
        "%d breakpoints make %d intervals; expected %d, as trajectory.intervals "
        "says",
        count, count - 1, d->spline_intervals);
  }
  double tolerance = 1e-9 * d->duration;
  if (values[0] != 0.0 || values[count - 1] < d->duration - tolerance ||
      values[count - 1] > d->duration + tolerance) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "breakpoints run from %g s to %g s; expected 0 s to %g s", values[0],
                             values[count - 1], d->duration);
  }
  for (int i = 1; i < count; i++) {
    if (values[i] > values[i - 1]) continue;
    (void)ambulo__yaml_error(ambulo__yaml_item(node, i), AMBULO_E_SCHEMA, NULL,
                             "breakpoint %g s follows %g s; expected rising times", values[i],
                             values[i - 1]);
  }
  values[count - 1] = d->duration;
  d->breakpoints = values;
  d->spline_intervals = count - 1;
}

static void read_knots(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                       const ambulo__yaml_node *breakpoints) {
  int knots = ambulo__yaml_choice(node, grids, 2, 0);
  reader->definition.knots = (ambulo_grid)(AMBULO_GRID_UNIFORM + knots);
  if (node && breakpoints)
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "knots are '%s', but breakpoints are given; expected one of the two",
                             grids[knots]);
}

/* a time grid on events wants trajectories that are the same between nodes as on them */
static void refuse_grid_for_basis(ambulo__problem_reader *reader, const char *basis) {
  if (reader->definition.grid == AMBULO_GRID_UNIFORM) return;
  (void)ambulo__yaml_error(reader->grid, AMBULO_E_SCHEMA, NULL,
                           "grid 'events' with basis %s, which has its own equal intervals; "
                           "expected it with bspline only",
                           basis);
}

static void refuse_for_basis(const ambulo__yaml_node *section, const char *key, const char *basis) {
  const ambulo__yaml_node *node = ambulo__yaml_get(section, key);
  if (!node) return;
  (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                           "'%s' means nothing with basis %s; expected it with bspline only", key,
                           basis);
}

void ambulo__read_trajectory(ambulo__problem_reader *reader, const ambulo__yaml_node *root) {
  static const char *const bases[] = {"bspline", "central_difference", "hermite"};
  ambulo_problem_definition *d = &reader->definition;
  const ambulo__yaml_node *section = ambulo__reader_section(root, "trajectory");
  if (!section) return;
  ambulo__read_members(reader, section, &ambulo__definition_members, "trajectory.", d);
  const char *basis = bases[d->discretization - AMBULO_BSPLINE];
  const ambulo__yaml_node *intervals = ambulo__yaml_get(section, "intervals");
  d->spline_intervals = ambulo__yaml_integer(intervals, 1, AMBULO__MOST_INTERVALS, 0);
  if (d->discretization == AMBULO_BSPLINE) {
    const ambulo__yaml_node *breakpoints = ambulo__yaml_get(section, "breakpoints");
    ambulo__read_member(reader, ambulo__yaml_get(section, "degree"), &ambulo__definition_members,
                        "trajectory.degree", d);
    if (breakpoints) read_breakpoints(reader, breakpoints, intervals);
    read_knots(reader, ambulo__yaml_get(section, "knots"), breakpoints);
  } else {
    refuse_for_basis(section, "degree", basis);
    refuse_for_basis(section, "breakpoints", basis);
    refuse_for_basis(section, "knots", basis);
    refuse_grid_for_basis(reader, basis);
  }
  ambulo__yaml_close(section);
}

/* ------------------------------------------------------------------------- solver */

/* Options that ambulo_problem_options() hands out and a caller may still change. */

static const double gigabyte = 1073741824.0;

/* 0 in a file: none */
static double read_limit(const ambulo__yaml_node *node) {
  double limit = ambulo__yaml_number_in(node, 0.0, 1e9, 0.0);
  return limit > 0.0 ? limit : AMBULO_OFF;
}

void ambulo__read_solver(ambulo__problem_reader *reader, const ambulo__yaml_node *section) {
  if (!section) return;
  ambulo__read_members(reader, section, &ambulo__options_members, "solver.", &reader->options);
  reader->options.time_limit = read_limit(ambulo__yaml_get(section, "time_limit"));
  reader->options.maximum_memory =
      gigabyte * read_limit(ambulo__yaml_get(section, "maximum_memory"));
  ambulo__yaml_close(section);
}
