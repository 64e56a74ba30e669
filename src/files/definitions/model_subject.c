/* definitions/model_subject.c - `subject` and `units`: who the model is scaled to, and how.
 *
 *   angle    degrees or radians; dh_angle: the same for the DH constants alone
 *   length   metres, or fractions of the stature H
 *   mass     kilograms, or fractions of the body mass M
 *   torque   N m, or fractions of M g H; forces of prismatic joints: N, or fractions of M g
 * Inertias are in the unit of mass times the unit of length squared.
 */
#include <math.h>

#include "definitions/model_reader.h"
#include "ambulo/tools/load.h"

static const double LEAST_MASS = 0.5, LARGEST_MASS = 1000;    /* kg */
static const double LEAST_STATURE = 0.2, LARGEST_STATURE = 3; /* m */

void ambulo__read_subject(ambulo__reader *reader, const ambulo__yaml_node *root) {
  static const char *const sexes[] = {"female", "male"};
  const ambulo__yaml_node *node = ambulo__yaml_get(root, "subject");
  ambulo_subject *s = &reader->subject;
  double mass =
      ambulo__yaml_number_in(ambulo__yaml_get(node, "mass"), LEAST_MASS, LARGEST_MASS, AMBULO_OFF);
  double stature = ambulo__yaml_number_in(ambulo__yaml_get(node, "stature"), LEAST_STATURE,
                                          LARGEST_STATURE, AMBULO_OFF);
  int sex = ambulo__yaml_choice(ambulo__yaml_get(node, "sex"), sexes, 2, -1);
  ambulo__yaml_close(node);
  if (isnan(s->mass)) s->mass = mass;
  if (isnan(s->stature)) s->stature = stature;
  if (s->sex == AMBULO_SEX_NOT_SET && sex >= 0) s->sex = sex == 0 ? AMBULO_FEMALE : AMBULO_MALE;
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
