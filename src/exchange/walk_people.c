/* exchange/walk_people.c - a problem in which a person's model walks, by the weights that are
 * fitted to people in a shipped problem.
 *
 * The shipped problem is loaded for a person of this mass and of the stature that these legs have
 * (H = l / 0.5346, as in its body), so that its numbers are already scaled. Its terms are then
 * written for the coordinates that both bodies have under one name. OpenSim's models agree on names
 * and signs but for the knee, which some of them bend to negative angles: there a torque that bends
 * it is negative, too, so strengths and prices of both directions and angles of rest change places
 * and sign. Coordinates that the shipped body lacks have a weak rest at their start pose. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "ambulo/tools/load.h"
#include "base/numtext.h"
#include "exchange/walker.h"
#include "problem/nlp.h"
#include "problem/term.h"

enum { PATH = 4096 };

typedef struct fitted {
  const ambulo__walker *walker;
  const ambulo_problem_definition *from;
  ambulo__text_buffer *text;
} fitted;

static int find(const ambulo__walker *w, const char *name) {
  return ambulo_model_find_coordinate(w->model, name);
}

int ambulo__walker_is_person(const ambulo__walker *w) {
  static const char *const names[] = {"pelvis_tilt",  "hip_flexion_r", "hip_flexion_l",
                                      "knee_angle_r", "knee_angle_l",  "ankle_angle_r",
                                      "ankle_angle_l"};
  for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
    if (find(w, names[i]) < 0) return 0;
  return 1;
}

/* -1: the knee bends to negative angles; a bent knee takes the foot back */
static double sign_of(const ambulo__walker *w, int coordinate) {
  const char *name = ambulo_model_coordinate(w->model, coordinate)->name;
  if (strncmp(name, "knee_angle_", 11) != 0) return 1.0;
  int side = name[11] == 'l' ? 0 : 1;
  const double *forward = ambulo_model_forward(w->model);
  return ambulo__walker_slope(w, w->foot[side], forward, coordinate) > 0.0 ? -1.0 : 1.0;
}

/* ---------------------------------------------------------------------- mappings */

typedef enum column { SCALE, STRENGTH, TENDON, ANGLE } column;

/* the values of a term at coordinate i of the shipped body, as a file has them; their number, 0
 * where the term says nothing of it */
static int values_of(const ambulo_term *term, column what, int i, double sign, double values[6]) {
  static const double degree = 0.017453292519943295;
  double scale = term->scale ? term->scale[i] : 1.0;
  if (what == SCALE || scale == 0.0) {
    values[0] = scale;
    return scale != 0.0;
  }
  if (what == STRENGTH && term->strength) {
    const double *of = &term->strength[6 * i];
    for (int k = 0; k < 3; k++) values[k] = of[sign < 0.0 ? 3 + k : k];
    for (int k = 0; k < 3; k++) values[3 + k] = of[sign < 0.0 ? k : 3 + k];
    return of[0] != 0.0 ? 6 : 0;
  }
  if (what == TENDON && term->tendon) values[0] = term->tendon[i];
  if (what == ANGLE && term->offset) values[0] = sign * term->offset[i] / degree;
  return (what == TENDON && term->tendon && values[0] != 0.0) ||
         (what == ANGLE && term->offset && values[0] != 0.0);
}

/* one mapping of a term, of all coordinates that both bodies have; whether there are any */
static int print_values(const fitted *f, const ambulo_term *term, column what, int print) {
  static const char *const keys[] = {"scale", "strength", "tendon", "angles"};
  static const double none = 0.0, one = 1.0;
  int open = what == SCALE && term->kind == AMBULO_ACCELERATION, found = open;
  ambulo__walk_map map = {0};
  for (int c = 0; c < f->walker->count; c++) {
    const char *name = ambulo_model_coordinate(f->walker->model, c)->name;
    int i = ambulo_model_find_coordinate(f->from->model, name);
    double values[6] = {0};
    int count = i < 0 ? 0 : values_of(term, what, i, sign_of(f->walker, c), values);
    if (count == 0 || (open && values[0] == 1.0)) continue;
    found = 1;
    if (!print) continue;
    if (!map.text) {
      map = ambulo__walk_map_begin(f->text, 4, keys[what]);
      if (what == SCALE && term->kind != AMBULO_POSTURE)
        ambulo__walk_map_item(&map, "default", open ? &one : &none, 1);
    }
    ambulo__walk_map_item(&map, name, values, count);
  }
  if (map.text) ambulo__walk_map_end(&map);
  return found;
}

static void print_key(const fitted *f, int indent, const char *key, double value) {
  ambulo__text_append_format(f->text, "%*s%s: ", indent, "", key);
  ambulo__walk_number(f->text, value);
  ambulo__text_append(f->text, "\n");
}

