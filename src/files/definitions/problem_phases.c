/* definitions/problem_phases.c - `gait.phases` of a problem file: when heel, sole and toes come and
 * go; and steps whose length is a function of the speed.
 *
 * What becomes of them is contact/gait_rule.h's. When the file says nothing, textbook timing of
 * comfortable walking at every speed (foot flat at 8 %, heel rise after 38 %, toe-off at 62 %;
 * Perry, Gait Analysis, 1992). With `by_speed` the stance is shorter the faster people walk, by 3.5
 * % of the stride for 1 m/s (Kirtley, Whittle & Jefferson, J Biomed Eng 7:282-288, 1985), -0.145
 * for 1 of u at 1.75 m; the heel's rise goes along.
 */
#include "definitions/problem_reader.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const names[AMBULO__PHASES] = {"heel_strike", "foot_flat", "heel_off",
                                                  "toe_off"};
static const char by_speed[] = "by_speed";
static const double people[AMBULO__PHASES] = {0.0, 0.08, 0.38, 0.62};
static const double people_slope[AMBULO__PHASES] = {0.0, 0.0, -0.145, -0.145};
static const double least[AMBULO__PHASES] = {-0.49, -0.49, -0.49, -0.49};
static const double most[AMBULO__PHASES] = {0.49, 1.0, 1.0, 1.0};

/* {comfortable, slope}, both with people's as defaults, or the word alone */
static void read_function(ambulo__gait_rule *rule, const ambulo__yaml_node *node, int i) {
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
  rule->phase_kind[i] = is_mapping ? AMBULO__PHASE_FUNCTION : AMBULO__PHASE_OF_PEOPLE;
  rule->phase[i] = value;
  rule->phase_slope[i] = slope;
}

static void read_phase(ambulo__problem_reader *reader, const ambulo__yaml_node *node, int i) {
  ambulo__gait_rule *rule = &reader->keys.rule;
  if (ambulo__yaml_is(node, AMBULO__YAML_SCALAR) &&
      strcmp(ambulo__yaml_text(node), by_speed) == 0) {
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, "phases: by_speed is of all four",
                             "got 'by_speed' for one phase; expected a number, or {comfortable, "
                             "slope}");
  } else if (!ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) {
    rule->phase[i] = ambulo__yaml_number_in(node, least[i], most[i], people[i]);
  } else if (ambulo__speed_unit(reader->model) > 0.0) {
    read_function(rule, node, i);
  } else {
    (void)ambulo__yaml_error(
        node, AMBULO_E_PROBLEM, "give the model a stature, or the phase a number",
        "a phase by speed of a model without stature or gravity; expected a number");
  }
}

static int is_by_speed(const ambulo__yaml_node *node) {
  static const char *const words[] = {by_speed};
  if (!ambulo__yaml_is(node, AMBULO__YAML_SCALAR)) return 0;
  return ambulo__yaml_choice(node, words, 1, -1) == 0;
}

void ambulo__read_step_length(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  ambulo__gait_rule *rule = &reader->keys.rule;
  rule->length_kind = AMBULO__LENGTH_FUNCTION;
  rule->length_comfortable =
      ambulo__yaml_number_in(ambulo__yaml_require(node, "comfortable"), 0.0, 5.0, 0.4);
  rule->length_slope =
      ambulo__yaml_number_in(ambulo__yaml_require(node, "slope"), -10.0, 10.0, 0.0);
  ambulo__yaml_close(node);
  if (!(ambulo__speed_unit(reader->model) > 0.0) || isnan(rule->speed)) {
    (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                             "a step length by speed, but %s; expected a length",
                             isnan(rule->speed) ? "no gait.speed" : "no stature or no gravity");
    return;
  }
  double number = ambulo__speed_number(reader->model, rule->speed);
  double length =
      rule->length_comfortable + rule->length_slope * (number - AMBULO__COMFORTABLE_NUMBER);
  if (length > 0.0) return;
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                           "steps of %.4g statures at a speed of %.4g sqrt(g H); expected a "
                           "length above 0",
                           length, number);
}

void ambulo__read_phases(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  ambulo__gait_rule *rule = &reader->keys.rule;
  int all_by_speed = is_by_speed(node);
  int is_mapping = ambulo__yaml_is(node, AMBULO__YAML_MAPPING);
  for (int i = 0; i < AMBULO__PHASES; i++) rule->phase[i] = people[i];
  if (all_by_speed && !(ambulo__speed_unit(reader->model) > 0.0)) {
    (void)ambulo__yaml_error(
        node, AMBULO_E_PROBLEM, NULL,
        "phases by speed of a model without stature or gravity; expected four numbers");
    return;
  }
  if (node && !all_by_speed && !is_mapping && !ambulo__yaml_is(node, AMBULO__YAML_SCALAR))
    (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                             "'phases' is a list; expected keys, or by_speed");
  for (int i = 0; i < AMBULO__PHASES; i++) {
    if (all_by_speed)
      read_function(rule, node, i);
    else if (is_mapping)
      read_phase(reader, ambulo__yaml_get(node, names[i]), i);
  }
  if (is_mapping) ambulo__yaml_close(node);
}

static int are_in_order(const double phase[AMBULO__PHASES]) {
  return phase[0] <= phase[1] && phase[1] <= phase[2] && phase[2] <= phase[3] &&
         phase[3] < phase[0] + 1.0;
}

void ambulo__check_phases(const ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                          const ambulo_gait *gait) {
  const double phase[AMBULO__PHASES] = {gait->heel_strike, gait->foot_flat, gait->heel_off,
                                        gait->toe_off};
  double number = ambulo__speed_number(reader->model, ambulo__gait_speed(gait));
  int moves = 0, outside = 0;
  if (!node) return;
  for (int i = 0; i < AMBULO__PHASES; i++) {
    if (reader->keys.rule.phase_kind[i] == AMBULO__PHASE_SHARE) continue;
    moves = 1;
    if (phase[i] >= least[i] && phase[i] <= most[i]) continue;
    const ambulo__yaml_node *own =
        ambulo__yaml_is(node, AMBULO__YAML_MAPPING) ? ambulo__yaml_get(node, names[i]) : node;
    outside = 1;
    (void)ambulo__yaml_error(own, AMBULO_E_PROBLEM, NULL,
                             "%s is at %.4g of the stride at a speed of %.4g sqrt(g H); expected "
                             "%.4g to %.4g",
                             names[i], phase[i], number, least[i], most[i]);
  }
  if (outside || are_in_order(phase)) return;
  char hint[80];
  (void)snprintf(hint, sizeof hint, "phases go with the speed, here %.4g sqrt(g H)", number);
  (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, moves ? hint : NULL,
                           "phases %.6g, %.6g, %.6g, %.6g of a stride; expected heel_strike <= "
                           "foot_flat <= heel_off <= toe_off < heel_strike + 1",
                           phase[0], phase[1], phase[2], phase[3]);
}
