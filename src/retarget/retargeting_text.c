/* retarget/retargeting_text.c - a plan as a problem file with its reference (retargeting.h). */
#include "retarget/retargeting.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void line(ambulo__text_buffer *text, const char *before, double value, const char *after) {
  ambulo__text_append(text, before);
  ambulo__text_append_number(text, value);
  ambulo__text_append(text, after);
}

/* to so many digits: times and places are read by people */
static double rounded(double value, double digit) {
  double whole = nearbyint(value / digit);
  return whole == 0.0 ? 0.0 : whole / nearbyint(1.0 / digit);
}

static void print_phase(const ambulo__retargeting *plan, const ambulo__standing *stance,
                        const ambulo__phase *phase, ambulo__text_buffer *text) {
  static const char *const modes[] = {"heel", "flat", "toe"};
  const ambulo__figure *f = plan->target;
  const double *heel = f->heel[stance->side];
  double c = cos(stance->heading), s = sin(stance->heading);
  double heading = rounded(stance->heading * 180.0 / acos(-1.0), 0.01);
  double height = rounded(stance->ankle[2], 1e-4);
  ambulo__text_append_format(text, "  - {foot: %s, mode: %s",
                             f->model->feet[f->foot[stance->side]].name, modes[phase->tread]);
  line(text, ", from: ", rounded(phase->from, 1e-4), "");
  line(text, ", to: ", rounded(phase->to, 1e-4), "");
  line(text, ", place: [", rounded(stance->ankle[0] + c * heel[0] - s * heel[1], 1e-4), "");
  line(text, ", ", rounded(stance->ankle[1] + s * heel[0] + c * heel[1], 1e-4), "");
  if (height != 0.0) line(text, ", ", height, "");
  ambulo__text_append(text, "]");
  if (heading != 0.0) line(text, ", heading: ", heading, "");
  ambulo__text_append(text, "}\n");
}

/* the earliest stance behind a time and a number; -1: none */
static int next_stance(const ambulo__standings *footing, int before) {
  int next = -1;
  for (int i = 0; i < footing->count; i++) {
    double at = footing->stance[i].phase[0].from;
    double last = before < 0 ? -INFINITY : footing->stance[before].phase[0].from;
    if (at < last || (at == last && i <= before)) continue;
    if (next < 0 || at < footing->stance[next].phase[0].from) next = i;
  }
  return next;
}

static void print_contacts(const ambulo__retargeting *plan, ambulo__text_buffer *text) {
  ambulo__text_append(text, "contacts:\n");
  for (int i = next_stance(&plan->footing, -1); i >= 0; i = next_stance(&plan->footing, i)) {
    const ambulo__standing *stance = &plan->footing.stance[i];
    for (int k = 0; k < stance->phases; k++) print_phase(plan, stance, &stance->phase[k], text);
  }
}

/* 1: the reference has the coordinate */
static int is_followed(const ambulo__figure *figure, int coordinate) {
  for (int s = 0; s < AMBULO__SEGMENTS; s++)
    for (int i = 0; i < figure->map.count[s]; i++)
      if (figure->map.coordinate[s][i] == coordinate) return 1;
  for (int i = 0; i < figure->map.slides; i++)
    if (figure->map.slide[i] == coordinate) return 1;
  return 0;
}

static void print_time(const ambulo__retargeting *plan, double duration,
                       ambulo__text_buffer *text) {
  /* per second */
  static const double nodes = 100.0, knots = 24.0;
  double size = sqrt(plan->target->leg / 0.9); /* small bodies move faster */
  line(text, "time: {duration: ", duration, ", grid: events, intervals: ");
  ambulo__text_append_format(text, "%.0f}\ntrajectory: {basis: bspline, degree: 4, intervals: %.0f",
                             fmax(60.0, nearbyint(nodes * duration / size)),
                             fmax(12.0, nearbyint(knots * duration / size)));
  ambulo__text_append(text, ", knots: events}\n\n");
}

/* On an edge a sole gives way: pressure may be a little behind it, and where a foot's own edge is
 * exact a solve takes many times as long. */
static void print_pressure(const ambulo__retargeting *plan, ambulo__text_buffer *text) {
  static const double share = 0.12; /* of the foot's length */
  const ambulo__figure *f = plan->target;
  const ambulo_foot *foot = &f->model->feet[f->foot[0]];
  double edge = rounded(share * (f->toe[0][0] - f->heel[0][0]), 1e-3), width = 0.0;
  if (foot->toe[1] >= 0) {
    const double *one = f->model->points[foot->toe[0]].position,
                 *other = f->model->points[foot->toe[1]].position;
    for (int i = 0; i < 3; i++) width += (one[i] - other[i]) * (one[i] - other[i]);
  }
  ambulo__text_append(text, "\nground_reaction: {kind: shared, loading_rate: 40, friction: 0.6, "
                            "free_moment: 0.03,\n  pressure: {heel: [-0.005, ");
  ambulo__text_append_number(text, edge);
  line(text, "], roll: ", edge, ", flat: [0, 0], toe: [");
  line(text, "", -edge, ", 0.005]");
  if (width > 0.0) line(text, ", width: ", rounded(0.5 * sqrt(width), 1e-4), "");
  ambulo__text_append(text, "}}\n\n");
}

