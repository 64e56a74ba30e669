/* definitions/model_numbers.c - numbers of a model file: by sex, in the file's units; references;
 * subject and units.
 */
#include "ambulo/tools/load.h"
#include "definitions/model_reader.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int is_none(const ambulo__yaml_node *node) {
  return ambulo__yaml_is(node, AMBULO__YAML_SCALAR) && strcmp(ambulo__yaml_text(node), "none") == 0;
}

/* The value for the other sex is read by nobody, and must be of the same shape all the same: a
 * fault in it would show only for another subject. */
static void check_other(const ambulo__yaml_node *chosen, const ambulo__yaml_node *other) {
  if (ambulo__yaml_is(other, AMBULO__YAML_MAPPING)) { /* by sex once more, as an item may be */
    check_other(chosen, ambulo__yaml_require(other, "female"));
    check_other(chosen, ambulo__yaml_require(other, "male"));
    ambulo__yaml_close(other);
    return;
  }
  if (!ambulo__yaml_is(chosen, AMBULO__YAML_SEQUENCE)) {
    if (!is_none(other)) (void)ambulo__yaml_number(other, 0.0);
    return;
  }
  int count = ambulo__yaml_items(chosen), others = ambulo__yaml_items(other);
  if (ambulo__yaml_is(other, AMBULO__YAML_SEQUENCE) && others != count)
    (void)ambulo__yaml_error(other, AMBULO_E_SCHEMA, NULL,
                             "got a sequence of %d; expected %d, as for the other sex", others,
                             count);
  for (int i = 0; i < count; i++)
    check_other(ambulo__yaml_item(chosen, i), ambulo__yaml_item(other, i));
}

const ambulo__yaml_node *ambulo__by_sex(ambulo__reader *reader, const ambulo__yaml_node *node) {
  if (!ambulo__yaml_is(node, AMBULO__YAML_MAPPING)) return node;
  const ambulo__yaml_node *female = ambulo__yaml_require(node, "female");
  const ambulo__yaml_node *male = ambulo__yaml_require(node, "male");
  ambulo__yaml_close(node);
  if (reader->subject.sex == AMBULO_SEX_NOT_SET) {
    ambulo__yaml_error(node, AMBULO_E_SCHEMA, "add it to `subject`",
                       "a value differs by sex, but the subject has none; expected subject.sex");
    return NULL;
  }
  int is_female = reader->subject.sex == AMBULO_FEMALE;
  check_other(is_female ? female : male, is_female ? male : female);
  return is_female ? female : male;
}

double ambulo__read_scaled(ambulo__reader *reader, const ambulo__yaml_node *node, double factor,
                           double fallback) {
  double value = ambulo__yaml_number(ambulo__by_sex(reader, node), NAN);
  return isnan(value) ? fallback : value * factor;
}

static int is_sequence_of(const ambulo__yaml_node *node, int count) {
  if (ambulo__yaml_is(node, AMBULO__YAML_SEQUENCE) && ambulo__yaml_items(node) == count) {
    return 1;
  }
  double unused[8];
  (void)ambulo__yaml_numbers(node, count, unused); /* says what is wrong */
  return 0;
}

int ambulo__read_vector(ambulo__reader *reader, const ambulo__yaml_node *node, int count,
                        double factor, double *values) {
  enum { MOST = 8 };
  double read[MOST];
  int good = 1;
  const ambulo__yaml_node *list = ambulo__by_sex(reader, node);
  if (!list || count > MOST || !is_sequence_of(list, count)) return 0;
  for (int i = 0; i < count; i++) {
    read[i] = ambulo__read_scaled(reader, ambulo__yaml_item(list, i), factor, NAN);
    good &= !isnan(read[i]);
  }
  if (good) memcpy(values, read, (size_t)count * sizeof *values);
  return good;
}

/* 6.2832 is a full turn; anatomical angles beyond it are degrees */
static void warn_of_degrees(ambulo__reader *reader, const ambulo__yaml_node *node, double value,
                            double unit) {
  if (unit != 1 || reader->warned_of_degrees || fabs(value) <= 6.2832) return;
  reader->warned_of_degrees = 1;
  ambulo__yaml_warning(node, "degrees are declared by `units: {angle: degrees}`",
                       "an angle of more than a full turn (got %s radians)",
                       ambulo__number_text(value).text);
}

