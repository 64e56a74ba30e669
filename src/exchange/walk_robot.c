/* exchange/walk_robot.c - a problem in which a robot walks, by its mass and the length of its legs.
 *
 * With m g the weight and l the length of the legs, bodies of one shape walk alike if lengths are
 * counted in l, times in sqrt(l / g), torques in m g l:
 *
 *     speed      v = 0.2 sqrt(g l),  step s = 0.4 l         at l = 0.7 m: 0.52 m/s, 0.28 m
 *     objective  60 sum (tau / (m g l))^2 + 0.002 sum (qdd l / g)^2 + 20 tilt^2 + rest (q - q0)^2
 *     contact    within 0.003 l, clear by 0.03 l, moments of the ground as forces at 0.25 l
 *     loading    3.2 sqrt(g / l) body weights per second
 *
 * A speed given alone brings its step along, s ~ sqrt(v): people keep the ratio of step length and
 * cadence. Feet come down and leave flat: a rigid sole on its edge would leave the centre of
 * pressure no room. */
#include "exchange/walker.h"

#include <math.h>

enum { STEP_INTERVALS = 64, STEP_PIECES = 10 };

static void line_of(ambulo__text_buffer *text, const char *before, double value,
                    const char *after) {
  ambulo__text_append(text, before);
  ambulo__walk_number(text, value);
  ambulo__text_append(text, after);
}

static void print_head(const ambulo__walker *w, ambulo__text_buffer *text) {
  ambulo__text_append_format(text, "# A walk of %s, by 'ambulo new walk --for': ", w->file);
  ambulo__text_append(text, w->symmetric
                                ? "one step, followed by its mirror image.\n"
                                : "two steps, since left and right differ\n# ('ambulo info' says "
                                  "where).\n");
  line_of(text, "#\n# Numbers follow from the body, ", w->mass, " kg on legs of ");
  line_of(text, "", w->leg,
          " m: lengths are shares of the legs, torques of weight\n# times legs, times of the "
          "pendulum they make. Change what you like; '--set gait.speed=' and others do\n# it for "
          "one solve.\n\n");
  ambulo__text_append(text, "ambulo: 1\nkind: problem\nname: walk\n");
  ambulo__walk_model(text, w->file);
  ambulo__text_append(text, "angles: degrees\n\n");
}

static void print_gait(const ambulo__walker *w, ambulo__text_buffer *text) {
  int steps = w->symmetric ? 1 : 2;
  ambulo__text_append_format(
      text,
      "# nodes and knots stand where contacts begin and end; more intervals: finer forces\n"
      "time: {grid: events, intervals: %d}\n"
      "trajectory: {basis: bspline, degree: 4, intervals: %d, knots: events}\n\n",
      steps * STEP_INTERVALS, steps * STEP_PIECES);
  ambulo__text_append_format(text, "gait:\n  steps: %d\n  first_foot: %s\n", steps,
                             ambulo_model_foot(w->model, w->foot[0])->name);
  line_of(text, "  speed: ", w->speed, " # m/s: 0.2 sqrt(gravity times leg)\n");
  line_of(text, "  step_length: ", w->step, " # m: 0.4 of the leg\n");
  if (!w->planar) line_of(text, "  step_width: ", w->width, " # m: as the feet stand\n");
  ambulo__text_append(text,
                      "  # shares of a stride: feet come down and leave flat, both are down for "
                      "10 % twice\n"
                      "  phases: {heel_strike: 0, foot_flat: 0, heel_off: 0.6, toe_off: 0.6}\n\n");
}

static void print_rows(const ambulo__walker *w, ambulo__text_buffer *text) {
  double l = w->leg;
  line_of(text, "ground_reaction:\n  kind: shared\n  moment_arm: ", 0.25 * l, "\n");
  line_of(text, "  loading_rate: ", 3.2 * sqrt(w->gravity / l), " # body weights per second\n");
  line_of(text, "  friction: 0.5\n  free_moment: ", 0.03 * l, "\n  minimum_force: 0.2\n\n");
  line_of(text, "constraints:\n  contact_tolerance: ", 0.003 * l, "\n");
  ambulo__text_append(text, w->rocks ? "  # legs of so few joints turn their feet with them\n"
                                       "  orientation_tolerance: 0.5\n"
                                     : "  orientation_tolerance: 0.01\n");
  line_of(text, "  clearance: {height: ", 0.03 * l, ", tip_from: 0.15");
  if (w->rocks) ambulo__text_append(text, ", turn: 0.7");
  line_of(text, ", ceiling: ", 0.5 * l, "");
  line_of(text, ", outward: ", 0.09 * l, "");
  line_of(text, ", inward: ", 0.045 * l, "}\n  joint_limits: nodes\n");
  if (w->has_speed_limits) ambulo__text_append(text, "  speed_limits: true\n");
  if (w->has_torque_limits) ambulo__text_append(text, "  torque_limits: true\n");
  ambulo__text_append_format(text, "\nends: {kind: %s, order: 2}\n\n",
                             w->symmetric ? "mirrored" : "periodic");
}

