/* definitions/problem_objective.c - `objective:` of a problem file: a list of terms, or `none`. */
#include "definitions/problem_reader.h"

#include "model/neutral_pose.h"
#include "problem/term.h"

#include <math.h>
#include <string.h>

enum { MOST_TERMS = 64 };

/* what stands for coordinate i; `otherwise` after an error */
typedef double coordinate_reader(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                                 int i, double otherwise);

/* [coordinates]: of a mapping of their names; `rest` for those not named, or all without a node */
static double *read_coordinates(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                                double rest, coordinate_reader *read) {
  int count = ambulo_model_coordinate_count(reader->model);
  double *array = ambulo__reader_alloc(reader, (size_t)count, sizeof *array);
  for (int i = 0; array && i < count; i++) {
    const ambulo__yaml_node *value =
        ambulo__yaml_get(node, ambulo_model_coordinate(reader->model, i)->name);
    array[i] = value ? read(reader, value, i, rest) : rest;
  }
  ambulo__yaml_close(node);
  return array;
}

static double read_weight(ambulo__problem_reader *reader, const ambulo__yaml_node *node, int i,
                          double otherwise) {
  (void)reader, (void)i;
  if (!ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE))
    return ambulo__yaml_number_in(node, 0.0, 1e12, otherwise);
  (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA,
                           "prices by direction are those of torque_power with strength: limits",
                           "got a sequence of %d; expected a number", ambulo__yaml_items(node));
  return otherwise;
}

/* a pair of prices (read_prices) is 1 here */
static double read_priced_weight(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                                 int i, double otherwise) {
  if (ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE)) return 1.0;
  return read_weight(reader, node, i, otherwise);
}

static double read_stiffness(ambulo__problem_reader *reader, const ambulo__yaml_node *node, int i,
                             double otherwise) {
  (void)reader, (void)i;
  return ambulo__yaml_number_in(node, 1e-6, 1e12, otherwise);
}

static double read_angle(ambulo__problem_reader *reader, const ambulo__yaml_node *node, int i,
                         double otherwise) {
  (void)otherwise;
  return ambulo__read_coordinate_value(reader, node, i);
}

/* mg with the sign that the coordinate's generalized force has when it carries the body */
static double body_weight_on(const ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                             int i) {
  const ambulo_model *model = reader->model;
  double axis[3], vertical = 0.0, g = 0.0;
  ambulo__neutral_axis(model, i, axis);
  for (int k = 0; k < 3; k++) {
    vertical += axis[k] * model->up[k];
    g += model->gravity[k] * model->gravity[k];
  }
  if (!ambulo__is_root_translation(model, i) || fabs(vertical) < 0.999) {
    (void)ambulo__yaml_error(node, AMBULO_E_PROBLEM, NULL,
                             "body_weight on '%s'; expected a vertical translation of the root",
                             model->coordinates[i].name);
    return 0.0;
  }
  return (vertical > 0.0 ? 1.0 : -1.0) * model->mass * sqrt(g);
}

static double read_offset(ambulo__problem_reader *reader, const ambulo__yaml_node *node, int i,
                          double otherwise) {
  const char *text = ambulo__yaml_text(node);
  if (strcmp(text, "body_weight") == 0) /* the subject's own */
    return body_weight_on(reader, node, i) / reader->keys.heavier;
  return text[0] ? ambulo__yaml_number(node, otherwise) : otherwise;
}

/* a number for all coordinates, or a mapping with `default` for those it does not name */
static double *read_scale(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                          int may_be_pairs) {
  int is_mapping = ambulo__yaml_is(node, AMBULO__YAML_MAPPING);
  double rest =
      ambulo__yaml_number_in(is_mapping ? ambulo__yaml_get(node, "default") : node, 0.0, 1e12, 1.0);
  return read_coordinates(reader, is_mapping ? node : NULL, rest,
                          may_be_pairs ? read_priced_weight : read_weight);
}

/* values per coordinate for a mapping {coordinate: [..]}; those not named stay zero */
static double *read_curves(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                           int size) {
  if (!node) return NULL;
  int count = ambulo_model_coordinate_count(reader->model);
  double *curves = ambulo__reader_alloc(reader, (size_t)(count * size), sizeof *curves);
  for (int i = 0; curves && i < count; i++) {
    const ambulo__yaml_node *value =
        ambulo__yaml_get(node, ambulo_model_coordinate(reader->model, i)->name);
    (void)ambulo__yaml_numbers(value, size, curves + i * size);
  }
  ambulo__yaml_close(node);
  return curves;
}