static void print_rows(const ambulo__retargeting *plan, ambulo__text_buffer *text) {
  print_pressure(plan, text);
  ambulo__text_append(text,
                      "constraints:\n"
                      "  contact_tolerance: 0.0005\n"
                      "  orientation_tolerance: 0.004\n"
                      "  clearance: {height: 0.015, tip_from: 0.2, ceiling: 1, turn: 0.9,\n"
                      "    outward: 0.5, inward: 0.5}\n"
                      "  joint_limits: nodes\n"
                      "  speed_limits: true\n"
                      "  torque_limits: true\n\n"
                      "solver: {feasibility_tolerance: 1e-5, optimality_tolerance: 0.01}\n\n");
  if (plan->repeats) {
    line(text, "ends: {kind: periodic, order: 2, travel: ", rounded(plan->travel, 1e-4), "");
    if (plan->rise != 0.0) line(text, ", rise: ", rounded(plan->rise, 1e-4), "");
    ambulo__text_append(text, "}\n\n");
  }
}

static void print_root_scale(const ambulo__retargeting *plan, double slides, double turns,
                             ambulo__text_buffer *text) {
  const ambulo__figure *f = plan->target;
  ambulo__text_append(text, "scale: {default: 1");
  for (int i = 0; i < f->map.slides; i++) {
    ambulo__text_append_format(text, ", %s: ", f->model->coordinates[f->map.slide[i]].name);
    ambulo__text_append_number(text, slides);
  }
  for (int i = 0; turns != 1.0 && i < f->map.count[AMBULO__PELVIS]; i++) {
    int c = f->map.coordinate[AMBULO__PELVIS][i];
    ambulo__text_append_format(text, ", %s: ", f->model->coordinates[c].name);
    ambulo__text_append_number(text, turns);
  }
  ambulo__text_append(text, "}");
}

static void print_rest(const ambulo__retargeting *plan, ambulo__text_buffer *text) {
  const ambulo_model *model = plan->target->model;
  int count = 0;
  for (int c = 0; c < model->coordinate_count; c++) {
    if (is_followed(plan->target, c)) continue;
    ambulo__text_append(text,
                        count++ ? ", " : "  - {term: posture, name: rest, weight: 20, scale: {");
    ambulo__text_append_format(text, "%s: 1", model->coordinates[c].name);
  }
  int first = 1;
  for (int c = 0; count && c < model->coordinate_count; c++) {
    double value = model->coordinates[c].default_value;
    if (is_followed(plan->target, c) || value == 0.0) continue;
    ambulo__text_append_format(text,
                               first ? "}, angles: {%s: " : ", %s: ", model->coordinates[c].name);
    ambulo__text_append_number(
        text, model->coordinates[c].type == AMBULO_REVOLUTE ? value * 180.0 / acos(-1.0) : value);
    first = 0;
  }
  if (count) ambulo__text_append(text, "}}\n");
}

static void print_objective(const ambulo__retargeting *plan, ambulo__text_buffer *text) {
  double mass = plan->target->model->mass;
  ambulo__text_append(text, "objective:\n  - {term: tracking, weight: 200, reference: "
                            "reference.csv, ");
  print_root_scale(plan, 0.3, 1.0, text);
  ambulo__text_append(text, "}\n");
  print_rest(plan, text);
  line(text, "  - {term: torque_squared, weight: ", rounded(0.1 / (mass * mass), 1e-8), ", ");
  print_root_scale(plan, 0.0, 0.0, text);
  ambulo__text_append(text, "}\n  - {term: force_rate, weight: 0.02}\n"
                            "  - {term: acceleration, weight: 1e-6}\n");
}

void ambulo__retargeting_problem(const ambulo__retargeting *plan, const char *motion,
                                 const char *model_file, ambulo__text_buffer *text) {
  const char *slash = strrchr(motion, '/');
  double duration = rounded(plan->time[plan->rows - 1], 1e-4);
  ambulo__text_append(text, "# ambulo retarget: the motion of ");
  ambulo__text_append(text, slash ? slash + 1 : motion);
  ambulo__text_append_format(text, "\n# onto model %s.\n", plan->target->model->name);
  line(text, "#\n# Lengths are those of the person times ", rounded(plan->ratio, 1e-4), ", times ");
  line(text, "times ", rounded(plan->time_ratio, 1e-4), ".\n");
  ambulo__text_append_format(text,
                             "# Contacts were found in the motion; times without a foot on the "
                             "ground: %d.\n",
                             plan->flights);
  ambulo__text_append(text, "\nambulo: 1\nkind: problem\nname: retarget\nmodel: ");
  ambulo__text_append_format(text, "%s\nangles: degrees\n\n", model_file);
  print_time(plan, duration, text);
  print_contacts(plan, text);
  print_rows(plan, text);
  print_objective(plan, text);
}

void ambulo__retargeting_reference(const ambulo__retargeting *plan, ambulo__text_buffer *text) {
  const ambulo_model *model = plan->target->model;
  int d = model->coordinate_count;
  ambulo__text_append(text, "# ambulo retarget: angles in radians, lengths in metres\ntime");
  for (int c = 0; c < d; c++)
    if (is_followed(plan->target, c))
      ambulo__text_append_format(text, ",%s", model->coordinates[c].name);
  for (int k = 0; k < plan->rows; k++) {
    line(text, "\n", rounded(plan->time[k], k + 1 < plan->rows ? 1e-6 : 1e-4), "");
    for (int c = 0; c < d; c++)
      if (is_followed(plan->target, c))
        line(text, ",", rounded(plan->q[(size_t)k * (size_t)d + (size_t)c], 1e-6), "");
  }
  ambulo__text_append(text, "\n");
}