/* ----------------------------------------------------------------------- objective */

static int is_hinge(const ambulo__walker *w, int c) {
  return ambulo_model_coordinate(w->model, c)->type == AMBULO_REVOLUTE;
}

/* sliders count in lengths of legs, where there are any but the root's (`all`: these too) */
void ambulo__walk_sliders(const ambulo__walker *w, double scale, int all,
                          ambulo__text_buffer *text) {
  ambulo__walk_map map = {0};
  for (int c = 0; c < w->count; c++) {
    if (is_hinge(w, c) || (!all && w->part[c] == AMBULO__PART_ROOT)) continue;
    if (!map.text) {
      double one = 1.0;
      map = ambulo__walk_map_begin(text, 4, "scale");
      ambulo__walk_map_item(&map, "default", &one, 1);
    }
    ambulo__walk_map_item(&map, ambulo_model_coordinate(w->model, c)->name, &scale, 1);
  }
  if (map.text) ambulo__walk_map_end(&map);
}

/* a posture of one part of the body at its start pose */
void ambulo__walk_posture(const ambulo__walker *w, ambulo__part_of_body part, const char *head,
                          ambulo__text_buffer *text) {
  static const double degree = 0.017453292519943295;
  ambulo__walk_map map = {0};
  for (int pass = 0; pass < 2; pass++) {
    for (int c = 0; c < w->count; c++) {
      int counts = part == AMBULO__PART_ROOT ? is_hinge(w, c) : 1;
      double unit = is_hinge(w, c) ? degree : 1.0;
      double value = pass ? w->pose[c] / unit : is_hinge(w, c) ? 1.0 : 1.0 / w->leg;
      if (w->part[c] != part || !counts || (pass && w->pose[c] == 0.0)) continue;
      if (!map.text) {
        if (!pass) ambulo__text_append(text, head);
        map = ambulo__walk_map_begin(text, 4, pass ? "angles" : "scale");
      }
      ambulo__walk_map_item(&map, ambulo_model_coordinate(w->model, c)->name, &value, 1);
    }
    if (map.text) ambulo__walk_map_end(&map);
    map.text = NULL;
  }
}

static void print_objective(const ambulo__walker *w, ambulo__text_buffer *text) {
  double torque = w->mass * w->gravity * w->leg, time_squared = w->leg / w->gravity;
  ambulo__text_append(text, "objective:\n  # small torques\n  - term: torque_squared\n");
  line_of(text, "    weight: ", 60.0 / (torque * torque), " # 60 / (weight times leg)^2\n");
  ambulo__walk_sliders(w, w->leg, 0, text);
  ambulo__walk_posture(
      w, AMBULO__PART_ROOT,
      "  # a trunk that stays as in the start pose\n  - term: posture\n    name: trunk\n"
      "    weight: 20\n",
      text);
  ambulo__walk_posture(w, AMBULO__PART_REST,
                       "  # and so does what is above: arms hang as there, and may swing a little\n"
                       "  - term: posture\n    name: arms\n    weight: 5\n",
                       text);
  ambulo__text_append(text, "  # smooth motions\n  - term: acceleration\n");
  line_of(text, "    weight: ", 0.002 * time_squared * time_squared,
          " # 0.002 (leg / gravity)^2\n");
  ambulo__walk_sliders(w, 1.0 / w->leg, 1, text);
}

void ambulo__walk_of_robot(const ambulo__walker *walker, ambulo__text_buffer *text) {
  print_head(walker, text);
  print_gait(walker, text);
  print_rows(walker, text);
  print_objective(walker, text);
}