double ambulo__read_angle(ambulo__reader *reader, const ambulo__yaml_node *node, double unit) {
  double value = ambulo__read_scaled(reader, node, 1, 0);
  warn_of_degrees(reader, node, value, unit);
  return value * unit;
}

void ambulo__read_interval(ambulo__reader *reader, const ambulo__yaml_node *node, double factor,
                           int is_angle, double interval[2]) {
  const ambulo__yaml_node *list = ambulo__by_sex(reader, node);
  if (!list || !is_sequence_of(list, 2)) return;
  for (int i = 0; i < 2; i++) {
    const ambulo__yaml_node *item = ambulo__by_sex(reader, ambulo__yaml_item(list, i));
    if (is_none(item)) {
      interval[i] = i == 0 ? -INFINITY : INFINITY;
      continue;
    }
    double value = ambulo__yaml_number(item, 0);
    if (is_angle) warn_of_degrees(reader, node, value, factor);
    interval[i] = value * factor;
  }
}

int ambulo__read_reference(const ambulo__reader *reader, const ambulo__yaml_node *node,
                           ambulo__model_list list) {
  static const char *const kinds[] = {"link", "coordinate", "point", "foot", "patch", "capsule"};
  const ambulo_model_definition *d = &reader->definition;
  const int counts[] = {d->link_count, d->coordinate_count, d->point_count,
                        d->foot_count, d->patch_count,      d->capsule_count};
  const char *const *names = reader->names[list];
  const char *name = ambulo__yaml_text(node);
  if (!name[0]) return -1;
  for (int i = 0; i < counts[list]; i++) {
    if (strcmp(names[i], name) == 0) return i;
  }
  char hint[128];
  const char *nearest = ambulo__nearest(name, names, (size_t)counts[list]);
  if (nearest) (void)snprintf(hint, sizeof hint, "did you mean '%.80s'?", nearest);
  (void)ambulo__yaml_error(node, AMBULO_E_MODEL, nearest ? hint : NULL,
                           "unknown %s (got '%.80s'); expected the name of a %s of this model",
                           kinds[list], name, kinds[list]);
  return -1;
}

const char *ambulo__read_item_name(ambulo__reader *reader, const ambulo__yaml_node *item,
                                   ambulo__model_list list, int index) {
  const char *name = ambulo__yaml_name(ambulo__yaml_require(item, "name"));
  reader->names[list][index] = name;
  reader->place_of[list][index] = ambulo__yaml_place(item);
  return name;
}

int ambulo__read_count(const ambulo__yaml_node *list, const char *what, int limit, int *count) {
  *count = 0;
  if (!list) return 1;
  if (!ambulo__yaml_is(list, AMBULO__YAML_SEQUENCE)) {
    (void)ambulo__yaml_error(list, AMBULO_E_SCHEMA, NULL, "`%s` is not a list; expected a list",
                             what);
    return 0;
  }
  int items = ambulo__yaml_items(list);
  if (items > limit) {
    (void)ambulo__yaml_error(list, AMBULO_E_LIMIT, NULL,
                             "too many %s (got %d); expected at most %d", what, items, limit);
    return 0;
  }
  *count = items;
  return 1;
}

/* --------------------------------------------------------------- subject and units */

/* Who the model is scaled to, and how.
 *
 *   angle    degrees or radians; dh_angle: the same for the DH constants alone
 *   length   metres, or fractions of the stature H
 *   mass     kilograms, or fractions of the body mass M
 *   torque   N m, or fractions of M g H; forces of prismatic joints: N, or fractions of M g
 * Inertias are in the unit of mass times the unit of length squared.
 */

static const double LEAST_MASS = 0.5, LARGEST_MASS = 1000;    /* kg */
static const double LEAST_STATURE = 0.2, LARGEST_STATURE = 3; /* m */

