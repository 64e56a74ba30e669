/* definitions/problem_phases.c - `gait.phases` of a problem file: when heel, sole and toes come and
 * go; and steps whose length is a function of the speed.
 *
 * A phase is a share f of the stride, or a function of the speed number u = v / sqrt(g H), H the
 * stature:
 *
 *     f(u) = comfortable + slope (u - 0.31)
 *
 * and so is the length of a step, in statures, where the file says a function of it. 0.31 is 1.28
 * m/s for 1.75 m. When the file says nothing, textbook timing of comfortable walking
 * at every speed (foot flat at 8 %, heel rise after 38 %, toe-off at 62 %; Perry, Gait Analysis,
 * 1992). With `by_speed` the stance is shorter the faster people walk, by 3.5 % of the stride for
 * 1 m/s (Kirtley, Whittle & Jefferson, J Biomed Eng 7:282-288, 1985), -0.145 for 1 of u at 1.75 m;
 * the heel's rise goes along.
 */
#include "definitions/problem_reader.h"

#include <math.h>
#include <string.h>

static const char *const names[AMBULO__PHASES] = {"heel_strike", "foot_flat", "heel_off",
                                                  "toe_off"};
static const char by_speed[] = "by_speed";
static const double people[AMBULO__PHASES] = {0.0, 0.08, 0.38, 0.62};
static const double people_slope[AMBULO__PHASES] = {0.0, 0.0, -0.145, -0.145};
static const double least[AMBULO__PHASES] = {-0.49, -0.49, -0.49, -0.49};
static const double most[AMBULO__PHASES] = {0.49, 1.0, 1.0, 1.0};

/* {comfortable, slope}, both with people's as defaults, or the word alone */
static double read_function(ambulo__problem_reader *reader, const ambulo__yaml_node *node, int i) {
  ambulo__problem_keys *keys = &reader->keys;
  double value = people[i], slope = people_slope[i];
  int is_mapping = ambulo__yaml_is(node, AMBULO__YAML_MAPPING);
  if (is_mapping && !ambulo__yaml_get(node, "comfortable") && !ambulo__yaml_get(node, "slope"))
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "a phase without a number; expected comfortable, slope, or both");
  if (is_mapping) {
    value = ambulo__yaml_number_in(ambulo__yaml_get(node, "comfortable"), least[i], most[i], value);
    slope = ambulo__yaml_number_in(ambulo__yaml_get(node, "slope"), -10.0, 10.0, slope);
    ambulo__yaml_close(node);
  }
  keys->by_speed[i] = is_mapping ? AMBULO__PHASE_FUNCTION : AMBULO__PHASE_OF_PEOPLE;
  keys->phase_slope[i] = slope;
  value += slope * (keys->speed_number - AMBULO__COMFORTABLE_NUMBER);
  if (value >= least[i] && value <= most[i]) return value;
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                           "%s is at %.4g of the stride at a speed of %.4g sqrt(g H); expected "
                           "%.4g to %.4g",
                           names[i], value, keys->speed_number, least[i], most[i]);
  return people[i];
}

static double read_phase(ambulo__problem_reader *reader, const ambulo__yaml_node *node, int i) {
  if (ambulo__yaml_is(node, AMBULO__YAML_SCALAR) &&
      strcmp(ambulo__yaml_text(node), by_speed) == 0) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, "phases: by_speed is of all four",
                             "got 'by_speed' for one phase; expected a number, or {comfortable, "
                             "slope}");
    return people[i];
  }
  if (!ambulo__yaml_is(node, AMBULO__YAML_MAPPING))
    return ambulo__yaml_number_in(node, least[i], most[i], people[i]);
  if (reader->keys.speed_unit > 0.0) return read_function(reader, node, i);
  (void)ambulo__yaml_error(
      node, AMBULO_E_PROBLEM, "give the model a stature, or the phase a number",
      "a phase by speed of a model without stature or gravity; expected a number");
  return people[i];
}

static int is_by_speed(const ambulo__yaml_node *node) {
  static const char *const words[] = {by_speed};
  if (!ambulo__yaml_is(node, AMBULO__YAML_SCALAR)) return 0;
  return ambulo__yaml_choice(node, words, 1, -1) == 0;
}

void ambulo__read_speed_number(ambulo__problem_reader *reader, double speed) {
  const double *g = reader->model->gravity;
  double stature = ambulo_model_stature(reader->model);
  double unit = sqrt(sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]) * fmax(stature, 0.0));
  if (!(unit > 0.0)) return;
  reader->keys.speed_unit = unit;
  reader->keys.speed_number = isfinite(speed) ? speed / unit : AMBULO__COMFORTABLE_NUMBER;
}

double ambulo__read_step_length(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                                double speed) {
  ambulo__problem_keys *keys = &reader->keys;
  double stature = ambulo_model_stature(reader->model);
  double constant =
      ambulo__yaml_number_in(ambulo__yaml_require(node, "comfortable"), 0.0, 5.0, 0.4);
  double slope = ambulo__yaml_number_in(ambulo__yaml_require(node, "slope"), -10.0, 10.0, 0.0);
  ambulo__yaml_close(node);
  ambulo__read_speed_number(reader, speed);
  if (!(keys->speed_unit > 0.0) || isnan(speed)) {
    (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                             "a step length by speed, but %s; expected a length",
                             isnan(speed) ? "no gait.speed" : "no stature or no gravity");
    return 1.0;
  }
  double length = constant + slope * (keys->speed_number - AMBULO__COMFORTABLE_NUMBER);
  if (!(length > 0.0)) {
    (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                             "steps of %.4g statures at a speed of %.4g sqrt(g H); expected a "
                             "length above 0",
                             length, keys->speed_number);
    return 1.0;
  }
  keys->length_function = 1;
  keys->length_constant = constant;
  keys->length_slope = slope * stature;
  return length * stature;
}

int ambulo__read_phases(ambulo__problem_reader *reader, const ambulo__yaml_node *node, double speed,
                        double value[AMBULO__PHASES]) {
  ambulo__read_speed_number(reader, speed);
  int all_by_speed = is_by_speed(node);
  int is_mapping = ambulo__yaml_is(node, AMBULO__YAML_MAPPING);
  if (all_by_speed && !(reader->keys.speed_unit > 0.0)) {
    (void)ambulo__yaml_error(
        node, AMBULO_E_PROBLEM, NULL,
        "phases by speed of a model without stature or gravity; expected four numbers");
    return 0;
  }
  if (node && !all_by_speed && !is_mapping) {
    if (!ambulo__yaml_is(node, AMBULO__YAML_SCALAR))
      (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                               "'phases' is a list; expected keys, or by_speed");
    return 0;
  }
  for (int i = 0; i < AMBULO__PHASES; i++) {
    value[i] = all_by_speed ? read_function(reader, node, i)
               : is_mapping ? read_phase(reader, ambulo__yaml_get(node, names[i]), i)
                            : people[i];
  }
  if (is_mapping) ambulo__yaml_close(node);
  return 1;
}