/* prices in `scale: {coordinate: [negative, positive]}` of strength that is limits; NULL: none */
static double *read_prices(ambulo__problem_reader *reader, const ambulo__yaml_node *scale) {
  int count = ambulo_model_coordinate_count(reader->model), some = 0;
  if (!ambulo__yaml_is(scale, AMBULO__YAML_MAPPING)) return NULL;
  double *price = ambulo__reader_alloc(reader, 2 * (size_t)count, sizeof *price);
  for (int i = 0; price && i < count; i++) {
    const ambulo__yaml_node *pair =
        ambulo__yaml_get(scale, ambulo_model_coordinate(reader->model, i)->name);
    price[2 * i] = price[2 * i + 1] = 1.0;
    if (!ambulo__yaml_is(pair, AMBULO__YAML_SEQUENCE)) continue;
    some = 1;
    if (!ambulo__yaml_numbers(pair, 2, price + 2 * i)) continue;
    for (int up = 0; up < 2; up++) {
      if (price[2 * i + up] > 0.0 && price[2 * i + up] <= 1e12) continue;
      (void)ambulo__yaml_error(ambulo__yaml_item(pair, up), AMBULO_E_SCHEMA,
                               "a scale of 0 leaves the coordinate out",
                               "a price of %g for %s; expected one above 0, at most 1e12",
                               price[2 * i + up], ambulo_model_coordinate(reader->model, i)->name);
    }
  }
  return some ? price : NULL;
}

/* curves, or the word `limits` */
static void read_strength(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                          const ambulo__yaml_node *scale, ambulo_term *term) {
  static const char *const words[] = {"limits"};
  if (node && !ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) {
    term->strength_is_limits = ambulo__yaml_choice(node, words, 1, -1) == 0;
    term->price = read_prices(reader, scale);
  } else {
    if (ambulo__yaml_is(node, AMBULO__YAML_MAPPING) && ambulo__yaml_pairs(node) == 0)
      (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, NULL,
                               "an empty mapping; expected 'limits', or curves of coordinates");
    term->strength = read_curves(reader, node, 6);
  }
}

/* `points: [from, to]`, names of the model's points */
static void read_line(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                      ambulo_term *term) {
  for (int end = 0; end < 2; end++)
    term->point[end] =
        ambulo__read_name_of(reader, ambulo__yaml_item(node, end), AMBULO__NAMED_POINT);
}

/* of devices by name, as read_scale of coordinates */
static double *read_device_scale(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  int count = reader->definition.device_count;
  int by_name = ambulo__yaml_is(node, AMBULO__YAML_MAPPING);
  double rest =
      ambulo__yaml_number_in(by_name ? ambulo__yaml_get(node, "default") : node, 0.0, 1e12, 1.0);
  double *scale = ambulo__reader_alloc(reader, (size_t)count, sizeof *scale);
  for (int i = 0; scale && i < count; i++) {
    const char *name = reader->definition.devices[i].name;
    const ambulo__yaml_node *value = by_name && name ? ambulo__yaml_get(node, name) : NULL;
    scale[i] = ambulo__yaml_number_in(value, 0.0, 1e12, rest);
  }
  if (by_name) ambulo__yaml_close(node);
  return scale;
}

/* 0 for those not named; NULL without a node */
static double *read_given(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                          coordinate_reader *read) {
  return node ? read_coordinates(reader, node, 0.0, read) : NULL;
}

/* what the kind of a term has besides weight and scale */
static void read_members(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                         ambulo_term *term) {
  int has = ambulo__term_info_of(term->kind)->members;
  if (has & AMBULO__TERM_SMOOTHING)
    term->smoothing =
        ambulo__yaml_number_in(ambulo__yaml_get(node, "smoothing"), 1e-9, 1e9, term->smoothing);
  if (has & AMBULO__TERM_POWER)
    term->power = ambulo__yaml_number_in(ambulo__yaml_get(node, "power"), 2.0, 8.0, term->power);
  if (has & AMBULO__TERM_CURVES) {
    term->passive = read_curves(reader, ambulo__yaml_get(node, "passive"), 4);
    read_strength(reader, ambulo__yaml_get(node, "strength"), ambulo__yaml_get(node, "scale"),
                  term);
  }
  if (has & AMBULO__TERM_OFFSET)
    term->offset = read_given(reader, ambulo__yaml_get(node, "offset"), read_offset);
  if (has & AMBULO__TERM_REST)
    term->offset = read_given(reader, ambulo__yaml_get(node, "angles"), read_angle);
  if (has & AMBULO__TERM_LINE) read_line(reader, ambulo__yaml_require(node, "points"), term);
  if (has & AMBULO__TERM_TENDON)
    term->tendon = read_given(reader, ambulo__yaml_get(node, "tendon"), read_stiffness);
  if (has & AMBULO__TERM_NEGATIVE)
    term->negative =
        ambulo__yaml_number_in(ambulo__yaml_get(node, "negative"), 0.0, 1.0, term->negative);
  if (has & AMBULO__TERM_MUSCLES) {
    ambulo__read_member(reader, ambulo__yaml_get(node, "activation"), &ambulo__term_members,
                        "activation", term);
    ambulo__read_member(reader, ambulo__yaml_get(node, "metabolic"), &ambulo__term_members,
                        "metabolic", term);
    ambulo__read_member(reader, ambulo__yaml_get(node, "reserve"), &ambulo__term_members, "reserve",
                        term);
  }
  if (has & AMBULO__TERM_DEVICES)
    term->device_scale = read_device_scale(reader, ambulo__yaml_get(node, "scale"));
  if (has & AMBULO__TERM_MARKS) ambulo__read_marks(reader, node, term);
  if (has & AMBULO__TERM_LOADS) ambulo__read_foot_loads(reader, node, term);
  if (has & AMBULO__TERM_HEIGHT)
    term->height = ambulo__yaml_number_in(ambulo__yaml_get(node, "height"), 1e-6, 10.0, 0.02);
}