ambulo_subject ambulo__subject_of(const ambulo__yaml_node *section) {
  static const char *const sexes[] = {"female", "male"};
  ambulo_subject s = ambulo_subject_default();
  s.mass = ambulo__yaml_number_in(ambulo__yaml_get(section, "mass"), LEAST_MASS, LARGEST_MASS,
                                  AMBULO_OFF);
  s.stature = ambulo__yaml_number_in(ambulo__yaml_get(section, "stature"), LEAST_STATURE,
                                     LARGEST_STATURE, AMBULO_OFF);
  int sex = ambulo__yaml_choice(ambulo__yaml_get(section, "sex"), sexes, 2, -1);
  if (sex >= 0) s.sex = sex == 0 ? AMBULO_FEMALE : AMBULO_MALE;
  ambulo__yaml_close(section);
  return s;
}

void ambulo__read_subject(ambulo__reader *reader, const ambulo__yaml_node *root) {
  const ambulo_subject own = ambulo__subject_of(ambulo__yaml_get(root, "subject"));
  ambulo_subject *s = &reader->subject;
  if (isnan(s->mass)) s->mass = own.mass;
  if (isnan(s->stature)) s->stature = own.stature;
  if (s->sex == AMBULO_SEX_NOT_SET) s->sex = own.sex;
  reader->definition.stature = s->stature;
}

static void need(const ambulo__yaml_node *node, double value, const char *what) {
  if (value > 0) return;
  (void)ambulo__yaml_error(node, AMBULO_E_SCHEMA, "give it under `subject`",
                           "the unit needs the %s of the subject; expected subject.%s", what, what);
}

/* The subject asked for by the caller changes nothing when the file is in absolute units. */
static void warn_of_unused(const ambulo__yaml_node *units, int uses_stature, int uses_mass,
                           const ambulo_subject *asked) {
  if (asked->stature > 0 && !uses_stature) {
    ambulo__yaml_warning(units, "lengths scale with `units: {length: stature}`",
                         "the lengths of this model do not depend on the stature of the subject");
  }
  if (asked->mass > 0 && !uses_mass) {
    ambulo__yaml_warning(units, "masses scale with `units: {mass: body_mass}`",
                         "the masses of this model do not depend on the mass of the subject");
  }
}

void ambulo__read_units(ambulo__reader *reader, const ambulo__yaml_node *root,
                        const ambulo_subject *asked) {
  static const char *const angles[] = {"radians", "degrees"};
  static const char *const lengths[] = {"metres", "stature"};
  static const char *const masses[] = {"kilograms", "body_mass"};
  static const char *const torques[] = {"newton_metres", "weight_stature"};
  const ambulo__yaml_node *node = ambulo__yaml_require(root, "units");
  const ambulo__yaml_node *angle = ambulo__yaml_require(node, "angle");
  const ambulo__yaml_node *dh_angle = ambulo__yaml_get(node, "dh_angle");
  const ambulo__yaml_node *length = ambulo__yaml_get(node, "length");
  const ambulo__yaml_node *mass = ambulo__yaml_get(node, "mass");
  const ambulo__yaml_node *torque = ambulo__yaml_get(node, "torque");
  int degrees = ambulo__yaml_choice(angle, angles, 2, 0);
  int dh_degrees = ambulo__yaml_choice(dh_angle, angles, 2, degrees);
  int by_stature = ambulo__yaml_choice(length, lengths, 2, 0);
  int by_mass = ambulo__yaml_choice(mass, masses, 2, 0);
  int by_weight = ambulo__yaml_choice(torque, torques, 2, 0);
  ambulo__yaml_close(node);
  const ambulo_subject *s = &reader->subject;
  const double *g = reader->definition.gravity;
  double weight = s->mass * sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  if (by_stature) need(length, s->stature, "stature");
  if (by_mass) need(mass, s->mass, "mass");
  if (by_weight) need(torque, s->mass, "mass");
  if (by_weight) need(torque, s->stature, "stature");
  reader->angle = degrees ? acos(-1) / 180 : 1;
  reader->dh_angle = dh_degrees ? acos(-1) / 180 : 1;
  reader->length = by_stature ? s->stature : 1;
  reader->mass = by_mass ? s->mass : 1;
  reader->force = by_weight ? weight : 1;
  reader->moment = by_weight ? weight * s->stature : 1;
  if (node && asked) warn_of_unused(node, by_stature, by_mass, asked);
}