static void print_upright(const fitted *f, const ambulo_term *term) {
  const char *names[2];
  for (int k = 0; k < 2; k++) {
    names[k] = ambulo_model_point(f->from->model, term->point[k])->name;
    if (ambulo_model_find_point(f->walker->model, names[k]) < 0) return;
  }
  ambulo__text_append(f->text, "  - term: upright\n");
  print_key(f, 4, "weight", term->weight);
  ambulo__text_append_format(f->text, "    points: [%s, %s]\n", names[0], names[1]);
}

static void print_term(const fitted *f, const ambulo_term *term) {
  const ambulo__term_info *info = ambulo__term_info_of(term->kind);
  if (term->kind == AMBULO_UPRIGHT) {
    print_upright(f, term);
    return;
  }
  int by_coordinate = info->members & (AMBULO__TERM_SCALE | AMBULO__TERM_REST);
  if (by_coordinate && !print_values(f, term, SCALE, 0)) return;
  ambulo__text_append_format(f->text, "  - term: %s\n", info->name);
  if (term->name && strcmp(term->name, info->name) != 0)
    ambulo__text_append_format(f->text, "    name: %s\n", term->name);
  if (term->weight != 1.0) print_key(f, 4, "weight", term->weight);
  if (info->members & AMBULO__TERM_POWER) print_key(f, 4, "power", term->power);
  if (info->members & AMBULO__TERM_SMOOTHING) print_key(f, 4, "smoothing", term->smoothing);
  if (!by_coordinate) return;
  print_values(f, term, SCALE, 1);
  print_values(f, term, STRENGTH, 1);
  print_values(f, term, TENDON, 1);
  print_values(f, term, ANGLE, 1);
}

/* ------------------------------------------------------------------------- parts */

static void print_head(const fitted *f, double stature) {
  const ambulo__walker *w = f->walker;
  ambulo__text_append_format(f->text, "# A walk of %s, by 'ambulo new walk --for': ", w->file);
  ambulo__text_append(f->text,
                      w->symmetric ? "one step, followed by its mirror image.\n" : "two steps.\n");
  ambulo__text_append(f->text, "#\n# Weights are those of the shipped walk.yaml, fitted to people "
                               "and scaled to this body, ");
  ambulo__walk_number(f->text, w->mass);
  ambulo__text_append(f->text, " kg on\n# legs of ");
  ambulo__walk_number(f->text, w->leg);
  ambulo__text_append(f->text, " m, as a person of ");
  ambulo__walk_number(f->text, stature);
  ambulo__text_append(f->text, " m has. Strengths are a person's peak torques (N m: positive,\n"
                               "# then negative) over the fitted price. Coordinates that the "
                               "shipped body lacks rest in the\n# start pose.\n\n");
  ambulo__text_append(f->text, "ambulo: 1\nkind: problem\nname: walk\n");
  ambulo__walk_model(f->text, w->file);
  ambulo__text_append(f->text, "angles: degrees\n\n");
}

static void print_gait(const fitted *f, double width) {
  const ambulo__walker *w = f->walker;
  int steps = w->symmetric ? 1 : 2;
  ambulo__text_append_format(
      f->text,
      "time: {grid: events, intervals: %d}\n"
      "trajectory: {basis: bspline, degree: 4, intervals: %d, knots: events}\n\n"
      "gait:\n  steps: %d\n  first_foot: %s\n",
      112 * steps, 14 * steps, steps, ambulo_model_foot(w->model, w->foot[0])->name);
  ambulo__text_append(f->text, "  speed: ");
  ambulo__walk_number(f->text, w->speed);
  ambulo__text_append(f->text, "\n  step_length: ");
  ambulo__walk_number(f->text, w->step);
  if (!w->planar) ambulo__text_append(f->text, "\n  step_width: ");
  if (!w->planar) ambulo__walk_number(f->text, width);
  ambulo__text_append(f->text, "\n  # shares of a stride, for feet that roll on edges\n  phases: "
                               "{heel_strike: 0, foot_flat: 0.096, heel_off: 0.385, toe_off: "
                               "0.609}\n\n");
}

/* soles of people give: an edge presses over some width */
static void print_pressure(const fitted *f, double size) {
  static const double heel[2] = {-0.01, 0.01}, flat[2] = {0.0, 0.02}, toe[2] = {-0.02, 0.02};
  static const struct {
    const char *name;
    const double *values;
  } boxes[] = {{"heel", heel}, {"flat", flat}, {"toe", toe}};
  const double width = 0.04 * size;
  ambulo__text_append(f->text, "  # a sole gives: its edges press over a width\n");
  ambulo__walk_map map = ambulo__walk_map_begin(f->text, 2, "pressure");
  for (int i = 0; i < 3; i++) {
    const double scaled[2] = {size * boxes[i].values[0], size * boxes[i].values[1]};
    ambulo__walk_map_item(&map, boxes[i].name, scaled, 2);
  }
  ambulo__walk_map_item(&map, "width", &width, 1);
  ambulo__walk_map_end(&map);
}