/* NOT_SET: there is none, which was said */
static ambulo_term_kind read_kind(const ambulo__yaml_node *node) {
  enum { MOST_KINDS = 64 };
  const char *words[MOST_KINDS];
  ambulo_term_kind kinds[MOST_KINDS];
  const ambulo__term_info *info;
  int count = 0;
  for (int k = 1; (info = ambulo__term_info_of((ambulo_term_kind)k)) && count < MOST_KINDS; k++) {
    if (info->members & AMBULO__TERM_CALLBACK) continue; /* of programs alone */
    kinds[count] = (ambulo_term_kind)k;
    words[count++] = info->name;
  }
  int choice = ambulo__yaml_choice(node, words, count, -1);
  return choice < 0 ? AMBULO_TERM_KIND_NOT_SET : kinds[choice];
}

static void read_term(ambulo__problem_reader *reader, const ambulo__yaml_node *node,
                      ambulo_term *term) {
  ambulo_term_kind kind = read_kind(ambulo__yaml_require(node, "term"));
  *term = ambulo_term_default(kind ? kind : AMBULO_TORQUE_SQUARED);
  if (!kind) return; /* which keys it has is not known either */
  const ambulo__yaml_node *name = ambulo__yaml_get(node, "name");
  if (name) term->name = ambulo__yaml_name(name);
  term->weight = ambulo__yaml_number_in(ambulo__yaml_get(node, "weight"), 0.0, 1e12, 1.0);
  double *scale = NULL;
  int priced = ambulo__term_has(term, AMBULO__TERM_CURVES) &&
               ambulo__yaml_is(ambulo__yaml_get(node, "strength"), AMBULO__YAML_SCALAR);
  if (ambulo__term_has(term, AMBULO__TERM_SCALE))
    scale = read_scale(reader, ambulo__yaml_get(node, "scale"), priced);
  if (ambulo__term_has(term, AMBULO__TERM_REST))
    scale = read_coordinates(reader, ambulo__yaml_require(node, "scale"), 0.0, read_weight);
  term->scale = scale;
  read_members(reader, node, term);
  if (ambulo__term_has(term, AMBULO__TERM_REFERENCE) && scale) {
    const ambulo__yaml_node *reference = ambulo__yaml_require(node, "reference");
    if (reference) term->reference = ambulo__read_tracked_motion(reader, reference, scale);
  }
  ambulo__yaml_close(node);
}

static int is_none(const ambulo__yaml_node *node) {
  static const char *const words[] = {"none"};
  if (!ambulo__yaml_is(node, AMBULO__YAML_SCALAR)) return 0;
  (void)ambulo__yaml_choice(node, words, 1, 0);
  return 1;
}

void ambulo__read_objective(ambulo__problem_reader *reader, const ambulo__yaml_node *node) {
  if (!node || is_none(node)) return;
  int count = ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE) ? ambulo__yaml_items(node) : 0;
  if (count < 1 || count > MOST_TERMS) {
    (void)ambulo__yaml_error(
        node, AMBULO_E_SCHEMA, NULL,
        "'objective' is not a list of 1 to %d terms; expected terms, or 'none'", MOST_TERMS);
    return;
  }
  ambulo_term *terms = ambulo__reader_alloc(reader, (size_t)count, sizeof *terms);
  if (!terms) return;
  for (int t = 0; t < count; t++) {
    const ambulo__yaml_node *item = ambulo__yaml_item(node, t);
    if (ambulo__yaml_is(item, AMBULO__YAML_MAPPING)) {
      read_term(reader, item, &terms[t]);
    } else {
      (void)ambulo__yaml_error(item, AMBULO_E_SCHEMA, NULL,
                               "a term is not a mapping; expected term, weight, ...");
    }
  }
  reader->definition.terms = terms;
  reader->definition.term_count = count;
}