static void print_rows(const fitted *f, double stature) {
  double size = stature / 1.75;
  const ambulo_ground_reaction *ground = &f->from->ground_reaction;
  const ambulo_clearance *clearance = &f->from->clearance;
  static const double degree = 0.017453292519943295;
  ambulo__text_append(f->text, "ground_reaction:\n  kind: shared\n");
  print_key(f, 2, "moment_arm", ground->moment_arm);
  print_key(f, 2, "slant", ground->slant);
  print_key(f, 2, "loading_rate", ground->loading_rate);
  print_key(f, 2, "friction", ground->friction);
  print_key(f, 2, "free_moment", ground->free_moment);
  print_key(f, 2, "minimum_force", f->from->minimum_force);
  print_key(f, 2, "heel_pad", ground->heel_pad);
  print_pressure(f, size);
  ambulo__text_append(f->text, "\nconstraints:\n");
  print_key(f, 2, "contact_tolerance", 0.001 * size);
  print_key(f, 2, "orientation_tolerance", f->from->orientation_tolerance);
  ambulo__text_append(f->text, "  strike_pitch: [");
  ambulo__walk_number(f->text, f->from->strike_pitch[0] / degree);
  ambulo__text_append(f->text, ", ");
  ambulo__walk_number(f->text, f->from->strike_pitch[1] / degree);
  ambulo__text_append(f->text, "]\n  clearance: {height: ");
  ambulo__walk_number(f->text, clearance->height);
  ambulo__text_append(f->text, ", tip_from: 0.15}\n  joint_limits: nodes\n");
  ambulo__text_append_format(f->text, "\nends: {kind: %s, order: 2}\n\n",
                             f->walker->symmetric ? "mirrored" : "periodic");
}

/* what the shipped body lacks, at rest in the start pose */
static void print_rest(const fitted *f) {
  static const double degree = 0.017453292519943295, one = 1.0;
  const ambulo__walker *w = f->walker;
  for (int pass = 0; pass < 2; pass++) {
    ambulo__walk_map map = {0};
    for (int c = 0; c < w->count; c++) {
      const ambulo_coordinate *coordinate = ambulo_model_coordinate(w->model, c);
      double unit = coordinate->type == AMBULO_REVOLUTE ? degree : 1.0;
      double angle = w->pose[c] / unit;
      if (w->part[c] == AMBULO__PART_ROOT || (pass && angle == 0.0) ||
          ambulo_model_find_coordinate(f->from->model, coordinate->name) >= 0)
        continue;
      if (!map.text && !pass)
        ambulo__text_append(f->text, "  - term: posture\n    name: rest\n    weight: 0.5\n");
      if (!map.text) map = ambulo__walk_map_begin(f->text, 4, pass ? "angles" : "scale");
      ambulo__walk_map_item(&map, coordinate->name, pass ? &angle : &one, 1);
    }
    if (map.text) ambulo__walk_map_end(&map);
  }
}

ambulo_status ambulo__walk_of_person(const ambulo__walker *walker, const char *shipped,
                                     ambulo_diagnostics *diagnostics, ambulo__text_buffer *text) {
  char path[PATH], set[3][80];
  double stature = walker->leg / 0.534643;
  int arms = find(walker, "arm_flex_r") >= 0 && find(walker, "arm_flex_l") >= 0;
  const char *const overrides[] = {set[0], set[1], set[2]};
  ambulo_problem *problem = NULL;
  if (snprintf(path, sizeof path, "%s/walk%s.yaml", shipped, arms ? "_whole_body" : "") >= PATH)
    return AMBULO_E_ARGUMENT;
  (void)snprintf(set[0], sizeof set[0], "subject.mass=%s", ambulo__number_text(walker->mass).text);
  (void)snprintf(set[1], sizeof set[1], "subject.stature=%s", ambulo__number_text(stature).text);
  (void)snprintf(set[2], sizeof set[2], "gait.speed=%s", ambulo__number_text(walker->speed).text);
  ambulo_status status =
      ambulo_problem_load(path, overrides, 3, &walker->allocator, diagnostics, &problem);
  if (status) return status;
  const fitted f = {walker, &problem->definition, text};
  print_head(&f, stature);
  print_gait(&f, 0.12 * stature / 1.75);
  print_rows(&f, stature);
  ambulo__text_append(text, "objective:\n");
  for (int t = 0; t < f.from->term_count; t++) print_term(&f, &f.from->terms[t]);
  print_rest(&f);
  ambulo_problem_free(problem);
  return AMBULO_OK;
}
